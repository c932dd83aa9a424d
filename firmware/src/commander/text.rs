//! The commander's words: the one place for what modes, requests, refusals and events are called, over MAVLink, on a
//! console and in files.

use super::{Event, Mode, Refusal, Request};

impl Mode {
    /// Its name, in lower case and without spaces.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Disarmed => "disarmed",
            Self::Idle => "idle",
            Self::TakeOff => "take-off",
            Self::Hold => "hold",
            Self::GoTo => "go-to",
            Self::Velocity => "velocity",
            Self::Follow => "follow",
            Self::Return => "return",
            Self::Land => "land",
            Self::Descent => "descent",
            Self::MotorOut => "motor-out",
        }
    }
}

impl Request {
    /// What is requested, to be followed by "refused".
    pub const fn name(&self) -> &'static str {
        match self {
            Self::Arm { .. } => "Arming",
            Self::Disarm { .. } => "Disarming",
            Self::TakeOff { .. } => "Take-off",
            Self::Hold => "Hold",
            Self::GoTo { .. } => "Go to",
            Self::Velocity { .. } => "Velocity",
            Self::Land => "Landing",
            Self::Return => "Return",
            Self::Follow => "Trajectory",
        }
    }
}

impl Refusal {
    /// The reason in two or three words.
    pub const fn reason(self) -> &'static str {
        match self {
            Self::NoNavigation => "no sensor data",
            Self::NotAligned => "attitude unknown",
            Self::NoPosition => "position unknown",
            Self::NoHeight => "height unknown",
            Self::NotLevel => "not level",
            Self::Moving => "moving",
            Self::Battery => "battery low",
            Self::RotorFailed => "rotor failed",
            Self::InAir => "in the air",
            Self::OnGround => "on the ground",
            Self::Disarmed => "disarmed",
            Self::NotAtStart => "it begins elsewhere",
        }
    }
}

impl Event {
    /// What has happened, and what the vehicle does about it. Short enough for a `STATUSTEXT` (50 characters).
    pub const fn text(self) -> &'static str {
        match self {
            Self::SensorsLost => "Sensors lost: descending blind",
            Self::SensorsGone => "Sensors lost: rotors stopped",
            Self::AttitudeLost => "Attitude lost: descending blind",
            Self::HeightLost => "Height lost: descending blind",
            Self::VelocityLost => "Velocity lost: descending level",
            Self::PositionLost => "Position lost: descending",
            Self::BatteryLow => "Battery low: returning",
            Self::BatteryCritical => "Battery critical: landing",
            // Pilots count rotors from 1.
            Self::RotorFailed { rotor: 0 } => "Rotor 1 failed: descending, turning",
            Self::RotorFailed { rotor: 1 } => "Rotor 2 failed: descending, turning",
            Self::RotorFailed { rotor: 2 } => "Rotor 3 failed: descending, turning",
            Self::RotorFailed { rotor: 3 } => "Rotor 4 failed: descending, turning",
            Self::RotorFailed { .. } => "Rotor failed: descending, turning",
        }
    }
}

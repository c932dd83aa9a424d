//! Texts of the commander: the names of modes, requests, refusals and events, over MAVLink, on the console and in
//! files.

use super::{Event, Mode, Refusal, Request, StationAction};

impl Mode {
    /// The name of the mode, in lower case and without spaces.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Disarmed => "disarmed",
            Self::Idle => "idle",
            Self::TakeOff => "take-off",
            Self::Hold => "hold",
            Self::GoTo => "go-to",
            Self::Velocity => "velocity",
            Self::Offboard => "offboard",
            Self::Orbit => "orbit",
            Self::Acro => "acro",
            Self::Stabilized => "stabilized",
            Self::Altitude => "altitude",
            Self::Position => "position",
            Self::Follow => "trajectory",
            Self::Return => "return",
            Self::Land => "land",
            Self::Descent => "descent",
            Self::MotorOut => "motor-out",
        }
    }
}

impl Request {
    /// The name of the request, to be followed by "refused".
    pub const fn name(&self) -> &'static str {
        match self {
            Self::Arm { .. } => "Arming",
            Self::Disarm => "Disarming",
            Self::TestMotor { .. } => "Motor test",
            Self::TakeOff { .. } => "Takeoff",
            Self::Hold => "Hold",
            Self::Manual(_) => "Manual mode",
            Self::Offboard => "Offboard mode",
            Self::Orbit(_) => "Orbit",
            Self::GoTo(_) => "Go to",
            Self::Speed { .. } => "Speed",
            Self::Velocity { .. } => "Velocity",
            Self::Land | Self::LandAt(_) => "Landing",
            Self::Return => "Return",
            Self::Follow => "Trajectory",
            Self::SetHome { .. } => "Setting home",
        }
    }
}

/// The reason of each refusal: alone, and as what is told when nobody waits for an answer.
macro_rules! reasons {
    ($($refusal:ident $reason:literal;)*) => {
        impl Refusal {
            /// The reason in a few words.
            pub const fn reason(self) -> &'static str {
                match self { $(Self::$refusal => $reason,)* }
            }

            /// The same, said of an arming.
            const fn of_arming(self) -> &'static str {
                match self { $(Self::$refusal => concat!("Arming refused: ", $reason),)* }
            }

            /// The same, said of a take-off.
            const fn of_take_off(self) -> &'static str {
                match self { $(Self::$refusal => concat!("Takeoff refused: ", $reason),)* }
            }
        }
    };
}

reasons! {
    NotHolding "possible in hold only";
    NoNavigation "no sensor data";
    NotAligned "no valid attitude estimate";
    NoHeading "no valid heading estimate";
    NoPosition "no valid position estimate";
    NoHeight "no valid height estimate";
    NotLevel "vehicle not level";
    Moving "vehicle moving";
    Battery "battery too low";
    RotorFailed "motor failed";
    NoGuidance "guidance hung";
    NoCommander "commander hung";
    InAir "vehicle in the air";
    OnGround "vehicle on the ground";
    Disarmed "vehicle disarmed";
    Armed "vehicle armed";
    Terminated "restart the vehicle first";
    NotAtStart "not at the start point";
    NotConfigured "vehicle not configured";
    ThrustToWeight "airframe cannot fly";
    Busy "too many commands at once";
    Unsettled "parameters are being set";
    Killed "killed a second ago";
    KillSwitch "kill switch on";
    NoSticks "no sticks";
    ThrottleUp "throttle stick is up";
    NoSetPoints "no set-points";
}

impl Event {
    /// What has happened, and what the vehicle does about it.
    pub const fn text(self) -> &'static str {
        match self {
            Self::SensorsLost => "Sensor data lost: blind descent",
            Self::SensorsGone => "No sensor data for 2 s: motors stopped",
            Self::AttitudeLost => "Attitude estimate lost: blind descent",
            Self::HeightLost => "Height estimate lost: level descent",
            Self::VelocityLost => "Velocity estimate lost: level descent",
            Self::PositionLost => "Position estimate lost: descending",
            Self::BatteryLow => "Battery low: returning home",
            Self::BatteryCritical => "Battery critical: landing",
            Self::StationLost { action: StationAction::Hold } => "Ground station lost: holding",
            Self::StationLost { action: StationAction::Return } => "Ground station lost: returning home",
            Self::StationLost { action: StationAction::Land } => "Ground station lost: landing",
            Self::SticksLost { action: StationAction::Hold } => "Sticks lost: holding",
            Self::SticksLost { action: StationAction::Return } => "Sticks lost: returning home",
            Self::SticksLost { action: StationAction::Land } => "Sticks lost: landing",
            Self::SetPointsLost { action: None } => "Set-points lost: flown by hand",
            Self::SetPointsLost { action: Some(StationAction::Hold) } => "Set-points lost: holding",
            Self::SetPointsLost { action: Some(StationAction::Return) } => "Set-points lost: returning home",
            Self::SetPointsLost { action: Some(StationAction::Land) } => "Set-points lost: landing",
            Self::NoPositionMode => "Position estimate lost: altitude mode",
            Self::NoAltitudeMode => "Height estimate lost: stabilized mode",
            // Pilots count motors from 1.
            Self::RotorFailed { rotor: 0 } => "Motor 1 failed: descending without yaw control",
            Self::RotorFailed { rotor: 1 } => "Motor 2 failed: descending without yaw control",
            Self::RotorFailed { rotor: 2 } => "Motor 3 failed: descending without yaw control",
            Self::RotorFailed { rotor: 3 } => "Motor 4 failed: descending without yaw control",
            Self::RotorFailed { .. } => "Motor failed: descending without yaw control",
            Self::ArmingRefused { refusal } => refusal.of_arming(),
            Self::TakeOffRefused { refusal } => refusal.of_take_off(),
            Self::OuterHung => "Guidance hung: blind descent",
            Self::CommanderHung => "Commander hung: descending",
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::commander::{Goal, ManualMode, SpeedKind};

    /// Length of the text in a MAVLink `STATUSTEXT`.
    const STATUSTEXT: usize = 50;
    const DOCUMENT: &str = include_str!("../../../docs/mavlink.md");

    #[test]
    fn texts_fit_into_a_statustext_and_are_documented() {
        let zero = [0.0; 3];
        let requests = [
            Request::Arm { force: false },
            Request::Disarm,
            Request::TakeOff { height_m: 0.0 },
            Request::Hold,
            Request::GoTo(Goal::default()),
            Request::Manual(ManualMode::Acro),
            Request::Offboard,
            Request::Speed { kind: SpeedKind::Up, speed_m_s: None },
            Request::Velocity { velocity_m_s: zero, yaw_rate_rad_s: 0.0 },
            Request::Land,
            Request::LandAt(Goal::default()),
            Request::Return,
            Request::Follow,
        ];
        let refusals = [
            Refusal::NoNavigation,
            Refusal::NotAligned,
            Refusal::NoHeading,
            Refusal::NoPosition,
            Refusal::NoHeight,
            Refusal::NotLevel,
            Refusal::Moving,
            Refusal::Battery,
            Refusal::RotorFailed,
            Refusal::NoGuidance,
            Refusal::NoCommander,
            Refusal::InAir,
            Refusal::OnGround,
            Refusal::Disarmed,
            Refusal::Armed,
            Refusal::Terminated,
            Refusal::NotAtStart,
            Refusal::NotConfigured,
            Refusal::ThrustToWeight,
            Refusal::Busy,
            Refusal::Unsettled,
            Refusal::Killed,
            Refusal::KillSwitch,
            Refusal::NoSticks,
            Refusal::ThrottleUp,
            Refusal::NoSetPoints,
            Refusal::NotHolding,
        ];
        for (request, refusal) in requests.iter().flat_map(|request| refusals.map(|refusal| (request, refusal))) {
            let text = format!("{} refused: {}", request.name(), refusal.reason());
            assert!(text.len() <= STATUSTEXT, "{text}");
            assert!(DOCUMENT.contains(&format!("| {} |", refusal.reason())), "{text}");
        }
        for event in [
            Event::SensorsLost,
            Event::SensorsGone,
            Event::AttitudeLost,
            Event::HeightLost,
            Event::VelocityLost,
            Event::PositionLost,
            Event::BatteryLow,
            Event::BatteryCritical,
            Event::StationLost { action: StationAction::Hold },
            Event::StationLost { action: StationAction::Return },
            Event::StationLost { action: StationAction::Land },
            Event::SticksLost { action: StationAction::Hold },
            Event::SticksLost { action: StationAction::Return },
            Event::SticksLost { action: StationAction::Land },
            Event::SetPointsLost { action: None },
            Event::SetPointsLost { action: Some(StationAction::Hold) },
            Event::SetPointsLost { action: Some(StationAction::Return) },
            Event::SetPointsLost { action: Some(StationAction::Land) },
            Event::NoPositionMode,
            Event::NoAltitudeMode,
            Event::RotorFailed { rotor: 0 },
            Event::OuterHung,
            Event::CommanderHung,
        ] {
            assert!(event.text().len() <= STATUSTEXT, "{}", event.text());
            assert!(DOCUMENT.contains(&format!("| {} |", event.text())), "{}", event.text());
        }
    }
}

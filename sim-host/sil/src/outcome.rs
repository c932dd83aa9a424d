//! How a flight ended, by the truth and not by what the vehicle believes.

use serde::Serialize;

/// Why a flight ended, by the truth and not by what the vehicle believes.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum End {
    /// It was flown for as long as the scenario says.
    #[default]
    DurationReached,
    /// It went further than 50 m from its reference, while armed or without ground.
    LeftReference,
    /// Its motion was no longer finite.
    NotFinite,
    /// The user ended it.
    Interrupted,
    /// It stood on the ground all the time.
    NeverFlew,
    /// It hit the ground; what is simulated goes on.
    Crashed(Crash),
}

impl End {
    /// As JSON has it.
    pub fn name(&self) -> &'static str {
        match self {
            Self::DurationReached => "duration-reached",
            Self::LeftReference => "left-reference",
            Self::NotFinite => "not-finite",
            Self::Interrupted => "interrupted",
            Self::NeverFlew => "never-flew",
            Self::Crashed(_) => "crashed",
        }
    }

    /// Whether it was flown to its end, unharmed.
    pub fn survived(&self) -> bool {
        matches!(self, Self::DurationReached)
    }

    /// Whether the simulation ended there because the vehicle was lost.
    pub fn is_lost(&self) -> bool {
        matches!(self, Self::LeftReference | Self::NotFinite)
    }
}

/// How a flight went.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Outcome {
    /// Ticks flown.
    pub ticks: u32,
    /// Ticks in which the mixer could not give the whole demand.
    pub saturated_ticks: u32,
    /// Why it ended.
    pub end: End,
    /// The first touchdown after it had flown, where there is ground.
    pub touchdown: Option<Contact>,
    /// The last touchdown; the same one, unless it has flown again.
    pub landing: Option<Contact>,
}

impl Outcome {
    /// Whether it was flown to its end, unharmed.
    pub fn survived(&self) -> bool {
        self.end.survived()
    }

    /// It has ended for this reason, unless it has ended before.
    pub(crate) fn end_by(&mut self, end: End) {
        if self.survived() {
            self.end = end;
        }
    }
}

/// A touchdown.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Contact {
    /// The first row with a foot on the ground, s.
    pub t_s: f64,
    /// Downwards, in the last row in the air, m/s: in the next, the ground has begun to brake it.
    pub descent_m_s: f64,
    /// Along the ground, in the last row in the air, m/s.
    pub drift_m_s: f64,
    /// Where, m.
    pub position_m: [f64; 3],
    /// Horizontal distance from where the flight began, m.
    pub from_start_m: f64,
}

/// The contact with the ground that damaged the vehicle.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Crash {
    /// When, s.
    pub t_s: f64,
    /// Downwards, in the last row in the air, m/s; 0 where it tipped over on the ground.
    pub descent_m_s: f64,
    /// Tilt at the contact, rad.
    pub tilt_rad: f64,
}

//! Whether the jobs of the outer partition and of the commander end, by the age of their outputs in effect.
//!
//! An overrun is no hang: the old output stays in effect for another period, and the flight goes on. But an output that is
//! never replaced would be flown for ever.

use crate::commander::{Directive, Known};
use crate::config::{FlightConfig, ModeSettings};
use crate::control::flatness::{self, ForceProfile, Heading};
use crate::settings::{Change, Place};
use crate::signals::{AttitudeReference, NavHealth, NavState, Tick};

/// The outer partition hangs when its output is older than this, ticks: 25 of its periods. Holding an attitude of 45° for
/// 0.1 s changes the velocity by 1 m/s and the place by 5 cm; from there a vehicle can still be levelled.
pub const OUTER_HUNG_AFTER: Tick = 100;
/// The commander hangs when its output is older than this, ticks: 25 of its periods. Its directive stays safe for much
/// longer than an attitude, but no failsafe acts meanwhile.
pub const COMMANDER_HUNG_AFTER: Tick = 500;

/// Which partitions hang.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Hung {
    /// Guidance and position control.
    pub outer: bool,
    /// Arming, modes, failsafes.
    pub commander: bool,
}

/// The ages of the outputs in effect, and what is flown in place of those that are too old.
#[derive(Clone, Debug, Default)]
pub struct Watchdog {
    outer_at: Tick,
    commander_at: Tick,
    /// In place of the outer partition's reference.
    level: Option<AttitudeReference>,
    /// Whether a directive has been given in place of the commander's.
    descends: bool,
}

/// How it is flown in place of a partition that hangs, as the settings say.
#[derive(Clone, Debug)]
pub struct Fallback {
    modes: ModeSettings,
    weight_n: f32,
}

impl Fallback {
    /// For a valid configuration.
    pub fn new(config: &FlightConfig) -> Self {
        Self { modes: config.modes, weight_n: config.airframe.weight_n() }
    }

    /// Takes over a setting.
    pub fn apply(&mut self, change: &Change) {
        change.apply_to(&mut self.modes, Place::modes);
    }

    /// Thrust of a blind descent in place of the outer partition's, N.
    pub fn blind_thrust_n(&self) -> f32 {
        self.modes.blind_thrust_part * self.weight_n
    }

    /// Rate of a descent in place of the commander's, m/s.
    pub fn rate_m_s(&self) -> f32 {
        self.modes.touchdown_m_s
    }
}

impl Watchdog {
    /// An output of the outer partition has taken effect.
    #[inline]
    pub fn outer_published(&mut self, tick: Tick) {
        self.outer_at = tick;
    }

    /// An output of the commander has taken effect.
    #[inline]
    pub fn commander_published(&mut self, tick: Tick) {
        self.commander_at = tick;
        self.descends = false;
    }

    /// Whether the outer partition hangs.
    #[inline]
    pub fn is_outer_hung(&self, tick: Tick) -> bool {
        tick.wrapping_sub(self.outer_at) > OUTER_HUNG_AFTER
    }

    /// Which partitions hang.
    pub fn hung(&self, tick: Tick) -> Hung {
        let commander = tick.wrapping_sub(self.commander_at) > COMMANDER_HUNG_AFTER;
        Hung { outer: self.is_outer_hung(tick), commander }
    }

    /// A blind descent in place of the outer partition: level, with the present heading and a thrust (N) below the weight.
    /// Also whether this is its first tick.
    pub fn level(&mut self, tick: Tick, nav: &NavState, thrust_n: f32) -> (AttitudeReference, bool) {
        let is_first = self.level.is_none_or(|level| tick.wrapping_sub(level.valid_at) != 1);
        let target = match self.level {
            Some(level) if !is_first => level.target,
            _ => {
                let heading = Heading { angle: nav.yaw(), rate: 0.0, acceleration: 0.0 };
                flatness::attitude_target(&ForceProfile::hover(1.0), &heading)
            }
        };
        let level = AttitudeReference { valid_at: tick, target, thrust_n, thrust_rate_n_s: 0.0 };
        self.level = Some(level);
        (level, is_first)
    }

    /// Whether a descent is flown in place of what the commander told.
    pub fn descends(&self) -> bool {
        self.descends
    }

    /// A descent by what is known in place of the commander's directive, at a rate (m/s); `None` on the ground. Also
    /// whether this is the first.
    pub fn descent(
        &mut self,
        told: &Directive,
        rate_m_s: f32,
        health: &NavHealth,
        heading_free: bool,
    ) -> Option<(Directive, bool)> {
        if matches!(told, Directive::Stop | Directive::Idle) {
            return None;
        }
        let is_first = !core::mem::replace(&mut self.descends, true);
        Some((Directive::Descend { rate_m_s, known: Known::of(health), heading_free }, is_first))
    }
}

//! Catching a vehicle that guidance takes over while it falls, or climbs, faster than guidance ever would.
//!
//! The generator brakes by its limits, which are made for comfort: a fall of 15 m/s after a flip would take seven seconds
//! and fifty metres. Until it is slow again it may use half of what the rotors can do beyond the weight.

use super::Outer;
use crate::config::ModeSettings;
use crate::control::law::PositionLaw;
use crate::guidance::setpoint::Target;
use crate::math;
use crate::signals::FlatReference;

/// A motion that is so much faster than the limit is caught, m/s.
const TOO_FAST_M_S: f32 = 2.0;
/// Part of the greatest acceleration against gravity that is used.
const PART: f32 = 0.5;
/// Least vertical force meanwhile, as a fraction of the weight. At the speed at which drag carries a vehicle next to no
/// force is needed to fall on, and the direction of a force that vanishes is anything: it would tumble after it.
const LEAST: f32 = 0.25;
/// The acceleration is reached so much faster.
const FASTER: f32 = 4.0;

impl<P: PositionLaw> Outer<P> {
    /// The generator goes on from a motion.
    pub(super) fn go_on_from(&mut self, motion: &FlatReference) {
        self.catch(self.is_too_fast(motion));
        self.setpoint.start(motion);
    }

    /// A step of the generator.
    pub(super) fn advance(&mut self, target: &Target) -> FlatReference {
        let reference = self.setpoint.advance(target);
        if self.catches && !self.is_too_fast(&reference) {
            self.catch(false);
        }
        reference
    }

    /// Begins to catch the vehicle, or ends it.
    pub(super) fn catch(&mut self, catches: bool) {
        if catches || self.catches {
            self.catches = catches;
            self.setpoint.limit(&if catches { self.hasty() } else { self.modes });
            self.limits = self.limits.with_floor(catches.then_some(LEAST * self.model.gravity));
        }
    }

    fn is_too_fast(&self, motion: &FlatReference) -> bool {
        let up = motion.velocity.z;
        up > self.modes.climb_m_s + TOO_FAST_M_S || -up > self.modes.sink_m_s + TOO_FAST_M_S
    }

    /// The limits while it catches.
    fn hasty(&self) -> ModeSettings {
        let modes = &self.modes;
        let spare = PART * (self.limits.force_max() - self.model.gravity);
        ModeSettings {
            vertical_acceleration_m_s2: math::max(spare, modes.vertical_acceleration_m_s2),
            jerk_m_s3: FASTER * modes.jerk_m_s3,
            ..*modes
        }
    }
}

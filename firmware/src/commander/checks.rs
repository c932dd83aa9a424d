//! Checks before arming, take-off and position flight.

use super::watch::Charge;
use super::{AT_PLACE_M, Commander, CommanderInput, Intent, Known, ManualMode, Refusal};
use crate::math;
use crate::signals::NavState;

/// Greatest tilt for arming: cos 20°.
const COS_TILT_MAX: f32 = 0.94;
/// Greatest speed of a vehicle that counts as not moving, m/s: above the noise of an estimate at rest.
const SPEED_MAX_M_S: f32 = 0.5;

impl Commander {
    /// Whether the vehicle may be armed.
    pub(super) fn check(&self, input: &CommanderInput) -> Result<(), Refusal> {
        let q = input.nav.attitude.quaternion();
        let cos_tilt = 1.0 - 2.0 * (q.i * q.i + q.j * q.j);
        self.check_configured()?;
        self.check_terminated()?;
        self.check_systems(&self.intent, input)?;
        if math::max(cos_tilt, -1.0) < COS_TILT_MAX {
            Err(Refusal::NotLevel)
        } else if self.ground.is_airborne() || !is_slow(&input.nav) {
            Err(Refusal::Moving)
        } else {
            Ok(())
        }
    }

    /// Whether the vehicle was ever configured.
    pub(super) fn check_configured(&self) -> Result<(), Refusal> {
        if !self.configured {
            Err(Refusal::NotConfigured)
        } else if super::THRUST_TO_WEIGHT.contains(&self.thrust_to_weight) {
            Ok(())
        } else {
            Err(Refusal::ThrustToWeight)
        }
    }

    /// Whether the flight was terminated since the vehicle was started.
    pub(super) fn check_terminated(&self) -> Result<(), Refusal> {
        if self.terminated { Err(Refusal::Terminated) } else { Ok(()) }
    }

    /// Whether navigation, battery and rotors are fit for a flight.
    fn check_systems(&self, intent: &Intent, input: &CommanderInput) -> Result<(), Refusal> {
        let health = &input.health;
        if input.nav_fresh && !health.attitude {
            return Err(Refusal::NotAligned);
        }
        if input.nav_fresh && !health.heading {
            return Err(Refusal::NoHeading);
        }
        check_known(intent, input)?;
        if self.battery.charge() == Charge::Critical {
            Err(Refusal::Battery)
        } else if input.failed_rotor.is_some() {
            Err(Refusal::RotorFailed)
        } else if input.outer_hung {
            Err(Refusal::NoGuidance)
        } else {
            Ok(())
        }
    }

    /// Whether the vehicle may take off.
    pub(super) fn check_take_off(&self, intent: &Intent, input: &CommanderInput) -> Result<(), Refusal> {
        self.check_systems(intent, input)?;
        if self.battery.charge() != Charge::Good {
            return Err(Refusal::Battery);
        }
        let away = (input.nav.position - self.start).norm_squared();
        if *intent == Intent::Follow && away > AT_PLACE_M * AT_PLACE_M {
            return Err(Refusal::NotAtStart);
        }
        Ok(())
    }

    /// Whether a place can be gone to: the position is known, now and persistently, and guidance runs.
    pub(super) fn check_position(&self, input: &CommanderInput) -> Result<(), Refusal> {
        if input.outer_hung {
            return Err(Refusal::NoGuidance);
        }
        check_position(input)?;
        if self.navigation.known() == Known::Position { Ok(()) } else { Err(Refusal::NoPosition) }
    }
}

/// Whether what a mode needs is known of the motion.
fn check_known(intent: &Intent, input: &CommanderInput) -> Result<(), Refusal> {
    match intent {
        Intent::Manual(ManualMode::Acro | ManualMode::Stabilized) if input.nav_fresh => Ok(()),
        Intent::Manual(ManualMode::Altitude) if input.nav_fresh => {
            if input.health.height {
                Ok(())
            } else {
                Err(Refusal::NoHeight)
            }
        }
        _ => check_position(input),
    }
}

fn check_position(input: &CommanderInput) -> Result<(), Refusal> {
    if !input.nav_fresh {
        Err(Refusal::NoNavigation)
    } else if !(input.health.position && input.health.velocity) {
        Err(Refusal::NoPosition)
    } else if !input.health.height {
        Err(Refusal::NoHeight)
    } else {
        Ok(())
    }
}

/// Whether the vehicle counts as not moving.
pub(super) fn is_slow(nav: &NavState) -> bool {
    nav.velocity.norm_squared() < SPEED_MAX_M_S * SPEED_MAX_M_S
}

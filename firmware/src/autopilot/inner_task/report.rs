//! What the ground partition is told of the vehicle.

use super::{InnerTask, Waiting};
use crate::commander::{Directive, Known, ManualMode, Mode};
use crate::control::law::AttitudeLaw;
use crate::estimator::status::Status;
use crate::mavlink::report::{Aim, ControlReport, LawReport, SensorReport};
use crate::mavlink::{GroundInput, Health};
use crate::outer::Authority;

impl<A: AttitudeLaw> InnerTask<A> {
    pub(super) fn ground_input(&mut self, overruns: [u32; 3]) -> GroundInput {
        GroundInput {
            nav: *self.inner.nav(),
            armed: self.is_armed(),
            mode: if self.watchdog.descends() { Mode::Descent } else { self.commander.shown },
            landed: self.commander.landed,
            ground_m: self.commander.ground_m,
            armable: self.commander.armable.is_ok(),
            health: Health {
                nav_fresh: self.inner.is_nav_fresh(),
                refused_samples: self.inner.refused_samples(),
                overruns,
                hung: self.watchdog.hung(self.tick),
                timing: self.timing,
            },
            estimator: self.estimator_status(),
            control: self.control_report(),
            sensors: self.sensor_report(),
            home: self.commander.home,
            injectable: self.injectable,
            changes_taken: self.waiting == Waiting::default(),
            replies: core::mem::take(&mut self.replies),
            events: core::mem::take(&mut self.events),
        }
    }

    fn control_report(&self) -> ControlReport {
        let (inner, outer, airframe) = (self.inner.output(), &self.outer, self.inner.airframe());
        let holds_position = match self.commander.directive {
            Directive::Descend { known, .. } => known == Known::Position,
            Directive::Manual { mode, .. } => mode == ManualMode::Position,
            _ => true,
        };
        let aim = Aim {
            attitude: outer.attitude.target.attitude,
            rates: outer.attitude.target.rates,
            thrust_n: outer.attitude.thrust_n,
            place: outer.wanted,
            velocity: outer.wanted_velocity,
            acceleration: outer.wanted_acceleration,
            yaw_rate: outer.wanted_yaw_rate,
            holds_position,
            holds_heading: !outer.heading_free,
        };
        ControlReport {
            aim: (self.is_armed() && outer.authority != Authority::Idle).then_some(aim),
            orbit: if let Directive::Orbit(orbit) = self.commander.directive { Some(orbit) } else { None },
            attitude_law: LawReport { s: inner.s, state: self.inner.law_state() },
            position_law: LawReport { s: outer.s, state: outer.law },
            motors: inner.motors,
            rotor_speeds_rad_s: *self.inner.rotor_speeds_rad_s(),
            thrust_n: inner.demand.thrust_n,
            thrust_max_n: airframe.thrust_max_n(),
            omega_max_rad_s: airframe.omega_max_rad_s,
        }
    }

    /// The sensors; `None` on ideal state.
    fn sensor_report(&self) -> Option<SensorReport> {
        let navigator = self.inner.navigator()?;
        let latest = navigator.latest();
        Some(SensorReport {
            imu: navigator.imu(),
            mag: latest.mag,
            baro: latest.baro,
            gnss: latest.gnss,
            vibration_m_s2: navigator.vibration().level_m_s2(),
            clipped: navigator.vibration().clipped(),
        })
    }

    /// The estimator's report; `None` on ideal state.
    pub fn estimator_status(&self) -> Option<Status> {
        let battery = self.inner.navigator()?.battery_with_age();
        Some(self.fusion.status(self.tick, &self.filter, self.nav_health(), battery))
    }
}

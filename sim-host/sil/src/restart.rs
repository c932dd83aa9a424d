//! Restarting the firmware in flight's world: what a board does by resetting its processor.

use firmware::autopilot::Autopilot;
use firmware::config::{FlightConfig, Start};
use firmware::failure::Injectable;
use firmware::mavlink::port::Ports;
use firmware::settings::Settings;

/// How the firmware is built again when a ground station restarts it.
#[derive(Clone, Debug)]
pub struct Restart<A, L> {
    /// The configuration, into which the settings are written as they are then.
    pub config: FlightConfig,
    /// Builds it of both, with its links.
    pub build: fn(&FlightConfig, Settings, Ports) -> Option<Autopilot<A, L>>,
}

impl<A, L> Restart<A, L>
where
    A: firmware::control::law::AttitudeLaw,
    L: firmware::control::law::PositionLaw,
{
    /// Builds the firmware again, as it is after a restart on the ground: with its settings, its links open and its clock
    /// going on.
    #[cold]
    pub(crate) fn restart(&self, autopilot: &mut Autopilot<A, L>, injectable: Injectable) {
        let settings = autopilot.ground.settings().clone();
        let mut config = FlightConfig { start: Start::OnGround, ..self.config.clone() };
        settings.write_to(&mut config);
        let ports = core::mem::replace(&mut autopilot.ports, Ports::new());
        let Some(mut again) = (self.build)(&config, settings, ports) else { return };
        again.inner.start_at(autopilot.inner.next_tick());
        again.inner.allow_failures(injectable);
        *autopilot = again;
    }
}

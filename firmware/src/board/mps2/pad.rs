//! Drivers of a board without sensors: it reports standing at its start position, level and at rest.

use super::{FreeRunning, RecordingPwm};
use crate::airframe::ROTORS;
use crate::board::{Companion, Rotors, Sensors, Start, StartError};
use crate::config::FlightConfig;
use crate::failure::Injectable;
use crate::mavlink::port::Ports;
use crate::pil::Cause;
use crate::rotors::PwmRotors;
use crate::settings::Settings;
use crate::signals::{MotorCommand, NavState, SensorFrame, Tick};

/// A sensor that always returns the same sample, and the chip's own outputs.
pub struct Board {
    sample: SensorFrame,
    pwm: PwmRotors<RecordingPwm>,
}

impl Sensors for Board {
    fn sample(&mut self, _tick: Tick) -> Option<SensorFrame> {
        Some(self.sample)
    }
}

impl Rotors for Board {
    fn drive(&mut self, command: &MotorCommand) {
        // These outputs cannot fail.
        let _ = self.pwm.set(command);
    }
}

impl Companion for Board {
    fn restart(&mut self) {
        cortex_m::peripheral::SCB::sys_reset();
    }
}

/// No additions to the partitions' jobs.
pub type Diagnostics = ();

/// The default flight.
///
/// # Errors
/// None on this board.
pub fn start(
    pwm: [RecordingPwm; ROTORS],
    _clock: FreeRunning,
    _ports: &'static Ports,
) -> Result<Start<Board, Diagnostics>, StartError> {
    let config = FlightConfig::default();
    let mut nav = NavState::at_rest();
    nav.position = config.start_position();
    let pwm = PwmRotors::new(pwm, config.airframe.omega_max_rad_s);
    let board = Board { sample: SensorFrame::Motion(nav), pwm };
    let settings = Settings::of(&config);
    Ok(Start { config, settings, injectable: Injectable::NONE, board, diagnostics: () })
}

/// Does nothing: there is no host.
pub fn answer(_result: Result<(), StartError>) {}

/// Does nothing: there is no host.
pub fn stopped(_cause: Cause) {}

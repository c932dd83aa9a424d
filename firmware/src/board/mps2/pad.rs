//! Drivers of a board without sensors: it reports standing at its start position, level and at rest.

use super::{Start, StartError};
use crate::airframe::ROTORS;
use crate::autopilot::InnerTask;
use crate::board::mps2::{FreeRunning, RecordingPwm};
use crate::config::FlightConfig;
use crate::failure::Injectable;
use crate::mavlink::port::Ports;
use crate::pil::Cause;
use crate::rotors::PwmRotors;
use crate::signals::{NavState, SensorFrame, Tick};

/// The serial port carries a link, and the loops' measured rates are sent.
pub const STANDS_ALONE: bool = true;

/// An IMU that always returns the same sample.
pub struct Imu {
    sample: SensorFrame,
}

impl super::Imu for Imu {
    fn sample(&mut self) -> Option<SensorFrame> {
        Some(self.sample)
    }
}

/// The board's own outputs.
pub struct Rotors {
    pwm: PwmRotors<RecordingPwm>,
}

impl super::Rotors for Rotors {
    fn drive(&mut self, flight: &InnerTask, _overruns: [u32; 3]) {
        // These outputs cannot fail.
        let _ = self.pwm.set(&flight.inner_output().motors);
    }
}

/// No additions to the partitions' jobs.
#[derive(Clone, Copy)]
pub struct Diagnostics;

impl Diagnostics {
    /// In the outer partition's job.
    pub fn outer(self, _tick: Tick) {}
    /// In the commander's job.
    pub fn commander(self) {}
    /// In the ground partition's job.
    pub fn ground(self) {}
}

/// The default flight.
///
/// # Errors
/// None on this board.
pub fn start(
    pwm: [RecordingPwm; ROTORS],
    _clock: FreeRunning,
    _ports: &'static Ports,
) -> Result<Start<Imu, Rotors, Diagnostics>, StartError> {
    let config = FlightConfig::default();
    let mut nav = NavState::at_rest();
    nav.position = config.start_position();
    let rotors = Rotors { pwm: PwmRotors::new(pwm, config.airframe.omega_max_rad_s) };
    let imu = Imu { sample: SensorFrame::Motion(nav) };
    Ok(Start { config, injectable: Injectable::NONE, imu, rotors, diagnostics: Diagnostics })
}

/// Does nothing: there is no host.
pub fn answer(_result: Result<(), StartError>) {}

/// Does nothing: there is no host.
pub fn stopped(_cause: Cause) {}

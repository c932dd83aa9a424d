//! What differs between boards; compiled for the target only.
//!
//! [`mps2`] is the chip of QEMU's mps2-an386: interrupts, timers, serial port, and PWM outputs that only remember.
//! An application takes its IMU and rotors from a drivers module: [`pad`] for a board without sensors, standing
//! still, `host` for processor in the loop. Each drivers module has the same items: `start`, `answer` and `stopped`,
//! and the types `Imu`, `Rotors` and `Diagnostics`. [`fault`] stops the rotors when nothing else is sure.
//!
//! Beside the square root's instruction in `math`, the only module of the crate with `unsafe` code; each block says why
//! it is sound.

#[cfg(feature = "pil")]
pub mod counter;
pub mod fault;
#[cfg(feature = "pil")]
pub mod host;
pub mod mps2;
pub mod pad;

use crate::autopilot::InnerTask;
use crate::commander::Request;
use crate::config::FlightConfig;
use crate::signals::SensorFrame;
use crate::validate::ConfigError;

/// The source of the inner loop's samples.
pub trait Imu {
    /// The sample of the tick that has just begun; none if it is missing. Called once a tick by the inner task,
    /// which waits for it.
    fn sample(&mut self) -> Option<SensorFrame>;

    /// What a pilot has asked for since the last tick, beside MAVLink. Called once a tick, after the sample.
    fn asked(&mut self) -> Option<Request> {
        None
    }
}

/// The sink of the inner loop's motor commands.
pub trait Rotors {
    /// Puts into effect what the inner loop has decided in this tick. Called once a tick by the inner task, after
    /// its step; must not wait for the rotors.
    fn drive(&mut self, flight: &InnerTask, overruns: [u32; 3]);
}

/// What a drivers module gives the application at boot.
pub struct Start<I, R, D> {
    /// What to fly.
    pub config: FlightConfig,
    /// Source of samples.
    pub imu: I,
    /// Sink of commands.
    pub rotors: R,
    /// What to do in the partitions beside their job.
    pub diagnostics: D,
}

/// Why a board does not fly.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum StartError {
    /// The application was started twice.
    Peripherals,
    /// The configuration holds a value that is out of its range.
    Config(ConfigError),
    /// The host cannot be reached.
    #[cfg(feature = "pil")]
    NoHost,
    /// What the host sent is not a flight for this build.
    #[cfg(feature = "pil")]
    Hello(crate::pil::HelloError),
}

impl core::fmt::Display for StartError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self {
            Self::Peripherals => f.write_str("the peripherals are taken"),
            Self::Config(error) => error.fmt(f),
            #[cfg(feature = "pil")]
            Self::NoHost => f.write_str("the host cannot be reached"),
            #[cfg(feature = "pil")]
            Self::Hello(error) => error.fmt(f),
        }
    }
}

//! Board support, compiled for the target only.
//!
//! [`mps2`] is the chip of QEMU's mps2-an386: interrupts, timers, serial port, and PWM outputs that only record their
//! duty cycle. An application takes its IMU and rotors from a drivers module: [`pad`] for a board without sensors that
//! stands still, `host` for processor in the loop. Each drivers module has the same items: the functions `start`,
//! `answer` and `stopped`, the types `Imu`, `Rotors` and `Diagnostics`, and `STANDS_ALONE`. [`fault`] stops the rotors after a panic or
//! hard fault.
//!
//! Apart from the square root instruction in `math`, this is the only module of the crate with `unsafe` code; each
//! block states why it is sound.

#[cfg(feature = "pil")]
pub mod counter;
pub mod fault;
#[cfg(feature = "pil")]
pub mod host;
pub mod mps2;
pub mod pad;

use crate::autopilot::InnerTask;
use crate::commander::Asked;
use crate::config::FlightConfig;
use crate::failure::Injectable;
use crate::signals::SensorFrame;
use crate::validate::ConfigError;

/// The source of the inner loop's samples.
pub trait Imu {
    /// The sample of the tick that has just begun; `None` if it is missing. Called once per tick by the inner task,
    /// which waits for it.
    fn sample(&mut self) -> Option<SensorFrame>;

    /// The next request since the last tick that did not come by MAVLink. Called after the sample until there is none.
    fn asked(&mut self) -> Option<Asked> {
        None
    }
}

/// The sink of the inner loop's motor commands.
pub trait Rotors {
    /// Outputs the inner loop's motor commands of this tick. Called once per tick by the inner task, after its step;
    /// must not wait for the rotors.
    fn drive(&mut self, flight: &InnerTask, overruns: [u32; 3]);
}

/// What a drivers module returns to the application at boot.
pub struct Start<I, R, D> {
    /// Configuration of the flight.
    pub config: FlightConfig,
    /// Failures that can be injected.
    pub injectable: Injectable,
    /// Source of samples.
    pub imu: I,
    /// Sink of commands.
    pub rotors: R,
    /// Additions to the partitions' jobs, for tests.
    pub diagnostics: D,
}

/// Error of starting a board.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum StartError {
    /// The application was started twice.
    Peripherals,
    /// The configuration is invalid.
    Config(ConfigError),
    /// The host cannot be reached.
    #[cfg(feature = "pil")]
    NoHost,
    /// The host's first frame cannot be decoded.
    #[cfg(feature = "pil")]
    Hello(crate::pil::HelloError),
}

impl core::fmt::Display for StartError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self {
            Self::Peripherals => f.write_str("the peripherals are already in use"),
            Self::Config(error) => error.fmt(f),
            #[cfg(feature = "pil")]
            Self::NoHost => f.write_str("the host cannot be reached"),
            #[cfg(feature = "pil")]
            Self::Hello(error) => error.fmt(f),
        }
    }
}

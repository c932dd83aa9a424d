//! What a board gives the firmware, as traits, and the bodies of the tasks that are generic over them.
//!
//! ```text
//! Ticker ─► inner:    Sensors, flight, Rotors, Companion     Clock measures it
//! serial ─► receive ──► Ports ──► ground ──► Ports ──► transmit ─► serial
//! ```
//!
//! [`tasks`] has a struct for each task, with what is its own, and a method that the task calls. An application binds them
//! to interrupts and priorities, and is little else. Both know no chip, so they are compiled and tested on the desktop too.
//! What a chip is made of stands in a module of its own behind a feature: `mps2`, QEMU's mps2-an386, behind `board-mps2`.
//! `fault` stops the rotors after a panic or a hard fault.
//!
//! Apart from the square root instruction in `math`, the chips' modules and `fault` are the only ones of the crate with
//! `unsafe` code; each block states why it is sound.

#[cfg(all(target_arch = "arm", target_os = "none"))]
pub mod fault;
#[cfg(all(feature = "board-mps2", target_arch = "arm", target_os = "none"))]
pub mod mps2;
pub mod storage;
pub mod tasks;

use embedded_io::{Read, ReadReady, Write, WriteReady};

use crate::autopilot::InnerTask;
use crate::commander::Asked;
use crate::config::FlightConfig;
use crate::failure::Injectable;
use crate::mavlink::port::Ports;
use crate::settings::Settings;
use crate::signals::{MotorCommand, SensorFrame, Tick};
use crate::validate::ConfigError;

/// The source of the inner loop's samples.
pub trait Sensors {
    /// The sample of a tick; `None` if it is missing. Called by the inner task, once at the beginning of every tick, which
    /// waits for it: a driver that has none yet returns `None` rather than take a part of the tick.
    fn sample(&mut self, tick: Tick) -> Option<SensorFrame>;
}

/// The sink of the inner loop's motor commands.
pub trait Rotors {
    /// Outputs the commands of a tick. Called by the inner task, once per tick, after its step; must not wait for the
    /// rotors. If one output fails, the others are set nevertheless.
    fn drive(&mut self, command: &MotorCommand);
}

/// Whoever takes part in the flight besides the schedule: a computer on board that asks without MAVLink, or the host of
/// processor in the loop. Most boards have none, and implement nothing.
pub trait Companion {
    /// Whether it is at the other end of every link, and compares what is sent: then the serial ports carry none, and
    /// nothing is sent that a clock has measured.
    const HAS_ALL_LINKS: bool = false;

    /// The next request since the last tick. Called by the inner task after the sample, until there is none.
    fn asked(&mut self) -> Option<Asked> {
        None
    }

    /// The inner task has finished its tick. `overruns` are those of outer, commander and ground since boot.
    fn see(&mut self, _flight: &InnerTask, _overruns: [u32; 3], _ports: &Ports) {}

    /// A ground station wants the vehicle restarted, which is disarmed: resets the processor. Half a second ago it has been
    /// told that it will be. A board that cannot stays as it is.
    fn restart(&mut self) {}
}

/// A clock that does not depend on the tick: the tick is measured by it.
pub trait Clock {
    /// How fast it counts.
    const COUNTS_PER_US: u32;

    /// Counts since its start, modulo 2³².
    fn now(&self) -> u32;
}

/// The source of the inner task's interrupt: a timer, or the sensor's own.
pub trait Ticker {
    /// The first interrupt comes one period from now.
    fn start(&mut self, period_us: u32);

    /// Called once per interrupt, first of all.
    fn acknowledge(&mut self);
}

/// The receiving half of a serial port, which interrupts when it has a byte.
pub trait SerialReceiver: Read + ReadReady {
    /// Called once per interrupt, before reading: a byte that arrives later interrupts again.
    fn acknowledge(&mut self);
}

/// The sending half of a serial port, which interrupts when it has room.
pub trait SerialSender: Write + WriteReady {
    /// Called once per interrupt, before writing.
    fn acknowledge(&mut self);
}

/// What is added to the partitions' jobs, for tests of what a late or faulty one does. Nothing, for `()`.
pub trait Diagnostics {
    /// In the outer partition's job, which was released at this tick.
    fn outer(&mut self, _released: Tick) {}
    /// In the commander's job.
    fn commander(&mut self) {}
    /// In the ground partition's job.
    fn ground(&mut self) {}
}

impl Diagnostics for () {}

/// What a board begins a flight with.
pub struct Start<B, D> {
    /// Configuration of the flight.
    pub config: FlightConfig,
    /// Its settings: those of the configuration, and what stands in the settings alone.
    pub settings: Settings,
    /// Failures that can be injected.
    pub injectable: Injectable,
    /// The drivers of the inner task.
    pub board: B,
    /// Additions to the partitions' jobs.
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

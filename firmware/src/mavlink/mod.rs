//! The ground partition, 100 Hz: MAVLink.
//!
//! Bytes in, bytes out; the board or the host only carries them. Knows NED/FRD through `frames` alone.

use crate::commander::{Commands, Replies};
use crate::signals::{NavState, Tick};

/// Bytes that can arrive between two jobs.
pub const RX_CAPACITY: usize = 512;
/// Bytes that one job can send.
pub const TX_CAPACITY: usize = 512;

/// Bytes received.
pub type RxBytes = heapless::Vec<u8, RX_CAPACITY>;
/// Bytes to send.
pub type TxBytes = heapless::Vec<u8, TX_CAPACITY>;

/// What a board has measured of its two control loops over the last second, with a clock of its own.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct LoopTiming {
    /// Activations of the inner loop in the second.
    pub inner_hz: u16,
    /// Finished jobs of the outer loop in the second.
    pub outer_hz: u16,
    /// Shortest and longest time between two activations of the inner loop, µs.
    pub inner_period_us: (u16, u16),
}

/// How the firmware itself is doing.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Health {
    /// Whether the motion is to be trusted.
    pub nav_fresh: bool,
    /// Sensor samples refused since boot.
    pub refused_samples: u32,
    /// Bytes of the ground station that did not fit, since boot.
    pub dropped_bytes: u32,
    /// Jobs of the outer, commander and ground partitions that overran since boot.
    pub overruns: [u32; 3],
    /// The loops' rates, where a board measures them.
    pub timing: Option<LoopTiming>,
}

/// Snapshot for the ground partition.
#[derive(Clone, Debug, PartialEq)]
pub struct GroundInput {
    /// The motion at the release.
    pub nav: NavState,
    /// Whether the rotors may turn.
    pub armed: bool,
    /// Whether the vehicle is on the ground.
    pub landed: bool,
    /// Whether an arm request would be accepted.
    pub armable: bool,
    /// How the firmware itself is doing.
    pub health: Health,
    /// Answers of the commander since the last job.
    pub replies: Replies,
    /// What the ground station has sent since the last job.
    pub received: RxBytes,
}

/// What the ground partition has to say.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct GroundOutput {
    /// For the ground station.
    pub transmit: TxBytes,
    /// For the commander.
    pub commands: Commands,
}

/// The ground partition.
#[derive(Clone, Debug, Default)]
pub struct Ground {}

impl Ground {
    /// One job, released at `released`.
    pub fn step(&mut self, _released: Tick, _input: &GroundInput) -> GroundOutput {
        GroundOutput::default()
    }
}

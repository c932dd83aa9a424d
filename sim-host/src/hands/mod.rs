//! A pilot's hands in this process: the sticks of a gamepad or of a radio on USB, or keys, and what its buttons ask.
//!
//! ```text
//! device ──► gamepad ─┐
//!                     ├──► sticks, orders ──► station ──► the pilot's link, as bytes
//! terminal ──► keys ──┘
//! ```
//!
//! [`gamepad`] and [`keys`] know the time that they are told and nothing else; `device` (Linux) reads the kernel's events
//! in a thread of its own. [`station`] makes the frames that a ground station's joystick would send, at ticks. So a
//! recording has all that acts on the flight, and neither the vehicle nor a replay knows of hands.
//!
//! *Hands*: what is moved. *Sticks*: what that means. *Order*: what a button or a key asks once.

pub mod axes;
#[cfg(target_os = "linux")]
pub mod device;
pub mod gamepad;
pub mod keys;
pub mod station;

use std::time::Instant;

use crate::console::Tone;
use crate::console::keyboard::Key;

/// Deflections, each 0 in the middle and 1 at the end.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Sticks {
    /// Positive to the right.
    pub roll: f64,
    /// Positive forward: nose down.
    pub pitch: f64,
    /// Positive to the right.
    pub yaw: f64,
    /// Positive up. In the middle it asks for half of the throttle.
    pub throttle: f64,
}

/// A mode that a pilot selects.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Selected {
    /// The sticks tilt the vehicle; the throttle is its thrust.
    Stabilized,
    /// As stabilized; the throttle climbs and descends.
    Altitude,
    /// The sticks are velocities.
    Position,
    /// The sticks are angular rates.
    Acro,
    /// Brakes and stays.
    Hold,
    /// Goes back and lands.
    Return,
    /// Lands here.
    Land,
}

/// What a button or a key asks for, once.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Order {
    /// Arm, or disarm if it is armed.
    ArmOrDisarm,
    /// Change the mode.
    Select(Selected),
    /// Stop the rotors at once.
    Kill,
}

/// What hands have done since they were last looked at.
#[derive(Clone, Debug, PartialEq)]
pub enum Act {
    /// Asks the vehicle.
    Order(Order),
    /// Tells who flies what has happened.
    Say(Tone, String),
    /// Shows a line of help.
    Explain(String),
    /// Ends the program.
    Quit,
}

/// What a pilot moves.
pub trait Hands {
    /// A key was pressed.
    fn press(&mut self, key: Key, now: Instant);

    /// What was done until `now`. Called some hundred times a second; does not wait.
    fn poll(&mut self, now: Instant) -> Vec<Act>;

    /// Where the sticks are now; `None` while there are none.
    fn sticks(&self) -> Option<Sticks>;
}

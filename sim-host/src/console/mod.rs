//! The console of `serve`: typed commands in, answers and events out, a line each.
//!
//! [`parse`] makes a line into a command, by the table that help is written from. A [`Session`] hands it to the vehicle
//! through the door for programs on board, and answers once the commander has decided. [`events`] tells what happens by
//! itself or at a ground station's wish. Lines come in between ticks and take effect with the next; a flight that gets
//! none is the flight without a console, bit for bit. [`terminal`] is where lines are typed and printed.

pub mod events;
pub mod line;
pub mod parse;
mod session;
pub mod terminal;

pub use line::{Line, Tone};
pub use session::{Control, Session};

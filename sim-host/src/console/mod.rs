//! The console of `serve`: one line per command, answer and event.
//!
//! [`parse`] reads a line, by the table from which help is written too. A [`Session`] passes the request to the
//! vehicle, as programs on board do, and answers once the commander has decided. [`events`] reports what happens in
//! between, by itself or commanded by a ground station. Lines are read between ticks and take effect in the next tick;
//! without any, the flight is bit for bit the one without a console. [`terminal`] reads and prints; who flies by
//! [keys](crate::hands::keys) gets them from there.

mod answers;
mod commands;
mod disarming;
mod editor;
pub mod events;
pub mod keyboard;
pub mod line;
mod overheard;
pub mod parse;
mod session;
pub mod terminal;

pub use line::{Line, Tone};
pub use session::{ConsoleInput, Control, Session};

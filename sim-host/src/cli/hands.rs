//! `serve --joystick` and `--keys`: what a pilot flies with.

use std::io::IsTerminal as _;

use anyhow::{Context as _, Result, ensure};
use clap::Args;

use crate::console::terminal::Stdio;
use crate::hands::Hands;
use crate::hands::axes::Layout;
use crate::hands::keys::Keys;

#[derive(Args, Clone, Debug)]
pub(super) struct HandsArgs {
    /// Fly by a gamepad, or by a radio on USB: the first that there is, or the one at a path or with this in its name.
    #[arg(long, value_name = "DEVICE", num_args = 0..=1, default_missing_value = "")]
    joystick: Option<String>,
    /// Which of its axes are the sticks, by name or number, a `-` before those to reverse: rx,-ry,x,-y.
    #[arg(long, value_name = "ROLL,PITCH,YAW,THROTTLE", requires = "joystick", allow_hyphen_values = true)]
    joystick_axes: Option<Layout>,
    /// Fly by the keys of this terminal: WASD and the arrows; `?` lists them, `:` begins a typed line.
    #[arg(long, conflicts_with = "joystick")]
    keys: bool,
}

impl HandsArgs {
    /// What the pilot moves, if anything.
    pub(super) fn open(&self) -> Result<Option<Box<dyn Hands>>> {
        if self.keys {
            ensure!(std::io::stdin().is_terminal(), NO_TERMINAL);
            return Ok(Some(Box::<Keys>::default()));
        }
        self.joystick.as_deref().map(|wish| joystick(wish, self.joystick_axes)).transpose()
    }

    /// The terminal on which lines are typed, or keys pressed.
    pub(super) fn terminal(&self) -> Result<Stdio> {
        if self.keys { Stdio::with_keys().context(NO_TERMINAL) } else { Ok(Stdio::new()) }
    }

    /// How to go on, for who starts.
    pub(super) fn hint(&self) -> Option<&'static str> {
        self.keys.then_some(
            "Keys fly: `3` chooses position mode, `m` arms, WASD and the arrows are the sticks. `?` lists them, `:` begins a line, `Q` ends it.",
        )
    }
}

const NO_TERMINAL: &str = "--keys needs a terminal, and standard input is none: leave it out, and type lines";

#[cfg(target_os = "linux")]
fn joystick(wish: &str, axes: Option<Layout>) -> Result<Box<dyn Hands>> {
    Ok(Box::new(crate::hands::device::open(wish, axes)?))
}

#[cfg(not(target_os = "linux"))]
fn joystick(_: &str, _: Option<Layout>) -> Result<Box<dyn Hands>> {
    anyhow::bail!("--joystick is for Linux: fly by --keys, or by the joystick of a ground station")
}

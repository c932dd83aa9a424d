//! Gamepads and radios as Linux shows them, in `/dev/input`: finds one, and reads it in a thread.

use std::io::ErrorKind;
use std::path::{Path, PathBuf};
use std::sync::mpsc::{Sender, channel};
use std::thread;
use std::time::Duration;

use anyhow::{Context as _, Result, anyhow};
use evdev::{AbsoluteAxisCode, EventSummary, EventType, KeyCode, PropType};

use super::axes::{Axis, Device, Layout};
use super::gamepad::{Event, Gamepad};
use crate::words::counted;

/// Where the kernel's devices are.
const FOLDER: &str = "/dev/input";
/// How often it is looked whether a device that is gone is back.
const LOOK_EVERY: Duration = Duration::from_secs(1);
/// Numbers of the buttons of joysticks and gamepads. What has none is no joystick, but perhaps a tablet.
const BUTTONS: core::ops::Range<u16> = 0x120..0x140;
/// A gamepad has this button at least, the south one.
const PAD_BUTTON: KeyCode = KeyCode::BTN_SOUTH;
/// Microsoft's number on USB.
const MICROSOFT: u16 = 0x045e;

/// Which device is meant.
#[derive(Clone, Debug, PartialEq)]
enum Wish {
    /// The first that has sticks.
    First,
    At(PathBuf),
    /// With this in its name, whatever the letters' case.
    Named(String),
}

impl Wish {
    fn of(text: &str) -> Self {
        match text {
            "" => Self::First,
            path if path.contains('/') => Self::At(path.into()),
            name => Self::Named(name.to_lowercase()),
        }
    }

    fn has_named(&self, name: &str) -> bool {
        if let Self::Named(part) = self { name.to_lowercase().contains(part) } else { true }
    }
}

/// An open device.
struct Open {
    device: evdev::Device,
    described: Device,
}

/// Opens the device that is meant by a path, or a part of its name, or by nothing the first one that has sticks, and goes
/// on to read it; with these axes, or those that it seems to have.
///
/// # Errors
/// One line with what was found instead, and what to do.
pub fn open(wish: &str, layout: Option<Layout>) -> Result<Gamepad> {
    let wish = Wish::of(wish);
    let mut found = match &wish {
        Wish::At(path) => open_at(path).map_err(|error| cannot_open(path, &error))?,
        Wish::First | Wish::Named(_) => find(&wish)?,
    };
    match layout {
        Some(layout) => layout.require(&found.described)?,
        None => drop(Layout::of(&found.described).with_context(|| without_sticks(&found.described))?),
    }
    let (sender, events) = channel();
    let _ = sender.send(Event::Found(found.described.clone()));
    thread::spawn(move || while follow(&mut found, &sender, &wish) {});
    Ok(Gamepad::new(events, layout))
}

/// Reads a device until it is gone, and waits until it is back. False once nobody listens any more.
fn follow(open: &mut Open, sender: &Sender<Event>, wish: &Wish) -> bool {
    loop {
        match open.device.fetch_events() {
            Ok(events) => {
                for event in events.filter_map(|event| told(&event.destructure())) {
                    if sender.send(event).is_err() {
                        return false;
                    }
                }
            }
            Err(error) if error.kind() == ErrorKind::Interrupted => {}
            Err(_) => break,
        }
    }
    if sender.send(Event::Gone).is_err() {
        return false;
    }
    *open = loop {
        thread::sleep(LOOK_EVERY);
        if let Some(back) = again(wish, &open.described.name) {
            break back;
        }
    };
    sender.send(Event::Found(open.described.clone())).is_ok()
}

fn told(event: &EventSummary) -> Option<Event> {
    match *event {
        EventSummary::AbsoluteAxis(_, AbsoluteAxisCode(code), value) => Some(Event::Moved { code, value }),
        // 2 is a repetition, as of a key that is held.
        EventSummary::Key(_, KeyCode(code), value @ (0 | 1)) => Some(Event::Button { code, down: value == 1 }),
        _ => None,
    }
}

/// The device that was there before, by its name: the kernel may number it anew, and give its number to another.
fn again(wish: &Wish, name: &str) -> Option<Open> {
    let first = if let Wish::At(path) = wish { Some(path.clone()) } else { None };
    let mut devices = first.into_iter().chain(paths()).filter_map(|path| open_at(&path).ok());
    devices.find(|open| open.described.name == name)
}

/// The devices of the kernel, in its order.
fn paths() -> Vec<PathBuf> {
    let entries = std::fs::read_dir(FOLDER).into_iter().flatten().flatten();
    let number = |path: &Path| path.file_name()?.to_str()?.strip_prefix("event")?.parse::<u32>().ok();
    let mut found: Vec<(u32, PathBuf)> =
        entries.filter_map(|entry| Some((number(&entry.path())?, entry.path()))).collect();
    found.sort();
    found.into_iter().map(|(_, path)| path).collect()
}

/// The first device that is meant. A gamepad may have motion sensors with the same name, which are none.
fn find(wish: &Wish) -> Result<Open> {
    let (mut second_best, mut others, mut unreadable) = (None, Vec::new(), 0);
    for path in paths() {
        let Ok(open) = open_at(&path) else {
            unreadable += 1;
            continue;
        };
        let is_named = wish.has_named(&open.described.name);
        if is_named && is_joystick(&open.device) && (*wish != Wish::First || Layout::of(&open.described).is_some()) {
            return Ok(open);
        }
        others.push(open.described.name.clone());
        if is_named && *wish != Wish::First {
            second_best = second_best.or(Some(open));
        }
    }
    second_best.ok_or_else(|| anyhow!(nothing_found(wish, &others, unreadable)))
}

/// A device's motion sensors have axes too, but no buttons of a joystick.
fn is_joystick(device: &evdev::Device) -> bool {
    let has_button = device.supported_keys().is_some_and(|keys| keys.iter().any(|key| BUTTONS.contains(&key.code())));
    has_button && !device.properties().contains(PropType::ACCELEROMETER)
}

fn open_at(path: &Path) -> std::io::Result<Open> {
    let device = evdev::Device::open(path)?;
    let mut axes = Vec::new();
    // The kernel tells of none where there are none.
    if device.supported_events().contains(EventType::ABSOLUTE) {
        axes.extend(device.get_absinfo()?.map(|(AbsoluteAxisCode(code), info)| Axis {
            code,
            min: info.minimum(),
            max: info.maximum(),
            flat: info.flat(),
            value: info.value(),
        }));
    }
    let described = Device {
        name: device.name().unwrap_or("without a name").to_owned(),
        axes,
        pad_buttons: device.supported_keys().is_some_and(|keys| keys.contains(PAD_BUTTON)),
        left_is_north: device.input_id().vendor() == MICROSOFT || driver(path).as_deref() == Some("xpad"),
    };
    Ok(Open { device, described })
}

/// The kernel's driver of a device, if that can be told.
fn driver(path: &Path) -> Option<String> {
    let path = path.canonicalize().ok()?;
    let link = Path::new("/sys/class/input").join(path.file_name()?).join("device/device/driver");
    Some(std::fs::read_link(link).ok()?.file_name()?.to_str()?.to_owned())
}

fn cannot_open(path: &Path, error: &std::io::Error) -> anyhow::Error {
    let path = path.display();
    match error.kind() {
        ErrorKind::NotFound => anyhow!("--joystick {path} is not there: leave it out for the first one with sticks"),
        ErrorKind::PermissionDenied => anyhow!(
            "--joystick {path} may not be read: join its group (sudo usermod -aG input $USER), and log in again"
        ),
        _ => anyhow!("--joystick {path} is no input device: use one of {FOLDER}/event*"),
    }
}

fn without_sticks(device: &Device) -> String {
    let axes = if device.axes.is_empty() { "none".to_owned() } else { device.axis_names() };
    format!(
        "--joystick: which axes of `{}` are its sticks is not known: say so by --joystick-axes ROLL,PITCH,YAW,THROTTLE; \
         it has {axes}",
        device.name
    )
}

/// That no device is the one that is meant, what there is instead, and what to do.
fn nothing_found(wish: &Wish, others: &[String], unreadable: usize) -> String {
    let what = match wish {
        Wish::Named(name) => format!("no device in {FOLDER} has `{name}` in its name"),
        Wish::First | Wish::At(_) => format!("no device in {FOLDER} has sticks"),
    };
    let names: Vec<String> = others.iter().map(|name| format!("`{name}`")).collect();
    let there = if names.is_empty() { String::new() } else { format!(", there are {}", names.join(", ")) };
    let hidden = match unreadable {
        0 => String::new(),
        count => format!(", {} may not be read (group `input`)", counted(count, "other")),
    };
    format!("--joystick: {what}{there}{hidden}: plug one in, or fly by --keys")
}

#[cfg(test)]
#[path = "device_tests.rs"]
mod tests;

//! Which axis of a device is which stick, and what its numbers mean.

use core::str::FromStr;

use anyhow::{Result, anyhow, ensure};

use super::Sticks;
use crate::refusal::did_you_mean;

/// The axes that have names, by Linux's numbers (`ABS_X` is 0).
const NAMES: [(&str, u16); 13] = [
    ("x", X),
    ("y", Y),
    ("z", Z),
    ("rx", RX),
    ("ry", RY),
    ("rz", RZ),
    ("throttle", THROTTLE),
    ("rudder", RUDDER),
    ("wheel", 8),
    ("gas", 9),
    ("brake", 10),
    ("hat0x", 16),
    ("hat0y", 17),
];
const X: u16 = 0;
const Y: u16 = 1;
const Z: u16 = 2;
const RX: u16 = 3;
const RY: u16 = 4;
const RZ: u16 = 5;
const THROTTLE: u16 = 6;
const RUDDER: u16 = 7;
/// Linux has no more axes.
const AXES: u16 = 64;

/// An axis of a device, as the kernel describes it, and where it is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Axis {
    /// Linux's number.
    pub code: u16,
    /// The least value.
    pub min: i32,
    /// The greatest.
    pub max: i32,
    /// Values this near to the middle are the middle.
    pub flat: i32,
    /// Where it is.
    pub value: i32,
}

impl Axis {
    /// −1 at the least value, 0 in the middle, 1 at the greatest.
    fn deflection(&self) -> f64 {
        let (min, max, flat) = (f64::from(self.min), f64::from(self.max), f64::from(self.flat.max(0)));
        let half = f64::midpoint(max, -min);
        // No device has an axis without a range, but a broken one may say so.
        if half <= flat {
            return 0.0;
        }
        let off = f64::from(self.value) - f64::midpoint(min, max);
        let beyond = (off.abs() - flat).max(0.0) / (half - flat);
        beyond.min(1.0).copysign(off)
    }
}

/// An axis that moves a stick.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Use {
    code: u16,
    /// Whether its greatest value is left, back or down.
    reversed: bool,
}

impl Use {
    const fn of(code: u16) -> Self {
        Self { code, reversed: false }
    }
}

/// Which axes are the sticks: roll, pitch, yaw, throttle.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Layout([Use; 4]);

/// The sticks in the order in which a layout names their axes.
const STICKS: [&str; 4] = ["roll", "pitch", "yaw", "throttle"];

impl Layout {
    const fn new(roll: u16, pitch: u16, yaw: u16, throttle: u16) -> Self {
        Self([Use::of(roll), Use::of(pitch), Use::of(yaw), Use::of(throttle)])
    }

    /// The same, with a greatest value that is back and one that is down.
    const fn up_is_least(self) -> Self {
        let Self([roll, pitch, yaw, throttle]) = self;
        Self([roll, Use { reversed: true, ..pitch }, yaw, Use { reversed: true, ..throttle }])
    }

    /// What a device is taken for by its axes; `None` if it does not look like anything that is flown with.
    pub fn of(device: &Device) -> Option<Self> {
        let has = |codes: &[u16]| codes.iter().all(|code| device.axis(*code).is_some());
        if device.is_gamepad() {
            // Mode 2. Up is the least value.
            let (right_x, right_y) = if has(&[RX, RY]) { (RX, RY) } else { (Z, RZ) };
            return has(&[X, Y, right_x, right_y]).then(|| Self::new(right_x, right_y, X, Y).up_is_least());
        }
        // A radio's channels, in the order of most: aileron, elevator, throttle, rudder.
        if has(&[X, Y, Z, RX]) {
            return Some(Self::new(X, Y, RX, Z));
        }
        // Joysticks: pushed forward is the least value, and so is a lever.
        let yaw = [RUDDER, RZ].into_iter().find(|code| has(&[*code]))?;
        let throttle = [THROTTLE, Z].into_iter().find(|code| has(&[*code]))?;
        has(&[X, Y]).then(|| Self::new(X, Y, yaw, throttle).up_is_least())
    }

    /// Refuses a device that has not all of these axes.
    ///
    /// # Errors
    /// One line with the first axis that is missing, and those that there are.
    pub fn require(&self, device: &Device) -> Result<()> {
        for (used, stick) in self.0.iter().zip(STICKS) {
            ensure!(
                device.axis(used.code).is_some(),
                "--joystick-axes: `{}` has no axis {} for {stick}: it has {}",
                device.name,
                name(used.code),
                device.axis_names()
            );
        }
        Ok(())
    }

    /// Where the sticks are.
    pub fn sticks(&self, device: &Device) -> Sticks {
        let [roll, pitch, yaw, throttle] = self.0.map(|used| {
            let deflection = device.axis(used.code).map_or(0.0, Axis::deflection);
            if used.reversed { -deflection } else { deflection }
        });
        Sticks { roll, pitch, yaw, throttle }
    }
}

/// Roll, pitch, yaw and throttle, by commas: names or Linux's numbers, a dash before those to reverse.
impl FromStr for Layout {
    type Err = anyhow::Error;

    fn from_str(text: &str) -> Result<Self> {
        let axes: Vec<&str> = text.split(',').map(str::trim).collect();
        let Ok(axes) = <[&str; 4]>::try_from(axes) else {
            return Err(anyhow!("four axes are needed, roll, pitch, yaw and throttle: as rx,-ry,x,-y"));
        };
        let mut used = [Use::of(0); 4];
        for (used, axis) in used.iter_mut().zip(axes) {
            let (reversed, axis) = axis.strip_prefix('-').map_or((false, axis), |axis| (true, axis));
            *used = Use { code: code(axis)?, reversed };
        }
        for (number, one) in used.iter().enumerate() {
            ensure!(
                used[..number].iter().all(|other| other.code != one.code),
                "axis {} is named twice",
                name(one.code)
            );
        }
        Ok(Self(used))
    }
}

/// As `--joystick-axes` takes it.
impl core::fmt::Display for Layout {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        let text = self.0.map(|used| format!("{}{}", if used.reversed { "-" } else { "" }, name(used.code)));
        f.write_str(&text.join(","))
    }
}

fn code(text: &str) -> Result<u16> {
    if let Ok(number) = text.parse::<u16>() {
        ensure!(number < AXES, "there is no axis {number}: they go from 0 to {}", AXES - 1);
        return Ok(number);
    }
    let lower = text.to_lowercase();
    let named = lower.strip_prefix("abs_").unwrap_or(&lower);
    let known = NAMES.map(|(name, _)| name);
    let found = NAMES.iter().find(|(name, _)| *name == named);
    found.map(|(_, code)| *code).ok_or_else(|| anyhow!("unknown axis `{text}`: {}", did_you_mean(named, &known)))
}

/// The name of an axis, or its number.
fn name(code: u16) -> String {
    let named = NAMES.iter().find(|(_, known)| *known == code);
    named.map_or_else(|| code.to_string(), |(name, _)| (*name).to_owned())
}

/// A device, as far as it is flown with.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Device {
    /// What it calls itself.
    pub name: String,
    /// Its axes.
    pub axes: Vec<Axis>,
    /// Whether its buttons are those of a gamepad.
    pub pad_buttons: bool,
    /// Whether the button on the left, an Xbox's X, is told as the north one: the kernel's driver has it so.
    pub left_is_north: bool,
}

impl Device {
    /// Whether it is laid out as a gamepad. Radios may have a gamepad's buttons, which are switches there, but they have a
    /// slider too.
    pub fn is_gamepad(&self) -> bool {
        self.pad_buttons && self.axis(THROTTLE).is_none()
    }

    fn axis(&self, code: u16) -> Option<&Axis> {
        self.axes.iter().find(|axis| axis.code == code)
    }

    /// An axis was moved.
    pub fn put(&mut self, code: u16, value: i32) {
        if let Some(axis) = self.axes.iter_mut().find(|axis| axis.code == code) {
            axis.value = value;
        }
    }

    /// Its axes, as `--joystick-axes` takes them.
    pub fn axis_names(&self) -> String {
        self.axes.iter().map(|axis| name(axis.code)).collect::<Vec<_>>().join(", ")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A device with these axes, each from −100 to 100 and in the middle.
    fn device(codes: &[u16], pad_buttons: bool) -> Device {
        let axis = |code: &u16| Axis { code: *code, min: -100, max: 100, flat: 0, value: 0 };
        Device {
            name: "a device".to_owned(),
            axes: codes.iter().map(axis).collect(),
            pad_buttons,
            left_is_north: false,
        }
    }

    #[test]
    fn the_ends_of_an_axis_are_full_deflections_and_its_middle_is_none() {
        let at = |(min, max, flat), value| Axis { code: 0, min, max, flat, value }.deflection();
        let [byte, word, channel] = [(0, 255, 0), (-32_768, 32_767, 128), (0, 2_047, 0)];
        for range in [byte, word, channel, (-1, 1, 0), (i32::MIN, i32::MAX, 15)] {
            assert_eq!([at(range, range.0), at(range, range.1)], [-1.0, 1.0], "{range:?}");
        }
        assert_eq!([at(byte, 127), at(byte, 128)], [-1.0 / 255.0, 1.0 / 255.0], "between the two");
        assert_eq!([at(word, -100), at(word, 127)], [0.0, 0.0], "the device says that this is the middle");
        assert!((0.0..0.001).contains(&at(word, 140)), "no step where it begins");
        assert!((at((0, 100, 0), 75) - 0.5).abs() < 1e-12);
        assert_eq!(at((0, 100, 0), 1_000), 1.0, "beyond its range");
        assert_eq!(at((5, 5, 0), 5), 0.0, "no range");
        assert_eq!(at((0, 10, 9), 10), 0.0, "nothing but a middle");
    }

    #[test]
    fn a_device_is_taken_for_what_its_axes_look_like() {
        for (what, codes, pad_buttons, layout) in [
            ("an Xbox gamepad", &[X, Y, Z, RX, RY, RZ, 16, 17][..], true, Some("rx,-ry,x,-y")),
            ("a plain gamepad", &[X, Y, Z, RZ, 16, 17], true, Some("z,-rz,x,-y")),
            ("a radio as a gamepad", &[X, Y, Z, RX, RY, RZ, THROTTLE], true, Some("x,y,rx,z")),
            ("a radio as a joystick", &[X, Y, Z, RX, RY, RZ, THROTTLE, RUDDER], false, Some("x,y,rx,z")),
            ("a stick with twist and lever", &[X, Y, RZ, THROTTLE, 16, 17], false, Some("x,-y,rz,-throttle")),
            ("a stick with pedals", &[X, Y, THROTTLE, RUDDER], false, Some("x,-y,rudder,-throttle")),
            ("a touchpad", &[X, Y, 47, 53, 54], false, None),
            ("half a gamepad", &[X, Y], true, None),
            ("nothing", &[], false, None),
        ] {
            let found = Layout::of(&device(codes, pad_buttons)).map(|layout| layout.to_string());
            assert_eq!(found.as_deref(), layout, "{what}");
        }
    }

    #[test]
    fn sticks_are_what_a_pilot_of_mode_2_means() {
        let mut pad = device(&[X, Y, RX, RY], true);
        let layout = Layout::of(&pad).expect("a gamepad");
        assert_eq!(layout.sticks(&pad), Sticks::default());
        // Left stick up and to the left, right stick down and to the right.
        for (code, value) in [(Y, -100), (X, -50), (RY, 20), (RX, 100), (63, 1)] {
            pad.put(code, value);
        }
        assert_eq!(layout.sticks(&pad), Sticks { roll: 1.0, pitch: -0.2, yaw: -0.5, throttle: 1.0 });
        let turned: Layout = "-rx,ry,-x,y".parse().expect("a layout");
        assert_eq!(turned.sticks(&pad), Sticks { roll: -1.0, pitch: 0.2, yaw: 0.5, throttle: -1.0 });
    }

    #[test]
    fn axes_have_names_and_numbers_and_read_back() {
        for (text, shown) in [
            ("rx,-ry,x,-y", "rx,-ry,x,-y"),
            (" 0 , -1 , RZ , -ABS_THROTTLE ", "x,-y,rz,-throttle"),
            ("40,1,2,63", "40,y,z,63"),
        ] {
            let layout: Layout = text.parse().expect(text);
            assert_eq!(layout.to_string(), shown);
            assert_eq!(shown.parse::<Layout>().expect(shown), layout);
        }
    }

    #[test]
    fn what_is_no_layout_is_refused_with_a_remedy() {
        let refused = |text: &str| text.parse::<Layout>().expect_err(text).to_string();
        assert!(refused("x,y").ends_with("as rx,-ry,x,-y"));
        assert_eq!(refused("x,y,z,ruder"), "unknown axis `ruder`: did you mean `rudder`?");
        assert_eq!(refused("x,y,z,64"), "there is no axis 64: they go from 0 to 63");
        assert_eq!(refused("x,y,z,-0"), "axis x is named twice");
        let layout: Layout = "x,y,z,rx".parse().expect("a layout");
        let text = layout.require(&device(&[X, Y, Z], false)).expect_err("one is missing").to_string();
        assert_eq!(text, "--joystick-axes: `a device` has no axis rx for throttle: it has x, y, z");
    }
}

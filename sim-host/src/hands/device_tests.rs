use std::time::Instant;

use evdev::uinput::VirtualDevice;
use evdev::{AbsInfo, AbsoluteAxisEvent, AttributeSet, BusType, InputId, KeyEvent, UinputAbsSetup};

use super::super::{Act, Hands, Order, Selected, Sticks};
use super::*;
use crate::console::Tone;

/// The longest that anything may take before the test calls it a hang.
const HANG: Duration = Duration::from_secs(20);

/// A gamepad that this process pretends to have.
fn pad(name: &str) -> std::io::Result<VirtualDevice> {
    let keys: AttributeSet<KeyCode> = [KeyCode::BTN_SOUTH, KeyCode::BTN_NORTH, KeyCode::BTN_WEST].into_iter().collect();
    let id = InputId::new(BusType::BUS_USB, MICROSOFT, 0x028e, 1);
    let mut builder = VirtualDevice::builder()?.name(name).input_id(id).with_keys(&keys)?;
    for axis in [AbsoluteAxisCode::ABS_X, AbsoluteAxisCode::ABS_Y, AbsoluteAxisCode::ABS_RX, AbsoluteAxisCode::ABS_RY] {
        builder = builder.with_absolute_axis(&UinputAbsSetup::new(axis, AbsInfo::new(0, -1000, 1000, 0, 0, 0)))?;
    }
    builder.build()
}

/// Its motion sensors: they have the same name in theirs, and no buttons.
fn motion_sensors(name: &str) -> std::io::Result<VirtualDevice> {
    let mut builder = VirtualDevice::builder()?.name(name);
    for axis in [AbsoluteAxisCode::ABS_X, AbsoluteAxisCode::ABS_Y, AbsoluteAxisCode::ABS_Z, AbsoluteAxisCode::ABS_RX] {
        builder = builder.with_absolute_axis(&UinputAbsSetup::new(axis, AbsInfo::new(7, -1000, 1000, 0, 0, 0)))?;
    }
    builder.build()
}

/// What the hands do, until a condition holds.
fn until(hands: &mut Gamepad, condition: impl Fn(&Gamepad, &[Act]) -> bool) -> Vec<Act> {
    let (start, mut acts) = (Instant::now(), Vec::new());
    while !condition(hands, &acts) {
        assert!(start.elapsed() < HANG, "it hangs at {:?}, after {acts:?}", hands.sticks());
        acts.extend(hands.poll(Instant::now()));
        thread::sleep(Duration::from_millis(1));
    }
    acts
}

#[test]
fn a_device_of_the_kernel_is_found_read_lost_and_found_again() {
    let name = format!("Glissade test pad {}", std::process::id());
    let (_sensors, mut device) =
        match motion_sensors(&format!("{name} motion")).and_then(|sensors| Ok((sensors, pad(&name)?))) {
            Ok(devices) => devices,
            Err(error) => {
                #[expect(clippy::print_stderr, reason = "who runs the tests is to know what was not tested")]
                {
                    eprintln!("left out: no device can be made by /dev/uinput: {error}");
                }
                return;
            }
        };
    let mut hands = open(&name.to_uppercase(), None).expect("it is there");
    until(&mut hands, |hands, _| hands.sticks() == Some(Sticks::default()));
    let moved = [(AbsoluteAxisCode::ABS_RX, 1000), (AbsoluteAxisCode::ABS_Y, -500)];
    device.emit(&moved.map(|(axis, value)| *AbsoluteAxisEvent::new(axis, value))).expect("moved");
    let there = Sticks { roll: 1.0, throttle: 0.5, ..Sticks::default() };
    until(&mut hands, |hands, _| hands.sticks() == Some(there));
    let pressed = [KeyCode::BTN_SOUTH, KeyCode::BTN_NORTH].map(|key| *KeyEvent::new(key, 1));
    device.emit(&pressed).expect("pressed");
    let acts = until(&mut hands, |_, acts| acts.len() == 2);
    assert_eq!(acts, [Act::Order(Order::ArmOrDisarm), Act::Order(Order::Select(Selected::Position))], "Xbox's X");
    drop(device);
    let acts = until(&mut hands, |hands, _| hands.sticks().is_none());
    assert!(matches!(acts.as_slice(), [Act::Say(Tone::Alarm, _)]), "{acts:?}");
    let _again = pad(&name).expect("as before");
    let acts = until(&mut hands, |hands, _| hands.sticks() == Some(Sticks::default()));
    assert_eq!(acts, [Act::Say(Tone::Good, format!("joystick `{name}` is back"))]);
}

#[test]
fn what_is_not_there_is_told_with_what_is() {
    let told = |wish, others: &[&str], unreadable| {
        nothing_found(&Wish::of(wish), &others.iter().map(|name| (*name).to_owned()).collect::<Vec<_>>(), unreadable)
    };
    let remedy = "plug one in, or fly by --keys";
    assert_eq!(told("", &[], 0), format!("--joystick: no device in /dev/input has sticks: {remedy}"));
    assert_eq!(
        told("Xbox", &["Mouse", "Power Button"], 1),
        format!(
            "--joystick: no device in /dev/input has `xbox` in its name, there are `Mouse`, `Power Button`, 1 other may \
             not be read (group `input`): {remedy}"
        )
    );
}

#[test]
fn a_path_that_is_no_device_is_refused() {
    for (path, expected) in [
        (
            "/dev/input/event99999",
            "--joystick /dev/input/event99999 is not there: leave it out for the first one with sticks",
        ),
        ("/dev/null", "--joystick /dev/null is no input device: use one of /dev/input/event*"),
    ] {
        let error = open(path, None).expect_err(path).to_string();
        assert_eq!(error, expected);
    }
}

#[test]
fn axes_that_mean_nothing_here_are_listed() {
    let axis = |code| Axis { code, min: 0, max: 255, flat: 0, value: 0 };
    let name = "Odd".to_owned();
    let device = Device { name, axes: vec![axis(2), axis(40)], pad_buttons: false, left_is_north: false };
    let text = without_sticks(&device);
    assert!(text.contains("`Odd`") && text.contains("--joystick-axes") && text.ends_with("it has z, 40"), "{text}");
}

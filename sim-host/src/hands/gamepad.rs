//! A gamepad, or a radio on USB: from what the kernel tells of it to sticks and orders.

use std::sync::mpsc::Receiver;
use std::time::Instant;

use super::axes::{Device, Layout};
use super::{Act, Hands, Order, Selected, Sticks};
use crate::console::Tone;
use crate::console::keyboard::Key;

/// What the kernel tells of a device.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Event {
    /// It is there, as it stands.
    Found(Device),
    /// An axis was moved.
    Moved {
        /// Linux's number.
        code: u16,
        /// Where it is.
        value: i32,
    },
    /// A button was pressed or let go.
    Button {
        /// Linux's number.
        code: u16,
        /// Whether it is down.
        down: bool,
    },
    /// It is gone.
    Gone,
}

// Linux's numbers of a gamepad's buttons, by where they are.
const SOUTH: u16 = 0x130;
const NORTH: u16 = 0x133;
const WEST: u16 = 0x134;
const EAST: u16 = 0x131;
const LEFT_SHOULDER: u16 = 0x136;
const RIGHT_SHOULDER: u16 = 0x137;
const SELECT: u16 = 0x13a;
const START: u16 = 0x13b;

/// Hands on a gamepad.
#[derive(Debug)]
pub struct Gamepad {
    events: Receiver<Event>,
    /// The axes that were asked for.
    wish: Option<Layout>,
    /// The device and what its axes mean, while it is there.
    held: Option<(Device, Layout)>,
    /// Its name, once it was there.
    name: Option<String>,
    select: bool,
    start: bool,
}

impl Gamepad {
    /// Of the device that `events` tell of, with these axes, or those that it seems to have.
    pub fn new(events: Receiver<Event>, wish: Option<Layout>) -> Self {
        Self { events, wish, held: None, name: None, select: false, start: false }
    }

    fn take(&mut self, event: Event) -> Option<Act> {
        match event {
            Event::Found(device) => return Some(self.found(device)),
            Event::Gone => return self.gone(),
            Event::Moved { code, value } => {
                if let Some((device, _)) = &mut self.held {
                    device.put(code, value);
                }
            }
            Event::Button { code, down } => return self.button(code, down).map(Act::Order),
        }
        None
    }

    fn found(&mut self, device: Device) -> Act {
        (self.select, self.start) = (false, false);
        let Some(layout) = self.wish.or_else(|| Layout::of(&device)) else {
            return Act::Say(Tone::Refused, format!("joystick `{}` has no sticks that are known", device.name));
        };
        let text = match self.name.replace(device.name.clone()) {
            Some(name) => format!("joystick `{name}` is back"),
            None => format!("joystick `{}`: roll, pitch, yaw and throttle are its axes {layout}", device.name),
        };
        self.held = Some((device, layout));
        Act::Say(Tone::Good, text)
    }

    /// An axis that is no longer told of stays nowhere: the vehicle is to know that there are no sticks.
    fn gone(&mut self) -> Option<Act> {
        let (device, _) = self.held.take()?;
        let text = format!("joystick `{}` is gone: no sticks until it is plugged in again", device.name);
        Some(Act::Say(Tone::Alarm, text))
    }

    /// What a gamepad's button asks when it is pressed. A radio's are switches, which may be on from the start.
    fn button(&mut self, code: u16, down: bool) -> Option<Order> {
        let (device, _) = self.held.as_ref().filter(|(device, _)| device.is_gamepad())?;
        let (north, west) = if device.left_is_north { (WEST, NORTH) } else { (NORTH, WEST) };
        match code {
            SELECT => self.select = down,
            START => self.start = down,
            _ => {}
        }
        if !down {
            return None;
        }
        match code {
            SELECT | START => (self.select && self.start).then_some(Order::Kill),
            SOUTH => Some(Order::ArmOrDisarm),
            EAST => Some(Order::Select(Selected::Stabilized)),
            LEFT_SHOULDER => Some(Order::Select(Selected::Hold)),
            RIGHT_SHOULDER => Some(Order::Select(Selected::Return)),
            _ if code == west => Some(Order::Select(Selected::Position)),
            _ if code == north => Some(Order::Select(Selected::Altitude)),
            _ => None,
        }
    }
}

impl Hands for Gamepad {
    fn press(&mut self, _: Key, _: Instant) {}

    fn poll(&mut self, _: Instant) -> Vec<Act> {
        let mut acts = Vec::new();
        while let Ok(event) = self.events.try_recv() {
            acts.extend(self.take(event));
        }
        acts
    }

    fn sticks(&self) -> Option<Sticks> {
        self.held.as_ref().map(|(device, layout)| layout.sticks(device))
    }
}

#[cfg(test)]
mod tests {
    use std::sync::mpsc::{Sender, channel};

    use super::super::axes::Axis;
    use super::*;

    /// A gamepad with two sticks, each axis from 0 to 200 and in the middle.
    fn device(codes: [u16; 4]) -> Device {
        let axes = codes.map(|code| Axis { code, min: 0, max: 200, flat: 0, value: 100 }).to_vec();
        Device { name: "pad".to_owned(), axes, pad_buttons: true, left_is_north: false }
    }

    fn plugged(device: Device) -> (Gamepad, Sender<Event>) {
        let (sender, events) = channel();
        sender.send(Event::Found(device)).expect("it listens");
        (Gamepad::new(events, None), sender)
    }

    fn poll(pad: &mut Gamepad) -> Vec<Act> {
        pad.poll(Instant::now())
    }

    /// What comes of buttons that are pressed and let go, one after another.
    fn orders(pad: &mut Gamepad, sender: &Sender<Event>, buttons: &[(u16, bool)]) -> Vec<Order> {
        poll(pad);
        for (code, down) in buttons {
            sender.send(Event::Button { code: *code, down: *down }).expect("it listens");
        }
        let order = |act| if let Act::Order(order) = act { order } else { panic!("{act:?}") };
        poll(pad).into_iter().map(order).collect()
    }

    #[test]
    fn sticks_are_where_the_axes_are_from_the_first_moment_on() {
        let (mut pad, sender) = plugged(device([0, 1, 3, 4]));
        assert_eq!(pad.sticks(), None, "nothing is known yet");
        poll(&mut pad);
        assert_eq!(pad.sticks(), Some(Sticks::default()));
        for (code, value) in [(1, 0), (3, 150), (9, 7)] {
            sender.send(Event::Moved { code, value }).expect("it listens");
        }
        assert_eq!(poll(&mut pad), []);
        assert_eq!(pad.sticks(), Some(Sticks { roll: 0.5, throttle: 1.0, ..Sticks::default() }));
    }

    #[test]
    fn a_device_that_is_gone_has_no_sticks_until_it_is_back() {
        let (mut pad, sender) = plugged(device([0, 1, 3, 4]));
        let found = "joystick `pad`: roll, pitch, yaw and throttle are its axes rx,-ry,x,-y".to_owned();
        assert_eq!(poll(&mut pad), [Act::Say(Tone::Good, found)]);
        sender.send(Event::Moved { code: 3, value: 200 }).expect("it listens");
        sender.send(Event::Gone).expect("it listens");
        let gone = "joystick `pad` is gone: no sticks until it is plugged in again".to_owned();
        assert_eq!(poll(&mut pad), [Act::Say(Tone::Alarm, gone)]);
        assert_eq!(pad.sticks(), None);
        sender.send(Event::Button { code: SOUTH, down: true }).expect("it listens");
        assert_eq!(poll(&mut pad), [], "nobody is there to press it");
        sender.send(Event::Found(device([0, 1, 3, 4]))).expect("it listens");
        assert_eq!(poll(&mut pad), [Act::Say(Tone::Good, "joystick `pad` is back".to_owned())]);
        assert_eq!(pad.sticks(), Some(Sticks::default()), "as it stands now");
        drop(sender);
        assert_eq!(poll(&mut pad), []);
    }

    #[test]
    fn buttons_ask_when_they_are_pressed() {
        let (mut pad, sender) = plugged(device([0, 1, 3, 4]));
        for (code, order) in [
            (SOUTH, Order::ArmOrDisarm),
            (WEST, Order::Select(Selected::Position)),
            (NORTH, Order::Select(Selected::Altitude)),
            (EAST, Order::Select(Selected::Stabilized)),
            (LEFT_SHOULDER, Order::Select(Selected::Hold)),
            (RIGHT_SHOULDER, Order::Select(Selected::Return)),
        ] {
            assert_eq!(orders(&mut pad, &sender, &[(code, true), (code, false)]), [order]);
        }
        assert_eq!(orders(&mut pad, &sender, &[(0x13d, true), (0x13d, false)]), [], "a button that means nothing");
    }

    #[test]
    fn select_and_start_together_kill_whichever_comes_first() {
        let (mut pad, sender) = plugged(device([0, 1, 3, 4]));
        for [first, second] in [[SELECT, START], [START, SELECT]] {
            assert_eq!(
                orders(&mut pad, &sender, &[(first, true), (first, false), (second, true), (second, false)]),
                []
            );
            let together = [(first, true), (second, true), (second, false), (first, false)];
            assert_eq!(orders(&mut pad, &sender, &together), [Order::Kill]);
        }
        // Unplugged while one was held: that one does not count any more.
        assert_eq!(orders(&mut pad, &sender, &[(SELECT, true)]), []);
        sender.send(Event::Gone).expect("it listens");
        sender.send(Event::Found(device([0, 1, 3, 4]))).expect("it listens");
        assert_eq!(orders(&mut pad, &sender, &[(START, true)]), []);
    }

    #[test]
    fn an_xbox_has_its_x_on_the_left() {
        let (mut pad, sender) = plugged(Device { left_is_north: true, ..device([0, 1, 3, 4]) });
        let pressed = orders(&mut pad, &sender, &[(NORTH, true), (WEST, true)]);
        assert_eq!(pressed, [Order::Select(Selected::Position), Order::Select(Selected::Altitude)]);
    }

    #[test]
    fn the_switches_of_a_radio_ask_nothing() {
        let axes = [0, 1, 2, 3, 4, 5, 6].map(|code| Axis { code, min: 0, max: 2_047, flat: 0, value: 1_024 }).to_vec();
        let (mut pad, sender) = plugged(Device { axes, ..device([0; 4]) });
        assert_eq!(orders(&mut pad, &sender, &[(SOUTH, true), (SELECT, true), (START, true)]), []);
        assert!(pad.sticks().is_some());
    }

    #[test]
    fn axes_that_were_asked_for_win() {
        let (sender, events) = channel();
        sender.send(Event::Found(device([0, 1, 3, 4]))).expect("it listens");
        let mut pad = Gamepad::new(events, Some("-x,y,rx,ry".parse().expect("a layout")));
        sender.send(Event::Moved { code: 0, value: 0 }).expect("it listens");
        poll(&mut pad);
        assert_eq!(pad.sticks(), Some(Sticks { roll: 1.0, ..Sticks::default() }));
    }
}

//! A link full of junk at line rate: nothing of it is carried out, commands between it are answered, and the other link
//! does not notice.

mod junk;

use std::collections::VecDeque;

use firmware::autopilot::Autopilot;
use firmware::config::{FlightConfig, Start};
use firmware::failure::{Injectable, Manner, Unit};
use firmware::guidance::Trajectory;
use firmware::mavlink::port::Profile;
use firmware::signals::{NavState, SensorFrame, Tick};
use nalgebra::Vector3;

use self::junk::{Junk, harmless};
use crate::vehicle::{Body, config};

/// 921,600 baud, bytes a tick.
const LINE: usize = 92;
/// Between two commands, ticks.
const COMMAND_EVERY: Tick = 250;
/// A ground station that has no answer asks again, and by when it has to have one, ticks.
const ASK_AGAIN: Tick = 150;
const ANSWERED_WITHIN: Tick = 500;

/// A ground station: what it waits for, and what it has received.
#[derive(Default)]
struct Station {
    received: Vec<u8>,
    /// How much of that has been read.
    read: usize,
    sequence: Option<u8>,
    /// The command that waits for its acknowledgement, when it was first sent, and how often.
    waits: Option<(u16, Vec<u8>, Tick, u32)>,
    answered: u32,
    repeated: u32,
}

impl Station {
    /// The command to be sent now.
    fn ask(&mut self, tick: Tick) -> Option<Vec<u8>> {
        if let Some((number, frame, since, times)) = &mut self.waits {
            assert!(tick - *since < ANSWERED_WITHIN, "command {number} of {since} is not answered at {tick}");
            if tick - *since < ASK_AGAIN * *times {
                return None;
            }
            *times += 1;
            self.repeated += 1;
            return Some(frame.clone());
        }
        if !tick.is_multiple_of(COMMAND_EVERY) {
            return None;
        }
        // A message, one that there is not, and a question to the commander: disarming in the air is refused, on the
        // ground it changes nothing.
        let (number, param1) = [(512, 148.0), (31_013, 0.0), (400, 0.0)][(tick / COMMAND_EVERY) as usize % 3];
        let frame = harmless(number, param1);
        self.waits = Some((number, frame.clone(), tick, 1));
        Some(frame)
    }

    /// Reads whole frames: their numbers have no gap, and an acknowledgement ends the waiting.
    fn hear(&mut self, bytes: &[u8]) {
        self.received.extend_from_slice(bytes);
        while let [0xfd, length, _, _, sequence, _, _, id0, id1, id2, rest @ ..] = &self.received[self.read..]
            && rest.len() >= usize::from(*length) + 2
        {
            let expected = self.sequence.map_or(*sequence, |last| last.wrapping_add(1));
            assert_eq!(*sequence, expected, "a gap");
            self.sequence = Some(*sequence);
            let payload = &rest[..usize::from(*length)];
            if [*id0, *id1, *id2] == [77, 0, 0]
                && let Some((number, ..)) = &self.waits
                && payload[..2] == number.to_le_bytes()
            {
                self.waits = None;
                self.answered += 1;
            }
            self.read += usize::from(*length) + 12;
        }
    }
}

/// A vehicle with two links.
struct Vehicle {
    pilot: Autopilot,
    body: Body,
    busy: Station,
    quiet: Station,
    /// What the busy link's line still has to carry.
    line: VecDeque<u8>,
}

impl Vehicle {
    fn new(config: &FlightConfig) -> Self {
        let mut pilot = Autopilot::new(config).expect("valid");
        for number in [0, 1] {
            pilot.ports.get(number).expect("a link").open(Profile::Normal);
        }
        let all = Unit::ALL.iter().fold(Injectable::NONE, |all, unit| all.with(*unit, 4, &Manner::ALL));
        pilot.inner.allow_failures(all);
        let nav = NavState { position: config.start_position(), ..NavState::at_rest() };
        let body = Body { airframe: config.airframe, nav };
        Self { pilot, body, busy: Station::default(), quiet: Station::default(), line: VecDeque::new() }
    }

    fn tick(&mut self, tick: Tick, junk: Option<&mut Junk>) {
        let asked = self.busy.ask(tick);
        if let Some(junk) = junk {
            if let Some(frame) = &asked {
                while junk.completes(frame, 1) {
                    self.line.extend(junk.next());
                }
                junk.sent(frame);
            }
            self.line.extend(asked.iter().flatten());
            while self.line.len() < LINE {
                self.line.extend(junk.next());
            }
        } else {
            self.line.extend(asked.iter().flatten());
        }
        let bytes: Vec<u8> = self.line.drain(..self.line.len().min(LINE)).collect();
        let (busy, quiet) = (self.pilot.ports.get(0).expect("one"), self.pilot.ports.get(1).expect("two"));
        busy.receive(&bytes);
        if let Some(frame) = self.quiet.ask(tick) {
            quiet.receive(&frame);
        }
        let motors = self.pilot.tick(Some(&SensorFrame::Motion(self.body.nav))).motors;
        self.body.step(&motors);
        let mut into = [0; LINE];
        self.busy.hear(self.pilot.ports.get(0).expect("one").take(&mut into));
        self.quiet.hear(self.pilot.ports.get(1).expect("two").take(&mut into));
        assert!(self.pilot.inner.take_failures().is_empty(), "no failure is injected");
    }
}

/// Sends so many frames of junk to one of two equal vehicles: they fly the same, and its other link is the same.
fn flood(config: &FlightConfig, frames: u32, seed: u64) {
    let (mut flooded, mut calm) = (Vehicle::new(config), Vehicle::new(config));
    let settings = flooded.pilot.ground.settings().clone();
    let mut junk = Junk::new(seed);
    let mut tick = 0;
    while junk.frames < frames {
        flooded.tick(tick, Some(&mut junk));
        calm.tick(tick, None);
        let (one, other) = (&flooded.pilot.inner, &calm.pilot.inner);
        assert_eq!(one.inner_output(), other.inner_output(), "at {tick}");
        assert_eq!(one.outer_output(), other.outer_output(), "at {tick}");
        let (told, otherwise) = (one.commander_output(), other.commander_output());
        assert_eq!((told.armed, told.kills, told.home), (otherwise.armed, otherwise.kills, otherwise.home));
        assert_eq!((told.mode, told.intent, told.overridden), (otherwise.mode, otherwise.intent, otherwise.overridden));
        tick += 1;
    }
    assert_eq!(flooded.pilot.ground.settings(), &settings, "no setting is changed");
    assert!(flooded.quiet.received == calm.quiet.received, "the other link is the same, byte for byte");
    assert_eq!(flooded.quiet.repeated, 0);
    let lost = flooded.pilot.ports.first().received().lost();
    assert_eq!(lost, 0, "the vehicle reads as fast as the line sends");
    let Station { answered, repeated, .. } = flooded.busy;
    assert!(answered * 5 > tick / COMMAND_EVERY * 4, "{answered} commands answered in {tick} ms");
    // Only what a cut frame before it takes with it is lost.
    assert!(repeated * 4 < answered, "{repeated} of {answered} commands had to be repeated");
}

fn hovering() -> FlightConfig {
    let start = Vector3::new(0.0, 0.0, 5.0);
    FlightConfig {
        trajectory: Trajectory::Hold { position_m: start.into(), yaw_rad: 0.0 },
        start: Start::InFlight,
        start_position_m: start.into(),
        ..config()
    }
}

#[test]
fn a_million_frames_of_junk_change_nothing_in_flight() {
    flood(&hovering(), 1_000_000, 1);
}

#[test]
fn junk_changes_nothing_on_the_ground() {
    flood(&config(), 200_000, 2);
}

//! The ground partition, 100 Hz: MAVLink.
//!
//! Bytes in, bytes out; the board or the host only carries them. `parser` decodes received bytes, `command` executes
//! commands, `mode` encodes modes as PX4 does, `text` sends texts to pilots, `telemetry` schedules periodic messages,
//! `status` fills in the health messages, and `writer` encodes messages. Answers wait in a queue until they fit into a
//! job's bytes. NED/FRD is converted in `frames` only.
//!
//! ```
//! use firmware::autopilot::Autopilot;
//! use firmware::config::FlightConfig;
//! use firmware::signals::{NavState, SensorFrame};
//!
//! // `COMMAND_LONG` to system 1: request `AUTOPILOT_VERSION` (MAVLink 2 frames, from any MAVLink library).
//! use glissade_dialect::mavlink_core::{MAVLinkV2MessageRaw, MavHeader, MessageData};
//! use glissade_dialect::{AUTOPILOT_VERSION_DATA, COMMAND_ACK_DATA, COMMAND_LONG_DATA, MavCmd};
//! let request = COMMAND_LONG_DATA {
//!     command: MavCmd::MAV_CMD_REQUEST_MESSAGE as u16,
//!     param1: AUTOPILOT_VERSION_DATA::ID as f32,
//!     target_system: 1,
//!     ..COMMAND_LONG_DATA::DEFAULT
//! };
//! let mut frame = MAVLinkV2MessageRaw::new();
//! frame.serialize_message_data(MavHeader { system_id: 255, component_id: 190, sequence: 0 }, &request);
//!
//! let mut autopilot = Autopilot::new(&FlightConfig::default()).expect("valid");
//! autopilot.inner.receive(frame.raw_bytes());
//! let mut sent = Vec::new();
//! for _ in 0..100 {
//!     autopilot.tick(Some(&SensorFrame::Motion(NavState::at_rest())));
//!     sent.extend_from_slice(&autopilot.inner.take_transmit());
//! }
//! // Frames start with 0xfd, and carry the message's number in bytes 7 to 9.
//! let has = |id: u32| sent.windows(10).any(|w| w[0] == 0xfd && w[7..10] == id.to_le_bytes()[..3]);
//! assert!(has(COMMAND_ACK_DATA::ID) && has(AUTOPILOT_VERSION_DATA::ID));
//! ```

mod command;
mod mode;
mod parser;
mod status;
mod telemetry;
#[cfg(test)]
mod tests;
mod text;
mod writer;

use glissade_dialect::{MISSION_COUNT_DATA, MavResult, TIMESYNC_DATA};

use self::parser::{CommandMessage, Incoming, Parser, Sender};
use self::telemetry::{Report, Telemetry};
use self::writer::Writer;
use crate::commander::{Answers, Commands, Event, Events, Mode, Origin, Outcome, Refusal, Request};
use crate::estimator::status::Status;
use crate::failure::{Failures, Injectable};
use crate::signals::{NavState, TICK_US, Tick};

/// MAVLink system of this vehicle.
pub const SYSTEM_ID: u8 = 1;
/// MAVLink component: the autopilot.
pub const COMPONENT_ID: u8 = 1;

/// Bytes that can arrive between two jobs.
pub const RX_CAPACITY: usize = 512;
/// Bytes that one job can send.
pub const TX_CAPACITY: usize = 512;

/// Bytes received.
pub type RxBytes = heapless::Vec<u8, RX_CAPACITY>;
/// Bytes to send.
pub type TxBytes = heapless::Vec<u8, TX_CAPACITY>;

/// Rates of the two control loops over the last second, as a board measures them with an independent clock.
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

/// Health of the firmware itself.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Health {
    /// Whether sensor samples are arriving.
    pub nav_fresh: bool,
    /// Sensor samples refused since boot.
    pub refused_samples: u32,
    /// Received bytes that were dropped for lack of space, since boot.
    pub dropped_bytes: u32,
    /// Jobs of the outer, commander and ground partitions that overran since boot.
    pub overruns: [u32; 3],
    /// Rates of the loops, if the board measures them.
    pub timing: Option<LoopTiming>,
}

/// Snapshot for the ground partition.
#[derive(Clone, Debug, PartialEq)]
pub struct GroundInput {
    /// The motion at the release.
    pub nav: NavState,
    /// Whether the rotors may turn.
    pub armed: bool,
    /// The mode that pilots see.
    pub mode: Mode,
    /// Whether the vehicle is on the ground.
    pub landed: bool,
    /// Whether an arm request would be accepted.
    pub armable: bool,
    /// Health of the firmware itself.
    pub health: Health,
    /// The estimator's report; `None` on ideal state.
    pub estimator: Option<Status>,
    /// Failures that the board can inject.
    pub injectable: Injectable,
    /// Replies of the commander since the last job.
    pub replies: Answers,
    /// Failsafe events since the last job.
    pub events: Events,
    /// Bytes received since the last job.
    pub received: RxBytes,
}

/// Output of the ground partition.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct GroundOutput {
    /// For the ground station.
    pub transmit: TxBytes,
    /// For the commander.
    pub commands: Commands,
    /// Whether a ground station stops the rotors now. No entry of a queue: it is never lost, and acts first.
    pub kill: bool,
    /// Accepted failure injections, for the board.
    pub failures: Failures,
}

/// Greatest number of queued answers.
const OUTBOX_CAPACITY: usize = 16;
/// Bytes of a job that answers may take, so that many requests do not silence the telemetry.
const OUTBOX_SHARE: usize = TX_CAPACITY / 2;

/// A message to be sent once.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Outgoing {
    /// Acknowledgement of a command.
    Ack { command: u16, result: MavResult, to: Sender },
    /// Why a command was refused, as a text for the pilot.
    Refusal(Request, Refusal),
    /// A failsafe event, as a text for the pilot.
    Event(Event),
    /// A requested message.
    Report(Report),
    /// An empty mission list: missions are not supported, but ground stations wait for the answer.
    NoMission { mission_type: u8, to: Sender },
    /// Answer to a time request: the time at which it was read, and the time in it.
    Timesync { tc1: i64, ts1: i64, to: Sender },
}

/// The ground partition.
#[derive(Clone, Debug, Default)]
pub struct Ground {
    parser: Parser,
    telemetry: Telemetry,
    outbox: heapless::Deque<Outgoing, OUTBOX_CAPACITY>,
    sequence: u8,
}

impl Ground {
    /// One job, released at `released`.
    pub fn step(&mut self, released: Tick, input: &GroundInput) -> GroundOutput {
        let mut output = GroundOutput::default();
        self.parser.push(&input.received);
        while let Some((sender, message)) = self.parser.next() {
            self.handle(released, input, sender, message, &mut output);
        }
        for event in &input.events {
            self.post(Outgoing::Event(*event));
        }
        self.post_replies(&input.replies);
        self.transmit(released, input, &mut output.transmit);
        output
    }

    fn handle(&mut self, now: Tick, input: &GroundInput, sender: Sender, message: Incoming, output: &mut GroundOutput) {
        match message {
            Incoming::Command(command) => self.handle_command(now, input, sender, &command, output),
            Incoming::MissionRequestList { mission_type } => {
                self.post(Outgoing::NoMission { mission_type, to: sender });
            }
            Incoming::Timesync { ts1 } => {
                let tc1 = i64::from(now) * i64::from(TICK_US) * 1000;
                self.post(Outgoing::Timesync { tc1, ts1, to: sender });
            }
        }
    }

    fn handle_command(
        &mut self,
        now: Tick,
        input: &GroundInput,
        sender: Sender,
        message: &CommandMessage,
        output: &mut GroundOutput,
    ) {
        let answer = command::carry_out(message, sender, now, input, &mut self.telemetry, output);
        if let Some(answer) = answer {
            self.post(Outgoing::Ack { command: message.command, result: answer.result, to: sender });
            if let Some(report) = answer.report {
                self.post(Outgoing::Report(report));
            }
        }
    }

    fn post_replies(&mut self, replies: &Answers) {
        for reply in replies {
            let Origin::Station { sender, command } = reply.command.origin else { continue };
            let result = command::result_of(reply.outcome);
            self.post(Outgoing::Ack { command, result, to: sender });
            if let Outcome::TemporarilyRejected(refusal) = reply.outcome {
                self.post(Outgoing::Refusal(reply.command.request, refusal));
            }
        }
    }

    fn post(&mut self, outgoing: Outgoing) {
        // With a full queue the answer is lost; the sender repeats its request.
        let _ = self.outbox.push_back(outgoing);
    }

    fn transmit(&mut self, now: Tick, input: &GroundInput, bytes: &mut TxBytes) {
        let bad_checksums = self.parser.bad_checksums();
        let mut out = Writer::new(bytes, &mut self.sequence);
        out.set_limit(OUTBOX_SHARE);
        while let Some(next) = self.outbox.front() {
            if !write(next, now, input, bad_checksums, &mut out) {
                break;
            }
            self.outbox.pop_front();
        }
        out.set_limit(TX_CAPACITY);
        self.telemetry.send(now, input, bad_checksums, &mut out);
    }
}

/// Appends an answer; false, with nothing written, if it does not fit.
fn write(outgoing: &Outgoing, now: Tick, input: &GroundInput, bad_checksums: u32, out: &mut Writer) -> bool {
    match *outgoing {
        Outgoing::Ack { command, result, to } => command::write_ack(command, result, to, out),
        Outgoing::Refusal(request, refusal) => text::write_refusal(&request, refusal, out),
        Outgoing::Event(event) => text::write_event(event, out),
        Outgoing::Report(report) => telemetry::write(report, now, input, bad_checksums, out),
        Outgoing::NoMission { mission_type, to: (target_system, target_component) } => {
            out.write(&MISSION_COUNT_DATA { target_system, target_component, count: 0, mission_type })
        }
        Outgoing::Timesync { tc1, ts1, to: (target_system, target_component) } => {
            out.write(&TIMESYNC_DATA { tc1, ts1, target_system, target_component })
        }
    }
}

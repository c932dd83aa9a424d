//! What a link has still to say once: failures first, then acknowledgements, then other answers.
//!
//! Each kind has a queue of its own, so that none holds up another, and is written as long as less than its share of the
//! link's ring is waiting to be sent: on a slow line, answers leave room for acknowledgements, and periodic telemetry
//! for both.

use glissade_dialect::{COMMAND_ACK_DATA, MavResult, PING_DATA, TIMESYNC_DATA};
use heapless::Deque;

use super::incoming::{FileRequest, MissionRequest, Sender};
use super::port::SENT_CAPACITY;
use super::telemetry::{self, Report, View};
use super::writer::Writer;
use super::{services, text};
use crate::commander::{Event, Refusal};

/// Greatest number of bytes that may be waiting to be sent when an answer is added.
pub(super) const ANSWERS_SHARE: usize = SENT_CAPACITY / 2;
/// The same for periodic telemetry: a tenth of a second of a 57,600 baud radio.
pub(super) const TELEMETRY_SHARE: usize = SENT_CAPACITY / 4;

/// An acknowledgement of a command.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Ack {
    /// Number in `MAV_CMD`.
    pub(super) command: u16,
    /// Its result.
    pub(super) result: MavResult,
    /// The command's sender.
    pub(super) to: Sender,
}

/// Any other answer.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Answer {
    /// Why a command was refused, which is named, as a text for the pilot.
    Refusal(&'static str, Refusal),
    /// A requested message.
    Report(Report),
    /// To a message of the mission protocol.
    Mission { request: MissionRequest, mission_type: u8, to: Sender },
    /// To a request for files.
    File { request: FileRequest, to: Sender },
    /// There are no logs.
    NoLogs,
    /// There is no such serial console.
    NoSerial { device: u8 },
    /// There are no extended parameters.
    NoExtendedParams,
    /// To a time request: the time at which it was read, ns, and the time in it.
    Timesync { tc1: i64, ts1: i64, to: Sender },
    /// To a ping.
    Ping { time_usec: u64, seq: u32, to: Sender },
}

/// The queues.
#[derive(Clone, Debug, Default)]
pub(super) struct Outbox {
    events: Deque<Event, 8>,
    acks: Deque<Ack, 32>,
    answers: Deque<Answer, 32>,
}

impl Outbox {
    /// A failure, for the pilot. The newest is the most important: if there are too many, the oldest goes.
    pub(super) fn report(&mut self, event: Event) {
        if self.events.is_full() {
            self.events.pop_front();
        }
        let _ = self.events.push_back(event);
    }

    /// An acknowledgement. A link that asks for more than its line can carry loses what is beyond the queue; its peer
    /// repeats.
    pub(super) fn acknowledge(&mut self, command: u16, result: MavResult, to: Sender) {
        let _ = self.acks.push_back(Ack { command, result, to });
    }

    /// Any other answer; the same holds for it.
    pub(super) fn answer(&mut self, answer: Answer) {
        let _ = self.answers.push_back(answer);
    }

    /// Writes what fits.
    pub(super) fn send(&mut self, view: &View, out: &mut Writer) {
        out.set_limit(SENT_CAPACITY);
        send(&mut self.events, |event| text::write_event(*event, out));
        send(&mut self.acks, |ack| write_ack(*ack, out));
        out.set_limit(ANSWERS_SHARE);
        send(&mut self.answers, |answer| write_answer(answer, view, out));
    }
}

/// Writes the messages of a queue, the oldest first, up to one that does not fit.
fn send<T, const N: usize>(queue: &mut Deque<T, N>, mut write: impl FnMut(&T) -> bool) {
    while queue.front().is_some_and(&mut write) {
        queue.pop_front();
    }
}

fn write_ack(ack: Ack, out: &mut Writer) -> bool {
    let Ack { command, result, to: (target_system, target_component) } = ack;
    out.write(&COMMAND_ACK_DATA { command, result, target_system, target_component, ..COMMAND_ACK_DATA::DEFAULT })
}

fn write_answer(answer: &Answer, view: &View, out: &mut Writer) -> bool {
    match *answer {
        Answer::Refusal(request, refusal) => text::write_refusal(request, refusal, out),
        Answer::Report(report) => telemetry::write(report, view, out),
        Answer::Mission { request, mission_type, to } => services::write_mission(request, mission_type, to, out),
        Answer::File { request, to } => services::write_file(request, to, out),
        Answer::NoLogs => services::write_no_logs(out),
        Answer::NoSerial { device } => services::write_no_serial(device, out),
        Answer::NoExtendedParams => services::write_no_extended_params(out),
        Answer::Timesync { tc1, ts1, to: (target_system, target_component) } => {
            out.write(&TIMESYNC_DATA { tc1, ts1, target_system, target_component })
        }
        Answer::Ping { time_usec, seq, to: (target_system, target_component) } => {
            out.write(&PING_DATA { time_usec, seq, target_system, target_component })
        }
    }
}

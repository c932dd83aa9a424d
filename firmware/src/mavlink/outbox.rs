//! What a link has still to say once: failures first, then acknowledgements, then other answers.
//!
//! Each kind has a queue of its own, so that none holds up another, and is written as long as less than its share of the
//! link's ring is waiting to be sent: on a slow line, answers leave room for acknowledgements, and periodic telemetry
//! for both. How much telemetry may wait depends on what the [`Line`] is seen to carry.

use glissade_dialect::{COMMAND_ACK_DATA, HEARTBEAT_DATA, MavResult, PING_DATA, TIMESYNC_DATA};
use heapless::Deque;

use super::incoming::{ExtendedRequest, FileRequest, MissionRequest, Sender};
use super::port::SENT_CAPACITY;
use super::telemetry::{self, Report, View};
use super::writer::{Writer, frame_len};
use super::{services, text};
use crate::commander::Event;

/// Greatest number of bytes that may be waiting to be sent when an answer is added.
pub(super) const ANSWERS_SHARE: usize = SENT_CAPACITY / 2;
/// The same for periodic telemetry: a tenth of a second of a 57,600 baud radio.
pub(super) const TELEMETRY_SHARE: usize = SENT_CAPACITY / 4;
/// The same on a fast line, which carries that in 60 ms.
pub(super) const FAST_SHARE: usize = SENT_CAPACITY / 4 * 3;
/// A line is fast if it carries this many bytes from one job to the next: 25.6 kB/s.
const FAST: usize = 256;
/// Greatest number of bytes that may wait when an acknowledgement is added: a heartbeat still fits.
const ACKS_SHARE: usize = SENT_CAPACITY - frame_len::<HEARTBEAT_DATA>();

/// What a link's line is seen to carry.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Line {
    /// Bytes that waited when the last job had written.
    left: usize,
    fast: bool,
}

impl Line {
    /// Greatest number of bytes of telemetry that may wait now. `waiting` bytes were not sent by the job's release.
    pub(super) fn share(&mut self, waiting: usize) -> usize {
        // A line that has sent everything may carry more than there was; nothing is learned from that.
        if self.left.saturating_sub(waiting) >= FAST {
            self.fast = true;
        } else if waiting > 0 {
            self.fast = false;
        }
        if self.fast { FAST_SHARE } else { TELEMETRY_SHARE }
    }

    /// At the end of a job: `waiting` bytes are still to be sent.
    pub(super) fn leave(&mut self, waiting: usize) {
        self.left = waiting;
    }
}

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
    /// Why a command was refused, as a text for the pilot.
    Refusal { request: &'static str, reason: &'static str },
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
    /// To a request for extended parameters.
    ExtendedParams(ExtendedRequest),
    /// To a time request: the time at which it was read, ns, and the time in it.
    Timesync { tc1: i64, ts1: i64, to: Sender },
    /// To a ping.
    Ping { time_usec: u64, seq: u32, to: Sender },
}

/// The queues.
#[derive(Clone, Debug, Default)]
pub(super) struct Outbox {
    events: Deque<Event, 8>,
    acks: Deque<Ack, ACKS>,
    answers: Deque<Answer, 32>,
    /// Acknowledgements and answers that found their queue full, since the link was opened.
    lost: u32,
}

/// Acknowledgements that can wait: more than the commands with parameters that one job can read, which are 41 bytes at least.
/// Shorter ones, as `SET_MODE`, can be more: what is beyond is counted as lost.
pub(super) const ACKS: usize = 64;

impl Outbox {
    /// A failure, for the pilot. The newest is the most important: if there are too many, the oldest goes.
    pub(super) fn report(&mut self, event: Event) {
        if self.events.is_full() {
            self.events.pop_front();
        }
        let _ = self.events.push_back(event);
    }

    /// An acknowledgement. A link that asks for more than its line can carry loses what is beyond the queue, which is
    /// counted; its peer repeats.
    pub(super) fn acknowledge(&mut self, command: u16, result: MavResult, to: Sender) {
        self.lost = self.lost.saturating_add(self.acks.push_back(Ack { command, result, to }).is_err().into());
    }

    /// Any other answer; the same holds for it.
    pub(super) fn answer(&mut self, answer: Answer) {
        self.lost = self.lost.saturating_add(self.answers.push_back(answer).is_err().into());
    }

    /// Acknowledgements and answers that were lost since the link was opened.
    pub(super) fn lost(&self) -> u32 {
        self.lost
    }

    /// Writes what fits.
    pub(super) fn send(&mut self, view: &View, out: &mut Writer) {
        out.set_limit(ACKS_SHARE);
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
        Answer::Refusal { request, reason } => text::write_refusal(request, reason, out),
        Answer::Report(report) => telemetry::write(report, view, out),
        Answer::Mission { request, mission_type, to } => services::write_mission(request, mission_type, to, out),
        Answer::File { request, to } => services::write_file(request, to, out),
        Answer::NoLogs => services::write_no_logs(out),
        Answer::NoSerial { device } => services::write_no_serial(device, out),
        Answer::ExtendedParams(request) => services::write_no_extended_params(&request, out),
        Answer::Timesync { tc1, ts1, to: (target_system, target_component) } => {
            out.write(&TIMESYNC_DATA { tc1, ts1, target_system, target_component })
        }
        Answer::Ping { time_usec, seq, to: (target_system, target_component) } => {
            out.write(&PING_DATA { time_usec, seq, target_system, target_component })
        }
    }
}

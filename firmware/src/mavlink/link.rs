//! One link: its parser, what has been asked on it and is still to be done or answered, its telemetry rates and its
//! sequence numbers. Nothing of it is shared with another link.

use glissade_dialect::MavResult;
use heapless::Deque;

use super::incoming::{CommandMessage, Incoming, Sender};
use super::outbox::{Answer, Line, Outbox};
use super::params::{self, Done, ParamRequest, Params};
use super::parser::Parser;
use super::port::{Port, Profile};
use super::setpoint::SetPointMessage;
use super::sticks::{Hands, Source, Taking};
use super::telemetry::{Place, Report, Telemetry, View};
use super::writer::Writer;
use super::{GroundOutput, command, mode, place, setpoint};
use crate::commander::{self, Command, Event, Outcome, Refusal, Reply, Request, StationReply};
use crate::frames::Origin;
use crate::latest::{Latest, Stamped};
use crate::settings::{Marks, Settings};
use crate::signals::{TICK_S, TICK_US, Tick};

/// Commands of a link that wait for the commander.
const WAITING: usize = 8;

/// An arming waits so long for settings that were set before it, ticks: within half a second a station is to be answered.
const SETTLED_WITHIN: Tick = 400;

/// A stream of set-points that are refused is told of once in this time, s.
const TELL_EVERY_S: f32 = 2.0;

/// Rates that a peer has set are forgotten once nothing has been heard of it for this long, s.
const SILENT_AFTER_S: f32 = 10.0;

/// What a job of the ground partition knows and passes on.
pub(super) struct Job<'a> {
    /// Its snapshot.
    pub(super) view: View<'a>,
    /// The vehicle's settings, and those that have been changed.
    pub(super) settings: &'a mut Settings,
    pub(super) changed: &'a mut Marks,
    /// An origin of the local frame that a ground station has set.
    pub(super) set_origin: &'a mut Option<Origin>,
    /// What was read last, on whatever link.
    pub(super) latest: &'a mut Latest,
    /// From whom sticks come.
    pub(super) hands: &'a mut Hands,
    /// From whom set-points come.
    pub(super) leader: &'a mut Option<Source>,
    /// Whether what can be set while disarmed only is refused.
    pub(super) armed: bool,
    /// Its output.
    pub(super) output: &'a mut GroundOutput,
}

/// The state of a link.
#[derive(Clone, Debug, Default)]
pub(super) struct Link {
    /// Which opening of the link this is.
    session: u32,
    parser: Parser,
    pub(super) telemetry: Telemetry,
    outbox: Outbox,
    line: Line,
    sequence: u8,
    params: Params,
    waiting: Deque<Command, WAITING>,
    /// Since when an arming has waited for settings.
    arming_waits_since: Option<Tick>,
    /// When the pilot was last told of a set-point that was refused.
    refused_at: Option<Tick>,
    /// When something for this vehicle, or a heartbeat, was last received.
    heard_at: Option<Tick>,
}

impl Link {
    /// Forgets the last peer if there is a new one. The sequence goes on: the new one cannot know where it began.
    pub(super) fn begin(&mut self, session: u32, profile: Profile, now: Tick, port: &Port) {
        if session != self.session {
            port.pass_stale_input();
            let telemetry = Telemetry::new(profile, now);
            *self = Self { session, telemetry, sequence: self.sequence, ..Self::default() };
        }
    }

    /// Reads and carries out what has been received. `number` is the link's own.
    pub(super) fn read(&mut self, number: u8, port: &Port, job: &mut Job) {
        self.parser.begin(port.received());
        while let Some((sender, message)) = self.parser.next(port.received(), job.view.us) {
            self.heard_at = Some(job.view.now);
            self.handle(number, sender, message, job);
        }
        let silent_after = (SILENT_AFTER_S / TICK_S) as Tick;
        if self.heard_at.is_some_and(|at| job.view.now.wrapping_sub(at) > silent_after) {
            self.heard_at = None;
            self.telemetry.forget_rates(job.view.now);
        }
    }

    fn handle(&mut self, number: u8, sender: Sender, message: Incoming, job: &mut Job) {
        match message {
            Incoming::Heartbeat { station } => {
                if station {
                    job.latest.station = Some(job.view.now);
                }
            }
            Incoming::Sticks(sticks) => {
                let from = Source { link: number, system: sender.0 };
                let taking = Taking::by(job.settings);
                job.output.kill |= job.hands.take(&sticks, from, job.view.now, &taking, job.latest);
            }
            Incoming::SetPoint(message) => self.take_setpoint(number, sender, &message, job),
            Incoming::Command(command) => self.handle_command(number, sender, &command, job),
            Incoming::SetMode { base_mode, custom_mode } => {
                let command = mode::as_command(base_mode, custom_mode);
                self.handle_command(number, sender, &command, job);
            }
            Incoming::Mission { request, mission_type } => {
                self.outbox.answer(Answer::Mission { request, mission_type, to: sender });
            }
            Incoming::Param(request) => self.handle_param(sender, &request, job),
            Incoming::File(request) => self.outbox.answer(Answer::File { request, to: sender }),
            Incoming::SetOrigin(place) => self.set_origin(&place, job),
            Incoming::Serial { device } => self.outbox.answer(Answer::NoSerial { device }),
            Incoming::ExtendedParams(request) => self.outbox.answer(Answer::ExtendedParams(request)),
            Incoming::Logs => self.outbox.answer(Answer::NoLogs),
            Incoming::Timesync { ts1 } => {
                let tc1 = i64::from(job.view.now) * i64::from(TICK_US) * 1000;
                self.outbox.answer(Answer::Timesync { tc1, ts1, to: sender });
            }
            Incoming::Ping { time_usec, seq } => self.outbox.answer(Answer::Ping { time_usec, seq, to: sender }),
        }
    }

    /// Takes over a set-point. While the last one of somebody else is not lost, another's does not count.
    fn take_setpoint(&mut self, link: u8, sender: Sender, message: &SetPointMessage, job: &mut Job) {
        let (now, from) = (job.view.now, Source { link, system: sender.0 });
        let loss_s = job.settings.setpoint_loss_s();
        if job.latest.setpoint_within(now, loss_s).is_some() && *job.leader != Some(from) {
            return;
        }
        match setpoint::read(message, &job.view) {
            Ok(value) => {
                *job.leader = Some(from);
                job.latest.setpoint = Some(Stamped { value, at: now });
            }
            Err(reason) => {
                let told = (TELL_EVERY_S / TICK_S) as Tick;
                if self.refused_at.is_none_or(|at| now.wrapping_sub(at) >= told) {
                    self.refused_at = Some(now);
                    self.refuse("Set-point", reason);
                }
            }
        }
    }

    fn handle_command(&mut self, link: u8, sender: Sender, message: &CommandMessage, job: &mut Job) {
        use command::Effect;
        let result = match command::carry_out(message, &job.view, &mut self.telemetry, job.output) {
            Effect::Done(result) => result,
            Effect::Report(report) => {
                self.outbox.answer(Answer::Report(report));
                MavResult::MAV_RESULT_ACCEPTED
            }
            Effect::Refuse { request, reason } => {
                self.refuse(request, reason);
                MavResult::MAV_RESULT_TEMPORARILY_REJECTED
            }
            Effect::Ask(request) => {
                let (peer, command) = (self.peer(), message.command);
                let origin = commander::Origin::Station { link, peer, sender, command };
                match self.waiting.push_back(Command { request, origin }) {
                    // The commander will answer.
                    Ok(()) => return,
                    Err(command) => {
                        self.refuse(command.request.name(), Refusal::Busy.reason());
                        MavResult::MAV_RESULT_TEMPORARILY_REJECTED
                    }
                }
            }
        };
        self.outbox.acknowledge(message.command, result, sender);
    }

    /// Answers with the origin that is in effect, whether it is the one that was sent or not; why not, if there is none.
    fn set_origin(&mut self, place: &Place, job: &mut Job) {
        let refused = place::set_origin(place, job.view.input, job.set_origin).err();
        let is_known = job.view.input.origin().is_some() || job.set_origin.is_some();
        match refused {
            Some(reason) if !is_known => self.refuse("Setting the origin", reason),
            _ => self.outbox.answer(Answer::Report(Report::GpsGlobalOrigin)),
        }
    }

    fn handle_param(&mut self, sender: Sender, request: &ParamRequest, job: &mut Job) {
        match request {
            ParamRequest::List => self.params.request_list(),
            ParamRequest::Read { index, name } => self.params.request_read(*index, name, sender),
            ParamRequest::Set { name, bits, kind } => {
                let done = params::set(job.settings, name, *bits, *kind, job.armed);
                if let Done::Changed(index) = done {
                    job.changed.set(index);
                }
                self.params.answer(name, done, sender);
            }
        }
    }

    /// A setting that was changed, on whatever link.
    pub(super) fn announce(&mut self, index: usize) {
        self.params.announce(index);
    }

    /// The next command for the commander. While settings are not `settled`, an arming waits, and in the end is refused.
    pub(super) fn next_command(&mut self, now: Tick, settled: bool) -> Option<Command> {
        let is_arming = |command: &Command| matches!(command.request, Request::Arm { .. });
        if settled || !self.waiting.front().is_some_and(is_arming) {
            self.arming_waits_since = None;
            return self.waiting.pop_front();
        }
        let since = *self.arming_waits_since.get_or_insert(now);
        if now.wrapping_sub(since) > SETTLED_WITHIN
            && let Some(command) = self.waiting.pop_front()
        {
            self.arming_waits_since = None;
            self.refuse_command(command, Refusal::Unsettled);
        }
        None
    }

    /// Whether an arming waits for settings.
    pub(super) fn has_arming_waiting(&self) -> bool {
        self.arming_waits_since.is_some()
    }

    /// Refuses what is still waiting for the commander: a kill came after it.
    pub(super) fn refuse_waiting(&mut self) {
        while let Some(command) = self.waiting.pop_front() {
            self.refuse_command(command, Refusal::Killed);
        }
    }

    fn refuse_command(&mut self, command: Command, refusal: Refusal) {
        let reply = Reply { command, outcome: Outcome::TemporarilyRejected(refusal) };
        if let Some(reply) = reply.to_station() {
            self.reply(&reply);
        }
    }

    /// Passes on a reply of the commander.
    pub(super) fn reply(&mut self, reply: &StationReply) {
        if reply.peer != self.peer() {
            return;
        }
        self.outbox.acknowledge(reply.command, command::result_of(reply.outcome), reply.sender);
        if let Outcome::TemporarilyRejected(refusal) = reply.outcome {
            self.refuse(reply.request, refusal.reason());
        }
    }

    /// Which of the link's peers this is.
    fn peer(&self) -> u16 {
        self.session as u16
    }

    /// Tells the pilot why something was refused.
    fn refuse(&mut self, request: &'static str, reason: &'static str) {
        self.outbox.answer(Answer::Refusal { request, reason });
    }

    /// Tells the pilot of a failure.
    pub(super) fn report(&mut self, event: Event) {
        self.outbox.report(event);
    }

    /// Writes what is to be said and fits: failures, acknowledgements, answers, settings, telemetry.
    pub(super) fn write(&mut self, view: &View, settings: &Settings, port: &Port) {
        let unanswered = self.outbox.lost().saturating_add(self.params.lost());
        let errors = self.parser.bad_checksums().saturating_add(port.lost()).saturating_add(unanswered);
        let view = View { errors, ..*view };
        let mut out = Writer::new(port, &mut self.sequence, view.us);
        let share = self.line.share(out.waiting());
        self.outbox.send(&view, &mut out);
        self.params.send_answers(settings, &mut out);
        out.set_limit(share);
        self.params.send_list(settings, &mut out);
        self.telemetry.send(&view, share, &mut out);
        self.line.leave(out.waiting());
    }
}

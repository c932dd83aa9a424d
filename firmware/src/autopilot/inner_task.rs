//! The tick: publishes outputs, releases partitions, runs the inner loop.

mod report;

use super::{Mailboxes, Released};
use crate::commander::{
    Answers, Asked, Command, Commander, CommanderInput, CommanderOutput, Commands, Directive, Event, Events, MotorTest,
    Origin, Outcome, Refusal, Reply, Request,
};
use crate::config::FlightConfig;
use crate::control::attitude::SlidingAttitude;
use crate::control::law::{AttitudeLaw, PositionLaw};
use crate::estimator::FilterReport;
use crate::estimator::status::Fusion;
use crate::failure::{Failures, Injectable};
use crate::inner::{Inner, InnerOutput};
use crate::latest::Latest;
use crate::mavlink::LoopTiming;
use crate::mavlink::port::Ports;
use crate::navigator::Navigator;
use crate::outer::{Authority, Outer, OuterInput, OuterOutput};
use crate::schedule::OUTER;
use crate::settings::Changes;
use crate::signals::{NavHealth, NavState, SensorFrame, Tick};
use crate::watchdog::{Fallback, Watchdog};

/// Time between the order to restart and the restart, ticks: the answer goes out before.
const RESTART_AFTER: Tick = 500;

/// The partitions that have not taken over the last changes of settings. The ground partition sends no others until
/// all have: a slow one loses none.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
struct Waiting {
    filter: bool,
    outer: bool,
    commander: bool,
}

/// The top of the schedule: owns the inner partition and the outputs now in effect.
#[derive(Clone, Debug)]
pub struct InnerTask<A = SlidingAttitude> {
    tick: Tick,
    inner: Inner<A>,
    outer: OuterOutput,
    filter: FilterReport,
    /// When that output took effect.
    filtered_at: Option<Tick>,
    /// Record of each kind of measurement, for telemetry.
    fusion: Fusion,
    commander: CommanderOutput,
    /// Commands for the commander's next job, and replies for the ground's.
    commands: Commands,
    replies: Answers,
    /// Failsafe events for the ground's next job.
    events: Events,
    /// Sticks, and when a ground station was last heard, as the ground partition has read them.
    latest: Latest,
    timing: Option<LoopTiming>,
    /// Changed settings, and who has not taken them over yet.
    changes: Changes,
    waiting: Waiting,
    /// Failures that the board can inject, and those it is to inject now.
    injectable: Injectable,
    failures: Failures,
    /// Kills since boot, wrapping. The rotors are stopped while the commander has not disarmed for as many: a count
    /// cannot be lost, and an output of before the kill does not undo it.
    kills: u32,
    /// Whether the flight was terminated, and when the vehicle is to be restarted.
    terminated: bool,
    restart_at: Option<Tick>,
    /// Acts when the outer partition or the commander hangs.
    watchdog: Watchdog,
    /// What is flown in place of a partition that hangs.
    fallback: Fallback,
}

impl<A: AttitudeLaw> InnerTask<A> {
    /// Ready for the first tick. The outer loop is run once before, at hover, so that its output is in effect from tick
    /// 0.
    pub(super) fn new(
        config: &FlightConfig,
        inner: Inner<A>,
        outer: &mut Outer<impl PositionLaw>,
        commander: &Commander,
    ) -> Self {
        let commander = commander.initial_output();
        let before = OuterInput {
            nav: *inner.nav(),
            thrust_n: config.airframe.weight_n(),
            directive: commander.directive,
            ground: commander.ground,
            latest: Latest::default(),
            changes: Changes::new(),
        };
        let first = outer.step(0_u32.wrapping_sub(OUTER.offset), &before);
        // That job was a dry run: it must leave no state in the law.
        outer.reset();
        Self {
            tick: 0,
            inner,
            outer: first,
            filter: FilterReport::NONE,
            filtered_at: None,
            fusion: Fusion::default(),
            commander,
            commands: Commands::new(),
            replies: Answers::new(),
            events: Events::new(),
            latest: Latest::default(),
            timing: None,
            changes: Changes::new(),
            waiting: Waiting::default(),
            injectable: Injectable::NONE,
            failures: Failures::new(),
            kills: 0,
            terminated: false,
            restart_at: None,
            watchdog: Watchdog::default(),
            fallback: Fallback::new(config),
        }
    }

    /// One tick: publish, release, control. Must be called once per tick, with `None` for a missing sample.
    #[inline]
    pub fn tick(&mut self, mail: &mut Mailboxes, ports: &Ports, sample: Option<&SensorFrame>) -> Released {
        let tick = self.tick;
        self.publish(tick, mail, ports);
        self.inner.sense(sample);
        let released = self.release(tick, mail, ports);
        let armed = self.is_armed();
        if self.watchdog.is_outer_hung(tick) {
            self.control_without_outer(tick, armed);
        } else {
            match self.outer.authority {
                Authority::Idle if armed => self.inner.idle(),
                Authority::Gentle if armed => self.inner.step_gently(tick, &self.outer.attitude),
                _ => self.inner.step(tick, &self.outer.attitude, armed),
            };
        }
        if !armed && let Some(MotorTest { rotor, part }) = self.commander.motor_test {
            self.test_motor(tick, rotor, part);
        }
        if self.inner.navigator().is_some() {
            self.inner.watch_rotors(armed, !self.commander.landed);
        }
        self.tick = tick.wrapping_add(1);
        released
    }

    /// Turns a motor, unless a kill or the commander's hanging has ended its test: nobody else would.
    #[cold]
    fn test_motor(&mut self, tick: Tick, rotor: u8, part: f32) {
        if self.commander.kills == self.kills && !self.watchdog.hung(tick).commander {
            self.inner.spin(rotor, part);
        }
    }

    /// One tick of control while the outer partition hangs: a blind descent, unless the vehicle is on the ground.
    #[cold]
    fn control_without_outer(&mut self, tick: Tick, armed: bool) {
        if !armed {
            self.inner.step(tick, &self.outer.attitude, false);
            return;
        }
        if self.outer.authority == Authority::Idle {
            self.inner.idle();
            return;
        }
        let thrust_n = self.fallback.blind_thrust_n() / self.outer.thrust_effectiveness;
        let (level, is_first) = self.watchdog.level(tick, self.inner.nav(), thrust_n);
        if is_first {
            self.report(Event::OuterHung);
        }
        if self.inner.failed_rotor().is_some() {
            // There is no torque to spare.
            self.inner.step(tick, &level, true);
        } else {
            self.inner.step_gently(tick, &level);
        }
    }

    /// The directive for the outer partition: the commander's, or a descent while that hangs.
    fn directive(&mut self, tick: Tick) -> Directive {
        let told = self.commander.directive;
        if !self.watchdog.hung(tick).commander {
            return told;
        }
        let (health, heading_free) = (self.nav_health(), self.inner.failed_rotor().is_some());
        let Some((descent, is_first)) = self.watchdog.descent(&told, self.fallback.rate_m_s(), &health, heading_free)
        else {
            return told;
        };
        if is_first {
            self.report(Event::CommanderHung);
        }
        descent
    }

    fn report(&mut self, event: Event) {
        // A full queue holds worse news.
        let _ = self.events.push(event);
    }

    #[inline]
    fn publish(&mut self, tick: Tick, mail: &mut Mailboxes, ports: &Ports) {
        if let Some(output) = mail.outer.publish(tick) {
            self.outer = *output;
            self.watchdog.outer_published(tick);
        }
        if let Some(navigator) = self.inner.navigator_mut()
            && let Some(output) = mail.filter.publish(tick)
        {
            navigator.inject(&output.injection);
            self.fusion.note(tick, &output.consistency);
            self.filter = output.report;
            self.filtered_at = Some(tick);
        }
        if let Some(output) = mail.commander.publish(tick) {
            for reply in &output.replies {
                self.reply(reply);
            }
            if let Some(event) = output.event {
                self.report(event);
            }
            self.commander = output.clone();
            self.watchdog.commander_published(tick);
        }
        if let Some(output) = mail.ground.publish(tick) {
            if output.kill {
                self.kill();
            }
            self.terminated |= output.terminate;
            if output.restart {
                self.restart_at = Some(tick.wrapping_add(RESTART_AFTER));
            }
            for command in &output.commands {
                if let Err(command) = self.commands.push(*command) {
                    self.refuse(command, Refusal::Busy);
                }
            }
            if !self.commands.is_empty() && self.watchdog.hung(tick).commander {
                self.refuse_all();
            }
            self.latest = output.latest;
            ports.publish();
            if !output.failures.is_empty() {
                self.failures = output.failures.clone();
            }
            if !output.changes.is_empty() {
                self.hand_on(&output.changes);
            }
        }
    }

    /// Settings for the other partitions: inner takes them over now, each of the others with its next job.
    #[cold]
    #[inline(never)]
    fn hand_on(&mut self, changes: &Changes) {
        for change in changes {
            self.inner.apply(change);
            self.fallback.apply(change);
        }
        self.changes = changes.clone();
        let filter = self.inner.navigator().is_some();
        self.waiting = Waiting { filter, outer: true, commander: true };
    }

    /// The changes for a partition that has not taken them over yet.
    fn changes_for(&mut self, partition: fn(&mut Waiting) -> &mut bool) -> Changes {
        let waits = core::mem::take(partition(&mut self.waiting));
        if waits { self.changes.clone() } else { Changes::new() }
    }

    fn reply(&mut self, reply: &Reply) {
        // Never full: a job of the commander has as many replies as commands, and one of the ground partition, which runs
        // twice as often, refuses no more.
        if let Some(reply) = reply.to_station() {
            let _ = self.replies.push(reply);
        }
    }

    fn refuse(&mut self, command: Command, refusal: Refusal) {
        self.reply(&Reply { command, outcome: Outcome::TemporarilyRejected(refusal) });
    }

    /// Answers what waits for a commander that hangs, which may go on much later.
    #[cold]
    fn refuse_all(&mut self) {
        // By reference: what consumes a vector can panic.
        let waiting = core::mem::take(&mut self.commands);
        for command in &waiting {
            self.refuse(*command, Refusal::NoCommander);
        }
    }

    /// Stops the rotors at once, until the commander has disarmed. It is not replied to.
    pub fn kill(&mut self) {
        self.kills = self.kills.wrapping_add(1);
    }

    #[inline]
    fn release(&mut self, tick: Tick, mail: &mut Mailboxes, ports: &Ports) -> Released {
        let released = Released {
            filter: self.inner.navigator().is_some() && mail.filter.is_due(tick),
            outer: mail.outer.is_due(tick),
            commander: mail.commander.is_due(tick),
            ground: mail.ground.is_due(tick),
        };
        if released.filter {
            let landed = self.commander.landed;
            let at_rest = landed && !self.is_armed();
            let changes = self.changes_for(|waiting| &mut waiting.filter);
            if let Some(navigator) = self.inner.navigator_mut() {
                mail.filter.release(tick, navigator.release(landed, at_rest, changes));
            }
        }
        if released.outer {
            let input = OuterInput {
                nav: *self.inner.nav(),
                thrust_n: self.inner.thrust_n(),
                directive: self.directive(tick),
                ground: self.commander.ground,
                latest: self.latest,
                changes: self.changes_for(|waiting| &mut waiting.outer),
            };
            mail.outer.release(tick, input);
        }
        if released.commander {
            let input = CommanderInput {
                nav: *self.inner.nav(),
                nav_fresh: self.inner.is_nav_fresh(),
                health: self.nav_health(),
                thrust_n: self.inner.thrust_n(),
                battery: self.inner.navigator().and_then(Navigator::battery),
                failed_rotor: self.inner.failed_rotor(),
                outer_hung: self.watchdog.is_outer_hung(tick),
                kills: self.kills,
                terminated: self.terminated || self.restart_at.is_some(),
                latest: self.latest,
                commands: core::mem::take(&mut self.commands),
                changes: self.changes_for(|waiting| &mut waiting.commander),
            };
            mail.commander.release(tick, input);
        }
        if released.ground {
            ports.release();
            let overruns = mail.overruns();
            mail.ground.release(tick, self.ground_input(overruns));
        }
        released
    }

    /// Declares the failures that this board can inject. The board must then [take](Self::take_failures) the accepted
    /// ones after each tick, and inject them.
    pub fn allow_failures(&mut self, injectable: Injectable) {
        self.injectable = injectable;
    }

    /// Accepted failure injections, already acknowledged to the ground station: inject them now.
    pub fn take_failures(&mut self) -> Failures {
        core::mem::take(&mut self.failures)
    }

    /// Begins at another tick than the first: after a restart whose clock goes on.
    pub fn start_at(&mut self, tick: Tick) {
        self.tick = tick;
        self.watchdog.outer_published(tick);
        self.watchdog.commander_published(tick);
    }

    /// Whether a ground station wants the vehicle restarted now: the board resets itself. By then it has been told that it
    /// will be. It is not while the vehicle is armed.
    pub fn takes_restart(&mut self) -> bool {
        let due = self.restart_at.is_some_and(|at| self.tick.wrapping_sub(at) < Tick::MAX / 2);
        if due {
            self.restart_at = None;
        }
        due && !self.is_armed()
    }

    fn is_armed(&self) -> bool {
        self.commander.armed && self.commander.kills == self.kills
    }

    /// What a pilot asks for: a [`request`](Self::request) or a [`kill`](Self::kill).
    ///
    /// # Errors
    /// The request itself if too many are waiting; never a kill.
    pub fn ask(&mut self, asked: Asked) -> Result<(), Request> {
        match asked {
            Asked::Request(request) => self.request(request),
            Asked::Kill => {
                self.kill();
                Ok(())
            }
        }
    }

    /// A request of a program on board, for the commander's next job.
    ///
    /// # Errors
    /// The request itself if too many are waiting.
    pub fn request(&mut self, request: Request) -> Result<(), Request> {
        let command = Command { request, origin: Origin::OnBoard };
        self.commands.push(command).map_err(|command| command.request)
    }

    /// Loop rates measured by the board, for telemetry.
    pub fn report_timing(&mut self, timing: LoopTiming) {
        self.timing = Some(timing);
    }

    /// The motion that the inner loop used in the last tick: as sensed, or as estimated.
    #[inline]
    pub fn nav(&self) -> &NavState {
        self.inner.nav()
    }

    /// The inner loop's output of the last tick.
    #[inline]
    pub fn inner_output(&self) -> &InnerOutput {
        self.inner.output()
    }

    /// The outer loop's output now in effect.
    #[inline]
    pub fn outer_output(&self) -> &OuterOutput {
        &self.outer
    }

    /// Navigation on sensors; `None` on ideal state.
    pub fn navigator(&self) -> Option<&Navigator> {
        self.inner.navigator()
    }

    /// What the filter knows, by its output now in effect.
    pub fn filter_report(&self) -> &FilterReport {
        &self.filter
    }

    /// When that output took effect.
    pub fn filtered_at(&self) -> Option<Tick> {
        self.filtered_at
    }

    /// Which components of the motion may be trusted.
    pub fn nav_health(&self) -> NavHealth {
        match (self.inner.is_nav_fresh(), self.inner.navigator()) {
            (false, _) => NavHealth::NONE,
            (true, None) => NavHealth::ALL,
            (true, Some(_)) => self.filter.health,
        }
    }

    /// Sticks, and when a ground station was last heard, as outer and commander are handed them.
    pub fn latest(&self) -> &Latest {
        &self.latest
    }

    /// The commander's output now in effect.
    pub fn commander_output(&self) -> &CommanderOutput {
        &self.commander
    }

    /// The number of the next tick.
    pub fn next_tick(&self) -> Tick {
        self.tick
    }
}

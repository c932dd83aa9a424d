//! The bodies of a board's tasks. What tasks share is behind RTIC's `Mutex`, which the desktop's tests have too.
//!
//! ```text
//! task       released by                     does
//! inner      the tick, 1 kHz                 sample, publish, release, control, rotors
//! receive    a serial port has a byte        puts it into the link's ring
//! outer      inner, every 4th tick           the estimator's filter, guidance and position control
//! commander  inner, every 20th tick          arming, modes, failures
//! ground     inner, every 10th tick          MAVLink
//! transmit   inner, or a serial port is free sends the link's bytes
//! idle                                       log; saves settings, where there is a flash (`storage`)
//! ```
//!
//! Priorities are rate monotonic, in this order from the highest. Inner pends the interrupts of those that it
//! [wakes](Wake); a release while the job is still running stays pending. Inner neither logs nor waits: a log entry may
//! mask all interrupts.

use rtic_core::Mutex;

use super::storage::Saving;
use super::{Clock, Companion, Diagnostics, Rotors, Sensors, SerialReceiver, SerialSender, Start, Ticker};
use crate::autopilot::{Autopilot, InnerTask, Mailboxes};
use crate::commander;
use crate::estimator::Filter;
use crate::mavlink::port::{Port, Ports, Profile};
use crate::mavlink::{self, LoopTiming};
use crate::meter::LoopMeter;
use crate::outer;
use crate::signals::TICK_US;
use crate::validate::ConfigError;

/// How the loops keep time; shared by inner, outer and idle.
#[derive(Clone, Copy, Debug, Default)]
pub struct Loops {
    /// Jobs that outer has finished since inner last looked.
    outer_jobs: u32,
    /// The last full second.
    timing: Option<LoopTiming>,
}

impl Loops {
    /// The last full second, once: for the log.
    pub fn take_timing(&mut self) -> Option<LoopTiming> {
        self.timing.take()
    }
}

/// The tasks that a tick wakes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[expect(clippy::struct_excessive_bools, reason = "a set of tasks, each of them in it or not")]
pub struct Wake {
    /// [`Outer`].
    pub outer: bool,
    /// [`Commander`].
    pub commander: bool,
    /// [`Ground`].
    pub ground: bool,
    /// [`Transmit`].
    pub transmit: bool,
}

/// What the tasks are made of, for an application to give to them.
pub struct Tasks<B, K, T, D> {
    /// For the task of the tick.
    pub inner: Inner<B, K, T>,
    /// Released by it.
    pub outer: Outer<D>,
    /// Released by it.
    pub commander: Commander<D>,
    /// Released by it.
    pub ground: Ground<D>,
    /// The link of the board's serial port; `None` if the companion has all links.
    pub line: Option<&'static Port>,
    /// Shared by inner, outer, commander and ground.
    pub mail: Mailboxes,
    /// Shared by inner, outer and idle.
    pub loops: Loops,
    /// Shared by ground and idle.
    pub saving: Saving,
}

impl<B: Sensors + Rotors + Companion, K: Clock, T: Ticker, D: Diagnostics + Clone> Tasks<B, K, T, D> {
    /// Builds the partitions of a flight. Its first tick comes once the [ticker is started](Inner::start).
    ///
    /// # Errors
    /// The first field of the configuration that is out of range.
    pub fn new(start: Start<B, D>, clock: K, ticker: T, ports: &'static Ports) -> Result<Self, ConfigError> {
        let Start { config, settings, injectable, board, diagnostics } = start;
        let Autopilot { mut inner, filter, outer, commander, ground, mail, .. } =
            Autopilot::on(&config, settings, ports)?;
        inner.allow_failures(injectable);
        let line = (!B::HAS_ALL_LINKS).then(|| ports.first());
        if let Some(port) = line {
            port.open(Profile::Normal);
        }
        let meter = LoopMeter::new(K::COUNTS_PER_US);
        Ok(Self {
            inner: Inner { board, clock, ticker, meter, flight: inner, ports },
            outer: Outer { filter, partition: outer, diagnostics: diagnostics.clone() },
            commander: Commander { partition: commander, diagnostics: diagnostics.clone() },
            ground: Ground { partition: ground, ports, diagnostics },
            line,
            mail,
            loops: Loops::default(),
            saving: Saving::default(),
        })
    }
}

/// The task of the tick.
pub struct Inner<B, K, T> {
    board: B,
    clock: K,
    ticker: T,
    meter: LoopMeter,
    flight: InnerTask,
    ports: &'static Ports,
}

impl<B: Sensors + Rotors + Companion, K: Clock, T: Ticker> Inner<B, K, T> {
    /// Starts the tick.
    pub fn start(&mut self) {
        self.ticker.start(TICK_US);
    }

    /// A tick. The tasks that it wakes are to be pended.
    #[inline]
    pub fn run(&mut self, mut mail: impl Mutex<T = Mailboxes>, mut loops: impl Mutex<T = Loops>) -> Wake {
        self.ticker.acknowledge();
        let sample = self.board.sample(self.flight.next_tick());
        self.measure(&mut loops);
        while let Some(asked) = self.board.asked() {
            // A full queue drops a request, like a ground station's.
            let _ = self.flight.ask(asked);
        }
        let (released, overruns) =
            mail.lock(|mail| (self.flight.tick(mail, self.ports, sample.as_ref()), mail.overruns()));
        self.board.drive(&self.flight.inner_output().motors);
        self.board.see(&self.flight, overruns, self.ports);
        if self.flight.takes_restart() {
            self.board.restart();
        }
        Wake {
            outer: released.filter || released.outer,
            commander: released.commander,
            ground: released.ground,
            transmit: !B::HAS_ALL_LINKS && self.ports.first().has_output(),
        }
    }

    /// Measures the loops, and once per second tells of them.
    #[inline]
    fn measure(&mut self, loops: &mut impl Mutex<T = Loops>) {
        let outer_jobs = loops.lock(|loops| core::mem::take(&mut loops.outer_jobs));
        let Some(timing) = self.meter.activation(self.clock.now(), outer_jobs) else { return };
        loops.lock(|loops| loops.timing = Some(timing));
        if !B::HAS_ALL_LINKS {
            self.flight.report_timing(timing);
        }
    }

    /// The flight.
    pub fn flight(&self) -> &InnerTask {
        &self.flight
    }
}

/// The task of the outer partition, and of the estimator's filter before it.
pub struct Outer<D> {
    filter: Filter,
    partition: outer::Outer,
    diagnostics: D,
}

impl<D: Diagnostics> Outer<D> {
    /// The jobs that are released, if any.
    pub fn run(&mut self, mut mail: impl Mutex<T = Mailboxes>, mut loops: impl Mutex<T = Loops>) {
        if let Some((tick, input)) = mail.lock(|mail| mail.filter.take()) {
            let output = self.filter.step(tick, &input);
            mail.lock(|mail| mail.filter.finish(output));
        }
        let Some((tick, input)) = mail.lock(|mail| mail.outer.take()) else { return };
        let output = self.partition.step(tick, &input);
        self.diagnostics.outer(tick);
        mail.lock(|mail| mail.outer.finish(output));
        loops.lock(|loops| loops.outer_jobs = loops.outer_jobs.saturating_add(1));
    }
}

/// The task of the commander.
pub struct Commander<D> {
    partition: commander::Commander,
    diagnostics: D,
}

impl<D: Diagnostics> Commander<D> {
    /// The job that is released, if any.
    pub fn run(&mut self, mut mail: impl Mutex<T = Mailboxes>) {
        let Some((tick, input)) = mail.lock(|mail| mail.commander.take()) else { return };
        let output = self.partition.step(tick, &input);
        self.diagnostics.commander();
        mail.lock(|mail| mail.commander.finish(output));
    }
}

/// The task of the ground partition.
pub struct Ground<D> {
    partition: mavlink::Ground,
    ports: &'static Ports,
    diagnostics: D,
}

impl<D: Diagnostics> Ground<D> {
    /// The job that is released, if any.
    pub fn run(&mut self, mut mail: impl Mutex<T = Mailboxes>, mut saving: impl Mutex<T = Saving>) {
        let Some((tick, input)) = mail.lock(|mail| mail.ground.take()) else { return };
        let output = self.partition.step(tick, &input, self.ports);
        self.diagnostics.ground();
        mail.lock(|mail| mail.ground.finish(output));
        saving.lock(|saving| saving.exchange(self.partition.settings_mut(), input.armed));
    }
}

/// The task of a serial port's receiving half.
pub struct Receive<R> {
    serial: R,
    line: Option<&'static Port>,
}

impl<R: SerialReceiver> Receive<R> {
    /// Bytes go to this link, or nowhere.
    pub fn new(serial: R, line: Option<&'static Port>) -> Self {
        Self { serial, line }
    }

    /// Takes in what has arrived.
    pub fn run(&mut self) {
        self.serial.acknowledge();
        // In a loop: a byte that arrives while this task runs may not interrupt again.
        while let Ok(true) = self.serial.read_ready() {
            let mut bytes = [0; 32];
            match self.serial.read(&mut bytes) {
                Ok(0) => return,
                Ok(count) => {
                    if let Some(port) = self.line {
                        port.receive(bytes.get(..count).unwrap_or_default());
                    }
                }
                // The next interrupt goes on: an error that lasts must not stop the tasks below.
                Err(_) => {
                    if let Some(port) = self.line {
                        port.lose(1);
                    }
                    return;
                }
            }
        }
    }
}

/// The task of a serial port's sending half.
pub struct Transmit<W> {
    serial: W,
    line: Option<&'static Port>,
}

impl<W: SerialSender> Transmit<W> {
    /// Bytes come from this link, or from nowhere.
    pub fn new(serial: W, line: Option<&'static Port>) -> Self {
        Self { serial, line }
    }

    /// Sends what there is, as much as the port takes.
    pub fn run(&mut self) {
        self.serial.acknowledge();
        let Some(port) = self.line else { return };
        while port.has_output() && self.serial.write_ready().unwrap_or(false) {
            if let Some(byte) = port.next_byte() {
                let _ = self.serial.write(&[byte]);
            }
        }
    }
}

#[cfg(test)]
mod tests;

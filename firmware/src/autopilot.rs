//! The partitions put together: scheduling and data flow between them.
//!
//! [`InnerTask`] is run by the tick's interrupt. Each partition below it `take`s its snapshot from its mailbox,
//! `step`s, and `finish`es with its output: on a board in an RTIC task of its own priority, on the desktop one after
//! the other in [`Autopilot::tick`]. Each tick, in this order (see `schedule`): due outputs are published, partitions
//! are released with a snapshot of their inputs, the inner loop runs, then the released partitions.

mod inner_task;

use core::borrow::Borrow;

pub use inner_task::InnerTask;

use crate::commander::{Commander, CommanderInput, CommanderOutput};
use crate::config::FlightConfig;
use crate::control::attitude::SlidingAttitude;
use crate::control::law::{AttitudeLaw, PositionLaw};
use crate::control::position::SlidingPosition;
use crate::estimator::{Filter, FilterInput, FilterOutput};
use crate::inner::{Inner, InnerOutput};
use crate::mavlink::port::Ports;
use crate::mavlink::{Ground, GroundInput, GroundOutput};
use crate::outer::{Outer, OuterInput, OuterOutput};
use crate::schedule::{COMMANDER, FILTER, GROUND, Mailbox, OUTER};
use crate::settings::Settings;
use crate::signals::SensorFrame;
use crate::validate::ConfigError;

/// The mailboxes between the partitions: all the data that they share.
#[derive(Clone, Debug)]
pub struct Mailboxes {
    /// Inner ⇄ outer.
    pub outer: Mailbox<OuterInput, OuterOutput, { OUTER.period }, { OUTER.offset }>,
    /// Inner ⇄ the estimator's filter.
    pub filter: Mailbox<FilterInput, FilterOutput, { FILTER.period }, { FILTER.offset }>,
    /// Inner ⇄ commander.
    pub commander: Mailbox<CommanderInput, CommanderOutput, { COMMANDER.period }, { COMMANDER.offset }, true>,
    /// Inner ⇄ ground.
    pub ground: Mailbox<GroundInput, GroundOutput, { GROUND.period }, { GROUND.offset }, true>,
}

impl Mailboxes {
    /// Empty mailboxes.
    pub const fn new() -> Self {
        Self { outer: Mailbox::new(), filter: Mailbox::new(), commander: Mailbox::new(), ground: Mailbox::new() }
    }

    /// Overruns since boot of the outer partition (with the filter), the commander and the ground partition.
    pub fn overruns(&self) -> [u32; 3] {
        let outer = self.outer.overruns().saturating_add(self.filter.overruns());
        [outer, self.commander.overruns(), self.ground.overruns()]
    }
}

impl Default for Mailboxes {
    fn default() -> Self {
        Self::new()
    }
}

/// The partitions that a tick has released.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[expect(clippy::struct_excessive_bools, reason = "a set of partitions, each of them in it or not")]
pub struct Released {
    /// The estimator's filter, in the same task as outer and before it.
    pub filter: bool,
    /// Guidance and position control.
    pub outer: bool,
    /// Arming, modes, failsafes.
    pub commander: bool,
    /// MAVLink.
    pub ground: bool,
}

/// Everything that flies, for one configuration. The desktop calls [`tick`](Autopilot::tick); a board takes it apart and
/// gives each partition to its task. `L` are the links: a board keeps them in a static, as their drivers use them too.
#[derive(Clone, Debug)]
pub struct Autopilot<A = SlidingAttitude, P = SlidingPosition, L = Ports> {
    /// Runs every tick.
    pub inner: InnerTask<A>,
    /// The estimator's covariance and late readings; idle on ideal state.
    pub filter: Filter,
    /// Guidance and position control.
    pub outer: Outer<P>,
    /// Arming, modes, failsafes.
    pub commander: Commander,
    /// MAVLink.
    pub ground: Ground,
    /// The mailboxes between them.
    pub mail: Mailboxes,
    /// The links to ground stations, all closed at first.
    pub ports: L,
}

impl Autopilot {
    /// Ready for the first tick, with the sliding mode laws.
    ///
    /// # Errors
    /// The first field of the configuration that is out of range.
    pub fn new(config: &FlightConfig) -> Result<Self, ConfigError> {
        Autopilot::on(config, Settings::of(config), Ports::new())
    }
}

impl<L: Borrow<Ports>> Autopilot<SlidingAttitude, SlidingPosition, L> {
    /// The same with its settings, of which the configuration was made, and with links that are kept elsewhere.
    ///
    /// # Errors
    /// The first field of the configuration that is out of range.
    pub fn on(config: &FlightConfig, settings: Settings, ports: L) -> Result<Self, ConfigError> {
        // The laws are made of valid values only.
        config.validate()?;
        let attitude = SlidingAttitude::new(&config.airframe, &config.attitude);
        let position = SlidingPosition::new(&config.airframe, &config.position);
        Self::assemble(config, settings, attitude, position, ports)
    }
}

impl<A: AttitudeLaw, P: PositionLaw> Autopilot<A, P> {
    /// Ready for the first tick, with other control laws; the configuration's sliding mode gains are not used.
    ///
    /// # Errors
    /// The first field of the configuration that is out of range.
    pub fn with_laws(config: &FlightConfig, attitude: A, position: P) -> Result<Self, ConfigError> {
        config.validate()?;
        Self::assemble(config, Settings::of(config), attitude, position, Ports::new())
    }
}

impl<A: AttitudeLaw, P: PositionLaw, L: Borrow<Ports>> Autopilot<A, P, L> {
    /// The partitions of a valid configuration.
    fn assemble(
        config: &FlightConfig,
        settings: Settings,
        attitude: A,
        position: P,
        ports: L,
    ) -> Result<Self, ConfigError> {
        let mut commander = Commander::new(config);
        commander.configure(&settings);
        let mut outer = Outer::new(config, position)?;
        let inner = Inner::new(config, attitude)?;
        Ok(Self {
            inner: InnerTask::new(config, inner, &mut outer, &commander),
            filter: filter(config),
            outer,
            commander,
            ground: Ground::new(settings),
            mail: Mailboxes::new(),
            ports,
        })
    }

    /// The same vehicle with the settings of which its configuration was made: with what stands in the settings alone,
    /// and unable to arm if it was never configured.
    #[must_use]
    pub fn with_settings(mut self, settings: Settings) -> Self {
        self.commander.configure(&settings);
        self.ground = Ground::new(settings);
        self
    }

    /// One tick of all partitions, in the order of the schedule: the desktop's executor.
    #[inline]
    pub fn tick(&mut self, sample: Option<&SensorFrame>) -> &InnerOutput {
        let released = self.inner.tick(&mut self.mail, self.ports.borrow(), sample);
        self.run(released);
        self.inner.inner_output()
    }

    /// The filter's output, if one has come into effect in the last tick.
    pub fn filtered(&self) -> Option<&FilterOutput> {
        let last_tick = self.inner.next_tick().wrapping_sub(1);
        // The filter's next job is released later than in the tick that publishes this one's output.
        if self.inner.filtered_at() == Some(last_tick) { self.mail.filter.last_output() } else { None }
    }

    /// The jobs that a tick has released, each to its end.
    #[inline]
    pub fn run(&mut self, released: Released) {
        let Self { filter, outer, commander, ground, mail, ports, .. } = self;
        if released.filter {
            mail.filter.run(|tick, input| filter.step(tick, input));
        }
        if released.outer {
            mail.outer.run(|tick, input| outer.step(tick, input));
        }
        if released.commander {
            mail.commander.run(|tick, input| commander.step(tick, input));
        }
        if released.ground {
            mail.ground.run(|tick, input| ground.step(tick, input, (*ports).borrow()));
        }
    }
}

/// The filter of a configuration; unused on ideal state.
fn filter(config: &FlightConfig) -> Filter {
    let airframe = &config.airframe;
    let [k, _, _] = airframe.drag_n_s_m;
    let settings = config.estimator.unwrap_or_default();
    Filter::new(&settings, airframe.gravity_m_s2, k / airframe.mass_kg, config.start_position())
}

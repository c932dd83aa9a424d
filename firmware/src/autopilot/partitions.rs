//! What flies, without the links: for a board to take apart.

use super::{InnerTask, Mailboxes};
use crate::commander::Commander;
use crate::config::FlightConfig;
use crate::control::attitude::SlidingAttitude;
use crate::control::law::{AttitudeLaw, PositionLaw};
use crate::control::position::SlidingPosition;
use crate::estimator::Filter;
use crate::inner::Inner;
use crate::mavlink::Ground;
use crate::outer::Outer;
use crate::settings::Settings;
use crate::validate::ConfigError;

/// The inner task, the partitions below it, and the mailboxes between them, for one configuration. A board gives each of
/// them to its task; the links to ground stations it keeps in a static, as their drivers use them too.
#[derive(Clone, Debug)]
pub struct Partitions<A = SlidingAttitude, P = SlidingPosition> {
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
}

impl Partitions {
    /// Ready for the first tick, with the sliding mode laws.
    ///
    /// # Errors
    /// The first field of the configuration that is out of range.
    pub fn new(config: &FlightConfig) -> Result<Self, ConfigError> {
        config.validate()?;
        let attitude = SlidingAttitude::new(&config.airframe, &config.attitude);
        let position = SlidingPosition::new(&config.airframe, &config.position);
        Self::with_laws(config, attitude, position)
    }
}

impl<A: AttitudeLaw, P: PositionLaw> Partitions<A, P> {
    /// Ready for the first tick, with other control laws; the configuration's sliding mode gains are not used.
    ///
    /// # Errors
    /// The first field of the configuration that is out of range.
    pub fn with_laws(config: &FlightConfig, attitude: A, position: P) -> Result<Self, ConfigError> {
        config.validate()?;
        let settings = Settings::of(config);
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
        })
    }
}

/// The filter of a configuration; unused on ideal state.
fn filter(config: &FlightConfig) -> Filter {
    let airframe = &config.airframe;
    let [k, _, _] = airframe.drag_n_s_m;
    let settings = config.estimator.unwrap_or_default();
    Filter::new(&settings, airframe.gravity_m_s2, k / airframe.mass_kg, config.start_position())
}

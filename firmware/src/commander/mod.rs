//! The commander partition, 50 Hz: arming.
//!
//! ```text
//!              arm, checks pass
//!  Disarmed ───────────────────► Armed { since }
//!     ▲                             │
//!     └─────────────────────────────┘
//!       disarm on the ground, or forced
//! ```
//!
//! A refused command leaves the state as it is and says why. A forced disarm also acts at once, through the
//! latch that the inner loop reads every tick (see `autopilot`).

use crate::config::{FlightConfig, Start};
use crate::math;
use crate::schedule::COMMANDER;
use crate::signals::{NavState, Tick};

/// What a ground station may ask for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Request {
    /// Start the flight; `force` skips the checks.
    Arm {
        /// Skip the checks.
        force: bool,
    },
    /// Stop the rotors; `force` also in the air.
    Disarm {
        /// Also in the air.
        force: bool,
    },
}

/// A request and who made it, so that the answer finds its way.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Command {
    /// What is asked.
    pub request: Request,
    /// MAVLink system and component of the sender.
    pub sender: (u8, u8),
}

/// How a command ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Outcome {
    /// Done.
    Accepted,
    /// Not now; the reason may pass.
    TemporarilyRejected(Refusal),
}

/// Why a command was refused.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Refusal {
    /// No valid motion from the sensors.
    NoNavigation,
    /// Tilted more than 20°.
    NotLevel,
    /// Moving faster than 0.5 m/s.
    Moving,
    /// In the air.
    InAir,
}

/// The answer to a command.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Reply {
    /// The command.
    pub command: Command,
    /// How it ended.
    pub outcome: Outcome,
}

/// Commands between two jobs.
pub type Commands = heapless::Vec<Command, 4>;
/// Replies of one job.
pub type Replies = heapless::Vec<Reply, 4>;

/// Snapshot for the commander.
#[derive(Clone, Debug, PartialEq)]
pub struct CommanderInput {
    /// The motion at the release.
    pub nav: NavState,
    /// Whether the motion is to be trusted.
    pub nav_fresh: bool,
    /// Commands that came since the last job.
    pub commands: Commands,
}

/// What the commander has decided.
#[derive(Clone, Debug, PartialEq)]
pub struct CommanderOutput {
    /// The tick at which the flight's clock started; none while disarmed.
    pub flight_start: Option<Tick>,
    /// Whether the vehicle is on the ground.
    pub landed: bool,
    /// Whether an arm request would be accepted.
    pub armable: bool,
    /// Answers to the commands.
    pub replies: Replies,
}

/// Arming state.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum State {
    /// Rotors stopped.
    Disarmed,
    /// Flying, or about to.
    Armed {
        /// Start of the flight's clock.
        since: Tick,
    },
}

/// The commander partition.
#[derive(Clone, Debug)]
pub struct Commander {
    state: State,
    ground_height: f32,
    /// Whether the start is a place on the ground; a flight that begins in the air has none that is known.
    on_ground: bool,
}

/// cos 20°.
const COS_TILT_MAX: f32 = 0.94;
const SPEED_MAX_M_S: f32 = 0.5;
/// Below this height over the start, at rest, the vehicle counts as landed.
const LANDED_HEIGHT_M: f32 = 0.1;

impl Commander {
    /// In the state in which the configuration starts.
    pub fn new(config: &FlightConfig) -> Self {
        let state = match config.start {
            Start::InFlight => State::Armed { since: 0 },
            Start::OnGround => State::Disarmed,
        };
        let [_, _, ground_height] = config.start_position_m;
        Self { state, ground_height, on_ground: config.start == Start::OnGround }
    }

    /// What holds before the first job's output.
    pub fn initial_output(&self) -> CommanderOutput {
        CommanderOutput {
            flight_start: self.flight_start(),
            landed: self.state == State::Disarmed,
            armable: false,
            replies: Replies::new(),
        }
    }

    /// One job, released at `released`.
    pub fn step(&mut self, released: Tick, input: &CommanderInput) -> CommanderOutput {
        let landed = self.is_landed(&input.nav);
        let mut replies = Replies::new();
        for command in &input.commands {
            let outcome = self.decide(command.request, released.wrapping_add(COMMANDER.offset), landed, input);
            // As many replies fit as commands.
            let _ = replies.push(Reply { command: *command, outcome });
        }
        CommanderOutput { flight_start: self.flight_start(), landed, armable: check(input).is_ok(), replies }
    }

    fn decide(&mut self, request: Request, effective: Tick, landed: bool, input: &CommanderInput) -> Outcome {
        match (request, self.state) {
            (Request::Arm { .. }, State::Armed { .. }) | (Request::Disarm { .. }, State::Disarmed) => Outcome::Accepted,
            (Request::Arm { force }, State::Disarmed) => match check(input) {
                Err(refusal) if !force => Outcome::TemporarilyRejected(refusal),
                _ => {
                    self.state = State::Armed { since: effective };
                    Outcome::Accepted
                }
            },
            (Request::Disarm { force }, State::Armed { .. }) => {
                if landed || force {
                    self.state = State::Disarmed;
                    Outcome::Accepted
                } else {
                    Outcome::TemporarilyRejected(Refusal::InAir)
                }
            }
        }
    }

    fn flight_start(&self) -> Option<Tick> {
        match self.state {
            State::Disarmed => None,
            State::Armed { since } => Some(since),
        }
    }

    fn is_landed(&self, nav: &NavState) -> bool {
        self.on_ground && nav.position.z - self.ground_height < LANDED_HEIGHT_M && is_slow(nav)
    }
}

fn is_slow(nav: &NavState) -> bool {
    nav.velocity.norm_squared() < SPEED_MAX_M_S * SPEED_MAX_M_S
}

/// Whether the vehicle may be armed.
fn check(input: &CommanderInput) -> Result<(), Refusal> {
    let q = input.nav.attitude.quaternion();
    let cos_tilt = 1.0 - 2.0 * (q.i * q.i + q.j * q.j);
    if !input.nav_fresh {
        Err(Refusal::NoNavigation)
    } else if math::max(cos_tilt, -1.0) < COS_TILT_MAX {
        Err(Refusal::NotLevel)
    } else if !is_slow(&input.nav) {
        Err(Refusal::Moving)
    } else {
        Ok(())
    }
}

//! The ground partition, 100 Hz: MAVLink.
//!
//! Bytes in, bytes out; the board or the host only carries them, through [`port`]: a pair of rings for each link. A
//! `link` has its own parser, answers and rates: `parser` finds frames, `incoming` decodes messages, `command` carries
//! out commands, `place` those that carry places on Earth, `goal` those that send it somewhere, `params` serves the settings, `services` answers for what
//! there is not, `setpoint` reads those of companion computers, `sticks` reads those of ground stations, `radio` says which of its channels they are, `mode` encodes modes as PX4 does, `text` sends texts to pilots, `telemetry` schedules and fills in the
//! messages about the vehicle, of which [`report`] tells the part that is gathered for it, `outbox` keeps what is still to
//! be said, and `writer` encodes messages. NED/FRD is converted in `frames` only.
//!
//! ```
//! use firmware::autopilot::Autopilot;
//! use firmware::config::FlightConfig;
//! use firmware::mavlink::port::Profile;
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
//! autopilot.ports.first().open(Profile::Normal);
//! autopilot.ports.first().receive(frame.raw_bytes());
//! let mut sent = Vec::new();
//! for _ in 0..100 {
//!     autopilot.tick(Some(&SensorFrame::Motion(NavState::at_rest())));
//!     sent.extend_from_slice(autopilot.ports.first().take(&mut [0; 2048]));
//! }
//! // Frames start with 0xfd, and carry the message's number in bytes 7 to 9.
//! let has = |id: u32| sent.windows(10).any(|w| w[0] == 0xfd && w[7..10] == id.to_le_bytes()[..3]);
//! assert!(has(COMMAND_ACK_DATA::ID) && has(AUTOPILOT_VERSION_DATA::ID));
//! ```

mod command;
mod goal;
mod incoming;
mod link;
mod mode;
mod outbox;
mod params;
mod parser;
mod place;
pub mod port;
mod radio;
pub mod report;
mod services;
mod setpoint;
mod sticks;
mod telemetry;
#[cfg(test)]
mod tests;
mod text;
mod writer;

use nalgebra::Vector3;

use self::link::{Job, Link};
use self::port::{LINKS, Ports};
use self::report::{ControlReport, SensorReport};
use self::sticks::{Hands, Source};
use self::telemetry::View;
use crate::commander::{Answers, Commands, Events, Mode, Request};
use crate::estimator::status::Status;
use crate::failure::{Failures, Injectable};
use crate::frames::Origin as MapOrigin;
use crate::latest::Latest;
use crate::schedule::{COMMANDER, GROUND};
use crate::sensors::BatterySample;
use crate::settings::{Changes, Marks, Settings};
use crate::signals::{NavState, Tick};
use crate::watchdog::Hung;

/// MAVLink component: the autopilot.
pub const COMPONENT_ID: u8 = 1;

/// Who the vehicle is on its links, as the settings say at the start.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Identity {
    /// MAVLink system.
    pub system: u8,
    /// `MAV_AUTOPILOT`.
    pub autopilot: u8,
}

impl Identity {
    fn of(settings: &Settings) -> Self {
        Self { system: settings.system_id(), autopilot: settings.autopilot() }
    }
}

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
    /// Jobs of the outer, commander and ground partitions that overran since boot.
    pub overruns: [u32; 3],
    /// Which partitions hang.
    pub hung: Hung,
    /// Rates of the loops, if the board measures them.
    pub timing: Option<LoopTiming>,
}

/// Snapshot for the ground partition.
#[derive(Clone, Debug, PartialEq)]
#[expect(clippy::struct_excessive_bools, reason = "independent facts about the vehicle")]
pub struct GroundInput {
    /// The motion at the release.
    pub nav: NavState,
    /// Whether the rotors may turn.
    pub armed: bool,
    /// The mode that pilots see.
    pub mode: Mode,
    /// Whether the vehicle is on the ground.
    pub landed: bool,
    /// z of the ground where it was armed, or has landed since, m.
    pub ground_m: f32,
    /// Whether an arm request would be accepted.
    pub armable: bool,
    /// Health of the firmware itself.
    pub health: Health,
    /// The estimator's report; `None` on ideal state.
    pub estimator: Option<Status>,
    /// The control loops.
    pub control: ControlReport,
    /// The sensors; `None` on ideal state.
    pub sensors: Option<SensorReport>,
    /// Where a return leads, m; `None` while that is unknown.
    pub home: Option<Vector3<f32>>,
    /// Failures that the board can inject.
    pub injectable: Injectable,
    /// Whether all partitions have taken over the last changes of settings.
    pub changes_taken: bool,
    /// Replies of the commander since the last job.
    pub replies: Answers,
    /// Failsafe events since the last job.
    pub events: Events,
}

impl GroundInput {
    /// The last sample of the battery monitor, unless it is old.
    fn battery(&self) -> Option<BatterySample> {
        self.estimator.as_ref().filter(|status| status.battery.healthy)?.battery_sample
    }

    /// Where GNSS has found the local frame's origin to be.
    fn origin(&self) -> Option<MapOrigin> {
        self.estimator.as_ref()?.origin
    }
}

/// Output of the ground partition.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct GroundOutput {
    /// For the commander.
    pub commands: Commands,
    /// Whether a ground station stops the rotors now. No entry of a queue: it is never lost, and acts first.
    pub kill: bool,
    /// Whether it terminates the flight: a kill, after which the vehicle is not armed again.
    pub terminate: bool,
    /// Whether it restarts the vehicle.
    pub restart: bool,
    /// Accepted failure injections, for the board.
    pub failures: Failures,
    /// Sticks, and when a ground station was last heard.
    pub latest: Latest,
    /// Settings that the other partitions are to take over.
    pub changes: Changes,
}

/// Commands that one job passes to the commander, which takes four a job and runs half as often.
const COMMANDS_A_JOB: usize = 2;

/// An arming that was passed on is seen after this time at the latest, ticks, if it was accepted: it is published, decided
/// in the commander's next job, takes effect, and comes with the next snapshot.
const ARMING_SEEN_AFTER: Tick = GROUND.offset + COMMANDER.period + COMMANDER.offset + GROUND.period;

/// The ground partition.
#[derive(Clone, Debug)]
pub struct Ground {
    us: Identity,
    links: [Link; LINKS],
    /// The link whose commands are passed on first, so that none is served before the others for ever.
    first: usize,
    settings: Settings,
    /// An origin of the local frame that a ground station has set; GNSS overrules it.
    set_origin: Option<MapOrigin>,
    /// What was read last, on whatever link.
    latest: Latest,
    /// From whom sticks come.
    hands: Hands,
    /// From whom set-points come.
    leader: Option<Source>,
    /// When an arming was last passed on: until it is seen what became of it, the vehicle counts as armed.
    arming_at: Option<Tick>,
}

impl Default for Ground {
    fn default() -> Self {
        Self::new(Settings::default())
    }
}

impl Ground {
    /// The owner of these settings.
    pub fn new(settings: Settings) -> Self {
        Self {
            us: Identity::of(&settings),
            links: Default::default(),
            first: 0,
            settings,
            set_origin: None,
            latest: Latest::default(),
            hands: Hands::default(),
            leader: None,
            arming_at: None,
        }
    }

    /// The settings, for whoever saves them.
    pub fn settings_mut(&mut self) -> &mut Settings {
        &mut self.settings
    }

    /// The settings.
    pub fn settings(&self) -> &Settings {
        &self.settings
    }

    /// One job, released at `released`: reads from the links that are open, and writes to them.
    pub fn step(&mut self, released: Tick, input: &GroundInput, ports: &Ports) -> GroundOutput {
        let (mut output, mut changed) = (GroundOutput::default(), Marks::default());
        let view = View::new(released, input, self.us, &self.settings, self.set_origin.as_ref());
        self.latest.forget_old(released);
        self.hands.forget_old(released);
        let view = View { latest: self.latest, ..view }.with_channels(&self.hands);
        let origin_before = self.set_origin;
        self.arming_at = self.arming_at.filter(|at| released.wrapping_sub(*at) <= ARMING_SEEN_AFTER);
        // Also while an arming waits for settings: who keeps on setting some would keep the others from arming.
        let arms = self.arming_at.is_some() || self.links.iter().any(Link::has_arming_waiting);
        let armed = input.armed || arms;
        for ((number, link), port) in (0..).zip(&mut self.links).zip(ports) {
            let Some((session, profile)) = port.session() else { continue };
            link.begin(session, profile, released, port);
            let (settings, changed) = (&mut self.settings, &mut changed);
            let (set_origin, latest, hands) = (&mut self.set_origin, &mut self.latest, &mut self.hands);
            let leader = &mut self.leader;
            let output = &mut output;
            link.read(
                number,
                port,
                &mut Job { view, settings, changed, set_origin, latest, hands, leader, armed, output },
            );
        }
        while let Some(index) = changed.first() {
            changed.clear(index);
            self.links.iter_mut().for_each(|link| link.announce(index));
        }
        if output.kill {
            self.links.iter_mut().for_each(Link::refuse_waiting);
        }
        if input.changes_taken {
            output.changes = self.settings.take_changes();
        }
        // What can be set while disarmed only is in effect before an arming that is asked for after it.
        self.pass_on_commands(released, input.armed || self.settings.are_settled(), &mut output);
        if output.commands.iter().any(|command| matches!(command.request, Request::Arm { .. })) {
            self.arming_at = Some(released);
        }
        for reply in &input.replies {
            if let Some(link) = self.links.get_mut(usize::from(reply.link)) {
                link.reply(reply);
            }
        }
        output.latest = self.latest;
        let view = if self.set_origin == origin_before {
            view
        } else {
            View::new(released, input, self.us, &self.settings, self.set_origin.as_ref())
        };
        let view = View { latest: self.latest, ..view }.with_channels(&self.hands);
        for (link, port) in self.links.iter_mut().zip(ports) {
            if port.session().is_some() {
                input.events.iter().for_each(|event| link.report(*event));
                link.write(&view, &self.settings, port);
            }
        }
        output
    }

    /// Takes commands from the links in turn.
    fn pass_on_commands(&mut self, now: Tick, settled: bool, output: &mut GroundOutput) {
        for _ in 0..LINKS * COMMANDS_A_JOB {
            if output.commands.len() == COMMANDS_A_JOB {
                return;
            }
            let command = self.links.get_mut(self.first).and_then(|link| link.next_command(now, settled));
            self.first = (self.first + 1) % LINKS;
            if let Some(command) = command {
                // Fits: fewer than the queue holds.
                let _ = output.commands.push(command);
            }
        }
    }
}

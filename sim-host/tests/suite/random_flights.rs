//! Flights by sticks and by set-points that a random generator moves, from end to end of their ranges, judged by the truth:
//! no limit is exceeded, nothing tips over, nothing falls, and what is let go stands still and lands.
//!
//! `GLISSADE_FLIGHTS` is how many of each kind are flown; `tests/run --full` flies 1,000. `GLISSADE_SEED` flies one alone.

use std::sync::atomic::{AtomicU64, Ordering};
use std::thread;

use firmware::commander::Mode;
use firmware::config::FlightConfig;
use glissade_dialect::{COMMAND_INT_DATA, MavCmd, SET_ATTITUDE_TARGET_DATA, SET_POSITION_TARGET_LOCAL_NED_DATA};
use rand::RngExt as _;
use sim_host::flight;
use sim_host::record::{Activity, Recorder, Row};
use sim_host::scenario::Scenario;
use sim_host::sil::Lockstep as _;

use crate::common::by_bytes::{ACRO, ALTITUDE, AUTO, Bytes, CENTRED, DOWN, HOLD, LAND, OFFBOARD, POSITION, STABILIZED};
use crate::common::load::load;

/// A field with gusts, its sensors, and a vehicle that stands on it.
fn standing() -> Scenario {
    // Yaw with the throttle down would disarm it.
    load("field", &["params.MAN_ARM_GESTURE=0"])
}

/// The same vehicle, on ideal state, so high that no tumble ends on the ground.
fn high(acro_deg_s: f64) -> Scenario {
    let wind = "wind={mean_m_s=[-1.6,1.2,0.0],turbulence_20ft_m_s=5.0}";
    let acro = ["R", "P"].map(|axis| format!("params.MC_ACRO_{axis}_MAX={acro_deg_s}"));
    let place = ["start_position_m=[0,0,500]", "trajectory.hold.position_m=[0,0,500]"];
    load("x500-hover", &[place[0], place[1], wind, "duration_s=100", &acro[0], &acro[1]])
}

/// What is true of a flight, in what it was told to do.
struct Watch {
    limits: FlightConfig,
    row: Row,
    mode: Mode,
    armed: bool,
    /// Since when it is in the mode, s, and what has been within its limit since.
    since_s: f64,
    caught: [bool; 5],
    /// The first thing that must not be.
    wrong: Option<String>,
    /// Whether it is told attitudes, which have no limits.
    free: bool,
}

/// What a mode begins with, like a tilt, acts for this time, s. Then a motion that is within the mode's limits stays within
/// them; one that is not comes to be so until the later time: a fall at 60 m/s is stopped with 3 m/s².
const BEGUN_S: f64 = 2.0;
const SETTLED_S: f64 = 30.0;

/// What has limits.
#[derive(Clone, Copy)]
enum Limited {
    Tilt,
    Rates,
    Speed,
    Climb,
    Sink,
}

impl Watch {
    fn new(scenario: &Scenario) -> Self {
        Self {
            limits: scenario.flight_config(),
            row: Row::default(),
            mode: Mode::Disarmed,
            armed: false,
            since_s: 0.0,
            caught: [false; 5],
            wrong: None,
            free: !scenario.file.ground,
        }
    }

    fn tilt_deg(&self) -> f64 {
        let [_, x, y, _] = self.row.attitude;
        (1.0 - 2.0 * (x * x + y * y)).clamp(-1.0, 1.0).acos().to_degrees()
    }

    fn speed(&self) -> f64 {
        self.row.velocity[0].hypot(self.row.velocity[1])
    }

    fn stands(&self) -> bool {
        self.speed() < 0.8 && self.row.velocity[2].abs() < 0.5 && self.tilt_deg() < 12.0
    }

    fn at_most(&mut self, what: &str, value: f64, most: f64) {
        if (value > most || value.is_nan()) && self.wrong.is_none() {
            self.wrong = Some(format!("{:.2} s, {:?}: {what} {value:.2}, at most {most:.2}", self.row.t, self.mode));
        }
    }

    fn keeps(&mut self, limited: Limited, value: f64, most: f64) {
        let caught = &mut self.caught[limited as usize];
        let since_s = self.row.t - self.since_s;
        *caught |= (since_s > BEGUN_S && value <= most) || since_s > SETTLED_S;
        if *caught {
            let what = ["tilt, °,", "body rates, °/s,", "speed, m/s,", "climb, m/s,", "sink, m/s,"][limited as usize];
            self.at_most(what, value, most);
        }
    }

    /// What the mode promises, with room for gusts (2 m/s) and for the estimate's error.
    fn judge(&mut self) {
        let Self { limits: FlightConfig { modes, manual, tilt_max_rad, .. }, row, .. } = *self;
        let degrees = |rad: f32| f64::from(rad).to_degrees();
        let [climb, sink] = [modes.climb_m_s, modes.sink_m_s].map(f64::from);
        let rates = row.rates.iter().fold(0.0_f64, |most, rate| most.max(rate.abs())).to_degrees();
        let (tilt, speed, up) = (self.tilt_deg(), self.speed(), row.velocity[2]);
        let all = row.position.iter().chain(&row.velocity).chain(&row.attitude).chain(&row.rates);
        self.at_most("numbers that are none", all.filter(|value| !value.is_finite()).count() as f64, 0.0);
        let is_low = row.position[2] < 0.1 && !matches!(self.mode, Mode::Stabilized | Mode::Acro) && !self.free;
        self.at_most("tilt near the ground, °,", if is_low { tilt } else { 0.0 }, 35.0);
        match self.mode {
            Mode::Disarmed | Mode::Idle => self.at_most("tilt on the ground, °,", tilt, 12.0),
            Mode::Acro => {
                let most = manual.acro_rates_rad_s.iter().fold(0.0_f32, |most, rate| most.max(*rate));
                self.keeps(Limited::Rates, rates, 1.15 * degrees(most) + 5.0);
            }
            Mode::Stabilized => self.keeps(Limited::Tilt, tilt, degrees(manual.tilt_max_rad) + 5.0),
            Mode::Altitude => {
                self.keeps(Limited::Tilt, tilt, degrees(manual.tilt_max_rad) + 5.0);
                self.keeps(Limited::Climb, up, climb + 0.6);
                self.keeps(Limited::Sink, -up, sink + 0.6);
            }
            Mode::Position => {
                self.keeps(Limited::Tilt, tilt, degrees(tilt_max_rad) + 5.0);
                self.keeps(Limited::Speed, speed, f64::from(manual.speed_m_s) + 1.0);
                self.keeps(Limited::Climb, up, climb + 0.6);
                self.keeps(Limited::Sink, -up, sink + 0.6);
            }
            // What is streamed as an attitude has no limits.
            Mode::Offboard if !self.free => {
                self.keeps(Limited::Tilt, tilt, degrees(tilt_max_rad) + 5.0);
                self.keeps(Limited::Speed, speed, 1.02 * f64::from(modes.fastest_m_s) + 1.0);
                self.keeps(Limited::Climb, up, 1.02 * climb + 0.6);
                self.keeps(Limited::Sink, -up, 1.02 * sink + 0.6);
            }
            _ => {}
        }
    }
}

impl Recorder for Watch {
    fn record(&mut self, row: &Row) {
        self.row = *row;
    }

    fn observe(&mut self, activity: &Activity) {
        let mode = activity.commander.mode;
        if mode != self.mode {
            (self.since_s, self.caught) = (self.row.t, [false; 5]);
        }
        (self.mode, self.armed) = (mode, activity.commander.armed);
        self.judge();
    }

    fn stops(&self) -> bool {
        self.wrong.is_some()
    }
}

/// What has to be true at a time, s.
type Checks = Vec<(f64, &'static str, fn(&Watch) -> bool)>;

/// A plan: what is sent, and what has to be true when.
struct Plan {
    bytes: Bytes,
    checks: Checks,
}

impl Plan {
    fn new(seed: u64) -> Self {
        Self { bytes: Bytes::new(seed), checks: Vec::new() }
    }

    /// At the end of what is planned so far.
    fn check(&mut self, what: &'static str, is_so: fn(&Watch) -> bool) {
        self.checks.push((f64::from(self.bytes.now) * 1e-3, what, is_so));
    }

    fn fly(self, scenario: &Scenario, seed: u64) -> Result<(), String> {
        let scenario = Scenario { replay: Some(self.bytes.into_entries().into()), ..scenario.clone() };
        let mut flight = flight::lockstep(&scenario, seed, flight::rigid_body(&scenario, seed)).expect("flies");
        let mut watch = Watch::new(&scenario);
        for (at_s, what, is_so) in self.checks {
            while f64::from(flight.next_tick()) * 1e-3 < at_s {
                let goes_on = flight.step(&mut watch);
                if let Some(wrong) = watch.wrong {
                    return Err(wrong);
                }
                if !goes_on {
                    return Err(format!("{:.2} s, {:?}: {:?}", watch.row.t, watch.mode, flight.outcome().end));
                }
            }
            if !is_so(&watch) {
                let Row { position, velocity, .. } = watch.row;
                let tilt = watch.tilt_deg();
                return Err(format!(
                    "{at_s:.2} s, {:?}: not {what}: {position:.2?} {velocity:.2?} {tilt:.1}°",
                    watch.mode
                ));
            }
        }
        Ok(())
    }
}

/// Flies a plan for many seeds, on all threads.
fn fly_all(scenario: &Scenario, plan: impl Fn(u64) -> Plan + Sync) {
    let number = |name: &str| std::env::var(name).ok().map(|text| text.parse::<u64>().expect("a number"));
    let alone = number("GLISSADE_SEED");
    let count = alone.or(number("GLISSADE_FLIGHTS")).unwrap_or(12);
    let next = AtomicU64::new(alone.unwrap_or(1));
    let fly = || {
        let mut failed = Vec::new();
        loop {
            let seed = next.fetch_add(1, Ordering::Relaxed);
            if seed > count {
                return failed;
            }
            if let Err(wrong) = plan(seed).fly(scenario, seed) {
                failed.push((seed, wrong));
            }
        }
    };
    let threads = thread::available_parallelism().map_or(1, usize::from);
    let mut failed: Vec<_> = thread::scope(|scope| {
        let flying: Vec<_> = (0..threads).map(|_| scope.spawn(fly)).collect();
        flying.into_iter().flat_map(|thread| thread.join().expect("a panic")).collect()
    });
    failed.sort();
    let lines: Vec<String> = failed.iter().take(40).map(|(seed, wrong)| format!("seed {seed}: {wrong}")).collect();
    assert!(failed.is_empty(), "{} of {count}:\n{}", failed.len(), lines.join("\n"));
}

/// Of main mode `number`: on the ground, tilted and turned by the sticks, with the throttle up to `most`.
fn on_the_ground(seed: u64, number: f32, most: f64) -> Plan {
    let mut plan = Plan::new(seed);
    let bytes = &mut plan.bytes;
    bytes.wait(4.0);
    bytes.sticks(0.5, DOWN);
    bytes.mode(number, 0.0);
    bytes.sticks(0.5, DOWN);
    bytes.arm();
    bytes.sticks(1.5, DOWN);
    plan.check("armed", |watch| watch.armed);
    plan.bytes.stir(4.0, -1.0..most);
    plan.bytes.sticks(0.5, DOWN);
    plan.check("on the ground", |watch| watch.row.position[2] < 0.3);
    plan
}

#[test]
fn what_stands_does_not_tip_over_whatever_the_sticks_do() {
    // Nearly what lifts it: to nine tenths of the weight, or the stick below its middle.
    for (number, most) in [(STABILIZED, -0.1), (ACRO, -0.1), (ALTITUDE, -0.05), (POSITION, -0.05)] {
        fly_all(&standing(), |seed| on_the_ground(seed, number, most));
    }
}

/// Stops, and lands by stick.
fn let_go(plan: &mut Plan, stop_s: f64) {
    plan.bytes.mode(POSITION, 0.0);
    plan.bytes.sticks(stop_s, CENTRED);
    plan.check("standing", Watch::stands);
    plan.bytes.sticks(100.0, DOWN);
    plan.check("landed", |watch| !watch.armed && watch.stands());
}

#[test]
fn position_mode_keeps_its_limits_and_lands() {
    fly_all(&standing(), |seed| {
        let mut plan = on_the_ground(seed, POSITION, -0.05);
        plan.bytes.sticks(5.0, [0.0, 0.0, 1.0, 0.0]);
        plan.check("in the air", |watch| watch.row.position[2] > 2.0);
        plan.bytes.stir(25.0, -1.0..1.0);
        let_go(&mut plan, 10.0);
        plan
    });
}

#[test]
fn altitude_mode_keeps_its_limits() {
    fly_all(&standing(), |seed| {
        let mut plan = on_the_ground(seed, ALTITUDE, -0.05);
        plan.bytes.sticks(12.0, [0.0, 0.0, 1.0, 0.0]);
        plan.check("in the air", |watch| watch.row.position[2] > 10.0);
        plan.bytes.stir(20.0, -0.4..1.0);
        let_go(&mut plan, 15.0);
        plan
    });
}

/// A pilot who has the thrust in hand comes down with drift, and faster than a program would.
#[test]
fn landings_in_stabilized_mode_do_not_tip_over() {
    fly_all(&standing(), |seed| {
        let mut plan = on_the_ground(seed, STABILIZED, -0.8);
        let bytes = &mut plan.bytes;
        let mut range = |low: f64, high: f64| bytes.random.random_range(low..high);
        let (rises, drifts) = (range(0.25, 0.4), [range(-0.3, 0.3), range(-0.3, 0.3)]);
        let (falls, turns) = (range(-0.2, -0.06), range(-1.0, 1.0));
        bytes.sticks(1.5, [0.0, 0.0, rises, 0.0]);
        plan.check("in the air", |watch| watch.row.position[2] > 0.5);
        plan.bytes.sticks(1.0, [drifts[0], drifts[1], -0.5 * rises, 0.0]);
        plan.bytes.sticks(4.0, [0.0, 0.0, falls, turns]);
        plan.bytes.sticks(2.0, [0.3 * drifts[1], 0.0, falls, 0.0]);
        plan.bytes.sticks(12.0, DOWN);
        plan.check("landed", |watch| !watch.armed && watch.stands());
        plan
    });
}

#[test]
fn stabilized_and_acro_mode_keep_their_limits_and_are_caught_again() {
    // Acro as it is set, and as it is flown.
    for (number, acro_deg_s) in [(STABILIZED, 100.0), (ACRO, 100.0), (ACRO, 720.0)] {
        fly_all(&high(acro_deg_s), |seed| {
            let mut plan = Plan::new(seed);
            plan.bytes.wait(4.0);
            plan.bytes.sticks(0.5, CENTRED);
            plan.bytes.mode(number, 0.0);
            plan.bytes.stir(8.0, -1.0..1.0);
            plan.bytes.mode(POSITION, 0.0);
            plan.bytes.sticks(45.0, CENTRED);
            plan.check("standing", Watch::stands);
            plan
        });
    }
}

/// Armed, and told to take off, a time ago.
fn taken_off(seed: u64, height_m: f32, ago_s: f64) -> Plan {
    let mut plan = Plan::new(seed);
    plan.bytes.wait(4.0);
    plan.bytes.arm();
    plan.bytes.wait(0.3);
    plan.bytes.take_off(height_m);
    plan.bytes.wait(ago_s);
    plan
}

/// Up in the air, in offboard mode.
fn offboard(seed: u64, height_m: f32) -> Plan {
    let mut plan = taken_off(seed, height_m, 4.0 + f64::from(height_m));
    let bytes = &mut plan.bytes;
    let still = SET_POSITION_TARGET_LOCAL_NED_DATA { z: -height_m, type_mask: 0b111 << 6, ..Default::default() };
    bytes.stream(0.5, |_| still.clone());
    bytes.mode(OFFBOARD, 0.0);
    bytes.stream(1.0, |_| still.clone());
    plan.check("in offboard mode", |watch| watch.mode == Mode::Offboard);
    plan
}

#[test]
fn set_points_at_random_are_flown_within_the_limits() {
    fly_all(&standing(), |seed| {
        let mut plan = offboard(seed, 60.0);
        plan.bytes.scatter(30.0);
        plan.bytes.mode(AUTO, HOLD);
        plan.bytes.wait(12.0);
        plan.check("standing", Watch::stands);
        plan
    });
}

/// Places below the ground, and speeds that lead there, with some drift.
#[test]
fn set_points_below_the_ground_lead_to_it_gently() {
    fly_all(&standing(), |seed| {
        let mut plan = offboard(seed, 5.0);
        let mut range = |low: f32, high: f32| plan.bytes.random.random_range(low..high);
        let (x, y, z) = (range(-2.0, 2.0), range(-2.0, 2.0), range(0.3, 10.0));
        let (vx, vy, vz) = (range(-0.5, 0.5), range(-0.5, 0.5), range(0.3, 3.0));
        let type_mask = [0b1111_1100_0000, 0b1001_1111_1000, 0b1111_1100_0111][range(0.0, 3.0) as usize];
        let below = SET_POSITION_TARGET_LOCAL_NED_DATA { x, y, z, vx, vy, vz, type_mask, ..Default::default() };
        plan.bytes.stream(25.0, |_| below.clone());
        plan.check("on the ground", |watch| matches!(watch.mode, Mode::Idle | Mode::Disarmed) && watch.stands());
        plan
    });
}

/// What may be asked for anywhere, and leads nowhere near the ground by itself.
const ANYWHERE: [MavCmd; 4] = [
    MavCmd::MAV_CMD_DO_SET_MODE,
    MavCmd::MAV_CMD_DO_REPOSITION,
    MavCmd::MAV_CMD_DO_ORBIT,
    MavCmd::MAV_CMD_NAV_RETURN_TO_LAUNCH,
];

/// A landing that is broken off at the last moment, at any height, once or several times.
#[test]
fn a_landing_that_is_broken_off_ends_in_the_air_or_standing() {
    fly_all(&standing(), |seed| {
        let mut plan = taken_off(seed, 2.0, 7.0);
        let bytes = &mut plan.bytes;
        for _ in 0..bytes.random.random_range(1..4) {
            bytes.mode(AUTO, LAND);
            let lasts = bytes.random.random_range(2.0..6.5);
            bytes.wait(lasts);
            let order = ANYWHERE[bytes.random.random_range(0..ANYWHERE.len())];
            let hold = [1.0, AUTO, HOLD, 0.0];
            let open = [f32::NAN; 4];
            bytes.command(order, if order == MavCmd::MAV_CMD_DO_SET_MODE { hold } else { open });
            let lasts = bytes.random.random_range(1.0..5.0);
            bytes.wait(lasts);
        }
        bytes.mode(AUTO, LAND);
        bytes.wait(40.0);
        plan.check("standing", |watch| watch.stands() && !watch.armed);
        plan
    });
}

/// A place below the ground, by a height over home or above the sea, as many a script has it.
#[test]
fn a_place_or_a_circle_below_the_ground_leads_to_it_gently() {
    fly_all(&standing(), |seed| {
        let mut plan = taken_off(seed, 5.0, 10.0);
        let bytes = &mut plan.bytes;
        let mut range = |low: f32, high: f32| bytes.random.random_range(low..high);
        // MAV_FRAME_GLOBAL_RELATIVE_ALT, MAV_FRAME_GLOBAL.
        let (relative, above_sea) = (3, 0);
        let (frame, height) = [(relative, range(-50.0, 0.1)), (above_sea, range(0.0, 480.0))][range(0.0, 2.0) as usize];
        let circles = range(0.0, 3.0) > 2.0;
        let command = if circles { MavCmd::MAV_CMD_DO_ORBIT } else { MavCmd::MAV_CMD_DO_REPOSITION } as u16;
        let [param1, param2, param4] = if circles { [5.0, 2.0, 0.0] } else { [-1.0, 1.0, f32::NAN] };
        let (x, y, z, target_system) = (i32::MAX, i32::MAX, height, 1);
        let open = COMMAND_INT_DATA { x, y, z, target_system, ..Default::default() };
        bytes.send(&COMMAND_INT_DATA { command, frame, param1, param2, param4, ..open });
        bytes.wait(35.0);
        plan.check("standing", |watch| watch.stands() && !watch.armed);
        plan
    });
}

/// A stream that ends while the vehicle sinks near the ground.
#[test]
fn a_stream_that_is_lost_near_the_ground_ends_in_the_air_or_standing() {
    fly_all(&standing(), |seed| {
        let mut plan = offboard(seed, 4.0);
        let sinking = |sink: f32| SET_POSITION_TARGET_LOCAL_NED_DATA {
            vz: sink,
            type_mask: 0b1001_1100_0111,
            ..Default::default()
        };
        let (sink, lasts) = (plan.bytes.random.random_range(0.5..1.5_f32), plan.bytes.random.random_range(0.5..1.0));
        plan.bytes.stream(lasts * 4.0 / f64::from(sink), |_| sinking(sink));
        plan.bytes.wait(6.0);
        plan.check("standing", Watch::stands);
        plan.bytes.mode(AUTO, LAND);
        plan.bytes.wait(25.0);
        plan.check("landed", |watch| watch.stands() && !watch.armed);
        plan
    });
}

#[test]
fn attitudes_and_rates_at_random_are_flown_and_caught_again() {
    fly_all(&high(100.0), |seed| {
        let mut plan = Plan::new(seed);
        let bytes = &mut plan.bytes;
        bytes.wait(4.0);
        let level =
            SET_ATTITUDE_TARGET_DATA { q: [1.0, 0.0, 0.0, 0.0], thrust: 0.5, type_mask: 7, ..Default::default() };
        bytes.attitude(0.5, &level);
        bytes.mode(OFFBOARD, 0.0);
        for _ in 0..8 {
            let mut range = |most: f32| bytes.random.random_range(-most..most);
            let q = nalgebra::UnitQuaternion::from_euler_angles(range(1.5), range(1.5), range(3.1));
            let message = SET_ATTITUDE_TARGET_DATA {
                q: [q.w, q.i, q.j, q.k],
                body_roll_rate: range(4.0),
                body_pitch_rate: range(4.0),
                body_yaw_rate: range(2.0),
                thrust: 0.5 + range(0.5),
                type_mask: [7, 128, 0][bytes.random.random_range(0..3)],
                ..SET_ATTITUDE_TARGET_DATA::DEFAULT
            };
            let lasts = bytes.random.random_range(0.3..1.5);
            bytes.attitude(lasts, &message);
        }
        bytes.mode(AUTO, HOLD);
        bytes.wait(45.0);
        plan.check("standing", Watch::stands);
        plan
    });
}

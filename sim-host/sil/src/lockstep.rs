//! Software in the loop: the firmware and a plant in lockstep, one tick after the other.
//!
//! Lockstep is a function call. At tick k the firmware gets the motion at t = k ms, or what sensors have made of it, and
//! its motor command acts on the plant from t to t + 1 ms. Nothing here allocates, and nothing depends on the clock on the wall.

use anyhow::{Context as _, Result, ensure};
use firmware::autopilot::Autopilot;
use firmware::commander::Asked;
use firmware::control::attitude::SlidingAttitude;
use firmware::control::law::{AttitudeLaw, PositionLaw};
use firmware::control::position::SlidingPosition;
use firmware::failure::{Failures, Injectable, Manner};
use firmware::guidance::Trajectory;
use firmware::inner::InnerOutput;
use firmware::navigator::Navigator;
use firmware::outer::OuterOutput;
use firmware::pil::AllSent;
use firmware::schedule::OUTER;
use firmware::signals::{MotorCommand, SensorFrame, TICK_S_EXACT, TICK_US, Tick};
use nalgebra::{UnitQuaternion, Vector3};

use crate::angles::roll_pitch_yaw;
use crate::delay::Delay;
use crate::failures::{self, Equipment};
use crate::noise::{Disturbed, Noise};
use crate::outcome::{End, Outcome};
use crate::pilot::Pilot;
use crate::plant::{Motion, Plant};
use crate::record::{Activity, Navigation, Recorder, Row, Seen};
use crate::reference;
use crate::replay::{Entry, Input, Replay};
use crate::restart::Restart;
use crate::sensors::faults::Kind;
use crate::sensors::{BatteryTruth, Fault, FaultId, Suite, Truth};
use crate::weather::Weather;

/// A simulation that advances by ticks of 1 ms, each in two halves with a look between them: what is recorded of a tick
/// is what the firmware saw, before its command acts.
pub trait Lockstep {
    /// First half: sense and control.
    fn control(&mut self);

    /// What the tick shows, between its halves, with a judgement: whether the vehicle is lost is decided where somebody
    /// looks.
    fn look(&mut self) -> Seen<'_>;

    /// Second half: the motor command acts on the plant for 1 ms. Returns false once a look has shown that the vehicle is
    /// lost, or the flight is ended; a driver then stops.
    fn act(&mut self) -> bool;

    /// Ends the flight as the user's wish, unless it has ended before.
    fn interrupt(&mut self);

    /// How the flight has gone so far.
    fn outcome(&self) -> Outcome;

    /// One tick, recorded. Returns false once the vehicle is lost.
    #[inline]
    fn step<R: Recorder>(&mut self, recorder: &mut R) -> bool {
        self.control();
        if !R::ENABLED {
            return self.act();
        }
        self.look().show(recorder);
        let goes_on = self.act();
        if goes_on && recorder.stops() {
            self.interrupt();
            return false;
        }
        goes_on
    }

    /// Flies `ticks` ticks, or until the vehicle is lost. Without a recorder, whether it was is seen at the end.
    fn run<R: Recorder>(&mut self, ticks: u32, recorder: &mut R) -> Outcome {
        for _ in 0..ticks {
            if !self.step(recorder) {
                break;
            }
        }
        self.look();
        self.outcome()
    }
}

/// A plant with the firmware in its loop, and the control laws that it flies by. On a cache line of its own: where a
/// stack happens to begin would otherwise decide a fifth of the speed.
#[derive(Clone, Debug)]
#[repr(align(64))]
pub struct Flight<P, A = SlidingAttitude, L = SlidingPosition> {
    /// The firmware.
    pub autopilot: Autopilot<A, L>,
    plant: P,
    noise: Noise,
    trajectory: Trajectory,
    tick: u32,
    outcome: Outcome,
    /// Large and rarely used: elsewhere, so that the rest stays together.
    delay: Option<Box<Delay>>,
    weather: Option<Box<Weather>>,
    sensors: Option<Box<Suite>>,
    pilot: Option<Box<Pilot>>,
    replay: Option<Box<Replay>>,
    restart: Option<Box<Restart<A, L>>>,
}

impl<P: Plant, A: AttitudeLaw, L: PositionLaw> Flight<P, A, L> {
    /// Before the first tick.
    pub fn new(autopilot: Autopilot<A, L>, plant: P, noise: Noise, trajectory: Trajectory) -> Self {
        Self {
            autopilot,
            plant,
            noise,
            trajectory,
            tick: 0,
            outcome: Outcome::default(),
            delay: None,
            weather: None,
            sensors: None,
            pilot: None,
            replay: None,
            restart: None,
        }
    }

    /// With motor commands that act `ticks` later, at most [`DELAY_TICKS_MAX`](crate::DELAY_TICKS_MAX); until the first
    /// of them does, the rotors keep their speeds.
    #[must_use]
    pub fn with_actuation_delay(mut self, ticks: usize) -> Self {
        self.delay = (ticks > 0).then(|| Box::new(Delay::new(ticks, self.plant.omega())));
        self
    }

    /// With firmware that a ground station can restart. Its clock goes on, and its links stay open.
    #[must_use]
    pub fn with_restart(mut self, restart: Restart<A, L>) -> Self {
        self.restart = Some(Box::new(restart));
        self
    }

    /// In a weather, which is asked for every tick.
    #[must_use]
    pub fn with_weather(mut self, weather: Option<Weather>) -> Self {
        self.weather = weather.map(Box::new);
        self
    }

    /// On sensors, which are asked every tick, in place of ideal ones.
    #[must_use]
    pub fn with_sensors(mut self, sensors: Option<Suite>) -> Self {
        self.sensors = sensors.map(Box::new);
        self
    }

    /// With a pilot.
    #[must_use]
    pub fn with_pilot(mut self, pilot: Option<Pilot>) -> Self {
        self.pilot = pilot.map(Box::new);
        self
    }

    /// With what came from outside in an earlier flight. The failures of ground stations are injected.
    #[must_use]
    pub fn with_replay(mut self, replay: Option<Replay>) -> Self {
        if replay.is_some() {
            self.autopilot.inner.allow_failures(self.injectable());
        }
        self.replay = replay.map(Box::new);
        self
    }

    /// The plant.
    pub fn plant(&self) -> &P {
        &self.plant
    }

    /// The plant, to do something to it.
    pub fn plant_mut(&mut self) -> &mut P {
        &mut self.plant
    }

    /// The sensors, if it flies on any.
    pub fn sensors(&self) -> Option<&Suite> {
        self.sensors.as_deref()
    }

    /// What an ideal accelerometer reads now, about the body's axes, m/s². Between two ticks it feels the push of the
    /// tick before.
    pub fn specific_force(&self) -> Vector3<f64> {
        let push = self.weather.as_ref().map_or_else(|| &self.noise.now().push, |weather| weather.now());
        self.plant.specific_force(push)
    }

    /// What the firmware's sensor sees now. To be asked once a tick, before the plant moves.
    #[inline]
    pub fn sense(&mut self) -> SensorFrame {
        let disturbed = self.noise.at(self.tick);
        if self.sensors.is_some() {
            return self.measure();
        }
        sense(&self.plant.motion(), disturbed)
    }

    /// Makes something fail, from now on or later.
    ///
    /// # Errors
    /// In one line, why that cannot be.
    pub fn inject(&mut self, fault: &Fault) -> Result<FaultId> {
        let battery = matches!(fault.kind, Kind::Collapse { .. });
        ensure!(
            !battery || self.plant.battery().is_some(),
            "there is no battery on board: give the scenario `[battery]`"
        );
        self.suite()?.inject(fault)
    }

    /// Puts a valid fault, or none, in place of the one in a slot.
    ///
    /// # Errors
    /// On ideal state.
    pub fn hold_fault(&mut self, slot: usize, fault: Option<&Fault>) -> Result<()> {
        self.suite()?.hold(slot, fault);
        Ok(())
    }

    /// Ends the faults of which this is true, also before they have begun.
    ///
    /// # Errors
    /// On ideal state.
    pub fn clear_faults_where(&mut self, is_over: impl Fn(&Fault) -> bool) -> Result<()> {
        self.suite()?.clear_where(is_over);
        Ok(())
    }

    /// Ends all faults, those to come too.
    ///
    /// # Errors
    /// On ideal state.
    pub fn clear_faults(&mut self) -> Result<()> {
        self.suite()?.clear_all();
        Ok(())
    }

    /// The failures that ground stations may be allowed to inject.
    pub fn injectable(&self) -> Injectable {
        failures::injectable(self.sensors(), self.plant.battery().is_some())
    }

    /// Injects the failures that the last tick has accepted from ground stations, and returns them. To be called once a
    /// tick, if any are allowed.
    pub fn take_failures(&mut self) -> Failures {
        let accepted = self.autopilot.inner.take_failures();
        for failure in &accepted {
            // Failures are allowed on sensors alone, where none of this can fail.
            if failure.manner == Manner::Well {
                // Also what a console or the scenario has made fail: it is said to work again.
                let of = Equipment::of(failure);
                let _ = self.clear_faults_where(|fault| of.has(fault));
            }
            for (slot, fault) in failures::of(failure, self.tick) {
                let _ = self.hold_fault(slot, fault.as_ref());
            }
        }
        accepted
    }

    /// The steady part of the wind, in the world, m/s.
    pub fn steady_wind(&self) -> Vector3<f64> {
        self.weather.as_ref().map_or_else(Vector3::zeros, |weather| weather.steady_wind())
    }

    /// Sets the steady part of the wind from now on (m/s, in the world). Changes no random number of the flight.
    ///
    /// # Errors
    /// A plant on which no wind acts.
    pub fn set_steady_wind(&mut self, mean: Vector3<f64>) -> Result<()> {
        let drag = self.plant.drag().filter(|drag| drag.iter().any(|k| *k > 0.0));
        let drag = drag.context("no wind acts on this vehicle: its airframe has no drag")?;
        self.weather.get_or_insert_with(|| Box::new(Weather::calm(drag))).set_steady_wind(mean);
        Ok(())
    }

    fn suite(&mut self) -> Result<&mut Suite> {
        self.sensors.as_deref_mut().context("nothing fails on ideal state: fly a scenario with `sensors`")
    }

    /// The tick that comes next.
    pub fn next_tick(&self) -> Tick {
        self.tick
    }

    /// What the sensors make of it, after faults have acted on the plant. Out of the way of the flights on ideal state.
    #[cold]
    fn measure(&mut self) -> SensorFrame {
        if let Some(faults) = self.sensors.as_mut().and_then(|suite| suite.tell_plant(self.tick)) {
            self.plant.apply_faults(&faults);
        }
        let (motion, specific_force) = (self.plant.motion(), self.specific_force());
        let battery = self.plant.battery().map_or_else(BatteryTruth::default, |state| BatteryTruth {
            voltage_v: state.voltage_v,
            current_a: state.current_a,
        });
        let (tick, omega) = (self.tick, self.plant.omega());
        let truth = Truth { tick, motion: &motion, specific_force, omega, battery };
        SensorFrame::Measured(self.sensors.as_mut().map(|suite| suite.measure(&truth)).unwrap_or_default())
    }

    /// What the pilot asks of the vehicle at this tick, handed over. To be called once a tick, after
    /// [`sense`](Self::sense).
    #[cold]
    pub fn ask_pilot(&mut self) -> Option<Asked> {
        let vehicle = &mut self.autopilot.inner;
        let armed = vehicle.commander_output().armed;
        let asked = self.pilot.as_mut()?.step(self.tick, vehicle.nav(), armed)?;
        // A full queue drops the request, as a busy vehicle would; the pilot looks again.
        let _ = vehicle.ask(asked);
        Some(asked)
    }

    /// What came from outside before this tick, handed over, after the failures that were accepted in the last one. To be
    /// called once a tick, before [`sense`](Self::sense).
    #[cold]
    pub fn hear_replayed(&mut self) -> &[Entry] {
        if self.replay.is_some() {
            self.take_failures();
        }
        let Some(replay) = self.replay.as_mut() else { return &[] };
        let (due, vehicle) = (replay.due(self.tick), &mut self.autopilot);
        for entry in due {
            match &entry.input {
                Input::Link { link, event } => {
                    if let Some(port) = vehicle.ports.get(*link) {
                        port.take_in(event.event());
                    }
                }
                // A full queue drops the request, as it did before.
                Input::Ask(asked) => drop(vehicle.inner.ask(*asked)),
            }
        }
        due
    }

    /// Takes what the vehicle sends to the ground stations of an earlier flight. To be called once a tick, after the
    /// firmware's.
    #[cold]
    pub fn send_replayed(&mut self) {
        if let Some(replay) = &mut self.replay {
            replay.take_sent(&self.autopilot.ports);
        }
    }

    /// What the vehicle has sent on each link, in a flight with inputs of an earlier one.
    pub fn sent(&self) -> AllSent {
        self.replay.as_ref().map_or_else(AllSent::default, |replay| *replay.sent())
    }

    /// Whether it is told where to go while it flies.
    fn is_commanded(&self) -> bool {
        self.pilot.is_some() || self.replay.is_some()
    }

    /// What a tick shows, with what a firmware has made of its sample.
    pub fn look_at(&mut self, inner: &InnerOutput, outer: &OuterOutput) -> Seen<'_> {
        let row = self.row(inner, outer);
        self.judge(&row);
        let navigation = self.sensors.is_some().then(|| self.navigation(row.t));
        Seen { row, activity: Some(self.activity(row.t)), navigation }
    }

    /// What a row shows, unless the flight has ended before.
    fn judge(&mut self, row: &Row) {
        match row.end() {
            // Guidance has it where it believes to be, which without sensors may be anywhere.
            End::LeftReference if self.is_parked() => {}
            end => self.outcome.end_by(end),
        }
    }

    /// Whether it is disarmed above ground, so that it follows no reference: it stands there, or is about to hit it.
    #[cold]
    fn is_parked(&self) -> bool {
        self.plant.has_ground() && !self.autopilot.inner.commander_output().armed
    }

    /// A motor command acts on the plant until the next; the tick ends. Returns false once the vehicle is lost.
    #[inline]
    pub fn actuate(&mut self, motors: &MotorCommand, saturated: bool) -> bool {
        let mut command = motors.omega_rad_s.map(f64::from);
        if let Some(delay) = &mut self.delay {
            command = delay.pass(command);
        }
        let mut push = &self.noise.now().push;
        if let Some(weather) = &mut self.weather {
            push = weather.add(push, self.tick, self.plant.air_density());
        }
        self.plant.step(&command, push, TICK_S_EXACT);
        self.outcome.saturated_ticks += u32::from(saturated);
        self.tick = self.tick.wrapping_add(1);
        self.outcome.ticks = self.tick;
        self.outcome.survived()
    }

    /// The record of this tick, with what the firmware has made of it.
    fn row(&self, inner: &InnerOutput, outer: &OuterOutput) -> Row {
        let t = time(self.tick);
        let given = || inner.motors.omega_rad_s.map(f64::from);
        let command = self.delay.as_ref().map_or_else(given, |delay| delay.arriving());
        let omega = self.plant.omega_during(&command);
        let desired = outer.attitude.target.attitude.cast::<f64>();
        Row {
            omega,
            omega_command: command,
            reference: self.reference(t, outer),
            reference_is_held: self.is_commanded() && self.tick % OUTER.period != OUTER.offset,
            desired_attitude: roll_pitch_yaw([desired.w, desired.i, desired.j, desired.k]),
            u: inner.demand.as_array().map(f64::from),
            s: [inner.s.x, inner.s.y, inner.s.z, outer.s.x, outer.s.y, outer.s.z].map(f64::from),
            ..Row::of_motion(t, &self.plant.motion())
        }
    }

    /// What the vehicle is doing.
    fn activity(&self, t: f64) -> Activity<'_> {
        Activity {
            t,
            commander: self.autopilot.inner.commander_output(),
            given: self.pilot.as_ref().map_or(0, |pilot| pilot.given()),
            battery: self.plant.battery(),
        }
    }

    /// What the vehicle believes, beside the truth.
    fn navigation(&self, t: f64) -> Navigation<'_> {
        let vehicle = &self.autopilot.inner;
        let state = vehicle.navigator().map(Navigator::state);
        Navigation {
            t,
            truth: self.plant.motion(),
            nav: vehicle.nav(),
            gyro_bias: state.map_or_else(Vector3::zeros, |state| state.gyro_bias),
            accel_bias: state.map_or_else(Vector3::zeros, |state| state.accel_bias),
            health: vehicle.nav_health(),
            filter: vehicle.filter_report(),
            filtered: self.autopilot.filtered(),
            covariance: self.autopilot.filter.covariance(),
            commander: vehicle.commander_output(),
        }
    }

    /// Where the vehicle ought to be: on its trajectory, or where guidance has it.
    fn reference(&self, t: f64, outer: &OuterOutput) -> [f64; 4] {
        if !self.is_commanded() {
            return reference::at(&self.trajectory, self.flight_time(t));
        }
        let wanted = outer.wanted;
        [wanted.x, wanted.y, wanted.z, wanted.w].map(f64::from)
    }

    /// Time on the flight's clock, s: 0 while disarmed.
    fn flight_time(&self, t: f64) -> f64 {
        let start = self.autopilot.inner.commander_output().flight_start();
        start.map_or(0.0, |start| t - time(start))
    }
}

impl<P: Plant, A: AttitudeLaw, L: PositionLaw> Lockstep for Flight<P, A, L> {
    #[inline]
    fn control(&mut self) {
        if self.replay.is_some() {
            self.hear_replayed();
        }
        let sample = self.sense();
        if self.pilot.is_some() {
            self.ask_pilot();
        }
        self.autopilot.tick(Some(&sample));
        if self.restart.is_some() && self.autopilot.inner.takes_restart() {
            let injectable = self.injectable();
            if let Some(restart) = &self.restart {
                restart.restart(&mut self.autopilot, injectable);
            }
        }
        if self.replay.is_some() {
            self.send_replayed();
        }
    }

    fn look(&mut self) -> Seen<'_> {
        let vehicle = &self.autopilot.inner;
        let (inner, outer) = (*vehicle.inner_output(), *vehicle.outer_output());
        self.look_at(&inner, &outer)
    }

    #[inline]
    fn act(&mut self) -> bool {
        let inner = self.autopilot.inner.inner_output();
        let (motors, saturated) = (inner.motors, inner.saturated);
        self.actuate(&motors, saturated)
    }

    fn interrupt(&mut self) {
        self.outcome.end_by(End::Interrupted);
    }

    fn outcome(&self) -> Outcome {
        self.outcome
    }
}

/// Time of a tick, s: correctly rounded, so that it prints as k/1000.
#[inline]
fn time(tick: Tick) -> f64 {
    f64::from(tick) * f64::from(TICK_US) / 1e6
}

/// An ideal sensor, with the disturbances that a scenario puts on its outputs.
#[inline]
fn sense(motion: &Motion, disturbed: &Disturbed) -> SensorFrame {
    let nav = if disturbed.is_on_outputs() { falsified(motion, disturbed).as_nav() } else { motion.as_nav() };
    SensorFrame::Motion(nav)
}

/// The motion as a disturbed sensor sees it.
#[cold]
fn falsified(motion: &Motion, disturbed: &Disturbed) -> Motion {
    let (roll, pitch, yaw) = UnitQuaternion::new_normalize(motion.attitude).euler_angles();
    let angles = Vector3::new(roll, pitch, yaw) + disturbed.angles;
    Motion {
        position: motion.position + disturbed.position,
        attitude: UnitQuaternion::from_euler_angles(angles.x, angles.y, angles.z).into_inner(),
        ..*motion
    }
}

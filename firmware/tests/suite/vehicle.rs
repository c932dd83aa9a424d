//! The vehicle of the flights: the partitions on a rigid body over a flat ground, their outputs in effect at once.

use firmware::airframe::Airframe;
use firmware::commander::{
    Command, Commander, CommanderInput, CommanderOutput, Commands, Event, Ground, Mode, Origin, Request,
};
use firmware::config::FlightConfig;
use firmware::control::attitude::{self, SlidingAttitude};
use firmware::control::position::SlidingPosition;
use firmware::inner::Inner;
use firmware::latest::{Latest, Stamped, Sticks};
use firmware::outer::{Authority, Outer, OuterInput, OuterOutput};
use firmware::schedule::{COMMANDER, OUTER};
use firmware::settings::{COUNT, Changes, Settings};
use firmware::signals::{MotorCommand, NavHealth, NavState, SensorFrame, TICK_S, Tick};
use nalgebra::{UnitQuaternion, Vector3};

/// A rigid body whose rotors follow at once, on a ground at z = 0 that takes every speed.
pub(crate) struct Body {
    pub(crate) airframe: Airframe,
    pub(crate) nav: NavState,
}

impl Body {
    pub(crate) fn step(&mut self, motors: &MotorCommand) {
        let geometry = &self.airframe.geometry;
        let omega = &motors.omega_rad_s;
        let thrust: f32 = geometry.thrust.iter().zip(omega).map(|(lift, w)| lift * w * w).sum();
        let nav = &mut self.nav;
        let spin = self.airframe.rotor_spin_rad_s(omega);
        let torque = geometry.torque(omega) - attitude::torque(&self.airframe, &Vector3::zeros(), &nav.rates, spin);
        nav.rates += torque.component_div(&Vector3::from(self.airframe.inertia_kg_m2)) * TICK_S;
        nav.attitude *= UnitQuaternion::from_scaled_axis(nav.rates * TICK_S);
        let drag = Vector3::from(self.airframe.drag_n_s_m).component_mul(&nav.velocity);
        let force = nav.attitude * Vector3::new(0.0, 0.0, thrust) - drag;
        let gravity = Vector3::new(0.0, 0.0, self.airframe.gravity_m_s2);
        nav.velocity += (force / self.airframe.mass_kg - gravity) * TICK_S;
        nav.position += nav.velocity * TICK_S;
        if nav.position.z <= 0.0 && nav.velocity.z <= 0.0 {
            nav.position.z = 0.0;
            nav.velocity = Vector3::zeros();
            nav.rates = Vector3::zeros();
            let (_, _, yaw) = nav.attitude.euler_angles();
            nav.attitude = UnitQuaternion::from_euler_angles(0.0, 0.0, yaw);
        }
    }
}

/// The default, but for the paper's rotational drag: against it, the rotors could not turn the heading by 1 rad/s.
pub(crate) fn config() -> FlightConfig {
    let mut config = FlightConfig::default();
    config.airframe.rotational_drag_n_m_s2 = [0.0; 3];
    config
}

/// What a failing estimator makes of the motion.
pub(crate) type Spoil = fn(&mut NavState, f32);

/// The partitions, their outputs in effect at once, so that a test may come between them.
pub(crate) struct Vehicle {
    pub(crate) body: Body,
    pub(crate) inner: Inner,
    pub(crate) outer: Outer,
    pub(crate) commander: Commander,
    pub(crate) told: CommanderOutput,
    pub(crate) reference: OuterOutput,
    pub(crate) motors: MotorCommand,
    pub(crate) tick: Tick,
    pub(crate) commands: Commands,
    pub(crate) health: NavHealth,
    pub(crate) latest: Latest,
    pub(crate) spoil: Spoil,
    pub(crate) events: Vec<Event>,
    pub(crate) config: FlightConfig,
}

impl Vehicle {
    pub(crate) fn new(config: &FlightConfig) -> Self {
        let airframe = config.airframe;
        let nav = NavState { position: config.start_position(), ..NavState::at_rest() };
        let commander = Commander::new(config);
        let told = commander.initial_output();
        let mut outer = Outer::new(config, SlidingPosition::new(&airframe, &config.position)).expect("valid");
        let (directive, changes) = (told.directive, Changes::new());
        let input = OuterInput {
            nav,
            thrust_n: airframe.weight_n(),
            directive,
            ground: Ground::Far,
            latest: Latest::default(),
            changes,
        };
        Self {
            body: Body { airframe, nav },
            inner: Inner::new(config, SlidingAttitude::new(&airframe, &config.attitude)).expect("valid"),
            reference: outer.step(0_u32.wrapping_sub(OUTER.offset), &input),
            outer,
            commander,
            told,
            motors: MotorCommand::STOPPED,
            tick: 0,
            commands: Commands::new(),
            health: NavHealth::ALL,
            latest: Latest::default(),
            spoil: |_, _| {},
            events: Vec::new(),
            config: config.clone(),
        }
    }

    pub(crate) fn tick(&mut self) {
        let mut nav = self.body.nav;
        (self.spoil)(&mut nav, self.tick as f32 * TICK_S);
        let sample = SensorFrame::Motion(nav);
        self.inner.sense(Some(&sample));
        if self.tick.is_multiple_of(COMMANDER.period) {
            let input = CommanderInput {
                nav,
                nav_fresh: true,
                health: self.health,
                thrust_n: self.inner.thrust_n(),
                battery: None,
                failed_rotor: None,
                outer_hung: false,
                kills: 0,
                terminated: false,
                latest: self.latest,
                commands: core::mem::take(&mut self.commands),
                changes: Changes::new(),
            };
            self.told = self.commander.step(self.tick, &input);
            self.events.extend(self.told.event);
        }
        if self.tick.is_multiple_of(OUTER.period) {
            let (directive, changes) = (self.told.directive, Changes::new());
            let input = OuterInput {
                nav,
                thrust_n: self.inner.thrust_n(),
                directive,
                ground: self.told.ground,
                latest: self.latest,
                changes,
            };
            self.reference = self.outer.step(self.tick, &input);
        }
        let output = match self.reference.authority {
            Authority::Idle if self.told.armed => self.inner.idle(),
            Authority::Gentle if self.told.armed => self.inner.step_gently(self.tick, &self.reference.attitude),
            _ => self.inner.step(self.tick, &self.reference.attitude, self.told.armed),
        };
        self.motors = output.motors;
        self.body.step(&self.motors);
        self.tick += 1;
    }

    /// Takes over what can be set in flight of another configuration.
    pub(crate) fn take_over(&mut self, config: &FlightConfig) {
        let settings = Settings::of(config);
        let mut before = Settings::of(&self.config);
        for index in 0..COUNT {
            let value = settings.get(index).expect("a setting");
            if before.get(index) != Some(value) {
                let change = before.set(index, value, true).expect("accepted");
                self.commander.apply(&change);
                self.outer.apply(&change);
                self.inner.apply(&change);
            }
        }
        self.config = config.clone();
    }

    pub(crate) fn ask(&mut self, request: Request) {
        let _ = self.commands.push(Command { request, origin: Origin::OnBoard });
    }

    /// Moves the sticks, which are told every 20 ms from now on.
    pub(crate) fn hold(&mut self, sticks: Sticks) {
        self.latest.sticks = Some(Stamped { value: sticks, at: self.tick });
    }

    pub(crate) fn run(&mut self, seconds: f32) {
        for _ in 0..(seconds / TICK_S) as u32 {
            if let Some(sticks) = &mut self.latest.sticks
                && self.tick.is_multiple_of(20)
            {
                sticks.at = self.tick;
            }
            self.tick();
        }
    }

    /// Until it idles on the ground, at most this long.
    pub(crate) fn until_landed(&mut self, seconds: f32) {
        let end = self.tick + (seconds / TICK_S) as u32;
        while self.told.mode != Mode::Idle {
            self.run(0.02);
            assert!(self.tick < end, "{:?} at {:?}", self.told.mode, self.body.nav);
        }
    }

    /// Until it is in a mode, at most this long.
    pub(crate) fn until(&mut self, mode: Mode, seconds: f32) {
        let end = self.tick + (seconds / TICK_S) as u32;
        while self.told.mode != mode {
            self.tick();
            assert!(self.tick < end, "{:?} instead of {mode:?}, at {:?}", self.told.mode, self.body.nav);
        }
    }

    /// Armed, and holding 4 m over the ground.
    pub(crate) fn airborne(config: &FlightConfig) -> Self {
        let mut vehicle = Self::new(config);
        vehicle.ask(Request::Arm { force: false });
        vehicle.ask(Request::TakeOff { height_m: 4.0 });
        vehicle.until(Mode::Hold, 8.0);
        vehicle.run(2.0);
        vehicle.assert_near([0.0, 0.0, 4.0], 0.05);
        vehicle
    }

    pub(crate) fn assert_near(&self, place: [f32; 3], within: f32) {
        let away = (self.body.nav.position - Vector3::from(place)).norm();
        assert!(away < within, "{:?} is {away} m from {place:?}", self.body.nav.position);
    }
}

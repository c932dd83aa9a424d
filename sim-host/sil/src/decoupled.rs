//! The paper's figures: Eq. 2 with the specific force and the torques as direct inputs of any size and sign, and
//! the firmware's own control laws evaluated at every plant step, as a continuous-time block diagram would.
//!
//! In this interpretation Table 1's gains give the paper's curves. It has no rotors: Ωr = 0.

use anyhow::{Result, anyhow};
use firmware::airframe::Airframe;
use firmware::config::FlightConfig;
use firmware::control::attitude;
use firmware::control::euler::EulerReference;
use firmware::control::position::{self, Translation};
use firmware::control::sliding::SlidingAxis;
use firmware::guidance::{Guidance, Trajectory};
use nalgebra::Vector3;

use crate::lockstep::Lockstep;
use crate::noise::{Disturbed, Noise};
use crate::outcome::{End, Outcome};
use crate::plant::Constants;
use crate::plant::paper::{self, PaperInput, PaperState};
use crate::record::{Row, Seen};
use crate::reference;
use crate::world::{AttitudeWave, Disturbance};

/// Plant steps per second.
const STEPS_A_SECOND: f64 = 1e5;
/// Plant step, s.
pub const STEP_S: f64 = 1.0 / STEPS_A_SECOND;
/// Plant steps per row of the record.
const STEPS_A_ROW: u32 = 100;

/// The decoupled model with the control laws in its loop.
#[derive(Clone, Debug)]
pub struct Decoupled {
    constants: Constants,
    airframe: Airframe,
    translation: Translation,
    position_axes: [SlidingAxis; 3],
    attitude_axes: [SlidingAxis; 3],
    trajectory: Trajectory,
    guidance: Guidance,
    wave: Option<AttitudeWave>,
    noise: Noise,
    state: PaperState,
    step: u32,
    demands: Demands,
    outcome: Outcome,
}

/// Demands of the laws at a step.
#[derive(Clone, Copy, Debug, Default)]
struct Demands {
    force: Vector3<f64>,
    torque: Vector3<f64>,
    s: [f64; 6],
}

/// φd, θd, ψd with two derivatives at time `t`, in double precision.
fn wave_at(wave: Option<&AttitudeWave>, t: f64) -> [Vector3<f64>; 3] {
    let Some(wave) = wave else {
        return [Vector3::zeros(); 3];
    };
    let axis = |i: usize| {
        let (a, w) = (wave.amplitude_rad[i], wave.rate_rad_s[i]);
        let (sin, cos) = libm::sincos(w * t + wave.phase_rad[i]);
        [a * sin, a * w * cos, -a * w * w * sin]
    };
    let [x, y, z] = [axis(0), axis(1), axis(2)];
    core::array::from_fn(|k| Vector3::new(x[k], y[k], z[k]))
}

impl Decoupled {
    /// At rest at `position` (m), before the first step. The laws and the trajectory are those of the configuration.
    ///
    /// # Errors
    /// The firmware refuses the trajectory.
    pub fn new(constants: Constants, config: &FlightConfig, position: Vector3<f64>) -> Result<Self> {
        let trajectory = config.trajectory.clone();
        let guidance = Guidance::with_tick(trajectory.clone(), STEP_S).map_err(|error| anyhow!("{error}"))?;
        Ok(Self {
            constants,
            airframe: config.airframe,
            translation: Translation::new(&config.airframe),
            position_axes: config.position.axes.map(|axis| SlidingAxis::new(&axis, STEP_S as f32)),
            attitude_axes: config.attitude.axes.map(|axis| SlidingAxis::new(&axis, STEP_S as f32)),
            trajectory,
            guidance,
            wave: None,
            noise: Noise::new(None, 0, STEPS_A_SECOND),
            state: PaperState::at_rest(position),
            step: 0,
            demands: Demands::default(),
            outcome: Outcome::default(),
        })
    }

    /// With an attitude to follow; level without it.
    #[must_use]
    pub fn with_attitude(mut self, wave: Option<AttitudeWave>) -> Self {
        self.wave = wave;
        self
    }

    /// Under disturbances.
    #[must_use]
    pub fn with_disturbance(mut self, disturbance: Option<&Disturbance>, seed: u64) -> Self {
        self.noise = Noise::new(disturbance, seed, STEPS_A_SECOND);
        self
    }

    fn time(&self) -> f64 {
        f64::from(self.step) / STEPS_A_SECOND
    }

    /// φd, θd, ψd at time `t`, rad.
    pub fn attitude_reference(&self, t: f64) -> [f64; 3] {
        let [angles, _, _] = wave_at(self.wave.as_ref(), t);
        angles.into()
    }

    /// Eq. 25–31 on the measured state.
    fn demands_under(&mut self, disturbed: &Disturbed) -> Demands {
        let measured: Vector3<f32> = (self.state.position + disturbed.position).cast();
        let velocity: Vector3<f32> = self.state.velocity.cast();
        let flat = self.guidance.at(self.step);
        let translation =
            position::demand(&mut self.position_axes, &self.translation, &flat, &measured, &velocity, false);

        let [angles, rates, accelerations] = wave_at(self.wave.as_ref(), self.time()).map(|v: Vector3<f64>| v.cast());
        let target = EulerReference { angles, rates, accelerations };
        let measured: Vector3<f32> = (self.state.angles + disturbed.angles).cast();
        let angle_rates: Vector3<f32> = self.state.angle_rates.cast();
        let rotation = attitude::euler_demand(&mut self.attitude_axes, &target, &measured, &angle_rates, false);
        let torque = attitude::torque(&self.airframe, &rotation.acceleration, &angle_rates, 0.0);
        let (s, p) = (rotation.s, translation.s);
        Demands {
            force: translation.force.cast(),
            torque: torque.cast(),
            s: [s.x, s.y, s.z, p.x, p.y, p.z].map(f64::from),
        }
    }

    fn row(&self) -> Row {
        let Demands { force, torque, s } = self.demands;
        let t = self.time();
        // The angles follow `[attitude]`, or stay level: the trajectory's yaw is nobody's.
        let [x, y, z, _] = reference::at(&self.trajectory, t);
        let [_, _, yaw] = self.attitude_reference(t);
        let reference = [x, y, z, yaw];
        let thrust = force.z * self.constants.mass;
        Row {
            reference,
            desired_attitude: self.attitude_reference(t),
            u: [thrust, torque.x, torque.y, torque.z],
            s,
            ..Row::of_motion(t, &paper::motion(&self.state))
        }
    }

    /// The demands act until the next step.
    fn advance(&mut self) {
        let input = PaperInput { force: self.demands.force, torque: self.demands.torque, spin: 0.0 };
        self.state = self.constants.paper_step(&self.state, |_| input, &self.noise.now().push, STEP_S);
        self.step += 1;
    }
}

impl Lockstep for Decoupled {
    fn control(&mut self) {
        let disturbed = *self.noise.at(self.step);
        self.demands = self.demands_under(&disturbed);
    }

    fn look(&mut self) -> Seen<'_> {
        let row = self.row();
        self.outcome.end_by(row.end());
        Seen { row, activity: None, navigation: None }
    }

    fn act(&mut self) -> bool {
        self.advance();
        for _ in 1..STEPS_A_ROW {
            self.control();
            self.advance();
        }
        self.outcome.ticks += 1;
        self.outcome.survived()
    }

    fn interrupt(&mut self) {
        self.outcome.end_by(End::Interrupted);
    }

    fn outcome(&self) -> Outcome {
        self.outcome
    }
}

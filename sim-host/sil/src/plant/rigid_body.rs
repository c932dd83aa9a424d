//! The rigid-body plant: full Newton–Euler motion of a quaternion attitude, integrated by fixed-step RK4.
//!
//! ```text
//! ṗ = v        v̇ = R(q)[0,0,U1]ᵀ/m − (k1..3/m)·v − [0,0,g]ᵀ        q̇ = ½ q ⊗ [0, Ω]
//! I Ω̇ = τ − Ω × I Ω − Ω × [0, 0, Jr Ωr]ᵀ − (k4 p|p|, k5 q|q|, k6 r|r|)ᵀ (− [0, 0, Jr Ω̇r]ᵀ)
//! ω̇i = (ωi,cmd − ωi)/τrotor
//! ```
//!
//! The rotors' first-order lag has a closed form between commands, so it is evaluated exactly at the stages. The second
//! equation is divided by I once, when the plant is built. [`Effects`] change B, the drag and the commands between
//! steps; a flight without them costs one comparison more.

use nalgebra::{Quaternion, SVector, UnitQuaternion, Vector3, Vector4};

use super::battery::BatteryState;
use super::effects::{Active, Effects, Sound};
use super::ground::Ground;
use super::{Constants, Motion, Plant, PlantFaults, Push};
use firmware::airframe::ROTORS;

/// Position, velocity, attitude (w, x, y, z) and body rates, in this order: one vector, so that the stages of RK4
/// are whole-vector operations.
type State = SVector<f64, 13>;

/// The plant and its state.
#[derive(Clone, Debug)]
pub struct RigidBody {
    constants: Constants,
    divided: Divided,
    ground: Option<Ground>,
    state: State,
    omega: Vector4<f64>,
    /// Boxed, because it is large and rarely used.
    sound: Box<Sound>,
    effects: Option<Box<Active>>,
}

/// The constants as the equations of motion need them: divided by mass and inertia.
#[derive(Clone, Debug)]
struct Divided {
    /// 1/m.
    inverse_mass: f64,
    /// 1/Ix, 1/Iy, 1/Iz.
    inverse_inertia: Vector3<f64>,
    /// k1..k3 over m.
    drag: Vector3<f64>,
    /// k4..k6 over I.
    rotational_drag: Vector3<f64>,
    /// ((Iy − Iz)/Ix, (Iz − Ix)/Iy, (Ix − Iy)/Iz): −I⁻¹(Ω × IΩ) is this times (qr, pr, pq).
    coupling: Vector3<f64>,
}

/// Effect of the rotors on the body at a stage.
#[derive(Clone, Copy)]
struct RotorState {
    /// U1/m, m/s².
    specific_thrust: f64,
    /// I⁻¹ τ minus the spin-up reaction, rad/s².
    angular_acceleration: Vector3<f64>,
    /// Jr Ωr over Ix and over Iy, 1/s.
    gyroscopic: (f64, f64),
}

impl Divided {
    fn new(c: &Constants) -> Self {
        let (ix, iy, iz) = (c.inertia.x, c.inertia.y, c.inertia.z);
        Self {
            inverse_mass: 1.0 / c.mass,
            inverse_inertia: c.inertia.map(f64::recip),
            drag: c.drag / c.mass,
            rotational_drag: c.rotational_drag.component_div(&c.inertia),
            coupling: Vector3::new((iy - iz) / ix, (iz - ix) / iy, (ix - iy) / iz),
        }
    }
}

impl RigidBody {
    /// At rest at `position`, with the rotors at hover speed (in the air) or stopped (on the ground).
    pub fn new(constants: Constants, ground: Option<Ground>, position: Vector3<f64>) -> Self {
        let stands = ground.as_ref().is_some_and(|ground| ground.height_above(&position) <= 0.0);
        let omega = Vector4::repeat(if stands { 0.0 } else { constants.hover_omega() });
        let divided = Divided::new(&constants);
        let sound = Box::new(Sound::new(&constants, divided.drag, divided.rotational_drag));
        Self { divided, ground, state: pack(&Motion::at_rest(position)), omega, sound, effects: None, constants }
    }

    /// With effects, at the present motion and rotor speeds.
    #[must_use]
    pub fn with_effects(mut self, effects: Effects) -> Self {
        let mut active = Box::new(Active::new(effects));
        self.evaluate(&mut active);
        self.effects = Some(active);
        self
    }

    /// With another motion and rotor speeds.
    #[must_use]
    pub fn with_state(mut self, motion: Motion, omega: Vector4<f64>) -> Self {
        self.state = pack(&motion);
        self.omega = omega;
        self
    }

    /// With another motion.
    #[must_use]
    pub fn with_motion(mut self, motion: Motion) -> Self {
        self.state = pack(&motion);
        self
    }

    /// The constants, with B as changed by the effects.
    pub fn constants(&self) -> &Constants {
        &self.constants
    }

    /// The ground, if any.
    pub fn ground(&self) -> Option<&Ground> {
        self.ground.as_ref()
    }

    /// Height of the centre of mass above the ground, or above the world's origin without ground, m.
    pub fn height_above_ground(&self) -> f64 {
        let position = self.motion().position;
        self.ground.as_ref().map_or(position.z, |ground| ground.height_above(&position))
    }

    /// Remaining fraction of each rotor's thrust and torque from now on: 1 for a healthy rotor, 0 for a failed one. Its
    /// spin continues.
    pub fn set_rotor_effectiveness(&mut self, effectiveness: [f64; ROTORS]) {
        self.sound.effectiveness = effectiveness;
        match self.effects.take() {
            Some(mut active) => {
                self.evaluate(&mut active);
                self.effects = Some(active);
            }
            None => self.constants.geometry = self.sound.geometry(1.0, &[1.0; ROTORS]),
        }
    }

    /// Updates B, the drag and the battery's load at the present state.
    fn evaluate(&mut self, active: &mut Active) {
        let motion = self.motion();
        active.set_height(motion.position.z);
        let cushion = active.cushion(self.ground.as_ref(), &motion, &self.sound.arms);
        self.constants.geometry = self.sound.geometry(active.density, &cushion);
        self.divided.drag = self.sound.drag * active.density;
        self.divided.rotational_drag = self.sound.rotational_drag * active.density;
        active.load(&self.constants.geometry, &self.omega);
    }

    #[expect(clippy::inline_always, reason = "measured: as for the derivative")]
    #[inline(always)]
    fn rotors(&self, omega: &Vector4<f64>, command: &Vector4<f64>) -> RotorState {
        let c = &self.constants;
        let reaction = if c.spin_up_reaction && c.rotor_lag > 0.0 {
            c.rotor_inertia * c.rotor_spin(&((command - omega) / c.rotor_lag))
        } else {
            0.0
        };
        self.rotors_reacting(omega, reaction)
    }

    /// The rotors' effect at their speeds (rad/s), with a reaction torque Jr Ω̇r (N m).
    #[expect(clippy::inline_always, reason = "measured: as for the derivative")]
    #[inline(always)]
    fn rotors_reacting(&self, omega: &Vector4<f64>, reaction: f64) -> RotorState {
        let (c, d) = (&self.constants, &self.divided);
        let u = c.inputs(omega);
        let spin_momentum = c.rotor_inertia * c.rotor_spin(omega);
        RotorState {
            specific_thrust: u.x * d.inverse_mass,
            angular_acceleration: Vector3::new(u.y, u.z, u.w - reaction).component_mul(&d.inverse_inertia),
            gyroscopic: (spin_momentum * d.inverse_inertia.x, spin_momentum * d.inverse_inertia.y),
        }
    }

    /// ẋ at a stage. `CONTACT` says whether there is ground, so that a flight without it has no cost.
    #[expect(
        clippy::inline_always,
        reason = "measured: called, its result goes through memory and stalls the next stage"
    )]
    #[inline(always)]
    fn derivative<const CONTACT: bool>(&self, state: &State, rotors: &RotorState, push: &Push) -> State {
        let d = &self.divided;
        let [_, _, _, vx, vy, vz, w, x, y, z, p, q, r] = state.data.0[0];
        let thrust = rotors.specific_thrust;
        let steady = push.acceleration - Vector3::new(0.0, 0.0, self.constants.gravity);
        let mut force = Vector3::new(
            (steady.x - d.drag.x * vx) + (x * z + w * y) * (2.0 * thrust),
            (steady.y - d.drag.y * vy) + (y * z - w * x) * (2.0 * thrust),
            (steady.z - d.drag.z * vz) + (1.0 - 2.0 * (x * x + y * y)) * thrust,
        );
        let (own, (gx, gy), k) = (&rotors.angular_acceleration, rotors.gyroscopic, &d.rotational_drag);
        // Grouped so that terms known before the stage come first: the stages depend on each other.
        let base = own + push.angular_acceleration;
        let mut turn = Vector3::new(
            (base.x - k.x * (p * p.abs())) + q * (d.coupling.x * r - gx),
            (base.y - k.y * (q * q.abs())) + p * (d.coupling.y * r + gy),
            (base.z - k.z * (r * r.abs())) + p * (d.coupling.z * q),
        );
        if CONTACT && let Some(ground) = &self.ground {
            let contact = ground.wrench(&unpack(state));
            force += contact.force * d.inverse_mass;
            turn += contact.torque.component_mul(&d.inverse_inertia);
        }
        let (hp, hq, hr) = (0.5 * p, 0.5 * q, 0.5 * r);
        State::from([
            vx,
            vy,
            vz,
            force.x,
            force.y,
            force.z,
            -x * hp - y * hq - z * hr,
            w * hp + y * hr - z * hq,
            w * hq - x * hr + z * hp,
            w * hr + x * hq - y * hp,
            turn.x,
            turn.y,
            turn.z,
        ])
    }

    /// [`rk4`](Self::rk4) with ground, a separate function so that flights without it are not slowed down.
    #[inline(never)]
    fn rk4_in_contact(&self, stages: &[RotorState; 3], push: &Push, h: f64) -> State {
        self.rk4::<true>(stages, push, h)
    }

    /// The state after a step of the classical Runge–Kutta method.
    #[inline]
    fn rk4<const CONTACT: bool>(&self, [first, middle, last]: &[RotorState; 3], push: &Push, h: f64) -> State {
        let s = self.state;
        let k1 = self.derivative::<CONTACT>(&s, first, push);
        let k2 = self.derivative::<CONTACT>(&(s + k1 * (0.5 * h)), middle, push);
        let k3 = self.derivative::<CONTACT>(&(s + k2 * (0.5 * h)), middle, push);
        let k4 = self.derivative::<CONTACT>(&(s + k3 * h), last, push);
        let mut next = (s + (k1 + (k2 + k3) * 2.0) * (h / 6.0)) + k4 * (h / 6.0);
        normalise(&mut next);
        next
    }

    /// Rotor speeds `time` after `from`, approaching `command`.
    #[inline]
    fn omega_after(&self, from: &Vector4<f64>, command: &Vector4<f64>, time: f64) -> Vector4<f64> {
        command + (from - command) * libm::exp(-time / self.constants.rotor_lag)
    }

    /// The rotors at the start, the middle and the end of a step, and their speeds at the end.
    #[expect(clippy::inline_always, reason = "measured: as for the derivative")]
    #[inline(always)]
    fn rotor_stages(&self, command: &Vector4<f64>, h: f64) -> ([RotorState; 3], Vector4<f64>) {
        if self.constants.rotor_lag > 0.0 {
            let half = self.omega_after(&self.omega, command, 0.5 * h);
            let end = self.omega_after(&self.omega, command, h);
            ([&self.omega, &half, &end].map(|omega| self.rotors(omega, command)), end)
        } else {
            ([self.rotors(command, command); 3], *command)
        }
    }

    /// The same with another time constant (s) for rotors that slow down. A first-order lag never passes its command, so
    /// that each rotor keeps to one of the two within a step, and the closed form stays.
    fn uneven_stages(&self, command: &Vector4<f64>, down: f64, h: f64) -> ([RotorState; 3], Vector4<f64>) {
        let c = &self.constants;
        let lag = command.zip_map(&self.omega, |to, from| if to < from { down } else { c.rotor_lag });
        let kept = |time: f64| lag.map(|lag| libm::exp(-time / lag));
        let after = |time: f64| command + (self.omega - command).component_mul(&kept(time));
        let reaction = |omega: &Vector4<f64>| {
            let spin_up = (command - omega).component_div(&lag);
            if c.spin_up_reaction { c.rotor_inertia * c.rotor_spin(&spin_up) } else { 0.0 }
        };
        let (half, end) = (after(0.5 * h), after(h));
        ([&self.omega, &half, &end].map(|omega| self.rotors_reacting(omega, reaction(omega))), end)
    }

    /// A step with effects, a separate function so that flights without them are not slowed down.
    #[cold]
    #[inline(never)]
    fn step_with_effects(&mut self, command: &[f64; ROTORS], push: &Push, h: f64) {
        let Some(mut active) = self.effects.take() else { return };
        if let Some(effectiveness) = active.failure(h) {
            self.sound.effectiveness = effectiveness;
            self.evaluate(&mut active);
        }
        let command = active.limit(command);
        let (stages, omega) = match active.effects.rotor_lag_down {
            Some(down) if self.constants.rotor_lag > 0.0 => self.uneven_stages(&command, down, h),
            _ => self.rotor_stages(&command, h),
        };
        self.state = self.rk4_in_contact(&stages, push, h);
        self.omega = omega;
        active.elapse(h);
        self.evaluate(&mut active);
        self.effects = Some(active);
    }
}

fn pack(motion: &Motion) -> State {
    let (p, v, q, w) = (&motion.position, &motion.velocity, &motion.attitude, &motion.rates);
    State::from([p.x, p.y, p.z, v.x, v.y, v.z, q.w, q.i, q.j, q.k, w.x, w.y, w.z])
}

#[inline]
fn unpack(state: &State) -> Motion {
    let [x, y, z, vx, vy, vz, qw, qx, qy, qz, p, q, r] = state.data.0[0];
    Motion {
        position: Vector3::new(x, y, z),
        velocity: Vector3::new(vx, vy, vz),
        attitude: Quaternion::new(qw, qx, qy, qz),
        rates: Vector3::new(p, q, r),
    }
}

/// Normalises the attitude, whose norm RK4 keeps to fifth order only: one Newton step of 1/√n², exact to (n² − 1)²,
/// which is below the resolution of f64 at any rate that a step of 1 ms can follow.
#[inline]
fn normalise(state: &mut State) {
    let [_, _, _, _, _, _, w, x, y, z, ..] = &mut state.data.0[0];
    let inverse = 1.5 - 0.5 * ((*w * *w + *x * *x) + (*y * *y + *z * *z));
    for component in [w, x, y, z] {
        *component *= inverse;
    }
}

impl Plant for RigidBody {
    fn has_ground(&self) -> bool {
        self.ground.is_some()
    }

    #[inline]
    fn motion(&self) -> Motion {
        unpack(&self.state)
    }

    fn omega(&self) -> [f64; ROTORS] {
        self.omega.into()
    }

    #[inline]
    fn omega_during(&self, command: &[f64; ROTORS]) -> [f64; ROTORS] {
        if self.constants.rotor_lag > 0.0 {
            return self.omega.into();
        }
        self.effects.as_ref().map_or(*command, |active| active.limit(command).into())
    }

    fn specific_force(&self, push: &Push) -> Vector3<f64> {
        let motion = self.motion();
        let mut world = push.acceleration - self.divided.drag.component_mul(&motion.velocity);
        if let Some(ground) = &self.ground {
            world += ground.wrench(&motion).force * self.divided.inverse_mass;
        }
        let thrust = self.constants.inputs(&self.omega).x * self.divided.inverse_mass;
        UnitQuaternion::new_unchecked(motion.attitude).inverse_transform_vector(&world) + Vector3::new(0.0, 0.0, thrust)
    }

    fn air_density(&self) -> f64 {
        self.effects.as_ref().map_or(1.0, |active| active.density)
    }

    fn apply_faults(&mut self, faults: &PlantFaults) {
        if let Some(active) = &mut self.effects {
            active.forget_schedule(faults.battery_factor);
        }
        self.set_rotor_effectiveness(faults.rotor_effectiveness);
    }

    fn drag(&self) -> Option<Vector3<f64>> {
        Some(self.constants.drag / self.constants.mass)
    }

    fn battery(&self) -> Option<BatteryState> {
        Some(self.effects.as_ref()?.effects.supply.as_ref()?.battery.state())
    }

    #[inline]
    fn step(&mut self, command: &[f64; ROTORS], push: &Push, h: f64) {
        if self.effects.is_some() {
            return self.step_with_effects(command, push, h);
        }
        let (stages, omega) = self.rotor_stages(&Vector4::from(*command), h);
        self.state = if self.ground.is_some() {
            self.rk4_in_contact(&stages, push, h)
        } else {
            self.rk4::<false>(&stages, push, h)
        };
        self.omega = omega;
    }
}

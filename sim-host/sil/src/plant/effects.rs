//! Optional effects of a flight: a separate lag for rotors that slow down, rotor failures, air density, ground effect,
//! and a battery. Each is evaluated between steps and held over the next.

use nalgebra::{Matrix4, Vector3, Vector4};

use super::air::{Atmosphere, GroundEffect};
use super::battery::{Battery, Collapse};
use super::ground::Ground;
use super::{Constants, Motion};
use firmware::airframe::ROTORS;

/// Rotors that lose their thrust and their drag torque in flight.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RotorFailure {
    /// When, s.
    pub at: f64,
    /// Remaining fraction of each rotor's column of B from then on.
    pub effectiveness: [f64; ROTORS],
}

/// A battery with its load and its collapses.
#[derive(Clone, Debug, PartialEq)]
pub struct Supply {
    /// The battery.
    pub battery: Battery,
    /// ωmax, at the battery's nominal voltage, rad/s.
    pub omega_max: f64,
    /// When its voltage collapses.
    pub collapses: Vec<Collapse>,
}

impl Supply {
    fn collapse(&mut self, time: f64) {
        let now = |collapse: &&Collapse| (collapse.from_to.0..collapse.from_to.1).contains(&time);
        let factor = self.collapses.iter().find(now).map_or(1.0, |collapse| collapse.factor);
        self.battery.set_factor(factor);
    }
}

/// The effects of a flight: all of them optional.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Effects {
    /// Time constant of a rotor that slows down, s.
    pub rotor_lag_down: Option<f64>,
    /// Rotors that fail, in the order of time.
    pub failures: Vec<RotorFailure>,
    /// Air of another density than at sea level.
    pub atmosphere: Option<Atmosphere>,
    /// Ground effect, where there is ground.
    pub ground_effect: Option<GroundEffect>,
    /// The battery.
    pub supply: Option<Supply>,
}

/// Effects in flight.
#[derive(Clone, Debug)]
pub(super) struct Active {
    pub(super) effects: Effects,
    /// Steps' sum, s.
    time: f64,
    /// The next failure.
    next: usize,
    /// ρ/ρ0 now.
    pub(super) density: f64,
}

impl Active {
    pub(super) fn new(mut effects: Effects) -> Self {
        if let Some(supply) = &mut effects.supply {
            supply.collapse(0.0);
        }
        Self { effects, time: 0.0, next: 0, density: 1.0 }
    }

    /// A command (rad/s) within what the battery's voltage allows.
    pub(super) fn limit(&self, command: &[f64; ROTORS]) -> Vector4<f64> {
        let most = |supply: &Supply| supply.omega_max * supply.battery.speed_limit();
        let most = self.effects.supply.as_ref().map_or(f64::INFINITY, most);
        Vector4::from(command.map(|omega| omega.min(most)))
    }

    /// Rotor effectiveness from the step of `step` s that begins now, if a failure is due.
    pub(super) fn failure(&mut self, step: f64) -> Option<[f64; ROTORS]> {
        let failure = self.effects.failures.get(self.next)?;
        // The sum of the steps is off by rounding; half a step decides which tick was meant.
        (failure.at < self.time + 0.5 * step).then(|| {
            self.next += 1;
            failure.effectiveness
        })
    }

    /// Cancels the schedule; the battery's voltage stays at a fraction of its undisturbed value.
    pub(super) fn forget_schedule(&mut self, battery_factor: f64) {
        self.next = self.effects.failures.len();
        if let Some(supply) = &mut self.effects.supply {
            supply.collapses.clear();
            supply.collapses.push(Collapse { from_to: (0.0, f64::INFINITY), factor: battery_factor });
            supply.collapse(self.time);
        }
    }

    /// Advances the time by a step of `step` s.
    pub(super) fn elapse(&mut self, step: f64) {
        self.time += step;
        if let Some(supply) = &mut self.effects.supply {
            supply.battery.discharge(step);
            supply.collapse(self.time + 0.5 * step);
        }
    }

    /// Evaluates the density of the air at a height, m.
    pub(super) fn set_height(&mut self, z: f64) {
        self.density = self.effects.atmosphere.map_or(1.0, |air| air.density(z));
    }

    /// Factor of the ground effect on each rotor's thrust.
    pub(super) fn cushion(
        &self,
        ground: Option<&Ground>,
        motion: &Motion,
        arms: &[Vector3<f64>; ROTORS],
    ) -> [f64; ROTORS] {
        let (Some(effect), Some(ground)) = (&self.effects.ground_effect, ground) else { return [1.0; ROTORS] };
        let q = &motion.attitude;
        let up = 1.0 - 2.0 * (q.i * q.i + q.j * q.j);
        if up <= 0.0 {
            return [1.0; ROTORS];
        }
        // The world's z axis in the body.
        let vertical = Vector3::new(2.0 * (q.i * q.k - q.w * q.j), 2.0 * (q.j * q.k + q.w * q.i), up);
        let height = ground.height_above(&motion.position);
        arms.map(|arm| effect.factor(height + vertical.dot(&(arm + Vector3::new(0.0, 0.0, effect.plane)))))
    }

    /// Applies the rotors' load to the battery, from the present B and rotor speeds (rad/s).
    pub(super) fn load(&mut self, geometry: &Matrix4<f64>, omega: &Vector4<f64>) {
        if let Some(supply) = &mut self.effects.supply {
            let power = |i: usize| geometry[(3, i)].abs() * (omega[i] * omega[i] * omega[i]).abs();
            supply.battery.load((0..ROTORS).map(power).sum());
        }
    }
}

/// Rotors and drag without faults and effects.
#[derive(Clone, Debug)]
pub(super) struct Sound {
    geometry: Matrix4<f64>,
    pub(super) drag: Vector3<f64>,
    pub(super) rotational_drag: Vector3<f64>,
    /// Positions of the rotors in the body, m, in the plane of the rotors.
    pub(super) arms: [Vector3<f64>; ROTORS],
    /// Remaining fraction of each column of B.
    pub(super) effectiveness: [f64; ROTORS],
}

impl Sound {
    /// `drag` is k1..k3 over m, `rotational_drag` k4..k6 over I.
    pub(super) fn new(constants: &Constants, drag: Vector3<f64>, rotational_drag: Vector3<f64>) -> Self {
        let arm = |rotor: usize| {
            let column = constants.geometry.column(rotor);
            let lift = column[0];
            if lift > 0.0 { Vector3::new(-column[2] / lift, column[1] / lift, 0.0) } else { Vector3::zeros() }
        };
        Self {
            geometry: constants.geometry,
            drag,
            rotational_drag,
            arms: core::array::from_fn(arm),
            effectiveness: [1.0; ROTORS],
        }
    }

    /// B with the effectiveness of each rotor, at an air density, and with a ground effect that acts on lift only.
    pub(super) fn geometry(&self, density: f64, cushion: &[f64; ROTORS]) -> Matrix4<f64> {
        let column = |rotor: usize| {
            let torque = self.effectiveness[rotor] * density;
            let lift = torque * cushion[rotor];
            self.geometry.column(rotor).component_mul(&Vector4::new(lift, lift, lift, torque))
        };
        Matrix4::from_columns(&core::array::from_fn::<_, ROTORS, _>(column))
    }
}

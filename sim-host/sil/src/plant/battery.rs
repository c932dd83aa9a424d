//! A battery: its voltage falls with the charge and sags under load, and limits the rotor speed.
//!
//! ```text
//! V = E(s) − R I     V I = P     so  V = (E + √(E² − 4 R P))/2     ṡ = −I/C     ω ≤ ωmax V/Vnominal
//! P = Σ |τi| ωi/η + Pavionics
//! ```
//!
//! P is the power of rotors and electronics, independent of the voltage: motor controllers hold a speed. A battery that
//! cannot supply it gives its maximum, at V = E/2; an empty one gives nothing.

use crate::airframe::Pack;

/// Reading of a perfect gauge.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct BatteryState {
    /// At the terminals, V.
    pub voltage_v: f64,
    /// A.
    pub current_a: f64,
    /// Remaining charge, as a fraction of the capacity.
    pub soc: f64,
}

/// A collapse of the voltage for a while, as when a cell fails.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Collapse {
    /// Start and end, s.
    pub from_to: (f64, f64),
    /// Remaining fraction of the open-circuit voltage.
    pub factor: f64,
}

/// A battery in flight.
#[derive(Clone, Debug, PartialEq)]
pub struct Battery {
    pack: Pack,
    /// Remaining fraction of the open-circuit voltage.
    factor: f64,
    state: BatteryState,
}

impl Battery {
    /// At a state of charge `soc`, without load.
    pub fn new(pack: Pack, soc: f64) -> Self {
        let mut battery = Self { pack, factor: 1.0, state: BatteryState { soc, ..BatteryState::default() } };
        battery.state.voltage_v = battery.open_circuit_v();
        battery
    }

    /// The reading of a perfect gauge now.
    pub fn state(&self) -> BatteryState {
        self.state
    }

    /// Scales the open-circuit voltage by a factor, 1 for none. Acts from the next load on.
    pub fn set_factor(&mut self, factor: f64) {
        self.factor = factor;
    }

    /// E, V: interpolated linearly on the pack's curve.
    pub fn open_circuit_v(&self) -> f64 {
        let curve = &self.pack.open_circuit_v;
        if self.state.soc <= 0.0 {
            return 0.0;
        }
        let place = self.state.soc.min(1.0) * (curve.len() - 1) as f64;
        let below = (place as usize).min(curve.len() - 2);
        let fraction = place - below as f64;
        self.factor * (curve[below] + (curve[below + 1] - curve[below]) * fraction)
    }

    /// Applies a load: the mechanical power of the rotors, W.
    pub fn load(&mut self, mechanical_w: f64) {
        let power = mechanical_w / self.pack.efficiency + self.pack.avionics_w;
        let open = self.open_circuit_v();
        let root = (open * open - 4.0 * self.pack.resistance_ohm * power).max(0.0).sqrt();
        let voltage = 0.5 * (open + root);
        // Above the greatest power: V = E/2 and I = E/2R, which is V/R.
        let current = if root > 0.0 { power / voltage } else { voltage / self.pack.resistance_ohm.max(f64::EPSILON) };
        (self.state.voltage_v, self.state.current_a) = (voltage, current);
    }

    /// Discharges by the load for `step` s.
    pub fn discharge(&mut self, step: f64) {
        self.state.soc = (self.state.soc - self.state.current_a * step / (3600.0 * self.pack.capacity_ah)).max(0.0);
    }

    /// Greatest rotor speed under the present load, in units of ωmax.
    pub fn speed_limit(&self) -> f64 {
        self.state.voltage_v / self.pack.nominal_v
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// 16 V full, 14 V empty, in a straight line.
    fn pack(resistance_ohm: f64) -> Pack {
        Pack {
            open_circuit_v: core::array::from_fn(|i| 14.0 + 0.2 * i as f64),
            resistance_ohm,
            capacity_ah: 5.0,
            nominal_v: 14.8,
            efficiency: 0.8,
            avionics_w: 10.0,
        }
    }

    #[test]
    fn voltage_sags_so_that_the_power_is_what_is_asked_for() {
        let mut battery = Battery::new(pack(0.02), 1.0);
        assert_eq!(battery.state(), BatteryState { voltage_v: 16.0, current_a: 0.0, soc: 1.0 });
        battery.load(240.0);
        let state = battery.state();
        assert!((state.voltage_v * state.current_a - 310.0).abs() < 1e-9, "240/0.8 + 10: {state:?}");
        assert!((state.voltage_v - (16.0 - 0.02 * state.current_a)).abs() < 1e-12, "{state:?}");
        assert!((battery.speed_limit() - state.voltage_v / 14.8).abs() < 1e-15);
    }

    #[test]
    fn no_more_is_given_than_there_is() {
        // E²/4R = 3,200 W at the most, at 8 V and 400 A.
        let mut battery = Battery::new(pack(0.02), 1.0);
        battery.load(1e5);
        assert!((battery.state().voltage_v - 8.0).abs() < 1e-12 && (battery.state().current_a - 400.0).abs() < 1e-9);
        let mut empty = Battery::new(pack(0.02), 0.0);
        empty.load(240.0);
        assert_eq!(empty.state(), BatteryState::default());
        assert_eq!(empty.speed_limit(), 0.0);
    }

    #[test]
    fn a_collapse_takes_its_part_of_the_open_circuit_voltage() {
        let mut battery = Battery::new(pack(0.0), 0.5);
        assert!((battery.open_circuit_v() - 15.0).abs() < 1e-12, "halfway");
        battery.set_factor(0.6);
        battery.load(100.0);
        assert!((battery.state().voltage_v - 9.0).abs() < 1e-12);
        battery.set_factor(1.0);
        battery.load(100.0);
        assert!((battery.state().voltage_v - 15.0).abs() < 1e-12);
    }

    /// Time (s) until it is empty under a load, in steps of `step` s.
    fn endurance(mut battery: Battery, mechanical_w: f64, step: f64) -> f64 {
        let mut steps = 0.0;
        while battery.state().soc > 0.0 {
            battery.load(mechanical_w);
            battery.discharge(step);
            steps += 1.0;
        }
        steps * step
    }

    #[test]
    fn it_lasts_as_long_as_its_closed_form_says() {
        // Without resistance, P t = C ∫E ds: 5 Ah at a mean of 15 V are 270 kJ. Euler's method with n = 900 steps is off
        // by half a step times E(1)/E(0) − 1 = 14 %, and the end is seen to a step.
        let lossless = endurance(Battery::new(pack(0.0), 1.0), 232.0, 1.0);
        assert!((lossless - 270_000.0 / 300.0).abs() < 1.2, "{lossless}");
        // With it, t = C ∫ V(E)/P dE/(E1 − E0) and ∫ (E + √(E² − a²))/2 dE = (E² + E √(E² − a²) − a² arcosh(E/a))/4.
        let (resistance, power) = (0.05_f64, 300.0);
        let a = (4.0 * resistance * power).sqrt();
        let integral = |e: f64| 0.25 * (e * e + e * (e * e - a * a).sqrt() - a * a * (e / a).acosh());
        let exact = 5.0 * 3600.0 * (integral(16.0) - integral(14.0)) / 2.0 / power;
        let lossy = endurance(Battery::new(pack(resistance), 1.0), 232.0, 1.0);
        assert!((lossy - exact).abs() < 1.2 && exact < 860.0, "{lossy} {exact}");
    }
}

//! Control laws with a tap on their demand, where a loop is opened, scaled, delayed, and a signal injected.

use std::cell::RefCell;
use std::collections::VecDeque;

use firmware::control::law::{AttitudeDemand, AttitudeInput, AttitudeLaw, PositionDemand, PositionInput, PositionLaw};
use firmware::signals::AttitudeTarget;

use crate::noise::White;

/// Signal added to a demand.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Signal {
    /// A push in the first step.
    Impulse(f64),
    /// `amplitude cos(omega_step k)`.
    Sine { amplitude: f64, omega_step: f64 },
}

impl Signal {
    fn at(self, step: u32) -> f64 {
        match self {
            Self::Impulse(size) => {
                if step == 0 {
                    size
                } else {
                    0.0
                }
            }
            Self::Sine { amplitude, omega_step } => amplitude * libm::cos(omega_step * f64::from(step)),
        }
    }
}

/// The demands of a law, `N` components per step, before the tap.
pub(super) type Log<const N: usize> = RefCell<Vec<[f64; N]>>;

/// A tap on a demand of `N` components: `sent = rest + gain·(asked − rest)` of `delay` steps ago, and the signal on the
/// first.
#[derive(Clone, Debug)]
pub(super) struct Tap<'a, const N: usize> {
    axis: usize,
    rest: [f64; N],
    gain: f64,
    delayed: VecDeque<[f64; N]>,
    signal: Signal,
    log: &'a Log<N>,
    step: u32,
}

impl<'a, const N: usize> Tap<'a, N> {
    /// On an axis, 0 to 2, whose demand is `rest` in hover.
    pub(super) fn new(axis: usize, rest: [f64; N], change: Change, signal: Signal, log: &'a Log<N>) -> Self {
        let Change { gain, delay_steps } = change;
        Self { axis, rest, gain, delayed: VecDeque::from(vec![rest; delay_steps]), signal, log, step: 0 }
    }

    fn pass(&mut self, asked: [f64; N]) -> [f64; N] {
        self.log.borrow_mut().push(asked);
        let scaled = core::array::from_fn(|i| self.rest[i] + self.gain * (asked[i] - self.rest[i]));
        self.delayed.push_back(scaled);
        let mut sent = self.delayed.pop_front().unwrap_or(scaled);
        sent[0] += self.signal.at(self.step);
        self.step += 1;
        sent
    }
}

/// Changes to a loop.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Change {
    pub(super) gain: f64,
    pub(super) delay_steps: usize,
}

impl Change {
    pub(super) const NONE: Self = Self { gain: 1.0, delay_steps: 0 };
}

/// An attitude law with a tap on its torque.
#[derive(Clone, Debug)]
pub(super) struct TappedAttitude<'a, A> {
    pub(super) law: A,
    /// Target that replaces the outer partition's.
    pub(super) target: Option<AttitudeTarget>,
    /// Noise on the measured rates, rad/s.
    pub(super) noise: Option<White>,
    pub(super) tap: Option<Tap<'a, 1>>,
}

impl<A> TappedAttitude<'_, A> {
    /// Without changes.
    pub(super) fn plain(law: A) -> Self {
        Self { law, target: None, noise: None, tap: None }
    }
}

impl<A: AttitudeLaw> AttitudeLaw for TappedAttitude<'_, A> {
    fn step(&mut self, input: &AttitudeInput) -> AttitudeDemand {
        let target = self.target.unwrap_or(*input.target);
        let rates = self.noise.as_mut().map_or(*input.rates, |noise| input.rates + noise.draw().cast());
        let mut demand = self.law.step(&AttitudeInput { target: &target, rates: &rates, ..*input });
        if let Some(tap) = &mut self.tap {
            let torque = &mut demand.torque[tap.axis];
            *torque = tap.pass([f64::from(*torque)])[0] as f32;
        }
        demand
    }

    fn reset(&mut self) {
        self.law.reset();
    }
}

/// A position law with a tap on its force and the two derivatives.
#[derive(Clone, Debug)]
pub(super) struct TappedPosition<'a, P> {
    pub(super) law: P,
    pub(super) tap: Option<Tap<'a, 3>>,
}

impl<P: PositionLaw> PositionLaw for TappedPosition<'_, P> {
    fn step(&mut self, input: &PositionInput) -> PositionDemand {
        let mut demand = self.law.step(input);
        if let Some(tap) = &mut self.tap {
            let (axis, profile) = (tap.axis, &mut demand.profile);
            let parts = [&mut profile.force, &mut profile.rate, &mut profile.acceleration].map(|v| &mut v[axis]);
            let asked = parts.each_ref().map(|v| f64::from(**v));
            for (part, sent) in parts.into_iter().zip(tap.pass(asked)) {
                *part = sent as f32;
            }
        }
        demand
    }

    fn reset(&mut self) {
        self.law.reset();
    }
}

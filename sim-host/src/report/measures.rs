//! What signals are measured by, a value at a time: when they settle, how great they are, how much they vary.

/// Watches an error until it stays in a band for good.
#[derive(Clone, Copy, Debug)]
pub struct Settling {
    band: f64,
    since: Option<f64>,
    /// When it was outside last: from when on.
    left: Option<f64>,
}

impl Settling {
    /// Settled means |e| < `band`, in the error's unit.
    pub fn new(band: f64) -> Self {
        Self { band, since: None, left: None }
    }

    /// Takes the error at time `t` (s). A NaN is outside of every band.
    pub fn take(&mut self, t: f64, error: f64) {
        if error.abs() < self.band {
            self.since.get_or_insert(t);
        } else if self.since.take().is_some() || self.left.is_none() {
            self.left = Some(t);
        }
    }

    /// The first time (s) from which the error has stayed inside until now; `None` if it is outside.
    pub fn since(&self) -> Option<f64> {
        self.since
    }

    /// How long after `onset_s` that was: 0 if the error has not left the band since.
    pub fn after(&self, onset_s: f64) -> Option<f64> {
        self.since.map(|since| (since - onset_s).max(0.0))
    }

    /// Whether it was outside at `onset_s` already, and not inside since, or only when it settled.
    pub fn was_outside_at(&self, onset_s: f64) -> bool {
        self.left.is_some_and(|left| left <= onset_s) && self.since.is_none_or(|since| since > onset_s)
    }
}

/// Mean square and maximum of a signal.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Size {
    count: u64,
    sum_of_squares: f64,
    max: f64,
}

impl Size {
    pub(crate) fn take(&mut self, value: f64) {
        self.count += 1;
        self.sum_of_squares += value * value;
        // `f64::max` would forget a NaN.
        if value.is_nan() || value.abs() > self.max {
            self.max = value.abs();
        }
    }

    pub(crate) fn rms(&self) -> Option<f64> {
        self.max().and(finite((self.sum_of_squares / self.count as f64).sqrt()))
    }

    pub(crate) fn max(&self) -> Option<f64> {
        (self.count > 0).then_some(self.max).and_then(finite)
    }
}

/// Total variation a second of Σ over the rotors of ω², from some time on.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Variation {
    from: f64,
    span: Option<(f64, f64)>,
    squares: [f64; 4],
    total: f64,
}

impl Variation {
    pub(crate) fn from(from: f64) -> Self {
        Self { from, span: None, squares: [0.0; 4], total: 0.0 }
    }

    pub(crate) fn take(&mut self, t: f64, omega: [f64; 4]) {
        if t < self.from {
            return;
        }
        let squares = omega.map(|w| w * w);
        if let Some((_, last)) = &mut self.span {
            *last = t;
            self.total += squares.iter().zip(self.squares).map(|(new, old)| (new - old).abs()).sum::<f64>();
        } else {
            self.span = Some((t, t));
        }
        self.squares = squares;
    }

    pub(crate) fn per_second(&self) -> Option<f64> {
        // One row alone gives 0/0: not finite, hence not defined.
        self.span.and_then(|(first, last)| finite(self.total / (last - first)))
    }
}

/// The greatest value of about the last second: of ten blocks of a tenth, the newest of which is being filled.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Recent {
    blocks: [f64; Self::BLOCKS],
    newest: u64,
}

impl Recent {
    const BLOCKS: usize = 10;

    /// Takes the value at time `t` (s), not before the one of the last call. A NaN is greater than any.
    pub(crate) fn take(&mut self, t: f64, value: f64) {
        let block = (t * Self::BLOCKS as f64) as u64;
        let passed = block.saturating_sub(self.newest).min(Self::BLOCKS as u64);
        for i in 0..passed {
            self.blocks[((block - i) % Self::BLOCKS as u64) as usize] = 0.0;
        }
        self.newest = self.newest.max(block);
        let greatest = &mut self.blocks[(self.newest % Self::BLOCKS as u64) as usize];
        if value.is_nan() || value > *greatest {
            *greatest = value;
        }
    }

    /// The greatest; infinite if a value was NaN.
    pub(crate) fn max(&self) -> f64 {
        self.blocks.iter().fold(0.0, |most, value| if value.is_nan() { f64::INFINITY } else { value.max(most) })
    }
}

/// `None` for what JSON cannot hold.
pub(crate) fn finite(value: f64) -> Option<f64> {
    value.is_finite().then_some(value)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_recent_is_the_last_second() {
        let mut recent = Recent::default();
        for k in 0..5000_u32 {
            // 7 until 3.5 s, then 2 but for one tick at 4.2 s.
            let value = if k < 3500 {
                7.0
            } else if k == 4200 {
                3.0
            } else {
                2.0
            };
            recent.take(f64::from(k) / 1e3, value);
            let expected = if k < 4400 { 7.0 } else { 3.0 };
            assert!(recent.max() == expected, "{k}: {}", recent.max());
        }
        recent.take(5.0, f64::NAN);
        assert!(recent.max().is_infinite());
    }
}

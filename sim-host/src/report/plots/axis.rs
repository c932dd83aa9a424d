//! An axis: its range, never narrower than is worth looking at, its unit, and ticks at round numbers.

/// What is shown of a quantity at least, in its unit: below it, all is numerical noise to a quadrotor.
mod least {
    /// A place: a vehicle is half a metre wide.
    pub(super) const PLACE_M: f64 = 1.0;
    /// A position's error: motion capture is good to a millimetre.
    pub(super) const METRE: f64 = 2e-3;
    /// 0.01° tilts the thrust by 2 mm/s².
    pub(super) const DEGREE: f64 = 0.02;
    /// A velocity's error: satellite navigation is good to centimetres a second.
    pub(super) const METRE_PER_SECOND: f64 = 0.02;
    /// The weight of a gram.
    pub(super) const NEWTON: f64 = 0.01;
    /// That of a gram at 10 cm.
    pub(super) const NEWTON_METRE: f64 = 1e-3;
    /// A rotor's speed: one turn in six seconds.
    pub(super) const RADIAN_PER_SECOND: f64 = 1.0;
    /// Accelerations, linear and angular.
    pub(super) const ACCELERATION: f64 = 0.01;
}

/// A unit, with what is worth showing of it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Unit {
    /// m or mm.
    Metre,
    /// °.
    Degree,
    /// m/s or mm/s.
    MetrePerSecond,
    /// N or mN.
    Newton,
    /// N m or mN m.
    NewtonMetre,
    /// rad/s.
    RadianPerSecond,
    /// m/s² and rad/s².
    Acceleration(&'static str),
}

impl Unit {
    fn name(self) -> &'static str {
        match self {
            Self::Metre => "m",
            Self::Degree => "°",
            Self::MetrePerSecond => "m/s",
            Self::Newton => "N",
            Self::NewtonMetre => "N m",
            Self::RadianPerSecond => "rad/s",
            Self::Acceleration(name) => name,
        }
    }

    fn least_span(self) -> f64 {
        match self {
            Self::Metre => least::METRE,
            Self::Degree => least::DEGREE,
            Self::MetrePerSecond => least::METRE_PER_SECOND,
            Self::Newton => least::NEWTON,
            Self::NewtonMetre => least::NEWTON_METRE,
            Self::RadianPerSecond => least::RADIAN_PER_SECOND,
            Self::Acceleration(_) => least::ACCELERATION,
        }
    }

    /// Whether thousandths of it have a name that people use.
    fn has_thousandths(self) -> bool {
        matches!(self, Self::Metre | Self::MetrePerSecond | Self::Newton | Self::NewtonMetre)
    }
}

/// What an axis shows: its name, its unit and the least that is shown of it.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Quantity {
    name: String,
    unit: Option<Unit>,
    least_span: f64,
}

impl Quantity {
    /// A quantity in a unit.
    pub(super) fn new(name: impl Into<String>, unit: Unit) -> Self {
        Self { name: name.into(), unit: Some(unit), least_span: unit.least_span() }
    }

    /// A coordinate in the world, m.
    pub(super) fn place(name: impl Into<String>) -> Self {
        Self { least_span: least::PLACE_M, ..Self::new(name, Unit::Metre) }
    }

    /// Shown over at least `span`, in the unit.
    pub(super) fn at_least(self, span: f64) -> Self {
        Self { least_span: span, ..self }
    }

    /// Name and unit as the axis shows them, and the factor from the unit to that shown, for a range.
    pub(super) fn label(&self, (low, high): (f64, f64)) -> (String, f64) {
        let Some(unit) = self.unit else { return (self.name.clone(), 1.0) };
        let small = unit.has_thousandths() && low.abs().max(high.abs()) < 0.3;
        let (prefix, factor) = if small { ("m", 1e3) } else { ("", 1.0) };
        (format!("{}, {prefix}{}", self.name, unit.name()), factor)
    }

    /// The step from one tick to the next in what is shown, for at most `most` steps in `size`. Angles go by eighths of
    /// a turn.
    pub(super) fn step(&self, size: f64, most: f64) -> f64 {
        let round = step(size, most);
        match (self.unit, round as u32) {
            (Some(Unit::Degree), 50) => 45.0,
            (Some(Unit::Degree), 100) => 90.0,
            (Some(Unit::Degree), 200) => 180.0,
            _ => round,
        }
    }

    /// A range that shows all values with a margin (a fraction of its size), and no less than is worth it.
    pub(super) fn range(&self, values: Option<(f64, f64)>, margin: f64) -> (f64, f64) {
        let (low, high) = values.unwrap_or((0.0, 0.0));
        // Of what has no unit, a thousandth of its size.
        let least = self.least_span.max(1e-3 * low.abs().max(high.abs())).max(1e-9);
        let half = (0.5 * (high - low) * (1.0 + 2.0 * margin)).max(0.5 * least);
        let middle = f64::midpoint(low, high);
        (middle - half, middle + half)
    }
}

/// A quantity whose label is written out, unit and all.
impl From<&str> for Quantity {
    fn from(label: &str) -> Self {
        Self { name: label.into(), unit: None, least_span: 0.0 }
    }
}

impl From<&String> for Quantity {
    fn from(label: &String) -> Self {
        label.as_str().into()
    }
}

/// 1, 2 or 5 times a power of ten, so that `size` has at most `most` steps.
pub(super) fn step(size: f64, most: f64) -> f64 {
    /// Fraction of a step that may be ignored in rounding to it.
    const HAIR: f64 = 1e-6;
    let least = size / most.max(1.0);
    let power = libm::pow(10.0, libm::log10(least).floor());
    let factor = least / power - HAIR;
    let round = [1.0, 2.0, 5.0].into_iter().find(|round| factor <= *round).unwrap_or(10.0);
    power * round
}

/// The multiples of a step within a range.
pub(super) fn ticks((low, high): (f64, f64), step: f64) -> Vec<f64> {
    let hair = 1e-6 * step;
    let (first, last) = (((low - hair) / step).ceil(), ((high + hair) / step).floor());
    let count = (last - first).clamp(0.0, 100.0) as u32;
    (0..=count).map(|i| (first + f64::from(i)) * step).filter(|v| (low - hair..=high + hair).contains(v)).collect()
}

/// From this step on, labels would be too long for the place beside the axis.
const LONG_STEP: f64 = 1e5;

/// A tick's label with as many decimals as steps of `step` need.
pub(super) fn label(value: f64, step: f64) -> String {
    let decimals = (-(libm::log10(step) + 1e-9).floor()).clamp(0.0, 9.0) as usize;
    let value = if value.abs() < 1e-6 * step { 0.0 } else { value };
    // Of what has diverged the size matters, not its digits.
    let text = if step >= LONG_STEP && value != 0.0 { format!("{value:e}") } else { format!("{value:.decimals$}") };
    text.replace('-', "−")
}

/// The label of a tick at a logarithm.
pub(super) fn decade(logarithm: f64) -> String {
    let whole = logarithm.round();
    format!("{:.1$}", libm::pow(10.0, whole), (-whole).max(0.0) as usize)
}

/// The whole decades within a range of logarithms.
pub(super) fn decades((low, high): (f64, f64)) -> Vec<f64> {
    let (first, last) = ((low - 1e-6).ceil() as i32, (high + 1e-6).floor() as i32);
    (first..=last).map(f64::from).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn steps_are_one_two_or_five() {
        assert_eq!([8.0, 10.0, 22.0].map(|size| step(size, 5.0)), [2.0, 2.0, 5.0]);
        assert!((step(0.5, 5.0) - 0.1).abs() < 1e-15);
    }

    #[test]
    fn ticks_are_round_and_inside() {
        assert_eq!(ticks((-0.3, 4.2), 1.0), [0.0, 1.0, 2.0, 3.0, 4.0]);
        assert_eq!(ticks((0.0, 90.0), step(90.0, 5.0)), [0.0, 20.0, 40.0, 60.0, 80.0]);
        let yaw = Quantity::new("yaw", Unit::Degree);
        assert_eq!(ticks((-190.0, 190.0), yaw.step(380.0, 5.0)), [-180.0, -90.0, 0.0, 90.0, 180.0]);
        for (low, high) in [(0.0, 1e-3), (-7.3, 1e6), (99.9999, 100.0001)] {
            let ticks = ticks((low, high), step(high - low, 6.0));
            assert!((2..=7).contains(&ticks.len()), "{ticks:?}");
        }
    }

    #[test]
    fn labels_have_the_decimals_that_they_need() {
        assert_eq!(label(0.5, 0.5), "0.5");
        assert_eq!(label(15.0, 5.0), "15");
        assert_eq!(label(-1e-17, 2.0), "0");
        assert_eq!(label(-0.002, 0.001), "−0.002");
        assert_eq!(label(-150_000_000.0, 50_000_000.0), "−1.5e8");
        assert_eq!([decade(-2.0), decade(3.0)], ["0.01", "1000"]);
    }

    #[test]
    fn noise_is_not_blown_up() {
        let error = Quantity::new("x error", Unit::Metre);
        let range = error.range(Some((-1e-12, 2e-12)), 0.05);
        assert!(range.1 - range.0 >= 2e-3 - 1e-12, "{range:?}");
        assert_eq!(error.label(range), ("x error, mm".into(), 1e3));
        assert_eq!(error.label((0.0, 5.0)), ("x error, m".into(), 1.0));
    }

    #[test]
    fn ranges_are_never_empty_and_hold_all_values() {
        for quantity in [Quantity::from("ratio"), Quantity::new("roll", Unit::Degree), Quantity::place("x")] {
            for range in [None, Some((0.0, 0.0)), Some((7.0, 7.0)), Some((-1e9, 1e9))] {
                let (low, high) = quantity.range(range, 0.05);
                assert!(low < high && (high - low).is_finite(), "{range:?}");
                let (least, most) = range.unwrap_or((0.0, 0.0));
                assert!(low <= least && most <= high);
            }
        }
    }
}

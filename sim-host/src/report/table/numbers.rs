//! Numbers as cells of a table.

pub(super) fn seconds(time: Option<f64>) -> String {
    time.map_or_else(|| "no".into(), |t| format!("{t:.3} s"))
}

/// A number with so many decimals, or by its size where it has diverged.
pub(super) fn number(value: f64, digits: usize) -> String {
    if value.abs() < DIVERGED { format!("{value:.digits$}") } else { format!("{value:.1e}") }
}

/// An error in thousandths of its unit, or in the unit where that would be a long number.
pub(super) fn error(value: Option<f64>, unit: &str) -> String {
    match value {
        None => undefined(),
        Some(v) if v >= 1e6 => format!("{v:.1e} {unit}"),
        Some(v) if v >= 1.0 => format!("{v:.2} {unit}"),
        Some(v) => format!("{:.3} m{unit}", 1e3 * v),
    }
}

/// From here on digits mean nothing: rotors' total variation is below it in every flight that is flown well.
const DIVERGED: f64 = 1e9;

pub(super) fn undefined() -> String {
    "–".into()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn errors_are_readable_at_any_size() {
        assert_eq!(error(Some(0.000_012), "m"), "0.012 mm");
        assert_eq!(error(Some(0.25), "rad"), "250.000 mrad");
        assert_eq!(error(Some(12.345), "m"), "12.35 m");
        assert_eq!(error(Some(1.0e12), "m"), "1.0e12 m");
        assert_eq!((number(0.26875, 4).as_str(), number(1.62e33, 4).as_str()), ("0.2687", "1.6e33"));
    }
}

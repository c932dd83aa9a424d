//! Configuration errors, and the range checks that configuration types share.

/// Error of a configuration, with the name of the field.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ConfigError {
    /// Not a finite number.
    NonFinite(&'static str),
    /// Must be above zero.
    NotPositive(&'static str),
    /// Must not be below zero.
    Negative(&'static str),
    /// Outside the range the field allows.
    OutOfRange(&'static str),
    /// The rotors cannot produce thrust and three torques independently.
    SingularGeometry,
}

/// Greatest accepted value, in SI units: the product of three still fits an f32.
const LARGEST: f32 = 1e9;

impl ConfigError {
    /// Checks that `value` is from 1e-9 to 1e9, where f32 arithmetic neither overflows nor underflows.
    ///
    /// # Errors
    /// `name`, if it is not.
    pub fn require_positive(name: &'static str, value: f32) -> Result<(), Self> {
        if !value.is_finite() {
            Err(Self::NonFinite(name))
        } else if value <= 0.0 {
            Err(Self::NotPositive(name))
        } else if (1e-9..=LARGEST).contains(&value) {
            Ok(())
        } else {
            Err(Self::OutOfRange(name))
        }
    }

    /// Checks that `value` is from 0 to 1e9.
    ///
    /// # Errors
    /// `name`, if it is not.
    pub fn require_not_negative(name: &'static str, value: f32) -> Result<(), Self> {
        if !value.is_finite() {
            Err(Self::NonFinite(name))
        } else if value < 0.0 {
            Err(Self::Negative(name))
        } else if value <= LARGEST {
            Ok(())
        } else {
            Err(Self::OutOfRange(name))
        }
    }
}

impl core::fmt::Display for ConfigError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self {
            Self::NonFinite(name) => write!(f, "`{name}` is not a finite number"),
            Self::NotPositive(name) => write!(f, "`{name}` must be above zero"),
            Self::Negative(name) => write!(f, "`{name}` must not be negative"),
            Self::OutOfRange(name) => write!(f, "`{name}` is out of its range"),
            Self::SingularGeometry => f.write_str("`airframe.geometry` cannot produce thrust and three torques"),
        }
    }
}

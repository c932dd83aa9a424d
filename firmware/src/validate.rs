//! Configuration errors, and the range checks that configuration types share.

/// The dotted key of a configuration field, in two pieces: that of its group, and its own within the group.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Field {
    /// Key of the group, as `control.x`; empty for a field whose own key is the whole.
    pub group: &'static str,
    /// Key in the group, as `lambda` or `reaching.sat.rho`.
    pub name: &'static str,
}

impl Field {
    /// A field of a group.
    pub const fn of(group: &'static str, name: &'static str) -> Self {
        Self { group, name }
    }
}

impl From<&'static str> for Field {
    fn from(name: &'static str) -> Self {
        Self { group: "", name }
    }
}

impl core::fmt::Display for Field {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        if !self.group.is_empty() {
            write!(f, "{}.", self.group)?;
        }
        f.write_str(self.name)
    }
}

/// Error of a configuration, with the field and the bounds that it violates.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ConfigError {
    /// Not a finite number.
    NonFinite(Field),
    /// Must be above zero.
    NotPositive(Field),
    /// Must not be below zero.
    Negative(Field),
    /// Outside `low ..= high`.
    OutOfRange {
        /// The field.
        field: Field,
        /// Least value.
        low: f32,
        /// Greatest value.
        high: f32,
    },
    /// Must be below this limit.
    NotBelow(Field, f32),
    /// The rotors cannot produce thrust and three torques independently.
    SingularGeometry,
}

/// Least and greatest accepted size, in SI units: a product of three still fits an f32.
const SMALLEST: f32 = 1e-9;
const LARGEST: f32 = 1e9;

impl ConfigError {
    /// Checks that `value` is from 1e-9 to 1e9, where f32 arithmetic neither overflows nor underflows.
    ///
    /// # Errors
    /// `field`, if it is not.
    pub fn require_positive(field: impl Into<Field>, value: f32) -> Result<(), Self> {
        let field = field.into();
        if value <= 0.0 {
            return Err(Self::NotPositive(field));
        }
        Self::require_within(field, value, SMALLEST, LARGEST)
    }

    /// Checks that `value` is from 0 to 1e9.
    ///
    /// # Errors
    /// `field`, if it is not.
    pub fn require_not_negative(field: impl Into<Field>, value: f32) -> Result<(), Self> {
        let field = field.into();
        if value < 0.0 {
            return Err(Self::Negative(field));
        }
        Self::require_within(field, value, 0.0, LARGEST)
    }

    /// Checks that `value` is a number within `low ..= high`.
    ///
    /// # Errors
    /// `field`, if it is not.
    pub fn require_within(field: impl Into<Field>, value: f32, low: f32, high: f32) -> Result<(), Self> {
        let field = field.into();
        if value.is_nan() {
            Err(Self::NonFinite(field))
        } else if (low..=high).contains(&value) {
            Ok(())
        } else {
            Err(Self::OutOfRange { field, low, high })
        }
    }

    /// Checks that `value` is below `limit`.
    ///
    /// # Errors
    /// `field`, if it is not.
    pub fn require_below(field: impl Into<Field>, value: f32, limit: f32) -> Result<(), Self> {
        if value < limit { Ok(()) } else { Err(Self::NotBelow(field.into(), limit)) }
    }
}

/// The values that a number of the configuration may have, and by which its violation is named.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Range {
    /// 1e-9 to 1e9 (see [`ConfigError::require_positive`]).
    Positive,
    /// 1e-9 up to below a limit.
    PositiveBelow(f32),
    /// 0 to 1e9.
    NotNegative,
    /// 0 up to below a limit.
    NotNegativeBelow(f32),
    /// A closed interval.
    Within(f32, f32),
    /// From a value up to below a limit.
    WithinBelow(f32, f32),
    /// Any finite number.
    Finite,
    /// Any positive finite number.
    FinitePositive,
}

impl Range {
    /// Least value.
    pub const fn min(self) -> f32 {
        match self {
            Self::Positive | Self::PositiveBelow(_) => SMALLEST,
            Self::NotNegative | Self::NotNegativeBelow(_) => 0.0,
            Self::Within(low, _) | Self::WithinBelow(low, _) => low,
            Self::Finite => f32::MIN,
            Self::FinitePositive => f32::MIN_POSITIVE,
        }
    }

    /// Greatest value.
    pub const fn max(self) -> f32 {
        match self {
            Self::Positive | Self::NotNegative => LARGEST,
            Self::PositiveBelow(limit) | Self::NotNegativeBelow(limit) | Self::WithinBelow(_, limit) => {
                limit.next_down()
            }
            Self::Within(_, high) => high,
            Self::Finite | Self::FinitePositive => f32::MAX,
        }
    }

    /// Checks a value.
    ///
    /// # Errors
    /// `field` with the bound that the value violates.
    pub fn check(self, field: impl Into<Field>, value: f32) -> Result<(), ConfigError> {
        let field = field.into();
        match self {
            Self::Positive => ConfigError::require_positive(field, value),
            Self::PositiveBelow(limit) => {
                ConfigError::require_positive(field, value)?;
                ConfigError::require_below(field, value, limit)
            }
            Self::NotNegative => ConfigError::require_not_negative(field, value),
            Self::NotNegativeBelow(limit) => {
                ConfigError::require_not_negative(field, value)?;
                ConfigError::require_below(field, value, limit)
            }
            Self::Within(low, high) => ConfigError::require_within(field, value, low, high),
            Self::WithinBelow(low, limit) => {
                if value < low {
                    return Err(ConfigError::OutOfRange { field, low, high: limit });
                }
                ConfigError::require_within(field, value, low, f32::INFINITY)?;
                ConfigError::require_below(field, value, limit)
            }
            Self::Finite | Self::FinitePositive if !value.is_finite() => Err(ConfigError::NonFinite(field)),
            Self::FinitePositive if value <= 0.0 => Err(ConfigError::NotPositive(field)),
            Self::Finite | Self::FinitePositive => Ok(()),
        }
    }
}

/// Without the bounds: a board would need a formatter of floats for them. The desktop's messages name them.
impl core::fmt::Display for ConfigError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self {
            Self::NonFinite(field) => write!(f, "`{field}` is not a finite number"),
            Self::NotPositive(field) => write!(f, "`{field}` must be above zero"),
            Self::Negative(field) => write!(f, "`{field}` must not be negative"),
            Self::OutOfRange { field, .. } => write!(f, "`{field}` is out of its range"),
            Self::NotBelow(field, _) => write!(f, "`{field}` is too large"),
            Self::SingularGeometry => f.write_str("`airframe.geometry` cannot produce thrust and three torques"),
        }
    }
}

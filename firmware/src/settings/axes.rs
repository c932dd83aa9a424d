//! The rows of the six axes: the same for each.

use super::table::{Class, Domain, Place, Setting, Slot, Value};
use crate::control::gains::{AxisNumber, ReachingLaw, Surface};
use crate::validate::Field;

/// Rows of an axis.
pub(super) const PER_AXIS: usize = 11;
/// Within an axis: the reaching law, and the first and the last of its numbers, which follow it.
const LAW: usize = 2;
const FIRST_NUMBER: usize = 3;
const LAST_NUMBER: usize = 7;

/// Rows of all axes.
pub(super) const AXES_COUNT: usize = 6 * PER_AXIS;

/// Units of an axis' numbers: of s, of its first and of its second derivative.
struct Units {
    s: &'static str,
    per_s: &'static str,
    per_s2: &'static str,
}

const ANGLE: Units = Units { s: "rad/s", per_s: "rad/s^2", per_s2: "rad/s^3" };
const LENGTH: Units = Units { s: "m/s", per_s: "m/s^2", per_s2: "m/s^3" };

/// A number of an axis.
const fn number(
    name: &'static str,
    unit: &'static str,
    text: &'static str,
    number: AxisNumber,
    (group, place): (&'static str, Place),
) -> Setting {
    let default = match number.default_shape() {
        0.0 => None,
        shape => Some(Value::Real(shape)),
    };
    let key = Field::of(group, number.name());
    Setting {
        name,
        unit,
        text,
        class: Class::InFlight,
        domain: Domain::Real(number.range()),
        scale: 1.0,
        default,
        key,
        place,
    }
}

/// A choice of an axis.
const fn choice(
    name: &'static str,
    text: &'static str,
    greatest: i32,
    (group, key): (&'static str, &'static str),
    place: Place,
) -> Setting {
    let (domain, key) = (Domain::Whole(0, greatest), Field::of(group, key));
    Setting { name, unit: "", text, class: Class::Disarmed, domain, scale: 1.0, default: None, key, place }
}

/// Access to a number of axis `$i`.
macro_rules! at {
    ($place:ident, $i:literal, $number:ident) => {
        Place::$place(Slot {
            get: |gains| gains.axes[$i].number(AxisNumber::$number).map(Value::Real),
            set: |gains, value| {
                if let Some(number) = gains.axes[$i].number_mut(AxisNumber::$number) {
                    *number = value.real();
                }
            },
        })
    };
}

/// The rows of axis `$i` of a law.
macro_rules! axis {
    ($place:ident, $i:literal, $name:literal, $group:literal, $units:ident) => {
        [
            number(concat!("SMC_", $name, "_LAMBDA"), "1/s", "Slope of the sliding surface", AxisNumber::Lambda, ($group, at!($place, $i, Lambda))),
            number(concat!("SMC_", $name, "_K"), $units.per_s, "Reaching gain", AxisNumber::Gain, ($group, at!($place, $i, Gain))),
            choice(
                concat!("SMC_", $name, "_LAW"),
                "Reaching law: 0 sgn, 1 sat, 2 tanh, 3 power, 4 exponential, 5 implicit sgn, 6 super-twisting, 7 implicit super-twisting",
                ReachingLaw::CODE_MAX,
                ($group, "reaching"),
                Place::$place(Slot {
                    get: |gains| Some(Value::Int(gains.axes[$i].reaching.code())),
                    set: |gains, value| gains.axes[$i].choose_law(value.int()),
                }),
            ),
            number(concat!("SMC_", $name, "_RHO"), $units.s, "Half-width of the boundary layer: laws 1, 2, 4", AxisNumber::Rho, ($group, at!($place, $i, Rho))),
            number(concat!("SMC_", $name, "_ALPHA"), "", "Exponent: law 3", AxisNumber::Alpha, ($group, at!($place, $i, Alpha))),
            number(concat!("SMC_", $name, "_RATE"), "1/s", "Rate of exponential reaching: law 4", AxisNumber::Rate, ($group, at!($place, $i, Rate))),
            number(concat!("SMC_", $name, "_TWIST"), $units.per_s2, "Gain k2 of super-twisting: laws 6, 7", AxisNumber::Twist, ($group, at!($place, $i, Twist))),
            number(concat!("SMC_", $name, "_HORIZ"), "s", "Horizon of backward Euler: laws 5, 7", AxisNumber::Horizon, ($group, at!($place, $i, Horizon))),
            choice(
                concat!("SMC_", $name, "_SURF"),
                "Sliding surface: 0 linear, 1 integral",
                1,
                ($group, "surface"),
                Place::$place(Slot {
                    get: |gains| Some(Value::Int(gains.axes[$i].surface.code())),
                    set: |gains, value| gains.axes[$i].surface = Surface::of_code(value.int()),
                }),
            ),
            number(concat!("SMC_", $name, "_APPR"), $units.s, "Greatest rate at which a large error is reduced", AxisNumber::ApproachMax, ($group, at!($place, $i, ApproachMax))),
            number(concat!("SMC_", $name, "_BRAKE"), $units.per_s, "Greatest deceleration along the surface", AxisNumber::Braking, ($group, at!($place, $i, Braking))),
        ]
    };
}

/// The rows of roll, pitch, yaw, x, y and z.
pub(super) const AXES: [Setting; AXES_COUNT] = {
    let axes: [[Setting; PER_AXIS]; 6] = [
        axis!(Attitude, 0, "ROLL", "control.roll", ANGLE),
        axis!(Attitude, 1, "PITCH", "control.pitch", ANGLE),
        axis!(Attitude, 2, "YAW", "control.yaw", ANGLE),
        axis!(Position, 0, "X", "control.x", LENGTH),
        axis!(Position, 1, "Y", "control.y", LENGTH),
        axis!(Position, 2, "Z", "control.z", LENGTH),
    ];
    let mut all = [axes[0][0]; AXES_COUNT];
    let mut row = 0;
    while row < AXES_COUNT {
        all[row] = axes[row / PER_AXIS][row % PER_AXIS];
        row += 1;
    }
    all
};

/// Whether a row of [`AXES`] is a reaching law.
pub(super) const fn is_law(row: usize) -> bool {
    row < AXES_COUNT && row % PER_AXIS == LAW
}

/// The rows of a law's numbers, for the row of the law.
pub(super) const fn numbers_of(law: usize) -> core::ops::RangeInclusive<usize> {
    law + (FIRST_NUMBER - LAW)..=law + (LAST_NUMBER - LAW)
}

/// The row of the law to which a row of a number belongs.
pub(super) const fn law_of(row: usize) -> Option<usize> {
    let place = row % PER_AXIS;
    if row < AXES_COUNT && place >= FIRST_NUMBER && place <= LAST_NUMBER { Some(row - place + LAW) } else { None }
}

/// Whether the law of a code has the number of a row.
pub(super) const fn law_has(code: i32, row: usize) -> bool {
    match row % PER_AXIS {
        3 => matches!(code, 1 | 2 | 4),
        4 => code == 3,
        5 => code == 4,
        6 => matches!(code, 6 | 7),
        7 => matches!(code, 5 | 7),
        _ => true,
    }
}

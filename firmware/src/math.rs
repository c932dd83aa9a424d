//! All `f32` mathematics of the firmware.
//!
//! Owns the implementation of each function, with its error bound. Everything here is written out in `f32` or comes
//! from `libm`, so desktop and Cortex-M4F give the same bits. `std`'s methods and the target's own `max`/`min` do not,
//! and `clippy.toml` forbids them elsewhere in this crate.

use core::f32::consts::{FRAC_PI_2, FRAC_PI_4, PI, TAU};

use nalgebra::SVector;

/// Square root, correctly rounded, by the core's own instruction; `libm` would need 52 instructions.
#[cfg(all(target_arch = "arm", target_abi = "eabihf"))]
#[inline]
pub fn sqrt(x: f32) -> f32 {
    /// Argument and result are in s0 (AAPCS, hard float). The `.fpu` directive is needed because the assembler does not
    /// know the target's floating-point unit while it collects the symbols of a crate for link-time optimisation.
    #[unsafe(naked)]
    extern "C" fn vsqrt(x: f32) -> f32 {
        core::arch::naked_asm!(".fpu fpv4-sp-d16", "vsqrt.f32 s0, s0", "bx lr")
    }
    vsqrt(x)
}

/// Square roots, correctly rounded, by one call: the compiler saves its registers for each call it cannot see into.
#[cfg(all(target_arch = "arm", target_abi = "eabihf"))]
#[inline]
pub fn sqrt_each([a, b, c, d]: [f32; 4]) -> [f32; 4] {
    #[repr(C)]
    struct Four(f32, f32, f32, f32);
    /// A structure of four floats is passed and returned in s0 to s3 (AAPCS, hard float).
    #[unsafe(naked)]
    extern "C" fn vsqrt(x: Four) -> Four {
        core::arch::naked_asm!(
            ".fpu fpv4-sp-d16",
            "vsqrt.f32 s0, s0",
            "vsqrt.f32 s1, s1",
            "vsqrt.f32 s2, s2",
            "vsqrt.f32 s3, s3",
            "bx lr",
        )
    }
    let Four(a, b, c, d) = vsqrt(Four(a, b, c, d));
    [a, b, c, d]
}

/// Square roots, correctly rounded.
#[cfg(not(all(target_arch = "arm", target_abi = "eabihf")))]
#[inline]
pub fn sqrt_each(x: [f32; 4]) -> [f32; 4] {
    x.map(sqrt)
}

/// Square root, correctly rounded.
#[cfg(not(all(target_arch = "arm", target_abi = "eabihf")))]
#[inline]
pub fn sqrt(x: f32) -> f32 {
    libm::sqrtf(x)
}

/// The larger of two numbers; `b` where either is NaN. Unlike `f32::max`, the same everywhere for ±0.
#[inline]
pub fn max(a: f32, b: f32) -> f32 {
    if a > b { a } else { b }
}

/// The smaller of two numbers; `b` where either is NaN. Unlike `f32::min`, the same everywhere for ±0.
#[inline]
pub fn min(a: f32, b: f32) -> f32 {
    if a < b { a } else { b }
}

/// `x` limited to `low ..= high`; `low` where `x` is NaN.
#[inline]
pub fn clamp(x: f32, low: f32, high: f32) -> f32 {
    min(max(x, low), high)
}

/// `x` limited to ±`most`; `-most` where `x` is NaN. Like [`clamp`], but with a single comparison while no limit acts.
#[inline]
pub fn limit(x: f32, most: f32) -> f32 {
    if abs(x) <= most {
        x
    } else if x > 0.0 {
        most
    } else {
        -most
    }
}

/// `x` limited to `0.0 ..= most`; 0 where `x` is NaN. The bit patterns of non-negative floats are ordered like the
/// floats, and those of negative ones and of NaN are greater: a single comparison shows that neither limit acts.
#[inline]
pub fn limit_positive(x: f32, most: f32) -> f32 {
    if x.to_bits() <= most.to_bits() { x } else { clamp(x, 0.0, most) }
}

/// The rate by which an error is to go: `gain` times it while it is small, and beyond that the rate from which it can be braked
/// with `most` of the next derivative, so that it ends on one curve however large it is.
#[inline]
pub fn braked(error: f32, gain: f32, most: f32) -> f32 {
    let linear = most / (gain * gain);
    let size = abs(error);
    if size <= linear {
        return gain * error;
    }
    let rate = sqrt(most * (2.0 * size - linear));
    if error < 0.0 { -rate } else { rate }
}

/// A vector limited to a length.
#[inline]
pub fn shorten<const N: usize>(vector: SVector<f32, N>, most: f32) -> SVector<f32, N> {
    let square = vector.norm_squared();
    if square <= most * most { vector } else { vector * (most / sqrt(square)) }
}

/// Magnitude.
#[inline]
pub fn abs(x: f32) -> f32 {
    f32::from_bits(x.to_bits() & 0x7fff_ffff)
}

/// Sine and cosine of an angle (rad), by Cody–Waite reduction and the Cephes `sinf`/`cosf` polynomials.
///
/// Absolute error below 1.0e-7 for |x| ≤ 2π and below 1e-4 up to 1e3. Wrap larger angles first (see [`Phase`]); beyond
/// 1e9 the result is NaN.
#[inline]
pub fn sin_cos(x: f32) -> (f32, f32) {
    // π/2 as a sum of three terms, the first two with few enough bits that their product with k is exact.
    const PART_1: f32 = 1.570_312_5;
    const PART_2: f32 = 4.837_513e-4;
    const PART_3: f32 = 7.549_79e-8;
    let scaled = x * core::f32::consts::FRAC_2_PI;
    let k = (scaled + if scaled < 0.0 { -0.5 } else { 0.5 }) as i32;
    let kf = k as f32;
    let r = ((x - kf * PART_1) - kf * PART_2) - kf * PART_3;
    let z = r * r;
    let sine = r + r * z * (-1.666_665_5e-1 + z * (8.332_161e-3 - z * 1.951_529_6e-4));
    let cosine = 1.0 - 0.5 * z + z * z * (4.166_664_6e-2 + z * (-1.388_731_6e-3 + z * 2.443_315_7e-5));
    match k & 3 {
        0 => (sine, cosine),
        1 => (cosine, -sine),
        2 => (-sine, -cosine),
        _ => (-cosine, sine),
    }
}

/// Angle of the point (x, y) from the x axis, rad in −π..=π, by the Cephes `atanf` polynomial with one division.
///
/// Absolute error below 4e-7; 0 at the origin, where the angle is undefined. Half the cost of `libm`'s, whose accuracy
/// of an ulp is not needed here.
#[inline]
pub fn atan2(y: f32, x: f32) -> f32 {
    /// tan(π/8): the polynomial is accurate up to here.
    const TAN_PI_8: f32 = 0.414_213_57;
    let (ax, ay) = (abs(x), abs(y));
    let (small, large) = if ay > ax { (ax, ay) } else { (ay, ax) };
    if large == 0.0 {
        return 0.0;
    }
    // atan(s/l), or π/4 + atan((s−l)/(s+l)) in the upper half of the octant.
    let (numerator, denominator, offset) =
        if small > TAN_PI_8 * large { (small - large, small + large, FRAC_PI_4) } else { (small, large, 0.0) };
    let t = numerator / denominator;
    let z = t * t;
    let series = ((8.053_744_5e-2 * z - 1.387_768_6e-1) * z + 1.997_771_1e-1) * z - 3.333_295e-1;
    let octant = offset + (t + t * z * series);
    let quadrant = if ay > ax { FRAC_PI_2 - octant } else { octant };
    let half = if x < 0.0 { PI - quadrant } else { quadrant };
    if y < 0.0 { -half } else { half }
}

/// e^x, by `libm`.
#[inline]
pub fn exp(x: f32) -> f32 {
    libm::expf(x)
}

/// `x^exponent` for x > 0, by `libm`: 219 instructions, so not for the control loops.
#[inline]
pub fn powf(x: f32, exponent: f32) -> f32 {
    libm::powf(x, exponent)
}

/// Hyperbolic tangent, by `libm`.
#[inline]
pub fn tanh(x: f32) -> f32 {
    libm::tanhf(x)
}

/// `x^exponent` for x ≥ 0 by micromath: relative error below 12 % for 1e-4 ≤ x ≤ 50 and 0 < exponent ≤ 1.
///
/// Only for reaching laws, where it scales a gain: with a gain 12 % off, the sliding surface is the same and the
/// reaching time is 12 % off. Zero maps to zero.
#[inline]
pub fn shape_power(x: f32, exponent: f32) -> f32 {
    if x > 0.0 { micromath::F32(x).powf(micromath::F32(exponent)).0 } else { 0.0 }
}

/// An angle wrapped to −π..π, for |angle| up to a few turns.
#[inline]
pub fn wrap_angle(angle: f32) -> f32 {
    if angle > PI {
        angle - TAU * (((angle + PI) / TAU) as i32) as f32
    } else if angle < -PI {
        angle + TAU * (((PI - angle) / TAU) as i32) as f32
    } else {
        angle
    }
}

/// A linearly increasing angle, counted in 2⁻⁶⁴ turns per tick, so that it is as exact after a day as after a second.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Phase {
    per_tick: u64,
}

impl Phase {
    /// A phase that advances by `rate_rad_s` with ticks `tick_s` apart. Slow (soft `f64` on the target): for
    /// configuration, not for the loop.
    pub fn new(rate_rad_s: f32, tick_s: f64) -> Self {
        let turns = f64::from(rate_rad_s) * tick_s / core::f64::consts::TAU;
        let scaled = turns * 18_446_744_073_709_551_616.0;
        Self { per_tick: (scaled as i64) as u64 }
    }

    /// The angle after `ticks`, rad in −π..π.
    #[inline]
    pub fn at(self, ticks: u32) -> f32 {
        let turns = self.per_tick.wrapping_mul(u64::from(ticks));
        let signed = (turns >> 32) as i32;
        signed as f32 * (PI / 2_147_483_648.0)
    }
}

/// True if every value is finite: 0·x is 0 for finite x only, and one comparison at the end is cheaper than one per
/// value.
#[inline]
pub fn all_finite(values: &[f32]) -> bool {
    let mut probe = 0.0;
    for value in values {
        probe += 0.0 * value;
    }
    probe == 0.0
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sweep(low: f64, high: f64) -> impl Iterator<Item = f32> {
        (0..=200_000).map(move |i| (low + (high - low) * f64::from(i) / 200_000.0) as f32)
    }

    #[test]
    fn sin_cos_error_is_below_1e_7_within_a_turn() {
        for x in sweep(-2.0 * core::f64::consts::PI, 2.0 * core::f64::consts::PI) {
            let (s, c) = sin_cos(x);
            assert!((f64::from(s) - f64::from(x).sin()).abs() < 1.0e-7, "sin {x}");
            assert!((f64::from(c) - f64::from(x).cos()).abs() < 1.0e-7, "cos {x}");
        }
    }

    #[test]
    fn atan2_error_is_below_4e_7_all_around_and_at_any_radius() {
        for angle in sweep(-core::f64::consts::PI, core::f64::consts::PI) {
            for radius in [1e-6, 1.0, 3e7] {
                let (y, x) = ((radius * f64::from(angle).sin()) as f32, (radius * f64::from(angle).cos()) as f32);
                let error = f64::from(atan2(y, x)) - f64::from(y).atan2(f64::from(x));
                assert!(error.abs() < 4e-7, "{y} {x}: {error}");
            }
        }
        assert_eq!(atan2(0.0, 0.0), 0.0);
        assert_eq!(atan2(0.0, -1.0), PI);
    }

    #[test]
    fn shape_power_error_is_below_12_percent_and_zero_is_zero() {
        for exponent in [0.25_f32, 0.5, 0.75, 1.0] {
            for x in sweep(1e-4, 50.0) {
                let exact = f64::from(x).powf(f64::from(exponent));
                let relative = (f64::from(shape_power(x, exponent)) - exact).abs() / exact;
                assert!(relative < 0.12, "{x}^{exponent}: {relative}");
            }
            assert_eq!(shape_power(0.0, exponent), 0.0);
        }
    }

    #[test]
    fn phase_keeps_its_accuracy_for_a_day() {
        let phase = Phase::new(1.0, 1e-3);
        for ticks in [0_u32, 1, 20_000, 3_600_000, 86_400_000] {
            let exact = (f64::from(ticks) * 1e-3).rem_euclid(core::f64::consts::TAU);
            let difference = (f64::from(phase.at(ticks)) - exact).rem_euclid(core::f64::consts::TAU);
            let error = difference.min(core::f64::consts::TAU - difference);
            assert!(error < 3e-7, "{ticks}: {error}");
        }
    }

    #[test]
    fn angles_wrap_to_half_a_turn() {
        for x in sweep(-20.0, 20.0) {
            let wrapped = wrap_angle(x);
            assert!((-PI - 1e-6..=PI + 1e-6).contains(&wrapped), "{x} -> {wrapped}");
            assert!((f64::from(wrapped).sin() - f64::from(x).sin()).abs() < 4e-6);
        }
    }

    #[test]
    fn all_finite_finds_one_that_is_not() {
        assert!(all_finite(&[f32::MAX, f32::MIN, -0.0, f32::MIN_POSITIVE, f32::MAX]));
        for bad in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
            for place in 0..4 {
                let mut values = [1.0; 4];
                values[place] = bad;
                assert!(!all_finite(&values));
            }
        }
    }

    #[test]
    fn the_cheap_limits_are_clamp() {
        let special = [f32::NAN, f32::INFINITY, f32::NEG_INFINITY, 0.0, 2.5, -2.5];
        for x in sweep(-5.0, 5.0).chain(special) {
            assert_eq!(limit(x, 2.5), clamp(x, -2.5, 2.5), "{x}");
            assert_eq!(limit_positive(x, 2.5), clamp(x, 0.0, 2.5), "{x}");
        }
        assert_eq!(limit_positive(-0.0, 2.5).to_bits(), 0);
    }

    #[test]
    fn not_a_number_is_limited_not_passed_on() {
        assert_eq!(clamp(f32::NAN, -1.0, 1.0), -1.0);
    }
}

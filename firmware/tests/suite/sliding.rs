//! What each reaching law promises, on the axis that it is made for: `ë = −d − (λ ė + u_r)`, sampled.

use firmware::control::sliding::{AxisGains, ReachingLaw, SlidingAxis, Surface};

const H: f32 = 1e-3;

fn axis(gain: f32, reaching: ReachingLaw) -> AxisGains {
    AxisGains::new(gain, 1.0, reaching)
}

/// s and `u_r`, step by step, of `ṡ = −u_r − d(t)` from s0: the error is held at zero, so that s is the rate alone.
fn reach(gains: &AxisGains, s0: f32, steps: usize, h: f32, d: impl Fn(f64) -> f64) -> Vec<(f64, f64)> {
    let mut axis = SlidingAxis::new(gains, h);
    let mut s = f64::from(s0);
    (0..steps)
        .map(|step| {
            let u = f64::from(axis.correction_along(0.0, 0.0, s as f32, false).acceleration);
            let row = (s, u);
            // The disturbance within a step at its middle.
            s -= (u + d((step as f64 + 0.5) * f64::from(h))) * f64::from(h);
            row
        })
        .collect()
}

fn variation(rows: &[(f64, f64)]) -> f64 {
    rows.windows(2).map(|pair| (pair[1].1 - pair[0].1).abs()).sum()
}

fn largest(rows: &[(f64, f64)]) -> f64 {
    rows.iter().map(|(s, _)| s.abs()).fold(0.0, f64::max)
}

#[test]
fn every_law_is_odd_and_drives_s_towards_zero() {
    for reaching in [
        ReachingLaw::Sgn,
        ReachingLaw::Sat { rho: 0.5 },
        ReachingLaw::Tanh { rho: 0.5 },
        ReachingLaw::Power { alpha: 0.5 },
        ReachingLaw::Exponential { rate: 2.0, rho: 0.5 },
        ReachingLaw::ImplicitSgn { horizon_s: 0.02 },
        ReachingLaw::SuperTwisting { twist: 3.0 },
        ReachingLaw::ImplicitSuperTwisting { twist: 3.0, horizon_s: 0.02 },
    ] {
        let rate = |s: f32| SlidingAxis::new(&axis(3.0, reaching), H).correction_along(0.0, 0.0, s, false).acceleration;
        for i in 1..2_000 {
            let s = i as f32 * 0.01;
            assert!(rate(s) > 0.0, "{reaching:?} at {s}");
            assert_eq!(rate(s), -rate(-s), "{reaching:?} at {s}");
        }
        assert_eq!(rate(0.0), 0.0);
    }
}

#[test]
fn constant_rate_power_and_exponential_laws_take_their_closed_form_times() {
    let time = |gains: &AxisGains, s0: f32| {
        let h = 1e-4;
        let rows = reach(gains, s0, 100_000, h, |_| 0.0);
        rows.iter().position(|(s, _)| *s < 2e-3).expect("reached") as f64 * f64::from(h)
    };
    // |s0|/K.
    assert!((time(&axis(2.0, ReachingLaw::Sgn), 4.0) - 2.0).abs() < 2e-3);
    // |s0|^½/(½K), 12 % for micromath.
    assert!((time(&axis(2.0, ReachingLaw::Power { alpha: 0.5 }), 4.0) - 2.0).abs() < 0.24);
    // ṡ = −K − q s until |s| = ρ: ln((K + q s0)/(K + q ρ))/q, then the layer to 2e-3 at the rate K/ρ + q.
    let (k, q, rho) = (2.0_f64, 3.0_f64, 0.01_f64);
    let exact = ((k + q * 4.0) / (k + q * rho)).ln() / q + (rho / 2e-3).ln() / (k / rho + q);
    let law = ReachingLaw::Exponential { rate: q as f32, rho: rho as f32 };
    assert!((time(&axis(k as f32, law), 4.0) - exact).abs() < 2e-3);
}

#[test]
fn sgn_by_backward_euler_does_not_chatter_beside_one_that_does() {
    // K fifty times what a layer could bear at this step, D a fifth of K.
    let (k, d) = (50.0, 10.0);
    let implicit = reach(&axis(k, ReachingLaw::ImplicitSgn { horizon_s: H }), 1.0, 3_000, H, |_| d);
    let explicit = reach(&axis(k, ReachingLaw::Sgn), 1.0, 3_000, H, |_| d);
    // Reached within s0/(K + D) here, where d helps; then |s| = h D, and u = −d to f32's resolution.
    let settled = &implicit[1_000..];
    assert!(settled.iter().all(|(s, _)| (s.abs() - f64::from(H) * d).abs() < 1e-6));
    assert_eq!(variation(settled), 0.0, "no chattering at all");
    // The explicit one jumps by 2K, at each step but those that d makes up for.
    assert!(variation(&explicit[1_000..]) > 1e4 * 2.0 * f64::from(k) / 10.0, "{}", variation(&explicit[1_000..]));
    assert!(largest(&explicit[1_000..]) > 0.5 * f64::from(k * H));
}

#[test]
fn super_twisting_rejects_a_changing_disturbance_of_any_size_to_second_order_in_the_step() {
    // |ḋ| ≤ L = 8; d itself is as large as K√s could never be near s = 0.
    let d = |t: f64| 30.0 + 4.0 * (2.0 * t).sin();
    let law = ReachingLaw::SuperTwisting { twist: 1.1 * 8.0 };
    let worst = |h: f32| {
        let steps = (8.0 / h) as usize;
        let rows = reach(&axis(1.5 * 8.0_f32.sqrt(), law), 0.5, steps, h, d);
        largest(&rows[steps * 3 / 4..])
    };
    let (coarse, fine) = (worst(2e-3), worst(1e-3));
    assert!(coarse < 50.0 * 2e-3 * 2e-3, "{coarse}");
    // Second order or better: a quarter at half the step; it chatters, so not to the last digit.
    assert!(coarse / fine > 3.0, "{coarse} {fine}");
}

#[test]
fn super_twisting_by_backward_euler_leaves_no_error_and_no_chattering() {
    let law = ReachingLaw::ImplicitSuperTwisting { twist: 8.8, horizon_s: H };
    let gains = axis(1.5 * 8.0_f32.sqrt(), law);
    let constant = reach(&gains, 0.5, 12_000, H, |_| 3.0);
    let settled = &constant[9_000..];
    assert!(largest(settled) < 1e-6, "{}", largest(settled));
    assert!(variation(settled) < 1e-3, "f32 rounding of v: {}", variation(settled));
    // A disturbance that changes by at most L = 8 a second leaves 4T²·L: what the integral needs for such a slope.
    let moving = reach(&gains, 0.5, 12_000, H, |t| 4.0 * (2.0 * t).sin());
    assert!(largest(&moving[9_000..]) < 1.05 * 4.0 * 8e-6, "{}", largest(&moving[9_000..]));
}

#[test]
fn an_integral_surface_is_met_from_the_first_moment_and_leaves_no_error() {
    let law = ReachingLaw::Sat { rho: 0.2 };
    let linear = AxisGains::new(20.0, 4.0, law);
    let integral = AxisGains { surface: Surface::Integral, ..linear };
    let fly = |gains: &AxisGains| {
        let (mut axis, mut e, mut rate) = (SlidingAxis::new(gains, H), 1.0_f64, 0.0_f64);
        let mut first = None;
        let mut largest: f64 = 0.0;
        for _ in 0..8_000 {
            let wanted = axis.correction(e as f32, rate as f32, false);
            first.get_or_insert(wanted.s);
            largest = largest.max(f64::from(wanted.s).abs());
            // ë = −(λ ė + u_r) − d with d = 5.
            rate -= (f64::from(wanted.acceleration) + 5.0) * f64::from(H);
            e += rate * f64::from(H);
        }
        (first.expect("flown"), largest, e)
    };
    // The linear surface is left by |s| = ρ D/K, so e = ρ D/(K λ).
    let (_, _, left) = fly(&linear);
    assert!((left.abs() - 0.2 * 5.0 / (20.0 * 4.0)).abs() < 1e-4, "{left}");
    let (first, most, left) = fly(&integral);
    assert_eq!(first, 0.0);
    // The disturbance never drives it further than ρ D/K, but for the sampling.
    assert!(most < 0.2 * 5.0 / 20.0 + 0.01 && left.abs() < 1e-4, "{most} {left}");
}

#[test]
fn what_integrates_holds_while_it_is_told_to() {
    let twisting = axis(2.0, ReachingLaw::ImplicitSuperTwisting { twist: 5.0, horizon_s: 0.01 });
    let integral = AxisGains { surface: Surface::Integral, ..axis(2.0, ReachingLaw::Sat { rho: 1.0 }) };
    for gains in [twisting, integral] {
        let mut axis = SlidingAxis::new(&gains, H);
        axis.correction(1.0, 0.0, true);
        let once = axis.correction(1.0, 0.0, true);
        assert_eq!(axis.correction(1.0, 0.0, true), once, "{gains:?}");
        axis.correction(1.0, 0.0, false);
        assert_ne!(axis.correction(1.0, 0.0, true), once, "{gains:?}");
        axis.reset();
        axis.correction(1.0, 0.0, true);
        assert_eq!(axis.correction(1.0, 0.0, true), once, "reset forgets: {gains:?}");
    }
}

#[test]
fn a_limited_approach_is_a_constant_rate() {
    let gains =
        AxisGains { approach_max: 2.0, ..AxisGains::new(10.0, 4.0, ReachingLaw::ImplicitSgn { horizon_s: 0.01 }) };
    let (mut axis, mut e, mut rate) = (SlidingAxis::new(&gains, H), 10.0_f64, 0.0_f64);
    for step in 0..8_000 {
        rate -= f64::from(axis.correction(e as f32, rate as f32, false).acceleration) * f64::from(H);
        e += rate * f64::from(H);
        if (1_000..3_500).contains(&step) {
            assert!((rate + 2.0).abs() < 1e-3, "{rate} at {step}");
        }
    }
    assert!(e.abs() < 1e-3, "{e}");
}

#[test]
fn a_large_error_is_braked_by_what_the_braking_says() {
    // From rest, 10 away: K = 20 accelerates it onto the parabola, from which it comes down at A = 5.
    let law = ReachingLaw::ImplicitSgn { horizon_s: 0.01 };
    let gains = AxisGains { braking: 5.0, ..AxisGains::new(20.0, 4.0, law) };
    let (mut axis, mut e, mut rate) = (SlidingAxis::new(&gains, H), 10.0_f64, 0.0_f64);
    let mut arrived = None;
    for step in 0..6_000 {
        let acceleration = -f64::from(axis.correction(e as f32, rate as f32, false).acceleration);
        // On the parabola, once it has come through the layer, and not yet where the surface is linear: A/λ² = 0.31.
        if (0.5..6.0).contains(&e) {
            assert!((acceleration - 5.0).abs() < 0.2, "{acceleration} at {e}");
        }
        rate += acceleration * f64::from(H);
        e += rate * f64::from(H);
        if e < 0.05 {
            arrived.get_or_insert(f64::from(step) * f64::from(H));
        }
        assert!(e > -0.01, "{e}");
    }
    // Bang-bang with 20 and 5 over 10: v = √(2·10/(1/20 + 1/5)) = 8.9, after v/20 + v/5 = 2.24 s; the end is linear.
    assert!(arrived.is_some_and(|t| (2.2..3.0).contains(&t)), "{arrived:?}");
}

#[test]
fn the_corrections_rate_is_its_derivative() {
    for (reaching, surface) in [
        (ReachingLaw::Sat { rho: 0.9 }, Surface::Linear),
        (ReachingLaw::Tanh { rho: 0.9 }, Surface::Linear),
        (ReachingLaw::Exponential { rate: 2.0, rho: 0.9 }, Surface::Linear),
        (ReachingLaw::ImplicitSgn { horizon_s: 0.3 }, Surface::Linear),
        (ReachingLaw::ImplicitSuperTwisting { twist: 30.0, horizon_s: 0.3 }, Surface::Linear),
        (ReachingLaw::ImplicitSgn { horizon_s: 0.3 }, Surface::Integral),
    ] {
        let gains = AxisGains { surface, ..AxisGains::new(3.0, 2.0, reaching) };
        for (e, rate, acceleration) in [(0.1_f32, 0.2_f32, -1.0_f32), (-0.2, 0.3, 2.0), (0.3, -1.3, 0.5)] {
            let h = 2e-3_f32;
            // Nothing is integrated between two looks: v and ∫e are states, not functions of e.
            let mut axis = SlidingAxis::new(&gains, 1e-9);
            axis.correction(0.0, 0.0, false);
            let mut at =
                |t: f32| axis.correction(e + rate * t + 0.5 * acceleration * t * t, rate + acceleration * t, true);
            let (before, now, after) = (at(-h), at(0.0), at(h));
            // What the held integral would have added: its rate λ² e, through the layer's slope.
            let held = if surface == Surface::Integral { 4.0 * e / 0.3 } else { 0.0 };
            let numeric = (after.acceleration - before.acceleration) / (2.0 * h) + held;
            let analytic = axis.correction_rate(now.s, e, rate, acceleration);
            assert!((numeric - analytic).abs() < 2e-2 * (1.0 + analytic.abs()), "{gains:?}: {numeric} {analytic}");
        }
    }
    // On the parabola, inside the layer.
    let law = ReachingLaw::ImplicitSgn { horizon_s: 0.3 };
    let mut axis = SlidingAxis::new(&AxisGains { braking: 1.0, ..AxisGains::new(10.0, 2.0, law) }, H);
    let (e, rate, acceleration, h) = (2.0_f32, -1.5_f32, 0.7_f32, 2e-3_f32);
    let mut at = |t: f32| axis.correction(e + rate * t + 0.5 * acceleration * t * t, rate + acceleration * t, true);
    let (before, now, after) = (at(-h), at(0.0), at(h));
    let numeric = (after.acceleration - before.acceleration) / (2.0 * h);
    let analytic = axis.correction_rate(now.s, e, rate, acceleration);
    assert!((numeric - analytic).abs() < 1e-2, "{numeric} {analytic}");
}

#[test]
fn gains_with_which_a_law_is_not_defined_are_refused() {
    for bad in [
        AxisGains::sat(1.0, 0.0, 0.1),
        AxisGains::sat(1.0, 1.0, f32::NAN),
        axis(1.0, ReachingLaw::Power { alpha: 1.0 }),
        axis(1.0, ReachingLaw::ImplicitSgn { horizon_s: 0.0 }),
        axis(1.0, ReachingLaw::SuperTwisting { twist: -1.0 }),
        axis(1.0, ReachingLaw::ImplicitSuperTwisting { twist: 1.0, horizon_s: f32::INFINITY }),
        axis(1.0, ReachingLaw::Exponential { rate: 0.0, rho: 1.0 }),
        AxisGains { approach_max: 0.0, ..axis(1.0, ReachingLaw::Sgn) },
        AxisGains { braking: f32::NAN, ..axis(1.0, ReachingLaw::Sgn) },
    ] {
        assert!(bad.validate("k").is_err(), "{bad:?}");
    }
}

#[test]
fn the_reaching_term_of_the_last_step_is_told() {
    let laws = [
        ReachingLaw::Sgn,
        ReachingLaw::Sat { rho: 0.1 },
        ReachingLaw::Tanh { rho: 0.1 },
        ReachingLaw::ImplicitSgn { horizon_s: 2e-3 },
        ReachingLaw::Power { alpha: 0.5 },
        ReachingLaw::Exponential { rate: 2.0, rho: 0.1 },
        ReachingLaw::SuperTwisting { twist: 3.0 },
        ReachingLaw::ImplicitSuperTwisting { twist: 3.0, horizon_s: 2e-3 },
    ];
    for law in laws {
        let mut axis = SlidingAxis::new(&axis(4.0, law), H);
        for s in [0.5_f32, 0.03, -0.2] {
            // With the error at zero the correction is the reaching term.
            let step = axis.correction_along(0.0, 0.0, s, false);
            assert_eq!(axis.reaching(), step.acceleration, "{law:?} at {s}");
        }
        let before = axis.reaching();
        axis.retune(&AxisGains::sat(1.0, 1.0, 0.1));
        assert_eq!(axis.reaching(), before, "until the next step");
        axis.reset();
        assert_eq!(axis.reaching(), 0.0);
    }
}

//! The mixer against Eq. 4 written out by hand, and, where limits bind, against the exact lexicographic optimum
//! in double precision, found by going through all vertices of the constraints: another algorithm than the mixer's.

use firmware::airframe::{Airframe, RotorGeometry};
use firmware::control::mixer::{Mixer, MixerError};
use firmware::signals::ControlInput;
use nalgebra::{Matrix3, Matrix4, SMatrix, Vector3};
use proptest::prelude::*;

/// Table 2: b, d, L.
const LIFT: f64 = 29.8e-4;
const YAW: f64 = 33e-6;
const ARM: f64 = 0.350;
/// ωmax² at thrust-to-weight 2.
const LIMIT: f64 = 2.0 * 0.823 * 9.81 / (4.0 * LIFT);

/// Eq. 4 as printed, plus layout: U1..U4 of ω1²..ω4².
fn eq4([w1, w2, w3, w4]: [f64; 4]) -> [f64; 4] {
    [LIFT * (w1 + w2 + w3 + w4), ARM * LIFT * (w4 - w2), ARM * LIFT * (w3 - w1), YAW * (w1 - w2 + w3 - w4)]
}

/// Rows of B for rotors at the given bearings (degrees from the nose, towards the left), spinning alternately, the
/// first pushing towards +ψ: roll torque is y·b, pitch torque −x·b.
fn ring<const N: usize>(bearings: [f64; N]) -> [[f32; N]; 4] {
    let row = |f: &dyn Fn(usize) -> f64| core::array::from_fn(|i| f(i) as f32);
    [
        row(&|_| LIFT),
        row(&|i| ARM * LIFT * bearings[i].to_radians().sin()),
        row(&|i| -ARM * LIFT * bearings[i].to_radians().cos()),
        row(&|i| if i % 2 == 0 { YAW } else { -YAW }),
    ]
}

fn x_quad() -> [[f32; 4]; 4] {
    ring([-45.0, -135.0, 135.0, 45.0])
}

fn hexa() -> [[f32; 6]; 4] {
    ring([0.0, 60.0, 120.0, 180.0, 240.0, 300.0])
}

fn octa() -> [[f32; 8]; 4] {
    ring([22.5, 67.5, 112.5, 157.5, 202.5, 247.5, 292.5, 337.5])
}

/// An airframe like many real ones: no symmetry, and arms of different lengths.
fn skewed() -> [[f32; 4]; 4] {
    let (b, d) = (LIFT as f32, YAW as f32);
    let (x, y) = ([0.31, -0.22, -0.27, 0.29], [-0.24, -0.33, 0.30, 0.26]);
    [[b; 4], y.map(|y| y * b), x.map(|x: f32| -x * b), [d, -1.1 * d, 0.9 * d, -d]]
}

fn mixer<const N: usize>(rows: &[[f32; N]; 4]) -> Mixer<N> {
    Mixer::new(rows, LIMIT.sqrt() as f32).expect("the rotors span U1..U4")
}

fn input(u: [f64; 4]) -> ControlInput {
    let [thrust_n, roll_n_m, pitch_n_m, yaw_n_m] = u.map(|v| v as f32);
    ControlInput { thrust_n, roll_n_m, pitch_n_m, yaw_n_m }
}

/// B ω² in double precision.
fn produced<const N: usize>(rows: &[[f32; N]; 4], omega_sq: &[f32; N]) -> [f64; 4] {
    rows.map(|row| row.iter().zip(omega_sq).map(|(b, w)| f64::from(*b) * f64::from(*w)).sum())
}

/// Most that each of U1..U4 can be in size.
fn most<const N: usize>(rows: &[[f32; N]; 4]) -> [f64; 4] {
    rows.map(|row| row.iter().map(|b| f64::from(*b).abs() * LIMIT).sum())
}

/// `a·x ≤ bound`, x = (part of the torque, thrust, yaw).
struct Limit {
    a: Vector3<f64>,
    bound: f64,
}

/// The limits 0 ≤ ωi² ≤ ωmax² and part ≤ 1, for speeds that the pseudo-inverse spans.
fn limits<const N: usize>(rows: &[[f32; N]; 4], demand: &ControlInput) -> Vec<Limit> {
    let b = SMatrix::<f64, 4, N>::from_fn(|i, j| f64::from(rows[i][j]));
    let square: Matrix4<f64> = b * b.transpose();
    let inverse = b.transpose() * square.try_inverse().expect("independent rows");
    let (roll, pitch) = (f64::from(demand.roll_n_m), f64::from(demand.pitch_n_m));
    let mut all = vec![Limit { a: Vector3::x(), bound: 1.0 }];
    for i in 0..N {
        let torque = inverse[(i, 1)] * roll + inverse[(i, 2)] * pitch;
        let a = Vector3::new(torque, inverse[(i, 0)], inverse[(i, 3)]);
        all.push(Limit { a, bound: LIMIT });
        all.push(Limit { a: -a, bound: 0.0 });
    }
    all
}

/// (part of the torque, thrust, yaw) by the mixer's priorities.
fn optimum(limits: &[Limit], thrust: f64, yaw: f64) -> Vector3<f64> {
    // In units where each coefficient is of order one, so that one tolerance fits all.
    let scale = Vector3::from_fn(|k, _| limits.iter().skip(1).map(|l| l.a[k].abs()).fold(1e-300, f64::max));
    let holds = |x: &Vector3<f64>| limits.iter().all(|l| l.a.dot(x) <= l.bound + 1e-9 * LIMIT);
    let mut part = 0.0_f64;
    for (i, p) in limits.iter().enumerate() {
        for (j, q) in limits.iter().enumerate().skip(i + 1) {
            for r in limits.iter().skip(j + 1) {
                let unit = |l: &Limit| l.a.component_div(&scale).transpose();
                let matrix = Matrix3::from_rows(&[unit(p), unit(q), unit(r)]);
                let Some(inverse) = matrix.try_inverse().filter(|_| matrix.determinant().abs() > 1e-9) else {
                    continue;
                };
                let x = (inverse * Vector3::new(p.bound, q.bound, r.bound)).component_div(&scale);
                if holds(&x) {
                    part = part.max(x.x);
                }
            }
        }
    }
    let thrust = nearest(thrust, &thrusts(limits, part));
    let yaw_range = limits.iter().fold((f64::NEG_INFINITY, f64::INFINITY), |(low, high), l| {
        let bound = (l.bound - l.a.x * part - l.a.y * thrust) / l.a.z;
        if l.a.z > 0.0 {
            (low, high.min(bound))
        } else if l.a.z < 0.0 {
            (low.max(bound), high)
        } else {
            (low, high)
        }
    });
    Vector3::new(part, thrust, yaw.max(yaw_range.0).min(yaw_range.1))
}

/// The thrusts at the vertices of what is left of the constraints when the torque is fixed.
fn thrusts(limits: &[Limit], part: f64) -> Vec<f64> {
    let mut all = Vec::new();
    for (i, p) in limits.iter().enumerate() {
        for q in &limits[i + 1..] {
            let (p_bound, q_bound) = (p.bound - p.a.x * part, q.bound - q.a.x * part);
            let determinant = p.a.y * q.a.z - p.a.z * q.a.y;
            if determinant.abs() < 1e-9 * (p.a.y * q.a.z).abs().max(1e-300) {
                continue;
            }
            let thrust = (p_bound * q.a.z - p.a.z * q_bound) / determinant;
            let yaw = (p.a.y * q_bound - p_bound * q.a.y) / determinant;
            let x = Vector3::new(part, thrust, yaw);
            if limits.iter().all(|l| l.a.dot(&x) <= l.bound + 1e-8 * LIMIT) {
                all.push(thrust);
            }
        }
    }
    all
}

/// The nearest to `x` of the range that the values span.
fn nearest(x: f64, values: &[f64]) -> f64 {
    let low = values.iter().copied().fold(f64::INFINITY, f64::min);
    let high = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    assert!(low <= high, "some thrust is always possible");
    x.max(low).min(high)
}

/// The speeds are lawful, and what they produce is the lexicographic optimum.
///
/// Tolerances, as parts of the most that each input can be: f32 rounding of a few 1e-7 in the part of the torque,
/// each priority below it magnified by the angle between the limits (about 10 on these layouts).
fn assert_optimal<const N: usize>(rows: &[[f32; N]; 4], demand: &ControlInput) {
    let allocation = mixer(rows).allocate(demand).expect("finite");
    let top = mixer(rows).omega_sq_max();
    assert!(allocation.omega_sq.iter().all(|w| (0.0..=top).contains(w)), "{demand:?}: {allocation:?}");
    let best = optimum(&limits(rows, demand), f64::from(demand.thrust_n), f64::from(demand.yaw_n_m));
    let got = produced(rows, &allocation.omega_sq);
    let want = [best.y, best.x * f64::from(demand.roll_n_m), best.x * f64::from(demand.pitch_n_m), best.z];
    for (k, tolerance) in [3e-4, 3e-5, 3e-5, 3e-3].into_iter().enumerate() {
        let error = (got[k] - want[k]).abs() / most(rows)[k];
        assert!(error < tolerance, "U{}: {got:?} for {want:?}, asked {demand:?}, part {}", k + 1, best.x);
    }
}

/// A demand whose parts reach `reach` times what the rotors can give.
fn demand_within<const N: usize>(rows: [[f32; N]; 4], reach: f64) -> impl Strategy<Value = ControlInput> {
    let most = most(&rows);
    [-0.2..1.5_f64, -1.0..1.0, -1.0..1.0, -1.0..1.0].prop_map(move |[t, r, p, y]| {
        input([t * most[0], reach * r * most[1], reach * p * most[2], reach * y * most[3]])
    })
}

fn squares<const N: usize>() -> impl Strategy<Value = [f64; N]> {
    // Corners and faces of the box as often as its inside.
    let one = prop_oneof![Just(0.0), Just(1.0), 0.0..1.0_f64, 0.0..1.0_f64];
    proptest::array::uniform(one.prop_map(|part: f64| part * LIMIT))
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(600))]

    #[test]
    fn plus_layout_inverts_eq_4_over_the_whole_feasible_set(squares in squares::<4>()) {
        let geometry = RotorGeometry::plus(LIFT as f32, YAW as f32, ARM as f32);
        let omega_sq = mixer(&geometry.rows()).allocate(&input(eq4(squares))).expect("finite").omega_sq;
        for (got, want) in omega_sq.iter().zip(squares) {
            // f32: 6e-8 of U1..U4 and of the inverse, some ten roundings.
            prop_assert!((f64::from(*got) - want).abs() < 3e-6 * LIMIT, "{omega_sq:?} for {squares:?}");
        }
    }

    #[test]
    fn what_the_rotors_can_give_is_given(
        quad in squares::<4>(), other in squares::<4>(), six in squares::<6>(), eight in squares::<8>()
    ) {
        assert_given(&x_quad(), quad);
        assert_given(&skewed(), other);
        assert_spanned_given(&hexa(), six);
        assert_spanned_given(&octa(), eight);
    }

    #[test]
    fn limits_bind_in_order_of_priority_on_quads(
        plus in demand_within(RotorGeometry::plus(LIFT as f32, YAW as f32, ARM as f32).rows(), 1.5),
        x in demand_within(x_quad(), 1.5),
        other in demand_within(skewed(), 1.5),
    ) {
        assert_optimal(&RotorGeometry::plus(LIFT as f32, YAW as f32, ARM as f32).rows(), &plus);
        assert_optimal(&x_quad(), &x);
        assert_optimal(&skewed(), &other);
    }

    #[test]
    fn demands_far_beyond_the_limits_keep_their_order(
        plus in demand_within(RotorGeometry::plus(LIFT as f32, YAW as f32, ARM as f32).rows(), 1.0),
        magnitude in 0.0..37.0_f64,
    ) {
        let far = 10.0_f64.powf(magnitude) as f32;
        let beyond = ControlInput { roll_n_m: plus.roll_n_m * far, pitch_n_m: plus.pitch_n_m * far, ..plus };
        assert_optimal(&RotorGeometry::plus(LIFT as f32, YAW as f32, ARM as f32).rows(), &beyond);
    }

    #[test]
    fn any_finite_demand_gives_lawful_speeds(bits in proptest::array::uniform4(any::<u32>())) {
        let [thrust_n, roll_n_m, pitch_n_m, yaw_n_m] = bits.map(f32::from_bits);
        let demand = ControlInput { thrust_n, roll_n_m, pitch_n_m, yaw_n_m };
        for rows in [x_quad(), skewed()] {
            assert_lawful(&rows, &demand);
        }
        assert_lawful(&hexa(), &demand);
        assert_lawful(&octa(), &demand);
    }
}

proptest! {
    // A vertex enumeration over 17 limits each.
    #![proptest_config(ProptestConfig::with_cases(150))]

    #[test]
    fn limits_bind_in_order_of_priority_on_hexa_and_octa(
        six in demand_within(hexa(), 1.2),
        eight in demand_within(octa(), 1.2),
    ) {
        assert_optimal(&hexa(), &six);
        assert_optimal(&octa(), &eight);
    }
}

fn assert_lawful<const N: usize>(rows: &[[f32; N]; 4], demand: &ControlInput) {
    let finite = demand.as_array().iter().all(|v| v.is_finite());
    match mixer(rows).allocate(demand) {
        Ok(allocation) => {
            assert!(finite, "{demand:?}");
            let top = mixer(rows).omega_sq_max();
            assert!(allocation.omega_sq.iter().all(|w| (0.0..=top).contains(w)), "{demand:?}: {allocation:?}");
        }
        Err(error) => assert!(!finite && matches!(error, MixerError::NonFinite(_)), "{demand:?}: {error:?}"),
    }
}

/// U of speeds within the limits is produced, whatever rotors are used for it.
fn assert_given<const N: usize>(rows: &[[f32; N]; 4], squares: [f64; N]) {
    let want = produced(rows, &squares.map(|w| w as f32));
    let got = produced(rows, &mixer(rows).allocate(&input(want)).expect("finite").omega_sq);
    for k in 0..4 {
        assert!((got[k] - want[k]).abs() < 1e-5 * most(rows)[k], "U{}: {got:?} for {want:?}", k + 1);
    }
}

/// With more than four rotors the promise is for speeds that the pseudo-inverse spans: those of B⁺U.
fn assert_spanned_given<const N: usize>(rows: &[[f32; N]; 4], squares: [f64; N]) {
    let demand = input(produced(rows, &squares.map(|w| w as f32)));
    let x = Vector3::new(1.0, f64::from(demand.thrust_n), f64::from(demand.yaw_n_m));
    if limits(rows, &demand).iter().all(|l| l.a.dot(&x) <= l.bound) {
        let got = produced(rows, &mixer(rows).allocate(&demand).expect("finite").omega_sq);
        for (k, want) in demand.as_array().into_iter().enumerate() {
            assert!((got[k] - f64::from(want)).abs() < 1e-5 * most(rows)[k], "U{}: {got:?} for {demand:?}", k + 1);
        }
    }
}

#[test]
fn a_torque_that_two_opposite_rotors_cannot_give_keeps_its_direction() {
    // Pitch alone asks for ω3² − ω1² = 1.4 ωmax², more than ωmax²: the whole torque shrinks by 1/1.4, roll too.
    let rows = RotorGeometry::plus(LIFT as f32, YAW as f32, ARM as f32).rows();
    let unit = ARM * LIFT * LIMIT;
    let demand = input([2.0 * LIFT * LIMIT, 0.4 * unit, 1.4 * unit, 0.0]);
    let got = produced(&rows, &mixer(&rows).allocate(&demand).expect("finite").omega_sq);
    assert!((got[1] / unit - 0.4 / 1.4).abs() < 1e-5 && (got[2] / unit - 1.0).abs() < 1e-5, "{got:?}");
    assert!((got[0] - 2.0 * LIFT * LIMIT).abs() < 1e-5 * most(&rows)[0], "the thrust was possible: {got:?}");
}

#[test]
fn the_field_that_is_not_finite_is_named() {
    let rows = Airframe::paper(2.0).geometry.rows();
    for (k, name) in ["thrust", "roll", "pitch", "yaw"].into_iter().enumerate() {
        for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
            let mut u = [8.0, 0.0, 0.0, 0.0];
            u[k] = bad;
            assert_eq!(mixer(&rows).allocate(&input(u)), Err(MixerError::NonFinite(name)));
        }
    }
}

#[test]
fn rotors_that_do_not_span_the_inputs_are_refused() {
    let mut rows = x_quad();
    rows[3] = rows[0];
    assert_eq!(Mixer::new(&rows, 30.0), Err(MixerError::Singular));
    rows[3] = [0.0; 4];
    assert_eq!(Mixer::new(&rows, 30.0), Err(MixerError::Singular));
    rows[3] = [f32::NAN; 4];
    assert_eq!(Mixer::new(&rows, 30.0), Err(MixerError::Singular));
}

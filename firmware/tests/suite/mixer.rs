//! The mixer against Eq. 4 written out by hand, and, where limits bind, against the exact lexicographic optimum
//! in double precision: three linear programs over the rotors' speeds, each solved by going through all basic
//! solutions. Nothing of the mixer's facets is in that.

use firmware::airframe::{Airframe, RotorGeometry};
use firmware::control::mixer::facets::{Layout, Rotors};
use firmware::control::mixer::{Mixer, MixerError};
use firmware::signals::ControlInput;
use nalgebra::{SMatrix, SVector, Vector2, Vector3};
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

/// Four arms with two rotors each, one above the other and turning against each other: no two columns of B are alike,
/// but those of U2 and U3 are in pairs, and not every four rotors span U1..U4.
fn coaxial() -> [[f32; 8]; 4] {
    let mut rows = ring([-45.0, -45.0, -135.0, -135.0, 135.0, 135.0, 45.0, 45.0]);
    // The lower rotor works in the upper one's wash.
    rows[0] = std::array::from_fn(|i| if i % 2 == 0 { LIFT } else { 0.8 * LIFT } as f32);
    rows
}

/// An airframe like many real ones: no symmetry, and arms of different lengths.
fn skewed() -> [[f32; 4]; 4] {
    let (b, d) = (LIFT as f32, YAW as f32);
    let (x, y) = ([0.31, -0.22, -0.27, 0.29], [-0.24, -0.33, 0.30, 0.26]);
    [[b; 4], y.map(|y| y * b), x.map(|x: f32| -x * b), [d, -1.1 * d, 0.9 * d, -d]]
}

fn mixer<const N: usize>(rows: &[[f32; N]; 4]) -> Mixer<N>
where
    Rotors<N>: Layout,
{
    Mixer::new(rows, LIMIT.sqrt() as f32).expect("the rotors span U1..U4")
}

fn limited<const N: usize>(rows: &[[f32; N]; 4], parts: [f32; N]) -> Mixer<N>
where
    Rotors<N>: Layout,
{
    let mut mixer = mixer(rows);
    mixer.set_limits(parts).expect("parts");
    mixer
}

fn plus() -> [[f32; 4]; 4] {
    RotorGeometry::plus(LIFT as f32, YAW as f32, ARM as f32).rows()
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

/// Least and greatest `cost·x` over 0 ≤ x ≤ upper with Σ columns·x = sum: that of all basic solutions, in which all but
/// M of the x stand at a bound. Everything is to be of order one.
fn extremes<const M: usize>(
    cost: &[f64],
    columns: &[SVector<f64, M>],
    upper: &[f64],
    sum: &SVector<f64, M>,
) -> Option<(f64, f64)> {
    const TOLERANCE: f64 = 1e-11;
    let n = columns.len();
    let mut found: Option<(f64, f64)> = None;
    for basis in (0..1_usize << n).filter(|basis| basis.count_ones() as usize == M) {
        let (basic, others): (Vec<usize>, Vec<usize>) = (0..n).partition(|i| basis >> i & 1 == 1);
        let matrix = SMatrix::<f64, M, M>::from_fn(|row, column| columns[basic[column]][row]);
        let Some(inverse) = matrix.try_inverse().filter(|inverse| inverse.amax() < 1e6) else { continue };
        for corner in 0..1_usize << others.len() {
            let at_top = || others.iter().enumerate().filter(|(bit, _)| corner >> bit & 1 == 1).map(|(_, i)| *i);
            let x = inverse * at_top().fold(*sum, |rest, i| rest - columns[i] * upper[i]);
            if basic.iter().zip(&x).all(|(i, x)| *x >= -TOLERANCE && *x <= upper[*i] + TOLERANCE) {
                let value = basic.iter().zip(&x).map(|(i, x)| cost[*i] * x).sum::<f64>()
                    + at_top().map(|i| cost[i] * upper[i]).sum::<f64>();
                let (low, high) = found.unwrap_or((value, value));
                found = Some((low.min(value), high.max(value)));
            }
        }
    }
    found
}

/// B, each row divided by the most its input can be, and the demand likewise: everything is of order one.
struct Problem<const N: usize> {
    rows: [[f64; N]; 4],
    upper: [f64; N],
    demand: [f64; 4],
}

impl<const N: usize> Problem<N> {
    fn new(rows: &[[f32; N]; 4], limits: [f32; N], demand: &ControlInput) -> Self {
        let most = most(rows);
        Self {
            rows: std::array::from_fn(|k| rows[k].map(|b| f64::from(b) * LIMIT / most[k])),
            upper: limits.map(|limit| f64::from(limit) / LIMIT),
            demand: std::array::from_fn(|k| f64::from(demand.as_array()[k]) / most[k]),
        }
    }

    /// The demanded torque's direction, and its greatest length that speeds within −slack ..= limit + slack can give.
    fn torque(&self, slack: f64) -> (Vector2<f64>, f64) {
        let [_, roll, pitch, _] = &self.rows;
        let asked = self.demand[1].hypot(self.demand[2]);
        let direction = Vector2::new(self.demand[1], self.demand[2]) / asked.max(1e-300);
        let mut columns: Vec<_> = roll.iter().zip(pitch).map(|(roll, pitch)| Vector2::new(*roll, *pitch)).collect();
        // Speeds counted from −slack; the torque's length is one more x.
        let offset: Vector2<f64> = columns.iter().sum::<Vector2<f64>>() * slack;
        let mut upper: Vec<_> = self.upper.iter().map(|upper| upper + 2.0 * slack).collect();
        let mut cost = vec![0.0; N];
        columns.push(-direction);
        upper.push(asked.min(10.0));
        cost.push(1.0);
        let (_, length) = extremes(&cost, &columns, &upper, &offset).expect("no torque is always possible");
        (direction, length)
    }

    /// The thrust nearest to the demand at this torque.
    fn thrust(&self, [_, roll, pitch, _]: [f64; 4]) -> f64 {
        let columns: Vec<_> = (0..N).map(|i| Vector2::new(self.rows[1][i], self.rows[2][i])).collect();
        let range = extremes(&self.rows[0], &columns, &self.upper, &Vector2::new(roll, pitch));
        let (low, high) = range.expect("the speeds that gave the torque give a thrust");
        self.demand[0].clamp(low, high)
    }

    /// The yaw nearest to the demand at this thrust and torque.
    fn yaw(&self, [thrust, roll, pitch, _]: [f64; 4]) -> f64 {
        let columns: Vec<_> = (0..N).map(|i| Vector3::new(self.rows[0][i], self.rows[1][i], self.rows[2][i])).collect();
        let range = extremes(&self.rows[3], &columns, &self.upper, &Vector3::new(thrust, roll, pitch));
        let (low, high) = range.expect("the speeds that gave the thrust give a yaw");
        self.demand[3].clamp(low, high)
    }
}

/// The speeds are within their limits, and what they produce is the lexicographic optimum: the torque by itself, the
/// thrust for the torque that is produced, the yaw for the thrust and torque that are.
///
/// Tolerances, as parts of the most that each input can be: f32 rounding of a few 1e-7, magnified in thrust and yaw by
/// the angle between the facets (about 10 on these layouts). With failed rotors the torque's optimum may jump with
/// its direction; it is then that for limits no more than 1e-6 wider.
fn assert_optimal<const N: usize>(rows: &[[f32; N]; 4], parts: [f32; N], demand: &ControlInput)
where
    Rotors<N>: Layout,
{
    const TOLERANCE: f64 = 2e-5;
    let mixer = limited(rows, parts);
    let allocation = mixer.allocate(demand).expect("finite");
    assert_possible(&mixer, parts, &allocation.omega_sq);
    let problem = Problem::new(rows, parts.map(|part| part * mixer.omega_sq_max()), demand);
    let (got, most) = (produced(rows, &allocation.omega_sq), most(rows));
    let got: [f64; 4] = std::array::from_fn(|k| got[k] / most[k]);

    let ((direction, least), (_, greatest)) = (problem.torque(0.0), problem.torque(1.1e-6));
    let torque = Vector2::new(got[1], got[2]);
    let along = direction.dot(&torque);
    let across = (torque - direction * along).norm();
    let text = || format!("asked {demand:?} of {parts:?}: {allocation:?}, {got:?}");
    assert!(across < TOLERANCE, "direction off by {across}, {}", text());
    assert!((least - TOLERANCE..greatest + TOLERANCE).contains(&along), "{along} of {least}..{greatest}, {}", text());
    let (thrust, yaw) = (problem.thrust(got), problem.yaw(got));
    assert!((got[0] - thrust).abs() < 5.0 * TOLERANCE, "thrust {thrust}, {}", text());
    assert!((got[3] - yaw).abs() < 20.0 * TOLERANCE, "yaw {yaw}, {}", text());

    let off = got.iter().zip(problem.demand).any(|(got, asked)| (got - asked).abs() > 20.0 * TOLERANCE);
    assert!(allocation.saturated || !off, "{}", text());
}

fn assert_possible<const N: usize>(mixer: &Mixer<N>, parts: [f32; N], omega_sq: &[f32; N])
where
    Rotors<N>: Layout,
{
    let top = mixer.omega_sq_max();
    assert!(omega_sq.iter().zip(parts).all(|(w, part)| (0.0..=part * top).contains(w)), "{omega_sq:?} of {parts:?}");
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

/// Limits of rotors of which most are sound, some weak, and some have failed.
fn parts<const N: usize>() -> impl Strategy<Value = [f32; N]> {
    proptest::array::uniform(prop_oneof![5 => Just(1.0), 2 => 0.3..1.0_f32, 1 => Just(0.0)])
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(600))]

    #[test]
    fn plus_layout_inverts_eq_4_over_the_whole_feasible_set(squares in squares::<4>()) {
        let omega_sq = mixer(&plus()).allocate(&input(eq4(squares))).expect("finite").omega_sq;
        for (got, want) in omega_sq.iter().zip(squares) {
            // f32: 6e-8 of U1..U4 and of the inverse, some ten roundings.
            prop_assert!((f64::from(*got) - want).abs() < 3e-6 * LIMIT, "{omega_sq:?} for {squares:?}");
        }
    }

    #[test]
    fn what_the_rotors_can_give_is_given(
        quad in (squares::<4>(), parts()), other in (squares::<4>(), parts()),
        six in (squares::<6>(), parts()), eight in (squares::<8>(), parts()),
    ) {
        assert_given(&x_quad(), quad);
        assert_given(&skewed(), other);
        assert_given(&hexa(), six);
        assert_given(&octa(), eight);
        assert_given(&coaxial(), eight);
    }

    #[test]
    fn limits_bind_in_order_of_priority_on_quads(
        by_plus in demand_within(plus(), 1.5), by_x in demand_within(x_quad(), 1.5),
        by_skewed in demand_within(skewed(), 1.5), parts in parts(),
    ) {
        for parts in [[1.0; 4], parts] {
            assert_optimal(&plus(), parts, &by_plus);
            assert_optimal(&x_quad(), parts, &by_x);
            assert_optimal(&skewed(), parts, &by_skewed);
        }
    }

    #[test]
    fn demands_far_beyond_the_limits_keep_their_order(
        near in demand_within(plus(), 1.0), weak in 0.3..1.0_f32,
        torque in 0.0..37.0_f64, thrust in 0.0..37.0_f64, yaw in 0.0..37.0_f64,
    ) {
        let [torque, thrust, yaw] = [torque, thrust, yaw].map(|magnitude| 10.0_f64.powf(magnitude) as f32);
        let ControlInput { thrust_n, roll_n_m, pitch_n_m, yaw_n_m } = near;
        let (roll_n_m, pitch_n_m) = (roll_n_m * torque, pitch_n_m * torque);
        assert_optimal(&plus(), [1.0, 1.0, weak, 1.0], &ControlInput { roll_n_m, pitch_n_m, ..near });
        let far = ControlInput { thrust_n: thrust_n * thrust, roll_n_m, pitch_n_m, yaw_n_m: yaw_n_m * yaw };
        assert_optimal(&plus(), [1.0, 1.0, weak, 1.0], &far);
    }

    #[test]
    fn any_demand_gives_possible_speeds_or_an_error(
        bits in proptest::array::uniform4(any::<u32>()), four in parts(), six in parts(), eight in parts(),
    ) {
        let [thrust_n, roll_n_m, pitch_n_m, yaw_n_m] = bits.map(f32::from_bits);
        let demand = ControlInput { thrust_n, roll_n_m, pitch_n_m, yaw_n_m };
        for rows in [plus(), x_quad(), skewed()] {
            assert_lawful(&rows, four, &demand);
        }
        assert_lawful(&hexa(), six, &demand);
        assert_lawful(&octa(), eight, &demand);
        assert_lawful(&coaxial(), eight, &demand);
    }

    #[test]
    fn speeds_are_continuous_in_the_demand(
        ends in proptest::array::uniform2([-0.2..1.5_f64, -1.2..1.2, -1.2..1.2, -1.2..1.2]), weak in 0.5..1.0_f32,
    ) {
        assert_continuous(&plus(), [1.0, weak, 1.0, 1.0], ends);
        assert_continuous(&x_quad(), [1.0, weak, 1.0, 1.0], ends);
        assert_continuous(&skewed(), [1.0, weak, 1.0, 1.0], ends);
        assert_continuous(&hexa(), [1.0, weak, 1.0, 1.0, 1.0, 1.0], ends);
        assert_continuous(&octa(), [1.0, weak, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0], ends);
        assert_continuous(&coaxial(), [1.0, weak, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0], ends);
    }
}

proptest! {
    // Some ten thousand basic solutions each.
    #![proptest_config(ProptestConfig::with_cases(150))]

    #[test]
    fn limits_bind_in_order_of_priority_on_hexa_and_octa(
        by_hexa in demand_within(hexa(), 1.2), by_octa in demand_within(octa(), 1.2),
        by_coaxial in demand_within(coaxial(), 1.2), six in parts(), eight in parts(),
    ) {
        assert_optimal(&hexa(), [1.0; 6], &by_hexa);
        assert_optimal(&hexa(), six, &by_hexa);
        assert_optimal(&octa(), [1.0; 8], &by_octa);
        assert_optimal(&octa(), eight, &by_octa);
        assert_optimal(&coaxial(), eight, &by_coaxial);
    }
}

fn assert_lawful<const N: usize>(rows: &[[f32; N]; 4], parts: [f32; N], demand: &ControlInput)
where
    Rotors<N>: Layout,
{
    let finite = demand.as_array().iter().all(|v| v.is_finite());
    let mixer = limited(rows, parts);
    match mixer.allocate(demand) {
        Ok(allocation) => {
            assert!(finite, "{demand:?}");
            assert_possible(&mixer, parts, &allocation.omega_sq);
        }
        Err(error) => assert!(!finite && matches!(error, MixerError::NonFinite(_)), "{demand:?}: {error:?}"),
    }
}

/// U of speeds within the limits is produced, whatever rotors are used for it.
fn assert_given<const N: usize>(rows: &[[f32; N]; 4], (squares, parts): ([f64; N], [f32; N]))
where
    Rotors<N>: Layout,
{
    let omega_sq = std::array::from_fn(|i| squares[i] as f32 * parts[i]);
    let want = produced(rows, &omega_sq);
    let mixer = limited(rows, parts);
    let got = produced(rows, &mixer.allocate(&input(want)).expect("finite").omega_sq);
    for k in 0..4 {
        assert!((got[k] - want[k]).abs() < 1e-5 * most(rows)[k], "U{}: {got:?} for {want:?} of {parts:?}", k + 1);
        let given = f64::from(mixer.given(&omega_sq).as_array()[k]);
        assert!((given - want[k]).abs() < 1e-6 * most(rows)[k], "U{}: {given} for {want:?}", k + 1);
    }
}

/// Between two demands, in parts of the most that each input can be, no small step moves a speed by more than `FACTOR`
/// as much: of a step the half that moves a speed further is looked at again, which ends at a jump if there is one.
fn assert_continuous<const N: usize>(rows: &[[f32; N]; 4], parts: [f32; N], ends: [[f64; 4]; 2])
where
    Rotors<N>: Layout,
{
    const FACTOR: f64 = 150.0;
    const HALVINGS: i32 = 14;
    const ROUNDING: f64 = 1e-3;
    let (mixer, most) = (limited(rows, parts), most(rows));
    let speeds = |u: [f64; 4]| {
        let demand = input(std::array::from_fn(|k| u[k] * most[k]));
        mixer.allocate(&demand).expect("finite").omega_sq.map(|w| f64::from(w) / LIMIT)
    };
    let moved = |[a, b]: [[f64; 4]; 2]| speeds(a).iter().zip(speeds(b)).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
    let [mut from, mut to] = ends;
    for _ in 0..HALVINGS {
        let middle = std::array::from_fn(|k| 0.5 * (from[k] + to[k]));
        if moved([from, middle]) > moved([middle, to]) {
            to = middle;
        } else {
            from = middle;
        }
    }
    let size = from.iter().zip(to).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
    let moved = moved([from, to]);
    assert!(moved < FACTOR * size + ROUNDING, "{moved} from {from:?} to {to:?} of {parts:?}");
}

#[test]
fn a_torque_that_two_opposite_rotors_cannot_give_keeps_its_direction() {
    // Pitch alone asks for ω3² − ω1² = 1.4 ωmax², more than ωmax²: the whole torque shrinks by 1/1.4, roll too.
    let rows = plus();
    let unit = ARM * LIFT * LIMIT;
    let demand = input([2.0 * LIFT * LIMIT, 0.4 * unit, 1.4 * unit, 0.0]);
    let got = produced(&rows, &mixer(&rows).allocate(&demand).expect("finite").omega_sq);
    assert!((got[1] / unit - 0.4 / 1.4).abs() < 1e-5 && (got[2] / unit - 1.0).abs() < 1e-5, "{got:?}");
    assert!((got[0] - 2.0 * LIFT * LIMIT).abs() < 1e-5 * most(&rows)[0], "the thrust was possible: {got:?}");
}

#[test]
fn with_a_failed_rotor_the_other_axis_and_the_thrust_are_kept() {
    // The front rotor of a plus layout has failed, so the nose cannot be lifted; roll is not its business. Its partner
    // must stand still with it, and yaw is what pays: 2 and 4 lift alone.
    let rows = plus();
    let demand = input([LIFT * LIMIT, ARM * LIFT * 0.5 * LIMIT, 0.0, 0.0]);
    let allocation = limited(&rows, [0.0, 1.0, 1.0, 1.0]).allocate(&demand).expect("finite");
    let want = [0.0, 0.25, 0.0, 0.75].map(|part| part * LIMIT);
    for (got, want) in allocation.omega_sq.into_iter().zip(want) {
        assert!((f64::from(got) - want).abs() < 3e-6 * LIMIT, "{allocation:?}");
    }
    assert!(allocation.saturated);
}

#[test]
fn limits_are_checked_and_can_be_taken_back() {
    let sound = mixer(&octa());
    let mut other = sound.clone();
    for bad in [f32::NAN, f32::INFINITY, -0.1, 1.1] {
        let mut parts = [0.5; 8];
        parts[5] = bad;
        assert_eq!(other.set_limits(parts), Err(MixerError::Limit(5)));
        assert_eq!(other, sound, "refused limits change nothing");
    }
    assert_eq!(other.set_limits([0.2; 8]), Ok(()));
    assert_ne!(other, sound);
    assert_eq!(other.set_limits([1.0; 8]), Ok(()));
    assert_eq!(other, sound);
}

#[test]
fn rotors_that_may_not_turn_stand_still() {
    // −0 is a limit like 0.
    let stopped = limited(&hexa(), [0.0, -0.0, 0.0, -0.0, 0.0, -0.0]);
    let allocation = stopped.allocate(&input([8.0, 0.1, -0.2, 0.01])).expect("finite");
    assert_eq!(allocation.omega_sq, [0.0; 6]);
    assert!(allocation.saturated);
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

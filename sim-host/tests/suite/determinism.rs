//! One flight, bit for bit: the same seed gives the same bytes, at any number of threads; and what truth.csv says obeys
//! the rigid-body equations, integrated again by a model written here.

use std::path::Path;
use std::process::Command;

use nalgebra::{Quaternion, Vector3};

use crate::common::folder::Folder;

type V = Vector3<f64>;

/// Runs `sim-host run` and returns its standard output.
fn run(arguments: &[&str], out: &Path) -> String {
    let output = Command::new(env!("CARGO_BIN_EXE_sim-host"))
        .arg("run")
        .args(arguments)
        .arg("--json")
        .arg("--out")
        .arg(out)
        .output()
        .expect("the program starts");
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8(output.stdout).expect("JSON is UTF-8")
}

fn truth(folder: &Path) -> Vec<u8> {
    std::fs::read(folder.join("truth.csv")).expect("truth.csv is there")
}

/// Short, with noise from the first second on.
const DISTURBED: [&str; 7] =
    ["paper-disturbed", "--set", "duration_s=3", "--set", "disturbance.from_s=1", "--set", "disturbance.to_s=2"];

#[test]
fn a_seed_is_a_flight() {
    let folder = Folder::new("seed");
    let fly = |seed: &str, to: &str| {
        let out = folder.0.join(to);
        run(&[&DISTURBED[..], &["--seed", seed]].concat(), &out);
        truth(&out)
    };
    let (first, again, other) = (fly("7", "a"), fly("7", "b"), fly("8", "c"));
    assert!(first == again, "the same seed, other bytes");
    assert!(first != other, "another seed, the same bytes");
    let lines = |bytes: &[u8]| bytes.split(|b| *b == b'\n').take(1001).map(<[u8]>::to_vec).collect::<Vec<_>>();
    assert!(lines(&first) == lines(&other), "until the noise sets in, seeds are alike");
}

#[test]
fn seeds_do_not_depend_on_the_number_of_threads() {
    let folder = Folder::new("jobs");
    let fly = |jobs: &str| {
        let out = folder.0.join(jobs);
        let text = run(&[&DISTURBED[..], &["--seeds", "1..8", "--jobs", jobs]].concat(), &out);
        let mut summaries: Vec<serde_json::Value> = serde_json::from_str(&text).expect("an array");
        for summary in &mut summaries {
            // The only key that depends on the clock on the wall.
            summary.as_object_mut().expect("an object").remove("real_time_factor").expect("it is there");
        }
        (summaries, (1..=8).map(|seed| truth(&out.join(format!("seed-{seed}")))).collect::<Vec<_>>())
    };
    let (one, two) = (fly("1"), fly("2"));
    assert_eq!(one.0, two.0);
    assert!(one.1 == two.1, "truth.csv depends on the number of threads");
    assert_eq!(one.0.len(), 8);
    let hashes: std::collections::BTreeSet<&str> =
        one.0.iter().map(|summary| summary["truth_sha256"].as_str().expect("a hash")).collect();
    assert_eq!(hashes.len(), 8, "eight seeds, eight flights");
}

/// On sensors, with faults that draw numbers, in the air after 5 s.
const ON_SENSORS: [&str; 5] = [
    "outdoor-hover",
    "--set",
    "duration_s=8",
    "--set",
    "fault=[{sensor=\"baro\",kind=\"noise\",sigma=2.0,from_s=1.0}]",
];

#[test]
fn a_flight_on_sensors_is_its_seed_whatever_the_threads() {
    let folder = Folder::new("sensors");
    // `assess` is given whole flights.
    let short = ["--set", "assess.from_s=5", "--set", "assess.to_s=8"];
    let fly = |jobs: &str| {
        let out = folder.0.join(jobs);
        run(&[&ON_SENSORS[..], &short, &["--seeds", "1..4", "--jobs", jobs]].concat(), &out);
        (1..=4).map(|seed| truth(&out.join(format!("seed-{seed}")))).collect::<Vec<_>>()
    };
    let (one, two) = (fly("1"), fly("2"));
    assert!(one == two, "truth.csv depends on the number of threads");
    let different: std::collections::BTreeSet<&Vec<u8>> = one.iter().collect();
    assert_eq!(different.len(), 4, "four seeds, four flights");
}

/// A row of truth.csv: state, and the rotor speeds that act until the next row.
struct Row {
    t: f64,
    state: State,
    omega: [f64; 4],
    command: [f64; 4],
}

#[derive(Clone, Copy)]
struct State {
    position: V,
    velocity: V,
    attitude: Quaternion<f64>,
    rates: V,
}

fn read(folder: &Path) -> Vec<Row> {
    let text = String::from_utf8(truth(folder)).expect("CSV is ASCII");
    let mut lines = text.lines();
    let header: Vec<&str> = lines.next().expect("a header").split(',').collect();
    let column = |name: &str| header.iter().position(|h| *h == name).unwrap_or_else(|| panic!("no column {name}"));
    let columns = |names: [&str; 3]| names.map(column);
    let (p, v) = (columns(["x_m", "y_m", "z_m"]), columns(["vx_m_s", "vy_m_s", "vz_m_s"]));
    let w = columns(["p_rad_s", "q_rad_s", "r_rad_s"]);
    let q = ["qw", "qx", "qy", "qz"].map(column);
    let omega = [1, 2, 3, 4].map(|i| column(&format!("omega{i}_rad_s")));
    let command = [1, 2, 3, 4].map(|i| column(&format!("omega{i}_cmd_rad_s")));
    lines
        .map(|line| {
            let n: Vec<f64> = line.split(',').map(|number| number.parse().expect("a number")).collect();
            let vector = |at: [usize; 3]| V::from(at.map(|i| n[i]));
            let [qw, qx, qy, qz] = q.map(|i| n[i]);
            let state = State {
                position: vector(p),
                velocity: vector(v),
                attitude: Quaternion::new(qw, qx, qy, qz),
                rates: vector(w),
            };
            Row { t: n[column("t_s")], state, omega: omega.map(|i| n[i]), command: command.map(|i| n[i]) }
        })
        .collect()
}

/// The rigid body of docs/simulation.md on Table 2, straight from its equations, cross products and all.
fn derivative(s: &State, [w1, w2, w3, w4]: [f64; 4]) -> State {
    let (b, d, l, m, jr, g, k, kr) = (29.8e-4, 33e-6, 0.350, 0.823, 28.4e-4, 9.81, 0.3729, 0.0556);
    let inertia = V::new(0.5e-2, 0.5e-2, 0.1e-2);
    let [q1, q2, q3, q4] = [w1 * w1, w2 * w2, w3 * w3, w4 * w4];
    let thrust = b * (q1 + q2 + q3 + q4);
    let torque = V::new(l * b * (q4 - q2), l * b * (q3 - q1), d * (q1 - q2 + q3 - q4));
    let rotors = V::new(0.0, 0.0, jr * (-w1 + w2 - w3 + w4));
    let axis = s.attitude * Quaternion::new(0.0, 0.0, 0.0, 1.0) * s.attitude.conjugate();
    let drag = s.rates.map(|w| kr * w * w.abs());
    let angular = torque - s.rates.cross(&inertia.component_mul(&s.rates)) - s.rates.cross(&rotors) - drag;
    State {
        position: s.velocity,
        velocity: axis.imag() * (thrust / m) - s.velocity * (k / m) - V::new(0.0, 0.0, g),
        attitude: s.attitude * Quaternion::from_imag(s.rates) * 0.5,
        rates: angular.component_div(&inertia),
    }
}

fn plus(s: &State, d: &State, h: f64) -> State {
    State {
        position: s.position + d.position * h,
        velocity: s.velocity + d.velocity * h,
        attitude: s.attitude + d.attitude * h,
        rates: s.rates + d.rates * h,
    }
}

/// From a row to the next in 20 steps of RK4, the rotors' speed at time `t` after the row being `omega(t)`.
fn integrate(mut s: State, omega: impl Fn(f64) -> [f64; 4]) -> State {
    let h = 1e-3 / 20.0;
    for i in 0..20 {
        let t = f64::from(i) * h;
        let k1 = derivative(&s, omega(t));
        let k2 = derivative(&plus(&s, &k1, 0.5 * h), omega(t + 0.5 * h));
        let k3 = derivative(&plus(&s, &k2, 0.5 * h), omega(t + 0.5 * h));
        let k4 = derivative(&plus(&s, &k3, h), omega(t + h));
        s = plus(&plus(&plus(&plus(&s, &k1, h / 6.0), &k2, h / 3.0), &k3, h / 3.0), &k4, h / 6.0);
    }
    s
}

fn assert_obeys(scenario: &str, setting: &str, lag_s: f64) {
    let folder = Folder::new(&format!("{scenario}-{setting}"));
    run(&[scenario, "--set", "duration_s=6", "--set", setting], &folder.0);
    let rows = read(&folder.0);
    assert_eq!(rows.len(), 6000);
    for pair in rows.windows(2) {
        let (row, next) = (&pair[0], &pair[1]);
        let s = integrate(row.state, |t| {
            let left = if lag_s > 0.0 { (-t / lag_s).exp() } else { 1.0 };
            let target = if lag_s > 0.0 { row.command } else { row.omega };
            core::array::from_fn(|i| target[i] + (row.omega[i] - target[i]) * left)
        });
        let (to, t) = (&next.state, row.t);
        // One 1 ms step of RK4 against twenty. Yaw drag and the rotors' precession make motions of some 100/s, so a step
        // leaves (0.1)⁵/120 = 1e-7 of rates that change by up to 10 rad/s in it; each integral of that is 1 ms shorter.
        // The smallest term there is, Jr Ωr Ω h/I with a few rad/s each, is above 1e-3 rad/s where it is not zero.
        assert!((s.rates - to.rates).norm() < 1e-5, "rates at {t}: {} {}", s.rates, to.rates);
        assert!((s.attitude - to.attitude).norm() < 1e-8, "attitude at {t}");
        assert!((s.velocity - to.velocity).norm() < 2e-9, "velocity at {t}");
        assert!((s.position - to.position).norm() < 2e-11, "position at {t}");
    }
}

#[test]
fn truth_csv_obeys_the_rigid_body_equations() {
    assert_obeys("helix", "actuation_delay_s=0.0", 0.0);
}

#[test]
fn truth_csv_obeys_them_with_rotors_that_lag() {
    assert_obeys("helix-lag", "actuation_delay_s=0.0", 0.02);
}

#[test]
fn truth_csv_obeys_them_with_a_delay() {
    assert_obeys("helix-lag", "actuation_delay_s=0.003", 0.02);
}

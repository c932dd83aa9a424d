//! The figures of a made-up flight: files exist, are whole and small. How they look is for the eye.

use std::fs;

use nalgebra::UnitQuaternion;

use super::*;

/// Time constant of the made-up approach, s.
const TAU: f64 = 0.25;

/// Error and error rate of a critically damped approach from `e0`, at rest when t = 0.
pub(super) fn approach(e0: f64, t: f64) -> (f64, f64) {
    let decay = (-t / TAU).exp();
    (e0 * (1.0 + t / TAU) * decay, -e0 * t / (TAU * TAU) * decay)
}

/// Made-up rows of a flight of the paper's helix from the origin.
pub(in crate::report) fn flight(seconds: f64) -> Vec<Row> {
    (0..=(seconds * 1000.0) as u32).map(|k| row(f64::from(k) / 1000.0)).collect()
}

fn row(t: f64) -> Row {
    let reference = [4.0 * t.sin(), 5.0 * t.cos(), 2.0 + t, 0.0];
    let [ex, ey, ez] = [0.0, 5.0, 2.0].map(|e0| approach(e0, t));
    let [roll, pitch, yaw] = angles(t);
    let q = UnitQuaternion::from_euler_angles(roll, pitch, yaw);
    let chatter = if ((t * 1000.0) as u32).is_multiple_of(2) { 0.05 } else { -0.05 };
    Row {
        t,
        position: [reference[0] - ex.0, reference[1] - ey.0, reference[2] - ez.0],
        velocity: [4.0 * t.cos() - ex.1, -5.0 * t.sin() - ey.1, 1.0 - ez.1],
        attitude: [q.w, q.i, q.j, q.k],
        rates: [0.0; 3],
        omega: [26.0; 4],
        omega_command: [26.0; 4],
        reference,
        desired_attitude: [roll, pitch, yaw],
        u: [8.1 + 8.0 * (-3.0 * t).exp(), chatter + 0.4 * (-3.0 * t).exp(), chatter, 0.1 * chatter],
        s: [0.0; 6],
    }
}

fn angles(t: f64) -> [f64; 3] {
    [0.45 * t.cos() + 0.5 * (-4.0 * t).exp(), -0.38 * t.sin(), 0.01 * (-2.0 * t).exp()]
}

/// Pseudo-random but the same each time: made of incommensurable sines.
fn samples() -> Vec<(f64, [f64; 6])> {
    let noise = |t: f64, axis: f64| (t * 9173.0 + axis).sin() + (t * 5711.0 + 2.0 * axis).sin() + (t * 12_713.0).cos();
    let at =
        |t: f64| std::array::from_fn(|axis| if (5.0..10.0).contains(&t) { 2.0 * noise(t, axis as f64) } else { 0.0 });
    (0..20_000).map(|k| f64::from(k) / 1000.0).map(|t| (t, at(t))).collect()
}

/// Draws every figure; into a folder that stays if `GLISSADE_PLOTS` names one.
fn draw_all(name: &str, rows: &[Row]) -> Vec<(PathBuf, String)> {
    let kept = std::env::var_os("GLISSADE_PLOTS").map(PathBuf::from);
    let base = kept.clone().unwrap_or_else(|| std::env::temp_dir().join(format!("glissade-{}", std::process::id())));
    let folder = base.join(name);
    fs::create_dir_all(&folder).expect("a folder for the figures");
    let applied =
        Disturbance { samples: &samples(), linear_unit: "m/s²", angular_unit: "rad/s²", acting: (5.0, 10.0) };
    let files = Figures { rows, disturbance: Some(applied), timeline: &Timeline::default() }.draw(&folder);
    let read = |file: PathBuf| (file.clone(), fs::read_to_string(file).expect("the file was written"));
    let texts = files.expect("drawn").into_iter().map(read).collect();
    if kept.is_none() {
        fs::remove_dir_all(&folder).expect("the folder is there");
    }
    texts
}

#[test]
fn every_figure_is_whole_and_small() {
    for (file, svg) in draw_all("flight", &flight(20.0)) {
        assert!(svg.starts_with("<svg width=\"1100\"") && svg.trim_end().ends_with("</svg>"), "{}", file.display());
        assert!(svg.len() < 300_000, "{} has {} bytes", file.display(), svg.len());
        assert!(!svg.contains("NaN") && !svg.contains("inf"), "{}", file.display());
    }
}

#[test]
fn figures_are_named_after_the_paper_s() {
    let names: Vec<_> = draw_all("names", &flight(1.0)).into_iter().map(|(file, _)| file).collect();
    let stems: Vec<_> = names.iter().filter_map(|file| file.file_name()?.to_str()).collect();
    let expected = ["altitude", "position", "attitude", "disturbance", "disturbed", "helix"];
    for ((stem, name), number) in stems.iter().zip(expected).zip(2..) {
        assert_eq!(*stem, format!("fig{number}-{name}.svg"));
    }
}

#[test]
fn axes_have_units_and_lines_have_names() {
    let figures = draw_all("texts", &flight(12.0));
    let says = |figure: usize, words: &[&str]| words.iter().all(|word| figures[figure].1.contains(word));
    assert!(says(0, &["z, m", "t, s", "z error, m", "z error rate, m/s", "U1, N", "reference", "flown", "start"]));
    assert!(says(2, &["roll, °", "U2, N m", "U4, N m"]));
    assert!(says(3, &["m/s²", "rad/s²"]));
    assert!(says(4, &["disturbed", "yaw, °"]));
    assert!(says(5, &["x (north), m", "y (west), m", "z (up), m", "from above"]));
}

#[test]
fn empty_and_diverged_flights_are_drawn_too() {
    draw_all("empty", &[]);
    draw_all("one", &flight(0.0));
    let mut rows = flight(6.0);
    for (k, row) in rows.iter_mut().enumerate().skip(3000) {
        row.position = [10_f64.powf(k as f64 / 10.0 - 300.0); 3];
        row.attitude = [f64::NAN; 4];
        row.u = [f64::INFINITY; 4];
    }
    draw_all("diverged", &rows);
}

#[test]
fn without_a_disturbance_two_figures_are_left_out() {
    let folder = std::env::temp_dir().join(format!("glissade-{}-calm", std::process::id()));
    fs::create_dir_all(&folder).expect("a folder for the figures");
    let files = Figures { rows: &flight(1.0), disturbance: None, timeline: &Timeline::default() }.draw(&folder);
    fs::remove_dir_all(&folder).expect("the folder is there");
    assert_eq!(files.map(|files| files.len()).expect("drawn"), 4);
}

#[test]
fn a_missing_folder_is_named() {
    let error = altitude(Path::new("no/such/folder"), &flight(1.0)).expect_err("no folder");
    assert!(format!("{error:#}").contains("no/such/folder"));
}

//! The figures of made-up flights: files exist, are whole and small, and keep the rules of every figure.

use std::fs;
use std::path::Path;

use nalgebra::UnitQuaternion;

use super::*;
use crate::record::Row;

/// Time constant of the made-up approach, s.
const TAU: f64 = 0.25;

/// Error and error rate of a critically damped approach from `e0`, at rest when t = 0.
pub(super) fn approach(e0: f64, t: f64) -> (f64, f64) {
    let decay = (-t / TAU).exp();
    (e0 * (1.0 + t / TAU) * decay, -e0 * t / (TAU * TAU) * decay)
}

/// Made-up rows of a flight of the paper's helix from the origin.
pub(in crate::report) fn made_up(seconds: f64) -> Vec<Row> {
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
        reference_is_held: false,
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

/// The figures of a flight along a trajectory with a disturbance.
pub(super) fn figures(rows: &[Row]) -> Figures<'_> {
    Figures {
        of: "made-up, seed 1".into(),
        kind: Kind::Tracking,
        rows,
        beliefs: &[],
        disturbance: Some(Disturbance { samples: samples(), on_accelerations: true, acting: (5.0, 10.0) }),
        places: vec![],
        surfaces: None,
        inputs: None,
        backdrop: backdrop::Backdrop::default(),
    }
}

/// Draws every figure, and returns the files' names and texts; into a folder that stays if `GLISSADE_PLOTS` names one.
pub(super) fn draw_all(name: &str, figures: &Figures) -> Vec<(String, String)> {
    let kept = std::env::var_os("GLISSADE_PLOTS").map(std::path::PathBuf::from);
    let temporary = || std::env::temp_dir().join(format!("glissade-{}", std::process::id()));
    let folder = kept.clone().unwrap_or_else(temporary).join(name);
    fs::create_dir_all(&folder).expect("a folder for the figures");
    let read = |file: &std::path::PathBuf| {
        let name = file.file_name().expect("it has a name").to_string_lossy().into_owned();
        let svg = fs::read_to_string(file).expect("the file was written");
        check(&name, &svg);
        (name, svg)
    };
    let texts = figures.draw(&folder).expect("drawn").iter().map(read).collect();
    if kept.is_none() {
        fs::remove_dir_all(&folder).expect("the folder is there");
    }
    texts
}

/// A text of a figure: what it says, and the rectangle that it takes.
struct Label<'a> {
    text: &'a str,
    low: (f64, f64),
    high: (f64, f64),
}

/// The value of an attribute.
fn attribute<'a>(element: &'a str, name: &str) -> Option<&'a str> {
    let (_, rest) = element.split_once(&format!(" {name}=\""))?;
    rest.split_once('"').map(|(value, _)| value)
}

fn labels(svg: &str) -> Vec<Label<'_>> {
    let texts = svg.lines().filter(|line| line.starts_with("<text"));
    let label = |element| {
        let number = |name| attribute(element, name).and_then(|v: &str| v.parse::<f64>().ok()).expect("a number");
        let text = element.split_once('>').and_then(|(_, rest)| rest.strip_suffix("</text>")).expect("a text");
        let (x, y, size) = (number("x"), number("y"), number("font-size"));
        let wide = match text.split_once("<tspan") {
            Some((first, more)) => {
                let more = more.split_once('>').map_or("", |(_, rest)| rest.trim_end_matches("</tspan>"));
                svg::text_width(first, size) + 12.0 + svg::text_width(more, 12.0)
            }
            None => svg::text_width(text, size),
        };
        let before = match attribute(element, "text-anchor") {
            Some("middle") => 0.5 * wide,
            Some(_) => wide,
            None => 0.0,
        };
        let (left, right, above) = (x - before, x - before + wide, 0.7 * size);
        match attribute(element, "transform") {
            // To the left of the place it becomes below it.
            Some(_) => Label { text, low: (x - above, y - wide + before), high: (x, y + before) },
            None => Label { text, low: (left, y - above), high: (right, y) },
        }
    };
    texts.map(label).collect()
}

/// What holds for every figure: it is whole and small, holds finite numbers only, no text leaves the page and none lies
/// on another.
fn check(name: &str, svg: &str) {
    assert!(svg.starts_with("<svg width=\"") && svg.trim_end().ends_with("</svg>"), "{name}");
    assert!(svg.len() < 300_000, "{name} has {} bytes", svg.len());
    assert!(!svg.contains("NaN") && !svg.contains("inf"), "{name}");
    let size = ["width", "height"].map(|side| attribute(svg, side).and_then(|v| v.parse::<f64>().ok()));
    let [Some(width), Some(height)] = size else { panic!("{name} has no size") };
    let labels = labels(svg);
    for (i, a) in labels.iter().enumerate() {
        let inside = a.low.0 >= 0.0 && a.low.1 >= 0.0 && a.high.0 <= width && a.high.1 <= height;
        assert!(inside, "{name}: `{}` leaves the page", a.text);
        for b in &labels[..i] {
            let apart = a.high.0 <= b.low.0 || b.high.0 <= a.low.0 || a.high.1 <= b.low.1 || b.high.1 <= a.low.1;
            assert!(apart, "{name}: `{}` lies on `{}`", a.text, b.text);
        }
    }
}

#[test]
fn figures_are_named_by_what_they_show() {
    let rows = made_up(20.0);
    let names: Vec<_> = draw_all("flight", &figures(&rows)).into_iter().map(|(name, _)| name).collect();
    let expected = ["position", "attitude", "rotors", "phase", "path", "disturbance", "disturbed"];
    assert_eq!(names, expected.map(|name| format!("{name}.svg")));
    let calm = Figures { disturbance: None, kind: Kind::Attitude, ..figures(&rows) };
    let names: Vec<_> = draw_all("calm", &calm).into_iter().map(|(name, _)| name).collect();
    assert_eq!(names, ["attitude.svg", "rotors.svg", "path.svg"]);
}

#[test]
fn axes_have_units_and_figures_have_headings() {
    let rows = made_up(12.0);
    let drawn = draw_all("texts", &figures(&rows));
    let says = |name: &str, words: &[&str]| {
        let (_, svg) = drawn.iter().find(|(file, _)| file == &format!("{name}.svg")).expect(name);
        for word in words {
            assert!(svg.contains(word), "{name} has no {word}");
        }
    };
    says("position", &["Position and its error", "made-up, seed 1", ">x, m<", ">t, s<", ">y error, m<"]);
    says("position", &["reference", "flown", "disturbance acts", "the same after 4 s", ">y error, mm<"]);
    says("attitude", &[">roll, °<", ">pitch error, °<"]);
    says("rotors", &[">U1, N<", ">U2, N m<", ">U3, mN m<", ">speed, rad/s<"]);
    says("phase", &[">y error, m<", ">y error rate, m/s<", "start"]);
    says("disturbance", &["disturbance, m/s²", "disturbance, rad/s²"]);
    says("path", &["x (north), m", "y (west), m", "z (up), m", "from above", "height"]);
}

#[test]
fn settings_stand_in_the_headings_as_far_as_there_is_room() {
    let rows = made_up(1.0);
    let of = |settings: &[&str]| {
        let settings: Vec<String> = settings.iter().map(|setting| (*setting).to_owned()).collect();
        figures(&rows).with_settings(&settings).of
    };
    assert_eq!(of(&[]), "made-up, seed 1");
    assert_eq!(of(&["control.z.gain=1", "ground=true"]), "made-up, seed 1, with control.z.gain=1, ground=true");
    let long = "x".repeat(90);
    assert_eq!(of(&["ground=true", &long, "a=1"]), "made-up, seed 1, with ground=true, 2 more");
    assert_eq!(of(&[&long]), "made-up, seed 1, with 1 setting");
}

#[test]
fn empty_short_and_diverged_flights_are_drawn_too() {
    draw_all("empty", &figures(&[]));
    draw_all("one", &figures(&made_up(0.0)));
    draw_all("short", &figures(&made_up(0.003)));
    let mut rows = made_up(6.0);
    for (k, row) in rows.iter_mut().enumerate().skip(3000) {
        row.position = [10_f64.powf(k as f64 / 10.0 - 300.0); 3];
        row.attitude = [f64::NAN; 4];
        row.u = [f64::INFINITY; 4];
    }
    draw_all("diverged", &figures(&rows));
}

#[test]
fn a_vehicle_that_never_moves_has_axes_of_their_least_span() {
    let still = |k: u32| Row { t: f64::from(k) * 1e-3, position: [1e-13 * f64::from(k % 7); 3], ..Row::default() };
    let rows: Vec<_> = (0..8000).map(still).collect();
    let drawn = draw_all("still", &Figures { disturbance: None, ..figures(&rows) });
    let names: Vec<_> = drawn.iter().map(|(name, _)| name.as_str()).collect();
    assert_eq!(names, ["position.svg", "attitude.svg"], "rotors that never turn have no figure");
    // Two millimetres, not the noise of 1e-13.
    assert!(drawn[0].1.contains(">x error, mm<") && drawn[0].1.contains(">−0.5<"));
}

/// A flight with a fault, to places: phases of 3 s each.
fn piloted(rows: &[Row]) -> Figures<'_> {
    let names = ["take-off", "hold", "go-to 1", "go-to 2", "return", "land"];
    let span = |(i, name): (usize, &str)| {
        let color = backdrop::phase_color(name);
        backdrop::Span { name: name.into(), from: 1.0 + 3.0 * i as f64, to: 4.0 + 3.0 * i as f64, color }
    };
    let fault = |from: f64, to: f64| backdrop::Span { name: "gnss off".into(), from, to, color: style::INK };
    let backdrop = backdrop::Backdrop {
        phases: names.into_iter().enumerate().map(span).collect(),
        faults: vec![fault(8.0, 8.2), fault(17.0, f64::INFINITY)],
        events: vec![(18.5, "touchdown".into()), (19.0, "disarmed".into()), (19.1, "lost".into())],
        landed: Some(18.5),
        named: false,
    };
    let places = vec![Some([3.0, 0.0, 5.0]), Some([3.0, 0.1, 5.0]), Some([-1.0, 2.0, 9.0])];
    Figures { kind: Kind::Piloted, disturbance: None, places, backdrop, ..figures(rows) }
}

#[test]
fn a_pilot_s_flight_names_phases_faults_and_landing() {
    let rows = made_up(20.0);
    let drawn = draw_all("piloted", &piloted(&rows));
    let names: Vec<_> = drawn.iter().map(|(name, _)| name.as_str()).collect();
    assert_eq!(names, ["flight.svg", "position.svg", "attitude.svg", "rotors.svg", "path.svg"]);
    for word in ["take-off", "hold", "go-to 1", "go-to 2", "return", "land", "gnss off", "touchdown", "disarmed"] {
        assert!(drawn[0].1.contains(&format!(">{word}<")), "{word} is not named");
    }
    let color = backdrop::phase_color("return");
    assert_eq!(color, backdrop::phase_color("return 2"));
    assert!(drawn[4].1.contains(&color.to_string()), "the path has the colours of the phases");
}

#[test]
fn a_reference_counts_only_while_the_vehicle_flies() {
    let rows = made_up(20.0);
    let figures = piloted(&rows);
    let error = tracking::while_flying(&figures, &rows, |row| row.t);
    assert!(error[0].0 >= 1.0 && error.last().expect("it flew").0 < 18.5);
}

#[test]
fn a_missing_folder_is_named() {
    let error = figures(&made_up(1.0)).draw(Path::new("no/such/folder")).expect_err("no folder");
    assert!(format!("{error:#}").contains("no/such/folder"));
}

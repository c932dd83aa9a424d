//! Trajectories from waypoints and from files, flown: judged by the truth.

use firmware::guidance::{Spline, Trajectory};
use nalgebra::Vector3;
use sim_host::flight;
use sim_host::record::Row;
use sim_host::reference;
use sim_host::scenario::Scenario;

fn load(name: &str, settings: &[&str]) -> anyhow::Result<Scenario> {
    let settings: Vec<String> = settings.iter().map(|s| (*s).to_owned()).collect();
    Scenario::load(name, &settings)
}

fn fly(name: &str, settings: &[&str]) -> (Scenario, Vec<Row>) {
    let scenario = load(name, settings).expect("valid");
    let mut rows = Vec::new();
    flight::fly(&scenario, 1, &mut rows).expect("can be flown");
    (scenario, rows)
}

fn path(scenario: &Scenario) -> &Spline {
    match &scenario.file.trajectory {
        Trajectory::Spline(path) => path,
        other => panic!("{other:?}"),
    }
}

fn distance(row: &Row) -> f64 {
    (0..3).map(|i| (row.position[i] - row.reference[i]).powi(2)).sum::<f64>().sqrt()
}

fn example(file: &str) -> String {
    format!("{}/../examples/csv/{file}", env!("CARGO_MANIFEST_DIR"))
}

#[test]
fn each_waypoint_is_flown_through_within_5_cm_round_after_round() {
    let (scenario, rows) = fly("waypoints", &[]);
    let path = path(&scenario);
    let rounds = (scenario.file.duration_s * 1e3) as u32 / path.duration_ms;
    assert!(rounds >= 2, "the flight shows more than a round: {} ms", path.duration_ms);
    for waypoint in [[5.0, 0.0, 2.5], [8.0, 3.0, 4.0], [5.0, 7.0, 3.0], [1.0, 5.0, 1.5], [-4.0, 5.0, 2.0]] {
        let near = |row: &&Row| (Vector3::from(row.position) - Vector3::from(waypoint)).norm() < 0.05;
        let passes: Vec<f64> = rows.iter().filter(near).map(|row| row.t).collect();
        let span = passes.last().zip(passes.first()).map_or(0.0, |(last, first)| last - first);
        let round = f64::from(path.duration_ms) * 1e-3;
        assert!((span - round).abs() < 0.1 || span > 1.9 * round, "{waypoint:?}: {span} s between first and last pass");
    }
    assert!(rows.iter().filter(|row| row.t > 5.0).all(|row| distance(row) < 0.05));
}

#[test]
fn a_file_is_flown_within_2_cm_and_ends_at_rest_where_it_says() {
    let (scenario, rows) = fly(&example("eight.toml"), &[]);
    assert_eq!((path(&scenario).begin_ms, path(&scenario).duration_ms), (1_000, 20_000));
    let worst = rows.iter().map(distance).fold(0.0, f64::max);
    assert!(worst < 0.02, "{worst} m");
    let last = rows.last().expect("flown");
    assert!((Vector3::from(last.position) - Vector3::new(0.0, 0.0, 2.0)).norm() < 0.01, "{:?}", last.position);
}

#[test]
fn the_firmwares_reference_is_the_desktops_in_double_precision() {
    let scenario = load("waypoints", &[]).expect("valid");
    let path = path(&scenario);
    for ms in (0..200_000).step_by(13) {
        let (single, double) = (path.at(ms, 1), reference::at(&scenario.file.trajectory, f64::from(ms) * 1e-3));
        let off = single.position.cast::<f64>() - Vector3::new(double[0], double[1], double[2]);
        let turn = f64::from(single.yaw) - double[3];
        let turn = turn - std::f64::consts::TAU * (turn / std::f64::consts::TAU).round();
        // Eight units in the last place of an f32: of the path's 13 m, and of a yaw up to 2π.
        assert!(off.norm() < 8.0 * 9.6e-7 && turn.abs() < 8.0 * 4.8e-7, "{ms}: {off} {turn}");
    }
}

#[test]
fn it_is_flown_on_sensors_from_the_ground() {
    let points = "{ position_m = [0, 0, 10] }, { position_m = [6, 0, 11] }, { position_m = [6, 6, 12], yaw_deg = 90 }";
    let trajectory = format!("trajectory={{ waypoints = {{ points = [{points}] }} }}");
    let (scenario, rows) = fly("outdoor-eight", &[&trajectory, "sensors=\"rtk\"", "duration_s=45"]);
    assert_eq!(path(&scenario).begin_ms, 4_000, "where the joining path ends");
    let last = rows.last().expect("flown");
    let off = Vector3::from(last.position) - Vector3::new(6.0, 6.0, 12.0);
    assert!(off.norm() < 0.3, "{off}");
    assert!(rows.iter().filter(|row| row.t > 20.0).all(|row| distance(row) < 0.5), "in 3 m/s of wind");
}

#[test]
fn a_path_beyond_the_vehicle_is_refused_by_the_limit() {
    for (settings, error) in [
        (["trajectory.waypoints.speed_m_s=30", "trajectory.waypoints.acceleration_m_s2=30"], "`tilt_max_rad` is 1.2"),
        (["trajectory.waypoints.acceleration_m_s2=9", "thrust_to_weight=1.1"], "(`thrust_to_weight`): fly it slower"),
        (["trajectory.waypoints.acceleration_m_s2=9", "thrust_to_weight=4"], ""),
        (
            ["trajectory.waypoints.points=[]", "duration_s=3"],
            "`trajectory.waypoints.points` must have 2 or more points, not 0",
        ),
    ] {
        match load("waypoints", &settings) {
            Ok(_) => assert_eq!(error, ""),
            Err(refused) => {
                let text = format!("{refused:#}");
                assert!(
                    !error.is_empty() && text.contains(error) && text.starts_with("scenario `waypoints`"),
                    "{text}"
                );
            }
        }
    }
    let refused =
        format!("{:#}", load(&example("eight.toml"), &["trajectory.csv.file=\"none.csv\""]).expect_err("refused"));
    assert!(refused.contains("none.csv") && !refused.contains('\n'), "{refused}");
}

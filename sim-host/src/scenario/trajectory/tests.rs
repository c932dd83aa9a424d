use super::*;

fn resolved(text: &str) -> Result<Spline> {
    let mut table: toml::Table = text.parse().expect("TOML");
    resolve(&mut table, Path::new("scenarios"))?;
    match table.remove("trajectory").expect("there").try_into().expect("a trajectory") {
        Trajectory::Spline(path) => Ok(path),
        other => panic!("{other:?}"),
    }
}

const POINTS: &str = "[trajectory.waypoints]\npoints = [
    { position_m = [0, 0, 2], at_s = 1 }, { position_m = [3, 1, 2.5], yaw_deg = 170, at_s = 3.25 },
    { position_m = [0, 4, 2], yaw_deg = -170, at_s = 5.5 }, { position_m = [-2, 0, 1], at_s = 8 },
]";

#[test]
fn each_waypoint_is_flown_through_at_its_time_with_the_shorter_turn() {
    let path = resolved(POINTS).expect("valid");
    let within = |ms: u32, [x, y, z, yaw]: [f32; 4]| {
        let there = path.at(ms, 1);
        let off = (there.position - nalgebra::Vector3::new(x, y, z)).norm();
        assert!(off < 1e-5 && (there.yaw - yaw).abs() < 1e-5, "{ms}: {there:?}");
    };
    within(0, [0.0, 0.0, 2.0, 0.0]);
    within(1_000, [0.0, 0.0, 2.0, 0.0]);
    within(3_250, [3.0, 1.0, 2.5, 170_f32.to_radians()]);
    within(5_500, [0.0, 4.0, 2.0, -170_f32.to_radians()]);
    within(8_000, [-2.0, 0.0, 1.0, -170_f32.to_radians()]);
    assert_eq!(path.at(8_000, 1).velocity.norm(), 0.0);
    assert!(path.at(4_400, 1).yaw_rate < 0.5, "the short way round");
}

#[test]
fn times_follow_from_the_limits_and_use_them() {
    let text = |more: &str| {
        format!(
            "[join]\nduration_s = 4\n[trajectory.waypoints]\npoints = [{{ position_m = [0, 0, 2] }}, \
                 {{ position_m = [8, 0, 2] }}, {{ position_m = [8, 6, 3] }}, {{ position_m = [0, 3, 2] }}]\n{more}"
        )
    };
    for (more, speed, acceleration) in [("", 2.0, 2.0), ("speed_m_s = 9\nacceleration_m_s2 = 3", 9.0, 3.0)] {
        let path = resolved(&text(more)).expect("valid");
        assert_eq!(path.begin_ms, 4_000, "after the joining path");
        let peak = Peak::of(&path);
        assert!(peak.speed <= speed * 1.001 && peak.acceleration <= acceleration * 1.001, "{peak:?}");
        assert!(peak.speed > speed * 0.98 || peak.acceleration > acceleration * 0.98, "{peak:?}");
    }
    let ring = resolved(&text("repeat = true")).expect("valid");
    assert!(ring.at(4_000, 1).velocity.norm() > 0.3, "a ring does not stop where it closes");
}

#[test]
fn what_is_wrong_with_waypoints_is_named() {
    for (from, to, error) in [
        (
            "at_s = 5.5",
            "at_s = 3.25",
            "`trajectory.waypoints.points.2.at_s` must be 0.05 s or more after `points.1.at_s`, 3.25, not 3.25",
        ),
        (", at_s = 8", "", "3 of 4 points have `at_s`: give it to all of them, or to none"),
        ("[-2, 0, 1]", "[-2, 0, 1e5]", "position_m.2` must be between -10000 and 10000 m, not 100000"),
        (
            "at_s = 8 },\n]",
            "at_s = 8 }]\nspeed_m_s = 2",
            "`speed_m_s`, `acceleration_m_s2` and `yaw_rate_rad_s` find the times",
        ),
        (
            "at_s = 8 },\n]",
            "at_s = 8 }]\nrepeat = true",
            "with `repeat` and `at_s` the last of `points` must be the first again",
        ),
        (
            "at_s = 8 },\n]",
            "at_s = 8 }]\nspeed = 2",
            "`trajectory.waypoints.speed` is no key: did you mean `speed_m_s`?",
        ),
        (
            "[trajectory.waypoints]",
            "[trajectory.hold]\n[trajectory.waypoints]",
            "`trajectory` is given twice, as `hold` and as `waypoints`",
        ),
    ] {
        let text = POINTS.replace(from, to);
        assert_ne!(text, POINTS);
        let refused = format!("{:#}", resolved(&text).expect_err("refused"));
        assert!(refused.contains(error) && !refused.contains('\n'), "{refused}");
    }
}

/// Rows of a lying eight, the heading along the velocity, at `rate_hz`.
fn eight(seconds: f64, rate_hz: f64) -> Vec<csv::Row> {
    let rows = (seconds * rate_hz).round() as usize;
    let mut last = 0.0;
    (0..=rows)
        .map(|i| {
            let t = i as f64 / rate_hz;
            let (sin, cos) = (t.sin(), t.cos());
            last = nearest((2.0 * (2.0 * t).cos()).atan2(4.0 * cos), last);
            csv::Row { line: i + 2, t, value: [4.0 * sin, (2.0 * t).sin(), 2.0, last] }
        })
        .collect()
}

fn csv_file(repeat: bool, tolerance_m: f64) -> Csv {
    Csv { file: String::new(), repeat, start_s: None, tolerance_m }
}

#[test]
fn a_minute_at_a_kilohertz_is_fitted_to_a_millimetre() {
    let rows = eight(60.0, 1e3);
    let path = fit_rows(&csv_file(false, 0.01), &rows, 0.0, 60.0).expect("fits");
    for row in rows.iter().step_by(7) {
        let there = crate::reference::at(&Trajectory::Spline(path.clone()), row.t);
        assert!(distance(&there, &row.value) < 1e-3, "{row:?} {there:?}");
        assert!(nearest(there[3] - row.value[3], 0.0).abs() < 2e-2, "{row:?} {there:?}");
    }
}

#[test]
fn a_file_that_cannot_be_flown_is_refused_by_its_line() {
    let turn = std::f64::consts::TAU;
    let refused = |file: &Csv, rows: &[csv::Row], join_s, flight_s| {
        format!("{:#}", fit_rows(file, rows, join_s, flight_s).expect_err("refused"))
    };
    let rows = eight(turn, 100.0);
    assert!(refused(&csv_file(false, 0.01), &rows, 0.0, 9.0).starts_with("it ends moving, at 6.28 s"));
    assert!(
        refused(&Csv { start_s: Some(2.0), ..csv_file(false, 0.01) }, &rows, 0.0, 5.0).starts_with("it begins moving")
    );
    assert!(refused(&csv_file(true, 0.01), &rows[..500], 0.0, 9.0).contains("line 501 is"));
    let mut corner = rows.clone();
    corner.iter_mut().skip(300).for_each(|row| row.value[2] += 1.0);
    let text = refused(&csv_file(false, 0.01), &corner, 0.0, 6.0);
    assert!(text.contains(" m beside line 30") && text.contains("more than `tolerance_m` = 0.01"), "{text}");
}

#[test]
fn the_greatest_acceleration_of_what_repeats_is_that_of_its_reference() {
    for text in [
        "helix = { amplitude_m = [2.0, 3.0], rate_rad_s = 1.5, base_m = 0.0, climb_m_s = 0.1, yaw_rad = 0.0 }",
        "figure-eight = { center_m = [0.0, 0.0, 2.0], amplitude_m = [3.0, 1.0], rate_rad_s = 1.2, yaw_rad = 0.0 }",
        "figure-eight = { center_m = [0.0, 0.0, 2.0], amplitude_m = [9.0, 0.5], rate_rad_s = 0.8, yaw_rad = 0.0 }",
    ] {
        let table: toml::Table = text.parse().expect("TOML");
        let trajectory: Trajectory = table.try_into().expect("a trajectory");
        // Second differences over 1 ms, of a turn at least.
        let at = |ms: i32| crate::reference::at(&trajectory, 10.0 + f64::from(ms) * 1e-3);
        let second = |ms: i32, i: usize| (at(ms + 1)[i] - 2.0 * at(ms)[i] + at(ms - 1)[i]) * 1e6;
        let greatest = (0..8_000).map(|ms| second(ms, 0).hypot(second(ms, 1))).fold(0.0, f64::max);
        assert!((sideways_m_s2(&trajectory) - greatest).abs() < 1e-3 * greatest, "{text}: {greatest}");
    }
}

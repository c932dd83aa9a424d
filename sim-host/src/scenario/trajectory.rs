//! `[trajectory.waypoints]` and `[trajectory.csv]`: read, fitted, and put into the scenario as the firmware's spline.
//!
//! Times of points and rows count from `start_s` on the flight's clock: the end of the joining path where there is one.

use std::path::Path;

use anyhow::{Context, Result, anyhow, bail, ensure};
use firmware::config::FlightConfig;
use firmware::guidance::{DURATION_MAX_MS, Spline, Trajectory};
use serde::Deserialize;

use super::csv::{self, nearest};
use crate::refusal::{Refusal, figure, nearest as nearest_name, typed, within};
use crate::spline::{self, Knot, SEGMENTS_MAX, Shape};

/// Greatest coordinate, m: an f32 still resolves a millimetre.
const LENGTH_MAX_M: f64 = 1e4;
/// Segments between the two waypoints that are closest in time.
const SEGMENTS_A_LEG: f64 = 4.0;
/// The shortest leg, s, before times are brought within the limits.
const LEG_MIN_S: f64 = 0.2;
/// The shortest segment of the firmware, ms.
const SEGMENT_MIN_MS: u32 = 10;
/// Below this mean speed in its first, or last, 0.1 s, a file begins, or ends, at rest, m/s.
const REST_M_S: f64 = 0.2;
const REST_S: f64 = 0.1;

/// A place to fly through.
#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Waypoint {
    position_m: [f64; 3],
    /// That of the point before without it; 0 at first.
    yaw_deg: Option<f64>,
    at_s: Option<f64>,
}

#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Waypoints {
    points: Vec<Waypoint>,
    #[serde(default)]
    repeat: bool,
    start_s: Option<f64>,
    speed_m_s: Option<f64>,
    acceleration_m_s2: Option<f64>,
    yaw_rate_rad_s: Option<f64>,
}

#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Csv {
    file: String,
    #[serde(default)]
    repeat: bool,
    start_s: Option<f64>,
    #[serde(default = "default_tolerance_m")]
    tolerance_m: f64,
}

fn default_tolerance_m() -> f64 {
    0.01
}

/// Puts a spline in the place of a scenario's waypoints or file; leaves every other trajectory alone. A file's path is
/// relative to `folder`, the scenario's.
///
/// # Errors
/// In one line: the key, or the file with line and column, and what is wrong.
pub(super) fn resolve(scenario: &mut toml::Table, folder: &Path) -> Result<()> {
    let join_s = scenario.get("join").and_then(|join| seconds(join.get("duration_s")?)).unwrap_or(0.0);
    let flight_s = scenario.get("duration_s").and_then(seconds).unwrap_or(f64::INFINITY);
    let Some(toml::Value::Table(kinds)) = scenario.get("trajectory") else { return Ok(()) };
    require_known(kinds)?;
    let Some(kind) = ["waypoints", "csv"].into_iter().find(|kind| kinds.contains_key(*kind)) else { return Ok(()) };
    let path = if kind == "csv" {
        of_csv(&table(kinds, kind)?, folder, join_s, flight_s)
    } else {
        of_waypoints(&table(kinds, kind)?, join_s)
    };
    let path = path.map_err(|error| Refusal::below(error, &format!("trajectory.{kind}")))?;
    let path = Trajectory::Spline(path);
    scenario.insert("trajectory".to_owned(), toml::Value::try_from(path)?);
    Ok(())
}

/// The kinds of `[trajectory.KIND]`.
const KINDS: [&str; 6] = ["hold", "step", "helix", "figure-eight", "waypoints", "csv"];

/// Says which tables a scenario without a trajectory may be given.
pub(super) fn explain_missing(error: anyhow::Error) -> anyhow::Error {
    match error.downcast::<Refusal>() {
        Ok(refusal) if refusal.is_missing() && refusal.key() == "trajectory" => {
            let [kind, others @ ..] = KINDS;
            let remedy = format!(
                "add a table `[trajectory.{kind}]` with `position_m` and `yaw_rad`, or one of {}",
                others.join(", ")
            );
            refusal.remedy(remedy).into()
        }
        Ok(refusal) => refusal.into(),
        Err(error) => error,
    }
}

/// Refuses a kind that there is none of, none, and two.
fn require_known(kinds: &toml::Table) -> Result<()> {
    let is_known = |kind: &str| kind == "spline" || KINDS.contains(&kind);
    let refusal = Refusal::new("trajectory", format!("must be one of {}", KINDS.join(", ")));
    let Some(kind) = kinds.keys().find(|kind| !is_known(kind)) else {
        return match kinds.keys().collect::<Vec<_>>()[..] {
            [] => Err(refusal.given("an empty table").into()),
            [_] => Ok(()),
            [kind, other, ..] => bail!("`trajectory` is given twice, as `{kind}` and as `{other}`: keep one"),
        };
    };
    let refusal = refusal.given(format!("`{kind}`"));
    let near = nearest_name(kind, KINDS);
    Err(near.map_or(refusal.clone(), |near| refusal.remedy(format!("did you mean `{near}`?"))).into())
}

fn seconds(value: &toml::Value) -> Option<f64> {
    value.as_float().or_else(|| value.as_integer().map(|whole| whole as f64))
}

fn table<T: serde::de::DeserializeOwned>(kinds: &toml::Table, kind: &str) -> Result<T> {
    let key = format!("trajectory.{kind}");
    match kinds.get(kind) {
        Some(toml::Value::Table(table)) => typed(table.clone()).map_err(|error| Refusal::below(error, &key)),
        other => {
            let refusal = Refusal::new(key, "must be a table");
            Err(other.map_or(refusal.clone(), |value| refusal.given(value)).into())
        }
    }
}

/// Milliseconds, for the firmware.
fn milliseconds(key: &str, value_s: f64) -> Result<u32> {
    within(key, value_s, 0.0, f64::from(DURATION_MAX_MS) * 1e-3)?;
    Ok((value_s * 1e3).round() as u32)
}

// ------------------------------------------------------------------------------------------------------ waypoints

fn of_waypoints(file: &Waypoints, join_s: f64) -> Result<Spline> {
    let points = places(file)?;
    let timed = file.points.iter().filter(|point| point.at_s.is_some()).count();
    ensure!(
        timed == 0 || timed == file.points.len(),
        "{timed} of {} points have `at_s`: give it to all of them, or to none",
        file.points.len()
    );
    let begin_s = file.start_s.unwrap_or(join_s);
    if timed == 0 {
        return within_limits(file, &points, begin_s);
    }
    ensure!(
        file.speed_m_s.or(file.acceleration_m_s2).or(file.yaw_rate_rad_s).is_none(),
        "`speed_m_s`, `acceleration_m_s2` and `yaw_rate_rad_s` find the times of points without `at_s`: leave them out"
    );
    let times: Vec<f64> = file.points.iter().filter_map(|point| point.at_s).collect();
    through(file.repeat, &points, &times, begin_s)
}

/// x, y, z and unwrapped yaw of each point.
fn places(file: &Waypoints) -> Result<Vec<[f64; 4]>> {
    if file.points.len() < 2 {
        return Err(Refusal::new("points", "must have 2 or more points").given(file.points.len()).into());
    }
    let mut places: Vec<[f64; 4]> = Vec::new();
    for (index, point) in file.points.iter().enumerate() {
        let [x, y, z] = point.position_m;
        for (axis, value) in [x, y, z].into_iter().enumerate() {
            within(&format!("points.{index}.position_m.{axis}"), value, -LENGTH_MAX_M, LENGTH_MAX_M)?;
        }
        let last = places.last().map_or(0.0, |place| place[3]);
        let yaw = point.yaw_deg.map_or(Ok(last), |deg| {
            within(&format!("points.{index}.yaw_deg"), deg, -3600.0, 3600.0).map(|()| deg.to_radians())
        })?;
        places.push([x, y, z, nearest(yaw, last)]);
    }
    Ok(places)
}

/// Times from the limits of speed, acceleration and yaw rate: in proportion to the length of the legs, and as short as
/// the limits allow.
fn within_limits(file: &Waypoints, points: &[[f64; 4]], begin_s: f64) -> Result<Spline> {
    let limit = |key: &str, value: Option<f64>, default: f64| {
        let value = value.unwrap_or(default);
        within(key, value, 0.01, 100.0).map(|()| value)
    };
    let speed = limit("speed_m_s", file.speed_m_s, 2.0)?;
    let acceleration = limit("acceleration_m_s2", file.acceleration_m_s2, 2.0)?;
    let yaw_rate = limit("yaw_rate_rad_s", file.yaw_rate_rad_s, 1.0)?;

    require_apart(points)?;
    let mut points = points.to_vec();
    if file.repeat && distance(&points[0], &points[points.len() - 1]) > 0.0 {
        let [x, y, z, yaw] = points[0];
        points.push([x, y, z, nearest(yaw, points[points.len() - 1][3])]);
    }
    let mut times = vec![0.0];
    for (i, leg) in points.windows(2).enumerate() {
        let stands = !file.repeat && (i == 0 || i + 2 == points.len());
        let ends = if stands { speed / acceleration } else { 0.0 };
        let long = (distance(&leg[0], &leg[1]) / speed).max((leg[1][3] - leg[0][3]).abs() / yaw_rate);
        times.push(times[i] + (long + ends).max(LEG_MIN_S));
    }
    require_short(times[times.len() - 1])?;
    let path = through(file.repeat, &points, &times, begin_s)?;
    let peak = Peak::of(&path);
    let slower = (peak.speed / speed).max((peak.acceleration / acceleration).sqrt()).max(peak.yaw_rate / yaw_rate);
    let duration_ms = (f64::from(path.duration_ms) * slower).ceil();
    require_short(duration_ms * 1e-3)?;
    Ok(Spline { duration_ms: (duration_ms as u32).max(SEGMENT_MIN_MS * path.segments() as u32), ..path })
}

/// Refuses a leg of no length: no limit says how long it takes.
fn require_apart(points: &[[f64; 4]]) -> Result<()> {
    let Some(i) = points.windows(2).position(|pair| pair[0] == pair[1]) else { return Ok(()) };
    let remedy = "leave one out, or give every point `at_s` to wait there";
    Err(Refusal::new(format!("points.{}", i + 1), format!("is where `points.{i}` is")).remedy(remedy).into())
}

/// Refuses a path that takes longer than the firmware's clock of a path goes.
fn require_short(seconds: f64) -> Result<()> {
    let most = f64::from(DURATION_MAX_MS) * 1e-3;
    ensure!(seconds <= most, "the path takes {seconds:.0} s, more than {most}: raise `speed_m_s`, or leave points out");
    Ok(())
}

fn distance(a: &[f64; 4], b: &[f64; 4]) -> f64 {
    a.iter().zip(b).take(3).map(|(a, b)| (a - b) * (a - b)).sum::<f64>().sqrt()
}

/// The path of minimum snap through points at their times.
fn through(repeat: bool, points: &[[f64; 4]], times: &[f64], begin_s: f64) -> Result<Spline> {
    let (first, last) = (times[0], times[times.len() - 1]);
    let last_key = format!("points.{}.at_s", times.len() - 1);
    within("points.0.at_s", first, 0.0, f64::from(DURATION_MAX_MS) * 1e-3)?;
    for (i, pair) in times.windows(2).enumerate() {
        later(&format!("points.{}.at_s", i + 1), pair[1], i, pair[0], 0.05)?;
    }
    let (start, end) = (points[0], points[points.len() - 1]);
    if repeat {
        ensure!(
            distance(&start, &end) < 1e-6,
            "with `repeat` and `at_s` the last of `points` must be the first again: its `at_s` is when the next round begins"
        );
        ensure!(points.len() > 3, "`points` must be at least 3 places to `repeat`");
    }
    let duration_ms = milliseconds(&last_key, last - first)?;
    let shortest = times.windows(2).map(|pair| pair[1] - pair[0]).fold(f64::INFINITY, f64::min);
    let wanted = (SEGMENTS_A_LEG * (last - first) / shortest).ceil();
    let segments = (wanted as usize).clamp(8, SEGMENTS_MAX);
    later(&last_key, last, 0, first, f64::from(SEGMENT_MIN_MS) * 1e-3 * segments as f64)?;
    ensure!(
        wanted <= SEGMENTS_A_LEG * SEGMENTS_MAX as f64,
        "points {shortest} s apart on a path of {} s need more than its {SEGMENTS_MAX} segments: leave some out",
        last - first
    );
    let turn = if repeat { whole_turns(end[3] - start[3])? } else { 0.0 };
    let rest = if repeat { [None; 2] } else { [Some(start), Some(end)] };
    let shape = Shape { segments, repeat, turn, rest };
    let scale = segments as f64 / (last - first);
    let knots = points.iter().zip(times).map(|(value, t)| Knot { at: (t - first) * scale, value: *value });
    // Where it stands, or where a ring closes, the end is met already.
    let inner: Vec<Knot> = if repeat { knots.take(points.len() - 1).collect() } else { inner(knots.collect()) };
    let control_points = shape.fit(&inner, &[]).context("`points`")?;
    Ok(spline::for_firmware(&shape, &control_points, milliseconds("start_s", begin_s + first)?, duration_ms))
}

/// Refuses a point's time that is not at least `gap_s` after that of another.
fn later(key: &str, at_s: f64, before: usize, before_s: f64, gap_s: f64) -> Result<()> {
    // Times are decimals: 0.3 - 0.25 is a little less than 0.05.
    if at_s - before_s >= gap_s - 1e-9 {
        return Ok(());
    }
    let rule = format!("must be {gap_s} s or more after `points.{before}.at_s`, {}", figure(before_s));
    Err(Refusal::new(key, rule).given(figure(at_s)).into())
}

fn inner(mut knots: Vec<Knot>) -> Vec<Knot> {
    knots.pop();
    knots.drain(..1);
    knots
}

fn whole_turns(turn: f64) -> Result<f64> {
    let whole = std::f64::consts::TAU * (turn / std::f64::consts::TAU).round();
    ensure!((turn - whole).abs() < 1e-2, "with `repeat` yaw must end as it begins, give or take whole turns");
    Ok(whole)
}

// ------------------------------------------------------------------------------------------------------------ CSV

fn of_csv(file: &Csv, folder: &Path, join_s: f64, flight_s: f64) -> Result<Spline> {
    within("tolerance_m", file.tolerance_m, 1e-4, 10.0)?;
    let path = folder.join(&file.file);
    let rows = csv::read(&path)?;
    let name = || format!("trajectory file `{}`", path.display());
    fit_rows(file, &rows, join_s, flight_s).with_context(name)
}

fn fit_rows(file: &Csv, rows: &[csv::Row], join_s: f64, flight_s: f64) -> Result<Spline> {
    let (first, last) = (rows[0], rows[rows.len() - 1]);
    let duration_ms = milliseconds("t_s", last.t - first.t)?;
    ensure!(duration_ms >= 100, "it takes {duration_ms} ms: it must be 100 ms at least");
    let begin_ms = milliseconds("start_s", file.start_s.unwrap_or(join_s) + first.t)?;
    let turn = if file.repeat { closes(file, rows)? } else { 0.0 };
    let rest = if file.repeat { [None; 2] } else { rests(rows) };
    let end_s = f64::from(begin_ms + duration_ms) * 1e-3;
    if !file.repeat {
        ensure!(
            rest[0].is_some() || f64::from(begin_ms) * 1e-3 <= join_s + 1e-3,
            "it begins moving, at {} s (`start_s` plus the first `t_s`), but the vehicle stands at its beginning until then: \
             let it begin at rest, or leave `start_s` out and begin at `t_s` = 0",
            f64::from(begin_ms) * 1e-3
        );
        ensure!(
            rest[1].is_some() || flight_s <= end_s,
            "it ends moving, at {end_s} s, before the flight does: let it end at rest, set `repeat`, or \
             `duration_s` to {end_s} at most"
        );
    }
    let scale = |segments: usize| segments as f64 / (last.t - first.t);
    let mut best: Option<(f64, usize, Shape, Vec<[f64; 4]>)> = None;
    for segments in [8, 16, 32, 64, 128, SEGMENTS_MAX] {
        // Two rows a segment decide its shape; a segment of the firmware lasts 10 ms.
        if best.is_some() && (2 * segments > rows.len() || segments as u32 * 10 > duration_ms) {
            break;
        }
        let shape = Shape { segments, repeat: file.repeat, turn, rest };
        let near: Vec<Knot> =
            rows.iter().map(|row| Knot { at: (row.t - first.t) * scale(segments), value: row.value }).collect();
        let points = shape.fit(&[], &near)?;
        let (error, row) = worst(&shape, &points, &near);
        if best.as_ref().is_none_or(|(least, ..)| error < *least) {
            best = Some((error, row, shape, points));
        }
        if error < 0.1 * file.tolerance_m {
            break;
        }
    }
    let (error, row, shape, points) = best.ok_or_else(|| anyhow!("no path fits it"))?;
    let (t, line) = (rows[row].t, rows[row].line);
    ensure!(
        error <= file.tolerance_m,
        "the path that fits it best is {error:.3} m beside line {line} (t_s = {t}), more than `tolerance_m` = {}: \
         smooth the corners of the file, split it, or raise `tolerance_m`",
        file.tolerance_m
    );
    Ok(spline::for_firmware(&shape, &points, begin_ms, duration_ms))
}

/// The greatest distance from a row, m, and which row.
fn worst(shape: &Shape, points: &[[f64; 4]], near: &[Knot]) -> (f64, usize) {
    let errors = near.iter().map(|knot| distance(&spline::value(points, shape, knot.at), &knot.value));
    errors.enumerate().fold((0.0, 0), |worst, (i, error)| if error > worst.0 { (error, i) } else { worst })
}

/// By how much yaw turns in a file that is to repeat, rad.
fn closes(file: &Csv, rows: &[csv::Row]) -> Result<f64> {
    let (first, last) = (rows[0], rows[rows.len() - 1]);
    let gap = distance(&first.value, &last.value);
    ensure!(
        gap <= file.tolerance_m,
        "with `repeat` the last row must be the first place again; line {} is {gap:.3} m from it",
        last.line
    );
    whole_turns(last.value[3] - first.value[3])
}

/// Where a file begins and ends, if it is at rest there.
fn rests(rows: &[csv::Row]) -> [Option<[f64; 4]>; 2] {
    let (first, last) = (&rows[0], &rows[rows.len() - 1]);
    let soon = rows.iter().find(|row| row.t >= first.t + REST_S).unwrap_or(last);
    let late = rows.iter().rfind(|row| row.t <= last.t - REST_S).unwrap_or(first);
    let at_rest = |a: &csv::Row, b: &csv::Row| distance(&a.value, &b.value) < REST_M_S * (b.t - a.t);
    [at_rest(first, soon).then_some(first.value), at_rest(late, last).then_some(last.value)]
}

// ----------------------------------------------------------------------------------------- what the vehicle can do

/// The greatest demands of a path, and when the greatest is made.
#[derive(Clone, Copy, Debug, Default)]
struct Peak {
    speed: f64,
    acceleration: f64,
    yaw_rate: f64,
}

/// Times at which a path is looked at, ms of its own.
fn samples(path: &Spline) -> impl Iterator<Item = u32> {
    (0..path.duration_ms).step_by((path.duration_ms / 5_000).max(1) as usize)
}

impl Peak {
    fn of(path: &Spline) -> Self {
        samples(path).fold(Self::default(), |peak, ms| {
            let there = path.at(path.begin_ms + ms, 1);
            Self {
                speed: peak.speed.max(f64::from(there.velocity.norm())),
                acceleration: peak.acceleration.max(f64::from(there.acceleration.norm())),
                yaw_rate: peak.yaw_rate.max(f64::from(there.yaw_rate.abs())),
            }
        })
    }
}

/// Refuses a path that asks for more thrust or tilt than the vehicle is allowed.
///
/// # Errors
/// The limit's key, and where the path exceeds it.
pub(super) fn flyable(path: &Spline, config: &FlightConfig) -> Result<()> {
    let strongest = config.airframe.thrust_max_n() / config.airframe.mass_kg;
    let steepest = config.tilt_max_rad;
    for ms in samples(path) {
        let mut force = path.at(path.begin_ms + ms, 1).acceleration;
        force.z += config.airframe.gravity_m_s2;
        let (size, tilt) = (force.norm(), force.xy().norm().atan2(force.z));
        let t = f64::from(path.begin_ms + ms) * 1e-3;
        ensure!(
            size <= strongest,
            "`trajectory` needs {size:.1} m/s^2 of thrust at {t:.2} s, and the rotors give {strongest:.1} at most \
             (`thrust_to_weight`): fly it slower"
        );
        ensure!(
            tilt <= steepest,
            "`trajectory` needs a tilt of {tilt:.3} rad at {t:.2} s, and `tilt_max_rad` is {steepest}: fly it slower"
        );
    }
    Ok(())
}

/// The greatest horizontal acceleration (m/s²) of a trajectory that repeats; of others, which are refused where they ask
/// for too much or jump anyway, 0.
pub(super) fn sideways_m_s2(trajectory: &Trajectory) -> f64 {
    match *trajectory {
        Trajectory::Helix { amplitude_m: [a, b], rate_rad_s, .. } => {
            f64::from(a.abs().max(b.abs()) * rate_rad_s * rate_rad_s)
        }
        Trajectory::FigureEight { amplitude_m: [a, b], rate_rad_s, .. } => {
            // ω² √(a² sin²θ + 16 b² sin² 2θ), greatest over u = sin²θ.
            let [a2, b2] = [a, b].map(|amplitude| f64::from(amplitude) * f64::from(amplitude));
            let u = ((a2 + 64.0 * b2) / (128.0 * b2)).min(1.0);
            f64::from(rate_rad_s) * f64::from(rate_rad_s) * (a2 * u + 64.0 * b2 * u * (1.0 - u)).sqrt()
        }
        Trajectory::Hold { .. } | Trajectory::Step { .. } | Trajectory::Spline(_) => 0.0,
    }
}

#[cfg(test)]
#[path = "trajectory/tests.rs"]
mod tests;

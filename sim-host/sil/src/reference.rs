//! The trajectories again, in double precision: what errors are measured against. Independent of the firmware's.

use std::f64::consts::TAU;

use firmware::guidance::{DEGREE, Spline, Trajectory};

/// x, y, z (m) and yaw (rad) of a trajectory at flight time `t` (s).
pub fn at(trajectory: &Trajectory, t: f64) -> [f64; 4] {
    let wide = |v: [f32; 3]| v.map(f64::from);
    let still = |[x, y, z]: [f64; 3], yaw: f32| [x, y, z, f64::from(yaw)];
    match *trajectory {
        Trajectory::Hold { position_m, yaw_rad } => still(wide(position_m), yaw_rad),
        Trajectory::Step { from_m, to_m, at_s, yaw_rad } => {
            still(wide(if t < f64::from(at_s) { from_m } else { to_m }), yaw_rad)
        }
        Trajectory::Helix { amplitude_m: [a, b], rate_rad_s, base_m, climb_m_s, yaw_rad } => {
            let (sin, cos) = libm::sincos(f64::from(rate_rad_s) * t);
            let height = f64::from(base_m) + f64::from(climb_m_s) * t;
            [f64::from(a) * sin, f64::from(b) * cos, height, f64::from(yaw_rad)]
        }
        Trajectory::FigureEight { center_m, amplitude_m: [a, b], rate_rad_s, yaw_rad } => {
            let angle = f64::from(rate_rad_s) * t;
            let [x, y, z] = wide(center_m);
            still([x + f64::from(a) * libm::sin(angle), y + f64::from(b) * libm::sin(2.0 * angle), z], yaw_rad)
        }
        Trajectory::Spline(ref path) => spline(path, t),
    }
}

/// By de Boor's recursion: control points halfway between neighbours, level by level, down to one.
fn spline(path: &Spline, t: f64) -> [f64; 4] {
    let (begin, duration) = (f64::from(path.begin_ms) * 1e-3, f64::from(path.duration_ms) * 1e-3);
    let passed = if path.repeat && t > begin { (t - begin) % duration } else { (t - begin).clamp(0.0, duration) };
    let (segments, points) = (path.segments(), &path.control_points);
    let place = passed / duration * segments as f64;
    let segment = (place as usize).min(segments - 1);
    let u = place - segment as f64;
    let mut active: [[f64; 4]; DEGREE + 1] = std::array::from_fn(|i| {
        let index = segment + i;
        let mut point = points[index % points.len()].map(f64::from);
        point[3] += f64::from(path.turn_rad) * (index / points.len()) as f64;
        point
    });
    for level in 1..=DEGREE {
        for i in (level..=DEGREE).rev() {
            let part = (u + (DEGREE - i) as f64) / (DEGREE + 1 - level) as f64;
            active[i] = std::array::from_fn(|k| active[i - 1][k] + part * (active[i][k] - active[i - 1][k]));
        }
    }
    let [x, y, z, yaw] = active[DEGREE];
    [x, y, z, yaw - TAU * libm::round(yaw / TAU)]
}

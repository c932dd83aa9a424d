//! The trajectories again, in double precision: what errors are measured against. Independent of the firmware's.

use firmware::guidance::Trajectory;

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
    }
}

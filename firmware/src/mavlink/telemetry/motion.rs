//! Motion: attitude, local position, odometry, and what a pilot reads off. NED and FRD.

use glissade_dialect::{ATTITUDE_DATA, ATTITUDE_QUATERNION_DATA, LOCAL_POSITION_NED_DATA, ODOMETRY_DATA, VFR_HUD_DATA};
use nalgebra::{Matrix3, Vector3};

use super::view::{View, heading_deg};
use crate::control::euler::Euler;
use crate::frames::{flip_attitude, flip_vector};
use crate::math;

/// `MAV_FRAME_LOCAL_NED` and `MAV_FRAME_BODY_FRD`.
const LOCAL_NED: u8 = 1;
const BODY_FRD: u8 = 12;
/// `MAV_ESTIMATOR_TYPE_AUTOPILOT`.
const BY_AUTOPILOT: u8 = 8;

/// Euler angles of the attitude.
pub(super) fn attitude(view: &View) -> Option<ATTITUDE_DATA> {
    let nav = &view.input.nav;
    let angles = flip_vector(&Euler::from_quaternion(&nav.attitude).angles());
    let rates = flip_vector(&nav.rates);
    view.known().attitude.then(|| ATTITUDE_DATA {
        time_boot_ms: view.boot_ms(),
        roll: angles.x,
        pitch: angles.y,
        yaw: angles.z,
        rollspeed: rates.x,
        pitchspeed: rates.y,
        yawspeed: rates.z,
    })
}

/// The attitude as a quaternion: body to world.
pub(super) fn attitude_quaternion(view: &View) -> Option<ATTITUDE_QUATERNION_DATA> {
    let nav = &view.input.nav;
    let [q1, q2, q3, q4] = quaternion(&nav.attitude);
    let rates = flip_vector(&nav.rates);
    view.known().attitude.then(|| ATTITUDE_QUATERNION_DATA {
        time_boot_ms: view.boot_ms(),
        q1,
        q2,
        q3,
        q4,
        rollspeed: rates.x,
        pitchspeed: rates.y,
        yawspeed: rates.z,
        ..ATTITUDE_QUATERNION_DATA::DEFAULT
    })
}

/// w, x, y, z of an attitude of NWU/FLU, in NED/FRD, with w not negative.
pub(super) fn quaternion(attitude: &nalgebra::UnitQuaternion<f32>) -> [f32; 4] {
    let flipped = flip_attitude(attitude);
    let q = flipped.quaternion();
    let sign = if q.w < 0.0 { -1.0 } else { 1.0 };
    [q.w, q.i, q.j, q.k].map(|component| component * sign)
}

/// Position and velocity in the local frame.
pub(super) fn local_position(view: &View) -> Option<LOCAL_POSITION_NED_DATA> {
    let position = flip_vector(&view.input.nav.position);
    let velocity = view.velocity_ned();
    view.knows_position().then(|| LOCAL_POSITION_NED_DATA {
        time_boot_ms: view.boot_ms(),
        x: position.x,
        y: position.y,
        z: position.z,
        vx: velocity.x,
        vy: velocity.y,
        vz: velocity.z,
    })
}

/// What a pilot reads off. NaN is unknown, but for the heading, without which nothing is sent.
pub(super) fn vfr_hud(view: &View) -> Option<VFR_HUD_DATA> {
    let (nav, known, control) = (&view.input.nav, view.known(), &view.input.control);
    let v = &nav.velocity;
    let over_ground = |v: &Vector3<f32>| math::sqrt(v.x * v.x + v.y * v.y);
    let through_air = |[x, y]: [f32; 2]| math::sqrt((v - Vector3::new(x, y, 0.0)).norm_squared());
    let unless = |known: bool, value: f32| if known { value } else { f32::NAN };
    (known.attitude && known.heading).then(|| VFR_HUD_DATA {
        airspeed: view.observed_wind().filter(|_| known.velocity && known.climb).map_or(f32::NAN, through_air),
        groundspeed: unless(known.velocity, over_ground(v)),
        heading: heading_deg(nav.yaw()) as i16,
        throttle: (math::clamp(control.thrust_n / control.thrust_max_n, 0.0, 1.0) * 100.0 + 0.5) as u16,
        alt: view.height_msl_m().unwrap_or(f32::NAN),
        climb: unless(known.climb, v.z),
    })
}

/// Pose in the local frame and velocity in the body's, with their variances. Covariances are not reported: NaN. On
/// ideal state nothing is estimated, and the variances are unknown too.
pub(super) fn odometry(view: &View) -> Option<ODOMETRY_DATA> {
    let nav = &view.input.nav;
    let position = flip_vector(&nav.position);
    let velocity = flip_vector(&(nav.attitude.inverse() * nav.velocity));
    let rates = flip_vector(&nav.rates);
    let sigma = view.input.estimator.as_ref().map(|status| status.sigma);
    (view.known().attitude && view.knows_position()).then(|| ODOMETRY_DATA {
        time_usec: view.boot_us(),
        frame_id: LOCAL_NED,
        child_frame_id: BODY_FRD,
        x: position.x,
        y: position.y,
        z: position.z,
        q: quaternion(&nav.attitude),
        vx: velocity.x,
        vy: velocity.y,
        vz: velocity.z,
        rollspeed: rates.x,
        pitchspeed: rates.y,
        yawspeed: rates.z,
        pose_covariance: sigma.map_or([f32::NAN; 21], |sigma| pose_covariance(&sigma, nav.yaw())),
        velocity_covariance: sigma.map_or([f32::NAN; 21], |sigma| velocity_covariance(&sigma, view)),
        estimator_type: BY_AUTOPILOT,
        ..ODOMETRY_DATA::DEFAULT
    })
}

/// The upper triangle of a 6 × 6 matrix, row by row, of which only the diagonal is known.
fn diagonal(variances: [f32; 6]) -> [f32; 21] {
    let mut triangle = [f32::NAN; 21];
    let at = [0, 6, 11, 15, 18, 20];
    for (index, variance) in at.into_iter().zip(variances) {
        if let Some(entry) = triangle.get_mut(index)
            && variance.is_finite()
        {
            *entry = variance;
        }
    }
    triangle
}

/// Of x, y, z, roll, pitch, yaw. The filter's attitude error is about the world's axes: roll and pitch are those about
/// the axes turned by the heading, as for a level vehicle.
fn pose_covariance(sigma: &[f32; 9], yaw: f32) -> [f32; 21] {
    let [about_x, about_y, about_z, _, _, _, x, y, z] = sigma.map(|sigma| sigma * sigma);
    let (sin, cos) = math::sin_cos(yaw);
    let roll = cos * cos * about_x + sin * sin * about_y;
    let pitch = sin * sin * about_x + cos * cos * about_y;
    diagonal([x, y, z, roll, pitch, about_z])
}

/// Of the velocity along the body's axes, neglecting correlations; the rates' are unknown.
fn velocity_covariance(sigma: &[f32; 9], view: &View) -> [f32; 21] {
    let [_, _, _, vx, vy, vz, _, _, _] = sigma.map(|sigma| sigma * sigma);
    let to_body: Matrix3<f32> = view.input.nav.attitude.inverse().to_rotation_matrix().into_inner();
    let squares = to_body.component_mul(&to_body);
    let body = squares * Vector3::new(vx, vy, vz);
    diagonal([body.x, body.y, body.z, f32::NAN, f32::NAN, f32::NAN])
}

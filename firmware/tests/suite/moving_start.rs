//! A vehicle that is switched on while it is carried about, rocking and translating, and never at rest: the estimator
//! begins all the same, and satellites teach it what it could not see. Sensors by closed form from the motion.

use core::f64::consts::PI;

use firmware::autopilot::Autopilot;
use firmware::config::{FlightConfig, Start};
use firmware::estimator::EstimatorSettings;
use firmware::sensors::{BaroSample, Geodetic, GnssSample, ImuSample, MagSample, Measurements};
use firmware::signals::{SensorFrame, Tick};
use nalgebra::{Rotation3, UnitQuaternion, Vector3};

type V = Vector3<f64>;

const G: f64 = 9.81;
/// Earth's field in the world, µT.
const FIELD: V = V::new(21.5, -1.3, -43.2);
/// What the IMU is off by: twice what the filter is told of the gyroscope's is left after calibration.
const GYRO_BIAS: V = V::new(0.006, -0.009, 0.007);
const ACCEL_BIAS: V = V::new(0.02, -0.015, 0.02);
/// Age of a GNSS solution when it arrives, ticks.
const GNSS_AGE: Tick = 150;

/// A sum of sines a component, and its derivatives: amplitude, rate (rad/s), phase.
#[derive(Clone, Copy)]
struct Wave([(f64, f64, f64); 3]);

impl Wave {
    fn derivative(&self, order: i32, t: f64) -> V {
        V::from(self.0.map(|(amplitude, rate, phase)| {
            amplitude * rate.powi(order) * (rate * t + phase + f64::from(order) * 0.5 * PI).sin()
        }))
    }
}

/// How a vehicle is carried.
#[derive(Clone, Copy)]
struct Carried {
    /// m.
    place: Wave,
    /// Roll, pitch, and yaw beside a steady turn, rad.
    angles: Wave,
    /// rad/s.
    turn: f64,
}

impl Carried {
    fn attitude(&self, t: f64) -> Rotation3<f64> {
        let [roll, pitch, yaw] = self.angles.derivative(0, t).into();
        Rotation3::from_euler_angles(roll, pitch, yaw + self.turn * t)
    }

    /// Ω of Euler angles' rates.
    fn rates(&self, t: f64) -> V {
        let [roll, pitch, _] = self.angles.derivative(0, t).into();
        let [dr, dp, dy] = (self.angles.derivative(1, t) + V::z() * self.turn).into();
        V::new(
            dr - dy * pitch.sin(),
            dp * roll.cos() + dy * roll.sin() * pitch.cos(),
            -dp * roll.sin() + dy * roll.cos() * pitch.cos(),
        )
    }

    fn force(&self, t: f64) -> V {
        self.attitude(t).inverse() * (self.place.derivative(2, t) + V::z() * G)
    }
}

/// Noise, even and of unit deviation.
struct Noise(u64);

impl Noise {
    fn unit(&mut self) -> f64 {
        // Numerical Recipes' generator.
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        ((self.0 >> 11) as f64 / (1_u64 << 53) as f64 - 0.5) * 12.0_f64.sqrt()
    }

    fn vector(&mut self, sigma: f64) -> V {
        V::new(self.unit(), self.unit(), self.unit()) * sigma
    }
}

fn measure(carried: &Carried, tick: Tick, noise: &mut Noise) -> Measurements {
    let t = f64::from(tick) * 1e-3;
    let imu = ImuSample {
        at: tick,
        gyro: (carried.rates(t) + GYRO_BIAS + noise.vector(1e-3)).cast(),
        accel: (carried.force(t) + ACCEL_BIAS + noise.vector(0.02)).cast(),
    };
    let field = carried.attitude(t).inverse() * FIELD + noise.vector(0.3);
    let height = carried.place.derivative(0, t).z + 0.08 * noise.unit();
    // dp/dh = −ρ g about sea level, 12.01 Pa/m.
    let pressure = 101_325.0 - 12.013 * height;
    let slow = tick.is_multiple_of(20);
    Measurements {
        imu: Some(imu),
        mag: slow.then_some(MagSample { at: tick, field_ut: field.cast() }),
        baro: slow.then_some(BaroSample { at: tick, pressure_pa: pressure as f32 }),
        gnss: (tick.is_multiple_of(200) && tick >= GNSS_AGE).then(|| fix(carried, tick - GNSS_AGE, noise)),
        ..Measurements::default()
    }
}

fn fix(carried: &Carried, at: Tick, noise: &mut Noise) -> GnssSample {
    // Metres for 1e-7° on WGS-84 at 47° N, where the meridian's radius is 6,369,600 m and the parallel's 4,358,000 m.
    const NORTH_M: f64 = 0.011_117;
    const EAST_M: f64 = 0.007_606;
    let t = f64::from(at) * 1e-3;
    let place = carried.place.derivative(0, t) + noise.vector(0.1);
    GnssSample {
        at,
        has_fix: true,
        place: Geodetic {
            latitude_e7: 470_000_000 + (place.x / NORTH_M).round() as i32,
            longitude_e7: 80_000_000 + (-place.y / EAST_M).round() as i32,
            height_mm: 488_000 + (place.z * 1e3).round() as i32,
        },
        velocity: (carried.place.derivative(1, t) + noise.vector(0.05)).cast(),
        horizontal_accuracy_m: 1.2,
        vertical_accuracy_m: 2.0,
        speed_accuracy_m_s: 0.05,
        separation_mm: 0,
        utc_us: None,
    }
}

/// Greatest errors from 20 s to 60 s: tilt and heading (°), velocity (m/s).
fn worst(carried: &Carried, seed: u64) -> [f64; 3] {
    let config = FlightConfig {
        start: Start::OnGround,
        estimator: Some(EstimatorSettings::default()),
        join: None,
        ..FlightConfig::default()
    };
    let mut autopilot = Autopilot::new(&config).expect("valid");
    let mut noise = Noise(seed);
    let mut worst = [0.0_f64; 3];
    for tick in 0..60_000 {
        autopilot.tick(Some(&SensorFrame::Measured(measure(carried, tick, &mut noise))));
        let nav = autopilot.inner.nav();
        assert!(nav.is_valid(), "tick {tick}: {nav:?}");
        if tick >= 20_000 {
            let t = f64::from(tick) * 1e-3;
            let truth = UnitQuaternion::from_rotation_matrix(&carried.attitude(t));
            let error = (truth * nav.attitude.cast::<f64>().inverse()).scaled_axis();
            let velocity = carried.place.derivative(1, t) - nav.velocity.cast();
            let now = [error.x.hypot(error.y).to_degrees(), error.z.abs().to_degrees(), velocity.norm()];
            worst = core::array::from_fn(|i| worst[i].max(now[i]));
        }
    }
    worst
}

/// By hand, on a walk; on a boat; turning on a table.
fn motions() -> [(&'static str, Carried); 4] {
    let still = (0.0, 1.0, 0.0);
    [
        (
            "by hand",
            Carried {
                place: Wave([(2.0, 1.1, 0.3), (1.5, 0.9, 1.0), (0.3, 2.3, 0.0)]),
                angles: Wave([(0.25, 2.1, 0.0), (0.2, 1.7, 1.0), (0.8, 0.4, 0.5)]),
                turn: 0.0,
            },
        ),
        (
            "on a boat",
            Carried {
                place: Wave([(4.0, 0.5, 0.0), (3.0, 0.45, 0.7), (0.8, 0.8, 0.2)]),
                angles: Wave([(0.15, 0.8, 0.4), (0.1, 0.7, 0.0), (0.05, 0.3, 0.0)]),
                turn: 0.05,
            },
        ),
        (
            // Seldom above 0.05 rad/s: now and then it looks as if it stood, at up to 2 m/s.
            "on a ship",
            Carried {
                place: Wave([(5.0, 0.4, 0.0), (2.0, 0.3, 0.7), (1.0, 0.5, 0.2)]),
                angles: Wave([(0.08, 0.5, 0.4), (0.05, 0.45, 0.0), (0.05, 0.2, 0.0)]),
                turn: 0.0,
            },
        ),
        ("turning", Carried { place: Wave([still; 3]), angles: Wave([(0.1, 1.3, 0.0), still, still]), turn: 0.6 }),
    ]
}

#[test]
fn a_vehicle_that_is_never_at_rest_knows_its_motion_within_20_s() {
    for (name, carried) in motions() {
        for seed in 1..=5 {
            let [tilt, heading, velocity] = worst(&carried, seed);
            println!("{name} {seed}: {tilt:.2} {heading:.2} {velocity:.3}");
            assert!(tilt < 2.0 && velocity < 0.5, "{name} {seed}: tilt {tilt}°, velocity {velocity} m/s");
            // The heading by a field that is right: as good as the tilt through its slope of 2.
            assert!(heading < 4.0, "{name} {seed}: heading {heading}°");
        }
    }
}

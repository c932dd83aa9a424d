//! `estimate.csv`: what a vehicle on sensors believed, beside `truth.csv`; a row each 20 ms.

use std::fs::File;
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};

use anyhow::Result;
use firmware::commander::Mode;
use firmware::estimator::update::Verdict;
use firmware::signals::{NavHealth, NavState};
use nalgebra::Vector3;

use super::out::{cannot_write, create_file};
use crate::assess::consistency::{SOURCES, kind};
use crate::plant::Motion;
use crate::record::Navigation;

/// Ticks from one row to the next.
pub const EVERY: u32 = 20;

/// The columns before those of the readings. World frame NWU, body frame FLU; σ of the attitude are about the world's
/// axes.
pub const HEADER: &str = "t_s,x_m,y_m,z_m,vx_m_s,vy_m_s,vz_m_s,qw,qx,qy,qz,p_rad_s,q_rad_s,r_rad_s,\
    sigma_roll_rad,sigma_pitch_rad,sigma_yaw_rad,sigma_vx_m_s,sigma_vy_m_s,sigma_vz_m_s,sigma_x_m,sigma_y_m,sigma_z_m,\
    gyro_bias_x_rad_s,gyro_bias_y_rad_s,gyro_bias_z_rad_s,accel_bias_x_m_s2,accel_bias_y_m_s2,accel_bias_z_m_s2,\
    wind_x_m_s,wind_y_m_s,attitude_ok,heading_ok,velocity_ok,position_ok,height_ok,mode,armed,landed";

/// What a vehicle believes at a time, and what is true then.
#[derive(Clone, Debug, PartialEq)]
pub struct Belief {
    /// When, s.
    pub t: f64,
    /// What is true.
    pub truth: Motion,
    /// What is believed.
    pub nav: NavState,
    /// Standard deviations of attitude (rad), velocity (m/s) and position (m), as believed.
    pub sigma: [f32; 9],
    /// Believed bias of the gyroscope, rad/s.
    pub gyro_bias: Vector3<f32>,
    /// Believed bias of the accelerometer, m/s².
    pub accel_bias: Vector3<f32>,
    /// Believed wind, x and y, m/s.
    pub wind: [f32; 2],
    /// What of it is trusted.
    pub health: NavHealth,
    /// What the vehicle is doing.
    pub mode: Mode,
    /// Whether the rotors may turn.
    pub armed: bool,
    /// Whether it believes to be on the ground.
    pub landed: bool,
    /// The newest reading of each of [`SOURCES`] since the belief before.
    pub readings: [Option<Verdict>; SOURCES.len()],
}

/// Makes beliefs of what the flight tells each tick.
#[derive(Clone, Debug, Default)]
pub struct Sampler {
    ticks: u32,
    readings: [Option<Verdict>; SOURCES.len()],
}

impl Sampler {
    /// Takes a tick; the first gives a belief, and each [`EVERY`]th after it.
    pub fn take(&mut self, navigation: &Navigation) -> Option<Belief> {
        for reading in navigation.filtered.into_iter().flat_map(|output| &output.consistency) {
            self.readings[reading.source as usize] = Some(reading.verdict);
        }
        let is_due = self.ticks.is_multiple_of(EVERY);
        self.ticks += 1;
        is_due.then(|| Belief {
            t: navigation.t,
            truth: navigation.truth,
            nav: *navigation.nav,
            sigma: navigation.filter.sigma,
            gyro_bias: navigation.gyro_bias,
            accel_bias: navigation.accel_bias,
            wind: navigation.filter.wind,
            health: navigation.health,
            mode: navigation.commander.mode,
            armed: navigation.commander.armed,
            landed: navigation.commander.landed,
            readings: core::mem::take(&mut self.readings),
        })
    }
}

/// Writes beliefs as CSV. An I/O error does not stop the flight: [`finish`](Self::finish) returns the first.
#[derive(Debug)]
pub struct EstimateWriter<W: Write> {
    out: W,
    name: PathBuf,
    line: String,
    outcome: io::Result<()>,
}

impl EstimateWriter<BufWriter<File>> {
    /// Creates (or overwrites) the file at `path`.
    ///
    /// # Errors
    /// When the file cannot be created; the message names it.
    pub fn create(path: &Path) -> Result<Self> {
        let file = create_file(path)?;
        Ok(Self::new(BufWriter::new(file), path.to_owned()))
    }
}

impl<W: Write> EstimateWriter<W> {
    /// Writes to `out`, which complaints call `name`.
    pub fn new(mut out: W, name: PathBuf) -> Self {
        let readings: Vec<_> =
            SOURCES.iter().map(|source| format!("nis_{}", kind(*source).0.replace('-', "_"))).collect();
        let outcome = writeln!(out, "{HEADER},{}", readings.join(","));
        Self { out, name, line: String::new(), outcome }
    }

    /// Appends a row.
    pub fn write(&mut self, belief: &Belief) {
        if self.outcome.is_err() {
            return;
        }
        self.line.clear();
        push_row(&mut self.line, belief);
        self.outcome = self.out.write_all(self.line.as_bytes());
    }

    /// Writes what is left.
    ///
    /// # Errors
    /// The first I/O error of the whole flight; the message names the file.
    pub fn finish(mut self) -> Result<()> {
        let flushed = self.out.flush();
        self.outcome.and(flushed).map_err(|error| cannot_write(&self.name, error))
    }
}

/// A row with its end of line. Numbers are the shortest that read back to the same f32, time to the same f64.
fn push_row(line: &mut String, belief: &Belief) {
    use std::fmt::Write as _;
    let q = belief.nav.attitude.quaternion();
    let (nav, health) = (&belief.nav, &belief.health);
    let motion = [&nav.position, &nav.velocity].into_iter().flatten();
    let attitude = [&q.w, &q.i, &q.j, &q.k];
    let biases = [&belief.gyro_bias, &belief.accel_bias].into_iter().flatten();
    let numbers = motion.chain(attitude).chain(nav.rates.iter()).chain(&belief.sigma).chain(biases).chain(&belief.wind);
    // Writing to a string cannot fail.
    let _ = write!(line, "{}", belief.t);
    for number in numbers {
        let _ = write!(line, ",{number}");
    }
    for flag in [health.attitude, health.heading, health.velocity, health.position, health.height] {
        let _ = write!(line, ",{}", u8::from(flag));
    }
    let _ = write!(line, ",{},{},{}", belief.mode.name(), u8::from(belief.armed), u8::from(belief.landed));
    for reading in &belief.readings {
        line.push(',');
        if let Some(verdict) = reading {
            let _ = write!(line, "{}", verdict.nis);
        }
    }
    line.push('\n');
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;

    /// Of a vehicle at the origin that believes to be at (1, 2, 3).
    pub(in crate::report) fn belief(t: f64) -> Belief {
        let mut readings = [None; SOURCES.len()];
        readings[1] = Some(Verdict { nis: 0.5, accepted: true });
        Belief {
            t,
            truth: Motion::at_rest(Vector3::zeros()),
            nav: NavState { position: Vector3::new(1.0, 2.0, 3.0), ..NavState::at_rest() },
            sigma: [0.1; 9],
            gyro_bias: Vector3::new(0.01, 0.02, 0.03),
            accel_bias: Vector3::zeros(),
            wind: [-2.0, 1.5],
            health: NavHealth { position: false, ..NavHealth::ALL },
            mode: Mode::TakeOff,
            armed: true,
            landed: false,
            readings,
        }
    }

    fn written() -> String {
        let mut text = Vec::new();
        let mut writer = EstimateWriter::new(&mut text, "estimate.csv".into());
        writer.write(&belief(0.02));
        writer.finish().expect("a vector takes every byte");
        String::from_utf8(text).expect("CSV is ASCII")
    }

    #[test]
    fn columns_stand_under_their_names() {
        let text = written();
        let [header, row] = text.lines().collect::<Vec<_>>()[..] else { panic!("{text}") };
        let (header, row): (Vec<_>, Vec<_>) = (header.split(',').collect(), row.split(',').collect());
        assert_eq!(header.len(), row.len());
        let unique: std::collections::BTreeSet<_> = header.iter().collect();
        assert_eq!(unique.len(), header.len());
        for (column, expected) in [
            ("t_s", "0.02"),
            ("y_m", "2"),
            ("qw", "1"),
            ("r_rad_s", "0"),
            ("sigma_z_m", "0.1"),
            ("gyro_bias_z_rad_s", "0.03"),
            ("wind_y_m_s", "1.5"),
            ("attitude_ok", "1"),
            ("position_ok", "0"),
            ("mode", "take-off"),
            ("armed", "1"),
            ("landed", "0"),
            ("nis_heading", ""),
            ("nis_baro", "0.5"),
            ("nis_rest", ""),
        ] {
            let at = header.iter().position(|name| *name == column).expect(column);
            assert_eq!(row[at], expected, "{column}");
        }
    }

    #[test]
    fn sources_stand_at_their_numbers() {
        for (number, source) in SOURCES.iter().enumerate() {
            assert_eq!(*source as usize, number);
        }
    }

    #[test]
    fn a_full_disk_is_reported_at_the_end() {
        struct Full;
        impl Write for Full {
            fn write(&mut self, _: &[u8]) -> io::Result<usize> {
                Err(io::ErrorKind::StorageFull.into())
            }
            fn flush(&mut self) -> io::Result<()> {
                Ok(())
            }
        }
        let mut writer = EstimateWriter::new(Full, "estimate.csv".into());
        writer.write(&belief(0.0));
        let error = format!("{:#}", writer.finish().expect_err("the disk was full"));
        assert!(error.contains("estimate.csv") && error.contains("free some space"), "{error}");
    }
}

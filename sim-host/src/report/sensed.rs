//! What a flight on sensors leaves besides its truth: beliefs, how far they were off, and how it ended.

use std::fs::File;
use std::io::BufWriter;

use anyhow::Result;
use nalgebra::UnitQuaternion;
use serde::Serialize;

use super::estimate::{Belief, EstimateWriter, Sampler};
use crate::outcome::Contact;
use crate::record::{Navigation, Recorder, Row};
use crate::statistics::MeanSquare;

/// Root mean squares of what the vehicle's beliefs were off by while it was armed; null if it never was.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Knowledge {
    /// Roll and pitch together, rad.
    pub tilt_rms_rad: Option<f64>,
    /// Heading, rad.
    pub heading_rms_rad: Option<f64>,
    /// Position, m.
    pub position_rms_m: Option<f64>,
    /// Velocity, m/s.
    pub velocity_rms_m_s: Option<f64>,
}

/// What the summary of a flight on sensors tells besides that of any flight.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Sensed {
    /// How far what it believed was off.
    pub estimate: Knowledge,
    /// The first touchdown after it has been half a metre up; null without one.
    pub touchdown: Option<Contact>,
    /// When it was disarmed for the first time after having been armed, s; null if it was not.
    pub disarmed_s: Option<f64>,
}

/// Takes a flight on sensors.
#[derive(Debug, Default)]
pub struct SensedRecorder {
    sampler: Sampler,
    /// Where beliefs are written to.
    file: Option<EstimateWriter<BufWriter<File>>>,
    /// Beliefs for the figures, if they are wanted.
    kept: Option<Vec<Belief>>,
    /// Tilt, heading, position, velocity.
    known: [MeanSquare; 4],
    armed: bool,
    disarmed_s: Option<f64>,
}

impl SensedRecorder {
    /// Neither writes nor keeps beliefs.
    pub fn new() -> Self {
        Self::default()
    }

    /// Writes beliefs to a file, and keeps them if figures are to be drawn.
    #[must_use]
    pub fn writing(mut self, file: EstimateWriter<BufWriter<File>>, keep: bool) -> Self {
        self.file = Some(file);
        self.kept = keep.then(Vec::new);
        self
    }

    /// What came of a flight that touched down so, and the beliefs that were kept.
    ///
    /// # Errors
    /// When estimate.csv could not be written; the message names it.
    pub fn finish(self, touchdown: Option<Contact>) -> Result<(Sensed, Vec<Belief>)> {
        if let Some(file) = self.file {
            file.finish()?;
        }
        let [tilt_rms_rad, heading_rms_rad, position_rms_m, velocity_rms_m_s] = self.known.map(MeanSquare::root);
        let sensed = Sensed {
            estimate: Knowledge { tilt_rms_rad, heading_rms_rad, position_rms_m, velocity_rms_m_s },
            touchdown,
            disarmed_s: self.disarmed_s,
        };
        Ok((sensed, self.kept.unwrap_or_default()))
    }

    fn compare(&mut self, navigation: &Navigation) {
        let Navigation { truth, nav, .. } = navigation;
        let is = UnitQuaternion::new_normalize(truth.attitude);
        let attitude = (is * nav.attitude.cast::<f64>().inverse()).scaled_axis();
        let [tilt, heading, position, velocity] = &mut self.known;
        tilt.take(libm::hypot(attitude.x, attitude.y));
        heading.take(attitude.z);
        position.take((truth.position - nav.position.cast()).norm());
        velocity.take((truth.velocity - nav.velocity.cast()).norm());
    }
}

impl Recorder for SensedRecorder {
    fn record(&mut self, _row: &Row) {}

    fn navigate(&mut self, navigation: &Navigation) {
        let armed = navigation.commander.armed;
        if armed {
            self.compare(navigation);
        } else if self.armed {
            self.disarmed_s.get_or_insert(navigation.t);
        }
        self.armed = armed;
        if let Some(belief) = self.sampler.take(navigation) {
            if let Some(file) = &mut self.file {
                file.write(&belief);
            }
            if let Some(kept) = &mut self.kept {
                kept.push(belief);
            }
        }
    }
}

//! Consistency of a filter: its innovations and estimation errors, normalised by its own covariances (Bar-Shalom, Li
//! and Kirubarajan 2001, §5.4).

use std::collections::BTreeMap;

use firmware::estimator::Source;
use nalgebra::{SMatrix, SVector, Vector3};

use crate::record::Navigation;

/// Number of error states evaluated: attitude, velocity and position.
pub const STATES: usize = 9;
/// Time between two samples of the error, s: long, because successive errors are correlated.
const LOOK_EVERY_S: f64 = 2.0;

/// The normalised innovations of one kind of reading.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Innovations {
    /// Degrees of freedom of one.
    pub degrees: u32,
    /// Readings.
    pub count: u64,
    /// Sum of their normalised innovations squared.
    pub sum: f64,
    /// How many were within the 95 % quantile of χ².
    pub within: u64,
    /// How many were refused.
    pub refused: u64,
    /// Of the first reading after each look.
    pub looks: Vec<f64>,
    /// Looks until now that have been given a reading, or passed without one.
    seen: usize,
}

/// Consistency of a flight.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Consistency {
    /// By kind of reading.
    pub innovations: BTreeMap<&'static str, Innovations>,
    /// Normalised estimation errors squared, one every two seconds of what is judged: of all nine states, and of
    /// attitude, velocity and position alone.
    pub nees: Vec<[f64; 4]>,
    next_look_s: f64,
    looks: usize,
}

/// Every kind of reading, in the order of its number.
pub const SOURCES: [Source; 9] = [
    Source::Heading,
    Source::Baro,
    Source::GnssPosition,
    Source::GnssHeight,
    Source::GnssVelocity,
    Source::PosePosition,
    Source::PoseAttitude,
    Source::Drag,
    Source::Rest,
];

/// Name and degrees of freedom of a kind of reading.
pub fn kind(source: Source) -> (&'static str, u32) {
    match source {
        Source::Heading => ("heading", 1),
        Source::Baro => ("baro", 1),
        Source::GnssPosition => ("gnss-position", 2),
        Source::GnssHeight => ("gnss-height", 1),
        Source::GnssVelocity => ("gnss-velocity", 3),
        Source::PosePosition => ("pose-position", 3),
        Source::PoseAttitude => ("pose-attitude", 3),
        Source::Drag => ("drag", 2),
        Source::Rest => ("rest", 3),
    }
}

/// 95 % quantile of χ² with one to three degrees of freedom.
pub fn quantile(degrees: u32) -> f64 {
    match degrees {
        1 => 3.841,
        2 => 5.991,
        _ => 7.815,
    }
}

impl Consistency {
    /// Adds a tick's readings, and every two seconds the error; `attitude` is the attitude error in the world, rad.
    pub fn take(&mut self, navigation: &Navigation, attitude: &Vector3<f64>) {
        // The covariance is that of the filter's last job; what it has found is in the motion when it comes into effect.
        if navigation.t >= self.next_look_s && navigation.filtered.is_some() {
            self.next_look_s = navigation.t + LOOK_EVERY_S;
            self.looks += 1;
            // A singular covariance counts as inconsistent.
            self.nees.push(nees(navigation, attitude).unwrap_or([f64::INFINITY; 4]));
        }
        for reading in navigation.filtered.into_iter().flat_map(|output| &output.consistency) {
            let (name, degrees) = kind(reading.source);
            let all = self.innovations.entry(name).or_default();
            let nis = f64::from(reading.verdict.nis);
            all.degrees = degrees;
            all.count += 1;
            all.refused += u64::from(!reading.verdict.accepted);
            all.within += u64::from(nis <= quantile(degrees));
            if reading.verdict.accepted {
                all.sum += nis;
            }
            if all.seen < self.looks {
                all.seen = self.looks;
                all.looks.push(nis);
            }
        }
    }
}

/// eᵀ P⁻¹ e of all, and of attitude, velocity and position.
fn nees(navigation: &Navigation, attitude: &Vector3<f64>) -> Option<[f64; 4]> {
    let (truth, nav) = (navigation.truth, navigation.nav);
    let velocity = truth.velocity - nav.velocity.cast();
    let position = truth.position - nav.position.cast();
    let error =
        SVector::<f64, STATES>::from_iterator(attitude.iter().chain(velocity.iter()).chain(position.iter()).copied());
    let covariance = SMatrix::<f64, STATES, STATES>::from_fn(|i, j| f64::from(navigation.covariance.get(i, j)));
    let block = |first: usize| {
        let (e, p) = (error.fixed_rows::<3>(first), covariance.fixed_view::<3, 3>(first, first));
        Some(e.dot(&p.cholesky()?.solve(&e)))
    };
    Some([error.dot(&covariance.cholesky()?.solve(&error)), block(0)?, block(3)?, block(6)?])
}

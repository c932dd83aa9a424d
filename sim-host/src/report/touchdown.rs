//! The first touchdown of a flight: when, and how fast.

use nalgebra::{Quaternion, UnitQuaternion, Vector3};
use serde::Serialize;

use crate::plant::ground::Ground;
use crate::record::{Recorder, Row};

/// A vehicle that has been this high above the ground (m) has taken off.
const AIRBORNE_M: f64 = 0.5;

/// A touchdown.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Contact {
    /// The first row with a foot on the ground, s.
    pub t_s: f64,
    /// Downwards, in the last row in the air, m/s: in the next, the ground has begun to brake it.
    pub descent_m_s: f64,
    /// Across the ground, in the last row in the air, m/s.
    pub drift_m_s: f64,
}

/// Looks for the first touchdown after the vehicle has been half a metre above the ground.
#[derive(Clone, Debug)]
pub struct Touchdown {
    ground: Ground,
    airborne: bool,
    /// The row before, if no foot was on the ground in it.
    velocity: Option<[f64; 3]>,
    first: Option<Contact>,
}

impl Touchdown {
    /// On a ground.
    pub fn new(ground: Ground) -> Self {
        Self { ground, airborne: false, velocity: None, first: None }
    }

    /// The touchdown, if there was one.
    pub fn first(&self) -> Option<Contact> {
        self.first
    }

    /// Whether a foot touches the ground.
    fn touches(&self, row: &Row) -> bool {
        let [w, x, y, z] = row.attitude;
        let attitude = UnitQuaternion::new_normalize(Quaternion::new(w, x, y, z));
        self.ground.clearances(&Vector3::from(row.position), &attitude).iter().any(|clearance| *clearance <= 0.0)
    }
}

impl Recorder for Touchdown {
    fn record(&mut self, row: &Row) {
        if self.first.is_some() {
            return;
        }
        self.airborne |= self.ground.height_above(&row.position.into()) > AIRBORNE_M;
        if !self.touches(row) {
            self.velocity = Some(row.velocity);
        } else if self.airborne {
            // A start on the ground is not airborne, so that there is a row before.
            let [x, y, z] = self.velocity.unwrap_or(row.velocity);
            self.first = Some(Contact { t_s: row.t, descent_m_s: -z, drift_m_s: (x * x + y * y).sqrt() });
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ground() -> Ground {
        Ground::for_vehicle(1.0, 2.0, 9.81, 0.04)
    }

    fn row(t: f64, height: f64, velocity: [f64; 3]) -> Row {
        Row { t, position: [0.0, 0.0, 1.0 + height], velocity, attitude: [1.0, 0.0, 0.0, 0.0], ..Row::default() }
    }

    /// What is seen of heights above the ground, a row each.
    fn seen(heights: &[f64]) -> Option<Contact> {
        let mut touchdown = Touchdown::new(ground());
        for (k, height) in heights.iter().enumerate() {
            let k = k as f64;
            touchdown.record(&row(k, *height, [3.0, 4.0, -k]));
        }
        touchdown.first()
    }

    #[test]
    fn the_first_contact_after_a_flight_counts_with_the_speed_before_it() {
        let contact = Contact { t_s: 3.0, descent_m_s: 2.0, drift_m_s: 5.0 };
        assert_eq!(seen(&[-0.001, 0.6, 0.1, 0.0, 0.2, 0.7, -0.1]), Some(contact));
    }

    #[test]
    fn a_hop_and_a_flight_that_does_not_end_are_no_touchdowns() {
        assert_eq!(seen(&[-0.001, 0.4, 0.1, 0.0, -0.001]), None);
        assert_eq!(seen(&[-0.001, 0.4, 0.6, 0.9]), None);
    }

    #[test]
    fn a_crooked_vehicle_lands_on_its_lowest_foot() {
        let mut touchdown = Touchdown::new(ground());
        touchdown.record(&row(0.0, 0.8, [0.0; 3]));
        // Rolled by 30°: the left feet are 0.15/√2/2 = 0.053 m above the centre, the right ones as far below it.
        let attitude = [0.966, 0.259, 0.0, 0.0];
        touchdown.record(&Row { attitude, ..row(1.0, 0.054, [0.0, 0.0, -1.5]) });
        assert_eq!(touchdown.first(), None);
        touchdown.record(&Row { attitude, ..row(2.0, 0.052, [0.0, 0.0, -1.4]) });
        assert_eq!(touchdown.first(), Some(Contact { t_s: 2.0, descent_m_s: 1.5, drift_m_s: 0.0 }));
    }
}

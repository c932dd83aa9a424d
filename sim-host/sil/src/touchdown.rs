//! A flight's contact with the ground: the first and the last touchdown, and whether the vehicle was damaged.

use nalgebra::Quaternion;

use crate::outcome::{Contact, Crash, End, Outcome};
use crate::plant::ground::Ground;
use crate::record::{Recorder, Row};

/// A vehicle that has been this high above the ground (m) has taken off.
const AIRBORNE_M: f64 = 0.5;
/// The fastest touchdown that a vehicle survives, m/s: a fall from 0.8 m. The model of the ground is tested up to 3 m/s;
/// landings sink at 0.4 m/s, and descents without a height at 1 to 3 m/s.
pub const HARDEST_M_S: f64 = 4.0;
/// A touchdown so soon after another is a bounce of it, s.
const BOUNCE_S: f64 = 3.0;
/// Cosine of the greatest tilt on the ground, 60°: beyond it, rotors touch before feet do.
pub const UPRIGHT: f64 = 0.5;

/// Looks for touchdowns after the vehicle has been half a metre above the ground, and for the first contact that it does
/// not survive: faster than 4 m/s downwards, or tilted by more than 60°.
#[derive(Clone, Debug)]
pub struct Touchdown {
    ground: Ground,
    /// Whether it has been half a metre up since the last touchdown.
    airborne: bool,
    /// Where the flight began.
    start: Option<[f64; 3]>,
    /// The row before, if no foot was on the ground in it.
    velocity: Option<[f64; 3]>,
    first: Option<Contact>,
    last: Option<Contact>,
    crash: Option<Crash>,
}

impl Touchdown {
    /// On a ground.
    pub fn new(ground: Ground) -> Self {
        Self { ground, airborne: false, start: None, velocity: None, first: None, last: None, crash: None }
    }

    /// The first touchdown, if there was one.
    pub fn first(&self) -> Option<Contact> {
        self.first
    }

    /// The last touchdown, if there was one: the first one, unless it has flown again. Bounces are one touchdown, as hard as
    /// the hardest.
    pub fn last(&self) -> Option<Contact> {
        self.last
    }

    /// The contact that it did not survive, if there was one.
    pub fn crash(&self) -> Option<Crash> {
        self.crash
    }

    /// Whether it has been half a metre above the ground.
    pub fn has_flown(&self) -> bool {
        self.airborne || self.first.is_some()
    }

    /// Whether a foot touches the ground.
    fn touches(&self, row: &Row) -> bool {
        let [w, x, y, z] = row.attitude;
        self.ground.touches(&row.position.into(), &Quaternion::new(w, x, y, z))
    }

    /// A foot is on the ground; `before` is the velocity in the row before, if none was.
    fn touch(&mut self, row: &Row, before: Option<[f64; 3]>) {
        let start = self.start.unwrap_or(row.position);
        if let Some([x, y, z]) = before.filter(|_| self.airborne) {
            let away = libm::hypot(row.position[0] - start[0], row.position[1] - start[1]);
            let contact = Contact {
                t_s: row.t,
                descent_m_s: -z,
                drift_m_s: libm::hypot(x, y),
                position_m: row.position,
                from_start_m: away,
            };
            self.first.get_or_insert(contact);
            (self.last, self.airborne) = (Some(contact.after(self.last.as_ref())), false);
        }
        if self.crash.is_none() {
            self.crash = crash(row, before);
        }
    }
}

impl Contact {
    /// The same, if it is a bounce of the one before: where it came to, and as hard as the harder of both.
    fn after(self, before: Option<&Self>) -> Self {
        match before {
            Some(before) if self.t_s - before.t_s < BOUNCE_S => self.and(before),
            _ => self,
        }
    }

    /// Two touches of one landing: where the vehicle came to, and as hard as the harder.
    #[must_use]
    pub fn and(self, before: &Self) -> Self {
        if before.descent_m_s > self.descent_m_s {
            Self { position_m: self.position_m, from_start_m: self.from_start_m, ..*before }
        } else {
            self
        }
    }
}

/// What a contact does that the vehicle does not survive.
fn crash(row: &Row, before: Option<[f64; 3]>) -> Option<Crash> {
    let [_, x, y, _] = row.attitude;
    let upright = 1.0 - 2.0 * (x * x + y * y);
    let descent_m_s = before.map_or(0.0, |[_, _, z]| -z);
    let survives = descent_m_s < HARDEST_M_S && upright > UPRIGHT;
    (!survives).then(|| Crash { t_s: row.t, descent_m_s, tilt_rad: libm::acos(upright.clamp(-1.0, 1.0)) })
}

impl Outcome {
    /// The same with what contact with the ground has shown, where there is ground.
    #[must_use]
    pub fn after(self, touchdown: Option<&Touchdown>) -> Self {
        let Some(seen) = touchdown else { return self };
        let end = match seen.crash() {
            Some(crash) => End::Crashed(crash),
            None if self.survived() && !seen.has_flown() => End::NeverFlew,
            None => self.end,
        };
        Self { end, touchdown: seen.first(), landing: seen.last(), ..self }
    }
}

impl Recorder for Touchdown {
    fn record(&mut self, row: &Row) {
        self.start.get_or_insert(row.position);
        self.airborne |= self.ground.height_above(&row.position.into()) > AIRBORNE_M;
        if self.touches(row) {
            let before = self.velocity.take();
            self.touch(row, before);
        } else {
            self.velocity = Some(row.velocity);
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
        let contact =
            Contact { t_s: 3.0, descent_m_s: 2.0, drift_m_s: 5.0, position_m: [0.0, 0.0, 1.0], from_start_m: 0.0 };
        assert_eq!(seen(&[-0.001, 0.6, 0.1, 0.0, 0.2, 0.7, -0.1]), Some(contact));
    }

    #[test]
    fn the_last_contact_is_that_of_the_last_flight() {
        let mut touchdown = Touchdown::new(ground());
        // Two flights of half a metre and more, and a hop.
        for (k, height) in [0.6, 0.0, -0.001, 0.7, -0.001, 0.4, 0.0].into_iter().enumerate() {
            touchdown.record(&row(k as f64, height, [0.0, 0.0, -1.0]));
        }
        let times = [touchdown.first(), touchdown.last()].map(|contact| contact.map(|contact| contact.t_s));
        assert_eq!((times, touchdown.has_flown()), ([Some(1.0), Some(4.0)], true));
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
        let contact = touchdown.first().expect("a foot is down");
        assert_eq!((contact.t_s, contact.descent_m_s, contact.drift_m_s), (2.0, 1.5, 0.0));
        assert_eq!(touchdown.crash(), None);
    }

    fn falls(speed: f64, attitude: [f64; 4]) -> Option<Crash> {
        let mut touchdown = Touchdown::new(ground());
        touchdown.record(&row(0.0, 0.8, [0.0; 3]));
        touchdown.record(&row(1.0, 0.16, [0.0, 0.0, -speed]));
        touchdown.record(&Row { attitude, ..row(2.0, -0.01, [0.0, 0.0, -0.5 * speed]) });
        assert!(touchdown.has_flown());
        touchdown.crash()
    }

    #[test]
    fn a_hard_contact_and_one_upside_down_are_crashes() {
        let level = [1.0, 0.0, 0.0, 0.0];
        assert_eq!(falls(3.0, level), None);
        assert_eq!(falls(13.0, level), Some(Crash { t_s: 2.0, descent_m_s: 13.0, tilt_rad: 0.0 }));
        let on_its_back = falls(0.5, [0.0, 1.0, 0.0, 0.0]).expect("its rotors touch first");
        assert!((on_its_back.tilt_rad - core::f64::consts::PI).abs() < 1e-9);
    }

    #[test]
    fn a_bounce_is_the_same_touchdown_and_as_hard_as_the_harder() {
        let contact = |t_s: f64, descent_m_s: f64, x: f64| Contact {
            t_s,
            descent_m_s,
            drift_m_s: 0.0,
            position_m: [x, 0.0, 0.0],
            from_start_m: x,
        };
        let hard = contact(33.5, 3.5, 1.0);
        let bounce = contact(34.3, 1.1, 2.0);
        assert_eq!(bounce.after(Some(&hard)), Contact { position_m: [2.0, 0.0, 0.0], from_start_m: 2.0, ..hard });
        assert_eq!(hard.after(Some(&contact(33.0, 1.0, 0.0))), hard, "the second was harder");
        let later = contact(60.0, 0.4, 5.0);
        assert_eq!(later.after(Some(&hard)), later, "another flight's");
        assert_eq!(hard.after(None), hard);
    }
}

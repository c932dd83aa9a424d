//! Whether a flight did what its pilot asked for. Decided by the truth: where the vehicle was, not where it took itself
//! to be.

use serde::Serialize;

use super::timeline::{Course, EventKind, Leg, order_text};
use crate::pilot::{Command, Order};
use crate::sil::{End, Outcome};

/// How near a place has to be reached on satellites, m: half a metre by the pilot's own look, and what a receiver in the
/// open wanders by.
pub const REACHED_BY_GNSS_M: f64 = 3.0;
/// The same where the position is measured directly, m.
pub const REACHED_M: f64 = 1.0;

/// The verdict on a mission.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Mission {
    /// Whether all commands were given and carried out.
    pub completed: bool,
    /// The first reason why not, and how the flight ended.
    pub reason: Option<String>,
}

impl Mission {
    /// The same with what lies behind the reason, where that is known.
    #[must_use]
    pub fn because(mut self, cause: Option<String>) -> Self {
        if let (Some(reason), Some(cause)) = (&mut self.reason, cause) {
            reason.push_str("; ");
            reason.push_str(&cause);
        }
        self
    }
}

/// Judges a flight by its pilot's script, with places reached within `radius_m`.
pub fn judge(course: &Course, outcome: &Outcome, script: &[Command], radius_m: f64) -> Mission {
    let reason = Judge { course, outcome, script, radius_m }.reason();
    Mission { completed: reason.is_none(), reason }
}

struct Judge<'a> {
    course: &'a Course,
    outcome: &'a Outcome,
    script: &'a [Command],
    radius_m: f64,
}

impl Judge<'_> {
    /// The first of the reasons for which it is not completed.
    fn reason(&self) -> Option<String> {
        let response = self.course.response.map(|(t, text)| format!("{text} at {t:.1} s; {}", self.ending()));
        response
            .or_else(|| self.bad_end())
            .or_else(|| self.refused())
            .or_else(|| self.left_over())
            .or_else(|| self.missed())
            .or_else(|| self.not_followed())
            .or_else(|| self.aloft())
    }

    fn bad_end(&self) -> Option<String> {
        match self.outcome.end {
            End::DurationReached => None,
            End::NeverFlew => {
                let refused = self.course.timeline.events.iter().rfind(|event| event.kind == EventKind::Refused);
                Some(refused.map_or_else(|| self.ending(), |event| format!("{}: {}", self.ending(), event.text)))
            }
            _ => Some(self.ending()),
        }
    }

    /// How the flight ended, in words.
    fn ending(&self) -> String {
        let t = f64::from(self.outcome.ticks) / 1e3;
        match (self.outcome.end, self.outcome.landing) {
            (End::DurationReached, Some(contact)) => {
                let (at, away) = (contact.t_s, contact.from_start_m);
                format!("landed at {at:.1} s with {:.2} m/s, {away:.1} m from the start", contact.descent_m_s)
            }
            (End::DurationReached, None) => "still flying at the end".into(),
            (end, _) => end_text(&end, t),
        }
    }

    /// The first command that the vehicle refused, and why.
    fn refused(&self) -> Option<String> {
        let refused = |leg: &Leg| Some(format!("`{}` refused: {}", order_text(&leg.order), leg.refused?));
        self.course.legs.iter().find_map(refused)
    }

    fn left_over(&self) -> Option<String> {
        let given = self.course.legs.len();
        let waits = || {
            let last =
                self.course.legs.last().map_or("the first".into(), |leg| format!("`{}`", order_text(&leg.order)));
            let (of, ended_s) = (self.script.len(), f64::from(self.outcome.ticks) / 1e3);
            match self.script.get(given) {
                Some(Command { at_s: Some(at_s), order, .. }) if *at_s >= ended_s => {
                    format!(
                        "{given} of {of} commands given: `{}` is for {at_s} s, and the flight ended before",
                        order_text(order)
                    )
                }
                _ => format!("{given} of {of} commands given: {last} was not reached in time"),
            }
        };
        (given < self.script.len()).then(waits)
    }

    fn missed(&self) -> Option<String> {
        let far = |leg: &&Leg| is_a_place(leg) && leg.off_m.is_none_or(|off| off > self.radius_m);
        let missed = self.course.legs.iter().find(far)?;
        let off = missed.off_m.unwrap_or(f64::NAN);
        Some(format!("`{}` missed by {off:.1} m", order_text(&missed.order)))
    }

    /// Of a flight that was told to fly its trajectory: whether it came to it.
    fn not_followed(&self) -> Option<String> {
        let follows = |leg: &Leg| leg.order == Order::Follow && leg.refused.is_none();
        let is_flown = self.course.timeline.phases.iter().any(|phase| phase.name.starts_with("trajectory"));
        (self.course.legs.iter().any(follows) && !is_flown).then(|| "its trajectory was not reached".into())
    }

    /// Of a flight that was told to land: whether it did, and where.
    fn aloft(&self) -> Option<String> {
        let last = self.course.legs.iter().rfind(|leg| !matches!(leg.order, Order::Disarm))?;
        if !matches!(last.order, Order::Land | Order::Return) {
            return None;
        }
        let Some(contact) = self.outcome.landing else { return Some("it has not landed".into()) };
        let ([x, y, _], place) = (contact.position_m, last.place.unwrap_or(contact.position_m));
        let off = libm::hypot(x - place[0], y - place[1]);
        if off > self.radius_m {
            return Some(format!("landed {off:.1} m from its place"));
        }
        (!self.course.disarmed).then(|| "landed, and not disarmed".into())
    }
}

/// Of a rotor (from 0) that the vehicle took for failed.
pub fn no_rotor_failed(rotor: usize) -> String {
    format!(
        "motor {} had not failed: the vehicle is not as it believes (mass, inertia, thrust), or its gains do not fit",
        rotor + 1
    )
}

/// Whether it has to be somewhere once the command is carried out.
fn is_a_place(leg: &Leg) -> bool {
    matches!(leg.order, Order::TakeOff { .. } | Order::GoTo { .. })
}

/// Why a flight of `t` seconds ended, in words.
pub fn end_text(end: &End, t: f64) -> String {
    match end {
        End::DurationReached => format!("flown for {t} s"),
        End::LeftReference => format!("LOST: more than 50 m from its reference at {t:.1} s"),
        End::NotFinite => format!("LOST: its motion was no longer finite at {t:.1} s"),
        End::Interrupted => format!("interrupted at {t:.1} s"),
        End::NeverFlew => "never flew".into(),
        End::Crashed(crash) if crash.tilt_rad > std::f64::consts::FRAC_PI_3 => {
            let (t, tilt, down) = (crash.t_s, crash.tilt_rad.to_degrees(), crash.descent_m_s);
            let speed = if down > 0.1 { format!(", with {down:.1} m/s down") } else { String::new() };
            format!("CRASHED at {t:.1} s: on the ground with a tilt of {tilt:.0}°{speed}")
        }
        End::Crashed(crash) => {
            format!("CRASHED at {:.1} s: hit the ground with {:.1} m/s", crash.t_s, crash.descent_m_s)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::outcome::{Contact, Crash};
    use crate::report::timeline::Timeline;

    const TAKE_OFF: Order = Order::TakeOff { height_m: 5.0 };
    const SCRIPT: [Command; 2] = [
        Command { at_s: Some(1.0), arrived_for_s: None, order: TAKE_OFF },
        Command { at_s: Some(300.0), arrived_for_s: None, order: Order::Return },
    ];

    fn leg(order: Order, off_m: f64) -> Leg {
        Leg { order, place: Some([0.0; 3]), refused: None, off_m: Some(off_m) }
    }

    fn course(legs: Vec<Leg>) -> Course {
        Course { legs, disarmed: true, timeline: Timeline::default(), ..Course::default() }
    }

    fn landed(away: f64) -> Outcome {
        let contact =
            Contact { t_s: 46.9, descent_m_s: 0.4, drift_m_s: 0.0, position_m: [away, 0.0, 0.0], from_start_m: away };
        Outcome { ticks: 60_000, landing: Some(contact), ..Outcome::default() }
    }

    fn reason(course: &Course, outcome: &Outcome) -> String {
        judge(course, outcome, &SCRIPT, REACHED_BY_GNSS_M).reason.unwrap_or_default()
    }

    #[test]
    fn a_mission_is_completed_if_all_is_done_and_the_vehicle_is_down_in_its_place() {
        let whole = course(vec![leg(TAKE_OFF, 0.2), leg(Order::Return, 1.0)]);
        assert!(judge(&whole, &landed(0.5), &SCRIPT, REACHED_BY_GNSS_M).completed);
        assert_eq!(reason(&whole, &landed(3.5)), "landed 3.5 m from its place");
        assert_eq!(reason(&whole, &Outcome::default()), "it has not landed");
        assert_eq!(reason(&Course { disarmed: false, ..whole.clone() }, &landed(0.5)), "landed, and not disarmed");
        let missed = course(vec![leg(TAKE_OFF, 3.2), leg(Order::Return, 1.0)]);
        assert_eq!(reason(&missed, &landed(0.5)), "`take-off to 5 m` missed by 3.2 m");
        let left_over = course(vec![leg(TAKE_OFF, 0.1)]);
        let late = Outcome { ticks: 400_000, ..Outcome::default() };
        assert_eq!(reason(&left_over, &late), "1 of 2 commands given: `take-off to 5 m` was not reached in time");
        let early = "1 of 2 commands given: `return` is for 300 s, and the flight ended before";
        assert_eq!(reason(&left_over, &Outcome::default()), early);
    }

    #[test]
    fn a_refused_command_is_no_missed_place() {
        let far = Order::GoTo { position_m: [9e3, 0.0, 5.0], yaw_deg: 0.0 };
        let refused = Leg { refused: Some("outside the geofence"), off_m: None, ..leg(far, 0.0) };
        let flown = course(vec![leg(TAKE_OFF, 0.1), refused]);
        assert_eq!(reason(&flown, &landed(0.0)), "`go-to 9000, 0, 5 m` refused: outside the geofence");
    }

    #[test]
    fn what_the_vehicle_did_by_itself_comes_first_and_then_how_it_ended() {
        let response = Some((31.1, "Position lost: descending"));
        let lost = Course { response, ..course(vec![leg(TAKE_OFF, 0.1), leg(Order::Land, 0.1)]) };
        assert_eq!(
            reason(&lost, &landed(12.3)),
            "Position lost: descending at 31.1 s; landed at 46.9 s with 0.40 m/s, 12.3 m from the start"
        );
        let crash = Crash { t_s: 40.0, descent_m_s: 13.0, tilt_rad: 0.1 };
        let crashed = Outcome { end: End::Crashed(crash), ..landed(1.0) };
        assert!(reason(&lost, &crashed).ends_with("CRASHED at 40.0 s: hit the ground with 13.0 m/s"));
    }
}

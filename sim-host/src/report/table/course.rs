//! The course of a flight on sensors or with a pilot: phases, landing, battery, what was known, what failed.

use std::fmt::Write as _;

use super::aligned;
use super::numbers::undefined;
use crate::report::sensed::{Knowledge, Sensed};
use crate::report::summary::Told;
use crate::report::timeline::{Event, EventKind, Phase};

/// Several lines with a newline at the end.
pub(super) fn render(told: &Told, sensed: Option<&Sensed>) -> String {
    let mut text = phases(&told.timeline.phases) + &events(&told.timeline.events);
    let mut line = |name: &str, value: &str| writeln!(text, "{name:<10}  {value}").expect("a string takes every byte");
    for (place, name) in told.places.iter().zip(std::iter::once("places").chain(std::iter::repeat(""))) {
        line(name, &format!("{:.2} m from {}", place.off_m, place.order));
    }
    if let Some(landing) = sensed.and_then(landing) {
        line("touchdown", &landing);
    }
    if let Some(again) = sensed.and_then(|sensed| landed_again(&told.timeline.events, sensed)) {
        line("", &again);
    }
    if let Some([start, end]) = told.battery {
        line("battery", &format!("{:.0} % at the start, {:.0} % at the end", 100.0 * start, 100.0 * end));
    }
    if let Some(known) = sensed.and_then(|sensed| knowledge(&sensed.estimate)) {
        line("estimate", &known);
    }
    text + "\n"
}

/// The shortest phase that has a row, s: half of the last digit of its times.
const SHORTEST_S: f64 = 0.05;

fn phases(phases: &[Phase]) -> String {
    let mut rows = vec![["phase", "from", "to", "error RMS", "maximum"].map(String::from)];
    // What the vehicle passed through in less than a row shows is no phase of the flight.
    for phase in phases.iter().filter(|phase| phase.to_s - phase.from_s >= SHORTEST_S) {
        let times = [phase.from_s, phase.to_s].map(|t| format!("{t:.1} s"));
        let [from, to] = times;
        rows.push([phase.name.clone(), from, to, metres(phase.error_rms_m), metres(phase.error_max_m)]);
    }
    aligned(&rows) + "\n"
}

/// What failed and what was done, if anything did.
fn events(events: &[Event]) -> String {
    use EventKind as K;
    let matters = |event: &&Event| !matches!(event.kind, K::Order | K::Touchdown | K::Disarmed);
    if events.iter().find(matters).is_none() {
        return String::new();
    }
    let mut text = String::new();
    for Event { t_s, kind, text: what } in events.iter().filter(|event| event.kind != K::Order) {
        let who = if matches!(kind, K::Response | K::Refused) { "vehicle: " } else { "" };
        writeln!(text, "{t_s:>8.1} s  {who}{what}").expect("a string takes every byte");
    }
    text + "\n"
}

/// The landing, if there was one.
fn landing(sensed: &Sensed) -> Option<String> {
    let disarmed = sensed.disarmed_s.map_or_else(|| "not disarmed".into(), |t| format!("disarmed at {t:.1} s"));
    let contact = sensed.touchdown?;
    Some(format!(
        "at {:.1} s, {:.2} m from the start, with {:.2} m/s down and {:.2} m/s sideways; {disarmed}",
        contact.t_s, contact.from_start_m, contact.descent_m_s, contact.drift_m_s
    ))
}

/// The last touchdown of a vehicle that has flown again after the first.
fn landed_again(events: &[Event], sensed: &Sensed) -> Option<String> {
    let first = sensed.touchdown?;
    let last = events.iter().rfind(|event| event.kind == EventKind::Touchdown && event.t_s > first.t_s)?;
    Some(format!("last at {:.1} s,{}", last.t_s, last.text.trim_start_matches("touchdown")))
}

/// What the vehicle's estimate was off by; nothing of one that was never armed.
fn knowledge(known: &Knowledge) -> Option<String> {
    let degrees = |value: Option<f64>| value.map_or_else(undefined, |v| format!("{:.2}°", v.to_degrees()));
    known.tilt_rms_rad?;
    Some(format!(
        "RMS error while armed: tilt {}, heading {}, position {}, velocity {}/s",
        degrees(known.tilt_rms_rad),
        degrees(known.heading_rms_rad),
        metres(known.position_rms_m),
        metres(known.velocity_rms_m_s),
    ))
}

fn metres(value: Option<f64>) -> String {
    value.map_or_else(undefined, |v| format!("{v:.3} m"))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::outcome::Contact;
    use crate::report::summary::Place;
    use crate::report::timeline::Timeline;

    fn told() -> Told {
        let phase = |name: &str, from_s, to_s, error: Option<f64>| Phase {
            name: name.into(),
            from_s,
            to_s,
            error_rms_m: error,
            error_max_m: error.map(|e| 2.0 * e),
        };
        let event = |t_s, kind, text: &str| Event { t_s, kind, text: text.into() };
        Told {
            mission: None,
            places: vec![Place { order: "take-off to 5 m".into(), off_m: 0.21 }],
            battery: Some([1.0, 0.823]),
            timeline: Timeline {
                phases: vec![
                    phase("before arming", 0.0, 2.48, None),
                    phase("armed", 2.48, 2.5, None),
                    phase("take-off", 2.5, 8.125, Some(0.034)),
                ],
                events: vec![
                    event(2.5, EventKind::Order, "arm"),
                    event(30.0, EventKind::FaultBegins, "fault: gnss off"),
                    event(31.1, EventKind::Response, "Position lost: descending"),
                ],
            },
        }
    }

    #[test]
    fn a_flight_on_sensors_tells_what_it_did() {
        let estimate = Knowledge {
            tilt_rms_rad: Some(0.005),
            heading_rms_rad: Some(0.02),
            position_rms_m: Some(1.25),
            velocity_rms_m_s: Some(0.05),
        };
        let touchdown = Some(Contact {
            t_s: 71.5,
            descent_m_s: 0.4,
            drift_m_s: 0.1,
            position_m: [0.3, 0.4, 0.0],
            from_start_m: 0.5,
        });
        let sensed = Sensed { estimate, touchdown, disarmed_s: Some(73.0) };
        let expected = "\
phase           from     to  error RMS  maximum
before arming  0.0 s  2.5 s          –        –
take-off       2.5 s  8.1 s    0.034 m  0.068 m

    30.0 s  fault: gnss off
    31.1 s  vehicle: Position lost: descending

places      0.21 m from take-off to 5 m
touchdown   at 71.5 s, 0.50 m from the start, with 0.40 m/s down and 0.10 m/s sideways; disarmed at 73.0 s
battery     100 % at the start, 82 % at the end
estimate    RMS error while armed: tilt 0.29°, heading 1.15°, position 1.250 m, velocity 0.050 m/s

";
        assert_eq!(render(&told(), Some(&sensed)), expected);
        let text = render(&Told { timeline: Timeline::default(), ..told() }, Some(&Sensed::default()));
        assert!(!text.contains("touchdown") && !text.contains("estimate"), "{text}");
    }
}

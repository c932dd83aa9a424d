//! What is told to pilots in words: why a command was refused, and what has happened.

use glissade_dialect::mavlink_core::types::CharArray;
use glissade_dialect::{MavSeverity, STATUSTEXT_DATA};

use super::writer::Writer;
use crate::commander::{Event, Refusal, Request};

/// Length of a text in its message.
const LENGTH: usize = 50;

/// Sends why a command was refused; false if it does not fit.
pub(super) fn write_refusal(request: &Request, refusal: Refusal, out: &mut Writer) -> bool {
    write([name(request), " refused: ", reason(refusal)], MavSeverity::MAV_SEVERITY_WARNING, out)
}

/// Sends what has happened; false if it does not fit.
pub(super) fn write_event(event: Event, out: &mut Writer) -> bool {
    let words = match event {
        Event::SensorsLost => ["Sensors lost", ": descending blind", ""],
        Event::SensorsGone => ["Sensors lost", ": rotors stopped", ""],
        Event::AttitudeLost => ["Attitude lost", ": descending blind", ""],
        Event::HeightLost => ["Height lost", ": descending blind", ""],
        Event::VelocityLost => ["Velocity lost", ": descending level", ""],
        Event::PositionLost => ["Position lost", ": descending", ""],
        Event::BatteryLow => ["Battery low", ": returning", ""],
        Event::BatteryCritical => ["Battery critical", ": landing", ""],
        Event::RotorFailed { rotor } => ["Rotor", number(rotor), " failed: descending, turning"],
    };
    write(words, MavSeverity::MAV_SEVERITY_CRITICAL, out)
}

/// The number of a rotor as pilots count them.
fn number(rotor: u8) -> &'static str {
    [" 1", " 2", " 3", " 4"].get(usize::from(rotor)).copied().unwrap_or_default()
}

fn name(request: &Request) -> &'static str {
    match request {
        Request::Arm { .. } => "Arming",
        Request::Disarm { .. } => "Disarming",
        Request::TakeOff { .. } => "Take-off",
        Request::Hold => "Hold",
        Request::GoTo { .. } => "Go to",
        Request::Velocity { .. } => "Velocity",
        Request::Land => "Landing",
        Request::Return => "Return",
        Request::Follow => "Trajectory",
    }
}

fn reason(refusal: Refusal) -> &'static str {
    match refusal {
        Refusal::NoNavigation => "no sensor data",
        Refusal::NotAligned => "attitude unknown",
        Refusal::NoPosition => "position unknown",
        Refusal::NoHeight => "height unknown",
        Refusal::NotLevel => "not level",
        Refusal::Moving => "moving",
        Refusal::Battery => "battery low",
        Refusal::RotorFailed => "rotor failed",
        Refusal::InAir => "in the air",
        Refusal::OnGround => "on the ground",
        Refusal::Disarmed => "disarmed",
        Refusal::NotAtStart => "it begins elsewhere",
    }
}

/// What does not fit is cut.
fn write(words: [&str; 3], severity: MavSeverity, out: &mut Writer) -> bool {
    let mut text = [0; LENGTH];
    for (to, from) in text.iter_mut().zip(words.iter().flat_map(|word| word.bytes())) {
        *to = from;
    }
    out.write(&STATUSTEXT_DATA { severity, text: CharArray::new(text) })
}

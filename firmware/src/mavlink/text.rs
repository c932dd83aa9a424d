//! Texts for pilots (`STATUSTEXT`): why a command was refused, and failsafe events.

use glissade_dialect::mavlink_core::types::CharArray;
use glissade_dialect::{MavSeverity, STATUSTEXT_DATA};

use super::writer::Writer;
use crate::commander::Event;

/// Length of a text in its message.
const LENGTH: usize = 50;

/// Sends why a command was refused; false if it does not fit.
pub(super) fn write_refusal(request: &str, reason: &str, out: &mut Writer) -> bool {
    write(&[request, " refused: ", reason], MavSeverity::MAV_SEVERITY_WARNING, out)
}

/// Sends an event; false if it does not fit.
pub(super) fn write_event(event: Event, out: &mut Writer) -> bool {
    let severity = match event {
        Event::ArmingRefused { .. } | Event::TakeOffRefused { .. } => MavSeverity::MAV_SEVERITY_WARNING,
        _ => MavSeverity::MAV_SEVERITY_CRITICAL,
    };
    write(&[event.text()], severity, out)
}

/// Sends the concatenated text, truncated to [`LENGTH`]; false if the message does not fit.
fn write(pieces: &[&str], severity: MavSeverity, out: &mut Writer) -> bool {
    let mut text = [0; LENGTH];
    for (to, from) in text.iter_mut().zip(pieces.iter().flat_map(|piece| piece.bytes())) {
        *to = from;
    }
    out.write(&STATUSTEXT_DATA { severity, text: CharArray::new(text) })
}

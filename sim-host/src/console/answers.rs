//! The answers to ground stations' commands that never reach the commander: unsupported ones, those whose parameters make
//! no request, and those that act at once. They are read from what the vehicle sends, so that the firmware need not tell of
//! them twice.

use firmware::commander::{Origin, Reply};
use glissade_dialect::mavlink_core::{MavlinkVersion, MessageData, consts};
use glissade_dialect::num_traits::FromPrimitive as _;
use glissade_dialect::{COMMAND_ACK_DATA, MavCmd, MavMessage, MavResult, STATUSTEXT_DATA};

use super::commands;

/// Bytes of a MAVLink 2 frame before its payload.
const HEADER: usize = consts::STX_SIZE + consts::v2::MIN_HEADER_SIZE;
/// More answers are not awaited: acknowledgements may be lost, where too many are asked for.
const AWAITED_MAX: usize = 16;
/// More commands that are unsupported are told each time: no ground station has so many.
const UNSUPPORTED_MAX: usize = 64;

/// What the firmware calls a set-point that it refuses.
const SET_POINT: &str = "Set-point";

/// To whom an answer goes, and to what.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Asked {
    link: u8,
    sender: (u8, u8),
    command: u16,
}

/// The acknowledgements that are still to come of what the commander has answered, and was told.
#[derive(Clone, Debug, Default)]
pub(super) struct Answers {
    awaited: Vec<Asked>,
    /// Commands that were told to be unsupported: some stations ask again every other second, for good.
    unsupported: Vec<Asked>,
    /// The link of who flies by hand in this process.
    pilot: Option<u8>,
}

impl Answers {
    /// A pilot of this process has this link.
    pub(super) fn seat_pilot(&mut self, link: u8) {
        self.pilot = Some(link);
    }

    /// Who has asked, in words.
    pub(super) fn who(&self, link: u8, system: u8) -> String {
        if self.pilot == Some(link) { "pilot".to_owned() } else { format!("ground station {system}") }
    }

    /// The commander's answer was told; its acknowledgement follows.
    pub(super) fn told(&mut self, reply: &Reply) {
        let Origin::Station { link, sender, command, .. } = reply.command.origin else { return };
        if self.awaited.len() == AWAITED_MAX {
            self.awaited.remove(0);
        }
        self.awaited.push(Asked { link, sender, command });
    }

    /// Tells the answers among the frames that are sent on a link that the commander has not given: refusals, and what
    /// acts at once: kills, terminations, restarts.
    pub(super) fn read(&mut self, link: u8, frames: &[u8], tell: &mut impl FnMut(String)) {
        let reason = reason(frames);
        for ack in acknowledgements(frames) {
            let sender = (ack.target_system, ack.target_component);
            let asked = Asked { link, sender, command: ack.command };
            if let Some(place) = self.awaited.iter().position(|awaited| *awaited == asked) {
                self.awaited.remove(place);
            } else if let Some(text) = answer(&ack, reason.as_deref()).filter(|_| !self.was_told(&ack, asked)) {
                tell(format!("{}: {text}", self.who(link, ack.target_system)));
            }
        }
    }

    /// Whether a command was told to be unsupported before.
    fn was_told(&mut self, ack: &COMMAND_ACK_DATA, asked: Asked) -> bool {
        if ack.result != MavResult::MAV_RESULT_UNSUPPORTED {
            return false;
        }
        let before = self.unsupported.contains(&asked);
        if !before && self.unsupported.len() < UNSUPPORTED_MAX {
            self.unsupported.push(asked);
        }
        before
    }
}

/// The messages of a kind among whole frames.
fn messages<M: MessageData<Message = MavMessage>>(mut frames: &[u8]) -> impl Iterator<Item = M> {
    let next = move || {
        let length = usize::from(*frames.get(1)?);
        let (frame, rest) = frames.split_at_checked(HEADER + length + consts::CHECKSUM_SIZE)?;
        frames = rest;
        Some(frame)
    };
    std::iter::from_fn(next).filter_map(|frame| {
        let id = u32::from_le_bytes([frame[7], frame[8], frame[9], 0]);
        let payload = &frame[HEADER..frame.len() - consts::CHECKSUM_SIZE];
        (id == M::ID).then(|| M::deser(MavlinkVersion::V2, payload).ok())?
    })
}

/// The acknowledgements among whole frames.
fn acknowledgements(frames: &[u8]) -> impl Iterator<Item = COMMAND_ACK_DATA> {
    messages(frames)
}

/// What is refused by a text among whole frames, and why.
fn refusals(frames: &[u8]) -> impl Iterator<Item = (String, String)> {
    messages(frames).filter_map(|text: STATUSTEXT_DATA| {
        let (what, reason) = text.text.to_str().ok()?.split_once(" refused: ")?;
        Some((what.to_owned(), reason.to_owned()))
    })
}

/// The reason of the one command that is refused by a text among whole frames; of several nobody knows which is whose.
fn reason(frames: &[u8]) -> Option<String> {
    let mut reasons = refusals(frames).filter_map(|(what, reason)| (what != SET_POINT).then_some(reason));
    reasons.next().filter(|_| reasons.next().is_none())
}

/// Why a set-point is refused, which no acknowledgement tells.
pub(super) fn refused_set_point(frames: &[u8]) -> Option<String> {
    refusals(frames).find_map(|(what, reason)| (what == SET_POINT).then_some(reason))
}

/// An answer in words. Ground stations ask for messages all the time, and do without those that there are not: of that
/// nothing is told.
fn answer(ack: &COMMAND_ACK_DATA, reason: Option<&str>) -> Option<String> {
    let known = MavCmd::from_u16(ack.command);
    if let Some(
        MavCmd::MAV_CMD_REQUEST_MESSAGE
        | MavCmd::MAV_CMD_SET_MESSAGE_INTERVAL
        | MavCmd::MAV_CMD_GET_MESSAGE_INTERVAL
        | MavCmd::MAV_CMD_GET_HOME_POSITION
        | MavCmd::MAV_CMD_REQUEST_PROTOCOL_VERSION
        | MavCmd::MAV_CMD_REQUEST_AUTOPILOT_CAPABILITIES,
    ) = known
    {
        return None;
    }
    let why = reason.map(|reason| format!("refused, {reason}"));
    let outcome = match ack.result {
        MavResult::MAV_RESULT_UNSUPPORTED => "unsupported",
        MavResult::MAV_RESULT_COMMAND_LONG_ONLY
        | MavResult::MAV_RESULT_COMMAND_INT_ONLY
        | MavResult::MAV_RESULT_COMMAND_UNSUPPORTED_MAV_FRAME => "unsupported in this form",
        MavResult::MAV_RESULT_FAILED => "failed",
        MavResult::MAV_RESULT_DENIED => "denied",
        MavResult::MAV_RESULT_TEMPORARILY_REJECTED if why.is_some() => why.as_deref().unwrap_or_default(),
        MavResult::MAV_RESULT_TEMPORARILY_REJECTED
            if matches!(known, Some(MavCmd::MAV_CMD_NAV_TAKEOFF | MavCmd::MAV_CMD_DO_SET_HOME)) =>
        {
            "refused, no place on Earth known or too many at once"
        }
        MavResult::MAV_RESULT_TEMPORARILY_REJECTED => "refused, too many at once",
        MavResult::MAV_RESULT_ACCEPTED => return accepted(known?).map(|what| format!("{what}: accepted")),
        MavResult::MAV_RESULT_IN_PROGRESS => return None,
    };
    let name = commands::name(ack.command).map_or_else(String::new, |name| format!(" ({name})"));
    Some(format!("command {}{name}: {outcome}", ack.command))
}

/// What is accepted without the commander, as far as it is told here: of an injected failure it is told when it begins.
fn accepted(command: MavCmd) -> Option<&'static str> {
    match command {
        // Of arming and disarming only a kill.
        MavCmd::MAV_CMD_COMPONENT_ARM_DISARM => Some("kill"),
        MavCmd::MAV_CMD_DO_FLIGHTTERMINATION => Some("termination"),
        MavCmd::MAV_CMD_PREFLIGHT_REBOOT_SHUTDOWN => Some("restart"),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use glissade_dialect::mavlink_core::{MAVLinkV2MessageRaw, MavHeader};

    use super::*;

    fn frame(message: &impl MessageData) -> Vec<u8> {
        let mut raw = MAVLinkV2MessageRaw::new();
        raw.serialize_message_data(MavHeader { system_id: 1, component_id: 1, sequence: 0 }, message);
        raw.raw_bytes().to_vec()
    }

    #[test]
    fn a_refusal_is_told_with_the_reason_that_its_station_is_sent() {
        let ack = frame(&COMMAND_ACK_DATA {
            command: 179,
            result: MavResult::MAV_RESULT_TEMPORARILY_REJECTED,
            target_system: 255,
            ..COMMAND_ACK_DATA::DEFAULT
        });
        let text = frame(&STATUSTEXT_DATA { text: "Home refused: no map".into(), ..STATUSTEXT_DATA::DEFAULT });
        for (frames, expected) in [
            (ack.clone(), "refused, no place on Earth known or too many at once"),
            ([&ack[..], &text].concat(), "refused, no map"),
            ([&ack[..], &text, &text].concat(), "refused, no place on Earth known or too many at once"),
        ] {
            let mut told = Vec::new();
            Answers::default().read(0, &frames, &mut |text| told.push(text));
            assert_eq!(told, [format!("ground station 255: command 179 (DO_SET_HOME): {expected}")]);
        }
    }
    #[test]
    fn who_flies_in_this_process_is_a_pilot_and_no_ground_station() {
        let mut answers = Answers::default();
        answers.seat_pilot(2);
        let ack = COMMAND_ACK_DATA {
            command: 176,
            result: MavResult::MAV_RESULT_DENIED,
            target_system: 254,
            ..COMMAND_ACK_DATA::DEFAULT
        };
        let mut told = Vec::new();
        for link in [1, 2] {
            answers.read(link, &frame(&ack), &mut |text| told.push(text));
        }
        let denied = "command 176 (DO_SET_MODE): denied";
        assert_eq!(told, [format!("ground station 254: {denied}"), format!("pilot: {denied}")]);
    }
}

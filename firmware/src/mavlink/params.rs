//! The parameter protocol: the settings of `settings`, to read and to set.
//!
//! [`Params`] is the state of one link: what it is still to be sent. Values are looked up when they are sent, so a value
//! that changes meanwhile is never sent twice. A list that is asked for again while it is sent goes on, past its end to the
//! value before which it was asked for: whoever asks gets every value once more, and who asks often does not start it
//! again and again. [`set`] changes a value; the
//! caller announces it on every link.
//!
//! Values are encoded bytewise: the bytes of an integer stand in the float of the message.

use glissade_dialect::mavlink_core::types::CharArray;
use glissade_dialect::{MavParamError, MavParamType, PARAM_ERROR_DATA, PARAM_VALUE_DATA};

use super::incoming::Sender;
use super::writer::Writer;
use crate::settings::{COUNT, Kind, Marks, NAME_MAX, SETTINGS, SettingError, Settings, Value, find};

/// A name as it stands in a message: ended by a zero, unless it takes the whole length.
pub(super) type Name = [u8; NAME_MAX];

/// A request of the protocol.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum ParamRequest {
    /// `PARAM_REQUEST_LIST`.
    List,
    /// `PARAM_REQUEST_READ`: by index, or by name if that is negative.
    Read { index: i16, name: Name },
    /// `PARAM_SET`: the bits of the value, and its type.
    Set { name: Name, bits: u32, kind: u8 },
}

/// What setting a value has come to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Done {
    /// It has another value: to be announced on every link.
    Changed(usize),
    /// It had that value already: to be answered.
    Unchanged(usize),
    /// Refused, with the setting if there is one: its value is to be answered too.
    Refused(Option<usize>, MavParamError),
}

/// Sets a value of a vehicle that is `armed` or not. A repeated request changes nothing.
pub(super) fn set(settings: &mut Settings, name: &Name, bits: u32, kind: u8, armed: bool) -> Done {
    let Some(index) = find_by(name) else { return Done::Refused(None, error_of(SettingError::Unknown)) };
    let Some(kind) = kind_of(kind) else { return Done::Refused(Some(index), error_of(SettingError::OtherType)) };
    let before = settings.generation();
    match settings.set(index, Value::from_bits(kind, bits), armed) {
        Ok(_) if settings.generation() == before => Done::Unchanged(index),
        Ok(_) => Done::Changed(index),
        Err(error) => Done::Refused(Some(index), error_of(error)),
    }
}

/// The setting of a name in a message.
fn find_by(name: &Name) -> Option<usize> {
    let length = name.iter().position(|byte| *byte == 0).unwrap_or(NAME_MAX);
    find(core::str::from_utf8(name.get(..length)?).ok()?)
}

fn kind_of(number: u8) -> Option<Kind> {
    const INT32: u8 = MavParamType::MAV_PARAM_TYPE_INT32 as u8;
    const REAL32: u8 = MavParamType::MAV_PARAM_TYPE_REAL32 as u8;
    match number {
        INT32 => Some(Kind::Int32),
        REAL32 => Some(Kind::Real32),
        _ => None,
    }
}

const fn number_of(kind: Kind) -> MavParamType {
    match kind {
        Kind::Int32 => MavParamType::MAV_PARAM_TYPE_INT32,
        Kind::Real32 => MavParamType::MAV_PARAM_TYPE_REAL32,
    }
}

const fn error_of(error: SettingError) -> MavParamError {
    match error {
        SettingError::Unknown => MavParamError::MAV_PARAM_ERROR_DOES_NOT_EXIST,
        SettingError::NotANumber | SettingError::OutOfRange | SettingError::Refused(_) => {
            MavParamError::MAV_PARAM_ERROR_VALUE_OUT_OF_RANGE
        }
        SettingError::ReadOnly => MavParamError::MAV_PARAM_ERROR_READ_ONLY,
        SettingError::Armed => MavParamError::MAV_PARAM_ERROR_PERMISSION_DENIED,
        SettingError::OtherType => MavParamError::MAV_PARAM_ERROR_TYPE_MISMATCH,
    }
}

/// An error that waits to be sent.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Refusal {
    name: Name,
    index: i16,
    error: MavParamError,
    to: Sender,
}

/// Errors that wait at most; a sender repeats a request whose answer is lost.
const ERRORS_MAX: usize = 32;

/// What one link is still to be sent.
#[derive(Clone, Debug, Default)]
pub(super) struct Params {
    /// Values that were asked for, set, or changed from another link.
    wanted: Marks,
    /// Index of the list's next value, and how many values are still to come.
    listing: Option<(usize, usize)>,
    errors: heapless::Deque<Refusal, ERRORS_MAX>,
    /// Errors that found the queue full, since the link was opened.
    lost: u32,
}

impl Params {
    /// All values: from the first, or from where the list is.
    pub(super) fn request_list(&mut self) {
        let next = self.listing.map_or(0, |(next, _)| next);
        self.listing = Some((next, COUNT));
    }

    /// One value; an error if there is none.
    pub(super) fn request_read(&mut self, index: i16, name: &Name, to: Sender) {
        let found = if index < 0 { find_by(name) } else { usize::try_from(index).ok().filter(|i| *i < COUNT) };
        match found {
            Some(index) => self.announce(index),
            None => self.refuse(Refusal { name: *name, index, error: error_of(SettingError::Unknown), to }),
        }
    }

    /// The answer to a link's own `PARAM_SET`.
    pub(super) fn answer(&mut self, name: &Name, done: Done, to: Sender) {
        let (index, error) = match done {
            Done::Changed(index) | Done::Unchanged(index) => (Some(index), None),
            Done::Refused(index, error) => (index, Some(error)),
        };
        if let Some(index) = index {
            self.announce(index);
        }
        if let Some(error) = error {
            let index = index.and_then(|index| i16::try_from(index).ok()).unwrap_or(-1);
            self.refuse(Refusal { name: *name, index, error, to });
        }
    }

    /// A value that this link is to be sent.
    pub(super) fn announce(&mut self, index: usize) {
        self.wanted.set(index);
    }

    fn refuse(&mut self, refusal: Refusal) {
        self.lost = self.lost.saturating_add(self.errors.push_back(refusal).is_err().into());
    }

    /// Errors that were lost since the link was opened.
    pub(super) fn lost(&self) -> u32 {
        self.lost
    }

    /// Sends what fits of the answers: errors, then the values that were asked for one by one, set or changed.
    pub(super) fn send_answers(&mut self, settings: &Settings, out: &mut Writer) {
        while self.errors.front().is_some_and(|refusal| write_error(refusal, out)) {
            self.errors.pop_front();
        }
        while let Some(index) = self.wanted.first() {
            if !write_value(settings, index, out) {
                return;
            }
            self.wanted.clear(index);
        }
    }

    /// Sends the list's next value, if it fits: one a job leaves two fifths of a 57,600 baud radio to the others.
    pub(super) fn send_list(&mut self, settings: &Settings, out: &mut Writer) {
        if let Some((index, left)) = self.listing
            && write_value(settings, index, out)
        {
            self.listing = Some(((index + 1) % COUNT, left - 1)).filter(|(_, left)| *left > 0);
        }
    }
}

/// Appends a value; false, with nothing written, if it does not fit. There is nothing to write of an index that is none.
fn write_value(settings: &Settings, index: usize, out: &mut Writer) -> bool {
    let (Some(setting), Some(value)) = (SETTINGS.get(index), settings.get(index)) else { return true };
    let mut param_id = [0; NAME_MAX];
    for (to, from) in param_id.iter_mut().zip(setting.name.bytes()) {
        *to = from;
    }
    out.write(&PARAM_VALUE_DATA {
        param_value: f32::from_bits(value.bits()),
        param_count: COUNT as u16,
        param_index: index as u16,
        param_id: CharArray::new(param_id),
        param_type: number_of(setting.kind()) as u8,
    })
}

fn write_error(refusal: &Refusal, out: &mut Writer) -> bool {
    let (target_system, target_component) = refusal.to;
    out.write(&PARAM_ERROR_DATA {
        param_index: refusal.index,
        target_system,
        target_component,
        param_id: CharArray::new(refusal.name),
        error: refusal.error as u8,
    })
}

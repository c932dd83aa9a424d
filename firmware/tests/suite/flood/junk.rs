//! Bytes that no vehicle may act on: random frames, frames for others, and damaged commands. Whatever is made is checked
//! by a search of its own that no frame in the stream is an intact one for the vehicle, wherever it begins.

/// Numbers from a seed (`SplitMix64`).
pub(crate) struct Random(pub(crate) u64);

impl Random {
    pub(crate) fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    pub(crate) fn below(&mut self, end: usize) -> usize {
        (self.next() % end as u64) as usize
    }

    fn byte(&mut self) -> u8 {
        self.next() as u8
    }

    fn bytes(&mut self, count: usize) -> Vec<u8> {
        (0..count).map(|_| self.byte()).collect()
    }

    fn one_of<T: Copy>(&mut self, all: &[T]) -> T {
        all[self.below(all.len())]
    }
}

/// A message that vehicles understand, as in MAVLink's definition: number, seed of the checksum, length, and where the
/// payload has its target's system and component.
struct Layout {
    id: u32,
    extra: u8,
    len: usize,
    system: Option<usize>,
    component: Option<usize>,
}

const fn layout(id: u32, extra: u8, len: usize, system: usize, has_component: bool) -> Layout {
    let component = if has_component { Some(system + 1) } else { None };
    Layout { id, extra, len, system: Some(system), component }
}

const LAYOUTS: [Layout; 23] = [
    Layout { id: 0, extra: 50, len: 9, system: None, component: None },
    layout(4, 237, 14, 12, true),
    layout(11, 89, 6, 4, false),
    layout(20, 214, 20, 2, true),
    layout(21, 159, 2, 0, true),
    layout(23, 168, 23, 4, true),
    layout(38, 9, 7, 4, true),
    layout(39, 254, 38, 32, true),
    layout(40, 230, 5, 2, true),
    layout(41, 28, 4, 2, true),
    layout(43, 132, 3, 0, true),
    layout(44, 221, 9, 2, true),
    layout(45, 232, 3, 0, true),
    layout(48, 41, 21, 12, false),
    layout(51, 196, 5, 2, true),
    layout(73, 38, 38, 32, true),
    layout(75, 158, 35, 30, true),
    layout(76, 152, 33, 30, true),
    layout(110, 84, 254, 1, true),
    layout(111, 34, 18, 16, true),
    layout(117, 128, 6, 4, true),
    layout(119, 116, 12, 10, true),
    layout(321, 88, 2, 0, true),
];

fn find(id: u32) -> Option<&'static Layout> {
    LAYOUTS.iter().find(|layout| layout.id == id)
}

/// CRC-16/MCRF4XX, bit by bit.
fn crc(bytes: &[u8], extra: u8) -> u16 {
    bytes.iter().chain([&extra]).fold(0xffff, |crc, byte| {
        (0..8).fold(crc ^ u16::from(*byte), |crc, _| if crc & 1 == 1 { (crc >> 1) ^ 0x8408 } else { crc >> 1 })
    })
}

/// A frame: of MAVLink 1, or of MAVLink 2 with these incompatibility flags. Sent by system 255, component 190.
fn sealed(v2: Option<u8>, sequence: u8, id: u32, extra: u8, payload: &[u8]) -> Vec<u8> {
    let length = payload.len() as u8;
    let [id0, id1, id2, _] = id.to_le_bytes();
    let mut frame = match v2 {
        None => vec![0xfe, length, sequence, 255, 190, id0],
        Some(flags) => vec![0xfd, length, flags, 0, sequence, 255, 190, id0, id1, id2],
    };
    frame.extend_from_slice(payload);
    let sum = crc(&frame[1..], extra);
    frame.extend_from_slice(&sum.to_le_bytes());
    if v2.is_some_and(|flags| flags & 1 == 1) {
        frame.extend_from_slice(&[0x5a; 13]);
    }
    frame
}

/// Length, without a signature, of the frame that begins here if it is intact, of a message that is understood.
pub(crate) fn intact(bytes: &[u8]) -> Option<(u32, usize)> {
    let (start, payload, id) = match *bytes {
        [0xfe, length, _, _, _, id, ..] => (6, usize::from(length), u32::from(id)),
        [0xfd, length, flags, _, _, _, _, id0, id1, id2, ..] if flags & !1 == 0 => {
            (10, usize::from(length), u32::from_le_bytes([id0, id1, id2, 0]))
        }
        _ => return None,
    };
    let extra = find(id)?.extra;
    let end = start + payload;
    let frame = bytes.get(..end + 2)?;
    (crc(&frame[1..end], extra).to_le_bytes() == frame[end..end + 2]).then_some((id, frame.len()))
}

/// A command to the vehicle, system 1, that would change something: in `COMMAND_LONG`, `SET_MODE`, `PARAM_SET` or
/// `SET_GPS_GLOBAL_ORIGIN`.
fn harmful(random: &mut Random, v2: Option<u8>) -> Vec<u8> {
    let sequence = random.byte();
    let long = |command: u16, params: [f32; 7]| {
        let mut payload: Vec<u8> = params.iter().flat_map(|value| value.to_le_bytes()).collect();
        payload.extend_from_slice(&command.to_le_bytes());
        payload.extend_from_slice(&[1, 1, 0]);
        (76, payload)
    };
    let (id, payload) = match random.below(9) {
        0 => long(400, [1.0, 21_196.0, 0.0, 0.0, 0.0, 0.0, 0.0]),
        1 => long(400, [0.0, 21_196.0, 0.0, 0.0, 0.0, 0.0, 0.0]),
        2 => long(21, [0.0; 7]),
        3 => long(176, [1.0, 4.0, 6.0, 0.0, 0.0, 0.0, 0.0]),
        4 => long(420, [0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0]),
        5 => long(179, [1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0]),
        6 => (11, [&0x0606_0000_u32.to_le_bytes()[..], &[1, 1]].concat()),
        7 => (23, [&9.0_f32.to_le_bytes()[..], &[1, 1], b"MPC_XY_CRUISE\0\0\0", &[9]].concat()),
        _ => (48, [&[1; 12][..], &[1], &[0; 8]].concat()),
    };
    let extra = find(id).expect("known").extra;
    sealed(v2, sequence, id, extra, &payload)
}

/// MAVLink 1, 2, or 2 with a signature.
fn version(random: &mut Random) -> Option<u8> {
    random.one_of(&[None, Some(0), Some(0), Some(1)])
}

/// An intact message with random fields, for another vehicle or component. A heartbeat is for all.
fn for_others(random: &mut Random) -> Vec<u8> {
    let (layout, mut v2) = (&LAYOUTS[random.below(LAYOUTS.len())], version(random));
    if layout.id > 255 {
        v2 = v2.or(Some(0));
    }
    // Fields that are still to come.
    let longer = if v2.is_some() && layout.len < 200 { random.below(8) } else { 0 };
    let mut payload = random.bytes(layout.len + longer);
    if let Some(system) = layout.system {
        payload[system] = 2 + random.byte() % 250;
        if let Some(component) = layout.component
            && random.below(2) == 0
        {
            // Of the same vehicle.
            (payload[system], payload[component]) = (1, 2 + random.byte() % 250);
        }
    }
    // What nobody is asked for; what comes with a target is an answer.
    sealed(v2, random.byte(), layout.id, layout.extra, &payload)
}

/// A ping to all, which is answered.
fn ping(random: &mut Random) -> Vec<u8> {
    let payload = [random.bytes(12), vec![0, 0]].concat();
    sealed(version(random), random.byte(), 4, 237, &payload)
}

/// A damaged command.
fn damaged(random: &mut Random) -> Vec<u8> {
    let kind = version(random);
    let mut frame = harmful(random, kind);
    // Not in the signature, which is not checked.
    let checked = frame.len() - if kind == Some(1) { 13 } else { 0 };
    let at = random.below(checked);
    match random.below(6) {
        0 => frame[at] ^= 1 << random.below(8),
        1 => (0..=random.below(4)).for_each(|_| {
            let at = random.below(checked);
            frame[at] ^= 1 << random.below(8);
        }),
        2 => frame[1] = random.byte(),
        3 => frame.truncate(at),
        4 => {
            // Cut, and sent again: cut too.
            let again = frame[..at].to_vec();
            frame.truncate(random.below(at + 1));
            frame.extend(again);
        }
        _ => frame.insert(at, random.byte()),
    }
    frame
}

/// A frame of no message that is known, with a random payload.
fn unknown(random: &mut Random) -> Vec<u8> {
    let count = random.below(120);
    let payload = random.bytes(count);
    sealed(Some(0), random.byte(), 50_000 + random.next() as u32 % 1_000, random.byte(), &payload)
}

/// A file whose payload is a command, in a frame that is damaged, between so many heartbeats that the stream is in step.
fn embedded(random: &mut Random) -> Vec<u8> {
    let beat = sealed(Some(0), 0, 0, 50, &[0, 0, 0, 0, 6, 8, 192, 4, 3]);
    let mut payload = random.bytes(254);
    // Another vehicle's, so that the place of the damage does not matter.
    payload[1] = 7;
    let command = harmful(random, Some(0));
    payload[20..20 + command.len()].copy_from_slice(&command);
    let mut file = sealed(Some(0), random.byte(), 110, 84, &payload);
    let end = file.len() - 1;
    file[end] ^= 0x55;
    [beat.repeat(30), file, beat].concat()
}

/// The stream: its frames, and the check of them.
pub(crate) struct Junk {
    random: Random,
    /// The last bytes sent: no frame that begins before them is still open.
    tail: Vec<u8>,
    pub(crate) frames: u32,
}

/// Longest frame.
const LONGEST: usize = 10 + 255 + 2 + 13;

impl Junk {
    pub(crate) fn new(seed: u64) -> Self {
        Self { random: Random(seed), tail: Vec::new(), frames: 0 }
    }

    /// The next frame.
    pub(crate) fn next(&mut self) -> Vec<u8> {
        loop {
            let (frame, inside) = self.make();
            if self.completes(&frame, inside) {
                continue;
            }
            self.sent(&frame);
            self.frames += 1;
            return frame;
        }
    }

    /// A frame, and from where in it no other one may begin.
    fn make(&mut self) -> (Vec<u8>, usize) {
        let random = &mut self.random;
        match random.below(400) {
            0..40 => {
                let count = 1 + random.below(60);
                let mut bytes = random.bytes(count);
                bytes[0] = random.one_of(&[0xfd, 0xfe, bytes[0]]);
                (bytes, 0)
            }
            40..140 => (for_others(random), 1),
            140..150 => (ping(random), 1),
            150..330 => (damaged(random), 0),
            330..370 => {
                let flags = 2 << random.below(7);
                (harmful(random, Some(flags)), 0)
            }
            370..399 => (unknown(random), 0),
            _ => (embedded(random), usize::MAX),
        }
    }

    /// Whether a frame ends an intact one that begins in what was sent before, or contains one that begins at `inside` or
    /// later.
    pub(crate) fn completes(&self, frame: &[u8], inside: usize) -> bool {
        let (before, mut all) = (self.tail.len(), self.tail.clone());
        all.extend_from_slice(frame);
        let ends_in_it = |at: usize| intact(&all[at..]).is_some_and(|(_, length)| at + length > before);
        (0..before).chain(before.saturating_add(inside)..all.len()).any(ends_in_it)
    }

    /// Takes note of bytes that were sent.
    pub(crate) fn sent(&mut self, bytes: &[u8]) {
        self.tail.extend_from_slice(bytes);
        let old = self.tail.len().saturating_sub(LONGEST);
        self.tail.drain(..old);
    }
}

/// A command that changes nothing: its number and `COMMAND_LONG`.
pub(crate) fn harmless(number: u16, param1: f32) -> Vec<u8> {
    let mut payload: Vec<u8> =
        [param1, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0].iter().flat_map(|value| value.to_le_bytes()).collect();
    payload.extend_from_slice(&number.to_le_bytes());
    payload.extend_from_slice(&[1, 1, 0]);
    sealed(Some(0), 0, 76, 152, &payload)
}

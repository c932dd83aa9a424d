use nalgebra::{Quaternion, UnitQuaternion};
use proptest::prelude::*;

use super::*;
use crate::commander;
use crate::mavlink::port::{LinkEvent, Profile};
use crate::sensors::{BaroSample, BatterySample, Geodetic, GnssSample, ImuSample, MagSample, PoseSample};
use crate::signals::{ControlInput, MotorCommand};

fn numbers<const N: usize>(first: f32) -> [f32; N] {
    core::array::from_fn(|i| first + i as f32 * 0.1)
}

fn nav(mut number: impl FnMut() -> f32) -> NavState {
    let mut vector = || [number(), number(), number()].into();
    let [position, velocity, rates] = [vector(), vector(), vector()];
    NavState { position, velocity, attitude: attitude(number), rates }
}

fn attitude(mut number: impl FnMut() -> f32) -> UnitQuaternion<f32> {
    UnitQuaternion::new_unchecked(Quaternion::new(number(), number(), number(), number()))
}

/// A frame with every sample, its words from a source.
fn measurements(mut word: impl FnMut() -> u32) -> Measurements {
    let imu = ImuSample { at: word(), gyro: vector(&mut word), accel: vector(&mut word) };
    let mag = MagSample { at: word(), field_ut: vector(&mut word) };
    let baro = BaroSample { at: word(), pressure_pa: f32::from_bits(word()) };
    let mut whole = || word().cast_signed();
    let place = Geodetic { latitude_e7: whole(), longitude_e7: whole(), height_mm: whole() };
    let gnss = GnssSample {
        at: word(),
        has_fix: word() & 1 == 1,
        place,
        velocity: vector(&mut word),
        horizontal_accuracy_m: f32::from_bits(word()),
        vertical_accuracy_m: f32::from_bits(word()),
        speed_accuracy_m_s: f32::from_bits(word()),
        separation_mm: word().cast_signed(),
        utc_us: Some(u64::from(word()) << 32 | u64::from(word())),
    };
    let pose = PoseSample { at: word(), position: vector(&mut word), attitude: attitude(|| f32::from_bits(word())) };
    let battery = BatterySample { voltage_v: f32::from_bits(word()), current_a: f32::from_bits(word()) };
    Measurements {
        imu: Some(imu),
        mag: Some(mag),
        baro: Some(baro),
        gnss: Some(gnss),
        pose: Some(pose),
        battery: Some(battery),
    }
}

fn vector(word: &mut impl FnMut() -> u32) -> Vector3<f32> {
    [word(), word(), word()].map(f32::from_bits).into()
}

/// Compares the bytes too, because a value with a NaN is not equal to itself.
fn assert_survives(request: &Request) {
    let bytes = request.encode();
    let decoded = Request::decode(&bytes).expect("a request");
    assert_eq!(decoded.encode(), bytes);
    #[expect(clippy::eq_op, reason = "false if there is a NaN in it")]
    if request == request {
        assert_eq!(&decoded, request);
    }
}

#[test]
fn a_request_is_decoded_as_it_was_encoded() {
    let mut nav = nav(|| 0.3);
    nav.velocity = [f32::NAN, -0.0, f32::MIN_POSITIVE / 2.0].into();
    for request in [Request::Sample(SensorFrame::Motion(nav)), Request::Missing, Request::Exit] {
        assert_survives(&request);
    }
    assert_eq!(Request::decode(&[9; REQUEST_BYTES]), None);
}

#[test]
fn every_value_of_a_measurement_keeps_its_bit_pattern() {
    // Signalling NaNs, each with a different payload.
    let first = 0x7fa0_0000;
    let mut next = first;
    let all = measurements(|| {
        next += 1;
        next
    });
    let request = Request::Sample(SensorFrame::Measured(all));
    assert_survives(&request);
    let bytes = request.encode();
    let words: Vec<u32> = bytes.chunks_exact(4).map(|b| u32::from_le_bytes([b[0], b[1], b[2], b[3]])).collect();
    // Except the word that encodes `has_fix`.
    let missing: Vec<u32> = (first + 1..=next).filter(|word| !words.contains(word)).collect();
    assert_eq!(missing.len(), 1, "{missing:x?}");
    assert_eq!(REQUEST_BYTES, 180);
}

proptest! {
    #[test]
    fn any_measurements_survive_their_bytes(words in proptest::collection::vec(any::<u32>(), 37), present: [bool; 6]) {
        let mut words = words.into_iter();
        let all = measurements(|| words.next().expect("enough"));
        let [imu, mag, baro, gnss, pose, battery] = present;
        let some = Measurements {
            imu: all.imu.filter(|_| imu),
            mag: all.mag.filter(|_| mag),
            baro: all.baro.filter(|_| baro),
            gnss: all.gnss.filter(|_| gnss),
            pose: all.pose.filter(|_| pose),
            battery: all.battery.filter(|_| battery),
        };
        assert_survives(&Request::Sample(SensorFrame::Measured(some)));
    }

    #[test]
    fn any_bytes_are_a_request_that_survives_or_none(words in proptest::collection::vec(0..3_u32, REQUEST_BYTES / 4)) {
        let mut bytes = [0; REQUEST_BYTES];
        for (to, word) in bytes.chunks_exact_mut(4).zip(words) {
            to.copy_from_slice(&word.to_le_bytes());
        }
        if let Some(request) = Request::decode(&bytes) {
            assert_survives(&request);
        }
    }
}

#[test]
fn a_reply_is_decoded_as_it_was_encoded() {
    let [thrust_n, roll_n_m, pitch_n_m, yaw_n_m] = numbers(2.0);
    let mut number = 20.0;
    let reply = Reply {
        tick: 77,
        state: State::Flying,
        nav: nav(|| {
            number += 1.0;
            number
        }),
        inner: InnerOutput {
            motors: MotorCommand { omega_rad_s: numbers(10.0) },
            demand: ControlInput { thrust_n, roll_n_m, pitch_n_m, yaw_n_m },
            s: numbers::<3>(-1.0).into(),
            saturated: true,
        },
        s_position: numbers::<3>(7.0).into(),
        overruns: [1, 2, 3],
        sent: core::array::from_fn(|i| Sent { bytes: i as u32, checksum: u32::MAX - i as u32 }),
    };
    assert_eq!(Reply::decode(&reply.encode()), Some(reply));
    for cause in [Cause::Panic, Cause::HardFault] {
        assert_eq!(Reply::decode(&Reply::stopped(cause).encode()), Some(Reply::stopped(cause)));
    }
    assert_eq!(Reply::decode(&[9; REPLY_BYTES]), None);
}

/// With every option present and every list full.
#[cfg(feature = "pil-wire")]
fn longest_config() -> crate::config::FlightConfig {
    use crate::guidance::{JoinPlan, Spline, Trajectory};

    let mut join = JoinPlan { duration_s: 3.0, start_acceleration_m_s2: [0.1; 3], middle_m: heapless::Vec::new() };
    while join.middle_m.push([1.0; 3]).is_ok() {}
    let mut control_points = heapless::Vec::new();
    while control_points.push([1.0; 4]).is_ok() {}
    let path = Spline { begin_ms: u32::MAX, duration_ms: u32::MAX, repeat: true, turn_rad: 1.0, control_points };
    crate::config::FlightConfig {
        trajectory: Trajectory::Spline(path),
        join: Some(join),
        estimator: Some(crate::estimator::EstimatorSettings::default()),
        ..crate::config::FlightConfig::default()
    }
}

#[cfg(feature = "pil-wire")]
#[test]
fn a_hello_is_decoded_as_it_was_encoded_and_an_invalid_one_is_refused() {
    use crate::failure::{Injectable, Manner, Unit};
    use crate::settings::{Settings, Value};

    let config = longest_config();
    let mut settings = Settings::of(&config);
    settings.restore(crate::settings::BAT1_N_CELLS, Value::Int(4)).expect("in range");
    let hello = Hello {
        config,
        settings,
        injectable: Injectable::NONE.with(Unit::Gnss, 1, &[Manner::Off]),
        busy: BusyWait { outer_us: 1, commander_us: 2, ground_us: 3 },
        fault: Some((5, Fault::Panic)),
    };
    let bytes = hello.encode().expect("fits");
    let length = u32::from_le_bytes([bytes[4], bytes[5], bytes[6], bytes[7]]);
    assert!(length as usize + 8 < HELLO_BYTES - 512, "leaves room for further settings: {length} bytes");
    assert_eq!(Hello::decode(&bytes), Ok(hello));
    let mut other = bytes;
    other[0] ^= 1;
    assert_eq!(Hello::decode(&other), Err(HelloError::Version));
    let mut long = bytes;
    long[4..8].copy_from_slice(&u32::MAX.to_le_bytes());
    assert_eq!(Hello::decode(&long), Err(HelloError::Malformed));
    let mut short = bytes;
    short[4..8].copy_from_slice(&9_u32.to_le_bytes());
    assert_eq!(Hello::decode(&short), Err(HelloError::Malformed));
}

#[cfg(feature = "pil-wire")]
#[test]
fn a_long_reason_is_truncated() {
    let answer = Answer::refused(&core::iter::repeat_n('x', 200).collect::<String>());
    assert_eq!(Answer::decode(&answer.encode()), Some(answer.clone()));
    assert!(matches!(answer, Answer::Refused(text) if text.len() == REPLY_BYTES - 4));
    assert_eq!(Answer::decode(&Answer::Ready.encode()), Some(Answer::Ready));
}

#[test]
fn a_pilots_request_is_decoded_as_it_was_encoded() {
    let [x, y, z, w] = numbers(-1.5);
    for asked in [
        commander::Request::Arm { force: true }.into(),
        commander::Request::Disarm.into(),
        commander::Request::TakeOff { height_m: 2.5 }.into(),
        commander::Request::Hold.into(),
        commander::Request::GoTo(commander::Goal::at([x, y, z], w)).into(),
        commander::Request::Velocity { velocity_m_s: [w, z, y], yaw_rate_rad_s: x }.into(),
        commander::Request::Land.into(),
        commander::Request::Return.into(),
        commander::Request::Follow.into(),
        Asked::Kill,
    ] {
        assert_survives(&Request::Ask(asked));
        assert_eq!(Request::decode(&Request::Ask(asked).encode()), Some(Request::Ask(asked)));
    }
}

#[test]
fn what_happens_on_a_link_is_decoded_as_it_was_encoded() {
    let bytes: Vec<u8> = (0..=255).collect();
    let mut arrived = Vec::new();
    let events = [
        LinkEvent::Open(Profile::Normal),
        LinkEvent::Open(Profile::Onboard),
        LinkEvent::Close,
        LinkEvent::Lost(u32::MAX),
        LinkEvent::Received(&bytes),
    ];
    for event in events {
        Signal::each(event, |signal| {
            let request = Request::Link { link: 3, signal };
            assert_survives(&request);
            match signal.event() {
                LinkEvent::Received(piece) => arrived.extend_from_slice(piece),
                other => assert_eq!(other, event),
            }
        });
    }
    assert_eq!(arrived, bytes, "in pieces, and whole");
    let mut too_long = Request::Link { link: 0, signal: Signal::Received(Piece::split(&bytes).0) }.encode();
    too_long[12] = PIECE_BYTES as u8 + 1;
    assert_eq!(Request::decode(&too_long), None);
}

#[test]
fn the_checksum_of_what_was_sent_is_fnv_1a() {
    let mut sent = Sent::default();
    assert_eq!((sent.bytes, sent.checksum), (0, 0x811c_9dc5));
    for byte in *b"foobar" {
        sent.add(byte);
    }
    // The test vector of its authors.
    assert_eq!((sent.bytes, sent.checksum), (6, 0xbf9c_f968));
}

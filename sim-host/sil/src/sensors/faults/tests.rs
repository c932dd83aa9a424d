//! Each kind of fault against the fault-free record of the same seed.

use firmware::sensors::{GnssSample, Measurements};

use super::*;
use crate::geodesy::{LocalFrame, Place};
use crate::sensors::tests::{at_rest, parts, record, truth};
use crate::sensors::{Home, Suite, SuiteFile};
use rand::{RngExt, SeedableRng, rngs::StdRng};

const SEED: u64 = 5;
const TICKS: Tick = 4000;

fn all() -> SuiteFile {
    parts("suite = \"gnss\"\npose.part = \"mocap\"")
}

/// A fault from its TOML form.
fn fault(text: &str) -> Fault {
    toml::from_str(text).expect(text)
}

fn with(text: &str) -> Vec<Measurements> {
    record(&all(), &[fault(text)], SEED, TICKS)
}

fn sound() -> Vec<Measurements> {
    record(&all(), &[], SEED, TICKS)
}

/// Asserts that a record differs from the fault-free one only in the IMU, and only from 1 s to 2 s.
fn assert_sound_but_for_the_imu(faulted: &[Measurements]) {
    for (tick, (ours, sound)) in faulted.iter().zip(&sound()).enumerate() {
        let imu = if (1000..=2000).contains(&tick) { ours.imu } else { sound.imu };
        assert_eq!(*ours, Measurements { imu, ..*sound }, "{tick}");
    }
}

#[test]
fn the_lists_of_names_are_those_that_files_know() {
    let refusal = |text: &str| {
        let table: toml::Table = text.parse().expect("TOML");
        Fault::try_from(table).expect_err("no such name")
    };
    let kinds = refusal("kind = \"?\"\nfrom_s = 0.0");
    assert!(kinds.contains(&KINDS.join(", ")), "{kinds}");
    let sensors = refusal("sensor = \"?\"\nkind = \"off\"\nfrom_s = 0.0");
    assert!(sensors.contains(&Sensor::ALL.map(Sensor::name).join(", ")), "{sensors}");
}

#[test]
fn a_sensor_that_is_off_delivers_nothing_and_comes_back_as_if_nothing_had_been() {
    let faulted = with("sensor = \"imu\"\nkind = \"off\"\nfrom_s = 1.0\nto_s = 2.0");
    assert!(faulted[1000..2000].iter().all(|m| m.imu.is_none()));
    assert_sound_but_for_the_imu(&faulted);
    let faulted = with("sensor = \"baro\"\nkind = \"off\"\nfrom_s = 1.0");
    // The last sound one was measured at 980 ms.
    assert!(faulted[1000..].iter().all(|m| m.baro.is_none()) && faulted[990].baro.is_some());
}

#[test]
fn a_sensor_that_is_stuck_repeats_its_value_with_fresh_stamps() {
    let faulted = with("sensor = \"gyro\"\nkind = \"stuck\"\nfrom_s = 1.0\nto_s = 2.0");
    let sound = sound();
    let held = sound[999].imu.expect("there").gyro;
    for tick in 1000..2000 {
        let (ours, sound) = (faulted[tick].imu.expect("there"), sound[tick].imu.expect("there"));
        assert_eq!((ours.gyro, ours.accel, ours.at), (held, sound.accel, sound.at));
    }
    assert_sound_but_for_the_imu(&faulted);
}

#[test]
fn drift_grows_from_the_onset_along_one_direction() {
    let faulted = with("sensor = \"accel\"\nkind = \"drift\"\nfrom_s = 1.0\nto_s = 2.0\nrate = 3.0");
    let sound = sound();
    let error = |tick: usize| faulted[tick].imu.expect("there").accel - sound[tick].imu.expect("there").accel;
    for tick in (1000..2000).step_by(100) {
        // An f32 of 10 m/s² resolves 1 µm/s².
        assert!((error(tick).norm() - 3e-3 * (tick - 1000) as f32).abs() < 1e-5);
    }
    assert!((error(1999).normalize() - error(1500).normalize()).norm() < 1e-5);
    assert_sound_but_for_the_imu(&faulted);
}

#[test]
fn noise_has_its_deviation() {
    let faulted = with("sensor = \"gyro\"\nkind = \"noise\"\nfrom_s = 1.0\nto_s = 2.0\nsigma = 0.5");
    let sound = sound();
    let square: f32 = (1000..2000)
        .map(|tick| (faulted[tick].imu.expect("there").gyro - sound[tick].imu.expect("there").gyro).norm_squared())
        .sum();
    // 3000 numbers: their variance is known to √(2/3000), of which 4.5.
    assert!((square / 3000.0 / 0.25 - 1.0).abs() < 0.116, "{square}");
    assert_sound_but_for_the_imu(&faulted);
}

#[test]
fn spikes_are_as_frequent_and_as_large_as_stated() {
    let text = "sensor = \"baro\"\nkind = \"spikes\"\nfrom_s = 0.0\nprobability = 0.1\nsize = 500.0";
    let (faulted, sound) = (record(&all(), &[fault(text)], SEED, 60_000), record(&all(), &[], SEED, 60_000));
    let errors = faulted.iter().zip(&sound).filter_map(|(a, b)| Some(a.baro?.pressure_pa - b.baro?.pressure_pa));
    let spikes: Vec<f32> = errors.filter(|error| *error != 0.0).collect();
    assert!(spikes.iter().all(|spike| (spike.abs() - 500.0).abs() < 0.01));
    assert!(spikes.iter().any(|spike| *spike > 0.0) && spikes.iter().any(|spike| *spike < 0.0));
    // Of 3000 samples 300 ± 4.5 √(3000 · 0.1 · 0.9).
    assert!((226..=374).contains(&spikes.len()), "{}", spikes.len());
}

#[test]
fn what_is_delayed_arrives_later_and_what_it_holds_up_is_lost() {
    let faulted = with("sensor = \"imu\"\nkind = \"delayed\"\nfrom_s = 1.0\nto_s = 2.0\nextra_s = 0.1");
    let at = |tick: usize| faulted[tick].imu.map(|imu| imu.at);
    assert!((1000..1100).all(|tick| at(tick).is_none()));
    assert!((1100..2000).all(|tick| at(tick) == Some(tick as Tick - 100)));
    assert!((2000..4000).all(|tick| at(tick) == Some(tick as Tick)));
}

#[test]
fn not_a_number_is_none() {
    let faulted = with("sensor = \"imu\"\nkind = \"nan\"\nfrom_s = 1.0\nto_s = 2.0");
    assert!(faulted[1000..2000].iter().all(|m| m.imu.is_some_and(|imu| !imu.is_plausible())));
    let faulted = with("sensor = \"accel\"\nkind = \"nan\"\nfrom_s = 1.0\nto_s = 2.0");
    let imu = faulted[1500].imu.expect("there");
    assert!(imu.gyro.iter().all(|rate| rate.is_finite()) && imu.accel.iter().all(|force| force.is_nan()));
    for sensor in ["mag", "baro", "gnss", "pose", "battery"] {
        let last = with(&format!("sensor = \"{sensor}\"\nkind = \"nan\"\nfrom_s = 0.0"));
        let spoilt = last.iter().any(|m| {
            m.mag.is_some_and(|mag| mag.field_ut.x.is_nan())
                || m.baro.is_some_and(|baro| baro.pressure_pa.is_nan())
                || m.gnss.is_some_and(|gnss| !gnss.is_usable())
                || m.pose.is_some_and(|pose| !pose.is_valid())
                || m.battery.is_some_and(|battery| battery.voltage_v.is_nan())
        });
        assert!(spoilt, "{sensor}");
    }
}

/// Distances by which solutions are off the sound ones, in the local frame, m.
fn offsets(faulted: &[Measurements]) -> Vec<(Tick, nalgebra::Vector3<f64>)> {
    let frame = LocalFrame::at(&Home::default().place());
    let place = |gnss: GnssSample| frame.position(&Place::of(&gnss.place));
    let both = faulted.iter().zip(sound()).filter_map(|(a, b)| Some((a.gnss?, b.gnss?)));
    both.map(|(a, b)| (a.at, place(a) - place(b))).collect()
}

#[test]
fn a_glitch_moves_the_place_by_its_size() {
    let drawn = offsets(&with("sensor = \"gnss\"\nkind = \"glitch\"\nfrom_s = 1.0\nto_s = 2.0\nsize_m = 50.0"));
    let north = "sensor = \"gnss\"\nkind = \"glitch\"\nfrom_s = 1.0\nto_s = 2.0\nsize_m = 50.0\ndirection = [2, 0, 0]";
    let north = offsets(&with(north));
    for ((at, drawn), (_, north)) in drawn.into_iter().zip(north) {
        if (1000..2000).contains(&at) {
            // Within the receiver's last digits, 11 mm of latitude.
            assert!((drawn.norm() - 50.0).abs() < 0.02 && drawn.z.abs() < 0.01, "{drawn}");
            assert!((north - nalgebra::Vector3::new(50.0, 0.0, 0.0)).amax() < 0.02, "{north}");
        } else {
            assert_eq!((drawn.norm(), north.norm()), (0.0, 0.0));
        }
    }
}

#[test]
fn a_receiver_without_fix_says_so() {
    let faulted = with("sensor = \"gnss\"\nkind = \"no-fix\"\nfrom_s = 1.0\nto_s = 2.0");
    let solutions = faulted.iter().filter_map(|m| m.gnss);
    assert!(solutions.clone().all(|gnss| gnss.has_fix != (1000..2000).contains(&gnss.at)));
    assert!(solutions.filter(|gnss| !gnss.has_fix).count() == 5);
}

#[test]
fn as_many_samples_are_lost_as_stated() {
    let faulted = with("sensor = \"imu\"\nkind = \"loss\"\nfrom_s = 1.0\nto_s = 2.0\nprobability = 0.3");
    let lost = faulted[1000..2000].iter().filter(|m| m.imu.is_none()).count();
    // Of 1000 samples 300 ± 4.5 √(1000 · 0.3 · 0.7).
    assert!((235..=365).contains(&lost), "{lost}");
}

#[test]
fn a_duplicate_is_the_sample_before_with_its_stamp() {
    let faulted = with("sensor = \"imu\"\nkind = \"duplicate\"\nfrom_s = 1.0\nto_s = 2.0\nprobability = 0.3");
    let sound = sound();
    let mut duplicates = 0;
    for tick in 1000..2000 {
        if faulted[tick].imu != sound[tick].imu {
            assert_eq!(faulted[tick].imu, faulted[tick - 1].imu);
            duplicates += 1;
        }
    }
    assert!((235..=365).contains(&duplicates), "{duplicates}");
    assert_sound_but_for_the_imu(&faulted);
}

#[test]
fn disorder_swaps_each_two_samples() {
    let faulted = with("sensor = \"imu\"\nkind = \"disorder\"\nfrom_s = 1.0\nto_s = 2.0");
    let at: Vec<Option<Tick>> = faulted[1000..1006].iter().map(|m| m.imu.map(|imu| imu.at)).collect();
    assert_eq!(at, [None, Some(1001), Some(1000), Some(1003), Some(1002), Some(1005)]);
    assert_sound_but_for_the_imu(&faulted);
}

#[test]
fn a_jump_in_time_shifts_stamps() {
    let faulted = with("sensor = \"mag\"\nkind = \"time-jump\"\nfrom_s = 1.0\nto_s = 2.0\nshift_s = -0.5");
    let pairs = faulted.iter().zip(sound()).filter_map(|(a, b)| Some((a.mag?, b.mag?)));
    for (ours, sound) in pairs {
        let shift = if (1000..2000).contains(&sound.at) { 500 } else { 0 };
        assert_eq!((ours.at, ours.field_ut), (sound.at - shift, sound.field_ut));
    }
    let early = with("sensor = \"imu\"\nkind = \"time-jump\"\nfrom_s = 0.0\nto_s = 0.1\nshift_s = -0.5");
    assert_eq!(early[50].imu.expect("there").at, 0);
}

#[test]
fn rotors_and_battery_fail_by_the_schedule() {
    let faults = [
        fault("kind = \"rotor\"\nindex = 2\neffectiveness = 0.25\nfrom_s = 1.0\nto_s = 2.0"),
        fault("kind = \"collapse\"\nfactor = 0.7\nfrom_s = 1.5"),
    ];
    let faults = Faults::new(&faults, 1);
    assert_eq!(faults.rotor_effectiveness(999), [1.0; ROTORS]);
    assert_eq!(faults.rotor_effectiveness(1000), [1.0, 1.0, 0.25, 1.0]);
    assert_eq!(faults.rotor_effectiveness(2000), [1.0; ROTORS]);
    assert_eq!((faults.battery_factor(1499), faults.battery_factor(1500)), (1.0, 0.7));
    assert_eq!(record(&all(), &[fault("kind = \"collapse\"\nfactor = 0.7\nfrom_s = 0.0")], SEED, TICKS), sound());
}

#[test]
fn of_several_faults_of_a_rotor_or_the_battery_the_one_that_began_last_acts() {
    let mut faults = Faults::new(
        &[
            fault("kind = \"rotor\"\nindex = 0\neffectiveness = 0.5\nfrom_s = 2.0\nto_s = 3.0"),
            fault("kind = \"rotor\"\nindex = 0\neffectiveness = 0.8\nfrom_s = 1.0"),
            fault("kind = \"collapse\"\nfactor = 0.7\nfrom_s = 1.0"),
            fault("kind = \"collapse\"\nfactor = 0.9\nfrom_s = 2.0"),
        ],
        1,
    );
    let rotor = |faults: &Faults, tick| faults.rotor_effectiveness(tick)[0];
    assert_eq!([1500, 2500, 3500].map(|tick| rotor(&faults, tick)), [0.8, 0.5, 0.8]);
    assert_eq!([1500, 2500].map(|tick| faults.battery_factor(tick)), [0.7, 0.9]);
    faults.inject(&Fault::starting(None, Kind::Rotor { index: 0, effectiveness: 1.0 }, 2600)).expect("fits");
    assert_eq!(rotor(&faults, 2700), 1.0, "it is given back");
    faults.clear_where(|fault| matches!(fault.kind, Kind::Rotor { .. }));
    assert_eq!((rotor(&faults, 1500), faults.battery_factor(2500)), (1.0, 0.9));
}

#[test]
fn a_fault_can_be_started_and_ended_while_flying() {
    let motion = at_rest();
    let mut suite = Suite::new(&all(), &Home::default(), &[], SEED);
    let (mut id, sound) = (None, sound());
    for tick in 0..300 {
        match tick {
            100 => id = Some(suite.inject(&Fault::starting(Some(Sensor::Imu), Kind::Off {}, 100)).expect("fits")),
            200 => suite.clear(id.take().expect("started")),
            _ => {}
        }
        let imu = suite.measure(&truth(tick, &motion)).imu;
        assert_eq!(imu, sound[tick as usize].imu.filter(|_| !(100..200).contains(&tick)));
    }
    let nothing = Fault::starting(None, Kind::Off {}, 0);
    assert!(suite.inject(&nothing).is_err());
    let off = Fault::starting(Some(Sensor::Imu), Kind::Off {}, 0);
    assert!((0..SPARE).all(|_| suite.inject(&off).is_ok()));
    assert!(suite.inject(&off).is_err());
    suite.clear_all();
    assert!(suite.measure(&truth(300, &motion)).imu.is_some());
}

#[test]
fn a_fault_does_not_change_what_another_draws() {
    let noise = fault("sensor = \"gyro\"\nkind = \"noise\"\nfrom_s = 0.0\nsigma = 0.5");
    let spikes = fault("sensor = \"gyro\"\nkind = \"spikes\"\nfrom_s = 0.0\nprobability = 0.0\nsize = 1.0");
    assert_eq!(record(&all(), &[noise, spikes], SEED, 500), record(&all(), &[noise], SEED, 500));
}

#[test]
fn a_fault_is_written_as_it_is_read() {
    for text in [
        "sensor = \"gnss\"\nkind = \"glitch\"\nfrom_s = 20\nto_s = 30\nsize_m = 50",
        "sensor = \"accel\"\nkind = \"drift\"\nfrom_s = 20.0\nrate = 0.1\ndirection = [0.0, 0.0, 1.0]",
        "kind = \"rotor\"\nindex = 1\neffectiveness = 0.0\nfrom_s = 3.0",
        "sensor = \"imu\"\nkind = \"off\"\nfrom_s = 0.0",
    ] {
        let read = fault(text);
        assert_eq!(fault(&toml::to_string(&read).expect("writes")), read);
    }
}

#[test]
fn a_fault_that_cannot_be_is_refused_by_its_key() {
    for (text, culprit) in [
        ("sensor = \"imu\"\nkind = \"off\"", "from_s"),
        ("kind = \"off\"\nfrom_s = 1.0", "`fault.sensor` is missing"),
        ("sensor = \"imu\"\nkind = \"off\"\nfrom_s = 1.0\nsize = 1.0", "size"),
        ("sensor = \"imu\"\nkind = \"drift\"\nfrom_s = 1.0\nrate = 1.0", "`imu`"),
        ("sensor = \"gyro\"\nkind = \"off\"\nfrom_s = 1.0", "`gyro`"),
        ("sensor = \"mag\"\nkind = \"glitch\"\nfrom_s = 1.0\nsize_m = 1.0", "`mag`"),
        ("sensor = \"radar\"\nkind = \"off\"\nfrom_s = 1.0", "radar"),
        ("sensor = \"gnss\"\nkind = \"drift\"\nfrom_s = 1.0", "rate"),
        ("sensor = \"gnss\"\nkind = \"off\"\nfrom_s = 2.0\nto_s = 1.0", "`fault.to_s`"),
        ("sensor = \"gnss\"\nkind = \"loss\"\nfrom_s = 2.0\nprobability = 1.5", "`fault.probability`"),
        ("sensor = \"gnss\"\nkind = \"delayed\"\nfrom_s = 2.0\nextra_s = 5.0", "`fault.extra_s`"),
        ("sensor = \"pose\"\nkind = \"drift\"\nfrom_s = 2.0\nrate = 1.0\ndirection = [0, 0, 0]", "`fault.direction`"),
        ("kind = \"rotor\"\nindex = 4\neffectiveness = 0.0\nfrom_s = 3.0", "`fault.index`"),
        ("kind = \"collapse\"\nfactor = nan\nfrom_s = 3.0", "`fault.factor`"),
    ] {
        let error = toml::from_str::<Fault>(text).expect_err(text).to_string();
        assert!(error.contains(culprit), "{text}: {error}");
    }
}

/// A kind of fault with random values.
fn any_kind(rng: &mut StdRng) -> Kind {
    let probability = rng.random_range(0.0..=1.0);
    let size = rng.random_range(-1e6..1e6);
    let direction = rng.random::<bool>().then(|| core::array::from_fn(|_| rng.random_range(0.1..1.0)));
    match rng.random_range(0..15) {
        0 => Kind::Off {},
        1 => Kind::Stuck {},
        2 => Kind::Drift { rate: size, direction },
        3 => Kind::Noise { sigma: size.abs() },
        4 => Kind::Spikes { probability, size },
        5 => Kind::Delayed { extra_s: probability },
        6 => Kind::Nan {},
        7 => Kind::Glitch { size_m: size, direction },
        8 => Kind::NoFix {},
        9 => Kind::Loss { probability },
        10 => Kind::Duplicate { probability },
        11 => Kind::Disorder {},
        12 => Kind::TimeJump { shift_s: size },
        13 => Kind::Rotor { index: rng.random_range(0..ROTORS), effectiveness: probability },
        _ => Kind::Collapse { factor: probability },
    }
}

/// A valid fault within the first second.
fn any_fault(rng: &mut StdRng) -> Fault {
    use Sensor::{Accel, Baro, Battery, Gnss, Gyro, Imu, Mag, Pose};
    loop {
        let sensor = [Imu, Gyro, Accel, Mag, Baro, Gnss, Pose, Battery].get(rng.random_range(0..9)).copied();
        let from_s = rng.random_range(0.0..1.0);
        let to_s = rng.random::<bool>().then(|| from_s + rng.random_range(0.0..0.5));
        let fault = Fault { sensor, kind: any_kind(rng), from_s, to_s };
        if fault.validate().is_ok() {
            return fault;
        }
    }
}

#[test]
fn no_schedule_of_faults_panics_and_what_is_not_faulted_is_sound() {
    let mut rng = StdRng::seed_from_u64(1);
    let sound = record(&all(), &[], SEED, 1500);
    for _ in 0..200 {
        let faults: Vec<Fault> = (0..rng.random_range(0..12)).map(|_| any_fault(&mut rng)).collect();
        let faulted = record(&all(), &faults, SEED, 1500);
        let is_faulted = |channel| faults.iter().any(|f| f.sensor.map(Sensor::channel) == Some(channel));
        for (ours, sound) in faulted.iter().zip(&sound) {
            assert!(is_faulted(Sensor::Imu) || ours.imu == sound.imu);
            assert!(is_faulted(Sensor::Mag) || ours.mag == sound.mag);
            assert!(is_faulted(Sensor::Baro) || ours.baro == sound.baro);
            assert!(is_faulted(Sensor::Gnss) || ours.gnss == sound.gnss);
            assert!(is_faulted(Sensor::Pose) || ours.pose == sound.pose);
            assert!(is_faulted(Sensor::Battery) || ours.battery == sound.battery);
        }
    }
}

use firmware::failure::Failure;

use super::*;
use crate::flight;
use crate::scenario::Scenario;
use crate::sensors::faults::{Kind, SLOTS};
use crate::sil::Lockstep as _;
use crate::sil::failures::{injectable, of};

fn read(line: &str) -> Result<Fault> {
    parse(line.split_whitespace(), 1500)
}

fn fault(line: &str) -> Fault {
    read(line).expect(line)
}

#[test]
fn a_sensor_is_offered_no_faults_of_rotors() {
    let offered = |line: &str| parse(line.split_whitespace(), 0).expect_err("no kind").to_string();
    assert!(
        offered("gnss")
            .ends_with("kind=off|stuck|drift|noise|spikes|delayed|nan|glitch|no-fix|loss|duplicate|disorder|time-jump")
    );
    assert!(offered("").ends_with("|time-jump|rotor|collapse"));
}

#[test]
fn lines_are_the_faults_of_files_from_now_on() {
    let rotor = fault("kind=rotor index=0 effectiveness=0.5");
    assert_eq!(rotor.kind, Kind::Rotor { index: 0, effectiveness: 0.5 });
    assert_eq!((rotor.from_s, rotor.to_s, rotor.sensor), (1.5, None, None));
    let gnss = fault("  sensor=gnss kind=glitch size_m=50 direction=[1,0,0] from_s=20 to_s=30 ");
    assert_eq!(gnss.kind, Kind::Glitch { size_m: 50.0, direction: Some([1.0, 0.0, 0.0]) });
    assert_eq!((gnss.from_s, gnss.to_s), (20.0, Some(30.0)));
}

#[test]
fn names_alone_are_enough_in_any_order() {
    assert_eq!(fault("gnss off"), fault("sensor=gnss kind=off"));
    assert_eq!(fault("stuck baro"), fault("kind=stuck sensor=baro"));
    assert_eq!(fault("rotor index=1 effectiveness=0"), fault("kind=rotor index=1 effectiveness=0.0"));
}

#[test]
fn motors_fail_as_in_px4() {
    for (number, index) in [(1, 0), (4, 3)] {
        let kind = Kind::Rotor { index, effectiveness: 0.0 };
        assert_eq!(fault(&format!("motor off -i {number}")), Fault::starting(None, kind, 1500));
    }
    assert_eq!(fault("motor off index=2"), fault("rotor index=2 effectiveness=0"));
    assert_eq!(fault("gps off -i 1"), fault("gnss off"));
    assert_eq!(fault("mag stuck"), fault("sensor=mag kind=stuck"));
}

#[test]
fn other_units_fail_as_mavlink_has_it() {
    for (px4, ours) in [
        ("motor slow -i 1", "rotor index=0 effectiveness=0.7"),
        ("gps wrong", "gnss glitch size_m=50"),
        ("gps wrong size_m=20 to_s=30", "gnss glitch size_m=20 to_s=30"),
        ("accel garbage", "accel noise sigma=10"),
        ("gyro garbage -i 1", "gyro noise sigma=1"),
        ("mag garbage", "mag noise sigma=50"),
        ("baro delayed", "baro delayed extra_s=0.5"),
        ("baro delayed extra_s=0.1", "baro delayed extra_s=0.1"),
        ("baro intermittent", "baro loss probability=0.7"),
        ("battery off", "sensor=battery kind=off"),
    ] {
        assert_eq!(fault(px4), fault(ours), "{px4}");
    }
}

#[test]
fn with_what_a_kind_needs_it_is_a_fault() {
    for kind in KINDS {
        let keys: Vec<String> = needs(kind).map(|key| format!("{key}=1")).collect();
        let sensor = if matches!(kind, "rotor" | "collapse") { "" } else { "gnss" };
        fault(&format!("{sensor} {kind} {}", keys.join(" ")));
    }
}

#[test]
fn what_is_listed_can_be_typed_again() {
    for line in ["gnss off", "collapse factor=0.85 from_s=3 to_s=5", "gnss glitch size_m=5"] {
        let asked = fault(line);
        assert_eq!(fault(&describe(&asked)), asked, "{}", describe(&asked));
    }
}

#[test]
fn bad_lines_are_refused_by_what_is_wrong_with_them() {
    for (line, culprit) in [
        ("rotor index=0", "`rotor` needs `effectiveness=…`"),
        ("rotor index=1 effectivness=0.5", "`effectivness` is no key: did you mean `effectiveness`?"),
        ("gnss off from=10 to=20", "`from` is no key: did you mean `from_s`?"),
        ("gnss off size=3", "`size` is no key: use sensor, kind, from_s, to_s"),
        ("gnss drift rate=1 colour=3", "`colour` is no key: use rate, direction, sensor, kind, from_s, to_s"),
        ("rotor index=0 0.5", "`0.5` has no key: write `effectiveness=0.5`"),
        ("rotor index=9 effectiveness=0", "`index` must be between 0 and 3, not 9"),
        ("motor 1", "say which rotor (index=0 is rotor 1)"),
        ("motor off", "say which rotor (index=0 is rotor 1)"),
        ("motor slow", "say which rotor (index=0 is rotor 1): "),
        ("motor garbage -i 1", "`garbage` does not go with `motor`: use off, slow"),
        ("gps slow", "`slow` does not go with `gps`: use off, stuck, garbage, wrong, delayed, intermittent"),
        ("gyro wrong", "`wrong` does not go with `gyro`: use stuck, garbage"),
        ("accel off", "`off` does not go with the sensor `accel`"),
        ("motor off -i 5", "`-i` counts from 1 to 4"),
        ("motor off -i", "`-i` counts from 1 to 4"),
        ("motor off -i 1 index=0", "`index` is given twice, as `0` and `0`"),
        ("gps off -i 2", "there is one of it alone: leave out `-i 2`"),
        ("collapse 0.7", "`0.7` has no key: write `factor=0.7`"),
        ("collapse", "`collapse` needs `factor=…`"),
        ("gnss spikes 1", "`spikes` needs `probability=…` and `size=…`"),
        ("gnss off 3", "`3` is too much: the times are `from_s=` and `to_s=`"),
        ("explode", "`explode` is no sensor and no kind"),
        ("", "kind="),
        ("sensor=gnss", "kind="),
        ("sensor=gps kind=off", "there is no sensor `gps`: use one of imu"),
        ("gns off", "did you mean `gnss`?"),
        ("gnss kind=stck", "there is no kind of fault `stck`: did you mean `stuck`?"),
        ("gnss off stuck", "`kind` is given twice"),
        ("sensor=gyro kind=off", "gyro"),
        ("rotor index=9 effectiveness=0.5", "index"),
        ("sensor=gnss kind=off colour=1", "colour"),
    ] {
        let error = format!("{:#}", read(line).expect_err(line));
        assert!(error.contains(culprit) && !error.contains('\n'), "{line}: {error}");
    }
}

#[test]
fn whatever_may_be_asked_for_is_done_and_is_a_valid_fault() {
    let scenario = Scenario::load("field", &[]).expect("built in");
    let flight = flight::lockstep(&scenario, 1, flight::rigid_body(&scenario, 1)).expect("flies");
    let injectable = injectable(flight.sensors(), true);
    let mut slots = Vec::new();
    for unit in Unit::ALL {
        for manner in Manner::ALL.into_iter().filter(|manner| injectable.allows(unit, *manner)) {
            let done: Vec<_> = of(&Failure { unit, manner, instance: None }, 1000).collect();
            assert_eq!(done.len(), usize::from(injectable.count(unit)), "{unit:?} {manner:?}");
            for (slot, fault) in done {
                assert_eq!(fault.is_none(), manner == Manner::Well, "{unit:?} {manner:?}");
                if let Some(fault) = fault {
                    fault.validate().expect("a fault");
                }
                slots.push(slot);
            }
        }
    }
    slots.sort_unstable();
    slots.dedup();
    assert_eq!(slots, (0..SLOTS).collect::<Vec<_>>());
}

#[test]
fn the_present_time_is_told_with_three_decimals() {
    let error = parse("gnss off to_s=5".split_whitespace(), 20_519).expect_err("in the past").to_string();
    assert_eq!(error, "`to_s` must be after `from_s`, 20.519 s, not 5: from 20.519 to 5 s runs backwards");
}

#[test]
fn a_failure_takes_the_place_of_the_one_before_and_can_be_taken_back() {
    let scenario = Scenario::load("field", &[]).expect("built in");
    let mut flight = flight::lockstep(&scenario, 1, flight::rigid_body(&scenario, 1)).expect("flies");
    let count = |flight: &crate::sil::Flight<_>| flight.sensors().map(|suite| suite.faults().list(0).count());
    for (manner, faults) in [(Manner::Off, 1), (Manner::Stuck, 1), (Manner::Well, 0)] {
        for (slot, fault) in of(&Failure { unit: Unit::Gnss, manner, instance: None }, 0) {
            flight.hold_fault(slot, fault.as_ref()).expect("on sensors");
        }
        assert_eq!(count(&flight), Some(faults), "{manner:?}");
    }
}

#[test]
fn ideal_state_has_nothing_to_fail() {
    assert!(injectable(None, true).is_none());
    let scenario = Scenario::load("pad", &[]).expect("built in");
    let mut flight = flight::lockstep(&scenario, 1, flight::rigid_body(&scenario, 1)).expect("flies");
    let refusal = flight.inject(&fault("sensor=gnss kind=off")).expect_err("ideal");
    assert!(refusal.to_string().contains("sensors"), "{refusal}");
    let refusal = flight.inject(&fault("kind=collapse factor=0.5")).expect_err("no battery");
    assert!(refusal.to_string().contains("battery"), "{refusal}");
}

#[test]
fn rotors_and_battery_go_by_what_is_commanded() {
    let scenario = Scenario::load("field", &[]).expect("built in");
    let mut flight = flight::lockstep(&scenario, 1, flight::rigid_body(&scenario, 1)).expect("flies");
    let volts = |flight: &crate::sil::Flight<crate::plant::rigid_body::RigidBody>| {
        crate::plant::Plant::battery(flight.plant()).map_or(0.0, |battery| battery.voltage_v)
    };
    flight.step(&mut ());
    let (lift, full) = (flight.plant().constants().geometry[(0, 2)], volts(&flight));
    flight.inject(&fault("kind=rotor index=2 effectiveness=0.5 from_s=0")).expect("a fault");
    flight.inject(&fault("kind=collapse factor=0.8 from_s=0")).expect("a fault");
    flight.step(&mut ());
    let left = flight.plant().constants().geometry[(0, 2)] / lift;
    assert!((left - 0.5).abs() < 1e-3 && (volts(&flight) / full - 0.8).abs() < 1e-3, "{left} {}", volts(&flight));
    flight.clear_faults().expect("on sensors");
    flight.step(&mut ());
    let left = flight.plant().constants().geometry[(0, 2)] / lift;
    assert!((left - 1.0).abs() < 1e-3 && (volts(&flight) / full - 1.0).abs() < 1e-3, "{left} {}", volts(&flight));
}

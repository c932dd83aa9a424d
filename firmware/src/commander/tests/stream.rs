//! What a stream of set-points lifts, and brings down.

use super::*;
use crate::guidance::stream::Motion;
use crate::latest::{SetPoint, Stamped};

/// A vehicle at a height, m, with a thrust in parts of its weight, and a set-point at another height.
fn streamed(height_m: f32, weights: f32, wanted_m: f32) -> CommanderInput {
    let mut input = standing();
    input.nav.position.z = height_m;
    input.thrust_n = weights * FlightConfig::default().airframe.weight_n();
    let motion = Motion::default().with_position([Some(0.0), Some(0.0), Some(wanted_m)]);
    input.latest.setpoint = Some(Stamped { value: SetPoint::Motion { motion, sent_ms: None }, at: 0 });
    input
}

/// Armed in offboard mode, on ground at this height, m.
fn armed_at(ground_m: f32, spool_up_s: f32) -> Bench {
    let mut bench = Bench::new(State::Disarmed);
    bench.commander.set(crate::settings::COM_SPOOLUP_TIME, Value::Real(spool_up_s));
    let stands = streamed(ground_m, 0.0, ground_m);
    assert_eq!(bench.ask(Request::Offboard, &stands), Outcome::Accepted);
    assert_eq!(bench.ask(ARM, &stands), Outcome::Accepted);
    bench
}

#[test]
fn a_set_point_lifts_nothing_before_the_rotors_have_spun_up() {
    let mut bench = armed_at(0.0, 1.0);
    let up = streamed(0.0, 0.0, 5.0);
    bench.run(0.9, &up);
    assert_eq!(bench.step(&up).mode, Mode::Idle);
    bench.run(0.1, &up);
    assert_eq!(bench.step(&up).mode, Mode::Offboard);
}

#[test]
fn a_set_point_at_the_ground_lands_the_vehicle_however_high_the_ground_is() {
    for ground_m in [-30.0, 0.0, 50.0] {
        let mut bench = armed_at(ground_m, 0.0);
        let high = ground_m + 5.0;
        bench.run(0.2, &streamed(ground_m, 1.2, high));
        bench.run(1.0, &streamed(high, 1.0, high));
        assert_eq!(bench.step(&streamed(high, 1.0, high)).mode, Mode::Offboard);
        // Against a branch, at rest and with little thrust: it is not told to come down.
        bench.run(1.0, &streamed(high, 0.5, high));
        assert_eq!(bench.step(&streamed(high, 0.5, high)).mode, Mode::Offboard, "ground at {ground_m} m");
        let lies = streamed(ground_m, 0.5, ground_m + 0.05);
        bench.run(1.0, &lies);
        assert_eq!(bench.step(&lies).mode, Mode::Idle, "ground at {ground_m} m");
    }
}

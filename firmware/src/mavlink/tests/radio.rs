//! A radio's channels as sticks and switches.

use glissade_dialect::RC_CHANNELS_OVERRIDE_DATA;

use super::sticks::OVERRIDE;
use super::*;
use crate::latest::Sticks;
use crate::settings::{Value, find};

/// Sticks in the middle, with every channel's usual scale: 1000, 1500 and 2000 µs, and 10 µs about the centre.
const CENTRED: RC_CHANNELS_OVERRIDE_DATA =
    RC_CHANNELS_OVERRIDE_DATA { chan1_raw: 1500, chan2_raw: 1500, chan3_raw: 1500, chan4_raw: 1500, ..OVERRIDE };

fn set(bench: &mut Bench, name: &str, value: Value) {
    let index = find(name).expect("in the table");
    bench.ground.settings.set(index, value, true).expect("in flight");
}

fn moved(bench: &mut Bench, message: &RC_CHANNELS_OVERRIDE_DATA) -> Sticks {
    bench.output_of(&frame(message)).0.latest.sticks.expect("sticks").value
}

#[test]
fn a_channel_goes_to_the_right_forward_and_up_with_its_pulse_unless_it_is_reversed() {
    // (1755 − 1500 − 10) µs are half of (2000 − 1500 − 10); a throttle has no centre.
    let (right, forward, up) = (
        RC_CHANNELS_OVERRIDE_DATA { chan1_raw: 1755, chan4_raw: 1755, ..CENTRED },
        RC_CHANNELS_OVERRIDE_DATA { chan2_raw: 1755, ..CENTRED },
        RC_CHANNELS_OVERRIDE_DATA { chan3_raw: 1750, ..CENTRED },
    );
    for (direction, sign, throttle) in [(1.0, 1.0, 0.75), (-1.0, -1.0, 0.25)] {
        let mut bench = Bench::silent();
        for name in ["RC1_REV", "RC2_REV", "RC3_REV", "RC4_REV"] {
            set(&mut bench, name, Value::Real(direction));
        }
        let Sticks { roll, pitch, yaw, .. } = moved(&mut bench, &right);
        // A rotation to the right is a positive roll, and a negative yaw.
        assert_eq!((roll, pitch, yaw), (0.5 * sign, 0.0, -0.5 * sign));
        assert_eq!(moved(&mut bench, &forward).pitch, 0.5 * sign);
        assert_eq!(moved(&mut bench, &up).throttle, throttle);
    }
}

#[test]
fn a_kill_switch_kills_when_it_is_turned_on_and_not_again_while_it_stays_on() {
    let mut bench = Bench::silent();
    set(&mut bench, "RC_MAP_KILL_SW", Value::Int(7));
    for (chan7_raw, kills) in
        [(1000, false), (1900, true), (1900, false), (2000, false), (1100, false), (1100, false), (1900, true)]
    {
        let switched = RC_CHANNELS_OVERRIDE_DATA { chan7_raw, ..CENTRED };
        let output = bench.output_of(&frame(&switched)).0;
        let is_on = output.latest.kill_switch;
        assert_eq!((is_on, output.kill), (chan7_raw > 1500, kills), "{chan7_raw} µs");
    }
}

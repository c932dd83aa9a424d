//! For any requests and failures: directives are finite, nothing stops the rotors in the air, and nothing but a recent
//! request makes the vehicle leave the ground.

use proptest::prelude::*;

use super::*;

fn any_number() -> impl Strategy<Value = f32> {
    prop_oneof![8 => -50.0..50.0_f32, 1 => any::<f32>()]
}

fn any_request() -> impl Strategy<Value = Request> {
    let number = any_number;
    prop_oneof![
        any::<bool>().prop_map(|force| Request::Arm { force }),
        Just(Request::Disarm),
        number().prop_map(|height_m| Request::TakeOff { height_m }),
        Just(Request::Hold),
        ([number(), number(), number()], number())
            .prop_map(|(position_m, yaw_rad)| Request::GoTo(Goal::at(position_m, yaw_rad))),
        ([number(), number(), number()], number())
            .prop_map(|(velocity_m_s, yaw_rate_rad_s)| Request::Velocity { velocity_m_s, yaw_rate_rad_s }),
        Just(Request::Land),
        Just(Request::Return),
        Just(Request::Follow),
    ]
}

/// Inputs that hold for some jobs, in the air or near the ground.
fn any_input() -> impl Strategy<Value = (CommanderInput, u16)> {
    let health = prop::collection::vec(prop::bool::weighted(0.85), 6);
    let motion = ([-5.0..5.0_f32, -5.0..5.0_f32, -0.2..20.0_f32], prop_oneof![Just(0.0), -3.0..3.0_f32]);
    let rest = (0.0..1.3_f32, 12.0..16.0_f32, prop::bool::weighted(0.95), prop::option::weighted(0.02, 0..4_u8));
    (health, motion, rest, prop::option::weighted(0.7, any_request()), 1..120_u16).prop_map(
        |(h, (position, vz), (thrust, volt, nav_fresh, failed_rotor), request, jobs)| {
            let mut input = standing();
            input.health =
                NavHealth { attitude: h[0], heading: h[1], velocity: h[2], position: h[3], height: h[4], climb: h[5] };
            input.nav.position = position.into();
            input.nav.velocity.z = vz;
            input.thrust_n = thrust * FlightConfig::default().airframe.weight_n();
            (input.nav_fresh, input.failed_rotor) = (nav_fresh, failed_rotor);
            let input = volts(volt, &input);
            (request.map_or(input.clone(), |request| asking(request, &input)), jobs)
        },
    )
}

proptest! {
    #[test]
    fn only_a_recent_request_launches_the_vehicle(inputs in prop::collection::vec(any_input(), 1..40)) {
        let mut bench = Bench::new(State::Disarmed);
        let (mut rested, mut asked) = (true, None);
        for (input, jobs) in inputs {
            // On the ground throughout, so that arming is possible.
            let nav = standing().nav;
            let mut input = CommanderInput { nav, nav_fresh: true, health: NavHealth::ALL, thrust_n: 0.0, ..input };
            for _ in 0..jobs {
                let launch = |command: &Command| matches!(command.request, Request::TakeOff { .. } | Request::Follow);
                if input.commands.iter().any(launch) {
                    asked = Some(bench.tick);
                }
                let now = bench.tick;
                let output = bench.step(&input);
                input.commands.clear();
                let rests = matches!(output.directive, Directive::Stop | Directive::Idle);
                if rested && !rests {
                    prop_assert!(asked.is_some_and(|at| now - at <= ticks(LAUNCH_HELD_S)), "{:?}", output);
                }
                rested = rests;
            }
        }
    }

    #[test]
    fn whatever_comes_directives_are_finite_and_nothing_stops_the_rotors_in_the_air(
        inputs in prop::collection::vec(any_input(), 1..40),
    ) {
        let mut bench = Bench::new(State::Idle { disarm_at: None });
        let mut before = bench.step(&standing());
        for (input, jobs) in inputs {
            for job in 0..jobs {
                let mut input = input.clone();
                if job > 0 {
                    input.commands.clear();
                }
                let output = bench.step(&input);
                prop_assert!(output.directive.is_finite(), "{:?}", output);
                prop_assert_eq!(output.armed, output.directive != Directive::Stop);
                if before.armed && !before.landed && !output.armed {
                    prop_assert_eq!(output.event, Some(Event::SensorsGone), "{:?}", before);
                }
                // Rotors idle in the air only where they stood still before, armed by force while falling; and where it seems to
                // stand near the ground.
                if before.armed && !before.landed && output.directive == Directive::Idle {
                    let comes_down = matches!(before.directive, Directive::Descend { .. } | Directive::Idle);
                    let may = comes_down || output.ground_m == input.nav.position.z;
                    prop_assert!(may, "{:?}", before);
                }
                before = output;
            }
        }
    }
}

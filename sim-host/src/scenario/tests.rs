use super::*;

fn refusal(name: &str, settings: &[&str]) -> String {
    let settings: Vec<String> = settings.iter().map(|s| (*s).to_owned()).collect();
    let error = Scenario::load(name, &settings).expect_err("must be refused");
    let text = format!("{error:#}");
    assert!(!text.contains('\n'), "{text}");
    text
}

#[test]
fn every_built_in_scenario_loads() {
    assert_eq!(list().expect("all load").len(), SCENARIOS.len());
}

#[test]
fn bad_input_is_one_line_that_names_the_culprit() {
    assert!(refusal("helicks", &[]).contains("helicks"));
    assert!(refusal("helix", &["airframe=papper"]).contains("papper"));
    assert!(refusal("helix", &["airframe.mass_kg=-1"]).contains("mass_kg"));
    assert!(refusal("helix", &["airframe.mass_kg=nan"]).contains("mass_kg"));
    assert!(refusal("helix", &["control.roll.lambda=nan"]).contains("control.roll"));
    assert!(refusal("helix", &["colour=1"]).contains("colour"));
    assert!(refusal("helix", &["control.roll.colour=1"]).contains("colour"));
    assert!(refusal("helix", &["duration_s=soon"]).contains("duration_s"));
    assert!(refusal("helix", &["duration_s"]).contains("KEY=VALUE"));
    assert!(refusal("helix", &["modes.colour=1"]).contains("colour"));
    assert!(refusal("helix", &["modes.cruise_m_s=0"]).contains("modes.cruise_m_s"));
    assert!(refusal("helix", &["modes.cruise_m_s=\"fast\""]).contains("cruise_m_s"));
    assert!(refusal("/nowhere/x.toml", &[]).contains("/nowhere/x.toml"));
}

#[test]
fn numbers_with_which_no_flight_makes_sense_are_refused_by_their_key() {
    for (scenario, setting, culprit) in [
        ("helix", "time_optimal_s=nan", "time_optimal_s"),
        ("helix", "duration_s=0.0001", "duration_s"),
        ("paper-ideal", "duration_s=50000", "duration_s"),
        ("helix", "trajectory.helix.yaw_rad=1e30", "yaw_rad"),
        ("helix", "trajectory.helix.rate_rad_s=1e4", "rate_rad_s"),
        ("helix", "trajectory.helix.base_m=1e38", "base_m"),
        ("helix", "join.duration_s=1e9", "join.duration_s"),
        ("helix", "thrust_to_weight=1e30", "thrust_to_weight"),
        ("helix", "airframe.mass_kg=1e-40", "mass_kg"),
        ("helix", "control.x.lambda=1e38", "control.x"),
        ("paper-disturbed", "duration_s=3", "disturbance"),
        ("paper-disturbed", "disturbance.to_s=4", "disturbance"),
        ("paper-disturbed", "disturbance.hold_s=0.0014", "hold_s"),
        ("paper-disturbed", "disturbance.position_output_m=-0.1", "position_output_m"),
        ("paper-ideal", "ground=true", "ground"),
        ("helix", "truth.mass_factor=0", "truth.mass_factor"),
        ("helix", "truth.inertia_factor=nan", "truth.inertia_factor"),
        ("helix", "truth.rotor_effectiveness=[1,1,1,-1]", "truth.rotor_effectiveness"),
        ("helix", "truth.rotor_effectiveness=[0,0,0,0]", "truth.rotor_effectiveness"),
        ("helix", "truth.rotor_lag_s=-1", "truth.rotor_lag_s"),
        ("helix", "truth.colour=1", "colour"),
        ("helix", "true_mass_kg=1", "true_mass_kg"),
        ("helix", "actuation_delay_s=0.0005", "actuation_delay_s"),
        ("helix", "actuation_delay_s=0.017", "actuation_delay_s"),
        ("helix", "airframe.actuation_delay_s=-0.001", "actuation_delay_s"),
        ("helix", "start_velocity_m_s=[1e3,0,0]", "start_velocity_m_s"),
        ("helix", "start_rates_rad_s=[0,nan,0]", "start_rates_rad_s"),
        ("helix", "tumble={rate_rad_s=-1.0,speed_m_s=0.0}", "tumble.rate_rad_s"),
        ("helix", "wind.turbulence_20ft_m_s=-1", "wind.turbulence_20ft_m_s"),
        ("helix", "wind.airspeed_m_s=0", "wind.airspeed_m_s"),
        ("helix", "wind.mean_m_s=[0,0,inf]", "wind.mean_m_s"),
        ("helix", "wind.gust=[{from_s=1.0,rise_s=0.0,peak_m_s=[1.0,0.0,0.0]}]", "wind.gust.0.rise_s"),
        ("helix", "wind.gust=[{from_s=1.0,rise_s=1.0,peak_m_s=[1e3,0.0,0.0]}]", "wind.gust.0.peak_m_s"),
        ("helix", "push=[{from_s=1.0,to_s=1.0}]", "push.0.to_s"),
        ("helix", "push=[{from_s=1.0,to_s=2.0,acceleration_m_s2=[0.0,nan,0.0]}]", "push.0.acceleration_m_s2"),
        ("helix", "push=[{from_s=1.0,to_s=2.0,colour=1.0}]", "colour"),
        ("helix", "world.altitude_m=2e4", "world.altitude_m"),
        ("pad", "world.ground_effect=true", "rotor_radius_m"),
        ("pad", "world.ground_height_m=1", "world.ground_height_m"),
        ("helix", "world.ground_height_m=-1", "ground"),
        ("x500-hover", "world.ground_effect=true", "ground"),
        ("helix", "world.rotor_lag_down=true", "rotor_lag_down_s"),
        ("helix", "battery.soc=0.5", "airframe.battery"),
        ("x500-hover", "battery.soc=1.1", "battery.soc"),
        ("x500-hover", "fault=[{kind=\"collapse\",from_s=1.0,to_s=2.0,factor=-1.0}]", "fault.0.factor"),
        ("x500-hover", "airframe.battery.efficiency=0", "airframe.battery.efficiency"),
        ("x500-hover", "airframe.rotor_radius_m=0", "airframe.rotor_radius_m"),
        ("helix", "fault=[{kind=\"rotor\",index=0,effectiveness=1.0,from_s=-1.0}]", "fault.0.from_s"),
        ("helix", "fault=[{kind=\"rotor\",index=4,effectiveness=1.0,from_s=1.0}]", "fault.0.index"),
        ("helix", "sensors=\"gps\"", "gps"),
        ("helix", "command=[{order=\"dance\"}]", "dance"),
        ("helix", "assess={from_s=-1.0}", "assess.from_s"),
        ("helix", "assess={from_s=9.0,to_s=8.0}", "assess.from_s"),
        ("helix", "home.latitude_deg=91", "latitude_deg"),
        ("paper-ideal", "world.altitude_m=100", "world"),
        ("paper-ideal", "push=[{from_s=1.0,to_s=2.0}]", "push"),
        ("paper-ideal", "battery.soc=1", "battery"),
        ("paper-ideal", "fault=[{kind=\"rotor\",index=0,effectiveness=0.0,from_s=1.0}]", "fault"),
        ("paper-ideal", "sensors=\"gnss\"", "sensors"),
        ("paper-ideal", "actuation_delay_s=0.001", "actuation_delay_s"),
        ("paper-ideal", "start_attitude_deg=[10,0,0]", "start_attitude_deg"),
        ("paper-ideal", "wind.mean_m_s=[1,0,0]", "wind"),
        ("paper-ideal", "tumble={rate_rad_s=1.0,speed_m_s=0.0}", "tumble"),
        ("helix", "attitude={amplitude_rad=[1,0,0],rate_rad_s=[1,1,1],phase_rad=[0,0,0]}", "attitude"),
    ] {
        assert!(refusal(scenario, &[setting]).contains(culprit), "{setting}");
    }
}

#[test]
fn a_start_is_either_drawn_or_written_down() {
    let settings = ["tumble={rate_rad_s=1.0,speed_m_s=0.0}", "start_rates_rad_s=[0,0,0]"];
    assert!(refusal("helix", &settings).contains("start_rates_rad_s"));
}

#[test]
fn the_bound_is_not_shown_for_another_problem() {
    let bound = |settings: &[&str]| {
        let settings: Vec<String> = settings.iter().map(|s| (*s).to_owned()).collect();
        Scenario::load("helix", &settings).expect("valid").file.time_optimal_s
    };
    assert_eq!(bound(&["control.x.lambda=3"]), Some(1.31));
    assert_eq!(bound(&["thrust_to_weight=4"]), None);
    assert_eq!(bound(&["truth.mass_factor=1.1"]), None);
    assert_eq!(bound(&["start_velocity_m_s=[1,0,0]"]), None);
}

#[test]
fn a_setting_takes_effect_in_plant_and_firmware() {
    let scenario = Scenario::load("helix", &["airframe.mass_kg=1".to_owned()]).expect("valid");
    assert_eq!(scenario.constants().mass, 1.0);
    assert_eq!(scenario.flight_config().airframe.mass_kg, 1.0);
}

#[test]
fn every_controller_is_known_by_its_name() {
    for name in ["x500-smc", "x500-pid", "x500-geometric", "x500-indi"] {
        let controller = tuning(name).expect("built in").controller;
        assert!(Controller::NAMES.contains(&controller.name()) && name.ends_with(controller.name()), "{name}");
    }
}

#[test]
fn a_setting_of_another_kind_takes_the_place_of_the_files() {
    let eight = "trajectory.figure-eight={center_m=[0,0,2],amplitude_m=[4,2],rate_rad_s=1,yaw_rad=0}";
    let loaded = Scenario::load("paper-ideal", &[eight.into(), "control.z.reaching.tanh.rho=5".into()]).expect("valid");
    assert!(matches!(loaded.file.trajectory, firmware::guidance::Trajectory::FigureEight { .. }));
    let Controller::Smc(control) = &loaded.controller else { panic!("sliding mode") };
    assert_eq!(control.z.reaching, firmware::control::sliding::ReachingLaw::Tanh { rho: 5.0 });
    // Both by the command line are one too many.
    let both = [eight.to_owned(), "trajectory.hold.yaw_rad=0".to_owned()];
    assert!(Scenario::load("paper-ideal", &both).is_err_and(|error| format!("{error:#}").contains("given twice")));
    let tuned = Scenario::load("x500-step", &["control.x.reaching.sat.rho=1".into()]).expect("valid");
    let Controller::Smc(control) = &tuned.controller else { panic!("sliding mode") };
    assert_eq!(control.x.reaching, firmware::control::sliding::ReachingLaw::Sat { rho: 1.0 });
}

#[test]
fn whatever_a_ground_station_may_set_is_accepted_at_the_next_start() {
    use firmware::settings::{Class, SETTINGS};
    let plain = Scenario::load("x500-step", &[]).expect("valid");
    for (index, setting) in SETTINGS.iter().enumerate().filter(|(_, setting)| setting.class != Class::ReadOnly) {
        for bound in [setting.min(), setting.max()] {
            let mut settings = plain.settings();
            if settings.set(index, bound, false).is_ok() {
                let again = plain.clone().with_settings(&settings);
                assert!(again.is_ok(), "{} {bound:?}: {:#}", setting.name, again.unwrap_err());
            }
        }
    }
}

#[test]
fn parameters_take_the_place_of_what_the_scenario_gives_and_flow_back_into_it() {
    let keys = ["params.SMC_X_LAW=5", "params.SMC_X_HORIZ=0.2", "params.MPC_XY_CRUISE=3", "params.MAV_SYS_ID=7"];
    let scenario = Scenario::load("x500-step", &keys.map(str::to_owned)).expect("valid");
    let config = scenario.flight_config();
    assert_eq!(
        config.position.axes[0].reaching,
        firmware::control::sliding::ReachingLaw::ImplicitSgn { horizon_s: 0.2 }
    );
    assert_eq!(config.modes.cruise_m_s, 3.0);
    let settings = scenario.settings();
    assert!(settings.is_configured() && settings.system_id() == 7);
    // As a file of parameters does it.
    let plain = Scenario::load("x500-step", &[]).expect("valid");
    let again = plain.clone().with_settings(&settings).expect("valid");
    assert_eq!((again.flight_config(), again.settings()), (config, settings));
    let same = plain.clone().with_settings(&plain.settings()).expect("valid");
    assert_eq!(same, plain, "nothing is written down that is so already");
}

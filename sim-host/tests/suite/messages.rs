//! What the program says of input that it cannot use: one line, with the name, the key, the value, what it may be and
//! what to do, and exit code 2. One table: arguments, and what the line holds.

mod arguments;

use std::fs;

use crate::common::folder::Folder;

/// A flight with settings, each after a `--set`.
fn refuses_settings(folder: &Folder, scenario: &str, settings: &[&str], parts: &[&str]) {
    let arguments = settings.iter().flat_map(|setting| ["--set", *setting]);
    folder.refuses(&["run", scenario].into_iter().chain(arguments).collect::<Vec<_>>(), parts);
}

#[test]
fn a_name_that_is_unknown_is_answered_with_the_one_that_was_meant() {
    let folder = Folder::new("names");
    folder.file("mine.toml", "airframe = \"x50\"\n");
    for (arguments, parts) in [
        (&["run", "helicks"][..], &["scenario", "`helicks`", "did you mean `helix`?"][..]),
        (&["run", "outdoor-tuor"], &["`outdoor-tuor`", "did you mean `outdoor-tour`?"]),
        (&["run", "qqq"], &["`qqq`", "sim-host scenarios", "path"]),
        (&["run", "helix", "--set", "airframe=x50"], &["airframe `x50`", "did you mean `x500`?"]),
        (&["run", "x500-hover", "--set", "tuning=x500-pdi"], &["tuning `x500-pdi`", "did you mean `x500-pid`?"]),
        (&["run", "helix", "--set", "sensors=gnsss"], &["suite `gnsss`", "did you mean `gnss`?"]),
        (&["compare", "x501"], &["matrix `x501`", "did you mean `x500`?"]),
        (&["compare", "x500-step"], &["`x500-step` is a scenario: `sim-host run x500-step` flies it"]),
        (&["run", "x500"], &["`x500` is a matrix: `sim-host compare x500` flies it; or an airframe"]),
        (&["serve", "compare"], &["`compare` is a command: `sim-host compare`"]),
        (&["tune", "x500-hover", "--out", "out"], &["`x500-hover` is a scenario"]),
        (&["compare", "x500", "--scenarios", "x500-hovr"], &["`x500-hovr`", "did you mean `x500-hover`?"]),
        (&["compare", "x500", "--disturbances", "mass30"], &["`mass30`", "did you mean `mass+30`?"]),
        (&["tune", "x500-scm", "--out", "out"], &["tune `x500-scm`", "did you mean `x500-smc`?"]),
        (&["asess"], &["'asess'", "'assess'"]),
        (&["rnu", "helix"], &["'rnu'", "did you mean `run`?"]),
        (&["fly", "helix"], &["'fly'", "run, scenarios, serve"]),
        (&["sweep", "helix"], &["scenario `helix`", "no `[disturbance]`", "paper-disturbed", ONE]),
        (&["assess", "helix"], &["scenario `helix`", "no `[assess]`", "sim-host assess"]),
        (&["helix"], &["'helix'", "sim-host run helix"]),
        (&["run", "helix", "--sed", "3"], &["'--sed'", "'--seed'"]),
        (&["tune", "x500-smc", "--out", "o", "--method", "psoo"], &["'psoo'", "pso"]),
        (&["run", "helix.toml"], &["`helix.toml`", "No such file", "built-in `helix`"]),
        (&["run"], &["<SCENARIO>", "--help"]),
    ] {
        folder.refuses(arguments, parts);
    }
}

#[test]
fn a_parameter_that_cannot_be_set_is_named_with_its_value_and_what_it_may_be() {
    let folder = Folder::new("parameters");
    for (setting, parts) in [
        ("params.MPC_XY_CRUSE=3", &["`params.MPC_XY_CRUSE` is no parameter: did you mean `MPC_XY_CRUISE`?"][..]),
        ("params.MPC_XY_CRUISE=1000", &["`params.MPC_XY_CRUISE` must be between 0.05 and 100, not 1000"]),
        ("params.MAV_SYS_ID=1.5", &["`params.MAV_SYS_ID` must be a whole number from 1 to 250, not 1.5"]),
        ("params.GL_AUTOPILOT=3", &["`params.GL_AUTOPILOT` must be 0 or 12, not 3"]),
        ("params.SYS_AUTOCONFIG=1", &["`params.SYS_AUTOCONFIG` cannot be set"]),
        ("params.MPC_XY_CRUISE=fast", &["`params.MPC_XY_CRUISE` must be a number, not \"fast\""]),
        ("params.qqqq=3", &["`params.qqqq` is no parameter: docs/parameters.md lists them"]),
        (
            "params={GL_YAW_1=0,GL_YAW_2=0,GL_YAW_3=0,GL_YAW_4=0}",
            &["`params`: the rotors cannot produce thrust and three torques"],
        ),
    ] {
        refuses_settings(&folder, "helix", &[setting], parts);
    }
}

#[test]
fn a_setting_that_cannot_be_is_named_with_its_value_and_what_it_may_be() {
    let folder = Folder::new("settings");
    for (scenario, setting, parts) in [
        (
            "helix",
            "control.x.lambda=-3",
            &["scenario `helix`", "`control.x.lambda` must be between 0.001 and 100, not -3"][..],
        ),
        ("helix", "control.x.lamda=3", &["`control.x.lamda` is no key", "did you mean `lambda`?"]),
        ("helix", "control.x.lambda=fast", &["`control.x.lambda` must be a number, not \"fast\""]),
        ("helix", "control.x.lambda=nan", &["`control.x.lambda` must be a finite number, not nan"]),
        ("helix", "control.x={lambda=3}", &["`control.x.gain` is missing", "add `gain"]),
        ("helix", "control.w.lambda=3", &["`control.w` is no key", "roll, pitch, yaw, x, y, z"]),
        ("helix", "contrl.x.lambda=3", &["`contrl` is no key", "did you mean `control`?"]),
        ("helix", "control=3", &["`control` must be a table, not 3"]),
        ("outdoor-tour", "home=[47.0,8.0]", &["`home` must be a table, not an array"]),
        ("outdoor-tour", "wind=[[1.0,2.0,3.0],3.0,4.0,5.0]", &["`wind` must be a table, not an array"]),
        ("x500-helix", "truth.actuation_delay_s=0.005", &["`truth.actuation_delay_s`", "is never told of it"]),
        ("helix", "control.x.reaching={power={alpha=2}}", &["`control.x.reaching.power.alpha` must be below 1, not 2"]),
        ("helix", "control.z.reaching=tanh", &["`control.z.reaching` must be a table", "write {tanh={rho=…}}"]),
        ("helix", "control.z.reaching={sat=0.5}", &["`control.z.reaching.sat` must be a table, not 0.5", "{rho=…}"]),
        ("helix", "control.z.K=1", &["`control.z.K` is no key: the paper's K is `gain`"]),
        (
            "helix",
            "control.z.rho=1",
            &["`control.z.rho` is no key", "inside `reaching`, as in reaching={tanh={rho=…}}"],
        ),
        ("helix", "control.x.reaching=sng", &["`control.x.reaching`", "`sng`", "did you mean `sgn`?"]),
        ("helix", "control.tilt_max_rad=1.6", &["`control.tilt_max_rad` must be below 1.5, not 1.6"]),
        ("helix", "airframe.mass=3", &["`airframe.mass` is no key", "did you mean `mass_kg`?"]),
        (
            "helix",
            "airframe.thrust_to_weight=3",
            &["scenario `helix` has its own `thrust_to_weight`", "set `thrust_to_weight`"],
        ),
        ("field", "sensors.gnss.rate_hz=3", &["`sensors.gnss.rate_hz`", "whole milliseconds, not 3", "divides 1000"]),
        ("helix", "airframe.mass_kg=-3", &["`airframe.mass_kg` must be above 0, not -3"]),
        ("helix", "airframe.rotors.1.lift_n_s2=0", &["`airframe.rotors.1.lift_n_s2` must be above 0, not 0"]),
        ("helix", "airframe.rotors.4.x_m=0", &["`rotors.4` is not there", "0 to 3"]),
        ("helix", "plant=rigd-body", &["`plant` must be one of rigid-body,", "did you mean `rigid-body`?"]),
        ("helix", "trajectory={helx={}}", &["`trajectory` must be one of", "did you mean `helix`?"]),
        ("x500-hover", "trajectory={waypoint={points=[]}}", &["`trajectory`", "did you mean `waypoints`?"]),
        ("x500-hover", "trajectory={waypoints={points=[]}}", &["`trajectory.waypoints.points` must have 2 or more"]),
        (
            "x500-hover",
            "trajectory={waypoints={points=[{position_m=[0,0,2]},{position_m=[0,0,3]},{position_m=[0,0,3]}]}}",
            &["`trajectory.waypoints.points.2` is where `points.1` is: leave one out, or give every point `at_s`"],
        ),
        (
            "x500-hover",
            "trajectory={waypoints={points=[{position_m=[0,0,2],at_s=1},{position_m=[0,0,3],at_s=1.05}]}}",
            &["`trajectory.waypoints.points.1.at_s` must be 0.08 s or more after `points.0.at_s`, 1, not 1.05"],
        ),
        ("x500-hover", "trajectory={csv={file=\"gone.csv\"}}", &["`trajectory.csv`", "`gone.csv`", "No such file"]),
        ("helix", "trajectory=3", &["`trajectory` must be", "not 3"]),
        ("helix", "duration_s=\u{1b}[31m", &["`duration_s` must be a number, not \"\\u{1b}[31m\""]),
        ("helix", "a\u{1b}[31m\nb=3", &["`a\\u{1b}[31m b` is no key"]),
        ("helix", "control.x.lambda=1e39", &["`control.x.lambda` must be between 0.001 and 100, not 1e39"]),
        ("helix", "control.x.lambda=-1e308", &["`control.x.lambda` must be between 0.001 and 100, not -1e308"]),
        ("helix", "trajectory.helix.yaw_rad=-1e39", &["`trajectory.helix.yaw_rad` must be", "rad, not -1e39"]),
        (
            "x500-hover",
            "airframe.thrust_to_weight=1e8",
            &["`airframe.thrust_to_weight` must be between 1.01 and 1000, not"],
        ),
        ("helix", "thrust_to_weight=1", &["`thrust_to_weight` must be between 1.01 and 1000, not 1"]),
        ("x500-hover", "start=on-ground", &["`start` is `on-ground`, and there is no ground: set `ground = true`"]),
        ("paper-ideal", "start=on-ground", &["`start` is `on-ground`", "`start = \"in-flight\"`"]),
        ("helix", "plant={}", &["`plant` must name a kind, not {}"]),
        (
            "helix",
            "control.x.reaching={sat={rho=1},sgn={}}",
            &["`control.x.reaching` must be one kind alone: keep one"],
        ),
        ("helix", "trajectory={}", &["`trajectory` must be one of hold, step,", "not an empty table"]),
        ("helix", "trajectory={hold={},step={}}", &["`trajectory` is given twice, as `hold` and as `step`"]),
        ("helix", "duration_s=soon", &["`duration_s` must be a number, not \"soon\""]),
        ("helix", "duration_s=", &["--set duration_s=", "the value is missing"]),
        ("helix", "=3", &["--set =3", "KEY=VALUE"]),
        ("helix", "duration_s", &["--set duration_s", "KEY=VALUE"]),
        ("helix", "duration_s.x=3", &["`duration_s` is 20.0, and no table"]),
        ("helix", "start_position_m=[0,0]", &["`start_position_m` must have 3 values, not 2"]),
        ("helix", "start_position_m=[0,0,0,0]", &["`start_position_m` has too many values, 4"]),
        ("x500-hover", "start_position_m.1=nan", &["`start_position_m.1` must be between -1e6 and 1e6 m, not nan"]),
        ("helix", "start_position_m.3=1", &["`start_position_m` has no entries", "as a whole"]),
        ("helix", "push=[{from_s=3,to_s=1}]", &["`push.0.to_s`", "from 3 to 1 s runs backwards"]),
        ("helix", "modes.climb_m_s=0", &["`modes.climb_m_s` must be between 0.05 and 100 m/s, not 0"]),
        ("helix", "sensors=3", &["`sensors` must be a suite's name or a table, not 3"]),
        ("paper-disturbed", "disturbance.to_s=1", &["`disturbance.to_s`", "runs backwards"]),
        ("paper-disturbed", "disturbance.hold_s=0.0014", &["`disturbance.hold_s` must be whole milliseconds"]),
        ("field", "sensors.gnss.delay_s=2", &["`sensors.gnss.delay_s` must be between 0 and 0.249 s, not 2"]),
        ("field", "sensors.gnss.dealy_s=2", &["`sensors.gnss.dealy_s` is no key", "did you mean `delay_s`?"]),
        ("x500-hover", "fault.0.from_s=3", &["`fault` has no entries", "as a whole"]),
        ("x500-hover", "command=[{order=\"take-of\"}]", &["`command.0.order`", "did you mean `take-off`?"]),
    ] {
        refuses_settings(&folder, scenario, &[setting], parts);
    }
}

#[test]
fn an_altitude_of_home_is_not_taken_for_its_latitude() {
    let line =
        "`home.altitude_m` is no key: the place's height is `height_m`; the air's density goes by `world.altitude_m`";
    refuses_settings(&Folder::new("altitude"), "field", &["home.altitude_m=500"], &[line]);
}

#[test]
fn a_duration_that_cannot_be_is_named_with_its_value_and_what_it_may_be() {
    let folder = Folder::new("durations");
    for (setting, parts) in [
        ("duration_s=0", &["`duration_s` must be between 0.001 and 1e6 s, not 0"][..]),
        ("duration_s=-5", &["`duration_s`", "not -5"]),
        ("duration_s=inf", &["`duration_s`", "not inf"]),
        ("duration_s=1e308", &["`duration_s` must be between 0.001 and 1e6 s, not 1e308"]),
        ("duration_s=0.0015", &["`duration_s` must be whole milliseconds, not 0.0015 s"]),
        ("duration_s=99999999999999999999", &["`duration_s` must be between 0.001 and 1e6 s, not 1e20"]),
        ("duration_s=3\nstart_position_m=[0,0,0]", &["`duration_s` must be a number, not \"3\\nstart"]),
    ] {
        refuses_settings(&folder, "helix", &[setting], parts);
    }
}

#[test]
fn sensors_without_a_start_on_the_ground_are_refused() {
    let folder = Folder::new("air");
    let line = "scenario `x500-hover`: `sensors` need a start on the ground, where the estimator aligns at rest: set \
                `start = \"on-ground\"`, `ground = true` and `[[command]]`s, as `indoor-helix` has them, or leave \
                `sensors` out";
    refuses_settings(&folder, "x500-hover", &["sensors=gnss"], &[line]);
}

#[test]
fn an_order_that_cannot_be_carried_out_is_refused_when_it_is_read() {
    let folder = Folder::new("orders");
    for (scenario, setting, parts) in [
        ("x500-hover", "command=[{order=\"rtl\"}]", &["`command.0.order`", "not `rtl`: did you mean `return`?"][..]),
        ("x500-hover", "command=[{order={loiter={}}}]", &["`command.0.order`", "not `loiter`: did you mean `hold`?"]),
        (
            "outdoor-hover",
            "command=[{at_s=1.0,order={go-to={position_m=[5.0,0.0,-10.0],yaw_deg=0.0}}}]",
            &["`command.0.order.go-to.position_m.2` must be above the ground, which is at 0 m, not -10: z points up"],
        ),
        (
            "outdoor-hover",
            "command=[{at_s=1.0,order={go-to={position_m=[2e4,0.0,10.0],yaw_deg=0.0}}}]",
            &["`command.0.order.go-to.position_m.0` must be between -10000 and 10000 m, not 20000"],
        ),
        (
            "outdoor-hover",
            "command=[{at_s=1.0,order={take-off={height_m=0.2}}}]",
            &["`command.0.order.take-off.height_m` must be between 0.3 and 100 m, not 0.2"],
        ),
        (
            "outdoor-hover",
            "command=[{at_s=1.0,order={velocity={velocity_m_s=[0.0,0.0,101.0]}}}]",
            &["`command.0.order.velocity.velocity_m_s.2` must be between -100 and 100 m/s, not 101"],
        ),
        ("outdoor-hover", "command.0.at_s=-1", &["`command.0.at_s` must be between 0 and 1e6 s, not -1"]),
        ("outdoor-hover", "command.0.at_s=nan", &["`command.0.at_s` must be between 0 and 1e6 s, not nan"]),
        (
            "outdoor-hover",
            "command=[{at_s=1,order=\"hold\"},{arrived_for_s=-0.5,order=\"land\"}]",
            &["`command.1.arrived_for_s` must be between 0 and 1e6 s, not -0.5"],
        ),
        ("field", "fault=[{sensor=\"gnss\",kind=\"off\",from_s=-1}]", &["`fault.0.from_s` must be between 0 and 1e6"]),
        (
            "x500-hover",
            "push=[{from_s=-1,to_s=1,acceleration_m_s2=[1,0,0]}]",
            &["`push.0.from_s` must be between 0 and 1e6 s, not -1"],
        ),
        ("field", "fault=[{sensor=\"gps\",kind=\"off\",from_s=1}]", &["`fault.0.sensor`", "did you mean `gnss`?"]),
    ] {
        refuses_settings(&folder, scenario, &[setting], parts);
    }
}

#[test]
fn a_fault_that_cannot_be_is_named_with_its_key() {
    let folder = Folder::new("faults");
    for (fault, parts) in [
        ("kind=\"rotr\",index=0,effectiveness=0.5", &["`fault.0.kind`", "`rotr`", "did you mean `rotor`?"][..]),
        ("kind=\"rotor\",index=7,effectiveness=0.5", &["`fault.0.index` must be between 0 and 3, not 7"]),
        ("kind=\"rotor\",index=\"two\",effectiveness=0.5", &["`fault.0.index` must be a whole number", "not \"two\""]),
        ("kind=\"glitch\",sensor=\"baro\",size_m=1", &["`fault.0.kind`", "`glitch`", "`baro`", "gnss, pose"]),
        ("kind=\"off\"", &["`fault.0.sensor` is missing", "mag, baro, gnss, pose, battery"]),
        ("kind=\"off\",sensor=\"gnss\"", &["`fault.0.sensor` is `gnss`", "`sensors`"]),
        (
            "kind=\"rotor\",to_s=0.5,index=1,effectiveness=0.5",
            &["`fault.0.to_s`", "`fault.0.from_s`", "runs backwards"],
        ),
        ("kind=\"rotor\",indx=2,effectiveness=0.5", &["`fault.0.indx` is no key", "did you mean `index`?"]),
    ] {
        refuses_settings(&folder, "x500-hover", &[&format!("fault=[{{{fault},from_s=1}}]")], parts);
    }
}

#[test]
fn what_begins_after_the_flight_is_told() {
    let folder = Folder::new("late");
    let late = [
        ("fault=[{kind=\"rotor\",index=0,effectiveness=0.5,from_s=7.5}]", "fault.0.from_s", "7.5"),
        ("push=[{from_s=1.0,to_s=9.0},{from_s=2.0,to_s=3.0}]", "push.1.from_s", "2"),
        (
            "wind={mean_m_s=[0.0,0.0,0.0],gust=[{from_s=3.0,rise_s=1.0,peak_m_s=[1.0,0.0,0.0]}]}",
            "wind.gust.0.from_s",
            "3",
        ),
    ];
    for (setting, key, from_s) in late {
        let flight = ["run", "field", "--json", "--set", "duration_s=2", "--set", setting];
        let (_, said) = folder.prints(&flight);
        let end = "must be before the end of the flight, `duration_s` = 2";
        assert_eq!(said, format!("sim-host: note: `{key}` {end}, not {from_s}: it never begins\n"), "{setting}");
    }
}

#[test]
fn of_a_comparison_it_is_told_once() {
    let folder = Folder::new("late-cells");
    let cells = ["compare", "--scenarios", "x500-hover,x500-step", "--disturbances", "none", "--seeds", "1..1"];
    let late = ["--controllers", "x500-pid", "--set", "duration_s=2", "--set", "push=[{from_s=3.0,to_s=4.0}]"];
    let (_, said) = folder.prints(&[cells.as_slice(), &late].concat());
    let expected = "sim-host: note: `push.0.from_s` must be before the end of the flight, `duration_s` = 2, not 3: it \
                    never begins (x500-hover under none, and 1 cell more)\n";
    assert_eq!(said, expected);
}

#[test]
fn a_scenario_may_have_any_name_as_long_as_it_is_there() {
    let folder = Folder::new("names");
    folder.file("README.md", "# Missions\n\nfly high\n");
    folder.file("mission.txt", "duration_s = 1.0\nstart_position_m = [0.0, 0.0, \"2\"]\n");
    folder.refuses(&["run", "README.md"], &["scenario `README.md`, line 3: "]);
    folder.refuses(&["run", "mission.txt"], &["scenario `mission.txt`, line 2: `start_position_m.2` must be a number"]);
}

#[test]
fn settings_of_gains_are_laid_over_the_tuning_that_flies() {
    let folder = Folder::new("gains");
    let hash = |settings: &[&str]| {
        let settings = settings.iter().flat_map(|setting| ["--set", *setting]);
        let arguments = ["run", "x500-step", "--set", "duration_s=2", "--json"].into_iter().chain(settings);
        let (out, _) = folder.prints(&arguments.collect::<Vec<_>>());
        let summary: serde_json::Value = serde_json::from_str(&out).expect("JSON");
        summary["truth_sha256"].as_str().expect("a hash").to_owned()
    };
    let changed = hash(&["control.x.lambda=3"]);
    assert_ne!(changed, hash(&[]), "a gain of the airframe's own tuning is changed");
    assert_eq!(changed, hash(&["smc.x.lambda=3"]), "by either name");
    assert_eq!(changed, hash(&["control.x.lambda=2", "control.x.lambda=3"]), "the last one wins");
    let pid = hash(&["tuning=x500-pid"]);
    assert_ne!(pid, hash(&["pid.position_p_1_s.xy=1.0", "tuning=x500-pid"]), "whatever the order");
    // The value that the tuning has is no change: nothing else of it is touched.
    assert_eq!(hash(&[]), hash(&["control.x.lambda=5.0"]));

    for (settings, parts) in [
        (&["control.x.lambda=-3"][..], &["`control.x.lambda` must be between 0.001 and 100, not -3"][..]),
        (&["control.x.lamda=3"], &["`control.x.lamda` is no key", "did you mean `lambda`?"]),
        (&["pid.yaw_weight=0.3"], &["tuning `x500-smc`", "`smc`, not of `pid`", "`control.…`"]),
        (&["tuning=x500-pid", "control.x.lambda=3"], &["tuning `x500-pid`", "`pid`, not of `smc`", "`pid.…`"]),
        (&["tuning=x500-pid", "pid.yaw_weight=3"], &["`pid.yaw_weight` must be between 0 and 1, not 3"]),
    ] {
        refuses_settings(&folder, "x500-hover", settings, parts);
    }
    refuses_settings(&folder, "helix", &["tuning=x500-pid"], &["`tuning` and `control`", "keep one"]);
    refuses_settings(&folder, "helix", &["pid.yaw_weight=0.3"], &["scenario `helix`", "`smc`, not of `pid`"]);
}

#[test]
fn an_axis_by_its_bounds_has_the_keys_of_its_bounds() {
    let folder = Folder::new("bounds");
    let bounds = |disturbance: f64| {
        format!("control.x={{answer_s=0.1,disturbance={disturbance},disturbance_rate=5.0,authority=10.0}}")
    };
    folder.prints(&["run", "helix", "--set", "duration_s=0.1", "--set", &bounds(3.0)]);
    let refuses = |settings: &[&str], parts: &[&str]| refuses_settings(&folder, "helix", settings, parts);
    refuses(
        &[&bounds(3.0), "control.x.lambda=3"],
        &["`control.x.lambda`", "answer_s, disturbance", "leave out `answer_s`"],
    );
    refuses(&[&bounds(10.0)], &["`control.x.disturbance` must be below 10, not 10", "`authority`"]);
    refuses(&[&bounds(-1.0)], &["`control.x.disturbance` must be above 0, not -1"]);
}

#[test]
fn what_a_scenario_lacks_is_named_with_where_it_is() {
    let folder = Folder::new("lacking");
    let refuses = |name: &str, setting: &str, parts: &[&str]| folder.refuses(&["run", name, "--set", setting], parts);
    refuses(
        "x500-hover",
        "modes.battery_low_v=14",
        &["`modes.battery_low_v` needs a battery: add a table `[battery]`"],
    );
    refuses("paper-ideal", "wind.mean_m_s=[5,0,0]", &["`wind` is modelled on the plant `rigid-body`", "as `helix`"]);
}

const SCENARIO: &str = "\
plant = \"rigid-body\"
airframe = \"x500\"
duration_s = 1.0

[trajectory.hold]
position_m = [0.0, 0.0, 0.0]
yaw_rad = 0.0
";

#[test]
fn a_file_is_named_with_the_line_of_the_key() {
    let folder = Folder::new("files");
    // Without a summary, which nobody needs to try something.
    folder.file("mine.toml", SCENARIO);
    folder.prints(&["run", "mine.toml"]);
    let spoilt = |from: &str, to: &str| {
        assert!(SCENARIO.contains(from), "{from}");
        SCENARIO.replacen(from, to, 1)
    };
    for (text, parts) in [
        (spoilt("= 1.0", "= -1.0"), &["scenario `bad.toml`, line 3", "`duration_s`", "not -1"][..]),
        (spoilt("= 1.0", "= 1.0 s"), &["scenario `bad.toml`, line 3"]),
        (spoilt("= 1.0", "= 1.0\nduration_s = 2.0"), &["scenario `bad.toml`, line 4", "`duration_s` is given twice"]),
        (spoilt("duration_s", "duration"), &["line 3", "`duration` is no key", "did you mean `duration_s`?"]),
        (spoilt("duration_s = 1.0", ""), &["scenario `bad.toml`", "`duration_s` is missing"]),
        (spoilt("yaw_rad = 0.0", ""), &["line 5", "`trajectory.hold.yaw_rad` is missing"]),
        (
            spoilt("[0.0, 0.0, 0.0]", "[0.0, 0.0]"),
            &["line 6", "`trajectory.hold.position_m` must have 3 values, not 2"],
        ),
        (
            spoilt("\"x500\"", "\"x50\""),
            &["scenario `bad.toml`, line 2: `airframe`: unknown airframe `x50`: did you mean `x500`?"],
        ),
        (
            spoilt("duration_s", "tuning = \"x500-pdi\"\nduration_s"),
            &["scenario `bad.toml`, line 3: `tuning`: unknown tuning `x500-pdi`: did you mean `x500-pid`?"],
        ),
        (
            spoilt("duration_s", "sensors = { suite = \"gnsss\" }\nduration_s"),
            &["scenario `bad.toml`, line 3: `sensors.suite`: unknown suite `gnsss`: did you mean `gnss`?"],
        ),
        (
            spoilt("duration_s", "sensors = { suite = \"gnss\", mag.part = \"ist\" }\nduration_s"),
            &["scenario `bad.toml`, line 3: `sensors.mag.part`: unknown part `ist`"],
        ),
        (
            spoilt("= 1.0", "= 99999999999999999999"),
            &["line 3: `duration_s` is too large: whole numbers go to 9223372036854775807, others to 1.79"],
        ),
        (spoilt("= 1.0", "= 1e999"), &["line 3: `duration_s` is too large"]),
        (
            format!("tuning = \"x500-smc\"\n{SCENARIO}\n[control]\ntilt_max_rad = 1.0"),
            &["scenario `bad.toml`", "`tuning` and `control`", "keep one"],
        ),
        (String::new(), &["scenario `bad.toml`", "is missing"]),
    ] {
        folder.file("bad.toml", text);
        folder.refuses(&["run", "bad.toml"], parts);
    }
    folder.file("gains.toml", "summary = \"\"\n[smc]\ntilt_max_rad = 1.0\n[smc.x]\nlambda = -1.0\n");
    refuses_settings(
        &folder,
        "x500-hover",
        &["tuning=gains.toml"],
        &["tuning `gains.toml`, line 4", "`smc.x.gain` is missing"],
    );
}

#[test]
fn a_file_that_is_none_says_what_it_is() {
    let folder = Folder::new("none");
    folder.file("bytes.toml", [b'a', b'\n', 0xff, 0xfe]);
    folder.file("huge.toml", vec![b'#'; (1 << 20) + 1]);
    fs::create_dir_all(folder.0.join("runs/helix")).expect("can be made");
    fs::create_dir_all(folder.0.join("runs/other")).expect("can be made");
    folder.file("runs/helix/scenario.toml", SCENARIO);
    for (name, parts) in [
        ("bytes.toml", &["scenario file `bytes.toml`", "line 2 is not UTF-8"][..]),
        ("huge.toml", &["scenario file `huge.toml`", "larger than 1 MiB, the most that is read"]),
        ("runs/helix", &["`runs/helix`", "folder", "give `runs/helix/scenario.toml`"]),
        ("runs/other", &["`runs/other`", "folder", "path of a scenario file"]),
        ("gone.toml", &["scenario file `gone.toml`", "No such file"]),
    ] {
        folder.refuses(&["run", name], parts);
    }
}

#[test]
fn what_might_never_end_is_not_read() {
    let folder = Folder::new("fifo");
    for name in ["fifo.toml", "fifo.csv", "fifo"] {
        let path = folder.0.join(name);
        rustix::fs::mkfifoat(rustix::fs::CWD, &path, rustix::fs::Mode::RUSR)
            .expect("the temporary folder can be written");
    }
    let cure = "it is not a regular file: write the text to one and give its path";
    folder.refuses(&["run", "fifo.toml"], &["scenario file `fifo.toml`", cure]);
    folder.refuses(&["run", "/dev/zero"], &["scenario file `/dev/zero`", cure]);
    folder.refuses(&["compare", "/dev/zero"], &["matrix file `/dev/zero`", cure]);
    refuses_settings(&folder, "x500-hover", &["tuning=fifo.toml"], &["tuning file `fifo.toml`", cure]);
    for file in ["fifo.csv", "/dev/zero"] {
        let trajectory = format!("trajectory={{csv={{file=\"{file}\"}}}}");
        refuses_settings(&folder, "x500-hover", &[&trajectory], &["`trajectory.csv`", file, cure]);
    }
    for command in [&["run", "helix"][..], &["analyse", "x500-hover"], &["paper"]] {
        folder.refuses(&[command, &["--out", "fifo"]].concat(), &["--out fifo", "it is no folder: name a folder"]);
    }
}

/// As a refused sweep has it.
const ONE: &str = "--set 'disturbance={from_s=3,to_s=8,hold_s=0.01,acceleration_m_s2=2}'";

#[test]
fn the_disturbance_that_a_refused_sweep_proposes_can_be_flown() {
    let setting = ONE.split('\'').nth(1).expect("in quotes");
    let folder = Folder::new("proposed");
    folder.prints(&["run", "helix", "--set", "duration_s=3.1", "--set", setting]);
}

#[test]
fn too_few_seeds_are_not_judged() {
    let folder = Folder::new("few");
    let part = ["--set", "duration_s=6", "--set", "assess.from_s=5", "--set", "assess.to_s=6"];
    let expect = ["--set", "assess.expect=[{measure=\"z-error-rms-m\",percentile=95,at_most=1e-9}]"];
    let (out, _) = folder.prints(&[&["assess", "outdoor-hover", "--seeds", "1..2"][..], &part, &expect].concat());
    assert!(out.contains("too few seeds, 20 needed") && !out.contains("NOT MET"), "{out}");
    assert!(out.ends_with("\n1 scenario: nothing violated; 1 could not be judged: too few seeds\n"), "{out}");
}

#[cfg(feature = "search")]
#[test]
fn a_search_that_ends_no_better_than_it_began_says_so() {
    let folder = Folder::new("tune");
    // Gains far from any that fly well, from which no iteration comes back.
    folder.file(
        "worse.toml",
        "summary = \"\"\nbase = \"x500-smc\"\ncourse = \"course.toml\"\n\
         [[parameters]]\nkeys = [\"smc.x.lambda\"]\nlow = 0.1\nhigh = 0.11\n",
    );
    folder.file("course.toml", COURSE);
    let arguments = ["tune", "worse.toml", "--particles", "4", "--iterations", "1", "--out", "out"];
    let (_, err) = folder.prints(&arguments);
    assert!(err.contains("warning") && err.contains("keep the base's") && err.contains("--iterations 2"), "{err}");
    let tuning = fs::read_to_string(folder.0.join("out/tuning.toml")).expect("written");
    assert!(tuning.contains("which are no worse"), "{tuning}");
}

/// One short flight.
#[cfg(feature = "search")]
const COURSE: &str = "\
summary = \"one flight\"
matrix = \"x500\"
scenarios = [\"x500-step\"]
disturbances = [\"none\"]

[cost]
rms = 1.0
floor = 1e-3
yaw = 0.2
settling = 0.5
chattering = 0.1
saturation = 0.5
lost = 10.0
";

#[test]
fn a_benchmark_says_what_it_measures() {
    let folder = Folder::new("bench");
    let (out, err) = folder.prints(&["bench", "--seconds", "1", "--runs", "3"]);
    assert!(err.contains("3 flights of `helix`, 1 simulated s each"), "{err}");
    assert!(["lowest", "median", "highest", "real time"].iter().all(|word| out.contains(word)), "{out}");
}

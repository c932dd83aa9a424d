//! What the program says of arguments: numbers, seeds, names and addresses.

use std::fs;
use std::net::UdpSocket;

use crate::common::folder::Folder;

#[test]
fn ranges_of_seeds_and_numbers_of_threads_say_what_they_may_be() {
    let folder = Folder::new("seeds");
    for (seeds, part) in [
        ("9..3", "9..3 runs backwards: use 3..9"),
        ("1..0", "1..0 runs backwards: use 0..1"),
        ("5", "use 5..5 for one flight"),
        ("a..b", "`a` is not a seed"),
        ("1..99999999", "more than 1000000"),
        ("1..99999999999999999999", "0 to 18446744073709551615"),
    ] {
        folder.refuses(&["run", "helix", "--seeds", seeds], &["--seeds", seeds, part]);
    }
    folder.refuses(&["run", "helix", "--seeds", "1..2", "--jobs", "0"], &["--jobs", "'0'", "from 1 up"]);
    folder.refuses(&["compare", "--jobs", "many"], &["--jobs", "'many'", "from 1 up"]);
    for arguments in
        [&["run", "helix", "--seed", "-1"][..], &["sweep", "paper-disturbed", "--seed", "99999999999999999999"]]
    {
        folder.refuses(arguments, &["--seed", arguments[3], "0 to 18446744073709551615"]);
    }
    folder.refuses(&["run", "helix", "--seeds", "-1..3"], &["--seeds", "'-1..3'", "`-1` is not a seed"]);
    folder.refuses(&["run", "helix", "--seeds", "1..2", "--jobs", "-2"], &["--jobs", "'-2'", "from 1 up"]);
    for number in ["-5", "x", "99999999999999999999999", "1.5"] {
        for (arguments, range) in [
            (&["bench", "--runs"][..], "from 1 to 10000"),
            (&["plan", "helix", "--flights"], "from 1 to 1000000000"),
            (&["tune", "x500-smc", "--out", "out", "--particles"], "from 4 to 10000"),
            (&["tune", "x500-smc", "--out", "out", "--iterations"], "from 1 to 1000000"),
            (&["pil", "pad", "--busy-outer-us"], "from 0 to 4294967295"),
        ] {
            let option = arguments[arguments.len() - 1];
            let parts = [option, number, "use a whole number", range];
            folder.refuses(&[arguments, &[number]].concat(), &parts);
        }
    }
    for number in ["-5", "nan", "5x", "0"] {
        folder.refuses(&["bench", "--seconds", number], &["--seconds", number, "use a number from 1 to 1e6"]);
        folder.refuses(&["serve", "--speed", number], &["--speed", number, "use a number from 0.01 to 1000"]);
    }
    let (_, said) = folder.prints(&["run", "helix", "--set", "duration_s=0.1", "--seeds", "1..=2", "--jobs", "100000"]);
    assert!(!said.contains("panicked"), "{said}");
}

#[test]
fn the_papers_flights_are_not_changed_but_others_are() {
    let remedy = "`sim-host run paper-ideal --set KEY=VALUE --out DIR`";
    Folder::new("paper-set").refuses(&["paper", "--set", "control.z.gain=3"], &["'--set'", remedy]);
}

#[test]
fn what_is_no_argument_says_how_it_is_set() {
    let folder = Folder::new("no-argument");
    for (arguments, part) in [
        (&["--set", "control.z.gain", "300"][..], "--set 'KEY=VALUE'"),
        (&["--set", "control.z.reaching={exponential={rate=5", "rho=0.1}}"], "in quotes if it has spaces, braces"),
        (&["--duration", "5"], "--set duration_s=5"),
        (&["-o", "runs/x"], "use --out DIR"),
        (&["--gain", "300"], "--set KEY=VALUE"),
    ] {
        folder.refuses(&[&["run", "paper-ideal"], arguments].concat(), &["unexpected argument", part]);
    }
    for (setting, part) in [
        ("z.lambda=20", "gains stand below `control`, as in control.z.lambda"),
        ("lambda=20", "each axis has its own, as in control.x.lambda"),
        ("control.reaching=sgn", "each axis has its own, as in control.x.reaching"),
        ("control.phi.lambda=20", "the paper's φ is `roll`"),
        ("control.altitude.lambda=20", "the altitude is `z`"),
        (
            "control.z.reaching=tanh",
            "write {tanh={rho=…}} in its place, and all of a --set in quotes: --set '…={tanh={rho=…}}'",
        ),
    ] {
        folder.refuses(&["run", "paper-ideal", "--set", setting], &[part]);
    }
}

#[test]
fn a_key_of_control_without_it_is_told_where_it_stands() {
    let folder = Folder::new("no-control");
    // The refusal of a key that there is not lists all that there are.
    let refused = folder.run(&["run", "helix", "--set", "control.nonsense=1"]);
    let said = String::from_utf8_lossy(&refused.stderr);
    let keys = said.trim().split_once("use ").expect("a list").1.split(", ");
    for key in keys {
        let setting = format!("{key}=1");
        folder.refuses(&["run", "helix", "--set", &setting], &[&format!("control.{key}")]);
    }
}

#[test]
fn seeds_that_make_no_difference_are_said_once() {
    let folder = Folder::new("idle");
    let note = "the seed makes no difference: `helix` has no random part";
    let short = ["run", "helix", "--set", "duration_s=0.1"];
    for (more, said) in [(&["--seeds", "1..3"][..], 1), (&["--seed", "2"], 1), (&[], 0)] {
        let (_, err) = folder.prints(&[&short[..], more].concat());
        assert_eq!(err.matches(note).count(), said, "{more:?}: {err}");
    }
    let windy = ["--seed", "2", "--set", "wind.turbulence_20ft_m_s=5"];
    let (_, err) = folder.prints(&[&short[..], &windy].concat());
    assert!(!err.contains(note), "turbulence is drawn from the seed: {err}");
}

#[test]
fn a_flight_from_its_folder_is_the_same_flight() {
    let folder = Folder::new("again");
    let short = ["run", "outdoor-hover", "--set", "duration_s=3"];
    folder.prints(&[&short[..], &["--seed", "7", "--out", "flown"]].concat());
    let (out, err) = folder.prints(&["run", "flown/scenario.toml", "--json"]);
    assert!(err.contains("note: flown with seed 7, as provenance.toml has it"), "{err}");
    let hash = |text: &str| {
        let summary: serde_json::Value = serde_json::from_str(text).expect("JSON");
        summary["truth_sha256"].as_str().expect("a hash").to_owned()
    };
    let first = fs::read_to_string(folder.0.join("flown/summary.json")).expect("written");
    assert_eq!(hash(&out), hash(&first));
    let (out, err) = folder.prints(&["run", "flown/scenario.toml", "--json", "--seed", "8"]);
    assert!(!err.contains("note") && hash(&out) != hash(&first), "{err}");
}

#[test]
fn a_name_that_nobody_reads_to_its_end_is_shortened() {
    let folder = Folder::new("long");
    let name = "k".repeat(5000);
    for arguments in [&["run", &name][..], &["run", "helix", "--set", &format!("{name}=3")], &["run", "helix", &name]] {
        folder.refuses(arguments, &["kkkk…kkkk"]);
        assert!(folder.run(arguments).stderr.len() < 500, "{arguments:?}");
    }
    folder.refuses(&["run", "a\u{1b}[31mb.toml"], &["`a\\u{1b}[31mb.toml`"]);
}

#[test]
fn addresses_say_the_cure() {
    let folder = Folder::new("addresses");
    let socket = UdpSocket::bind("127.0.0.1:0").expect("a free port");
    let taken = socket.local_addr().expect("bound");
    let next = format!("--listen 127.0.0.1:{}", taken.port().checked_add(1).unwrap_or(65534));
    folder.refuses(&["serve", "--listen", &taken.to_string()], &[&taken.to_string(), "in use", &next]);
    // A name, and peers by name: as far as the port, which is taken.
    let by_name = format!("localhost:{}", taken.port());
    folder.refuses(&["serve", "--listen", &by_name, "--peer", "localhost"], &[&taken.to_string(), "in use"]);
    folder.refuses(
        &["serve", "--listen", "192.0.2.1:14580"],
        &["192.0.2.1", "no address of this machine", "127.0.0.1:14580"],
    );
    folder.refuses(&["serve", "--listen", "localhost:many"], &["--listen", "localhost:14580"]);
    folder.refuses(&["serve", "--listen", ""], &["--listen", "address is missing: use 127.0.0.1:14580"]);
    folder.refuses(
        &["serve", "--listen", "localhost:14599", "--peer", "localhost:14599"],
        &["--peer 127.0.0.1:14599 is where the vehicle itself listens", "127.0.0.1:14550"],
    );
    folder.refuses(&["serve", "--peer", ":14550"], &["--peer", "host is missing", "127.0.0.1:14550"]);
    folder.refuses(&["serve", "--listen", "[::1]:0"], &["[::1]:0", "127.0.0.1:14550", "IPv6"]);
    for (key, vehicle) in [("--listen", 2), ("--tcp", 3), ("--onboard", 3)] {
        let port = 65537 - vehicle;
        folder.refuses(
            &["serve", "--vehicles", "3", key, &format!("127.0.0.1:{port}")],
            &[&format!(
                "--vehicles 3: there is no port 65536 for vehicle {vehicle}: use {key} 127.0.0.1:65533 or lower"
            )],
        );
    }
}

//! Tuning: a search through the whole chain finds what is known to be best, and neither threads nor an interruption
//! change what it finds.

use std::fs;
use std::path::PathBuf;
use std::process::{Command, Output};

use crate::common::folder::Folder;
use anyhow::ensure;
use firmware::control::sliding::ReachingLaw;
use sim_host::controller::{Controller, TuningFile};
use sim_host::tune::{Journal, Method, Parameter, Run, Scale, Settings, Space, State};

fn journal_path(folder: &Folder) -> PathBuf {
    folder.0.join("journal.csv")
}

const NAMES: [&str; 3] = ["lambda", "gain", "horizon"];
const METHODS: [Method; 2] = [Method::Pso, Method::CmaEs];

fn settings(method: Method, iterations: usize) -> Settings {
    Settings { method, particles: 12, iterations, seed: 7 }
}

fn space() -> Space {
    let parameter = |keys: &[&str], low, high, scale| {
        let keys = keys.iter().map(|key| (*key).to_owned()).collect();
        Parameter { keys, factors: None, low, high, scale }
    };
    let parameters = vec![
        parameter(&["smc.x.lambda", "smc.y.lambda"], 0.1, 10.0, Scale::Log),
        parameter(&["smc.z.gain"], 0.0, 20.0, Scale::Linear),
        parameter(&["smc.roll.reaching.implicit-sgn.horizon_s"], 0.001, 1.0, Scale::Log),
    ];
    let base = include_str!("../../tunings/x500-smc.toml").parse().expect("TOML");
    Space::new("x500-smc", base, parameters).expect("valid")
}

/// Distance from the gains that are best, in units in which each counts the same.
fn distance(controller: &Controller) -> f64 {
    let Controller::Smc(control) = controller else { panic!("another controller") };
    let ReachingLaw::ImplicitSgn { horizon_s } = control.roll.reaching else { panic!("another law") };
    let lambda = libm::log(f64::from(control.x.lambda) / 3.0) + libm::log(f64::from(control.y.lambda) / 3.0);
    let gain = (f64::from(control.z.gain) - 12.0) / 10.0;
    let horizon = libm::log(f64::from(horizon_s) / 0.02);
    lambda * lambda + gain * gain + horizon * horizon
}

/// A vehicle that tells its cost without flying.
fn cost(point: &[f64]) -> f64 {
    distance(&space().controller(point).expect("a controller"))
}

fn go(settings: Settings, journal: Journal, jobs: usize) -> anyhow::Result<State> {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(jobs).build().expect("threads start");
    let run = Run { settings, dimensions: NAMES.len(), cost, journal };
    pool.install(|| run.go(|_| Ok(())))
}

#[test]
fn a_search_finds_the_best_gains_and_the_tuning_file_holds_them() {
    for method in METHODS {
        let folder = Folder::new(&format!("optimum-{}", method.name()));
        let journal = Journal::create(&journal_path(&folder), "optimum", &NAMES).expect("a file");
        let found = go(settings(method, 60), journal, 2).expect("searches");
        let text = space().tuning(&found.best_point, "found").expect("TOML");
        let tuning: TuningFile = toml::from_str(&text).expect("a tuning");
        assert_eq!(distance(&tuning.controller), found.best_cost());
        // Four digits of a gain leave 1e-6 of cost at most; the swarm comes within a percent of each gain.
        assert!(found.best_cost() < 1e-3, "{method:?}: {}", found.best_cost());
        assert!(found.iterations.windows(2).all(|pair| pair[1].best <= pair[0].best));
    }
}

#[test]
fn the_number_of_threads_changes_nothing() {
    for method in METHODS {
        let folder = Folder::new(&format!("threads-{}", method.name()));
        let run = |jobs: usize| {
            let path = folder.0.join(format!("{jobs}.csv"));
            let found = go(settings(method, 10), Journal::create(&path, "threads", &NAMES).expect("a file"), jobs);
            (found.expect("searches"), fs::read_to_string(path).expect("the journal is there"))
        };
        assert_eq!(run(1), run(4), "{method:?}");
    }
}

#[test]
fn a_run_that_was_interrupted_goes_on_to_the_bit() {
    for method in METHODS {
        let folder = Folder::new(&format!("resume-{}", method.name()));
        let whole_path = folder.0.join("whole.csv");
        let journal = Journal::create(&whole_path, "resume", &NAMES).expect("a file");
        let whole = go(settings(method, 12), journal, 2).expect("searches");
        let whole_text = fs::read_to_string(&whole_path).expect("the journal is there");

        // Interrupted in the middle of a line of the journal, in the middle of an iteration.
        let cut: usize = whole_text.lines().take(2 + 12 * 4 + 5).map(|line| line.len() + 1).sum::<usize>() + 9;
        fs::write(journal_path(&folder), &whole_text[..cut]).expect("a file");
        let flown = std::sync::atomic::AtomicUsize::new(0);
        let counted = |point: &[f64]| {
            flown.fetch_add(1, std::sync::atomic::Ordering::Relaxed);
            cost(point)
        };
        let journal = Journal::resume(&journal_path(&folder), "resume", &NAMES).expect("is this run's");
        let run = Run { settings: settings(method, 12), dimensions: NAMES.len(), cost: counted, journal };
        assert_eq!(run.go(|_| Ok(())).expect("searches"), whole, "{method:?}");
        assert_eq!(flown.into_inner(), 12 * 12 - (12 * 4 + 5), "what is known is not flown again");
        assert_eq!(fs::read_to_string(journal_path(&folder)).expect("the journal is there"), whole_text);
    }
}

#[test]
fn a_run_that_was_stopped_can_be_given_more_iterations() {
    let folder = Folder::new("more");
    let run =
        |iterations: usize, journal: Journal| go(settings(Method::Pso, iterations), journal, 2).expect("searches");
    let first = run(5, Journal::create(&journal_path(&folder), "more", &NAMES).expect("a file"));
    let more = run(9, Journal::resume(&journal_path(&folder), "more", &NAMES).expect("is this run's"));
    assert_eq!(first.iterations, more.iterations[..5]);
    assert_eq!(more.iterations.len(), 9);
}

#[test]
fn a_journal_of_another_run_is_refused() {
    let folder = Folder::new("other");
    let path = journal_path(&folder);
    let refusal = |journal: anyhow::Result<Journal>| format!("{:#}", journal.expect_err("must be refused"));
    assert!(refusal(Journal::resume(&path, "a", &NAMES)).contains("journal.csv"));
    go(settings(Method::Pso, 2), Journal::create(&path, "a", &NAMES).expect("a file"), 1).expect("searches");
    assert!(refusal(Journal::create(&path, "a", &NAMES)).contains("--resume"));
    assert!(refusal(Journal::resume(&path, "b", &NAMES)).contains("another run"));
    // The same name, but other points: the seed of the search stands for a program that searches otherwise.
    let journal = Journal::resume(&path, "a", &NAMES).expect("the same name");
    let error = go(Settings { seed: 8, ..settings(Method::Pso, 2) }, journal, 1).expect_err("other points");
    assert!(error.to_string().contains("another version"), "{error:#}");
    let text = fs::read_to_string(&path).expect("the journal is there");
    fs::write(&path, text + "1.0,zero,0.5,0.5\n").expect("a file");
    assert!(refusal(Journal::resume(&path, "a", &NAMES)).contains("damaged"));
}

#[test]
fn an_observer_that_fails_ends_the_run() {
    let folder = Folder::new("observer");
    let journal = Journal::create(&journal_path(&folder), "observer", &NAMES).expect("a file");
    let run = Run { settings: settings(Method::Pso, 5), dimensions: NAMES.len(), cost, journal };
    let mut seen = 0;
    let error = run.go(|state| {
        seen = state.iterations.len();
        ensure!(seen < 2, "the disk is full");
        Ok(())
    });
    assert_eq!(error.expect_err("it fails").to_string(), "the disk is full");
    assert_eq!(seen, 2);
}

/// A tune that takes a second: one flight of hovering, from files of the user's own.
struct Files(Folder);

impl Files {
    fn new(name: &str) -> Self {
        let files = Self(Folder::new(name));
        files.write("base.toml", include_str!("../../tunings/x500-smc.toml"));
        files.write(
            "matrix.toml",
            "summary = \"hover\"\ncontrollers = [\"base.toml\"]\nscenarios = [\"x500-hover\"]\nseeds = \"11..12\"\n\
             disturbances = [{ name = \"none\", set = [\"duration_s=1\"] }, \
             { name = \"wind\", set = [\"duration_s=1\", \"wind.turbulence_20ft_m_s=7.7\"] }]\n",
        );
        files.write(
            "course.toml",
            "summary = \"hover\"\nmatrix = \"matrix.toml\"\nseeds = \"1..2\"\n[cost]\nrms = 1.0\nfloor = 1e-3\n\
             yaw = 0.1\nsettling = 0.5\nchattering = 0.1\nsaturation = 0.5\nlost = 10.0\n",
        );
        files.write(
            "tune.toml",
            "summary = \"hover\"\nbase = \"base.toml\"\ncourse = \"course.toml\"\n\
             [[parameters]]\nkeys = [\"smc.z.lambda\"]\nlow = 0.5\nhigh = 8.0\n\
             [[parameters]]\nkeys = [\"smc.x.lambda\", \"smc.y.lambda\"]\nlow = 0.5\nhigh = 8.0\nscale = \"linear\"\n",
        );
        files
    }

    fn write(&self, name: &str, text: &str) {
        fs::write(self.0.0.join(name), text).expect("the temporary folder can be written");
    }

    fn read(&self, name: &str) -> String {
        fs::read_to_string(self.0.0.join(name)).unwrap_or_else(|error| panic!("{name}: {error}"))
    }

    fn run(&self, arguments: &[&str]) -> Output {
        let mut command = Command::new(env!("CARGO_BIN_EXE_sim-host"));
        command.args(arguments).current_dir(&self.0.0).output().expect("the program starts")
    }

    fn tune(&self, iterations: &str, out: &str, more: &[&str]) -> Output {
        let arguments = ["tune", "tune.toml", "--particles", "4", "--iterations", iterations, "--out", out];
        self.run(&[&arguments, more].concat())
    }

    /// The files as they are, but for one in which `from` stands as `to`: one line that names `culprits`, exit code 2.
    fn refuses(&self, file: &str, from: &str, to: &str, culprits: &[&str]) {
        let sound = self.read(file);
        assert!(sound.contains(from), "{file} has no {from}");
        self.write(file, &sound.replacen(from, to, 1));
        let output = self.tune("2", "refused", &[]);
        self.write(file, &sound);
        let complaint = String::from_utf8(output.stderr).expect("UTF-8");
        assert_eq!(output.status.code(), Some(2), "{to}: {complaint}");
        assert_eq!(complaint.lines().count(), 1, "{to}: {complaint}");
        assert!(culprits.iter().all(|culprit| complaint.contains(culprit)), "{to}: {complaint}");
    }
}

#[test]
fn a_run_leaves_a_tuning_that_a_scenario_loads() {
    let files = Files::new("files");
    let output = files.tune("3", "whole", &["--jobs", "2"]);
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    assert!(String::from_utf8_lossy(&output.stdout).contains("12 evaluations of 3 flights"));
    let tuning = files.read("whole/tuning.toml");
    assert!(tuning.contains("sim-host tune tune.toml --method pso --particles 4 --iterations 3 --seed 1"), "{tuning}");
    assert_eq!(files.read("whole/progress.csv").lines().count(), 1 + 3);
    assert!(files.read("whole/convergence.svg").starts_with("<svg"));
    let flown = files.run(&["run", "x500-hover", "--json", "--set", "tuning=whole/tuning.toml"]);
    assert!(flown.status.success(), "{}", String::from_utf8_lossy(&flown.stderr));

    // The same in two parts, on another number of threads.
    assert!(files.tune("2", "parts", &["--jobs", "1"]).status.success());
    assert!(files.tune("3", "parts", &["--jobs", "3", "--resume"]).status.success());
    for file in ["tuning.toml", "progress.csv", "journal.csv", "convergence.svg"] {
        assert_eq!(files.read(&format!("parts/{file}")), files.read(&format!("whole/{file}")), "{file}");
    }
    for refused in [files.tune("3", "whole", &[]), files.tune("3", "nowhere", &["--resume"])] {
        assert_eq!(refused.status.code(), Some(2));
        assert!(String::from_utf8_lossy(&refused.stderr).contains("journal.csv"));
    }
}

#[test]
fn spoilt_files_are_refused_by_file_and_key() {
    let files = Files::new("spoilt");
    for (file, from, to, culprits) in [
        ("tune.toml", "base.toml", "bass.toml", ["tune.toml", "bass.toml"]),
        ("tune.toml", "course.toml", "curse.toml", ["tune.toml", "curse.toml"]),
        ("tune.toml", "smc.z.lambda", "smc.z.lamda", ["base.toml", "smc.z.lamda"]),
        ("tune.toml", "low = 0.5", "low = 9.0", ["tune.toml", "low"]),
        ("tune.toml", "low = 0.5", "lowest = 0.5", ["tune.toml", "lowest"]),
        ("tune.toml", "linear", "cubic", ["tune.toml", "cubic"]),
        ("base.toml", "tilt_max_rad = 1.2", "tilt_max_rad = -1.0", ["tune.toml", "tilt"]),
        ("base.toml", "tilt_max_rad", "tilt_most_rad", ["base.toml", "tilt_most_rad"]),
        ("course.toml", "matrix.toml", "matrices.toml", ["course.toml", "matrices.toml"]),
        ("course.toml", "1..2", "1..11", ["course.toml", "seeds"]),
        ("course.toml", "seeds = \"1..2\"", "", ["course.toml", "seeds"]),
        ("course.toml", "seeds = ", "scenarios = [\"x500-hoover\"]\nseeds = ", ["course.toml", "x500-hoover"]),
        ("course.toml", "seeds = ", "disturbances = [\"rain\"]\nseeds = ", ["course.toml", "rain"]),
        ("course.toml", "seeds = ", "disturbances = []\nseeds = ", ["course.toml", "disturbances"]),
        ("course.toml", "rms = 1.0", "rms = -1.0", ["course.toml", "cost.rms"]),
        ("course.toml", "floor = 1e-3", "floor = 0.0", ["course.toml", "cost.floor"]),
        ("course.toml", "saturation", "saturating", ["course.toml", "saturating"]),
    ] {
        files.refuses(file, from, to, &culprits);
    }
    for (option, value) in [("--particles", "3"), ("--iterations", "0"), ("--jobs", "0"), ("--method", "guess")] {
        let output = files.run(&["tune", "tune.toml", "--out", "refused", option, value]);
        assert_eq!(output.status.code(), Some(2), "{option}");
        assert!(String::from_utf8_lossy(&output.stderr).contains(option), "{option}");
    }
}

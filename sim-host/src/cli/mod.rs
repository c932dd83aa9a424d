//! The command line: arguments, typed, and one module a command.
//!
//! Standard output is the result, standard error is progress and complaints. A complaint is one line and exit
//! code 2; a flight that ends badly is a result, not a complaint. A difference between image and desktop, or an
//! overrun, is one line and exit code 1.

mod analyse;
mod assess;
mod bench;
mod compare;
mod complaints;
mod demo;
mod fly;
mod hands;
mod names;
mod numbers;
mod paper;
mod pil;
mod plan;
mod replay;
mod run;
mod scenarios;
mod serve;
mod sweep;
mod tune;

use std::io::Write as _;
use std::net::SocketAddr;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use anyhow::{Context, Result};
use clap::builder::{StringValueParser, TypedValueParser};
use clap::{Args, Parser, Subcommand};
use complaints::{complain, one_line, refuse, tell};
use numbers::{number, whole};

use crate::interrupt::{self, Interrupted};
use crate::link;
use crate::refusal::Refusal;
use crate::scenario::Scenario;
use crate::seeds::{self, Seeds};
use crate::serve::SPEEDS;
use crate::tune::{ITERATIONS, Method, PARTICLES};

/// More threads than this do not make it faster.
const MOST_THREADS: usize = 256;

/// Glissade on the desktop: flies the firmware against a plant model, in lockstep.
///
/// Without a command: flies `outdoor-tour` on sensors and the paper's disturbed case, and leaves figures in runs/.
#[derive(Debug, Parser)]
#[command(name = "sim-host", version)]
struct Cli {
    #[command(subcommand)]
    command: Option<Command>,
}

#[derive(Debug, Subcommand)]
enum Command {
    /// Fly a scenario, for one seed or many.
    Run(RunArgs),
    /// List the built-in scenarios.
    Scenarios {
        /// Print a JSON array.
        #[arg(long)]
        json: bool,
    },
    /// Fly in real time for a ground station, over MAVLink and UDP.
    Serve(ServeArgs),
    /// Fly a scenario with the Cortex-M image under QEMU in the loop, and compare it with the desktop bit for bit.
    Pil(PilArgs),
    /// Margins, attitude bandwidth and noise of a scenario's loops about hover: linear, and as the simulation has them.
    Analyse {
        #[command(flatten)]
        which: Which,
        /// Seed of the test noise.
        #[arg(long, default_value_t = 1, value_parser = seeds::number, allow_negative_numbers = true)]
        seed: u64,
        /// Write analyse.json and figures there.
        #[arg(long, value_name = "DIR")]
        out: Option<PathBuf>,
        /// Print a JSON object.
        #[arg(long)]
        json: bool,
    },
    /// Fly many seeds of the scenarios that are judged, and print percentiles beside what is expected of them.
    Assess(AssessArgs),
    /// Measure how fast the simulation is.
    Bench {
        /// Simulated seconds a run.
        #[arg(long, default_value_t = 2000.0, value_parser = number(1.0..=1e6), allow_negative_numbers = true)]
        seconds: f64,
        /// Runs; the median counts.
        #[arg(long, default_value_t = 5, value_parser = whole(1..=10_000_usize), allow_negative_numbers = true)]
        runs: usize,
        /// Print a JSON object.
        #[arg(long)]
        json: bool,
    },
    /// Scale a scenario's disturbance up until it fails.
    Sweep {
        #[command(flatten)]
        which: Which,
        /// Seed of the random numbers.
        #[arg(long, default_value_t = 1, value_parser = seeds::number, allow_negative_numbers = true)]
        seed: u64,
        /// Print a JSON array.
        #[arg(long)]
        json: bool,
    },
    /// Fly every controller in every scenario under every disturbance of a matrix, and compare them.
    Compare(CompareArgs),
    /// Fly the paper's simulations, make its Figures 2 to 7, and hold its claims against what was flown.
    Paper {
        /// Write the figures, paper.md and paper.json there.
        #[arg(long, value_name = "DIR", default_value = "runs/paper")]
        out: PathBuf,
        /// Print a JSON object.
        #[arg(long)]
        json: bool,
    },
    /// Plan the path that joins a scenario's trajectory, and print it as that scenario's `[join]` table.
    Plan {
        #[command(flatten)]
        which: Which,
        /// Seed of the search.
        #[arg(long, default_value_t = 1, value_parser = seeds::number, allow_negative_numbers = true)]
        seed: u64,
        /// Flights to spend at most.
        #[arg(long, default_value_t = 60_000, value_parser = whole(1..=1_000_000_000_usize), allow_negative_numbers = true)]
        flights: usize,
    },
    /// Search for the gains of a controller, and write them as a tuning file.
    Tune(TuneArgs),
}

#[derive(Args, Clone, Debug)]
struct Settings {
    /// Set a key of the scenario, or of its airframe with `airframe.` before it. Repeatable.
    #[arg(long = "set", value_name = "KEY=VALUE")]
    set: Vec<String>,
}

/// On how many threads flights are flown.
#[derive(Args, Clone, Copy, Debug)]
struct Threads {
    /// Flights at once; as many as there are cores by default. The results do not depend on it.
    #[arg(long, value_name = "J", value_parser = jobs, allow_negative_numbers = true)]
    jobs: Option<usize>,
}

impl Threads {
    /// Threads for at most so many flights.
    fn pool(self, flights: u64) -> Result<rayon::ThreadPool> {
        let most = usize::try_from(flights).map_or(MOST_THREADS, |flights| flights.clamp(1, MOST_THREADS));
        rayon::ThreadPoolBuilder::new()
            .num_threads(self.jobs.map_or(0, |jobs| jobs.min(most)))
            .build()
            .context("cannot start the threads for --jobs: choose fewer")
    }
}

fn jobs(text: &str) -> Result<usize, String> {
    let jobs = text.parse().ok().filter(|jobs| *jobs > 0);
    jobs.ok_or_else(|| "flights at once are a whole number from 1 up; leave it out for one on each core".to_owned())
}

fn listen_address(text: &str) -> Result<SocketAddr, String> {
    link::address::parse(text, link::LISTEN_PORT).map_err(|error| format!("{error:#}"))
}

fn tcp_address(text: &str) -> Result<SocketAddr, String> {
    link::address::parse(text, link::TCP_PORT).map_err(|error| format!("{error:#}"))
}

fn vehicles(text: &str) -> Result<u16, String> {
    let count = text.parse().ok().filter(|count| (1..=250).contains(count));
    count.ok_or_else(|| "vehicles are a whole number from 1 to 250".to_owned())
}

fn peer_address(text: &str) -> Result<SocketAddr, String> {
    address_to_send_to(text, link::PEER_PORT)
}

fn onboard_address(text: &str) -> Result<SocketAddr, String> {
    address_to_send_to(text, link::ONBOARD_PORT)
}

fn address_to_send_to(text: &str, default_port: u16) -> Result<SocketAddr, String> {
    match link::address::parse(text, default_port) {
        Ok(address) if address.ip().is_unspecified() => {
            Err(format!("the host is missing: use 127.0.0.1:{}", address.port()))
        }
        other => other.map_err(|error| format!("{error:#}")),
    }
}

/// A scenario, and what is to be different in it.
#[derive(Args, Clone, Debug)]
struct Which {
    /// Name of a built-in scenario, or path of a file.
    scenario: String,
    #[command(flatten)]
    settings: Settings,
}

impl Which {
    fn load(&self) -> Result<Scenario> {
        load(&self.scenario, &self.settings.set)
    }
}

#[derive(Args, Clone, Debug)]
struct RunArgs {
    #[command(flatten)]
    which: Which,
    /// Seed of the random numbers; of a scenario.toml that an earlier run has left, the one it flew, else 1.
    #[arg(long, value_parser = seeds::number, allow_negative_numbers = true, conflicts_with = "seeds")]
    seed: Option<u64>,
    /// Seeds to fly, first and last.
    #[arg(long, value_name = "A..B", allow_hyphen_values = true)]
    seeds: Option<Seeds>,
    #[command(flatten)]
    threads: Threads,
    /// Fly it as it was flown in a recording of `serve --record`.
    #[arg(long, value_name = "FILE", conflicts_with = "seeds")]
    replay: Option<PathBuf>,
    /// Write truth.csv, summary.json and figures there; with several seeds, into a folder a seed.
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Print a JSON object, or an array for several seeds.
    #[arg(long)]
    json: bool,
}

#[derive(Args, Clone, Debug)]
struct AssessArgs {
    /// Names of built-in scenarios, or paths of files; all built-in ones that are judged without any.
    scenarios: Vec<String>,
    /// Seeds to fly, first and last.
    #[arg(long, value_name = "A..B", default_value = "1..100", allow_hyphen_values = true)]
    seeds: Seeds,
    #[command(flatten)]
    threads: Threads,
    /// Print a JSON array.
    #[arg(long)]
    json: bool,
    #[command(flatten)]
    settings: Settings,
}

#[derive(Args, Clone, Debug)]
struct CompareArgs {
    /// Name of a built-in matrix, or path of a file.
    #[arg(default_value = "x500")]
    matrix: String,
    /// Tunings to compare, by name or path, in place of the matrix' own; the others are compared with the first.
    #[arg(long, value_name = "NAME,...", value_delimiter = ',', value_parser = trimmed())]
    controllers: Option<Vec<String>>,
    /// Only these of the matrix' scenarios.
    #[arg(long, value_name = "NAME,...", value_delimiter = ',', value_parser = trimmed())]
    scenarios: Option<Vec<String>>,
    /// Only these of the matrix' disturbances.
    #[arg(long, value_name = "NAME,...", value_delimiter = ',', value_parser = trimmed())]
    disturbances: Option<Vec<String>>,
    /// Seeds to fly, first and last, in place of the matrix' own.
    #[arg(long, value_name = "A..B", allow_hyphen_values = true)]
    seeds: Option<Seeds>,
    #[command(flatten)]
    threads: Threads,
    /// Write compare.json, compare.csv, compare.md and figures there.
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Print a JSON object.
    #[arg(long)]
    json: bool,
    #[command(flatten)]
    settings: Settings,
}

#[derive(Args, Clone, Debug)]
struct ServeArgs {
    /// Name of a built-in scenario, or path of a file.
    #[arg(default_value = "field")]
    scenario: String,
    /// Address to receive on: `HOST:PORT`, `HOST`, or `:PORT` for every interface.
    #[arg(long, value_name = "ADDRESS", default_value = link::DEFAULT_LISTEN, value_parser = listen_address)]
    listen: SocketAddr,
    /// Address of a ground station: `HOST:PORT`, or `HOST` for port 14550. Repeatable; without it and `--onboard`, a ground
    /// station on port 14550 and a program on port 14540 of this machine.
    #[arg(long = "peer", value_name = "ADDRESS", value_parser = peer_address)]
    peers: Vec<SocketAddr>,
    /// Address of a program that is told more, as one on board: MAVSDK. Repeatable.
    #[arg(long = "onboard", value_name = "ADDRESS", value_parser = onboard_address)]
    onboard: Vec<SocketAddr>,
    /// Ground stations can connect by TCP too, on 127.0.0.1:5760 or another `HOST:PORT`.
    #[arg(long, value_name = "ADDRESS", value_parser = tcp_address, num_args = 0..=1, default_missing_value = link::DEFAULT_TCP)]
    tcp: Option<SocketAddr>,
    /// MAVLink system of the vehicle, 1 to 250, in place of the scenario's.
    #[arg(long, value_name = "N", value_parser = whole(1..=250_u32), allow_negative_numbers = true)]
    sysid: Option<u32>,
    /// Vehicles to fly by one clock, 1 to 250: each has the next system, seed, `--listen` and `--onboard` port.
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = vehicles, allow_negative_numbers = true)]
    vehicles: u16,
    /// Record what comes from outside into a new file, for `run --replay` and `pil --replay`.
    #[arg(long, value_name = "FILE")]
    record: Option<PathBuf>,
    /// Simulated seconds per second, 0.01 to 1000.
    #[arg(long, default_value_t = 1.0, value_parser = number(SPEEDS), allow_negative_numbers = true)]
    speed: f64,
    /// Seed of the random numbers.
    #[arg(long, default_value_t = 1, value_parser = seeds::number, allow_negative_numbers = true)]
    seed: u64,
    /// Keep the parameters that ground stations set in this file, and load them from it.
    #[arg(long, value_name = "FILE")]
    params: Option<PathBuf>,
    #[command(flatten)]
    hands: hands::HandsArgs,
    #[command(flatten)]
    settings: Settings,
}

#[derive(Args, Clone, Debug)]
struct PilArgs {
    #[command(flatten)]
    which: Which,
    /// Seed of the random numbers; 1, or that of the recording.
    #[arg(long, value_parser = seeds::number, allow_negative_numbers = true)]
    seed: Option<u64>,
    /// Fly it as it was flown in a recording of `serve --record`.
    #[arg(long, value_name = "FILE")]
    replay: Option<PathBuf>,
    /// The image; by default the one that `cargo fw-pil` has built.
    #[arg(long, value_name = "ELF")]
    image: Option<PathBuf>,
    /// Let the outer partition's jobs take this much longer, µs of the target's time.
    #[arg(long, default_value_t = 0, value_name = "US", value_parser = whole(0..=u32::MAX), allow_negative_numbers = true)]
    busy_outer_us: u32,
    /// Let the commander's jobs take this much longer, µs.
    #[arg(long, default_value_t = 0, value_name = "US", value_parser = whole(0..=u32::MAX), allow_negative_numbers = true)]
    busy_commander_us: u32,
    /// Let the ground partition's jobs take this much longer, µs.
    #[arg(long, default_value_t = 0, value_name = "US", value_parser = whole(0..=u32::MAX), allow_negative_numbers = true)]
    busy_ground_us: u32,
    /// Write truth.csv and summary.json there.
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Print a JSON object.
    #[arg(long)]
    json: bool,
}

#[derive(Args, Clone, Debug)]
struct TuneArgs {
    /// Name of a built-in tune, or path of a file.
    tune: String,
    /// How to search.
    #[arg(long, value_enum, default_value_t = Method::Pso)]
    method: Method,
    /// Points an iteration.
    #[arg(long, default_value_t = 40, value_parser = whole(PARTICLES), allow_negative_numbers = true)]
    particles: usize,
    /// Iterations, the first random points among them.
    #[arg(long, default_value_t = 60, value_parser = whole(ITERATIONS), allow_negative_numbers = true)]
    iterations: usize,
    /// Seed of the search.
    #[arg(long, default_value_t = 1, value_parser = seeds::number, allow_negative_numbers = true)]
    seed: u64,
    #[command(flatten)]
    threads: Threads,
    /// Write tuning.toml, progress.csv, convergence.svg and the journal there.
    #[arg(long, value_name = "DIR")]
    out: PathBuf,
    /// Go on with the run in that folder.
    #[arg(long)]
    resume: bool,
}

/// Runs the program.
pub fn main() -> ExitCode {
    let cli = match Cli::try_parse() {
        Ok(cli) => cli,
        Err(error) => return refuse(&error),
    };
    let result = interrupt::handle_signals().and_then(|()| execute(cli.command));
    match result {
        Ok(()) => ExitCode::SUCCESS,
        // What was flown has been reported.
        Err(error) if error.is::<Interrupted>() => ExitCode::from(interrupt::exit_code()),
        Err(error) => {
            complain(&one_line(&error));
            ExitCode::from(if error.is::<run::SomeFailed>() || pil::is_finding(&error) || error.is::<assess::Unmet>() {
                1
            } else {
                2
            })
        }
    }
}

fn execute(command: Option<Command>) -> Result<()> {
    match command {
        None => demo::run(),
        Some(Command::Run(args)) => run::run(&args),
        Some(Command::Scenarios { json }) => scenarios::run(json),
        Some(Command::Serve(args)) => serve::run(&args),
        Some(Command::Pil(args)) => pil::run(&args),
        Some(Command::Analyse { which, seed, out, json }) => analyse::run(&which, seed, out.as_deref(), json),
        Some(Command::Assess(args)) => assess::run(&args),
        Some(Command::Bench { seconds, runs, json }) => bench::run(seconds, runs, json),
        Some(Command::Sweep { which, seed, json }) => sweep::run(&which, seed, json),
        Some(Command::Compare(args)) => compare::run(&args),
        Some(Command::Paper { out, json }) => paper::run(&out, json),
        Some(Command::Plan { which, seed, flights }) => plan::run(&which, seed, flights),
        Some(Command::Tune(args)) => tune::run(&args),
    }
}

/// Says, once, that seeds were given to a scenario of which none makes a difference.
fn note_idle_seeds(scenario: &Scenario, given: bool) {
    if given && !scenario.file.is_random() {
        complain(&format!("note: the seed makes no difference: `{}` has no random part", scenario.name));
    }
}

/// A name of a list, whatever blanks stand around it.
fn trimmed() -> impl TypedValueParser<Value = String> {
    StringValueParser::new().map(|name| name.trim().to_owned())
}

/// A scenario; what of it comes after its end is told, and flown without.
fn load(name: &str, settings: &[String]) -> Result<Scenario> {
    names::require(names::Kind::Scenario, name)?;
    let scenario = Scenario::load(name, settings)?;
    for late in scenario.file.too_late() {
        complain(&never_begins(&late));
    }
    note_mismatches(&scenario, settings);
    Ok(scenario)
}

fn note_mismatches(scenario: &Scenario, settings: &[String]) {
    for mismatch in scenario.mismatches(settings) {
        complain(&format!("note: {mismatch}"));
    }
}

/// The note of what comes after the end of a flight.
fn never_begins(late: &Refusal) -> String {
    format!("note: {late}: it never begins")
}

/// A result, and where its folder has been written, if one was.
fn and_wrote(text: String, out: Option<&Path>, contents: Option<String>) -> String {
    match (out, contents) {
        (Some(out), Some(contents)) => format!("{}\n\n{}", text.trim_end(), wrote(out, &contents)),
        _ => text,
    }
}

/// Where a folder has been written, and what it holds.
fn wrote(folder: &Path, contents: &str) -> String {
    format!("wrote {}: {contents}", folder.display())
}

/// Writes a result to standard output. A reader that has gone away is not an error.
fn say(text: &str) -> Result<()> {
    let mut out = std::io::stdout().lock();
    match writeln!(out, "{}", text.trim_end()).and_then(|()| out.flush()) {
        Err(error) if error.kind() != std::io::ErrorKind::BrokenPipe => Err(error).context("cannot write the result"),
        _ => Ok(()),
    }
}

#[cfg(test)]
mod tests {
    use clap::CommandFactory as _;

    use super::*;

    #[test]
    fn the_arguments_are_consistent() {
        Cli::command().debug_assert();
    }
}

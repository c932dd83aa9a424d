//! `pil`: flies a scenario with the image under QEMU in the loop, and holds it against the desktop bit for bit.

use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use anyhow::{Context, Result, bail};
use firmware::failure::Injectable;
use firmware::inner::InnerOutput;
use firmware::outer::OuterOutput;
use firmware::pil::AllSent;
use firmware::signals::TICK_S_EXACT;
use serde_json::json;

use super::{PilArgs, fly as report_of, replay};
use crate::flight;
use crate::interrupt::{self, Interrupted};
use crate::pil::{
    BusyWait, Difference, Overrun, Pil, PilOptions, PilOutput, SentDiffers, Stopped, compare, compare_sent,
};
use crate::plant::rigid_body::RigidBody;
use crate::record::Recorder;
use crate::report::{Metrics, Paint, Progress, Staged, Summary, TruthWriter, table};
use crate::scenario::Scenario;
use crate::sil::replay::Input;
use crate::sil::{End, Flight, Lockstep as _};
use crate::touchdown::Touchdown;

pub(super) fn run(args: &PilArgs) -> Result<()> {
    let (scenario, seed) = replay::load(&args.which, args.seed, args.replay.as_deref(), |_| 1)?;
    scenario.require_rigid_body()?;
    scenario.controller.require_smc("`pil`")?;
    if let Some(path) = &args.replay {
        require_no_restart(&scenario, seed, path)?;
    }
    let config = scenario.flight_config();
    let busy =
        BusyWait { outer_us: args.busy_outer_us, commander_us: args.busy_commander_us, ground_us: args.busy_ground_us };
    let timeout = Duration::from_secs(10);
    let flight = flight::lockstep(&scenario, seed, flight::rigid_body(&scenario, seed))?;
    let injectable = if scenario.replay.is_some() { flight.injectable() } else { Injectable::NONE };
    let image = image(args.image.as_deref())?;
    let settings = scenario.settings();
    let pil = Pil::start(&PilOptions { settings, injectable, busy, timeout, ..PilOptions::new(image, &config) })?;

    let bar = Progress::new(scenario.file.duration_s, !args.json);
    interrupt::listen();
    let staged = args.out.as_deref().map(Staged::begin).transpose()?;
    let Flown { summary, wall_s, sent } = match &staged {
        Some(staged) => {
            let folder = staged.folder();
            report_of::provenance(&folder, &scenario, &args.which.settings.set, seed)?;
            let flown = fly(&scenario, seed, flight, pil, folder.truth()?, bar)?;
            folder.summary(&flown.summary)?;
            flown
        }
        None => fly(&scenario, seed, flight, pil, TruthWriter::hash_only(), bar)?,
    };
    staged.map(Staged::finish).transpose()?;
    if summary.ended == End::Interrupted {
        super::say(&table::render(&summary, Paint::for_stdout()))?;
        return Err(Interrupted.into());
    }
    // The desktop alone, without the image, must leave the same bytes.
    let sil = report_of::fly(&scenario, seed, false)?;
    if sil.truth_sha256 != summary.truth_sha256 {
        return Err(TruthDiffers { desktop: sil.truth_sha256, image: summary.truth_sha256 }.into());
    }
    report(args, &summary, wall_s, &sent)
}

/// Refuses a recording in which a ground station restarts the vehicle, which the image would have to boot again for. What is
/// asked and not done, as while it is armed, is no obstacle: so the desktop flies it first.
fn require_no_restart(scenario: &Scenario, seed: u64, recording: &Path) -> Result<()> {
    let mut flight = flight::lockstep(scenario, seed, flight::rigid_body(scenario, seed))?;
    for _ in 0..scenario.ticks() {
        flight.hear_replayed();
        let sample = flight.sense();
        flight.ask_pilot();
        flight.autopilot.tick(Some(&sample));
        if flight.autopilot.inner.takes_restart() {
            bail!(
                "recording `{}`: a ground station restarts the vehicle before {:.1} s (PREFLIGHT_REBOOT_SHUTDOWN), and the \
                 image flies without a restart: record a flight that has none, or fly this one by `run --replay`",
                recording.display(),
                f64::from(flight.next_tick()) * TICK_S_EXACT
            );
        }
        flight.send_replayed();
        let InnerOutput { motors, saturated, .. } = *flight.autopilot.inner.inner_output();
        if !flight.actuate(&motors, saturated) {
            break;
        }
    }
    Ok(())
}

/// What came of a flight, how long it took, s, and what was sent on the links.
struct Flown {
    summary: Summary,
    wall_s: f64,
    sent: AllSent,
}

/// Two truth.csv that ought to be the same; their SHA-256.
#[derive(Debug)]
struct TruthDiffers {
    desktop: String,
    image: String,
}

impl std::fmt::Display for TruthDiffers {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "truth.csv differs: SHA-256 {} on the desktop, {} with the image", self.desktop, self.image)
    }
}

impl std::error::Error for TruthDiffers {}

/// Whether an error is what a comparison has found, rather than a reason why there was none.
pub(super) fn is_finding(error: &anyhow::Error) -> bool {
    error.is::<TruthDiffers>()
        || error.is::<Difference>()
        || error.is::<SentDiffers>()
        || error.is::<Overrun>()
        || error.is::<Stopped>()
}

/// The image to fly: the one named, else the one built in the workspace that this program or the user is in.
fn image(named: Option<&Path>) -> Result<PathBuf> {
    if let Some(path) = named {
        return Ok(path.to_owned());
    }
    let here = std::env::current_dir().context("there is no current folder")?;
    let built = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    for root in here.ancestors().chain([built.as_path()]) {
        let image = root.join(crate::pil::IMAGE);
        if image.is_file() {
            return Ok(image);
        }
    }
    bail!("no image: build it with `cargo fw-pil`, or name one with --image")
}

/// Flies plant and image in lockstep, the desktop's autopilot beside them.
fn fly<W: std::io::Write>(
    scenario: &Scenario,
    seed: u64,
    mut flight: Flight<RigidBody>,
    mut pil: Pil,
    truth: TruthWriter<W>,
    bar: Progress,
) -> Result<Flown> {
    let touchdown = flight::ground(scenario).map(Touchdown::new);
    let mut recorder = (((Metrics::new(), truth), bar), touchdown);
    let start = Instant::now();
    for _ in 0..scenario.ticks() {
        if !step(&mut flight, &mut pil, &mut recorder)? {
            break;
        }
        if recorder.stops() {
            flight.interrupt();
            break;
        }
    }
    // As at the end of every flight, a last look tells whether the vehicle was lost in the last tick.
    flight.look();
    let wall_s = start.elapsed().as_secs_f64();
    pil.finish()?;
    let (((metrics, truth), bar), touchdown) = recorder;
    bar.finish();
    let flown = report_of::Flown { outcome: flight.outcome().after(touchdown.as_ref()), wall_s };
    let summary = report_of::summarise(scenario, seed, &flown, truth.finish()?, &metrics);
    Ok(Flown { summary, wall_s, sent: flight.sent() })
}

/// One tick. What moves the plant and what truth.csv records of the firmware is the image's; the desired attitude,
/// which only the figures of merit look at, is the desktop's.
fn step(flight: &mut Flight<RigidBody>, pil: &mut Pil, recorder: &mut impl Recorder) -> Result<bool> {
    for entry in flight.hear_replayed() {
        match &entry.input {
            Input::Link { link, event } => pil.link(*link, event.event())?,
            Input::Ask(asked) => pil.ask(*asked)?,
        }
    }
    let sample = flight.sense();
    if let Some(asked) = flight.ask_pilot() {
        pil.ask(asked)?;
    }
    flight.autopilot.tick(Some(&sample));
    flight.send_replayed();
    let image = pil.tick(&sample)?;
    compare(&flight.autopilot.inner, &image)?;
    compare_sent(flight.next_tick(), &flight.sent(), &image.sent)?;
    let inner = inner_of(&image);
    let outer = OuterOutput { s: image.s_position, ..*flight.autopilot.inner.outer_output() };
    flight.look_at(&inner, &outer).show(recorder);
    Ok(flight.actuate(&inner.motors, inner.saturated))
}

fn inner_of(image: &PilOutput) -> InnerOutput {
    InnerOutput { motors: image.motors, demand: image.demand, s: image.s_attitude, saturated: image.saturated }
}

fn report(args: &PilArgs, summary: &Summary, wall_s: f64, sent: &AllSent) -> Result<()> {
    let sent_bytes: u64 = sent.iter().map(|sent| u64::from(sent.bytes)).sum();
    let microseconds_a_tick = wall_s * 1e6 / (summary.duration_s * 1e3);
    if args.json {
        let verdict = json!({
            "scenario": summary.scenario,
            "seed": summary.seed,
            "duration_s": summary.duration_s,
            "truth_sha256": summary.truth_sha256,
            "bit_identical": true,
            "sent_bytes": sent_bytes,
            "real_time_factor": summary.real_time_factor,
        });
        return super::say(&verdict.to_string());
    }
    let sent = if sent_bytes > 0 { format!(", {sent_bytes} bytes of MAVLink") } else { String::new() };
    super::say(&format!(
        "{}image and desktop  the same, bit for bit: {} ticks{sent}, and truth.csv ({microseconds_a_tick:.0} µs a tick)",
        table::render(summary, Paint::for_stdout()),
        (summary.duration_s * 1e3).round()
    ))
}

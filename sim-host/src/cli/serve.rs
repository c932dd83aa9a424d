//! `serve`: flies in real time, with a console and for ground stations.

use std::net::SocketAddr;
use std::path::Path;

use anyhow::{Context as _, Result};
use firmware::config::Start;
use firmware::mavlink::port::Profile;
use firmware::settings::store::Loaded;

use super::ServeArgs;
use super::names::{self, Kind};
use crate::console::Session;
use crate::console::terminal::Stdio;
use crate::flash_file::ParameterFile;
use crate::flight;
use crate::interrupt::{self, Interrupted};
use crate::link::{DEFAULT_PEERS, Peer, UdpLinks};
use crate::scenario::Scenario;
use crate::serve::{Flown, Pacing, serve};

pub(super) fn run(args: &ServeArgs) -> Result<()> {
    names::require(Kind::Scenario, &args.scenario)?;
    let mut scenario = Scenario::load(&args.scenario, &args.settings.set)?;
    scenario.require_rigid_body()?;
    super::note_mismatches(&scenario, &args.settings.set);
    let mut parameters = None;
    if let Some(path) = &args.params {
        let mut settings = scenario.settings();
        let (file, loaded) = ParameterFile::open(path, &mut settings)?;
        scenario = scenario.with_settings(&settings).with_context(|| format!("--params {}", path.display()))?;
        eprintln!("{}", kept(path, &loaded));
        parameters = Some(file);
    }
    let flight = flight::lockstep(&scenario, args.seed, flight::rigid_body(&scenario, args.seed))?;
    let mut session = Session::new(flight).with_parameters(parameters).telling_the_truth(&scenario.file.home);
    let peers = peers(args);
    let mut links = UdpLinks::bind(args.listen, &peers)?;
    eprint!("{}", greeting(&scenario, links.local_address()?, &peers));
    interrupt::listen();
    let mut terminal = Stdio::new();
    let flown = serve(&mut session, &mut links, &mut terminal, Pacing { speed: args.speed }, interrupt::requested)?;
    drop(terminal);
    eprintln!("{}", farewell(&flown));
    if interrupt::requested() { Err(Interrupted.into()) } else { Ok(()) }
}

/// Whom the vehicle sends to without having heard of them.
fn peers(args: &ServeArgs) -> Vec<Peer> {
    if args.peers.is_empty() && args.onboard.is_empty() {
        return DEFAULT_PEERS.to_vec();
    }
    let named = |addresses: &[SocketAddr], profile| {
        addresses.iter().map(move |address| Peer { address: *address, profile }).collect::<Vec<_>>()
    };
    [named(&args.peers, Profile::Normal), named(&args.onboard, Profile::Onboard)].concat()
}

/// What flies, and how to talk to it.
fn greeting(scenario: &Scenario, listen: SocketAddr, peers: &[Peer]) -> String {
    let hint = |port: u16, hint| if peers.iter().any(|peer| peer.address.port() == port) { hint } else { "" };
    let addresses: Vec<String> = peers.iter().map(|peer| peer.address.to_string()).collect();
    format!(
        "`{}`{}\n\
         MAVLink goes to {}, and comes in on {listen}.\n\
         {}{}Type `help` for the commands; {}. `quit` or Ctrl-C ends it.\n",
        scenario.name,
        about(&scenario.file.summary),
        addresses.join(" and "),
        hint(
            14550,
            "Ground stations that listen on UDP port 14550 connect by themselves; MAVProxy: \
             mavproxy.py --master=udp:127.0.0.1:14550\n"
        ),
        hint(14540, "MAVSDK: udpin://0.0.0.0:14540\n"),
        first_flight(scenario),
    )
}

/// What to type first.
fn first_flight(scenario: &Scenario) -> &'static str {
    match (scenario.file.start, scenario.file.ground) {
        (Start::OnGround, _) => "`arm`, `takeoff 5`, `land` is a first flight",
        (Start::InFlight, true) => "it is in the air already: `goto 5 0 5`, `land`",
        (Start::InFlight, false) => "it is in the air already, with no ground to land on: `goto 5 0 5`, `hold`",
    }
}

/// What was loaded from a file of parameters.
fn kept(path: &Path, loaded: &Loaded) -> String {
    let Loaded { values, refused, .. } = *loaded;
    let left = if refused == 0 { String::new() } else { format!("; {refused} do not fit any more, and are left out") };
    format!("{values} parameters loaded from {}{left}", path.display())
}

fn about(summary: &str) -> String {
    if summary.is_empty() { String::new() } else { format!(": {summary}") }
}

/// How long was flown, and how fast.
fn farewell(flown: &Flown) -> String {
    let Flown { simulated_s, wall_s } = *flown;
    format!("flown {simulated_s:.1} s in {wall_s:.1} s: ran at {:.2} x real time", simulated_s / wall_s.max(1e-9))
}

//! `serve`: flies in real time, with a console and for ground stations.

use std::net::SocketAddr;
use std::path::Path;

use anyhow::{Context as _, Result, anyhow, bail, ensure};
use firmware::config::Start;
use firmware::mavlink::port::Profile;
use firmware::settings::store::Loaded;
use firmware::settings::{MAV_SYS_ID, Value};

use super::ServeArgs;
use super::names::{self, Kind};
use crate::console::Session;
use crate::flash_file::ParameterFile;
use crate::flight;
use crate::hands::station::Station;
use crate::interrupt::{self, Interrupted};
use crate::link::address::{elsewhere, is_own};
use crate::link::{DEFAULT_PEERS, LAST_ONBOARD_PORT, LISTEN_PORT, Links, Peer};
use crate::recording::{Header, Recorder, arguments};
use crate::scenario::Scenario;
use crate::serve::{Flown, Member, Pacing, serve};
use crate::words::counted;

/// Distance between the homes of several vehicles, m: to the east, so that they stand side by side on a map.
const APART_M: f64 = 5.0;
/// Metres of a degree of latitude.
const METRES_A_DEGREE: f64 = 111_320.0;

pub(super) fn run(args: &ServeArgs) -> Result<()> {
    names::require(Kind::Scenario, &args.scenario)?;
    require_ports(args)?;
    require_no_overlap(args)?;
    let listeners: Vec<SocketAddr> = (0..args.vehicles).map(|number| further(args.listen, number)).collect();
    require_apart(args, &listeners)?;
    let mut set = args.settings.set.clone();
    set.extend(args.sysid.map(|system| format!("params.MAV_SYS_ID={system}")));
    let scenario = Scenario::load(&args.scenario, &set)?;
    scenario.require_rigid_body()?;
    super::note_mismatches(&scenario, &set);
    let (scenario, parameters) = with_parameters(args, scenario)?;
    let hands = args.hands.open()?;
    let header = Header::new(&scenario, &set, args.seed)?;
    let recorder = recorder(args, &header)?;
    let mut fleet = Vec::new();
    for number in 0..args.vehicles {
        fleet.push(member(&scenario, args, number)?);
    }
    // Ports that the system has chosen are known only now.
    let listeners: Vec<SocketAddr> = fleet.iter().map(|one| one.links.local_address()).collect::<Result<_>>()?;
    require_apart(args, &listeners)?;
    if hands.is_some() {
        fleet.iter_mut().try_for_each(seat_pilot)?;
    }
    greet(args, &scenario, &fleet)?;
    if let Some(first) = fleet.first_mut() {
        first.vehicle.keep_parameters(parameters);
        first.recorder = recorder;
    }
    interrupt::listen();
    let mut terminal = args.hands.terminal()?;
    let flown = serve(&mut fleet, &mut terminal, hands, Pacing { speed: args.speed }, interrupt::requested);
    // However it has ended: what was set in flight is not lost with a recording that cannot be written.
    let saved = fleet.first_mut().map_or(Ok(0), |first| first.vehicle.save_at_end());
    drop(terminal);
    match saved? {
        0 => {}
        1 => super::tell("1 parameter that was set in flight is saved"),
        count => super::tell(&format!("{count} parameters that were set in flight are saved")),
    }
    super::tell(&farewell(&flown?));
    let recorder = fleet.first().and_then(|first| first.recorder.as_ref());
    if let (Some(path), Some(true)) = (&args.record, recorder.map(Recorder::is_whole)) {
        let again = again(args, &set, path);
        super::tell(&format!("recorded into {}: fly it again by sim-host {again}", path.display()));
    }
    if interrupt::requested() { Err(Interrupted.into()) } else { Ok(()) }
}

/// The scenario with what a file of parameters keeps, and that file, if one is named.
fn with_parameters(args: &ServeArgs, scenario: Scenario) -> Result<(Scenario, Option<ParameterFile>)> {
    let Some(path) = &args.params else { return Ok((scenario, None)) };
    ensure!(args.vehicles == 1, "--params is one vehicle's file: leave out --vehicles {}", args.vehicles);
    let mut settings = scenario.settings();
    let (file, loaded) = ParameterFile::open(path, &mut settings)?;
    if let Some(system) = args.sysid {
        // What is asked for now wins over what was kept; it is not kept by that.
        settings.restore(MAV_SYS_ID, Value::Int(system.cast_signed())).map_err(|_| anyhow!("--sysid {system}"))?;
    }
    let scenario = scenario.with_settings(&settings).with_context(|| format!("--params {}", path.display()))?;
    super::tell(&kept(path, &loaded));
    Ok((scenario, Some(file)))
}

/// Says what flies, and where.
fn greet(args: &ServeArgs, scenario: &Scenario, fleet: &[Member<Session>]) -> Result<()> {
    if let Some(first) = fleet.first() {
        super::tell(&greeting(scenario, first.links.local_address()?, &peers(args, 0)));
    }
    if args.vehicles > 1 {
        super::tell(&format!("{} vehicles; `vehicle N` selects the one that typed lines are for.", args.vehicles));
    }
    for (number, member) in (0..).zip(fleet).skip(1) {
        let addresses: Vec<String> = peers(args, number).iter().map(|peer| peer.address.to_string()).collect();
        let (number, listen) = (number + 1, member.links.local_address()?);
        super::tell(&format!("Vehicle {number} sends to {}, and listens on {listen}.", addresses.join(" and ")));
    }
    args.hands.hint().into_iter().for_each(super::tell);
    Ok(())
}

/// Gives a link of a vehicle to who flies by hand.
fn seat_pilot(member: &mut Member<Session>) -> Result<()> {
    member.vehicle.seat_pilot(member.links.seat_pilot()?);
    let system = member.vehicle.flight().autopilot.ground.settings().system_id();
    member.pilot = Some(Station::new(system));
    Ok(())
}

/// The vehicle with this number, from 0: each has the next system, seed and ports, and its home beside the last one's.
fn member(scenario: &Scenario, args: &ServeArgs, number: u16) -> Result<Member<Session>> {
    let first = scenario.settings().system_id();
    let mut scenario = scenario.clone();
    if number > 0 {
        let mut settings = scenario.settings();
        let system = i32::from(settings.system_id()) + i32::from(number);
        settings.set(MAV_SYS_ID, Value::Int(system), false).map_err(|_| {
            anyhow!("--vehicles {}: there is no MAVLink system {system}: they go to 250", args.vehicles)
        })?;
        scenario = scenario.with_settings(&settings)?;
        let home = &mut scenario.file.home;
        let degree_m = METRES_A_DEGREE * libm::cos(home.latitude_deg.to_radians()).max(1e-3);
        home.longitude_deg += f64::from(number) * APART_M / degree_m;
    }
    let seed = args.seed.wrapping_add(number.into());
    let flight = flight::lockstep(&scenario, seed, flight::rigid_body(&scenario, seed))?;
    let last = u8::try_from(u16::from(first) + args.vehicles - 1).unwrap_or(u8::MAX);
    let vehicle = Session::new(flight).among(first..=last).telling_the_truth(&scenario.file.home);
    let mut links = Links::bind(further(args.listen, number), &peers(args, number))?;
    if is_presumed(args) {
        links = links.presuming_its_peers();
    }
    if let Some(listen) = args.tcp {
        let server = links.serve_tcp(further(listen, number))?;
        let whose = if args.vehicles > 1 { format!(" of vehicle {}", number + 1) } else { String::new() };
        super::tell(&format!("Ground stations{whose} can connect by TCP to {server}."));
    }
    Ok(Member { vehicle, links, recorder: None, pilot: None })
}

/// The address of the vehicle with this number; a port that the system chooses stays that.
fn further(address: SocketAddr, number: u16) -> SocketAddr {
    let port = if address.port() == 0 { 0 } else { address.port().saturating_add(number) };
    SocketAddr::new(address.ip(), port)
}

/// Refuses addresses from which on there are not enough ports for all vehicles.
fn require_ports(args: &ServeArgs) -> Result<()> {
    let onboard = args.onboard.iter().map(|address| ("--onboard", *address));
    let tcp = args.tcp.map(|address| ("--tcp", address));
    for (key, address) in onboard.chain(tcp).chain([("--listen", args.listen)]) {
        let highest = u16::MAX - (args.vehicles - 1);
        ensure!(
            address.port() <= highest,
            "--vehicles {}: there is no port 65536 for vehicle {}: use {key} {} or lower",
            args.vehicles,
            u16::MAX - address.port() + 2,
            SocketAddr::new(address.ip(), highest)
        );
    }
    Ok(())
}

/// Refuses programs' ports that go on, from vehicle to vehicle, into a ground station's.
fn require_no_overlap(args: &ServeArgs) -> Result<()> {
    for onboard in &args.onboard {
        for number in 1..args.vehicles {
            let address = further(*onboard, number);
            ensure!(
                !args.peers.contains(&address),
                "--onboard {onboard}: vehicle {} would have {address}, which is given by --peer: use --vehicles {number} \
                 or fewer, or ports that are further apart",
                number + 1
            );
        }
    }
    Ok(())
}

/// Refuses peers at whose address a vehicle listens: it would be sent what another tells, or what it tells itself.
fn require_apart(args: &ServeArgs, listeners: &[SocketAddr]) -> Result<()> {
    for number in 0..args.vehicles {
        for peer in peers(args, number) {
            let is_there = |own: &SocketAddr| own.port() != 0 && is_own(*own, &peer.address);
            if let Some(listener) = (0..).zip(listeners).find_map(|(who, own)| is_there(own).then_some(who)) {
                bail!(meets(args, number, &peer, listener));
            }
        }
    }
    Ok(())
}

/// What is said of a peer of the vehicle `number` at whose address the vehicle `listener` listens, both from 0.
fn meets(args: &ServeArgs, number: u16, peer: &Peer, listener: u16) -> String {
    let (option, address, listen) = (peer.option(), peer.address, args.listen);
    let (sender, receiver) = (number + 1, listener + 1);
    let whom = if peer.profile == Profile::Onboard { "programs on board" } else { "the ground station" };
    let other_port = SocketAddr::new(listen.ip(), LISTEN_PORT);
    match () {
        () if is_presumed(args) && listener == 0 => format!(
            "--listen {listen} is the port of {whom}, to which vehicles send by themselves: leave out --listen, or use another \
             port, as --listen {other_port}"
        ),
        () if is_presumed(args) => format!(
            "--listen {listen}: vehicle {receiver} would listen on port {}, which is that of {whom}: use --listen {other_port}",
            address.port()
        ),
        () if peer.profile == Profile::Onboard && args.vehicles > 1 => format!(
            "--onboard {}: vehicle {sender} would send to {address}, where vehicle {receiver} listens: use fewer vehicles, or \
             ports of --listen and --onboard that are further apart",
            SocketAddr::new(address.ip(), address.port().saturating_sub(number))
        ),
        () => {
            let who = if args.vehicles > 1 { format!("vehicle {receiver}") } else { "the vehicle itself".to_owned() };
            let station = elsewhere(further(listen, listener));
            format!("{option} {address} is where {who} listens: give the ground station's address, as {station}")
        }
    }
}

/// Whether nobody was named, so that a vehicle has the default peers.
fn is_presumed(args: &ServeArgs) -> bool {
    args.peers.is_empty() && args.onboard.is_empty()
}

/// Whom a vehicle sends to without having heard of them: all the same ground stations, each its own programs.
fn peers(args: &ServeArgs, number: u16) -> Vec<Peer> {
    let named = |addresses: &[SocketAddr], profile| {
        addresses.iter().map(move |address| Peer { address: *address, profile }).collect::<Vec<_>>()
    };
    let mut peers = [named(&args.peers, Profile::Normal), named(&args.onboard, Profile::Onboard)].concat();
    if is_presumed(args) {
        peers = DEFAULT_PEERS.to_vec();
    }
    // The ports of the defaults end before the ground stations'; what was given goes on as it was given.
    let highest = if is_presumed(args) { LAST_ONBOARD_PORT } else { u16::MAX };
    for peer in peers.iter_mut().filter(|peer| peer.profile == Profile::Onboard) {
        let address = further(peer.address, number);
        peer.address = SocketAddr::new(address.ip(), address.port().min(highest));
    }
    peers
}

/// The recorder of what comes from outside, if there is to be one.
fn recorder(args: &ServeArgs, header: &Header) -> Result<Option<Recorder>> {
    let Some(path) = &args.record else { return Ok(None) };
    ensure!(args.vehicles == 1, "--record is of one vehicle: leave out --vehicles {}", args.vehicles);
    ensure!(args.params.is_none(), "--record knows no --params: give what is set by --set params.NAME=VALUE");
    Recorder::create(path, header).map(Some)
}

/// How a recording is flown again.
fn again(args: &ServeArgs, set: &[String], path: &Path) -> String {
    format!("run {}{} --replay {}", args.scenario, arguments(set), path.display())
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
    let Loaded { values, refused, rebuilt } = *loaded;
    let left = if refused == 0 { String::new() } else { format!("; {refused} do not fit any more, and are left out") };
    let mended = match rebuilt {
        0 => "",
        1 => "; one of its two copies was damaged, and is rebuilt from the other",
        _ => "; both of its copies were damaged, and values may be lost",
    };
    format!("{} loaded from {}{left}{mended}", counted(values, "parameter"), path.display())
}

fn about(summary: &str) -> String {
    if summary.is_empty() { String::new() } else { format!(": {summary}") }
}

/// How long was flown, and how fast.
fn farewell(flown: &Flown) -> String {
    let Flown { simulated_s, wall_s } = *flown;
    format!("flown {simulated_s:.1} s in {wall_s:.1} s: ran at {:.2} x real time", simulated_s / wall_s.max(1e-9))
}

#[cfg(test)]
mod tests {
    use clap::Parser as _;

    use super::super::{Cli, Command};
    use super::*;

    /// What follows `serve` on the command line, in words.
    fn args(words: &str) -> ServeArgs {
        let all = ["sim-host", "serve"].into_iter().chain(words.split_whitespace());
        match Cli::try_parse_from(all).expect("they are arguments").command {
            Some(Command::Serve(args)) => args,
            other => panic!("serve, not {other:?}"),
        }
    }

    /// The ports to which a vehicle sends, from 0.
    fn ports(args: &ServeArgs, number: u16) -> Vec<u16> {
        peers(args, number).iter().map(|peer| peer.address.port()).collect()
    }

    #[test]
    fn two_hundred_and_fifty_vehicles_have_programs_and_a_ground_station() {
        let many = args("--vehicles 250");
        for (number, onboard) in [(0, 14_540), (8, 14_548), (9, 14_549), (10, 14_549), (249, 14_549)] {
            assert_eq!(ports(&many, number), [14_550, onboard], "vehicle {}", number + 1);
        }
        require_ports(&many).and_then(|()| require_no_overlap(&many)).expect("they are flown");
    }

    #[test]
    fn programs_ports_that_go_on_into_a_ground_stations_are_refused_with_the_vehicle_that_has_it() {
        let given = "--peer 127.0.0.1:14550 --onboard 127.0.0.1:14540 --vehicles";
        require_no_overlap(&args(&format!("{given} 10"))).expect("14549 is the last");
        let error = require_no_overlap(&args(&format!("{given} 11"))).expect_err("14550 is a station's");
        assert_eq!(
            error.to_string(),
            "--onboard 127.0.0.1:14540: vehicle 11 would have 127.0.0.1:14550, which is given by --peer: use --vehicles 10 \
             or fewer, or ports that are further apart"
        );
        assert_eq!(ports(&args("--onboard 127.0.0.1:14540 --vehicles 20"), 19), [14_559], "no station is named");
    }

    /// Why vehicles that listen where they are told to are not flown, if they are not.
    fn met(words: &str) -> Option<String> {
        let args = args(words);
        let listeners: Vec<SocketAddr> = (0..args.vehicles).map(|number| further(args.listen, number)).collect();
        require_apart(&args, &listeners).err().map(|error| error.to_string())
    }

    #[test]
    fn no_vehicle_is_another_ones_peer() {
        let onboard = "--onboard 127.0.0.1:14540 --vehicles";
        assert_eq!(met(&format!("{onboard} 40")), None);
        for (words, expected) in [
            (
                format!("{onboard} 41"),
                "--onboard 127.0.0.1:14540: vehicle 41 would send to 127.0.0.1:14580, where vehicle 1 listens: use fewer \
                 vehicles, or ports of --listen and --onboard that are further apart",
            ),
            (
                "--listen :14580 --peer 127.0.0.1:14581 --vehicles 2".to_owned(),
                "--peer 127.0.0.1:14581 is where vehicle 2 listens: give the ground station's address, as 127.0.0.1:14550",
            ),
            (
                "--peer 127.0.0.1:14580".to_owned(),
                "--peer 127.0.0.1:14580 is where the vehicle itself listens: give the ground station's address, as \
                 127.0.0.1:14550",
            ),
        ] {
            assert_eq!(met(&words).as_deref(), Some(expected), "{words}");
        }
    }

    #[test]
    fn where_a_ground_station_listens_no_vehicle_does_and_no_peer_is_blamed_that_was_not_given() {
        for (words, expected) in [
            (
                "--listen 127.0.0.1:14550",
                "--listen 127.0.0.1:14550 is the port of the ground station, to which vehicles send by themselves: leave out \
                 --listen, or use another port, as --listen 127.0.0.1:14580",
            ),
            (
                "--listen :14540",
                "--listen 0.0.0.0:14540 is the port of programs on board, to which vehicles send by themselves: leave out \
                 --listen, or use another port, as --listen 0.0.0.0:14580",
            ),
            (
                "--listen 127.0.0.1:14549 --vehicles 2",
                "--listen 127.0.0.1:14549: vehicle 2 would listen on port 14550, which is that of the ground station: use \
                 --listen 127.0.0.1:14580",
            ),
        ] {
            assert_eq!(met(words).as_deref(), Some(expected), "{words}");
        }
        assert_eq!(met("--listen 127.0.0.1:14550 --peer 127.0.0.1:14551"), None, "a station elsewhere");
    }

    #[test]
    fn one_parameter_is_told_as_one() {
        let says = |values| kept(Path::new("p"), &Loaded { values, ..Loaded::default() });
        assert_eq!([says(0), says(1)], ["0 parameters loaded from p", "1 parameter loaded from p"]);
    }
}

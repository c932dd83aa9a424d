//! What belongs to one link, and to whom it is open: turns, peers, rates, losses.

use glissade_dialect::HEARTBEAT_DATA;

use super::*;
use crate::mavlink::port::LINKS;
use crate::settings::{SYS_AUTOSTART, Value};

#[test]
fn commands_are_taken_from_all_links_in_turn() {
    let mut bench = Bench::silent();
    for port in &bench.ports {
        port.open(Profile::Normal);
    }
    bench.job(&[]);
    for port in &bench.ports {
        port.receive(&command(ARM, 1.0, 0.0).repeat(6));
    }
    // Two are passed on in a job: those of all links in two jobs.
    for _ in 0..6 {
        bench.jobs(LINKS as u32 / 2);
        let mut links: Vec<u8> = bench
            .commands
            .drain(..)
            .filter_map(|command| if let Origin::Station { link, .. } = command.origin { Some(link) } else { None })
            .collect();
        links.sort_unstable();
        assert_eq!(links, (0..LINKS as u8).collect::<Vec<_>>());
    }
}

#[test]
fn a_ground_station_is_heard_on_every_link() {
    let mut bench = Bench::silent();
    for port in &bench.ports {
        port.open(Profile::Normal);
    }
    bench.job(&[]);
    for number in 0..LINKS {
        let beat = frame(&HEARTBEAT_DATA { mavtype: 6, ..HEARTBEAT_DATA::DEFAULT });
        bench.ports.get(number).expect("a link").receive(&beat);
        let now = bench.tick;
        assert_eq!(bench.output_of(&[]).0.latest.station, Some(now), "link {number}");
    }
}

#[test]
fn what_the_last_peer_of_a_link_has_sent_is_not_carried_out_for_the_next() {
    let kill = command(ARM, 0.0, 21196.0);
    let mut bench = Bench::silent();
    bench.ports.first().receive(&kill);
    bench.ports.first().open(Profile::Normal);
    bench.jobs(30);
    assert!(!bench.killed);
    bench.job(&kill);
    assert!(bench.killed, "its own is");
}

#[test]
fn the_rates_that_a_peer_has_set_are_kept_while_it_is_heard_and_forgotten_after_10_s() {
    let mut bench = Bench::new();
    bench.job(&command(SET_INTERVAL, 30.0, -1.0));
    let beat = frame(&HEARTBEAT_DATA { mavtype: 6, ..HEARTBEAT_DATA::DEFAULT });
    for _ in 0..15 {
        assert_eq!(count(&bench.job(&beat), 30) + count(&bench.jobs(99), 30), 0);
    }
    // The last beat was 0.99 s ago.
    assert_eq!(count(&bench.jobs(900), 30), 0, "not yet");
    bench.jobs(10);
    assert_eq!(count(&bench.jobs(100), 30), 20, "every 50 ms again");
}

#[test]
fn an_arming_that_waits_for_settings_is_refused_before_its_sender_gives_up() {
    let mut bench = Bench::silent();
    // Somebody never takes over what is set while disarmed only.
    bench.input.changes_taken = false;
    bench.ground.settings.set(SYS_AUTOSTART, Value::Int(4001), false).expect("settable");
    assert!(bench.job(&command(ARM, 1.0, 0.0)).is_empty());
    assert_eq!(bench.jobs(39), [], "there is still hope");
    let messages = bench.jobs(9);
    let [MavMessage::COMMAND_ACK(ack), MavMessage::STATUSTEXT(text)] = messages.as_slice() else {
        panic!("{messages:?}")
    };
    assert_eq!((ack.command, ack.result), (ARM, MavResult::MAV_RESULT_TEMPORARILY_REJECTED));
    assert_eq!(text.text.to_str(), Ok("Arming refused: parameters are being set"));
    assert!(bench.commands.is_empty());
}

#[test]
fn bytes_that_were_lost_are_counted_on_their_link() {
    let mut bench = Bench::new();
    let port = bench.ports.first();
    port.lose(3);
    // Five more than fit; they are no frames.
    port.receive(&[0; port::RECEIVED_CAPACITY + 5]);
    let messages = bench.jobs(100);
    let status = messages.iter().rev().find_map(|m| if let MavMessage::SYS_STATUS(m) = m { Some(m) } else { None });
    assert_eq!(status.expect("sent").errors_comm, 8);
}

#[test]
fn after_a_gap_a_frame_is_believed_if_another_or_nothing_follows_it() {
    let kill = command(ARM, 0.0, 21196.0);
    let another = command(NAV_WAYPOINT, 0.0, 0.0);
    for (before, after, believed) in [
        (&[][..], &[0x55][..], true),
        (&[0x55], &[], true),
        (&[0x55], another.as_slice(), true),
        // It may be a piece of a file, in a message that was damaged on the way.
        (&[0x55], &[0x55], false),
    ] {
        let mut bench = Bench::silent();
        bench.job(&[before, kill.as_slice(), after].concat());
        bench.jobs(30);
        assert_eq!(bench.killed, believed, "{before:?} before and {after:?} after it");
    }
}

#[test]
fn what_comes_back_under_the_vehicles_own_name_is_not_carried_out() {
    let kill = COMMAND_LONG_DATA { target_system: 1, command: ARM, param2: 21196.0, ..COMMAND_LONG_DATA::DEFAULT };
    // An echo; another component of the vehicle, as a companion computer, may command.
    for (component_id, obeyed) in [(1, false), (191, true)] {
        let mut bench = Bench::silent();
        let answers = bench.job(&frame_from(MavHeader { system_id: 1, component_id, sequence: 0 }, &kill));
        assert_eq!((bench.killed, answers.len()), (obeyed, usize::from(obeyed)), "component {component_id}");
    }
}

#[test]
fn signed_frames_follow_each_other_without_a_gap() {
    let mut bench = Bench::silent();
    let messages = bench.job(&with_flags(1, 13).repeat(3));
    assert_eq!(count(&messages, 77), 3);
}

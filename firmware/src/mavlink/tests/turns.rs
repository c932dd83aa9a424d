//! Who is sent first, and how much: fast lines and slow ones, and links on which more is asked for than they carry.

use glissade_dialect::{
    HEARTBEAT_DATA, PARAM_REQUEST_LIST_DATA, PARAM_REQUEST_READ_DATA, PARAM_SET_DATA, SYS_STATUS_DATA,
};

use super::messages::{flying, vehicle};
use super::*;
use crate::mavlink::telemetry::Telemetry;
use crate::settings::COUNT;

/// Bytes that 57,600 baud carry in 10 ms.
const SLOW: usize = 57;

/// A vehicle of which everything is known, on a line.
struct Line {
    bench: Bench,
    /// Bytes that it carries from one job to the next.
    carries: usize,
    sent: Vec<u8>,
}

impl Line {
    fn new(carries: usize, profile: Profile) -> Self {
        let mut bench = vehicle();
        bench.input.control = flying();
        bench.input.health.timing = Some(LoopTiming { inner_hz: 1000, outer_hz: 250, inner_period_us: (999, 1001) });
        bench.ground.links[0].telemetry = Telemetry::new(profile, 0);
        Self { bench, carries, sent: Vec::new() }
    }

    /// A line on which every message of a measured motion comes every 10 ms.
    fn with_everything(carries: usize) -> Self {
        let mut line = Self::new(carries, Profile::Normal);
        for id in STREAMED {
            line.bench.set_interval(id, 10_000.0);
        }
        line
    }

    fn job(&mut self, received: &[u8]) {
        let Self { bench, carries, sent } = self;
        let sensors = bench.input.sensors.as_mut().expect("set");
        sensors.imu.as_mut().expect("set").at = bench.tick;
        sensors.mag.as_mut().expect("set").at = bench.tick;
        sensors.baro.as_mut().expect("set").at = bench.tick;
        let port = bench.ports.first();
        assert_eq!(port.receive(received), received.len());
        bench.ports.release();
        bench.ground.step(bench.tick, &bench.input, &bench.ports);
        bench.ports.publish();
        bench.tick += GROUND.period;
        sent.extend_from_slice(port.take(&mut vec![0; *carries]));
    }

    fn jobs(&mut self, count: u32) {
        (0..count).for_each(|_| self.job(&[]));
    }

    /// What has been sent: whole frames, whose end may still be waiting.
    fn messages(&mut self) -> Vec<MavMessage> {
        let mut end = 0;
        while let Some(length) = self.sent.get(end + 1).map(|length| usize::from(*length) + 12)
            && end + length <= self.sent.len()
        {
            end += length;
        }
        let rest = self.sent.split_off(end);
        parse(&core::mem::replace(&mut self.sent, rest), &mut self.bench.sequence)
    }
}

fn list() -> Vec<u8> {
    frame(&PARAM_REQUEST_LIST_DATA { target_system: 1, target_component: 0 })
}

fn indices(messages: &[MavMessage]) -> Vec<usize> {
    let index = |m: &MavMessage| if let MavMessage::PARAM_VALUE(m) = m { Some(m.param_index.into()) } else { None };
    messages.iter().filter_map(index).collect()
}

#[test]
fn a_fast_line_gets_every_message_of_the_onboard_table_at_its_rate() {
    let mut line = Line::new(SENT_CAPACITY, Profile::Onboard);
    line.jobs(100);
    line.messages();
    line.jobs(1_000);
    let messages = line.messages();
    for (id, expected) in [
        (0, 10),
        (30, 1_000),
        (32, 500),
        (33, 500),
        (31, 500),
        (74, 100),
        (1, 50),
        (245, 50),
        (147, 20),
        (24, 50),
        (242, 10),
        (49, 10),
        (141, 100),
        (436, 10),
        (2, 10),
        (83, 500),
        (85, 100),
        (331, 333),
        (105, 500),
        (26, 250),
        (29, 100),
        (36, 100),
        (291, 100),
        (230, 50),
        (231, 20),
        (241, 20),
        (252, 40),
    ] {
        let came = count(&messages, id);
        assert!(came.abs_diff(expected) <= (expected / 50).max(1), "message {id}: {came} in 10 s, not {expected}");
    }
}

#[test]
fn more_than_a_line_carries_is_shared_out_in_turn() {
    // A radio, and a line that carries half of what is asked for.
    for carries in [SLOW, 1_000] {
        let mut line = Line::with_everything(carries);
        line.jobs(3_000);
        let messages = line.messages();
        assert!(count(&messages, 0).abs_diff(30) <= 1, "a heartbeat a second");
        // The rates of the loops are four messages at a time.
        let times = |id: f32| count(&messages, id as u32) / if id == 252.0 { 4 } else { 1 };
        let counts = STREAMED.map(|id| (id, times(id)));
        let (least, most) = counts.iter().fold((usize::MAX, 0), |(least, most), (_, n)| (least.min(*n), most.max(*n)));
        assert!(least > 0 && most <= least + least / 20 + 1, "{carries} bytes a job: {counts:?}");
    }
}

#[test]
fn an_acknowledgement_waits_for_a_tenth_of_a_second_of_a_slow_line() {
    let mut line = Line::with_everything(SLOW);
    line.jobs(300);
    line.messages();
    for _ in 0..20 {
        line.job(&command(NAV_WAYPOINT, 0.0, 0.0));
        line.jobs(10);
        assert_eq!(count(&line.messages(), 77), 1, "within 110 ms");
    }
}

#[test]
fn parameters_are_answered_before_telemetry() {
    for carries in [SLOW, SENT_CAPACITY] {
        let mut line = Line::with_everything(carries);
        line.jobs(300);
        line.messages();
        let read = PARAM_REQUEST_READ_DATA {
            param_index: -1,
            target_system: 1,
            target_component: 1,
            param_id: "MPC_TKO_SPEED".into(),
        };
        let set = PARAM_SET_DATA {
            param_value: 2.5,
            target_system: 1,
            target_component: 1,
            param_id: "MPC_TKO_SPEED".into(),
            param_type: 9,
        };
        let unknown = PARAM_REQUEST_READ_DATA { param_id: "NO_SUCH".into(), ..read.clone() };
        for (request, id) in [(frame(&read), 22), (frame(&set), 22), (frame(&unknown), 345)] {
            line.job(&request);
            line.jobs(11);
            assert_eq!(count(&line.messages(), id), 1, "within 120 ms at {carries} bytes a job");
        }
        line.job(&list());
        line.jobs(COUNT as u32 * 3 / 2);
        assert_eq!(indices(&line.messages()), (0..COUNT).collect::<Vec<_>>(), "{carries} bytes a job");
    }
}

#[test]
fn a_list_that_is_asked_for_again_and_again_comes_to_its_end() {
    let mut line = Line::new(SENT_CAPACITY, Profile::Normal);
    let mut all = Vec::new();
    for _ in 0..=COUNT / 50 {
        line.job(&list());
        line.jobs(49);
        all.extend(indices(&line.messages()));
    }
    assert_eq!(all[..COUNT], *(0..COUNT).collect::<Vec<_>>(), "asked for every half second");
    // Whoever asked last gets every value after that, and no more.
    line.jobs(COUNT as u32 + 10);
    all.extend(indices(&line.messages()));
    let last: std::collections::BTreeSet<_> = all[all.len() - COUNT..].iter().collect();
    assert_eq!(last.len(), COUNT);
    assert!(all.len() < COUNT * 9 / 4);
    line.job(&list());
    line.jobs(5);
    assert_eq!(indices(&line.messages()), [0, 1, 2, 3, 4, 5], "after its end from the first");
}

#[test]
fn a_flood_of_commands_holds_back_no_heartbeat() {
    let mut line = Line::new(SLOW, Profile::Normal);
    let flood = command(NAV_WAYPOINT, 0.0, 0.0).repeat(8);
    (0..1_000).for_each(|_| line.job(&flood));
    let beats = count(&line.messages(), 0);
    assert!(beats.abs_diff(10) <= 1, "{beats} heartbeats in 10 s");
    // 800 a second are answered as the line carries them; the rest is counted.
    line.jobs(200);
    let errors = line.messages().iter().rev().find_map(|m| match m {
        MavMessage::SYS_STATUS(m) => Some(m.errors_comm),
        _ => None,
    });
    assert!(errors.expect("sent") > 5_000, "{errors:?}");
}

#[test]
fn a_burst_of_commands_is_answered_one_and_all() {
    let mut line = Line::new(SENT_CAPACITY, Profile::Normal);
    line.job(&command(NAV_WAYPOINT, 0.0, 0.0).repeat(46));
    line.jobs(5);
    assert_eq!(count(&line.messages(), 77), 46, "2,048 bytes of commands");
}

#[test]
fn acknowledgements_are_written_where_telemetry_and_answers_would_have_to_wait() {
    let mut line = Line::with_everything(0);
    line.jobs(10);
    // A quarter of what may wait is there: with these it is more than half.
    line.job(&command(NAV_WAYPOINT, 0.0, 0.0).repeat(46));
    line.carries = SENT_CAPACITY;
    line.job(&[]);
    assert_eq!(count(&line.messages(), 77), 46);
}

#[test]
fn a_line_that_stands_still_and_is_full_of_acknowledgements_has_room_for_a_heartbeat() {
    let mut line = Line::new(0, Profile::Normal);
    // The first heartbeat comes at once, the next one a second later.
    for _ in 0..150 {
        line.job(&command(NAV_WAYPOINT, 0.0, 0.0).repeat(8));
    }
    line.sent.extend_from_slice(line.bench.ports.first().take(&mut [0; SENT_CAPACITY]));
    let messages = line.messages();
    assert!(count(&messages, 77) > 64 && count(&messages, 0) == 2, "{} heartbeats", count(&messages, 0));
}

#[test]
fn of_more_failures_than_can_wait_the_newest_are_told() {
    let mut line = Line::new(0, Profile::Normal);
    for _ in 0..30 {
        line.job(&command(NAV_WAYPOINT, 0.0, 0.0).repeat(8));
    }
    let events = [
        Event::RotorFailed { rotor: 0 },
        Event::RotorFailed { rotor: 1 },
        Event::RotorFailed { rotor: 2 },
        Event::RotorFailed { rotor: 3 },
        Event::PositionLost,
        Event::VelocityLost,
        Event::HeightLost,
        Event::AttitudeLost,
        Event::SensorsLost,
        Event::BatteryLow,
        Event::BatteryCritical,
        Event::SensorsGone,
    ];
    for event in events {
        let _ = line.bench.input.events.push(event);
        line.job(&[]);
        line.bench.input.events.clear();
    }
    line.carries = SENT_CAPACITY;
    line.jobs(20);
    let messages = line.messages();
    let told: Vec<_> = messages
        .iter()
        .filter_map(|m| if let MavMessage::STATUSTEXT(m) = m { m.text.to_str().ok() } else { None })
        .collect();
    assert!(told.len() > 4, "{told:?}");
    let newest = &events[events.len() - told.len()..];
    assert_eq!(told, newest.iter().map(|event| event.text()).collect::<Vec<_>>());
}

#[test]
fn a_link_that_is_opened_after_weeks_is_told_everything() {
    let told = |opened_at: Tick| {
        let mut bench = Bench::new();
        bench.tick = opened_at;
        bench.ports.first().open(Profile::Normal);
        // The jobs of three seconds.
        let messages = bench.jobs(300);
        (count(&messages, HEARTBEAT_DATA::ID), count(&messages, SYS_STATUS_DATA::ID))
    };
    let expected = told(0);
    assert!(expected.0 >= 3 && expected.1 >= 3, "{expected:?}");
    for opened_at in [Tick::MAX / 2 / 20 * 20 + 1_000, Tick::MAX / 20 * 20 - 9_000] {
        assert_eq!(told(opened_at), expected, "{opened_at}");
    }
}

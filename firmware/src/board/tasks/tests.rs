use core::convert::Infallible;
use std::collections::VecDeque;

use embedded_io::{ErrorType, Read, ReadReady, Write, WriteReady};
use embedded_storage_async::nor_flash::ReadNorFlash as _;
use glissade_dialect::mavlink_core::types::CharArray;
use glissade_dialect::mavlink_core::{MAVLinkV2MessageRaw, MavHeader, MessageData};
use glissade_dialect::{COMMAND_LONG_DATA, MavCmd, MavParamType, PARAM_SET_DATA};
use rtic_core::Exclusive;

use super::*;
use crate::board::storage::Keeper;
use crate::commander::{Asked, Mode, Request};
use crate::config::FlightConfig;
use crate::failure::Injectable;
use crate::inner::InnerOutput;
use crate::settings::store::tests::Flash;
use crate::settings::store::{Store, block_on};
use crate::settings::{Settings, Value, find};
use crate::signals::{MotorCommand, NavState, SensorFrame, Tick};

/// A vehicle that is held at rest, and whoever takes part in its flight.
#[derive(Debug, Default)]
struct Bench<const HAS_ALL_LINKS: bool> {
    /// The ticks at which it was asked for a sample.
    sampled: Vec<Tick>,
    driven: Vec<MotorCommand>,
    asked: VecDeque<Asked>,
    overruns: [u32; 3],
}

fn sample(tick: Tick) -> Option<SensorFrame> {
    (tick % 97 != 50).then(|| SensorFrame::Motion(NavState::at_rest()))
}

impl<const HAS_ALL_LINKS: bool> Sensors for Bench<HAS_ALL_LINKS> {
    fn sample(&mut self, tick: Tick) -> Option<SensorFrame> {
        self.sampled.push(tick);
        sample(tick)
    }
}

impl<const HAS_ALL_LINKS: bool> Rotors for Bench<HAS_ALL_LINKS> {
    fn drive(&mut self, command: &MotorCommand) {
        self.driven.push(*command);
    }
}

impl<const HAS_ALL_LINKS: bool> Companion for Bench<HAS_ALL_LINKS> {
    const HAS_ALL_LINKS: bool = HAS_ALL_LINKS;

    fn asked(&mut self) -> Option<Asked> {
        self.asked.pop_front()
    }

    fn see(&mut self, flight: &InnerTask, overruns: [u32; 3], _ports: &Ports) {
        assert_eq!(flight.next_tick() as usize, self.driven.len(), "after the tick");
        self.overruns = overruns;
    }
}

/// A clock that stands, and a tick that comes when it is called.
struct Still;

impl Clock for Still {
    const COUNTS_PER_US: u32 = 1;

    fn now(&self) -> u32 {
        0
    }
}

impl Ticker for Still {
    fn start(&mut self, _period_us: u32) {}
    fn acknowledge(&mut self) {}
}

/// A serial port.
#[derive(Debug, Default)]
struct Serial {
    received: VecDeque<u8>,
    sent: Vec<u8>,
    /// Bytes that fit into its buffer, if there are not 2048, and that still do.
    buffer: Option<usize>,
    room: usize,
}

impl ErrorType for Serial {
    type Error = Infallible;
}

impl ReadReady for Serial {
    fn read_ready(&mut self) -> Result<bool, Infallible> {
        Ok(!self.received.is_empty())
    }
}

impl Read for Serial {
    fn read(&mut self, buffer: &mut [u8]) -> Result<usize, Infallible> {
        buffer[0] = self.received.pop_front().expect("it would wait for ever");
        Ok(1)
    }
}

impl WriteReady for Serial {
    fn write_ready(&mut self) -> Result<bool, Infallible> {
        Ok(self.room > 0)
    }
}

impl Write for Serial {
    fn write(&mut self, buffer: &[u8]) -> Result<usize, Infallible> {
        self.room = self.room.checked_sub(1).expect("it would wait");
        self.sent.push(buffer[0]);
        Ok(1)
    }

    fn flush(&mut self) -> Result<(), Infallible> {
        Ok(())
    }
}

impl SerialReceiver for Serial {
    fn acknowledge(&mut self) {}
}

impl SerialSender for Serial {
    fn acknowledge(&mut self) {
        self.room = self.buffer.unwrap_or(2048);
    }
}

/// All tasks of a board, by priority: an interrupt that is pended is served at once.
struct Board<const HAS_ALL_LINKS: bool> {
    tasks: Tasks<Bench<HAS_ALL_LINKS>, Still, Still, ()>,
    receive: Receive<Serial>,
    transmit: Transmit<Serial>,
}

impl<const HAS_ALL_LINKS: bool> Board<HAS_ALL_LINKS> {
    fn new() -> Self {
        let ports: &'static Ports = Box::leak(Box::default());
        let (config, injectable) = (FlightConfig::default(), Injectable::NONE);
        let settings = Settings::of(&config);
        let start = Start { config, settings, injectable, board: Bench::default(), diagnostics: () };
        let tasks = Tasks::new(start, Still, Still, ports).expect("valid");
        let line = tasks.line;
        let (receive, transmit) = (Receive::new(Serial::default(), line), Transmit::new(Serial::default(), line));
        Self { tasks, receive, transmit }
    }

    fn hear(&mut self, bytes: &[u8]) {
        self.receive.serial.received.extend(bytes);
        self.receive.run();
    }

    fn tick(&mut self) -> Wake {
        let wake = self.wake();
        let Tasks { outer, commander, ground, mail, loops, saving, .. } = &mut self.tasks;
        if wake.outer {
            outer.run(Exclusive(mail), Exclusive(loops));
        }
        if wake.commander {
            commander.run(Exclusive(mail));
        }
        if wake.ground {
            ground.run(Exclusive(mail), Exclusive(saving));
        }
        if wake.transmit {
            self.transmit.run();
        }
        wake
    }

    fn wake(&mut self) -> Wake {
        let Tasks { inner, mail, loops, .. } = &mut self.tasks;
        inner.run(Exclusive(mail), Exclusive(loops))
    }

    fn output(&self) -> &InnerOutput {
        self.tasks.inner.flight.inner_output()
    }
}

fn frame(command: MavCmd, param1: f32, param7: f32) -> Vec<u8> {
    let command = command as u16;
    encoded(&COMMAND_LONG_DATA { command, param1, param7, target_system: 1, ..COMMAND_LONG_DATA::DEFAULT })
}

fn encoded(message: &impl MessageData) -> Vec<u8> {
    let mut raw = MAVLinkV2MessageRaw::new();
    raw.serialize_message_data(MavHeader { system_id: 255, component_id: 190, sequence: 0 }, message);
    raw.raw_bytes().to_vec()
}

#[test]
fn the_tasks_of_a_board_fly_as_the_desktop_does_and_send_the_same_bytes() {
    let mut board: Board<false> = Board::new();
    let mut desktop = Autopilot::new(&FlightConfig::default()).expect("valid");
    desktop.ports.first().open(Profile::Normal);
    let mut sent = Vec::new();
    for tick in 0..3_000 {
        let bytes = match tick {
            100 => frame(MavCmd::MAV_CMD_COMPONENT_ARM_DISARM, 1.0, 0.0),
            300 => frame(MavCmd::MAV_CMD_NAV_TAKEOFF, 0.0, 2.0),
            _ => Vec::new(),
        };
        desktop.ports.first().receive(&bytes);
        desktop.tick(sample(tick).as_ref());
        sent.extend_from_slice(desktop.ports.first().take(&mut [0; 2048]));
        board.hear(&bytes);
        board.tick();
        assert_eq!(board.output(), desktop.inner.inner_output(), "tick {tick}");
    }
    assert_eq!(desktop.inner.commander_output().mode, Mode::TakeOff);
    assert!(sent.len() > 1_000 && board.transmit.serial.sent == sent, "{} bytes", sent.len());
    let bench = &board.tasks.inner.board;
    assert_eq!(bench.sampled, (0..3_000).collect::<Vec<_>>(), "each driver is given the tick");
    assert_eq!(bench.driven.last(), Some(&desktop.inner.inner_output().motors));
    assert_eq!(bench.overruns, [0; 3]);
}

#[test]
fn a_companion_with_all_links_is_asked_and_no_byte_of_a_serial_port_mixes_in() {
    let mut board: Board<true> = Board::new();
    let ports = board.tasks.inner.ports;
    board.tasks.inner.board.asked.extend([Request::Arm { force: false }.into(), Asked::Kill]);
    for _ in 0..100 {
        board.hear(&frame(MavCmd::MAV_CMD_COMPONENT_ARM_DISARM, 1.0, 0.0));
        assert!(!board.tick().transmit);
    }
    assert!(board.tasks.inner.board.asked.is_empty(), "all that it asks is taken");
    assert!(ports.iter().all(|port| !port.is_open() && port.received().held() == 0));
    assert!(board.transmit.serial.sent.is_empty() && board.receive.serial.received.is_empty());
}

#[test]
fn a_job_that_is_not_run_in_time_is_an_overrun_that_the_companion_sees() {
    let mut board: Board<false> = Board::new();
    let woken: Vec<Wake> = (0..21).map(|_| board.wake()).collect();
    assert!(woken[0].outer && woken[0].commander && woken[0].ground && !woken[1].outer);
    assert_eq!(board.tasks.inner.board.overruns, [1, 1, 1]);
}

#[test]
fn a_serial_port_that_is_full_gets_the_rest_when_it_is_free() {
    let mut board: Board<false> = Board::new();
    for _ in 0..11 {
        board.wake();
        let Tasks { ground, mail, saving, .. } = &mut board.tasks;
        ground.run(Exclusive(mail), Exclusive(saving));
    }
    let port = board.tasks.inner.ports.first();
    let all = port.look(&mut [0; 2048]).to_vec();
    assert!(all.len() > 10, "a heartbeat: {all:?}");
    board.transmit.serial.buffer = Some(7);
    let mut runs = 0;
    while port.has_output() {
        board.transmit.run();
        runs += 1;
    }
    assert_eq!(runs, all.len().div_ceil(7));
    assert_eq!(board.transmit.serial.sent, all);
}

#[test]
fn what_is_set_by_mavlink_is_in_the_flash_after_a_while_and_not_while_armed() {
    let mut flash: Flash<4> = Flash::new();
    let range = 0..flash.capacity() as u32;
    let mut board: Board<false> = Board::new();
    let mut keeper = Keeper::new(Store::new(&mut flash, range.clone()).expect("a range"));
    let cruise = find("MPC_XY_CRUISE").expect("a setting");
    let mut set = |board: &mut Board<false>, speed_m_s: f32, ticks: u32| {
        let mut param_id = [0; 16];
        param_id[..13].copy_from_slice(b"MPC_XY_CRUISE");
        let param_type = MavParamType::MAV_PARAM_TYPE_REAL32 as u8;
        let target = PARAM_SET_DATA { target_system: 1, target_component: 1, ..PARAM_SET_DATA::DEFAULT };
        let param_id = CharArray::new(param_id);
        board.hear(&encoded(&PARAM_SET_DATA { param_value: speed_m_s, param_id, param_type, ..target }));
        for _ in 0..ticks {
            board.tick();
            keeper.run(Exclusive(&mut board.tasks.saving)).expect("a flash that works");
        }
    };
    set(&mut board, 3.5, 100);
    board.hear(&frame(MavCmd::MAV_CMD_COMPONENT_ARM_DISARM, 1.0, 0.0));
    for _ in 0..100 {
        board.tick();
    }
    assert!(board.tasks.inner.flight.commander_output().armed);
    set(&mut board, 4.5, 100);
    let stored = |flash: &mut Flash<4>| {
        let mut settings = Settings::default();
        block_on(Store::new(flash, range.clone()).expect("a range").load(&mut settings)).expect("whole");
        settings.get(cruise)
    };
    assert_eq!(stored(&mut flash.clone()), Some(Value::Real(3.5)));
}

/// A serial port whose error lasts.
struct Broken;

impl ErrorType for Broken {
    type Error = embedded_io::ErrorKind;
}

impl ReadReady for Broken {
    fn read_ready(&mut self) -> Result<bool, embedded_io::ErrorKind> {
        Ok(true)
    }
}

impl Read for Broken {
    fn read(&mut self, _buffer: &mut [u8]) -> Result<usize, embedded_io::ErrorKind> {
        Err(embedded_io::ErrorKind::Other)
    }
}

impl SerialReceiver for Broken {
    fn acknowledge(&mut self) {}
}

#[test]
fn an_error_of_a_serial_port_that_lasts_is_counted_and_stops_no_task() {
    let ports: &'static Ports = Box::leak(Box::default());
    let mut receive = Receive::new(Broken, Some(ports.first()));
    receive.run();
    receive.run();
    assert_eq!(ports.first().received().lost(), 2);
}

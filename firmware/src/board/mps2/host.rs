//! Drivers for processor in the loop: the host is sensors and rotors, over two semihosting FIFOs.
//!
//! A read blocks the emulated machine until the host answers, and takes no time on its clock. The board's own rotor
//! outputs are driven too. The host is at the other end of every link: the serial port carries none. See `pil` for the
//! frames.

use core::cell::RefCell;
use core::ffi::CStr;

use cortex_m::interrupt::{self, Mutex};
use heapless::Deque;
use semihosting::fs::File;
use semihosting::io::{Read, Write};

use super::{FreeRunning, RecordingPwm, end, stop_rotors};
use crate::airframe::ROTORS;
use crate::autopilot::InnerTask;
use crate::board::{self, Companion, Rotors, Sensors, Start, StartError};
use crate::commander::Asked;
use crate::mavlink::port::Ports;
use crate::pil::{
    AllSent, Answer, BusyWait, Cause, Fault, HELLO_BYTES, Hello, REPLY_BYTES, REQUEST_BYTES, Reply, Request, take_sent,
};
use crate::rotors::PwmRotors;
use crate::signals::{MotorCommand, SensorFrame, Tick};

/// Longest path of the FIFOs' directory.
const PATH_MAX: usize = 256;
/// What a pilot may ask between two ticks.
const ASKED_MAX: usize = 8;

/// The FIFO to the host, once it is open: used by the inner task and by the fault handlers.
static TO_HOST: Mutex<RefCell<Option<File>>> = Mutex::new(RefCell::new(None));

/// Sensors whose samples come from the host, rotors whose commands go to it and to the chip's own outputs, and the host at
/// the other end of every link.
pub struct Board {
    from_host: File,
    pwm: PwmRotors<RecordingPwm>,
    ports: &'static Ports,
    asked: Deque<Asked, ASKED_MAX>,
    sent: AllSent,
}

impl Board {
    fn request(&mut self) -> Option<Request> {
        let mut bytes = [0; REQUEST_BYTES];
        self.from_host.read_exact(&mut bytes).ok().and_then(|()| Request::decode(&bytes))
    }
}

impl Sensors for Board {
    /// Takes in what the host says before the sample, too.
    fn sample(&mut self, _tick: Tick) -> Option<SensorFrame> {
        loop {
            match self.request() {
                Some(Request::Sample(sample)) => return Some(sample),
                Some(Request::Missing) => return None,
                Some(Request::Ask(asked)) if self.asked.push_back(asked).is_ok() => {}
                Some(Request::Link { link, signal }) => {
                    if let Some(port) = self.ports.get(link as usize) {
                        port.take_in(signal.event());
                    }
                }
                Some(Request::Exit) => {
                    stop_rotors();
                    semihosting::process::exit(0)
                }
                // The host has gone, or has asked too much of a tick.
                _ => {
                    stop_rotors();
                    end()
                }
            }
        }
    }
}

impl Rotors for Board {
    fn drive(&mut self, command: &MotorCommand) {
        // These outputs cannot fail.
        let _ = self.pwm.set(command);
    }
}

impl Companion for Board {
    const HAS_ALL_LINKS: bool = true;

    fn asked(&mut self) -> Option<Asked> {
        self.asked.pop_front()
    }

    fn see(&mut self, flight: &InnerTask, overruns: [u32; 3], ports: &Ports) {
        take_sent(ports, &mut self.sent);
        send(&Reply::of(flight, overruns, self.sent).encode());
    }
}

/// Busy-waits and faults that the host adds to the partitions' jobs.
#[derive(Clone, Copy)]
pub struct Diagnostics {
    clock: FreeRunning,
    busy: BusyWait,
    fault: Option<(Tick, Fault)>,
}

impl board::Diagnostics for Diagnostics {
    fn outer(&mut self, released: Tick) {
        self.clock.busy_wait(self.busy.outer_us);
        if let Some((at, fault)) = self.fault
            && released >= at
        {
            provoke(fault);
        }
    }

    fn commander(&mut self) {
        self.clock.busy_wait(self.busy.commander_us);
    }

    fn ground(&mut self) {
        self.clock.busy_wait(self.busy.ground_us);
    }
}

/// Reads the flight's configuration from the host, over the FIFOs in the directory given as the image's only argument.
///
/// # Errors
/// The host cannot be reached, or its frame is malformed.
pub fn start(
    pwm: [RecordingPwm; ROTORS],
    clock: FreeRunning,
    ports: &'static Ports,
) -> Result<Start<Board, Diagnostics>, StartError> {
    let arguments = semihosting::experimental::env::args::<PATH_MAX>().map_err(|_| StartError::NoHost)?;
    let directory = (&arguments).next().and_then(Result::ok).ok_or(StartError::NoHost)?;
    let to_host = open(directory, "from-image", |path| File::create(path))?;
    interrupt::free(|section| TO_HOST.borrow(section).replace(Some(to_host)));
    // Opened second, because it waits for the host: once the host has opened its end of this one, both are open.
    let mut from_host = open(directory, "to-image", |path| File::open(path))?;
    let mut bytes = [0; HELLO_BYTES];
    from_host.read_exact(&mut bytes).map_err(|_| StartError::NoHost)?;
    let Hello { config, settings, injectable, busy, fault } = Hello::decode(&bytes).map_err(StartError::Hello)?;
    let pwm = PwmRotors::new(pwm, config.airframe.omega_max_rad_s);
    Ok(Start {
        config,
        settings,
        injectable,
        board: Board { from_host, pwm, ports, asked: Deque::new(), sent: AllSent::default() },
        diagnostics: Diagnostics { clock, busy, fault },
    })
}

/// Sends the host whether the flight begins.
pub fn answer(result: Result<(), StartError>) {
    let answer = match result {
        Ok(()) => Answer::Ready,
        Err(error) => Answer::refused(&error),
    };
    send(&answer.encode());
}

/// Sends the host that the rotors were stopped for good.
pub fn stopped(cause: Cause) {
    send(&Reply::stopped(cause).encode());
}

/// Opens a file in a directory with the function `how`.
fn open(
    directory: &str,
    name: &str,
    how: fn(&CStr) -> Result<File, semihosting::io::Error>,
) -> Result<File, StartError> {
    let mut path: heapless::Vec<u8, PATH_MAX> = heapless::Vec::new();
    for piece in [directory, "/", name, "\0"] {
        path.extend_from_slice(piece.as_bytes()).map_err(|_| StartError::NoHost)?;
    }
    let path = CStr::from_bytes_with_nul(&path).map_err(|_| StartError::NoHost)?;
    how(path).map_err(|_| StartError::NoHost)
}

fn send(bytes: &[u8; REPLY_BYTES]) {
    interrupt::free(|section| {
        // Already borrowed only if this call comes from a fault during another call: then nothing can be sent.
        if let Ok(mut to_host) = TO_HOST.borrow(section).try_borrow_mut()
            && let Some(file) = to_host.as_mut()
        {
            // If the host has gone, the next read fails.
            let _ = file.write_all(bytes);
        }
    });
}

fn provoke(fault: Fault) {
    match fault {
        Fault::Panic => panic!("requested by the host"),
        Fault::UndefinedInstruction => cortex_m::asm::udf(),
        Fault::StackOverflow => {
            core::hint::black_box(recurse(0));
        }
    }
}

#[allow(unconditional_recursion)]
#[inline(never)]
fn recurse(depth: u32) -> u32 {
    let frame = core::hint::black_box([depth; 64]);
    recurse(depth.wrapping_add(1)).wrapping_add(frame[0])
}

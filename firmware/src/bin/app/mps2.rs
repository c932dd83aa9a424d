//! The RTIC application: every partition is a task of its own priority, and only the mailboxes are shared.
//!
//! ```text
//! priority  task       released by                     does
//!        6  inner      TIMER0, 1 kHz                    sample, publish, release, control, rotors
//!        5  receive    UART 0 has a byte                drains it towards the ground partition
//!        4  outer      inner, every 4th tick            the estimator's filter, guidance and position control
//!        3  commander  inner, every 20th tick           arming, modes, failures
//!        2  ground     inner, every 10th tick           MAVLink
//!        1  transmit   inner or UART 0 is free          sends MAVLink bytes
//!        –  idle                                        log
//! ```
//!
//! Priorities are rate monotonic. A partition is released by pending an interrupt whose peripheral is not used; a
//! release while the job is still running stays pending. The inner task neither logs nor waits: a log entry masks all
//! interrupts while the host writes it.

use core::panic::PanicInfo;

// Links the start-up code, which is not referenced by name.
use cortex_m_rt as _;
use defmt_semihosting as _;
use firmware::board::{StartError, fault};
use firmware::pil::Cause;

use crate::drivers;

#[rtic::app(device = firmware::board::mps2, peripherals = false)]
mod app {
    use embedded_io::{Read, ReadReady, Write, WriteReady};
    use firmware::autopilot::{Autopilot, InnerTask, Mailboxes};
    use firmware::board::mps2::{
        COUNTS_PER_US, FreeRunning, Interrupt, PeriodicTimer, Peripherals, Uart, UartRx, UartTx,
    };
    use firmware::board::{Imu as _, Rotors as _, Start, StartError};
    use firmware::commander::Commander;
    use firmware::estimator::Filter;
    use firmware::mavlink::port::{Port, Ports, Profile};
    use firmware::mavlink::{Ground, LoopTiming};
    use firmware::meter::LoopMeter;
    use firmware::outer::Outer;
    use firmware::signals::TICK_US;

    use crate::drivers::{self, Diagnostics, Imu, Rotors};

    #[shared]
    struct Shared {
        mail: Mailboxes,
        /// Jobs that outer has finished since inner last looked.
        outer_jobs: u32,
        /// The last full second, for the log.
        timing: Option<LoopTiming>,
    }

    #[local]
    struct Local {
        top: Top,
        uart_rx: UartRx,
        /// The serial port's link, for the tasks that fill and empty it.
        received: &'static Port,
        filter: Filter,
        outer: Outer,
        commander: Commander,
        ground: Ground,
        ports: &'static Ports,
        busy_outer: Diagnostics,
        busy_commander: Diagnostics,
        busy_ground: Diagnostics,
        line: Line,
    }

    /// Resources of the inner task.
    pub(crate) struct Top {
        tick: PeriodicTimer,
        clock: FreeRunning,
        meter: LoopMeter,
        imu: Imu,
        rotors: Rotors,
        flight: InnerTask,
        ports: &'static Ports,
    }

    /// The serial port, and the link whose bytes it sends.
    pub(crate) struct Line {
        uart: UartTx,
        port: &'static Port,
    }

    /// The peripherals, the flight's configuration, and the partitions built for it.
    struct Boot {
        tick: PeriodicTimer,
        clock: FreeRunning,
        uart: Uart,
        start: Start<Imu, Rotors, Diagnostics>,
        autopilot: Autopilot,
    }

    fn boot(ports: &'static Ports) -> Result<Boot, StartError> {
        let Peripherals { tick, clock, uart, pwm } = Peripherals::take().ok_or(StartError::Peripherals)?;
        let start = drivers::start(pwm, clock, ports)?;
        let mut autopilot = Autopilot::new(&start.config).map_err(StartError::Config)?;
        autopilot.inner.allow_failures(start.injectable);
        Ok(Boot { tick, clock, uart, start, autopilot })
    }

    #[init(local = [links: Ports = Ports::new()])]
    fn init(cx: init::Context) -> (Shared, Local) {
        let ports: &'static Ports = cx.local.links;
        let Boot { mut tick, clock, uart, start, autopilot } = match boot(ports) {
            Ok(boot) => boot,
            Err(error) => super::refuse(error),
        };
        drivers::answer(Ok(()));
        defmt::info!("glissade {=str} is up", env!("CARGO_PKG_VERSION"));
        let port = ports.first();
        if drivers::STANDS_ALONE {
            port.open(Profile::Normal);
        }
        let (uart_rx, uart) = uart.start();
        let Start { imu, rotors, diagnostics, .. } = start;
        let Autopilot { inner: flight, filter, outer, commander, ground, mail, .. } = autopilot;
        tick.start(TICK_US);
        let meter = LoopMeter::new(COUNTS_PER_US);
        (
            Shared { mail, outer_jobs: 0, timing: None },
            Local {
                top: Top { tick, clock, meter, imu, rotors, flight, ports },
                uart_rx,
                received: port,
                filter,
                outer,
                commander,
                ground,
                ports,
                busy_outer: diagnostics,
                busy_commander: diagnostics,
                busy_ground: diagnostics,
                line: Line { uart, port },
            },
        )
    }

    /// Runs every tick.
    #[task(binds = TIMER0, priority = 6, local = [top], shared = [mail, outer_jobs, timing])]
    fn inner(mut cx: inner::Context) {
        let top = cx.local.top;
        top.tick.next();
        let sample = top.imu.sample();
        let outer_jobs = cx.shared.outer_jobs.lock(core::mem::take);
        if let Some(timing) = top.meter.activation(top.clock.now(), outer_jobs) {
            if drivers::STANDS_ALONE {
                top.flight.report_timing(timing);
            }
            cx.shared.timing.lock(|shared| *shared = Some(timing));
        }
        while let Some(asked) = top.imu.asked() {
            // A full queue drops a request, like a ground station's.
            let _ = top.flight.ask(asked);
        }
        let (released, overruns) =
            cx.shared.mail.lock(|mail| (top.flight.tick(mail, top.ports, sample.as_ref()), mail.overruns()));
        top.rotors.drive(&top.flight, overruns);
        if drivers::STANDS_ALONE && top.ports.first().has_output() {
            rtic::pend(Interrupt::UARTTX0);
        }
        if released.filter || released.outer {
            rtic::pend(Interrupt::DUALTIMER);
        }
        if released.commander {
            rtic::pend(Interrupt::SPI);
        }
        if released.ground {
            rtic::pend(Interrupt::PORT0);
        }
    }

    #[task(binds = UARTRX0, priority = 5, local = [uart_rx, received])]
    fn receive(cx: receive::Context) {
        let (uart, received) = (cx.local.uart_rx, cx.local.received);
        uart.acknowledge();
        // In a loop: a byte that arrives while this task runs may not interrupt again.
        while let Ok(true) = uart.read_ready() {
            let mut byte = [0];
            if uart.read(&mut byte).is_ok() {
                if drivers::STANDS_ALONE {
                    received.receive(&byte);
                }
            }
        }
    }

    #[task(binds = DUALTIMER, priority = 4, local = [filter, outer, busy_outer], shared = [mail, outer_jobs])]
    fn outer(mut cx: outer::Context) {
        if let Some((tick, input)) = cx.shared.mail.lock(|mail| mail.filter.take()) {
            let output = cx.local.filter.step(tick, &input);
            cx.shared.mail.lock(|mail| mail.filter.finish(output));
        }
        let Some((tick, input)) = cx.shared.mail.lock(|mail| mail.outer.take()) else { return };
        let output = cx.local.outer.step(tick, &input);
        cx.local.busy_outer.outer(tick);
        cx.shared.mail.lock(|mail| mail.outer.finish(output));
        cx.shared.outer_jobs.lock(|jobs| *jobs = jobs.saturating_add(1));
    }

    #[task(binds = SPI, priority = 3, local = [commander, busy_commander], shared = [mail])]
    fn commander(mut cx: commander::Context) {
        let Some((tick, input)) = cx.shared.mail.lock(|mail| mail.commander.take()) else { return };
        let output = cx.local.commander.step(tick, &input);
        cx.local.busy_commander.commander();
        cx.shared.mail.lock(|mail| mail.commander.finish(output));
    }

    #[task(binds = PORT0, priority = 2, local = [ground, ports, busy_ground], shared = [mail])]
    fn ground(mut cx: ground::Context) {
        let Some((tick, input)) = cx.shared.mail.lock(|mail| mail.ground.take()) else { return };
        let output = cx.local.ground.step(tick, &input, cx.local.ports);
        cx.local.busy_ground.ground();
        cx.shared.mail.lock(|mail| mail.ground.finish(output));
    }

    #[task(binds = UARTTX0, priority = 1, local = [line])]
    fn transmit(cx: transmit::Context) {
        let line = cx.local.line;
        line.uart.acknowledge();
        while drivers::STANDS_ALONE && line.port.has_output() && line.uart.write_ready().unwrap_or(false) {
            if let Some(byte) = line.port.next_byte() {
                let _ = line.uart.write(&[byte]);
            }
        }
    }

    #[idle(shared = [timing])]
    fn idle(mut cx: idle::Context) -> ! {
        loop {
            if let Some(timing) = cx.shared.timing.lock(Option::take) {
                let (shortest, longest) = timing.inner_period_us;
                defmt::info!(
                    "inner {=u16} Hz ({=u16}..{=u16} µs), outer {=u16} Hz",
                    timing.inner_hz,
                    shortest,
                    longest,
                    timing.outer_hz
                );
            }
            rtic::export::wfi();
        }
    }
}

/// A board whose flight is refused does not start its loops.
fn refuse(error: StartError) -> ! {
    drivers::answer(Err(error));
    defmt::error!("{}", defmt::Display2Format(&error));
    fault::end()
}

#[panic_handler]
fn panic(info: &PanicInfo) -> ! {
    // The second time, logging itself has panicked.
    if fault::stop_rotors() {
        drivers::stopped(Cause::Panic);
        defmt::error!("{}", defmt::Display2Format(info));
    }
    fault::end()
}

firmware::fault_handlers!(after_hard_fault);

extern "C" fn after_hard_fault() -> ! {
    if fault::stop_rotors() {
        drivers::stopped(Cause::HardFault);
        defmt::error!("hard fault");
    }
    fault::end()
}

//! The RTIC application: every partition is a task of its own priority, and only the mailboxes are shared. What the tasks
//! do is in `firmware::board::tasks`; here is by which interrupt and priority. A partition is released by pending an
//! interrupt whose peripheral is not used.

use core::panic::PanicInfo;

// Links the start-up code, which is not referenced by name.
use cortex_m_rt as _;
use defmt_semihosting as _;
use firmware::board::{StartError, mps2};
use firmware::pil::Cause;

use crate::drivers;

#[rtic::app(device = firmware::board::mps2, peripherals = false)]
mod app {
    use firmware::autopilot::Mailboxes;
    use firmware::board::mps2::{FreeRunning, Interrupt, PeriodicTimer, Peripherals, UartRx, UartTx};
    use firmware::board::storage::Saving;
    use firmware::board::tasks::{Commander, Ground, Inner, Loops, Outer, Receive, Tasks, Transmit};
    use firmware::board::{Start, StartError};
    use firmware::mavlink::port::Ports;

    use crate::drivers::{self, Board, Diagnostics};

    #[shared]
    struct Shared {
        mail: Mailboxes,
        loops: Loops,
        // There is no flash: nobody takes what waits in it.
        saving: Saving,
    }

    #[local]
    struct Local {
        inner: Inner<Board, FreeRunning, PeriodicTimer>,
        receive: Receive<UartRx>,
        outer: Outer<Diagnostics>,
        commander: Commander<Diagnostics>,
        ground: Ground<Diagnostics>,
        transmit: Transmit<UartTx>,
    }

    #[init(local = [ports: Ports = Ports::new()])]
    fn init(cx: init::Context) -> (Shared, Local) {
        boot(cx.local.ports).unwrap_or_else(|error| super::refuse(error))
    }

    fn boot(ports: &'static Ports) -> Result<(Shared, Local), StartError> {
        let Peripherals { tick, clock, uart, pwm } = Peripherals::take().ok_or(StartError::Peripherals)?;
        let start: Start<Board, Diagnostics> = drivers::start(pwm, clock, ports)?;
        let Tasks { mut inner, outer, commander, ground, line, mail, loops, saving } =
            Tasks::new(start, clock, tick, ports).map_err(StartError::Config)?;
        drivers::answer(Ok(()));
        defmt::info!("glissade {=str} is up", env!("CARGO_PKG_VERSION"));
        let (rx, tx) = uart.start();
        inner.start();
        let (receive, transmit) = (Receive::new(rx, line), Transmit::new(tx, line));
        Ok((Shared { mail, loops, saving }, Local { inner, receive, outer, commander, ground, transmit }))
    }

    #[task(binds = TIMER0, priority = 6, local = [inner], shared = [mail, loops])]
    fn inner(cx: inner::Context) {
        let wake = cx.local.inner.run(cx.shared.mail, cx.shared.loops);
        for (is_due, task) in [
            (wake.transmit, Interrupt::UARTTX0),
            (wake.outer, Interrupt::DUALTIMER),
            (wake.commander, Interrupt::SPI),
            (wake.ground, Interrupt::PORT0),
        ] {
            if is_due {
                rtic::pend(task);
            }
        }
    }

    #[task(binds = UARTRX0, priority = 5, local = [receive])]
    fn receive(cx: receive::Context) {
        cx.local.receive.run();
    }

    #[task(binds = DUALTIMER, priority = 4, local = [outer], shared = [mail, loops])]
    fn outer(cx: outer::Context) {
        cx.local.outer.run(cx.shared.mail, cx.shared.loops);
    }

    #[task(binds = SPI, priority = 3, local = [commander], shared = [mail])]
    fn commander(cx: commander::Context) {
        cx.local.commander.run(cx.shared.mail);
    }

    #[task(binds = PORT0, priority = 2, local = [ground], shared = [mail, saving])]
    fn ground(cx: ground::Context) {
        cx.local.ground.run(cx.shared.mail, cx.shared.saving);
    }

    #[task(binds = UARTTX0, priority = 1, local = [transmit])]
    fn transmit(cx: transmit::Context) {
        cx.local.transmit.run();
    }

    #[idle(shared = [loops])]
    fn idle(mut cx: idle::Context) -> ! {
        loop {
            if let Some(timing) = cx.shared.loops.lock(Loops::take_timing) {
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
    mps2::end()
}

#[panic_handler]
fn panic(info: &PanicInfo) -> ! {
    // The second time, logging itself has panicked.
    if mps2::stop_rotors() {
        drivers::stopped(Cause::Panic);
        defmt::error!("{}", defmt::Display2Format(info));
    }
    mps2::end()
}

firmware::fault_handlers!(after_hard_fault);

extern "C" fn after_hard_fault() -> ! {
    if mps2::stop_rotors() {
        drivers::stopped(Cause::HardFault);
        defmt::error!("hard fault");
    }
    mps2::end()
}

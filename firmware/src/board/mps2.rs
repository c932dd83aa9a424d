//! QEMU's mps2-an386 (Cortex-M4F at 25 MHz): the device in the form that RTIC needs, and drivers of its peripherals.
//!
//! The chip has no sensors, and its PWM outputs only record their duty cycle. So an application takes the inner task's
//! drivers from [`pad`], which stands still, or from `host`, processor in the loop. Both have the same items: the functions
//! `start`, `answer` and `stopped`, and the types `Board` and `Diagnostics`.

#[cfg(feature = "pil")]
pub mod counter;
mod device;
#[cfg(feature = "pil")]
pub mod host;
pub mod pad;
mod pwm;
mod timer;
mod uart;

pub use device::{Interrupt, NVIC_PRIO_BITS, interrupt};
pub use pwm::RecordingPwm;
pub use timer::{FreeRunning, PeriodicTimer};
pub use uart::{Uart, UartRx, UartTx};

use core::sync::atomic::{AtomicBool, Ordering};

use super::fault;
use crate::airframe::ROTORS;

/// Stops the rotors for good. Returns true the first time; see [`fault::stop_rotors`].
pub fn stop_rotors() -> bool {
    fault::stop_rotors(pwm::stop_all)
}

/// Ends the emulation with a failure.
pub fn end() -> ! {
    semihosting::process::exit(1)
}

/// The peripherals that the application uses; there is one of each.
pub struct Peripherals {
    /// TIMER0: the tick.
    pub tick: PeriodicTimer,
    /// TIMER1: a clock that is independent of the tick interrupt.
    pub clock: FreeRunning,
    /// UART0.
    pub uart: Uart,
    /// One output per rotor.
    pub pwm: [RecordingPwm; ROTORS],
}

impl Peripherals {
    /// Returns the peripherals on the first call, then `None`.
    pub fn take() -> Option<Self> {
        static TAKEN: AtomicBool = AtomicBool::new(false);
        (!TAKEN.swap(true, Ordering::Relaxed)).then(|| {
            let clock = FreeRunning::start();
            Self { tick: PeriodicTimer::new(clock), clock, uart: Uart::new(), pwm: pwm::channels() }
        })
    }
}

/// A block of device registers.
#[derive(Clone, Copy)]
struct Registers {
    base: usize,
}

#[allow(unsafe_code)]
impl Registers {
    fn read(self, offset: usize) -> u32 {
        // SAFETY: only this module's children make `Registers`, with the base of an APB peripheral of this chip and
        // offsets of 32-bit registers in it; reading them touches no memory that Rust knows of.
        unsafe { core::ptr::with_exposed_provenance::<u32>(self.base + offset).read_volatile() }
    }

    fn write(self, offset: usize, value: u32) {
        // SAFETY: as in `read`; these peripherals have no access to memory.
        unsafe { core::ptr::with_exposed_provenance_mut::<u32>(self.base + offset).write_volatile(value) }
    }
}

//! Fatal faults: the rotors are stopped first, then everything else.

use core::sync::atomic::{AtomicBool, Ordering};

/// Stops everything that could start the rotors again, and the rotors by the board's function. Returns true the first time;
/// false means a fault during fault handling, after which only an end remains.
pub fn stop_rotors(stop_all: fn()) -> bool {
    static STOPPED: AtomicBool = AtomicBool::new(false);
    cortex_m::interrupt::disable();
    stop_all();
    !STOPPED.swap(true, Ordering::Relaxed)
}

/// Defines the handlers of hard faults and unexpected interrupts. Both call the given function, an `extern "C" fn() ->
/// !`.
///
/// It runs on a fresh stack, because the old one may be the cause. An application needs this once.
#[macro_export]
macro_rules! fault_handlers {
    ($stopped:path) => {
        $crate::fault_handlers!(@ HardFault, $stopped);
        $crate::fault_handlers!(@ DefaultHandler, $stopped);
    };
    (@ $name:ident, $stopped:path) => {
        // SAFETY: the name is one that cortex-m-rt's vector table asks for, and nothing else defines it.
        // The function needs no prologue: it only moves the stack pointer to the top of the stack, whose contents
        // are not needed any more because `$stopped` does not return, and jumps.
        #[allow(unsafe_code, non_snake_case)]
        #[unsafe(naked)]
        #[unsafe(no_mangle)]
        extern "C" fn $name() -> ! {
            ::core::arch::naked_asm!(
                "ldr r0, =_stack_start",
                "mov sp, r0",
                "b {stopped}",
                stopped = sym $stopped,
            )
        }
    };
}

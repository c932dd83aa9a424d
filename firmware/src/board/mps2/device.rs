//! Interrupt numbers and vector table, in the form of a peripheral access crate.

#![allow(unsafe_code)]

use cortex_m::interrupt::InterruptNumber;

/// Bits of an interrupt's priority: eight levels.
pub const NVIC_PRIO_BITS: u8 = 3;

/// The name under which RTIC looks for the interrupts.
pub use Interrupt as interrupt;

macro_rules! interrupts {
    ($($name:ident = $number:literal: $text:literal,)*) => {
        /// Interrupts of the chip.
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        #[repr(u16)]
        pub enum Interrupt {
            $(#[doc = $text] $name = $number,)*
        }

        unsafe extern "C" {
            $(fn $name();)*
        }

        /// The vector table's part for interrupts.
        #[unsafe(link_section = ".vector_table.interrupts")]
        #[unsafe(no_mangle)]
        // SAFETY: cortex-m-rt's link.x puts the section right after the exceptions; entry n is interrupt n because the
        // list below is in order and without a gap. The handlers are tasks, or DefaultHandler by device.x.
        static __INTERRUPTS: [unsafe extern "C" fn(); 13] = [$($name,)*];
    };
}

interrupts! {
    UARTRX0 = 0: "UART 0 has received.",
    UARTTX0 = 1: "UART 0 can send.",
    UARTRX1 = 2: "UART 1 has received.",
    UARTTX1 = 3: "UART 1 can send.",
    UARTRX2 = 4: "UART 2 has received.",
    UARTTX2 = 5: "UART 2 can send.",
    PORT0 = 6: "Port 0.",
    PORT1 = 7: "Port 1.",
    TIMER0 = 8: "Timer 0 has reached zero.",
    TIMER1 = 9: "Timer 1 has reached zero.",
    DUALTIMER = 10: "The dual timer.",
    SPI = 11: "SPI 0 and 1.",
    UARTOVF = 12: "A UART has lost a byte.",
}

// SAFETY: the numbers are the chip's, fixed, and below the 240 of the core.
unsafe impl InterruptNumber for Interrupt {
    fn number(self) -> u16 {
        self as u16
    }
}

//! Counts instructions, exactly, by QEMU's clock: with `-icount shift=10` each instruction takes 1,024 ns of it, and
//! TIMER1 counts every 40 ns.
//!
//! Two empty functions, `mark_begin_NAME` and `mark_end`, are called around each counted section, so that a QEMU plugin
//! or a debugger can find the same sections by their addresses.

use super::FreeRunning;
use crate::board::Clock as _;

/// Counts of the timer in five instructions: 5 · 1,024 ns / 40 ns.
const COUNTS_IN_FIVE: u32 = 128;

/// Instructions that [`known_number`] has more than [`mark_end`].
const KNOWN: u32 = 1_000;

/// An empty function that marks the beginning of a section.
pub type Mark = extern "C" fn();

/// Defines empty functions with unique names in the image's symbol table.
macro_rules! marks {
    ($($(#[$doc:meta])* $name:ident)*) => {$(
        $(#[$doc])*
        // SAFETY: nothing else has the name, and the function does nothing but return.
        #[allow(unsafe_code)]
        #[unsafe(naked)]
        #[unsafe(no_mangle)]
        pub extern "C" fn $name() {
            core::arch::naked_asm!("bx lr")
        }
    )*};
}

marks! {
    /// An empty section.
    mark_begin_nothing
    /// A known number of instructions.
    mark_begin_known
    /// Attitude step and mixer.
    mark_begin_attitude
    /// Position step and flatness.
    mark_begin_position
    /// The reference.
    mark_begin_guidance
    /// The mixer, no limit acting.
    mark_begin_mixer
    /// The mixer at a limit.
    mark_begin_mixer_saturated
    /// Prediction of the nominal state.
    mark_begin_prediction
    /// Notches and low-pass ahead of the controller.
    mark_begin_gyro_filter
    /// Prediction of the covariance.
    mark_begin_covariance
    /// Correction by a measurement of three components.
    mark_begin_correction_3
    /// Correction by a measurement of one component.
    mark_begin_correction_1
    /// A job of the estimator's filter without a GNSS fix.
    mark_begin_filter
    /// A job with a GNSS fix.
    mark_begin_filter_gnss
    /// The end of any section.
    mark_end
}

/// Counts instructions between marks.
#[derive(Clone, Copy)]
pub struct Counter {
    clock: FreeRunning,
    /// Counts of the timer over an empty section.
    empty: u32,
}

impl Counter {
    /// Calibrates the overhead of counting.
    pub fn new(clock: FreeRunning) -> Self {
        let counter = Self { clock, empty: 0 };
        Self { empty: counter.timed(mark_begin_nothing, || ()).0, ..counter }
    }

    /// False if the emulator's clock does not count instructions as configured.
    pub fn is_exact(&self) -> bool {
        // By one function for both, so that what the compiler makes of the surroundings cancels.
        let more = self.called(known_number).wrapping_sub(self.called(mark_end));
        // Within a count: an instruction is no whole number of counts, so that either reading may round.
        (more * 5).abs_diff(KNOWN * COUNTS_IN_FIVE) <= 5
    }

    /// Timer counts over a call.
    #[inline(never)]
    fn called(&self, section: extern "C" fn()) -> u32 {
        self.timed(mark_begin_known, || section()).0
    }

    /// Number of instructions that `section` executes, and its result.
    #[inline]
    pub fn count<R>(&self, begin: Mark, section: impl FnOnce() -> R) -> (u32, R) {
        let (counts, result) = self.timed(begin, section);
        let instructions = (counts.saturating_sub(self.empty) * 5 + COUNTS_IN_FIVE / 2) / COUNTS_IN_FIVE;
        (instructions, result)
    }

    /// Timer counts from before the first mark until after the second.
    #[inline]
    fn timed<R>(&self, begin: Mark, section: impl FnOnce() -> R) -> (u32, R) {
        let start = self.clock.now();
        begin();
        let result = section();
        mark_end();
        (self.clock.now().wrapping_sub(start), result)
    }
}

/// A thousand `nop` instructions.
#[unsafe(naked)]
extern "C" fn known_number() {
    core::arch::naked_asm!(".rept 1000", "nop", ".endr", "bx lr")
}

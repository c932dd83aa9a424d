//! Counts instructions, exactly, by QEMU's clock: with `-icount shift=10` each instruction takes 1,024 ns of it, and
//! TIMER1 counts every 40 ns.
//!
//! Around what is counted two empty functions are called, `mark_begin_NAME` and `mark_end`, by whose addresses a
//! plugin of QEMU or a debugger finds the same sections.

use super::mps2::FreeRunning;

/// Counts of the timer in five instructions: 5 · 1,024 ns / 40 ns.
const COUNTS_IN_FIVE: u32 = 128;

/// Instructions of [`known_number`], its call and its return among them.
const KNOWN: u32 = 1_002;

/// An empty function by which the beginning of a section is found.
pub type Mark = extern "C" fn();

/// Defines empty functions with names of their own in the image's table of symbols.
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
    /// The nominal state's prediction.
    mark_begin_prediction
    /// Notches and low-pass ahead of the controller.
    mark_begin_gyro_filter
    /// The covariance's prediction.
    mark_begin_covariance
    /// A correction by three numbers.
    mark_begin_correction_3
    /// A correction by one number.
    mark_begin_correction_1
    /// A job of the estimator's filter without a fix of the satellites.
    mark_begin_filter
    /// A job with one.
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
    /// Finds out what counting itself takes.
    pub fn new(clock: FreeRunning) -> Self {
        let counter = Self { clock, empty: 0 };
        Self { empty: counter.timed(mark_begin_nothing, || ()).0, ..counter }
    }

    /// False if the emulator's clock does not go by instructions as it ought to.
    pub fn is_exact(&self) -> bool {
        self.count(mark_begin_known, || known_number()).0 == KNOWN
    }

    /// Instructions that `section` takes, and its result.
    #[inline]
    pub fn count<R>(&self, begin: Mark, section: impl FnOnce() -> R) -> (u32, R) {
        let (counts, result) = self.timed(begin, section);
        let instructions = (counts.saturating_sub(self.empty) * 5 + COUNTS_IN_FIVE / 2) / COUNTS_IN_FIVE;
        (instructions, result)
    }

    /// Counts of the timer from before the one mark until after the other.
    #[inline]
    fn timed<R>(&self, begin: Mark, section: impl FnOnce() -> R) -> (u32, R) {
        let start = self.clock.now();
        begin();
        let result = section();
        mark_end();
        (self.clock.now().wrapping_sub(start), result)
    }
}

/// A thousand instructions that do nothing.
#[unsafe(naked)]
extern "C" fn known_number() {
    core::arch::naked_asm!(".rept 1000", "nop", ".endr", "bx lr")
}

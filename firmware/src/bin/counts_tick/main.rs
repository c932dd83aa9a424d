//! Counts the instructions of the inner task's whole tick on the target, and fails if they exceed their budget: run it
//! with `cargo counts-tick`. An image of its own: in `counts` the loops would be compiled for two callers.

#![cfg_attr(all(target_arch = "arm", target_os = "none"), no_std, no_main)]

#[cfg(all(target_arch = "arm", target_os = "none"))]
mod flight;
#[cfg(all(target_arch = "arm", target_os = "none"))]
#[path = "../counts/plant.rs"]
#[expect(dead_code, reason = "`counts` needs more of it")]
mod plant;
#[cfg(all(target_arch = "arm", target_os = "none"))]
#[path = "../counts/sensors.rs"]
mod sensors;
#[cfg(all(target_arch = "arm", target_os = "none"))]
#[path = "../counts/tally.rs"]
mod tally;
#[cfg(all(target_arch = "arm", target_os = "none"))]
#[path = "../counts/vehicle.rs"]
mod vehicle;

#[cfg(all(target_arch = "arm", target_os = "none"))]
mod image {
    use firmware::board::mps2::counter::Counter;
    use firmware::board::mps2::{self, Peripherals};
    use semihosting::println;

    use crate::flight;

    /// Budget of a tick in instructions, for the mean and for the maximum, which is of a tick that releases every
    /// partition.
    const MEAN: f32 = 2_450.0;
    const MAX: u32 = 5_100;

    /// Greatest distance from where it should hold at the end, m, for the flight to be valid.
    const HELD_WITHIN_M: f32 = 1.0;

    #[cortex_m_rt::entry]
    fn main() -> ! {
        let Some(board) = Peripherals::take() else { mps2::end() };
        let counter = Counter::new(board.clock);
        let Ok(counts) = flight::fly(counter) else {
            println!("the flight cannot start");
            mps2::end()
        };
        let (all, alone) = (&counts.all, &counts.alone);
        println!("instructions per tick       calls    mean   max  budgets");
        println!("inner task, link open      {:6} {:7.1} {:5}  {MEAN} {MAX}", all.calls, all.mean(), all.max);
        println!("the same, nothing released {:6} {:7.1} {:5}", alone.calls, alone.mean(), alone.max);
        println!("error at the end: position {:.3} m", counts.final_error_m);
        let valid = counter.is_exact() && counts.final_error_m < HELD_WITHIN_M;
        if valid && all.mean() <= MEAN && all.max <= MAX {
            semihosting::process::exit(0);
        }
        println!("EXCEEDED, or not valid: QEMU has to be started with -icount shift=10");
        mps2::end()
    }

    #[panic_handler]
    fn panic(_: &core::panic::PanicInfo) -> ! {
        mps2::end()
    }
}

#[cfg(not(all(target_arch = "arm", target_os = "none")))]
fn main() {}

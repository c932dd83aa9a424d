//! Counts the instructions of the control loops over a flight on the target, and fails where one is over its budget:
//! `cargo counts`.

#![cfg_attr(all(target_arch = "arm", target_os = "none"), no_std, no_main)]

#[cfg(all(target_arch = "arm", target_os = "none"))]
mod flight;
#[cfg(all(target_arch = "arm", target_os = "none"))]
mod plant;

#[cfg(all(target_arch = "arm", target_os = "none"))]
mod image {
    use firmware::board::counter::Counter;
    use firmware::board::fault;
    use firmware::board::mps2::Peripherals;
    use semihosting::println;

    use crate::flight::{Counts, Flight, Tally};

    /// Instructions that a call may take at the most.
    const ATTITUDE_BUDGET: u32 = 600;
    const POSITION_BUDGET: u32 = 1_000;

    /// A vehicle that ends farther than this from its reference, m, has not flown what is to be counted.
    const TRACKED_WITHIN_M: f32 = 0.3;

    #[cortex_m_rt::entry]
    fn main() -> ! {
        let Some(counter) = Peripherals::take().and_then(|board| Counter::calibrated(board.clock)) else {
            println!("instructions cannot be counted: QEMU needs -icount shift=10");
            fault::end()
        };
        match Flight::new(counter).map(Flight::fly) {
            Ok(counts) if report(&counts) => semihosting::process::exit(0),
            Ok(_) => {}
            Err(error) => println!("no flight to count: {error}"),
        }
        fault::end()
    }

    /// Prints what a flight has taken. True if it was a flight with everything in it, and within its budgets.
    fn report(counts: &Counts) -> bool {
        println!("instructions a call     calls      mean   max  budget");
        let rows = [
            ("attitude and mixer", &counts.attitude, Some(ATTITUDE_BUDGET)),
            ("position and flatness", &counts.position, Some(POSITION_BUDGET)),
            ("guidance", &counts.guidance, None),
            ("mixer", &counts.mixer, None),
            ("mixer at a limit", &counts.mixer_saturated, None),
        ];
        let mut good = true;
        for (name, tally, budget) in rows {
            good &= row(name, tally, budget);
        }
        println!("{:.3} m from its reference at the end", counts.final_error_m);
        good && counts.final_error_m < TRACKED_WITHIN_M
    }

    fn row(name: &str, tally: &Tally, budget: Option<u32>) -> bool {
        let (calls, mean, max) = (tally.calls, tally.mean(), tally.max);
        let Some(budget) = budget else {
            println!("{name:22} {calls:6} {mean:9.1} {max:5}");
            return calls > 0;
        };
        let verdict = if max <= budget { "" } else { "  EXCEEDED" };
        println!("{name:22} {calls:6} {mean:9.1} {max:5} {budget:7}{verdict}");
        calls > 0 && max <= budget
    }

    #[panic_handler]
    fn panic(_: &core::panic::PanicInfo) -> ! {
        fault::end()
    }
}

#[cfg(not(all(target_arch = "arm", target_os = "none")))]
fn main() {}

//! Counts the instructions of the control loops over a flight on the target, and fails if one exceeds its budget: run
//! it with `cargo counts`.

#![cfg_attr(all(target_arch = "arm", target_os = "none"), no_std, no_main)]

#[cfg(all(target_arch = "arm", target_os = "none"))]
mod flight;
#[cfg(all(target_arch = "arm", target_os = "none"))]
mod navigation;
#[cfg(all(target_arch = "arm", target_os = "none"))]
mod plant;
#[cfg(all(target_arch = "arm", target_os = "none"))]
mod sensors;
#[cfg(all(target_arch = "arm", target_os = "none"))]
mod tally;
#[cfg(all(target_arch = "arm", target_os = "none"))]
mod vehicle;

#[cfg(all(target_arch = "arm", target_os = "none"))]
mod image {
    use firmware::board::mps2::counter::Counter;
    use firmware::board::mps2::{self, Peripherals};
    use semihosting::println;

    use crate::flight::{Counts, Flight};
    use crate::tally::Tally;

    /// Budget of a call in instructions, for the mean and for the maximum.
    struct Budget {
        mean: u32,
        max: u32,
    }

    const ATTITUDE: Budget = Budget { mean: 600, max: 900 };
    /// While no rotor is at its limit; at a limit, the mixer goes through its facets.
    const ATTITUDE_WITHIN_LIMITS: Budget = Budget { mean: 600, max: 600 };
    const POSITION: Budget = Budget { mean: 1_000, max: 1_000 };

    const PREDICTION: Budget = Budget { mean: 600, max: 600 };
    const COVARIANCE: Budget = Budget { mean: 8_000, max: 8_000 };
    const CORRECTION: Budget = Budget { mean: 8_000, max: 8_000 };

    /// Greatest distance from the reference at the end, m, for the flight to be valid.
    const TRACKED_WITHIN_M: f32 = 0.3;
    /// Greatest error of the position estimate at the end, m, for the flight to be valid.
    const ESTIMATED_WITHIN_M: f32 = 1.0;

    #[cortex_m_rt::entry]
    fn main() -> ! {
        let Some(board) = Peripherals::take() else { mps2::end() };
        let counter = Counter::new(board.clock);
        match Flight::new(counter).map(Flight::fly) {
            // Flies nevertheless, for tools that count by the marks.
            Ok(_) if !counter.is_exact() => println!("cannot count: start QEMU with -icount shift=10"),
            Ok(counts) if report(&counts) => semihosting::process::exit(0),
            Ok(_) => {}
            Err(error) => println!("the flight cannot start: {error}"),
        }
        mps2::end()
    }

    /// Prints the counts of a flight. True if the flight was valid and within its budgets.
    fn report(counts: &Counts) -> bool {
        println!("instructions per call       calls    mean   max  budgets");
        let navigation = &counts.navigation;
        let rows = [
            ("attitude and mixer", &counts.attitude, Some(ATTITUDE)),
            ("the same, no limit active", &counts.attitude_within_limits, Some(ATTITUDE_WITHIN_LIMITS)),
            ("position and flatness", &counts.position, Some(POSITION)),
            ("guidance", &counts.guidance, None),
            ("mixer", &counts.mixer, None),
            ("mixer at a limit", &counts.mixer_saturated, None),
            ("state prediction", &navigation.prediction, Some(PREDICTION)),
            ("notches and low-pass", &navigation.gyro_filter, None),
            ("covariance prediction", &navigation.covariance, Some(COVARIANCE)),
            ("correction, 3 components", &navigation.correction_3, Some(CORRECTION)),
            ("correction, 1 component", &navigation.correction_1, Some(CORRECTION)),
            ("filter job", &navigation.job, None),
            ("filter job with GNSS fix", &navigation.job_with_gnss, None),
        ];
        let mut good = true;
        for (name, tally, budget) in rows {
            good &= row(name, tally, budget);
        }
        let (flown, estimated) = (counts.final_error_m, counts.estimate_error_m);
        println!("errors at the end: position {flown:.3} m, position estimate {estimated:.3} m");
        good && flown < TRACKED_WITHIN_M && estimated < ESTIMATED_WITHIN_M
    }

    fn row(name: &str, tally: &Tally, budget: Option<Budget>) -> bool {
        let (calls, mean, max) = (tally.calls, tally.mean(), tally.max);
        let Some(budget) = budget else {
            println!("{name:26} {calls:6} {mean:7.1} {max:5}");
            return calls > 0;
        };
        let within = mean <= budget.mean as f32 && max <= budget.max;
        let verdict = if within { "" } else { "  EXCEEDED" };
        println!("{name:26} {calls:6} {mean:7.1} {max:5}  {} {}{verdict}", budget.mean, budget.max);
        calls > 0 && within
    }

    #[panic_handler]
    fn panic(_: &core::panic::PanicInfo) -> ! {
        mps2::end()
    }
}

#[cfg(not(all(target_arch = "arm", target_os = "none")))]
fn main() {}

//! Nothing but the top of the schedule, to look at: if anything in a tick could panic, the linked image would hold
//! functions of `core::panicking`. It is never run.

#![cfg_attr(all(target_arch = "arm", target_os = "none"), no_std, no_main)]

#[cfg(all(target_arch = "arm", target_os = "none"))]
mod image {
    use core::hint::black_box;

    use firmware::autopilot::Autopilot;
    use firmware::config::FlightConfig;
    use firmware::signals::{NavState, SensorFrame};

    #[cortex_m_rt::entry]
    fn main() -> ! {
        let Ok(Autopilot { mut inner, mut mail, .. }) = Autopilot::new(&black_box(FlightConfig::default())) else {
            end()
        };
        let mut sample = Some(SensorFrame::Motion(NavState::at_rest()));
        loop {
            black_box(inner.tick(black_box(&mut mail), black_box(&mut sample).as_ref()));
        }
    }

    fn end() -> ! {
        loop {
            cortex_m::asm::wfi();
        }
    }

    #[panic_handler]
    fn panic(_: &core::panic::PanicInfo) -> ! {
        end()
    }
}

#[cfg(not(all(target_arch = "arm", target_os = "none")))]
fn main() {}

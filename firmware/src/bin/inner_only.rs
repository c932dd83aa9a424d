//! An image with only the inner task, on sensors and on ideal state: if anything in a tick could panic, it would
//! contain functions of `core::panicking`. It is inspected, and never run.

#![cfg_attr(all(target_arch = "arm", target_os = "none"), no_std, no_main)]

#[cfg(all(target_arch = "arm", target_os = "none"))]
mod image {
    use core::hint::black_box;

    use firmware::autopilot::Autopilot;
    use firmware::config::FlightConfig;
    use firmware::estimator::EstimatorSettings;
    use firmware::mavlink::port::Ports;
    use firmware::sensors::Measurements;
    use firmware::settings::Settings;
    use firmware::signals::{NavState, SensorFrame};

    static PORTS: Ports = Ports::new();

    #[cortex_m_rt::entry]
    fn main() -> ! {
        let config = FlightConfig { estimator: Some(EstimatorSettings::default()), ..FlightConfig::default() };
        let (config, settings) = (black_box(&config), Settings::of(&config));
        let Ok(Autopilot { mut inner, mut mail, ports, .. }) = Autopilot::on(config, settings, &PORTS) else { end() };
        let motion = SensorFrame::Motion(NavState::at_rest());
        let measured = SensorFrame::Measured(Measurements::default());
        loop {
            // On ideal state, on sensors, and without a sample.
            for sample in [Some(&motion), Some(&measured), None] {
                black_box(inner.tick(black_box(&mut mail), ports, black_box(sample)));
            }
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

//! PWM outputs. The emulated chip has none, so these only record their duty cycle, for a debugger to read.

use core::convert::Infallible;
use core::sync::atomic::{AtomicU16, Ordering};

use embedded_hal::pwm::{ErrorType, SetDutyCycle};

use crate::airframe::ROTORS;

/// Stands in for the compare registers: writable without a lock, so that a fault handler can stop the rotors.
static DUTY: [AtomicU16; ROTORS] = [const { AtomicU16::new(0) }; ROTORS];

/// An output that only records its duty cycle.
pub struct RecordingPwm {
    duty: &'static AtomicU16,
}

pub(super) fn channels() -> [RecordingPwm; ROTORS] {
    DUTY.each_ref().map(|duty| RecordingPwm { duty })
}

/// Sets every output to zero; callable from anywhere.
pub(super) fn stop_all() {
    for duty in &DUTY {
        duty.store(0, Ordering::Relaxed);
    }
}

impl ErrorType for RecordingPwm {
    type Error = Infallible;
}

impl SetDutyCycle for RecordingPwm {
    fn max_duty_cycle(&self) -> u16 {
        u16::MAX
    }

    fn set_duty_cycle(&mut self, duty: u16) -> Result<(), Infallible> {
        self.duty.store(duty, Ordering::Relaxed);
        Ok(())
    }
}

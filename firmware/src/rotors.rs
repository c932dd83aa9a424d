//! Conversion of rotor speeds to duty cycles of the speed controllers.

use embedded_hal::pwm::SetDutyCycle;

use crate::airframe::ROTORS;
use crate::math;
use crate::signals::MotorCommand;

/// One PWM output per rotor. The duty cycle is ω/ωmax times the output's maximum.
pub struct PwmRotors<P> {
    outputs: [P; ROTORS],
    omega_max_rad_s: f32,
}

impl<P: SetDutyCycle> PwmRotors<P> {
    /// Rotors with their greatest speed. Nothing is written to the outputs yet.
    pub fn new(outputs: [P; ROTORS], omega_max_rad_s: f32) -> Self {
        Self { outputs, omega_max_rad_s }
    }

    /// Sets every rotor's speed. NaN stops a rotor.
    ///
    /// # Errors
    /// The error of the first output that fails; the others are set nevertheless.
    pub fn set(&mut self, command: &MotorCommand) -> Result<(), P::Error> {
        let mut result = Ok(());
        for (output, omega) in self.outputs.iter_mut().zip(command.omega_rad_s) {
            let fraction = math::clamp(omega / self.omega_max_rad_s, 0.0, 1.0);
            let duty = (fraction * f32::from(output.max_duty_cycle()) + 0.5) as u16;
            result = result.and(output.set_duty_cycle(duty));
        }
        result
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use embedded_hal::pwm::{ErrorKind, ErrorType};

    /// Remembers what it was told; fails if it is `broken`.
    #[derive(Default)]
    struct Output {
        duty: u16,
        broken: bool,
    }

    impl ErrorType for Output {
        type Error = ErrorKind;
    }

    impl SetDutyCycle for Output {
        fn max_duty_cycle(&self) -> u16 {
            1_000
        }

        fn set_duty_cycle(&mut self, duty: u16) -> Result<(), ErrorKind> {
            self.duty = duty;
            if self.broken { Err(ErrorKind::Other) } else { Ok(()) }
        }
    }

    #[test]
    fn speed_is_a_part_of_the_greatest() {
        let mut rotors = PwmRotors::new(<[Output; ROTORS]>::default(), 50.0);
        assert_eq!(rotors.set(&MotorCommand { omega_rad_s: [0.0, 25.0, 50.0, 60.0] }), Ok(()));
        assert_eq!(rotors.outputs.map(|output| output.duty), [0, 500, 1_000, 1_000]);
    }

    #[test]
    fn what_is_not_a_number_stops_the_rotor_and_a_broken_output_stops_no_other() {
        let mut rotors = PwmRotors::new(<[Output; ROTORS]>::default(), 50.0);
        rotors.outputs[0].broken = true;
        let command = MotorCommand { omega_rad_s: [50.0, f32::NAN, -1.0, 50.0] };
        assert_eq!(rotors.set(&command), Err(ErrorKind::Other));
        assert_eq!(rotors.outputs.map(|output| output.duty), [1_000, 0, 0, 1_000]);
    }
}

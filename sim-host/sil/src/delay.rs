//! What lies between a motor command and the rotors.

use firmware::airframe::ROTORS;

/// The longest delay between a motor command and the rotors, ticks.
pub const DELAY_TICKS_MAX: usize = 16;

/// Motor commands on their way to the rotors: a ring of as many as the delay has ticks.
#[derive(Clone, Debug)]
pub(crate) struct Delay {
    on_the_way: [[f64; ROTORS]; DELAY_TICKS_MAX],
    ticks: usize,
    /// Which of them arrives next.
    next: usize,
}

impl Delay {
    /// Of one tick to [`DELAY_TICKS_MAX`]; `omega` (rad/s) arrives until the first command does.
    pub(crate) fn new(ticks: usize, omega: [f64; ROTORS]) -> Self {
        Self { on_the_way: [omega; DELAY_TICKS_MAX], ticks: ticks.clamp(1, DELAY_TICKS_MAX), next: 0 }
    }

    /// What arrives now.
    pub(crate) fn arriving(&self) -> [f64; ROTORS] {
        self.on_the_way[self.next]
    }

    /// Sends a command, and returns what arrives. Out of the way of the flights without a delay.
    #[cold]
    pub(crate) fn pass(&mut self, command: [f64; ROTORS]) -> [f64; ROTORS] {
        let place = self.next;
        self.next = (place + 1) % self.ticks;
        core::mem::replace(&mut self.on_the_way[place], command)
    }
}

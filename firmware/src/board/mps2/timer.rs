//! CMSDK APB timers: they count down from a reload value, at the core's clock.

use super::Registers;
use crate::board::{Clock, Ticker};

/// Both timers run at 25 MHz.
const COUNTS_PER_US: u32 = 25;

const TIMER0: usize = 0x4000_0000;
const TIMER1: usize = 0x4000_1000;

const CTRL: usize = 0x0;
const VALUE: usize = 0x4;
const RELOAD: usize = 0x8;
const INTERRUPT: usize = 0xc;

const ENABLE: u32 = 1;
const ENABLE_WITH_INTERRUPT: u32 = 1 | 1 << 3;

/// TIMER0 as the compare unit of [`FreeRunning`]: interrupts at every period of that clock.
///
/// Each count-down is started separately and stops at zero, without reload: QEMU with `-icount sleep=off` skips every
/// second interrupt of a timer that reloads itself while the core sleeps (it advances its clock to the next deadline
/// when the reload is scheduled, before the interrupt that wakes the core).
pub struct PeriodicTimer {
    registers: Registers,
    clock: FreeRunning,
    period: u32,
    /// The clock at the next interrupt.
    due: u32,
}

impl PeriodicTimer {
    pub(super) fn new(clock: FreeRunning) -> Self {
        Self { registers: Registers { base: TIMER0 }, clock, period: 0, due: 0 }
    }
}

impl Ticker for PeriodicTimer {
    fn start(&mut self, period_us: u32) {
        self.period = period_us.saturating_mul(COUNTS_PER_US);
        self.due = self.clock.now();
        self.registers.write(RELOAD, 0);
        self.acknowledge();
        self.registers.write(CTRL, ENABLE_WITH_INTERRUPT);
    }

    /// A late call does not shift later interrupts; if it is late by a whole period, that interrupt is skipped.
    fn acknowledge(&mut self) {
        self.registers.write(INTERRUPT, 1);
        let now = self.clock.now();
        self.due = self.due.wrapping_add(self.period);
        let mut left = self.due.wrapping_sub(now);
        if left == 0 || left > self.period {
            self.due = now.wrapping_add(self.period);
            left = self.period;
        }
        self.registers.write(VALUE, left);
    }
}

/// TIMER1, which runs freely through all 2³² counts (172 s). Anyone may read it.
#[derive(Clone, Copy)]
pub struct FreeRunning {
    registers: Registers,
}

impl FreeRunning {
    pub(super) fn start() -> Self {
        let registers = Registers { base: TIMER1 };
        registers.write(RELOAD, u32::MAX);
        registers.write(VALUE, u32::MAX);
        registers.write(CTRL, ENABLE);
        Self { registers }
    }

    /// Keeps the core busy for this time, including the time of tasks with higher priority.
    pub fn busy_wait(&self, us: u32) {
        let (start, counts) = (self.now(), us.saturating_mul(COUNTS_PER_US));
        while self.now().wrapping_sub(start) < counts {
            // Reading the timer is slow under QEMU: once every few microseconds is enough.
            cortex_m::asm::delay(500);
        }
    }
}

impl Clock for FreeRunning {
    const COUNTS_PER_US: u32 = COUNTS_PER_US;

    fn now(&self) -> u32 {
        !self.registers.read(VALUE)
    }
}

//! CMSDK APB timers: they count down from a reload value, at the core's clock.

use super::Registers;

/// Both timers run at 25 MHz.
pub const COUNTS_PER_US: u32 = 25;

const TIMER0: usize = 0x4000_0000;
const TIMER1: usize = 0x4000_1000;

const CTRL: usize = 0x0;
const VALUE: usize = 0x4;
const RELOAD: usize = 0x8;
const INTERRUPT: usize = 0xc;

const ENABLE: u32 = 1;
const ENABLE_WITH_INTERRUPT: u32 = 1 | 1 << 3;

/// TIMER0, which interrupts at a fixed period.
pub struct PeriodicTimer {
    registers: Registers,
}

impl PeriodicTimer {
    pub(super) fn new() -> Self {
        Self { registers: Registers { base: TIMER0 } }
    }

    /// The first interrupt comes one period from now.
    pub fn start(&mut self, period_us: u32) {
        let reload = period_us.saturating_mul(COUNTS_PER_US).saturating_sub(1);
        self.registers.write(RELOAD, reload);
        self.registers.write(VALUE, reload);
        self.registers.write(CTRL, ENABLE_WITH_INTERRUPT);
    }

    /// To be called once an interrupt.
    pub fn acknowledge(&mut self) {
        self.registers.write(INTERRUPT, 1);
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

    /// Counts since the start, modulo 2³².
    pub fn now(&self) -> u32 {
        !self.registers.read(VALUE)
    }

    /// Keeps the core busy for that long; tasks of higher priority run meanwhile and count towards it.
    pub fn busy_wait(&self, us: u32) {
        let (start, counts) = (self.now(), us.saturating_mul(COUNTS_PER_US));
        while self.now().wrapping_sub(start) < counts {}
    }
}

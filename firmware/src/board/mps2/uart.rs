//! CMSDK APB UART 0, one byte of buffer each way, behind `embedded-io`.

use core::convert::Infallible;

use embedded_io::{ErrorType, Read, ReadReady, Write, WriteReady};

use super::Registers;
use crate::board::{SerialReceiver, SerialSender};

const UART0: usize = 0x4000_4000;

const DATA: usize = 0x0;
const STATE: usize = 0x4;
const CTRL: usize = 0x8;
const INTERRUPT: usize = 0xc;
const BAUD_DIVIDER: usize = 0x10;

const TX_FULL: u32 = 1;
const RX_FULL: u32 = 1 << 1;
/// Both directions, both with interrupts.
const ENABLE: u32 = 0b1111;
const TX_INTERRUPT: u32 = 1;
const RX_INTERRUPT: u32 = 1 << 1;
/// 25 MHz / 115,200 baud.
const DIVIDER: u32 = 217;

/// UART 0, not yet running.
pub struct Uart {
    registers: Registers,
}

/// Its receiving half.
pub struct UartRx {
    registers: Registers,
}

/// Its sending half.
pub struct UartTx {
    registers: Registers,
}

impl Uart {
    pub(super) fn new() -> Self {
        Self { registers: Registers { base: UART0 } }
    }

    /// Runs at 115,200 baud from now on; both halves interrupt.
    pub fn start(self) -> (UartRx, UartTx) {
        self.registers.write(BAUD_DIVIDER, DIVIDER);
        self.registers.write(CTRL, ENABLE);
        (UartRx { registers: self.registers }, UartTx { registers: self.registers })
    }
}

impl SerialReceiver for UartRx {
    fn acknowledge(&mut self) {
        self.registers.write(INTERRUPT, RX_INTERRUPT);
    }
}

impl SerialSender for UartTx {
    fn acknowledge(&mut self) {
        self.registers.write(INTERRUPT, TX_INTERRUPT);
    }
}

impl ErrorType for UartRx {
    type Error = Infallible;
}

impl ErrorType for UartTx {
    type Error = Infallible;
}

impl ReadReady for UartRx {
    fn read_ready(&mut self) -> Result<bool, Infallible> {
        Ok(self.registers.read(STATE) & RX_FULL != 0)
    }
}

impl Read for UartRx {
    /// Waits for the first byte, as the trait requires.
    fn read(&mut self, buffer: &mut [u8]) -> Result<usize, Infallible> {
        let Some(byte) = buffer.first_mut() else { return Ok(0) };
        while !self.read_ready()? {}
        *byte = self.registers.read(DATA) as u8;
        Ok(1)
    }
}

impl WriteReady for UartTx {
    fn write_ready(&mut self) -> Result<bool, Infallible> {
        Ok(self.registers.read(STATE) & TX_FULL == 0)
    }
}

impl Write for UartTx {
    /// Waits until the first byte can be sent, as the trait requires.
    fn write(&mut self, buffer: &[u8]) -> Result<usize, Infallible> {
        let Some(byte) = buffer.first() else { return Ok(0) };
        while !self.write_ready()? {}
        self.registers.write(DATA, u32::from(*byte));
        Ok(1)
    }

    fn flush(&mut self) -> Result<(), Infallible> {
        while !self.write_ready()? {}
        Ok(())
    }
}

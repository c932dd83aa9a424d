//! A ground station over TCP: a stream of bytes either way, which never blocks.

use std::io::{ErrorKind, Read as _, Write as _};
use std::net::TcpStream;

/// Bytes read at one go.
const READ_MAX: usize = 16_384;
/// Bytes that wait in the system for a slow station. More would only be older when they arrive: what the vehicle keeps
/// instead, it keeps in its own order, answers before telemetry.
const SYSTEM_OUTBOX: usize = 8_192;

/// A connection.
#[derive(Debug)]
pub(super) struct Connection {
    stream: TcpStream,
    outbox: Vec<u8>,
}

impl Connection {
    /// Of a stream that was accepted; `None` if it is gone already.
    pub(super) fn new(stream: TcpStream) -> Option<Self> {
        stream.set_nonblocking(true).ok()?;
        // Telemetry is small, and answers are waited for.
        stream.set_nodelay(true).ok()?;
        // A system that does not know it takes more, and answers are later.
        let _ = rustix::net::sockopt::set_socket_send_buffer_size(&stream, SYSTEM_OUTBOX);
        Some(Self { stream, outbox: Vec::new() })
    }

    /// Appends what has arrived, at most so that `inbox` holds `most` bytes: the rest waits in the network. False once the
    /// station has gone.
    pub(super) fn read(&mut self, inbox: &mut Vec<u8>, most: usize) -> bool {
        let mut bytes = [0; READ_MAX];
        let room = most.saturating_sub(inbox.len()).min(READ_MAX);
        if room == 0 {
            return true;
        }
        match self.stream.read(&mut bytes[..room]) {
            Ok(0) => false,
            Ok(count) => {
                inbox.extend_from_slice(&bytes[..count]);
                true
            }
            Err(error) => matches!(error.kind(), ErrorKind::WouldBlock | ErrorKind::Interrupted),
        }
    }

    /// Whether the station has not taken yet what was sent before: then it is sent nothing new.
    pub(super) fn is_busy(&mut self) -> bool {
        self.flush();
        !self.outbox.is_empty()
    }

    /// Sends whole frames, or keeps them until the station takes them.
    pub(super) fn write(&mut self, frames: &[u8]) {
        self.outbox.extend_from_slice(frames);
        self.flush();
    }

    fn flush(&mut self) {
        if self.outbox.is_empty() {
            return;
        }
        while let Ok(count @ 1..) = self.stream.write(&self.outbox) {
            self.outbox.drain(..count);
            if self.outbox.is_empty() {
                return;
            }
        }
    }
}

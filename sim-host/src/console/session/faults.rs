//! Faults of sensors, rotors and battery that are typed.

use anyhow::Result;

use super::Session;
use crate::console::line::Tone;
use crate::failures::{self, Equipment};
use crate::report::timeline::fault_name;
use crate::sensors::Fault;

impl Session {
    /// Starts a fault. One that begins at once is reported by [`Watch`], as scheduled ones are.
    pub(super) fn inject(&mut self, fault: &Fault) -> Result<()> {
        let now_s = self.time_s();
        let fault = Fault { from_s: fault.from_s.max(now_s), ..*fault };
        self.flight.inject(&fault)?;
        if fault.from_s > now_s {
            self.say(Tone::Plain, format!("fault from {} s on: {}", fault.from_s, fault_name(&fault)));
        }
        Ok(())
    }

    pub(super) fn list_faults(&mut self) {
        let now_s = self.time_s();
        let line = |fault: &Fault| {
            let typed = failures::describe(fault);
            if fault.from_s > now_s {
                format!("from {} s on: fault {typed}", fault.from_s)
            } else {
                format!("fault {typed}")
            }
        };
        let lines: Vec<String> = self.faults().iter().map(line).collect();
        if lines.is_empty() {
            self.say(Tone::Plain, "no faults".to_owned());
        }
        for line in lines {
            self.say(Tone::Plain, line);
        }
    }

    /// The faults that act, and those to come.
    pub(super) fn faults(&self) -> Vec<Fault> {
        let tick = self.flight.next_tick();
        self.flight.sensors().map_or_else(Vec::new, |suite| suite.faults().list(tick).collect())
    }

    pub(super) fn clear(&mut self, of: Option<Equipment>) -> Result<()> {
        let is_meant = |fault: &Fault| of.is_none_or(|of| of.has(fault));
        let count = self.faults().iter().filter(|fault| is_meant(fault)).count();
        self.flight.clear_faults_where(is_meant)?;
        let what = of.map_or_else(String::new, |of| format!(" of {}", of.name()));
        let text = if count == 0 { format!("no faults{what}") } else { format!("no faults{what}: {count} cleared") };
        self.say(Tone::Plain, text);
        Ok(())
    }
}

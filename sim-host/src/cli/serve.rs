//! `serve`: flies in real time for a ground station.

use std::sync::atomic::AtomicBool;

use anyhow::{Result, ensure};
use firmware::mavlink::TxBytes;

use super::ServeArgs;
use crate::failures::{self, Order};
use crate::flight;
use crate::link::UdpLink;
use crate::plant::Plant as _;
use crate::plant::rigid_body::RigidBody;
use crate::scenario::Scenario;
use crate::serve::{Console, Pacing, Vehicle, serve};
use crate::sil::Flight;

impl Vehicle for Flight<RigidBody> {
    fn tick(&mut self, received: &[u8]) -> Option<TxBytes> {
        self.autopilot.inner.receive(received);
        self.step(&mut ());
        for failure in self.autopilot.inner.take_failures() {
            let tick = self.next_tick();
            for (slot, fault) in failures::of(&failure, tick) {
                // The firmware is allowed failures on sensors alone, where this cannot fail.
                let _ = self.hold_fault(slot, fault.as_ref());
            }
        }
        self.autopilot.inner.has_transmit().then(|| self.autopilot.inner.take_transmit())
    }

    fn execute(&mut self, line: &str) -> Result<String> {
        let tick = self.next_tick();
        match failures::parse(line, tick)? {
            None => Ok(String::new()),
            Some(Order::Fault(fault)) => self.inject(&fault).map(|_| failures::describe(&fault)),
            Some(Order::Clear) => self.clear_faults().map(|()| "no faults".to_owned()),
            Some(Order::List) => {
                let faults = self.sensors().map(|suite| suite.faults().list(tick));
                let lines: Vec<_> = faults.into_iter().flatten().map(|fault| failures::describe(&fault)).collect();
                Ok(if lines.is_empty() { "no faults".to_owned() } else { lines.join("\n") })
            }
        }
    }
}

pub(super) fn run(args: &ServeArgs) -> Result<()> {
    let scenario = Scenario::load(&args.scenario, &args.settings.set)?;
    scenario.require_rigid_body()?;
    ensure!(args.speed.is_finite() && args.speed > 0.0, "--speed must be a number above zero, not {}", args.speed);
    let mut vehicle = flight::lockstep(&scenario, args.seed, flight::rigid_body(&scenario, args.seed))?;
    let injectable = failures::injectable(vehicle.sensors(), vehicle.plant().battery().is_some());
    vehicle.autopilot.inner.allow_failures(injectable);
    let mut link = UdpLink::bind(args.listen, &args.peers)?;
    let peers: Vec<String> = args.peers.iter().map(ToString::to_string).collect();
    eprintln!("flying `{}`; MAVLink on {}, to {}; stop with Ctrl-C", scenario.name, args.listen, peers.join(" and "));
    let (console, pacing) = (Console::on_standard_input(), Pacing { speed: args.speed });
    serve(&mut vehicle, &mut link, &console, pacing, &AtomicBool::new(false))
}

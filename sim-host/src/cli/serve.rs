//! `serve`: flies in real time for a ground station.

use std::sync::atomic::AtomicBool;

use anyhow::{Result, ensure};
use firmware::mavlink::TxBytes;

use super::ServeArgs;
use crate::flight;
use crate::link::UdpLink;
use crate::plant::rigid_body::RigidBody;
use crate::scenario::Scenario;
use crate::serve::{Pacing, Vehicle, serve};
use crate::sil::Flight;

impl Vehicle for Flight<RigidBody> {
    fn tick(&mut self, received: &[u8]) -> Option<TxBytes> {
        self.autopilot.inner.receive(received);
        self.step(&mut ());
        self.autopilot.inner.has_transmit().then(|| self.autopilot.inner.take_transmit())
    }
}

pub(super) fn run(args: &ServeArgs) -> Result<()> {
    let scenario = Scenario::load(&args.scenario, &args.settings.set)?;
    scenario.require_rigid_body()?;
    ensure!(args.speed.is_finite() && args.speed > 0.0, "--speed must be a number above zero, not {}", args.speed);
    let mut vehicle = flight::lockstep(&scenario, args.seed, flight::rigid_body(&scenario, args.seed))?;
    let mut link = UdpLink::bind(args.listen, &args.peers)?;
    let peers: Vec<String> = args.peers.iter().map(ToString::to_string).collect();
    eprintln!("flying `{}`; MAVLink on {}, to {}; stop with Ctrl-C", scenario.name, args.listen, peers.join(" and "));
    serve(&mut vehicle, &mut link, Pacing { speed: args.speed }, &AtomicBool::new(false))
}

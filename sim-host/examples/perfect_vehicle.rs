//! A vehicle without physics, for trying ground stations: it is always exactly where guidance wants it to be.

use std::net::SocketAddr;
use std::process::ExitCode;
use std::sync::atomic::AtomicBool;

use clap::{Parser, Subcommand};
use firmware::autopilot::Autopilot;
use firmware::config::FlightConfig;
use firmware::mavlink::TxBytes;
use firmware::signals::{NavState, SensorFrame};
use sim_host::link::{DEFAULT_LISTEN, DEFAULT_PEERS, UdpLink};
use sim_host::serve::{Pacing, Vehicle, serve};

#[derive(Parser)]
struct Arguments {
    #[command(subcommand)]
    command: Command,
}

#[derive(Subcommand)]
enum Command {
    /// Fly in real time for a ground station.
    Serve {
        #[arg(long, default_value = DEFAULT_LISTEN)]
        listen: SocketAddr,
        #[arg(long, default_values = DEFAULT_PEERS)]
        peer: Vec<SocketAddr>,
        #[arg(long, default_value_t = 1.0)]
        speed: f64,
    },
}

struct PerfectVehicle {
    autopilot: Autopilot,
    nav: NavState,
}

impl Vehicle for PerfectVehicle {
    fn tick(&mut self, received: &[u8]) -> Option<TxBytes> {
        self.autopilot.inner.receive(received);
        self.autopilot.tick(Some(&SensorFrame { nav: self.nav }));
        let inner = &self.autopilot.inner;
        if inner.commander_output().flight_start.is_some() {
            self.nav.position = inner.outer_output().reference.position;
            self.nav.velocity = inner.outer_output().reference.velocity;
        }
        inner.has_transmit().then(|| self.autopilot.inner.take_transmit())
    }
}

fn fly(arguments: Arguments) -> anyhow::Result<()> {
    let Command::Serve { listen, peer, speed } = arguments.command;
    let autopilot =
        Autopilot::new(&FlightConfig::default()).map_err(|error| anyhow::anyhow!("default configuration: {error}"))?;
    let mut vehicle = PerfectVehicle { autopilot, nav: NavState::at_rest() };
    let mut link = UdpLink::bind(listen, &peer)?;
    serve(&mut vehicle, &mut link, Pacing { speed }, &AtomicBool::new(false))
}

fn main() -> ExitCode {
    match fly(Arguments::parse()) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("error: {error:#}");
            ExitCode::from(2)
        }
    }
}

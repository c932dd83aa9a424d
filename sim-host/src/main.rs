//! `sim-host`: test flights on the desktop, from the command line.

use std::process::ExitCode;

fn main() -> ExitCode {
    sim_host::cli::main()
}

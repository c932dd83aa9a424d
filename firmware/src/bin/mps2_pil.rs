//! The application of `mps2` with the processor in the loop: the host is its IMU and its rotors.

#![cfg_attr(all(target_arch = "arm", target_os = "none"), no_std, no_main)]

#[cfg(all(target_arch = "arm", target_os = "none"))]
use firmware::board::mps2::host as drivers;

#[cfg(all(target_arch = "arm", target_os = "none"))]
#[path = "app/mps2.rs"]
mod application;

#[cfg(not(all(target_arch = "arm", target_os = "none")))]
fn main() {}

//! Glissade on QEMU's mps2-an386, standing on the ground: MAVLink on UART 0, log on the semihosting console.

#![cfg_attr(all(target_arch = "arm", target_os = "none"), no_std, no_main)]

#[cfg(all(target_arch = "arm", target_os = "none"))]
use firmware::board::mps2::pad as drivers;

#[cfg(all(target_arch = "arm", target_os = "none"))]
#[path = "app/mps2.rs"]
mod application;

#[cfg(not(all(target_arch = "arm", target_os = "none")))]
fn main() {}

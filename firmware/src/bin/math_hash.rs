//! Prints the hash of `selftest` as computed on the target, for comparison with the desktop's.

#![cfg_attr(all(target_arch = "arm", target_os = "none"), no_std, no_main)]

#[cfg(all(target_arch = "arm", target_os = "none"))]
mod image {
    use firmware::board::mps2;

    #[cortex_m_rt::entry]
    fn main() -> ! {
        semihosting::println!("{:016x}", firmware::selftest::math_hash(20_000));
        semihosting::process::exit(0)
    }

    #[panic_handler]
    fn panic(_: &core::panic::PanicInfo) -> ! {
        mps2::end()
    }
}

#[cfg(not(all(target_arch = "arm", target_os = "none")))]
fn main() {}

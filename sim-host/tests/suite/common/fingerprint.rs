//! Whether two flights were the same, down to the last bit.

use std::hash::{DefaultHasher, Hasher as _};

use sim_host::record::{Navigation, Recorder, Row};

/// Hashes of what was true and of what was believed, over the whole flight; nothing else is kept of it.
#[derive(Clone, Debug, Default)]
pub(crate) struct Fingerprint {
    truth: DefaultHasher,
    believed: DefaultHasher,
}

impl Fingerprint {
    /// Of the truth, and of what was believed.
    pub(crate) fn hashes(&self) -> [u64; 2] {
        [self.truth.finish(), self.believed.finish()]
    }
}

impl Recorder for Fingerprint {
    fn record(&mut self, row: &Row) {
        let motion = row.position.iter().chain(&row.velocity).chain(&row.attitude).chain(&row.rates);
        for value in motion.chain(&row.omega).chain(&row.omega_command) {
            self.truth.write_u64(value.to_bits());
        }
    }

    fn navigate(&mut self, navigation: &Navigation) {
        let nav = navigation.nav;
        let motion = nav.position.iter().chain(nav.velocity.iter()).chain(nav.attitude.coords.iter());
        for value in motion.chain(nav.rates.iter()).chain(&navigation.filter.sigma).chain(&navigation.filter.wind) {
            self.believed.write_u32(value.to_bits());
        }
        for reading in navigation.filtered.into_iter().flat_map(|output| &output.consistency) {
            self.believed.write_u32(reading.verdict.nis.to_bits());
        }
    }
}

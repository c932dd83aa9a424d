//! The ground stations that are heard over the link, and lost when they fall silent.
//!
//! Measured by the wall clock: ground stations send one heartbeat per second of it, however fast the simulation runs.

use std::net::SocketAddr;
use std::time::{Duration, Instant};

/// A ground station that has been silent this long is lost.
pub const LOST_AFTER: Duration = Duration::from_secs(5);
/// More are not kept, so that a port scan cannot make the list grow.
const STATIONS_MAX: usize = 16;

/// A change among the ground stations.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum News {
    /// Heard for the first time, or again.
    Heard {
        /// Its address.
        address: SocketAddr,
        /// Its MAVLink system.
        system: u8,
    },
    /// Silent for [`LOST_AFTER`].
    Lost {
        /// Its address.
        address: SocketAddr,
        /// Its MAVLink system.
        system: u8,
    },
    /// Found no free link.
    TurnedAway {
        /// Its address.
        address: SocketAddr,
    },
}

#[derive(Clone, Copy, Debug)]
struct Station {
    address: SocketAddr,
    system: u8,
    heard: Instant,
    /// Whether its appearance was reported.
    reported: bool,
}

/// The ground stations that are heard.
#[derive(Clone, Debug, Default)]
pub struct Stations {
    all: Vec<Station>,
    /// Who found no free link, and whether that was reported.
    turned_away: Vec<(SocketAddr, bool)>,
}

impl Stations {
    /// A valid frame has come.
    pub fn hear(&mut self, address: SocketAddr, system: u8, now: Instant) {
        if let Some(station) = self.all.iter_mut().find(|station| station.address == address) {
            station.heard = now;
        } else if self.all.len() < STATIONS_MAX {
            self.all.push(Station { address, system, heard: now, reported: false });
        }
    }

    /// Someone has found no free link, which is reported once.
    pub fn turn_away(&mut self, address: SocketAddr) {
        let is_new = self.turned_away.iter().all(|(known, _)| *known != address);
        if is_new && self.turned_away.len() < STATIONS_MAX {
            self.turned_away.push((address, false));
        }
    }

    /// The next change that was not reported yet, if any.
    pub fn news(&mut self, now: Instant) -> Option<News> {
        if let Some(new) = self.all.iter_mut().find(|station| !station.reported) {
            new.reported = true;
            return Some(News::Heard { address: new.address, system: new.system });
        }
        if let Some((address, reported)) = self.turned_away.iter_mut().find(|(_, reported)| !reported) {
            *reported = true;
            return Some(News::TurnedAway { address: *address });
        }
        let lost = self.all.iter().position(|station| now.saturating_duration_since(station.heard) > LOST_AFTER)?;
        let Station { address, system, .. } = self.all.swap_remove(lost);
        Some(News::Lost { address, system })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn address(port: u16) -> SocketAddr {
        SocketAddr::from(([127, 0, 0, 1], port))
    }

    #[test]
    fn a_station_is_told_when_it_comes_when_it_is_lost_and_when_it_is_back() {
        let (mut stations, start) = (Stations::default(), Instant::now());
        let at = |seconds: u64| start + Duration::from_secs(seconds);
        let (address, system) = (address(14550), 255);
        for second in 0..3 {
            stations.hear(address, system, at(second));
        }
        assert_eq!(stations.news(at(3)), Some(News::Heard { address, system }));
        assert_eq!(stations.news(at(7)), None);
        assert_eq!(stations.news(at(8)), Some(News::Lost { address, system }));
        assert_eq!(stations.news(at(100)), None);
        stations.hear(address, system, at(100));
        assert_eq!(stations.news(at(100)), Some(News::Heard { address, system }));
    }

    #[test]
    fn who_finds_no_link_is_told_once() {
        let (mut stations, now) = (Stations::default(), Instant::now());
        for _ in 0..3 {
            stations.turn_away(address(1));
        }
        assert_eq!(stations.news(now), Some(News::TurnedAway { address: address(1) }));
        assert_eq!(stations.news(now), None);
    }

    #[test]
    fn there_are_never_too_many() {
        let (mut stations, now) = (Stations::default(), Instant::now());
        for port in 1..1000 {
            stations.hear(address(port), 255, now);
        }
        assert_eq!(stations.all.len(), STATIONS_MAX);
    }
}

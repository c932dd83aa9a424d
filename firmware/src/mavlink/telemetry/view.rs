//! What a job's messages are made of: the snapshot of the vehicle, and where it is on Earth.

use nalgebra::Vector3;

use crate::frames::{LocalFrame, Origin, flip_vector};
use crate::latest::Latest;
use crate::mavlink::radio::Channels;
use crate::mavlink::sticks::Hands;
use crate::mavlink::{GroundInput, Identity};
use crate::settings::Settings;
use crate::signals::{NavHealth, TICK_US, Tick};

/// A GNSS solution that was measured longer ago than this is no solution any more, ticks.
const GNSS_SILENT_AFTER: Tick = 2_000;

/// The local frame on Earth, with heights above mean sea level.
#[derive(Clone, Copy, Debug)]
pub(in crate::mavlink) struct Map {
    frame: LocalFrame,
    separation_mm: i32,
}

/// A place on Earth.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::mavlink) struct Place {
    /// Latitude, 1e-7°.
    pub(in crate::mavlink) latitude_e7: i32,
    /// Longitude, 1e-7°.
    pub(in crate::mavlink) longitude_e7: i32,
    /// Height above mean sea level, mm.
    pub(in crate::mavlink) height_msl_mm: i32,
}

impl Map {
    fn new(origin: &Origin) -> Self {
        Self { frame: LocalFrame::new(origin.place), separation_mm: origin.separation_mm }
    }

    /// The place of a position, m.
    pub(in crate::mavlink) fn place(&self, position: &Vector3<f32>) -> Place {
        let place = self.frame.to_geodetic(position);
        Place {
            latitude_e7: place.latitude_e7,
            longitude_e7: place.longitude_e7,
            height_msl_mm: place.height_mm.saturating_sub(self.separation_mm),
        }
    }

    /// The position of a place, m.
    pub(in crate::mavlink) fn position(&self, place: &Place) -> Vector3<f32> {
        self.frame.to_local(&crate::sensors::Geodetic {
            latitude_e7: place.latitude_e7,
            longitude_e7: place.longitude_e7,
            height_mm: place.height_msl_mm.saturating_add(self.separation_mm),
        })
    }
}

/// What the messages of one job are made of.
#[derive(Clone, Copy, Debug)]
pub(in crate::mavlink) struct View<'a> {
    /// When the job was released.
    pub(in crate::mavlink) now: Tick,
    /// The vehicle then.
    pub(in crate::mavlink) input: &'a GroundInput,
    /// Where the local frame is; `None` while that is unknown.
    pub(in crate::mavlink) map: Option<Map>,
    /// Who the vehicle is.
    pub(in crate::mavlink) us: Identity,
    /// Charge of the battery, %; −1 while it is unknown.
    pub(in crate::mavlink) battery_percent: i8,
    /// Height of a take-off that names none, m.
    pub(in crate::mavlink) take_off_m: f32,
    /// Horizontal speed for which none is given, m/s.
    pub(in crate::mavlink) cruise_m_s: f32,
    /// What was read last, on whatever link.
    pub(in crate::mavlink) latest: Latest,
    /// A radio's channels, unless they are lost, and whether there ever were any.
    pub(in crate::mavlink) channels: Option<Channels>,
    pub(in crate::mavlink) has_had_channels: bool,
    /// Age at which sticks are lost, s.
    pub(in crate::mavlink) stick_loss_s: f32,
    /// Bytes that this link has lost since boot, and frames with a wrong checksum and answers that were lost since it was
    /// opened.
    pub(in crate::mavlink) errors: u32,
}

impl<'a> View<'a> {
    /// A job's view. `set_origin` is an origin that a ground station has set, which GNSS overrules.
    pub(in crate::mavlink) fn new(
        now: Tick,
        input: &'a GroundInput,
        us: Identity,
        settings: &Settings,
        set_origin: Option<&Origin>,
    ) -> Self {
        let map = input.origin().as_ref().or(set_origin).map(Map::new);
        let charge = input.battery().and_then(|battery| settings.charge(&battery));
        Self {
            now,
            input,
            us,
            battery_percent: charge.map_or(-1, |charge| (charge * 100.0 + 0.5) as i8),
            take_off_m: settings.take_off_height_m(),
            cruise_m_s: settings.cruise_m_s(),
            map,
            latest: Latest::default(),
            channels: None,
            has_had_channels: false,
            stick_loss_s: settings.stick_loss_s(),
            errors: 0,
        }
    }

    /// Time since boot, µs.
    pub(in crate::mavlink) fn boot_us(&self) -> u64 {
        u64::from(self.now) * u64::from(TICK_US)
    }

    /// Time since boot, ms.
    pub(in crate::mavlink) fn boot_ms(&self) -> u32 {
        // A tick is a millisecond now; this holds for other lengths too.
        (self.boot_us() / 1000) as u32
    }

    /// The same with a radio's channels.
    pub(in crate::mavlink) fn with_channels(self, hands: &Hands) -> Self {
        let channels = hands.channels_within(self.now, self.stick_loss_s).copied();
        Self { channels, has_had_channels: hands.has_had_channels(), ..self }
    }

    /// Whether there are sticks or channels that are not lost.
    pub(in crate::mavlink) fn has_sticks(&self) -> bool {
        self.channels.is_some() || self.latest.sticks_within(self.now, self.stick_loss_s).is_some()
    }

    /// What is known of the motion.
    pub(in crate::mavlink) fn known(&self) -> NavHealth {
        match &self.input.estimator {
            Some(status) => status.health,
            None if self.input.health.nav_fresh => NavHealth::ALL,
            None => NavHealth::NONE,
        }
    }

    /// Whether position and velocity are known in all directions.
    pub(in crate::mavlink) fn knows_position(&self) -> bool {
        let NavHealth { position, velocity, height, climb, .. } = self.known();
        position && velocity && height && climb
    }

    /// Velocity, m/s: north, east, down.
    pub(in crate::mavlink) fn velocity_ned(&self) -> Vector3<f32> {
        flip_vector(&self.input.nav.velocity)
    }

    /// The vehicle's place; `None` while the map or the position is unknown.
    pub(in crate::mavlink) fn place(&self) -> Option<Place> {
        let map = self.map.filter(|_| self.knows_position())?;
        Some(map.place(&self.input.nav.position))
    }

    /// Height above mean sea level, m.
    pub(in crate::mavlink) fn height_msl_m(&self) -> Option<f32> {
        let map = self.map.filter(|_| self.known().height)?;
        Some(map.place(&self.input.nav.position).height_msl_mm as f32 * 1e-3)
    }

    /// Height above mean sea level of the ground where the vehicle was armed, m.
    pub(in crate::mavlink) fn ground_msl_m(&self) -> Option<f32> {
        let nav = &self.input.nav.position;
        let ground = Vector3::new(nav.x, nav.y, self.input.ground_m);
        Some(self.map?.place(&ground).height_msl_mm as f32 * 1e-3)
    }

    /// Height above home, m.
    pub(in crate::mavlink) fn height_over_home_m(&self) -> Option<f32> {
        let home = self.input.home.filter(|_| self.known().height)?;
        Some(self.input.nav.position.z - home.z)
    }

    /// The estimated wind and its standard deviations per axis, m/s: at first a calm, of which nothing is known.
    pub(in crate::mavlink) fn wind(&self) -> Option<([f32; 2], [f32; 2])> {
        self.input.estimator.as_ref().map(|status| (status.wind, status.wind_sigma))
    }

    /// The same, once it has been observed.
    pub(in crate::mavlink) fn observed_wind(&self) -> Option<[f32; 2]> {
        /// Greatest deviation of a wind that counts as observed, m/s: some 40 % of the one that is assumed before.
        const SIGMA_MAX: f32 = 2.0;
        let (wind, sigma) = self.wind()?;
        sigma.iter().all(|sigma| *sigma < SIGMA_MAX).then_some(wind)
    }

    /// The last GNSS solution, unless it is old.
    pub(in crate::mavlink) fn gnss(&self) -> Option<&'a crate::sensors::GnssSample> {
        let gnss = self.input.sensors.as_ref()?.gnss.as_ref();
        gnss.filter(|gnss| self.now.wrapping_sub(gnss.at) <= GNSS_SILENT_AFTER)
    }

    /// UTC now, µs since 1970.
    pub(in crate::mavlink) fn utc_us(&self) -> Option<u64> {
        // The time of an old solution is as good: both clocks run on.
        let gnss = self.input.sensors.as_ref()?.gnss.as_ref()?;
        let since = u64::from(self.now.wrapping_sub(gnss.at)) * u64::from(TICK_US);
        gnss.utc_us.map(|utc| utc.saturating_add(since))
    }
}

/// A value as an integer of a message, limited to the type's range; NaN is 0.
pub(super) fn limited_i16(value: f32) -> i16 {
    let rounded = if value < 0.0 { value - 0.5 } else { value + 0.5 };
    rounded as i16
}

/// The same, from 0 to one below the greatest value, which means unknown.
pub(super) fn limited_u16(value: f32) -> u16 {
    ((value + 0.5) as u16).min(u16::MAX - 1)
}

/// The same without a value for unknown.
pub(super) fn limited_u32(value: f32) -> u32 {
    (value + 0.5) as u32
}

/// A heading ψ of NWU, rad, as one clockwise from north, degrees in [0, 360).
pub(super) fn heading_deg(yaw: f32) -> f32 {
    let clockwise = -yaw.to_degrees();
    if clockwise < 0.0 { clockwise + 360.0 } else { clockwise }
}

//! The estimator's report to pilots: which sensors are present and healthy, and how consistent their readings are.

use super::filter::{Consistency, FilterReport, Source};
use super::update::gate;
use crate::frames::Origin;
use crate::sensors::BatterySample;
use crate::signals::{NavHealth, Tick};

/// A sensor is unhealthy if none of its readings has been fused for this long, ticks.
const SILENT_AFTER: Tick = 1_500;
/// Number of [`Source`]s.
const SOURCES: usize = Source::Rest as usize + 1;

/// Record of one kind of measurement.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
struct Kind {
    /// When one was last fused.
    accepted: Option<Tick>,
    /// NIS of the newest one over the gate.
    ratio: f32,
}

/// Record of every kind of measurement.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Fusion {
    kinds: [Kind; SOURCES],
}

/// Whether a sensor is present and healthy.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Sensor {
    /// A reading of it has been fused since boot.
    pub present: bool,
    /// A reading of it has been fused within the last 1.5 s.
    pub healthy: bool,
}

/// The estimator's report.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Status {
    /// Which components of the motion may be trusted.
    pub health: NavHealth,
    /// Magnetometer.
    pub mag: Sensor,
    /// Barometer.
    pub baro: Sensor,
    /// Satellite receiver.
    pub gnss: Sensor,
    /// Motion capture.
    pub pose: Sensor,
    /// Battery monitor.
    pub battery: Sensor,
    /// The last sample of the battery monitor.
    pub battery_sample: Option<BatterySample>,
    /// Ratio of the normalised innovation squared to its gate, for velocity, horizontal position, height and heading.
    /// Above 1 the reading was refused.
    pub ratios: [f32; 4],
    /// Standard deviations of horizontal position and height, m.
    pub accuracy_m: [f32; 2],
    /// Standard deviations of attitude (rad), velocity (m/s) and position (m), three components each.
    pub sigma: [f32; 9],
    /// Estimated wind, x and y, m/s.
    pub wind: [f32; 2],
    /// Its standard deviations, m/s.
    pub wind_sigma: [f32; 2],
    /// Where the local frame's origin is on Earth; `None` before the first GNSS fix.
    pub origin: Option<Origin>,
}

impl Fusion {
    /// Records the measurements of a job whose output took effect at `now`.
    pub fn note(&mut self, now: Tick, readings: &[Consistency]) {
        for reading in readings {
            if let Some(kind) = self.kinds.get_mut(reading.source as usize) {
                kind.ratio = reading.verdict.nis / gate_of(reading.source);
                if reading.verdict.accepted {
                    kind.accepted = Some(now);
                }
            }
        }
    }

    fn kind(&self, source: Source) -> Kind {
        self.kinds.get(source as usize).copied().unwrap_or_default()
    }

    fn sensor(&self, now: Tick, source: Source) -> Sensor {
        let accepted = self.kind(source).accepted;
        Sensor { present: accepted.is_some(), healthy: accepted.is_some_and(|at| now.wrapping_sub(at) <= SILENT_AFTER) }
    }

    /// The ratio of whichever of two kinds was fused last.
    fn newer(&self, now: Tick, one: Source, other: Source) -> f32 {
        let age = |kind: &Kind| kind.accepted.map_or(Tick::MAX, |at| now.wrapping_sub(at));
        let (one, other) = (self.kind(one), self.kind(other));
        if age(&other) < age(&one) { other.ratio } else { one.ratio }
    }

    /// The report at `now`, from the filter's last report, the health, and the last battery sample with its age in
    /// ticks.
    pub fn status(
        &self,
        now: Tick,
        filter: &FilterReport,
        health: NavHealth,
        battery: Option<(BatterySample, u32)>,
    ) -> Status {
        let [.., x, y, z] = filter.sigma;
        Status {
            health,
            mag: self.sensor(now, Source::Heading),
            baro: self.sensor(now, Source::Baro),
            gnss: self.sensor(now, Source::GnssPosition),
            pose: self.sensor(now, Source::PosePosition),
            battery: Sensor {
                present: battery.is_some(),
                healthy: battery.is_some_and(|(_, age)| age <= SILENT_AFTER),
            },
            battery_sample: battery.map(|(sample, _)| sample),
            ratios: [
                self.kind(Source::GnssVelocity).ratio,
                self.newer(now, Source::GnssPosition, Source::PosePosition),
                self.newer(now, Source::Baro, Source::GnssHeight),
                self.kind(Source::Heading).ratio,
            ],
            accuracy_m: [crate::math::sqrt(x * x + y * y), z],
            sigma: filter.sigma,
            wind: filter.wind,
            wind_sigma: filter.wind_sigma,
            origin: filter.origin,
        }
    }
}

/// The gate of a kind of measurement.
fn gate_of(source: Source) -> f32 {
    match source {
        Source::Heading | Source::Baro | Source::GnssHeight => gate::<1>(),
        Source::GnssPosition | Source::Drag => gate::<2>(),
        Source::GnssVelocity | Source::PosePosition | Source::PoseAttitude | Source::Rest => gate::<3>(),
    }
}

#[cfg(test)]
mod tests {
    use super::super::update::Verdict;
    use super::*;

    fn reading(source: Source, nis: f32, accepted: bool) -> Consistency {
        Consistency { source, verdict: Verdict { nis, accepted } }
    }

    fn status(fusion: &Fusion, now: Tick) -> Status {
        fusion.status(now, &FilterReport::NONE, NavHealth::ALL, None)
    }

    #[test]
    fn a_sensor_is_present_once_heard_and_well_while_its_readings_are_taken_in() {
        let mut fusion = Fusion::default();
        assert_eq!(status(&fusion, 0).baro, Sensor::default());
        fusion.note(100, &[reading(Source::Baro, 2.5, true), reading(Source::GnssPosition, 100.0, false)]);
        let well = Sensor { present: true, healthy: true };
        assert_eq!((status(&fusion, 1_600).baro, status(&fusion, 1_600).gnss), (well, Sensor::default()));
        fusion.note(1_000, &[reading(Source::Baro, 50.0, false)]);
        assert_eq!(status(&fusion, 1_601).baro, Sensor { present: true, healthy: false });
    }

    #[test]
    fn ratios_are_in_units_of_the_gate_and_of_the_source_in_use() {
        let mut fusion = Fusion::default();
        fusion.note(100, &[reading(Source::Baro, 2.5, true), reading(Source::GnssVelocity, 64.0, false)]);
        assert_eq!(status(&fusion, 200).ratios, [2.0, 0.0, 0.1, 0.0]);
        fusion.note(300, &[reading(Source::GnssHeight, 12.5, true), reading(Source::Heading, 5.0, true)]);
        assert_eq!(status(&fusion, 300).ratios, [2.0, 0.0, 0.5, 0.2]);
    }

    #[test]
    fn a_battery_that_is_not_measured_any_more_is_not_well() {
        let sample = BatterySample { voltage_v: 15.0, current_a: 12.0 };
        let at = |age| Fusion::default().status(0, &FilterReport::NONE, NavHealth::ALL, Some((sample, age))).battery;
        assert_eq!(at(1_500), Sensor { present: true, healthy: true });
        assert_eq!(at(1_501), Sensor { present: true, healthy: false });
    }
}

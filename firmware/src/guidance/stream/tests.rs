//! Streams of set-points against closed forms in double precision: accuracy, limits, continuity.

mod hard;
mod smooth;
mod steps;

use super::*;

const LIMITS: ModeSettings = ModeSettings { fastest_m_s: 12.0, ..crate::guidance::setpoint::tests::LIMITS };

const FASTEST: Fastest = Fastest { speed_m_s: 12.0, acceleration_m_s2: 10.0, vertical_m_s2: 10.0 };

/// Random numbers, 0 to 1.
struct Random(u64);

impl Random {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }
}

fn circle(radius: f64, speed: f64, t: f64) -> [[f64; 3]; 3] {
    let w = speed / radius;
    let (s, c) = (w * t).sin_cos();
    [[radius * c, radius * s, 5.0], [-speed * s, speed * c, 0.0], [-speed * w * c, -speed * w * s, 0.0]]
}

/// What a companion sends, and how it arrives.
#[derive(Clone, Copy)]
struct Link {
    period_s: f64,
    /// Given besides the position.
    velocity: bool,
    acceleration: bool,
    clock: bool,
    /// Of the transport, ±s.
    jitter_s: f64,
    /// Of the first sample, s.
    phase_s: f64,
    seed: u64,
}

const LINK: Link = Link {
    period_s: 0.02002,
    velocity: false,
    acceleration: false,
    clock: false,
    jitter_s: 0.0,
    phase_s: 0.0033,
    seed: 1,
};

fn some(axes: [f64; 3]) -> [Option<f32>; 3] {
    axes.map(|axis| Some(axis as f32))
}

impl Link {
    /// The samples of a path, each with the first tick at which the outer partition sees it.
    fn samples(&self, seconds: f64, path: impl Fn(f64) -> [[f64; 3]; 3]) -> Vec<(Tick, Sample)> {
        let mut random = Random(self.seed);
        // A link keeps the order.
        let mut latest = 0.0_f64;
        let mut samples: Vec<(Tick, Sample)> = (0..(seconds / self.period_s) as u32)
            .map(|k| {
                let t = self.phase_s + f64::from(k) * self.period_s;
                let arrival = latest.max(t + self.jitter_s * 2.0 * random.next());
                latest = arrival;
                let at = ((arrival * 100.0).ceil() * 10.0) as Tick;
                let [p, v, a] = path(t);
                let mut motion = Motion::default().with_position(some(p));
                if self.velocity {
                    motion = motion.with_velocity(some(v));
                }
                if self.acceleration {
                    motion = motion.with_acceleration(some(a));
                }
                let sent_ms = self.clock.then_some((t * 1e3) as u32 + 77_000);
                (at + 6, Sample { motion, at, sent_ms })
            })
            .collect();
        samples.sort_by_key(|(seen, sample)| (*seen, sample.sent_ms));
        samples
    }

    /// Flies a path, starting on it.
    fn fly(&self, stream: &mut Stream, seconds: f64, path: impl Fn(f64) -> [[f64; 3]; 3]) -> Vec<(f64, FlatReference)> {
        fly(&self.samples(seconds, path), stream, seconds)
    }
}

/// The references, with their times, of a stream that sees samples at ticks.
fn fly(samples: &[(Tick, Sample)], stream: &mut Stream, seconds: f64) -> Vec<(f64, FlatReference)> {
    let mut next = 0;
    let mut flown = Vec::new();
    for step in 1..(seconds / 0.004) as Tick {
        let release = step * 4;
        while samples.get(next).is_some_and(|(seen, _)| *seen <= release) {
            next += 1;
        }
        if next > 0 {
            let now = release + OUTER.offset;
            flown.push((f64::from(now) * 1e-3, stream.advance(now, &samples[next - 1].1)));
        }
    }
    flown
}

fn start_on(path: impl Fn(f64) -> [[f64; 3]; 3]) -> Stream {
    let [p, v, a] = path(0.0).map(|axes| Vector3::from(axes.map(|axis| axis as f32)));
    let mut stream = Stream::new(&LIMITS, FASTEST);
    stream.start(&FlatReference { velocity: v, acceleration: a, ..FlatReference::standing(p, 0.0) });
    stream
}

fn error(r: &FlatReference, truth: [f64; 3]) -> f64 {
    r.position.iter().zip(truth).map(|(r, truth)| (f64::from(*r) - truth).powi(2)).sum::<f64>().sqrt()
}

/// RMS error at the same time after 2 s, and with the lag that makes it smallest: (m, s, m).
fn accuracy(flown: &[(f64, FlatReference)], path: impl Fn(f64) -> [[f64; 3]; 3], from: f64) -> (f64, f64, f64) {
    let rms = |lag: f64| {
        let squares: Vec<f64> =
            flown.iter().filter(|(t, _)| *t > from).map(|(t, r)| error(r, path(t - lag)[0]).powi(2)).collect();
        (squares.iter().sum::<f64>() / squares.len() as f64).sqrt()
    };
    let best = (-200..200).map(|i| f64::from(i) * 0.5e-3).min_by(|a, b| rms(*a).total_cmp(&rms(*b))).unwrap();
    (rms(0.0), best, rms(best))
}

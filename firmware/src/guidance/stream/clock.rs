//! Estimates when the samples of a stream were taken, on the vehicle's clock.
//!
//! A sample is read up to a period of the ground partition after its bytes have come, and these come with jitter. At
//! 8 m/s a jitter of 10 ms is 8 cm. Either of two clocks removes it:
//!
//! - the *sender's*, if the samples have one that advances like the vehicle's: the smallest difference of arrival and
//!   sender's time within seconds is that of a sample that has not waited;
//! - else a *regular* one: a phase and a period that follow the arrivals.

use crate::math;
use crate::schedule::GROUND;
use crate::signals::{TICK_S, Tick};

/// Longest wait of a byte for the ground partition, ticks.
const READ: f32 = GROUND.period as f32;
/// Plausible advances after which the sender's clock is trusted, if it has run as fast as the vehicle's until then: the
/// differences are spread by no more than this, ms. A clock of another rate, as of a script beside a simulation that does not
/// run in real time, leads farther away than no clock.
const TRUSTED: u8 = 25;
const EVEN_MS: i32 = 60;
/// As many count at most, and a sample that is late takes away so many.
const MOST_TRUSTED: u8 = 60;
const DISTRUST: u8 = 4;
/// A clock that was found to run at another rate is not looked at for so many samples.
const SHUNNED: u16 = 2_000;
/// Differences spread farther only if one of the clocks is wrong, ms.
const WIDEST_MS: i32 = 250;
/// A sample that is late by more is from another clock, ms.
const LATEST_MS: i32 = 200;
/// Half of the time over which the smallest difference is sought, ticks: 100 ppm of drift are 0.8 ms in all.
const WINDOW: Tick = 4_000;
/// The longest advance of a clock that is plausible, ms.
const LONGEST_MS: i32 = 1_000;
/// The difference without a wait is corrected with this rate, so that the correction is not taken for motion.
const SLEWING: f32 = 0.004;
/// A sample is not older than this when it is read, ms.
const OLDEST_MS: f32 = 200.0;
/// Error of a time of the sender's clock, s: it counts ms.
const SENT_ERROR_S: f32 = 0.002;
/// Error of a regular time in units of the mean distance of arrivals from it, and at most, ticks.
const JITTERS: f32 = 1.5;
const LARGEST_ERROR: f32 = 15.0;
/// The mean distance before any is known, ticks, and how fast it is learnt.
const JITTER: f32 = 5.0;
const JITTER_GAIN: f32 = 0.1;
/// Least gains of the regular clock's phase and period.
const PHASE_GAIN: f32 = 0.03;
const PERIOD_GAIN: f32 = 0.000_45;
/// The same numbers within so many periods are a repetition.
const EARLY: f32 = 0.75;
/// An arrival follows a lost sample if it is so many periods and so many times the mean distance after the one before. A
/// period that is learnt too short takes late ones for lost ones, and stays.
const LOST: f32 = 1.5;
const LOST_JITTERS: f32 = 2.0;
/// So many in turn are neither lost nor early: the stream has another rate.
const OTHER: u8 = 4;

/// Smallest and largest difference of arrival and sender's time, relative to the first, ms.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Span {
    low: i32,
    high: i32,
}

impl Span {
    const NONE: Self = Self { low: i32::MAX, high: i32::MIN };

    fn with(self, other: Self) -> Self {
        Self { low: self.low.min(other.low), high: self.high.max(other.high) }
    }
}

/// The sender's clock.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Sent {
    latest: Option<u32>,
    /// Plausible advances so far, less what is late.
    trust: u8,
    /// Samples for which it is not looked at.
    shunned: u16,
    regular: Regular,
    /// Difference to which the spans are relative, ms.
    base: u32,
    begun: Tick,
    /// What is taken for the difference without a wait.
    offset: f32,
    now: Span,
    before: Span,
}

/// The regular clock.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Regular {
    /// Arrivals so far, up to 255.
    count: u8,
    period: f32,
    /// Of the latest arrival behind the regular time, ticks.
    late: f32,
    /// By which the latest arrival moved the regular times, ticks.
    shift: f32,
    /// Arrivals in turn that seemed to follow lost ones, or to be early.
    skips: u8,
    /// Mean distance of arrivals from the regular times, ticks.
    jitter: f32,
}

/// When samples were taken.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Clock {
    sent: Sent,
    regular: Regular,
}

/// What a sample's times tell.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Taken {
    /// It was taken so long before its arrival; the second number is the error of that, s.
    Before(f32, f32),
    /// Before the one before: the link has changed their order.
    Late,
}

impl Sent {
    const NONE: Self = Self {
        latest: None,
        trust: 0,
        shunned: 0,
        regular: Regular::NONE,
        base: 0,
        begun: 0,
        offset: 0.0,
        now: Span::NONE,
        before: Span::NONE,
    };

    /// Whether a sample comes after a later one.
    fn is_late(&mut self, sent: Option<u32>) -> bool {
        let behind = self.latest.zip(sent).map_or(0, |(latest, sent)| latest.wrapping_sub(sent).cast_signed());
        let is_late = self.trust >= TRUSTED && behind > 0 && behind <= LATEST_MS;
        if is_late {
            self.trust -= DISTRUST;
        }
        is_late
    }

    /// Time from sample to arrival, and by how much the latest moved that, ms, if the clock is trusted.
    fn delay(&mut self, at: Tick, since: Option<i32>, sent: Option<u32>) -> Option<(f32, f32)> {
        let advance = self.latest.zip(sent).map(|(before, now)| now.wrapping_sub(before).cast_signed());
        self.latest = sent;
        let sent = sent?;
        if self.shunned > 0 {
            self.shunned -= 1;
            return None;
        }
        let is_plausible = advance.zip(since).is_some_and(|(advance, since)| {
            advance > 0 && advance <= LONGEST_MS && (advance - since).abs() <= 50 + since / 2
        });
        if is_plausible {
            self.trust = (self.trust + 1).min(MOST_TRUSTED);
        } else {
            *self = Self { latest: Some(sent), base: at.wrapping_sub(sent), begun: at, ..Self::NONE };
        }
        // The clock counts whole ms: between them a regular time is better.
        let fraction = math::clamp(0.5 - self.regular.late(advance), 0.0, 1.0);
        let difference = at.wrapping_sub(sent).wrapping_sub(self.base).cast_signed();
        self.widen(at, difference);
        // Arrivals within less than the wait's range have all waited: by how much, is known within the rest of it.
        let span = self.now.with(self.before);
        let widest = if self.trust <= TRUSTED { EVEN_MS } else { WIDEST_MS };
        if span.high - span.low > widest {
            *self = Self { latest: Some(sent), base: at.wrapping_sub(sent), begun: at, shunned: SHUNNED, ..Self::NONE };
            return None;
        }
        if self.trust < TRUSTED {
            return None;
        }
        let waited = 0.5 * math::max(READ - (span.high - span.low) as f32, 0.0);
        let wanted = span.low as f32 - waited - self.offset;
        let most = if self.trust == TRUSTED { f32::MAX } else { SLEWING * advance.unwrap_or(0) as f32 };
        let shift = math::limit(wanted, most);
        self.offset += shift;
        let offset = self.offset;
        Some((difference as f32 - offset - fraction, math::abs(shift)))
    }

    /// Takes a difference into the span, and forgets those of two windows before.
    fn widen(&mut self, at: Tick, difference: i32) {
        if at.wrapping_sub(self.begun) > WINDOW {
            (self.before, self.now, self.begun) = (self.now, Span::NONE, at);
        }
        self.now = self.now.with(Span { low: difference, high: difference });
    }
}

impl Regular {
    const NONE: Self = Self { count: 0, period: 20.0, late: 0.0, shift: 0.0, skips: 0, jitter: JITTER };

    /// Time from the regular time to one that is `since` after the one before.
    fn late(&mut self, since: Option<i32>) -> f32 {
        match since {
            Some(since) if since > 0 && since <= LONGEST_MS => self.advance(since as f32),
            _ => *self = Self { count: 1, ..Self::NONE },
        }
        self.late
    }

    /// Follows an arrival `since` the one before by the gains of a line fitted to all, down to the least gains.
    fn advance(&mut self, since: f32) {
        if self.count < 2 {
            (self.period, self.count) = (since, 2);
            return;
        }
        let elapsed = since + self.late;
        let is_next = elapsed < LOST * self.period + math::max(LOST_JITTERS * self.jitter, 0.6 * READ);
        let is_regular = is_next && since > 0.5 * self.period;
        self.skips = if is_regular { 0 } else { self.skips + 1 };
        if self.skips >= OTHER {
            // None is lost: they come at another rate.
            *self = Self { count: 2, period: since, ..Self::NONE };
            return;
        }
        let periods = if is_next { 1.0 } else { (elapsed / self.period + 0.5) as i32 as f32 };
        let residual = elapsed - periods * self.period;
        self.count = self.count.saturating_add(1);
        let n = self.count as f32;
        let line = 2.0 / (n * (n + 1.0));
        self.shift = residual * math::max((2.0 * n - 1.0) * line, PHASE_GAIN);
        self.late = residual - self.shift;
        self.jitter += (math::abs(residual) - self.jitter) * JITTER_GAIN;
        let period = self.period + residual / periods * math::max(3.0 * line, PERIOD_GAIN);
        self.period = math::clamp(period, 2.0, LONGEST_MS as f32);
    }
}

impl Clock {
    /// A clock before the first sample.
    pub(super) const NONE: Self = Self { sent: Sent::NONE, regular: Regular::NONE };

    /// Whether a sample comes so early, `since` ticks after the one before, that it may be the same once more.
    pub(super) fn is_early(&self, since: i32) -> bool {
        self.regular.count > 1 && (since as f32) < EARLY * self.regular.period
    }

    /// Takes a sample that arrived at a tick, `since` ticks after the one before.
    pub(super) fn take(&mut self, at: Tick, since: Option<i32>, sent: Option<u32>) -> Taken {
        if self.sent.is_late(sent) {
            return Taken::Late;
        }
        let regular = self.regular.late(since) + 0.5 * READ;
        let (delay, error_s) = if let Some((delay, shift)) = self.sent.delay(at, since, sent) {
            (delay, SENT_ERROR_S + TICK_S * shift)
        } else {
            let error = 1.0 + JITTERS * self.regular.jitter;
            (regular, TICK_S * (math::min(error, LARGEST_ERROR) + math::abs(self.regular.shift)))
        };
        Taken::Before(math::clamp(delay, -OLDEST_MS, OLDEST_MS) * TICK_S, error_s)
    }
}

//! Progress on standard error, so that standard output stays the result. Hidden when standard error is not a terminal
//! or when the caller wants none (`--json`). The bar shows simulated time; it never reads the wall clock for the
//! flight, only for its own remaining-time estimate.

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

use crate::interrupt;
use crate::record::{Recorder, Row};

/// Simulated time between two updates, ms: 400 updates in a 20 s flight, nothing beside its 20,000 ticks.
const UPDATE_MS: u64 = 50;

/// A recorder that shows how far a flight is, and ends it when the user asks for that.
pub struct Progress {
    bar: ProgressBar,
    next_ms: u64,
    stops: bool,
}

impl Progress {
    /// A bar for a flight of `duration_s` simulated seconds.
    pub fn new(duration_s: f64, visible: bool) -> Self {
        let bar = bar((duration_s * 1e3).round() as u64, visible);
        bar.set_style(style("flying {bar:40} {percent:>3} %, {eta} left"));
        Self { bar, next_ms: UPDATE_MS, stops: false }
    }

    /// Takes the bar off the screen.
    pub fn finish(self) {
        self.bar.finish_and_clear();
    }
}

impl Recorder for Progress {
    fn record(&mut self, row: &Row) {
        let now_ms = (row.t * 1e3).round() as u64;
        if now_ms >= self.next_ms {
            self.bar.set_position(now_ms);
            self.next_ms = now_ms.saturating_add(UPDATE_MS);
            self.stops = interrupt::requested();
        }
    }

    fn stops(&self) -> bool {
        self.stops
    }
}

/// A bar for many flights, one step each; clones of it may be moved to the threads that fly.
pub fn of_flights(count: u64, visible: bool) -> ProgressBar {
    let bar = bar(count, visible);
    bar.set_style(style("flights {bar:40} {pos}/{len}, {eta} left"));
    bar
}

/// A bar for a search of `count` evaluations; its message is the best cost so far.
pub fn of_search(count: u64, visible: bool) -> ProgressBar {
    let bar = bar(count, visible);
    bar.set_style(style("tuning {bar:40} {pos}/{len}, best {msg}, {eta} left"));
    bar
}

fn bar(length: u64, visible: bool) -> ProgressBar {
    // `stderr()` hides itself where standard error is not a terminal.
    let target = if visible { ProgressDrawTarget::stderr() } else { ProgressDrawTarget::hidden() };
    ProgressBar::with_draw_target(Some(length), target)
}

fn style(template: &str) -> ProgressStyle {
    ProgressStyle::with_template(template).expect("the template is a constant that a test has seen")
}

#[cfg(test)]
mod tests {
    use super::*;

    fn row(t: f64) -> Row {
        Row { t, ..Row::default() }
    }

    #[test]
    fn moves_every_fiftieth_tick() {
        let mut progress = Progress::new(2.0, false);
        let mut seen = Vec::new();
        for k in 0..=200 {
            progress.record(&row(f64::from(k) / 1000.0));
            seen.push(progress.bar.position());
        }
        seen.dedup();
        assert_eq!(seen, [0, 50, 100, 150, 200]);
        assert_eq!(progress.bar.length(), Some(2000));
        progress.finish();
    }

    #[test]
    fn hidden_bars_are_hidden() {
        assert!(Progress::new(1.0, false).bar.is_hidden());
        let flights = of_flights(8, false);
        flights.inc(3);
        assert!(flights.is_hidden());
        assert_eq!((flights.position(), flights.length()), (3, Some(8)));
        assert!(of_search(8, false).is_hidden());
    }
}

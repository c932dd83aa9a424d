//! What a flight was doing behind what is drawn of it: phases, faults, events.

use super::style::{Color, INK, Key, Role, palette};
use super::svg::{Anchor, Area, Font, Stroke, text_width};

/// Height of the strip of one kind's names.
const STRIP: f64 = 17.0;
const SIZE: f64 = 11.5;
/// The event that ends a flight.
pub(super) const DISARMED: &str = "disarmed";
/// The phase that begins a flight, and those that are none.
const TAKE_OFF: &str = "take-off";
const IDLING: [&str; 2] = ["armed", "landed"];
/// How strong a phase's colour is behind its name, and behind the lines.
const STRIP_TINT: f64 = 0.45;
const SHADE_TINT: f64 = 0.16;

/// A stretch of a flight with its name.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Span {
    pub(super) name: String,
    /// s.
    pub(super) from: f64,
    pub(super) to: f64,
    pub(super) color: Color,
}

impl Span {
    fn kind(&self) -> &str {
        kind_of(&self.name)
    }
}

/// A phase's name without its number: `go-to 2` is a `go-to`.
fn kind_of(name: &str) -> &str {
    name.trim_end_matches(|c: char| c.is_ascii_digit() || c == ' ')
}

/// Phases, faults and events of a flight, drawn behind a panel over time.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Backdrop {
    pub(super) phases: Vec<Span>,
    pub(super) faults: Vec<Span>,
    /// Events with their times, s.
    pub(super) events: Vec<(f64, String)>,
    /// When it first landed, s; before all times, if it never flew.
    pub(super) landed: Option<f64>,
    /// Whether names stand above the panel, or the shades alone are drawn.
    pub(super) named: bool,
}

impl Backdrop {
    /// The same with names above the panel.
    pub(super) fn named(&self) -> Self {
        Self { named: true, ..self.clone() }
    }

    /// The legend's entries of phases, each once, and of faults.
    pub(super) fn keys(&self) -> Vec<Key<'_>> {
        let faults = (!self.faults.is_empty()).then_some(Key::Line("fault or push", Role::Fault));
        self.phases_once().map(|(name, color)| Key::Series(name, color.tint(STRIP_TINT))).chain(faults).collect()
    }

    /// The legend's entries of legs in the colours of phases.
    pub(super) fn leg_keys(&self) -> Vec<Key<'_>> {
        self.phases_once().map(|(name, color)| Key::Line(name, Role::Leg(color))).collect()
    }

    fn phases_once(&self) -> impl Iterator<Item = (&str, Color)> {
        let mut seen: Vec<&Span> = Vec::new();
        for span in &self.phases {
            if seen.iter().all(|known| known.kind() != span.kind()) {
                seen.push(span);
            }
        }
        seen.into_iter().map(|span| (span.kind(), span.color))
    }

    /// When all is over, s: it was disarmed, and did not fly again. Infinite, if it was not.
    pub(super) fn end(&self) -> f64 {
        let flown = self.phases.last().map_or(f64::INFINITY, |phase| phase.to);
        time_of(&self.events, DISARMED).filter(|t| *t >= flown).unwrap_or(f64::INFINITY)
    }

    /// False if it stood on the ground from beginning to end.
    pub(super) fn has_flown(&self) -> bool {
        self.landed != Some(f64::NEG_INFINITY)
    }

    /// Whether the vehicle flies at `t`, s: always, where nothing is known of phases. What it is to do before and after
    /// is no reference to compare with.
    pub(super) fn flies(&self, t: f64) -> bool {
        let flies = || self.phases.is_empty() || self.phases.iter().any(|span| (span.from..span.to).contains(&t));
        let landed = self.landed.is_some_and(|landed| t >= landed);
        if landed { self.flies_again(t) } else { flies() }
    }

    /// Whether it flies at `t`, s, after the first landing: once it has taken off again, wherever it does not stand with
    /// rotors idling.
    fn flies_again(&self, t: f64) -> bool {
        let landed = self.landed.unwrap_or(f64::INFINITY);
        let again = self.phases.iter().find(|span| span.kind() == TAKE_OFF && span.from > landed);
        let now = self.phases.iter().find(|span| (span.from..span.to).contains(&t));
        again.is_some_and(|again| t >= again.from) && now.is_some_and(|now| !IDLING.contains(&now.kind()))
    }

    /// Rows of names, from the bottom: phases, faults, events.
    fn strips(&self) -> [bool; 3] {
        [!self.phases.is_empty(), !self.faults.is_empty(), !self.events.is_empty()].map(|any| any && self.named)
    }

    /// Pixels that the names need above a panel.
    pub(super) fn height(&self) -> f64 {
        STRIP * self.strips().iter().filter(|strip| **strip).count() as f64
    }

    /// The middle of a kind's strip, above the panel's upper edge.
    fn strip(&self, kind: usize) -> Option<f64> {
        let strips = self.strips();
        let below = strips[..kind].iter().filter(|strip| **strip).count() as f64;
        strips[kind].then_some(-STRIP * (below + 0.5))
    }

    /// Draws shades and names into a panel whose horizontal axis shows `range`, s.
    pub(super) fn draw(&self, chart: &Area, range: (f64, f64)) {
        for span in &self.phases {
            draw_phase(chart, range, span, self.strip(0));
        }
        for span in &self.faults {
            self.draw_fault(chart, range, span);
        }
    }

    /// A fault: bars at both ends and a line along the upper edge, so that the phases show below it.
    fn draw_fault(&self, chart: &Area, range: (f64, f64), span: &Span) {
        let (left, right) = (place(chart, range, span.from), place(chart, range, span.to));
        if right <= left {
            return;
        }
        let edge = Stroke { color: span.color, width: 1.2, dashed: true };
        chart.line([(left, chart.height), (left, 0.0)], edge);
        if span.to < range.1 {
            chart.line([(right, 0.0), (right, chart.height)], edge);
        }
        let Some(middle) = self.strip(1) else {
            chart.line([(left, -2.5), (right, -2.5)], Role::Fault.stroke());
            return;
        };
        chart.rectangle((left, middle - 0.5 * STRIP), (right, middle + 0.5 * STRIP), span.color.tint(0.3));
        // A name that does not fit goes on beyond a short fault, or to its left.
        let wide = text_width(&span.name, SIZE);
        let (x, anchor) = match () {
            () if wide < right - left => (left + 4.0, Anchor::Start),
            () if right + wide + 4.0 < chart.width => (right + 4.0, Anchor::Start),
            () => (left - 4.0, Anchor::End),
        };
        chart.text((x, middle), &span.name, Font::new(SIZE, anchor));
    }

    /// Draws a line at each event, and its name above.
    pub(super) fn draw_events(&self, chart: &Area, range: (f64, f64)) {
        let stroke = Stroke { color: INK, width: 1.0, dashed: true };
        let shown: Vec<_> = self.events.iter().filter(|(t, _)| (range.0..=range.1).contains(t)).collect();
        let names: Vec<_> = shown.iter().map(|(t, name)| (place(chart, range, *t), text_width(name, SIZE))).collect();
        let strip = self.strip(2);
        let top = strip.map_or(0.0, |middle| middle + 0.5 * STRIP);
        for (((_, name), (x, _)), left) in shown.iter().zip(&names).zip(apart(&names, chart.width)) {
            chart.line([(*x, top), (*x, chart.height)], stroke);
            if let Some(middle) = strip {
                chart.text((left, middle), name, Font::new(SIZE, Anchor::Start));
            }
        }
    }
}

/// Left edges of names (the middle that each would have, and its width) that do not overlap and end within `width`.
fn apart(names: &[(f64, f64)], width: f64) -> Vec<f64> {
    // Of the fonts that a viewer may have the widest takes 4.5 pixels more for `touchdown` than its width here.
    const GAP: f64 = 12.0;
    let mut free = 0.0_f64;
    let mut lefts: Vec<f64> = Vec::with_capacity(names.len());
    for (middle, wide) in names {
        let left = (middle - 0.5 * wide).max(free);
        free = left + wide + GAP;
        lefts.push(left);
    }
    let mut limit = width;
    for (left, (_, wide)) in lefts.iter_mut().zip(names).rev() {
        *left = left.min(limit - wide);
        limit = *left - GAP;
    }
    lefts
}

/// A phase: a shade, and its name where it fits; the legend has it too.
fn draw_phase(chart: &Area, range: (f64, f64), span: &Span, strip: Option<f64>) {
    let (left, right) = (place(chart, range, span.from), place(chart, range, span.to));
    if right <= left {
        return;
    }
    chart.rectangle((left, 0.0), (right, chart.height), span.color.tint(SHADE_TINT));
    let Some(middle) = strip else { return };
    // A gap shows where one of a kind follows another.
    chart.rectangle(
        (left + 0.5, middle - 0.5 * STRIP),
        (right - 0.5, middle + 0.5 * STRIP),
        span.color.tint(STRIP_TINT),
    );
    if text_width(&span.name, SIZE) < right - left {
        chart.text((f64::midpoint(left, right), middle), &span.name, Font::new(SIZE, Anchor::Middle));
    }
}

/// When something happened, s.
pub(super) fn time_of(events: &[(f64, String)], name: &str) -> Option<f64> {
    events.iter().find(|(_, known)| known == name).map(|(t, _)| *t)
}

/// Pixels from the left, within the panel.
fn place(chart: &Area, (from, to): (f64, f64), t: f64) -> f64 {
    chart.width * ((t - from) / (to - from)).clamp(0.0, 1.0)
}

/// The colour of a mode, the same in every figure.
pub(super) fn phase_color(name: &str) -> Color {
    match kind_of(name) {
        TAKE_OFF => palette::GREEN,
        "hold" => palette::SKY,
        "go-to" | "velocity" => palette::BLUE,
        "trajectory" => palette::ORANGE,
        "return" => palette::PURPLE,
        "land" | "descent" | "motor-out" => palette::VERMILION,
        _ => palette::GREY,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_vehicle_flies_again_from_its_next_take_off_on() {
        let span = |(name, from, to): (&str, f64, f64)| Span { name: name.into(), from, to, color: INK };
        let phases = [
            ("armed", 1.0, 2.0),
            ("take-off", 2.0, 4.0),
            ("land", 4.0, 7.0),
            ("landed", 7.0, 8.0),
            ("armed", 10.0, 11.0),
            ("take-off", 11.0, 13.0),
            ("land", 13.0, 16.0),
            ("landed", 16.0, 17.0),
        ];
        let twice = Backdrop { phases: phases.map(span).into(), landed: Some(6.0), ..Backdrop::default() };
        let flies = |t: f64| twice.flies(t);
        assert!([3.0, 5.0, 11.0, 15.0].into_iter().all(flies));
        assert!(![0.0, 6.0, 6.5, 7.5, 9.0, 10.5, 16.5, 18.0].into_iter().any(flies));
    }

    #[test]
    fn names_keep_apart_and_within_the_panel() {
        assert_eq!(apart(&[(10.0, 20.0), (100.0, 20.0)], 200.0), [0.0, 90.0]);
        assert_eq!(apart(&[(190.0, 20.0), (195.0, 20.0), (196.0, 20.0)], 200.0), [116.0, 148.0, 180.0]);
        assert!(apart(&[], 200.0).is_empty());
        // As wide as in DejaVu Sans, in sizes of the font.
        let (touchdown, names) = (5.53 * SIZE, ["touchdown", DISARMED].map(|name| text_width(name, SIZE)));
        let [first, second] = apart(&names.map(|wide| (500.0, wide)), 1000.0)[..] else { panic!("two names") };
        assert!(second - first > touchdown + 5.0, "a space shows between them");
    }
}

//! One diagram of a figure: lines over time or a path in a plane, with its axes.

use super::axis::{self, Quantity};
use super::backdrop::Backdrop;
use super::series::{Points, extent};
use super::style::{INK, Role, palette};
use super::svg::{Anchor, Area, Font, Stroke, text_width};

/// Room for the tick labels and the axis' name, in pixels.
pub(super) const LEFT: f64 = 68.0;
pub(super) const BELOW: f64 = 44.0;
/// The same without the horizontal axis' name.
const BELOW_TICKS: f64 = 24.0;
/// Room for the title, and to the right of the diagram.
pub(super) const ABOVE: f64 = 30.0;
pub(super) const RIGHT: f64 = 20.0;
/// Pixels from one tick to the next, at least.
const TICK_ACROSS: f64 = 62.0;
const TICK_UP: f64 = 30.0;
/// A flight is shown over this at least, s: ten ticks.
const LEAST_S: f64 = 0.01;
/// Margin above and below the lines, as a fraction of their range.
const MARGIN: f64 = 0.06;

/// One diagram of a figure.
#[derive(Clone, Debug)]
pub(super) struct Panel {
    pub(super) title: String,
    /// Horizontal quantity with its unit.
    pub(super) across: Quantity,
    /// Vertical quantity with its unit.
    pub(super) up: Quantity,
    /// Lines, the lowest first.
    pub(super) lines: Vec<(Role, Points)>,
    /// Mark the first point of the last line.
    pub(super) mark_start: bool,
    /// A stretch of the horizontal axis to shade.
    pub(super) shaded: Option<(f64, f64)>,
    /// As many pixels a unit in both directions.
    pub(super) equal_scales: bool,
    /// Points of their own.
    pub(super) dots: Points,
    /// A place to mark.
    pub(super) mark: Option<(f64, f64)>,
    /// Places with their names.
    pub(super) places: Vec<((f64, f64), String)>,
    /// What is across is given as its decimal logarithm.
    pub(super) decades: bool,
    /// A band around a line: its lower and its upper edge.
    pub(super) band: Option<(Points, Points)>,
    /// What is up is given as its decimal logarithm, within these.
    pub(super) decades_up: Option<(f64, f64)>,
    /// From where to where the horizontal axis goes, if not over what is drawn.
    pub(super) span: Option<(f64, f64)>,
    /// What its own lines are, beside the title.
    pub(super) keys: Vec<(&'static str, Role)>,
    /// Phases, faults and events behind the lines; they do not widen the axes.
    pub(super) backdrop: Backdrop,
}

/// Ranges of both axes in data units, and where they lie on the page.
pub(super) struct Scales {
    across: (f64, f64),
    up: (f64, f64),
    size: (f64, f64),
}

impl Scales {
    /// Data to pixels of the diagram.
    pub(super) fn place(&self, (x, y): (f64, f64)) -> (f64, f64) {
        let fraction = |v: f64, (low, high): (f64, f64)| (v - low) / (high - low);
        (self.size.0 * fraction(x, self.across), self.size.1 * (1.0 - fraction(y, self.up)))
    }
}

impl Panel {
    /// Lines over time. `up` is a [`Quantity`], or a label with its unit written out.
    pub(super) fn over_time(title: &str, up: impl Into<Quantity>, lines: Vec<(Role, Points)>) -> Self {
        Self {
            title: title.into(),
            across: Quantity::from("t, s").at_least(LEAST_S),
            up: up.into(),
            lines,
            mark_start: false,
            shaded: None,
            equal_scales: false,
            dots: Vec::new(),
            mark: None,
            places: Vec::new(),
            decades: false,
            band: None,
            decades_up: None,
            span: None,
            keys: Vec::new(),
            backdrop: Backdrop::default(),
        }
    }

    /// A path in a plane, its start marked.
    pub(super) fn path(title: &str, across: impl Into<Quantity>, up: impl Into<Quantity>, points: Points) -> Self {
        let lines = vec![(Role::Flown, points)];
        Self { across: across.into(), mark_start: true, ..Self::over_time(title, up, lines) }
    }

    /// Draws it into an area.
    pub(super) fn draw(&self, area: &Area) {
        let above = ABOVE + self.backdrop.height();
        let below = if self.across == Quantity::from("") { BELOW_TICKS } else { BELOW };
        let chart = area.inner(LEFT, above, area.width - LEFT - RIGHT, area.height - above - below);
        let scales = self.scales((chart.width, chart.height));
        area.text((LEFT, 0.5 * ABOVE), &self.title, Font::new(13.0, Anchor::Start).bold());
        self.draw_keys(area);
        self.draw_behind(&chart, &scales);
        self.draw_axes(&chart, &scales);
        for (role, points) in &self.lines {
            chart.line(points.iter().map(|p| scales.place(*p)), role.stroke());
        }
        self.draw_marks(&chart, &scales);
        if self.is_empty() {
            let middle = (0.5 * chart.width, 0.5 * chart.height);
            chart.text(middle, "nothing flown", Font { color: palette::GREY, ..Font::new(12.0, Anchor::Middle) });
        }
    }

    /// Whether a jump of the reference is drawn.
    pub(super) fn jumps(&self) -> bool {
        self.lines.iter().any(|(role, points)| *role == Role::Jump && !points.is_empty())
    }

    fn is_empty(&self) -> bool {
        self.dots.is_empty() && self.band.is_none() && self.lines.iter().all(|(_, points)| points.is_empty())
    }

    fn draw_keys(&self, area: &Area) {
        let (middle, mut x) = (0.5 * ABOVE, area.width - RIGHT);
        for (name, role) in self.keys.iter().rev() {
            x -= text_width(name, 12.0);
            area.text((x, middle), name, Font::new(12.0, Anchor::Start));
            area.line([(x - 26.0, middle), (x - 6.0, middle)], role.stroke());
            x -= 42.0;
        }
    }

    /// What is shown across and up, before scales are made equal.
    pub(super) fn ranges(&self) -> ((f64, f64), (f64, f64)) {
        let Scales { across, up, .. } =
            Self { equal_scales: false, mark_start: true, ..self.clone() }.scales((1.0, 1.0));
        (across, up)
    }

    /// The ranges in a diagram of so many pixels.
    fn scales(&self, size: (f64, f64)) -> Scales {
        let edges = || self.band.iter().flat_map(|(lower, upper)| lower.iter().chain(upper));
        let places = || self.places.iter().map(|(place, _)| place);
        let lines = || self.lines.iter().flat_map(|(_, points)| points);
        let points = || lines().chain(&self.dots).chain(&self.mark).chain(edges()).chain(places());
        let margin = if self.mark_start || self.equal_scales { MARGIN } else { 0.0 };
        let found = extent(points().map(|p| p.0));
        // Time runs from edge to edge, the tick that a flight ends before included.
        let across = self.span.unwrap_or_else(|| self.across.range(found, margin));
        let up = self.decades_up.unwrap_or_else(|| self.up.range(extent(points().map(|p| p.1)), MARGIN));
        let (across, up) = if self.equal_scales { equalised(across, up, size) } else { (across, up) };
        Scales { across, up, size }
    }

    fn draw_behind(&self, chart: &Area, scales: &Scales) {
        self.backdrop.draw(chart, scales.across);
        if let Some((from, to)) = self.shaded {
            let inside = |t: f64| scales.place((t.clamp(scales.across.0, scales.across.1), scales.up.0));
            let (left, right) = (inside(from), inside(to));
            chart.rectangle((left.0, 0.0), right, palette::DISTURBED);
        }
        if let Some((lower, upper)) = &self.band {
            let outline = lower.iter().chain(upper.iter().rev()).filter(|p| p.0.is_finite());
            chart.polygon(outline.map(|p| scales.place(*p)), palette::BAND);
        }
    }

    fn draw_axes(&self, chart: &Area, scales: &Scales) {
        let grid = Stroke { color: palette::GRID, width: 0.6, dashed: false };
        let ink = Stroke { color: INK, width: 1.0, dashed: false };
        let (across, right) = ticks(&self.across, scales.across, chart.width / TICK_ACROSS, self.decades);
        // At equal scales, with equal steps.
        let tick_up = if self.equal_scales { TICK_ACROSS } else { TICK_UP };
        let (up, rising) = ticks(&self.up, scales.up, chart.height / tick_up, self.decades_up.is_some());
        for (value, label) in right {
            let (x, bottom) = scales.place((value, scales.up.0));
            chart.line([(x, 0.0), (x, bottom)], grid);
            // At the right edge, within the page.
            let x = x.min(chart.width + RIGHT - 0.5 * text_width(&label, 12.0) - 1.0);
            chart.text((x, bottom + 12.0), &label, Font::new(12.0, Anchor::Middle));
        }
        for (value, label) in rising {
            let (_, y) = scales.place((scales.across.0, value));
            chart.line([(0.0, y), (chart.width, y)], grid);
            chart.text((-5.0, y), &label, Font::new(12.0, Anchor::End));
        }
        chart.line([(0.0, 0.0), (0.0, chart.height), (chart.width, chart.height)], ink);
        chart.text((0.5 * chart.width, chart.height + 31.0), &across, Font::new(12.0, Anchor::Middle));
        chart.text((-LEFT + 11.0, 0.5 * chart.height), &up, Font::new(12.0, Anchor::Middle).upright());
    }

    fn draw_marks(&self, chart: &Area, scales: &Scales) {
        let (radius, color) = if self.decades_up.is_some() { (0.8, palette::FLOWN) } else { (3.5, palette::START) };
        chart.dots(self.dots.iter().map(|p| scales.place(*p)), radius, color);
        for (x, y) in self.mark.iter().map(|p| scales.place(*p)) {
            let ink = Stroke { color: INK, width: 1.5, dashed: false };
            chart.line([(x - 5.0, y - 5.0), (x + 5.0, y + 5.0)], ink);
            chart.line([(x - 5.0, y + 5.0), (x + 5.0, y - 5.0)], ink);
        }
        if self.mark_start {
            let start = self.lines.last().and_then(|(_, points)| points.first());
            chart.dots(start.map(|p| scales.place(*p)), 4.0, palette::START);
        }
        place_names(chart, &self.places.iter().map(|(p, name)| (scales.place(*p), name.as_str())).collect::<Vec<_>>());
        self.backdrop.draw_events(chart, scales.across);
    }
}

/// Names beside their places, each where the ones before leave room; a ring at each place.
pub(super) fn place_names(chart: &Area, places: &[((f64, f64), &str)]) {
    let mut taken: Vec<(f64, f64)> = Vec::new();
    for ((x, y), name) in places {
        chart.dot((*x, *y), 4.0, INK);
        chart.dot((*x, *y), 2.6, super::style::Color(255, 255, 255));
        let free = |y: f64| taken.iter().all(|(a, b)| (a - x).abs() > 60.0 || (b - y).abs() > 14.0);
        let beside = [y - 10.0, y + 12.0, y - 24.0, y + 26.0].into_iter().find(|y| free(*y));
        if let Some(beside) = beside {
            // Names go to the left where they would leave the diagram.
            let wide = text_width(name, 12.0);
            let (dx, anchor) = if x + wide + 8.0 > chart.width { (-7.0, Anchor::End) } else { (7.0, Anchor::Start) };
            chart.text((x + dx, beside), name, Font::new(12.0, anchor));
            taken.push((*x, beside));
        }
    }
}

/// An axis' label, and its ticks with theirs.
fn ticks(quantity: &Quantity, range: (f64, f64), most: f64, logarithm: bool) -> (String, Vec<(f64, String)>) {
    let (name, factor) = quantity.label(range);
    if logarithm {
        return (name, axis::decades(range).into_iter().map(|v| (v, axis::decade(v))).collect());
    }
    let shown = (factor * range.0, factor * range.1);
    let step = |most: f64| quantity.step(shown.1 - shown.0, most);
    // One tick alone tells no scale.
    let tells = |step: &f64| axis::ticks(shown, *step).len() > 1;
    let finer = [1.0, 1.5, 2.0, 3.0].map(|times| step(times * most));
    let step = finer.into_iter().find(tells).unwrap_or(finer[0]);
    (name, axis::ticks(shown, step).into_iter().map(|v| (v / factor, axis::label(v, step))).collect())
}

/// Widens one of two ranges so that `size` pixels show both at the same scale.
pub(super) fn equalised(across: (f64, f64), up: (f64, f64), (width, height): (f64, f64)) -> ((f64, f64), (f64, f64)) {
    let per_pixel = ((across.1 - across.0) / width).max((up.1 - up.0) / height);
    let widen = |(low, high): (f64, f64), pixels: f64| {
        let (middle, half) = (f64::midpoint(low, high), 0.5 * per_pixel * pixels);
        (middle - half, middle + half)
    };
    (widen(across, width), widen(up, height))
}

/// Names, units and panels of the three directions and the three angles.
pub(super) const POSITIONS: [&str; 3] = ["x", "y", "z"];
pub(super) const DIRECTIONS: [&str; 3] = ["north", "west", "up"];
pub(super) const ANGLES: [&str; 3] = ["roll", "pitch", "yaw"];
#[cfg(test)]
mod tests {
    use super::super::axis::Unit;
    use super::*;

    #[test]
    fn equal_scales_are_equal_and_show_everything() {
        let (across, up) = equalised((0.0, 8.0), (-5.0, 5.0), (400.0, 300.0));
        assert!(((across.1 - across.0) / 400.0 - (up.1 - up.0) / 300.0).abs() < 1e-15);
        assert!(across.0 <= 0.0 && across.1 >= 8.0 && up.0 <= -5.0 && up.1 >= 5.0);
    }

    #[test]
    fn an_axis_has_two_ticks_at_least() {
        for (range, most) in [((-4.0, 4.9), 2.0), ((-0.4, 0.9), 1.0), ((3.1, 3.9), 2.0)] {
            let (_, ticks) = ticks(&Quantity::new("speed", Unit::MetrePerSecond), range, most, false);
            assert!(ticks.len() > 1, "{range:?}: {ticks:?}");
        }
    }

    #[test]
    fn ticks_are_labelled_in_the_unit_that_is_shown() {
        let (name, ticks) = ticks(&Quantity::new("x error", Unit::Metre), (-0.002, 0.002), 5.0, false);
        assert_eq!(name, "x error, mm");
        let labels: Vec<_> = ticks.iter().map(|(_, label)| label.as_str()).collect();
        assert_eq!(labels, ["−2", "−1", "0", "1", "2"]);
        assert!((ticks[0].0 + 0.002).abs() < 1e-12);
    }
}

//! One figure's frame, its panels and the palette. Text sizes and label areas are set by eye: an SVG backend has no
//! font metrics.

use std::fs;
use std::path::Path;

use anyhow::{Context, Result};
use plotters::coord::Shift;
use plotters::coord::types::RangedCoordf64;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

use super::series::{Points, extent};

/// Where everything is drawn.
pub(super) type Area<'a> = DrawingArea<SVGBackend<'a>, Shift>;
/// A chart of real numbers.
pub(super) type Chart<'a, 'b> = ChartContext<'a, SVGBackend<'b>, Cartesian2d<RangedCoordf64, RangedCoordf64>>;

/// The backend rounds to whole units; the page is drawn this many times larger than it is shown, for smooth curves.
pub(super) const FINE: u32 = 3;

/// Colours that people with any colour vision tell apart (Okabe and Ito 2008).
pub(super) mod palette {
    use plotters::style::RGBColor;

    /// The reference: light and wide, below.
    pub(in super::super) const REFERENCE: RGBColor = RGBColor(230, 159, 0);
    /// What was flown: dark and thin, above.
    pub(in super::super) const FLOWN: RGBColor = RGBColor(0, 114, 178);
    /// A level to compare with.
    pub(in super::super) const LEVEL: RGBColor = RGBColor(140, 140, 140);
    /// Where a path starts.
    pub(in super::super) const START: RGBColor = RGBColor(213, 94, 0);
    /// While a disturbance acts.
    pub(in super::super) const DISTURBED: RGBColor = RGBColor(222, 226, 230);
    /// What is believed to hold 95 %.
    pub(in super::super) const BAND: RGBColor = RGBColor(205, 225, 240);
    /// Things of a kind that stand side by side.
    pub(in super::super) const SERIES: [RGBColor; 6] = [
        RGBColor(0, 114, 178),
        RGBColor(230, 159, 0),
        RGBColor(0, 158, 115),
        RGBColor(213, 94, 0),
        RGBColor(204, 121, 167),
        RGBColor(86, 180, 233),
    ];
    /// Text and axes.
    pub(in super::super) const INK: RGBColor = RGBColor(40, 40, 40);
    /// Grid.
    pub(in super::super) const GRID: RGBColor = RGBColor(205, 205, 205);
}

/// What a line shows, hence how it looks.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Role {
    Reference,
    Flown,
    Level,
    Limit,
}

impl Role {
    pub(super) fn style(self) -> ShapeStyle {
        let (color, width) = match self {
            Self::Reference => (palette::REFERENCE, 4 * FINE),
            Self::Flown => (palette::FLOWN, FINE + 1),
            Self::Level => (palette::LEVEL, FINE),
            Self::Limit => (palette::START, 2 * FINE),
        };
        color.stroke_width(width)
    }
}

/// An entry of a figure's legend.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Key<'a> {
    Reference,
    Flown,
    Start,
    Disturbed,
    Linear,
    Simulated,
    Small,
    Step,
    /// One of several, by name and colour.
    Series(&'a str, RGBColor),
}

impl<'a> Key<'a> {
    fn name(self) -> &'a str {
        match self {
            Self::Reference => "reference",
            Self::Flown => "flown",
            Self::Start => "start",
            Self::Disturbed => "disturbed",
            Self::Linear => "linear",
            Self::Simulated => "in the simulation",
            Self::Small => "a small step",
            Self::Step => "5°",
            Self::Series(name, _) => name,
        }
    }
}

/// One diagram of a figure.
pub(super) struct Panel {
    pub(super) title: String,
    /// Horizontal quantity with its unit.
    pub(super) across: String,
    /// Vertical quantity with its unit.
    pub(super) up: String,
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
    /// What is across is given as its decimal logarithm.
    pub(super) decades: bool,
    /// A band around a line: its lower and its upper edge.
    pub(super) band: Option<(Points, Points)>,
    /// What is up is given as its decimal logarithm, within these.
    pub(super) decades_up: Option<(f64, f64)>,
}

impl Panel {
    /// Lines over time.
    pub(super) fn over_time(title: &str, up: &str, lines: Vec<(Role, Points)>) -> Self {
        let (title, across, up) = (title.into(), "t, s".into(), up.into());
        let (mark_start, shaded, equal_scales, decades) = (false, None, false, false);
        let (dots, mark, band, decades_up) = (vec![], None, None, None);
        Self { title, across, up, lines, mark_start, shaded, equal_scales, dots, mark, decades, band, decades_up }
    }

    /// A path in a plane, its start marked.
    pub(super) fn path(title: &str, across: &str, up: &str, points: Points) -> Self {
        let lines = vec![(Role::Flown, points)];
        Self { across: across.into(), mark_start: true, ..Self::over_time(title, up, lines) }
    }

    pub(super) fn draw(&self, area: &Area) -> Result<()> {
        let (across, up) = self.ranges(area);
        let mut chart = ChartBuilder::on(area)
            .caption(&self.title, text(15))
            .margin(px(8))
            .margin_right(px(18))
            .x_label_area_size(px(LABELS_BELOW))
            .y_label_area_size(px(LABELS_LEFT))
            .build_cartesian_2d(across.0..across.1, up.0..up.1)?;
        self.draw_shade(&mut chart, across, up)?;
        self.draw_band(&mut chart)?;
        self.draw_mesh(&mut chart, across, up)?;
        for (role, points) in &self.lines {
            chart.draw_series(LineSeries::new(points.iter().copied(), role.style()))?;
        }
        self.draw_dots(&mut chart)?;
        self.draw_start(&mut chart)
    }

    fn draw_dots(&self, chart: &mut Chart) -> Result<()> {
        let (size, color) =
            if self.decades_up.is_some() { (px(1) + 1, palette::FLOWN) } else { (px(4), palette::START) };
        chart.draw_series(self.dots.iter().map(|place| Circle::new(*place, size, color.filled())))?;
        chart.draw_series(
            self.mark.iter().map(|place| Cross::new(*place, px(5), palette::INK.stroke_width(FINE + 1))),
        )?;
        Ok(())
    }

    fn ranges(&self, area: &Area) -> ((f64, f64), (f64, f64)) {
        let edges = || self.band.iter().flat_map(|(lower, upper)| lower.iter().chain(upper));
        let points =
            || self.lines.iter().flat_map(|(_, points)| points).chain(&self.dots).chain(&self.mark).chain(edges());
        let across = extent(points().map(|p| p.0));
        let up = self.decades_up.unwrap_or_else(|| padded(extent(points().map(|p| p.1)), 0.06));
        if self.equal_scales {
            let (width, height) = area.dim_in_pixel();
            let inner = (width.saturating_sub(px(LABELS_LEFT + 26)), height.saturating_sub(px(LABELS_BELOW + 40)));
            return equalised(padded(across, 0.06), up, inner);
        }
        // A path keeps clear of the frame. Time runs from edge to edge, but for the tick that a flight ends before.
        (padded(across, if self.mark_start { 0.06 } else { 1e-4 }), up)
    }

    fn draw_shade(&self, chart: &mut Chart, across: (f64, f64), up: (f64, f64)) -> Result<()> {
        if let Some((from, to)) = self.shaded {
            let corners = [(from.clamp(across.0, across.1), up.0), (to.clamp(across.0, across.1), up.1)];
            chart.draw_series([Rectangle::new(corners, palette::DISTURBED.filled())])?;
        }
        Ok(())
    }

    fn draw_band(&self, chart: &mut Chart) -> Result<()> {
        if let Some((lower, upper)) = &self.band {
            let outline: Points = lower.iter().chain(upper.iter().rev()).copied().collect();
            chart.draw_series([Polygon::new(outline, palette::BAND.filled())])?;
        }
        Ok(())
    }

    fn draw_mesh(&self, chart: &mut Chart, across: (f64, f64), up: (f64, f64)) -> Result<()> {
        chart
            .configure_mesh()
            .light_line_style(TRANSPARENT)
            .bold_line_style(palette::GRID.stroke_width(FINE / 2))
            .axis_style(palette::INK.stroke_width(FINE))
            .x_labels(7)
            .y_labels(6)
            .x_label_formatter(&|v| if self.decades { decade(*v) } else { tick(*v, across.1 - across.0) })
            .y_label_formatter(&|v| if self.decades_up.is_some() { decade(*v) } else { tick(*v, up.1 - up.0) })
            .label_style(text(12))
            .axis_desc_style(text(13))
            .x_desc(&self.across)
            .y_desc(&self.up)
            .draw()?;
        Ok(())
    }

    fn draw_start(&self, chart: &mut Chart) -> Result<()> {
        let start = self.lines.last().and_then(|(_, points)| points.first());
        if let Some(start) = start.filter(|_| self.mark_start) {
            chart.draw_series([Circle::new(*start, px(4), palette::START.filled())])?;
        }
        Ok(())
    }
}

/// Room for the tick labels and the axis' name, in shown pixels.
const LABELS_LEFT: u32 = 60;
const LABELS_BELOW: u32 = 36;
/// Height of a figure's heading, in shown pixels.
const HEADING: u32 = 44;

/// Draws a figure of `size` shown pixels and writes it to `path`.
pub(super) fn save(
    path: &Path,
    size: (u32, u32),
    heading: &str,
    legend: &[Key],
    draw: impl FnOnce(&Area) -> Result<()>,
) -> Result<()> {
    let mut svg = String::new();
    {
        let page = SVGBackend::with_string(&mut svg, (px(size.0), px(size.1))).into_drawing_area();
        page.fill(&WHITE)?;
        let (top, rest) = page.split_vertically(px(HEADING));
        draw_heading(&top, heading, legend)?;
        draw(&rest)?;
        page.present()?;
    }
    // The view box keeps the fine units. Joins are round because wide lines over thinned points would show spikes.
    let (fine, shown) = (dimensions(px(size.0), px(size.1)), dimensions(size.0, size.1));
    fs::write(path, svg.replacen(&fine, &(shown + " stroke-linejoin=\"round\""), 1))
        .with_context(|| format!("cannot write {}: choose a folder you can write to with --out", path.display()))
}

/// How the page begins.
fn dimensions(width: u32, height: u32) -> String {
    format!("<svg width=\"{width}\" height=\"{height}\"")
}

/// Draws panels row by row into equal cells.
pub(super) fn grid(area: &Area, columns: usize, panels: &[Panel]) -> Result<()> {
    let cells = area.split_evenly((panels.len().div_ceil(columns), columns));
    panels.iter().zip(&cells).try_for_each(|(panel, cell)| panel.draw(cell))
}

fn draw_heading(area: &Area, heading: &str, legend: &[Key]) -> Result<()> {
    let (width, middle) = (area.dim_in_pixel().0.cast_signed(), at(HEADING / 2));
    let left = Pos::new(HPos::Left, VPos::Center);
    area.draw(&Text::new(heading, (at(14), middle), text(18).pos(left)))?;
    let mut x = width - at(10);
    for key in legend.iter().rev() {
        // About 7.5 pixels a letter at this size, and the sample.
        x -= at(44 + 15 * key.name().len() as u32 / 2);
        draw_sample(area, *key, x, middle)?;
        area.draw(&Text::new(key.name(), (x + at(32), middle), text(13).pos(left)))?;
    }
    Ok(())
}

fn draw_sample(area: &Area, key: Key, x: i32, middle: i32) -> Result<()> {
    let (end, half) = (x + at(26), at(6));
    let line = |role: Role| PathElement::new(vec![(x, middle), (end, middle)], role.style());
    match key {
        Key::Reference | Key::Small => area.draw(&line(Role::Reference))?,
        Key::Flown | Key::Linear | Key::Step => area.draw(&line(Role::Flown))?,
        Key::Start | Key::Simulated => area.draw(&Circle::new((x + at(20), middle), px(4), palette::START.filled()))?,
        Key::Disturbed => {
            area.draw(&Rectangle::new([(x, middle - half), (end, middle + half)], palette::DISTURBED.filled()))?;
        }
        Key::Series(_, color) => {
            area.draw(&Rectangle::new([(x, middle - half), (end, middle + half)], color.filled()))?;
        }
    }
    Ok(())
}

/// A coordinate in the page's units, from shown pixels.
fn at(shown: u32) -> i32 {
    px(shown).cast_signed()
}

/// Shown pixels in the page's units.
pub(super) fn px(shown: u32) -> u32 {
    shown * FINE
}

/// Sans-serif text of so many shown pixels.
pub(super) fn text(size: u32) -> TextStyle<'static> {
    ("sans-serif", px(size)).into_font().color(&palette::INK)
}

/// A range with a margin, as a fraction of its size; never empty.
pub(super) fn padded(range: Option<(f64, f64)>, margin: f64) -> (f64, f64) {
    let (low, high) = range.unwrap_or((0.0, 1.0));
    let size = high - low;
    // A constant still gets an axis.
    if size <= 1e-9 * high.abs().max(low.abs()).max(1e-6) {
        let around = (0.1 * high.abs()).max(1e-3);
        return (low - around, high + around);
    }
    (low - margin * size, high + margin * size)
}

/// Widens one of two ranges so that `inner` pixels show both at the same scale.
pub(super) fn equalised(across: (f64, f64), up: (f64, f64), (width, height): (u32, u32)) -> ((f64, f64), (f64, f64)) {
    let per_pixel = ((across.1 - across.0) / f64::from(width)).max((up.1 - up.0) / f64::from(height));
    let widen = |(low, high): (f64, f64), pixels: u32| {
        let (middle, half) = (f64::midpoint(low, high), 0.5 * per_pixel * f64::from(pixels));
        (middle - half, middle + half)
    };
    (widen(across, width), widen(up, height))
}

/// The label of a tick at a logarithm: of whole decades alone.
pub(super) fn decade(logarithm: f64) -> String {
    let whole = logarithm.round();
    if (logarithm - whole).abs() > 1e-6 {
        return String::new();
    }
    format!("{:.1$}", libm::pow(10.0, whole), (-whole).max(0.0) as usize)
}

/// A tick's label with as many decimals as its axis of `size` needs for about six ticks.
pub(super) fn tick(value: f64, size: f64) -> String {
    let step = libm::log10(size / 6.0).floor();
    let value = if value.abs() < 1e-9 * size { 0.0 } else { value };
    if (-3.0..6.0).contains(&step) {
        return format!("{value:.0$}", (-step).max(0.0) as usize);
    }
    if value == 0.0 { "0".into() } else { format!("{value:.1e}") }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ticks_have_the_decimals_they_need() {
        assert_eq!(tick(0.5, 2.1), "0.5");
        assert_eq!(tick(15.0, 20.0), "15");
        assert_eq!(tick(-1e-17, 2.0), "0.0");
        assert_eq!(tick(0.002, 0.01), "0.002");
        assert_eq!(tick(2e-5, 1e-4), "2.0e-5");
        assert_eq!(tick(5e7, 2e8), "5.0e7");
        assert_eq!(tick(0.0, 2e8), "0");
    }

    #[test]
    fn ranges_are_never_empty() {
        assert_eq!(padded(Some((0.0, 10.0)), 0.1), (-1.0, 11.0));
        for range in [None, Some((0.0, 0.0)), Some((7.0, 7.0)), Some((-1e9, 1e9))] {
            let (low, high) = padded(range, 0.05);
            assert!(low < high && (high - low).is_finite(), "{range:?}");
        }
    }

    #[test]
    fn equal_scales_are_equal_and_show_everything() {
        let (across, up) = equalised((0.0, 8.0), (-5.0, 5.0), (400, 300));
        assert!(((across.1 - across.0) / 400.0 - (up.1 - up.0) / 300.0).abs() < 1e-15);
        assert!(across.0 <= 0.0 && across.1 >= 8.0 && up.0 <= -5.0 && up.1 >= 5.0);
    }
}

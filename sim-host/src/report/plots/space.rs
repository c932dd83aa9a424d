//! A path in space: parallel projection with equal scales on all three axes, so that a circle looks like one seen
//! from the side, over a floor that carries the ticks and the path's shadow.

use super::axis;
use super::panel::place_names;
use super::series::{Points, extent, gaps, thin_path};
use super::style::{Color, Role, palette};
use super::svg::{Anchor, Area, Font, Stroke};
use crate::record::Row;

/// Where the viewer looks: this far from north towards west, this far down, rad.
const HEADING: f64 = 35.0 * std::f64::consts::PI / 180.0;
const DOWN: f64 = 24.0 * std::f64::consts::PI / 180.0;

/// Fraction of a step that may be ignored in rounding to it.
const HAIR: f64 = 0.02;
/// Fraction of a step by which a reference may go below what was flown without another step: one that leads a landing
/// goes on a little below the ground, and the floor is to lie on the ground.
const BELOW: f64 = 0.2;
/// Steps along the longest side of the frame.
const STEPS: f64 = 5.0;
/// No side of the frame is shorter than this fraction of the longest: a hover is not a needle.
const SHORTEST: f64 = 0.3;
/// Pixels around the frame for ticks and names, to the sides and above and below.
const ASIDE: f64 = 62.0;
const AROUND: f64 = 46.0;
/// The shadow on the floor.
const SHADOW: Stroke = Stroke { color: Color(190, 190, 190), width: 1.0, dashed: false };

/// A path in space with its colour, m.
#[derive(Clone, Debug)]
pub(super) struct Leg {
    pub(super) points: Vec<[f64; 3]>,
    pub(super) role: Role,
}

/// World (m) to the picture: right, up (m).
fn project([x, y, z]: [f64; 3]) -> (f64, f64) {
    let (sin, cos) = libm::sincos(HEADING);
    let (sin_down, cos_down) = libm::sincos(DOWN);
    let away = x * cos + y * sin;
    (x * sin - y * cos, z * cos_down + away * sin_down)
}

/// The box around the paths, its edges on ticks.
#[derive(Clone, Debug)]
pub(super) struct Frame {
    low: [f64; 3],
    high: [f64; 3],
    step: f64,
    /// From where to where the paths go in the picture, right and up, m.
    paths: [Option<(f64, f64)>; 2],
}

impl Frame {
    /// Around what was flown and its reference.
    pub(super) fn around(rows: &[Row]) -> Self {
        let range = |axis: usize| extent(rows.iter().flat_map(|row| [row.position[axis], row.reference[axis]]));
        let ranges = [0, 1, 2].map(|axis| range(axis).unwrap_or((0.0, 1.0)));
        let longest = ranges.iter().map(|(low, high)| high - low).fold(1e-3, f64::max);
        let step = axis::step(longest, STEPS);
        let widen = |(low, high): (f64, f64)| {
            let half = 0.5 * (high - low).max(SHORTEST * longest);
            let middle = f64::midpoint(low, high);
            (middle - half, middle + half)
        };
        // Heights grow upwards from the ground.
        let up = |(low, high): (f64, f64)| (low, high.max(low + SHORTEST * longest));
        let floor = |(low, high): (f64, f64)| {
            let flown = extent(rows.iter().map(|row| row.position[2])).map_or(low, |(low, _)| low);
            (if flown - low < BELOW * step { flown } else { low }, high)
        };
        let ranges = [widen(ranges[0]), widen(ranges[1]), up(floor(ranges[2]))];
        let both = |row: &Row| {
            let [x, y, z, _] = row.reference;
            [project(row.position), project([x, y, z])]
        };
        let paths = || rows.iter().flat_map(both);
        // An edge may be passed by a hair without another step.
        Self {
            paths: [extent(paths().map(|p| p.0)), extent(paths().map(|p| p.1))],
            low: ranges.map(|(low, _)| (low / step + HAIR).floor() * step),
            high: ranges.map(|(_, high)| (high / step - HAIR).ceil() * step),
            step,
        }
    }

    /// Ticks of one axis, m.
    fn ticks(&self, axis: usize) -> impl Iterator<Item = f64> + '_ {
        let count = ((self.high[axis] - self.low[axis]) / self.step).round() as u32;
        (0..=count).map(move |i| self.low[axis] + f64::from(i) * self.step)
    }

    /// From where to where the picture goes, right and up, m: it holds the floor, the upright and the paths.
    fn picture(&self) -> ((f64, f64), (f64, f64)) {
        let drawn: Points = self.lines().into_iter().flatten().map(project).collect();
        let range = |of: fn(&(f64, f64)) -> f64, paths: Option<(f64, f64)>| {
            let ends = paths.into_iter().flat_map(|(low, high)| [low, high]);
            extent(drawn.iter().map(of).chain(ends)).unwrap_or((0.0, 1.0))
        };
        (range(|p| p.0, self.paths[0]), range(|p| p.1, self.paths[1]))
    }

    /// The height that a picture of a width needs, pixels.
    pub(super) fn height(&self, width: f64) -> f64 {
        let (across, up) = self.picture();
        (width - 2.0 * ASIDE) * (up.1 - up.0) / (across.1 - across.0) + 2.0 * AROUND
    }

    /// The floor's grid and the upright at its left corner.
    fn lines(&self) -> Vec<[[f64; 3]; 2]> {
        let [(x0, x1), (y0, y1), (z0, z1)] = [0, 1, 2].map(|i| (self.low[i], self.high[i]));
        let along_y = self.ticks(0).map(|x| [[x, y0, z0], [x, y1, z0]]);
        let along_x = self.ticks(1).map(|y| [[x0, y, z0], [x1, y, z0]]);
        along_y.chain(along_x).chain([[[x0, y1, z0], [x0, y1, z1]]]).collect()
    }
}

/// A frame in an area: where everything lies, in pixels.
struct View<'a> {
    frame: &'a Frame,
    across: (f64, f64),
    up: (f64, f64),
    /// Pixels per metre, and what is left at each side.
    scale: f64,
    left: f64,
    top: f64,
}

impl<'a> View<'a> {
    fn new(frame: &'a Frame, area: &Area) -> Self {
        let (across, up) = frame.picture();
        let (wide, high) = (across.1 - across.0, up.1 - up.0);
        let scale = ((area.width - 2.0 * ASIDE) / wide).min((area.height - 2.0 * AROUND) / high);
        let (left, top) = (0.5 * (area.width - scale * wide), 0.5 * (area.height - scale * high));
        Self { frame, across, up, scale, left, top }
    }

    fn place(&self, point: [f64; 3]) -> (f64, f64) {
        let (x, y) = project(point);
        (self.left + self.scale * (x - self.across.0), self.top + self.scale * (self.up.1 - y))
    }

    fn path(&self, points: &[[f64; 3]]) -> Points {
        thin_path(points.iter().map(|p| self.place(*p)).collect())
    }

    /// Ticks and names: x and y along the near edges of the floor, z up its left corner.
    fn draw_axes(&self, area: &Area) {
        let frame = self.frame;
        let ([x0, y0, z0], [_, y1, _]) = (frame.low, frame.high);
        let text = |point: [f64; 3], (dx, dy): (f64, f64), label: &str, anchor: Anchor| {
            let (x, y) = self.place(point);
            area.text((x + dx, y + dy), label, Font::new(12.0, anchor));
        };
        let label = |value: f64| axis::label(value, frame.step);
        // At two corners two labels would stand on each other.
        frame.ticks(0).skip(1).for_each(|x| text([x, y0, z0], (6.0, 9.0), &label(x), Anchor::Start));
        frame.ticks(1).for_each(|y| text([x0, y, z0], (-4.0, 11.0), &label(y), Anchor::End));
        frame.ticks(2).skip(1).for_each(|z| text([x0, y1, z], (-7.0, 0.0), &label(z), Anchor::End));
        let middle = |i: usize| f64::midpoint(frame.low[i], frame.high[i]);
        text([middle(0), y0, z0], (34.0, 28.0), "x (north), m", Anchor::Start);
        text([x0, middle(1), z0], (-30.0, 30.0), "y (west), m", Anchor::End);
        text([x0, y1, frame.high[2]], (0.0, -16.0), "z (up), m", Anchor::Middle);
    }
}

/// Draws paths in space, the lowest first, with the shadow of the last but the reference, its start and its places.
pub(super) fn draw(area: &Area, frame: &Frame, reference: &Leg, flown: &[Leg], places: &[([f64; 3], String)]) {
    let view = View::new(frame, area);
    let grid = Stroke { color: palette::GRID, width: 1.0, dashed: false };
    for line in frame.lines() {
        area.line(line.map(|point| view.place(point)), grid);
    }
    view.draw_axes(area);
    for leg in flown {
        let floor: Vec<_> = leg.points.iter().map(|[x, y, _]| [*x, *y, frame.low[2]]).collect();
        area.line(view.path(&floor), SHADOW);
    }
    let path = view.path(&reference.points);
    area.line(gaps(&path), Role::Jump.stroke());
    area.line(path, reference.role.stroke());
    for leg in flown {
        area.line(view.path(&leg.points), leg.role.stroke());
    }
    let start = flown.first().and_then(|leg| leg.points.first());
    area.dots(start.map(|p| view.place(*p)), 4.0, palette::START);
    let named: Vec<_> = places.iter().map(|(p, name)| (view.place(*p), name.as_str())).collect();
    place_names(area, &named);
}

#[cfg(test)]
mod tests {
    use super::super::tests::made_up;
    use super::*;

    #[test]
    fn projection_is_an_orthogonal_view() {
        // The columns of a projection onto a plane satisfy Σ rightᵢ² = Σ upᵢ² = 1 and Σ rightᵢ·upᵢ = 0.
        let axes = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]].map(project);
        let sum = |f: fn(&(f64, f64)) -> f64| axes.iter().map(f).sum::<f64>();
        assert!((sum(|a| a.0 * a.0) - 1.0).abs() < 1e-15);
        assert!((sum(|a| a.1 * a.1) - 1.0).abs() < 1e-15);
        assert!(sum(|a| a.0 * a.1).abs() < 1e-15);
    }

    #[test]
    fn frame_holds_the_paths_on_round_numbers() {
        let frame = Frame::around(&made_up(20.0));
        assert_eq!((frame.low, frame.high), ([-5.0, -5.0, 0.0], [5.0, 5.0, 25.0]));
        assert_eq!(frame.ticks(2).count(), 6);
    }

    #[test]
    fn the_floor_lies_on_the_ground_where_a_landing_s_reference_goes_on_below_it() {
        let row = |flown: f64, reference: f64| Row {
            position: [0.0, 0.0, flown],
            reference: [0.0, 0.0, reference, 0.0],
            ..Row::default()
        };
        // Steps of 5 m: a foot sinks in by 3 mm, and the reference is 0.25 m below when the landing is noticed.
        let landing = Frame::around(&[row(0.0, 0.0), row(20.0, 20.0), row(-0.003, -0.25)]);
        assert_eq!((landing.low[2], landing.high[2]), (0.0, 20.0));
        // What leads far below is shown.
        let below = Frame::around(&[row(0.0, 0.0), row(20.0, 20.0), row(0.0, -3.0)]);
        assert_eq!(below.low[2], -5.0);
    }

    #[test]
    fn a_climb_is_not_a_needle() {
        let row = |t: f64| Row { t, position: [0.0, 0.0, t], reference: [0.0, 0.0, t, 0.0], ..Row::default() };
        let frame = Frame::around(&[row(0.0), row(10.0)]);
        assert!(frame.high[0] - frame.low[0] >= 3.0 && frame.low[2] >= 0.0, "{frame:?}");
    }
}

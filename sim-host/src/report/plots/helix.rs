//! A path in space: parallel projection with equal scales on all three axes, so that a circle looks like one seen
//! from the side, over a floor that carries the ticks.

use anyhow::Result;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

use super::panel::{Area, Role, equalised, padded, palette, px, text};
use super::series::{Points, extent, thin_path};
use crate::record::Row;

/// Where the viewer looks: this far from north towards west, this far down, rad.
const HEADING: f64 = 35.0 * std::f64::consts::PI / 180.0;
const DOWN: f64 = 24.0 * std::f64::consts::PI / 180.0;

/// Fraction of a step that may be ignored in rounding to it.
const HAIR: f64 = 0.02;

/// World (m) to the picture: right, up (m).
fn project([x, y, z]: [f64; 3]) -> (f64, f64) {
    let (sin, cos) = libm::sincos(HEADING);
    let (sin_down, cos_down) = libm::sincos(DOWN);
    let away = x * cos + y * sin;
    (x * sin - y * cos, z * cos_down + away * sin_down)
}

/// The box around the paths, its edges on ticks.
struct Frame {
    low: [f64; 3],
    high: [f64; 3],
    step: [f64; 3],
}

impl Frame {
    fn around(rows: &[Row]) -> Self {
        let range =
            |axis: usize| padded(extent(rows.iter().flat_map(|row| [row.position[axis], row.reference[axis]])), 0.0);
        let ranges = [range(0), range(1), range(2)];
        let step = ranges.map(|(low, high)| tick_step(high - low));
        // An edge may be passed by a hair without another step.
        let down = |v: f64, step: f64| (v / step + HAIR).floor() * step;
        let up = |v: f64, step: f64| (v / step - HAIR).ceil() * step;
        Self {
            low: std::array::from_fn(|i| down(ranges[i].0, step[i])),
            high: std::array::from_fn(|i| up(ranges[i].1, step[i])),
            step,
        }
    }

    /// Ticks of one axis, m.
    fn ticks(&self, axis: usize) -> impl Iterator<Item = f64> + '_ {
        let count = ((self.high[axis] - self.low[axis]) / self.step[axis]).round() as u32;
        (0..=count).map(move |i| self.low[axis] + f64::from(i) * self.step[axis])
    }

    fn corners(&self) -> impl Iterator<Item = [f64; 3]> + '_ {
        let pick = |corner: usize, axis: usize| if corner >> axis & 1 == 0 { self.low[axis] } else { self.high[axis] };
        (0..8).map(move |corner| [pick(corner, 0), pick(corner, 1), pick(corner, 2)])
    }

    /// The floor's grid and the upright at its left corner.
    fn lines(&self) -> Vec<[[f64; 3]; 2]> {
        let [(x0, x1), (y0, y1), (z0, z1)] = [0, 1, 2].map(|i| (self.low[i], self.high[i]));
        let along_y = self.ticks(0).map(|x| [[x, y0, z0], [x, y1, z0]]);
        let along_x = self.ticks(1).map(|y| [[x0, y, z0], [x1, y, z0]]);
        along_y.chain(along_x).chain([[[x0, y1, z0], [x0, y1, z1]]]).collect()
    }

    /// Ticks' places and labels: x and y along the near edges of the floor, z up its left corner.
    fn labels(&self) -> Vec<([f64; 3], String, Pos)> {
        let ([x0, y0, z0], y1) = (self.low, self.high[1]);
        let below = |h| Pos::new(h, VPos::Top);
        let x = self.ticks(0).map(|x| ([x, y0, z0], format!(" {x}"), below(HPos::Left)));
        let y = self.ticks(1).map(|y| ([x0, y, z0], format!("{y} "), below(HPos::Right)));
        let z = self.ticks(2).map(|z| ([x0, y1, z], format!("{z}  "), Pos::new(HPos::Right, VPos::Center)));
        // At two corners two labels would stand on each other.
        x.skip(1).chain(y).chain(z.skip(1)).collect()
    }

    /// The axes' names, beyond the middle of the edges that carry their ticks.
    fn names(&self) -> [([f64; 3], &'static str, Pos); 3] {
        let middle = |i: usize| f64::midpoint(self.low[i], self.high[i]);
        let ([x0, y0, z0], [_, y1, z1]) = (self.low, self.high);
        let aside = |axis: usize| 0.22 * (self.high[axis] - self.low[axis]);
        [
            ([middle(0), y0 - aside(1), z0], "x (north), m", Pos::new(HPos::Left, VPos::Top)),
            ([x0 - aside(0), middle(1), z0], "y (west), m", Pos::new(HPos::Right, VPos::Top)),
            ([x0, y1, z1 + 0.06 * (z1 - z0)], "z (up), m", Pos::new(HPos::Center, VPos::Bottom)),
        ]
    }
}

/// 1, 2 or 5 times a power of ten, for about five ticks.
fn tick_step(size: f64) -> f64 {
    let power = libm::pow(10.0, libm::log10(size / 5.0).floor());
    let factor = size / 5.0 / power - HAIR;
    power
        * if factor <= 1.0 {
            1.0
        } else if factor <= 2.0 {
            2.0
        } else if factor <= 5.0 {
            5.0
        } else {
            10.0
        }
}

/// Draws reference and flown path in space, the start marked.
pub(super) fn draw(area: &Area, rows: &[Row]) -> Result<()> {
    let frame = Frame::around(rows);
    let corners: Points = frame.corners().map(project).collect();
    let across = padded(extent(corners.iter().map(|p| p.0)), 0.14);
    let up = padded(extent(corners.iter().map(|p| p.1)), 0.09);
    let (across, up) = equalised(across, up, area.dim_in_pixel());
    let mut chart = ChartBuilder::on(area).build_cartesian_2d(across.0..across.1, up.0..up.1)?;
    let grid = palette::GRID.stroke_width(px(1));
    chart.draw_series(frame.lines().into_iter().map(|line| PathElement::new(line.map(project).to_vec(), grid)))?;
    let label = |(place, label, pos): ([f64; 3], String, Pos)| Text::new(label, project(place), text(12).pos(pos));
    chart.draw_series(frame.labels().into_iter().map(label))?;
    chart.draw_series(frame.names().map(|(place, name, pos)| label((place, name.into(), pos))))?;
    let reference = rows.iter().map(|row| project([row.reference[0], row.reference[1], row.reference[2]]));
    let flown = rows.iter().map(|row| project(row.position));
    chart.draw_series(LineSeries::new(thin_path(reference.collect()), Role::Reference.style()))?;
    chart.draw_series(LineSeries::new(thin_path(flown.collect()), Role::Flown.style()))?;
    let start = rows.first().map(|row| Circle::new(project(row.position), px(4), palette::START.filled()));
    chart.draw_series(start)?;
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::super::tests::flight;
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
        let frame = Frame::around(&flight(20.0));
        assert_eq!((frame.low, frame.high), ([-4.0, -6.0, 0.0], [4.0, 6.0, 25.0]));
        assert_eq!(frame.ticks(2).count(), 6);
    }

    #[test]
    fn steps_are_one_two_or_five() {
        assert_eq!([8.0, 10.0, 22.0, 0.5].map(tick_step), [2.0, 2.0, 5.0, 0.1]);
    }
}

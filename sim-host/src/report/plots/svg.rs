//! A page of SVG: lines, dots, areas and text at places in pixels, x to the right and y down.
//!
//! Places are written to a tenth of a pixel, one after the other relative to the one before, so that a line of a
//! thousand points takes some 6 kB.

use std::cell::RefCell;
use std::fmt::Write as _;

use super::style::Color;

/// What a page holds so far.
#[derive(Debug, Default)]
pub(super) struct Page {
    body: RefCell<String>,
}

/// A rectangle of a page that something is drawn into. Places are relative to its upper left corner.
#[derive(Clone, Copy, Debug)]
pub(super) struct Area<'p> {
    page: &'p Page,
    /// The upper left corner on the page.
    left: f64,
    top: f64,
    pub(super) width: f64,
    pub(super) height: f64,
}

/// How a line is drawn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Stroke {
    pub(super) color: Color,
    pub(super) width: f64,
    pub(super) dashed: bool,
}

/// Which point of a text stands at its place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Anchor {
    Start,
    Middle,
    End,
}

/// How a text is written. It is centred vertically at its place.
#[derive(Clone, Copy, Debug)]
pub(super) struct Font {
    pub(super) size: f64,
    pub(super) anchor: Anchor,
    pub(super) bold: bool,
    /// Turned by a quarter, to be read from the right.
    pub(super) upright: bool,
    pub(super) color: Color,
}

impl Font {
    /// Ink of so many pixels.
    pub(super) fn new(size: f64, anchor: Anchor) -> Self {
        Self { size, anchor, bold: false, upright: false, color: super::style::INK }
    }

    pub(super) fn bold(self) -> Self {
        Self { bold: true, ..self }
    }

    pub(super) fn upright(self) -> Self {
        Self { upright: true, ..self }
    }
}

/// About how wide a text is: sans-serif letters are about 0.57 of their size wide.
pub(super) fn text_width(text: &str, size: f64) -> f64 {
    0.57 * size * text.chars().count() as f64
}

impl Page {
    /// The whole page as an area of `size` pixels.
    pub(super) fn area(&self, size: (u32, u32)) -> Area<'_> {
        Area { page: self, left: 0.0, top: 0.0, width: f64::from(size.0), height: f64::from(size.1) }
    }

    /// The file's text, on white.
    pub(super) fn finish(self, (width, height): (u32, u32)) -> String {
        format!(
            "<svg width=\"{width}\" height=\"{height}\" viewBox=\"0 0 {width} {height}\" \
             xmlns=\"http://www.w3.org/2000/svg\" font-family=\"Helvetica, Arial, 'DejaVu Sans', sans-serif\" \
             stroke-linejoin=\"round\" stroke-linecap=\"round\">\n\
             <rect width=\"{width}\" height=\"{height}\" fill=\"#ffffff\"/>\n{}</svg>\n",
            self.body.into_inner()
        )
    }

    fn write(&self, element: &str) {
        let mut body = self.body.borrow_mut();
        body.push_str(element);
        body.push('\n');
    }
}

impl<'p> Area<'p> {
    /// A rectangle within this one.
    pub(super) fn inner(&self, left: f64, top: f64, width: f64, height: f64) -> Area<'p> {
        let (width, height) = (width.max(1.0), height.max(1.0));
        Area { page: self.page, left: self.left + left, top: self.top + top, width, height }
    }

    /// What lies above and below `height`.
    pub(super) fn split_below(&self, height: f64) -> (Area<'p>, Area<'p>) {
        (self.inner(0.0, 0.0, self.width, height), self.inner(0.0, height, self.width, self.height - height))
    }

    /// What lies left and right of `width`.
    pub(super) fn split_right(&self, width: f64) -> (Area<'p>, Area<'p>) {
        (self.inner(0.0, 0.0, width, self.height), self.inner(width, 0.0, self.width - width, self.height))
    }

    /// A line; it is interrupted at points that are not finite.
    pub(super) fn line(&self, points: impl IntoIterator<Item = (f64, f64)>, stroke: Stroke) {
        let path = self.path(points);
        if !path.is_empty() {
            let dash = if stroke.dashed { " stroke-dasharray=\"4 4\"" } else { "" };
            let Stroke { color, width, .. } = stroke;
            self.page.write(&format!(
                "<path d=\"{path}\" fill=\"none\" stroke=\"{color}\" stroke-width=\"{width}\"{dash}/>"
            ));
        }
    }

    /// A filled outline.
    pub(super) fn polygon(&self, points: impl IntoIterator<Item = (f64, f64)>, color: Color) {
        let path = self.path(points);
        if !path.is_empty() {
            self.page.write(&format!("<path d=\"{path}Z\" fill=\"{color}\"/>"));
        }
    }

    /// A filled rectangle between two corners.
    pub(super) fn rectangle(&self, (x0, y0): (f64, f64), (x1, y1): (f64, f64), color: Color) {
        let (left, top) = (self.left + x0.min(x1), self.top + y0.min(y1));
        let (width, height) = ((x1 - x0).abs(), (y1 - y0).abs());
        self.page.write(&format!(
            "<rect x=\"{left:.1}\" y=\"{top:.1}\" width=\"{width:.1}\" height=\"{height:.1}\" fill=\"{color}\"/>"
        ));
    }

    /// A dot of a radius.
    pub(super) fn dot(&self, place: (f64, f64), radius: f64, color: Color) {
        self.dots([place], radius, color);
    }

    /// Dots of one radius: a path of lines without length, with round ends.
    pub(super) fn dots(&self, places: impl IntoIterator<Item = (f64, f64)>, radius: f64, color: Color) {
        let mut path = String::new();
        for (x, y) in places.into_iter().filter(|(x, y)| x.is_finite() && y.is_finite()) {
            // Writing to a string cannot fail.
            let _ = write!(path, "M{:.1} {:.1}h0", self.left + x, self.top + y);
        }
        if !path.is_empty() {
            let width = 2.0 * radius;
            self.page.write(&format!("<path d=\"{path}\" stroke=\"{color}\" stroke-width=\"{width}\"/>"));
        }
    }

    /// A text at a place.
    pub(super) fn text(&self, at: (f64, f64), text: &str, font: Font) {
        self.text_and(at, text, font, ("", 0.0));
    }

    /// The same, going on in lighter letters of another size: wherever the first end, whatever letters a machine has.
    pub(super) fn text_and(&self, (x, y): (f64, f64), text: &str, font: Font, (more, more_size): (&str, f64)) {
        let (x, y) = (self.left + x, self.top + y);
        // Letters reach about 0.7 of their size above the line that they stand on.
        let down = 0.35 * font.size;
        let (at, turn) = if font.upright {
            ((x + down, y), format!(" transform=\"rotate(-90 {:.1} {y:.1})\"", x + down))
        } else {
            ((x, y + down), String::new())
        };
        let anchor = match font.anchor {
            Anchor::Start => "",
            Anchor::Middle => " text-anchor=\"middle\"",
            Anchor::End => " text-anchor=\"end\"",
        };
        let weight = if font.bold { " font-weight=\"bold\"" } else { "" };
        let escaped = |text: &str| text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;");
        let text = match more {
            "" => escaped(text),
            more => {
                let more = escaped(more);
                let light = format!("<tspan dx=\"12\" font-size=\"{more_size}\" font-weight=\"normal\">{more}</tspan>");
                escaped(text) + &light
            }
        };
        let Font { size, color, .. } = font;
        self.page.write(&format!(
            "<text x=\"{:.1}\" y=\"{:.1}\" font-size=\"{size}\" fill=\"{color}\"{anchor}{weight}{turn}>{text}</text>",
            at.0, at.1
        ));
    }

    /// A path's data, in tenths of a pixel from point to point so that rounding does not add up.
    fn path(&self, points: impl IntoIterator<Item = (f64, f64)>) -> String {
        let tenths = |v: f64| (10.0 * v).round() as i64;
        let mut path = String::new();
        let mut before: Option<(i64, i64)> = None;
        for (x, y) in points {
            if !(x.is_finite() && y.is_finite()) {
                before = None;
                continue;
            }
            let now = (tenths(self.left + x), tenths(self.top + y));
            match before {
                None => {
                    let _ = write!(path, "M{} {}l0 0", Tenths(now.0), Tenths(now.1));
                }
                Some(last) if last == now => {}
                Some(last) => {
                    let _ = write!(path, " {} {}", Tenths(now.0 - last.0), Tenths(now.1 - last.1));
                }
            }
            before = Some(now);
        }
        path
    }
}

/// A number of tenths, as short as it can be written.
struct Tenths(i64);

impl std::fmt::Display for Tenths {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let (sign, size) = (if self.0 < 0 { "-" } else { "" }, self.0.unsigned_abs());
        match (size / 10, size % 10) {
            (whole, 0) => write!(f, "{sign}{whole}"),
            (0, tenths) => write!(f, "{sign}.{tenths}"),
            (whole, tenths) => write!(f, "{sign}{whole}.{tenths}"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_path_is_relative_and_breaks_where_it_is_not_finite() {
        let page = Page::default();
        let area = page.area((100, 100)).inner(10.0, 20.0, 50.0, 50.0);
        let path = area.path([(0.0, 0.0), (1.5, -0.5), (1.5, -0.52), (f64::NAN, 1.0), (2.0, 2.0)]);
        assert_eq!(path, "M10 20l0 0 1.5 -.5M12 22l0 0");
    }

    #[test]
    fn text_is_escaped() {
        let page = Page::default();
        page.area((9, 9)).text((1.0, 2.0), "a < b & c", Font::new(10.0, Anchor::End));
        let text = page.finish((9, 9));
        assert!(text.contains("text-anchor=\"end\"") && text.contains("a &lt; b &amp; c"), "{text}");
    }
}

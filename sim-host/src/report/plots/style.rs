//! Colours and strokes, and what they stand for in every figure.

use std::fmt;

use super::svg::Stroke;

/// Red, green, blue.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Color(pub(super) u8, pub(super) u8, pub(super) u8);

impl Color {
    /// This colour on white, as strong as `strength` (0 to 1).
    pub(super) fn tint(self, strength: f64) -> Self {
        let mix = |c: u8| (255.0 - strength * (255.0 - f64::from(c))).round() as u8;
        Self(mix(self.0), mix(self.1), mix(self.2))
    }
}

impl fmt::Display for Color {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "#{:02x}{:02x}{:02x}", self.0, self.1, self.2)
    }
}

/// Colours that people with any colour vision tell apart (Okabe and Ito 2008).
pub(super) mod palette {
    use super::Color;

    pub(in super::super) const BLUE: Color = Color(0, 114, 178);
    pub(in super::super) const ORANGE: Color = Color(230, 159, 0);
    pub(in super::super) const GREEN: Color = Color(0, 158, 115);
    pub(in super::super) const VERMILION: Color = Color(213, 94, 0);
    pub(in super::super) const PURPLE: Color = Color(204, 121, 167);
    pub(in super::super) const SKY: Color = Color(86, 180, 233);
    pub(in super::super) const GREY: Color = Color(140, 140, 140);

    /// The reference: light and wide, below.
    pub(in super::super) const REFERENCE: Color = ORANGE;
    /// What was flown: dark and thin, above.
    pub(in super::super) const FLOWN: Color = BLUE;
    /// A level to compare with.
    pub(in super::super) const LEVEL: Color = GREY;
    /// Where a path starts; what is lost.
    pub(in super::super) const START: Color = VERMILION;
    /// While a disturbance acts.
    pub(in super::super) const DISTURBED: Color = Color(222, 226, 230);
    /// Two standard deviations.
    pub(in super::super) const BAND: Color = Color(200, 204, 210);
    /// Things of a kind that stand side by side.
    pub(in super::super) const SERIES: [Color; 6] = [BLUE, ORANGE, GREEN, VERMILION, PURPLE, SKY];
    /// Grid.
    pub(in super::super) const GRID: Color = Color(222, 222, 222);
}

/// Text and axes.
pub(super) const INK: Color = Color(40, 40, 40);

/// What a line shows, hence how it looks.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Role {
    Reference,
    Flown,
    Level,
    Limit,
    /// One of several, by its colour.
    Series(Color),
    /// A path's leg, by its colour.
    Leg(Color),
    /// The reference below legs in colours.
    Guide,
    /// From where to where a reference jumps.
    Jump,
    /// While something fails.
    Fault,
}

impl Role {
    pub(super) fn stroke(self) -> Stroke {
        let (color, width) = match self {
            Self::Reference => (palette::REFERENCE, 4.0),
            Self::Flown => (palette::FLOWN, 1.3),
            Self::Level => (palette::LEVEL, 1.0),
            Self::Limit => (palette::START, 2.0),
            Self::Series(color) => (color, 1.3),
            Self::Leg(color) => (color, 2.0),
            Self::Guide => (palette::GRID, 7.0),
            Self::Jump => (palette::GREY, 1.2),
            Self::Fault => (INK, 3.0),
        };
        Stroke { color, width, dashed: self == Self::Jump }
    }
}

/// An entry of a figure's legend.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Key<'a> {
    Reference,
    Flown,
    Start,
    Jump,
    Disturbed,
    Linear,
    Simulated,
    /// A line like that of a role, by name.
    Line(&'a str, Role),
    /// One of several, by name and colour.
    Series(&'a str, Color),
    /// Dots, by name and colour.
    Dots(&'a str, Color),
}

impl<'a> Key<'a> {
    pub(super) fn name(self) -> &'a str {
        match self {
            Self::Reference => "reference",
            Self::Flown => "flown",
            Self::Start => "start",
            Self::Jump => "the reference jumps",
            Self::Disturbed => "disturbance acts",
            Self::Linear => "linear",
            Self::Simulated => "in the simulation",
            Self::Line(name, _) | Self::Series(name, _) | Self::Dots(name, _) => name,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn colours_are_written_in_hexadecimal_and_fade_to_white() {
        assert_eq!(palette::ORANGE.to_string(), "#e69f00");
        assert_eq!(palette::ORANGE.tint(0.0), Color(255, 255, 255));
        assert_eq!(palette::ORANGE.tint(1.0), palette::ORANGE);
    }
}

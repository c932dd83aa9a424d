//! Where the vehicle is sent, and how fast.

use super::FARTHEST_M;
use super::request::SPEEDS_M_S;
use super::request::{TURN_MAX, within};
use crate::config::ModeSettings;
use crate::guidance::setpoint::Speeds;
use crate::math;

/// Where to go. What is not given stays as it is: the place where the vehicle stops, or that it goes to already; the
/// height; the heading.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Goal {
    /// x and y in the world, m.
    pub place_m: Option<[f32; 2]>,
    /// z in the world, m.
    pub height_m: Option<f32>,
    /// ψ, rad.
    pub yaw_rad: Option<f32>,
    /// Horizontal speed on this way, m/s.
    pub speed_m_s: Option<f32>,
}

impl Goal {
    /// All of it: a position, m, and a heading ψ, rad.
    pub const fn at([x, y, z]: [f32; 3], yaw_rad: f32) -> Self {
        Self { place_m: Some([x, y]), height_m: Some(z), yaw_rad: Some(yaw_rad), speed_m_s: None }
    }

    /// Whether it asks for a heading alone.
    pub(super) fn is_turn(&self) -> bool {
        self.yaw_rad.is_some() && self.place_m.is_none() && self.height_m.is_none()
    }

    /// x, y, z, ψ and the speed; NaN for what is left open.
    pub fn numbers(&self) -> [f32; 5] {
        let [x, y] = self.place_m.unwrap_or([f32::NAN; 2]);
        let [z, yaw, speed] = [self.height_m, self.yaw_rad, self.speed_m_s].map(|value| value.unwrap_or(f32::NAN));
        [x, y, z, yaw, speed]
    }

    /// From such numbers.
    pub fn of_numbers([x, y, z, yaw, speed]: [f32; 5]) -> Self {
        let given = |value: f32| Some(value).filter(|value| !value.is_nan());
        Self { place_m: given(x + y).map(|_| [x, y]), height_m: given(z), yaw_rad: given(yaw), speed_m_s: given(speed) }
    }

    /// True if every value is finite and within the accepted range.
    pub(super) fn is_sane(&self) -> bool {
        self.place_m.is_none_or(|place_m| within(&place_m, FARTHEST_M))
            && self.height_m.is_none_or(|height_m| within(&[height_m], FARTHEST_M))
            && self.yaw_rad.is_none_or(|yaw_rad| within(&[yaw_rad], TURN_MAX))
            && self.speed_m_s.is_none_or(|speed_m_s| SPEEDS_M_S.contains(&speed_m_s))
    }
}

/// A speed that a pilot can set.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SpeedKind {
    /// Over the ground.
    Horizontal,
    /// Upwards.
    Up,
    /// Downwards.
    Down,
}

/// The speeds that a pilot has set, m/s; `None` for the settings'. They count on the way to a goal, until disarming.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct ChosenSpeeds {
    horizontal: Option<f32>,
    up: Option<f32>,
    down: Option<f32>,
}

impl ChosenSpeeds {
    pub(super) fn choose(&mut self, kind: SpeedKind, speed_m_s: Option<f32>) {
        *match kind {
            SpeedKind::Horizontal => &mut self.horizontal,
            SpeedKind::Up => &mut self.up,
            SpeedKind::Down => &mut self.down,
        } = speed_m_s;
    }

    /// Within what the settings allow.
    pub(super) fn within(&self, settings: &ModeSettings) -> Speeds {
        let usual = Speeds::usual(settings);
        let chosen = |speed: Option<f32>, usual: f32, most: f32| speed.map_or(usual, |speed| math::min(speed, most));
        Speeds {
            horizontal_m_s: chosen(self.horizontal, usual.horizontal_m_s, settings.fastest_m_s),
            up_m_s: chosen(self.up, usual.up_m_s, settings.climb_m_s),
            down_m_s: chosen(self.down, usual.down_m_s, settings.sink_m_s),
        }
    }
}

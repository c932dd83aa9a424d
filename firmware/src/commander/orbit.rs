//! Flying circles.

use super::request::within;
use super::{Commander, FARTHEST_M, FASTEST_M_S, State};
use crate::math;
use nalgebra::Vector3;

/// Default radius, m.
const RADIUS_M: f32 = 10.0;
/// Accepted radii, m.
const RADII_M: core::ops::RangeInclusive<f32> = 1.0..=1000.0;
/// Part of the horizontal acceleration that a circle may need; the rest corrects.
const ACCELERATION_PART: f32 = 0.8;

/// A circle to fly, as it is asked for. What is not given is as on the circle that is flown, or chosen: the place and the
/// height where the vehicle is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OrbitGoal {
    /// x and y of the centre, m.
    pub center_m: Option<[f32; 2]>,
    /// z, m.
    pub height_m: Option<f32>,
    /// m.
    pub radius_m: Option<f32>,
    /// m/s; negative for clockwise, seen from above.
    pub speed_m_s: Option<f32>,
    /// Where the nose points.
    pub heading: OrbitHeading,
}

/// Where the nose of a vehicle that flies a circle points.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum OrbitHeading {
    /// To the centre.
    Center,
    /// As it is.
    Kept,
    /// Along the circle.
    Along,
}

/// A circle to fly.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Orbit {
    /// The centre in the world, m.
    pub center: Vector3<f32>,
    /// m.
    pub radius_m: f32,
    /// m/s; negative for clockwise, seen from above.
    pub speed_m_s: f32,
    /// Where the nose points.
    pub heading: OrbitHeading,
}

impl OrbitGoal {
    /// x, y, z, the radius and the speed; NaN for what is left open.
    pub fn numbers(&self) -> [f32; 5] {
        let [x, y] = self.center_m.unwrap_or([f32::NAN; 2]);
        let [z, r, v] = [self.height_m, self.radius_m, self.speed_m_s].map(|value| value.unwrap_or(f32::NAN));
        [x, y, z, r, v]
    }

    /// From such numbers.
    pub fn of_numbers([x, y, z, radius, speed]: [f32; 5], heading: OrbitHeading) -> Self {
        let given = |value: f32| Some(value).filter(|value| !value.is_nan());
        Self {
            center_m: given(x + y).map(|_| [x, y]),
            height_m: given(z),
            radius_m: given(radius),
            speed_m_s: given(speed),
            heading,
        }
    }

    /// True if every value is finite and within the accepted range.
    pub(super) fn is_sane(&self) -> bool {
        self.center_m.is_none_or(|center_m| within(&center_m, FARTHEST_M))
            && self.height_m.is_none_or(|height_m| within(&[height_m], FARTHEST_M))
            && self.radius_m.is_none_or(|radius_m| RADII_M.contains(&radius_m))
            && self.speed_m_s.is_none_or(|speed_m_s| within(&[speed_m_s], FASTEST_M_S) && speed_m_s != 0.0)
    }
}

impl Commander {
    /// The circle that a goal asks for, of a vehicle at a place: no faster than it can turn.
    pub(super) fn orbit(&self, goal: &OrbitGoal, here: &Vector3<f32>) -> Orbit {
        let before = if let State::Orbit(orbit) = self.state { Some(orbit) } else { None };
        let center = before.map_or(*here, |orbit| orbit.center);
        let [x, y] = goal.center_m.unwrap_or([center.x, center.y]);
        let radius_m = goal.radius_m.or(before.map(|orbit| orbit.radius_m)).unwrap_or(RADIUS_M);
        let settings = &self.settings;
        let turns = math::sqrt(ACCELERATION_PART * settings.acceleration_m_s2 * radius_m);
        let most = math::min(settings.fastest_m_s, turns);
        Orbit {
            center: Vector3::new(x, y, goal.height_m.unwrap_or(center.z)),
            radius_m,
            speed_m_s: math::limit(
                goal.speed_m_s.or(before.map(|orbit| orbit.speed_m_s)).unwrap_or(settings.cruise_m_s),
                most,
            ),
            heading: goal.heading,
        }
    }
}

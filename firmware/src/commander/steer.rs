//! What guidance is told in each state.

use nalgebra::Vector3;

use super::{Commander, CommanderInput, Course, Directive, Ground, Known, Orbit, State};
use crate::guidance::setpoint::{self, Speeds};
use crate::math;
use crate::signals::{NavState, Tick};

/// What stands does not move up or down as fast as this, m/s. Chosen: above the speed of a touchdown.
const FALLS_M_S: f32 = 0.6;
/// What stands turns no faster than this, rad/s, and leans no more than 25°, of which this is the cosine.
const TURNS_RAD_S: f32 = 2.0;
const LEANS: f32 = 0.906;
/// So much below where it has stood last, m, is no place where it has stood: more than the height's error.
const BELOW_M: f32 = 2.0;
/// Below this height, m, a descent slows down to the touchdown speed at the latest.
const FINAL_HEIGHT_M: f32 = 2.0;
/// Below this height, m, feet may stand: the height's error, and what a vehicle tilts.
const UNDERFOOT_M: f32 = 0.15;
/// A goal so much lower, m, leads down.
const LOWER_M: f32 = 0.1;
/// A goal below this height over the ground, m, leads to it.
const LEADS_DOWN_M: f32 = 0.3;
/// A goal at most this far above the ground is on it, m.
pub(super) const GROUND_M: f32 = 0.1;
/// Part of the vertical acceleration with which a descent slows down: the vehicle is late, and catches up with the rest.
const BRAKING_PART: f32 = 0.5;
/// At this height, m, it has slowed down to it. Chosen: more than the height's error and what the vehicle lags behind.
const SLOW_HEIGHT_M: f32 = 1.0;

impl Commander {
    pub(super) fn over_home(&self, height: f32) -> Vector3<f32> {
        Vector3::new(self.home.x, self.home.y, height)
    }

    /// The directive for guidance, from a motion.
    pub(super) fn directive(&self, nav: &NavState) -> Directive {
        let (settings, height) = (&self.settings, nav.position.z);
        let climb = |height_m: f32, speed_m_s: f32| Directive::Climb { height_m, speed_m_s, yaw: None };
        let go_to = |position, yaw| Directive::GoTo { position, yaw, speeds: Speeds::usual(settings) };
        match self.state {
            State::Disarmed => Directive::Stop,
            State::Idle { .. } => Directive::Idle,
            State::TakeOff { to_m, .. } => climb(to_m, settings.take_off_m_s),
            State::Hold => Directive::HOLD,
            State::Orbit(orbit) => self.circle(orbit, height),
            State::Offboard => Directive::Offboard { in_air: self.ground.is_clear() },
            State::Manual(mode) => Directive::Manual {
                mode,
                in_air: self.ground.is_clear(),
                sink_m_s: self.rate_of_descent(settings.sink_m_s, height),
            },
            State::GoTo(course) | State::Approach(course) => self.steer(&course, height),
            State::Velocity { mut velocity, yaw_rate } => {
                let sinks = math::max(-velocity.z, 0.0);
                velocity.z = math::max(velocity.z, -self.rate_of_descent(sinks, height));
                Directive::Velocity { velocity, yaw_rate }
            }
            State::Join => go_to(self.entry, Some(self.entry_yaw)),
            State::Follow { since } => Directive::Follow { since },
            State::Return { at_m, climbs: true } => climb(at_m, settings.climb_m_s),
            State::Return { at_m, climbs: false } => go_to(self.over_home(at_m), None),
            State::Land => self.descend(settings.landing_m_s, height, false),
            State::Descent => self.descend(settings.descent_m_s, height, false),
            State::MotorOut => self.descend(settings.descent_m_s, height, true),
        }
    }

    /// The directive to go on a course, at a height (z, m).
    fn steer(&self, course: &Course, height: f32) -> Directive {
        let (height_m, yaw) = (course.height_m, course.yaw);
        let mut speeds = self.speeds.within(&self.settings);
        if let Some(speed_m_s) = course.speed_m_s {
            speeds.horizontal_m_s = math::min(speed_m_s, self.settings.fastest_m_s);
        }
        if self.over_ground(height_m) < LEADS_DOWN_M {
            speeds.down_m_s = self.rate_of_descent(speeds.down_m_s, height);
        }
        let Some([x, y]) = course.place_m else {
            let speed_m_s = if height_m > height { speeds.up_m_s } else { speeds.down_m_s };
            return Directive::Climb { height_m, speed_m_s, yaw };
        };
        Directive::GoTo { position: Vector3::new(x, y, height_m), yaw, speeds }
    }

    /// A circle on the ground, or below it, is come down to straight: the ground would be touched at the circle's speed.
    /// Far below what is taken for the ground there is none, and the circle is flown once it is reached.
    fn circle(&self, orbit: Orbit, height: f32) -> Directive {
        let height_m = orbit.center.z;
        let is_reached = self.over_ground(height) < -BELOW_M && height < height_m + BELOW_M;
        if self.over_ground(height_m) < LEADS_DOWN_M && !is_reached {
            let speed_m_s = self.rate_of_descent(self.settings.sink_m_s, height);
            return Directive::Climb { height_m, speed_m_s, yaw: None };
        }
        Directive::Orbit(orbit)
    }

    /// Whether the vehicle is at the ground and sent to it, or below: it comes down then as in a landing. Sent no lower than
    /// where it stands it would bear a part of its weight and balance on its feet.
    pub(super) fn settles(&self, released: Tick, input: &CommanderInput) -> bool {
        let height_m = match self.state {
            State::Offboard => self.height_by_setpoint(released, input),
            State::GoTo(course) | State::Approach(course) => Some(course.height_m),
            State::Orbit(orbit) => Some(orbit.center.z),
            _ => None,
        };
        height_m.is_some_and(|height_m| self.over_ground(height_m) < GROUND_M)
            && self.ground_below(&input.nav) == Ground::Underfoot
    }

    pub(super) fn descend(&self, rate_m_s: f32, height: f32, heading_free: bool) -> Directive {
        let known = self.navigation.known();
        Directive::Descend { rate_m_s: self.rate_of_descent(rate_m_s, height), known, heading_free }
    }

    /// A height (z, m) over the ground, m. Home may have been set to below the ground, and the ground there may be higher
    /// than where the vehicle last stood.
    fn over_ground(&self, height: f32) -> f32 {
        height - math::max(self.home.z, self.ground_m())
    }

    /// Whether the ground may be touched at any time, at a height (z, m): near it, and at an unknown height.
    fn may_touch(&self, height: f32) -> bool {
        self.navigation.known() >= Known::Climb || self.over_ground(height) < FINAL_HEIGHT_M
    }

    /// Whether feet may be on the ground: where it may be touched, unless the vehicle is seen to rise or to fall. So one that
    /// falls with little thrust below the height of its home is not taken for one that stands.
    pub(super) fn may_stand(&self, nav: &NavState) -> bool {
        let falls = self.navigation.known() < Known::Attitude && math::abs(nav.velocity.z) > FALLS_M_S;
        // Where it has never stood nothing is known of the ground: what turns or leans there flies.
        let is_below = self.stood_m.is_none_or(|stood_m| nav.position.z < stood_m - BELOW_M);
        let turns = nav.rates.norm_squared() > TURNS_RAD_S * TURNS_RAD_S;
        let leans = (nav.attitude * Vector3::z()).z < LEANS;
        self.may_touch(nav.position.z) && !falls && !(is_below && (turns || leans))
    }

    /// How near the ground is. A take-off leaves it, and a landing comes down gently anyway.
    pub(super) fn ground_below(&self, nav: &NavState) -> Ground {
        let flies = match self.state {
            State::Disarmed
            | State::Idle { .. }
            | State::TakeOff { .. }
            | State::Land
            | State::Descent
            | State::MotorOut => false,
            State::Manual(_) | State::Offboard => true,
            // Some begin on the ground, and some in flight.
            _ => self.ground.is_airborne() && self.stood_m.is_some(),
        };
        if !flies || !self.may_stand(nav) {
            Ground::Far
        } else if self.stood_m.is_some_and(|stood_m| math::abs(nav.position.z - stood_m) < UNDERFOOT_M) {
            Ground::Underfoot
        } else {
            Ground::Near
        }
    }

    /// Whether the vehicle is told to go lower than a height (z, m).
    pub(super) fn leads_down(&self, height: f32) -> bool {
        match self.state {
            State::GoTo(course) | State::Approach(course) => course.height_m < height - LOWER_M,
            State::Orbit(orbit) => orbit.center.z < height - LOWER_M,
            State::Velocity { velocity, .. } => velocity.z < 0.0,
            _ => false,
        }
    }

    /// The rate of a descent at a height (z, m): no more than `rate_m_s`, and slow near the ground.
    fn rate_of_descent(&self, rate_m_s: f32, height: f32) -> f32 {
        let over_ground = self.over_ground(height);
        let touchdown_m_s = math::min(rate_m_s, self.settings.touchdown_m_s);
        let faster_m_s =
            if self.may_touch(height) { 0.0 } else { self.faster_by(over_ground - SLOW_HEIGHT_M, touchdown_m_s) };
        math::min(rate_m_s, touchdown_m_s + faster_m_s)
    }

    /// How much faster than to touch down a descent may be, m/s, to slow down within a height, m, by the setpoint's braking
    /// and with twice its delay, after which a fifteenth of a change is left: the root of
    /// h = t (f/a + 2d) + f (f/2a + 2d).
    fn faster_by(&self, height: f32, touchdown_m_s: f32) -> f32 {
        let (a, d) = (BRAKING_PART * self.settings.vertical_acceleration_m_s2, setpoint::delay_s(&self.settings));
        let half = touchdown_m_s + 2.0 * a * d;
        let rest = math::max(height - 2.0 * touchdown_m_s * d, 0.0);
        math::sqrt(half * half + 2.0 * a * rest) - half
    }
}

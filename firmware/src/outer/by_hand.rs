//! Flying by hand: from sticks to an attitude and a thrust.
//!
//! In position mode the sticks are a velocity for the setpoint generator. In altitude mode they are a tilt, and the
//! position law controls the vertical motion alone. In stabilized mode the thrust is the stick's too. In acro mode the
//! sticks are body rates: the reference attitude is their integral on the rotation group, so that a flip is nothing
//! special, and stays within reach of the vehicle's own.

use nalgebra::{UnitQuaternion, Vector1, Vector2, Vector3};

use super::{Outer, OuterInput, OuterOutput, Source, as_it_moves, forget_horizontal, velocity};
use crate::airframe::Airframe;
use crate::config::ManualSettings;
use crate::control::flatness::{self, ForceProfile, Heading};
use crate::control::law::PositionLaw;
use crate::guidance::hands::{self, ManualMode, Smooth};
use crate::latest::Sticks;
use crate::math;
use crate::schedule::{OUTER, OUTER_AHEAD_S};
use crate::signals::{AttitudeReference, AttitudeTarget, FlatReference, NavState, TICK_S, Tick};

/// Time between two jobs, s.
const STEP_S: f32 = OUTER.period as f32 * TICK_S;
/// Angular frequencies of the filters, rad/s. A step is followed to 90 % in 3.9 of their inverses: a tilt in 0.11 s, or later
/// where the torque does not suffice; a body rate in 0.1 s; the thrust in 0.1 s; the rate of the heading in 0.4 s, for
/// yaw has little torque.
const TILT: f32 = 30.0;
/// The same for the way to an attitude that is streamed.
const APPROACH: f32 = 25.0;
/// Part of the angular acceleration with full torque that a stick may ask for, in any direction: what saturates falls behind,
/// and comes late. About an axis between roll and pitch there is 0.7 of the torque.
const AGILITY: f32 = 0.6;
const RATE: f32 = 40.0;
const THRUST: f32 = 40.0;
const TURN: f32 = 10.0;
/// Of an attitude that is far away no more is turned towards at once, rad: its rate stays below 6 rad/s.
const TURN_MAX_RAD: f32 = 0.5;
/// In acro mode the reference is at most this far ahead of the vehicle's attitude: sines of half of 0.2 rad of tilt, and of
/// half of 0.03 rad about the thrust. Yaw has so little torque that the vehicle falls behind each time a stick moves; what it
/// is behind it would overtake the stick by.
const REACH: f32 = 0.099_833_42;
const REACH_YAW: f32 = 0.014_999_44;
/// And its yaw rate is at most so far ahead of the vehicle's, rad/s.
const REACH_YAW_RATE: f32 = 0.35;

/// What flying by hand keeps between jobs.
#[derive(Clone, Debug)]
pub(super) struct ByHand {
    pub(super) settings: ManualSettings,
    /// The mode of the last job, if that was flown by hand.
    mode: Option<ManualMode>,
    /// Greatest second derivative of the tilt's tangent that is asked for, 1/s², and angular acceleration, rad/s².
    agility: f32,
    /// Greatest angular acceleration of the heading that is asked for, rad/s².
    yaw_agility: f32,
    /// Tangent of the tilt, forward and to the left.
    tilt: [Smooth; 2],
    /// Thrust, N.
    thrust: Smooth,
    /// Body rates, rad/s, and the attitude that they lead to.
    rates: [Smooth; 3],
    attitude: UnitQuaternion<f32>,
    /// Heading, rad, and its rate, rad/s.
    yaw: f32,
    turn: Smooth,
}

impl ByHand {
    pub(super) fn new(settings: &ManualSettings, airframe: &Airframe) -> Self {
        Self {
            settings: *settings,
            agility: AGILITY * airframe.tilting_rad_s2(),
            yaw_agility: AGILITY * airframe.yawing_rad_s2(),
            mode: None,
            tilt: Default::default(),
            thrust: Smooth::default(),
            rates: Default::default(),
            attitude: UnitQuaternion::identity(),
            yaw: 0.0,
            turn: Smooth::default(),
        }
    }

    /// Begins to follow what a companion computer streams, or goes on.
    pub(super) fn lead(&mut self, nav: &NavState, thrust_n: f32) {
        if self.mode != Some(ManualMode::Acro) {
            self.begin(nav, thrust_n, nav.yaw());
            self.mode = Some(ManualMode::Acro);
        }
    }

    /// A step of the thrust towards this, N.
    pub(super) fn thrust(&mut self, wanted_n: f32) -> Smooth {
        self.thrust.step(wanted_n, THRUST);
        self.thrust
    }

    /// A step towards an attitude that turns with these rates, in its own frame: critically damped on the rotation group.
    pub(super) fn approach(
        &mut self,
        wanted: &UnitQuaternion<f32>,
        wanted_rates: &Vector3<f32>,
        nav: &NavState,
    ) -> AttitudeTarget {
        let away = self.attitude.inverse() * wanted;
        let sign = if away.w < 0.0 { -2.0 } else { 2.0 };
        let turn = away.imag() * sign;
        let size = math::sqrt(turn.norm_squared());
        let turn = turn * math::min(1.0, TURN_MAX_RAD / math::max(size, 1e-6));
        let wanted_rates = away * wanted_rates;
        for ((smooth, turn), rate) in self.rates.iter_mut().zip(&turn).zip(&wanted_rates) {
            smooth.rate = APPROACH * APPROACH * turn + 2.0 * APPROACH * (rate - smooth.value);
        }
        let before = self.attitude_target();
        let reference = AttitudeReference { valid_at: 0, target: before, thrust_n: 0.0, thrust_rate_n_s: 0.0 };
        let turned = reference.target_after(STEP_S).attitude;
        for smooth in &mut self.rates {
            smooth.value += smooth.rate * STEP_S;
        }
        self.attitude = within_reach(&UnitQuaternion::new_normalize(turned.into_inner()), nav);
        self.attitude_target()
    }

    /// Something else flies now.
    pub(super) fn end(&mut self) {
        self.mode = None;
    }

    /// Begins where the vehicle is: with its tilt and rates, and the heading `yaw`.
    fn begin(&mut self, nav: &NavState, thrust_n: f32, yaw: f32) {
        let axis = nav.attitude * Vector3::z();
        let (sin, cos) = math::sin_cos(yaw);
        // Beyond 60° of tilt the tangent says nothing.
        let per_z = 1.0 / math::max(axis.z, 0.5);
        self.tilt = [cos * axis.x + sin * axis.y, cos * axis.y - sin * axis.x].map(|part| Smooth::at(part * per_z));
        self.thrust = Smooth::at(thrust_n);
        self.rates = [nav.rates.x, nav.rates.y, nav.rates.z].map(Smooth::at);
        self.attitude = nav.attitude;
        self.yaw = yaw;
        self.turn = Smooth::at(0.0);
    }

    /// A step of the heading.
    fn turn(&mut self, rate: f32) -> Heading {
        let before = self.turn.value;
        hands::step_within(core::array::from_mut(&mut self.turn), &Vector1::new(rate), TURN, self.yaw_agility);
        self.yaw = math::wrap_angle(self.yaw + 0.5 * (before + self.turn.value) * STEP_S);
        Heading { angle: self.yaw, rate: self.turn.value, acceleration: self.turn.rate }
    }

    /// A step of the tilt, whose force is one along z, in the world.
    fn tilt(&mut self, wanted: Vector2<f32>, heading: &Heading) -> ForceProfile {
        hands::step_within(&mut self.tilt, &wanted, TILT, self.agility);
        let [forward, left] = &self.tilt;
        let (sin, cos) = math::sin_cos(heading.angle);
        let turned = |x: f32, y: f32| Vector3::new(cos * x - sin * y, sin * x + cos * y, 0.0);
        let u = turned(forward.value, left.value);
        let (u_rate, u_acceleration) =
            (turned(forward.rate, left.rate), turned(forward.acceleration, left.acceleration));
        let across = |v: &Vector3<f32>| Vector3::new(-v.y, v.x, 0.0);
        let (w, w_rate) = (heading.rate, heading.acceleration);
        ForceProfile {
            force: u + Vector3::z(),
            rate: u_rate + across(&u) * w,
            acceleration: u_acceleration + across(&u_rate) * (2.0 * w) + across(&u) * w_rate - u * (w * w),
        }
    }

    /// A step of the body rates.
    pub(super) fn rotate(&mut self, wanted: &Vector3<f32>, nav: &NavState) -> AttitudeTarget {
        let before = self.attitude_target();
        let reference = AttitudeReference { valid_at: 0, target: before, thrust_n: 0.0, thrust_rate_n_s: 0.0 };
        let turned = reference.target_after(STEP_S).attitude;
        let [roll, pitch, yaw] = &mut self.rates;
        let mut across = [*roll, *pitch];
        hands::step_slewing(&mut across, &wanted.xy(), RATE, self.agility);
        [*roll, *pitch] = across;
        hands::step_slewing(core::array::from_mut(yaw), &Vector1::new(wanted.z), RATE, self.yaw_agility);
        let behind = yaw.value - nav.rates.z;
        if math::abs(behind) > REACH_YAW_RATE {
            *yaw = Smooth::at(nav.rates.z + math::limit(behind, REACH_YAW_RATE));
        }
        self.attitude = within_reach(&UnitQuaternion::new_normalize(turned.into_inner()), nav);
        self.attitude_target()
    }

    fn attitude_target(&self) -> AttitudeTarget {
        let [p, q, r] = &self.rates;
        AttitudeTarget {
            attitude: self.attitude,
            rates: Vector3::new(p.value, q.value, r.value),
            accelerations: Vector3::new(p.rate, q.rate, r.rate),
        }
    }
}

/// An attitude moved towards the vehicle's where it is too far from it. A vehicle that cannot follow, or that hits
/// something, does not turn all the way once it can.
fn within_reach(wanted: &UnitQuaternion<f32>, nav: &NavState) -> UnitQuaternion<f32> {
    let ahead = nav.rates * OUTER_AHEAD_S;
    let now = AttitudeTarget { attitude: nav.attitude, rates: nav.rates, accelerations: Vector3::zeros() };
    let here = AttitudeReference { valid_at: 0, target: now, thrust_n: 0.0, thrust_rate_n_s: 0.0 };
    let here = if ahead.norm_squared() < 0.01 { here.target_after(OUTER_AHEAD_S).attitude } else { nav.attitude };
    let away = here.inverse() * wanted;
    let q = if away.w < 0.0 { -away.into_inner() } else { away.into_inner() };
    let tilt = math::sqrt(q.i * q.i + q.j * q.j);
    if tilt <= REACH && math::abs(q.k) <= REACH_YAW {
        return *wanted;
    }
    let part = math::min(1.0, REACH / math::max(tilt, 1e-6));
    let near = Vector3::new(q.i * part, q.j * part, math::limit(q.k, REACH_YAW));
    let near = nalgebra::Quaternion::from_parts(math::sqrt(1.0 - near.norm_squared()), near);
    UnitQuaternion::new_normalize(here.into_inner() * near)
}

impl<P: PositionLaw> Outer<P> {
    /// One job by the sticks. `in_air` is whether the vehicle is off the ground: on it, it is kept level.
    pub(super) fn fly_by_hand(
        &mut self,
        effective: Tick,
        input: &OuterInput,
        (mode, in_air, sink_m_s): (ManualMode, bool, f32),
    ) -> OuterOutput {
        let sticks = input.latest.sticks.map_or(Sticks::CENTRED, |sticks| sticks.value);
        let sticks = if in_air { sticks } else { Sticks { roll: 0.0, pitch: 0.0, yaw: 0.0, ..sticks } };
        if self.by_hand.mode != Some(mode) {
            self.begin_by_hand(input);
            self.by_hand.mode = Some(mode);
        }
        let mut climb = self.by_hand.settings.climb(&sticks, &self.modes);
        climb = math::max(climb, -sink_m_s);
        match mode {
            ManualMode::Position => self.move_by_hand(effective, input, &sticks, climb),
            ManualMode::Altitude => self.tilt_by_hand(effective, input, &sticks, climb),
            ManualMode::Stabilized | ManualMode::Acro => self.thrust_by_hand(effective, input, &sticks, mode),
        }
    }

    /// Goes on from what has flown before.
    fn begin_by_hand(&mut self, input: &OuterInput) {
        let reference = self.last_reference(input);
        self.go_on_from(&reference);
        if self.by_hand.mode.is_none() {
            self.by_hand.begin(&input.nav, input.thrust_n, reference.yaw);
        }
        if self.by_hand.mode == Some(ManualMode::Acro) {
            // The heading was nobody's concern.
            self.by_hand.begin(&input.nav, input.thrust_n, input.nav.yaw());
        }
    }

    /// Position mode.
    fn move_by_hand(&mut self, effective: Tick, input: &OuterInput, sticks: &Sticks, climb: f32) -> OuterOutput {
        let heading = self.by_hand.turn(self.by_hand.settings.yaw_rate(sticks));
        let ahead = self.by_hand.settings.velocity(sticks);
        let (sin, cos) = math::sin_cos(heading.angle);
        let wanted = Vector3::new(cos * ahead.x - sin * ahead.y, sin * ahead.x + cos * ahead.y, climb);
        let mut reference = self.advance(&velocity(wanted, 0.0));
        let now = self.predict(input);
        self.by_hand.tilt = [Smooth::at(0.0); 2];
        self.leash(&mut reference, &now, climb < 0.0);
        (reference.yaw, reference.yaw_rate, reference.yaw_acceleration) =
            (heading.angle, heading.rate, heading.acceleration);
        self.source = Source::ByHand(reference);
        self.track(effective, &now, &reference)
    }

    /// Altitude mode.
    fn tilt_by_hand(&mut self, effective: Tick, input: &OuterInput, sticks: &Sticks, climb: f32) -> OuterOutput {
        let mut now = self.predict(input);
        let heading = self.by_hand.turn(self.by_hand.settings.yaw_rate(sticks));
        let tilt = self.by_hand.tilt(self.by_hand.settings.tilt(sticks), &heading);
        self.setpoint.put_horizontally(now.position.x, now.position.y);
        let mut reference = self.advance(&velocity(Vector3::new(0.0, 0.0, climb), 0.0));
        self.leash(&mut reference, &now, climb < 0.0);
        self.source = Source::ByHand(with_height_of(as_it_moves(&now, &heading), &reference));
        now.forget_horizontal();
        forget_horizontal(&mut reference);
        (reference.yaw, reference.yaw_rate, reference.yaw_acceleration) =
            (heading.angle, heading.rate, heading.acceleration);
        let (s, vertical) = self.demand(&now, &reference);
        let (f, f_rate, f_acceleration) = (vertical.force.z, vertical.rate.z, vertical.acceleration.z);
        let mut profile = ForceProfile {
            force: tilt.force * f,
            rate: tilt.rate * f + tilt.force * f_rate,
            acceleration: tilt.acceleration * f + tilt.rate * (2.0 * f_rate) + tilt.force * f_acceleration,
        };
        self.limited = self.limits.apply(&mut profile);
        self.output(effective, &now, &profile, &reference, s).wanting_what_it_does(&input.nav)
    }

    /// Stabilized and acro mode.
    fn thrust_by_hand(
        &mut self,
        effective: Tick,
        input: &OuterInput,
        sticks: &Sticks,
        mode: ManualMode,
    ) -> OuterOutput {
        let now = self.predict(input);
        let gravity = self.model.gravity;
        let wanted_n =
            self.by_hand.settings.thrust_n(sticks, self.mass_kg * gravity, self.mass_kg * self.limits.force_max());
        let thrust = self.by_hand.thrust(wanted_n);
        let (target, heading) = if mode == ManualMode::Acro {
            let target = self.by_hand.rotate(&self.by_hand.settings.body_rates(sticks), &input.nav);
            (target, Heading { angle: input.nav.yaw(), rate: 0.0, acceleration: 0.0 })
        } else {
            let heading = self.by_hand.turn(self.by_hand.settings.yaw_rate(sticks));
            let tilt = self.by_hand.tilt(self.by_hand.settings.tilt(sticks), &heading);
            (flatness::attitude_target(&tilt, &heading), heading)
        };
        let reference = as_it_moves(&now, &heading);
        self.source = Source::ByHand(reference);
        // The law demands nothing here, but goes on learning: what it knew would be wrong when it is needed next.
        let (s, _) = self.demand(&now, &reference);
        let hover = ForceProfile::hover(gravity);
        let attitude =
            AttitudeReference { valid_at: effective, target, thrust_n: thrust.value, thrust_rate_n_s: thrust.rate };
        OuterOutput { attitude, ..self.output(effective, &now, &hover, &reference, s) }
    }
}

/// A reference with the vertical motion of another.
fn with_height_of(mut reference: FlatReference, other: &FlatReference) -> FlatReference {
    let FlatReference { position, velocity, acceleration, jerk, snap, .. } = &mut reference;
    (position.z, velocity.z, acceleration.z) = (other.position.z, other.velocity.z, other.acceleration.z);
    (jerk.z, snap.z) = (other.jerk.z, other.snap.z);
    reference
}

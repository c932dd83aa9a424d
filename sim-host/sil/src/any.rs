//! A flight on any plant under any control laws, as one type.
//!
//! A loop that is generic over its recorder would be compiled again for each of them, with all of the firmware and the
//! plant in it. This type has each pair of plant and laws once, and asks which one it is three times a tick.

use crate::baseline::geometric::{GeometricAttitude, GeometricPosition};
use crate::baseline::indi::{IndiAttitude, IndiPosition};
use crate::baseline::pid::{PidAttitude, PidPosition};
use crate::decoupled::Decoupled;
use crate::lockstep::{Flight, Lockstep};
use crate::outcome::Outcome;
use crate::plant::paper::PaperPlant;
use crate::plant::rigid_body::RigidBody;
use crate::record::Seen;

/// A plant with the firmware in its loop, under one of the control laws.
#[derive(Clone, Debug)]
pub enum UnderLaws<P> {
    /// The firmware's own.
    Smc(Box<Flight<P>>),
    /// The cascade of PX4.
    Pid(Box<Flight<P, PidAttitude, PidPosition>>),
    /// Geometric tracking on SE(3).
    Geometric(Box<Flight<P, GeometricAttitude, GeometricPosition>>),
    /// Incremental nonlinear dynamic inversion.
    Indi(Box<Flight<P, IndiAttitude, IndiPosition>>),
}

/// A flight of whatever a scenario may ask for.
#[derive(Clone, Debug)]
pub enum AnyFlight {
    /// On the nonlinear plant.
    RigidBody(UnderLaws<RigidBody>),
    /// On the paper's plant.
    Paper(UnderLaws<PaperPlant>),
    /// The paper's block diagram, without a firmware in lockstep.
    Decoupled(Box<Decoupled>),
}

/// Does `$work` with whichever `$flight` it is.
macro_rules! with {
    ($any:ident, $flight:ident => $work:expr) => {
        match $any {
            AnyFlight::RigidBody(laws) => with!(laws, $flight => $work, UnderLaws),
            AnyFlight::Paper(laws) => with!(laws, $flight => $work, UnderLaws),
            AnyFlight::Decoupled($flight) => $work,
        }
    };
    ($laws:ident, $flight:ident => $work:expr, UnderLaws) => {
        match $laws {
            UnderLaws::Smc($flight) => $work,
            UnderLaws::Pid($flight) => $work,
            UnderLaws::Geometric($flight) => $work,
            UnderLaws::Indi($flight) => $work,
        }
    };
}

impl Lockstep for AnyFlight {
    #[inline(never)]
    fn control(&mut self) {
        with!(self, flight => flight.control());
    }

    #[inline(never)]
    fn look(&mut self) -> Seen<'_> {
        with!(self, flight => flight.look())
    }

    #[inline(never)]
    fn act(&mut self) -> bool {
        with!(self, flight => flight.act())
    }

    fn interrupt(&mut self) {
        with!(self, flight => flight.interrupt());
    }

    fn outcome(&self) -> Outcome {
        with!(self, flight => flight.outcome())
    }
}

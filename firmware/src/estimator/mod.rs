//! The estimator: what moves how, from sensors that are noisy, biased, late and sometimes wrong.
//!
//! An error-state Kalman filter in two halves (Solà 2017, "Quaternion kinematics for the error-state Kalman filter", with
//! the error in the world):
//!
//! ```text
//! ImuSample ─► predictor ─► NavState                                              inner, every tick
//!                ▲ │ snapshot, sums since the last
//!     correction │ ▼
//!               filter ◄─ magnetometer, barometer, GNSS, motion capture           outer rate, 250 Hz
//! ```
//!
//! [`predictor`] owns the nominal state, and integrates it. [`filter`] owns the [`covariance`] and the [`history`] of
//! the last quarter of a second, in which a late reading is fused at its own time (`fusion`, by [`models`]); what it finds goes back
//! as a correction. [`align`] is how it begins, [`update`] the gate and the correction, [`watch`] what is made of a
//! sensor that goes wrong, [`settings`] what it is told of the sensors,
//! [`status`] what it says of itself. Local frame: the world's axes, through the place
//! where the vehicle was aligned.

pub mod align;
pub mod covariance;
pub mod filter;
mod fusion;
pub mod history;
pub mod models;
pub mod predictor;
pub mod settings;
pub mod status;
pub mod update;
pub mod watch;

pub use filter::{Filter, FilterInput, FilterOutput, Injection, Readings, Source};
pub use predictor::{Correction, Nominal, Predictor};
pub use settings::EstimatorSettings;

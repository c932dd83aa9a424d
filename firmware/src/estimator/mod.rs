//! The estimator: attitude, velocity and position from sensors that are noisy, biased, late and sometimes wrong.
//!
//! An error-state Kalman filter in two halves (Solà 2017, "Quaternion kinematics for the error-state Kalman filter",
//! with the attitude error in the world frame):
//!
//! ```text
//! ImuSample ─► predictor ─► NavState                                              inner, every tick
//!                ▲ │ snapshot, sums since the last
//!     correction │ ▼
//!               filter ◄─ magnetometer, barometer, GNSS, motion capture           outer rate, 250 Hz
//! ```
//!
//! | module | owns |
//! |---|---|
//! | [`predictor`] | the nominal state: strapdown integration of the IMU at 1 kHz |
//! | [`filter`] | the filter job: covariance, history, offsets, health |
//! | [`covariance`] | the 21 × 21 error covariance: prediction and correction |
//! | [`history`] | the last 252 ms of motion, so that a late reading is fused at its own time |
//! | `fusion`, [`models`] | one measurement model per sensor |
//! | [`update`] | innovation, gate and correction of one measurement |
//! | [`watch`] | detection of stuck, silent and jumping sensors |
//! | [`align`] | initial alignment |
//! | [`settings`] | noise parameters |
//! | [`status`] | the estimator's report to pilots |
//! | [`vibration`] | how strongly the accelerometer is shaken, for pilots |
//!
//! The filter's correction goes back to the predictor as an [`Injection`]. The local frame has the world's axes and its
//! origin at the place where the vehicle was aligned.

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
pub mod vibration;
pub mod watch;

pub use filter::{Filter, FilterInput, FilterOutput, FilterReport, Injection, Readings, Source};
pub use predictor::{Correction, Nominal, Predictor};
pub use settings::EstimatorSettings;
pub use vibration::Vibration;

//! What a flight leaves to people and scripts: its record, its figures of merit, its pictures.
//!
//! ```text
//!                 ┌─► TruthWriter ─► truth.csv, SHA-256 ─┐
//! loop ─► Row ─►  ├─► Metrics ───────────────────────────┼─► Summary ─► summary.json, --json, table
//!  (Recorder)     ├─► Progress ─► bar on stderr          │      ▲
//!                 └─► Vec<Row> ─► Figures ─► *.svg       └──────┤ Flight: what the loop knows besides
//!                                                               │ Sensed: of flights on sensors
//! loop ─► Navigation ─► SensedRecorder ─► estimate.csv ─────────┘
//!                            └─► Vec<Belief> ─► EstimateFigures ─► *.svg
//! ```
//!
//! Everything takes rows through [`Recorder`](crate::record::Recorder), in simulated time, and none of it can change a
//! flight. Recorders combine as tuples, so that a sweep over seeds keeps figures without keeping rows:
//!
//! ```
//! use sim_host::record::Recorder as _;
//! use sim_host::report::{Metrics, TruthWriter};
//!
//! let mut recorder = (Metrics::new(), TruthWriter::hash_only());
//! // sil::fly(&scenario, &mut recorder);
//! let (metrics, truth) = recorder;
//! let truth_sha256 = truth.finish()?;
//! # assert_eq!(truth_sha256.len(), 64);
//! # anyhow::Ok(())
//! ```

pub mod comparison;
pub mod estimate;
pub mod measures;
pub mod metrics;
pub mod mission;
pub mod out;
pub mod paint;
pub mod paper;
pub mod plots;
pub mod progress;
pub mod sensed;
pub mod staged;
pub mod summary;
pub mod table;
pub mod timeline;
pub mod truth;

pub use metrics::{Metrics, Settling};
pub use out::OutFolder;
pub use paint::Paint;
pub use plots::Figures;
pub use progress::Progress;
pub use sensed::{Sensed, SensedRecorder};
pub use staged::Staged;
pub use summary::{Flight, Summary};
pub use timeline::{Timeline, TimelineRecorder};
pub use truth::TruthWriter;

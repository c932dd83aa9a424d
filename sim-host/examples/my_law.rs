//! A position law of your own, flown on a built-in scenario without a change to this tree.
//!
//! ```text
//! cargo run --profile fast --example my_law
//! ```

use anyhow::Result;
use firmware::control::attitude::SlidingAttitude;
use firmware::control::flatness::ForceProfile;
use firmware::control::law::{PositionDemand, PositionInput, PositionLaw};
use nalgebra::{Vector3, Vector4};
use sim_host::flight;
use sim_host::record::Row;
use sim_host::scenario::Scenario;
use sim_host::sil::Lockstep as _;

/// A PD law with the reference's acceleration fed forward.
struct MyLaw {
    /// 1/s².
    stiffness: f32,
    /// 1/s.
    damping: f32,
    gravity_m_s2: f32,
}

impl PositionLaw for MyLaw {
    fn step(&mut self, input: &PositionInput) -> PositionDemand {
        let reference = input.reference;
        let feedback = (reference.position - input.position) * self.stiffness
            + (reference.velocity - input.velocity) * self.damping;
        let weight = Vector3::new(0.0, 0.0, self.gravity_m_s2);
        PositionDemand {
            s: Vector3::zeros(),
            profile: ForceProfile {
                force: reference.acceleration + weight + feedback,
                rate: reference.jerk,
                acceleration: reference.snap,
            },
        }
    }

    fn reset(&mut self) {}
}

fn main() -> Result<()> {
    let scenario = Scenario::load("x500-helix", &[])?;
    let config = scenario.flight_config();
    let mine = MyLaw { stiffness: 6.0, damping: 4.5, gravity_m_s2: config.airframe.gravity_m_s2 };
    let attitude = SlidingAttitude::new(&config.airframe, &config.attitude);
    let mut flight = flight::with_laws(&scenario, 1, flight::rigid_body(&scenario, 1), attitude, mine)?;
    let mut rows: Vec<Row> = Vec::new();
    flight.run(scenario.ticks(), &mut rows);

    let off = |row: &Row| (Vector3::from(row.position) - Vector4::from(row.reference).xyz()).norm();
    let worst = rows.iter().filter(|row| row.t > 6.0).map(off).fold(0.0, f64::max);
    println!("{}: at most {:.0} mm from the reference after 6 s", scenario.name, worst * 1e3);
    Ok(())
}

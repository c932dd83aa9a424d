//! What of a pilot's script is refused when it is read: what the vehicle would deny, and places below the ground.

use anyhow::Result;
use firmware::commander::{FARTHEST_M, FASTEST_M_S, TAKE_OFF_HEIGHTS_M};

use super::ScenarioFile;
use super::validate::{DURATION_MAX_S, each};
use crate::pilot::Order;
use crate::refusal::{Refusal, shortest, within};

/// Greatest yaw and yaw rate, ° and °/s: two turns, as the firmware has it.
const TURNS_DEG: f64 = 720.0;

/// Refuses the first command that cannot be carried out.
pub(super) fn commands(f: &ScenarioFile) -> Result<()> {
    let ground_m = f.ground.then(|| f.ground_height_m());
    let mut before = None;
    for (i, command) in f.command.iter().enumerate() {
        order(&format!("command.{i}.order"), &command.order, ground_m)?;
        for (key, seconds) in [("at_s", command.at_s), ("arrived_for_s", command.arrived_for_s)] {
            within(&format!("command.{i}.{key}"), seconds.unwrap_or(0.0), 0.0, DURATION_MAX_S)?;
        }
        if command.arrived_for_s.is_some() && !before.is_some_and(|order: Order| order.arrives()) {
            return Err(Refusal::new(format!("command.{i}.arrived_for_s"), "follows a command that arrives nowhere")
                .remedy("only take-off, go-to and hold do: give `at_s`, the time in the flight")
                .into());
        }
        before = Some(command.order);
    }
    Ok(())
}

fn order(key: &str, order: &Order, ground_m: Option<f64>) -> Result<()> {
    match *order {
        Order::TakeOff { height_m } => {
            let (low, high) = (shortest(*TAKE_OFF_HEIGHTS_M.start()), shortest(*TAKE_OFF_HEIGHTS_M.end()));
            within(&format!("{key}.take-off.height_m"), height_m, low, high)
        }
        Order::GoTo { position_m, yaw_deg } => {
            each(&format!("{key}.go-to.position_m"), &position_m, FARTHEST_M.into())?;
            within(&format!("{key}.go-to.yaw_deg"), yaw_deg, -TURNS_DEG, TURNS_DEG)?;
            above(&format!("{key}.go-to.position_m.2"), position_m[2], ground_m)
        }
        Order::Velocity { velocity_m_s, yaw_rate_deg_s } => {
            each(&format!("{key}.velocity.velocity_m_s"), &velocity_m_s, FASTEST_M_S.into())?;
            within(&format!("{key}.velocity.yaw_rate_deg_s"), yaw_rate_deg_s, -TURNS_DEG, TURNS_DEG)
        }
        Order::Arm | Order::Disarm | Order::Kill | Order::Hold | Order::Land | Order::Return | Order::Follow => Ok(()),
    }
}

/// Refuses a height (m) that is not above the ground, where there is ground: many have z point down.
fn above(key: &str, z: f32, ground_m: Option<f64>) -> Result<()> {
    let Some(ground_m) = ground_m.filter(|ground_m| f64::from(z) <= *ground_m) else { return Ok(()) };
    let rule = format!("must be above the ground, which is at {ground_m} m");
    let remedy = "z points up, and `land` comes down";
    Err(Refusal::new(key, rule).given(z).remedy(remedy).into())
}

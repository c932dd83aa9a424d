//! What a vehicle is asked, as words: a kind, and its numbers in SI units. A number is written in the shortest form that
//! reads back as the same bits.

use anyhow::{Result, bail, ensure};
use firmware::commander::{Asked, Goal, ManualMode, Mode, MotorTest, OrbitGoal, OrbitHeading, Request, SpeedKind};

/// The kinds, each with how many numbers it has.
const KINDS: [(&str, usize); 26] = [
    ("arm", 0),
    ("arm-force", 0),
    ("disarm", 0),
    ("takeoff", 1),
    ("hold", 0),
    ("goto", 5),
    ("velocity", 4),
    ("land", 0),
    ("return", 0),
    ("trajectory", 0),
    ("home", 3),
    ("home-here", 0),
    ("kill", 0),
    ("land-at", 5),
    ("speed", 1),
    ("speed-up", 1),
    ("speed-down", 1),
    ("acro", 0),
    ("offboard", 0),
    ("orbit", 5),
    ("orbit-kept", 5),
    ("orbit-along", 5),
    ("motor-test", 3),
    ("stabilized", 0),
    ("altitude", 0),
    ("position", 0),
];

/// As words.
pub(super) fn text(asked: &Asked) -> String {
    match *asked {
        Asked::Kill => "kill".to_owned(),
        Asked::Request(request) => match request {
            Request::Arm { force: false } => "arm".to_owned(),
            Request::Arm { force: true } => "arm-force".to_owned(),
            Request::Disarm => "disarm".to_owned(),
            Request::TakeOff { height_m } => format!("takeoff {height_m}"),
            Request::Hold => "hold".to_owned(),
            Request::Manual(mode) => Mode::from(mode).name().to_owned(),
            Request::Offboard => "offboard".to_owned(),
            Request::Orbit(goal) => {
                let name = match goal.heading {
                    OrbitHeading::Center => "orbit",
                    OrbitHeading::Kept => "orbit-kept",
                    OrbitHeading::Along => "orbit-along",
                };
                format!("{name} {}", goal.numbers().map(|number| number.to_string()).join(" "))
            }
            Request::TestMotor { test: MotorTest { rotor, part }, seconds } => {
                format!("motor-test {rotor} {part} {seconds}")
            }
            Request::GoTo(goal) => format!("goto {}", numbers(&goal)),
            Request::LandAt(goal) => format!("land-at {}", numbers(&goal)),
            Request::Speed { kind, speed_m_s } => {
                let name = match kind {
                    SpeedKind::Horizontal => "speed",
                    SpeedKind::Up => "speed-up",
                    SpeedKind::Down => "speed-down",
                };
                format!("{name} {}", speed_m_s.unwrap_or(f32::NAN))
            }
            Request::Velocity { velocity_m_s: [x, y, z], yaw_rate_rad_s } => {
                format!("velocity {x} {y} {z} {yaw_rate_rad_s}")
            }
            Request::Land => "land".to_owned(),
            Request::Return => "return".to_owned(),
            Request::Follow => "trajectory".to_owned(),
            Request::SetHome { position_m: Some([x, y, z]) } => format!("home {x} {y} {z}"),
            Request::SetHome { position_m: None } => "home-here".to_owned(),
        },
    }
}

/// The numbers of a goal; NaN for what it leaves open.
fn numbers(goal: &Goal) -> String {
    goal.numbers().map(|number| number.to_string()).join(" ")
}

/// From words.
///
/// # Errors
/// In one line, what is expected in place of them.
pub(super) fn read(words: &[&str]) -> Result<Asked> {
    let kind = words.first().copied().unwrap_or_default();
    let Some((_, count)) = KINDS.into_iter().find(|(name, _)| *name == kind) else {
        let names: Vec<&str> = KINDS.iter().map(|(name, _)| *name).collect();
        bail!("`ask` must be followed by one of {}, not by `{kind}`", names.join(", "))
    };
    let numbers: Vec<f32> = words.iter().skip(1).filter_map(|word| word.parse().ok()).collect();
    ensure!(numbers.len() == count && words.len() == count + 1, "`ask {kind}` must be followed by {count} numbers");
    let request = match (kind, numbers.as_slice()) {
        ("arm", _) => Request::Arm { force: false },
        ("arm-force", _) => Request::Arm { force: true },
        ("disarm", _) => Request::Disarm,
        ("takeoff", [height_m]) => Request::TakeOff { height_m: *height_m },
        ("hold", _) => Request::Hold,
        ("goto", [x, y, z, yaw, speed]) => Request::GoTo(Goal::of_numbers([*x, *y, *z, *yaw, *speed])),
        ("land-at", [x, y, z, yaw, speed]) => Request::LandAt(Goal::of_numbers([*x, *y, *z, *yaw, *speed])),
        ("speed", [speed]) => Request::Speed { kind: SpeedKind::Horizontal, speed_m_s: given(*speed) },
        ("speed-up", [speed]) => Request::Speed { kind: SpeedKind::Up, speed_m_s: given(*speed) },
        ("speed-down", [speed]) => Request::Speed { kind: SpeedKind::Down, speed_m_s: given(*speed) },
        ("velocity", [x, y, z, rate]) => Request::Velocity { velocity_m_s: [*x, *y, *z], yaw_rate_rad_s: *rate },
        ("offboard", _) => Request::Offboard,
        ("motor-test", [rotor, part, seconds]) => {
            Request::TestMotor { test: MotorTest { rotor: *rotor as u8, part: *part }, seconds: *seconds }
        }
        ("orbit", numbers) => orbit(numbers, OrbitHeading::Center),
        ("orbit-kept", numbers) => orbit(numbers, OrbitHeading::Kept),
        ("orbit-along", numbers) => orbit(numbers, OrbitHeading::Along),
        ("acro", _) => Request::Manual(ManualMode::Acro),
        ("stabilized", _) => Request::Manual(ManualMode::Stabilized),
        ("altitude", _) => Request::Manual(ManualMode::Altitude),
        ("position", _) => Request::Manual(ManualMode::Position),
        ("land", _) => Request::Land,
        ("return", _) => Request::Return,
        ("trajectory", _) => Request::Follow,
        ("home", [x, y, z]) => Request::SetHome { position_m: Some([*x, *y, *z]) },
        ("home-here", _) => Request::SetHome { position_m: None },
        _ => return Ok(Asked::Kill),
    };
    Ok(request.into())
}

fn given(number: f32) -> Option<f32> {
    Some(number).filter(|number| !number.is_nan())
}

/// An orbit of five numbers; there are as many.
fn orbit(numbers: &[f32], heading: OrbitHeading) -> Request {
    let mut five = [f32::NAN; 5];
    for (to, from) in five.iter_mut().zip(numbers) {
        *to = *from;
    }
    Request::Orbit(OrbitGoal::of_numbers(five, heading))
}

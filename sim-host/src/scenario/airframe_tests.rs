//! The airframes that come with the binary are bodies that fly, with their published figures.

use firmware::airframe::Airframe;

use super::{AIRFRAMES, Scenario};
use crate::airframe::AirframeFile;

fn airframe(name: &str) -> AirframeFile {
    Scenario::load("hover", &[format!("airframe={name}")]).expect("valid").airframe
}

#[test]
fn every_airframe_is_a_body_that_hovers_level_and_steers() {
    for (name, _) in AIRFRAMES {
        let airframe = airframe(name);
        let [ix, iy, iz] = airframe.inertia_kg_m2;
        // Any distribution of mass: no moment of inertia is more than the two others together.
        assert!(ix <= iy + iz && iy <= ix + iz && iz <= ix + iy, "{name}");
        let b = airframe.geometry();
        let lift = airframe.rotors[0].lift_n_s2;
        // Rotors at one speed turn it no way, in parts of what a single one does; and they can turn it every way.
        for row in 1..4 {
            assert!(b.row(row).sum().abs() < 1e-9 * lift, "{name}, row {row}");
        }
        assert!(b.is_invertible(), "{name}");
        for rotor in airframe.rotors {
            // Yaw torque over thrust is millimetres to centimetres for any propeller of these sizes.
            assert!((1e-3..5e-2).contains(&(rotor.yaw_n_m_s2.abs() / rotor.lift_n_s2)), "{name}");
        }
    }
}

#[test]
fn the_published_vehicles_have_their_published_figures() {
    // Diagonal between the motors: 492 mm (x500), 250 mm (racer250), 92 mm (crazyflie).
    for (name, diagonal_m, mass_kg) in [("x500", 0.492, 2.0), ("racer250", 0.250, 0.752), ("crazyflie", 0.092, 0.030)] {
        let airframe = airframe(name);
        for rotor in airframe.rotors {
            assert!((2.0 * rotor.x_m.hypot(rotor.y_m) / diagonal_m - 1.0).abs() < 2e-3, "{name}");
        }
        assert_eq!(airframe.mass_kg, mass_kg, "{name}");
    }
}

/// Table 2 stands in the firmware too, as the airframe of a board that has not been configured.
#[test]
fn the_papers_airframe_is_the_firmwares() {
    let file = Scenario::load("helix", &[]).expect("valid").airframe.flight();
    let firmware = Airframe::paper(2.0);
    let same = |a: f32, b: f32| assert!((a - b).abs() <= 1e-6 * b.abs(), "{a} {b}");
    same(file.mass_kg, firmware.mass_kg);
    same(file.rotor_inertia_kg_m2, firmware.rotor_inertia_kg_m2);
    same(file.omega_max_rad_s, firmware.omega_max_rad_s);
    let pairs = [
        (file.inertia_kg_m2, firmware.inertia_kg_m2),
        (file.drag_n_s_m, firmware.drag_n_s_m),
        (file.rotational_drag_n_m_s2, firmware.rotational_drag_n_m_s2),
    ];
    pairs.iter().flat_map(|(a, b)| a.iter().zip(b)).for_each(|(a, b)| same(*a, *b));
    let (rows, other) = (file.geometry.rows(), firmware.geometry.rows());
    rows.iter().flatten().zip(other.iter().flatten()).for_each(|(a, b)| same(*a, *b));
}

//! The figures of an analysis: Bode and Nyquist diagrams of each loop, steps of the attitude, gain of the noise.

use std::path::{Path, PathBuf};

use anyhow::Result;

use super::axis::{Quantity, Unit};
use super::page::{grid, save, size_of};
use super::panel::Panel;
use super::series::Points;
use super::style::{Key, Role};
use crate::analyse::{Analysis, Attitude, Loop, Sample};

/// Draws every figure into `folder`. Returns the files written.
///
/// # Errors
/// When a file cannot be written; the message names it. So for every figure.
pub fn draw(folder: &Path, analysis: &Analysis) -> Result<Vec<PathBuf>> {
    let mut files: Vec<PathBuf> =
        analysis.loops.iter().map(|one| of_loop(folder, &of(analysis), one)).collect::<Result<_>>()?;
    files.push(attitude(folder, analysis)?);
    Ok(files)
}

/// Which scenario and controller.
fn of(analysis: &Analysis) -> String {
    format!("{}, {}", analysis.scenario, analysis.controller)
}

/// |L|, its phase, its Nyquist diagram about −1, and |1/(1 + L)|, with what was measured in the simulation.
fn of_loop(folder: &Path, of: &str, one: &Loop) -> Result<PathBuf> {
    let simulated: Vec<Sample> = one.checks.iter().map(|check| check.simulated).collect();
    let decibels = |samples: &[Sample]| -> Points {
        samples.iter().map(|s| (libm::log10(s.omega_rad_s), decibels_of(s.value.norm_sqr()))).collect()
    };
    let sensitivity = |samples: &[Sample]| -> Points {
        samples.iter().map(|s| (libm::log10(s.omega_rad_s), -decibels_of((s.value + 1.0).norm_sqr()))).collect()
    };
    let panels = [
        bode("gain", "|L|, dB", decibels(&one.response), decibels(&simulated), vec![0.0]),
        bode(
            "phase",
            Quantity::new("phase of L", Unit::Degree),
            phases(&one.response),
            phases(&simulated),
            vec![-180.0],
        ),
        nyquist(&one.response, &simulated),
        bode("sensitivity", "|1/(1 + L)|, dB", sensitivity(&one.response), sensitivity(&simulated), vec![0.0]),
    ];
    let path = folder.join(format!("loop-{}.svg", one.name));
    let heading = format!("Loop {}, opened at its law's demand\n{of}", one.name);
    save(&path, size_of(2, 360), &heading, &[Key::Linear, Key::Simulated], |area| grid(area, 2, &panels))?;
    Ok(path)
}

fn decibels_of(square: f64) -> f64 {
    10.0 * libm::log10(square)
}

/// Over frequencies given as their logarithm, with levels to compare with.
fn bode(title: &str, up: impl Into<Quantity>, line: Points, dots: Points, levels: Vec<f64>) -> Panel {
    let across = extent(&line);
    let level = |v: f64| (Role::Level, vec![(across.0, v), (across.1, v)]);
    let lines = levels.into_iter().map(level).chain([(Role::Flown, line)]).collect();
    Panel { across: "ω, rad/s".into(), dots, decades: true, ..Panel::over_time(title, up, lines) }
}

fn extent(line: &Points) -> (f64, f64) {
    (line.first().map_or(0.0, |p| p.0), line.last().map_or(1.0, |p| p.0))
}

/// Phase in °, from −360 to 0 at first, and on without a jump.
fn phases(samples: &[Sample]) -> Points {
    let phase = |s: &Sample| libm::atan2(s.value.im, s.value.re).to_degrees();
    let turns = |degrees: f64| 360.0 * (degrees / 360.0).round();
    let mut before = -180.0;
    let next = |s: &Sample| {
        before = phase(s) - turns(phase(s) - before);
        (libm::log10(s.omega_rad_s), before)
    };
    samples.iter().map(next).collect()
}

/// About −1, where it matters.
fn nyquist(samples: &[Sample], simulated: &[Sample]) -> Panel {
    let near = |s: &&Sample| s.value.re.abs() <= 2.5 && s.value.im.abs() <= 2.0;
    let points = |samples: &[Sample]| samples.iter().filter(near).map(|s| (s.value.re, s.value.im)).collect::<Points>();
    let circle = (0..=180).map(|i| {
        let (sin, cos) = libm::sincos(f64::from(i) * core::f64::consts::PI / 90.0);
        (cos, sin)
    });
    let lines = vec![(Role::Level, circle.collect()), (Role::Flown, points(samples))];
    let path = Panel::path("Nyquist diagram, with |L| = 1 and −1", "real part of L", "imaginary part of L", vec![]);
    Panel { lines, dots: points(simulated), equal_scales: true, mark: Some((-1.0, 0.0)), mark_start: false, ..path }
}

/// A step of each angle beside the gain of the noise on its rate.
fn attitude(folder: &Path, analysis: &Analysis) -> Result<PathBuf> {
    let panels: Vec<Panel> = analysis.attitude.iter().flat_map(|axis| [step(axis), noise(axis)]).collect();
    let path = folder.join("attitude.svg");
    let heading = format!("Steps of the attitude, noise of the rates\n{}", of(analysis));
    save(
        &path,
        size_of(3, 260),
        &heading,
        &[Key::Line("a small step", Role::Reference), Key::Line("a step of 5°", Role::Flown)],
        |area| grid(area, 2, &panels),
    )?;
    Ok(path)
}

fn step(axis: &Attitude) -> Panel {
    let lines = vec![(Role::Reference, axis.small_step.clone()), (Role::Flown, axis.step.clone())];
    Panel::over_time(&format!("step of {}", axis.name), "fraction of the step", lines)
}

fn noise(axis: &Attitude) -> Panel {
    let line = axis.noise_gain.iter().map(|(omega, gain)| (libm::log10(*omega), *gain)).collect();
    let title = format!("rotor speed for noise on the rate of {}", axis.name);
    bode(&title, "rad/s for 1 rad/s", line, vec![], vec![])
}

//! Processor in the loop: the image under QEMU is the flight controller, with one frame each way per tick.
//!
//! ```text
//! plant ── SensorFrame ─► FIFO to-image   ─► IMU driver ─► inner task …   (qemu-system-arm, mps2-an386)
//! plant ◄─ PilOutput   ── FIFO from-image ◄─ rotor driver ◄┘
//! ```
//!
//! Before a sample may go what a pilot asks and what ground stations send; a reply has a checksum of all that was sent to
//! them.
//!
//! The image's clock is virtual: it stands still while the image waits for a sample, so nothing here depends on how
//! fast the desktop is. Every wait has a time-out; see `firmware::pil` for the frames.

mod fifo;
mod qemu;

use std::fmt;
use std::path::PathBuf;
use std::time::Duration;

use anyhow::{Context, Result, bail};
use firmware::autopilot::InnerTask;
use firmware::commander::Asked;
use firmware::config::FlightConfig;
use firmware::failure::Injectable;
use firmware::inner::InnerOutput;
use firmware::mavlink::port::LinkEvent;
use firmware::pil::{AllSent, Answer, Cause, Hello, REPLY_BYTES, Reply, Request, Sent, Signal, State};
pub use firmware::pil::{BusyWait, Fault};
use firmware::settings::Settings;
use firmware::signals::{ControlInput, MotorCommand, NavState, SensorFrame, TICK_S_EXACT, Tick};
use nalgebra::Vector3;

use qemu::Qemu;

/// Where `cargo fw-pil` puts the image, relative to the workspace's root.
pub const IMAGE: &str = "target/thumbv7em-none-eabihf/image/mps2-pil";

/// Options of a flight on the image.
#[derive(Clone, Debug)]
pub struct PilOptions<'a> {
    /// The image, an ELF file.
    pub image: PathBuf,
    /// The flight's configuration.
    pub config: &'a FlightConfig,
    /// Its settings.
    pub settings: Settings,
    /// Failures that ground stations may inject; the host does it.
    pub injectable: Injectable,
    /// Busy-waits added to its partitions' jobs.
    pub busy: BusyWait,
    /// A fault that the outer partition's job causes at a tick.
    pub fault: Option<(Tick, Fault)>,
    /// Time-out for an answer of the image.
    pub timeout: Duration,
}

impl<'a> PilOptions<'a> {
    /// With the configuration's own settings, without busy-waits, faults and failures, with a time-out of 10 s.
    pub fn new(image: impl Into<PathBuf>, config: &'a FlightConfig) -> Self {
        Self {
            image: image.into(),
            config,
            settings: Settings::of(config),
            injectable: Injectable::NONE,
            busy: BusyWait::default(),
            fault: None,
            timeout: Duration::from_secs(10),
        }
    }
}

/// Output of the image in a tick.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PilOutput {
    /// The motion that the controller used: the true one, or the estimate.
    pub nav: NavState,
    /// Commanded rotor speeds.
    pub motors: MotorCommand,
    /// U1..U4, the demand to the mixer.
    pub demand: ControlInput,
    /// Sliding variables s1, s2, s3, rad/s.
    pub s_attitude: Vector3<f32>,
    /// Sliding variables sx, sy, sz, m/s.
    pub s_position: Vector3<f32>,
    /// Whether the mixer could not give the whole demand.
    pub saturated: bool,
    /// Overruns so far of outer, commander and ground: zeros, because the first one ends the flight.
    pub overruns: [u32; 3],
    /// What has been sent on each link so far.
    pub sent: AllSent,
}

impl From<Reply> for PilOutput {
    fn from(reply: Reply) -> Self {
        let InnerOutput { motors, demand, s, saturated } = reply.inner;
        let Reply { nav, s_position, overruns, sent, .. } = reply;
        Self { nav, motors, demand, s_attitude: s, s_position, saturated, overruns, sent }
    }
}

/// A job that was not finished when its output was due.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Overrun {
    /// The tick at which it was detected.
    pub tick: Tick,
    /// Overruns so far of outer, commander and ground.
    pub counts: [u32; 3],
}

impl fmt::Display for Overrun {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let late: Vec<&str> = ["outer", "commander", "ground"]
            .into_iter()
            .zip(self.counts)
            .filter_map(|(name, count)| (count > 0).then_some(name))
            .collect();
        write!(f, "overrun: {} had not finished when due at {:.3} s", late.join(" and "), seconds(self.tick))
    }
}

impl std::error::Error for Overrun {}

/// The image has stopped its rotors permanently.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Stopped {
    /// The tick that was not finished.
    pub tick: Tick,
    /// Why.
    pub cause: Cause,
}

impl fmt::Display for Stopped {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let cause = match self.cause {
            Cause::Panic => "a panic",
            Cause::HardFault => "a hard fault",
        };
        write!(f, "the image has stopped its rotors at {:.3} s after {cause}", seconds(self.tick))
    }
}

impl std::error::Error for Stopped {}

fn seconds(tick: Tick) -> f64 {
    f64::from(tick) * TICK_S_EXACT
}

/// A running image. Dropped without [`finish`](Self::finish), it is killed.
#[derive(Debug)]
pub struct Pil {
    qemu: Qemu,
    tick: Tick,
}

impl Pil {
    /// Boots the image and sends it the configuration.
    ///
    /// # Errors
    /// In one line: no image, no QEMU, no answer in time, or a configuration that the image refuses.
    pub fn start(options: &PilOptions) -> Result<Self> {
        let PilOptions { config, ref settings, injectable, busy, fault, .. } = *options;
        let hello = Hello { config: config.clone(), settings: settings.clone(), injectable, busy, fault };
        let hello = hello.encode().map_err(|error| anyhow::anyhow!("{error}"))?;
        let mut qemu = Qemu::start(&options.image, options.timeout)?;
        qemu.send(&hello)?;
        match Answer::decode(&qemu.receive::<REPLY_BYTES>()?) {
            Some(Answer::Ready) => Ok(Self { qemu, tick: 0 }),
            Some(Answer::Refused(reason)) => bail!("the image refuses the flight: {reason}"),
            None => bail!("the image's answer cannot be read: rebuild it with `cargo fw-pil`"),
        }
    }

    /// One tick of the image with this sample.
    ///
    /// # Errors
    /// [`Overrun`] or [`Stopped`] (see `downcast_ref`), or in one line why there was no answer.
    pub fn tick(&mut self, sample: &SensorFrame) -> Result<PilOutput> {
        self.exchange(&Request::Sample(*sample))
    }

    /// Sends the image what a pilot asks for, before the next tick.
    ///
    /// # Errors
    /// In one line, why it could not be sent.
    pub fn ask(&mut self, asked: Asked) -> Result<()> {
        self.qemu.send(&Request::Ask(asked).encode())
    }

    /// Tells the image what happens on a link before the next tick.
    ///
    /// # Errors
    /// In one line, why it could not be sent.
    pub fn link(&mut self, link: usize, event: LinkEvent) -> Result<()> {
        let mut result = Ok(());
        Signal::each(event, |signal| {
            if result.is_ok() {
                result = self.qemu.send(&Request::Link { link: link as u32, signal }.encode());
            }
        });
        result
    }

    /// One tick of the image without a sample.
    ///
    /// # Errors
    /// As [`tick`](Self::tick).
    pub fn tick_without_sample(&mut self) -> Result<PilOutput> {
        self.exchange(&Request::Missing)
    }

    fn exchange(&mut self, request: &Request) -> Result<PilOutput> {
        let tick = self.tick;
        self.qemu.send(&request.encode())?;
        let bytes = self.qemu.receive().with_context(|| format!("at {:.3} s", seconds(tick)))?;
        let reply = Reply::decode(&bytes).context("the image's reply cannot be read")?;
        if let State::Stopped(cause) = reply.state {
            bail!(Stopped { tick, cause });
        }
        if reply.tick != tick {
            bail!("the image replies for tick {} and not for tick {tick}", reply.tick);
        }
        if reply.overruns != [0; 3] {
            bail!(Overrun { tick, counts: reply.overruns });
        }
        self.tick = tick.wrapping_add(1);
        Ok(reply.into())
    }

    /// Ends the image.
    ///
    /// # Errors
    /// It does not end in time, or with an error.
    pub fn finish(mut self) -> Result<()> {
        self.qemu.send(&Request::Exit.encode())?;
        self.qemu.wait()
    }
}

/// The first field in which image and desktop differ.
#[derive(Clone, Debug, PartialEq)]
pub struct Difference {
    /// The tick.
    pub tick: Tick,
    /// The field.
    pub field: &'static str,
    /// Its value on the desktop.
    pub sil: f32,
    /// Its value in the image.
    pub pil: f32,
}

impl fmt::Display for Difference {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { tick, field, sil, pil } = self;
        let (sil_bits, pil_bits) = (sil.to_bits(), pil.to_bits());
        write!(
            f,
            "`{field}` differs at {:.3} s: {sil} ({sil_bits:08x}) on the desktop, {pil} ({pil_bits:08x}) in the image",
            seconds(*tick)
        )
    }
}

impl std::error::Error for Difference {}

/// Compares a tick of the image with the same tick of the desktop, bit for bit.
///
/// # Errors
/// The first field that differs.
pub fn compare(desktop: &InnerTask, pil: &PilOutput) -> Result<(), Difference> {
    let reply = Reply::of(desktop, [0; 3], pil.sent);
    let (tick, sil) = (reply.tick, reply.into());
    for ((field, sil), (_, pil)) in fields(&sil).zip(fields(pil)) {
        if sil.to_bits() != pil.to_bits() {
            return Err(Difference { tick, field, sil, pil });
        }
    }
    Ok(())
}

/// What was sent on a link differs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SentDiffers {
    /// The tick.
    pub tick: Tick,
    /// The link.
    pub link: usize,
    /// All that the desktop has sent on it.
    pub desktop: Sent,
    /// All that the image has.
    pub image: Sent,
}

impl fmt::Display for SentDiffers {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { tick, link, desktop, image } = self;
        let text = |sent: &Sent| format!("{} bytes (checksum {:08x})", sent.bytes, sent.checksum);
        let (desktop, image) = (text(desktop), text(image));
        write!(
            f,
            "what is sent on link {link} differs at {:.3} s: {desktop} on the desktop, {image} in the image",
            seconds(*tick)
        )
    }
}

impl std::error::Error for SentDiffers {}

/// Compares what was sent on the links until a tick, every byte of it.
///
/// # Errors
/// The first link on which something else was sent.
pub fn compare_sent(tick: Tick, desktop: &AllSent, image: &AllSent) -> Result<(), SentDiffers> {
    for (link, (desktop, image)) in desktop.iter().zip(image).enumerate() {
        if desktop != image {
            return Err(SentDiffers { tick, link, desktop: *desktop, image: *image });
        }
    }
    Ok(())
}

/// The fields to compare, with their names, in the order in which they are computed.
fn fields(output: &PilOutput) -> impl Iterator<Item = (&'static str, f32)> {
    nav_fields(&output.nav).into_iter().chain(control_fields(output))
}

/// The fields of navigation.
fn nav_fields(nav: &NavState) -> [(&'static str, f32); 13] {
    let (position, velocity, rates, q) = (&nav.position, &nav.velocity, &nav.rates, nav.attitude.quaternion());
    [
        ("x", position.x),
        ("y", position.y),
        ("z", position.z),
        ("vx", velocity.x),
        ("vy", velocity.y),
        ("vz", velocity.z),
        ("qw", q.w),
        ("qx", q.i),
        ("qy", q.j),
        ("qz", q.k),
        ("p", rates.x),
        ("q", rates.y),
        ("r", rates.z),
    ]
}

/// The fields of control.
fn control_fields(output: &PilOutput) -> [(&'static str, f32); 15] {
    let [omega1, omega2, omega3, omega4] = output.motors.omega_rad_s;
    let [u1, u2, u3, u4] = output.demand.as_array();
    let (attitude, position) = (&output.s_attitude, &output.s_position);
    [
        ("s1", attitude.x),
        ("s2", attitude.y),
        ("s3", attitude.z),
        ("sx", position.x),
        ("sy", position.y),
        ("sz", position.z),
        ("U1", u1),
        ("U2", u2),
        ("U3", u3),
        ("U4", u4),
        ("omega1", omega1),
        ("omega2", omega2),
        ("omega3", omega3),
        ("omega4", omega4),
        ("saturated", f32::from(u8::from(output.saturated))),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;
    use firmware::autopilot::Autopilot;

    #[test]
    fn the_first_difference_is_named_with_time_and_both_values() {
        let mut autopilot = Autopilot::new(&FlightConfig::default()).expect("valid");
        for _ in 0..=1_234 {
            autopilot.tick(None);
        }
        let desktop = &autopilot.inner;
        let mut pil: PilOutput = Reply::of(desktop, [0; 3], AllSent::default()).into();
        assert_eq!(compare(desktop, &pil), Ok(()));
        pil.demand.roll_n_m = -0.0;
        pil.motors.omega_rad_s[3] = 1.0;
        let difference = compare(desktop, &pil).expect_err("U2 has another sign");
        let text = "`U2` differs at 1.234 s: 0 (00000000) on the desktop, -0 (80000000) in the image";
        assert_eq!(difference.to_string(), text);
        pil.nav.velocity.y = f32::NAN;
        let difference = compare(desktop, &pil).expect_err("the motion comes first");
        assert_eq!(difference.field, "vy");
    }

    #[test]
    fn a_link_on_which_another_byte_was_sent_is_named() {
        let desktop = AllSent::default();
        let mut image = desktop;
        assert_eq!(compare_sent(20, &desktop, &image), Ok(()));
        image[2] = Sent { bytes: 0, checksum: 1 };
        let text = "what is sent on link 2 differs at 0.020 s: 0 bytes (checksum 811c9dc5) on the desktop, 0 bytes \
                    (checksum 00000001) in the image";
        assert_eq!(compare_sent(20, &desktop, &image).expect_err("another").to_string(), text);
    }

    #[test]
    fn an_overrun_names_the_partitions() {
        let overrun = Overrun { tick: 1_002, counts: [1, 0, 2] };
        assert_eq!(overrun.to_string(), "overrun: outer and ground had not finished when due at 1.002 s");
    }

    #[test]
    fn a_missing_image_is_named_with_the_remedy() {
        let config = FlightConfig::default();
        let error = Pil::start(&PilOptions::new("no/such/image", &config)).expect_err("no image");
        assert_eq!(format!("{error:#}"), "there is no image no/such/image: build it with `cargo fw-pil`");
    }
}

//! Settings: everything about the vehicle that can be set, owned in one place.
//!
//! ```text
//! ground station ─► set ─► Settings ─ take_changes ─► GroundOutput.changes ─► inner: attitude law
//!                             │                                               filter: estimator
//!                             │ next_unsaved                                  outer: position law, limits
//!                             ▼                                               commander: thresholds
//!                           store
//! ```
//!
//! [`SETTINGS`] is the table of all of them: name, range, unit, default, when they take effect, and where they stand in
//! the configuration. [`Settings`] holds their values; the lowest partition owns it. A value that was set goes to its
//! owners as a [`Change`], by the same schedule as every other output (see `autopilot`), and each owner `apply`s it to
//! its own part. Ranges are stated in the table alone: the configuration is validated by it too.

mod axes;
mod marks;
mod radio;
mod rows;
pub mod store;
mod table;
#[cfg(test)]
mod tests;

pub use radio::{RADIO_CHANNELS, RadioChannel};
pub use rows::{COUNT, SETTINGS};
pub use table::{Class, Domain, Kind, NAME_MAX, Place, Setting, Slot, Value, find};
pub(crate) use table::{check_airframe, check_estimator, check_flight, check_manual, check_modes};

pub(crate) use self::marks::Marks;
use crate::airframe::Airframe;
use crate::config::FlightConfig;
use crate::control::mixer::Mixer;
use crate::math;
use crate::sensors::BatterySample;
use crate::validate::ConfigError;

/// Index of the airframe's number; 0 for a vehicle that was never configured.
pub const SYS_AUTOSTART: usize = rows::index_of("SYS_AUTOSTART");
/// Index of the MAVLink system.
pub const MAV_SYS_ID: usize = rows::index_of("MAV_SYS_ID");
/// Index of the `MAV_AUTOPILOT` that ground stations are told.
pub const GL_AUTOPILOT: usize = rows::index_of("GL_AUTOPILOT");
/// Index of the battery's number of cells.
pub const BAT1_N_CELLS: usize = rows::index_of("BAT1_N_CELLS");
/// Index of the voltage of an empty cell.
pub const BAT1_V_EMPTY: usize = rows::index_of("BAT1_V_EMPTY");
/// Index of the voltage of a full cell.
pub const BAT1_V_CHARGED: usize = rows::index_of("BAT1_V_CHARGED");
/// Index of the resistance of a cell.
pub const BAT1_R_INTERNAL: usize = rows::index_of("BAT1_R_INTERNAL");
/// Index of the height of a take-off for which none is given.
pub const MIS_TAKEOFF_ALT: usize = rows::index_of("MIS_TAKEOFF_ALT");
/// Index of what is done when the ground station is lost.
pub const NAV_DLL_ACT: usize = rows::index_of("NAV_DLL_ACT");
/// Index of the silence after which it is lost.
pub const COM_DL_LOSS_T: usize = rows::index_of("COM_DL_LOSS_T");
/// Index of the silence after which sticks are lost.
pub const COM_RC_LOSS_T: usize = rows::index_of("COM_RC_LOSS_T");
/// Index of whose sticks count.
pub const COM_RC_IN_MODE: usize = rows::index_of("COM_RC_IN_MODE");
/// Indices of the channels of a radio's sticks and switches.
pub const RC_MAP_ROLL: usize = rows::index_of("RC_MAP_ROLL");
/// Of pitch.
pub const RC_MAP_PITCH: usize = rows::index_of("RC_MAP_PITCH");
/// Of yaw.
pub const RC_MAP_YAW: usize = rows::index_of("RC_MAP_YAW");
/// Of the throttle.
pub const RC_MAP_THROTTLE: usize = rows::index_of("RC_MAP_THROTTLE");
/// Of the mode switch.
pub const RC_MAP_FLTMODE: usize = rows::index_of("RC_MAP_FLTMODE");
/// Of the arming switch.
pub const RC_MAP_ARM_SW: usize = rows::index_of("RC_MAP_ARM_SW");
/// Of the kill switch.
pub const RC_MAP_KILL_SW: usize = rows::index_of("RC_MAP_KILL_SW");
/// Index of the mode of the mode switch's first position; the others follow.
pub const COM_FLTMODE1: usize = rows::index_of("COM_FLTMODE1");
/// Index of the thrust with which a set-point of an attitude hovers.
pub(crate) const MPC_THR_HOVER: usize = rows::index_of("MPC_THR_HOVER");
const MPC_XY_CRUISE: usize = rows::index_of("MPC_XY_CRUISE");
/// Index of what is done when sticks are lost.
pub const NAV_RCL_ACT: usize = rows::index_of("NAV_RCL_ACT");
/// Index of whether the sticks arm.
pub const MAN_ARM_GESTURE: usize = rows::index_of("MAN_ARM_GESTURE");
/// Index of which modes moved sticks end.
pub const COM_RC_OVERRIDE: usize = rows::index_of("COM_RC_OVERRIDE");
/// Index of how far they have to be moved.
pub const COM_RC_STICK_OV: usize = rows::index_of("COM_RC_STICK_OV");
/// Index of the time on the ground after arming until it disarms.
pub const COM_DISARM_PRFLT: usize = rows::index_of("COM_DISARM_PRFLT");
/// Index of the time for which the rotors idle after a landing.
pub const COM_DISARM_LAND: usize = rows::index_of("COM_DISARM_LAND");
/// Index of the time for which the rotors spin up.
pub const COM_SPOOLUP_TIME: usize = rows::index_of("COM_SPOOLUP_TIME");
/// Index of the silence after which set-points are lost.
pub const COM_OF_LOSS_T: usize = rows::index_of("COM_OF_LOSS_T");
/// Index of what is done when they are.
pub const COM_OBL_RC_ACT: usize = rows::index_of("COM_OBL_RC_ACT");
/// Rows that stand in the settings alone, and concern the commander.
pub(crate) const OF_COMMANDER: [usize; 19] = [
    COM_OF_LOSS_T,
    COM_OBL_RC_ACT,
    SYS_AUTOSTART,
    NAV_DLL_ACT,
    COM_DL_LOSS_T,
    COM_RC_LOSS_T,
    COM_FLTMODE1,
    COM_FLTMODE1 + 1,
    COM_FLTMODE1 + 2,
    COM_FLTMODE1 + 3,
    COM_FLTMODE1 + 4,
    COM_FLTMODE1 + 5,
    NAV_RCL_ACT,
    MAN_ARM_GESTURE,
    COM_RC_OVERRIDE,
    COM_RC_STICK_OV,
    COM_DISARM_PRFLT,
    COM_DISARM_LAND,
    COM_SPOOLUP_TIME,
];
/// Index of the greatest tilt.
pub(crate) const TILT_MAX: usize = rows::index_of("MPC_TILTMAX_AIR");
/// Index of the first axis' first row.
const FIRST_AXIS: usize = rows::index_of("SMC_ROLL_LAMBDA");

/// PX4's number of a generic quadrotor: what a vehicle that is configured by a program has in [`SYS_AUTOSTART`].
const GENERIC_QUADROTOR: i32 = 4001;

/// A value that was set, on its way to its owners.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Change {
    /// In [`SETTINGS`].
    pub index: u16,
    /// The settings' generation in which it was set.
    pub generation: u16,
    /// The value, as it was set.
    pub value: Value,
}

impl Change {
    /// The row, and the value in the configuration's unit.
    pub(crate) fn place(&self) -> Option<(&'static Place, Value)> {
        let setting = SETTINGS.get(usize::from(self.index))?;
        Some((&setting.place, setting.configured(self.value)))
    }

    /// Applies it to a part of the configuration. Returns whether it is of that part.
    pub(crate) fn apply_to<T>(&self, part: &mut T, slot_of: fn(&Place) -> Option<&Slot<T>>) -> bool {
        let Some((place, value)) = self.place() else { return false };
        let Some(slot) = slot_of(place) else { return false };
        (slot.set)(part, value);
        true
    }
}

/// Changes that one job of the ground partition sends at most: a reaching law with its numbers, and one more.
pub const CHANGES_MAX: usize = 4;
/// Changes that a law needs: itself and its numbers.
const LAW_CHANGES: usize = 3;

/// Changes of one job.
pub type Changes = heapless::Vec<Change, CHANGES_MAX>;

/// Why a setting was not set.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum SettingError {
    /// There is no such setting.
    Unknown,
    /// NaN.
    NotANumber,
    /// Outside of the setting's range.
    OutOfRange,
    /// It cannot be set.
    ReadOnly,
    /// It cannot be set while the vehicle is armed.
    Armed,
    /// It is of the other type.
    OtherType,
    /// The value fits the setting, but not the others.
    Refused(ConfigError),
}

/// Whether an airframe's values fit together.
fn is_flyable(airframe: &Airframe) -> Result<(), ConfigError> {
    airframe.validate()?;
    Mixer::new(&airframe.geometry.rows(), airframe.omega_max_rad_s)
        .map(|_| ())
        .map_err(|_| ConfigError::SingularGeometry)
}

fn is_of_airframe(index: usize) -> bool {
    SETTINGS.get(index).is_some_and(|setting| setting.place.airframe().is_some())
}

/// The values of all settings.
#[derive(Clone, Debug, PartialEq)]
pub struct Settings {
    /// 32 bits each, in the order of [`SETTINGS`].
    bits: [u32; COUNT],
    /// Counts the values that were set, wrapping.
    generation: u16,
    /// Those that their owners have not been told yet.
    unsent: Marks,
    /// Whose turn it is among them: settings that are set again and again do not hold up the others.
    next: usize,
    /// Those that have not been saved yet.
    unsaved: Marks,
}

impl Default for Settings {
    /// The defaults, of a vehicle that was never configured.
    fn default() -> Self {
        let mut settings = Self::of(&FlightConfig::default());
        settings.put(SYS_AUTOSTART, Value::Int(0));
        settings
    }
}

/// On the wire: the values.
#[cfg(feature = "serde")]
impl serde::Serialize for Settings {
    fn serialize<S: serde::Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        to.collect_seq(self.bits)
    }
}

#[cfg(feature = "serde")]
impl<'de> serde::Deserialize<'de> for Settings {
    fn deserialize<D: serde::Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        use serde::de::Error as _;

        let values = heapless::Vec::<u32, COUNT>::deserialize(from)?;
        let bits = values.into_array().map_err(|_| D::Error::custom("a setting is missing"))?;
        Ok(Self { bits, ..Self::default() })
    }
}

impl Settings {
    /// Those of a configuration, and defaults for what it does not have. The vehicle is configured: by a program.
    pub fn of(config: &FlightConfig) -> Self {
        let mut settings =
            Self { bits: [0; COUNT], generation: 0, unsent: Marks::default(), next: 0, unsaved: Marks::default() };
        for (bits, setting) in settings.bits.iter_mut().zip(&SETTINGS) {
            let value = setting.read(config).or(setting.default);
            *bits = value.map_or(0, Value::bits);
        }
        settings.put(SYS_AUTOSTART, Value::Int(GENERIC_QUADROTOR));
        settings
    }

    /// Writes them into a configuration, which keeps what cannot be set: the trajectory and the start, and whether it
    /// has an estimator. A value that the configuration has already keeps its bits.
    pub fn write_to(&self, config: &mut FlightConfig) {
        for (index, setting) in SETTINGS.iter().enumerate() {
            let Some(value) = self.get(index) else { continue };
            if setting.read(config) != Some(value) {
                setting.place.set(config, setting.configured(value));
            }
        }
    }

    /// A value.
    pub fn get(&self, index: usize) -> Option<Value> {
        let setting = SETTINGS.get(index)?;
        self.bits.get(index).map(|bits| Value::from_bits(setting.kind(), *bits))
    }

    /// Sets a value of the vehicle, `armed` or not. Setting the present value changes nothing, and is never refused.
    ///
    /// # Errors
    /// Why the value was not set.
    pub fn set(&mut self, index: usize, value: Value, armed: bool) -> Result<Change, SettingError> {
        let setting = SETTINGS.get(index).ok_or(SettingError::Unknown)?;
        if value.kind() != setting.kind() {
            return Err(SettingError::OtherType);
        }
        if self.bits.get(index) != Some(&value.bits()) {
            match setting.class {
                Class::ReadOnly => return Err(SettingError::ReadOnly),
                Class::Disarmed if armed => return Err(SettingError::Armed),
                _ => {}
            }
            self.restore(index, value)?;
            self.generation = self.generation.wrapping_add(1);
            self.mark(index);
        }
        Ok(self.change(index, value))
    }

    /// Puts a stored value back before the flight: whatever its class, and nobody is told.
    ///
    /// # Errors
    /// Why the value was not set.
    pub fn restore(&mut self, index: usize, value: Value) -> Result<(), SettingError> {
        let setting = SETTINGS.get(index).ok_or(SettingError::Unknown)?;
        if value.kind() != setting.kind() {
            return Err(SettingError::OtherType);
        }
        if value.real().is_nan() {
            return Err(SettingError::NotANumber);
        }
        if !setting.accepts(value) {
            return Err(SettingError::OutOfRange);
        }
        self.check_with_others(setting, value)?;
        self.put(index, value);
        Ok(())
    }

    /// Puts stored values back all together, each as [`restore`](Self::restore) does: an airframe that is refused as a
    /// whole stays as it was. Returns how many were refused.
    pub fn restore_all(&mut self, values: impl Iterator<Item = (usize, Value)>) -> usize {
        let before = self.clone();
        let mut refused = 0;
        for (index, value) in values {
            let fits = SETTINGS.get(index).is_some_and(|setting| setting.accepts(value));
            if fits {
                self.put(index, value);
            } else {
                refused += 1;
            }
        }
        if is_flyable(&self.airframe()).is_err() {
            for index in (0..COUNT).filter(|index| is_of_airframe(*index)) {
                if let Some(value) = before.get(index).filter(|value| self.get(index) != Some(*value)) {
                    self.put(index, value);
                    refused += 1;
                }
            }
        }
        refused
    }

    /// Refuses an airframe whose rotors cannot be mixed.
    fn check_with_others(&self, setting: &Setting, value: Value) -> Result<(), SettingError> {
        let Place::Airframe(slot) = setting.place else { return Ok(()) };
        let mut airframe = self.airframe();
        (slot.set)(&mut airframe, value);
        is_flyable(&airframe).map_err(SettingError::Refused)
    }

    /// The airframe.
    fn airframe(&self) -> Airframe {
        // Every field is a setting: nothing is left of the paper's.
        let mut airframe = Airframe::paper(1.0);
        for (index, setting) in SETTINGS.iter().enumerate() {
            if let (Place::Airframe(slot), Some(value)) = (setting.place, self.get(index)) {
                (slot.set)(&mut airframe, value);
            }
        }
        airframe
    }

    fn put(&mut self, index: usize, value: Value) {
        if let Some(bits) = self.bits.get_mut(index) {
            *bits = value.bits();
        }
    }

    fn change(&self, index: usize, value: Value) -> Change {
        Change { index: index as u16, generation: self.generation, value }
    }

    /// A value that was set waits to be sent and to be saved.
    fn mark(&mut self, index: usize) {
        self.unsaved.set(index);
        let Some(setting) = SETTINGS.get(index) else { return };
        let stays_here = matches!(setting.place, Place::Settings) && !OF_COMMANDER.contains(&index);
        if setting.class == Class::Boot || stays_here || !self.is_in_use(index) {
            return;
        }
        self.unsent.set(index);
        // A law that is chosen begins with default numbers, so that its own follow at once.
        if let Some(row) = index.checked_sub(FIRST_AXIS)
            && axes::is_law(row)
        {
            for number in axes::numbers_of(row).map(|row| FIRST_AXIS + row) {
                if self.is_in_use(number) {
                    self.unsent.set(number);
                } else {
                    self.unsent.clear(number);
                }
            }
        }
    }

    /// False for a number that its axis' reaching law does not have.
    fn is_in_use(&self, index: usize) -> bool {
        let Some(row) = index.checked_sub(FIRST_AXIS) else { return true };
        let Some(law) = axes::law_of(row) else { return true };
        let code = self.get(FIRST_AXIS + law).map_or(0, Value::int);
        axes::law_has(code, row)
    }

    /// The next changes for the owners, in turn by the table; a law comes together with its numbers.
    pub fn take_changes(&mut self) -> Changes {
        let mut changes = Changes::new();
        while let Some(index) = self.unsent.next_from(self.next) {
            let law = index.checked_sub(FIRST_AXIS).filter(|row| axes::is_law(*row));
            let needed = if law.is_some() { LAW_CHANGES } else { 1 };
            if changes.len() + needed > CHANGES_MAX {
                break;
            }
            self.take_change(index, &mut changes);
            self.next = index + 1;
            for number in law.into_iter().flat_map(axes::numbers_of).map(|row| FIRST_AXIS + row) {
                if self.unsent.has(number) {
                    self.take_change(number, &mut changes);
                }
            }
        }
        changes
    }

    fn take_change(&mut self, index: usize, changes: &mut Changes) {
        self.unsent.clear(index);
        if let Some(value) = self.get(index) {
            // There is room, as was asked before.
            let _ = changes.push(self.change(index, value));
        }
    }

    /// Whether all that can be set while disarmed only is with its owners: it is to be in effect before the next arming.
    pub(crate) fn are_settled(&self) -> bool {
        let is_disarmed = |index: usize| SETTINGS.get(index).is_some_and(|setting| setting.class == Class::Disarmed);
        self.unsent.first().is_none() || !(0..COUNT).any(|index| self.unsent.has(index) && is_disarmed(index))
    }

    /// The next value to be saved. The caller waits with it until the vehicle is disarmed.
    pub fn next_unsaved(&self) -> Option<(usize, Value)> {
        let index = self.unsaved.first()?;
        Some((index, self.get(index)?))
    }

    /// Notes that a value is in the store, unless it was set to another meanwhile.
    pub fn saved(&mut self, index: usize, value: Value) {
        if self.bits.get(index) == Some(&value.bits()) {
            self.unsaved.clear(index);
        }
    }

    /// How many values were set, wrapping.
    pub fn generation(&self) -> u16 {
        self.generation
    }

    /// Whether the vehicle was ever configured.
    pub fn is_configured(&self) -> bool {
        self.get(SYS_AUTOSTART).map_or(0, Value::int) != 0
    }

    /// MAVLink system of this vehicle.
    pub fn system_id(&self) -> u8 {
        self.get(MAV_SYS_ID).and_then(|value| u8::try_from(value.int()).ok()).unwrap_or(1)
    }

    /// The `MAV_AUTOPILOT` that ground stations are told.
    pub fn autopilot(&self) -> u8 {
        self.get(GL_AUTOPILOT).and_then(|value| u8::try_from(value.int()).ok()).unwrap_or(0)
    }

    /// Charge of the battery, as a fraction, by its voltage at rest: linear between the voltages that count as empty and as
    /// full. `None` while the number of cells is not set.
    pub fn charge(&self, battery: &BatterySample) -> Option<f32> {
        let real = |index| self.get(index).map(Value::real);
        let cells = self.get(BAT1_N_CELLS).map(Value::int).filter(|cells| *cells > 0)? as f32;
        let (empty, full) = (real(BAT1_V_EMPTY)?, real(BAT1_V_CHARGED)?);
        let at_rest = battery.voltage_v / cells + battery.current_a * real(BAT1_R_INTERNAL)?;
        (full > empty && at_rest.is_finite()).then(|| math::clamp((at_rest - empty) / (full - empty), 0.0, 1.0))
    }

    /// Age at which sticks are lost, s.
    pub fn stick_loss_s(&self) -> f32 {
        self.get(COM_RC_LOSS_T).map_or(0.0, Value::real)
    }

    /// Age at which a stream of set-points is lost, s.
    pub fn setpoint_loss_s(&self) -> f32 {
        self.get(COM_OF_LOSS_T).map_or(0.0, Value::real)
    }

    /// Horizontal speed on the way to a place, m/s.
    pub fn cruise_m_s(&self) -> f32 {
        self.get(MPC_XY_CRUISE).map_or(0.0, Value::real)
    }

    /// Height of a take-off for which none is given, m.
    pub fn take_off_height_m(&self) -> f32 {
        self.get(MIS_TAKEOFF_ALT).map_or(crate::commander::TAKE_OFF_HEIGHT_M, Value::real)
    }
}

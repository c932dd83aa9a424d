#![doc = "MAVLink glissade dialect."]
#![doc = ""]
#![doc = "This file was automatically generated, do not edit."]
#![allow(deprecated)]
#![allow(clippy::match_single_binding)]
#![allow(rustdoc::broken_intra_doc_links)]
#[cfg(feature = "arbitrary")]
use arbitrary::Arbitrary;
#[allow(unused_imports)]
use bitflags::{Flags, bitflags};
#[allow(unused_imports)]
use mavlink_core::{MavlinkVersion, Message, MessageData, bytes::Bytes, bytes_mut::BytesMut, types::CharArray};
#[allow(unused_imports)]
use num_derive::{FromPrimitive, ToPrimitive};
#[allow(unused_imports)]
use num_traits::{FromPrimitive, ToPrimitive};
#[cfg(feature = "serde")]
use serde::{Deserialize, Serialize};
#[cfg(feature = "ts-rs")]
use ts_rs::TS;
pub const MINOR_MAVLINK_VERSION: u8 = 3u8;
bitflags! { # [cfg_attr (feature = "ts-rs" , derive (TS))] # [cfg_attr (feature = "ts-rs" , ts (export , type = "number"))] # [cfg_attr (feature = "serde" , derive (Serialize , Deserialize))] # [cfg_attr (feature = "arbitrary" , derive (Arbitrary))] # [derive (Debug , Copy , Clone , PartialEq)] pub struct EstimatorStatusFlags : u16 { # [doc = "Attitude and heading are known."] const ESTIMATOR_ATTITUDE = 1 ; # [doc = "Horizontal velocity is known."] const ESTIMATOR_VELOCITY_HORIZ = 2 ; # [doc = "Vertical velocity is known."] const ESTIMATOR_VELOCITY_VERT = 4 ; # [doc = "Position is known in the local frame."] const ESTIMATOR_POS_HORIZ_REL = 8 ; # [doc = "Position is known on the globe."] const ESTIMATOR_POS_HORIZ_ABS = 16 ; } }
impl EstimatorStatusFlags {
    pub const DEFAULT: Self = Self::ESTIMATOR_ATTITUDE;
}
impl Default for EstimatorStatusFlags {
    fn default() -> Self {
        Self::DEFAULT
    }
}
#[cfg_attr(feature = "ts-rs", derive(TS))]
#[cfg_attr(feature = "ts-rs", ts(export))]
#[derive(Debug, Copy, Clone, PartialEq, FromPrimitive, ToPrimitive)]
#[cfg_attr(feature = "serde", derive(Serialize, Deserialize))]
#[cfg_attr(feature = "serde", serde(tag = "type"))]
#[cfg_attr(feature = "arbitrary", derive(Arbitrary))]
#[repr(u32)]
pub enum MavAutopilot {
    #[doc = "No known coding of modes."]
    MAV_AUTOPILOT_GENERIC = 0,
    #[doc = "PX4, whose mode numbers are used."]
    MAV_AUTOPILOT_PX4 = 12,
}
impl MavAutopilot {
    pub const DEFAULT: Self = Self::MAV_AUTOPILOT_GENERIC;
}
impl Default for MavAutopilot {
    fn default() -> Self {
        Self::DEFAULT
    }
}
#[cfg_attr(feature = "ts-rs", derive(TS))]
#[cfg_attr(feature = "ts-rs", ts(export))]
#[derive(Debug, Copy, Clone, PartialEq, FromPrimitive, ToPrimitive)]
#[cfg_attr(feature = "serde", derive(Serialize, Deserialize))]
#[cfg_attr(feature = "serde", serde(tag = "type"))]
#[cfg_attr(feature = "arbitrary", derive(Arbitrary))]
#[repr(u32)]
pub enum MavCmd {
    #[doc = "Return to where it was armed, and land."]
    MAV_CMD_NAV_RETURN_TO_LAUNCH = 20,
    #[doc = "Land."]
    MAV_CMD_NAV_LAND = 21,
    #[doc = "Take off to a height."]
    MAV_CMD_NAV_TAKEOFF = 22,
    #[doc = "Fly a circle."]
    MAV_CMD_DO_ORBIT = 34,
    #[doc = "Turn to a heading."]
    MAV_CMD_CONDITION_YAW = 115,
    #[doc = "Set the mode, in the autopilot type's coding."]
    MAV_CMD_DO_SET_MODE = 176,
    #[doc = "Set a speed."]
    MAV_CMD_DO_CHANGE_SPEED = 178,
    #[doc = "Set where the vehicle returns to."]
    MAV_CMD_DO_SET_HOME = 179,
    #[doc = "Stop the rotors at once."]
    MAV_CMD_DO_FLIGHTTERMINATION = 185,
    #[doc = "Go to a place, and stay."]
    MAV_CMD_DO_REPOSITION = 192,
    #[doc = "Turn a motor for a while."]
    MAV_CMD_DO_MOTOR_TEST = 209,
    #[doc = "Load, store or reset parameters."]
    MAV_CMD_PREFLIGHT_STORAGE = 245,
    #[doc = "Reboot."]
    MAV_CMD_PREFLIGHT_REBOOT_SHUTDOWN = 246,
    #[doc = "Set a standard mode."]
    MAV_CMD_DO_SET_STANDARD_MODE = 262,
    #[doc = "Arm (1) or disarm (0)."]
    MAV_CMD_COMPONENT_ARM_DISARM = 400,
    #[doc = "The old way to ask for HOME_POSITION."]
    MAV_CMD_GET_HOME_POSITION = 410,
    #[doc = "Make something fail."]
    MAV_CMD_INJECT_FAILURE = 420,
    #[doc = "Ask for a message's interval."]
    MAV_CMD_GET_MESSAGE_INTERVAL = 510,
    #[doc = "Set a message's interval."]
    MAV_CMD_SET_MESSAGE_INTERVAL = 511,
    #[doc = "Send a message once."]
    MAV_CMD_REQUEST_MESSAGE = 512,
    #[doc = "The old way to ask for PROTOCOL_VERSION."]
    MAV_CMD_REQUEST_PROTOCOL_VERSION = 519,
    #[doc = "The old way to ask for AUTOPILOT_VERSION."]
    MAV_CMD_REQUEST_AUTOPILOT_CAPABILITIES = 520,
}
impl MavCmd {
    pub const DEFAULT: Self = Self::MAV_CMD_NAV_RETURN_TO_LAUNCH;
}
impl Default for MavCmd {
    fn default() -> Self {
        Self::DEFAULT
    }
}
#[cfg_attr(feature = "ts-rs", derive(TS))]
#[cfg_attr(feature = "ts-rs", ts(export))]
#[derive(Debug, Copy, Clone, PartialEq, FromPrimitive, ToPrimitive)]
#[cfg_attr(feature = "serde", derive(Serialize, Deserialize))]
#[cfg_attr(feature = "serde", serde(tag = "type"))]
#[cfg_attr(feature = "arbitrary", derive(Arbitrary))]
#[repr(u32)]
pub enum MavLandedState {
    #[doc = "On the ground."]
    MAV_LANDED_STATE_ON_GROUND = 1,
    #[doc = "In the air."]
    MAV_LANDED_STATE_IN_AIR = 2,
    #[doc = "Taking off."]
    MAV_LANDED_STATE_TAKEOFF = 3,
    #[doc = "Landing."]
    MAV_LANDED_STATE_LANDING = 4,
}
impl MavLandedState {
    pub const DEFAULT: Self = Self::MAV_LANDED_STATE_ON_GROUND;
}
impl Default for MavLandedState {
    fn default() -> Self {
        Self::DEFAULT
    }
}
#[cfg_attr(feature = "ts-rs", derive(TS))]
#[cfg_attr(feature = "ts-rs", ts(export))]
#[derive(Debug, Copy, Clone, PartialEq, FromPrimitive, ToPrimitive)]
#[cfg_attr(feature = "serde", derive(Serialize, Deserialize))]
#[cfg_attr(feature = "serde", serde(tag = "type"))]
#[cfg_attr(feature = "arbitrary", derive(Arbitrary))]
#[repr(u32)]
pub enum MavMissionResult {
    #[doc = "Done."]
    MAV_MISSION_ACCEPTED = 0,
    #[doc = "Failed."]
    MAV_MISSION_ERROR = 1,
    #[doc = "Not supported."]
    MAV_MISSION_UNSUPPORTED = 3,
    #[doc = "Too many items."]
    MAV_MISSION_NO_SPACE = 4,
    #[doc = "No such item."]
    MAV_MISSION_INVALID_SEQUENCE = 13,
    #[doc = "Not now."]
    MAV_MISSION_DENIED = 14,
}
impl MavMissionResult {
    pub const DEFAULT: Self = Self::MAV_MISSION_ACCEPTED;
}
impl Default for MavMissionResult {
    fn default() -> Self {
        Self::DEFAULT
    }
}
bitflags! { # [cfg_attr (feature = "ts-rs" , derive (TS))] # [cfg_attr (feature = "ts-rs" , ts (export , type = "number"))] # [cfg_attr (feature = "serde" , derive (Serialize , Deserialize))] # [cfg_attr (feature = "arbitrary" , derive (Arbitrary))] # [derive (Debug , Copy , Clone , PartialEq)] pub struct MavModeFlag : u16 { # [doc = "Rotors may turn."] const MAV_MODE_FLAG_SAFETY_ARMED = 128 ; # [doc = "Attitude is controlled."] const MAV_MODE_FLAG_STABILIZE_ENABLED = 16 ; # [doc = "Position is controlled."] const MAV_MODE_FLAG_GUIDED_ENABLED = 8 ; # [doc = "Flies by itself."] const MAV_MODE_FLAG_AUTO_ENABLED = 4 ; # [doc = "custom_mode is valid."] const MAV_MODE_FLAG_CUSTOM_MODE_ENABLED = 1 ; } }
impl MavModeFlag {
    pub const DEFAULT: Self = Self::MAV_MODE_FLAG_SAFETY_ARMED;
}
impl Default for MavModeFlag {
    fn default() -> Self {
        Self::DEFAULT
    }
}
#[cfg_attr(feature = "ts-rs", derive(TS))]
#[cfg_attr(feature = "ts-rs", ts(export))]
#[derive(Debug, Copy, Clone, PartialEq, FromPrimitive, ToPrimitive)]
#[cfg_attr(feature = "serde", derive(Serialize, Deserialize))]
#[cfg_attr(feature = "serde", serde(tag = "type"))]
#[cfg_attr(feature = "arbitrary", derive(Arbitrary))]
#[repr(u32)]
pub enum MavParamError {
    #[doc = "None."]
    MAV_PARAM_ERROR_NO_ERROR = 0,
    #[doc = "No such parameter."]
    MAV_PARAM_ERROR_DOES_NOT_EXIST = 1,
    #[doc = "The value is out of range."]
    MAV_PARAM_ERROR_VALUE_OUT_OF_RANGE = 2,
    #[doc = "Not now."]
    MAV_PARAM_ERROR_PERMISSION_DENIED = 3,
    #[doc = "Cannot be set."]
    MAV_PARAM_ERROR_READ_ONLY = 5,
    #[doc = "Of another type."]
    MAV_PARAM_ERROR_TYPE_MISMATCH = 7,
}
impl MavParamError {
    pub const DEFAULT: Self = Self::MAV_PARAM_ERROR_NO_ERROR;
}
impl Default for MavParamError {
    fn default() -> Self {
        Self::DEFAULT
    }
}
#[cfg_attr(feature = "ts-rs", derive(TS))]
#[cfg_attr(feature = "ts-rs", ts(export))]
#[derive(Debug, Copy, Clone, PartialEq, FromPrimitive, ToPrimitive)]
#[cfg_attr(feature = "serde", derive(Serialize, Deserialize))]
#[cfg_attr(feature = "serde", serde(tag = "type"))]
#[cfg_attr(feature = "arbitrary", derive(Arbitrary))]
#[repr(u32)]
pub enum MavParamType {
    #[doc = "Integer."]
    MAV_PARAM_TYPE_INT32 = 6,
    #[doc = "Real."]
    MAV_PARAM_TYPE_REAL32 = 9,
}
impl MavParamType {
    pub const DEFAULT: Self = Self::MAV_PARAM_TYPE_INT32;
}
impl Default for MavParamType {
    fn default() -> Self {
        Self::DEFAULT
    }
}
bitflags! { # [cfg_attr (feature = "ts-rs" , derive (TS))] # [cfg_attr (feature = "ts-rs" , ts (export , type = "number"))] # [cfg_attr (feature = "serde" , derive (Serialize , Deserialize))] # [cfg_attr (feature = "arbitrary" , derive (Arbitrary))] # [derive (Debug , Copy , Clone , PartialEq)] pub struct MavProtocolCapability : u64 { # [doc = "Missions, in the newer form."] const MAV_PROTOCOL_CAPABILITY_MISSION_INT = 4 ; # [doc = "COMMAND_INT is understood."] const MAV_PROTOCOL_CAPABILITY_COMMAND_INT = 8 ; # [doc = "The bytes of an integer parameter stand in its value."] const MAV_PROTOCOL_CAPABILITY_PARAM_ENCODE_BYTEWISE = 16 ; # [doc = "SET_ATTITUDE_TARGET is understood."] const MAV_PROTOCOL_CAPABILITY_SET_ATTITUDE_TARGET = 64 ; # [doc = "SET_POSITION_TARGET_LOCAL_NED is understood."] const MAV_PROTOCOL_CAPABILITY_SET_POSITION_TARGET_LOCAL_NED = 128 ; # [doc = "SET_POSITION_TARGET_GLOBAL_INT is understood."] const MAV_PROTOCOL_CAPABILITY_SET_POSITION_TARGET_GLOBAL_INT = 256 ; # [doc = "MAVLink 2 is spoken."] const MAV_PROTOCOL_CAPABILITY_MAVLINK2 = 8192 ; } }
impl MavProtocolCapability {
    pub const DEFAULT: Self = Self::MAV_PROTOCOL_CAPABILITY_MISSION_INT;
}
impl Default for MavProtocolCapability {
    fn default() -> Self {
        Self::DEFAULT
    }
}
#[cfg_attr(feature = "ts-rs", derive(TS))]
#[cfg_attr(feature = "ts-rs", ts(export))]
#[derive(Debug, Copy, Clone, PartialEq, FromPrimitive, ToPrimitive)]
#[cfg_attr(feature = "serde", derive(Serialize, Deserialize))]
#[cfg_attr(feature = "serde", serde(tag = "type"))]
#[cfg_attr(feature = "arbitrary", derive(Arbitrary))]
#[repr(u32)]
pub enum MavResult {
    #[doc = "Done."]
    MAV_RESULT_ACCEPTED = 0,
    #[doc = "Not now."]
    MAV_RESULT_TEMPORARILY_REJECTED = 1,
    #[doc = "Invalid parameters."]
    MAV_RESULT_DENIED = 2,
    #[doc = "Unknown command."]
    MAV_RESULT_UNSUPPORTED = 3,
    #[doc = "Tried in vain."]
    MAV_RESULT_FAILED = 4,
    #[doc = "Under way."]
    MAV_RESULT_IN_PROGRESS = 5,
    #[doc = "Only as COMMAND_LONG."]
    MAV_RESULT_COMMAND_LONG_ONLY = 7,
    #[doc = "Only as COMMAND_INT."]
    MAV_RESULT_COMMAND_INT_ONLY = 8,
    #[doc = "Not in this frame."]
    MAV_RESULT_COMMAND_UNSUPPORTED_MAV_FRAME = 9,
}
impl MavResult {
    pub const DEFAULT: Self = Self::MAV_RESULT_ACCEPTED;
}
impl Default for MavResult {
    fn default() -> Self {
        Self::DEFAULT
    }
}
#[cfg_attr(feature = "ts-rs", derive(TS))]
#[cfg_attr(feature = "ts-rs", ts(export))]
#[derive(Debug, Copy, Clone, PartialEq, FromPrimitive, ToPrimitive)]
#[cfg_attr(feature = "serde", derive(Serialize, Deserialize))]
#[cfg_attr(feature = "serde", serde(tag = "type"))]
#[cfg_attr(feature = "arbitrary", derive(Arbitrary))]
#[repr(u32)]
pub enum MavSeverity {
    #[doc = "Something has failed."]
    MAV_SEVERITY_CRITICAL = 2,
    #[doc = "Error."]
    MAV_SEVERITY_ERROR = 3,
    #[doc = "Warning."]
    MAV_SEVERITY_WARNING = 4,
    #[doc = "Unusual."]
    MAV_SEVERITY_NOTICE = 5,
    #[doc = "Usual."]
    MAV_SEVERITY_INFO = 6,
}
impl MavSeverity {
    pub const DEFAULT: Self = Self::MAV_SEVERITY_CRITICAL;
}
impl Default for MavSeverity {
    fn default() -> Self {
        Self::DEFAULT
    }
}
#[cfg_attr(feature = "ts-rs", derive(TS))]
#[cfg_attr(feature = "ts-rs", ts(export))]
#[derive(Debug, Copy, Clone, PartialEq, FromPrimitive, ToPrimitive)]
#[cfg_attr(feature = "serde", derive(Serialize, Deserialize))]
#[cfg_attr(feature = "serde", serde(tag = "type"))]
#[cfg_attr(feature = "arbitrary", derive(Arbitrary))]
#[repr(u32)]
pub enum MavState {
    #[doc = "Ready to be armed."]
    MAV_STATE_STANDBY = 3,
    #[doc = "Armed."]
    MAV_STATE_ACTIVE = 4,
    #[doc = "Something has failed, and it comes down."]
    MAV_STATE_CRITICAL = 5,
}
impl MavState {
    pub const DEFAULT: Self = Self::MAV_STATE_STANDBY;
}
impl Default for MavState {
    fn default() -> Self {
        Self::DEFAULT
    }
}
bitflags! { # [cfg_attr (feature = "ts-rs" , derive (TS))] # [cfg_attr (feature = "ts-rs" , ts (export , type = "number"))] # [cfg_attr (feature = "serde" , derive (Serialize , Deserialize))] # [cfg_attr (feature = "arbitrary" , derive (Arbitrary))] # [derive (Debug , Copy , Clone , PartialEq)] pub struct MavSysStatusSensor : u32 { # [doc = "Gyroscope."] const MAV_SYS_STATUS_SENSOR_3D_GYRO = 1 ; # [doc = "Accelerometer."] const MAV_SYS_STATUS_SENSOR_3D_ACCEL = 2 ; # [doc = "Magnetometer."] const MAV_SYS_STATUS_SENSOR_3D_MAG = 4 ; # [doc = "Barometer."] const MAV_SYS_STATUS_SENSOR_ABSOLUTE_PRESSURE = 8 ; # [doc = "Satellite receiver."] const MAV_SYS_STATUS_SENSOR_GPS = 32 ; # [doc = "The motion itself, measured from outside."] const MAV_SYS_STATUS_SENSOR_EXTERNAL_GROUND_TRUTH = 512 ; # [doc = "Rate control."] const MAV_SYS_STATUS_SENSOR_ANGULAR_RATE_CONTROL = 1024 ; # [doc = "Attitude control."] const MAV_SYS_STATUS_SENSOR_ATTITUDE_STABILIZATION = 2048 ; # [doc = "Heading control."] const MAV_SYS_STATUS_SENSOR_YAW_POSITION = 4096 ; # [doc = "Height control."] const MAV_SYS_STATUS_SENSOR_Z_ALTITUDE_CONTROL = 8192 ; # [doc = "Position control."] const MAV_SYS_STATUS_SENSOR_XY_POSITION_CONTROL = 16384 ; # [doc = "Motor outputs."] const MAV_SYS_STATUS_SENSOR_MOTOR_OUTPUTS = 32768 ; # [doc = "Sticks, of a radio or a ground station."] const MAV_SYS_STATUS_SENSOR_RC_RECEIVER = 65536 ; # [doc = "Not breached."] const MAV_SYS_STATUS_GEOFENCE = 1048576 ; # [doc = "Attitude and position are known."] const MAV_SYS_STATUS_AHRS = 2097152 ; # [doc = "Battery monitor."] const MAV_SYS_STATUS_SENSOR_BATTERY = 33554432 ; # [doc = "An arm request would be accepted."] const MAV_SYS_STATUS_PREARM_CHECK = 268435456 ; } }
impl MavSysStatusSensor {
    pub const DEFAULT: Self = Self::MAV_SYS_STATUS_SENSOR_3D_GYRO;
}
impl Default for MavSysStatusSensor {
    fn default() -> Self {
        Self::DEFAULT
    }
}
#[cfg_attr(feature = "ts-rs", derive(TS))]
#[cfg_attr(feature = "ts-rs", ts(export))]
#[derive(Debug, Copy, Clone, PartialEq, FromPrimitive, ToPrimitive)]
#[cfg_attr(feature = "serde", derive(Serialize, Deserialize))]
#[cfg_attr(feature = "serde", serde(tag = "type"))]
#[cfg_attr(feature = "arbitrary", derive(Arbitrary))]
#[repr(u32)]
pub enum MavType {
    #[doc = "Quadrotor."]
    MAV_TYPE_QUADROTOR = 2,
    #[doc = "Ground station."]
    MAV_TYPE_GCS = 6,
}
impl MavType {
    pub const DEFAULT: Self = Self::MAV_TYPE_QUADROTOR;
}
impl Default for MavType {
    fn default() -> Self {
        Self::DEFAULT
    }
}
#[cfg_attr(feature = "ts-rs", derive(TS))]
#[cfg_attr(feature = "ts-rs", ts(export))]
#[derive(Debug, Copy, Clone, PartialEq, FromPrimitive, ToPrimitive)]
#[cfg_attr(feature = "serde", derive(Serialize, Deserialize))]
#[cfg_attr(feature = "serde", serde(tag = "type"))]
#[cfg_attr(feature = "arbitrary", derive(Arbitrary))]
#[repr(u32)]
pub enum MavVtolState {
    #[doc = "Not a VTOL."]
    MAV_VTOL_STATE_UNDEFINED = 0,
}
impl MavVtolState {
    pub const DEFAULT: Self = Self::MAV_VTOL_STATE_UNDEFINED;
}
impl Default for MavVtolState {
    fn default() -> Self {
        Self::DEFAULT
    }
}
#[doc = "Heights."]
#[doc = ""]
#[doc = "ID: 141"]
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(Serialize, Deserialize))]
#[cfg_attr(feature = "arbitrary", derive(Arbitrary))]
#[cfg_attr(feature = "ts-rs", derive(TS))]
#[cfg_attr(feature = "ts-rs", ts(export))]
pub struct ALTITUDE_DATA {
    #[doc = "Time since boot."]
    pub time_usec: u64,
    #[doc = "Altitude monotonic."]
    pub altitude_monotonic: f32,
    #[doc = "Altitude amsl."]
    pub altitude_amsl: f32,
    #[doc = "Altitude local."]
    pub altitude_local: f32,
    #[doc = "Altitude relative."]
    pub altitude_relative: f32,
    #[doc = "Altitude terrain."]
    pub altitude_terrain: f32,
    #[doc = "Bottom clearance."]
    pub bottom_clearance: f32,
}
impl ALTITUDE_DATA {
    pub const ENCODED_LEN: usize = 32usize;
    pub const DEFAULT: Self = Self {
        time_usec: 0_u64,
        altitude_monotonic: 0.0_f32,
        altitude_amsl: 0.0_f32,
        altitude_local: 0.0_f32,
        altitude_relative: 0.0_f32,
        altitude_terrain: 0.0_f32,
        bottom_clearance: 0.0_f32,
    };
    #[cfg(feature = "arbitrary")]
    pub fn random<R: rand::Rng>(rng: &mut R) -> Self {
        use arbitrary::{Arbitrary, Unstructured};
        let mut buf = [0u8; 1024];
        rng.fill_bytes(&mut buf);
        let mut unstructured = Unstructured::new(&buf);
        Self::arbitrary(&mut unstructured).unwrap_or_default()
    }
}
impl Default for ALTITUDE_DATA {
    fn default() -> Self {
        Self::DEFAULT.clone()
    }
}
impl MessageData for ALTITUDE_DATA {
    type Message = MavMessage;
    const ID: u32 = 141u32;
    const NAME: &'static str = "ALTITUDE";
    const EXTRA_CRC: u8 = 47u8;
    const ENCODED_LEN: usize = 32usize;
    fn deser(_version: MavlinkVersion, __input: &[u8]) -> Result<Self, ::mavlink_core::error::ParserError> {
        let avail_len = __input.len();
        let mut payload_buf;
        let mut buf = if avail_len < Self::ENCODED_LEN {
            payload_buf = [0; Self::ENCODED_LEN];
            payload_buf[0..avail_len].copy_from_slice(__input);
            Bytes::new(&payload_buf)
        } else {
            Bytes::new(__input)
        };
        let mut __struct = Self::default();
        __struct.time_usec = buf.get_u64_le()?;
        __struct.altitude_monotonic = buf.get_f32_le()?;
        __struct.altitude_amsl = buf.get_f32_le()?;
        __struct.altitude_local = buf.get_f32_le()?;
        __struct.altitude_relative = buf.get_f32_le()?;
        __struct.altitude_terrain = buf.get_f32_le()?;
        __struct.bottom_clearance = buf.get_f32_le()?;
        Ok(__struct)
    }
    fn ser(&self, version: MavlinkVersion, bytes: &mut [u8]) -> usize {
        let mut __tmp = BytesMut::new(bytes);
        if __tmp.remaining() < Self::ENCODED_LEN {
            panic!("buffer is too small (need {} bytes, but got {})", Self::ENCODED_LEN, __tmp.remaining(),)
        }
        __tmp.put_u64_le(self.time_usec);
        __tmp.put_f32_le(self.altitude_monotonic);
        __tmp.put_f32_le(self.altitude_amsl);
        __tmp.put_f32_le(self.altitude_local);
        __tmp.put_f32_le(self.altitude_relative);
        __tmp.put_f32_le(self.altitude_terrain);
        __tmp.put_f32_le(self.bottom_clearance);
        if matches!(version, MavlinkVersion::V2) {
            let len = __tmp.len();
            ::mavlink_core::utils::remove_trailing_zeroes(&bytes[..len])
        } else {
            __tmp.len()
        }
    }
}
#[doc = "Attitude and rates, NED/FRD."]
#[doc = ""]
#[doc = "ID: 30"]
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(Serialize, Deserialize))]
#[cfg_attr(feature = "arbitrary", derive(Arbitrary))]
#[cfg_attr(feature = "ts-rs", derive(TS))]
#[cfg_attr(feature = "ts-rs", ts(export))]
pub struct ATTITUDE_DATA {
    #[doc = "Time since boot."]
    pub time_boot_ms: u32,
    #[doc = "Roll."]
    pub roll: f32,
    #[doc = "Pitch."]
    pub pitch: f32,
    #[doc = "Yaw."]
    pub yaw: f32,
    #[doc = "p."]
    pub rollspeed: f32,
    #[doc = "q."]
    pub pitchspeed: f32,
    #[doc = "r."]
    pub yawspeed: f32,
}
impl ATTITUDE_DATA {
    pub const ENCODED_LEN: usize = 28usize;
    pub const DEFAULT: Self = Self {
        time_boot_ms: 0_u32,
        roll: 0.0_f32,
        pitch: 0.0_f32,
        yaw: 0.0_f32,
        rollspeed: 0.0_f32,
        pitchspeed: 0.0_f32,
        yawspeed: 0.0_f32,
    };
    #[cfg(feature = "arbitrary")]
    pub fn random<R: rand::Rng>(rng: &mut R) -> Self {
        use arbitrary::{Arbitrary, Unstructured};
        let mut buf = [0u8; 1024];
        rng.fill_bytes(&mut buf);
        let mut unstructured = Unstructured::new(&buf);
        Self::arbitrary(&mut unstructured).unwrap_or_default()
    }
}
impl Default for ATTITUDE_DATA {
    fn default() -> Self {
        Self::DEFAULT.clone()
    }
}
impl MessageData for ATTITUDE_DATA {
    type Message = MavMessage;
    const ID: u32 = 30u32;
    const NAME: &'static str = "ATTITUDE";
    const EXTRA_CRC: u8 = 39u8;
    const ENCODED_LEN: usize = 28usize;
    fn deser(_version: MavlinkVersion, __input: &[u8]) -> Result<Self, ::mavlink_core::error::ParserError> {
        let avail_len = __input.len();
        let mut payload_buf;
        let mut buf = if avail_len < Self::ENCODED_LEN {
            payload_buf = [0; Self::ENCODED_LEN];
            payload_buf[0..avail_len].copy_from_slice(__input);
            Bytes::new(&payload_buf)
        } else {
            Bytes::new(__input)
        };
        let mut __struct = Self::default();
        __struct.time_boot_ms = buf.get_u32_le()?;
        __struct.roll = buf.get_f32_le()?;
        __struct.pitch = buf.get_f32_le()?;
        __struct.yaw = buf.get_f32_le()?;
        __struct.rollspeed = buf.get_f32_le()?;
        __struct.pitchspeed = buf.get_f32_le()?;
        __struct.yawspeed = buf.get_f32_le()?;
        Ok(__struct)
    }
    fn ser(&self, version: MavlinkVersion, bytes: &mut [u8]) -> usize {
        let mut __tmp = BytesMut::new(bytes);
        if __tmp.remaining() < Self::ENCODED_LEN {
            panic!("buffer is too small (need {} bytes, but got {})", Self::ENCODED_LEN, __tmp.remaining(),)
        }
        __tmp.put_u32_le(self.time_boot_ms);
        __tmp.put_f32_le(self.roll);
        __tmp.put_f32_le(self.pitch);
        __tmp.put_f32_le(self.yaw);
        __tmp.put_f32_le(self.rollspeed);
        __tmp.put_f32_le(self.pitchspeed);
        __tmp.put_f32_le(self.yawspeed);
        if matches!(version, MavlinkVersion::V2) {
            let len = __tmp.len();
            ::mavlink_core::utils::remove_trailing_zeroes(&bytes[..len])
        } else {
            __tmp.len()
        }
    }
}
#[doc = "Attitude as a quaternion, and rates."]
#[doc = ""]
#[doc = "ID: 31"]
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(Serialize, Deserialize))]
#[cfg_attr(feature = "arbitrary", derive(Arbitrary))]
#[cfg_attr(feature = "ts-rs", derive(TS))]
#[cfg_attr(feature = "ts-rs", ts(export))]
pub struct ATTITUDE_QUATERNION_DATA {
    #[doc = "Time since boot."]
    pub time_boot_ms: u32,
    #[doc = "Q1."]
    pub q1: f32,
    #[doc = "Q2."]
    pub q2: f32,
    #[doc = "Q3."]
    pub q3: f32,
    #[doc = "Q4."]
    pub q4: f32,
    #[doc = "Rollspeed."]
    pub rollspeed: f32,
    #[doc = "Pitchspeed."]
    pub pitchspeed: f32,
    #[doc = "Yawspeed."]
    pub yawspeed: f32,
    #[doc = "Repr offset q."]
    #[cfg_attr(feature = "serde", serde(default = "crate::utils::RustDefault::rust_default"))]
    #[cfg_attr(feature = "serde", serde(with = "serde_arrays"))]
    #[cfg_attr(feature = "ts-rs", ts(type = "Array<number>"))]
    pub repr_offset_q: [f32; 4],
}
impl ATTITUDE_QUATERNION_DATA {
    pub const ENCODED_LEN: usize = 48usize;
    pub const DEFAULT: Self = Self {
        time_boot_ms: 0_u32,
        q1: 0.0_f32,
        q2: 0.0_f32,
        q3: 0.0_f32,
        q4: 0.0_f32,
        rollspeed: 0.0_f32,
        pitchspeed: 0.0_f32,
        yawspeed: 0.0_f32,
        repr_offset_q: [0.0_f32; 4usize],
    };
    #[cfg(feature = "arbitrary")]
    pub fn random<R: rand::Rng>(rng: &mut R) -> Self {
        use arbitrary::{Arbitrary, Unstructured};
        let mut buf = [0u8; 1024];
        rng.fill_bytes(&mut buf);
        let mut unstructured = Unstructured::new(&buf);
        Self::arbitrary(&mut unstructured).unwrap_or_default()
    }
}
impl Default for ATTITUDE_QUATERNION_DATA {
    fn default() -> Self {
        Self::DEFAULT.clone()
    }
}
impl MessageData for ATTITUDE_QUATERNION_DATA {
    type Message = MavMessage;
    const ID: u32 = 31u32;
    const NAME: &'static str = "ATTITUDE_QUATERNION";
    const EXTRA_CRC: u8 = 246u8;
    const ENCODED_LEN: usize = 48usize;
    fn deser(_version: MavlinkVersion, __input: &[u8]) -> Result<Self, ::mavlink_core::error::ParserError> {
        let avail_len = __input.len();
        let mut payload_buf;
        let mut buf = if avail_len < Self::ENCODED_LEN {
            payload_buf = [0; Self::ENCODED_LEN];
            payload_buf[0..avail_len].copy_from_slice(__input);
            Bytes::new(&payload_buf)
        } else {
            Bytes::new(__input)
        };
        let mut __struct = Self::default();
        __struct.time_boot_ms = buf.get_u32_le()?;
        __struct.q1 = buf.get_f32_le()?;
        __struct.q2 = buf.get_f32_le()?;
        __struct.q3 = buf.get_f32_le()?;
        __struct.q4 = buf.get_f32_le()?;
        __struct.rollspeed = buf.get_f32_le()?;
        __struct.pitchspeed = buf.get_f32_le()?;
        __struct.yawspeed = buf.get_f32_le()?;
        for v in &mut __struct.repr_offset_q {
            let val = buf.get_f32_le()?;
            *v = val;
        }
        Ok(__struct)
    }
    fn ser(&self, version: MavlinkVersion, bytes: &mut [u8]) -> usize {
        let mut __tmp = BytesMut::new(bytes);
        if __tmp.remaining() < Self::ENCODED_LEN {
            panic!("buffer is too small (need {} bytes, but got {})", Self::ENCODED_LEN, __tmp.remaining(),)
        }
        __tmp.put_u32_le(self.time_boot_ms);
        __tmp.put_f32_le(self.q1);
        __tmp.put_f32_le(self.q2);
        __tmp.put_f32_le(self.q3);
        __tmp.put_f32_le(self.q4);
        __tmp.put_f32_le(self.rollspeed);
        __tmp.put_f32_le(self.pitchspeed);
        __tmp.put_f32_le(self.yawspeed);
        if matches!(version, MavlinkVersion::V2) {
            for val in &self.repr_offset_q {
                __tmp.put_f32_le(*val);
            }
            let len = __tmp.len();
            ::mavlink_core::utils::remove_trailing_zeroes(&bytes[..len])
        } else {
            __tmp.len()
        }
    }
}
#[doc = "Attitude and thrust that are aimed at."]
#[doc = ""]
#[doc = "ID: 83"]
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(Serialize, Deserialize))]
#[cfg_attr(feature = "arbitrary", derive(Arbitrary))]
#[cfg_attr(feature = "ts-rs", derive(TS))]
#[cfg_attr(feature = "ts-rs", ts(export))]
pub struct ATTITUDE_TARGET_DATA {
    #[doc = "Time since boot."]
    pub time_boot_ms: u32,
    #[doc = "Q."]
    #[cfg_attr(feature = "serde", serde(with = "serde_arrays"))]
    #[cfg_attr(feature = "ts-rs", ts(type = "Array<number>"))]
    pub q: [f32; 4],
    #[doc = "Body roll rate."]
    pub body_roll_rate: f32,
    #[doc = "Body pitch rate."]
    pub body_pitch_rate: f32,
    #[doc = "Body yaw rate."]
    pub body_yaw_rate: f32,
    #[doc = "Thrust."]
    pub thrust: f32,
    #[doc = "Type mask."]
    pub type_mask: u8,
}
impl ATTITUDE_TARGET_DATA {
    pub const ENCODED_LEN: usize = 37usize;
    pub const DEFAULT: Self = Self {
        time_boot_ms: 0_u32,
        q: [0.0_f32; 4usize],
        body_roll_rate: 0.0_f32,
        body_pitch_rate: 0.0_f32,
        body_yaw_rate: 0.0_f32,
        thrust: 0.0_f32,
        type_mask: 0_u8,
    };
    #[cfg(feature = "arbitrary")]
    pub fn random<R: rand::Rng>(rng: &mut R) -> Self {
        use arbitrary::{Arbitrary, Unstructured};
        let mut buf = [0u8; 1024];
        rng.fill_bytes(&mut buf);
        let mut unstructured = Unstructured::new(&buf);
        Self::arbitrary(&mut unstructured).unwrap_or_default()
    }
}
impl Default for ATTITUDE_TARGET_DATA {
    fn default() -> Self {
        Self::DEFAULT.clone()
    }
}
impl MessageData for ATTITUDE_TARGET_DATA {
    type Message = MavMessage;
    const ID: u32 = 83u32;
    const NAME: &'static str = "ATTITUDE_TARGET";
    const EXTRA_CRC: u8 = 22u8;
    const ENCODED_LEN: usize = 37usize;
    fn deser(_version: MavlinkVersion, __input: &[u8]) -> Result<Self, ::mavlink_core::error::ParserError> {
        let avail_len = __input.len();
        let mut payload_buf;
        let mut buf = if avail_len < Self::ENCODED_LEN {
            payload_buf = [0; Self::ENCODED_LEN];
            payload_buf[0..avail_len].copy_from_slice(__input);
            Bytes::new(&payload_buf)
        } else {
            Bytes::new(__input)
        };
        let mut __struct = Self::default();
        __struct.time_boot_ms = buf.get_u32_le()?;
        for v in &mut __struct.q {
            let val = buf.get_f32_le()?;
            *v = val;
        }
        __struct.body_roll_rate = buf.get_f32_le()?;
        __struct.body_pitch_rate = buf.get_f32_le()?;
        __struct.body_yaw_rate = buf.get_f32_le()?;
        __struct.thrust = buf.get_f32_le()?;
        __struct.type_mask = buf.get_u8()?;
        Ok(__struct)
    }
    fn ser(&self, version: MavlinkVersion, bytes: &mut [u8]) -> usize {
        let mut __tmp = BytesMut::new(bytes);
        if __tmp.remaining() < Self::ENCODED_LEN {
            panic!("buffer is too small (need {} bytes, but got {})", Self::ENCODED_LEN, __tmp.remaining(),)
        }
        __tmp.put_u32_le(self.time_boot_ms);
        for val in &self.q {
            __tmp.put_f32_le(*val);
        }
        __tmp.put_f32_le(self.body_roll_rate);
        __tmp.put_f32_le(self.body_pitch_rate);
        __tmp.put_f32_le(self.body_yaw_rate);
        __tmp.put_f32_le(self.thrust);
        __tmp.put_u8(self.type_mask);
        if matches!(version, MavlinkVersion::V2) {
            let len = __tmp.len();
            ::mavlink_core::utils::remove_trailing_zeroes(&bytes[..len])
        } else {
            __tmp.len()
        }
    }
}
#[doc = "Version and capabilities."]
#[doc = ""]
#[doc = "ID: 148"]
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(Serialize, Deserialize))]
#[cfg_attr(feature = "arbitrary", derive(Arbitrary))]
#[cfg_attr(feature = "ts-rs", derive(TS))]
#[cfg_attr(feature = "ts-rs", ts(export))]
pub struct AUTOPILOT_VERSION_DATA {
    #[doc = "Capabilities."]
    pub capabilities: MavProtocolCapability,
    #[doc = "Not used."]
    pub uid: u64,
    #[doc = "Version of the firmware: major, minor, patch, type."]
    pub flight_sw_version: u32,
    #[doc = "Not used."]
    pub middleware_sw_version: u32,
    #[doc = "Not used."]
    pub os_sw_version: u32,
    #[doc = "Not used."]
    pub board_version: u32,
    #[doc = "Not used."]
    pub vendor_id: u16,
    #[doc = "Not used."]
    pub product_id: u16,
    #[doc = "Not used."]
    #[cfg_attr(feature = "serde", serde(with = "serde_arrays"))]
    #[cfg_attr(feature = "ts-rs", ts(type = "Array<number>"))]
    pub flight_custom_version: [u8; 8],
    #[doc = "Not used."]
    #[cfg_attr(feature = "serde", serde(with = "serde_arrays"))]
    #[cfg_attr(feature = "ts-rs", ts(type = "Array<number>"))]
    pub middleware_custom_version: [u8; 8],
    #[doc = "Not used."]
    #[cfg_attr(feature = "serde", serde(with = "serde_arrays"))]
    #[cfg_attr(feature = "ts-rs", ts(type = "Array<number>"))]
    pub os_custom_version: [u8; 8],
}
impl AUTOPILOT_VERSION_DATA {
    pub const ENCODED_LEN: usize = 60usize;
    pub const DEFAULT: Self = Self {
        capabilities: MavProtocolCapability::DEFAULT,
        uid: 0_u64,
        flight_sw_version: 0_u32,
        middleware_sw_version: 0_u32,
        os_sw_version: 0_u32,
        board_version: 0_u32,
        vendor_id: 0_u16,
        product_id: 0_u16,
        flight_custom_version: [0_u8; 8usize],
        middleware_custom_version: [0_u8; 8usize],
        os_custom_version: [0_u8; 8usize],
    };
    #[cfg(feature = "arbitrary")]
    pub fn random<R: rand::Rng>(rng: &mut R) -> Self {
        use arbitrary::{Arbitrary, Unstructured};
        let mut buf = [0u8; 1024];
        rng.fill_bytes(&mut buf);
        let mut unstructured = Unstructured::new(&buf);
        Self::arbitrary(&mut unstructured).unwrap_or_default()
    }
}
impl Default for AUTOPILOT_VERSION_DATA {
    fn default() -> Self {
        Self::DEFAULT.clone()
    }
}
impl MessageData for AUTOPILOT_VERSION_DATA {
    type Message = MavMessage;
    const ID: u32 = 148u32;
    const NAME: &'static str = "AUTOPILOT_VERSION";
    const EXTRA_CRC: u8 = 178u8;
    const ENCODED_LEN: usize = 60usize;
    fn deser(_version: MavlinkVersion, __input: &[u8]) -> Result<Self, ::mavlink_core::error::ParserError> {
        let avail_len = __input.len();
        let mut payload_buf;
        let mut buf = if avail_len < Self::ENCODED_LEN {
            payload_buf = [0; Self::ENCODED_LEN];
            payload_buf[0..avail_len].copy_from_slice(__input);
            Bytes::new(&payload_buf)
        } else {
            Bytes::new(__input)
        };
        let mut __struct = Self::default();
        let tmp = buf.get_u64_le()?;
        __struct.capabilities = MavProtocolCapability::from_bits_retain(tmp as <MavProtocolCapability as Flags>::Bits);
        __struct.uid = buf.get_u64_le()?;
        __struct.flight_sw_version = buf.get_u32_le()?;
        __struct.middleware_sw_version = buf.get_u32_le()?;
        __struct.os_sw_version = buf.get_u32_le()?;
        __struct.board_version = buf.get_u32_le()?;
        __struct.vendor_id = buf.get_u16_le()?;
        __struct.product_id = buf.get_u16_le()?;
        for v in &mut __struct.flight_custom_version {
            let val = buf.get_u8()?;
            *v = val;
        }
        for v in &mut __struct.middleware_custom_version {
            let val = buf.get_u8()?;
            *v = val;
        }
        for v in &mut __struct.os_custom_version {
            let val = buf.get_u8()?;
            *v = val;
        }
        Ok(__struct)
    }
    fn ser(&self, version: MavlinkVersion, bytes: &mut [u8]) -> usize {
        let mut __tmp = BytesMut::new(bytes);
        if __tmp.remaining() < Self::ENCODED_LEN {
            panic!("buffer is too small (need {} bytes, but got {})", Self::ENCODED_LEN, __tmp.remaining(),)
        }
        __tmp.put_u64_le(self.capabilities.bits() as u64);
        __tmp.put_u64_le(self.uid);
        __tmp.put_u32_le(self.flight_sw_version);
        __tmp.put_u32_le(self.middleware_sw_version);
        __tmp.put_u32_le(self.os_sw_version);
        __tmp.put_u32_le(self.board_version);
        __tmp.put_u16_le(self.vendor_id);
        __tmp.put_u16_le(self.product_id);
        for val in &self.flight_custom_version {
            __tmp.put_u8(*val);
        }
        for val in &self.middleware_custom_version {
            __tmp.put_u8(*val);
        }
        for val in &self.os_custom_version {
            __tmp.put_u8(*val);
        }
        if matches!(version, MavlinkVersion::V2) {
            let len = __tmp.len();
            ::mavlink_core::utils::remove_trailing_zeroes(&bytes[..len])
        } else {
            __tmp.len()
        }
    }
}
#[doc = "A mode that can be set."]
#[doc = ""]
#[doc = "ID: 435"]
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(Serialize, Deserialize))]
#[cfg_attr(feature = "arbitrary", derive(Arbitrary))]
#[cfg_attr(feature = "ts-rs", derive(TS))]
#[cfg_attr(feature = "ts-rs", ts(export))]
pub struct AVAILABLE_MODES_DATA {
    #[doc = "Custom mode."]
    pub custom_mode: u32,
    #[doc = "Properties."]
    pub properties: u32,
    #[doc = "Number modes."]
    pub number_modes: u8,
    #[doc = "Mode index."]
    pub mode_index: u8,
    #[doc = "Standard mode."]
    pub standard_mode: u8,
    #[doc = "Mode name."]
    #[cfg_attr(feature = "ts-rs", ts(type = "string"))]
    pub mode_name: CharArray<35>,
}
impl AVAILABLE_MODES_DATA {
    pub const ENCODED_LEN: usize = 46usize;
    pub const DEFAULT: Self = Self {
        custom_mode: 0_u32,
        properties: 0_u32,
        number_modes: 0_u8,
        mode_index: 0_u8,
        standard_mode: 0_u8,
        mode_name: CharArray::new([0_u8; 35usize]),
    };
    #[cfg(feature = "arbitrary")]
    pub fn random<R: rand::Rng>(rng: &mut R) -> Self {
        use arbitrary::{Arbitrary, Unstructured};
        let mut buf = [0u8; 1024];
        rng.fill_bytes(&mut buf);
        let mut unstructured = Unstructured::new(&buf);
        Self::arbitrary(&mut unstructured).unwrap_or_default()
    }
}
impl Default for AVAILABLE_MODES_DATA {
    fn default() -> Self {
        Self::DEFAULT.clone()
    }
}
impl MessageData for AVAILABLE_MODES_DATA {
    type Message = MavMessage;
    const ID: u32 = 435u32;
    const NAME: &'static str = "AVAILABLE_MODES";
    const EXTRA_CRC: u8 = 134u8;
    const ENCODED_LEN: usize = 46usize;
    fn deser(_version: MavlinkVersion, __input: &[u8]) -> Result<Self, ::mavlink_core::error::ParserError> {
        let avail_len = __input.len();
        let mut payload_buf;
        let mut buf = if avail_len < Self::ENCODED_LEN {
            payload_buf = [0; Self::ENCODED_LEN];
            payload_buf[0..avail_len].copy_from_slice(__input);
            Bytes::new(&payload_buf)
        } else {
            Bytes::new(__input)
        };
        let mut __struct = Self::default();
        __struct.custom_mode = buf.get_u32_le()?;
        __struct.properties = buf.get_u32_le()?;
        __struct.number_modes = buf.get_u8()?;
        __struct.mode_index = buf.get_u8()?;
        __struct.standard_mode = buf.get_u8()?;
        let mut tmp = [0_u8; 35usize];
        for v in &mut tmp {
            *v = buf.get_u8()?;
        }
        __struct.mode_name = CharArray::new(tmp);
        Ok(__struct)
    }
    fn ser(&self, version: MavlinkVersion, bytes: &mut [u8]) -> usize {
        let mut __tmp = BytesMut::new(bytes);
        if __tmp.remaining() < Self::ENCODED_LEN {
            panic!("buffer is too small (need {} bytes, but got {})", Self::ENCODED_LEN, __tmp.remaining(),)
        }
        __tmp.put_u32_le(self.custom_mode);
        __tmp.put_u32_le(self.properties);
        __tmp.put_u8(self.number_modes);
        __tmp.put_u8(self.mode_index);
        __tmp.put_u8(self.standard_mode);
        for val in &self.mode_name {
            __tmp.put_u8(*val);
        }
        if matches!(version, MavlinkVersion::V2) {
            let len = __tmp.len();
            ::mavlink_core::utils::remove_trailing_zeroes(&bytes[..len])
        } else {
            __tmp.len()
        }
    }
}
#[doc = "Changes when the modes change."]
#[doc = ""]
#[doc = "ID: 437"]
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(Serialize, Deserialize))]
#[cfg_attr(feature = "arbitrary", derive(Arbitrary))]
#[cfg_attr(feature = "ts-rs", derive(TS))]
#[cfg_attr(feature = "ts-rs", ts(export))]
pub struct AVAILABLE_MODES_MONITOR_DATA {
    #[doc = "Seq."]
    pub seq: u8,
}
impl AVAILABLE_MODES_MONITOR_DATA {
    pub const ENCODED_LEN: usize = 1usize;
    pub const DEFAULT: Self = Self { seq: 0_u8 };
    #[cfg(feature = "arbitrary")]
    pub fn random<R: rand::Rng>(rng: &mut R) -> Self {
        use arbitrary::{Arbitrary, Unstructured};
        let mut buf = [0u8; 1024];
        rng.fill_bytes(&mut buf);
        let mut unstructured = Unstructured::new(&buf);
        Self::arbitrary(&mut unstructured).unwrap_or_default()
    }
}
impl Default for AVAILABLE_MODES_MONITOR_DATA {
    fn default() -> Self {
        Self::DEFAULT.clone()
    }
}
impl MessageData for AVAILABLE_MODES_MONITOR_DATA {
    type Message = MavMessage;
    const ID: u32 = 437u32;
    const NAME: &'static str = "AVAILABLE_MODES_MONITOR";
    const EXTRA_CRC: u8 = 30u8;
    const ENCODED_LEN: usize = 1usize;
    fn deser(_version: MavlinkVersion, __input: &[u8]) -> Result<Self, ::mavlink_core::error::ParserError> {
        let avail_len = __input.len();
        let mut payload_buf;
        let mut buf = if avail_len < Self::ENCODED_LEN {
            payload_buf = [0; Self::ENCODED_LEN];
            payload_buf[0..avail_len].copy_from_slice(__input);
            Bytes::new(&payload_buf)
        } else {
            Bytes::new(__input)
        };
        let mut __struct = Self::default();
        __struct.seq = buf.get_u8()?;
        Ok(__struct)
    }
    fn ser(&self, version: MavlinkVersion, bytes: &mut [u8]) -> usize {
        let mut __tmp = BytesMut::new(bytes);
        if __tmp.remaining() < Self::ENCODED_LEN {
            panic!("buffer is too small (need {} bytes, but got {})", Self::ENCODED_LEN, __tmp.remaining(),)
        }
        __tmp.put_u8(self.seq);
        if matches!(version, MavlinkVersion::V2) {
            let len = __tmp.len();
            ::mavlink_core::utils::remove_trailing_zeroes(&bytes[..len])
        } else {
            __tmp.len()
        }
    }
}
#[doc = "Battery."]
#[doc = ""]
#[doc = "ID: 147"]
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(Serialize, Deserialize))]
#[cfg_attr(feature = "arbitrary", derive(Arbitrary))]
#[cfg_attr(feature = "ts-rs", derive(TS))]
#[cfg_attr(feature = "ts-rs", ts(export))]
pub struct BATTERY_STATUS_DATA {
    #[doc = "Current consumed."]
    pub current_consumed: i32,
    #[doc = "Energy consumed."]
    pub energy_consumed: i32,
    #[doc = "Temperature."]
    pub temperature: i16,
    #[doc = "Voltages."]
    #[cfg_attr(feature = "serde", serde(with = "serde_arrays"))]
    #[cfg_attr(feature = "ts-rs", ts(type = "Array<number>"))]
    pub voltages: [u16; 10],
    #[doc = "Current battery."]
    pub current_battery: i16,
    #[doc = "Id."]
    pub id: u8,
    #[doc = "Battery function."]
    pub battery_function: u8,
    #[doc = "Type."]
    pub mavtype: u8,
    #[doc = "Battery remaining."]
    pub battery_remaining: i8,
    #[doc = "Time remaining."]
    #[cfg_attr(feature = "serde", serde(default = "crate::utils::RustDefault::rust_default"))]
    pub time_remaining: i32,
    #[doc = "Charge state."]
    #[cfg_attr(feature = "serde", serde(default = "crate::utils::RustDefault::rust_default"))]
    pub charge_state: u8,
    #[doc = "Voltages ext."]
    #[cfg_attr(feature = "serde", serde(default = "crate::utils::RustDefault::rust_default"))]
    #[cfg_attr(feature = "serde", serde(with = "serde_arrays"))]
    #[cfg_attr(feature = "ts-rs", ts(type = "Array<number>"))]
    pub voltages_ext: [u16; 4],
    #[doc = "Mode."]
    #[cfg_attr(feature = "serde", serde(default = "crate::utils::RustDefault::rust_default"))]
    pub mode: u8,
    #[doc = "Fault bitmask."]
    #[cfg_attr(feature = "serde", serde(default = "crate::utils::RustDefault::rust_default"))]
    pub fault_bitmask: u32,
}
impl BATTERY_STATUS_DATA {
    pub const ENCODED_LEN: usize = 54usize;
    pub const DEFAULT: Self = Self {
        current_consumed: 0_i32,
        energy_consumed: 0_i32,
        temperature: 0_i16,
        voltages: [0_u16; 10usize],
        current_battery: 0_i16,
        id: 0_u8,
        battery_function: 0_u8,
        mavtype: 0_u8,
        battery_remaining: 0_i8,
        time_remaining: 0_i32,
        charge_state: 0_u8,
        voltages_ext: [0_u16; 4usize],
        mode: 0_u8,
        fault_bitmask: 0_u32,
    };
    #[cfg(feature = "arbitrary")]
    pub fn random<R: rand::Rng>(rng: &mut R) -> Self {
        use arbitrary::{Arbitrary, Unstructured};
        let mut buf = [0u8; 1024];
        rng.fill_bytes(&mut buf);
        let mut unstructured = Unstructured::new(&buf);
        Self::arbitrary(&mut unstructured).unwrap_or_default()
    }
}
impl Default for BATTERY_STATUS_DATA {
    fn default() -> Self {
        Self::DEFAULT.clone()
    }
}
impl MessageData for BATTERY_STATUS_DATA {
    type Message = MavMessage;
    const ID: u32 = 147u32;
    const NAME: &'static str = "BATTERY_STATUS";
    const EXTRA_CRC: u8 = 154u8;
    const ENCODED_LEN: usize = 54usize;
    fn deser(_version: MavlinkVersion, __input: &[u8]) -> Result<Self, ::mavlink_core::error::ParserError> {
        let avail_len = __input.len();
        let mut payload_buf;
        let mut buf = if avail_len < Self::ENCODED_LEN {
            payload_buf = [0; Self::ENCODED_LEN];
            payload_buf[0..avail_len].copy_from_slice(__input);
            Bytes::new(&payload_buf)
        } else {
            Bytes::new(__input)
        };
        let mut __struct = Self::default();
        __struct.current_consumed = buf.get_i32_le()?;
        __struct.energy_consumed = buf.get_i32_le()?;
        __struct.temperature = buf.get_i16_le()?;
        for v in &mut __struct.voltages {
            let val = buf.get_u16_le()?;
            *v = val;
        }
        __struct.current_battery = buf.get_i16_le()?;
        __struct.id = buf.get_u8()?;
        __struct.battery_function = buf.get_u8()?;
        __struct.mavtype = buf.get_u8()?;
        __struct.battery_remaining = buf.get_i8()?;
        __struct.time_remaining = buf.get_i32_le()?;
        __struct.charge_state = buf.get_u8()?;
        for v in &mut __struct.voltages_ext {
            let val = buf.get_u16_le()?;
            *v = val;
        }
        __struct.mode = buf.get_u8()?;
        __struct.fault_bitmask = buf.get_u32_le()?;
        Ok(__struct)
    }
    fn ser(&self, version: MavlinkVersion, bytes: &mut [u8]) -> usize {
        let mut __tmp = BytesMut::new(bytes);
        if __tmp.remaining() < Self::ENCODED_LEN {
            panic!("buffer is too small (need {} bytes, but got {})", Self::ENCODED_LEN, __tmp.remaining(),)
        }
        __tmp.put_i32_le(self.current_consumed);
        __tmp.put_i32_le(self.energy_consumed);
        __tmp.put_i16_le(self.temperature);
        for val in &self.voltages {
            __tmp.put_u16_le(*val);
        }
        __tmp.put_i16_le(self.current_battery);
        __tmp.put_u8(self.id);
        __tmp.put_u8(self.battery_function);
        __tmp.put_u8(self.mavtype);
        __tmp.put_i8(self.battery_remaining);
        if matches!(version, MavlinkVersion::V2) {
            __tmp.put_i32_le(self.time_remaining);
            __tmp.put_u8(self.charge_state);
            for val in &self.voltages_ext {
                __tmp.put_u16_le(*val);
            }
            __tmp.put_u8(self.mode);
            __tmp.put_u32_le(self.fault_bitmask);
            let len = __tmp.len();
            ::mavlink_core::utils::remove_trailing_zeroes(&bytes[..len])
        } else {
            __tmp.len()
        }
    }
}
#[doc = "How a command ended."]
#[doc = ""]
#[doc = "ID: 77"]
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(Serialize, Deserialize))]
#[cfg_attr(feature = "arbitrary", derive(Arbitrary))]
#[cfg_attr(feature = "ts-rs", derive(TS))]
#[cfg_attr(feature = "ts-rs", ts(export))]
pub struct COMMAND_ACK_DATA {
    #[doc = "MAV_CMD."]
    pub command: u16,
    #[doc = "Result."]
    pub result: MavResult,
    #[doc = "Progress while it runs."]
    #[cfg_attr(feature = "serde", serde(default = "crate::utils::RustDefault::rust_default"))]
    pub progress: u8,
    #[doc = "Detail of the result."]
    #[cfg_attr(feature = "serde", serde(default = "crate::utils::RustDefault::rust_default"))]
    pub result_param2: i32,
    #[doc = "System that sent the command."]
    #[cfg_attr(feature = "serde", serde(default = "crate::utils::RustDefault::rust_default"))]
    pub target_system: u8,
    #[doc = "Component that sent the command."]
    #[cfg_attr(feature = "serde", serde(default = "crate::utils::RustDefault::rust_default"))]
    pub target_component: u8,
}
impl COMMAND_ACK_DATA {
    pub const ENCODED_LEN: usize = 10usize;
    pub const DEFAULT: Self = Self {
        command: 0_u16,
        result: MavResult::DEFAULT,
        progress: 0_u8,
        result_param2: 0_i32,
        target_system: 0_u8,
        target_component: 0_u8,
    };
    #[cfg(feature = "arbitrary")]
    pub fn random<R: rand::Rng>(rng: &mut R) -> Self {
        use arbitrary::{Arbitrary, Unstructured};
        let mut buf = [0u8; 1024];
        rng.fill_bytes(&mut buf);
        let mut unstructured = Unstructured::new(&buf);
        Self::arbitrary(&mut unstructured).unwrap_or_default()
    }
}
impl Default for COMMAND_ACK_DATA {
    fn default() -> Self {
        Self::DEFAULT.clone()
    }
}
impl MessageData for COMMAND_ACK_DATA {
    type Message = MavMessage;
    const ID: u32 = 77u32;
    const NAME: &'static str = "COMMAND_ACK";
    const EXTRA_CRC: u8 = 143u8;
    const ENCODED_LEN: usize = 10usize;
    fn deser(_version: MavlinkVersion, __input: &[u8]) -> Result<Self, ::mavlink_core::error::ParserError> {
        let avail_len = __input.len();
        let mut payload_buf;
        let mut buf = if avail_len < Self::ENCODED_LEN {
            payload_buf = [0; Self::ENCODED_LEN];
            payload_buf[0..avail_len].copy_from_slice(__input);
            Bytes::new(&payload_buf)
        } else {
            Bytes::new(__input)
        };
        let mut __struct = Self::default();
        __struct.command = buf.get_u16_le()?;
        let tmp = buf.get_u8()?;
        __struct.result = FromPrimitive::from_u8(tmp)
            .ok_or(::mavlink_core::error::ParserError::InvalidEnum { enum_type: "MavResult", value: tmp as u64 })?;
        __struct.progress = buf.get_u8()?;
        __struct.result_param2 = buf.get_i32_le()?;
        __struct.target_system = buf.get_u8()?;
        __struct.target_component = buf.get_u8()?;
        Ok(__struct)
    }
    fn ser(&self, version: MavlinkVersion, bytes: &mut [u8]) -> usize {
        let mut __tmp = BytesMut::new(bytes);
        if __tmp.remaining() < Self::ENCODED_LEN {
            panic!("buffer is too small (need {} bytes, but got {})", Self::ENCODED_LEN, __tmp.remaining(),)
        }
        __tmp.put_u16_le(self.command);
        __tmp.put_u8(self.result as u8);
        if matches!(version, MavlinkVersion::V2) {
            __tmp.put_u8(self.progress);
            __tmp.put_i32_le(self.result_param2);
            __tmp.put_u8(self.target_system);
            __tmp.put_u8(self.target_component);
            let len = __tmp.len();
            ::mavlink_core::utils::remove_trailing_zeroes(&bytes[..len])
        } else {
            __tmp.len()
        }
    }
}
#[doc = "A command with a position in integers."]
#[doc = ""]
#[doc = "ID: 75"]
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(Serialize, Deserialize))]
#[cfg_attr(feature = "arbitrary", derive(Arbitrary))]
#[cfg_attr(feature = "ts-rs", derive(TS))]
#[cfg_attr(feature = "ts-rs", ts(export))]
pub struct COMMAND_INT_DATA {
    #[doc = "Parameter 1."]
    pub param1: f32,
    #[doc = "Parameter 2."]
    pub param2: f32,
    #[doc = "Parameter 3."]
    pub param3: f32,
    #[doc = "Parameter 4."]
    pub param4: f32,
    #[doc = "Parameter 5."]
    pub x: i32,
    #[doc = "Parameter 6."]
    pub y: i32,
    #[doc = "Parameter 7."]
    pub z: f32,
    #[doc = "MAV_CMD."]
    pub command: u16,
    #[doc = "System."]
    pub target_system: u8,
    #[doc = "Component."]
    pub target_component: u8,
    #[doc = "Frame of the position."]
    pub frame: u8,
    #[doc = "Not used."]
    pub current: u8,
    #[doc = "Not used."]
    pub autocontinue: u8,
}
impl COMMAND_INT_DATA {
    pub const ENCODED_LEN: usize = 35usize;
    pub const DEFAULT: Self = Self {
        param1: 0.0_f32,
        param2: 0.0_f32,
        param3: 0.0_f32,
        param4: 0.0_f32,
        x: 0_i32,
        y: 0_i32,
        z: 0.0_f32,
        command: 0_u16,
        target_system: 0_u8,
        target_component: 0_u8,
        frame: 0_u8,
        current: 0_u8,
        autocontinue: 0_u8,
    };
    #[cfg(feature = "arbitrary")]
    pub fn random<R: rand::Rng>(rng: &mut R) -> Self {
        use arbitrary::{Arbitrary, Unstructured};
        let mut buf = [0u8; 1024];
        rng.fill_bytes(&mut buf);
        let mut unstructured = Unstructured::new(&buf);
        Self::arbitrary(&mut unstructured).unwrap_or_default()
    }
}
impl Default for COMMAND_INT_DATA {
    fn default() -> Self {
        Self::DEFAULT.clone()
    }
}
impl MessageData for COMMAND_INT_DATA {
    type Message = MavMessage;
    const ID: u32 = 75u32;
    const NAME: &'static str = "COMMAND_INT";
    const EXTRA_CRC: u8 = 158u8;
    const ENCODED_LEN: usize = 35usize;
    fn deser(_version: MavlinkVersion, __input: &[u8]) -> Result<Self, ::mavlink_core::error::ParserError> {
        let avail_len = __input.len();
        let mut payload_buf;
        let mut buf = if avail_len < Self::ENCODED_LEN {
            payload_buf = [0; Self::ENCODED_LEN];
            payload_buf[0..avail_len].copy_from_slice(__input);
            Bytes::new(&payload_buf)
        } else {
            Bytes::new(__input)
        };
        let mut __struct = Self::default();
        __struct.param1 = buf.get_f32_le()?;
        __struct.param2 = buf.get_f32_le()?;
        __struct.param3 = buf.get_f32_le()?;
        __struct.param4 = buf.get_f32_le()?;
        __struct.x = buf.get_i32_le()?;
        __struct.y = buf.get_i32_le()?;
        __struct.z = buf.get_f32_le()?;
        __struct.command = buf.get_u16_le()?;
        __struct.target_system = buf.get_u8()?;
        __struct.target_component = buf.get_u8()?;
        __struct.frame = buf.get_u8()?;
        __struct.current = buf.get_u8()?;
        __struct.autocontinue = buf.get_u8()?;
        Ok(__struct)
    }
    fn ser(&self, version: MavlinkVersion, bytes: &mut [u8]) -> usize {
        let mut __tmp = BytesMut::new(bytes);
        if __tmp.remaining() < Self::ENCODED_LEN {
            panic!("buffer is too small (need {} bytes, but got {})", Self::ENCODED_LEN, __tmp.remaining(),)
        }
        __tmp.put_f32_le(self.param1);
        __tmp.put_f32_le(self.param2);
        __tmp.put_f32_le(self.param3);
        __tmp.put_f32_le(self.param4);
        __tmp.put_i32_le(self.x);
        __tmp.put_i32_le(self.y);
        __tmp.put_f32_le(self.z);
        __tmp.put_u16_le(self.command);
        __tmp.put_u8(self.target_system);
        __tmp.put_u8(self.target_component);
        __tmp.put_u8(self.frame);
        __tmp.put_u8(self.current);
        __tmp.put_u8(self.autocontinue);
        if matches!(version, MavlinkVersion::V2) {
            let len = __tmp.len();
            ::mavlink_core::utils::remove_trailing_zeroes(&bytes[..len])
        } else {
            __tmp.len()
        }
    }
}
#[doc = "A command."]
#[doc = ""]
#[doc = "ID: 76"]
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(Serialize, Deserialize))]
#[cfg_attr(feature = "arbitrary", derive(Arbitrary))]
#[cfg_attr(feature = "ts-rs", derive(TS))]
#[cfg_attr(feature = "ts-rs", ts(export))]
pub struct COMMAND_LONG_DATA {
    #[doc = "Parameter 1."]
    pub param1: f32,
    #[doc = "Parameter 2."]
    pub param2: f32,
    #[doc = "Parameter 3."]
    pub param3: f32,
    #[doc = "Parameter 4."]
    pub param4: f32,
    #[doc = "Parameter 5."]
    pub param5: f32,
    #[doc = "Parameter 6."]
    pub param6: f32,
    #[doc = "Parameter 7."]
    pub param7: f32,
    #[doc = "MAV_CMD."]
    pub command: u16,
    #[doc = "System."]
    pub target_system: u8,
    #[doc = "Component."]
    pub target_component: u8,
    #[doc = "Number of the repetition."]
    pub confirmation: u8,
}
impl COMMAND_LONG_DATA {
    pub const ENCODED_LEN: usize = 33usize;
    pub const DEFAULT: Self = Self {
        param1: 0.0_f32,
        param2: 0.0_f32,
        param3: 0.0_f32,
        param4: 0.0_f32,
        param5: 0.0_f32,
        param6: 0.0_f32,
        param7: 0.0_f32,
        command: 0_u16,
        target_system: 0_u8,
        target_component: 0_u8,
        confirmation: 0_u8,
    };
    #[cfg(feature = "arbitrary")]
    pub fn random<R: rand::Rng>(rng: &mut R) -> Self {
        use arbitrary::{Arbitrary, Unstructured};
        let mut buf = [0u8; 1024];
        rng.fill_bytes(&mut buf);
        let mut unstructured = Unstructured::new(&buf);
        Self::arbitrary(&mut unstructured).unwrap_or_default()
    }
}
impl Default for COMMAND_LONG_DATA {
    fn default() -> Self {
        Self::DEFAULT.clone()
    }
}
impl MessageData for COMMAND_LONG_DATA {
    type Message = MavMessage;
    const ID: u32 = 76u32;
    const NAME: &'static str = "COMMAND_LONG";
    const EXTRA_CRC: u8 = 152u8;
    const ENCODED_LEN: usize = 33usize;
    fn deser(_version: MavlinkVersion, __input: &[u8]) -> Result<Self, ::mavlink_core::error::ParserError> {
        let avail_len = __input.len();
        let mut payload_buf;
        let mut buf = if avail_len < Self::ENCODED_LEN {
            payload_buf = [0; Self::ENCODED_LEN];
            payload_buf[0..avail_len].copy_from_slice(__input);
            Bytes::new(&payload_buf)
        } else {
            Bytes::new(__input)
        };
        let mut __struct = Self::default();
        __struct.param1 = buf.get_f32_le()?;
        __struct.param2 = buf.get_f32_le()?;
        __struct.param3 = buf.get_f32_le()?;
        __struct.param4 = buf.get_f32_le()?;
        __struct.param5 = buf.get_f32_le()?;
        __struct.param6 = buf.get_f32_le()?;
        __struct.param7 = buf.get_f32_le()?;
        __struct.command = buf.get_u16_le()?;
        __struct.target_system = buf.get_u8()?;
        __struct.target_component = buf.get_u8()?;
        __struct.confirmation = buf.get_u8()?;
        Ok(__struct)
    }
    fn ser(&self, version: MavlinkVersion, bytes: &mut [u8]) -> usize {
        let mut __tmp = BytesMut::new(bytes);
        if __tmp.remaining() < Self::ENCODED_LEN {
            panic!("buffer is too small (need {} bytes, but got {})", Self::ENCODED_LEN, __tmp.remaining(),)
        }
        __tmp.put_f32_le(self.param1);
        __tmp.put_f32_le(self.param2);
        __tmp.put_f32_le(self.param3);
        __tmp.put_f32_le(self.param4);
        __tmp.put_f32_le(self.param5);
        __tmp.put_f32_le(self.param6);
        __tmp.put_f32_le(self.param7);
        __tmp.put_u16_le(self.command);
        __tmp.put_u8(self.target_system);
        __tmp.put_u8(self.target_component);
        __tmp.put_u8(self.confirmation);
        if matches!(version, MavlinkVersion::V2) {
            let len = __tmp.len();
            ::mavlink_core::utils::remove_trailing_zeroes(&bytes[..len])
        } else {
            __tmp.len()
        }
    }
}
#[doc = "The mode now."]
#[doc = ""]
#[doc = "ID: 436"]
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(Serialize, Deserialize))]
#[cfg_attr(feature = "arbitrary", derive(Arbitrary))]
#[cfg_attr(feature = "ts-rs", derive(TS))]
#[cfg_attr(feature = "ts-rs", ts(export))]
pub struct CURRENT_MODE_DATA {
    #[doc = "Custom mode."]
    pub custom_mode: u32,
    #[doc = "Intended custom mode."]
    pub intended_custom_mode: u32,
    #[doc = "Standard mode."]
    pub standard_mode: u8,
}
impl CURRENT_MODE_DATA {
    pub const ENCODED_LEN: usize = 9usize;
    pub const DEFAULT: Self = Self { custom_mode: 0_u32, intended_custom_mode: 0_u32, standard_mode: 0_u8 };
    #[cfg(feature = "arbitrary")]
    pub fn random<R: rand::Rng>(rng: &mut R) -> Self {
        use arbitrary::{Arbitrary, Unstructured};
        let mut buf = [0u8; 1024];
        rng.fill_bytes(&mut buf);
        let mut unstructured = Unstructured::new(&buf);
        Self::arbitrary(&mut unstructured).unwrap_or_default()
    }
}
impl Default for CURRENT_MODE_DATA {
    fn default() -> Self {
        Self::DEFAULT.clone()
    }
}
impl MessageData for CURRENT_MODE_DATA {
    type Message = MavMessage;
    const ID: u32 = 436u32;
    const NAME: &'static str = "CURRENT_MODE";
    const EXTRA_CRC: u8 = 193u8;
    const ENCODED_LEN: usize = 9usize;
    fn deser(_version: MavlinkVersion, __input: &[u8]) -> Result<Self, ::mavlink_core::error::ParserError> {
        let avail_len = __input.len();
        let mut payload_buf;
        let mut buf = if avail_len < Self::ENCODED_LEN {
            payload_buf = [0; Self::ENCODED_LEN];
            payload_buf[0..avail_len].copy_from_slice(__input);
            Bytes::new(&payload_buf)
        } else {
            Bytes::new(__input)
        };
        let mut __struct = Self::default();
        __struct.custom_mode = buf.get_u32_le()?;
        __struct.intended_custom_mode = buf.get_u32_le()?;
        __struct.standard_mode = buf.get_u8()?;
        Ok(__struct)
    }
    fn ser(&self, version: MavlinkVersion, bytes: &mut [u8]) -> usize {
        let mut __tmp = BytesMut::new(bytes);
        if __tmp.remaining() < Self::ENCODED_LEN {
            panic!("buffer is too small (need {} bytes, but got {})", Self::ENCODED_LEN, __tmp.remaining(),)
        }
        __tmp.put_u32_le(self.custom_mode);
        __tmp.put_u32_le(self.intended_custom_mode);
        __tmp.put_u8(self.standard_mode);
        if matches!(version, MavlinkVersion::V2) {
            let len = __tmp.len();
            ::mavlink_core::utils::remove_trailing_zeroes(&bytes[..len])
        } else {
            __tmp.len()
        }
    }
}
#[doc = "Named values."]
#[doc = ""]
#[doc = "ID: 350"]
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(Serialize, Deserialize))]
#[cfg_attr(feature = "arbitrary", derive(Arbitrary))]
#[cfg_attr(feature = "ts-rs", derive(TS))]
#[cfg_attr(feature = "ts-rs", ts(export))]
pub struct DEBUG_FLOAT_ARRAY_DATA {
    #[doc = "Time since boot."]
    pub time_usec: u64,
    #[doc = "Array id."]
    pub array_id: u16,
    #[doc = "Name."]
    #[cfg_attr(feature = "ts-rs", ts(type = "string"))]
    pub name: CharArray<10>,
    #[doc = "Data."]
    #[cfg_attr(feature = "serde", serde(default = "crate::utils::RustDefault::rust_default"))]
    #[cfg_attr(feature = "serde", serde(with = "serde_arrays"))]
    #[cfg_attr(feature = "ts-rs", ts(type = "Array<number>"))]
    pub data: [f32; 58],
}
impl DEBUG_FLOAT_ARRAY_DATA {
    pub const ENCODED_LEN: usize = 252usize;
    pub const DEFAULT: Self =
        Self { time_usec: 0_u64, array_id: 0_u16, name: CharArray::new([0_u8; 10usize]), data: [0.0_f32; 58usize] };
    #[cfg(feature = "arbitrary")]
    pub fn random<R: rand::Rng>(rng: &mut R) -> Self {
        use arbitrary::{Arbitrary, Unstructured};
        let mut buf = [0u8; 1024];
        rng.fill_bytes(&mut buf);
        let mut unstructured = Unstructured::new(&buf);
        Self::arbitrary(&mut unstructured).unwrap_or_default()
    }
}
impl Default for DEBUG_FLOAT_ARRAY_DATA {
    fn default() -> Self {
        Self::DEFAULT.clone()
    }
}
impl MessageData for DEBUG_FLOAT_ARRAY_DATA {
    type Message = MavMessage;
    const ID: u32 = 350u32;
    const NAME: &'static str = "DEBUG_FLOAT_ARRAY";
    const EXTRA_CRC: u8 = 232u8;
    const ENCODED_LEN: usize = 252usize;
    fn deser(_version: MavlinkVersion, __input: &[u8]) -> Result<Self, ::mavlink_core::error::ParserError> {
        let avail_len = __input.len();
        let mut payload_buf;
        let mut buf = if avail_len < Self::ENCODED_LEN {
            payload_buf = [0; Self::ENCODED_LEN];
            payload_buf[0..avail_len].copy_from_slice(__input);
            Bytes::new(&payload_buf)
        } else {
            Bytes::new(__input)
        };
        let mut __struct = Self::default();
        __struct.time_usec = buf.get_u64_le()?;
        __struct.array_id = buf.get_u16_le()?;
        let mut tmp = [0_u8; 10usize];
        for v in &mut tmp {
            *v = buf.get_u8()?;
        }
        __struct.name = CharArray::new(tmp);
        for v in &mut __struct.data {
            let val = buf.get_f32_le()?;
            *v = val;
        }
        Ok(__struct)
    }
    fn ser(&self, version: MavlinkVersion, bytes: &mut [u8]) -> usize {
        let mut __tmp = BytesMut::new(bytes);
        if __tmp.remaining() < Self::ENCODED_LEN {
            panic!("buffer is too small (need {} bytes, but got {})", Self::ENCODED_LEN, __tmp.remaining(),)
        }
        __tmp.put_u64_le(self.time_usec);
        __tmp.put_u16_le(self.array_id);
        for val in &self.name {
            __tmp.put_u8(*val);
        }
        if matches!(version, MavlinkVersion::V2) {
            for val in &self.data {
                __tmp.put_f32_le(*val);
            }
            let len = __tmp.len();
            ::mavlink_core::utils::remove_trailing_zeroes(&bytes[..len])
        } else {
            __tmp.len()
        }
    }
}
#[doc = "Speeds of the rotors."]
#[doc = ""]
#[doc = "ID: 291"]
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(Serialize, Deserialize))]
#[cfg_attr(feature = "arbitrary", derive(Arbitrary))]
#[cfg_attr(feature = "ts-rs", derive(TS))]
#[cfg_attr(feature = "ts-rs", ts(export))]
pub struct ESC_STATUS_DATA {
    #[doc = "Time since boot."]
    pub time_usec: u64,
    #[doc = "Rpm."]
    #[cfg_attr(feature = "serde", serde(with = "serde_arrays"))]
    #[cfg_attr(feature = "ts-rs", ts(type = "Array<number>"))]
    pub rpm: [i32; 4],
    #[doc = "Voltage."]
    #[cfg_attr(feature = "serde", serde(with = "serde_arrays"))]
    #[cfg_attr(feature = "ts-rs", ts(type = "Array<number>"))]
    pub voltage: [f32; 4],
    #[doc = "Current."]
    #[cfg_attr(feature = "serde", serde(with = "serde_arrays"))]
    #[cfg_attr(feature = "ts-rs", ts(type = "Array<number>"))]
    pub current: [f32; 4],
    #[doc = "Index."]
    pub index: u8,
}
impl ESC_STATUS_DATA {
    pub const ENCODED_LEN: usize = 57usize;
    pub const DEFAULT: Self = Self {
        time_usec: 0_u64,
        rpm: [0_i32; 4usize],
        voltage: [0.0_f32; 4usize],
        current: [0.0_f32; 4usize],
        index: 0_u8,
    };
    #[cfg(feature = "arbitrary")]
    pub fn random<R: rand::Rng>(rng: &mut R) -> Self {
        use arbitrary::{Arbitrary, Unstructured};
        let mut buf = [0u8; 1024];
        rng.fill_bytes(&mut buf);
        let mut unstructured = Unstructured::new(&buf);
        Self::arbitrary(&mut unstructured).unwrap_or_default()
    }
}
impl Default for ESC_STATUS_DATA {
    fn default() -> Self {
        Self::DEFAULT.clone()
    }
}
impl MessageData for ESC_STATUS_DATA {
    type Message = MavMessage;
    const ID: u32 = 291u32;
    const NAME: &'static str = "ESC_STATUS";
    const EXTRA_CRC: u8 = 10u8;
    const ENCODED_LEN: usize = 57usize;
    fn deser(_version: MavlinkVersion, __input: &[u8]) -> Result<Self, ::mavlink_core::error::ParserError> {
        let avail_len = __input.len();
        let mut payload_buf;
        let mut buf = if avail_len < Self::ENCODED_LEN {
            payload_buf = [0; Self::ENCODED_LEN];
            payload_buf[0..avail_len].copy_from_slice(__input);
            Bytes::new(&payload_buf)
        } else {
            Bytes::new(__input)
        };
        let mut __struct = Self::default();
        __struct.time_usec = buf.get_u64_le()?;
        for v in &mut __struct.rpm {
            let val = buf.get_i32_le()?;
            *v = val;
        }
        for v in &mut __struct.voltage {
            let val = buf.get_f32_le()?;
            *v = val;
        }
        for v in &mut __struct.current {
            let val = buf.get_f32_le()?;
            *v = val;
        }
        __struct.index = buf.get_u8()?;
        Ok(__struct)
    }
    fn ser(&self, version: MavlinkVersion, bytes: &mut [u8]) -> usize {
        let mut __tmp = BytesMut::new(bytes);
        if __tmp.remaining() < Self::ENCODED_LEN {
            panic!("buffer is too small (need {} bytes, but got {})", Self::ENCODED_LEN, __tmp.remaining(),)
        }
        __tmp.put_u64_le(self.time_usec);
        for val in &self.rpm {
            __tmp.put_i32_le(*val);
        }
        for val in &self.voltage {
            __tmp.put_f32_le(*val);
        }
        for val in &self.current {
            __tmp.put_f32_le(*val);
        }
        __tmp.put_u8(self.index);
        if matches!(version, MavlinkVersion::V2) {
            let len = __tmp.len();
            ::mavlink_core::utils::remove_trailing_zeroes(&bytes[..len])
        } else {
            __tmp.len()
        }
    }
}
#[doc = "How the estimator is doing."]
#[doc = ""]
#[doc = "ID: 230"]
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(Serialize, Deserialize))]
#[cfg_attr(feature = "arbitrary", derive(Arbitrary))]
#[cfg_attr(feature = "ts-rs", derive(TS))]
#[cfg_attr(feature = "ts-rs", ts(export))]
pub struct ESTIMATOR_STATUS_DATA {
    #[doc = "Time since boot."]
    pub time_usec: u64,
    #[doc = "Velocity's innovation over its gate."]
    pub vel_ratio: f32,
    #[doc = "The horizontal position's."]
    pub pos_horiz_ratio: f32,
    #[doc = "The height's."]
    pub pos_vert_ratio: f32,
    #[doc = "The heading's."]
    pub mag_ratio: f32,
    #[doc = "Not used."]
    pub hagl_ratio: f32,
    #[doc = "Not used."]
    pub tas_ratio: f32,
    #[doc = "Standard deviation of the horizontal position."]
    pub pos_horiz_accuracy: f32,
    #[doc = "Standard deviation of the height."]
    pub pos_vert_accuracy: f32,
    #[doc = "What is known."]
    pub flags: EstimatorStatusFlags,
}
impl ESTIMATOR_STATUS_DATA {
    pub const ENCODED_LEN: usize = 42usize;
    pub const DEFAULT: Self = Self {
        time_usec: 0_u64,
        vel_ratio: 0.0_f32,
        pos_horiz_ratio: 0.0_f32,
        pos_vert_ratio: 0.0_f32,
        mag_ratio: 0.0_f32,
        hagl_ratio: 0.0_f32,
        tas_ratio: 0.0_f32,
        pos_horiz_accuracy: 0.0_f32,
        pos_vert_accuracy: 0.0_f32,
        flags: EstimatorStatusFlags::DEFAULT,
    };
    #[cfg(feature = "arbitrary")]
    pub fn random<R: rand::Rng>(rng: &mut R) -> Self {
        use arbitrary::{Arbitrary, Unstructured};
        let mut buf = [0u8; 1024];
        rng.fill_bytes(&mut buf);
        let mut unstructured = Unstructured::new(&buf);
        Self::arbitrary(&mut unstructured).unwrap_or_default()
    }
}
impl Default for ESTIMATOR_STATUS_DATA {
    fn default() -> Self {
        Self::DEFAULT.clone()
    }
}
impl MessageData for ESTIMATOR_STATUS_DATA {
    type Message = MavMessage;
    const ID: u32 = 230u32;
    const NAME: &'static str = "ESTIMATOR_STATUS";
    const EXTRA_CRC: u8 = 163u8;
    const ENCODED_LEN: usize = 42usize;
    fn deser(_version: MavlinkVersion, __input: &[u8]) -> Result<Self, ::mavlink_core::error::ParserError> {
        let avail_len = __input.len();
        let mut payload_buf;
        let mut buf = if avail_len < Self::ENCODED_LEN {
            payload_buf = [0; Self::ENCODED_LEN];
            payload_buf[0..avail_len].copy_from_slice(__input);
            Bytes::new(&payload_buf)
        } else {
            Bytes::new(__input)
        };
        let mut __struct = Self::default();
        __struct.time_usec = buf.get_u64_le()?;
        __struct.vel_ratio = buf.get_f32_le()?;
        __struct.pos_horiz_ratio = buf.get_f32_le()?;
        __struct.pos_vert_ratio = buf.get_f32_le()?;
        __struct.mag_ratio = buf.get_f32_le()?;
        __struct.hagl_ratio = buf.get_f32_le()?;
        __struct.tas_ratio = buf.get_f32_le()?;
        __struct.pos_horiz_accuracy = buf.get_f32_le()?;
        __struct.pos_vert_accuracy = buf.get_f32_le()?;
        let tmp = buf.get_u16_le()?;
        __struct.flags = EstimatorStatusFlags::from_bits_retain(tmp as <EstimatorStatusFlags as Flags>::Bits);
        Ok(__struct)
    }
    fn ser(&self, version: MavlinkVersion, bytes: &mut [u8]) -> usize {
        let mut __tmp = BytesMut::new(bytes);
        if __tmp.remaining() < Self::ENCODED_LEN {
            panic!("buffer is too small (need {} bytes, but got {})", Self::ENCODED_LEN, __tmp.remaining(),)
        }
        __tmp.put_u64_le(self.time_usec);
        __tmp.put_f32_le(self.vel_ratio);
        __tmp.put_f32_le(self.pos_horiz_ratio);
        __tmp.put_f32_le(self.pos_vert_ratio);
        __tmp.put_f32_le(self.mag_ratio);
        __tmp.put_f32_le(self.hagl_ratio);
        __tmp.put_f32_le(self.tas_ratio);
        __tmp.put_f32_le(self.pos_horiz_accuracy);
        __tmp.put_f32_le(self.pos_vert_accuracy);
        __tmp.put_u16_le(self.flags.bits() as u16);
        if matches!(version, MavlinkVersion::V2) {
            let len = __tmp.len();
            ::mavlink_core::utils::remove_trailing_zeroes(&bytes[..len])
        } else {
            __tmp.len()
        }
    }
}
#[doc = "Whether the vehicle is on the ground."]
#[doc = ""]
#[doc = "ID: 245"]
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(Serialize, Deserialize))]
#[cfg_attr(feature = "arbitrary", derive(Arbitrary))]
#[cfg_attr(feature = "ts-rs", derive(TS))]
#[cfg_attr(feature = "ts-rs", ts(export))]
pub struct EXTENDED_SYS_STATE_DATA {
    #[doc = "VTOL state."]
    pub vtol_state: MavVtolState,
    #[doc = "Landed state."]
    pub landed_state: MavLandedState,
}
impl EXTENDED_SYS_STATE_DATA {
    pub const ENCODED_LEN: usize = 2usize;
    pub const DEFAULT: Self = Self { vtol_state: MavVtolState::DEFAULT, landed_state: MavLandedState::DEFAULT };
    #[cfg(feature = "arbitrary")]
    pub fn random<R: rand::Rng>(rng: &mut R) -> Self {
        use arbitrary::{Arbitrary, Unstructured};
        let mut buf = [0u8; 1024];
        rng.fill_bytes(&mut buf);
        let mut unstructured = Unstructured::new(&buf);
        Self::arbitrary(&mut unstructured).unwrap_or_default()
    }
}
impl Default for EXTENDED_SYS_STATE_DATA {
    fn default() -> Self {
        Self::DEFAULT.clone()
    }
}
impl MessageData for EXTENDED_SYS_STATE_DATA {
    type Message = MavMessage;
    const ID: u32 = 245u32;
    const NAME: &'static str = "EXTENDED_SYS_STATE";
    const EXTRA_CRC: u8 = 130u8;
    const ENCODED_LEN: usize = 2usize;
    fn deser(_version: MavlinkVersion, __input: &[u8]) -> Result<Self, ::mavlink_core::error::ParserError> {
        let avail_len = __input.len();
        let mut payload_buf;
        let mut buf = if avail_len < Self::ENCODED_LEN {
            payload_buf = [0; Self::ENCODED_LEN];
            payload_buf[0..avail_len].copy_from_slice(__input);
            Bytes::new(&payload_buf)
        } else {
            Bytes::new(__input)
        };
        let mut __struct = Self::default();
        let tmp = buf.get_u8()?;
        __struct.vtol_state = FromPrimitive::from_u8(tmp)
            .ok_or(::mavlink_core::error::ParserError::InvalidEnum { enum_type: "MavVtolState", value: tmp as u64 })?;
        let tmp = buf.get_u8()?;
        __struct.landed_state = FromPrimitive::from_u8(tmp).ok_or(::mavlink_core::error::ParserError::InvalidEnum {
            enum_type: "MavLandedState",
            value: tmp as u64,
        })?;
        Ok(__struct)
    }
    fn ser(&self, version: MavlinkVersion, bytes: &mut [u8]) -> usize {
        let mut __tmp = BytesMut::new(bytes);
        if __tmp.remaining() < Self::ENCODED_LEN {
            panic!("buffer is too small (need {} bytes, but got {})", Self::ENCODED_LEN, __tmp.remaining(),)
        }
        __tmp.put_u8(self.vtol_state as u8);
        __tmp.put_u8(self.landed_state as u8);
        if matches!(version, MavlinkVersion::V2) {
            let len = __tmp.len();
            ::mavlink_core::utils::remove_trailing_zeroes(&bytes[..len])
        } else {
            __tmp.len()
        }
    }
}
#[doc = "A piece of a file transfer."]
#[doc = ""]
#[doc = "ID: 110"]
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(Serialize, Deserialize))]
#[cfg_attr(feature = "arbitrary", derive(Arbitrary))]
#[cfg_attr(feature = "ts-rs", derive(TS))]
#[cfg_attr(feature = "ts-rs", ts(export))]
pub struct FILE_TRANSFER_PROTOCOL_DATA {
    #[doc = "Target network."]
    pub target_network: u8,
    #[doc = "System."]
    pub target_system: u8,
    #[doc = "Component."]
    pub target_component: u8,
    #[doc = "Payload."]
    #[cfg_attr(feature = "serde", serde(with = "serde_arrays"))]
    #[cfg_attr(feature = "ts-rs", ts(type = "Array<number>"))]
    pub payload: [u8; 251],
}
impl FILE_TRANSFER_PROTOCOL_DATA {
    pub const ENCODED_LEN: usize = 254usize;
    pub const DEFAULT: Self =
        Self { target_network: 0_u8, target_system: 0_u8, target_component: 0_u8, payload: [0_u8; 251usize] };
    #[cfg(feature = "arbitrary")]
    pub fn random<R: rand::Rng>(rng: &mut R) -> Self {
        use arbitrary::{Arbitrary, Unstructured};
        let mut buf = [0u8; 1024];
        rng.fill_bytes(&mut buf);
        let mut unstructured = Unstructured::new(&buf);
        Self::arbitrary(&mut unstructured).unwrap_or_default()
    }
}
impl Default for FILE_TRANSFER_PROTOCOL_DATA {
    fn default() -> Self {
        Self::DEFAULT.clone()
    }
}
impl MessageData for FILE_TRANSFER_PROTOCOL_DATA {
    type Message = MavMessage;
    const ID: u32 = 110u32;
    const NAME: &'static str = "FILE_TRANSFER_PROTOCOL";
    const EXTRA_CRC: u8 = 84u8;
    const ENCODED_LEN: usize = 254usize;
    fn deser(_version: MavlinkVersion, __input: &[u8]) -> Result<Self, ::mavlink_core::error::ParserError> {
        let avail_len = __input.len();
        let mut payload_buf;
        let mut buf = if avail_len < Self::ENCODED_LEN {
            payload_buf = [0; Self::ENCODED_LEN];
            payload_buf[0..avail_len].copy_from_slice(__input);
            Bytes::new(&payload_buf)
        } else {
            Bytes::new(__input)
        };
        let mut __struct = Self::default();
        __struct.target_network = buf.get_u8()?;
        __struct.target_system = buf.get_u8()?;
        __struct.target_component = buf.get_u8()?;
        for v in &mut __struct.payload {
            let val = buf.get_u8()?;
            *v = val;
        }
        Ok(__struct)
    }
    fn ser(&self, version: MavlinkVersion, bytes: &mut [u8]) -> usize {
        let mut __tmp = BytesMut::new(bytes);
        if __tmp.remaining() < Self::ENCODED_LEN {
            panic!("buffer is too small (need {} bytes, but got {})", Self::ENCODED_LEN, __tmp.remaining(),)
        }
        __tmp.put_u8(self.target_network);
        __tmp.put_u8(self.target_system);
        __tmp.put_u8(self.target_component);
        for val in &self.payload {
            __tmp.put_u8(*val);
        }
        if matches!(version, MavlinkVersion::V2) {
            let len = __tmp.len();
            ::mavlink_core::utils::remove_trailing_zeroes(&bytes[..len])
        } else {
            __tmp.len()
        }
    }
}
#[doc = "Position on the globe."]
#[doc = ""]
#[doc = "ID: 33"]
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(Serialize, Deserialize))]
#[cfg_attr(feature = "arbitrary", derive(Arbitrary))]
#[cfg_attr(feature = "ts-rs", derive(TS))]
#[cfg_attr(feature = "ts-rs", ts(export))]
pub struct GLOBAL_POSITION_INT_DATA {
    #[doc = "Time since boot."]
    pub time_boot_ms: u32,
    #[doc = "Lat."]
    pub lat: i32,
    #[doc = "Lon."]
    pub lon: i32,
    #[doc = "Alt."]
    pub alt: i32,
    #[doc = "Relative alt."]
    pub relative_alt: i32,
    #[doc = "Vx."]
    pub vx: i16,
    #[doc = "Vy."]
    pub vy: i16,
    #[doc = "Vz."]
    pub vz: i16,
    #[doc = "Hdg."]
    pub hdg: u16,
}
impl GLOBAL_POSITION_INT_DATA {
    pub const ENCODED_LEN: usize = 28usize;
    pub const DEFAULT: Self = Self {
        time_boot_ms: 0_u32,
        lat: 0_i32,
        lon: 0_i32,
        alt: 0_i32,
        relative_alt: 0_i32,
        vx: 0_i16,
        vy: 0_i16,
        vz: 0_i16,
        hdg: 0_u16,
    };
    #[cfg(feature = "arbitrary")]
    pub fn random<R: rand::Rng>(rng: &mut R) -> Self {
        use arbitrary::{Arbitrary, Unstructured};
        let mut buf = [0u8; 1024];
        rng.fill_bytes(&mut buf);
        let mut unstructured = Unstructured::new(&buf);
        Self::arbitrary(&mut unstructured).unwrap_or_default()
    }
}
impl Default for GLOBAL_POSITION_INT_DATA {
    fn default() -> Self {
        Self::DEFAULT.clone()
    }
}
impl MessageData for GLOBAL_POSITION_INT_DATA {
    type Message = MavMessage;
    const ID: u32 = 33u32;
    const NAME: &'static str = "GLOBAL_POSITION_INT";
    const EXTRA_CRC: u8 = 104u8;
    const ENCODED_LEN: usize = 28usize;
    fn deser(_version: MavlinkVersion, __input: &[u8]) -> Result<Self, ::mavlink_core::error::ParserError> {
        let avail_len = __input.len();
        let mut payload_buf;
        let mut buf = if avail_len < Self::ENCODED_LEN {
            payload_buf = [0; Self::ENCODED_LEN];
            payload_buf[0..avail_len].copy_from_slice(__input);
            Bytes::new(&payload_buf)
        } else {
            Bytes::new(__input)
        };
        let mut __struct = Self::default();
        __struct.time_boot_ms = buf.get_u32_le()?;
        __struct.lat = buf.get_i32_le()?;
        __struct.lon = buf.get_i32_le()?;
        __struct.alt = buf.get_i32_le()?;
        __struct.relative_alt = buf.get_i32_le()?;
        __struct.vx = buf.get_i16_le()?;
        __struct.vy = buf.get_i16_le()?;
        __struct.vz = buf.get_i16_le()?;
        __struct.hdg = buf.get_u16_le()?;
        Ok(__struct)
    }
    fn ser(&self, version: MavlinkVersion, bytes: &mut [u8]) -> usize {
        let mut __tmp = BytesMut::new(bytes);
        if __tmp.remaining() < Self::ENCODED_LEN {
            panic!("buffer is too small (need {} bytes, but got {})", Self::ENCODED_LEN, __tmp.remaining(),)
        }
        __tmp.put_u32_le(self.time_boot_ms);
        __tmp.put_i32_le(self.lat);
        __tmp.put_i32_le(self.lon);
        __tmp.put_i32_le(self.alt);
        __tmp.put_i32_le(self.relative_alt);
        __tmp.put_i16_le(self.vx);
        __tmp.put_i16_le(self.vy);
        __tmp.put_i16_le(self.vz);
        __tmp.put_u16_le(self.hdg);
        if matches!(version, MavlinkVersion::V2) {
            let len = __tmp.len();
            ::mavlink_core::utils::remove_trailing_zeroes(&bytes[..len])
        } else {
            __tmp.len()
        }
    }
}
#[doc = "Place of the local origin."]
#[doc = ""]
#[doc = "ID: 49"]
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(Serialize, Deserialize))]
#[cfg_attr(feature = "arbitrary", derive(Arbitrary))]
#[cfg_attr(feature = "ts-rs", derive(TS))]
#[cfg_attr(feature = "ts-rs", ts(export))]
pub struct GPS_GLOBAL_ORIGIN_DATA {
    #[doc = "Latitude."]
    pub latitude: i32,
    #[doc = "Longitude."]
    pub longitude: i32,
    #[doc = "Altitude."]
    pub altitude: i32,
    #[doc = "Time since boot."]
    #[cfg_attr(feature = "serde", serde(default = "crate::utils::RustDefault::rust_default"))]
    pub time_usec: u64,
}
impl GPS_GLOBAL_ORIGIN_DATA {
    pub const ENCODED_LEN: usize = 20usize;
    pub const DEFAULT: Self = Self { latitude: 0_i32, longitude: 0_i32, altitude: 0_i32, time_usec: 0_u64 };
    #[cfg(feature = "arbitrary")]
    pub fn random<R: rand::Rng>(rng: &mut R) -> Self {
        use arbitrary::{Arbitrary, Unstructured};
        let mut buf = [0u8; 1024];
        rng.fill_bytes(&mut buf);
        let mut unstructured = Unstructured::new(&buf);
        Self::arbitrary(&mut unstructured).unwrap_or_default()
    }
}
impl Default for GPS_GLOBAL_ORIGIN_DATA {
    fn default() -> Self {
        Self::DEFAULT.clone()
    }
}
impl MessageData for GPS_GLOBAL_ORIGIN_DATA {
    type Message = MavMessage;
    const ID: u32 = 49u32;
    const NAME: &'static str = "GPS_GLOBAL_ORIGIN";
    const EXTRA_CRC: u8 = 39u8;
    const ENCODED_LEN: usize = 20usize;
    fn deser(_version: MavlinkVersion, __input: &[u8]) -> Result<Self, ::mavlink_core::error::ParserError> {
        let avail_len = __input.len();
        let mut payload_buf;
        let mut buf = if avail_len < Self::ENCODED_LEN {
            payload_buf = [0; Self::ENCODED_LEN];
            payload_buf[0..avail_len].copy_from_slice(__input);
            Bytes::new(&payload_buf)
        } else {
            Bytes::new(__input)
        };
        let mut __struct = Self::default();
        __struct.latitude = buf.get_i32_le()?;
        __struct.longitude = buf.get_i32_le()?;
        __struct.altitude = buf.get_i32_le()?;
        __struct.time_usec = buf.get_u64_le()?;
        Ok(__struct)
    }
    fn ser(&self, version: MavlinkVersion, bytes: &mut [u8]) -> usize {
        let mut __tmp = BytesMut::new(bytes);
        if __tmp.remaining() < Self::ENCODED_LEN {
            panic!("buffer is too small (need {} bytes, but got {})", Self::ENCODED_LEN, __tmp.remaining(),)
        }
        __tmp.put_i32_le(self.latitude);
        __tmp.put_i32_le(self.longitude);
        __tmp.put_i32_le(self.altitude);
        if matches!(version, MavlinkVersion::V2) {
            __tmp.put_u64_le(self.time_usec);
            let len = __tmp.len();
            ::mavlink_core::utils::remove_trailing_zeroes(&bytes[..len])
        } else {
            __tmp.len()
        }
    }
}
#[doc = "Position by the satellite receiver."]
#[doc = ""]
#[doc = "ID: 24"]
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(Serialize, Deserialize))]
#[cfg_attr(feature = "arbitrary", derive(Arbitrary))]
#[cfg_attr(feature = "ts-rs", derive(TS))]
#[cfg_attr(feature = "ts-rs", ts(export))]
pub struct GPS_RAW_INT_DATA {
    #[doc = "Time since boot."]
    pub time_usec: u64,
    #[doc = "Lat."]
    pub lat: i32,
    #[doc = "Lon."]
    pub lon: i32,
    #[doc = "Alt."]
    pub alt: i32,
    #[doc = "Eph."]
    pub eph: u16,
    #[doc = "Epv."]
    pub epv: u16,
    #[doc = "Vel."]
    pub vel: u16,
    #[doc = "Cog."]
    pub cog: u16,
    #[doc = "Fix type."]
    pub fix_type: u8,
    #[doc = "Satellites visible."]
    pub satellites_visible: u8,
    #[doc = "Alt ellipsoid."]
    #[cfg_attr(feature = "serde", serde(default = "crate::utils::RustDefault::rust_default"))]
    pub alt_ellipsoid: i32,
    #[doc = "H acc."]
    #[cfg_attr(feature = "serde", serde(default = "crate::utils::RustDefault::rust_default"))]
    pub h_acc: u32,
    #[doc = "V acc."]
    #[cfg_attr(feature = "serde", serde(default = "crate::utils::RustDefault::rust_default"))]
    pub v_acc: u32,
    #[doc = "Vel acc."]
    #[cfg_attr(feature = "serde", serde(default = "crate::utils::RustDefault::rust_default"))]
    pub vel_acc: u32,
    #[doc = "Hdg acc."]
    #[cfg_attr(feature = "serde", serde(default = "crate::utils::RustDefault::rust_default"))]
    pub hdg_acc: u32,
}
impl GPS_RAW_INT_DATA {
    pub const ENCODED_LEN: usize = 50usize;
    pub const DEFAULT: Self = Self {
        time_usec: 0_u64,
        lat: 0_i32,
        lon: 0_i32,
        alt: 0_i32,
        eph: 0_u16,
        epv: 0_u16,
        vel: 0_u16,
        cog: 0_u16,
        fix_type: 0_u8,
        satellites_visible: 0_u8,
        alt_ellipsoid: 0_i32,
        h_acc: 0_u32,
        v_acc: 0_u32,
        vel_acc: 0_u32,
        hdg_acc: 0_u32,
    };
    #[cfg(feature = "arbitrary")]
    pub fn random<R: rand::Rng>(rng: &mut R) -> Self {
        use arbitrary::{Arbitrary, Unstructured};
        let mut buf = [0u8; 1024];
        rng.fill_bytes(&mut buf);
        let mut unstructured = Unstructured::new(&buf);
        Self::arbitrary(&mut unstructured).unwrap_or_default()
    }
}
impl Default for GPS_RAW_INT_DATA {
    fn default() -> Self {
        Self::DEFAULT.clone()
    }
}
impl MessageData for GPS_RAW_INT_DATA {
    type Message = MavMessage;
    const ID: u32 = 24u32;
    const NAME: &'static str = "GPS_RAW_INT";
    const EXTRA_CRC: u8 = 24u8;
    const ENCODED_LEN: usize = 50usize;
    fn deser(_version: MavlinkVersion, __input: &[u8]) -> Result<Self, ::mavlink_core::error::ParserError> {
        let avail_len = __input.len();
        let mut payload_buf;
        let mut buf = if avail_len < Self::ENCODED_LEN {
            payload_buf = [0; Self::ENCODED_LEN];
            payload_buf[0..avail_len].copy_from_slice(__input);
            Bytes::new(&payload_buf)
        } else {
            Bytes::new(__input)
        };
        let mut __struct = Self::default();
        __struct.time_usec = buf.get_u64_le()?;
        __struct.lat = buf.get_i32_le()?;
        __struct.lon = buf.get_i32_le()?;
        __struct.alt = buf.get_i32_le()?;
        __struct.eph = buf.get_u16_le()?;
        __struct.epv = buf.get_u16_le()?;
        __struct.vel = buf.get_u16_le()?;
        __struct.cog = buf.get_u16_le()?;
        __struct.fix_type = buf.get_u8()?;
        __struct.satellites_visible = buf.get_u8()?;
        __struct.alt_ellipsoid = buf.get_i32_le()?;
        __struct.h_acc = buf.get_u32_le()?;
        __struct.v_acc = buf.get_u32_le()?;
        __struct.vel_acc = buf.get_u32_le()?;
        __struct.hdg_acc = buf.get_u32_le()?;
        Ok(__struct)
    }
    fn ser(&self, version: MavlinkVersion, bytes: &mut [u8]) -> usize {
        let mut __tmp = BytesMut::new(bytes);
        if __tmp.remaining() < Self::ENCODED_LEN {
            panic!("buffer is too small (need {} bytes, but got {})", Self::ENCODED_LEN, __tmp.remaining(),)
        }
        __tmp.put_u64_le(self.time_usec);
        __tmp.put_i32_le(self.lat);
        __tmp.put_i32_le(self.lon);
        __tmp.put_i32_le(self.alt);
        __tmp.put_u16_le(self.eph);
        __tmp.put_u16_le(self.epv);
        __tmp.put_u16_le(self.vel);
        __tmp.put_u16_le(self.cog);
        __tmp.put_u8(self.fix_type);
        __tmp.put_u8(self.satellites_visible);
        if matches!(version, MavlinkVersion::V2) {
            __tmp.put_i32_le(self.alt_ellipsoid);
            __tmp.put_u32_le(self.h_acc);
            __tmp.put_u32_le(self.v_acc);
            __tmp.put_u32_le(self.vel_acc);
            __tmp.put_u32_le(self.hdg_acc);
            let len = __tmp.len();
            ::mavlink_core::utils::remove_trailing_zeroes(&bytes[..len])
        } else {
            __tmp.len()
        }
    }
}
#[doc = "Who this is, and its mode."]
#[doc = ""]
#[doc = "ID: 0"]
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(Serialize, Deserialize))]
#[cfg_attr(feature = "arbitrary", derive(Arbitrary))]
#[cfg_attr(feature = "ts-rs", derive(TS))]
#[cfg_attr(feature = "ts-rs", ts(export))]
pub struct HEARTBEAT_DATA {
    #[doc = "Mode, in the autopilot type's coding."]
    pub custom_mode: u32,
    #[doc = "Vehicle type."]
    pub mavtype: u8,
    #[doc = "Autopilot type."]
    pub autopilot: u8,
    #[doc = "Mode flags."]
    pub base_mode: u8,
    #[doc = "State."]
    pub system_status: u8,
    #[doc = "MAVLink version."]
    pub mavlink_version: u8,
}
impl HEARTBEAT_DATA {
    pub const ENCODED_LEN: usize = 9usize;
    pub const DEFAULT: Self = Self {
        custom_mode: 0_u32,
        mavtype: 0_u8,
        autopilot: 0_u8,
        base_mode: 0_u8,
        system_status: 0_u8,
        mavlink_version: MINOR_MAVLINK_VERSION,
    };
    #[cfg(feature = "arbitrary")]
    pub fn random<R: rand::Rng>(rng: &mut R) -> Self {
        use arbitrary::{Arbitrary, Unstructured};
        let mut buf = [0u8; 1024];
        rng.fill_bytes(&mut buf);
        let mut unstructured = Unstructured::new(&buf);
        Self::arbitrary(&mut unstructured).unwrap_or_default()
    }
}
impl Default for HEARTBEAT_DATA {
    fn default() -> Self {
        Self::DEFAULT.clone()
    }
}
impl MessageData for HEARTBEAT_DATA {
    type Message = MavMessage;
    const ID: u32 = 0u32;
    const NAME: &'static str = "HEARTBEAT";
    const EXTRA_CRC: u8 = 50u8;
    const ENCODED_LEN: usize = 9usize;
    fn deser(_version: MavlinkVersion, __input: &[u8]) -> Result<Self, ::mavlink_core::error::ParserError> {
        let avail_len = __input.len();
        let mut payload_buf;
        let mut buf = if avail_len < Self::ENCODED_LEN {
            payload_buf = [0; Self::ENCODED_LEN];
            payload_buf[0..avail_len].copy_from_slice(__input);
            Bytes::new(&payload_buf)
        } else {
            Bytes::new(__input)
        };
        let mut __struct = Self::default();
        __struct.custom_mode = buf.get_u32_le()?;
        __struct.mavtype = buf.get_u8()?;
        __struct.autopilot = buf.get_u8()?;
        __struct.base_mode = buf.get_u8()?;
        __struct.system_status = buf.get_u8()?;
        __struct.mavlink_version = buf.get_u8()?;
        Ok(__struct)
    }
    fn ser(&self, version: MavlinkVersion, bytes: &mut [u8]) -> usize {
        let mut __tmp = BytesMut::new(bytes);
        if __tmp.remaining() < Self::ENCODED_LEN {
            panic!("buffer is too small (need {} bytes, but got {})", Self::ENCODED_LEN, __tmp.remaining(),)
        }
        __tmp.put_u32_le(self.custom_mode);
        __tmp.put_u8(self.mavtype);
        __tmp.put_u8(self.autopilot);
        __tmp.put_u8(self.base_mode);
        __tmp.put_u8(self.system_status);
        __tmp.put_u8(self.mavlink_version);
        if matches!(version, MavlinkVersion::V2) {
            let len = __tmp.len();
            ::mavlink_core::utils::remove_trailing_zeroes(&bytes[..len])
        } else {
            __tmp.len()
        }
    }
}
#[doc = "Sensors in SI units."]
#[doc = ""]
#[doc = "ID: 105"]
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(Serialize, Deserialize))]
#[cfg_attr(feature = "arbitrary", derive(Arbitrary))]
#[cfg_attr(feature = "ts-rs", derive(TS))]
#[cfg_attr(feature = "ts-rs", ts(export))]
pub struct HIGHRES_IMU_DATA {
    #[doc = "Time since boot."]
    pub time_usec: u64,
    #[doc = "Xacc."]
    pub xacc: f32,
    #[doc = "Yacc."]
    pub yacc: f32,
    #[doc = "Zacc."]
    pub zacc: f32,
    #[doc = "Xgyro."]
    pub xgyro: f32,
    #[doc = "Ygyro."]
    pub ygyro: f32,
    #[doc = "Zgyro."]
    pub zgyro: f32,
    #[doc = "Xmag."]
    pub xmag: f32,
    #[doc = "Ymag."]
    pub ymag: f32,
    #[doc = "Zmag."]
    pub zmag: f32,
    #[doc = "Abs pressure."]
    pub abs_pressure: f32,
    #[doc = "Diff pressure."]
    pub diff_pressure: f32,
    #[doc = "Pressure alt."]
    pub pressure_alt: f32,
    #[doc = "Temperature."]
    pub temperature: f32,
    #[doc = "Fields updated."]
    pub fields_updated: u16,
}
impl HIGHRES_IMU_DATA {
    pub const ENCODED_LEN: usize = 62usize;
    pub const DEFAULT: Self = Self {
        time_usec: 0_u64,
        xacc: 0.0_f32,
        yacc: 0.0_f32,
        zacc: 0.0_f32,
        xgyro: 0.0_f32,
        ygyro: 0.0_f32,
        zgyro: 0.0_f32,
        xmag: 0.0_f32,
        ymag: 0.0_f32,
        zmag: 0.0_f32,
        abs_pressure: 0.0_f32,
        diff_pressure: 0.0_f32,
        pressure_alt: 0.0_f32,
        temperature: 0.0_f32,
        fields_updated: 0_u16,
    };
    #[cfg(feature = "arbitrary")]
    pub fn random<R: rand::Rng>(rng: &mut R) -> Self {
        use arbitrary::{Arbitrary, Unstructured};
        let mut buf = [0u8; 1024];
        rng.fill_bytes(&mut buf);
        let mut unstructured = Unstructured::new(&buf);
        Self::arbitrary(&mut unstructured).unwrap_or_default()
    }
}
impl Default for HIGHRES_IMU_DATA {
    fn default() -> Self {
        Self::DEFAULT.clone()
    }
}
impl MessageData for HIGHRES_IMU_DATA {
    type Message = MavMessage;
    const ID: u32 = 105u32;
    const NAME: &'static str = "HIGHRES_IMU";
    const EXTRA_CRC: u8 = 93u8;
    const ENCODED_LEN: usize = 62usize;
    fn deser(_version: MavlinkVersion, __input: &[u8]) -> Result<Self, ::mavlink_core::error::ParserError> {
        let avail_len = __input.len();
        let mut payload_buf;
        let mut buf = if avail_len < Self::ENCODED_LEN {
            payload_buf = [0; Self::ENCODED_LEN];
            payload_buf[0..avail_len].copy_from_slice(__input);
            Bytes::new(&payload_buf)
        } else {
            Bytes::new(__input)
        };
        let mut __struct = Self::default();
        __struct.time_usec = buf.get_u64_le()?;
        __struct.xacc = buf.get_f32_le()?;
        __struct.yacc = buf.get_f32_le()?;
        __struct.zacc = buf.get_f32_le()?;
        __struct.xgyro = buf.get_f32_le()?;
        __struct.ygyro = buf.get_f32_le()?;
        __struct.zgyro = buf.get_f32_le()?;
        __struct.xmag = buf.get_f32_le()?;
        __struct.ymag = buf.get_f32_le()?;
        __struct.zmag = buf.get_f32_le()?;
        __struct.abs_pressure = buf.get_f32_le()?;
        __struct.diff_pressure = buf.get_f32_le()?;
        __struct.pressure_alt = buf.get_f32_le()?;
        __struct.temperature = buf.get_f32_le()?;
        __struct.fields_updated = buf.get_u16_le()?;
        Ok(__struct)
    }
    fn ser(&self, version: MavlinkVersion, bytes: &mut [u8]) -> usize {
        let mut __tmp = BytesMut::new(bytes);
        if __tmp.remaining() < Self::ENCODED_LEN {
            panic!("buffer is too small (need {} bytes, but got {})", Self::ENCODED_LEN, __tmp.remaining(),)
        }
        __tmp.put_u64_le(self.time_usec);
        __tmp.put_f32_le(self.xacc);
        __tmp.put_f32_le(self.yacc);
        __tmp.put_f32_le(self.zacc);
        __tmp.put_f32_le(self.xgyro);
        __tmp.put_f32_le(self.ygyro);
        __tmp.put_f32_le(self.zgyro);
        __tmp.put_f32_le(self.xmag);
        __tmp.put_f32_le(self.ymag);
        __tmp.put_f32_le(self.zmag);
        __tmp.put_f32_le(self.abs_pressure);
        __tmp.put_f32_le(self.diff_pressure);
        __tmp.put_f32_le(self.pressure_alt);
        __tmp.put_f32_le(self.temperature);
        __tmp.put_u16_le(self.fields_updated);
        if matches!(version, MavlinkVersion::V2) {
            let len = __tmp.len();
            ::mavlink_core::utils::remove_trailing_zeroes(&bytes[..len])
        } else {
            __tmp.len()
        }
    }
}
#[doc = "The true motion of a simulated vehicle."]
#[doc = ""]
#[doc = "ID: 115"]
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(Serialize, Deserialize))]
#[cfg_attr(feature = "arbitrary", derive(Arbitrary))]
#[cfg_attr(feature = "ts-rs", derive(TS))]
#[cfg_attr(feature = "ts-rs", ts(export))]
pub struct HIL_STATE_QUATERNION_DATA {
    #[doc = "Time since boot."]
    pub time_usec: u64,
    #[doc = "Attitude quaternion."]
    #[cfg_attr(feature = "serde", serde(with = "serde_arrays"))]
    #[cfg_attr(feature = "ts-rs", ts(type = "Array<number>"))]
    pub attitude_quaternion: [f32; 4],
    #[doc = "Rollspeed."]
    pub rollspeed: f32,
    #[doc = "Pitchspeed."]
    pub pitchspeed: f32,
    #[doc = "Yawspeed."]
    pub yawspeed: f32,
    #[doc = "Lat."]
    pub lat: i32,
    #[doc = "Lon."]
    pub lon: i32,
    #[doc = "Alt."]
    pub alt: i32,
    #[doc = "Vx."]
    pub vx: i16,
    #[doc = "Vy."]
    pub vy: i16,
    #[doc = "Vz."]
    pub vz: i16,
    #[doc = "Ind airspeed."]
    pub ind_airspeed: u16,
    #[doc = "True airspeed."]
    pub true_airspeed: u16,
    #[doc = "Xacc."]
    pub xacc: i16,
    #[doc = "Yacc."]
    pub yacc: i16,
    #[doc = "Zacc."]
    pub zacc: i16,
}
impl HIL_STATE_QUATERNION_DATA {
    pub const ENCODED_LEN: usize = 64usize;
    pub const DEFAULT: Self = Self {
        time_usec: 0_u64,
        attitude_quaternion: [0.0_f32; 4usize],
        rollspeed: 0.0_f32,
        pitchspeed: 0.0_f32,
        yawspeed: 0.0_f32,
        lat: 0_i32,
        lon: 0_i32,
        alt: 0_i32,
        vx: 0_i16,
        vy: 0_i16,
        vz: 0_i16,
        ind_airspeed: 0_u16,
        true_airspeed: 0_u16,
        xacc: 0_i16,
        yacc: 0_i16,
        zacc: 0_i16,
    };
    #[cfg(feature = "arbitrary")]
    pub fn random<R: rand::Rng>(rng: &mut R) -> Self {
        use arbitrary::{Arbitrary, Unstructured};
        let mut buf = [0u8; 1024];
        rng.fill_bytes(&mut buf);
        let mut unstructured = Unstructured::new(&buf);
        Self::arbitrary(&mut unstructured).unwrap_or_default()
    }
}
impl Default for HIL_STATE_QUATERNION_DATA {
    fn default() -> Self {
        Self::DEFAULT.clone()
    }
}
impl MessageData for HIL_STATE_QUATERNION_DATA {
    type Message = MavMessage;
    const ID: u32 = 115u32;
    const NAME: &'static str = "HIL_STATE_QUATERNION";
    const EXTRA_CRC: u8 = 4u8;
    const ENCODED_LEN: usize = 64usize;
    fn deser(_version: MavlinkVersion, __input: &[u8]) -> Result<Self, ::mavlink_core::error::ParserError> {
        let avail_len = __input.len();
        let mut payload_buf;
        let mut buf = if avail_len < Self::ENCODED_LEN {
            payload_buf = [0; Self::ENCODED_LEN];
            payload_buf[0..avail_len].copy_from_slice(__input);
            Bytes::new(&payload_buf)
        } else {
            Bytes::new(__input)
        };
        let mut __struct = Self::default();
        __struct.time_usec = buf.get_u64_le()?;
        for v in &mut __struct.attitude_quaternion {
            let val = buf.get_f32_le()?;
            *v = val;
        }
        __struct.rollspeed = buf.get_f32_le()?;
        __struct.pitchspeed = buf.get_f32_le()?;
        __struct.yawspeed = buf.get_f32_le()?;
        __struct.lat = buf.get_i32_le()?;
        __struct.lon = buf.get_i32_le()?;
        __struct.alt = buf.get_i32_le()?;
        __struct.vx = buf.get_i16_le()?;
        __struct.vy = buf.get_i16_le()?;
        __struct.vz = buf.get_i16_le()?;
        __struct.ind_airspeed = buf.get_u16_le()?;
        __struct.true_airspeed = buf.get_u16_le()?;
        __struct.xacc = buf.get_i16_le()?;
        __struct.yacc = buf.get_i16_le()?;
        __struct.zacc = buf.get_i16_le()?;
        Ok(__struct)
    }
    fn ser(&self, version: MavlinkVersion, bytes: &mut [u8]) -> usize {
        let mut __tmp = BytesMut::new(bytes);
        if __tmp.remaining() < Self::ENCODED_LEN {
            panic!("buffer is too small (need {} bytes, but got {})", Self::ENCODED_LEN, __tmp.remaining(),)
        }
        __tmp.put_u64_le(self.time_usec);
        for val in &self.attitude_quaternion {
            __tmp.put_f32_le(*val);
        }
        __tmp.put_f32_le(self.rollspeed);
        __tmp.put_f32_le(self.pitchspeed);
        __tmp.put_f32_le(self.yawspeed);
        __tmp.put_i32_le(self.lat);
        __tmp.put_i32_le(self.lon);
        __tmp.put_i32_le(self.alt);
        __tmp.put_i16_le(self.vx);
        __tmp.put_i16_le(self.vy);
        __tmp.put_i16_le(self.vz);
        __tmp.put_u16_le(self.ind_airspeed);
        __tmp.put_u16_le(self.true_airspeed);
        __tmp.put_i16_le(self.xacc);
        __tmp.put_i16_le(self.yacc);
        __tmp.put_i16_le(self.zacc);
        if matches!(version, MavlinkVersion::V2) {
            let len = __tmp.len();
            ::mavlink_core::utils::remove_trailing_zeroes(&bytes[..len])
        } else {
            __tmp.len()
        }
    }
}
#[doc = "Where the vehicle returns to."]
#[doc = ""]
#[doc = "ID: 242"]
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(Serialize, Deserialize))]
#[cfg_attr(feature = "arbitrary", derive(Arbitrary))]
#[cfg_attr(feature = "ts-rs", derive(TS))]
#[cfg_attr(feature = "ts-rs", ts(export))]
pub struct HOME_POSITION_DATA {
    #[doc = "Latitude."]
    pub latitude: i32,
    #[doc = "Longitude."]
    pub longitude: i32,
    #[doc = "Altitude."]
    pub altitude: i32,
    #[doc = "X."]
    pub x: f32,
    #[doc = "Y."]
    pub y: f32,
    #[doc = "Z."]
    pub z: f32,
    #[doc = "Q."]
    #[cfg_attr(feature = "serde", serde(with = "serde_arrays"))]
    #[cfg_attr(feature = "ts-rs", ts(type = "Array<number>"))]
    pub q: [f32; 4],
    #[doc = "Approach x."]
    pub approach_x: f32,
    #[doc = "Approach y."]
    pub approach_y: f32,
    #[doc = "Approach z."]
    pub approach_z: f32,
    #[doc = "Time since boot."]
    #[cfg_attr(feature = "serde", serde(default = "crate::utils::RustDefault::rust_default"))]
    pub time_usec: u64,
}
impl HOME_POSITION_DATA {
    pub const ENCODED_LEN: usize = 60usize;
    pub const DEFAULT: Self = Self {
        latitude: 0_i32,
        longitude: 0_i32,
        altitude: 0_i32,
        x: 0.0_f32,
        y: 0.0_f32,
        z: 0.0_f32,
        q: [0.0_f32; 4usize],
        approach_x: 0.0_f32,
        approach_y: 0.0_f32,
        approach_z: 0.0_f32,
        time_usec: 0_u64,
    };
    #[cfg(feature = "arbitrary")]
    pub fn random<R: rand::Rng>(rng: &mut R) -> Self {
        use arbitrary::{Arbitrary, Unstructured};
        let mut buf = [0u8; 1024];
        rng.fill_bytes(&mut buf);
        let mut unstructured = Unstructured::new(&buf);
        Self::arbitrary(&mut unstructured).unwrap_or_default()
    }
}
impl Default for HOME_POSITION_DATA {
    fn default() -> Self {
        Self::DEFAULT.clone()
    }
}
impl MessageData for HOME_POSITION_DATA {
    type Message = MavMessage;
    const ID: u32 = 242u32;
    const NAME: &'static str = "HOME_POSITION";
    const EXTRA_CRC: u8 = 104u8;
    const ENCODED_LEN: usize = 60usize;
    fn deser(_version: MavlinkVersion, __input: &[u8]) -> Result<Self, ::mavlink_core::error::ParserError> {
        let avail_len = __input.len();
        let mut payload_buf;
        let mut buf = if avail_len < Self::ENCODED_LEN {
            payload_buf = [0; Self::ENCODED_LEN];
            payload_buf[0..avail_len].copy_from_slice(__input);
            Bytes::new(&payload_buf)
        } else {
            Bytes::new(__input)
        };
        let mut __struct = Self::default();
        __struct.latitude = buf.get_i32_le()?;
        __struct.longitude = buf.get_i32_le()?;
        __struct.altitude = buf.get_i32_le()?;
        __struct.x = buf.get_f32_le()?;
        __struct.y = buf.get_f32_le()?;
        __struct.z = buf.get_f32_le()?;
        for v in &mut __struct.q {
            let val = buf.get_f32_le()?;
            *v = val;
        }
        __struct.approach_x = buf.get_f32_le()?;
        __struct.approach_y = buf.get_f32_le()?;
        __struct.approach_z = buf.get_f32_le()?;
        __struct.time_usec = buf.get_u64_le()?;
        Ok(__struct)
    }
    fn ser(&self, version: MavlinkVersion, bytes: &mut [u8]) -> usize {
        let mut __tmp = BytesMut::new(bytes);
        if __tmp.remaining() < Self::ENCODED_LEN {
            panic!("buffer is too small (need {} bytes, but got {})", Self::ENCODED_LEN, __tmp.remaining(),)
        }
        __tmp.put_i32_le(self.latitude);
        __tmp.put_i32_le(self.longitude);
        __tmp.put_i32_le(self.altitude);
        __tmp.put_f32_le(self.x);
        __tmp.put_f32_le(self.y);
        __tmp.put_f32_le(self.z);
        for val in &self.q {
            __tmp.put_f32_le(*val);
        }
        __tmp.put_f32_le(self.approach_x);
        __tmp.put_f32_le(self.approach_y);
        __tmp.put_f32_le(self.approach_z);
        if matches!(version, MavlinkVersion::V2) {
            __tmp.put_u64_le(self.time_usec);
            let len = __tmp.len();
            ::mavlink_core::utils::remove_trailing_zeroes(&bytes[..len])
        } else {
            __tmp.len()
        }
    }
}
#[doc = "Position and velocity, NED."]
#[doc = ""]
#[doc = "ID: 32"]
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(Serialize, Deserialize))]
#[cfg_attr(feature = "arbitrary", derive(Arbitrary))]
#[cfg_attr(feature = "ts-rs", derive(TS))]
#[cfg_attr(feature = "ts-rs", ts(export))]
pub struct LOCAL_POSITION_NED_DATA {
    #[doc = "Time since boot."]
    pub time_boot_ms: u32,
    #[doc = "North."]
    pub x: f32,
    #[doc = "East."]
    pub y: f32,
    #[doc = "Down."]
    pub z: f32,
    #[doc = "North."]
    pub vx: f32,
    #[doc = "East."]
    pub vy: f32,
    #[doc = "Down."]
    pub vz: f32,
}
impl LOCAL_POSITION_NED_DATA {
    pub const ENCODED_LEN: usize = 28usize;
    pub const DEFAULT: Self =
        Self { time_boot_ms: 0_u32, x: 0.0_f32, y: 0.0_f32, z: 0.0_f32, vx: 0.0_f32, vy: 0.0_f32, vz: 0.0_f32 };
    #[cfg(feature = "arbitrary")]
    pub fn random<R: rand::Rng>(rng: &mut R) -> Self {
        use arbitrary::{Arbitrary, Unstructured};
        let mut buf = [0u8; 1024];
        rng.fill_bytes(&mut buf);
        let mut unstructured = Unstructured::new(&buf);
        Self::arbitrary(&mut unstructured).unwrap_or_default()
    }
}
impl Default for LOCAL_POSITION_NED_DATA {
    fn default() -> Self {
        Self::DEFAULT.clone()
    }
}
impl MessageData for LOCAL_POSITION_NED_DATA {
    type Message = MavMessage;
    const ID: u32 = 32u32;
    const NAME: &'static str = "LOCAL_POSITION_NED";
    const EXTRA_CRC: u8 = 185u8;
    const ENCODED_LEN: usize = 28usize;
    fn deser(_version: MavlinkVersion, __input: &[u8]) -> Result<Self, ::mavlink_core::error::ParserError> {
        let avail_len = __input.len();
        let mut payload_buf;
        let mut buf = if avail_len < Self::ENCODED_LEN {
            payload_buf = [0; Self::ENCODED_LEN];
            payload_buf[0..avail_len].copy_from_slice(__input);
            Bytes::new(&payload_buf)
        } else {
            Bytes::new(__input)
        };
        let mut __struct = Self::default();
        __struct.time_boot_ms = buf.get_u32_le()?;
        __struct.x = buf.get_f32_le()?;
        __struct.y = buf.get_f32_le()?;
        __struct.z = buf.get_f32_le()?;
        __struct.vx = buf.get_f32_le()?;
        __struct.vy = buf.get_f32_le()?;
        __struct.vz = buf.get_f32_le()?;
        Ok(__struct)
    }
    fn ser(&self, version: MavlinkVersion, bytes: &mut [u8]) -> usize {
        let mut __tmp = BytesMut::new(bytes);
        if __tmp.remaining() < Self::ENCODED_LEN {
            panic!("buffer is too small (need {} bytes, but got {})", Self::ENCODED_LEN, __tmp.remaining(),)
        }
        __tmp.put_u32_le(self.time_boot_ms);
        __tmp.put_f32_le(self.x);
        __tmp.put_f32_le(self.y);
        __tmp.put_f32_le(self.z);
        __tmp.put_f32_le(self.vx);
        __tmp.put_f32_le(self.vy);
        __tmp.put_f32_le(self.vz);
        if matches!(version, MavlinkVersion::V2) {
            let len = __tmp.len();
            ::mavlink_core::utils::remove_trailing_zeroes(&bytes[..len])
        } else {
            __tmp.len()
        }
    }
}
#[doc = "A log."]
#[doc = ""]
#[doc = "ID: 118"]
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(Serialize, Deserialize))]
#[cfg_attr(feature = "arbitrary", derive(Arbitrary))]
#[cfg_attr(feature = "ts-rs", derive(TS))]
#[cfg_attr(feature = "ts-rs", ts(export))]
pub struct LOG_ENTRY_DATA {
    #[doc = "Time utc."]
    pub time_utc: u32,
    #[doc = "Size."]
    pub size: u32,
    #[doc = "Id."]
    pub id: u16,
    #[doc = "Num logs."]
    pub num_logs: u16,
    #[doc = "Last log num."]
    pub last_log_num: u16,
}
impl LOG_ENTRY_DATA {
    pub const ENCODED_LEN: usize = 14usize;
    pub const DEFAULT: Self = Self { time_utc: 0_u32, size: 0_u32, id: 0_u16, num_logs: 0_u16, last_log_num: 0_u16 };
    #[cfg(feature = "arbitrary")]
    pub fn random<R: rand::Rng>(rng: &mut R) -> Self {
        use arbitrary::{Arbitrary, Unstructured};
        let mut buf = [0u8; 1024];
        rng.fill_bytes(&mut buf);
        let mut unstructured = Unstructured::new(&buf);
        Self::arbitrary(&mut unstructured).unwrap_or_default()
    }
}
impl Default for LOG_ENTRY_DATA {
    fn default() -> Self {
        Self::DEFAULT.clone()
    }
}
impl MessageData for LOG_ENTRY_DATA {
    type Message = MavMessage;
    const ID: u32 = 118u32;
    const NAME: &'static str = "LOG_ENTRY";
    const EXTRA_CRC: u8 = 56u8;
    const ENCODED_LEN: usize = 14usize;
    fn deser(_version: MavlinkVersion, __input: &[u8]) -> Result<Self, ::mavlink_core::error::ParserError> {
        let avail_len = __input.len();
        let mut payload_buf;
        let mut buf = if avail_len < Self::ENCODED_LEN {
            payload_buf = [0; Self::ENCODED_LEN];
            payload_buf[0..avail_len].copy_from_slice(__input);
            Bytes::new(&payload_buf)
        } else {
            Bytes::new(__input)
        };
        let mut __struct = Self::default();
        __struct.time_utc = buf.get_u32_le()?;
        __struct.size = buf.get_u32_le()?;
        __struct.id = buf.get_u16_le()?;
        __struct.num_logs = buf.get_u16_le()?;
        __struct.last_log_num = buf.get_u16_le()?;
        Ok(__struct)
    }
    fn ser(&self, version: MavlinkVersion, bytes: &mut [u8]) -> usize {
        let mut __tmp = BytesMut::new(bytes);
        if __tmp.remaining() < Self::ENCODED_LEN {
            panic!("buffer is too small (need {} bytes, but got {})", Self::ENCODED_LEN, __tmp.remaining(),)
        }
        __tmp.put_u32_le(self.time_utc);
        __tmp.put_u32_le(self.size);
        __tmp.put_u16_le(self.id);
        __tmp.put_u16_le(self.num_logs);
        __tmp.put_u16_le(self.last_log_num);
        if matches!(version, MavlinkVersion::V2) {
            let len = __tmp.len();
            ::mavlink_core::utils::remove_trailing_zeroes(&bytes[..len])
        } else {
            __tmp.len()
        }
    }
}
#[doc = "Asks to erase all logs."]
#[doc = ""]
#[doc = "ID: 121"]
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(Serialize, Deserialize))]
#[cfg_attr(feature = "arbitrary", derive(Arbitrary))]
#[cfg_attr(feature = "ts-rs", derive(TS))]
#[cfg_attr(feature = "ts-rs", ts(export))]
pub struct LOG_ERASE_DATA {
    #[doc = "System."]
    pub target_system: u8,
    #[doc = "Component."]
    pub target_component: u8,
}
impl LOG_ERASE_DATA {
    pub const ENCODED_LEN: usize = 2usize;
    pub const DEFAULT: Self = Self { target_system: 0_u8, target_component: 0_u8 };
    #[cfg(feature = "arbitrary")]
    pub fn random<R: rand::Rng>(rng: &mut R) -> Self {
        use arbitrary::{Arbitrary, Unstructured};
        let mut buf = [0u8; 1024];
        rng.fill_bytes(&mut buf);
        let mut unstructured = Unstructured::new(&buf);
        Self::arbitrary(&mut unstructured).unwrap_or_default()
    }
}
impl Default for LOG_ERASE_DATA {
    fn default() -> Self {
        Self::DEFAULT.clone()
    }
}
impl MessageData for LOG_ERASE_DATA {
    type Message = MavMessage;
    const ID: u32 = 121u32;
    const NAME: &'static str = "LOG_ERASE";
    const EXTRA_CRC: u8 = 237u8;
    const ENCODED_LEN: usize = 2usize;
    fn deser(_version: MavlinkVersion, __input: &[u8]) -> Result<Self, ::mavlink_core::error::ParserError> {
        let avail_len = __input.len();
        let mut payload_buf;
        let mut buf = if avail_len < Self::ENCODED_LEN {
            payload_buf = [0; Self::ENCODED_LEN];
            payload_buf[0..avail_len].copy_from_slice(__input);
            Bytes::new(&payload_buf)
        } else {
            Bytes::new(__input)
        };
        let mut __struct = Self::default();
        __struct.target_system = buf.get_u8()?;
        __struct.target_component = buf.get_u8()?;
        Ok(__struct)
    }
    fn ser(&self, version: MavlinkVersion, bytes: &mut [u8]) -> usize {
        let mut __tmp = BytesMut::new(bytes);
        if __tmp.remaining() < Self::ENCODED_LEN {
            panic!("buffer is too small (need {} bytes, but got {})", Self::ENCODED_LEN, __tmp.remaining(),)
        }
        __tmp.put_u8(self.target_system);
        __tmp.put_u8(self.target_component);
        if matches!(version, MavlinkVersion::V2) {
            let len = __tmp.len();
            ::mavlink_core::utils::remove_trailing_zeroes(&bytes[..len])
        } else {
            __tmp.len()
        }
    }
}
#[doc = "Asks for a piece of a log."]
#[doc = ""]
#[doc = "ID: 119"]
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(Serialize, Deserialize))]
#[cfg_attr(feature = "arbitrary", derive(Arbitrary))]
#[cfg_attr(feature = "ts-rs", derive(TS))]
#[cfg_attr(feature = "ts-rs", ts(export))]
pub struct LOG_REQUEST_DATA_DATA {
    #[doc = "Ofs."]
    pub ofs: u32,
    #[doc = "Count."]
    pub count: u32,
    #[doc = "Id."]
    pub id: u16,
    #[doc = "System."]
    pub target_system: u8,
    #[doc = "Component."]
    pub target_component: u8,
}
impl LOG_REQUEST_DATA_DATA {
    pub const ENCODED_LEN: usize = 12usize;
    pub const DEFAULT: Self = Self { ofs: 0_u32, count: 0_u32, id: 0_u16, target_system: 0_u8, target_component: 0_u8 };
    #[cfg(feature = "arbitrary")]
    pub fn random<R: rand::Rng>(rng: &mut R) -> Self {
        use arbitrary::{Arbitrary, Unstructured};
        let mut buf = [0u8; 1024];
        rng.fill_bytes(&mut buf);
        let mut unstructured = Unstructured::new(&buf);
        Self::arbitrary(&mut unstructured).unwrap_or_default()
    }
}
impl Default for LOG_REQUEST_DATA_DATA {
    fn default() -> Self {
        Self::DEFAULT.clone()
    }
}
impl MessageData for LOG_REQUEST_DATA_DATA {
    type Message = MavMessage;
    const ID: u32 = 119u32;
    const NAME: &'static str = "LOG_REQUEST_DATA";
    const EXTRA_CRC: u8 = 116u8;
    const ENCODED_LEN: usize = 12usize;
    fn deser(_version: MavlinkVersion, __input: &[u8]) -> Result<Self, ::mavlink_core::error::ParserError> {
        let avail_len = __input.len();
        let mut payload_buf;
        let mut buf = if avail_len < Self::ENCODED_LEN {
            payload_buf = [0; Self::ENCODED_LEN];
            payload_buf[0..avail_len].copy_from_slice(__input);
            Bytes::new(&payload_buf)
        } else {
            Bytes::new(__input)
        };
        let mut __struct = Self::default();
        __struct.ofs = buf.get_u32_le()?;
        __struct.count = buf.get_u32_le()?;
        __struct.id = buf.get_u16_le()?;
        __struct.target_system = buf.get_u8()?;
        __struct.target_component = buf.get_u8()?;
        Ok(__struct)
    }
    fn ser(&self, version: MavlinkVersion, bytes: &mut [u8]) -> usize {
        let mut __tmp = BytesMut::new(bytes);
        if __tmp.remaining() < Self::ENCODED_LEN {
            panic!("buffer is too small (need {} bytes, but got {})", Self::ENCODED_LEN, __tmp.remaining(),)
        }
        __tmp.put_u32_le(self.ofs);
        __tmp.put_u32_le(self.count);
        __tmp.put_u16_le(self.id);
        __tmp.put_u8(self.target_system);
        __tmp.put_u8(self.target_component);
        if matches!(version, MavlinkVersion::V2) {
            let len = __tmp.len();
            ::mavlink_core::utils::remove_trailing_zeroes(&bytes[..len])
        } else {
            __tmp.len()
        }
    }
}
#[doc = "Ends a log transfer."]
#[doc = ""]
#[doc = "ID: 122"]
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(Serialize, Deserialize))]
#[cfg_attr(feature = "arbitrary", derive(Arbitrary))]
#[cfg_attr(feature = "ts-rs", derive(TS))]
#[cfg_attr(feature = "ts-rs", ts(export))]
pub struct LOG_REQUEST_END_DATA {
    #[doc = "System."]
    pub target_system: u8,
    #[doc = "Component."]
    pub target_component: u8,
}
impl LOG_REQUEST_END_DATA {
    pub const ENCODED_LEN: usize = 2usize;
    pub const DEFAULT: Self = Self { target_system: 0_u8, target_component: 0_u8 };
    #[cfg(feature = "arbitrary")]
    pub fn random<R: rand::Rng>(rng: &mut R) -> Self {
        use arbitrary::{Arbitrary, Unstructured};
        let mut buf = [0u8; 1024];
        rng.fill_bytes(&mut buf);
        let mut unstructured = Unstructured::new(&buf);
        Self::arbitrary(&mut unstructured).unwrap_or_default()
    }
}
impl Default for LOG_REQUEST_END_DATA {
    fn default() -> Self {
        Self::DEFAULT.clone()
    }
}
impl MessageData for LOG_REQUEST_END_DATA {
    type Message = MavMessage;
    const ID: u32 = 122u32;
    const NAME: &'static str = "LOG_REQUEST_END";
    const EXTRA_CRC: u8 = 203u8;
    const ENCODED_LEN: usize = 2usize;
    fn deser(_version: MavlinkVersion, __input: &[u8]) -> Result<Self, ::mavlink_core::error::ParserError> {
        let avail_len = __input.len();
        let mut payload_buf;
        let mut buf = if avail_len < Self::ENCODED_LEN {
            payload_buf = [0; Self::ENCODED_LEN];
            payload_buf[0..avail_len].copy_from_slice(__input);
            Bytes::new(&payload_buf)
        } else {
            Bytes::new(__input)
        };
        let mut __struct = Self::default();
        __struct.target_system = buf.get_u8()?;
        __struct.target_component = buf.get_u8()?;
        Ok(__struct)
    }
    fn ser(&self, version: MavlinkVersion, bytes: &mut [u8]) -> usize {
        let mut __tmp = BytesMut::new(bytes);
        if __tmp.remaining() < Self::ENCODED_LEN {
            panic!("buffer is too small (need {} bytes, but got {})", Self::ENCODED_LEN, __tmp.remaining(),)
        }
        __tmp.put_u8(self.target_system);
        __tmp.put_u8(self.target_component);
        if matches!(version, MavlinkVersion::V2) {
            let len = __tmp.len();
            ::mavlink_core::utils::remove_trailing_zeroes(&bytes[..len])
        } else {
            __tmp.len()
        }
    }
}
#[doc = "Asks for the list of logs."]
#[doc = ""]
#[doc = "ID: 117"]
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(Serialize, Deserialize))]
#[cfg_attr(feature = "arbitrary", derive(Arbitrary))]
#[cfg_attr(feature = "ts-rs", derive(TS))]
#[cfg_attr(feature = "ts-rs", ts(export))]
pub struct LOG_REQUEST_LIST_DATA {
    #[doc = "Start."]
    pub start: u16,
    #[doc = "End."]
    pub end: u16,
    #[doc = "System."]
    pub target_system: u8,
    #[doc = "Component."]
    pub target_component: u8,
}
impl LOG_REQUEST_LIST_DATA {
    pub const ENCODED_LEN: usize = 6usize;
    pub const DEFAULT: Self = Self { start: 0_u16, end: 0_u16, target_system: 0_u8, target_component: 0_u8 };
    #[cfg(feature = "arbitrary")]
    pub fn random<R: rand::Rng>(rng: &mut R) -> Self {
        use arbitrary::{Arbitrary, Unstructured};
        let mut buf = [0u8; 1024];
        rng.fill_bytes(&mut buf);
        let mut unstructured = Unstructured::new(&buf);
        Self::arbitrary(&mut unstructured).unwrap_or_default()
    }
}
impl Default for LOG_REQUEST_LIST_DATA {
    fn default() -> Self {
        Self::DEFAULT.clone()
    }
}
impl MessageData for LOG_REQUEST_LIST_DATA {
    type Message = MavMessage;
    const ID: u32 = 117u32;
    const NAME: &'static str = "LOG_REQUEST_LIST";
    const EXTRA_CRC: u8 = 128u8;
    const ENCODED_LEN: usize = 6usize;
    fn deser(_version: MavlinkVersion, __input: &[u8]) -> Result<Self, ::mavlink_core::error::ParserError> {
        let avail_len = __input.len();
        let mut payload_buf;
        let mut buf = if avail_len < Self::ENCODED_LEN {
            payload_buf = [0; Self::ENCODED_LEN];
            payload_buf[0..avail_len].copy_from_slice(__input);
            Bytes::new(&payload_buf)
        } else {
            Bytes::new(__input)
        };
        let mut __struct = Self::default();
        __struct.start = buf.get_u16_le()?;
        __struct.end = buf.get_u16_le()?;
        __struct.target_system = buf.get_u8()?;
        __struct.target_component = buf.get_u8()?;
        Ok(__struct)
    }
    fn ser(&self, version: MavlinkVersion, bytes: &mut [u8]) -> usize {
        let mut __tmp = BytesMut::new(bytes);
        if __tmp.remaining() < Self::ENCODED_LEN {
            panic!("buffer is too small (need {} bytes, but got {})", Self::ENCODED_LEN, __tmp.remaining(),)
        }
        __tmp.put_u16_le(self.start);
        __tmp.put_u16_le(self.end);
        __tmp.put_u8(self.target_system);
        __tmp.put_u8(self.target_component);
        if matches!(version, MavlinkVersion::V2) {
            let len = __tmp.len();
            ::mavlink_core::utils::remove_trailing_zeroes(&bytes[..len])
        } else {
            __tmp.len()
        }
    }
}
#[doc = "Sticks of a ground station."]
#[doc = ""]
#[doc = "ID: 69"]
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(Serialize, Deserialize))]
#[cfg_attr(feature = "arbitrary", derive(Arbitrary))]
#[cfg_attr(feature = "ts-rs", derive(TS))]
#[cfg_attr(feature = "ts-rs", ts(export))]
pub struct MANUAL_CONTROL_DATA {
    #[doc = "X."]
    pub x: i16,
    #[doc = "Y."]
    pub y: i16,
    #[doc = "Z."]
    pub z: i16,
    #[doc = "R."]
    pub r: i16,
    #[doc = "Buttons."]
    pub buttons: u16,
    #[doc = "Target."]
    pub target: u8,
}
impl MANUAL_CONTROL_DATA {
    pub const ENCODED_LEN: usize = 11usize;
    pub const DEFAULT: Self = Self { x: 0_i16, y: 0_i16, z: 0_i16, r: 0_i16, buttons: 0_u16, target: 0_u8 };
    #[cfg(feature = "arbitrary")]
    pub fn random<R: rand::Rng>(rng: &mut R) -> Self {
        use arbitrary::{Arbitrary, Unstructured};
        let mut buf = [0u8; 1024];
        rng.fill_bytes(&mut buf);
        let mut unstructured = Unstructured::new(&buf);
        Self::arbitrary(&mut unstructured).unwrap_or_default()
    }
}
impl Default for MANUAL_CONTROL_DATA {
    fn default() -> Self {
        Self::DEFAULT.clone()
    }
}
impl MessageData for MANUAL_CONTROL_DATA {
    type Message = MavMessage;
    const ID: u32 = 69u32;
    const NAME: &'static str = "MANUAL_CONTROL";
    const EXTRA_CRC: u8 = 243u8;
    const ENCODED_LEN: usize = 11usize;
    fn deser(_version: MavlinkVersion, __input: &[u8]) -> Result<Self, ::mavlink_core::error::ParserError> {
        let avail_len = __input.len();
        let mut payload_buf;
        let mut buf = if avail_len < Self::ENCODED_LEN {
            payload_buf = [0; Self::ENCODED_LEN];
            payload_buf[0..avail_len].copy_from_slice(__input);
            Bytes::new(&payload_buf)
        } else {
            Bytes::new(__input)
        };
        let mut __struct = Self::default();
        __struct.x = buf.get_i16_le()?;
        __struct.y = buf.get_i16_le()?;
        __struct.z = buf.get_i16_le()?;
        __struct.r = buf.get_i16_le()?;
        __struct.buttons = buf.get_u16_le()?;
        __struct.target = buf.get_u8()?;
        Ok(__struct)
    }
    fn ser(&self, version: MavlinkVersion, bytes: &mut [u8]) -> usize {
        let mut __tmp = BytesMut::new(bytes);
        if __tmp.remaining() < Self::ENCODED_LEN {
            panic!("buffer is too small (need {} bytes, but got {})", Self::ENCODED_LEN, __tmp.remaining(),)
        }
        __tmp.put_i16_le(self.x);
        __tmp.put_i16_le(self.y);
        __tmp.put_i16_le(self.z);
        __tmp.put_i16_le(self.r);
        __tmp.put_u16_le(self.buttons);
        __tmp.put_u8(self.target);
        if matches!(version, MavlinkVersion::V2) {
            let len = __tmp.len();
            ::mavlink_core::utils::remove_trailing_zeroes(&bytes[..len])
        } else {
            __tmp.len()
        }
    }
}
#[doc = "Interval of a message."]
#[doc = ""]
#[doc = "ID: 244"]
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(Serialize, Deserialize))]
#[cfg_attr(feature = "arbitrary", derive(Arbitrary))]
#[cfg_attr(feature = "ts-rs", derive(TS))]
#[cfg_attr(feature = "ts-rs", ts(export))]
pub struct MESSAGE_INTERVAL_DATA {
    #[doc = "Interval us."]
    pub interval_us: i32,
    #[doc = "Message id."]
    pub message_id: u16,
}
impl MESSAGE_INTERVAL_DATA {
    pub const ENCODED_LEN: usize = 6usize;
    pub const DEFAULT: Self = Self { interval_us: 0_i32, message_id: 0_u16 };
    #[cfg(feature = "arbitrary")]
    pub fn random<R: rand::Rng>(rng: &mut R) -> Self {
        use arbitrary::{Arbitrary, Unstructured};
        let mut buf = [0u8; 1024];
        rng.fill_bytes(&mut buf);
        let mut unstructured = Unstructured::new(&buf);
        Self::arbitrary(&mut unstructured).unwrap_or_default()
    }
}
impl Default for MESSAGE_INTERVAL_DATA {
    fn default() -> Self {
        Self::DEFAULT.clone()
    }
}
impl MessageData for MESSAGE_INTERVAL_DATA {
    type Message = MavMessage;
    const ID: u32 = 244u32;
    const NAME: &'static str = "MESSAGE_INTERVAL";
    const EXTRA_CRC: u8 = 95u8;
    const ENCODED_LEN: usize = 6usize;
    fn deser(_version: MavlinkVersion, __input: &[u8]) -> Result<Self, ::mavlink_core::error::ParserError> {
        let avail_len = __input.len();
        let mut payload_buf;
        let mut buf = if avail_len < Self::ENCODED_LEN {
            payload_buf = [0; Self::ENCODED_LEN];
            payload_buf[0..avail_len].copy_from_slice(__input);
            Bytes::new(&payload_buf)
        } else {
            Bytes::new(__input)
        };
        let mut __struct = Self::default();
        __struct.interval_us = buf.get_i32_le()?;
        __struct.message_id = buf.get_u16_le()?;
        Ok(__struct)
    }
    fn ser(&self, version: MavlinkVersion, bytes: &mut [u8]) -> usize {
        let mut __tmp = BytesMut::new(bytes);
        if __tmp.remaining() < Self::ENCODED_LEN {
            panic!("buffer is too small (need {} bytes, but got {})", Self::ENCODED_LEN, __tmp.remaining(),)
        }
        __tmp.put_i32_le(self.interval_us);
        __tmp.put_u16_le(self.message_id);
        if matches!(version, MavlinkVersion::V2) {
            let len = __tmp.len();
            ::mavlink_core::utils::remove_trailing_zeroes(&bytes[..len])
        } else {
            __tmp.len()
        }
    }
}
#[doc = "Result of a mission transfer."]
#[doc = ""]
#[doc = "ID: 47"]
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(Serialize, Deserialize))]
#[cfg_attr(feature = "arbitrary", derive(Arbitrary))]
#[cfg_attr(feature = "ts-rs", derive(TS))]
#[cfg_attr(feature = "ts-rs", ts(export))]
pub struct MISSION_ACK_DATA {
    #[doc = "System."]
    pub target_system: u8,
    #[doc = "Component."]
    pub target_component: u8,
    #[doc = "Type."]
    pub mavtype: u8,
    #[doc = "Mission type."]
    #[cfg_attr(feature = "serde", serde(default = "crate::utils::RustDefault::rust_default"))]
    pub mission_type: u8,
}
impl MISSION_ACK_DATA {
    pub const ENCODED_LEN: usize = 4usize;
    pub const DEFAULT: Self = Self { target_system: 0_u8, target_component: 0_u8, mavtype: 0_u8, mission_type: 0_u8 };
    #[cfg(feature = "arbitrary")]
    pub fn random<R: rand::Rng>(rng: &mut R) -> Self {
        use arbitrary::{Arbitrary, Unstructured};
        let mut buf = [0u8; 1024];
        rng.fill_bytes(&mut buf);
        let mut unstructured = Unstructured::new(&buf);
        Self::arbitrary(&mut unstructured).unwrap_or_default()
    }
}
impl Default for MISSION_ACK_DATA {
    fn default() -> Self {
        Self::DEFAULT.clone()
    }
}
impl MessageData for MISSION_ACK_DATA {
    type Message = MavMessage;
    const ID: u32 = 47u32;
    const NAME: &'static str = "MISSION_ACK";
    const EXTRA_CRC: u8 = 153u8;
    const ENCODED_LEN: usize = 4usize;
    fn deser(_version: MavlinkVersion, __input: &[u8]) -> Result<Self, ::mavlink_core::error::ParserError> {
        let avail_len = __input.len();
        let mut payload_buf;
        let mut buf = if avail_len < Self::ENCODED_LEN {
            payload_buf = [0; Self::ENCODED_LEN];
            payload_buf[0..avail_len].copy_from_slice(__input);
            Bytes::new(&payload_buf)
        } else {
            Bytes::new(__input)
        };
        let mut __struct = Self::default();
        __struct.target_system = buf.get_u8()?;
        __struct.target_component = buf.get_u8()?;
        __struct.mavtype = buf.get_u8()?;
        __struct.mission_type = buf.get_u8()?;
        Ok(__struct)
    }
    fn ser(&self, version: MavlinkVersion, bytes: &mut [u8]) -> usize {
        let mut __tmp = BytesMut::new(bytes);
        if __tmp.remaining() < Self::ENCODED_LEN {
            panic!("buffer is too small (need {} bytes, but got {})", Self::ENCODED_LEN, __tmp.remaining(),)
        }
        __tmp.put_u8(self.target_system);
        __tmp.put_u8(self.target_component);
        __tmp.put_u8(self.mavtype);
        if matches!(version, MavlinkVersion::V2) {
            __tmp.put_u8(self.mission_type);
            let len = __tmp.len();
            ::mavlink_core::utils::remove_trailing_zeroes(&bytes[..len])
        } else {
            __tmp.len()
        }
    }
}
#[doc = "Asks to clear a mission."]
#[doc = ""]
#[doc = "ID: 45"]
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(Serialize, Deserialize))]
#[cfg_attr(feature = "arbitrary", derive(Arbitrary))]
#[cfg_attr(feature = "ts-rs", derive(TS))]
#[cfg_attr(feature = "ts-rs", ts(export))]
pub struct MISSION_CLEAR_ALL_DATA {
    #[doc = "System."]
    pub target_system: u8,
    #[doc = "Component."]
    pub target_component: u8,
    #[doc = "Mission type."]
    #[cfg_attr(feature = "serde", serde(default = "crate::utils::RustDefault::rust_default"))]
    pub mission_type: u8,
}
impl MISSION_CLEAR_ALL_DATA {
    pub const ENCODED_LEN: usize = 3usize;
    pub const DEFAULT: Self = Self { target_system: 0_u8, target_component: 0_u8, mission_type: 0_u8 };
    #[cfg(feature = "arbitrary")]
    pub fn random<R: rand::Rng>(rng: &mut R) -> Self {
        use arbitrary::{Arbitrary, Unstructured};
        let mut buf = [0u8; 1024];
        rng.fill_bytes(&mut buf);
        let mut unstructured = Unstructured::new(&buf);
        Self::arbitrary(&mut unstructured).unwrap_or_default()
    }
}
impl Default for MISSION_CLEAR_ALL_DATA {
    fn default() -> Self {
        Self::DEFAULT.clone()
    }
}
impl MessageData for MISSION_CLEAR_ALL_DATA {
    type Message = MavMessage;
    const ID: u32 = 45u32;
    const NAME: &'static str = "MISSION_CLEAR_ALL";
    const EXTRA_CRC: u8 = 232u8;
    const ENCODED_LEN: usize = 3usize;
    fn deser(_version: MavlinkVersion, __input: &[u8]) -> Result<Self, ::mavlink_core::error::ParserError> {
        let avail_len = __input.len();
        let mut payload_buf;
        let mut buf = if avail_len < Self::ENCODED_LEN {
            payload_buf = [0; Self::ENCODED_LEN];
            payload_buf[0..avail_len].copy_from_slice(__input);
            Bytes::new(&payload_buf)
        } else {
            Bytes::new(__input)
        };
        let mut __struct = Self::default();
        __struct.target_system = buf.get_u8()?;
        __struct.target_component = buf.get_u8()?;
        __struct.mission_type = buf.get_u8()?;
        Ok(__struct)
    }
    fn ser(&self, version: MavlinkVersion, bytes: &mut [u8]) -> usize {
        let mut __tmp = BytesMut::new(bytes);
        if __tmp.remaining() < Self::ENCODED_LEN {
            panic!("buffer is too small (need {} bytes, but got {})", Self::ENCODED_LEN, __tmp.remaining(),)
        }
        __tmp.put_u8(self.target_system);
        __tmp.put_u8(self.target_component);
        if matches!(version, MavlinkVersion::V2) {
            __tmp.put_u8(self.mission_type);
            let len = __tmp.len();
            ::mavlink_core::utils::remove_trailing_zeroes(&bytes[..len])
        } else {
            __tmp.len()
        }
    }
}
#[doc = "How many mission items there are."]
#[doc = ""]
#[doc = "ID: 44"]
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(Serialize, Deserialize))]
#[cfg_attr(feature = "arbitrary", derive(Arbitrary))]
#[cfg_attr(feature = "ts-rs", derive(TS))]
#[cfg_attr(feature = "ts-rs", ts(export))]
pub struct MISSION_COUNT_DATA {
    #[doc = "Number of items."]
    pub count: u16,
    #[doc = "System."]
    pub target_system: u8,
    #[doc = "Component."]
    pub target_component: u8,
    #[doc = "Mission, fence or rally points."]
    #[cfg_attr(feature = "serde", serde(default = "crate::utils::RustDefault::rust_default"))]
    pub mission_type: u8,
}
impl MISSION_COUNT_DATA {
    pub const ENCODED_LEN: usize = 5usize;
    pub const DEFAULT: Self = Self { count: 0_u16, target_system: 0_u8, target_component: 0_u8, mission_type: 0_u8 };
    #[cfg(feature = "arbitrary")]
    pub fn random<R: rand::Rng>(rng: &mut R) -> Self {
        use arbitrary::{Arbitrary, Unstructured};
        let mut buf = [0u8; 1024];
        rng.fill_bytes(&mut buf);
        let mut unstructured = Unstructured::new(&buf);
        Self::arbitrary(&mut unstructured).unwrap_or_default()
    }
}
impl Default for MISSION_COUNT_DATA {
    fn default() -> Self {
        Self::DEFAULT.clone()
    }
}
impl MessageData for MISSION_COUNT_DATA {
    type Message = MavMessage;
    const ID: u32 = 44u32;
    const NAME: &'static str = "MISSION_COUNT";
    const EXTRA_CRC: u8 = 221u8;
    const ENCODED_LEN: usize = 5usize;
    fn deser(_version: MavlinkVersion, __input: &[u8]) -> Result<Self, ::mavlink_core::error::ParserError> {
        let avail_len = __input.len();
        let mut payload_buf;
        let mut buf = if avail_len < Self::ENCODED_LEN {
            payload_buf = [0; Self::ENCODED_LEN];
            payload_buf[0..avail_len].copy_from_slice(__input);
            Bytes::new(&payload_buf)
        } else {
            Bytes::new(__input)
        };
        let mut __struct = Self::default();
        __struct.count = buf.get_u16_le()?;
        __struct.target_system = buf.get_u8()?;
        __struct.target_component = buf.get_u8()?;
        __struct.mission_type = buf.get_u8()?;
        Ok(__struct)
    }
    fn ser(&self, version: MavlinkVersion, bytes: &mut [u8]) -> usize {
        let mut __tmp = BytesMut::new(bytes);
        if __tmp.remaining() < Self::ENCODED_LEN {
            panic!("buffer is too small (need {} bytes, but got {})", Self::ENCODED_LEN, __tmp.remaining(),)
        }
        __tmp.put_u16_le(self.count);
        __tmp.put_u8(self.target_system);
        __tmp.put_u8(self.target_component);
        if matches!(version, MavlinkVersion::V2) {
            __tmp.put_u8(self.mission_type);
            let len = __tmp.len();
            ::mavlink_core::utils::remove_trailing_zeroes(&bytes[..len])
        } else {
            __tmp.len()
        }
    }
}
#[doc = "The mission item under way."]
#[doc = ""]
#[doc = "ID: 42"]
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(Serialize, Deserialize))]
#[cfg_attr(feature = "arbitrary", derive(Arbitrary))]
#[cfg_attr(feature = "ts-rs", derive(TS))]
#[cfg_attr(feature = "ts-rs", ts(export))]
pub struct MISSION_CURRENT_DATA {
    #[doc = "Seq."]
    pub seq: u16,
    #[doc = "Total."]
    #[cfg_attr(feature = "serde", serde(default = "crate::utils::RustDefault::rust_default"))]
    pub total: u16,
    #[doc = "Mission state."]
    #[cfg_attr(feature = "serde", serde(default = "crate::utils::RustDefault::rust_default"))]
    pub mission_state: u8,
    #[doc = "Mission mode."]
    #[cfg_attr(feature = "serde", serde(default = "crate::utils::RustDefault::rust_default"))]
    pub mission_mode: u8,
}
impl MISSION_CURRENT_DATA {
    pub const ENCODED_LEN: usize = 6usize;
    pub const DEFAULT: Self = Self { seq: 0_u16, total: 0_u16, mission_state: 0_u8, mission_mode: 0_u8 };
    #[cfg(feature = "arbitrary")]
    pub fn random<R: rand::Rng>(rng: &mut R) -> Self {
        use arbitrary::{Arbitrary, Unstructured};
        let mut buf = [0u8; 1024];
        rng.fill_bytes(&mut buf);
        let mut unstructured = Unstructured::new(&buf);
        Self::arbitrary(&mut unstructured).unwrap_or_default()
    }
}
impl Default for MISSION_CURRENT_DATA {
    fn default() -> Self {
        Self::DEFAULT.clone()
    }
}
impl MessageData for MISSION_CURRENT_DATA {
    type Message = MavMessage;
    const ID: u32 = 42u32;
    const NAME: &'static str = "MISSION_CURRENT";
    const EXTRA_CRC: u8 = 28u8;
    const ENCODED_LEN: usize = 6usize;
    fn deser(_version: MavlinkVersion, __input: &[u8]) -> Result<Self, ::mavlink_core::error::ParserError> {
        let avail_len = __input.len();
        let mut payload_buf;
        let mut buf = if avail_len < Self::ENCODED_LEN {
            payload_buf = [0; Self::ENCODED_LEN];
            payload_buf[0..avail_len].copy_from_slice(__input);
            Bytes::new(&payload_buf)
        } else {
            Bytes::new(__input)
        };
        let mut __struct = Self::default();
        __struct.seq = buf.get_u16_le()?;
        __struct.total = buf.get_u16_le()?;
        __struct.mission_state = buf.get_u8()?;
        __struct.mission_mode = buf.get_u8()?;
        Ok(__struct)
    }
    fn ser(&self, version: MavlinkVersion, bytes: &mut [u8]) -> usize {
        let mut __tmp = BytesMut::new(bytes);
        if __tmp.remaining() < Self::ENCODED_LEN {
            panic!("buffer is too small (need {} bytes, but got {})", Self::ENCODED_LEN, __tmp.remaining(),)
        }
        __tmp.put_u16_le(self.seq);
        if matches!(version, MavlinkVersion::V2) {
            __tmp.put_u16_le(self.total);
            __tmp.put_u8(self.mission_state);
            __tmp.put_u8(self.mission_mode);
            let len = __tmp.len();
            ::mavlink_core::utils::remove_trailing_zeroes(&bytes[..len])
        } else {
            __tmp.len()
        }
    }
}
#[doc = "A mission item, the old way."]
#[doc = ""]
#[doc = "ID: 39"]
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(Serialize, Deserialize))]
#[cfg_attr(feature = "arbitrary", derive(Arbitrary))]
#[cfg_attr(feature = "ts-rs", derive(TS))]
#[cfg_attr(feature = "ts-rs", ts(export))]
pub struct MISSION_ITEM_DATA {
    #[doc = "Param1."]
    pub param1: f32,
    #[doc = "Param2."]
    pub param2: f32,
    #[doc = "Param3."]
    pub param3: f32,
    #[doc = "Param4."]
    pub param4: f32,
    #[doc = "X."]
    pub x: f32,
    #[doc = "Y."]
    pub y: f32,
    #[doc = "Z."]
    pub z: f32,
    #[doc = "Seq."]
    pub seq: u16,
    #[doc = "Command."]
    pub command: u16,
    #[doc = "System."]
    pub target_system: u8,
    #[doc = "Component."]
    pub target_component: u8,
    #[doc = "Frame."]
    pub frame: u8,
    #[doc = "Current."]
    pub current: u8,
    #[doc = "Autocontinue."]
    pub autocontinue: u8,
    #[doc = "Mission type."]
    #[cfg_attr(feature = "serde", serde(default = "crate::utils::RustDefault::rust_default"))]
    pub mission_type: u8,
}
impl MISSION_ITEM_DATA {
    pub const ENCODED_LEN: usize = 38usize;
    pub const DEFAULT: Self = Self {
        param1: 0.0_f32,
        param2: 0.0_f32,
        param3: 0.0_f32,
        param4: 0.0_f32,
        x: 0.0_f32,
        y: 0.0_f32,
        z: 0.0_f32,
        seq: 0_u16,
        command: 0_u16,
        target_system: 0_u8,
        target_component: 0_u8,
        frame: 0_u8,
        current: 0_u8,
        autocontinue: 0_u8,
        mission_type: 0_u8,
    };
    #[cfg(feature = "arbitrary")]
    pub fn random<R: rand::Rng>(rng: &mut R) -> Self {
        use arbitrary::{Arbitrary, Unstructured};
        let mut buf = [0u8; 1024];
        rng.fill_bytes(&mut buf);
        let mut unstructured = Unstructured::new(&buf);
        Self::arbitrary(&mut unstructured).unwrap_or_default()
    }
}
impl Default for MISSION_ITEM_DATA {
    fn default() -> Self {
        Self::DEFAULT.clone()
    }
}
impl MessageData for MISSION_ITEM_DATA {
    type Message = MavMessage;
    const ID: u32 = 39u32;
    const NAME: &'static str = "MISSION_ITEM";
    const EXTRA_CRC: u8 = 254u8;
    const ENCODED_LEN: usize = 38usize;
    fn deser(_version: MavlinkVersion, __input: &[u8]) -> Result<Self, ::mavlink_core::error::ParserError> {
        let avail_len = __input.len();
        let mut payload_buf;
        let mut buf = if avail_len < Self::ENCODED_LEN {
            payload_buf = [0; Self::ENCODED_LEN];
            payload_buf[0..avail_len].copy_from_slice(__input);
            Bytes::new(&payload_buf)
        } else {
            Bytes::new(__input)
        };
        let mut __struct = Self::default();
        __struct.param1 = buf.get_f32_le()?;
        __struct.param2 = buf.get_f32_le()?;
        __struct.param3 = buf.get_f32_le()?;
        __struct.param4 = buf.get_f32_le()?;
        __struct.x = buf.get_f32_le()?;
        __struct.y = buf.get_f32_le()?;
        __struct.z = buf.get_f32_le()?;
        __struct.seq = buf.get_u16_le()?;
        __struct.command = buf.get_u16_le()?;
        __struct.target_system = buf.get_u8()?;
        __struct.target_component = buf.get_u8()?;
        __struct.frame = buf.get_u8()?;
        __struct.current = buf.get_u8()?;
        __struct.autocontinue = buf.get_u8()?;
        __struct.mission_type = buf.get_u8()?;
        Ok(__struct)
    }
    fn ser(&self, version: MavlinkVersion, bytes: &mut [u8]) -> usize {
        let mut __tmp = BytesMut::new(bytes);
        if __tmp.remaining() < Self::ENCODED_LEN {
            panic!("buffer is too small (need {} bytes, but got {})", Self::ENCODED_LEN, __tmp.remaining(),)
        }
        __tmp.put_f32_le(self.param1);
        __tmp.put_f32_le(self.param2);
        __tmp.put_f32_le(self.param3);
        __tmp.put_f32_le(self.param4);
        __tmp.put_f32_le(self.x);
        __tmp.put_f32_le(self.y);
        __tmp.put_f32_le(self.z);
        __tmp.put_u16_le(self.seq);
        __tmp.put_u16_le(self.command);
        __tmp.put_u8(self.target_system);
        __tmp.put_u8(self.target_component);
        __tmp.put_u8(self.frame);
        __tmp.put_u8(self.current);
        __tmp.put_u8(self.autocontinue);
        if matches!(version, MavlinkVersion::V2) {
            __tmp.put_u8(self.mission_type);
            let len = __tmp.len();
            ::mavlink_core::utils::remove_trailing_zeroes(&bytes[..len])
        } else {
            __tmp.len()
        }
    }
}
#[doc = "A mission item."]
#[doc = ""]
#[doc = "ID: 73"]
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(Serialize, Deserialize))]
#[cfg_attr(feature = "arbitrary", derive(Arbitrary))]
#[cfg_attr(feature = "ts-rs", derive(TS))]
#[cfg_attr(feature = "ts-rs", ts(export))]
pub struct MISSION_ITEM_INT_DATA {
    #[doc = "Param1."]
    pub param1: f32,
    #[doc = "Param2."]
    pub param2: f32,
    #[doc = "Param3."]
    pub param3: f32,
    #[doc = "Param4."]
    pub param4: f32,
    #[doc = "X."]
    pub x: i32,
    #[doc = "Y."]
    pub y: i32,
    #[doc = "Z."]
    pub z: f32,
    #[doc = "Seq."]
    pub seq: u16,
    #[doc = "Command."]
    pub command: u16,
    #[doc = "System."]
    pub target_system: u8,
    #[doc = "Component."]
    pub target_component: u8,
    #[doc = "Frame."]
    pub frame: u8,
    #[doc = "Current."]
    pub current: u8,
    #[doc = "Autocontinue."]
    pub autocontinue: u8,
    #[doc = "Mission type."]
    #[cfg_attr(feature = "serde", serde(default = "crate::utils::RustDefault::rust_default"))]
    pub mission_type: u8,
}
impl MISSION_ITEM_INT_DATA {
    pub const ENCODED_LEN: usize = 38usize;
    pub const DEFAULT: Self = Self {
        param1: 0.0_f32,
        param2: 0.0_f32,
        param3: 0.0_f32,
        param4: 0.0_f32,
        x: 0_i32,
        y: 0_i32,
        z: 0.0_f32,
        seq: 0_u16,
        command: 0_u16,
        target_system: 0_u8,
        target_component: 0_u8,
        frame: 0_u8,
        current: 0_u8,
        autocontinue: 0_u8,
        mission_type: 0_u8,
    };
    #[cfg(feature = "arbitrary")]
    pub fn random<R: rand::Rng>(rng: &mut R) -> Self {
        use arbitrary::{Arbitrary, Unstructured};
        let mut buf = [0u8; 1024];
        rng.fill_bytes(&mut buf);
        let mut unstructured = Unstructured::new(&buf);
        Self::arbitrary(&mut unstructured).unwrap_or_default()
    }
}
impl Default for MISSION_ITEM_INT_DATA {
    fn default() -> Self {
        Self::DEFAULT.clone()
    }
}
impl MessageData for MISSION_ITEM_INT_DATA {
    type Message = MavMessage;
    const ID: u32 = 73u32;
    const NAME: &'static str = "MISSION_ITEM_INT";
    const EXTRA_CRC: u8 = 38u8;
    const ENCODED_LEN: usize = 38usize;
    fn deser(_version: MavlinkVersion, __input: &[u8]) -> Result<Self, ::mavlink_core::error::ParserError> {
        let avail_len = __input.len();
        let mut payload_buf;
        let mut buf = if avail_len < Self::ENCODED_LEN {
            payload_buf = [0; Self::ENCODED_LEN];
            payload_buf[0..avail_len].copy_from_slice(__input);
            Bytes::new(&payload_buf)
        } else {
            Bytes::new(__input)
        };
        let mut __struct = Self::default();
        __struct.param1 = buf.get_f32_le()?;
        __struct.param2 = buf.get_f32_le()?;
        __struct.param3 = buf.get_f32_le()?;
        __struct.param4 = buf.get_f32_le()?;
        __struct.x = buf.get_i32_le()?;
        __struct.y = buf.get_i32_le()?;
        __struct.z = buf.get_f32_le()?;
        __struct.seq = buf.get_u16_le()?;
        __struct.command = buf.get_u16_le()?;
        __struct.target_system = buf.get_u8()?;
        __struct.target_component = buf.get_u8()?;
        __struct.frame = buf.get_u8()?;
        __struct.current = buf.get_u8()?;
        __struct.autocontinue = buf.get_u8()?;
        __struct.mission_type = buf.get_u8()?;
        Ok(__struct)
    }
    fn ser(&self, version: MavlinkVersion, bytes: &mut [u8]) -> usize {
        let mut __tmp = BytesMut::new(bytes);
        if __tmp.remaining() < Self::ENCODED_LEN {
            panic!("buffer is too small (need {} bytes, but got {})", Self::ENCODED_LEN, __tmp.remaining(),)
        }
        __tmp.put_f32_le(self.param1);
        __tmp.put_f32_le(self.param2);
        __tmp.put_f32_le(self.param3);
        __tmp.put_f32_le(self.param4);
        __tmp.put_i32_le(self.x);
        __tmp.put_i32_le(self.y);
        __tmp.put_f32_le(self.z);
        __tmp.put_u16_le(self.seq);
        __tmp.put_u16_le(self.command);
        __tmp.put_u8(self.target_system);
        __tmp.put_u8(self.target_component);
        __tmp.put_u8(self.frame);
        __tmp.put_u8(self.current);
        __tmp.put_u8(self.autocontinue);
        if matches!(version, MavlinkVersion::V2) {
            __tmp.put_u8(self.mission_type);
            let len = __tmp.len();
            ::mavlink_core::utils::remove_trailing_zeroes(&bytes[..len])
        } else {
            __tmp.len()
        }
    }
}
#[doc = "Asks for a mission item, the old way."]
#[doc = ""]
#[doc = "ID: 40"]
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(Serialize, Deserialize))]
#[cfg_attr(feature = "arbitrary", derive(Arbitrary))]
#[cfg_attr(feature = "ts-rs", derive(TS))]
#[cfg_attr(feature = "ts-rs", ts(export))]
pub struct MISSION_REQUEST_DATA {
    #[doc = "Seq."]
    pub seq: u16,
    #[doc = "System."]
    pub target_system: u8,
    #[doc = "Component."]
    pub target_component: u8,
    #[doc = "Mission type."]
    #[cfg_attr(feature = "serde", serde(default = "crate::utils::RustDefault::rust_default"))]
    pub mission_type: u8,
}
impl MISSION_REQUEST_DATA {
    pub const ENCODED_LEN: usize = 5usize;
    pub const DEFAULT: Self = Self { seq: 0_u16, target_system: 0_u8, target_component: 0_u8, mission_type: 0_u8 };
    #[cfg(feature = "arbitrary")]
    pub fn random<R: rand::Rng>(rng: &mut R) -> Self {
        use arbitrary::{Arbitrary, Unstructured};
        let mut buf = [0u8; 1024];
        rng.fill_bytes(&mut buf);
        let mut unstructured = Unstructured::new(&buf);
        Self::arbitrary(&mut unstructured).unwrap_or_default()
    }
}
impl Default for MISSION_REQUEST_DATA {
    fn default() -> Self {
        Self::DEFAULT.clone()
    }
}
impl MessageData for MISSION_REQUEST_DATA {
    type Message = MavMessage;
    const ID: u32 = 40u32;
    const NAME: &'static str = "MISSION_REQUEST";
    const EXTRA_CRC: u8 = 230u8;
    const ENCODED_LEN: usize = 5usize;
    fn deser(_version: MavlinkVersion, __input: &[u8]) -> Result<Self, ::mavlink_core::error::ParserError> {
        let avail_len = __input.len();
        let mut payload_buf;
        let mut buf = if avail_len < Self::ENCODED_LEN {
            payload_buf = [0; Self::ENCODED_LEN];
            payload_buf[0..avail_len].copy_from_slice(__input);
            Bytes::new(&payload_buf)
        } else {
            Bytes::new(__input)
        };
        let mut __struct = Self::default();
        __struct.seq = buf.get_u16_le()?;
        __struct.target_system = buf.get_u8()?;
        __struct.target_component = buf.get_u8()?;
        __struct.mission_type = buf.get_u8()?;
        Ok(__struct)
    }
    fn ser(&self, version: MavlinkVersion, bytes: &mut [u8]) -> usize {
        let mut __tmp = BytesMut::new(bytes);
        if __tmp.remaining() < Self::ENCODED_LEN {
            panic!("buffer is too small (need {} bytes, but got {})", Self::ENCODED_LEN, __tmp.remaining(),)
        }
        __tmp.put_u16_le(self.seq);
        __tmp.put_u8(self.target_system);
        __tmp.put_u8(self.target_component);
        if matches!(version, MavlinkVersion::V2) {
            __tmp.put_u8(self.mission_type);
            let len = __tmp.len();
            ::mavlink_core::utils::remove_trailing_zeroes(&bytes[..len])
        } else {
            __tmp.len()
        }
    }
}
#[doc = "Asks for a mission item."]
#[doc = ""]
#[doc = "ID: 51"]
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(Serialize, Deserialize))]
#[cfg_attr(feature = "arbitrary", derive(Arbitrary))]
#[cfg_attr(feature = "ts-rs", derive(TS))]
#[cfg_attr(feature = "ts-rs", ts(export))]
pub struct MISSION_REQUEST_INT_DATA {
    #[doc = "Seq."]
    pub seq: u16,
    #[doc = "System."]
    pub target_system: u8,
    #[doc = "Component."]
    pub target_component: u8,
    #[doc = "Mission type."]
    #[cfg_attr(feature = "serde", serde(default = "crate::utils::RustDefault::rust_default"))]
    pub mission_type: u8,
}
impl MISSION_REQUEST_INT_DATA {
    pub const ENCODED_LEN: usize = 5usize;
    pub const DEFAULT: Self = Self { seq: 0_u16, target_system: 0_u8, target_component: 0_u8, mission_type: 0_u8 };
    #[cfg(feature = "arbitrary")]
    pub fn random<R: rand::Rng>(rng: &mut R) -> Self {
        use arbitrary::{Arbitrary, Unstructured};
        let mut buf = [0u8; 1024];
        rng.fill_bytes(&mut buf);
        let mut unstructured = Unstructured::new(&buf);
        Self::arbitrary(&mut unstructured).unwrap_or_default()
    }
}
impl Default for MISSION_REQUEST_INT_DATA {
    fn default() -> Self {
        Self::DEFAULT.clone()
    }
}
impl MessageData for MISSION_REQUEST_INT_DATA {
    type Message = MavMessage;
    const ID: u32 = 51u32;
    const NAME: &'static str = "MISSION_REQUEST_INT";
    const EXTRA_CRC: u8 = 196u8;
    const ENCODED_LEN: usize = 5usize;
    fn deser(_version: MavlinkVersion, __input: &[u8]) -> Result<Self, ::mavlink_core::error::ParserError> {
        let avail_len = __input.len();
        let mut payload_buf;
        let mut buf = if avail_len < Self::ENCODED_LEN {
            payload_buf = [0; Self::ENCODED_LEN];
            payload_buf[0..avail_len].copy_from_slice(__input);
            Bytes::new(&payload_buf)
        } else {
            Bytes::new(__input)
        };
        let mut __struct = Self::default();
        __struct.seq = buf.get_u16_le()?;
        __struct.target_system = buf.get_u8()?;
        __struct.target_component = buf.get_u8()?;
        __struct.mission_type = buf.get_u8()?;
        Ok(__struct)
    }
    fn ser(&self, version: MavlinkVersion, bytes: &mut [u8]) -> usize {
        let mut __tmp = BytesMut::new(bytes);
        if __tmp.remaining() < Self::ENCODED_LEN {
            panic!("buffer is too small (need {} bytes, but got {})", Self::ENCODED_LEN, __tmp.remaining(),)
        }
        __tmp.put_u16_le(self.seq);
        __tmp.put_u8(self.target_system);
        __tmp.put_u8(self.target_component);
        if matches!(version, MavlinkVersion::V2) {
            __tmp.put_u8(self.mission_type);
            let len = __tmp.len();
            ::mavlink_core::utils::remove_trailing_zeroes(&bytes[..len])
        } else {
            __tmp.len()
        }
    }
}
#[doc = "Asks how many mission items there are."]
#[doc = ""]
#[doc = "ID: 43"]
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(Serialize, Deserialize))]
#[cfg_attr(feature = "arbitrary", derive(Arbitrary))]
#[cfg_attr(feature = "ts-rs", derive(TS))]
#[cfg_attr(feature = "ts-rs", ts(export))]
pub struct MISSION_REQUEST_LIST_DATA {
    #[doc = "System."]
    pub target_system: u8,
    #[doc = "Component."]
    pub target_component: u8,
    #[doc = "Mission, fence or rally points."]
    #[cfg_attr(feature = "serde", serde(default = "crate::utils::RustDefault::rust_default"))]
    pub mission_type: u8,
}
impl MISSION_REQUEST_LIST_DATA {
    pub const ENCODED_LEN: usize = 3usize;
    pub const DEFAULT: Self = Self { target_system: 0_u8, target_component: 0_u8, mission_type: 0_u8 };
    #[cfg(feature = "arbitrary")]
    pub fn random<R: rand::Rng>(rng: &mut R) -> Self {
        use arbitrary::{Arbitrary, Unstructured};
        let mut buf = [0u8; 1024];
        rng.fill_bytes(&mut buf);
        let mut unstructured = Unstructured::new(&buf);
        Self::arbitrary(&mut unstructured).unwrap_or_default()
    }
}
impl Default for MISSION_REQUEST_LIST_DATA {
    fn default() -> Self {
        Self::DEFAULT.clone()
    }
}
impl MessageData for MISSION_REQUEST_LIST_DATA {
    type Message = MavMessage;
    const ID: u32 = 43u32;
    const NAME: &'static str = "MISSION_REQUEST_LIST";
    const EXTRA_CRC: u8 = 132u8;
    const ENCODED_LEN: usize = 3usize;
    fn deser(_version: MavlinkVersion, __input: &[u8]) -> Result<Self, ::mavlink_core::error::ParserError> {
        let avail_len = __input.len();
        let mut payload_buf;
        let mut buf = if avail_len < Self::ENCODED_LEN {
            payload_buf = [0; Self::ENCODED_LEN];
            payload_buf[0..avail_len].copy_from_slice(__input);
            Bytes::new(&payload_buf)
        } else {
            Bytes::new(__input)
        };
        let mut __struct = Self::default();
        __struct.target_system = buf.get_u8()?;
        __struct.target_component = buf.get_u8()?;
        __struct.mission_type = buf.get_u8()?;
        Ok(__struct)
    }
    fn ser(&self, version: MavlinkVersion, bytes: &mut [u8]) -> usize {
        let mut __tmp = BytesMut::new(bytes);
        if __tmp.remaining() < Self::ENCODED_LEN {
            panic!("buffer is too small (need {} bytes, but got {})", Self::ENCODED_LEN, __tmp.remaining(),)
        }
        __tmp.put_u8(self.target_system);
        __tmp.put_u8(self.target_component);
        if matches!(version, MavlinkVersion::V2) {
            __tmp.put_u8(self.mission_type);
            let len = __tmp.len();
            ::mavlink_core::utils::remove_trailing_zeroes(&bytes[..len])
        } else {
            __tmp.len()
        }
    }
}
#[doc = "Asks for part of a mission."]
#[doc = ""]
#[doc = "ID: 37"]
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(Serialize, Deserialize))]
#[cfg_attr(feature = "arbitrary", derive(Arbitrary))]
#[cfg_attr(feature = "ts-rs", derive(TS))]
#[cfg_attr(feature = "ts-rs", ts(export))]
pub struct MISSION_REQUEST_PARTIAL_LIST_DATA {
    #[doc = "Start index."]
    pub start_index: i16,
    #[doc = "End index."]
    pub end_index: i16,
    #[doc = "System."]
    pub target_system: u8,
    #[doc = "Component."]
    pub target_component: u8,
    #[doc = "Mission type."]
    #[cfg_attr(feature = "serde", serde(default = "crate::utils::RustDefault::rust_default"))]
    pub mission_type: u8,
}
impl MISSION_REQUEST_PARTIAL_LIST_DATA {
    pub const ENCODED_LEN: usize = 7usize;
    pub const DEFAULT: Self =
        Self { start_index: 0_i16, end_index: 0_i16, target_system: 0_u8, target_component: 0_u8, mission_type: 0_u8 };
    #[cfg(feature = "arbitrary")]
    pub fn random<R: rand::Rng>(rng: &mut R) -> Self {
        use arbitrary::{Arbitrary, Unstructured};
        let mut buf = [0u8; 1024];
        rng.fill_bytes(&mut buf);
        let mut unstructured = Unstructured::new(&buf);
        Self::arbitrary(&mut unstructured).unwrap_or_default()
    }
}
impl Default for MISSION_REQUEST_PARTIAL_LIST_DATA {
    fn default() -> Self {
        Self::DEFAULT.clone()
    }
}
impl MessageData for MISSION_REQUEST_PARTIAL_LIST_DATA {
    type Message = MavMessage;
    const ID: u32 = 37u32;
    const NAME: &'static str = "MISSION_REQUEST_PARTIAL_LIST";
    const EXTRA_CRC: u8 = 212u8;
    const ENCODED_LEN: usize = 7usize;
    fn deser(_version: MavlinkVersion, __input: &[u8]) -> Result<Self, ::mavlink_core::error::ParserError> {
        let avail_len = __input.len();
        let mut payload_buf;
        let mut buf = if avail_len < Self::ENCODED_LEN {
            payload_buf = [0; Self::ENCODED_LEN];
            payload_buf[0..avail_len].copy_from_slice(__input);
            Bytes::new(&payload_buf)
        } else {
            Bytes::new(__input)
        };
        let mut __struct = Self::default();
        __struct.start_index = buf.get_i16_le()?;
        __struct.end_index = buf.get_i16_le()?;
        __struct.target_system = buf.get_u8()?;
        __struct.target_component = buf.get_u8()?;
        __struct.mission_type = buf.get_u8()?;
        Ok(__struct)
    }
    fn ser(&self, version: MavlinkVersion, bytes: &mut [u8]) -> usize {
        let mut __tmp = BytesMut::new(bytes);
        if __tmp.remaining() < Self::ENCODED_LEN {
            panic!("buffer is too small (need {} bytes, but got {})", Self::ENCODED_LEN, __tmp.remaining(),)
        }
        __tmp.put_i16_le(self.start_index);
        __tmp.put_i16_le(self.end_index);
        __tmp.put_u8(self.target_system);
        __tmp.put_u8(self.target_component);
        if matches!(version, MavlinkVersion::V2) {
            __tmp.put_u8(self.mission_type);
            let len = __tmp.len();
            ::mavlink_core::utils::remove_trailing_zeroes(&bytes[..len])
        } else {
            __tmp.len()
        }
    }
}
#[doc = "Asks to go on with an item."]
#[doc = ""]
#[doc = "ID: 41"]
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(Serialize, Deserialize))]
#[cfg_attr(feature = "arbitrary", derive(Arbitrary))]
#[cfg_attr(feature = "ts-rs", derive(TS))]
#[cfg_attr(feature = "ts-rs", ts(export))]
pub struct MISSION_SET_CURRENT_DATA {
    #[doc = "Seq."]
    pub seq: u16,
    #[doc = "System."]
    pub target_system: u8,
    #[doc = "Component."]
    pub target_component: u8,
}
impl MISSION_SET_CURRENT_DATA {
    pub const ENCODED_LEN: usize = 4usize;
    pub const DEFAULT: Self = Self { seq: 0_u16, target_system: 0_u8, target_component: 0_u8 };
    #[cfg(feature = "arbitrary")]
    pub fn random<R: rand::Rng>(rng: &mut R) -> Self {
        use arbitrary::{Arbitrary, Unstructured};
        let mut buf = [0u8; 1024];
        rng.fill_bytes(&mut buf);
        let mut unstructured = Unstructured::new(&buf);
        Self::arbitrary(&mut unstructured).unwrap_or_default()
    }
}
impl Default for MISSION_SET_CURRENT_DATA {
    fn default() -> Self {
        Self::DEFAULT.clone()
    }
}
impl MessageData for MISSION_SET_CURRENT_DATA {
    type Message = MavMessage;
    const ID: u32 = 41u32;
    const NAME: &'static str = "MISSION_SET_CURRENT";
    const EXTRA_CRC: u8 = 28u8;
    const ENCODED_LEN: usize = 4usize;
    fn deser(_version: MavlinkVersion, __input: &[u8]) -> Result<Self, ::mavlink_core::error::ParserError> {
        let avail_len = __input.len();
        let mut payload_buf;
        let mut buf = if avail_len < Self::ENCODED_LEN {
            payload_buf = [0; Self::ENCODED_LEN];
            payload_buf[0..avail_len].copy_from_slice(__input);
            Bytes::new(&payload_buf)
        } else {
            Bytes::new(__input)
        };
        let mut __struct = Self::default();
        __struct.seq = buf.get_u16_le()?;
        __struct.target_system = buf.get_u8()?;
        __struct.target_component = buf.get_u8()?;
        Ok(__struct)
    }
    fn ser(&self, version: MavlinkVersion, bytes: &mut [u8]) -> usize {
        let mut __tmp = BytesMut::new(bytes);
        if __tmp.remaining() < Self::ENCODED_LEN {
            panic!("buffer is too small (need {} bytes, but got {})", Self::ENCODED_LEN, __tmp.remaining(),)
        }
        __tmp.put_u16_le(self.seq);
        __tmp.put_u8(self.target_system);
        __tmp.put_u8(self.target_component);
        if matches!(version, MavlinkVersion::V2) {
            let len = __tmp.len();
            ::mavlink_core::utils::remove_trailing_zeroes(&bytes[..len])
        } else {
            __tmp.len()
        }
    }
}
#[doc = "Asks for part of a mission to be replaced."]
#[doc = ""]
#[doc = "ID: 38"]
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(Serialize, Deserialize))]
#[cfg_attr(feature = "arbitrary", derive(Arbitrary))]
#[cfg_attr(feature = "ts-rs", derive(TS))]
#[cfg_attr(feature = "ts-rs", ts(export))]
pub struct MISSION_WRITE_PARTIAL_LIST_DATA {
    #[doc = "Start index."]
    pub start_index: i16,
    #[doc = "End index."]
    pub end_index: i16,
    #[doc = "System."]
    pub target_system: u8,
    #[doc = "Component."]
    pub target_component: u8,
    #[doc = "Mission type."]
    #[cfg_attr(feature = "serde", serde(default = "crate::utils::RustDefault::rust_default"))]
    pub mission_type: u8,
}
impl MISSION_WRITE_PARTIAL_LIST_DATA {
    pub const ENCODED_LEN: usize = 7usize;
    pub const DEFAULT: Self =
        Self { start_index: 0_i16, end_index: 0_i16, target_system: 0_u8, target_component: 0_u8, mission_type: 0_u8 };
    #[cfg(feature = "arbitrary")]
    pub fn random<R: rand::Rng>(rng: &mut R) -> Self {
        use arbitrary::{Arbitrary, Unstructured};
        let mut buf = [0u8; 1024];
        rng.fill_bytes(&mut buf);
        let mut unstructured = Unstructured::new(&buf);
        Self::arbitrary(&mut unstructured).unwrap_or_default()
    }
}
impl Default for MISSION_WRITE_PARTIAL_LIST_DATA {
    fn default() -> Self {
        Self::DEFAULT.clone()
    }
}
impl MessageData for MISSION_WRITE_PARTIAL_LIST_DATA {
    type Message = MavMessage;
    const ID: u32 = 38u32;
    const NAME: &'static str = "MISSION_WRITE_PARTIAL_LIST";
    const EXTRA_CRC: u8 = 9u8;
    const ENCODED_LEN: usize = 7usize;
    fn deser(_version: MavlinkVersion, __input: &[u8]) -> Result<Self, ::mavlink_core::error::ParserError> {
        let avail_len = __input.len();
        let mut payload_buf;
        let mut buf = if avail_len < Self::ENCODED_LEN {
            payload_buf = [0; Self::ENCODED_LEN];
            payload_buf[0..avail_len].copy_from_slice(__input);
            Bytes::new(&payload_buf)
        } else {
            Bytes::new(__input)
        };
        let mut __struct = Self::default();
        __struct.start_index = buf.get_i16_le()?;
        __struct.end_index = buf.get_i16_le()?;
        __struct.target_system = buf.get_u8()?;
        __struct.target_component = buf.get_u8()?;
        __struct.mission_type = buf.get_u8()?;
        Ok(__struct)
    }
    fn ser(&self, version: MavlinkVersion, bytes: &mut [u8]) -> usize {
        let mut __tmp = BytesMut::new(bytes);
        if __tmp.remaining() < Self::ENCODED_LEN {
            panic!("buffer is too small (need {} bytes, but got {})", Self::ENCODED_LEN, __tmp.remaining(),)
        }
        __tmp.put_i16_le(self.start_index);
        __tmp.put_i16_le(self.end_index);
        __tmp.put_u8(self.target_system);
        __tmp.put_u8(self.target_component);
        if matches!(version, MavlinkVersion::V2) {
            __tmp.put_u8(self.mission_type);
            let len = __tmp.len();
            ::mavlink_core::utils::remove_trailing_zeroes(&bytes[..len])
        } else {
            __tmp.len()
        }
    }
}
#[doc = "A named value."]
#[doc = ""]
#[doc = "ID: 251"]
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(Serialize, Deserialize))]
#[cfg_attr(feature = "arbitrary", derive(Arbitrary))]
#[cfg_attr(feature = "ts-rs", derive(TS))]
#[cfg_attr(feature = "ts-rs", ts(export))]
pub struct NAMED_VALUE_FLOAT_DATA {
    #[doc = "Time since boot."]
    pub time_boot_ms: u32,
    #[doc = "Value."]
    pub value: f32,
    #[doc = "Name."]
    #[cfg_attr(feature = "ts-rs", ts(type = "string"))]
    pub name: CharArray<10>,
}
impl NAMED_VALUE_FLOAT_DATA {
    pub const ENCODED_LEN: usize = 18usize;
    pub const DEFAULT: Self = Self { time_boot_ms: 0_u32, value: 0.0_f32, name: CharArray::new([0_u8; 10usize]) };
    #[cfg(feature = "arbitrary")]
    pub fn random<R: rand::Rng>(rng: &mut R) -> Self {
        use arbitrary::{Arbitrary, Unstructured};
        let mut buf = [0u8; 1024];
        rng.fill_bytes(&mut buf);
        let mut unstructured = Unstructured::new(&buf);
        Self::arbitrary(&mut unstructured).unwrap_or_default()
    }
}
impl Default for NAMED_VALUE_FLOAT_DATA {
    fn default() -> Self {
        Self::DEFAULT.clone()
    }
}
impl MessageData for NAMED_VALUE_FLOAT_DATA {
    type Message = MavMessage;
    const ID: u32 = 251u32;
    const NAME: &'static str = "NAMED_VALUE_FLOAT";
    const EXTRA_CRC: u8 = 170u8;
    const ENCODED_LEN: usize = 18usize;
    fn deser(_version: MavlinkVersion, __input: &[u8]) -> Result<Self, ::mavlink_core::error::ParserError> {
        let avail_len = __input.len();
        let mut payload_buf;
        let mut buf = if avail_len < Self::ENCODED_LEN {
            payload_buf = [0; Self::ENCODED_LEN];
            payload_buf[0..avail_len].copy_from_slice(__input);
            Bytes::new(&payload_buf)
        } else {
            Bytes::new(__input)
        };
        let mut __struct = Self::default();
        __struct.time_boot_ms = buf.get_u32_le()?;
        __struct.value = buf.get_f32_le()?;
        let mut tmp = [0_u8; 10usize];
        for v in &mut tmp {
            *v = buf.get_u8()?;
        }
        __struct.name = CharArray::new(tmp);
        Ok(__struct)
    }
    fn ser(&self, version: MavlinkVersion, bytes: &mut [u8]) -> usize {
        let mut __tmp = BytesMut::new(bytes);
        if __tmp.remaining() < Self::ENCODED_LEN {
            panic!("buffer is too small (need {} bytes, but got {})", Self::ENCODED_LEN, __tmp.remaining(),)
        }
        __tmp.put_u32_le(self.time_boot_ms);
        __tmp.put_f32_le(self.value);
        for val in &self.name {
            __tmp.put_u8(*val);
        }
        if matches!(version, MavlinkVersion::V2) {
            let len = __tmp.len();
            ::mavlink_core::utils::remove_trailing_zeroes(&bytes[..len])
        } else {
            __tmp.len()
        }
    }
}
#[doc = "A named number."]
#[doc = ""]
#[doc = "ID: 252"]
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(Serialize, Deserialize))]
#[cfg_attr(feature = "arbitrary", derive(Arbitrary))]
#[cfg_attr(feature = "ts-rs", derive(TS))]
#[cfg_attr(feature = "ts-rs", ts(export))]
pub struct NAMED_VALUE_INT_DATA {
    #[doc = "Time since boot."]
    pub time_boot_ms: u32,
    #[doc = "Value."]
    pub value: i32,
    #[doc = "Name."]
    #[cfg_attr(feature = "ts-rs", ts(type = "string"))]
    pub name: CharArray<10>,
}
impl NAMED_VALUE_INT_DATA {
    pub const ENCODED_LEN: usize = 18usize;
    pub const DEFAULT: Self = Self { time_boot_ms: 0_u32, value: 0_i32, name: CharArray::new([0_u8; 10usize]) };
    #[cfg(feature = "arbitrary")]
    pub fn random<R: rand::Rng>(rng: &mut R) -> Self {
        use arbitrary::{Arbitrary, Unstructured};
        let mut buf = [0u8; 1024];
        rng.fill_bytes(&mut buf);
        let mut unstructured = Unstructured::new(&buf);
        Self::arbitrary(&mut unstructured).unwrap_or_default()
    }
}
impl Default for NAMED_VALUE_INT_DATA {
    fn default() -> Self {
        Self::DEFAULT.clone()
    }
}
impl MessageData for NAMED_VALUE_INT_DATA {
    type Message = MavMessage;
    const ID: u32 = 252u32;
    const NAME: &'static str = "NAMED_VALUE_INT";
    const EXTRA_CRC: u8 = 44u8;
    const ENCODED_LEN: usize = 18usize;
    fn deser(_version: MavlinkVersion, __input: &[u8]) -> Result<Self, ::mavlink_core::error::ParserError> {
        let avail_len = __input.len();
        let mut payload_buf;
        let mut buf = if avail_len < Self::ENCODED_LEN {
            payload_buf = [0; Self::ENCODED_LEN];
            payload_buf[0..avail_len].copy_from_slice(__input);
            Bytes::new(&payload_buf)
        } else {
            Bytes::new(__input)
        };
        let mut __struct = Self::default();
        __struct.time_boot_ms = buf.get_u32_le()?;
        __struct.value = buf.get_i32_le()?;
        let mut tmp = [0_u8; 10usize];
        for v in &mut tmp {
            *v = buf.get_u8()?;
        }
        __struct.name = CharArray::new(tmp);
        Ok(__struct)
    }
    fn ser(&self, version: MavlinkVersion, bytes: &mut [u8]) -> usize {
        let mut __tmp = BytesMut::new(bytes);
        if __tmp.remaining() < Self::ENCODED_LEN {
            panic!("buffer is too small (need {} bytes, but got {})", Self::ENCODED_LEN, __tmp.remaining(),)
        }
        __tmp.put_u32_le(self.time_boot_ms);
        __tmp.put_i32_le(self.value);
        for val in &self.name {
            __tmp.put_u8(*val);
        }
        if matches!(version, MavlinkVersion::V2) {
            let len = __tmp.len();
            ::mavlink_core::utils::remove_trailing_zeroes(&bytes[..len])
        } else {
            __tmp.len()
        }
    }
}
#[doc = "Pose and velocity with their covariances."]
#[doc = ""]
#[doc = "ID: 331"]
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(Serialize, Deserialize))]
#[cfg_attr(feature = "arbitrary", derive(Arbitrary))]
#[cfg_attr(feature = "ts-rs", derive(TS))]
#[cfg_attr(feature = "ts-rs", ts(export))]
pub struct ODOMETRY_DATA {
    #[doc = "Time since boot."]
    pub time_usec: u64,
    #[doc = "X."]
    pub x: f32,
    #[doc = "Y."]
    pub y: f32,
    #[doc = "Z."]
    pub z: f32,
    #[doc = "Q."]
    #[cfg_attr(feature = "serde", serde(with = "serde_arrays"))]
    #[cfg_attr(feature = "ts-rs", ts(type = "Array<number>"))]
    pub q: [f32; 4],
    #[doc = "Vx."]
    pub vx: f32,
    #[doc = "Vy."]
    pub vy: f32,
    #[doc = "Vz."]
    pub vz: f32,
    #[doc = "Rollspeed."]
    pub rollspeed: f32,
    #[doc = "Pitchspeed."]
    pub pitchspeed: f32,
    #[doc = "Yawspeed."]
    pub yawspeed: f32,
    #[doc = "Pose covariance."]
    #[cfg_attr(feature = "serde", serde(with = "serde_arrays"))]
    #[cfg_attr(feature = "ts-rs", ts(type = "Array<number>"))]
    pub pose_covariance: [f32; 21],
    #[doc = "Velocity covariance."]
    #[cfg_attr(feature = "serde", serde(with = "serde_arrays"))]
    #[cfg_attr(feature = "ts-rs", ts(type = "Array<number>"))]
    pub velocity_covariance: [f32; 21],
    #[doc = "Frame id."]
    pub frame_id: u8,
    #[doc = "Child frame id."]
    pub child_frame_id: u8,
    #[doc = "Reset counter."]
    #[cfg_attr(feature = "serde", serde(default = "crate::utils::RustDefault::rust_default"))]
    pub reset_counter: u8,
    #[doc = "Estimator type."]
    #[cfg_attr(feature = "serde", serde(default = "crate::utils::RustDefault::rust_default"))]
    pub estimator_type: u8,
    #[doc = "Quality."]
    #[cfg_attr(feature = "serde", serde(default = "crate::utils::RustDefault::rust_default"))]
    pub quality: i8,
}
impl ODOMETRY_DATA {
    pub const ENCODED_LEN: usize = 233usize;
    pub const DEFAULT: Self = Self {
        time_usec: 0_u64,
        x: 0.0_f32,
        y: 0.0_f32,
        z: 0.0_f32,
        q: [0.0_f32; 4usize],
        vx: 0.0_f32,
        vy: 0.0_f32,
        vz: 0.0_f32,
        rollspeed: 0.0_f32,
        pitchspeed: 0.0_f32,
        yawspeed: 0.0_f32,
        pose_covariance: [0.0_f32; 21usize],
        velocity_covariance: [0.0_f32; 21usize],
        frame_id: 0_u8,
        child_frame_id: 0_u8,
        reset_counter: 0_u8,
        estimator_type: 0_u8,
        quality: 0_i8,
    };
    #[cfg(feature = "arbitrary")]
    pub fn random<R: rand::Rng>(rng: &mut R) -> Self {
        use arbitrary::{Arbitrary, Unstructured};
        let mut buf = [0u8; 1024];
        rng.fill_bytes(&mut buf);
        let mut unstructured = Unstructured::new(&buf);
        Self::arbitrary(&mut unstructured).unwrap_or_default()
    }
}
impl Default for ODOMETRY_DATA {
    fn default() -> Self {
        Self::DEFAULT.clone()
    }
}
impl MessageData for ODOMETRY_DATA {
    type Message = MavMessage;
    const ID: u32 = 331u32;
    const NAME: &'static str = "ODOMETRY";
    const EXTRA_CRC: u8 = 91u8;
    const ENCODED_LEN: usize = 233usize;
    fn deser(_version: MavlinkVersion, __input: &[u8]) -> Result<Self, ::mavlink_core::error::ParserError> {
        let avail_len = __input.len();
        let mut payload_buf;
        let mut buf = if avail_len < Self::ENCODED_LEN {
            payload_buf = [0; Self::ENCODED_LEN];
            payload_buf[0..avail_len].copy_from_slice(__input);
            Bytes::new(&payload_buf)
        } else {
            Bytes::new(__input)
        };
        let mut __struct = Self::default();
        __struct.time_usec = buf.get_u64_le()?;
        __struct.x = buf.get_f32_le()?;
        __struct.y = buf.get_f32_le()?;
        __struct.z = buf.get_f32_le()?;
        for v in &mut __struct.q {
            let val = buf.get_f32_le()?;
            *v = val;
        }
        __struct.vx = buf.get_f32_le()?;
        __struct.vy = buf.get_f32_le()?;
        __struct.vz = buf.get_f32_le()?;
        __struct.rollspeed = buf.get_f32_le()?;
        __struct.pitchspeed = buf.get_f32_le()?;
        __struct.yawspeed = buf.get_f32_le()?;
        for v in &mut __struct.pose_covariance {
            let val = buf.get_f32_le()?;
            *v = val;
        }
        for v in &mut __struct.velocity_covariance {
            let val = buf.get_f32_le()?;
            *v = val;
        }
        __struct.frame_id = buf.get_u8()?;
        __struct.child_frame_id = buf.get_u8()?;
        __struct.reset_counter = buf.get_u8()?;
        __struct.estimator_type = buf.get_u8()?;
        __struct.quality = buf.get_i8()?;
        Ok(__struct)
    }
    fn ser(&self, version: MavlinkVersion, bytes: &mut [u8]) -> usize {
        let mut __tmp = BytesMut::new(bytes);
        if __tmp.remaining() < Self::ENCODED_LEN {
            panic!("buffer is too small (need {} bytes, but got {})", Self::ENCODED_LEN, __tmp.remaining(),)
        }
        __tmp.put_u64_le(self.time_usec);
        __tmp.put_f32_le(self.x);
        __tmp.put_f32_le(self.y);
        __tmp.put_f32_le(self.z);
        for val in &self.q {
            __tmp.put_f32_le(*val);
        }
        __tmp.put_f32_le(self.vx);
        __tmp.put_f32_le(self.vy);
        __tmp.put_f32_le(self.vz);
        __tmp.put_f32_le(self.rollspeed);
        __tmp.put_f32_le(self.pitchspeed);
        __tmp.put_f32_le(self.yawspeed);
        for val in &self.pose_covariance {
            __tmp.put_f32_le(*val);
        }
        for val in &self.velocity_covariance {
            __tmp.put_f32_le(*val);
        }
        __tmp.put_u8(self.frame_id);
        __tmp.put_u8(self.child_frame_id);
        if matches!(version, MavlinkVersion::V2) {
            __tmp.put_u8(self.reset_counter);
            __tmp.put_u8(self.estimator_type);
            __tmp.put_i8(self.quality);
            let len = __tmp.len();
            ::mavlink_core::utils::remove_trailing_zeroes(&bytes[..len])
        } else {
            __tmp.len()
        }
    }
}
#[doc = "The circle that is flown."]
#[doc = ""]
#[doc = "ID: 360"]
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(Serialize, Deserialize))]
#[cfg_attr(feature = "arbitrary", derive(Arbitrary))]
#[cfg_attr(feature = "ts-rs", derive(TS))]
#[cfg_attr(feature = "ts-rs", ts(export))]
pub struct ORBIT_EXECUTION_STATUS_DATA {
    #[doc = "Time since boot."]
    pub time_usec: u64,
    #[doc = "Radius, negative if it is flown counter-clockwise."]
    pub radius: f32,
    #[doc = "x of the centre, or latitude."]
    pub x: i32,
    #[doc = "y of the centre, or longitude."]
    pub y: i32,
    #[doc = "Height of the centre."]
    pub z: f32,
    #[doc = "MAV_FRAME of x, y and z."]
    pub frame: u8,
}
impl ORBIT_EXECUTION_STATUS_DATA {
    pub const ENCODED_LEN: usize = 25usize;
    pub const DEFAULT: Self = Self { time_usec: 0_u64, radius: 0.0_f32, x: 0_i32, y: 0_i32, z: 0.0_f32, frame: 0_u8 };
    #[cfg(feature = "arbitrary")]
    pub fn random<R: rand::Rng>(rng: &mut R) -> Self {
        use arbitrary::{Arbitrary, Unstructured};
        let mut buf = [0u8; 1024];
        rng.fill_bytes(&mut buf);
        let mut unstructured = Unstructured::new(&buf);
        Self::arbitrary(&mut unstructured).unwrap_or_default()
    }
}
impl Default for ORBIT_EXECUTION_STATUS_DATA {
    fn default() -> Self {
        Self::DEFAULT.clone()
    }
}
impl MessageData for ORBIT_EXECUTION_STATUS_DATA {
    type Message = MavMessage;
    const ID: u32 = 360u32;
    const NAME: &'static str = "ORBIT_EXECUTION_STATUS";
    const EXTRA_CRC: u8 = 11u8;
    const ENCODED_LEN: usize = 25usize;
    fn deser(_version: MavlinkVersion, __input: &[u8]) -> Result<Self, ::mavlink_core::error::ParserError> {
        let avail_len = __input.len();
        let mut payload_buf;
        let mut buf = if avail_len < Self::ENCODED_LEN {
            payload_buf = [0; Self::ENCODED_LEN];
            payload_buf[0..avail_len].copy_from_slice(__input);
            Bytes::new(&payload_buf)
        } else {
            Bytes::new(__input)
        };
        let mut __struct = Self::default();
        __struct.time_usec = buf.get_u64_le()?;
        __struct.radius = buf.get_f32_le()?;
        __struct.x = buf.get_i32_le()?;
        __struct.y = buf.get_i32_le()?;
        __struct.z = buf.get_f32_le()?;
        __struct.frame = buf.get_u8()?;
        Ok(__struct)
    }
    fn ser(&self, version: MavlinkVersion, bytes: &mut [u8]) -> usize {
        let mut __tmp = BytesMut::new(bytes);
        if __tmp.remaining() < Self::ENCODED_LEN {
            panic!("buffer is too small (need {} bytes, but got {})", Self::ENCODED_LEN, __tmp.remaining(),)
        }
        __tmp.put_u64_le(self.time_usec);
        __tmp.put_f32_le(self.radius);
        __tmp.put_i32_le(self.x);
        __tmp.put_i32_le(self.y);
        __tmp.put_f32_le(self.z);
        __tmp.put_u8(self.frame);
        if matches!(version, MavlinkVersion::V2) {
            let len = __tmp.len();
            ::mavlink_core::utils::remove_trailing_zeroes(&bytes[..len])
        } else {
            __tmp.len()
        }
    }
}
#[doc = "Why a parameter was refused."]
#[doc = ""]
#[doc = "ID: 345"]
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(Serialize, Deserialize))]
#[cfg_attr(feature = "arbitrary", derive(Arbitrary))]
#[cfg_attr(feature = "ts-rs", derive(TS))]
#[cfg_attr(feature = "ts-rs", ts(export))]
pub struct PARAM_ERROR_DATA {
    #[doc = "Its number, -1 to go by the name."]
    pub param_index: i16,
    #[doc = "System."]
    pub target_system: u8,
    #[doc = "Component."]
    pub target_component: u8,
    #[doc = "Name."]
    #[cfg_attr(feature = "ts-rs", ts(type = "string"))]
    pub param_id: CharArray<16>,
    #[doc = "Error."]
    pub error: u8,
}
impl PARAM_ERROR_DATA {
    pub const ENCODED_LEN: usize = 21usize;
    pub const DEFAULT: Self = Self {
        param_index: 0_i16,
        target_system: 0_u8,
        target_component: 0_u8,
        param_id: CharArray::new([0_u8; 16usize]),
        error: 0_u8,
    };
    #[cfg(feature = "arbitrary")]
    pub fn random<R: rand::Rng>(rng: &mut R) -> Self {
        use arbitrary::{Arbitrary, Unstructured};
        let mut buf = [0u8; 1024];
        rng.fill_bytes(&mut buf);
        let mut unstructured = Unstructured::new(&buf);
        Self::arbitrary(&mut unstructured).unwrap_or_default()
    }
}
impl Default for PARAM_ERROR_DATA {
    fn default() -> Self {
        Self::DEFAULT.clone()
    }
}
impl MessageData for PARAM_ERROR_DATA {
    type Message = MavMessage;
    const ID: u32 = 345u32;
    const NAME: &'static str = "PARAM_ERROR";
    const EXTRA_CRC: u8 = 209u8;
    const ENCODED_LEN: usize = 21usize;
    fn deser(_version: MavlinkVersion, __input: &[u8]) -> Result<Self, ::mavlink_core::error::ParserError> {
        let avail_len = __input.len();
        let mut payload_buf;
        let mut buf = if avail_len < Self::ENCODED_LEN {
            payload_buf = [0; Self::ENCODED_LEN];
            payload_buf[0..avail_len].copy_from_slice(__input);
            Bytes::new(&payload_buf)
        } else {
            Bytes::new(__input)
        };
        let mut __struct = Self::default();
        __struct.param_index = buf.get_i16_le()?;
        __struct.target_system = buf.get_u8()?;
        __struct.target_component = buf.get_u8()?;
        let mut tmp = [0_u8; 16usize];
        for v in &mut tmp {
            *v = buf.get_u8()?;
        }
        __struct.param_id = CharArray::new(tmp);
        __struct.error = buf.get_u8()?;
        Ok(__struct)
    }
    fn ser(&self, version: MavlinkVersion, bytes: &mut [u8]) -> usize {
        let mut __tmp = BytesMut::new(bytes);
        if __tmp.remaining() < Self::ENCODED_LEN {
            panic!("buffer is too small (need {} bytes, but got {})", Self::ENCODED_LEN, __tmp.remaining(),)
        }
        __tmp.put_i16_le(self.param_index);
        __tmp.put_u8(self.target_system);
        __tmp.put_u8(self.target_component);
        for val in &self.param_id {
            __tmp.put_u8(*val);
        }
        __tmp.put_u8(self.error);
        if matches!(version, MavlinkVersion::V2) {
            let len = __tmp.len();
            ::mavlink_core::utils::remove_trailing_zeroes(&bytes[..len])
        } else {
            __tmp.len()
        }
    }
}
#[doc = "Answers PARAM_EXT_SET."]
#[doc = ""]
#[doc = "ID: 324"]
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(Serialize, Deserialize))]
#[cfg_attr(feature = "arbitrary", derive(Arbitrary))]
#[cfg_attr(feature = "ts-rs", derive(TS))]
#[cfg_attr(feature = "ts-rs", ts(export))]
pub struct PARAM_EXT_ACK_DATA {
    #[doc = "Name."]
    #[cfg_attr(feature = "ts-rs", ts(type = "string"))]
    pub param_id: CharArray<16>,
    #[doc = "Value."]
    #[cfg_attr(feature = "ts-rs", ts(type = "string"))]
    pub param_value: CharArray<128>,
    #[doc = "Type."]
    pub param_type: u8,
    #[doc = "Result."]
    pub param_result: u8,
}
impl PARAM_EXT_ACK_DATA {
    pub const ENCODED_LEN: usize = 146usize;
    pub const DEFAULT: Self = Self {
        param_id: CharArray::new([0_u8; 16usize]),
        param_value: CharArray::new([0_u8; 128usize]),
        param_type: 0_u8,
        param_result: 0_u8,
    };
    #[cfg(feature = "arbitrary")]
    pub fn random<R: rand::Rng>(rng: &mut R) -> Self {
        use arbitrary::{Arbitrary, Unstructured};
        let mut buf = [0u8; 1024];
        rng.fill_bytes(&mut buf);
        let mut unstructured = Unstructured::new(&buf);
        Self::arbitrary(&mut unstructured).unwrap_or_default()
    }
}
impl Default for PARAM_EXT_ACK_DATA {
    fn default() -> Self {
        Self::DEFAULT.clone()
    }
}
impl MessageData for PARAM_EXT_ACK_DATA {
    type Message = MavMessage;
    const ID: u32 = 324u32;
    const NAME: &'static str = "PARAM_EXT_ACK";
    const EXTRA_CRC: u8 = 132u8;
    const ENCODED_LEN: usize = 146usize;
    fn deser(_version: MavlinkVersion, __input: &[u8]) -> Result<Self, ::mavlink_core::error::ParserError> {
        let avail_len = __input.len();
        let mut payload_buf;
        let mut buf = if avail_len < Self::ENCODED_LEN {
            payload_buf = [0; Self::ENCODED_LEN];
            payload_buf[0..avail_len].copy_from_slice(__input);
            Bytes::new(&payload_buf)
        } else {
            Bytes::new(__input)
        };
        let mut __struct = Self::default();
        let mut tmp = [0_u8; 16usize];
        for v in &mut tmp {
            *v = buf.get_u8()?;
        }
        __struct.param_id = CharArray::new(tmp);
        let mut tmp = [0_u8; 128usize];
        for v in &mut tmp {
            *v = buf.get_u8()?;
        }
        __struct.param_value = CharArray::new(tmp);
        __struct.param_type = buf.get_u8()?;
        __struct.param_result = buf.get_u8()?;
        Ok(__struct)
    }
    fn ser(&self, version: MavlinkVersion, bytes: &mut [u8]) -> usize {
        let mut __tmp = BytesMut::new(bytes);
        if __tmp.remaining() < Self::ENCODED_LEN {
            panic!("buffer is too small (need {} bytes, but got {})", Self::ENCODED_LEN, __tmp.remaining(),)
        }
        for val in &self.param_id {
            __tmp.put_u8(*val);
        }
        for val in &self.param_value {
            __tmp.put_u8(*val);
        }
        __tmp.put_u8(self.param_type);
        __tmp.put_u8(self.param_result);
        if matches!(version, MavlinkVersion::V2) {
            let len = __tmp.len();
            ::mavlink_core::utils::remove_trailing_zeroes(&bytes[..len])
        } else {
            __tmp.len()
        }
    }
}
#[doc = "Asks for all extended parameters."]
#[doc = ""]
#[doc = "ID: 321"]
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(Serialize, Deserialize))]
#[cfg_attr(feature = "arbitrary", derive(Arbitrary))]
#[cfg_attr(feature = "ts-rs", derive(TS))]
#[cfg_attr(feature = "ts-rs", ts(export))]
pub struct PARAM_EXT_REQUEST_LIST_DATA {
    #[doc = "System."]
    pub target_system: u8,
    #[doc = "Component."]
    pub target_component: u8,
}
impl PARAM_EXT_REQUEST_LIST_DATA {
    pub const ENCODED_LEN: usize = 2usize;
    pub const DEFAULT: Self = Self { target_system: 0_u8, target_component: 0_u8 };
    #[cfg(feature = "arbitrary")]
    pub fn random<R: rand::Rng>(rng: &mut R) -> Self {
        use arbitrary::{Arbitrary, Unstructured};
        let mut buf = [0u8; 1024];
        rng.fill_bytes(&mut buf);
        let mut unstructured = Unstructured::new(&buf);
        Self::arbitrary(&mut unstructured).unwrap_or_default()
    }
}
impl Default for PARAM_EXT_REQUEST_LIST_DATA {
    fn default() -> Self {
        Self::DEFAULT.clone()
    }
}
impl MessageData for PARAM_EXT_REQUEST_LIST_DATA {
    type Message = MavMessage;
    const ID: u32 = 321u32;
    const NAME: &'static str = "PARAM_EXT_REQUEST_LIST";
    const EXTRA_CRC: u8 = 88u8;
    const ENCODED_LEN: usize = 2usize;
    fn deser(_version: MavlinkVersion, __input: &[u8]) -> Result<Self, ::mavlink_core::error::ParserError> {
        let avail_len = __input.len();
        let mut payload_buf;
        let mut buf = if avail_len < Self::ENCODED_LEN {
            payload_buf = [0; Self::ENCODED_LEN];
            payload_buf[0..avail_len].copy_from_slice(__input);
            Bytes::new(&payload_buf)
        } else {
            Bytes::new(__input)
        };
        let mut __struct = Self::default();
        __struct.target_system = buf.get_u8()?;
        __struct.target_component = buf.get_u8()?;
        Ok(__struct)
    }
    fn ser(&self, version: MavlinkVersion, bytes: &mut [u8]) -> usize {
        let mut __tmp = BytesMut::new(bytes);
        if __tmp.remaining() < Self::ENCODED_LEN {
            panic!("buffer is too small (need {} bytes, but got {})", Self::ENCODED_LEN, __tmp.remaining(),)
        }
        __tmp.put_u8(self.target_system);
        __tmp.put_u8(self.target_component);
        if matches!(version, MavlinkVersion::V2) {
            let len = __tmp.len();
            ::mavlink_core::utils::remove_trailing_zeroes(&bytes[..len])
        } else {
            __tmp.len()
        }
    }
}
#[doc = "Asks for an extended parameter."]
#[doc = ""]
#[doc = "ID: 320"]
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(Serialize, Deserialize))]
#[cfg_attr(feature = "arbitrary", derive(Arbitrary))]
#[cfg_attr(feature = "ts-rs", derive(TS))]
#[cfg_attr(feature = "ts-rs", ts(export))]
pub struct PARAM_EXT_REQUEST_READ_DATA {
    #[doc = "Its number; -1: by name."]
    pub param_index: i16,
    #[doc = "System."]
    pub target_system: u8,
    #[doc = "Component."]
    pub target_component: u8,
    #[doc = "Name."]
    #[cfg_attr(feature = "ts-rs", ts(type = "string"))]
    pub param_id: CharArray<16>,
}
impl PARAM_EXT_REQUEST_READ_DATA {
    pub const ENCODED_LEN: usize = 20usize;
    pub const DEFAULT: Self = Self {
        param_index: 0_i16,
        target_system: 0_u8,
        target_component: 0_u8,
        param_id: CharArray::new([0_u8; 16usize]),
    };
    #[cfg(feature = "arbitrary")]
    pub fn random<R: rand::Rng>(rng: &mut R) -> Self {
        use arbitrary::{Arbitrary, Unstructured};
        let mut buf = [0u8; 1024];
        rng.fill_bytes(&mut buf);
        let mut unstructured = Unstructured::new(&buf);
        Self::arbitrary(&mut unstructured).unwrap_or_default()
    }
}
impl Default for PARAM_EXT_REQUEST_READ_DATA {
    fn default() -> Self {
        Self::DEFAULT.clone()
    }
}
impl MessageData for PARAM_EXT_REQUEST_READ_DATA {
    type Message = MavMessage;
    const ID: u32 = 320u32;
    const NAME: &'static str = "PARAM_EXT_REQUEST_READ";
    const EXTRA_CRC: u8 = 243u8;
    const ENCODED_LEN: usize = 20usize;
    fn deser(_version: MavlinkVersion, __input: &[u8]) -> Result<Self, ::mavlink_core::error::ParserError> {
        let avail_len = __input.len();
        let mut payload_buf;
        let mut buf = if avail_len < Self::ENCODED_LEN {
            payload_buf = [0; Self::ENCODED_LEN];
            payload_buf[0..avail_len].copy_from_slice(__input);
            Bytes::new(&payload_buf)
        } else {
            Bytes::new(__input)
        };
        let mut __struct = Self::default();
        __struct.param_index = buf.get_i16_le()?;
        __struct.target_system = buf.get_u8()?;
        __struct.target_component = buf.get_u8()?;
        let mut tmp = [0_u8; 16usize];
        for v in &mut tmp {
            *v = buf.get_u8()?;
        }
        __struct.param_id = CharArray::new(tmp);
        Ok(__struct)
    }
    fn ser(&self, version: MavlinkVersion, bytes: &mut [u8]) -> usize {
        let mut __tmp = BytesMut::new(bytes);
        if __tmp.remaining() < Self::ENCODED_LEN {
            panic!("buffer is too small (need {} bytes, but got {})", Self::ENCODED_LEN, __tmp.remaining(),)
        }
        __tmp.put_i16_le(self.param_index);
        __tmp.put_u8(self.target_system);
        __tmp.put_u8(self.target_component);
        for val in &self.param_id {
            __tmp.put_u8(*val);
        }
        if matches!(version, MavlinkVersion::V2) {
            let len = __tmp.len();
            ::mavlink_core::utils::remove_trailing_zeroes(&bytes[..len])
        } else {
            __tmp.len()
        }
    }
}
#[doc = "Sets an extended parameter."]
#[doc = ""]
#[doc = "ID: 323"]
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(Serialize, Deserialize))]
#[cfg_attr(feature = "arbitrary", derive(Arbitrary))]
#[cfg_attr(feature = "ts-rs", derive(TS))]
#[cfg_attr(feature = "ts-rs", ts(export))]
pub struct PARAM_EXT_SET_DATA {
    #[doc = "System."]
    pub target_system: u8,
    #[doc = "Component."]
    pub target_component: u8,
    #[doc = "Name."]
    #[cfg_attr(feature = "ts-rs", ts(type = "string"))]
    pub param_id: CharArray<16>,
    #[doc = "Value."]
    #[cfg_attr(feature = "ts-rs", ts(type = "string"))]
    pub param_value: CharArray<128>,
    #[doc = "Type."]
    pub param_type: u8,
}
impl PARAM_EXT_SET_DATA {
    pub const ENCODED_LEN: usize = 147usize;
    pub const DEFAULT: Self = Self {
        target_system: 0_u8,
        target_component: 0_u8,
        param_id: CharArray::new([0_u8; 16usize]),
        param_value: CharArray::new([0_u8; 128usize]),
        param_type: 0_u8,
    };
    #[cfg(feature = "arbitrary")]
    pub fn random<R: rand::Rng>(rng: &mut R) -> Self {
        use arbitrary::{Arbitrary, Unstructured};
        let mut buf = [0u8; 1024];
        rng.fill_bytes(&mut buf);
        let mut unstructured = Unstructured::new(&buf);
        Self::arbitrary(&mut unstructured).unwrap_or_default()
    }
}
impl Default for PARAM_EXT_SET_DATA {
    fn default() -> Self {
        Self::DEFAULT.clone()
    }
}
impl MessageData for PARAM_EXT_SET_DATA {
    type Message = MavMessage;
    const ID: u32 = 323u32;
    const NAME: &'static str = "PARAM_EXT_SET";
    const EXTRA_CRC: u8 = 78u8;
    const ENCODED_LEN: usize = 147usize;
    fn deser(_version: MavlinkVersion, __input: &[u8]) -> Result<Self, ::mavlink_core::error::ParserError> {
        let avail_len = __input.len();
        let mut payload_buf;
        let mut buf = if avail_len < Self::ENCODED_LEN {
            payload_buf = [0; Self::ENCODED_LEN];
            payload_buf[0..avail_len].copy_from_slice(__input);
            Bytes::new(&payload_buf)
        } else {
            Bytes::new(__input)
        };
        let mut __struct = Self::default();
        __struct.target_system = buf.get_u8()?;
        __struct.target_component = buf.get_u8()?;
        let mut tmp = [0_u8; 16usize];
        for v in &mut tmp {
            *v = buf.get_u8()?;
        }
        __struct.param_id = CharArray::new(tmp);
        let mut tmp = [0_u8; 128usize];
        for v in &mut tmp {
            *v = buf.get_u8()?;
        }
        __struct.param_value = CharArray::new(tmp);
        __struct.param_type = buf.get_u8()?;
        Ok(__struct)
    }
    fn ser(&self, version: MavlinkVersion, bytes: &mut [u8]) -> usize {
        let mut __tmp = BytesMut::new(bytes);
        if __tmp.remaining() < Self::ENCODED_LEN {
            panic!("buffer is too small (need {} bytes, but got {})", Self::ENCODED_LEN, __tmp.remaining(),)
        }
        __tmp.put_u8(self.target_system);
        __tmp.put_u8(self.target_component);
        for val in &self.param_id {
            __tmp.put_u8(*val);
        }
        for val in &self.param_value {
            __tmp.put_u8(*val);
        }
        __tmp.put_u8(self.param_type);
        if matches!(version, MavlinkVersion::V2) {
            let len = __tmp.len();
            ::mavlink_core::utils::remove_trailing_zeroes(&bytes[..len])
        } else {
            __tmp.len()
        }
    }
}
#[doc = "An extended parameter."]
#[doc = ""]
#[doc = "ID: 322"]
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(Serialize, Deserialize))]
#[cfg_attr(feature = "arbitrary", derive(Arbitrary))]
#[cfg_attr(feature = "ts-rs", derive(TS))]
#[cfg_attr(feature = "ts-rs", ts(export))]
pub struct PARAM_EXT_VALUE_DATA {
    #[doc = "How many there are."]
    pub param_count: u16,
    #[doc = "Its number."]
    pub param_index: u16,
    #[doc = "Name."]
    #[cfg_attr(feature = "ts-rs", ts(type = "string"))]
    pub param_id: CharArray<16>,
    #[doc = "Value."]
    #[cfg_attr(feature = "ts-rs", ts(type = "string"))]
    pub param_value: CharArray<128>,
    #[doc = "Type."]
    pub param_type: u8,
}
impl PARAM_EXT_VALUE_DATA {
    pub const ENCODED_LEN: usize = 149usize;
    pub const DEFAULT: Self = Self {
        param_count: 0_u16,
        param_index: 0_u16,
        param_id: CharArray::new([0_u8; 16usize]),
        param_value: CharArray::new([0_u8; 128usize]),
        param_type: 0_u8,
    };
    #[cfg(feature = "arbitrary")]
    pub fn random<R: rand::Rng>(rng: &mut R) -> Self {
        use arbitrary::{Arbitrary, Unstructured};
        let mut buf = [0u8; 1024];
        rng.fill_bytes(&mut buf);
        let mut unstructured = Unstructured::new(&buf);
        Self::arbitrary(&mut unstructured).unwrap_or_default()
    }
}
impl Default for PARAM_EXT_VALUE_DATA {
    fn default() -> Self {
        Self::DEFAULT.clone()
    }
}
impl MessageData for PARAM_EXT_VALUE_DATA {
    type Message = MavMessage;
    const ID: u32 = 322u32;
    const NAME: &'static str = "PARAM_EXT_VALUE";
    const EXTRA_CRC: u8 = 243u8;
    const ENCODED_LEN: usize = 149usize;
    fn deser(_version: MavlinkVersion, __input: &[u8]) -> Result<Self, ::mavlink_core::error::ParserError> {
        let avail_len = __input.len();
        let mut payload_buf;
        let mut buf = if avail_len < Self::ENCODED_LEN {
            payload_buf = [0; Self::ENCODED_LEN];
            payload_buf[0..avail_len].copy_from_slice(__input);
            Bytes::new(&payload_buf)
        } else {
            Bytes::new(__input)
        };
        let mut __struct = Self::default();
        __struct.param_count = buf.get_u16_le()?;
        __struct.param_index = buf.get_u16_le()?;
        let mut tmp = [0_u8; 16usize];
        for v in &mut tmp {
            *v = buf.get_u8()?;
        }
        __struct.param_id = CharArray::new(tmp);
        let mut tmp = [0_u8; 128usize];
        for v in &mut tmp {
            *v = buf.get_u8()?;
        }
        __struct.param_value = CharArray::new(tmp);
        __struct.param_type = buf.get_u8()?;
        Ok(__struct)
    }
    fn ser(&self, version: MavlinkVersion, bytes: &mut [u8]) -> usize {
        let mut __tmp = BytesMut::new(bytes);
        if __tmp.remaining() < Self::ENCODED_LEN {
            panic!("buffer is too small (need {} bytes, but got {})", Self::ENCODED_LEN, __tmp.remaining(),)
        }
        __tmp.put_u16_le(self.param_count);
        __tmp.put_u16_le(self.param_index);
        for val in &self.param_id {
            __tmp.put_u8(*val);
        }
        for val in &self.param_value {
            __tmp.put_u8(*val);
        }
        __tmp.put_u8(self.param_type);
        if matches!(version, MavlinkVersion::V2) {
            let len = __tmp.len();
            ::mavlink_core::utils::remove_trailing_zeroes(&bytes[..len])
        } else {
            __tmp.len()
        }
    }
}
#[doc = "Asks for all parameters."]
#[doc = ""]
#[doc = "ID: 21"]
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(Serialize, Deserialize))]
#[cfg_attr(feature = "arbitrary", derive(Arbitrary))]
#[cfg_attr(feature = "ts-rs", derive(TS))]
#[cfg_attr(feature = "ts-rs", ts(export))]
pub struct PARAM_REQUEST_LIST_DATA {
    #[doc = "System."]
    pub target_system: u8,
    #[doc = "Component."]
    pub target_component: u8,
}
impl PARAM_REQUEST_LIST_DATA {
    pub const ENCODED_LEN: usize = 2usize;
    pub const DEFAULT: Self = Self { target_system: 0_u8, target_component: 0_u8 };
    #[cfg(feature = "arbitrary")]
    pub fn random<R: rand::Rng>(rng: &mut R) -> Self {
        use arbitrary::{Arbitrary, Unstructured};
        let mut buf = [0u8; 1024];
        rng.fill_bytes(&mut buf);
        let mut unstructured = Unstructured::new(&buf);
        Self::arbitrary(&mut unstructured).unwrap_or_default()
    }
}
impl Default for PARAM_REQUEST_LIST_DATA {
    fn default() -> Self {
        Self::DEFAULT.clone()
    }
}
impl MessageData for PARAM_REQUEST_LIST_DATA {
    type Message = MavMessage;
    const ID: u32 = 21u32;
    const NAME: &'static str = "PARAM_REQUEST_LIST";
    const EXTRA_CRC: u8 = 159u8;
    const ENCODED_LEN: usize = 2usize;
    fn deser(_version: MavlinkVersion, __input: &[u8]) -> Result<Self, ::mavlink_core::error::ParserError> {
        let avail_len = __input.len();
        let mut payload_buf;
        let mut buf = if avail_len < Self::ENCODED_LEN {
            payload_buf = [0; Self::ENCODED_LEN];
            payload_buf[0..avail_len].copy_from_slice(__input);
            Bytes::new(&payload_buf)
        } else {
            Bytes::new(__input)
        };
        let mut __struct = Self::default();
        __struct.target_system = buf.get_u8()?;
        __struct.target_component = buf.get_u8()?;
        Ok(__struct)
    }
    fn ser(&self, version: MavlinkVersion, bytes: &mut [u8]) -> usize {
        let mut __tmp = BytesMut::new(bytes);
        if __tmp.remaining() < Self::ENCODED_LEN {
            panic!("buffer is too small (need {} bytes, but got {})", Self::ENCODED_LEN, __tmp.remaining(),)
        }
        __tmp.put_u8(self.target_system);
        __tmp.put_u8(self.target_component);
        if matches!(version, MavlinkVersion::V2) {
            let len = __tmp.len();
            ::mavlink_core::utils::remove_trailing_zeroes(&bytes[..len])
        } else {
            __tmp.len()
        }
    }
}
#[doc = "Asks for a parameter."]
#[doc = ""]
#[doc = "ID: 20"]
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(Serialize, Deserialize))]
#[cfg_attr(feature = "arbitrary", derive(Arbitrary))]
#[cfg_attr(feature = "ts-rs", derive(TS))]
#[cfg_attr(feature = "ts-rs", ts(export))]
pub struct PARAM_REQUEST_READ_DATA {
    #[doc = "Its number, -1 to go by the name."]
    pub param_index: i16,
    #[doc = "System."]
    pub target_system: u8,
    #[doc = "Component."]
    pub target_component: u8,
    #[doc = "Name."]
    #[cfg_attr(feature = "ts-rs", ts(type = "string"))]
    pub param_id: CharArray<16>,
}
impl PARAM_REQUEST_READ_DATA {
    pub const ENCODED_LEN: usize = 20usize;
    pub const DEFAULT: Self = Self {
        param_index: 0_i16,
        target_system: 0_u8,
        target_component: 0_u8,
        param_id: CharArray::new([0_u8; 16usize]),
    };
    #[cfg(feature = "arbitrary")]
    pub fn random<R: rand::Rng>(rng: &mut R) -> Self {
        use arbitrary::{Arbitrary, Unstructured};
        let mut buf = [0u8; 1024];
        rng.fill_bytes(&mut buf);
        let mut unstructured = Unstructured::new(&buf);
        Self::arbitrary(&mut unstructured).unwrap_or_default()
    }
}
impl Default for PARAM_REQUEST_READ_DATA {
    fn default() -> Self {
        Self::DEFAULT.clone()
    }
}
impl MessageData for PARAM_REQUEST_READ_DATA {
    type Message = MavMessage;
    const ID: u32 = 20u32;
    const NAME: &'static str = "PARAM_REQUEST_READ";
    const EXTRA_CRC: u8 = 214u8;
    const ENCODED_LEN: usize = 20usize;
    fn deser(_version: MavlinkVersion, __input: &[u8]) -> Result<Self, ::mavlink_core::error::ParserError> {
        let avail_len = __input.len();
        let mut payload_buf;
        let mut buf = if avail_len < Self::ENCODED_LEN {
            payload_buf = [0; Self::ENCODED_LEN];
            payload_buf[0..avail_len].copy_from_slice(__input);
            Bytes::new(&payload_buf)
        } else {
            Bytes::new(__input)
        };
        let mut __struct = Self::default();
        __struct.param_index = buf.get_i16_le()?;
        __struct.target_system = buf.get_u8()?;
        __struct.target_component = buf.get_u8()?;
        let mut tmp = [0_u8; 16usize];
        for v in &mut tmp {
            *v = buf.get_u8()?;
        }
        __struct.param_id = CharArray::new(tmp);
        Ok(__struct)
    }
    fn ser(&self, version: MavlinkVersion, bytes: &mut [u8]) -> usize {
        let mut __tmp = BytesMut::new(bytes);
        if __tmp.remaining() < Self::ENCODED_LEN {
            panic!("buffer is too small (need {} bytes, but got {})", Self::ENCODED_LEN, __tmp.remaining(),)
        }
        __tmp.put_i16_le(self.param_index);
        __tmp.put_u8(self.target_system);
        __tmp.put_u8(self.target_component);
        for val in &self.param_id {
            __tmp.put_u8(*val);
        }
        if matches!(version, MavlinkVersion::V2) {
            let len = __tmp.len();
            ::mavlink_core::utils::remove_trailing_zeroes(&bytes[..len])
        } else {
            __tmp.len()
        }
    }
}
#[doc = "Sets a parameter."]
#[doc = ""]
#[doc = "ID: 23"]
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(Serialize, Deserialize))]
#[cfg_attr(feature = "arbitrary", derive(Arbitrary))]
#[cfg_attr(feature = "ts-rs", derive(TS))]
#[cfg_attr(feature = "ts-rs", ts(export))]
pub struct PARAM_SET_DATA {
    #[doc = "Value, bytewise."]
    pub param_value: f32,
    #[doc = "System."]
    pub target_system: u8,
    #[doc = "Component."]
    pub target_component: u8,
    #[doc = "Name."]
    #[cfg_attr(feature = "ts-rs", ts(type = "string"))]
    pub param_id: CharArray<16>,
    #[doc = "Type."]
    pub param_type: u8,
}
impl PARAM_SET_DATA {
    pub const ENCODED_LEN: usize = 23usize;
    pub const DEFAULT: Self = Self {
        param_value: 0.0_f32,
        target_system: 0_u8,
        target_component: 0_u8,
        param_id: CharArray::new([0_u8; 16usize]),
        param_type: 0_u8,
    };
    #[cfg(feature = "arbitrary")]
    pub fn random<R: rand::Rng>(rng: &mut R) -> Self {
        use arbitrary::{Arbitrary, Unstructured};
        let mut buf = [0u8; 1024];
        rng.fill_bytes(&mut buf);
        let mut unstructured = Unstructured::new(&buf);
        Self::arbitrary(&mut unstructured).unwrap_or_default()
    }
}
impl Default for PARAM_SET_DATA {
    fn default() -> Self {
        Self::DEFAULT.clone()
    }
}
impl MessageData for PARAM_SET_DATA {
    type Message = MavMessage;
    const ID: u32 = 23u32;
    const NAME: &'static str = "PARAM_SET";
    const EXTRA_CRC: u8 = 168u8;
    const ENCODED_LEN: usize = 23usize;
    fn deser(_version: MavlinkVersion, __input: &[u8]) -> Result<Self, ::mavlink_core::error::ParserError> {
        let avail_len = __input.len();
        let mut payload_buf;
        let mut buf = if avail_len < Self::ENCODED_LEN {
            payload_buf = [0; Self::ENCODED_LEN];
            payload_buf[0..avail_len].copy_from_slice(__input);
            Bytes::new(&payload_buf)
        } else {
            Bytes::new(__input)
        };
        let mut __struct = Self::default();
        __struct.param_value = buf.get_f32_le()?;
        __struct.target_system = buf.get_u8()?;
        __struct.target_component = buf.get_u8()?;
        let mut tmp = [0_u8; 16usize];
        for v in &mut tmp {
            *v = buf.get_u8()?;
        }
        __struct.param_id = CharArray::new(tmp);
        __struct.param_type = buf.get_u8()?;
        Ok(__struct)
    }
    fn ser(&self, version: MavlinkVersion, bytes: &mut [u8]) -> usize {
        let mut __tmp = BytesMut::new(bytes);
        if __tmp.remaining() < Self::ENCODED_LEN {
            panic!("buffer is too small (need {} bytes, but got {})", Self::ENCODED_LEN, __tmp.remaining(),)
        }
        __tmp.put_f32_le(self.param_value);
        __tmp.put_u8(self.target_system);
        __tmp.put_u8(self.target_component);
        for val in &self.param_id {
            __tmp.put_u8(*val);
        }
        __tmp.put_u8(self.param_type);
        if matches!(version, MavlinkVersion::V2) {
            let len = __tmp.len();
            ::mavlink_core::utils::remove_trailing_zeroes(&bytes[..len])
        } else {
            __tmp.len()
        }
    }
}
#[doc = "A parameter."]
#[doc = ""]
#[doc = "ID: 22"]
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(Serialize, Deserialize))]
#[cfg_attr(feature = "arbitrary", derive(Arbitrary))]
#[cfg_attr(feature = "ts-rs", derive(TS))]
#[cfg_attr(feature = "ts-rs", ts(export))]
pub struct PARAM_VALUE_DATA {
    #[doc = "Value, bytewise."]
    pub param_value: f32,
    #[doc = "How many there are."]
    pub param_count: u16,
    #[doc = "Its number, -1 to go by the name."]
    pub param_index: u16,
    #[doc = "Name."]
    #[cfg_attr(feature = "ts-rs", ts(type = "string"))]
    pub param_id: CharArray<16>,
    #[doc = "Type."]
    pub param_type: u8,
}
impl PARAM_VALUE_DATA {
    pub const ENCODED_LEN: usize = 25usize;
    pub const DEFAULT: Self = Self {
        param_value: 0.0_f32,
        param_count: 0_u16,
        param_index: 0_u16,
        param_id: CharArray::new([0_u8; 16usize]),
        param_type: 0_u8,
    };
    #[cfg(feature = "arbitrary")]
    pub fn random<R: rand::Rng>(rng: &mut R) -> Self {
        use arbitrary::{Arbitrary, Unstructured};
        let mut buf = [0u8; 1024];
        rng.fill_bytes(&mut buf);
        let mut unstructured = Unstructured::new(&buf);
        Self::arbitrary(&mut unstructured).unwrap_or_default()
    }
}
impl Default for PARAM_VALUE_DATA {
    fn default() -> Self {
        Self::DEFAULT.clone()
    }
}
impl MessageData for PARAM_VALUE_DATA {
    type Message = MavMessage;
    const ID: u32 = 22u32;
    const NAME: &'static str = "PARAM_VALUE";
    const EXTRA_CRC: u8 = 220u8;
    const ENCODED_LEN: usize = 25usize;
    fn deser(_version: MavlinkVersion, __input: &[u8]) -> Result<Self, ::mavlink_core::error::ParserError> {
        let avail_len = __input.len();
        let mut payload_buf;
        let mut buf = if avail_len < Self::ENCODED_LEN {
            payload_buf = [0; Self::ENCODED_LEN];
            payload_buf[0..avail_len].copy_from_slice(__input);
            Bytes::new(&payload_buf)
        } else {
            Bytes::new(__input)
        };
        let mut __struct = Self::default();
        __struct.param_value = buf.get_f32_le()?;
        __struct.param_count = buf.get_u16_le()?;
        __struct.param_index = buf.get_u16_le()?;
        let mut tmp = [0_u8; 16usize];
        for v in &mut tmp {
            *v = buf.get_u8()?;
        }
        __struct.param_id = CharArray::new(tmp);
        __struct.param_type = buf.get_u8()?;
        Ok(__struct)
    }
    fn ser(&self, version: MavlinkVersion, bytes: &mut [u8]) -> usize {
        let mut __tmp = BytesMut::new(bytes);
        if __tmp.remaining() < Self::ENCODED_LEN {
            panic!("buffer is too small (need {} bytes, but got {})", Self::ENCODED_LEN, __tmp.remaining(),)
        }
        __tmp.put_f32_le(self.param_value);
        __tmp.put_u16_le(self.param_count);
        __tmp.put_u16_le(self.param_index);
        for val in &self.param_id {
            __tmp.put_u8(*val);
        }
        __tmp.put_u8(self.param_type);
        if matches!(version, MavlinkVersion::V2) {
            let len = __tmp.len();
            ::mavlink_core::utils::remove_trailing_zeroes(&bytes[..len])
        } else {
            __tmp.len()
        }
    }
}
#[doc = "Asks for an answer, or answers."]
#[doc = ""]
#[doc = "ID: 4"]
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(Serialize, Deserialize))]
#[cfg_attr(feature = "arbitrary", derive(Arbitrary))]
#[cfg_attr(feature = "ts-rs", derive(TS))]
#[cfg_attr(feature = "ts-rs", ts(export))]
pub struct PING_DATA {
    #[doc = "Time since boot."]
    pub time_usec: u64,
    #[doc = "Seq."]
    pub seq: u32,
    #[doc = "System."]
    pub target_system: u8,
    #[doc = "Component."]
    pub target_component: u8,
}
impl PING_DATA {
    pub const ENCODED_LEN: usize = 14usize;
    pub const DEFAULT: Self = Self { time_usec: 0_u64, seq: 0_u32, target_system: 0_u8, target_component: 0_u8 };
    #[cfg(feature = "arbitrary")]
    pub fn random<R: rand::Rng>(rng: &mut R) -> Self {
        use arbitrary::{Arbitrary, Unstructured};
        let mut buf = [0u8; 1024];
        rng.fill_bytes(&mut buf);
        let mut unstructured = Unstructured::new(&buf);
        Self::arbitrary(&mut unstructured).unwrap_or_default()
    }
}
impl Default for PING_DATA {
    fn default() -> Self {
        Self::DEFAULT.clone()
    }
}
impl MessageData for PING_DATA {
    type Message = MavMessage;
    const ID: u32 = 4u32;
    const NAME: &'static str = "PING";
    const EXTRA_CRC: u8 = 237u8;
    const ENCODED_LEN: usize = 14usize;
    fn deser(_version: MavlinkVersion, __input: &[u8]) -> Result<Self, ::mavlink_core::error::ParserError> {
        let avail_len = __input.len();
        let mut payload_buf;
        let mut buf = if avail_len < Self::ENCODED_LEN {
            payload_buf = [0; Self::ENCODED_LEN];
            payload_buf[0..avail_len].copy_from_slice(__input);
            Bytes::new(&payload_buf)
        } else {
            Bytes::new(__input)
        };
        let mut __struct = Self::default();
        __struct.time_usec = buf.get_u64_le()?;
        __struct.seq = buf.get_u32_le()?;
        __struct.target_system = buf.get_u8()?;
        __struct.target_component = buf.get_u8()?;
        Ok(__struct)
    }
    fn ser(&self, version: MavlinkVersion, bytes: &mut [u8]) -> usize {
        let mut __tmp = BytesMut::new(bytes);
        if __tmp.remaining() < Self::ENCODED_LEN {
            panic!("buffer is too small (need {} bytes, but got {})", Self::ENCODED_LEN, __tmp.remaining(),)
        }
        __tmp.put_u64_le(self.time_usec);
        __tmp.put_u32_le(self.seq);
        __tmp.put_u8(self.target_system);
        __tmp.put_u8(self.target_component);
        if matches!(version, MavlinkVersion::V2) {
            let len = __tmp.len();
            ::mavlink_core::utils::remove_trailing_zeroes(&bytes[..len])
        } else {
            __tmp.len()
        }
    }
}
#[doc = "Place and velocity that are aimed at."]
#[doc = ""]
#[doc = "ID: 85"]
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(Serialize, Deserialize))]
#[cfg_attr(feature = "arbitrary", derive(Arbitrary))]
#[cfg_attr(feature = "ts-rs", derive(TS))]
#[cfg_attr(feature = "ts-rs", ts(export))]
pub struct POSITION_TARGET_LOCAL_NED_DATA {
    #[doc = "Time since boot."]
    pub time_boot_ms: u32,
    #[doc = "X."]
    pub x: f32,
    #[doc = "Y."]
    pub y: f32,
    #[doc = "Z."]
    pub z: f32,
    #[doc = "Vx."]
    pub vx: f32,
    #[doc = "Vy."]
    pub vy: f32,
    #[doc = "Vz."]
    pub vz: f32,
    #[doc = "Afx."]
    pub afx: f32,
    #[doc = "Afy."]
    pub afy: f32,
    #[doc = "Afz."]
    pub afz: f32,
    #[doc = "Yaw."]
    pub yaw: f32,
    #[doc = "Yaw rate."]
    pub yaw_rate: f32,
    #[doc = "Type mask."]
    pub type_mask: u16,
    #[doc = "Coordinate frame."]
    pub coordinate_frame: u8,
}
impl POSITION_TARGET_LOCAL_NED_DATA {
    pub const ENCODED_LEN: usize = 51usize;
    pub const DEFAULT: Self = Self {
        time_boot_ms: 0_u32,
        x: 0.0_f32,
        y: 0.0_f32,
        z: 0.0_f32,
        vx: 0.0_f32,
        vy: 0.0_f32,
        vz: 0.0_f32,
        afx: 0.0_f32,
        afy: 0.0_f32,
        afz: 0.0_f32,
        yaw: 0.0_f32,
        yaw_rate: 0.0_f32,
        type_mask: 0_u16,
        coordinate_frame: 0_u8,
    };
    #[cfg(feature = "arbitrary")]
    pub fn random<R: rand::Rng>(rng: &mut R) -> Self {
        use arbitrary::{Arbitrary, Unstructured};
        let mut buf = [0u8; 1024];
        rng.fill_bytes(&mut buf);
        let mut unstructured = Unstructured::new(&buf);
        Self::arbitrary(&mut unstructured).unwrap_or_default()
    }
}
impl Default for POSITION_TARGET_LOCAL_NED_DATA {
    fn default() -> Self {
        Self::DEFAULT.clone()
    }
}
impl MessageData for POSITION_TARGET_LOCAL_NED_DATA {
    type Message = MavMessage;
    const ID: u32 = 85u32;
    const NAME: &'static str = "POSITION_TARGET_LOCAL_NED";
    const EXTRA_CRC: u8 = 140u8;
    const ENCODED_LEN: usize = 51usize;
    fn deser(_version: MavlinkVersion, __input: &[u8]) -> Result<Self, ::mavlink_core::error::ParserError> {
        let avail_len = __input.len();
        let mut payload_buf;
        let mut buf = if avail_len < Self::ENCODED_LEN {
            payload_buf = [0; Self::ENCODED_LEN];
            payload_buf[0..avail_len].copy_from_slice(__input);
            Bytes::new(&payload_buf)
        } else {
            Bytes::new(__input)
        };
        let mut __struct = Self::default();
        __struct.time_boot_ms = buf.get_u32_le()?;
        __struct.x = buf.get_f32_le()?;
        __struct.y = buf.get_f32_le()?;
        __struct.z = buf.get_f32_le()?;
        __struct.vx = buf.get_f32_le()?;
        __struct.vy = buf.get_f32_le()?;
        __struct.vz = buf.get_f32_le()?;
        __struct.afx = buf.get_f32_le()?;
        __struct.afy = buf.get_f32_le()?;
        __struct.afz = buf.get_f32_le()?;
        __struct.yaw = buf.get_f32_le()?;
        __struct.yaw_rate = buf.get_f32_le()?;
        __struct.type_mask = buf.get_u16_le()?;
        __struct.coordinate_frame = buf.get_u8()?;
        Ok(__struct)
    }
    fn ser(&self, version: MavlinkVersion, bytes: &mut [u8]) -> usize {
        let mut __tmp = BytesMut::new(bytes);
        if __tmp.remaining() < Self::ENCODED_LEN {
            panic!("buffer is too small (need {} bytes, but got {})", Self::ENCODED_LEN, __tmp.remaining(),)
        }
        __tmp.put_u32_le(self.time_boot_ms);
        __tmp.put_f32_le(self.x);
        __tmp.put_f32_le(self.y);
        __tmp.put_f32_le(self.z);
        __tmp.put_f32_le(self.vx);
        __tmp.put_f32_le(self.vy);
        __tmp.put_f32_le(self.vz);
        __tmp.put_f32_le(self.afx);
        __tmp.put_f32_le(self.afy);
        __tmp.put_f32_le(self.afz);
        __tmp.put_f32_le(self.yaw);
        __tmp.put_f32_le(self.yaw_rate);
        __tmp.put_u16_le(self.type_mask);
        __tmp.put_u8(self.coordinate_frame);
        if matches!(version, MavlinkVersion::V2) {
            let len = __tmp.len();
            ::mavlink_core::utils::remove_trailing_zeroes(&bytes[..len])
        } else {
            __tmp.len()
        }
    }
}
#[doc = "Protocol version."]
#[doc = ""]
#[doc = "ID: 300"]
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(Serialize, Deserialize))]
#[cfg_attr(feature = "arbitrary", derive(Arbitrary))]
#[cfg_attr(feature = "ts-rs", derive(TS))]
#[cfg_attr(feature = "ts-rs", ts(export))]
pub struct PROTOCOL_VERSION_DATA {
    #[doc = "Version."]
    pub version: u16,
    #[doc = "Min version."]
    pub min_version: u16,
    #[doc = "Max version."]
    pub max_version: u16,
    #[doc = "Spec version hash."]
    #[cfg_attr(feature = "serde", serde(with = "serde_arrays"))]
    #[cfg_attr(feature = "ts-rs", ts(type = "Array<number>"))]
    pub spec_version_hash: [u8; 8],
    #[doc = "Library version hash."]
    #[cfg_attr(feature = "serde", serde(with = "serde_arrays"))]
    #[cfg_attr(feature = "ts-rs", ts(type = "Array<number>"))]
    pub library_version_hash: [u8; 8],
}
impl PROTOCOL_VERSION_DATA {
    pub const ENCODED_LEN: usize = 22usize;
    pub const DEFAULT: Self = Self {
        version: 0_u16,
        min_version: 0_u16,
        max_version: 0_u16,
        spec_version_hash: [0_u8; 8usize],
        library_version_hash: [0_u8; 8usize],
    };
    #[cfg(feature = "arbitrary")]
    pub fn random<R: rand::Rng>(rng: &mut R) -> Self {
        use arbitrary::{Arbitrary, Unstructured};
        let mut buf = [0u8; 1024];
        rng.fill_bytes(&mut buf);
        let mut unstructured = Unstructured::new(&buf);
        Self::arbitrary(&mut unstructured).unwrap_or_default()
    }
}
impl Default for PROTOCOL_VERSION_DATA {
    fn default() -> Self {
        Self::DEFAULT.clone()
    }
}
impl MessageData for PROTOCOL_VERSION_DATA {
    type Message = MavMessage;
    const ID: u32 = 300u32;
    const NAME: &'static str = "PROTOCOL_VERSION";
    const EXTRA_CRC: u8 = 217u8;
    const ENCODED_LEN: usize = 22usize;
    fn deser(_version: MavlinkVersion, __input: &[u8]) -> Result<Self, ::mavlink_core::error::ParserError> {
        let avail_len = __input.len();
        let mut payload_buf;
        let mut buf = if avail_len < Self::ENCODED_LEN {
            payload_buf = [0; Self::ENCODED_LEN];
            payload_buf[0..avail_len].copy_from_slice(__input);
            Bytes::new(&payload_buf)
        } else {
            Bytes::new(__input)
        };
        let mut __struct = Self::default();
        __struct.version = buf.get_u16_le()?;
        __struct.min_version = buf.get_u16_le()?;
        __struct.max_version = buf.get_u16_le()?;
        for v in &mut __struct.spec_version_hash {
            let val = buf.get_u8()?;
            *v = val;
        }
        for v in &mut __struct.library_version_hash {
            let val = buf.get_u8()?;
            *v = val;
        }
        Ok(__struct)
    }
    fn ser(&self, version: MavlinkVersion, bytes: &mut [u8]) -> usize {
        let mut __tmp = BytesMut::new(bytes);
        if __tmp.remaining() < Self::ENCODED_LEN {
            panic!("buffer is too small (need {} bytes, but got {})", Self::ENCODED_LEN, __tmp.remaining(),)
        }
        __tmp.put_u16_le(self.version);
        __tmp.put_u16_le(self.min_version);
        __tmp.put_u16_le(self.max_version);
        for val in &self.spec_version_hash {
            __tmp.put_u8(*val);
        }
        for val in &self.library_version_hash {
            __tmp.put_u8(*val);
        }
        if matches!(version, MavlinkVersion::V2) {
            let len = __tmp.len();
            ::mavlink_core::utils::remove_trailing_zeroes(&bytes[..len])
        } else {
            __tmp.len()
        }
    }
}
#[doc = "Channels of the remote control."]
#[doc = ""]
#[doc = "ID: 65"]
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(Serialize, Deserialize))]
#[cfg_attr(feature = "arbitrary", derive(Arbitrary))]
#[cfg_attr(feature = "ts-rs", derive(TS))]
#[cfg_attr(feature = "ts-rs", ts(export))]
pub struct RC_CHANNELS_DATA {
    #[doc = "Time since boot."]
    pub time_boot_ms: u32,
    #[doc = "Chan1 raw."]
    pub chan1_raw: u16,
    #[doc = "Chan2 raw."]
    pub chan2_raw: u16,
    #[doc = "Chan3 raw."]
    pub chan3_raw: u16,
    #[doc = "Chan4 raw."]
    pub chan4_raw: u16,
    #[doc = "Chan5 raw."]
    pub chan5_raw: u16,
    #[doc = "Chan6 raw."]
    pub chan6_raw: u16,
    #[doc = "Chan7 raw."]
    pub chan7_raw: u16,
    #[doc = "Chan8 raw."]
    pub chan8_raw: u16,
    #[doc = "Chan9 raw."]
    pub chan9_raw: u16,
    #[doc = "Chan10 raw."]
    pub chan10_raw: u16,
    #[doc = "Chan11 raw."]
    pub chan11_raw: u16,
    #[doc = "Chan12 raw."]
    pub chan12_raw: u16,
    #[doc = "Chan13 raw."]
    pub chan13_raw: u16,
    #[doc = "Chan14 raw."]
    pub chan14_raw: u16,
    #[doc = "Chan15 raw."]
    pub chan15_raw: u16,
    #[doc = "Chan16 raw."]
    pub chan16_raw: u16,
    #[doc = "Chan17 raw."]
    pub chan17_raw: u16,
    #[doc = "Chan18 raw."]
    pub chan18_raw: u16,
    #[doc = "Chancount."]
    pub chancount: u8,
    #[doc = "Rssi."]
    pub rssi: u8,
}
impl RC_CHANNELS_DATA {
    pub const ENCODED_LEN: usize = 42usize;
    pub const DEFAULT: Self = Self {
        time_boot_ms: 0_u32,
        chan1_raw: 0_u16,
        chan2_raw: 0_u16,
        chan3_raw: 0_u16,
        chan4_raw: 0_u16,
        chan5_raw: 0_u16,
        chan6_raw: 0_u16,
        chan7_raw: 0_u16,
        chan8_raw: 0_u16,
        chan9_raw: 0_u16,
        chan10_raw: 0_u16,
        chan11_raw: 0_u16,
        chan12_raw: 0_u16,
        chan13_raw: 0_u16,
        chan14_raw: 0_u16,
        chan15_raw: 0_u16,
        chan16_raw: 0_u16,
        chan17_raw: 0_u16,
        chan18_raw: 0_u16,
        chancount: 0_u8,
        rssi: 0_u8,
    };
    #[cfg(feature = "arbitrary")]
    pub fn random<R: rand::Rng>(rng: &mut R) -> Self {
        use arbitrary::{Arbitrary, Unstructured};
        let mut buf = [0u8; 1024];
        rng.fill_bytes(&mut buf);
        let mut unstructured = Unstructured::new(&buf);
        Self::arbitrary(&mut unstructured).unwrap_or_default()
    }
}
impl Default for RC_CHANNELS_DATA {
    fn default() -> Self {
        Self::DEFAULT.clone()
    }
}
impl MessageData for RC_CHANNELS_DATA {
    type Message = MavMessage;
    const ID: u32 = 65u32;
    const NAME: &'static str = "RC_CHANNELS";
    const EXTRA_CRC: u8 = 118u8;
    const ENCODED_LEN: usize = 42usize;
    fn deser(_version: MavlinkVersion, __input: &[u8]) -> Result<Self, ::mavlink_core::error::ParserError> {
        let avail_len = __input.len();
        let mut payload_buf;
        let mut buf = if avail_len < Self::ENCODED_LEN {
            payload_buf = [0; Self::ENCODED_LEN];
            payload_buf[0..avail_len].copy_from_slice(__input);
            Bytes::new(&payload_buf)
        } else {
            Bytes::new(__input)
        };
        let mut __struct = Self::default();
        __struct.time_boot_ms = buf.get_u32_le()?;
        __struct.chan1_raw = buf.get_u16_le()?;
        __struct.chan2_raw = buf.get_u16_le()?;
        __struct.chan3_raw = buf.get_u16_le()?;
        __struct.chan4_raw = buf.get_u16_le()?;
        __struct.chan5_raw = buf.get_u16_le()?;
        __struct.chan6_raw = buf.get_u16_le()?;
        __struct.chan7_raw = buf.get_u16_le()?;
        __struct.chan8_raw = buf.get_u16_le()?;
        __struct.chan9_raw = buf.get_u16_le()?;
        __struct.chan10_raw = buf.get_u16_le()?;
        __struct.chan11_raw = buf.get_u16_le()?;
        __struct.chan12_raw = buf.get_u16_le()?;
        __struct.chan13_raw = buf.get_u16_le()?;
        __struct.chan14_raw = buf.get_u16_le()?;
        __struct.chan15_raw = buf.get_u16_le()?;
        __struct.chan16_raw = buf.get_u16_le()?;
        __struct.chan17_raw = buf.get_u16_le()?;
        __struct.chan18_raw = buf.get_u16_le()?;
        __struct.chancount = buf.get_u8()?;
        __struct.rssi = buf.get_u8()?;
        Ok(__struct)
    }
    fn ser(&self, version: MavlinkVersion, bytes: &mut [u8]) -> usize {
        let mut __tmp = BytesMut::new(bytes);
        if __tmp.remaining() < Self::ENCODED_LEN {
            panic!("buffer is too small (need {} bytes, but got {})", Self::ENCODED_LEN, __tmp.remaining(),)
        }
        __tmp.put_u32_le(self.time_boot_ms);
        __tmp.put_u16_le(self.chan1_raw);
        __tmp.put_u16_le(self.chan2_raw);
        __tmp.put_u16_le(self.chan3_raw);
        __tmp.put_u16_le(self.chan4_raw);
        __tmp.put_u16_le(self.chan5_raw);
        __tmp.put_u16_le(self.chan6_raw);
        __tmp.put_u16_le(self.chan7_raw);
        __tmp.put_u16_le(self.chan8_raw);
        __tmp.put_u16_le(self.chan9_raw);
        __tmp.put_u16_le(self.chan10_raw);
        __tmp.put_u16_le(self.chan11_raw);
        __tmp.put_u16_le(self.chan12_raw);
        __tmp.put_u16_le(self.chan13_raw);
        __tmp.put_u16_le(self.chan14_raw);
        __tmp.put_u16_le(self.chan15_raw);
        __tmp.put_u16_le(self.chan16_raw);
        __tmp.put_u16_le(self.chan17_raw);
        __tmp.put_u16_le(self.chan18_raw);
        __tmp.put_u8(self.chancount);
        __tmp.put_u8(self.rssi);
        if matches!(version, MavlinkVersion::V2) {
            let len = __tmp.len();
            ::mavlink_core::utils::remove_trailing_zeroes(&bytes[..len])
        } else {
            __tmp.len()
        }
    }
}
#[doc = "Channels of a ground station."]
#[doc = ""]
#[doc = "ID: 70"]
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(Serialize, Deserialize))]
#[cfg_attr(feature = "arbitrary", derive(Arbitrary))]
#[cfg_attr(feature = "ts-rs", derive(TS))]
#[cfg_attr(feature = "ts-rs", ts(export))]
pub struct RC_CHANNELS_OVERRIDE_DATA {
    #[doc = "Chan1 raw."]
    pub chan1_raw: u16,
    #[doc = "Chan2 raw."]
    pub chan2_raw: u16,
    #[doc = "Chan3 raw."]
    pub chan3_raw: u16,
    #[doc = "Chan4 raw."]
    pub chan4_raw: u16,
    #[doc = "Chan5 raw."]
    pub chan5_raw: u16,
    #[doc = "Chan6 raw."]
    pub chan6_raw: u16,
    #[doc = "Chan7 raw."]
    pub chan7_raw: u16,
    #[doc = "Chan8 raw."]
    pub chan8_raw: u16,
    #[doc = "System."]
    pub target_system: u8,
    #[doc = "Component."]
    pub target_component: u8,
    #[doc = "Chan9 raw."]
    #[cfg_attr(feature = "serde", serde(default = "crate::utils::RustDefault::rust_default"))]
    pub chan9_raw: u16,
    #[doc = "Chan10 raw."]
    #[cfg_attr(feature = "serde", serde(default = "crate::utils::RustDefault::rust_default"))]
    pub chan10_raw: u16,
    #[doc = "Chan11 raw."]
    #[cfg_attr(feature = "serde", serde(default = "crate::utils::RustDefault::rust_default"))]
    pub chan11_raw: u16,
    #[doc = "Chan12 raw."]
    #[cfg_attr(feature = "serde", serde(default = "crate::utils::RustDefault::rust_default"))]
    pub chan12_raw: u16,
    #[doc = "Chan13 raw."]
    #[cfg_attr(feature = "serde", serde(default = "crate::utils::RustDefault::rust_default"))]
    pub chan13_raw: u16,
    #[doc = "Chan14 raw."]
    #[cfg_attr(feature = "serde", serde(default = "crate::utils::RustDefault::rust_default"))]
    pub chan14_raw: u16,
    #[doc = "Chan15 raw."]
    #[cfg_attr(feature = "serde", serde(default = "crate::utils::RustDefault::rust_default"))]
    pub chan15_raw: u16,
    #[doc = "Chan16 raw."]
    #[cfg_attr(feature = "serde", serde(default = "crate::utils::RustDefault::rust_default"))]
    pub chan16_raw: u16,
    #[doc = "Chan17 raw."]
    #[cfg_attr(feature = "serde", serde(default = "crate::utils::RustDefault::rust_default"))]
    pub chan17_raw: u16,
    #[doc = "Chan18 raw."]
    #[cfg_attr(feature = "serde", serde(default = "crate::utils::RustDefault::rust_default"))]
    pub chan18_raw: u16,
}
impl RC_CHANNELS_OVERRIDE_DATA {
    pub const ENCODED_LEN: usize = 38usize;
    pub const DEFAULT: Self = Self {
        chan1_raw: 0_u16,
        chan2_raw: 0_u16,
        chan3_raw: 0_u16,
        chan4_raw: 0_u16,
        chan5_raw: 0_u16,
        chan6_raw: 0_u16,
        chan7_raw: 0_u16,
        chan8_raw: 0_u16,
        target_system: 0_u8,
        target_component: 0_u8,
        chan9_raw: 0_u16,
        chan10_raw: 0_u16,
        chan11_raw: 0_u16,
        chan12_raw: 0_u16,
        chan13_raw: 0_u16,
        chan14_raw: 0_u16,
        chan15_raw: 0_u16,
        chan16_raw: 0_u16,
        chan17_raw: 0_u16,
        chan18_raw: 0_u16,
    };
    #[cfg(feature = "arbitrary")]
    pub fn random<R: rand::Rng>(rng: &mut R) -> Self {
        use arbitrary::{Arbitrary, Unstructured};
        let mut buf = [0u8; 1024];
        rng.fill_bytes(&mut buf);
        let mut unstructured = Unstructured::new(&buf);
        Self::arbitrary(&mut unstructured).unwrap_or_default()
    }
}
impl Default for RC_CHANNELS_OVERRIDE_DATA {
    fn default() -> Self {
        Self::DEFAULT.clone()
    }
}
impl MessageData for RC_CHANNELS_OVERRIDE_DATA {
    type Message = MavMessage;
    const ID: u32 = 70u32;
    const NAME: &'static str = "RC_CHANNELS_OVERRIDE";
    const EXTRA_CRC: u8 = 124u8;
    const ENCODED_LEN: usize = 38usize;
    fn deser(_version: MavlinkVersion, __input: &[u8]) -> Result<Self, ::mavlink_core::error::ParserError> {
        let avail_len = __input.len();
        let mut payload_buf;
        let mut buf = if avail_len < Self::ENCODED_LEN {
            payload_buf = [0; Self::ENCODED_LEN];
            payload_buf[0..avail_len].copy_from_slice(__input);
            Bytes::new(&payload_buf)
        } else {
            Bytes::new(__input)
        };
        let mut __struct = Self::default();
        __struct.chan1_raw = buf.get_u16_le()?;
        __struct.chan2_raw = buf.get_u16_le()?;
        __struct.chan3_raw = buf.get_u16_le()?;
        __struct.chan4_raw = buf.get_u16_le()?;
        __struct.chan5_raw = buf.get_u16_le()?;
        __struct.chan6_raw = buf.get_u16_le()?;
        __struct.chan7_raw = buf.get_u16_le()?;
        __struct.chan8_raw = buf.get_u16_le()?;
        __struct.target_system = buf.get_u8()?;
        __struct.target_component = buf.get_u8()?;
        __struct.chan9_raw = buf.get_u16_le()?;
        __struct.chan10_raw = buf.get_u16_le()?;
        __struct.chan11_raw = buf.get_u16_le()?;
        __struct.chan12_raw = buf.get_u16_le()?;
        __struct.chan13_raw = buf.get_u16_le()?;
        __struct.chan14_raw = buf.get_u16_le()?;
        __struct.chan15_raw = buf.get_u16_le()?;
        __struct.chan16_raw = buf.get_u16_le()?;
        __struct.chan17_raw = buf.get_u16_le()?;
        __struct.chan18_raw = buf.get_u16_le()?;
        Ok(__struct)
    }
    fn ser(&self, version: MavlinkVersion, bytes: &mut [u8]) -> usize {
        let mut __tmp = BytesMut::new(bytes);
        if __tmp.remaining() < Self::ENCODED_LEN {
            panic!("buffer is too small (need {} bytes, but got {})", Self::ENCODED_LEN, __tmp.remaining(),)
        }
        __tmp.put_u16_le(self.chan1_raw);
        __tmp.put_u16_le(self.chan2_raw);
        __tmp.put_u16_le(self.chan3_raw);
        __tmp.put_u16_le(self.chan4_raw);
        __tmp.put_u16_le(self.chan5_raw);
        __tmp.put_u16_le(self.chan6_raw);
        __tmp.put_u16_le(self.chan7_raw);
        __tmp.put_u16_le(self.chan8_raw);
        __tmp.put_u8(self.target_system);
        __tmp.put_u8(self.target_component);
        if matches!(version, MavlinkVersion::V2) {
            __tmp.put_u16_le(self.chan9_raw);
            __tmp.put_u16_le(self.chan10_raw);
            __tmp.put_u16_le(self.chan11_raw);
            __tmp.put_u16_le(self.chan12_raw);
            __tmp.put_u16_le(self.chan13_raw);
            __tmp.put_u16_le(self.chan14_raw);
            __tmp.put_u16_le(self.chan15_raw);
            __tmp.put_u16_le(self.chan16_raw);
            __tmp.put_u16_le(self.chan17_raw);
            __tmp.put_u16_le(self.chan18_raw);
            let len = __tmp.len();
            ::mavlink_core::utils::remove_trailing_zeroes(&bytes[..len])
        } else {
            __tmp.len()
        }
    }
}
#[doc = "Asks for streams, the old way."]
#[doc = ""]
#[doc = "ID: 66"]
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(Serialize, Deserialize))]
#[cfg_attr(feature = "arbitrary", derive(Arbitrary))]
#[cfg_attr(feature = "ts-rs", derive(TS))]
#[cfg_attr(feature = "ts-rs", ts(export))]
pub struct REQUEST_DATA_STREAM_DATA {
    #[doc = "Req message rate."]
    pub req_message_rate: u16,
    #[doc = "System."]
    pub target_system: u8,
    #[doc = "Component."]
    pub target_component: u8,
    #[doc = "Req stream id."]
    pub req_stream_id: u8,
    #[doc = "Start stop."]
    pub start_stop: u8,
}
impl REQUEST_DATA_STREAM_DATA {
    pub const ENCODED_LEN: usize = 6usize;
    pub const DEFAULT: Self = Self {
        req_message_rate: 0_u16,
        target_system: 0_u8,
        target_component: 0_u8,
        req_stream_id: 0_u8,
        start_stop: 0_u8,
    };
    #[cfg(feature = "arbitrary")]
    pub fn random<R: rand::Rng>(rng: &mut R) -> Self {
        use arbitrary::{Arbitrary, Unstructured};
        let mut buf = [0u8; 1024];
        rng.fill_bytes(&mut buf);
        let mut unstructured = Unstructured::new(&buf);
        Self::arbitrary(&mut unstructured).unwrap_or_default()
    }
}
impl Default for REQUEST_DATA_STREAM_DATA {
    fn default() -> Self {
        Self::DEFAULT.clone()
    }
}
impl MessageData for REQUEST_DATA_STREAM_DATA {
    type Message = MavMessage;
    const ID: u32 = 66u32;
    const NAME: &'static str = "REQUEST_DATA_STREAM";
    const EXTRA_CRC: u8 = 148u8;
    const ENCODED_LEN: usize = 6usize;
    fn deser(_version: MavlinkVersion, __input: &[u8]) -> Result<Self, ::mavlink_core::error::ParserError> {
        let avail_len = __input.len();
        let mut payload_buf;
        let mut buf = if avail_len < Self::ENCODED_LEN {
            payload_buf = [0; Self::ENCODED_LEN];
            payload_buf[0..avail_len].copy_from_slice(__input);
            Bytes::new(&payload_buf)
        } else {
            Bytes::new(__input)
        };
        let mut __struct = Self::default();
        __struct.req_message_rate = buf.get_u16_le()?;
        __struct.target_system = buf.get_u8()?;
        __struct.target_component = buf.get_u8()?;
        __struct.req_stream_id = buf.get_u8()?;
        __struct.start_stop = buf.get_u8()?;
        Ok(__struct)
    }
    fn ser(&self, version: MavlinkVersion, bytes: &mut [u8]) -> usize {
        let mut __tmp = BytesMut::new(bytes);
        if __tmp.remaining() < Self::ENCODED_LEN {
            panic!("buffer is too small (need {} bytes, but got {})", Self::ENCODED_LEN, __tmp.remaining(),)
        }
        __tmp.put_u16_le(self.req_message_rate);
        __tmp.put_u8(self.target_system);
        __tmp.put_u8(self.target_component);
        __tmp.put_u8(self.req_stream_id);
        __tmp.put_u8(self.start_stop);
        if matches!(version, MavlinkVersion::V2) {
            let len = __tmp.len();
            ::mavlink_core::utils::remove_trailing_zeroes(&bytes[..len])
        } else {
            __tmp.len()
        }
    }
}
#[doc = "IMU and magnetometer."]
#[doc = ""]
#[doc = "ID: 26"]
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(Serialize, Deserialize))]
#[cfg_attr(feature = "arbitrary", derive(Arbitrary))]
#[cfg_attr(feature = "ts-rs", derive(TS))]
#[cfg_attr(feature = "ts-rs", ts(export))]
pub struct SCALED_IMU_DATA {
    #[doc = "Time since boot."]
    pub time_boot_ms: u32,
    #[doc = "Xacc."]
    pub xacc: i16,
    #[doc = "Yacc."]
    pub yacc: i16,
    #[doc = "Zacc."]
    pub zacc: i16,
    #[doc = "Xgyro."]
    pub xgyro: i16,
    #[doc = "Ygyro."]
    pub ygyro: i16,
    #[doc = "Zgyro."]
    pub zgyro: i16,
    #[doc = "Xmag."]
    pub xmag: i16,
    #[doc = "Ymag."]
    pub ymag: i16,
    #[doc = "Zmag."]
    pub zmag: i16,
    #[doc = "Temperature."]
    #[cfg_attr(feature = "serde", serde(default = "crate::utils::RustDefault::rust_default"))]
    pub temperature: i16,
}
impl SCALED_IMU_DATA {
    pub const ENCODED_LEN: usize = 24usize;
    pub const DEFAULT: Self = Self {
        time_boot_ms: 0_u32,
        xacc: 0_i16,
        yacc: 0_i16,
        zacc: 0_i16,
        xgyro: 0_i16,
        ygyro: 0_i16,
        zgyro: 0_i16,
        xmag: 0_i16,
        ymag: 0_i16,
        zmag: 0_i16,
        temperature: 0_i16,
    };
    #[cfg(feature = "arbitrary")]
    pub fn random<R: rand::Rng>(rng: &mut R) -> Self {
        use arbitrary::{Arbitrary, Unstructured};
        let mut buf = [0u8; 1024];
        rng.fill_bytes(&mut buf);
        let mut unstructured = Unstructured::new(&buf);
        Self::arbitrary(&mut unstructured).unwrap_or_default()
    }
}
impl Default for SCALED_IMU_DATA {
    fn default() -> Self {
        Self::DEFAULT.clone()
    }
}
impl MessageData for SCALED_IMU_DATA {
    type Message = MavMessage;
    const ID: u32 = 26u32;
    const NAME: &'static str = "SCALED_IMU";
    const EXTRA_CRC: u8 = 170u8;
    const ENCODED_LEN: usize = 24usize;
    fn deser(_version: MavlinkVersion, __input: &[u8]) -> Result<Self, ::mavlink_core::error::ParserError> {
        let avail_len = __input.len();
        let mut payload_buf;
        let mut buf = if avail_len < Self::ENCODED_LEN {
            payload_buf = [0; Self::ENCODED_LEN];
            payload_buf[0..avail_len].copy_from_slice(__input);
            Bytes::new(&payload_buf)
        } else {
            Bytes::new(__input)
        };
        let mut __struct = Self::default();
        __struct.time_boot_ms = buf.get_u32_le()?;
        __struct.xacc = buf.get_i16_le()?;
        __struct.yacc = buf.get_i16_le()?;
        __struct.zacc = buf.get_i16_le()?;
        __struct.xgyro = buf.get_i16_le()?;
        __struct.ygyro = buf.get_i16_le()?;
        __struct.zgyro = buf.get_i16_le()?;
        __struct.xmag = buf.get_i16_le()?;
        __struct.ymag = buf.get_i16_le()?;
        __struct.zmag = buf.get_i16_le()?;
        __struct.temperature = buf.get_i16_le()?;
        Ok(__struct)
    }
    fn ser(&self, version: MavlinkVersion, bytes: &mut [u8]) -> usize {
        let mut __tmp = BytesMut::new(bytes);
        if __tmp.remaining() < Self::ENCODED_LEN {
            panic!("buffer is too small (need {} bytes, but got {})", Self::ENCODED_LEN, __tmp.remaining(),)
        }
        __tmp.put_u32_le(self.time_boot_ms);
        __tmp.put_i16_le(self.xacc);
        __tmp.put_i16_le(self.yacc);
        __tmp.put_i16_le(self.zacc);
        __tmp.put_i16_le(self.xgyro);
        __tmp.put_i16_le(self.ygyro);
        __tmp.put_i16_le(self.zgyro);
        __tmp.put_i16_le(self.xmag);
        __tmp.put_i16_le(self.ymag);
        __tmp.put_i16_le(self.zmag);
        if matches!(version, MavlinkVersion::V2) {
            __tmp.put_i16_le(self.temperature);
            let len = __tmp.len();
            ::mavlink_core::utils::remove_trailing_zeroes(&bytes[..len])
        } else {
            __tmp.len()
        }
    }
}
#[doc = "Barometer."]
#[doc = ""]
#[doc = "ID: 29"]
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(Serialize, Deserialize))]
#[cfg_attr(feature = "arbitrary", derive(Arbitrary))]
#[cfg_attr(feature = "ts-rs", derive(TS))]
#[cfg_attr(feature = "ts-rs", ts(export))]
pub struct SCALED_PRESSURE_DATA {
    #[doc = "Time since boot."]
    pub time_boot_ms: u32,
    #[doc = "Press abs."]
    pub press_abs: f32,
    #[doc = "Press diff."]
    pub press_diff: f32,
    #[doc = "Temperature."]
    pub temperature: i16,
    #[doc = "Temperature press diff."]
    #[cfg_attr(feature = "serde", serde(default = "crate::utils::RustDefault::rust_default"))]
    pub temperature_press_diff: i16,
}
impl SCALED_PRESSURE_DATA {
    pub const ENCODED_LEN: usize = 16usize;
    pub const DEFAULT: Self = Self {
        time_boot_ms: 0_u32,
        press_abs: 0.0_f32,
        press_diff: 0.0_f32,
        temperature: 0_i16,
        temperature_press_diff: 0_i16,
    };
    #[cfg(feature = "arbitrary")]
    pub fn random<R: rand::Rng>(rng: &mut R) -> Self {
        use arbitrary::{Arbitrary, Unstructured};
        let mut buf = [0u8; 1024];
        rng.fill_bytes(&mut buf);
        let mut unstructured = Unstructured::new(&buf);
        Self::arbitrary(&mut unstructured).unwrap_or_default()
    }
}
impl Default for SCALED_PRESSURE_DATA {
    fn default() -> Self {
        Self::DEFAULT.clone()
    }
}
impl MessageData for SCALED_PRESSURE_DATA {
    type Message = MavMessage;
    const ID: u32 = 29u32;
    const NAME: &'static str = "SCALED_PRESSURE";
    const EXTRA_CRC: u8 = 115u8;
    const ENCODED_LEN: usize = 16usize;
    fn deser(_version: MavlinkVersion, __input: &[u8]) -> Result<Self, ::mavlink_core::error::ParserError> {
        let avail_len = __input.len();
        let mut payload_buf;
        let mut buf = if avail_len < Self::ENCODED_LEN {
            payload_buf = [0; Self::ENCODED_LEN];
            payload_buf[0..avail_len].copy_from_slice(__input);
            Bytes::new(&payload_buf)
        } else {
            Bytes::new(__input)
        };
        let mut __struct = Self::default();
        __struct.time_boot_ms = buf.get_u32_le()?;
        __struct.press_abs = buf.get_f32_le()?;
        __struct.press_diff = buf.get_f32_le()?;
        __struct.temperature = buf.get_i16_le()?;
        __struct.temperature_press_diff = buf.get_i16_le()?;
        Ok(__struct)
    }
    fn ser(&self, version: MavlinkVersion, bytes: &mut [u8]) -> usize {
        let mut __tmp = BytesMut::new(bytes);
        if __tmp.remaining() < Self::ENCODED_LEN {
            panic!("buffer is too small (need {} bytes, but got {})", Self::ENCODED_LEN, __tmp.remaining(),)
        }
        __tmp.put_u32_le(self.time_boot_ms);
        __tmp.put_f32_le(self.press_abs);
        __tmp.put_f32_le(self.press_diff);
        __tmp.put_i16_le(self.temperature);
        if matches!(version, MavlinkVersion::V2) {
            __tmp.put_i16_le(self.temperature_press_diff);
            let len = __tmp.len();
            ::mavlink_core::utils::remove_trailing_zeroes(&bytes[..len])
        } else {
            __tmp.len()
        }
    }
}
#[doc = "A serial console."]
#[doc = ""]
#[doc = "ID: 126"]
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(Serialize, Deserialize))]
#[cfg_attr(feature = "arbitrary", derive(Arbitrary))]
#[cfg_attr(feature = "ts-rs", derive(TS))]
#[cfg_attr(feature = "ts-rs", ts(export))]
pub struct SERIAL_CONTROL_DATA {
    #[doc = "Baudrate."]
    pub baudrate: u32,
    #[doc = "Timeout."]
    pub timeout: u16,
    #[doc = "Device."]
    pub device: u8,
    #[doc = "Flags."]
    pub flags: u8,
    #[doc = "Count."]
    pub count: u8,
    #[doc = "Data."]
    #[cfg_attr(feature = "serde", serde(with = "serde_arrays"))]
    #[cfg_attr(feature = "ts-rs", ts(type = "Array<number>"))]
    pub data: [u8; 70],
}
impl SERIAL_CONTROL_DATA {
    pub const ENCODED_LEN: usize = 79usize;
    pub const DEFAULT: Self =
        Self { baudrate: 0_u32, timeout: 0_u16, device: 0_u8, flags: 0_u8, count: 0_u8, data: [0_u8; 70usize] };
    #[cfg(feature = "arbitrary")]
    pub fn random<R: rand::Rng>(rng: &mut R) -> Self {
        use arbitrary::{Arbitrary, Unstructured};
        let mut buf = [0u8; 1024];
        rng.fill_bytes(&mut buf);
        let mut unstructured = Unstructured::new(&buf);
        Self::arbitrary(&mut unstructured).unwrap_or_default()
    }
}
impl Default for SERIAL_CONTROL_DATA {
    fn default() -> Self {
        Self::DEFAULT.clone()
    }
}
impl MessageData for SERIAL_CONTROL_DATA {
    type Message = MavMessage;
    const ID: u32 = 126u32;
    const NAME: &'static str = "SERIAL_CONTROL";
    const EXTRA_CRC: u8 = 220u8;
    const ENCODED_LEN: usize = 79usize;
    fn deser(_version: MavlinkVersion, __input: &[u8]) -> Result<Self, ::mavlink_core::error::ParserError> {
        let avail_len = __input.len();
        let mut payload_buf;
        let mut buf = if avail_len < Self::ENCODED_LEN {
            payload_buf = [0; Self::ENCODED_LEN];
            payload_buf[0..avail_len].copy_from_slice(__input);
            Bytes::new(&payload_buf)
        } else {
            Bytes::new(__input)
        };
        let mut __struct = Self::default();
        __struct.baudrate = buf.get_u32_le()?;
        __struct.timeout = buf.get_u16_le()?;
        __struct.device = buf.get_u8()?;
        __struct.flags = buf.get_u8()?;
        __struct.count = buf.get_u8()?;
        for v in &mut __struct.data {
            let val = buf.get_u8()?;
            *v = val;
        }
        Ok(__struct)
    }
    fn ser(&self, version: MavlinkVersion, bytes: &mut [u8]) -> usize {
        let mut __tmp = BytesMut::new(bytes);
        if __tmp.remaining() < Self::ENCODED_LEN {
            panic!("buffer is too small (need {} bytes, but got {})", Self::ENCODED_LEN, __tmp.remaining(),)
        }
        __tmp.put_u32_le(self.baudrate);
        __tmp.put_u16_le(self.timeout);
        __tmp.put_u8(self.device);
        __tmp.put_u8(self.flags);
        __tmp.put_u8(self.count);
        for val in &self.data {
            __tmp.put_u8(*val);
        }
        if matches!(version, MavlinkVersion::V2) {
            let len = __tmp.len();
            ::mavlink_core::utils::remove_trailing_zeroes(&bytes[..len])
        } else {
            __tmp.len()
        }
    }
}
#[doc = "Outputs to the rotors."]
#[doc = ""]
#[doc = "ID: 36"]
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(Serialize, Deserialize))]
#[cfg_attr(feature = "arbitrary", derive(Arbitrary))]
#[cfg_attr(feature = "ts-rs", derive(TS))]
#[cfg_attr(feature = "ts-rs", ts(export))]
pub struct SERVO_OUTPUT_RAW_DATA {
    #[doc = "Time since boot."]
    pub time_usec: u32,
    #[doc = "Servo1 raw."]
    pub servo1_raw: u16,
    #[doc = "Servo2 raw."]
    pub servo2_raw: u16,
    #[doc = "Servo3 raw."]
    pub servo3_raw: u16,
    #[doc = "Servo4 raw."]
    pub servo4_raw: u16,
    #[doc = "Servo5 raw."]
    pub servo5_raw: u16,
    #[doc = "Servo6 raw."]
    pub servo6_raw: u16,
    #[doc = "Servo7 raw."]
    pub servo7_raw: u16,
    #[doc = "Servo8 raw."]
    pub servo8_raw: u16,
    #[doc = "Port."]
    pub port: u8,
    #[doc = "Servo9 raw."]
    #[cfg_attr(feature = "serde", serde(default = "crate::utils::RustDefault::rust_default"))]
    pub servo9_raw: u16,
    #[doc = "Servo10 raw."]
    #[cfg_attr(feature = "serde", serde(default = "crate::utils::RustDefault::rust_default"))]
    pub servo10_raw: u16,
    #[doc = "Servo11 raw."]
    #[cfg_attr(feature = "serde", serde(default = "crate::utils::RustDefault::rust_default"))]
    pub servo11_raw: u16,
    #[doc = "Servo12 raw."]
    #[cfg_attr(feature = "serde", serde(default = "crate::utils::RustDefault::rust_default"))]
    pub servo12_raw: u16,
    #[doc = "Servo13 raw."]
    #[cfg_attr(feature = "serde", serde(default = "crate::utils::RustDefault::rust_default"))]
    pub servo13_raw: u16,
    #[doc = "Servo14 raw."]
    #[cfg_attr(feature = "serde", serde(default = "crate::utils::RustDefault::rust_default"))]
    pub servo14_raw: u16,
    #[doc = "Servo15 raw."]
    #[cfg_attr(feature = "serde", serde(default = "crate::utils::RustDefault::rust_default"))]
    pub servo15_raw: u16,
    #[doc = "Servo16 raw."]
    #[cfg_attr(feature = "serde", serde(default = "crate::utils::RustDefault::rust_default"))]
    pub servo16_raw: u16,
}
impl SERVO_OUTPUT_RAW_DATA {
    pub const ENCODED_LEN: usize = 37usize;
    pub const DEFAULT: Self = Self {
        time_usec: 0_u32,
        servo1_raw: 0_u16,
        servo2_raw: 0_u16,
        servo3_raw: 0_u16,
        servo4_raw: 0_u16,
        servo5_raw: 0_u16,
        servo6_raw: 0_u16,
        servo7_raw: 0_u16,
        servo8_raw: 0_u16,
        port: 0_u8,
        servo9_raw: 0_u16,
        servo10_raw: 0_u16,
        servo11_raw: 0_u16,
        servo12_raw: 0_u16,
        servo13_raw: 0_u16,
        servo14_raw: 0_u16,
        servo15_raw: 0_u16,
        servo16_raw: 0_u16,
    };
    #[cfg(feature = "arbitrary")]
    pub fn random<R: rand::Rng>(rng: &mut R) -> Self {
        use arbitrary::{Arbitrary, Unstructured};
        let mut buf = [0u8; 1024];
        rng.fill_bytes(&mut buf);
        let mut unstructured = Unstructured::new(&buf);
        Self::arbitrary(&mut unstructured).unwrap_or_default()
    }
}
impl Default for SERVO_OUTPUT_RAW_DATA {
    fn default() -> Self {
        Self::DEFAULT.clone()
    }
}
impl MessageData for SERVO_OUTPUT_RAW_DATA {
    type Message = MavMessage;
    const ID: u32 = 36u32;
    const NAME: &'static str = "SERVO_OUTPUT_RAW";
    const EXTRA_CRC: u8 = 222u8;
    const ENCODED_LEN: usize = 37usize;
    fn deser(_version: MavlinkVersion, __input: &[u8]) -> Result<Self, ::mavlink_core::error::ParserError> {
        let avail_len = __input.len();
        let mut payload_buf;
        let mut buf = if avail_len < Self::ENCODED_LEN {
            payload_buf = [0; Self::ENCODED_LEN];
            payload_buf[0..avail_len].copy_from_slice(__input);
            Bytes::new(&payload_buf)
        } else {
            Bytes::new(__input)
        };
        let mut __struct = Self::default();
        __struct.time_usec = buf.get_u32_le()?;
        __struct.servo1_raw = buf.get_u16_le()?;
        __struct.servo2_raw = buf.get_u16_le()?;
        __struct.servo3_raw = buf.get_u16_le()?;
        __struct.servo4_raw = buf.get_u16_le()?;
        __struct.servo5_raw = buf.get_u16_le()?;
        __struct.servo6_raw = buf.get_u16_le()?;
        __struct.servo7_raw = buf.get_u16_le()?;
        __struct.servo8_raw = buf.get_u16_le()?;
        __struct.port = buf.get_u8()?;
        __struct.servo9_raw = buf.get_u16_le()?;
        __struct.servo10_raw = buf.get_u16_le()?;
        __struct.servo11_raw = buf.get_u16_le()?;
        __struct.servo12_raw = buf.get_u16_le()?;
        __struct.servo13_raw = buf.get_u16_le()?;
        __struct.servo14_raw = buf.get_u16_le()?;
        __struct.servo15_raw = buf.get_u16_le()?;
        __struct.servo16_raw = buf.get_u16_le()?;
        Ok(__struct)
    }
    fn ser(&self, version: MavlinkVersion, bytes: &mut [u8]) -> usize {
        let mut __tmp = BytesMut::new(bytes);
        if __tmp.remaining() < Self::ENCODED_LEN {
            panic!("buffer is too small (need {} bytes, but got {})", Self::ENCODED_LEN, __tmp.remaining(),)
        }
        __tmp.put_u32_le(self.time_usec);
        __tmp.put_u16_le(self.servo1_raw);
        __tmp.put_u16_le(self.servo2_raw);
        __tmp.put_u16_le(self.servo3_raw);
        __tmp.put_u16_le(self.servo4_raw);
        __tmp.put_u16_le(self.servo5_raw);
        __tmp.put_u16_le(self.servo6_raw);
        __tmp.put_u16_le(self.servo7_raw);
        __tmp.put_u16_le(self.servo8_raw);
        __tmp.put_u8(self.port);
        if matches!(version, MavlinkVersion::V2) {
            __tmp.put_u16_le(self.servo9_raw);
            __tmp.put_u16_le(self.servo10_raw);
            __tmp.put_u16_le(self.servo11_raw);
            __tmp.put_u16_le(self.servo12_raw);
            __tmp.put_u16_le(self.servo13_raw);
            __tmp.put_u16_le(self.servo14_raw);
            __tmp.put_u16_le(self.servo15_raw);
            __tmp.put_u16_le(self.servo16_raw);
            let len = __tmp.len();
            ::mavlink_core::utils::remove_trailing_zeroes(&bytes[..len])
        } else {
            __tmp.len()
        }
    }
}
#[doc = "Sets an attitude and thrust."]
#[doc = ""]
#[doc = "ID: 82"]
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(Serialize, Deserialize))]
#[cfg_attr(feature = "arbitrary", derive(Arbitrary))]
#[cfg_attr(feature = "ts-rs", derive(TS))]
#[cfg_attr(feature = "ts-rs", ts(export))]
pub struct SET_ATTITUDE_TARGET_DATA {
    #[doc = "Time since boot."]
    pub time_boot_ms: u32,
    #[doc = "Q."]
    #[cfg_attr(feature = "serde", serde(with = "serde_arrays"))]
    #[cfg_attr(feature = "ts-rs", ts(type = "Array<number>"))]
    pub q: [f32; 4],
    #[doc = "Body roll rate."]
    pub body_roll_rate: f32,
    #[doc = "Body pitch rate."]
    pub body_pitch_rate: f32,
    #[doc = "Body yaw rate."]
    pub body_yaw_rate: f32,
    #[doc = "Thrust."]
    pub thrust: f32,
    #[doc = "System."]
    pub target_system: u8,
    #[doc = "Component."]
    pub target_component: u8,
    #[doc = "Type mask."]
    pub type_mask: u8,
}
impl SET_ATTITUDE_TARGET_DATA {
    pub const ENCODED_LEN: usize = 39usize;
    pub const DEFAULT: Self = Self {
        time_boot_ms: 0_u32,
        q: [0.0_f32; 4usize],
        body_roll_rate: 0.0_f32,
        body_pitch_rate: 0.0_f32,
        body_yaw_rate: 0.0_f32,
        thrust: 0.0_f32,
        target_system: 0_u8,
        target_component: 0_u8,
        type_mask: 0_u8,
    };
    #[cfg(feature = "arbitrary")]
    pub fn random<R: rand::Rng>(rng: &mut R) -> Self {
        use arbitrary::{Arbitrary, Unstructured};
        let mut buf = [0u8; 1024];
        rng.fill_bytes(&mut buf);
        let mut unstructured = Unstructured::new(&buf);
        Self::arbitrary(&mut unstructured).unwrap_or_default()
    }
}
impl Default for SET_ATTITUDE_TARGET_DATA {
    fn default() -> Self {
        Self::DEFAULT.clone()
    }
}
impl MessageData for SET_ATTITUDE_TARGET_DATA {
    type Message = MavMessage;
    const ID: u32 = 82u32;
    const NAME: &'static str = "SET_ATTITUDE_TARGET";
    const EXTRA_CRC: u8 = 49u8;
    const ENCODED_LEN: usize = 39usize;
    fn deser(_version: MavlinkVersion, __input: &[u8]) -> Result<Self, ::mavlink_core::error::ParserError> {
        let avail_len = __input.len();
        let mut payload_buf;
        let mut buf = if avail_len < Self::ENCODED_LEN {
            payload_buf = [0; Self::ENCODED_LEN];
            payload_buf[0..avail_len].copy_from_slice(__input);
            Bytes::new(&payload_buf)
        } else {
            Bytes::new(__input)
        };
        let mut __struct = Self::default();
        __struct.time_boot_ms = buf.get_u32_le()?;
        for v in &mut __struct.q {
            let val = buf.get_f32_le()?;
            *v = val;
        }
        __struct.body_roll_rate = buf.get_f32_le()?;
        __struct.body_pitch_rate = buf.get_f32_le()?;
        __struct.body_yaw_rate = buf.get_f32_le()?;
        __struct.thrust = buf.get_f32_le()?;
        __struct.target_system = buf.get_u8()?;
        __struct.target_component = buf.get_u8()?;
        __struct.type_mask = buf.get_u8()?;
        Ok(__struct)
    }
    fn ser(&self, version: MavlinkVersion, bytes: &mut [u8]) -> usize {
        let mut __tmp = BytesMut::new(bytes);
        if __tmp.remaining() < Self::ENCODED_LEN {
            panic!("buffer is too small (need {} bytes, but got {})", Self::ENCODED_LEN, __tmp.remaining(),)
        }
        __tmp.put_u32_le(self.time_boot_ms);
        for val in &self.q {
            __tmp.put_f32_le(*val);
        }
        __tmp.put_f32_le(self.body_roll_rate);
        __tmp.put_f32_le(self.body_pitch_rate);
        __tmp.put_f32_le(self.body_yaw_rate);
        __tmp.put_f32_le(self.thrust);
        __tmp.put_u8(self.target_system);
        __tmp.put_u8(self.target_component);
        __tmp.put_u8(self.type_mask);
        if matches!(version, MavlinkVersion::V2) {
            let len = __tmp.len();
            ::mavlink_core::utils::remove_trailing_zeroes(&bytes[..len])
        } else {
            __tmp.len()
        }
    }
}
#[doc = "Sets the place of the local origin."]
#[doc = ""]
#[doc = "ID: 48"]
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(Serialize, Deserialize))]
#[cfg_attr(feature = "arbitrary", derive(Arbitrary))]
#[cfg_attr(feature = "ts-rs", derive(TS))]
#[cfg_attr(feature = "ts-rs", ts(export))]
pub struct SET_GPS_GLOBAL_ORIGIN_DATA {
    #[doc = "Latitude."]
    pub latitude: i32,
    #[doc = "Longitude."]
    pub longitude: i32,
    #[doc = "Altitude."]
    pub altitude: i32,
    #[doc = "System."]
    pub target_system: u8,
}
impl SET_GPS_GLOBAL_ORIGIN_DATA {
    pub const ENCODED_LEN: usize = 13usize;
    pub const DEFAULT: Self = Self { latitude: 0_i32, longitude: 0_i32, altitude: 0_i32, target_system: 0_u8 };
    #[cfg(feature = "arbitrary")]
    pub fn random<R: rand::Rng>(rng: &mut R) -> Self {
        use arbitrary::{Arbitrary, Unstructured};
        let mut buf = [0u8; 1024];
        rng.fill_bytes(&mut buf);
        let mut unstructured = Unstructured::new(&buf);
        Self::arbitrary(&mut unstructured).unwrap_or_default()
    }
}
impl Default for SET_GPS_GLOBAL_ORIGIN_DATA {
    fn default() -> Self {
        Self::DEFAULT.clone()
    }
}
impl MessageData for SET_GPS_GLOBAL_ORIGIN_DATA {
    type Message = MavMessage;
    const ID: u32 = 48u32;
    const NAME: &'static str = "SET_GPS_GLOBAL_ORIGIN";
    const EXTRA_CRC: u8 = 41u8;
    const ENCODED_LEN: usize = 13usize;
    fn deser(_version: MavlinkVersion, __input: &[u8]) -> Result<Self, ::mavlink_core::error::ParserError> {
        let avail_len = __input.len();
        let mut payload_buf;
        let mut buf = if avail_len < Self::ENCODED_LEN {
            payload_buf = [0; Self::ENCODED_LEN];
            payload_buf[0..avail_len].copy_from_slice(__input);
            Bytes::new(&payload_buf)
        } else {
            Bytes::new(__input)
        };
        let mut __struct = Self::default();
        __struct.latitude = buf.get_i32_le()?;
        __struct.longitude = buf.get_i32_le()?;
        __struct.altitude = buf.get_i32_le()?;
        __struct.target_system = buf.get_u8()?;
        Ok(__struct)
    }
    fn ser(&self, version: MavlinkVersion, bytes: &mut [u8]) -> usize {
        let mut __tmp = BytesMut::new(bytes);
        if __tmp.remaining() < Self::ENCODED_LEN {
            panic!("buffer is too small (need {} bytes, but got {})", Self::ENCODED_LEN, __tmp.remaining(),)
        }
        __tmp.put_i32_le(self.latitude);
        __tmp.put_i32_le(self.longitude);
        __tmp.put_i32_le(self.altitude);
        __tmp.put_u8(self.target_system);
        if matches!(version, MavlinkVersion::V2) {
            let len = __tmp.len();
            ::mavlink_core::utils::remove_trailing_zeroes(&bytes[..len])
        } else {
            __tmp.len()
        }
    }
}
#[doc = "Asks for a mode, the old way."]
#[doc = ""]
#[doc = "ID: 11"]
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(Serialize, Deserialize))]
#[cfg_attr(feature = "arbitrary", derive(Arbitrary))]
#[cfg_attr(feature = "ts-rs", derive(TS))]
#[cfg_attr(feature = "ts-rs", ts(export))]
pub struct SET_MODE_DATA {
    #[doc = "Custom mode."]
    pub custom_mode: u32,
    #[doc = "System."]
    pub target_system: u8,
    #[doc = "Base mode."]
    pub base_mode: u8,
}
impl SET_MODE_DATA {
    pub const ENCODED_LEN: usize = 6usize;
    pub const DEFAULT: Self = Self { custom_mode: 0_u32, target_system: 0_u8, base_mode: 0_u8 };
    #[cfg(feature = "arbitrary")]
    pub fn random<R: rand::Rng>(rng: &mut R) -> Self {
        use arbitrary::{Arbitrary, Unstructured};
        let mut buf = [0u8; 1024];
        rng.fill_bytes(&mut buf);
        let mut unstructured = Unstructured::new(&buf);
        Self::arbitrary(&mut unstructured).unwrap_or_default()
    }
}
impl Default for SET_MODE_DATA {
    fn default() -> Self {
        Self::DEFAULT.clone()
    }
}
impl MessageData for SET_MODE_DATA {
    type Message = MavMessage;
    const ID: u32 = 11u32;
    const NAME: &'static str = "SET_MODE";
    const EXTRA_CRC: u8 = 89u8;
    const ENCODED_LEN: usize = 6usize;
    fn deser(_version: MavlinkVersion, __input: &[u8]) -> Result<Self, ::mavlink_core::error::ParserError> {
        let avail_len = __input.len();
        let mut payload_buf;
        let mut buf = if avail_len < Self::ENCODED_LEN {
            payload_buf = [0; Self::ENCODED_LEN];
            payload_buf[0..avail_len].copy_from_slice(__input);
            Bytes::new(&payload_buf)
        } else {
            Bytes::new(__input)
        };
        let mut __struct = Self::default();
        __struct.custom_mode = buf.get_u32_le()?;
        __struct.target_system = buf.get_u8()?;
        __struct.base_mode = buf.get_u8()?;
        Ok(__struct)
    }
    fn ser(&self, version: MavlinkVersion, bytes: &mut [u8]) -> usize {
        let mut __tmp = BytesMut::new(bytes);
        if __tmp.remaining() < Self::ENCODED_LEN {
            panic!("buffer is too small (need {} bytes, but got {})", Self::ENCODED_LEN, __tmp.remaining(),)
        }
        __tmp.put_u32_le(self.custom_mode);
        __tmp.put_u8(self.target_system);
        __tmp.put_u8(self.base_mode);
        if matches!(version, MavlinkVersion::V2) {
            let len = __tmp.len();
            ::mavlink_core::utils::remove_trailing_zeroes(&bytes[..len])
        } else {
            __tmp.len()
        }
    }
}
#[doc = "Sets a place or velocity on the globe."]
#[doc = ""]
#[doc = "ID: 86"]
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(Serialize, Deserialize))]
#[cfg_attr(feature = "arbitrary", derive(Arbitrary))]
#[cfg_attr(feature = "ts-rs", derive(TS))]
#[cfg_attr(feature = "ts-rs", ts(export))]
pub struct SET_POSITION_TARGET_GLOBAL_INT_DATA {
    #[doc = "Time since boot."]
    pub time_boot_ms: u32,
    #[doc = "Lat int."]
    pub lat_int: i32,
    #[doc = "Lon int."]
    pub lon_int: i32,
    #[doc = "Alt."]
    pub alt: f32,
    #[doc = "Vx."]
    pub vx: f32,
    #[doc = "Vy."]
    pub vy: f32,
    #[doc = "Vz."]
    pub vz: f32,
    #[doc = "Afx."]
    pub afx: f32,
    #[doc = "Afy."]
    pub afy: f32,
    #[doc = "Afz."]
    pub afz: f32,
    #[doc = "Yaw."]
    pub yaw: f32,
    #[doc = "Yaw rate."]
    pub yaw_rate: f32,
    #[doc = "Type mask."]
    pub type_mask: u16,
    #[doc = "System."]
    pub target_system: u8,
    #[doc = "Component."]
    pub target_component: u8,
    #[doc = "Coordinate frame."]
    pub coordinate_frame: u8,
}
impl SET_POSITION_TARGET_GLOBAL_INT_DATA {
    pub const ENCODED_LEN: usize = 53usize;
    pub const DEFAULT: Self = Self {
        time_boot_ms: 0_u32,
        lat_int: 0_i32,
        lon_int: 0_i32,
        alt: 0.0_f32,
        vx: 0.0_f32,
        vy: 0.0_f32,
        vz: 0.0_f32,
        afx: 0.0_f32,
        afy: 0.0_f32,
        afz: 0.0_f32,
        yaw: 0.0_f32,
        yaw_rate: 0.0_f32,
        type_mask: 0_u16,
        target_system: 0_u8,
        target_component: 0_u8,
        coordinate_frame: 0_u8,
    };
    #[cfg(feature = "arbitrary")]
    pub fn random<R: rand::Rng>(rng: &mut R) -> Self {
        use arbitrary::{Arbitrary, Unstructured};
        let mut buf = [0u8; 1024];
        rng.fill_bytes(&mut buf);
        let mut unstructured = Unstructured::new(&buf);
        Self::arbitrary(&mut unstructured).unwrap_or_default()
    }
}
impl Default for SET_POSITION_TARGET_GLOBAL_INT_DATA {
    fn default() -> Self {
        Self::DEFAULT.clone()
    }
}
impl MessageData for SET_POSITION_TARGET_GLOBAL_INT_DATA {
    type Message = MavMessage;
    const ID: u32 = 86u32;
    const NAME: &'static str = "SET_POSITION_TARGET_GLOBAL_INT";
    const EXTRA_CRC: u8 = 5u8;
    const ENCODED_LEN: usize = 53usize;
    fn deser(_version: MavlinkVersion, __input: &[u8]) -> Result<Self, ::mavlink_core::error::ParserError> {
        let avail_len = __input.len();
        let mut payload_buf;
        let mut buf = if avail_len < Self::ENCODED_LEN {
            payload_buf = [0; Self::ENCODED_LEN];
            payload_buf[0..avail_len].copy_from_slice(__input);
            Bytes::new(&payload_buf)
        } else {
            Bytes::new(__input)
        };
        let mut __struct = Self::default();
        __struct.time_boot_ms = buf.get_u32_le()?;
        __struct.lat_int = buf.get_i32_le()?;
        __struct.lon_int = buf.get_i32_le()?;
        __struct.alt = buf.get_f32_le()?;
        __struct.vx = buf.get_f32_le()?;
        __struct.vy = buf.get_f32_le()?;
        __struct.vz = buf.get_f32_le()?;
        __struct.afx = buf.get_f32_le()?;
        __struct.afy = buf.get_f32_le()?;
        __struct.afz = buf.get_f32_le()?;
        __struct.yaw = buf.get_f32_le()?;
        __struct.yaw_rate = buf.get_f32_le()?;
        __struct.type_mask = buf.get_u16_le()?;
        __struct.target_system = buf.get_u8()?;
        __struct.target_component = buf.get_u8()?;
        __struct.coordinate_frame = buf.get_u8()?;
        Ok(__struct)
    }
    fn ser(&self, version: MavlinkVersion, bytes: &mut [u8]) -> usize {
        let mut __tmp = BytesMut::new(bytes);
        if __tmp.remaining() < Self::ENCODED_LEN {
            panic!("buffer is too small (need {} bytes, but got {})", Self::ENCODED_LEN, __tmp.remaining(),)
        }
        __tmp.put_u32_le(self.time_boot_ms);
        __tmp.put_i32_le(self.lat_int);
        __tmp.put_i32_le(self.lon_int);
        __tmp.put_f32_le(self.alt);
        __tmp.put_f32_le(self.vx);
        __tmp.put_f32_le(self.vy);
        __tmp.put_f32_le(self.vz);
        __tmp.put_f32_le(self.afx);
        __tmp.put_f32_le(self.afy);
        __tmp.put_f32_le(self.afz);
        __tmp.put_f32_le(self.yaw);
        __tmp.put_f32_le(self.yaw_rate);
        __tmp.put_u16_le(self.type_mask);
        __tmp.put_u8(self.target_system);
        __tmp.put_u8(self.target_component);
        __tmp.put_u8(self.coordinate_frame);
        if matches!(version, MavlinkVersion::V2) {
            let len = __tmp.len();
            ::mavlink_core::utils::remove_trailing_zeroes(&bytes[..len])
        } else {
            __tmp.len()
        }
    }
}
#[doc = "Sets a place or velocity in the local frame."]
#[doc = ""]
#[doc = "ID: 84"]
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(Serialize, Deserialize))]
#[cfg_attr(feature = "arbitrary", derive(Arbitrary))]
#[cfg_attr(feature = "ts-rs", derive(TS))]
#[cfg_attr(feature = "ts-rs", ts(export))]
pub struct SET_POSITION_TARGET_LOCAL_NED_DATA {
    #[doc = "Time since boot."]
    pub time_boot_ms: u32,
    #[doc = "X."]
    pub x: f32,
    #[doc = "Y."]
    pub y: f32,
    #[doc = "Z."]
    pub z: f32,
    #[doc = "Vx."]
    pub vx: f32,
    #[doc = "Vy."]
    pub vy: f32,
    #[doc = "Vz."]
    pub vz: f32,
    #[doc = "Afx."]
    pub afx: f32,
    #[doc = "Afy."]
    pub afy: f32,
    #[doc = "Afz."]
    pub afz: f32,
    #[doc = "Yaw."]
    pub yaw: f32,
    #[doc = "Yaw rate."]
    pub yaw_rate: f32,
    #[doc = "Type mask."]
    pub type_mask: u16,
    #[doc = "System."]
    pub target_system: u8,
    #[doc = "Component."]
    pub target_component: u8,
    #[doc = "Coordinate frame."]
    pub coordinate_frame: u8,
}
impl SET_POSITION_TARGET_LOCAL_NED_DATA {
    pub const ENCODED_LEN: usize = 53usize;
    pub const DEFAULT: Self = Self {
        time_boot_ms: 0_u32,
        x: 0.0_f32,
        y: 0.0_f32,
        z: 0.0_f32,
        vx: 0.0_f32,
        vy: 0.0_f32,
        vz: 0.0_f32,
        afx: 0.0_f32,
        afy: 0.0_f32,
        afz: 0.0_f32,
        yaw: 0.0_f32,
        yaw_rate: 0.0_f32,
        type_mask: 0_u16,
        target_system: 0_u8,
        target_component: 0_u8,
        coordinate_frame: 0_u8,
    };
    #[cfg(feature = "arbitrary")]
    pub fn random<R: rand::Rng>(rng: &mut R) -> Self {
        use arbitrary::{Arbitrary, Unstructured};
        let mut buf = [0u8; 1024];
        rng.fill_bytes(&mut buf);
        let mut unstructured = Unstructured::new(&buf);
        Self::arbitrary(&mut unstructured).unwrap_or_default()
    }
}
impl Default for SET_POSITION_TARGET_LOCAL_NED_DATA {
    fn default() -> Self {
        Self::DEFAULT.clone()
    }
}
impl MessageData for SET_POSITION_TARGET_LOCAL_NED_DATA {
    type Message = MavMessage;
    const ID: u32 = 84u32;
    const NAME: &'static str = "SET_POSITION_TARGET_LOCAL_NED";
    const EXTRA_CRC: u8 = 143u8;
    const ENCODED_LEN: usize = 53usize;
    fn deser(_version: MavlinkVersion, __input: &[u8]) -> Result<Self, ::mavlink_core::error::ParserError> {
        let avail_len = __input.len();
        let mut payload_buf;
        let mut buf = if avail_len < Self::ENCODED_LEN {
            payload_buf = [0; Self::ENCODED_LEN];
            payload_buf[0..avail_len].copy_from_slice(__input);
            Bytes::new(&payload_buf)
        } else {
            Bytes::new(__input)
        };
        let mut __struct = Self::default();
        __struct.time_boot_ms = buf.get_u32_le()?;
        __struct.x = buf.get_f32_le()?;
        __struct.y = buf.get_f32_le()?;
        __struct.z = buf.get_f32_le()?;
        __struct.vx = buf.get_f32_le()?;
        __struct.vy = buf.get_f32_le()?;
        __struct.vz = buf.get_f32_le()?;
        __struct.afx = buf.get_f32_le()?;
        __struct.afy = buf.get_f32_le()?;
        __struct.afz = buf.get_f32_le()?;
        __struct.yaw = buf.get_f32_le()?;
        __struct.yaw_rate = buf.get_f32_le()?;
        __struct.type_mask = buf.get_u16_le()?;
        __struct.target_system = buf.get_u8()?;
        __struct.target_component = buf.get_u8()?;
        __struct.coordinate_frame = buf.get_u8()?;
        Ok(__struct)
    }
    fn ser(&self, version: MavlinkVersion, bytes: &mut [u8]) -> usize {
        let mut __tmp = BytesMut::new(bytes);
        if __tmp.remaining() < Self::ENCODED_LEN {
            panic!("buffer is too small (need {} bytes, but got {})", Self::ENCODED_LEN, __tmp.remaining(),)
        }
        __tmp.put_u32_le(self.time_boot_ms);
        __tmp.put_f32_le(self.x);
        __tmp.put_f32_le(self.y);
        __tmp.put_f32_le(self.z);
        __tmp.put_f32_le(self.vx);
        __tmp.put_f32_le(self.vy);
        __tmp.put_f32_le(self.vz);
        __tmp.put_f32_le(self.afx);
        __tmp.put_f32_le(self.afy);
        __tmp.put_f32_le(self.afz);
        __tmp.put_f32_le(self.yaw);
        __tmp.put_f32_le(self.yaw_rate);
        __tmp.put_u16_le(self.type_mask);
        __tmp.put_u8(self.target_system);
        __tmp.put_u8(self.target_component);
        __tmp.put_u8(self.coordinate_frame);
        if matches!(version, MavlinkVersion::V2) {
            let len = __tmp.len();
            ::mavlink_core::utils::remove_trailing_zeroes(&bytes[..len])
        } else {
            __tmp.len()
        }
    }
}
#[doc = "The true state of a simulated vehicle."]
#[doc = ""]
#[doc = "ID: 108"]
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(Serialize, Deserialize))]
#[cfg_attr(feature = "arbitrary", derive(Arbitrary))]
#[cfg_attr(feature = "ts-rs", derive(TS))]
#[cfg_attr(feature = "ts-rs", ts(export))]
pub struct SIM_STATE_DATA {
    #[doc = "Q1."]
    pub q1: f32,
    #[doc = "Q2."]
    pub q2: f32,
    #[doc = "Q3."]
    pub q3: f32,
    #[doc = "Q4."]
    pub q4: f32,
    #[doc = "Roll."]
    pub roll: f32,
    #[doc = "Pitch."]
    pub pitch: f32,
    #[doc = "Yaw."]
    pub yaw: f32,
    #[doc = "Xacc."]
    pub xacc: f32,
    #[doc = "Yacc."]
    pub yacc: f32,
    #[doc = "Zacc."]
    pub zacc: f32,
    #[doc = "Xgyro."]
    pub xgyro: f32,
    #[doc = "Ygyro."]
    pub ygyro: f32,
    #[doc = "Zgyro."]
    pub zgyro: f32,
    #[doc = "Lat."]
    pub lat: f32,
    #[doc = "Lon."]
    pub lon: f32,
    #[doc = "Alt."]
    pub alt: f32,
    #[doc = "Std dev horz."]
    pub std_dev_horz: f32,
    #[doc = "Std dev vert."]
    pub std_dev_vert: f32,
    #[doc = "Vn."]
    pub vn: f32,
    #[doc = "Ve."]
    pub ve: f32,
    #[doc = "Vd."]
    pub vd: f32,
    #[doc = "Lat int."]
    #[cfg_attr(feature = "serde", serde(default = "crate::utils::RustDefault::rust_default"))]
    pub lat_int: i32,
    #[doc = "Lon int."]
    #[cfg_attr(feature = "serde", serde(default = "crate::utils::RustDefault::rust_default"))]
    pub lon_int: i32,
}
impl SIM_STATE_DATA {
    pub const ENCODED_LEN: usize = 92usize;
    pub const DEFAULT: Self = Self {
        q1: 0.0_f32,
        q2: 0.0_f32,
        q3: 0.0_f32,
        q4: 0.0_f32,
        roll: 0.0_f32,
        pitch: 0.0_f32,
        yaw: 0.0_f32,
        xacc: 0.0_f32,
        yacc: 0.0_f32,
        zacc: 0.0_f32,
        xgyro: 0.0_f32,
        ygyro: 0.0_f32,
        zgyro: 0.0_f32,
        lat: 0.0_f32,
        lon: 0.0_f32,
        alt: 0.0_f32,
        std_dev_horz: 0.0_f32,
        std_dev_vert: 0.0_f32,
        vn: 0.0_f32,
        ve: 0.0_f32,
        vd: 0.0_f32,
        lat_int: 0_i32,
        lon_int: 0_i32,
    };
    #[cfg(feature = "arbitrary")]
    pub fn random<R: rand::Rng>(rng: &mut R) -> Self {
        use arbitrary::{Arbitrary, Unstructured};
        let mut buf = [0u8; 1024];
        rng.fill_bytes(&mut buf);
        let mut unstructured = Unstructured::new(&buf);
        Self::arbitrary(&mut unstructured).unwrap_or_default()
    }
}
impl Default for SIM_STATE_DATA {
    fn default() -> Self {
        Self::DEFAULT.clone()
    }
}
impl MessageData for SIM_STATE_DATA {
    type Message = MavMessage;
    const ID: u32 = 108u32;
    const NAME: &'static str = "SIM_STATE";
    const EXTRA_CRC: u8 = 32u8;
    const ENCODED_LEN: usize = 92usize;
    fn deser(_version: MavlinkVersion, __input: &[u8]) -> Result<Self, ::mavlink_core::error::ParserError> {
        let avail_len = __input.len();
        let mut payload_buf;
        let mut buf = if avail_len < Self::ENCODED_LEN {
            payload_buf = [0; Self::ENCODED_LEN];
            payload_buf[0..avail_len].copy_from_slice(__input);
            Bytes::new(&payload_buf)
        } else {
            Bytes::new(__input)
        };
        let mut __struct = Self::default();
        __struct.q1 = buf.get_f32_le()?;
        __struct.q2 = buf.get_f32_le()?;
        __struct.q3 = buf.get_f32_le()?;
        __struct.q4 = buf.get_f32_le()?;
        __struct.roll = buf.get_f32_le()?;
        __struct.pitch = buf.get_f32_le()?;
        __struct.yaw = buf.get_f32_le()?;
        __struct.xacc = buf.get_f32_le()?;
        __struct.yacc = buf.get_f32_le()?;
        __struct.zacc = buf.get_f32_le()?;
        __struct.xgyro = buf.get_f32_le()?;
        __struct.ygyro = buf.get_f32_le()?;
        __struct.zgyro = buf.get_f32_le()?;
        __struct.lat = buf.get_f32_le()?;
        __struct.lon = buf.get_f32_le()?;
        __struct.alt = buf.get_f32_le()?;
        __struct.std_dev_horz = buf.get_f32_le()?;
        __struct.std_dev_vert = buf.get_f32_le()?;
        __struct.vn = buf.get_f32_le()?;
        __struct.ve = buf.get_f32_le()?;
        __struct.vd = buf.get_f32_le()?;
        __struct.lat_int = buf.get_i32_le()?;
        __struct.lon_int = buf.get_i32_le()?;
        Ok(__struct)
    }
    fn ser(&self, version: MavlinkVersion, bytes: &mut [u8]) -> usize {
        let mut __tmp = BytesMut::new(bytes);
        if __tmp.remaining() < Self::ENCODED_LEN {
            panic!("buffer is too small (need {} bytes, but got {})", Self::ENCODED_LEN, __tmp.remaining(),)
        }
        __tmp.put_f32_le(self.q1);
        __tmp.put_f32_le(self.q2);
        __tmp.put_f32_le(self.q3);
        __tmp.put_f32_le(self.q4);
        __tmp.put_f32_le(self.roll);
        __tmp.put_f32_le(self.pitch);
        __tmp.put_f32_le(self.yaw);
        __tmp.put_f32_le(self.xacc);
        __tmp.put_f32_le(self.yacc);
        __tmp.put_f32_le(self.zacc);
        __tmp.put_f32_le(self.xgyro);
        __tmp.put_f32_le(self.ygyro);
        __tmp.put_f32_le(self.zgyro);
        __tmp.put_f32_le(self.lat);
        __tmp.put_f32_le(self.lon);
        __tmp.put_f32_le(self.alt);
        __tmp.put_f32_le(self.std_dev_horz);
        __tmp.put_f32_le(self.std_dev_vert);
        __tmp.put_f32_le(self.vn);
        __tmp.put_f32_le(self.ve);
        __tmp.put_f32_le(self.vd);
        if matches!(version, MavlinkVersion::V2) {
            __tmp.put_i32_le(self.lat_int);
            __tmp.put_i32_le(self.lon_int);
            let len = __tmp.len();
            ::mavlink_core::utils::remove_trailing_zeroes(&bytes[..len])
        } else {
            __tmp.len()
        }
    }
}
#[doc = "A text for the pilot."]
#[doc = ""]
#[doc = "ID: 253"]
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(Serialize, Deserialize))]
#[cfg_attr(feature = "arbitrary", derive(Arbitrary))]
#[cfg_attr(feature = "ts-rs", derive(TS))]
#[cfg_attr(feature = "ts-rs", ts(export))]
pub struct STATUSTEXT_DATA {
    #[doc = "Severity."]
    pub severity: MavSeverity,
    #[doc = "Text."]
    #[cfg_attr(feature = "ts-rs", ts(type = "string"))]
    pub text: CharArray<50>,
}
impl STATUSTEXT_DATA {
    pub const ENCODED_LEN: usize = 51usize;
    pub const DEFAULT: Self = Self { severity: MavSeverity::DEFAULT, text: CharArray::new([0_u8; 50usize]) };
    #[cfg(feature = "arbitrary")]
    pub fn random<R: rand::Rng>(rng: &mut R) -> Self {
        use arbitrary::{Arbitrary, Unstructured};
        let mut buf = [0u8; 1024];
        rng.fill_bytes(&mut buf);
        let mut unstructured = Unstructured::new(&buf);
        Self::arbitrary(&mut unstructured).unwrap_or_default()
    }
}
impl Default for STATUSTEXT_DATA {
    fn default() -> Self {
        Self::DEFAULT.clone()
    }
}
impl MessageData for STATUSTEXT_DATA {
    type Message = MavMessage;
    const ID: u32 = 253u32;
    const NAME: &'static str = "STATUSTEXT";
    const EXTRA_CRC: u8 = 83u8;
    const ENCODED_LEN: usize = 51usize;
    fn deser(_version: MavlinkVersion, __input: &[u8]) -> Result<Self, ::mavlink_core::error::ParserError> {
        let avail_len = __input.len();
        let mut payload_buf;
        let mut buf = if avail_len < Self::ENCODED_LEN {
            payload_buf = [0; Self::ENCODED_LEN];
            payload_buf[0..avail_len].copy_from_slice(__input);
            Bytes::new(&payload_buf)
        } else {
            Bytes::new(__input)
        };
        let mut __struct = Self::default();
        let tmp = buf.get_u8()?;
        __struct.severity = FromPrimitive::from_u8(tmp)
            .ok_or(::mavlink_core::error::ParserError::InvalidEnum { enum_type: "MavSeverity", value: tmp as u64 })?;
        let mut tmp = [0_u8; 50usize];
        for v in &mut tmp {
            *v = buf.get_u8()?;
        }
        __struct.text = CharArray::new(tmp);
        Ok(__struct)
    }
    fn ser(&self, version: MavlinkVersion, bytes: &mut [u8]) -> usize {
        let mut __tmp = BytesMut::new(bytes);
        if __tmp.remaining() < Self::ENCODED_LEN {
            panic!("buffer is too small (need {} bytes, but got {})", Self::ENCODED_LEN, __tmp.remaining(),)
        }
        __tmp.put_u8(self.severity as u8);
        for val in &self.text {
            __tmp.put_u8(*val);
        }
        if matches!(version, MavlinkVersion::V2) {
            let len = __tmp.len();
            ::mavlink_core::utils::remove_trailing_zeroes(&bytes[..len])
        } else {
            __tmp.len()
        }
    }
}
#[doc = "UTC and the time since boot."]
#[doc = ""]
#[doc = "ID: 2"]
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(Serialize, Deserialize))]
#[cfg_attr(feature = "arbitrary", derive(Arbitrary))]
#[cfg_attr(feature = "ts-rs", derive(TS))]
#[cfg_attr(feature = "ts-rs", ts(export))]
pub struct SYSTEM_TIME_DATA {
    #[doc = "Time unix usec."]
    pub time_unix_usec: u64,
    #[doc = "Time since boot."]
    pub time_boot_ms: u32,
}
impl SYSTEM_TIME_DATA {
    pub const ENCODED_LEN: usize = 12usize;
    pub const DEFAULT: Self = Self { time_unix_usec: 0_u64, time_boot_ms: 0_u32 };
    #[cfg(feature = "arbitrary")]
    pub fn random<R: rand::Rng>(rng: &mut R) -> Self {
        use arbitrary::{Arbitrary, Unstructured};
        let mut buf = [0u8; 1024];
        rng.fill_bytes(&mut buf);
        let mut unstructured = Unstructured::new(&buf);
        Self::arbitrary(&mut unstructured).unwrap_or_default()
    }
}
impl Default for SYSTEM_TIME_DATA {
    fn default() -> Self {
        Self::DEFAULT.clone()
    }
}
impl MessageData for SYSTEM_TIME_DATA {
    type Message = MavMessage;
    const ID: u32 = 2u32;
    const NAME: &'static str = "SYSTEM_TIME";
    const EXTRA_CRC: u8 = 137u8;
    const ENCODED_LEN: usize = 12usize;
    fn deser(_version: MavlinkVersion, __input: &[u8]) -> Result<Self, ::mavlink_core::error::ParserError> {
        let avail_len = __input.len();
        let mut payload_buf;
        let mut buf = if avail_len < Self::ENCODED_LEN {
            payload_buf = [0; Self::ENCODED_LEN];
            payload_buf[0..avail_len].copy_from_slice(__input);
            Bytes::new(&payload_buf)
        } else {
            Bytes::new(__input)
        };
        let mut __struct = Self::default();
        __struct.time_unix_usec = buf.get_u64_le()?;
        __struct.time_boot_ms = buf.get_u32_le()?;
        Ok(__struct)
    }
    fn ser(&self, version: MavlinkVersion, bytes: &mut [u8]) -> usize {
        let mut __tmp = BytesMut::new(bytes);
        if __tmp.remaining() < Self::ENCODED_LEN {
            panic!("buffer is too small (need {} bytes, but got {})", Self::ENCODED_LEN, __tmp.remaining(),)
        }
        __tmp.put_u64_le(self.time_unix_usec);
        __tmp.put_u32_le(self.time_boot_ms);
        if matches!(version, MavlinkVersion::V2) {
            let len = __tmp.len();
            ::mavlink_core::utils::remove_trailing_zeroes(&bytes[..len])
        } else {
            __tmp.len()
        }
    }
}
#[doc = "Health."]
#[doc = ""]
#[doc = "ID: 1"]
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(Serialize, Deserialize))]
#[cfg_attr(feature = "arbitrary", derive(Arbitrary))]
#[cfg_attr(feature = "ts-rs", derive(TS))]
#[cfg_attr(feature = "ts-rs", ts(export))]
pub struct SYS_STATUS_DATA {
    #[doc = "What there is."]
    pub onboard_control_sensors_present: MavSysStatusSensor,
    #[doc = "What is in use."]
    pub onboard_control_sensors_enabled: MavSysStatusSensor,
    #[doc = "What is well."]
    pub onboard_control_sensors_health: MavSysStatusSensor,
    #[doc = "Share of the time in use."]
    pub load: u16,
    #[doc = "Battery voltage, UINT16_MAX if unknown."]
    pub voltage_battery: u16,
    #[doc = "Battery current, -1 if unknown."]
    pub current_battery: i16,
    #[doc = "Share of received frames lost."]
    pub drop_rate_comm: u16,
    #[doc = "Received bytes or frames lost."]
    pub errors_comm: u16,
    #[doc = "Sensor samples refused."]
    pub errors_count1: u16,
    #[doc = "Overruns of the outer partition."]
    pub errors_count2: u16,
    #[doc = "Overruns of the commander partition."]
    pub errors_count3: u16,
    #[doc = "Overruns of the ground partition."]
    pub errors_count4: u16,
    #[doc = "Battery charge, -1 if unknown."]
    pub battery_remaining: i8,
}
impl SYS_STATUS_DATA {
    pub const ENCODED_LEN: usize = 31usize;
    pub const DEFAULT: Self = Self {
        onboard_control_sensors_present: MavSysStatusSensor::DEFAULT,
        onboard_control_sensors_enabled: MavSysStatusSensor::DEFAULT,
        onboard_control_sensors_health: MavSysStatusSensor::DEFAULT,
        load: 0_u16,
        voltage_battery: 0_u16,
        current_battery: 0_i16,
        drop_rate_comm: 0_u16,
        errors_comm: 0_u16,
        errors_count1: 0_u16,
        errors_count2: 0_u16,
        errors_count3: 0_u16,
        errors_count4: 0_u16,
        battery_remaining: 0_i8,
    };
    #[cfg(feature = "arbitrary")]
    pub fn random<R: rand::Rng>(rng: &mut R) -> Self {
        use arbitrary::{Arbitrary, Unstructured};
        let mut buf = [0u8; 1024];
        rng.fill_bytes(&mut buf);
        let mut unstructured = Unstructured::new(&buf);
        Self::arbitrary(&mut unstructured).unwrap_or_default()
    }
}
impl Default for SYS_STATUS_DATA {
    fn default() -> Self {
        Self::DEFAULT.clone()
    }
}
impl MessageData for SYS_STATUS_DATA {
    type Message = MavMessage;
    const ID: u32 = 1u32;
    const NAME: &'static str = "SYS_STATUS";
    const EXTRA_CRC: u8 = 124u8;
    const ENCODED_LEN: usize = 31usize;
    fn deser(_version: MavlinkVersion, __input: &[u8]) -> Result<Self, ::mavlink_core::error::ParserError> {
        let avail_len = __input.len();
        let mut payload_buf;
        let mut buf = if avail_len < Self::ENCODED_LEN {
            payload_buf = [0; Self::ENCODED_LEN];
            payload_buf[0..avail_len].copy_from_slice(__input);
            Bytes::new(&payload_buf)
        } else {
            Bytes::new(__input)
        };
        let mut __struct = Self::default();
        let tmp = buf.get_u32_le()?;
        __struct.onboard_control_sensors_present =
            MavSysStatusSensor::from_bits_retain(tmp as <MavSysStatusSensor as Flags>::Bits);
        let tmp = buf.get_u32_le()?;
        __struct.onboard_control_sensors_enabled =
            MavSysStatusSensor::from_bits_retain(tmp as <MavSysStatusSensor as Flags>::Bits);
        let tmp = buf.get_u32_le()?;
        __struct.onboard_control_sensors_health =
            MavSysStatusSensor::from_bits_retain(tmp as <MavSysStatusSensor as Flags>::Bits);
        __struct.load = buf.get_u16_le()?;
        __struct.voltage_battery = buf.get_u16_le()?;
        __struct.current_battery = buf.get_i16_le()?;
        __struct.drop_rate_comm = buf.get_u16_le()?;
        __struct.errors_comm = buf.get_u16_le()?;
        __struct.errors_count1 = buf.get_u16_le()?;
        __struct.errors_count2 = buf.get_u16_le()?;
        __struct.errors_count3 = buf.get_u16_le()?;
        __struct.errors_count4 = buf.get_u16_le()?;
        __struct.battery_remaining = buf.get_i8()?;
        Ok(__struct)
    }
    fn ser(&self, version: MavlinkVersion, bytes: &mut [u8]) -> usize {
        let mut __tmp = BytesMut::new(bytes);
        if __tmp.remaining() < Self::ENCODED_LEN {
            panic!("buffer is too small (need {} bytes, but got {})", Self::ENCODED_LEN, __tmp.remaining(),)
        }
        __tmp.put_u32_le(self.onboard_control_sensors_present.bits() as u32);
        __tmp.put_u32_le(self.onboard_control_sensors_enabled.bits() as u32);
        __tmp.put_u32_le(self.onboard_control_sensors_health.bits() as u32);
        __tmp.put_u16_le(self.load);
        __tmp.put_u16_le(self.voltage_battery);
        __tmp.put_i16_le(self.current_battery);
        __tmp.put_u16_le(self.drop_rate_comm);
        __tmp.put_u16_le(self.errors_comm);
        __tmp.put_u16_le(self.errors_count1);
        __tmp.put_u16_le(self.errors_count2);
        __tmp.put_u16_le(self.errors_count3);
        __tmp.put_u16_le(self.errors_count4);
        __tmp.put_i8(self.battery_remaining);
        if matches!(version, MavlinkVersion::V2) {
            let len = __tmp.len();
            ::mavlink_core::utils::remove_trailing_zeroes(&bytes[..len])
        } else {
            __tmp.len()
        }
    }
}
#[doc = "Compares two clocks."]
#[doc = ""]
#[doc = "ID: 111"]
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(Serialize, Deserialize))]
#[cfg_attr(feature = "arbitrary", derive(Arbitrary))]
#[cfg_attr(feature = "ts-rs", derive(TS))]
#[cfg_attr(feature = "ts-rs", ts(export))]
pub struct TIMESYNC_DATA {
    #[doc = "0 in a request, the responder's time in a response."]
    pub tc1: i64,
    #[doc = "The requester's time."]
    pub ts1: i64,
    #[doc = "System."]
    #[cfg_attr(feature = "serde", serde(default = "crate::utils::RustDefault::rust_default"))]
    pub target_system: u8,
    #[doc = "Component."]
    #[cfg_attr(feature = "serde", serde(default = "crate::utils::RustDefault::rust_default"))]
    pub target_component: u8,
}
impl TIMESYNC_DATA {
    pub const ENCODED_LEN: usize = 18usize;
    pub const DEFAULT: Self = Self { tc1: 0_i64, ts1: 0_i64, target_system: 0_u8, target_component: 0_u8 };
    #[cfg(feature = "arbitrary")]
    pub fn random<R: rand::Rng>(rng: &mut R) -> Self {
        use arbitrary::{Arbitrary, Unstructured};
        let mut buf = [0u8; 1024];
        rng.fill_bytes(&mut buf);
        let mut unstructured = Unstructured::new(&buf);
        Self::arbitrary(&mut unstructured).unwrap_or_default()
    }
}
impl Default for TIMESYNC_DATA {
    fn default() -> Self {
        Self::DEFAULT.clone()
    }
}
impl MessageData for TIMESYNC_DATA {
    type Message = MavMessage;
    const ID: u32 = 111u32;
    const NAME: &'static str = "TIMESYNC";
    const EXTRA_CRC: u8 = 34u8;
    const ENCODED_LEN: usize = 18usize;
    fn deser(_version: MavlinkVersion, __input: &[u8]) -> Result<Self, ::mavlink_core::error::ParserError> {
        let avail_len = __input.len();
        let mut payload_buf;
        let mut buf = if avail_len < Self::ENCODED_LEN {
            payload_buf = [0; Self::ENCODED_LEN];
            payload_buf[0..avail_len].copy_from_slice(__input);
            Bytes::new(&payload_buf)
        } else {
            Bytes::new(__input)
        };
        let mut __struct = Self::default();
        __struct.tc1 = buf.get_i64_le()?;
        __struct.ts1 = buf.get_i64_le()?;
        __struct.target_system = buf.get_u8()?;
        __struct.target_component = buf.get_u8()?;
        Ok(__struct)
    }
    fn ser(&self, version: MavlinkVersion, bytes: &mut [u8]) -> usize {
        let mut __tmp = BytesMut::new(bytes);
        if __tmp.remaining() < Self::ENCODED_LEN {
            panic!("buffer is too small (need {} bytes, but got {})", Self::ENCODED_LEN, __tmp.remaining(),)
        }
        __tmp.put_i64_le(self.tc1);
        __tmp.put_i64_le(self.ts1);
        if matches!(version, MavlinkVersion::V2) {
            __tmp.put_u8(self.target_system);
            __tmp.put_u8(self.target_component);
            let len = __tmp.len();
            ::mavlink_core::utils::remove_trailing_zeroes(&bytes[..len])
        } else {
            __tmp.len()
        }
    }
}
#[doc = "What a pilot reads off."]
#[doc = ""]
#[doc = "ID: 74"]
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(Serialize, Deserialize))]
#[cfg_attr(feature = "arbitrary", derive(Arbitrary))]
#[cfg_attr(feature = "ts-rs", derive(TS))]
#[cfg_attr(feature = "ts-rs", ts(export))]
pub struct VFR_HUD_DATA {
    #[doc = "Airspeed."]
    pub airspeed: f32,
    #[doc = "Groundspeed."]
    pub groundspeed: f32,
    #[doc = "Alt."]
    pub alt: f32,
    #[doc = "Climb."]
    pub climb: f32,
    #[doc = "Heading."]
    pub heading: i16,
    #[doc = "Throttle."]
    pub throttle: u16,
}
impl VFR_HUD_DATA {
    pub const ENCODED_LEN: usize = 20usize;
    pub const DEFAULT: Self =
        Self { airspeed: 0.0_f32, groundspeed: 0.0_f32, alt: 0.0_f32, climb: 0.0_f32, heading: 0_i16, throttle: 0_u16 };
    #[cfg(feature = "arbitrary")]
    pub fn random<R: rand::Rng>(rng: &mut R) -> Self {
        use arbitrary::{Arbitrary, Unstructured};
        let mut buf = [0u8; 1024];
        rng.fill_bytes(&mut buf);
        let mut unstructured = Unstructured::new(&buf);
        Self::arbitrary(&mut unstructured).unwrap_or_default()
    }
}
impl Default for VFR_HUD_DATA {
    fn default() -> Self {
        Self::DEFAULT.clone()
    }
}
impl MessageData for VFR_HUD_DATA {
    type Message = MavMessage;
    const ID: u32 = 74u32;
    const NAME: &'static str = "VFR_HUD";
    const EXTRA_CRC: u8 = 20u8;
    const ENCODED_LEN: usize = 20usize;
    fn deser(_version: MavlinkVersion, __input: &[u8]) -> Result<Self, ::mavlink_core::error::ParserError> {
        let avail_len = __input.len();
        let mut payload_buf;
        let mut buf = if avail_len < Self::ENCODED_LEN {
            payload_buf = [0; Self::ENCODED_LEN];
            payload_buf[0..avail_len].copy_from_slice(__input);
            Bytes::new(&payload_buf)
        } else {
            Bytes::new(__input)
        };
        let mut __struct = Self::default();
        __struct.airspeed = buf.get_f32_le()?;
        __struct.groundspeed = buf.get_f32_le()?;
        __struct.alt = buf.get_f32_le()?;
        __struct.climb = buf.get_f32_le()?;
        __struct.heading = buf.get_i16_le()?;
        __struct.throttle = buf.get_u16_le()?;
        Ok(__struct)
    }
    fn ser(&self, version: MavlinkVersion, bytes: &mut [u8]) -> usize {
        let mut __tmp = BytesMut::new(bytes);
        if __tmp.remaining() < Self::ENCODED_LEN {
            panic!("buffer is too small (need {} bytes, but got {})", Self::ENCODED_LEN, __tmp.remaining(),)
        }
        __tmp.put_f32_le(self.airspeed);
        __tmp.put_f32_le(self.groundspeed);
        __tmp.put_f32_le(self.alt);
        __tmp.put_f32_le(self.climb);
        __tmp.put_i16_le(self.heading);
        __tmp.put_u16_le(self.throttle);
        if matches!(version, MavlinkVersion::V2) {
            let len = __tmp.len();
            ::mavlink_core::utils::remove_trailing_zeroes(&bytes[..len])
        } else {
            __tmp.len()
        }
    }
}
#[doc = "Vibration."]
#[doc = ""]
#[doc = "ID: 241"]
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(Serialize, Deserialize))]
#[cfg_attr(feature = "arbitrary", derive(Arbitrary))]
#[cfg_attr(feature = "ts-rs", derive(TS))]
#[cfg_attr(feature = "ts-rs", ts(export))]
pub struct VIBRATION_DATA {
    #[doc = "Time since boot."]
    pub time_usec: u64,
    #[doc = "Vibration x."]
    pub vibration_x: f32,
    #[doc = "Vibration y."]
    pub vibration_y: f32,
    #[doc = "Vibration z."]
    pub vibration_z: f32,
    #[doc = "Clipping 0."]
    pub clipping_0: u32,
    #[doc = "Clipping 1."]
    pub clipping_1: u32,
    #[doc = "Clipping 2."]
    pub clipping_2: u32,
}
impl VIBRATION_DATA {
    pub const ENCODED_LEN: usize = 32usize;
    pub const DEFAULT: Self = Self {
        time_usec: 0_u64,
        vibration_x: 0.0_f32,
        vibration_y: 0.0_f32,
        vibration_z: 0.0_f32,
        clipping_0: 0_u32,
        clipping_1: 0_u32,
        clipping_2: 0_u32,
    };
    #[cfg(feature = "arbitrary")]
    pub fn random<R: rand::Rng>(rng: &mut R) -> Self {
        use arbitrary::{Arbitrary, Unstructured};
        let mut buf = [0u8; 1024];
        rng.fill_bytes(&mut buf);
        let mut unstructured = Unstructured::new(&buf);
        Self::arbitrary(&mut unstructured).unwrap_or_default()
    }
}
impl Default for VIBRATION_DATA {
    fn default() -> Self {
        Self::DEFAULT.clone()
    }
}
impl MessageData for VIBRATION_DATA {
    type Message = MavMessage;
    const ID: u32 = 241u32;
    const NAME: &'static str = "VIBRATION";
    const EXTRA_CRC: u8 = 90u8;
    const ENCODED_LEN: usize = 32usize;
    fn deser(_version: MavlinkVersion, __input: &[u8]) -> Result<Self, ::mavlink_core::error::ParserError> {
        let avail_len = __input.len();
        let mut payload_buf;
        let mut buf = if avail_len < Self::ENCODED_LEN {
            payload_buf = [0; Self::ENCODED_LEN];
            payload_buf[0..avail_len].copy_from_slice(__input);
            Bytes::new(&payload_buf)
        } else {
            Bytes::new(__input)
        };
        let mut __struct = Self::default();
        __struct.time_usec = buf.get_u64_le()?;
        __struct.vibration_x = buf.get_f32_le()?;
        __struct.vibration_y = buf.get_f32_le()?;
        __struct.vibration_z = buf.get_f32_le()?;
        __struct.clipping_0 = buf.get_u32_le()?;
        __struct.clipping_1 = buf.get_u32_le()?;
        __struct.clipping_2 = buf.get_u32_le()?;
        Ok(__struct)
    }
    fn ser(&self, version: MavlinkVersion, bytes: &mut [u8]) -> usize {
        let mut __tmp = BytesMut::new(bytes);
        if __tmp.remaining() < Self::ENCODED_LEN {
            panic!("buffer is too small (need {} bytes, but got {})", Self::ENCODED_LEN, __tmp.remaining(),)
        }
        __tmp.put_u64_le(self.time_usec);
        __tmp.put_f32_le(self.vibration_x);
        __tmp.put_f32_le(self.vibration_y);
        __tmp.put_f32_le(self.vibration_z);
        __tmp.put_u32_le(self.clipping_0);
        __tmp.put_u32_le(self.clipping_1);
        __tmp.put_u32_le(self.clipping_2);
        if matches!(version, MavlinkVersion::V2) {
            let len = __tmp.len();
            ::mavlink_core::utils::remove_trailing_zeroes(&bytes[..len])
        } else {
            __tmp.len()
        }
    }
}
#[doc = "Wind."]
#[doc = ""]
#[doc = "ID: 231"]
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(Serialize, Deserialize))]
#[cfg_attr(feature = "arbitrary", derive(Arbitrary))]
#[cfg_attr(feature = "ts-rs", derive(TS))]
#[cfg_attr(feature = "ts-rs", ts(export))]
pub struct WIND_COV_DATA {
    #[doc = "Time since boot."]
    pub time_usec: u64,
    #[doc = "Wind x."]
    pub wind_x: f32,
    #[doc = "Wind y."]
    pub wind_y: f32,
    #[doc = "Wind z."]
    pub wind_z: f32,
    #[doc = "Var horiz."]
    pub var_horiz: f32,
    #[doc = "Var vert."]
    pub var_vert: f32,
    #[doc = "Wind alt."]
    pub wind_alt: f32,
    #[doc = "Horiz accuracy."]
    pub horiz_accuracy: f32,
    #[doc = "Vert accuracy."]
    pub vert_accuracy: f32,
}
impl WIND_COV_DATA {
    pub const ENCODED_LEN: usize = 40usize;
    pub const DEFAULT: Self = Self {
        time_usec: 0_u64,
        wind_x: 0.0_f32,
        wind_y: 0.0_f32,
        wind_z: 0.0_f32,
        var_horiz: 0.0_f32,
        var_vert: 0.0_f32,
        wind_alt: 0.0_f32,
        horiz_accuracy: 0.0_f32,
        vert_accuracy: 0.0_f32,
    };
    #[cfg(feature = "arbitrary")]
    pub fn random<R: rand::Rng>(rng: &mut R) -> Self {
        use arbitrary::{Arbitrary, Unstructured};
        let mut buf = [0u8; 1024];
        rng.fill_bytes(&mut buf);
        let mut unstructured = Unstructured::new(&buf);
        Self::arbitrary(&mut unstructured).unwrap_or_default()
    }
}
impl Default for WIND_COV_DATA {
    fn default() -> Self {
        Self::DEFAULT.clone()
    }
}
impl MessageData for WIND_COV_DATA {
    type Message = MavMessage;
    const ID: u32 = 231u32;
    const NAME: &'static str = "WIND_COV";
    const EXTRA_CRC: u8 = 105u8;
    const ENCODED_LEN: usize = 40usize;
    fn deser(_version: MavlinkVersion, __input: &[u8]) -> Result<Self, ::mavlink_core::error::ParserError> {
        let avail_len = __input.len();
        let mut payload_buf;
        let mut buf = if avail_len < Self::ENCODED_LEN {
            payload_buf = [0; Self::ENCODED_LEN];
            payload_buf[0..avail_len].copy_from_slice(__input);
            Bytes::new(&payload_buf)
        } else {
            Bytes::new(__input)
        };
        let mut __struct = Self::default();
        __struct.time_usec = buf.get_u64_le()?;
        __struct.wind_x = buf.get_f32_le()?;
        __struct.wind_y = buf.get_f32_le()?;
        __struct.wind_z = buf.get_f32_le()?;
        __struct.var_horiz = buf.get_f32_le()?;
        __struct.var_vert = buf.get_f32_le()?;
        __struct.wind_alt = buf.get_f32_le()?;
        __struct.horiz_accuracy = buf.get_f32_le()?;
        __struct.vert_accuracy = buf.get_f32_le()?;
        Ok(__struct)
    }
    fn ser(&self, version: MavlinkVersion, bytes: &mut [u8]) -> usize {
        let mut __tmp = BytesMut::new(bytes);
        if __tmp.remaining() < Self::ENCODED_LEN {
            panic!("buffer is too small (need {} bytes, but got {})", Self::ENCODED_LEN, __tmp.remaining(),)
        }
        __tmp.put_u64_le(self.time_usec);
        __tmp.put_f32_le(self.wind_x);
        __tmp.put_f32_le(self.wind_y);
        __tmp.put_f32_le(self.wind_z);
        __tmp.put_f32_le(self.var_horiz);
        __tmp.put_f32_le(self.var_vert);
        __tmp.put_f32_le(self.wind_alt);
        __tmp.put_f32_le(self.horiz_accuracy);
        __tmp.put_f32_le(self.vert_accuracy);
        if matches!(version, MavlinkVersion::V2) {
            let len = __tmp.len();
            ::mavlink_core::utils::remove_trailing_zeroes(&bytes[..len])
        } else {
            __tmp.len()
        }
    }
}
#[derive(Clone, PartialEq, Debug)]
#[cfg_attr(feature = "serde", derive(Serialize, Deserialize))]
#[cfg_attr(feature = "serde", serde(tag = "type"))]
#[cfg_attr(feature = "arbitrary", derive(Arbitrary))]
#[cfg_attr(feature = "ts-rs", derive(TS))]
#[cfg_attr(feature = "ts-rs", ts(export))]
#[repr(u32)]
pub enum MavMessage {
    #[doc = "Heights."]
    #[doc = ""]
    #[doc = "ID: 141"]
    ALTITUDE(ALTITUDE_DATA),
    #[doc = "Attitude and rates, NED/FRD."]
    #[doc = ""]
    #[doc = "ID: 30"]
    ATTITUDE(ATTITUDE_DATA),
    #[doc = "Attitude as a quaternion, and rates."]
    #[doc = ""]
    #[doc = "ID: 31"]
    ATTITUDE_QUATERNION(ATTITUDE_QUATERNION_DATA),
    #[doc = "Attitude and thrust that are aimed at."]
    #[doc = ""]
    #[doc = "ID: 83"]
    ATTITUDE_TARGET(ATTITUDE_TARGET_DATA),
    #[doc = "Version and capabilities."]
    #[doc = ""]
    #[doc = "ID: 148"]
    AUTOPILOT_VERSION(AUTOPILOT_VERSION_DATA),
    #[doc = "A mode that can be set."]
    #[doc = ""]
    #[doc = "ID: 435"]
    AVAILABLE_MODES(AVAILABLE_MODES_DATA),
    #[doc = "Changes when the modes change."]
    #[doc = ""]
    #[doc = "ID: 437"]
    AVAILABLE_MODES_MONITOR(AVAILABLE_MODES_MONITOR_DATA),
    #[doc = "Battery."]
    #[doc = ""]
    #[doc = "ID: 147"]
    BATTERY_STATUS(BATTERY_STATUS_DATA),
    #[doc = "How a command ended."]
    #[doc = ""]
    #[doc = "ID: 77"]
    COMMAND_ACK(COMMAND_ACK_DATA),
    #[doc = "A command with a position in integers."]
    #[doc = ""]
    #[doc = "ID: 75"]
    COMMAND_INT(COMMAND_INT_DATA),
    #[doc = "A command."]
    #[doc = ""]
    #[doc = "ID: 76"]
    COMMAND_LONG(COMMAND_LONG_DATA),
    #[doc = "The mode now."]
    #[doc = ""]
    #[doc = "ID: 436"]
    CURRENT_MODE(CURRENT_MODE_DATA),
    #[doc = "Named values."]
    #[doc = ""]
    #[doc = "ID: 350"]
    DEBUG_FLOAT_ARRAY(DEBUG_FLOAT_ARRAY_DATA),
    #[doc = "Speeds of the rotors."]
    #[doc = ""]
    #[doc = "ID: 291"]
    ESC_STATUS(ESC_STATUS_DATA),
    #[doc = "How the estimator is doing."]
    #[doc = ""]
    #[doc = "ID: 230"]
    ESTIMATOR_STATUS(ESTIMATOR_STATUS_DATA),
    #[doc = "Whether the vehicle is on the ground."]
    #[doc = ""]
    #[doc = "ID: 245"]
    EXTENDED_SYS_STATE(EXTENDED_SYS_STATE_DATA),
    #[doc = "A piece of a file transfer."]
    #[doc = ""]
    #[doc = "ID: 110"]
    FILE_TRANSFER_PROTOCOL(FILE_TRANSFER_PROTOCOL_DATA),
    #[doc = "Position on the globe."]
    #[doc = ""]
    #[doc = "ID: 33"]
    GLOBAL_POSITION_INT(GLOBAL_POSITION_INT_DATA),
    #[doc = "Place of the local origin."]
    #[doc = ""]
    #[doc = "ID: 49"]
    GPS_GLOBAL_ORIGIN(GPS_GLOBAL_ORIGIN_DATA),
    #[doc = "Position by the satellite receiver."]
    #[doc = ""]
    #[doc = "ID: 24"]
    GPS_RAW_INT(GPS_RAW_INT_DATA),
    #[doc = "Who this is, and its mode."]
    #[doc = ""]
    #[doc = "ID: 0"]
    HEARTBEAT(HEARTBEAT_DATA),
    #[doc = "Sensors in SI units."]
    #[doc = ""]
    #[doc = "ID: 105"]
    HIGHRES_IMU(HIGHRES_IMU_DATA),
    #[doc = "The true motion of a simulated vehicle."]
    #[doc = ""]
    #[doc = "ID: 115"]
    HIL_STATE_QUATERNION(HIL_STATE_QUATERNION_DATA),
    #[doc = "Where the vehicle returns to."]
    #[doc = ""]
    #[doc = "ID: 242"]
    HOME_POSITION(HOME_POSITION_DATA),
    #[doc = "Position and velocity, NED."]
    #[doc = ""]
    #[doc = "ID: 32"]
    LOCAL_POSITION_NED(LOCAL_POSITION_NED_DATA),
    #[doc = "A log."]
    #[doc = ""]
    #[doc = "ID: 118"]
    LOG_ENTRY(LOG_ENTRY_DATA),
    #[doc = "Asks to erase all logs."]
    #[doc = ""]
    #[doc = "ID: 121"]
    LOG_ERASE(LOG_ERASE_DATA),
    #[doc = "Asks for a piece of a log."]
    #[doc = ""]
    #[doc = "ID: 119"]
    LOG_REQUEST_DATA(LOG_REQUEST_DATA_DATA),
    #[doc = "Ends a log transfer."]
    #[doc = ""]
    #[doc = "ID: 122"]
    LOG_REQUEST_END(LOG_REQUEST_END_DATA),
    #[doc = "Asks for the list of logs."]
    #[doc = ""]
    #[doc = "ID: 117"]
    LOG_REQUEST_LIST(LOG_REQUEST_LIST_DATA),
    #[doc = "Sticks of a ground station."]
    #[doc = ""]
    #[doc = "ID: 69"]
    MANUAL_CONTROL(MANUAL_CONTROL_DATA),
    #[doc = "Interval of a message."]
    #[doc = ""]
    #[doc = "ID: 244"]
    MESSAGE_INTERVAL(MESSAGE_INTERVAL_DATA),
    #[doc = "Result of a mission transfer."]
    #[doc = ""]
    #[doc = "ID: 47"]
    MISSION_ACK(MISSION_ACK_DATA),
    #[doc = "Asks to clear a mission."]
    #[doc = ""]
    #[doc = "ID: 45"]
    MISSION_CLEAR_ALL(MISSION_CLEAR_ALL_DATA),
    #[doc = "How many mission items there are."]
    #[doc = ""]
    #[doc = "ID: 44"]
    MISSION_COUNT(MISSION_COUNT_DATA),
    #[doc = "The mission item under way."]
    #[doc = ""]
    #[doc = "ID: 42"]
    MISSION_CURRENT(MISSION_CURRENT_DATA),
    #[doc = "A mission item, the old way."]
    #[doc = ""]
    #[doc = "ID: 39"]
    MISSION_ITEM(MISSION_ITEM_DATA),
    #[doc = "A mission item."]
    #[doc = ""]
    #[doc = "ID: 73"]
    MISSION_ITEM_INT(MISSION_ITEM_INT_DATA),
    #[doc = "Asks for a mission item, the old way."]
    #[doc = ""]
    #[doc = "ID: 40"]
    MISSION_REQUEST(MISSION_REQUEST_DATA),
    #[doc = "Asks for a mission item."]
    #[doc = ""]
    #[doc = "ID: 51"]
    MISSION_REQUEST_INT(MISSION_REQUEST_INT_DATA),
    #[doc = "Asks how many mission items there are."]
    #[doc = ""]
    #[doc = "ID: 43"]
    MISSION_REQUEST_LIST(MISSION_REQUEST_LIST_DATA),
    #[doc = "Asks for part of a mission."]
    #[doc = ""]
    #[doc = "ID: 37"]
    MISSION_REQUEST_PARTIAL_LIST(MISSION_REQUEST_PARTIAL_LIST_DATA),
    #[doc = "Asks to go on with an item."]
    #[doc = ""]
    #[doc = "ID: 41"]
    MISSION_SET_CURRENT(MISSION_SET_CURRENT_DATA),
    #[doc = "Asks for part of a mission to be replaced."]
    #[doc = ""]
    #[doc = "ID: 38"]
    MISSION_WRITE_PARTIAL_LIST(MISSION_WRITE_PARTIAL_LIST_DATA),
    #[doc = "A named value."]
    #[doc = ""]
    #[doc = "ID: 251"]
    NAMED_VALUE_FLOAT(NAMED_VALUE_FLOAT_DATA),
    #[doc = "A named number."]
    #[doc = ""]
    #[doc = "ID: 252"]
    NAMED_VALUE_INT(NAMED_VALUE_INT_DATA),
    #[doc = "Pose and velocity with their covariances."]
    #[doc = ""]
    #[doc = "ID: 331"]
    ODOMETRY(ODOMETRY_DATA),
    #[doc = "The circle that is flown."]
    #[doc = ""]
    #[doc = "ID: 360"]
    ORBIT_EXECUTION_STATUS(ORBIT_EXECUTION_STATUS_DATA),
    #[doc = "Why a parameter was refused."]
    #[doc = ""]
    #[doc = "ID: 345"]
    PARAM_ERROR(PARAM_ERROR_DATA),
    #[doc = "Answers PARAM_EXT_SET."]
    #[doc = ""]
    #[doc = "ID: 324"]
    PARAM_EXT_ACK(PARAM_EXT_ACK_DATA),
    #[doc = "Asks for all extended parameters."]
    #[doc = ""]
    #[doc = "ID: 321"]
    PARAM_EXT_REQUEST_LIST(PARAM_EXT_REQUEST_LIST_DATA),
    #[doc = "Asks for an extended parameter."]
    #[doc = ""]
    #[doc = "ID: 320"]
    PARAM_EXT_REQUEST_READ(PARAM_EXT_REQUEST_READ_DATA),
    #[doc = "Sets an extended parameter."]
    #[doc = ""]
    #[doc = "ID: 323"]
    PARAM_EXT_SET(PARAM_EXT_SET_DATA),
    #[doc = "An extended parameter."]
    #[doc = ""]
    #[doc = "ID: 322"]
    PARAM_EXT_VALUE(PARAM_EXT_VALUE_DATA),
    #[doc = "Asks for all parameters."]
    #[doc = ""]
    #[doc = "ID: 21"]
    PARAM_REQUEST_LIST(PARAM_REQUEST_LIST_DATA),
    #[doc = "Asks for a parameter."]
    #[doc = ""]
    #[doc = "ID: 20"]
    PARAM_REQUEST_READ(PARAM_REQUEST_READ_DATA),
    #[doc = "Sets a parameter."]
    #[doc = ""]
    #[doc = "ID: 23"]
    PARAM_SET(PARAM_SET_DATA),
    #[doc = "A parameter."]
    #[doc = ""]
    #[doc = "ID: 22"]
    PARAM_VALUE(PARAM_VALUE_DATA),
    #[doc = "Asks for an answer, or answers."]
    #[doc = ""]
    #[doc = "ID: 4"]
    PING(PING_DATA),
    #[doc = "Place and velocity that are aimed at."]
    #[doc = ""]
    #[doc = "ID: 85"]
    POSITION_TARGET_LOCAL_NED(POSITION_TARGET_LOCAL_NED_DATA),
    #[doc = "Protocol version."]
    #[doc = ""]
    #[doc = "ID: 300"]
    PROTOCOL_VERSION(PROTOCOL_VERSION_DATA),
    #[doc = "Channels of the remote control."]
    #[doc = ""]
    #[doc = "ID: 65"]
    RC_CHANNELS(RC_CHANNELS_DATA),
    #[doc = "Channels of a ground station."]
    #[doc = ""]
    #[doc = "ID: 70"]
    RC_CHANNELS_OVERRIDE(RC_CHANNELS_OVERRIDE_DATA),
    #[doc = "Asks for streams, the old way."]
    #[doc = ""]
    #[doc = "ID: 66"]
    REQUEST_DATA_STREAM(REQUEST_DATA_STREAM_DATA),
    #[doc = "IMU and magnetometer."]
    #[doc = ""]
    #[doc = "ID: 26"]
    SCALED_IMU(SCALED_IMU_DATA),
    #[doc = "Barometer."]
    #[doc = ""]
    #[doc = "ID: 29"]
    SCALED_PRESSURE(SCALED_PRESSURE_DATA),
    #[doc = "A serial console."]
    #[doc = ""]
    #[doc = "ID: 126"]
    SERIAL_CONTROL(SERIAL_CONTROL_DATA),
    #[doc = "Outputs to the rotors."]
    #[doc = ""]
    #[doc = "ID: 36"]
    SERVO_OUTPUT_RAW(SERVO_OUTPUT_RAW_DATA),
    #[doc = "Sets an attitude and thrust."]
    #[doc = ""]
    #[doc = "ID: 82"]
    SET_ATTITUDE_TARGET(SET_ATTITUDE_TARGET_DATA),
    #[doc = "Sets the place of the local origin."]
    #[doc = ""]
    #[doc = "ID: 48"]
    SET_GPS_GLOBAL_ORIGIN(SET_GPS_GLOBAL_ORIGIN_DATA),
    #[doc = "Asks for a mode, the old way."]
    #[doc = ""]
    #[doc = "ID: 11"]
    SET_MODE(SET_MODE_DATA),
    #[doc = "Sets a place or velocity on the globe."]
    #[doc = ""]
    #[doc = "ID: 86"]
    SET_POSITION_TARGET_GLOBAL_INT(SET_POSITION_TARGET_GLOBAL_INT_DATA),
    #[doc = "Sets a place or velocity in the local frame."]
    #[doc = ""]
    #[doc = "ID: 84"]
    SET_POSITION_TARGET_LOCAL_NED(SET_POSITION_TARGET_LOCAL_NED_DATA),
    #[doc = "The true state of a simulated vehicle."]
    #[doc = ""]
    #[doc = "ID: 108"]
    SIM_STATE(SIM_STATE_DATA),
    #[doc = "A text for the pilot."]
    #[doc = ""]
    #[doc = "ID: 253"]
    STATUSTEXT(STATUSTEXT_DATA),
    #[doc = "UTC and the time since boot."]
    #[doc = ""]
    #[doc = "ID: 2"]
    SYSTEM_TIME(SYSTEM_TIME_DATA),
    #[doc = "Health."]
    #[doc = ""]
    #[doc = "ID: 1"]
    SYS_STATUS(SYS_STATUS_DATA),
    #[doc = "Compares two clocks."]
    #[doc = ""]
    #[doc = "ID: 111"]
    TIMESYNC(TIMESYNC_DATA),
    #[doc = "What a pilot reads off."]
    #[doc = ""]
    #[doc = "ID: 74"]
    VFR_HUD(VFR_HUD_DATA),
    #[doc = "Vibration."]
    #[doc = ""]
    #[doc = "ID: 241"]
    VIBRATION(VIBRATION_DATA),
    #[doc = "Wind."]
    #[doc = ""]
    #[doc = "ID: 231"]
    WIND_COV(WIND_COV_DATA),
}
impl MavMessage {
    pub const fn all_ids() -> &'static [u32] {
        &[
            0u32, 1u32, 2u32, 4u32, 11u32, 20u32, 21u32, 22u32, 23u32, 24u32, 26u32, 29u32, 30u32, 31u32, 32u32, 33u32,
            36u32, 37u32, 38u32, 39u32, 40u32, 41u32, 42u32, 43u32, 44u32, 45u32, 47u32, 48u32, 49u32, 51u32, 65u32,
            66u32, 69u32, 70u32, 73u32, 74u32, 75u32, 76u32, 77u32, 82u32, 83u32, 84u32, 85u32, 86u32, 105u32, 108u32,
            110u32, 111u32, 115u32, 117u32, 118u32, 119u32, 121u32, 122u32, 126u32, 141u32, 147u32, 148u32, 230u32,
            231u32, 241u32, 242u32, 244u32, 245u32, 251u32, 252u32, 253u32, 291u32, 300u32, 320u32, 321u32, 322u32,
            323u32, 324u32, 331u32, 345u32, 350u32, 360u32, 435u32, 436u32, 437u32,
        ]
    }
    pub const fn all_messages() -> &'static [(&'static str, u32)] {
        &[
            (HEARTBEAT_DATA::NAME, HEARTBEAT_DATA::ID),
            (SYS_STATUS_DATA::NAME, SYS_STATUS_DATA::ID),
            (SYSTEM_TIME_DATA::NAME, SYSTEM_TIME_DATA::ID),
            (PING_DATA::NAME, PING_DATA::ID),
            (SET_MODE_DATA::NAME, SET_MODE_DATA::ID),
            (PARAM_REQUEST_READ_DATA::NAME, PARAM_REQUEST_READ_DATA::ID),
            (PARAM_REQUEST_LIST_DATA::NAME, PARAM_REQUEST_LIST_DATA::ID),
            (PARAM_VALUE_DATA::NAME, PARAM_VALUE_DATA::ID),
            (PARAM_SET_DATA::NAME, PARAM_SET_DATA::ID),
            (GPS_RAW_INT_DATA::NAME, GPS_RAW_INT_DATA::ID),
            (SCALED_IMU_DATA::NAME, SCALED_IMU_DATA::ID),
            (SCALED_PRESSURE_DATA::NAME, SCALED_PRESSURE_DATA::ID),
            (ATTITUDE_DATA::NAME, ATTITUDE_DATA::ID),
            (ATTITUDE_QUATERNION_DATA::NAME, ATTITUDE_QUATERNION_DATA::ID),
            (LOCAL_POSITION_NED_DATA::NAME, LOCAL_POSITION_NED_DATA::ID),
            (GLOBAL_POSITION_INT_DATA::NAME, GLOBAL_POSITION_INT_DATA::ID),
            (SERVO_OUTPUT_RAW_DATA::NAME, SERVO_OUTPUT_RAW_DATA::ID),
            (MISSION_REQUEST_PARTIAL_LIST_DATA::NAME, MISSION_REQUEST_PARTIAL_LIST_DATA::ID),
            (MISSION_WRITE_PARTIAL_LIST_DATA::NAME, MISSION_WRITE_PARTIAL_LIST_DATA::ID),
            (MISSION_ITEM_DATA::NAME, MISSION_ITEM_DATA::ID),
            (MISSION_REQUEST_DATA::NAME, MISSION_REQUEST_DATA::ID),
            (MISSION_SET_CURRENT_DATA::NAME, MISSION_SET_CURRENT_DATA::ID),
            (MISSION_CURRENT_DATA::NAME, MISSION_CURRENT_DATA::ID),
            (MISSION_REQUEST_LIST_DATA::NAME, MISSION_REQUEST_LIST_DATA::ID),
            (MISSION_COUNT_DATA::NAME, MISSION_COUNT_DATA::ID),
            (MISSION_CLEAR_ALL_DATA::NAME, MISSION_CLEAR_ALL_DATA::ID),
            (MISSION_ACK_DATA::NAME, MISSION_ACK_DATA::ID),
            (SET_GPS_GLOBAL_ORIGIN_DATA::NAME, SET_GPS_GLOBAL_ORIGIN_DATA::ID),
            (GPS_GLOBAL_ORIGIN_DATA::NAME, GPS_GLOBAL_ORIGIN_DATA::ID),
            (MISSION_REQUEST_INT_DATA::NAME, MISSION_REQUEST_INT_DATA::ID),
            (RC_CHANNELS_DATA::NAME, RC_CHANNELS_DATA::ID),
            (REQUEST_DATA_STREAM_DATA::NAME, REQUEST_DATA_STREAM_DATA::ID),
            (MANUAL_CONTROL_DATA::NAME, MANUAL_CONTROL_DATA::ID),
            (RC_CHANNELS_OVERRIDE_DATA::NAME, RC_CHANNELS_OVERRIDE_DATA::ID),
            (MISSION_ITEM_INT_DATA::NAME, MISSION_ITEM_INT_DATA::ID),
            (VFR_HUD_DATA::NAME, VFR_HUD_DATA::ID),
            (COMMAND_INT_DATA::NAME, COMMAND_INT_DATA::ID),
            (COMMAND_LONG_DATA::NAME, COMMAND_LONG_DATA::ID),
            (COMMAND_ACK_DATA::NAME, COMMAND_ACK_DATA::ID),
            (SET_ATTITUDE_TARGET_DATA::NAME, SET_ATTITUDE_TARGET_DATA::ID),
            (ATTITUDE_TARGET_DATA::NAME, ATTITUDE_TARGET_DATA::ID),
            (SET_POSITION_TARGET_LOCAL_NED_DATA::NAME, SET_POSITION_TARGET_LOCAL_NED_DATA::ID),
            (POSITION_TARGET_LOCAL_NED_DATA::NAME, POSITION_TARGET_LOCAL_NED_DATA::ID),
            (SET_POSITION_TARGET_GLOBAL_INT_DATA::NAME, SET_POSITION_TARGET_GLOBAL_INT_DATA::ID),
            (HIGHRES_IMU_DATA::NAME, HIGHRES_IMU_DATA::ID),
            (SIM_STATE_DATA::NAME, SIM_STATE_DATA::ID),
            (FILE_TRANSFER_PROTOCOL_DATA::NAME, FILE_TRANSFER_PROTOCOL_DATA::ID),
            (TIMESYNC_DATA::NAME, TIMESYNC_DATA::ID),
            (HIL_STATE_QUATERNION_DATA::NAME, HIL_STATE_QUATERNION_DATA::ID),
            (LOG_REQUEST_LIST_DATA::NAME, LOG_REQUEST_LIST_DATA::ID),
            (LOG_ENTRY_DATA::NAME, LOG_ENTRY_DATA::ID),
            (LOG_REQUEST_DATA_DATA::NAME, LOG_REQUEST_DATA_DATA::ID),
            (LOG_ERASE_DATA::NAME, LOG_ERASE_DATA::ID),
            (LOG_REQUEST_END_DATA::NAME, LOG_REQUEST_END_DATA::ID),
            (SERIAL_CONTROL_DATA::NAME, SERIAL_CONTROL_DATA::ID),
            (ALTITUDE_DATA::NAME, ALTITUDE_DATA::ID),
            (BATTERY_STATUS_DATA::NAME, BATTERY_STATUS_DATA::ID),
            (AUTOPILOT_VERSION_DATA::NAME, AUTOPILOT_VERSION_DATA::ID),
            (ESTIMATOR_STATUS_DATA::NAME, ESTIMATOR_STATUS_DATA::ID),
            (WIND_COV_DATA::NAME, WIND_COV_DATA::ID),
            (VIBRATION_DATA::NAME, VIBRATION_DATA::ID),
            (HOME_POSITION_DATA::NAME, HOME_POSITION_DATA::ID),
            (MESSAGE_INTERVAL_DATA::NAME, MESSAGE_INTERVAL_DATA::ID),
            (EXTENDED_SYS_STATE_DATA::NAME, EXTENDED_SYS_STATE_DATA::ID),
            (NAMED_VALUE_FLOAT_DATA::NAME, NAMED_VALUE_FLOAT_DATA::ID),
            (NAMED_VALUE_INT_DATA::NAME, NAMED_VALUE_INT_DATA::ID),
            (STATUSTEXT_DATA::NAME, STATUSTEXT_DATA::ID),
            (ESC_STATUS_DATA::NAME, ESC_STATUS_DATA::ID),
            (PROTOCOL_VERSION_DATA::NAME, PROTOCOL_VERSION_DATA::ID),
            (PARAM_EXT_REQUEST_READ_DATA::NAME, PARAM_EXT_REQUEST_READ_DATA::ID),
            (PARAM_EXT_REQUEST_LIST_DATA::NAME, PARAM_EXT_REQUEST_LIST_DATA::ID),
            (PARAM_EXT_VALUE_DATA::NAME, PARAM_EXT_VALUE_DATA::ID),
            (PARAM_EXT_SET_DATA::NAME, PARAM_EXT_SET_DATA::ID),
            (PARAM_EXT_ACK_DATA::NAME, PARAM_EXT_ACK_DATA::ID),
            (ODOMETRY_DATA::NAME, ODOMETRY_DATA::ID),
            (PARAM_ERROR_DATA::NAME, PARAM_ERROR_DATA::ID),
            (DEBUG_FLOAT_ARRAY_DATA::NAME, DEBUG_FLOAT_ARRAY_DATA::ID),
            (ORBIT_EXECUTION_STATUS_DATA::NAME, ORBIT_EXECUTION_STATUS_DATA::ID),
            (AVAILABLE_MODES_DATA::NAME, AVAILABLE_MODES_DATA::ID),
            (CURRENT_MODE_DATA::NAME, CURRENT_MODE_DATA::ID),
            (AVAILABLE_MODES_MONITOR_DATA::NAME, AVAILABLE_MODES_MONITOR_DATA::ID),
        ]
    }
}
impl Message for MavMessage {
    fn parse(version: MavlinkVersion, id: u32, payload: &[u8]) -> Result<Self, ::mavlink_core::error::ParserError> {
        match id {
            ALTITUDE_DATA::ID => ALTITUDE_DATA::deser(version, payload).map(Self::ALTITUDE),
            ATTITUDE_DATA::ID => ATTITUDE_DATA::deser(version, payload).map(Self::ATTITUDE),
            ATTITUDE_QUATERNION_DATA::ID => {
                ATTITUDE_QUATERNION_DATA::deser(version, payload).map(Self::ATTITUDE_QUATERNION)
            }
            ATTITUDE_TARGET_DATA::ID => ATTITUDE_TARGET_DATA::deser(version, payload).map(Self::ATTITUDE_TARGET),
            AUTOPILOT_VERSION_DATA::ID => AUTOPILOT_VERSION_DATA::deser(version, payload).map(Self::AUTOPILOT_VERSION),
            AVAILABLE_MODES_DATA::ID => AVAILABLE_MODES_DATA::deser(version, payload).map(Self::AVAILABLE_MODES),
            AVAILABLE_MODES_MONITOR_DATA::ID => {
                AVAILABLE_MODES_MONITOR_DATA::deser(version, payload).map(Self::AVAILABLE_MODES_MONITOR)
            }
            BATTERY_STATUS_DATA::ID => BATTERY_STATUS_DATA::deser(version, payload).map(Self::BATTERY_STATUS),
            COMMAND_ACK_DATA::ID => COMMAND_ACK_DATA::deser(version, payload).map(Self::COMMAND_ACK),
            COMMAND_INT_DATA::ID => COMMAND_INT_DATA::deser(version, payload).map(Self::COMMAND_INT),
            COMMAND_LONG_DATA::ID => COMMAND_LONG_DATA::deser(version, payload).map(Self::COMMAND_LONG),
            CURRENT_MODE_DATA::ID => CURRENT_MODE_DATA::deser(version, payload).map(Self::CURRENT_MODE),
            DEBUG_FLOAT_ARRAY_DATA::ID => DEBUG_FLOAT_ARRAY_DATA::deser(version, payload).map(Self::DEBUG_FLOAT_ARRAY),
            ESC_STATUS_DATA::ID => ESC_STATUS_DATA::deser(version, payload).map(Self::ESC_STATUS),
            ESTIMATOR_STATUS_DATA::ID => ESTIMATOR_STATUS_DATA::deser(version, payload).map(Self::ESTIMATOR_STATUS),
            EXTENDED_SYS_STATE_DATA::ID => {
                EXTENDED_SYS_STATE_DATA::deser(version, payload).map(Self::EXTENDED_SYS_STATE)
            }
            FILE_TRANSFER_PROTOCOL_DATA::ID => {
                FILE_TRANSFER_PROTOCOL_DATA::deser(version, payload).map(Self::FILE_TRANSFER_PROTOCOL)
            }
            GLOBAL_POSITION_INT_DATA::ID => {
                GLOBAL_POSITION_INT_DATA::deser(version, payload).map(Self::GLOBAL_POSITION_INT)
            }
            GPS_GLOBAL_ORIGIN_DATA::ID => GPS_GLOBAL_ORIGIN_DATA::deser(version, payload).map(Self::GPS_GLOBAL_ORIGIN),
            GPS_RAW_INT_DATA::ID => GPS_RAW_INT_DATA::deser(version, payload).map(Self::GPS_RAW_INT),
            HEARTBEAT_DATA::ID => HEARTBEAT_DATA::deser(version, payload).map(Self::HEARTBEAT),
            HIGHRES_IMU_DATA::ID => HIGHRES_IMU_DATA::deser(version, payload).map(Self::HIGHRES_IMU),
            HIL_STATE_QUATERNION_DATA::ID => {
                HIL_STATE_QUATERNION_DATA::deser(version, payload).map(Self::HIL_STATE_QUATERNION)
            }
            HOME_POSITION_DATA::ID => HOME_POSITION_DATA::deser(version, payload).map(Self::HOME_POSITION),
            LOCAL_POSITION_NED_DATA::ID => {
                LOCAL_POSITION_NED_DATA::deser(version, payload).map(Self::LOCAL_POSITION_NED)
            }
            LOG_ENTRY_DATA::ID => LOG_ENTRY_DATA::deser(version, payload).map(Self::LOG_ENTRY),
            LOG_ERASE_DATA::ID => LOG_ERASE_DATA::deser(version, payload).map(Self::LOG_ERASE),
            LOG_REQUEST_DATA_DATA::ID => LOG_REQUEST_DATA_DATA::deser(version, payload).map(Self::LOG_REQUEST_DATA),
            LOG_REQUEST_END_DATA::ID => LOG_REQUEST_END_DATA::deser(version, payload).map(Self::LOG_REQUEST_END),
            LOG_REQUEST_LIST_DATA::ID => LOG_REQUEST_LIST_DATA::deser(version, payload).map(Self::LOG_REQUEST_LIST),
            MANUAL_CONTROL_DATA::ID => MANUAL_CONTROL_DATA::deser(version, payload).map(Self::MANUAL_CONTROL),
            MESSAGE_INTERVAL_DATA::ID => MESSAGE_INTERVAL_DATA::deser(version, payload).map(Self::MESSAGE_INTERVAL),
            MISSION_ACK_DATA::ID => MISSION_ACK_DATA::deser(version, payload).map(Self::MISSION_ACK),
            MISSION_CLEAR_ALL_DATA::ID => MISSION_CLEAR_ALL_DATA::deser(version, payload).map(Self::MISSION_CLEAR_ALL),
            MISSION_COUNT_DATA::ID => MISSION_COUNT_DATA::deser(version, payload).map(Self::MISSION_COUNT),
            MISSION_CURRENT_DATA::ID => MISSION_CURRENT_DATA::deser(version, payload).map(Self::MISSION_CURRENT),
            MISSION_ITEM_DATA::ID => MISSION_ITEM_DATA::deser(version, payload).map(Self::MISSION_ITEM),
            MISSION_ITEM_INT_DATA::ID => MISSION_ITEM_INT_DATA::deser(version, payload).map(Self::MISSION_ITEM_INT),
            MISSION_REQUEST_DATA::ID => MISSION_REQUEST_DATA::deser(version, payload).map(Self::MISSION_REQUEST),
            MISSION_REQUEST_INT_DATA::ID => {
                MISSION_REQUEST_INT_DATA::deser(version, payload).map(Self::MISSION_REQUEST_INT)
            }
            MISSION_REQUEST_LIST_DATA::ID => {
                MISSION_REQUEST_LIST_DATA::deser(version, payload).map(Self::MISSION_REQUEST_LIST)
            }
            MISSION_REQUEST_PARTIAL_LIST_DATA::ID => {
                MISSION_REQUEST_PARTIAL_LIST_DATA::deser(version, payload).map(Self::MISSION_REQUEST_PARTIAL_LIST)
            }
            MISSION_SET_CURRENT_DATA::ID => {
                MISSION_SET_CURRENT_DATA::deser(version, payload).map(Self::MISSION_SET_CURRENT)
            }
            MISSION_WRITE_PARTIAL_LIST_DATA::ID => {
                MISSION_WRITE_PARTIAL_LIST_DATA::deser(version, payload).map(Self::MISSION_WRITE_PARTIAL_LIST)
            }
            NAMED_VALUE_FLOAT_DATA::ID => NAMED_VALUE_FLOAT_DATA::deser(version, payload).map(Self::NAMED_VALUE_FLOAT),
            NAMED_VALUE_INT_DATA::ID => NAMED_VALUE_INT_DATA::deser(version, payload).map(Self::NAMED_VALUE_INT),
            ODOMETRY_DATA::ID => ODOMETRY_DATA::deser(version, payload).map(Self::ODOMETRY),
            ORBIT_EXECUTION_STATUS_DATA::ID => {
                ORBIT_EXECUTION_STATUS_DATA::deser(version, payload).map(Self::ORBIT_EXECUTION_STATUS)
            }
            PARAM_ERROR_DATA::ID => PARAM_ERROR_DATA::deser(version, payload).map(Self::PARAM_ERROR),
            PARAM_EXT_ACK_DATA::ID => PARAM_EXT_ACK_DATA::deser(version, payload).map(Self::PARAM_EXT_ACK),
            PARAM_EXT_REQUEST_LIST_DATA::ID => {
                PARAM_EXT_REQUEST_LIST_DATA::deser(version, payload).map(Self::PARAM_EXT_REQUEST_LIST)
            }
            PARAM_EXT_REQUEST_READ_DATA::ID => {
                PARAM_EXT_REQUEST_READ_DATA::deser(version, payload).map(Self::PARAM_EXT_REQUEST_READ)
            }
            PARAM_EXT_SET_DATA::ID => PARAM_EXT_SET_DATA::deser(version, payload).map(Self::PARAM_EXT_SET),
            PARAM_EXT_VALUE_DATA::ID => PARAM_EXT_VALUE_DATA::deser(version, payload).map(Self::PARAM_EXT_VALUE),
            PARAM_REQUEST_LIST_DATA::ID => {
                PARAM_REQUEST_LIST_DATA::deser(version, payload).map(Self::PARAM_REQUEST_LIST)
            }
            PARAM_REQUEST_READ_DATA::ID => {
                PARAM_REQUEST_READ_DATA::deser(version, payload).map(Self::PARAM_REQUEST_READ)
            }
            PARAM_SET_DATA::ID => PARAM_SET_DATA::deser(version, payload).map(Self::PARAM_SET),
            PARAM_VALUE_DATA::ID => PARAM_VALUE_DATA::deser(version, payload).map(Self::PARAM_VALUE),
            PING_DATA::ID => PING_DATA::deser(version, payload).map(Self::PING),
            POSITION_TARGET_LOCAL_NED_DATA::ID => {
                POSITION_TARGET_LOCAL_NED_DATA::deser(version, payload).map(Self::POSITION_TARGET_LOCAL_NED)
            }
            PROTOCOL_VERSION_DATA::ID => PROTOCOL_VERSION_DATA::deser(version, payload).map(Self::PROTOCOL_VERSION),
            RC_CHANNELS_DATA::ID => RC_CHANNELS_DATA::deser(version, payload).map(Self::RC_CHANNELS),
            RC_CHANNELS_OVERRIDE_DATA::ID => {
                RC_CHANNELS_OVERRIDE_DATA::deser(version, payload).map(Self::RC_CHANNELS_OVERRIDE)
            }
            REQUEST_DATA_STREAM_DATA::ID => {
                REQUEST_DATA_STREAM_DATA::deser(version, payload).map(Self::REQUEST_DATA_STREAM)
            }
            SCALED_IMU_DATA::ID => SCALED_IMU_DATA::deser(version, payload).map(Self::SCALED_IMU),
            SCALED_PRESSURE_DATA::ID => SCALED_PRESSURE_DATA::deser(version, payload).map(Self::SCALED_PRESSURE),
            SERIAL_CONTROL_DATA::ID => SERIAL_CONTROL_DATA::deser(version, payload).map(Self::SERIAL_CONTROL),
            SERVO_OUTPUT_RAW_DATA::ID => SERVO_OUTPUT_RAW_DATA::deser(version, payload).map(Self::SERVO_OUTPUT_RAW),
            SET_ATTITUDE_TARGET_DATA::ID => {
                SET_ATTITUDE_TARGET_DATA::deser(version, payload).map(Self::SET_ATTITUDE_TARGET)
            }
            SET_GPS_GLOBAL_ORIGIN_DATA::ID => {
                SET_GPS_GLOBAL_ORIGIN_DATA::deser(version, payload).map(Self::SET_GPS_GLOBAL_ORIGIN)
            }
            SET_MODE_DATA::ID => SET_MODE_DATA::deser(version, payload).map(Self::SET_MODE),
            SET_POSITION_TARGET_GLOBAL_INT_DATA::ID => {
                SET_POSITION_TARGET_GLOBAL_INT_DATA::deser(version, payload).map(Self::SET_POSITION_TARGET_GLOBAL_INT)
            }
            SET_POSITION_TARGET_LOCAL_NED_DATA::ID => {
                SET_POSITION_TARGET_LOCAL_NED_DATA::deser(version, payload).map(Self::SET_POSITION_TARGET_LOCAL_NED)
            }
            SIM_STATE_DATA::ID => SIM_STATE_DATA::deser(version, payload).map(Self::SIM_STATE),
            STATUSTEXT_DATA::ID => STATUSTEXT_DATA::deser(version, payload).map(Self::STATUSTEXT),
            SYSTEM_TIME_DATA::ID => SYSTEM_TIME_DATA::deser(version, payload).map(Self::SYSTEM_TIME),
            SYS_STATUS_DATA::ID => SYS_STATUS_DATA::deser(version, payload).map(Self::SYS_STATUS),
            TIMESYNC_DATA::ID => TIMESYNC_DATA::deser(version, payload).map(Self::TIMESYNC),
            VFR_HUD_DATA::ID => VFR_HUD_DATA::deser(version, payload).map(Self::VFR_HUD),
            VIBRATION_DATA::ID => VIBRATION_DATA::deser(version, payload).map(Self::VIBRATION),
            WIND_COV_DATA::ID => WIND_COV_DATA::deser(version, payload).map(Self::WIND_COV),
            _ => Err(::mavlink_core::error::ParserError::UnknownMessage { id }),
        }
    }
    fn message_name(&self) -> &'static str {
        match self {
            Self::ALTITUDE(..) => ALTITUDE_DATA::NAME,
            Self::ATTITUDE(..) => ATTITUDE_DATA::NAME,
            Self::ATTITUDE_QUATERNION(..) => ATTITUDE_QUATERNION_DATA::NAME,
            Self::ATTITUDE_TARGET(..) => ATTITUDE_TARGET_DATA::NAME,
            Self::AUTOPILOT_VERSION(..) => AUTOPILOT_VERSION_DATA::NAME,
            Self::AVAILABLE_MODES(..) => AVAILABLE_MODES_DATA::NAME,
            Self::AVAILABLE_MODES_MONITOR(..) => AVAILABLE_MODES_MONITOR_DATA::NAME,
            Self::BATTERY_STATUS(..) => BATTERY_STATUS_DATA::NAME,
            Self::COMMAND_ACK(..) => COMMAND_ACK_DATA::NAME,
            Self::COMMAND_INT(..) => COMMAND_INT_DATA::NAME,
            Self::COMMAND_LONG(..) => COMMAND_LONG_DATA::NAME,
            Self::CURRENT_MODE(..) => CURRENT_MODE_DATA::NAME,
            Self::DEBUG_FLOAT_ARRAY(..) => DEBUG_FLOAT_ARRAY_DATA::NAME,
            Self::ESC_STATUS(..) => ESC_STATUS_DATA::NAME,
            Self::ESTIMATOR_STATUS(..) => ESTIMATOR_STATUS_DATA::NAME,
            Self::EXTENDED_SYS_STATE(..) => EXTENDED_SYS_STATE_DATA::NAME,
            Self::FILE_TRANSFER_PROTOCOL(..) => FILE_TRANSFER_PROTOCOL_DATA::NAME,
            Self::GLOBAL_POSITION_INT(..) => GLOBAL_POSITION_INT_DATA::NAME,
            Self::GPS_GLOBAL_ORIGIN(..) => GPS_GLOBAL_ORIGIN_DATA::NAME,
            Self::GPS_RAW_INT(..) => GPS_RAW_INT_DATA::NAME,
            Self::HEARTBEAT(..) => HEARTBEAT_DATA::NAME,
            Self::HIGHRES_IMU(..) => HIGHRES_IMU_DATA::NAME,
            Self::HIL_STATE_QUATERNION(..) => HIL_STATE_QUATERNION_DATA::NAME,
            Self::HOME_POSITION(..) => HOME_POSITION_DATA::NAME,
            Self::LOCAL_POSITION_NED(..) => LOCAL_POSITION_NED_DATA::NAME,
            Self::LOG_ENTRY(..) => LOG_ENTRY_DATA::NAME,
            Self::LOG_ERASE(..) => LOG_ERASE_DATA::NAME,
            Self::LOG_REQUEST_DATA(..) => LOG_REQUEST_DATA_DATA::NAME,
            Self::LOG_REQUEST_END(..) => LOG_REQUEST_END_DATA::NAME,
            Self::LOG_REQUEST_LIST(..) => LOG_REQUEST_LIST_DATA::NAME,
            Self::MANUAL_CONTROL(..) => MANUAL_CONTROL_DATA::NAME,
            Self::MESSAGE_INTERVAL(..) => MESSAGE_INTERVAL_DATA::NAME,
            Self::MISSION_ACK(..) => MISSION_ACK_DATA::NAME,
            Self::MISSION_CLEAR_ALL(..) => MISSION_CLEAR_ALL_DATA::NAME,
            Self::MISSION_COUNT(..) => MISSION_COUNT_DATA::NAME,
            Self::MISSION_CURRENT(..) => MISSION_CURRENT_DATA::NAME,
            Self::MISSION_ITEM(..) => MISSION_ITEM_DATA::NAME,
            Self::MISSION_ITEM_INT(..) => MISSION_ITEM_INT_DATA::NAME,
            Self::MISSION_REQUEST(..) => MISSION_REQUEST_DATA::NAME,
            Self::MISSION_REQUEST_INT(..) => MISSION_REQUEST_INT_DATA::NAME,
            Self::MISSION_REQUEST_LIST(..) => MISSION_REQUEST_LIST_DATA::NAME,
            Self::MISSION_REQUEST_PARTIAL_LIST(..) => MISSION_REQUEST_PARTIAL_LIST_DATA::NAME,
            Self::MISSION_SET_CURRENT(..) => MISSION_SET_CURRENT_DATA::NAME,
            Self::MISSION_WRITE_PARTIAL_LIST(..) => MISSION_WRITE_PARTIAL_LIST_DATA::NAME,
            Self::NAMED_VALUE_FLOAT(..) => NAMED_VALUE_FLOAT_DATA::NAME,
            Self::NAMED_VALUE_INT(..) => NAMED_VALUE_INT_DATA::NAME,
            Self::ODOMETRY(..) => ODOMETRY_DATA::NAME,
            Self::ORBIT_EXECUTION_STATUS(..) => ORBIT_EXECUTION_STATUS_DATA::NAME,
            Self::PARAM_ERROR(..) => PARAM_ERROR_DATA::NAME,
            Self::PARAM_EXT_ACK(..) => PARAM_EXT_ACK_DATA::NAME,
            Self::PARAM_EXT_REQUEST_LIST(..) => PARAM_EXT_REQUEST_LIST_DATA::NAME,
            Self::PARAM_EXT_REQUEST_READ(..) => PARAM_EXT_REQUEST_READ_DATA::NAME,
            Self::PARAM_EXT_SET(..) => PARAM_EXT_SET_DATA::NAME,
            Self::PARAM_EXT_VALUE(..) => PARAM_EXT_VALUE_DATA::NAME,
            Self::PARAM_REQUEST_LIST(..) => PARAM_REQUEST_LIST_DATA::NAME,
            Self::PARAM_REQUEST_READ(..) => PARAM_REQUEST_READ_DATA::NAME,
            Self::PARAM_SET(..) => PARAM_SET_DATA::NAME,
            Self::PARAM_VALUE(..) => PARAM_VALUE_DATA::NAME,
            Self::PING(..) => PING_DATA::NAME,
            Self::POSITION_TARGET_LOCAL_NED(..) => POSITION_TARGET_LOCAL_NED_DATA::NAME,
            Self::PROTOCOL_VERSION(..) => PROTOCOL_VERSION_DATA::NAME,
            Self::RC_CHANNELS(..) => RC_CHANNELS_DATA::NAME,
            Self::RC_CHANNELS_OVERRIDE(..) => RC_CHANNELS_OVERRIDE_DATA::NAME,
            Self::REQUEST_DATA_STREAM(..) => REQUEST_DATA_STREAM_DATA::NAME,
            Self::SCALED_IMU(..) => SCALED_IMU_DATA::NAME,
            Self::SCALED_PRESSURE(..) => SCALED_PRESSURE_DATA::NAME,
            Self::SERIAL_CONTROL(..) => SERIAL_CONTROL_DATA::NAME,
            Self::SERVO_OUTPUT_RAW(..) => SERVO_OUTPUT_RAW_DATA::NAME,
            Self::SET_ATTITUDE_TARGET(..) => SET_ATTITUDE_TARGET_DATA::NAME,
            Self::SET_GPS_GLOBAL_ORIGIN(..) => SET_GPS_GLOBAL_ORIGIN_DATA::NAME,
            Self::SET_MODE(..) => SET_MODE_DATA::NAME,
            Self::SET_POSITION_TARGET_GLOBAL_INT(..) => SET_POSITION_TARGET_GLOBAL_INT_DATA::NAME,
            Self::SET_POSITION_TARGET_LOCAL_NED(..) => SET_POSITION_TARGET_LOCAL_NED_DATA::NAME,
            Self::SIM_STATE(..) => SIM_STATE_DATA::NAME,
            Self::STATUSTEXT(..) => STATUSTEXT_DATA::NAME,
            Self::SYSTEM_TIME(..) => SYSTEM_TIME_DATA::NAME,
            Self::SYS_STATUS(..) => SYS_STATUS_DATA::NAME,
            Self::TIMESYNC(..) => TIMESYNC_DATA::NAME,
            Self::VFR_HUD(..) => VFR_HUD_DATA::NAME,
            Self::VIBRATION(..) => VIBRATION_DATA::NAME,
            Self::WIND_COV(..) => WIND_COV_DATA::NAME,
        }
    }
    fn message_id(&self) -> u32 {
        match self {
            Self::ALTITUDE(..) => ALTITUDE_DATA::ID,
            Self::ATTITUDE(..) => ATTITUDE_DATA::ID,
            Self::ATTITUDE_QUATERNION(..) => ATTITUDE_QUATERNION_DATA::ID,
            Self::ATTITUDE_TARGET(..) => ATTITUDE_TARGET_DATA::ID,
            Self::AUTOPILOT_VERSION(..) => AUTOPILOT_VERSION_DATA::ID,
            Self::AVAILABLE_MODES(..) => AVAILABLE_MODES_DATA::ID,
            Self::AVAILABLE_MODES_MONITOR(..) => AVAILABLE_MODES_MONITOR_DATA::ID,
            Self::BATTERY_STATUS(..) => BATTERY_STATUS_DATA::ID,
            Self::COMMAND_ACK(..) => COMMAND_ACK_DATA::ID,
            Self::COMMAND_INT(..) => COMMAND_INT_DATA::ID,
            Self::COMMAND_LONG(..) => COMMAND_LONG_DATA::ID,
            Self::CURRENT_MODE(..) => CURRENT_MODE_DATA::ID,
            Self::DEBUG_FLOAT_ARRAY(..) => DEBUG_FLOAT_ARRAY_DATA::ID,
            Self::ESC_STATUS(..) => ESC_STATUS_DATA::ID,
            Self::ESTIMATOR_STATUS(..) => ESTIMATOR_STATUS_DATA::ID,
            Self::EXTENDED_SYS_STATE(..) => EXTENDED_SYS_STATE_DATA::ID,
            Self::FILE_TRANSFER_PROTOCOL(..) => FILE_TRANSFER_PROTOCOL_DATA::ID,
            Self::GLOBAL_POSITION_INT(..) => GLOBAL_POSITION_INT_DATA::ID,
            Self::GPS_GLOBAL_ORIGIN(..) => GPS_GLOBAL_ORIGIN_DATA::ID,
            Self::GPS_RAW_INT(..) => GPS_RAW_INT_DATA::ID,
            Self::HEARTBEAT(..) => HEARTBEAT_DATA::ID,
            Self::HIGHRES_IMU(..) => HIGHRES_IMU_DATA::ID,
            Self::HIL_STATE_QUATERNION(..) => HIL_STATE_QUATERNION_DATA::ID,
            Self::HOME_POSITION(..) => HOME_POSITION_DATA::ID,
            Self::LOCAL_POSITION_NED(..) => LOCAL_POSITION_NED_DATA::ID,
            Self::LOG_ENTRY(..) => LOG_ENTRY_DATA::ID,
            Self::LOG_ERASE(..) => LOG_ERASE_DATA::ID,
            Self::LOG_REQUEST_DATA(..) => LOG_REQUEST_DATA_DATA::ID,
            Self::LOG_REQUEST_END(..) => LOG_REQUEST_END_DATA::ID,
            Self::LOG_REQUEST_LIST(..) => LOG_REQUEST_LIST_DATA::ID,
            Self::MANUAL_CONTROL(..) => MANUAL_CONTROL_DATA::ID,
            Self::MESSAGE_INTERVAL(..) => MESSAGE_INTERVAL_DATA::ID,
            Self::MISSION_ACK(..) => MISSION_ACK_DATA::ID,
            Self::MISSION_CLEAR_ALL(..) => MISSION_CLEAR_ALL_DATA::ID,
            Self::MISSION_COUNT(..) => MISSION_COUNT_DATA::ID,
            Self::MISSION_CURRENT(..) => MISSION_CURRENT_DATA::ID,
            Self::MISSION_ITEM(..) => MISSION_ITEM_DATA::ID,
            Self::MISSION_ITEM_INT(..) => MISSION_ITEM_INT_DATA::ID,
            Self::MISSION_REQUEST(..) => MISSION_REQUEST_DATA::ID,
            Self::MISSION_REQUEST_INT(..) => MISSION_REQUEST_INT_DATA::ID,
            Self::MISSION_REQUEST_LIST(..) => MISSION_REQUEST_LIST_DATA::ID,
            Self::MISSION_REQUEST_PARTIAL_LIST(..) => MISSION_REQUEST_PARTIAL_LIST_DATA::ID,
            Self::MISSION_SET_CURRENT(..) => MISSION_SET_CURRENT_DATA::ID,
            Self::MISSION_WRITE_PARTIAL_LIST(..) => MISSION_WRITE_PARTIAL_LIST_DATA::ID,
            Self::NAMED_VALUE_FLOAT(..) => NAMED_VALUE_FLOAT_DATA::ID,
            Self::NAMED_VALUE_INT(..) => NAMED_VALUE_INT_DATA::ID,
            Self::ODOMETRY(..) => ODOMETRY_DATA::ID,
            Self::ORBIT_EXECUTION_STATUS(..) => ORBIT_EXECUTION_STATUS_DATA::ID,
            Self::PARAM_ERROR(..) => PARAM_ERROR_DATA::ID,
            Self::PARAM_EXT_ACK(..) => PARAM_EXT_ACK_DATA::ID,
            Self::PARAM_EXT_REQUEST_LIST(..) => PARAM_EXT_REQUEST_LIST_DATA::ID,
            Self::PARAM_EXT_REQUEST_READ(..) => PARAM_EXT_REQUEST_READ_DATA::ID,
            Self::PARAM_EXT_SET(..) => PARAM_EXT_SET_DATA::ID,
            Self::PARAM_EXT_VALUE(..) => PARAM_EXT_VALUE_DATA::ID,
            Self::PARAM_REQUEST_LIST(..) => PARAM_REQUEST_LIST_DATA::ID,
            Self::PARAM_REQUEST_READ(..) => PARAM_REQUEST_READ_DATA::ID,
            Self::PARAM_SET(..) => PARAM_SET_DATA::ID,
            Self::PARAM_VALUE(..) => PARAM_VALUE_DATA::ID,
            Self::PING(..) => PING_DATA::ID,
            Self::POSITION_TARGET_LOCAL_NED(..) => POSITION_TARGET_LOCAL_NED_DATA::ID,
            Self::PROTOCOL_VERSION(..) => PROTOCOL_VERSION_DATA::ID,
            Self::RC_CHANNELS(..) => RC_CHANNELS_DATA::ID,
            Self::RC_CHANNELS_OVERRIDE(..) => RC_CHANNELS_OVERRIDE_DATA::ID,
            Self::REQUEST_DATA_STREAM(..) => REQUEST_DATA_STREAM_DATA::ID,
            Self::SCALED_IMU(..) => SCALED_IMU_DATA::ID,
            Self::SCALED_PRESSURE(..) => SCALED_PRESSURE_DATA::ID,
            Self::SERIAL_CONTROL(..) => SERIAL_CONTROL_DATA::ID,
            Self::SERVO_OUTPUT_RAW(..) => SERVO_OUTPUT_RAW_DATA::ID,
            Self::SET_ATTITUDE_TARGET(..) => SET_ATTITUDE_TARGET_DATA::ID,
            Self::SET_GPS_GLOBAL_ORIGIN(..) => SET_GPS_GLOBAL_ORIGIN_DATA::ID,
            Self::SET_MODE(..) => SET_MODE_DATA::ID,
            Self::SET_POSITION_TARGET_GLOBAL_INT(..) => SET_POSITION_TARGET_GLOBAL_INT_DATA::ID,
            Self::SET_POSITION_TARGET_LOCAL_NED(..) => SET_POSITION_TARGET_LOCAL_NED_DATA::ID,
            Self::SIM_STATE(..) => SIM_STATE_DATA::ID,
            Self::STATUSTEXT(..) => STATUSTEXT_DATA::ID,
            Self::SYSTEM_TIME(..) => SYSTEM_TIME_DATA::ID,
            Self::SYS_STATUS(..) => SYS_STATUS_DATA::ID,
            Self::TIMESYNC(..) => TIMESYNC_DATA::ID,
            Self::VFR_HUD(..) => VFR_HUD_DATA::ID,
            Self::VIBRATION(..) => VIBRATION_DATA::ID,
            Self::WIND_COV(..) => WIND_COV_DATA::ID,
        }
    }
    fn message_id_from_name(name: &str) -> Option<u32> {
        match name {
            ALTITUDE_DATA::NAME => Some(ALTITUDE_DATA::ID),
            ATTITUDE_DATA::NAME => Some(ATTITUDE_DATA::ID),
            ATTITUDE_QUATERNION_DATA::NAME => Some(ATTITUDE_QUATERNION_DATA::ID),
            ATTITUDE_TARGET_DATA::NAME => Some(ATTITUDE_TARGET_DATA::ID),
            AUTOPILOT_VERSION_DATA::NAME => Some(AUTOPILOT_VERSION_DATA::ID),
            AVAILABLE_MODES_DATA::NAME => Some(AVAILABLE_MODES_DATA::ID),
            AVAILABLE_MODES_MONITOR_DATA::NAME => Some(AVAILABLE_MODES_MONITOR_DATA::ID),
            BATTERY_STATUS_DATA::NAME => Some(BATTERY_STATUS_DATA::ID),
            COMMAND_ACK_DATA::NAME => Some(COMMAND_ACK_DATA::ID),
            COMMAND_INT_DATA::NAME => Some(COMMAND_INT_DATA::ID),
            COMMAND_LONG_DATA::NAME => Some(COMMAND_LONG_DATA::ID),
            CURRENT_MODE_DATA::NAME => Some(CURRENT_MODE_DATA::ID),
            DEBUG_FLOAT_ARRAY_DATA::NAME => Some(DEBUG_FLOAT_ARRAY_DATA::ID),
            ESC_STATUS_DATA::NAME => Some(ESC_STATUS_DATA::ID),
            ESTIMATOR_STATUS_DATA::NAME => Some(ESTIMATOR_STATUS_DATA::ID),
            EXTENDED_SYS_STATE_DATA::NAME => Some(EXTENDED_SYS_STATE_DATA::ID),
            FILE_TRANSFER_PROTOCOL_DATA::NAME => Some(FILE_TRANSFER_PROTOCOL_DATA::ID),
            GLOBAL_POSITION_INT_DATA::NAME => Some(GLOBAL_POSITION_INT_DATA::ID),
            GPS_GLOBAL_ORIGIN_DATA::NAME => Some(GPS_GLOBAL_ORIGIN_DATA::ID),
            GPS_RAW_INT_DATA::NAME => Some(GPS_RAW_INT_DATA::ID),
            HEARTBEAT_DATA::NAME => Some(HEARTBEAT_DATA::ID),
            HIGHRES_IMU_DATA::NAME => Some(HIGHRES_IMU_DATA::ID),
            HIL_STATE_QUATERNION_DATA::NAME => Some(HIL_STATE_QUATERNION_DATA::ID),
            HOME_POSITION_DATA::NAME => Some(HOME_POSITION_DATA::ID),
            LOCAL_POSITION_NED_DATA::NAME => Some(LOCAL_POSITION_NED_DATA::ID),
            LOG_ENTRY_DATA::NAME => Some(LOG_ENTRY_DATA::ID),
            LOG_ERASE_DATA::NAME => Some(LOG_ERASE_DATA::ID),
            LOG_REQUEST_DATA_DATA::NAME => Some(LOG_REQUEST_DATA_DATA::ID),
            LOG_REQUEST_END_DATA::NAME => Some(LOG_REQUEST_END_DATA::ID),
            LOG_REQUEST_LIST_DATA::NAME => Some(LOG_REQUEST_LIST_DATA::ID),
            MANUAL_CONTROL_DATA::NAME => Some(MANUAL_CONTROL_DATA::ID),
            MESSAGE_INTERVAL_DATA::NAME => Some(MESSAGE_INTERVAL_DATA::ID),
            MISSION_ACK_DATA::NAME => Some(MISSION_ACK_DATA::ID),
            MISSION_CLEAR_ALL_DATA::NAME => Some(MISSION_CLEAR_ALL_DATA::ID),
            MISSION_COUNT_DATA::NAME => Some(MISSION_COUNT_DATA::ID),
            MISSION_CURRENT_DATA::NAME => Some(MISSION_CURRENT_DATA::ID),
            MISSION_ITEM_DATA::NAME => Some(MISSION_ITEM_DATA::ID),
            MISSION_ITEM_INT_DATA::NAME => Some(MISSION_ITEM_INT_DATA::ID),
            MISSION_REQUEST_DATA::NAME => Some(MISSION_REQUEST_DATA::ID),
            MISSION_REQUEST_INT_DATA::NAME => Some(MISSION_REQUEST_INT_DATA::ID),
            MISSION_REQUEST_LIST_DATA::NAME => Some(MISSION_REQUEST_LIST_DATA::ID),
            MISSION_REQUEST_PARTIAL_LIST_DATA::NAME => Some(MISSION_REQUEST_PARTIAL_LIST_DATA::ID),
            MISSION_SET_CURRENT_DATA::NAME => Some(MISSION_SET_CURRENT_DATA::ID),
            MISSION_WRITE_PARTIAL_LIST_DATA::NAME => Some(MISSION_WRITE_PARTIAL_LIST_DATA::ID),
            NAMED_VALUE_FLOAT_DATA::NAME => Some(NAMED_VALUE_FLOAT_DATA::ID),
            NAMED_VALUE_INT_DATA::NAME => Some(NAMED_VALUE_INT_DATA::ID),
            ODOMETRY_DATA::NAME => Some(ODOMETRY_DATA::ID),
            ORBIT_EXECUTION_STATUS_DATA::NAME => Some(ORBIT_EXECUTION_STATUS_DATA::ID),
            PARAM_ERROR_DATA::NAME => Some(PARAM_ERROR_DATA::ID),
            PARAM_EXT_ACK_DATA::NAME => Some(PARAM_EXT_ACK_DATA::ID),
            PARAM_EXT_REQUEST_LIST_DATA::NAME => Some(PARAM_EXT_REQUEST_LIST_DATA::ID),
            PARAM_EXT_REQUEST_READ_DATA::NAME => Some(PARAM_EXT_REQUEST_READ_DATA::ID),
            PARAM_EXT_SET_DATA::NAME => Some(PARAM_EXT_SET_DATA::ID),
            PARAM_EXT_VALUE_DATA::NAME => Some(PARAM_EXT_VALUE_DATA::ID),
            PARAM_REQUEST_LIST_DATA::NAME => Some(PARAM_REQUEST_LIST_DATA::ID),
            PARAM_REQUEST_READ_DATA::NAME => Some(PARAM_REQUEST_READ_DATA::ID),
            PARAM_SET_DATA::NAME => Some(PARAM_SET_DATA::ID),
            PARAM_VALUE_DATA::NAME => Some(PARAM_VALUE_DATA::ID),
            PING_DATA::NAME => Some(PING_DATA::ID),
            POSITION_TARGET_LOCAL_NED_DATA::NAME => Some(POSITION_TARGET_LOCAL_NED_DATA::ID),
            PROTOCOL_VERSION_DATA::NAME => Some(PROTOCOL_VERSION_DATA::ID),
            RC_CHANNELS_DATA::NAME => Some(RC_CHANNELS_DATA::ID),
            RC_CHANNELS_OVERRIDE_DATA::NAME => Some(RC_CHANNELS_OVERRIDE_DATA::ID),
            REQUEST_DATA_STREAM_DATA::NAME => Some(REQUEST_DATA_STREAM_DATA::ID),
            SCALED_IMU_DATA::NAME => Some(SCALED_IMU_DATA::ID),
            SCALED_PRESSURE_DATA::NAME => Some(SCALED_PRESSURE_DATA::ID),
            SERIAL_CONTROL_DATA::NAME => Some(SERIAL_CONTROL_DATA::ID),
            SERVO_OUTPUT_RAW_DATA::NAME => Some(SERVO_OUTPUT_RAW_DATA::ID),
            SET_ATTITUDE_TARGET_DATA::NAME => Some(SET_ATTITUDE_TARGET_DATA::ID),
            SET_GPS_GLOBAL_ORIGIN_DATA::NAME => Some(SET_GPS_GLOBAL_ORIGIN_DATA::ID),
            SET_MODE_DATA::NAME => Some(SET_MODE_DATA::ID),
            SET_POSITION_TARGET_GLOBAL_INT_DATA::NAME => Some(SET_POSITION_TARGET_GLOBAL_INT_DATA::ID),
            SET_POSITION_TARGET_LOCAL_NED_DATA::NAME => Some(SET_POSITION_TARGET_LOCAL_NED_DATA::ID),
            SIM_STATE_DATA::NAME => Some(SIM_STATE_DATA::ID),
            STATUSTEXT_DATA::NAME => Some(STATUSTEXT_DATA::ID),
            SYSTEM_TIME_DATA::NAME => Some(SYSTEM_TIME_DATA::ID),
            SYS_STATUS_DATA::NAME => Some(SYS_STATUS_DATA::ID),
            TIMESYNC_DATA::NAME => Some(TIMESYNC_DATA::ID),
            VFR_HUD_DATA::NAME => Some(VFR_HUD_DATA::ID),
            VIBRATION_DATA::NAME => Some(VIBRATION_DATA::ID),
            WIND_COV_DATA::NAME => Some(WIND_COV_DATA::ID),
            _ => None,
        }
    }
    fn default_message_from_id(id: u32) -> Option<Self> {
        match id {
            ALTITUDE_DATA::ID => Some(Self::ALTITUDE(ALTITUDE_DATA::default())),
            ATTITUDE_DATA::ID => Some(Self::ATTITUDE(ATTITUDE_DATA::default())),
            ATTITUDE_QUATERNION_DATA::ID => Some(Self::ATTITUDE_QUATERNION(ATTITUDE_QUATERNION_DATA::default())),
            ATTITUDE_TARGET_DATA::ID => Some(Self::ATTITUDE_TARGET(ATTITUDE_TARGET_DATA::default())),
            AUTOPILOT_VERSION_DATA::ID => Some(Self::AUTOPILOT_VERSION(AUTOPILOT_VERSION_DATA::default())),
            AVAILABLE_MODES_DATA::ID => Some(Self::AVAILABLE_MODES(AVAILABLE_MODES_DATA::default())),
            AVAILABLE_MODES_MONITOR_DATA::ID => {
                Some(Self::AVAILABLE_MODES_MONITOR(AVAILABLE_MODES_MONITOR_DATA::default()))
            }
            BATTERY_STATUS_DATA::ID => Some(Self::BATTERY_STATUS(BATTERY_STATUS_DATA::default())),
            COMMAND_ACK_DATA::ID => Some(Self::COMMAND_ACK(COMMAND_ACK_DATA::default())),
            COMMAND_INT_DATA::ID => Some(Self::COMMAND_INT(COMMAND_INT_DATA::default())),
            COMMAND_LONG_DATA::ID => Some(Self::COMMAND_LONG(COMMAND_LONG_DATA::default())),
            CURRENT_MODE_DATA::ID => Some(Self::CURRENT_MODE(CURRENT_MODE_DATA::default())),
            DEBUG_FLOAT_ARRAY_DATA::ID => Some(Self::DEBUG_FLOAT_ARRAY(DEBUG_FLOAT_ARRAY_DATA::default())),
            ESC_STATUS_DATA::ID => Some(Self::ESC_STATUS(ESC_STATUS_DATA::default())),
            ESTIMATOR_STATUS_DATA::ID => Some(Self::ESTIMATOR_STATUS(ESTIMATOR_STATUS_DATA::default())),
            EXTENDED_SYS_STATE_DATA::ID => Some(Self::EXTENDED_SYS_STATE(EXTENDED_SYS_STATE_DATA::default())),
            FILE_TRANSFER_PROTOCOL_DATA::ID => {
                Some(Self::FILE_TRANSFER_PROTOCOL(FILE_TRANSFER_PROTOCOL_DATA::default()))
            }
            GLOBAL_POSITION_INT_DATA::ID => Some(Self::GLOBAL_POSITION_INT(GLOBAL_POSITION_INT_DATA::default())),
            GPS_GLOBAL_ORIGIN_DATA::ID => Some(Self::GPS_GLOBAL_ORIGIN(GPS_GLOBAL_ORIGIN_DATA::default())),
            GPS_RAW_INT_DATA::ID => Some(Self::GPS_RAW_INT(GPS_RAW_INT_DATA::default())),
            HEARTBEAT_DATA::ID => Some(Self::HEARTBEAT(HEARTBEAT_DATA::default())),
            HIGHRES_IMU_DATA::ID => Some(Self::HIGHRES_IMU(HIGHRES_IMU_DATA::default())),
            HIL_STATE_QUATERNION_DATA::ID => Some(Self::HIL_STATE_QUATERNION(HIL_STATE_QUATERNION_DATA::default())),
            HOME_POSITION_DATA::ID => Some(Self::HOME_POSITION(HOME_POSITION_DATA::default())),
            LOCAL_POSITION_NED_DATA::ID => Some(Self::LOCAL_POSITION_NED(LOCAL_POSITION_NED_DATA::default())),
            LOG_ENTRY_DATA::ID => Some(Self::LOG_ENTRY(LOG_ENTRY_DATA::default())),
            LOG_ERASE_DATA::ID => Some(Self::LOG_ERASE(LOG_ERASE_DATA::default())),
            LOG_REQUEST_DATA_DATA::ID => Some(Self::LOG_REQUEST_DATA(LOG_REQUEST_DATA_DATA::default())),
            LOG_REQUEST_END_DATA::ID => Some(Self::LOG_REQUEST_END(LOG_REQUEST_END_DATA::default())),
            LOG_REQUEST_LIST_DATA::ID => Some(Self::LOG_REQUEST_LIST(LOG_REQUEST_LIST_DATA::default())),
            MANUAL_CONTROL_DATA::ID => Some(Self::MANUAL_CONTROL(MANUAL_CONTROL_DATA::default())),
            MESSAGE_INTERVAL_DATA::ID => Some(Self::MESSAGE_INTERVAL(MESSAGE_INTERVAL_DATA::default())),
            MISSION_ACK_DATA::ID => Some(Self::MISSION_ACK(MISSION_ACK_DATA::default())),
            MISSION_CLEAR_ALL_DATA::ID => Some(Self::MISSION_CLEAR_ALL(MISSION_CLEAR_ALL_DATA::default())),
            MISSION_COUNT_DATA::ID => Some(Self::MISSION_COUNT(MISSION_COUNT_DATA::default())),
            MISSION_CURRENT_DATA::ID => Some(Self::MISSION_CURRENT(MISSION_CURRENT_DATA::default())),
            MISSION_ITEM_DATA::ID => Some(Self::MISSION_ITEM(MISSION_ITEM_DATA::default())),
            MISSION_ITEM_INT_DATA::ID => Some(Self::MISSION_ITEM_INT(MISSION_ITEM_INT_DATA::default())),
            MISSION_REQUEST_DATA::ID => Some(Self::MISSION_REQUEST(MISSION_REQUEST_DATA::default())),
            MISSION_REQUEST_INT_DATA::ID => Some(Self::MISSION_REQUEST_INT(MISSION_REQUEST_INT_DATA::default())),
            MISSION_REQUEST_LIST_DATA::ID => Some(Self::MISSION_REQUEST_LIST(MISSION_REQUEST_LIST_DATA::default())),
            MISSION_REQUEST_PARTIAL_LIST_DATA::ID => {
                Some(Self::MISSION_REQUEST_PARTIAL_LIST(MISSION_REQUEST_PARTIAL_LIST_DATA::default()))
            }
            MISSION_SET_CURRENT_DATA::ID => Some(Self::MISSION_SET_CURRENT(MISSION_SET_CURRENT_DATA::default())),
            MISSION_WRITE_PARTIAL_LIST_DATA::ID => {
                Some(Self::MISSION_WRITE_PARTIAL_LIST(MISSION_WRITE_PARTIAL_LIST_DATA::default()))
            }
            NAMED_VALUE_FLOAT_DATA::ID => Some(Self::NAMED_VALUE_FLOAT(NAMED_VALUE_FLOAT_DATA::default())),
            NAMED_VALUE_INT_DATA::ID => Some(Self::NAMED_VALUE_INT(NAMED_VALUE_INT_DATA::default())),
            ODOMETRY_DATA::ID => Some(Self::ODOMETRY(ODOMETRY_DATA::default())),
            ORBIT_EXECUTION_STATUS_DATA::ID => {
                Some(Self::ORBIT_EXECUTION_STATUS(ORBIT_EXECUTION_STATUS_DATA::default()))
            }
            PARAM_ERROR_DATA::ID => Some(Self::PARAM_ERROR(PARAM_ERROR_DATA::default())),
            PARAM_EXT_ACK_DATA::ID => Some(Self::PARAM_EXT_ACK(PARAM_EXT_ACK_DATA::default())),
            PARAM_EXT_REQUEST_LIST_DATA::ID => {
                Some(Self::PARAM_EXT_REQUEST_LIST(PARAM_EXT_REQUEST_LIST_DATA::default()))
            }
            PARAM_EXT_REQUEST_READ_DATA::ID => {
                Some(Self::PARAM_EXT_REQUEST_READ(PARAM_EXT_REQUEST_READ_DATA::default()))
            }
            PARAM_EXT_SET_DATA::ID => Some(Self::PARAM_EXT_SET(PARAM_EXT_SET_DATA::default())),
            PARAM_EXT_VALUE_DATA::ID => Some(Self::PARAM_EXT_VALUE(PARAM_EXT_VALUE_DATA::default())),
            PARAM_REQUEST_LIST_DATA::ID => Some(Self::PARAM_REQUEST_LIST(PARAM_REQUEST_LIST_DATA::default())),
            PARAM_REQUEST_READ_DATA::ID => Some(Self::PARAM_REQUEST_READ(PARAM_REQUEST_READ_DATA::default())),
            PARAM_SET_DATA::ID => Some(Self::PARAM_SET(PARAM_SET_DATA::default())),
            PARAM_VALUE_DATA::ID => Some(Self::PARAM_VALUE(PARAM_VALUE_DATA::default())),
            PING_DATA::ID => Some(Self::PING(PING_DATA::default())),
            POSITION_TARGET_LOCAL_NED_DATA::ID => {
                Some(Self::POSITION_TARGET_LOCAL_NED(POSITION_TARGET_LOCAL_NED_DATA::default()))
            }
            PROTOCOL_VERSION_DATA::ID => Some(Self::PROTOCOL_VERSION(PROTOCOL_VERSION_DATA::default())),
            RC_CHANNELS_DATA::ID => Some(Self::RC_CHANNELS(RC_CHANNELS_DATA::default())),
            RC_CHANNELS_OVERRIDE_DATA::ID => Some(Self::RC_CHANNELS_OVERRIDE(RC_CHANNELS_OVERRIDE_DATA::default())),
            REQUEST_DATA_STREAM_DATA::ID => Some(Self::REQUEST_DATA_STREAM(REQUEST_DATA_STREAM_DATA::default())),
            SCALED_IMU_DATA::ID => Some(Self::SCALED_IMU(SCALED_IMU_DATA::default())),
            SCALED_PRESSURE_DATA::ID => Some(Self::SCALED_PRESSURE(SCALED_PRESSURE_DATA::default())),
            SERIAL_CONTROL_DATA::ID => Some(Self::SERIAL_CONTROL(SERIAL_CONTROL_DATA::default())),
            SERVO_OUTPUT_RAW_DATA::ID => Some(Self::SERVO_OUTPUT_RAW(SERVO_OUTPUT_RAW_DATA::default())),
            SET_ATTITUDE_TARGET_DATA::ID => Some(Self::SET_ATTITUDE_TARGET(SET_ATTITUDE_TARGET_DATA::default())),
            SET_GPS_GLOBAL_ORIGIN_DATA::ID => Some(Self::SET_GPS_GLOBAL_ORIGIN(SET_GPS_GLOBAL_ORIGIN_DATA::default())),
            SET_MODE_DATA::ID => Some(Self::SET_MODE(SET_MODE_DATA::default())),
            SET_POSITION_TARGET_GLOBAL_INT_DATA::ID => {
                Some(Self::SET_POSITION_TARGET_GLOBAL_INT(SET_POSITION_TARGET_GLOBAL_INT_DATA::default()))
            }
            SET_POSITION_TARGET_LOCAL_NED_DATA::ID => {
                Some(Self::SET_POSITION_TARGET_LOCAL_NED(SET_POSITION_TARGET_LOCAL_NED_DATA::default()))
            }
            SIM_STATE_DATA::ID => Some(Self::SIM_STATE(SIM_STATE_DATA::default())),
            STATUSTEXT_DATA::ID => Some(Self::STATUSTEXT(STATUSTEXT_DATA::default())),
            SYSTEM_TIME_DATA::ID => Some(Self::SYSTEM_TIME(SYSTEM_TIME_DATA::default())),
            SYS_STATUS_DATA::ID => Some(Self::SYS_STATUS(SYS_STATUS_DATA::default())),
            TIMESYNC_DATA::ID => Some(Self::TIMESYNC(TIMESYNC_DATA::default())),
            VFR_HUD_DATA::ID => Some(Self::VFR_HUD(VFR_HUD_DATA::default())),
            VIBRATION_DATA::ID => Some(Self::VIBRATION(VIBRATION_DATA::default())),
            WIND_COV_DATA::ID => Some(Self::WIND_COV(WIND_COV_DATA::default())),
            _ => None,
        }
    }
    #[cfg(feature = "arbitrary")]
    fn random_message_from_id<R: rand::Rng>(id: u32, rng: &mut R) -> Option<Self> {
        match id {
            ALTITUDE_DATA::ID => Some(Self::ALTITUDE(ALTITUDE_DATA::random(rng))),
            ATTITUDE_DATA::ID => Some(Self::ATTITUDE(ATTITUDE_DATA::random(rng))),
            ATTITUDE_QUATERNION_DATA::ID => Some(Self::ATTITUDE_QUATERNION(ATTITUDE_QUATERNION_DATA::random(rng))),
            ATTITUDE_TARGET_DATA::ID => Some(Self::ATTITUDE_TARGET(ATTITUDE_TARGET_DATA::random(rng))),
            AUTOPILOT_VERSION_DATA::ID => Some(Self::AUTOPILOT_VERSION(AUTOPILOT_VERSION_DATA::random(rng))),
            AVAILABLE_MODES_DATA::ID => Some(Self::AVAILABLE_MODES(AVAILABLE_MODES_DATA::random(rng))),
            AVAILABLE_MODES_MONITOR_DATA::ID => {
                Some(Self::AVAILABLE_MODES_MONITOR(AVAILABLE_MODES_MONITOR_DATA::random(rng)))
            }
            BATTERY_STATUS_DATA::ID => Some(Self::BATTERY_STATUS(BATTERY_STATUS_DATA::random(rng))),
            COMMAND_ACK_DATA::ID => Some(Self::COMMAND_ACK(COMMAND_ACK_DATA::random(rng))),
            COMMAND_INT_DATA::ID => Some(Self::COMMAND_INT(COMMAND_INT_DATA::random(rng))),
            COMMAND_LONG_DATA::ID => Some(Self::COMMAND_LONG(COMMAND_LONG_DATA::random(rng))),
            CURRENT_MODE_DATA::ID => Some(Self::CURRENT_MODE(CURRENT_MODE_DATA::random(rng))),
            DEBUG_FLOAT_ARRAY_DATA::ID => Some(Self::DEBUG_FLOAT_ARRAY(DEBUG_FLOAT_ARRAY_DATA::random(rng))),
            ESC_STATUS_DATA::ID => Some(Self::ESC_STATUS(ESC_STATUS_DATA::random(rng))),
            ESTIMATOR_STATUS_DATA::ID => Some(Self::ESTIMATOR_STATUS(ESTIMATOR_STATUS_DATA::random(rng))),
            EXTENDED_SYS_STATE_DATA::ID => Some(Self::EXTENDED_SYS_STATE(EXTENDED_SYS_STATE_DATA::random(rng))),
            FILE_TRANSFER_PROTOCOL_DATA::ID => {
                Some(Self::FILE_TRANSFER_PROTOCOL(FILE_TRANSFER_PROTOCOL_DATA::random(rng)))
            }
            GLOBAL_POSITION_INT_DATA::ID => Some(Self::GLOBAL_POSITION_INT(GLOBAL_POSITION_INT_DATA::random(rng))),
            GPS_GLOBAL_ORIGIN_DATA::ID => Some(Self::GPS_GLOBAL_ORIGIN(GPS_GLOBAL_ORIGIN_DATA::random(rng))),
            GPS_RAW_INT_DATA::ID => Some(Self::GPS_RAW_INT(GPS_RAW_INT_DATA::random(rng))),
            HEARTBEAT_DATA::ID => Some(Self::HEARTBEAT(HEARTBEAT_DATA::random(rng))),
            HIGHRES_IMU_DATA::ID => Some(Self::HIGHRES_IMU(HIGHRES_IMU_DATA::random(rng))),
            HIL_STATE_QUATERNION_DATA::ID => Some(Self::HIL_STATE_QUATERNION(HIL_STATE_QUATERNION_DATA::random(rng))),
            HOME_POSITION_DATA::ID => Some(Self::HOME_POSITION(HOME_POSITION_DATA::random(rng))),
            LOCAL_POSITION_NED_DATA::ID => Some(Self::LOCAL_POSITION_NED(LOCAL_POSITION_NED_DATA::random(rng))),
            LOG_ENTRY_DATA::ID => Some(Self::LOG_ENTRY(LOG_ENTRY_DATA::random(rng))),
            LOG_ERASE_DATA::ID => Some(Self::LOG_ERASE(LOG_ERASE_DATA::random(rng))),
            LOG_REQUEST_DATA_DATA::ID => Some(Self::LOG_REQUEST_DATA(LOG_REQUEST_DATA_DATA::random(rng))),
            LOG_REQUEST_END_DATA::ID => Some(Self::LOG_REQUEST_END(LOG_REQUEST_END_DATA::random(rng))),
            LOG_REQUEST_LIST_DATA::ID => Some(Self::LOG_REQUEST_LIST(LOG_REQUEST_LIST_DATA::random(rng))),
            MANUAL_CONTROL_DATA::ID => Some(Self::MANUAL_CONTROL(MANUAL_CONTROL_DATA::random(rng))),
            MESSAGE_INTERVAL_DATA::ID => Some(Self::MESSAGE_INTERVAL(MESSAGE_INTERVAL_DATA::random(rng))),
            MISSION_ACK_DATA::ID => Some(Self::MISSION_ACK(MISSION_ACK_DATA::random(rng))),
            MISSION_CLEAR_ALL_DATA::ID => Some(Self::MISSION_CLEAR_ALL(MISSION_CLEAR_ALL_DATA::random(rng))),
            MISSION_COUNT_DATA::ID => Some(Self::MISSION_COUNT(MISSION_COUNT_DATA::random(rng))),
            MISSION_CURRENT_DATA::ID => Some(Self::MISSION_CURRENT(MISSION_CURRENT_DATA::random(rng))),
            MISSION_ITEM_DATA::ID => Some(Self::MISSION_ITEM(MISSION_ITEM_DATA::random(rng))),
            MISSION_ITEM_INT_DATA::ID => Some(Self::MISSION_ITEM_INT(MISSION_ITEM_INT_DATA::random(rng))),
            MISSION_REQUEST_DATA::ID => Some(Self::MISSION_REQUEST(MISSION_REQUEST_DATA::random(rng))),
            MISSION_REQUEST_INT_DATA::ID => Some(Self::MISSION_REQUEST_INT(MISSION_REQUEST_INT_DATA::random(rng))),
            MISSION_REQUEST_LIST_DATA::ID => Some(Self::MISSION_REQUEST_LIST(MISSION_REQUEST_LIST_DATA::random(rng))),
            MISSION_REQUEST_PARTIAL_LIST_DATA::ID => {
                Some(Self::MISSION_REQUEST_PARTIAL_LIST(MISSION_REQUEST_PARTIAL_LIST_DATA::random(rng)))
            }
            MISSION_SET_CURRENT_DATA::ID => Some(Self::MISSION_SET_CURRENT(MISSION_SET_CURRENT_DATA::random(rng))),
            MISSION_WRITE_PARTIAL_LIST_DATA::ID => {
                Some(Self::MISSION_WRITE_PARTIAL_LIST(MISSION_WRITE_PARTIAL_LIST_DATA::random(rng)))
            }
            NAMED_VALUE_FLOAT_DATA::ID => Some(Self::NAMED_VALUE_FLOAT(NAMED_VALUE_FLOAT_DATA::random(rng))),
            NAMED_VALUE_INT_DATA::ID => Some(Self::NAMED_VALUE_INT(NAMED_VALUE_INT_DATA::random(rng))),
            ODOMETRY_DATA::ID => Some(Self::ODOMETRY(ODOMETRY_DATA::random(rng))),
            ORBIT_EXECUTION_STATUS_DATA::ID => {
                Some(Self::ORBIT_EXECUTION_STATUS(ORBIT_EXECUTION_STATUS_DATA::random(rng)))
            }
            PARAM_ERROR_DATA::ID => Some(Self::PARAM_ERROR(PARAM_ERROR_DATA::random(rng))),
            PARAM_EXT_ACK_DATA::ID => Some(Self::PARAM_EXT_ACK(PARAM_EXT_ACK_DATA::random(rng))),
            PARAM_EXT_REQUEST_LIST_DATA::ID => {
                Some(Self::PARAM_EXT_REQUEST_LIST(PARAM_EXT_REQUEST_LIST_DATA::random(rng)))
            }
            PARAM_EXT_REQUEST_READ_DATA::ID => {
                Some(Self::PARAM_EXT_REQUEST_READ(PARAM_EXT_REQUEST_READ_DATA::random(rng)))
            }
            PARAM_EXT_SET_DATA::ID => Some(Self::PARAM_EXT_SET(PARAM_EXT_SET_DATA::random(rng))),
            PARAM_EXT_VALUE_DATA::ID => Some(Self::PARAM_EXT_VALUE(PARAM_EXT_VALUE_DATA::random(rng))),
            PARAM_REQUEST_LIST_DATA::ID => Some(Self::PARAM_REQUEST_LIST(PARAM_REQUEST_LIST_DATA::random(rng))),
            PARAM_REQUEST_READ_DATA::ID => Some(Self::PARAM_REQUEST_READ(PARAM_REQUEST_READ_DATA::random(rng))),
            PARAM_SET_DATA::ID => Some(Self::PARAM_SET(PARAM_SET_DATA::random(rng))),
            PARAM_VALUE_DATA::ID => Some(Self::PARAM_VALUE(PARAM_VALUE_DATA::random(rng))),
            PING_DATA::ID => Some(Self::PING(PING_DATA::random(rng))),
            POSITION_TARGET_LOCAL_NED_DATA::ID => {
                Some(Self::POSITION_TARGET_LOCAL_NED(POSITION_TARGET_LOCAL_NED_DATA::random(rng)))
            }
            PROTOCOL_VERSION_DATA::ID => Some(Self::PROTOCOL_VERSION(PROTOCOL_VERSION_DATA::random(rng))),
            RC_CHANNELS_DATA::ID => Some(Self::RC_CHANNELS(RC_CHANNELS_DATA::random(rng))),
            RC_CHANNELS_OVERRIDE_DATA::ID => Some(Self::RC_CHANNELS_OVERRIDE(RC_CHANNELS_OVERRIDE_DATA::random(rng))),
            REQUEST_DATA_STREAM_DATA::ID => Some(Self::REQUEST_DATA_STREAM(REQUEST_DATA_STREAM_DATA::random(rng))),
            SCALED_IMU_DATA::ID => Some(Self::SCALED_IMU(SCALED_IMU_DATA::random(rng))),
            SCALED_PRESSURE_DATA::ID => Some(Self::SCALED_PRESSURE(SCALED_PRESSURE_DATA::random(rng))),
            SERIAL_CONTROL_DATA::ID => Some(Self::SERIAL_CONTROL(SERIAL_CONTROL_DATA::random(rng))),
            SERVO_OUTPUT_RAW_DATA::ID => Some(Self::SERVO_OUTPUT_RAW(SERVO_OUTPUT_RAW_DATA::random(rng))),
            SET_ATTITUDE_TARGET_DATA::ID => Some(Self::SET_ATTITUDE_TARGET(SET_ATTITUDE_TARGET_DATA::random(rng))),
            SET_GPS_GLOBAL_ORIGIN_DATA::ID => {
                Some(Self::SET_GPS_GLOBAL_ORIGIN(SET_GPS_GLOBAL_ORIGIN_DATA::random(rng)))
            }
            SET_MODE_DATA::ID => Some(Self::SET_MODE(SET_MODE_DATA::random(rng))),
            SET_POSITION_TARGET_GLOBAL_INT_DATA::ID => {
                Some(Self::SET_POSITION_TARGET_GLOBAL_INT(SET_POSITION_TARGET_GLOBAL_INT_DATA::random(rng)))
            }
            SET_POSITION_TARGET_LOCAL_NED_DATA::ID => {
                Some(Self::SET_POSITION_TARGET_LOCAL_NED(SET_POSITION_TARGET_LOCAL_NED_DATA::random(rng)))
            }
            SIM_STATE_DATA::ID => Some(Self::SIM_STATE(SIM_STATE_DATA::random(rng))),
            STATUSTEXT_DATA::ID => Some(Self::STATUSTEXT(STATUSTEXT_DATA::random(rng))),
            SYSTEM_TIME_DATA::ID => Some(Self::SYSTEM_TIME(SYSTEM_TIME_DATA::random(rng))),
            SYS_STATUS_DATA::ID => Some(Self::SYS_STATUS(SYS_STATUS_DATA::random(rng))),
            TIMESYNC_DATA::ID => Some(Self::TIMESYNC(TIMESYNC_DATA::random(rng))),
            VFR_HUD_DATA::ID => Some(Self::VFR_HUD(VFR_HUD_DATA::random(rng))),
            VIBRATION_DATA::ID => Some(Self::VIBRATION(VIBRATION_DATA::random(rng))),
            WIND_COV_DATA::ID => Some(Self::WIND_COV(WIND_COV_DATA::random(rng))),
            _ => None,
        }
    }
    fn ser(&self, version: MavlinkVersion, bytes: &mut [u8]) -> usize {
        match self {
            Self::ALTITUDE(body) => body.ser(version, bytes),
            Self::ATTITUDE(body) => body.ser(version, bytes),
            Self::ATTITUDE_QUATERNION(body) => body.ser(version, bytes),
            Self::ATTITUDE_TARGET(body) => body.ser(version, bytes),
            Self::AUTOPILOT_VERSION(body) => body.ser(version, bytes),
            Self::AVAILABLE_MODES(body) => body.ser(version, bytes),
            Self::AVAILABLE_MODES_MONITOR(body) => body.ser(version, bytes),
            Self::BATTERY_STATUS(body) => body.ser(version, bytes),
            Self::COMMAND_ACK(body) => body.ser(version, bytes),
            Self::COMMAND_INT(body) => body.ser(version, bytes),
            Self::COMMAND_LONG(body) => body.ser(version, bytes),
            Self::CURRENT_MODE(body) => body.ser(version, bytes),
            Self::DEBUG_FLOAT_ARRAY(body) => body.ser(version, bytes),
            Self::ESC_STATUS(body) => body.ser(version, bytes),
            Self::ESTIMATOR_STATUS(body) => body.ser(version, bytes),
            Self::EXTENDED_SYS_STATE(body) => body.ser(version, bytes),
            Self::FILE_TRANSFER_PROTOCOL(body) => body.ser(version, bytes),
            Self::GLOBAL_POSITION_INT(body) => body.ser(version, bytes),
            Self::GPS_GLOBAL_ORIGIN(body) => body.ser(version, bytes),
            Self::GPS_RAW_INT(body) => body.ser(version, bytes),
            Self::HEARTBEAT(body) => body.ser(version, bytes),
            Self::HIGHRES_IMU(body) => body.ser(version, bytes),
            Self::HIL_STATE_QUATERNION(body) => body.ser(version, bytes),
            Self::HOME_POSITION(body) => body.ser(version, bytes),
            Self::LOCAL_POSITION_NED(body) => body.ser(version, bytes),
            Self::LOG_ENTRY(body) => body.ser(version, bytes),
            Self::LOG_ERASE(body) => body.ser(version, bytes),
            Self::LOG_REQUEST_DATA(body) => body.ser(version, bytes),
            Self::LOG_REQUEST_END(body) => body.ser(version, bytes),
            Self::LOG_REQUEST_LIST(body) => body.ser(version, bytes),
            Self::MANUAL_CONTROL(body) => body.ser(version, bytes),
            Self::MESSAGE_INTERVAL(body) => body.ser(version, bytes),
            Self::MISSION_ACK(body) => body.ser(version, bytes),
            Self::MISSION_CLEAR_ALL(body) => body.ser(version, bytes),
            Self::MISSION_COUNT(body) => body.ser(version, bytes),
            Self::MISSION_CURRENT(body) => body.ser(version, bytes),
            Self::MISSION_ITEM(body) => body.ser(version, bytes),
            Self::MISSION_ITEM_INT(body) => body.ser(version, bytes),
            Self::MISSION_REQUEST(body) => body.ser(version, bytes),
            Self::MISSION_REQUEST_INT(body) => body.ser(version, bytes),
            Self::MISSION_REQUEST_LIST(body) => body.ser(version, bytes),
            Self::MISSION_REQUEST_PARTIAL_LIST(body) => body.ser(version, bytes),
            Self::MISSION_SET_CURRENT(body) => body.ser(version, bytes),
            Self::MISSION_WRITE_PARTIAL_LIST(body) => body.ser(version, bytes),
            Self::NAMED_VALUE_FLOAT(body) => body.ser(version, bytes),
            Self::NAMED_VALUE_INT(body) => body.ser(version, bytes),
            Self::ODOMETRY(body) => body.ser(version, bytes),
            Self::ORBIT_EXECUTION_STATUS(body) => body.ser(version, bytes),
            Self::PARAM_ERROR(body) => body.ser(version, bytes),
            Self::PARAM_EXT_ACK(body) => body.ser(version, bytes),
            Self::PARAM_EXT_REQUEST_LIST(body) => body.ser(version, bytes),
            Self::PARAM_EXT_REQUEST_READ(body) => body.ser(version, bytes),
            Self::PARAM_EXT_SET(body) => body.ser(version, bytes),
            Self::PARAM_EXT_VALUE(body) => body.ser(version, bytes),
            Self::PARAM_REQUEST_LIST(body) => body.ser(version, bytes),
            Self::PARAM_REQUEST_READ(body) => body.ser(version, bytes),
            Self::PARAM_SET(body) => body.ser(version, bytes),
            Self::PARAM_VALUE(body) => body.ser(version, bytes),
            Self::PING(body) => body.ser(version, bytes),
            Self::POSITION_TARGET_LOCAL_NED(body) => body.ser(version, bytes),
            Self::PROTOCOL_VERSION(body) => body.ser(version, bytes),
            Self::RC_CHANNELS(body) => body.ser(version, bytes),
            Self::RC_CHANNELS_OVERRIDE(body) => body.ser(version, bytes),
            Self::REQUEST_DATA_STREAM(body) => body.ser(version, bytes),
            Self::SCALED_IMU(body) => body.ser(version, bytes),
            Self::SCALED_PRESSURE(body) => body.ser(version, bytes),
            Self::SERIAL_CONTROL(body) => body.ser(version, bytes),
            Self::SERVO_OUTPUT_RAW(body) => body.ser(version, bytes),
            Self::SET_ATTITUDE_TARGET(body) => body.ser(version, bytes),
            Self::SET_GPS_GLOBAL_ORIGIN(body) => body.ser(version, bytes),
            Self::SET_MODE(body) => body.ser(version, bytes),
            Self::SET_POSITION_TARGET_GLOBAL_INT(body) => body.ser(version, bytes),
            Self::SET_POSITION_TARGET_LOCAL_NED(body) => body.ser(version, bytes),
            Self::SIM_STATE(body) => body.ser(version, bytes),
            Self::STATUSTEXT(body) => body.ser(version, bytes),
            Self::SYSTEM_TIME(body) => body.ser(version, bytes),
            Self::SYS_STATUS(body) => body.ser(version, bytes),
            Self::TIMESYNC(body) => body.ser(version, bytes),
            Self::VFR_HUD(body) => body.ser(version, bytes),
            Self::VIBRATION(body) => body.ser(version, bytes),
            Self::WIND_COV(body) => body.ser(version, bytes),
        }
    }
    fn extra_crc(id: u32) -> u8 {
        match id {
            ALTITUDE_DATA::ID => ALTITUDE_DATA::EXTRA_CRC,
            ATTITUDE_DATA::ID => ATTITUDE_DATA::EXTRA_CRC,
            ATTITUDE_QUATERNION_DATA::ID => ATTITUDE_QUATERNION_DATA::EXTRA_CRC,
            ATTITUDE_TARGET_DATA::ID => ATTITUDE_TARGET_DATA::EXTRA_CRC,
            AUTOPILOT_VERSION_DATA::ID => AUTOPILOT_VERSION_DATA::EXTRA_CRC,
            AVAILABLE_MODES_DATA::ID => AVAILABLE_MODES_DATA::EXTRA_CRC,
            AVAILABLE_MODES_MONITOR_DATA::ID => AVAILABLE_MODES_MONITOR_DATA::EXTRA_CRC,
            BATTERY_STATUS_DATA::ID => BATTERY_STATUS_DATA::EXTRA_CRC,
            COMMAND_ACK_DATA::ID => COMMAND_ACK_DATA::EXTRA_CRC,
            COMMAND_INT_DATA::ID => COMMAND_INT_DATA::EXTRA_CRC,
            COMMAND_LONG_DATA::ID => COMMAND_LONG_DATA::EXTRA_CRC,
            CURRENT_MODE_DATA::ID => CURRENT_MODE_DATA::EXTRA_CRC,
            DEBUG_FLOAT_ARRAY_DATA::ID => DEBUG_FLOAT_ARRAY_DATA::EXTRA_CRC,
            ESC_STATUS_DATA::ID => ESC_STATUS_DATA::EXTRA_CRC,
            ESTIMATOR_STATUS_DATA::ID => ESTIMATOR_STATUS_DATA::EXTRA_CRC,
            EXTENDED_SYS_STATE_DATA::ID => EXTENDED_SYS_STATE_DATA::EXTRA_CRC,
            FILE_TRANSFER_PROTOCOL_DATA::ID => FILE_TRANSFER_PROTOCOL_DATA::EXTRA_CRC,
            GLOBAL_POSITION_INT_DATA::ID => GLOBAL_POSITION_INT_DATA::EXTRA_CRC,
            GPS_GLOBAL_ORIGIN_DATA::ID => GPS_GLOBAL_ORIGIN_DATA::EXTRA_CRC,
            GPS_RAW_INT_DATA::ID => GPS_RAW_INT_DATA::EXTRA_CRC,
            HEARTBEAT_DATA::ID => HEARTBEAT_DATA::EXTRA_CRC,
            HIGHRES_IMU_DATA::ID => HIGHRES_IMU_DATA::EXTRA_CRC,
            HIL_STATE_QUATERNION_DATA::ID => HIL_STATE_QUATERNION_DATA::EXTRA_CRC,
            HOME_POSITION_DATA::ID => HOME_POSITION_DATA::EXTRA_CRC,
            LOCAL_POSITION_NED_DATA::ID => LOCAL_POSITION_NED_DATA::EXTRA_CRC,
            LOG_ENTRY_DATA::ID => LOG_ENTRY_DATA::EXTRA_CRC,
            LOG_ERASE_DATA::ID => LOG_ERASE_DATA::EXTRA_CRC,
            LOG_REQUEST_DATA_DATA::ID => LOG_REQUEST_DATA_DATA::EXTRA_CRC,
            LOG_REQUEST_END_DATA::ID => LOG_REQUEST_END_DATA::EXTRA_CRC,
            LOG_REQUEST_LIST_DATA::ID => LOG_REQUEST_LIST_DATA::EXTRA_CRC,
            MANUAL_CONTROL_DATA::ID => MANUAL_CONTROL_DATA::EXTRA_CRC,
            MESSAGE_INTERVAL_DATA::ID => MESSAGE_INTERVAL_DATA::EXTRA_CRC,
            MISSION_ACK_DATA::ID => MISSION_ACK_DATA::EXTRA_CRC,
            MISSION_CLEAR_ALL_DATA::ID => MISSION_CLEAR_ALL_DATA::EXTRA_CRC,
            MISSION_COUNT_DATA::ID => MISSION_COUNT_DATA::EXTRA_CRC,
            MISSION_CURRENT_DATA::ID => MISSION_CURRENT_DATA::EXTRA_CRC,
            MISSION_ITEM_DATA::ID => MISSION_ITEM_DATA::EXTRA_CRC,
            MISSION_ITEM_INT_DATA::ID => MISSION_ITEM_INT_DATA::EXTRA_CRC,
            MISSION_REQUEST_DATA::ID => MISSION_REQUEST_DATA::EXTRA_CRC,
            MISSION_REQUEST_INT_DATA::ID => MISSION_REQUEST_INT_DATA::EXTRA_CRC,
            MISSION_REQUEST_LIST_DATA::ID => MISSION_REQUEST_LIST_DATA::EXTRA_CRC,
            MISSION_REQUEST_PARTIAL_LIST_DATA::ID => MISSION_REQUEST_PARTIAL_LIST_DATA::EXTRA_CRC,
            MISSION_SET_CURRENT_DATA::ID => MISSION_SET_CURRENT_DATA::EXTRA_CRC,
            MISSION_WRITE_PARTIAL_LIST_DATA::ID => MISSION_WRITE_PARTIAL_LIST_DATA::EXTRA_CRC,
            NAMED_VALUE_FLOAT_DATA::ID => NAMED_VALUE_FLOAT_DATA::EXTRA_CRC,
            NAMED_VALUE_INT_DATA::ID => NAMED_VALUE_INT_DATA::EXTRA_CRC,
            ODOMETRY_DATA::ID => ODOMETRY_DATA::EXTRA_CRC,
            ORBIT_EXECUTION_STATUS_DATA::ID => ORBIT_EXECUTION_STATUS_DATA::EXTRA_CRC,
            PARAM_ERROR_DATA::ID => PARAM_ERROR_DATA::EXTRA_CRC,
            PARAM_EXT_ACK_DATA::ID => PARAM_EXT_ACK_DATA::EXTRA_CRC,
            PARAM_EXT_REQUEST_LIST_DATA::ID => PARAM_EXT_REQUEST_LIST_DATA::EXTRA_CRC,
            PARAM_EXT_REQUEST_READ_DATA::ID => PARAM_EXT_REQUEST_READ_DATA::EXTRA_CRC,
            PARAM_EXT_SET_DATA::ID => PARAM_EXT_SET_DATA::EXTRA_CRC,
            PARAM_EXT_VALUE_DATA::ID => PARAM_EXT_VALUE_DATA::EXTRA_CRC,
            PARAM_REQUEST_LIST_DATA::ID => PARAM_REQUEST_LIST_DATA::EXTRA_CRC,
            PARAM_REQUEST_READ_DATA::ID => PARAM_REQUEST_READ_DATA::EXTRA_CRC,
            PARAM_SET_DATA::ID => PARAM_SET_DATA::EXTRA_CRC,
            PARAM_VALUE_DATA::ID => PARAM_VALUE_DATA::EXTRA_CRC,
            PING_DATA::ID => PING_DATA::EXTRA_CRC,
            POSITION_TARGET_LOCAL_NED_DATA::ID => POSITION_TARGET_LOCAL_NED_DATA::EXTRA_CRC,
            PROTOCOL_VERSION_DATA::ID => PROTOCOL_VERSION_DATA::EXTRA_CRC,
            RC_CHANNELS_DATA::ID => RC_CHANNELS_DATA::EXTRA_CRC,
            RC_CHANNELS_OVERRIDE_DATA::ID => RC_CHANNELS_OVERRIDE_DATA::EXTRA_CRC,
            REQUEST_DATA_STREAM_DATA::ID => REQUEST_DATA_STREAM_DATA::EXTRA_CRC,
            SCALED_IMU_DATA::ID => SCALED_IMU_DATA::EXTRA_CRC,
            SCALED_PRESSURE_DATA::ID => SCALED_PRESSURE_DATA::EXTRA_CRC,
            SERIAL_CONTROL_DATA::ID => SERIAL_CONTROL_DATA::EXTRA_CRC,
            SERVO_OUTPUT_RAW_DATA::ID => SERVO_OUTPUT_RAW_DATA::EXTRA_CRC,
            SET_ATTITUDE_TARGET_DATA::ID => SET_ATTITUDE_TARGET_DATA::EXTRA_CRC,
            SET_GPS_GLOBAL_ORIGIN_DATA::ID => SET_GPS_GLOBAL_ORIGIN_DATA::EXTRA_CRC,
            SET_MODE_DATA::ID => SET_MODE_DATA::EXTRA_CRC,
            SET_POSITION_TARGET_GLOBAL_INT_DATA::ID => SET_POSITION_TARGET_GLOBAL_INT_DATA::EXTRA_CRC,
            SET_POSITION_TARGET_LOCAL_NED_DATA::ID => SET_POSITION_TARGET_LOCAL_NED_DATA::EXTRA_CRC,
            SIM_STATE_DATA::ID => SIM_STATE_DATA::EXTRA_CRC,
            STATUSTEXT_DATA::ID => STATUSTEXT_DATA::EXTRA_CRC,
            SYSTEM_TIME_DATA::ID => SYSTEM_TIME_DATA::EXTRA_CRC,
            SYS_STATUS_DATA::ID => SYS_STATUS_DATA::EXTRA_CRC,
            TIMESYNC_DATA::ID => TIMESYNC_DATA::EXTRA_CRC,
            VFR_HUD_DATA::ID => VFR_HUD_DATA::EXTRA_CRC,
            VIBRATION_DATA::ID => VIBRATION_DATA::EXTRA_CRC,
            WIND_COV_DATA::ID => WIND_COV_DATA::EXTRA_CRC,
            _ => 0,
        }
    }
    fn target_system_id(&self) -> Option<u8> {
        match self {
            Self::COMMAND_ACK(inner) => Some(inner.target_system),
            Self::COMMAND_INT(inner) => Some(inner.target_system),
            Self::COMMAND_LONG(inner) => Some(inner.target_system),
            Self::FILE_TRANSFER_PROTOCOL(inner) => Some(inner.target_system),
            Self::LOG_ERASE(inner) => Some(inner.target_system),
            Self::LOG_REQUEST_DATA(inner) => Some(inner.target_system),
            Self::LOG_REQUEST_END(inner) => Some(inner.target_system),
            Self::LOG_REQUEST_LIST(inner) => Some(inner.target_system),
            Self::MANUAL_CONTROL(inner) => Some(inner.target),
            Self::MISSION_ACK(inner) => Some(inner.target_system),
            Self::MISSION_CLEAR_ALL(inner) => Some(inner.target_system),
            Self::MISSION_COUNT(inner) => Some(inner.target_system),
            Self::MISSION_ITEM(inner) => Some(inner.target_system),
            Self::MISSION_ITEM_INT(inner) => Some(inner.target_system),
            Self::MISSION_REQUEST(inner) => Some(inner.target_system),
            Self::MISSION_REQUEST_INT(inner) => Some(inner.target_system),
            Self::MISSION_REQUEST_LIST(inner) => Some(inner.target_system),
            Self::MISSION_REQUEST_PARTIAL_LIST(inner) => Some(inner.target_system),
            Self::MISSION_SET_CURRENT(inner) => Some(inner.target_system),
            Self::MISSION_WRITE_PARTIAL_LIST(inner) => Some(inner.target_system),
            Self::PARAM_ERROR(inner) => Some(inner.target_system),
            Self::PARAM_EXT_REQUEST_LIST(inner) => Some(inner.target_system),
            Self::PARAM_EXT_REQUEST_READ(inner) => Some(inner.target_system),
            Self::PARAM_EXT_SET(inner) => Some(inner.target_system),
            Self::PARAM_REQUEST_LIST(inner) => Some(inner.target_system),
            Self::PARAM_REQUEST_READ(inner) => Some(inner.target_system),
            Self::PARAM_SET(inner) => Some(inner.target_system),
            Self::PING(inner) => Some(inner.target_system),
            Self::RC_CHANNELS_OVERRIDE(inner) => Some(inner.target_system),
            Self::REQUEST_DATA_STREAM(inner) => Some(inner.target_system),
            Self::SET_ATTITUDE_TARGET(inner) => Some(inner.target_system),
            Self::SET_GPS_GLOBAL_ORIGIN(inner) => Some(inner.target_system),
            Self::SET_MODE(inner) => Some(inner.target_system),
            Self::SET_POSITION_TARGET_GLOBAL_INT(inner) => Some(inner.target_system),
            Self::SET_POSITION_TARGET_LOCAL_NED(inner) => Some(inner.target_system),
            Self::TIMESYNC(inner) => Some(inner.target_system),
            _ => None,
        }
    }
    fn target_system_id_mut(&mut self) -> Option<&mut u8> {
        match self {
            Self::COMMAND_ACK(inner) => Some(&mut inner.target_system),
            Self::COMMAND_INT(inner) => Some(&mut inner.target_system),
            Self::COMMAND_LONG(inner) => Some(&mut inner.target_system),
            Self::FILE_TRANSFER_PROTOCOL(inner) => Some(&mut inner.target_system),
            Self::LOG_ERASE(inner) => Some(&mut inner.target_system),
            Self::LOG_REQUEST_DATA(inner) => Some(&mut inner.target_system),
            Self::LOG_REQUEST_END(inner) => Some(&mut inner.target_system),
            Self::LOG_REQUEST_LIST(inner) => Some(&mut inner.target_system),
            Self::MANUAL_CONTROL(inner) => Some(&mut inner.target),
            Self::MISSION_ACK(inner) => Some(&mut inner.target_system),
            Self::MISSION_CLEAR_ALL(inner) => Some(&mut inner.target_system),
            Self::MISSION_COUNT(inner) => Some(&mut inner.target_system),
            Self::MISSION_ITEM(inner) => Some(&mut inner.target_system),
            Self::MISSION_ITEM_INT(inner) => Some(&mut inner.target_system),
            Self::MISSION_REQUEST(inner) => Some(&mut inner.target_system),
            Self::MISSION_REQUEST_INT(inner) => Some(&mut inner.target_system),
            Self::MISSION_REQUEST_LIST(inner) => Some(&mut inner.target_system),
            Self::MISSION_REQUEST_PARTIAL_LIST(inner) => Some(&mut inner.target_system),
            Self::MISSION_SET_CURRENT(inner) => Some(&mut inner.target_system),
            Self::MISSION_WRITE_PARTIAL_LIST(inner) => Some(&mut inner.target_system),
            Self::PARAM_ERROR(inner) => Some(&mut inner.target_system),
            Self::PARAM_EXT_REQUEST_LIST(inner) => Some(&mut inner.target_system),
            Self::PARAM_EXT_REQUEST_READ(inner) => Some(&mut inner.target_system),
            Self::PARAM_EXT_SET(inner) => Some(&mut inner.target_system),
            Self::PARAM_REQUEST_LIST(inner) => Some(&mut inner.target_system),
            Self::PARAM_REQUEST_READ(inner) => Some(&mut inner.target_system),
            Self::PARAM_SET(inner) => Some(&mut inner.target_system),
            Self::PING(inner) => Some(&mut inner.target_system),
            Self::RC_CHANNELS_OVERRIDE(inner) => Some(&mut inner.target_system),
            Self::REQUEST_DATA_STREAM(inner) => Some(&mut inner.target_system),
            Self::SET_ATTITUDE_TARGET(inner) => Some(&mut inner.target_system),
            Self::SET_GPS_GLOBAL_ORIGIN(inner) => Some(&mut inner.target_system),
            Self::SET_MODE(inner) => Some(&mut inner.target_system),
            Self::SET_POSITION_TARGET_GLOBAL_INT(inner) => Some(&mut inner.target_system),
            Self::SET_POSITION_TARGET_LOCAL_NED(inner) => Some(&mut inner.target_system),
            Self::TIMESYNC(inner) => Some(&mut inner.target_system),
            _ => None,
        }
    }
    fn target_component_id(&self) -> Option<u8> {
        match self {
            Self::COMMAND_ACK(inner) => Some(inner.target_component),
            Self::COMMAND_INT(inner) => Some(inner.target_component),
            Self::COMMAND_LONG(inner) => Some(inner.target_component),
            Self::FILE_TRANSFER_PROTOCOL(inner) => Some(inner.target_component),
            Self::LOG_ERASE(inner) => Some(inner.target_component),
            Self::LOG_REQUEST_DATA(inner) => Some(inner.target_component),
            Self::LOG_REQUEST_END(inner) => Some(inner.target_component),
            Self::LOG_REQUEST_LIST(inner) => Some(inner.target_component),
            Self::MISSION_ACK(inner) => Some(inner.target_component),
            Self::MISSION_CLEAR_ALL(inner) => Some(inner.target_component),
            Self::MISSION_COUNT(inner) => Some(inner.target_component),
            Self::MISSION_ITEM(inner) => Some(inner.target_component),
            Self::MISSION_ITEM_INT(inner) => Some(inner.target_component),
            Self::MISSION_REQUEST(inner) => Some(inner.target_component),
            Self::MISSION_REQUEST_INT(inner) => Some(inner.target_component),
            Self::MISSION_REQUEST_LIST(inner) => Some(inner.target_component),
            Self::MISSION_REQUEST_PARTIAL_LIST(inner) => Some(inner.target_component),
            Self::MISSION_SET_CURRENT(inner) => Some(inner.target_component),
            Self::MISSION_WRITE_PARTIAL_LIST(inner) => Some(inner.target_component),
            Self::PARAM_ERROR(inner) => Some(inner.target_component),
            Self::PARAM_EXT_REQUEST_LIST(inner) => Some(inner.target_component),
            Self::PARAM_EXT_REQUEST_READ(inner) => Some(inner.target_component),
            Self::PARAM_EXT_SET(inner) => Some(inner.target_component),
            Self::PARAM_REQUEST_LIST(inner) => Some(inner.target_component),
            Self::PARAM_REQUEST_READ(inner) => Some(inner.target_component),
            Self::PARAM_SET(inner) => Some(inner.target_component),
            Self::PING(inner) => Some(inner.target_component),
            Self::RC_CHANNELS_OVERRIDE(inner) => Some(inner.target_component),
            Self::REQUEST_DATA_STREAM(inner) => Some(inner.target_component),
            Self::SET_ATTITUDE_TARGET(inner) => Some(inner.target_component),
            Self::SET_POSITION_TARGET_GLOBAL_INT(inner) => Some(inner.target_component),
            Self::SET_POSITION_TARGET_LOCAL_NED(inner) => Some(inner.target_component),
            Self::TIMESYNC(inner) => Some(inner.target_component),
            _ => None,
        }
    }
    fn target_component_id_mut(&mut self) -> Option<&mut u8> {
        match self {
            Self::COMMAND_ACK(inner) => Some(&mut inner.target_component),
            Self::COMMAND_INT(inner) => Some(&mut inner.target_component),
            Self::COMMAND_LONG(inner) => Some(&mut inner.target_component),
            Self::FILE_TRANSFER_PROTOCOL(inner) => Some(&mut inner.target_component),
            Self::LOG_ERASE(inner) => Some(&mut inner.target_component),
            Self::LOG_REQUEST_DATA(inner) => Some(&mut inner.target_component),
            Self::LOG_REQUEST_END(inner) => Some(&mut inner.target_component),
            Self::LOG_REQUEST_LIST(inner) => Some(&mut inner.target_component),
            Self::MISSION_ACK(inner) => Some(&mut inner.target_component),
            Self::MISSION_CLEAR_ALL(inner) => Some(&mut inner.target_component),
            Self::MISSION_COUNT(inner) => Some(&mut inner.target_component),
            Self::MISSION_ITEM(inner) => Some(&mut inner.target_component),
            Self::MISSION_ITEM_INT(inner) => Some(&mut inner.target_component),
            Self::MISSION_REQUEST(inner) => Some(&mut inner.target_component),
            Self::MISSION_REQUEST_INT(inner) => Some(&mut inner.target_component),
            Self::MISSION_REQUEST_LIST(inner) => Some(&mut inner.target_component),
            Self::MISSION_REQUEST_PARTIAL_LIST(inner) => Some(&mut inner.target_component),
            Self::MISSION_SET_CURRENT(inner) => Some(&mut inner.target_component),
            Self::MISSION_WRITE_PARTIAL_LIST(inner) => Some(&mut inner.target_component),
            Self::PARAM_ERROR(inner) => Some(&mut inner.target_component),
            Self::PARAM_EXT_REQUEST_LIST(inner) => Some(&mut inner.target_component),
            Self::PARAM_EXT_REQUEST_READ(inner) => Some(&mut inner.target_component),
            Self::PARAM_EXT_SET(inner) => Some(&mut inner.target_component),
            Self::PARAM_REQUEST_LIST(inner) => Some(&mut inner.target_component),
            Self::PARAM_REQUEST_READ(inner) => Some(&mut inner.target_component),
            Self::PARAM_SET(inner) => Some(&mut inner.target_component),
            Self::PING(inner) => Some(&mut inner.target_component),
            Self::RC_CHANNELS_OVERRIDE(inner) => Some(&mut inner.target_component),
            Self::REQUEST_DATA_STREAM(inner) => Some(&mut inner.target_component),
            Self::SET_ATTITUDE_TARGET(inner) => Some(&mut inner.target_component),
            Self::SET_POSITION_TARGET_GLOBAL_INT(inner) => Some(&mut inner.target_component),
            Self::SET_POSITION_TARGET_LOCAL_NED(inner) => Some(&mut inner.target_component),
            Self::TIMESYNC(inner) => Some(&mut inner.target_component),
            _ => None,
        }
    }
}

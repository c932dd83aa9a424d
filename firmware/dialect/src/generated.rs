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
    #[doc = "PX4, whose mode numbers are used."]
    MAV_AUTOPILOT_PX4 = 12,
}
impl MavAutopilot {
    pub const DEFAULT: Self = Self::MAV_AUTOPILOT_PX4;
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
    #[doc = "Set the mode, in the autopilot type's coding."]
    MAV_CMD_DO_SET_MODE = 176,
    #[doc = "Arm (1) or disarm (0)."]
    MAV_CMD_COMPONENT_ARM_DISARM = 400,
    #[doc = "Make something fail."]
    MAV_CMD_INJECT_FAILURE = 420,
    #[doc = "Set a message's interval."]
    MAV_CMD_SET_MESSAGE_INTERVAL = 511,
    #[doc = "Send a message once."]
    MAV_CMD_REQUEST_MESSAGE = 512,
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
bitflags! { # [cfg_attr (feature = "ts-rs" , derive (TS))] # [cfg_attr (feature = "ts-rs" , ts (export , type = "number"))] # [cfg_attr (feature = "serde" , derive (Serialize , Deserialize))] # [cfg_attr (feature = "arbitrary" , derive (Arbitrary))] # [derive (Debug , Copy , Clone , PartialEq)] pub struct MavModeFlag : u8 { # [doc = "Rotors may turn."] const MAV_MODE_FLAG_SAFETY_ARMED = 128 ; # [doc = "Attitude is controlled."] const MAV_MODE_FLAG_STABILIZE_ENABLED = 16 ; # [doc = "Position is controlled."] const MAV_MODE_FLAG_GUIDED_ENABLED = 8 ; # [doc = "Flies by itself."] const MAV_MODE_FLAG_AUTO_ENABLED = 4 ; # [doc = "custom_mode is valid."] const MAV_MODE_FLAG_CUSTOM_MODE_ENABLED = 1 ; } }
impl MavModeFlag {
    pub const DEFAULT: Self = Self::MAV_MODE_FLAG_SAFETY_ARMED;
}
impl Default for MavModeFlag {
    fn default() -> Self {
        Self::DEFAULT
    }
}
bitflags! { # [cfg_attr (feature = "ts-rs" , derive (TS))] # [cfg_attr (feature = "ts-rs" , ts (export , type = "number"))] # [cfg_attr (feature = "serde" , derive (Serialize , Deserialize))] # [cfg_attr (feature = "arbitrary" , derive (Arbitrary))] # [derive (Debug , Copy , Clone , PartialEq)] pub struct MavProtocolCapability : u64 { # [doc = "COMMAND_INT is understood."] const MAV_PROTOCOL_CAPABILITY_COMMAND_INT = 8 ; # [doc = "MAVLink 2 is spoken."] const MAV_PROTOCOL_CAPABILITY_MAVLINK2 = 8192 ; } }
impl MavProtocolCapability {
    pub const DEFAULT: Self = Self::MAV_PROTOCOL_CAPABILITY_COMMAND_INT;
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
    #[doc = "Warning."]
    MAV_SEVERITY_WARNING = 4,
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
bitflags! { # [cfg_attr (feature = "ts-rs" , derive (TS))] # [cfg_attr (feature = "ts-rs" , ts (export , type = "number"))] # [cfg_attr (feature = "serde" , derive (Serialize , Deserialize))] # [cfg_attr (feature = "arbitrary" , derive (Arbitrary))] # [derive (Debug , Copy , Clone , PartialEq)] pub struct MavSysStatusSensor : u32 { # [doc = "Gyroscope."] const MAV_SYS_STATUS_SENSOR_3D_GYRO = 1 ; # [doc = "Accelerometer."] const MAV_SYS_STATUS_SENSOR_3D_ACCEL = 2 ; # [doc = "Magnetometer."] const MAV_SYS_STATUS_SENSOR_3D_MAG = 4 ; # [doc = "Barometer."] const MAV_SYS_STATUS_SENSOR_ABSOLUTE_PRESSURE = 8 ; # [doc = "Satellite receiver."] const MAV_SYS_STATUS_SENSOR_GPS = 32 ; # [doc = "The motion itself, measured from outside."] const MAV_SYS_STATUS_SENSOR_EXTERNAL_GROUND_TRUTH = 512 ; # [doc = "Rate control."] const MAV_SYS_STATUS_SENSOR_ANGULAR_RATE_CONTROL = 1024 ; # [doc = "Attitude control."] const MAV_SYS_STATUS_SENSOR_ATTITUDE_STABILIZATION = 2048 ; # [doc = "Heading control."] const MAV_SYS_STATUS_SENSOR_YAW_POSITION = 4096 ; # [doc = "Height control."] const MAV_SYS_STATUS_SENSOR_Z_ALTITUDE_CONTROL = 8192 ; # [doc = "Position control."] const MAV_SYS_STATUS_SENSOR_XY_POSITION_CONTROL = 16384 ; # [doc = "Motor outputs."] const MAV_SYS_STATUS_SENSOR_MOTOR_OUTPUTS = 32768 ; # [doc = "Not breached."] const MAV_SYS_STATUS_GEOFENCE = 1048576 ; # [doc = "Attitude and position are known."] const MAV_SYS_STATUS_AHRS = 2097152 ; # [doc = "Battery monitor."] const MAV_SYS_STATUS_SENSOR_BATTERY = 33554432 ; # [doc = "An arm request would be accepted."] const MAV_SYS_STATUS_PREARM_CHECK = 268435456 ; } }
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
    pub mavtype: MavType,
    #[doc = "Autopilot type."]
    pub autopilot: MavAutopilot,
    #[doc = "Mode flags."]
    pub base_mode: MavModeFlag,
    #[doc = "State."]
    pub system_status: MavState,
    #[doc = "MAVLink version."]
    pub mavlink_version: u8,
}
impl HEARTBEAT_DATA {
    pub const ENCODED_LEN: usize = 9usize;
    pub const DEFAULT: Self = Self {
        custom_mode: 0_u32,
        mavtype: MavType::DEFAULT,
        autopilot: MavAutopilot::DEFAULT,
        base_mode: MavModeFlag::DEFAULT,
        system_status: MavState::DEFAULT,
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
        let tmp = buf.get_u8()?;
        __struct.mavtype = FromPrimitive::from_u8(tmp)
            .ok_or(::mavlink_core::error::ParserError::InvalidEnum { enum_type: "MavType", value: tmp as u64 })?;
        let tmp = buf.get_u8()?;
        __struct.autopilot = FromPrimitive::from_u8(tmp)
            .ok_or(::mavlink_core::error::ParserError::InvalidEnum { enum_type: "MavAutopilot", value: tmp as u64 })?;
        let tmp = buf.get_u8()?;
        __struct.base_mode = MavModeFlag::from_bits_retain(tmp as <MavModeFlag as Flags>::Bits);
        let tmp = buf.get_u8()?;
        __struct.system_status = FromPrimitive::from_u8(tmp)
            .ok_or(::mavlink_core::error::ParserError::InvalidEnum { enum_type: "MavState", value: tmp as u64 })?;
        __struct.mavlink_version = buf.get_u8()?;
        Ok(__struct)
    }
    fn ser(&self, version: MavlinkVersion, bytes: &mut [u8]) -> usize {
        let mut __tmp = BytesMut::new(bytes);
        if __tmp.remaining() < Self::ENCODED_LEN {
            panic!("buffer is too small (need {} bytes, but got {})", Self::ENCODED_LEN, __tmp.remaining(),)
        }
        __tmp.put_u32_le(self.custom_mode);
        __tmp.put_u8(self.mavtype as u8);
        __tmp.put_u8(self.autopilot as u8);
        __tmp.put_u8(self.base_mode.bits() as u8);
        __tmp.put_u8(self.system_status as u8);
        __tmp.put_u8(self.mavlink_version);
        if matches!(version, MavlinkVersion::V2) {
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
#[derive(Clone, PartialEq, Debug)]
#[cfg_attr(feature = "serde", derive(Serialize, Deserialize))]
#[cfg_attr(feature = "serde", serde(tag = "type"))]
#[cfg_attr(feature = "arbitrary", derive(Arbitrary))]
#[cfg_attr(feature = "ts-rs", derive(TS))]
#[cfg_attr(feature = "ts-rs", ts(export))]
#[repr(u32)]
pub enum MavMessage {
    #[doc = "Attitude and rates, NED/FRD."]
    #[doc = ""]
    #[doc = "ID: 30"]
    ATTITUDE(ATTITUDE_DATA),
    #[doc = "Version and capabilities."]
    #[doc = ""]
    #[doc = "ID: 148"]
    AUTOPILOT_VERSION(AUTOPILOT_VERSION_DATA),
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
    #[doc = "How the estimator is doing."]
    #[doc = ""]
    #[doc = "ID: 230"]
    ESTIMATOR_STATUS(ESTIMATOR_STATUS_DATA),
    #[doc = "Whether the vehicle is on the ground."]
    #[doc = ""]
    #[doc = "ID: 245"]
    EXTENDED_SYS_STATE(EXTENDED_SYS_STATE_DATA),
    #[doc = "Who this is, and its mode."]
    #[doc = ""]
    #[doc = "ID: 0"]
    HEARTBEAT(HEARTBEAT_DATA),
    #[doc = "Position and velocity, NED."]
    #[doc = ""]
    #[doc = "ID: 32"]
    LOCAL_POSITION_NED(LOCAL_POSITION_NED_DATA),
    #[doc = "How many mission items there are."]
    #[doc = ""]
    #[doc = "ID: 44"]
    MISSION_COUNT(MISSION_COUNT_DATA),
    #[doc = "Asks how many mission items there are."]
    #[doc = ""]
    #[doc = "ID: 43"]
    MISSION_REQUEST_LIST(MISSION_REQUEST_LIST_DATA),
    #[doc = "A named number."]
    #[doc = ""]
    #[doc = "ID: 252"]
    NAMED_VALUE_INT(NAMED_VALUE_INT_DATA),
    #[doc = "A text for the pilot."]
    #[doc = ""]
    #[doc = "ID: 253"]
    STATUSTEXT(STATUSTEXT_DATA),
    #[doc = "Health."]
    #[doc = ""]
    #[doc = "ID: 1"]
    SYS_STATUS(SYS_STATUS_DATA),
    #[doc = "Compares two clocks."]
    #[doc = ""]
    #[doc = "ID: 111"]
    TIMESYNC(TIMESYNC_DATA),
}
impl MavMessage {
    pub const fn all_ids() -> &'static [u32] {
        &[0u32, 1u32, 30u32, 32u32, 43u32, 44u32, 75u32, 76u32, 77u32, 111u32, 148u32, 230u32, 245u32, 252u32, 253u32]
    }
    pub const fn all_messages() -> &'static [(&'static str, u32)] {
        &[
            (HEARTBEAT_DATA::NAME, HEARTBEAT_DATA::ID),
            (SYS_STATUS_DATA::NAME, SYS_STATUS_DATA::ID),
            (ATTITUDE_DATA::NAME, ATTITUDE_DATA::ID),
            (LOCAL_POSITION_NED_DATA::NAME, LOCAL_POSITION_NED_DATA::ID),
            (MISSION_REQUEST_LIST_DATA::NAME, MISSION_REQUEST_LIST_DATA::ID),
            (MISSION_COUNT_DATA::NAME, MISSION_COUNT_DATA::ID),
            (COMMAND_INT_DATA::NAME, COMMAND_INT_DATA::ID),
            (COMMAND_LONG_DATA::NAME, COMMAND_LONG_DATA::ID),
            (COMMAND_ACK_DATA::NAME, COMMAND_ACK_DATA::ID),
            (TIMESYNC_DATA::NAME, TIMESYNC_DATA::ID),
            (AUTOPILOT_VERSION_DATA::NAME, AUTOPILOT_VERSION_DATA::ID),
            (ESTIMATOR_STATUS_DATA::NAME, ESTIMATOR_STATUS_DATA::ID),
            (EXTENDED_SYS_STATE_DATA::NAME, EXTENDED_SYS_STATE_DATA::ID),
            (NAMED_VALUE_INT_DATA::NAME, NAMED_VALUE_INT_DATA::ID),
            (STATUSTEXT_DATA::NAME, STATUSTEXT_DATA::ID),
        ]
    }
}
impl Message for MavMessage {
    fn parse(version: MavlinkVersion, id: u32, payload: &[u8]) -> Result<Self, ::mavlink_core::error::ParserError> {
        match id {
            ATTITUDE_DATA::ID => ATTITUDE_DATA::deser(version, payload).map(Self::ATTITUDE),
            AUTOPILOT_VERSION_DATA::ID => AUTOPILOT_VERSION_DATA::deser(version, payload).map(Self::AUTOPILOT_VERSION),
            COMMAND_ACK_DATA::ID => COMMAND_ACK_DATA::deser(version, payload).map(Self::COMMAND_ACK),
            COMMAND_INT_DATA::ID => COMMAND_INT_DATA::deser(version, payload).map(Self::COMMAND_INT),
            COMMAND_LONG_DATA::ID => COMMAND_LONG_DATA::deser(version, payload).map(Self::COMMAND_LONG),
            ESTIMATOR_STATUS_DATA::ID => ESTIMATOR_STATUS_DATA::deser(version, payload).map(Self::ESTIMATOR_STATUS),
            EXTENDED_SYS_STATE_DATA::ID => {
                EXTENDED_SYS_STATE_DATA::deser(version, payload).map(Self::EXTENDED_SYS_STATE)
            }
            HEARTBEAT_DATA::ID => HEARTBEAT_DATA::deser(version, payload).map(Self::HEARTBEAT),
            LOCAL_POSITION_NED_DATA::ID => {
                LOCAL_POSITION_NED_DATA::deser(version, payload).map(Self::LOCAL_POSITION_NED)
            }
            MISSION_COUNT_DATA::ID => MISSION_COUNT_DATA::deser(version, payload).map(Self::MISSION_COUNT),
            MISSION_REQUEST_LIST_DATA::ID => {
                MISSION_REQUEST_LIST_DATA::deser(version, payload).map(Self::MISSION_REQUEST_LIST)
            }
            NAMED_VALUE_INT_DATA::ID => NAMED_VALUE_INT_DATA::deser(version, payload).map(Self::NAMED_VALUE_INT),
            STATUSTEXT_DATA::ID => STATUSTEXT_DATA::deser(version, payload).map(Self::STATUSTEXT),
            SYS_STATUS_DATA::ID => SYS_STATUS_DATA::deser(version, payload).map(Self::SYS_STATUS),
            TIMESYNC_DATA::ID => TIMESYNC_DATA::deser(version, payload).map(Self::TIMESYNC),
            _ => Err(::mavlink_core::error::ParserError::UnknownMessage { id }),
        }
    }
    fn message_name(&self) -> &'static str {
        match self {
            Self::ATTITUDE(..) => ATTITUDE_DATA::NAME,
            Self::AUTOPILOT_VERSION(..) => AUTOPILOT_VERSION_DATA::NAME,
            Self::COMMAND_ACK(..) => COMMAND_ACK_DATA::NAME,
            Self::COMMAND_INT(..) => COMMAND_INT_DATA::NAME,
            Self::COMMAND_LONG(..) => COMMAND_LONG_DATA::NAME,
            Self::ESTIMATOR_STATUS(..) => ESTIMATOR_STATUS_DATA::NAME,
            Self::EXTENDED_SYS_STATE(..) => EXTENDED_SYS_STATE_DATA::NAME,
            Self::HEARTBEAT(..) => HEARTBEAT_DATA::NAME,
            Self::LOCAL_POSITION_NED(..) => LOCAL_POSITION_NED_DATA::NAME,
            Self::MISSION_COUNT(..) => MISSION_COUNT_DATA::NAME,
            Self::MISSION_REQUEST_LIST(..) => MISSION_REQUEST_LIST_DATA::NAME,
            Self::NAMED_VALUE_INT(..) => NAMED_VALUE_INT_DATA::NAME,
            Self::STATUSTEXT(..) => STATUSTEXT_DATA::NAME,
            Self::SYS_STATUS(..) => SYS_STATUS_DATA::NAME,
            Self::TIMESYNC(..) => TIMESYNC_DATA::NAME,
        }
    }
    fn message_id(&self) -> u32 {
        match self {
            Self::ATTITUDE(..) => ATTITUDE_DATA::ID,
            Self::AUTOPILOT_VERSION(..) => AUTOPILOT_VERSION_DATA::ID,
            Self::COMMAND_ACK(..) => COMMAND_ACK_DATA::ID,
            Self::COMMAND_INT(..) => COMMAND_INT_DATA::ID,
            Self::COMMAND_LONG(..) => COMMAND_LONG_DATA::ID,
            Self::ESTIMATOR_STATUS(..) => ESTIMATOR_STATUS_DATA::ID,
            Self::EXTENDED_SYS_STATE(..) => EXTENDED_SYS_STATE_DATA::ID,
            Self::HEARTBEAT(..) => HEARTBEAT_DATA::ID,
            Self::LOCAL_POSITION_NED(..) => LOCAL_POSITION_NED_DATA::ID,
            Self::MISSION_COUNT(..) => MISSION_COUNT_DATA::ID,
            Self::MISSION_REQUEST_LIST(..) => MISSION_REQUEST_LIST_DATA::ID,
            Self::NAMED_VALUE_INT(..) => NAMED_VALUE_INT_DATA::ID,
            Self::STATUSTEXT(..) => STATUSTEXT_DATA::ID,
            Self::SYS_STATUS(..) => SYS_STATUS_DATA::ID,
            Self::TIMESYNC(..) => TIMESYNC_DATA::ID,
        }
    }
    fn message_id_from_name(name: &str) -> Option<u32> {
        match name {
            ATTITUDE_DATA::NAME => Some(ATTITUDE_DATA::ID),
            AUTOPILOT_VERSION_DATA::NAME => Some(AUTOPILOT_VERSION_DATA::ID),
            COMMAND_ACK_DATA::NAME => Some(COMMAND_ACK_DATA::ID),
            COMMAND_INT_DATA::NAME => Some(COMMAND_INT_DATA::ID),
            COMMAND_LONG_DATA::NAME => Some(COMMAND_LONG_DATA::ID),
            ESTIMATOR_STATUS_DATA::NAME => Some(ESTIMATOR_STATUS_DATA::ID),
            EXTENDED_SYS_STATE_DATA::NAME => Some(EXTENDED_SYS_STATE_DATA::ID),
            HEARTBEAT_DATA::NAME => Some(HEARTBEAT_DATA::ID),
            LOCAL_POSITION_NED_DATA::NAME => Some(LOCAL_POSITION_NED_DATA::ID),
            MISSION_COUNT_DATA::NAME => Some(MISSION_COUNT_DATA::ID),
            MISSION_REQUEST_LIST_DATA::NAME => Some(MISSION_REQUEST_LIST_DATA::ID),
            NAMED_VALUE_INT_DATA::NAME => Some(NAMED_VALUE_INT_DATA::ID),
            STATUSTEXT_DATA::NAME => Some(STATUSTEXT_DATA::ID),
            SYS_STATUS_DATA::NAME => Some(SYS_STATUS_DATA::ID),
            TIMESYNC_DATA::NAME => Some(TIMESYNC_DATA::ID),
            _ => None,
        }
    }
    fn default_message_from_id(id: u32) -> Option<Self> {
        match id {
            ATTITUDE_DATA::ID => Some(Self::ATTITUDE(ATTITUDE_DATA::default())),
            AUTOPILOT_VERSION_DATA::ID => Some(Self::AUTOPILOT_VERSION(AUTOPILOT_VERSION_DATA::default())),
            COMMAND_ACK_DATA::ID => Some(Self::COMMAND_ACK(COMMAND_ACK_DATA::default())),
            COMMAND_INT_DATA::ID => Some(Self::COMMAND_INT(COMMAND_INT_DATA::default())),
            COMMAND_LONG_DATA::ID => Some(Self::COMMAND_LONG(COMMAND_LONG_DATA::default())),
            ESTIMATOR_STATUS_DATA::ID => Some(Self::ESTIMATOR_STATUS(ESTIMATOR_STATUS_DATA::default())),
            EXTENDED_SYS_STATE_DATA::ID => Some(Self::EXTENDED_SYS_STATE(EXTENDED_SYS_STATE_DATA::default())),
            HEARTBEAT_DATA::ID => Some(Self::HEARTBEAT(HEARTBEAT_DATA::default())),
            LOCAL_POSITION_NED_DATA::ID => Some(Self::LOCAL_POSITION_NED(LOCAL_POSITION_NED_DATA::default())),
            MISSION_COUNT_DATA::ID => Some(Self::MISSION_COUNT(MISSION_COUNT_DATA::default())),
            MISSION_REQUEST_LIST_DATA::ID => Some(Self::MISSION_REQUEST_LIST(MISSION_REQUEST_LIST_DATA::default())),
            NAMED_VALUE_INT_DATA::ID => Some(Self::NAMED_VALUE_INT(NAMED_VALUE_INT_DATA::default())),
            STATUSTEXT_DATA::ID => Some(Self::STATUSTEXT(STATUSTEXT_DATA::default())),
            SYS_STATUS_DATA::ID => Some(Self::SYS_STATUS(SYS_STATUS_DATA::default())),
            TIMESYNC_DATA::ID => Some(Self::TIMESYNC(TIMESYNC_DATA::default())),
            _ => None,
        }
    }
    #[cfg(feature = "arbitrary")]
    fn random_message_from_id<R: rand::Rng>(id: u32, rng: &mut R) -> Option<Self> {
        match id {
            ATTITUDE_DATA::ID => Some(Self::ATTITUDE(ATTITUDE_DATA::random(rng))),
            AUTOPILOT_VERSION_DATA::ID => Some(Self::AUTOPILOT_VERSION(AUTOPILOT_VERSION_DATA::random(rng))),
            COMMAND_ACK_DATA::ID => Some(Self::COMMAND_ACK(COMMAND_ACK_DATA::random(rng))),
            COMMAND_INT_DATA::ID => Some(Self::COMMAND_INT(COMMAND_INT_DATA::random(rng))),
            COMMAND_LONG_DATA::ID => Some(Self::COMMAND_LONG(COMMAND_LONG_DATA::random(rng))),
            ESTIMATOR_STATUS_DATA::ID => Some(Self::ESTIMATOR_STATUS(ESTIMATOR_STATUS_DATA::random(rng))),
            EXTENDED_SYS_STATE_DATA::ID => Some(Self::EXTENDED_SYS_STATE(EXTENDED_SYS_STATE_DATA::random(rng))),
            HEARTBEAT_DATA::ID => Some(Self::HEARTBEAT(HEARTBEAT_DATA::random(rng))),
            LOCAL_POSITION_NED_DATA::ID => Some(Self::LOCAL_POSITION_NED(LOCAL_POSITION_NED_DATA::random(rng))),
            MISSION_COUNT_DATA::ID => Some(Self::MISSION_COUNT(MISSION_COUNT_DATA::random(rng))),
            MISSION_REQUEST_LIST_DATA::ID => Some(Self::MISSION_REQUEST_LIST(MISSION_REQUEST_LIST_DATA::random(rng))),
            NAMED_VALUE_INT_DATA::ID => Some(Self::NAMED_VALUE_INT(NAMED_VALUE_INT_DATA::random(rng))),
            STATUSTEXT_DATA::ID => Some(Self::STATUSTEXT(STATUSTEXT_DATA::random(rng))),
            SYS_STATUS_DATA::ID => Some(Self::SYS_STATUS(SYS_STATUS_DATA::random(rng))),
            TIMESYNC_DATA::ID => Some(Self::TIMESYNC(TIMESYNC_DATA::random(rng))),
            _ => None,
        }
    }
    fn ser(&self, version: MavlinkVersion, bytes: &mut [u8]) -> usize {
        match self {
            Self::ATTITUDE(body) => body.ser(version, bytes),
            Self::AUTOPILOT_VERSION(body) => body.ser(version, bytes),
            Self::COMMAND_ACK(body) => body.ser(version, bytes),
            Self::COMMAND_INT(body) => body.ser(version, bytes),
            Self::COMMAND_LONG(body) => body.ser(version, bytes),
            Self::ESTIMATOR_STATUS(body) => body.ser(version, bytes),
            Self::EXTENDED_SYS_STATE(body) => body.ser(version, bytes),
            Self::HEARTBEAT(body) => body.ser(version, bytes),
            Self::LOCAL_POSITION_NED(body) => body.ser(version, bytes),
            Self::MISSION_COUNT(body) => body.ser(version, bytes),
            Self::MISSION_REQUEST_LIST(body) => body.ser(version, bytes),
            Self::NAMED_VALUE_INT(body) => body.ser(version, bytes),
            Self::STATUSTEXT(body) => body.ser(version, bytes),
            Self::SYS_STATUS(body) => body.ser(version, bytes),
            Self::TIMESYNC(body) => body.ser(version, bytes),
        }
    }
    fn extra_crc(id: u32) -> u8 {
        match id {
            ATTITUDE_DATA::ID => ATTITUDE_DATA::EXTRA_CRC,
            AUTOPILOT_VERSION_DATA::ID => AUTOPILOT_VERSION_DATA::EXTRA_CRC,
            COMMAND_ACK_DATA::ID => COMMAND_ACK_DATA::EXTRA_CRC,
            COMMAND_INT_DATA::ID => COMMAND_INT_DATA::EXTRA_CRC,
            COMMAND_LONG_DATA::ID => COMMAND_LONG_DATA::EXTRA_CRC,
            ESTIMATOR_STATUS_DATA::ID => ESTIMATOR_STATUS_DATA::EXTRA_CRC,
            EXTENDED_SYS_STATE_DATA::ID => EXTENDED_SYS_STATE_DATA::EXTRA_CRC,
            HEARTBEAT_DATA::ID => HEARTBEAT_DATA::EXTRA_CRC,
            LOCAL_POSITION_NED_DATA::ID => LOCAL_POSITION_NED_DATA::EXTRA_CRC,
            MISSION_COUNT_DATA::ID => MISSION_COUNT_DATA::EXTRA_CRC,
            MISSION_REQUEST_LIST_DATA::ID => MISSION_REQUEST_LIST_DATA::EXTRA_CRC,
            NAMED_VALUE_INT_DATA::ID => NAMED_VALUE_INT_DATA::EXTRA_CRC,
            STATUSTEXT_DATA::ID => STATUSTEXT_DATA::EXTRA_CRC,
            SYS_STATUS_DATA::ID => SYS_STATUS_DATA::EXTRA_CRC,
            TIMESYNC_DATA::ID => TIMESYNC_DATA::EXTRA_CRC,
            _ => 0,
        }
    }
    fn target_system_id(&self) -> Option<u8> {
        match self {
            Self::COMMAND_ACK(inner) => Some(inner.target_system),
            Self::COMMAND_INT(inner) => Some(inner.target_system),
            Self::COMMAND_LONG(inner) => Some(inner.target_system),
            Self::MISSION_COUNT(inner) => Some(inner.target_system),
            Self::MISSION_REQUEST_LIST(inner) => Some(inner.target_system),
            Self::TIMESYNC(inner) => Some(inner.target_system),
            _ => None,
        }
    }
    fn target_system_id_mut(&mut self) -> Option<&mut u8> {
        match self {
            Self::COMMAND_ACK(inner) => Some(&mut inner.target_system),
            Self::COMMAND_INT(inner) => Some(&mut inner.target_system),
            Self::COMMAND_LONG(inner) => Some(&mut inner.target_system),
            Self::MISSION_COUNT(inner) => Some(&mut inner.target_system),
            Self::MISSION_REQUEST_LIST(inner) => Some(&mut inner.target_system),
            Self::TIMESYNC(inner) => Some(&mut inner.target_system),
            _ => None,
        }
    }
    fn target_component_id(&self) -> Option<u8> {
        match self {
            Self::COMMAND_ACK(inner) => Some(inner.target_component),
            Self::COMMAND_INT(inner) => Some(inner.target_component),
            Self::COMMAND_LONG(inner) => Some(inner.target_component),
            Self::MISSION_COUNT(inner) => Some(inner.target_component),
            Self::MISSION_REQUEST_LIST(inner) => Some(inner.target_component),
            Self::TIMESYNC(inner) => Some(inner.target_component),
            _ => None,
        }
    }
    fn target_component_id_mut(&mut self) -> Option<&mut u8> {
        match self {
            Self::COMMAND_ACK(inner) => Some(&mut inner.target_component),
            Self::COMMAND_INT(inner) => Some(&mut inner.target_component),
            Self::COMMAND_LONG(inner) => Some(&mut inner.target_component),
            Self::MISSION_COUNT(inner) => Some(&mut inner.target_component),
            Self::MISSION_REQUEST_LIST(inner) => Some(&mut inner.target_component),
            Self::TIMESYNC(inner) => Some(&mut inner.target_component),
            _ => None,
        }
    }
}

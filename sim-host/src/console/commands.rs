//! Names of commands that ground stations send and the vehicle does not know, as MAVLink's `common.xml` has them. Those that
//! it knows are in the dialect.

use glissade_dialect::MavCmd;
use glissade_dialect::num_traits::FromPrimitive as _;

/// A command's name, without `MAV_CMD_`.
pub(super) fn name(command: u16) -> Option<String> {
    let known =
        || MavCmd::from_u16(command).map(|known| format!("{known:?}").trim_start_matches("MAV_CMD_").to_owned());
    let unknown = OTHERS.iter().find(|(number, _)| *number == command);
    known().or_else(|| unknown.map(|(_, name)| (*name).to_owned()))
}

/// By rising numbers.
const OTHERS: &[(u16, &str)] = &[
    (16, "NAV_WAYPOINT"),
    (17, "NAV_LOITER_UNLIM"),
    (18, "NAV_LOITER_TURNS"),
    (19, "NAV_LOITER_TIME"),
    (23, "NAV_LAND_LOCAL"),
    (24, "NAV_TAKEOFF_LOCAL"),
    (25, "NAV_FOLLOW"),
    (30, "NAV_CONTINUE_AND_CHANGE_ALT"),
    (31, "NAV_LOITER_TO_ALT"),
    (32, "DO_FOLLOW"),
    (33, "DO_FOLLOW_REPOSITION"),
    (35, "DO_FIGURE_EIGHT"),
    (80, "NAV_ROI"),
    (84, "NAV_VTOL_TAKEOFF"),
    (85, "NAV_VTOL_LAND"),
    (92, "NAV_GUIDED_ENABLE"),
    (93, "NAV_DELAY"),
    (94, "NAV_PAYLOAD_PLACE"),
    (112, "CONDITION_DELAY"),
    (113, "CONDITION_CHANGE_ALT"),
    (114, "CONDITION_DISTANCE"),
    (177, "DO_JUMP"),
    (180, "DO_SET_PARAMETER"),
    (181, "DO_SET_RELAY"),
    (182, "DO_REPEAT_RELAY"),
    (183, "DO_SET_SERVO"),
    (184, "DO_REPEAT_SERVO"),
    (186, "DO_CHANGE_ALTITUDE"),
    (187, "DO_SET_ACTUATOR"),
    (188, "DO_RETURN_PATH_START"),
    (189, "DO_LAND_START"),
    (190, "DO_RALLY_LAND"),
    (191, "DO_GO_AROUND"),
    (193, "DO_PAUSE_CONTINUE"),
    (194, "DO_SET_REVERSE"),
    (195, "DO_SET_ROI_LOCATION"),
    (196, "DO_SET_ROI_WPNEXT_OFFSET"),
    (197, "DO_SET_ROI_NONE"),
    (198, "DO_SET_ROI_SYSID"),
    (200, "DO_CONTROL_VIDEO"),
    (201, "DO_SET_ROI"),
    (202, "DO_DIGICAM_CONFIGURE"),
    (203, "DO_DIGICAM_CONTROL"),
    (204, "DO_MOUNT_CONFIGURE"),
    (205, "DO_MOUNT_CONTROL"),
    (206, "DO_SET_CAM_TRIGG_DIST"),
    (207, "DO_FENCE_ENABLE"),
    (208, "DO_PARACHUTE"),
    (210, "DO_INVERTED_FLIGHT"),
    (211, "DO_GRIPPER"),
    (212, "DO_AUTOTUNE_ENABLE"),
    (213, "NAV_SET_YAW_SPEED"),
    (214, "DO_SET_CAM_TRIGG_INTERVAL"),
    (220, "DO_MOUNT_CONTROL_QUAT"),
    (221, "DO_GUIDED_MASTER"),
    (222, "DO_GUIDED_LIMITS"),
    (223, "DO_ENGINE_CONTROL"),
    (224, "DO_SET_MISSION_CURRENT"),
    (241, "PREFLIGHT_CALIBRATION"),
    (242, "PREFLIGHT_SET_SENSOR_OFFSETS"),
    (243, "PREFLIGHT_UAVCAN"),
    (252, "OVERRIDE_GOTO"),
    (300, "MISSION_START"),
    (310, "ACTUATOR_TEST"),
    (311, "CONFIGURE_ACTUATOR"),
    (401, "RUN_PREARM_CHECKS"),
    (405, "ILLUMINATOR_ON_OFF"),
    (406, "DO_ILLUMINATOR_CONFIGURE"),
    (500, "START_RX_PAIR"),
    (521, "REQUEST_CAMERA_INFORMATION"),
    (522, "REQUEST_CAMERA_SETTINGS"),
    (525, "REQUEST_STORAGE_INFORMATION"),
    (526, "STORAGE_FORMAT"),
    (527, "REQUEST_CAMERA_CAPTURE_STATUS"),
    (528, "REQUEST_FLIGHT_INFORMATION"),
    (529, "RESET_CAMERA_SETTINGS"),
    (530, "SET_CAMERA_MODE"),
    (531, "SET_CAMERA_ZOOM"),
    (532, "SET_CAMERA_FOCUS"),
    (533, "SET_STORAGE_USAGE"),
    (534, "SET_CAMERA_SOURCE"),
    (600, "JUMP_TAG"),
    (601, "DO_JUMP_TAG"),
    (1000, "DO_GIMBAL_MANAGER_PITCHYAW"),
    (1001, "DO_GIMBAL_MANAGER_CONFIGURE"),
    (2000, "IMAGE_START_CAPTURE"),
    (2001, "IMAGE_STOP_CAPTURE"),
    (2002, "REQUEST_CAMERA_IMAGE_CAPTURE"),
    (2003, "DO_TRIGGER_CONTROL"),
    (2004, "CAMERA_TRACK_POINT"),
    (2005, "CAMERA_TRACK_RECTANGLE"),
    (2010, "CAMERA_STOP_TRACKING"),
    (2500, "VIDEO_START_CAPTURE"),
    (2501, "VIDEO_STOP_CAPTURE"),
    (2502, "VIDEO_START_STREAMING"),
    (2503, "VIDEO_STOP_STREAMING"),
    (2504, "REQUEST_VIDEO_STREAM_INFORMATION"),
    (2505, "REQUEST_VIDEO_STREAM_STATUS"),
    (2510, "LOGGING_START"),
    (2511, "LOGGING_STOP"),
    (2520, "AIRFRAME_CONFIGURATION"),
    (2600, "CONTROL_HIGH_LATENCY"),
    (2800, "PANORAMA_CREATE"),
    (3000, "DO_VTOL_TRANSITION"),
    (3001, "ARM_AUTHORIZATION_REQUEST"),
    (4000, "SET_GUIDED_SUBMODE_STANDARD"),
    (4001, "SET_GUIDED_SUBMODE_CIRCLE"),
    (4501, "CONDITION_GATE"),
    (5200, "UAVCAN_GET_NODE_INFO"),
    (5300, "DO_SET_SAFETY_SWITCH_STATE"),
    (10001, "DO_ADSB_OUT_IDENT"),
    (30001, "PAYLOAD_PREPARE_DEPLOY"),
    (30002, "PAYLOAD_CONTROL_DEPLOY"),
    (31010, "USER_1"),
    (31011, "USER_2"),
    (31012, "USER_3"),
    (31013, "USER_4"),
    (31014, "USER_5"),
    (42006, "FIXED_MAG_CAL_YAW"),
    (42600, "DO_WINCH"),
    (43000, "GUIDED_CHANGE_SPEED"),
    (43001, "GUIDED_CHANGE_ALTITUDE"),
    (43002, "GUIDED_CHANGE_HEADING"),
    (43003, "EXTERNAL_POSITION_ESTIMATE"),
];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn commands_that_clients_send_have_names() {
        for (command, expected) in [
            (17, "NAV_LOITER_UNLIM"),
            (176, "DO_SET_MODE"),
            (187, "DO_SET_ACTUATOR"),
            (224, "DO_SET_MISSION_CURRENT"),
            (241, "PREFLIGHT_CALIBRATION"),
            (300, "MISSION_START"),
            (2510, "LOGGING_START"),
        ] {
            assert_eq!(name(command).as_deref(), Some(expected));
        }
        assert_eq!(name(60_000), None);
    }

    #[test]
    fn each_is_named_once() {
        assert!(OTHERS.is_sorted_by(|a, b| a.0 < b.0));
        assert!(OTHERS.iter().all(|(command, _)| MavCmd::from_u16(*command).is_none()), "the dialect names it");
    }
}

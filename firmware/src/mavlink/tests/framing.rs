//! Frames in streams that are damaged, or made to be misread.

use super::*;

/// `FILE_TRANSFER_PROTOCOL` to another vehicle, its data beginning with some bytes.
fn file_frame(data: &[u8]) -> Vec<u8> {
    const ID: u8 = 110;
    const EXTRA_CRC: u8 = 84;
    let mut bytes = vec![0xfd, 254, 0, 0, 7, 254, 190, ID, 0, 0, 0, 9, 1];
    bytes.extend(data);
    bytes.resize(10 + 254, 0x33);
    let checksum = calculate_crc(&bytes[1..], EXTRA_CRC);
    bytes.extend(checksum.to_le_bytes());
    bytes
}

#[test]
fn commands_between_long_frames_that_are_cut_are_answered_in_time() {
    let cut = &file_frame(&[])[..12];
    let mut bench = Bench::silent();
    let mut answered = 0;
    for round in 0..20 {
        // At 92 kB/s, and a command each half a second.
        let mut line = if round % 2 == 0 { command(NAV_WAYPOINT, 0.0, 0.0) } else { Vec::new() };
        for _ in 0..25 {
            while line.len() < 920 {
                line.extend(cut);
            }
            let bytes: Vec<u8> = line.drain(..920).collect();
            answered += count(&bench.job(&bytes), 77);
        }
    }
    assert_eq!(answered, 10);
}

#[test]
fn a_command_in_a_file_for_another_vehicle_is_never_executed_wherever_the_bytes_are_cut() {
    let kill = command(ARM, 0.0, 21196.0);
    for lead in 0..40 {
        // What was damaged before may reach to anywhere in the file.
        let mut junk = vec![0xfd, 20 + lead, 0, 0, 0, 255, 190, 76, 0, 0];
        junk.truncate(10);
        for ends in [30, 40, 55, 90, 200] {
            let bytes =
                [junk.clone(), file_frame(&[vec![0x33; 7], kill.clone(), vec![0x33; 30], kill.clone()].concat())];
            let bytes = bytes.concat();
            let mut bench = Bench::silent();
            bench.job(&bytes[..ends]);
            bench.job(&bytes[ends..]);
            bench.jobs(20);
            assert!(!bench.killed, "{lead} {ends}");
        }
    }
}

#[test]
fn a_command_after_noise_is_not_made_to_wait() {
    let mut bench = Bench::silent();
    bench.job(&[0x00, 0x55, 0x17]);
    assert!(bench.result_of(&command(NAV_WAYPOINT, 0.0, 0.0)).is_some());
}

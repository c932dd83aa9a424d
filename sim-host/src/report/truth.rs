//! `truth.csv`: the flight as it was, for anyone who wants to check the physics with a tool of their own.
//!
//! One row a tick, every number in the shortest decimal form that reads back to the same f64, so the text is the
//! flight bit for bit and its SHA-256 is the flight's fingerprint. The hash is taken while writing; over
//! [`std::io::sink`] it costs no file. Rows allocate nothing: they collect in a block of fixed size, which is hashed
//! and written when it is full.

use std::fs::File;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

use anyhow::Result;
use sha2::{Digest, Sha256};

use super::out::{cannot_write, create_file};
use crate::record::{Recorder, Row};

/// Number of columns.
pub const COLUMNS: usize = 36;

/// The header. World frame NWU, body frame FLU; `omega` acts from the row's time to the next row's.
pub const HEADER: [&str; COLUMNS] = [
    "t_s",
    "x_m",
    "y_m",
    "z_m",
    "vx_m_s",
    "vy_m_s",
    "vz_m_s",
    "qw",
    "qx",
    "qy",
    "qz",
    "p_rad_s",
    "q_rad_s",
    "r_rad_s",
    "omega1_rad_s",
    "omega2_rad_s",
    "omega3_rad_s",
    "omega4_rad_s",
    "ref_x_m",
    "ref_y_m",
    "ref_z_m",
    "ref_yaw_rad",
    "U1_n",
    "U2_n_m",
    "U3_n_m",
    "U4_n_m",
    "s1_rad_s",
    "s2_rad_s",
    "s3_rad_s",
    "sx_m_s",
    "sy_m_s",
    "sz_m_s",
    "omega1_cmd_rad_s",
    "omega2_cmd_rad_s",
    "omega3_cmd_rad_s",
    "omega4_cmd_rad_s",
];

/// The longest number is `-1.2345678901234567e-308` and its comma, rounded up.
const LONGEST_NUMBER: usize = 32;
const LONGEST_ROW: usize = COLUMNS * LONGEST_NUMBER;
/// Large enough that hashing and writing are cheap a row, small enough to stay in the cache.
const BLOCK: usize = 64 * 1024;

/// Writes the rows of a flight as CSV and hashes the bytes as they pass.
///
/// An I/O error does not stop the flight: it is kept, nothing is written after it, and
/// [`finish`](Self::finish) returns it.
pub struct TruthWriter<W: Write> {
    out: W,
    name: PathBuf,
    hash: Sha256,
    block: Vec<u8>,
    number: zmij::Buffer,
    outcome: io::Result<()>,
}

impl TruthWriter<File> {
    /// Creates (or overwrites) the file at `path`.
    ///
    /// # Errors
    /// When the file cannot be created; the message names it.
    pub fn create(path: &Path) -> Result<Self> {
        let file = create_file(path)?;
        Ok(Self::named(file, path.to_owned()))
    }
}

impl TruthWriter<io::Sink> {
    /// Only the hash, no file.
    pub fn hash_only() -> Self {
        Self::new(io::sink())
    }
}

impl<W: Write> TruthWriter<W> {
    /// Writes to `out`, which needs no buffer of its own.
    pub fn new(out: W) -> Self {
        Self::named(out, PathBuf::from("truth.csv"))
    }

    fn named(out: W, name: PathBuf) -> Self {
        let mut block = Vec::with_capacity(BLOCK + LONGEST_ROW);
        block.extend_from_slice(HEADER.join(",").as_bytes());
        block.push(b'\n');
        Self { out, name, hash: Sha256::new(), block, number: zmij::Buffer::new(), outcome: Ok(()) }
    }

    /// Writes what is left and returns the SHA-256 of every byte, in lower-case hexadecimal.
    ///
    /// # Errors
    /// The first I/O error of the whole flight; the message names the file.
    pub fn finish(mut self) -> Result<String> {
        self.pass_block();
        let flushed = self.out.flush();
        self.outcome.and(flushed).map_err(|error| cannot_write(&self.name, error))?;
        Ok(hex(&self.hash.finalize()))
    }

    fn pass_block(&mut self) {
        self.hash.update(&self.block);
        if self.outcome.is_ok() {
            self.outcome = self.out.write_all(&self.block);
        }
        self.block.clear();
    }

    fn number(&mut self, value: f64, end: u8) {
        self.block.extend_from_slice(self.number.format(value).as_bytes());
        self.block.push(end);
    }
}

impl<W: Write> Recorder for TruthWriter<W> {
    fn record(&mut self, row: &Row) {
        let values = values(row);
        for value in &values[..COLUMNS - 1] {
            self.number(*value, b',');
        }
        self.number(values[COLUMNS - 1], b'\n');
        if self.block.len() >= BLOCK {
            self.pass_block();
        }
    }
}

/// A row's numbers in the order of [`HEADER`].
#[rustfmt::skip] // One line a group of columns.
fn values(row: &Row) -> [f64; COLUMNS] {
    let Row { t, position: [x, y, z], velocity: [vx, vy, vz], attitude: [qw, qx, qy, qz], rates: [p, q, r], .. } = *row;
    let Row { omega: [o1, o2, o3, o4], omega_command: [c1, c2, c3, c4], .. } = *row;
    let Row { reference: [ref_x, ref_y, ref_z, ref_yaw], u: [u1, u2, u3, u4], s: [s1, s2, s3, sx, sy, sz], .. } = *row;
    [
        t,
        x, y, z,
        vx, vy, vz,
        qw, qx, qy, qz,
        p, q, r,
        o1, o2, o3, o4,
        ref_x, ref_y, ref_z, ref_yaw,
        u1, u2, u3, u4,
        s1, s2, s3, sx, sy, sz,
        c1, c2, c3, c4,
    ]
}

pub(crate) fn hex(bytes: &[u8]) -> String {
    use std::fmt::Write as _;
    bytes.iter().fold(String::with_capacity(2 * bytes.len()), |mut text, byte| {
        write!(text, "{byte:02x}").expect("writing to a string cannot fail");
        text
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use rand::{RngExt as _, SeedableRng as _};

    /// Numbers that printers get wrong, and any bit pattern else that is not a NaN.
    fn hard_numbers(count: usize) -> Vec<f64> {
        let mut random = chacha20::ChaCha8Rng::seed_from_u64(1);
        let edges = [0.0, -0.0, 0.1, 1.0 / 3.0, 1e-5, 9.999_999e-6, 1e16, 5e-324, f64::MIN_POSITIVE, f64::MAX, 1e23];
        let patterns = std::iter::repeat_with(move || f64::from_bits(random.random())).filter(|v| !v.is_nan());
        edges.into_iter().chain(patterns).take(count).collect()
    }

    fn row_of(v: &[f64]) -> Row {
        let take = |from: usize| std::array::from_fn(|i| v[from + i]);
        Row {
            t: v[0],
            position: [v[1], v[2], v[3]],
            velocity: [v[4], v[5], v[6]],
            attitude: take(7),
            rates: [v[11], v[12], v[13]],
            omega: take(14),
            reference: take(18),
            reference_is_held: false,
            desired_attitude: [0.0; 3],
            u: take(22),
            s: std::array::from_fn(|i| v[26 + i]),
            omega_command: take(32),
        }
    }

    fn write(rows: &[Row]) -> (String, String) {
        let mut text = Vec::new();
        let mut writer = TruthWriter::new(&mut text);
        for row in rows {
            writer.record(row);
        }
        let hash = writer.finish().expect("a vector takes every byte");
        (String::from_utf8(text).expect("CSV is ASCII"), hash)
    }

    fn rows(numbers: &[f64]) -> Vec<Row> {
        numbers.chunks_exact(COLUMNS).map(row_of).collect()
    }

    #[test]
    fn every_number_reads_back_bit_for_bit() {
        let numbers = hard_numbers(COLUMNS * 2000);
        let (text, _) = write(&rows(&numbers));
        let read = text.lines().skip(1).flat_map(|line| line.split(',')).map(|n| n.parse::<f64>().expect("a number"));
        let (read, written): (Vec<u64>, Vec<u64>) =
            (read.map(f64::to_bits).collect(), numbers.iter().map(|v| v.to_bits()).collect());
        assert!(read == written);
    }

    #[test]
    fn numbers_are_as_short_as_the_standard_library_s() {
        // Digits only: the two place the point differently, and round 2071254452146181.25, a tie, to either side.
        let digits = |text: &str| {
            let mantissa = text.split('e').next().unwrap_or_default();
            mantissa.replace(['-', '.'], "").trim_matches('0').len()
        };
        let mut buffer = zmij::Buffer::new();
        for value in hard_numbers(20_000).into_iter().filter(|v| v.is_finite()) {
            let text = buffer.format(value);
            assert_eq!(digits(text), digits(&format!("{value:e}")), "{value:e} was printed as {text}");
        }
    }

    #[test]
    fn header_names_every_column_once() {
        let (text, _) = write(&[]);
        assert_eq!(text, format!("{}\n", HEADER.join(",")));
        let unique: std::collections::BTreeSet<_> = HEADER.iter().collect();
        assert_eq!(unique.len(), COLUMNS);
    }

    #[test]
    fn columns_stand_under_their_names() {
        let numbers: Vec<f64> = (0..COLUMNS).map(|i| i as f64).collect();
        let row = row_of(&numbers);
        assert_eq!(values(&row).to_vec(), numbers);
        let column = |name: &str| HEADER.iter().position(|h| *h == name).map(|i| values(&row)[i]);
        assert_eq!(column("vy_m_s"), Some(row.velocity[1]));
        assert_eq!(column("qw"), Some(row.attitude[0]));
        assert_eq!(column("omega4_rad_s"), Some(row.omega[3]));
        assert_eq!(column("ref_yaw_rad"), Some(row.reference[3]));
        assert_eq!(column("U2_n_m"), Some(row.u[1]));
        assert_eq!(column("sx_m_s"), Some(row.s[3]));
        assert_eq!(column("omega1_cmd_rad_s"), Some(row.omega_command[0]));
    }

    #[test]
    fn hash_is_that_of_the_bytes_with_or_without_a_file() {
        let rows = rows(&hard_numbers(COLUMNS * 500));
        let (text, hash) = write(&rows);
        assert!(text.len() > 2 * BLOCK, "the test must cross the edge of a block");
        assert_eq!(hash, hex(&Sha256::digest(text.as_bytes())));
        let mut sink = TruthWriter::hash_only();
        for row in &rows {
            sink.record(row);
        }
        assert_eq!(sink.finish().expect("a sink takes every byte"), hash);
    }

    #[test]
    fn hexadecimal_is_the_usual_one() {
        let empty = "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855";
        assert_eq!(hex(&Sha256::digest(b"")), empty);
    }

    #[test]
    fn nan_has_one_spelling() {
        let numbers = [f64::NAN, -f64::NAN, f64::from_bits(0x7ff0_0000_0000_0001)];
        let (text, _) = write(&rows(&numbers.repeat(COLUMNS / 3)));
        let line = text.lines().nth(1).expect("one row");
        assert!(line.split(',').all(|n| n == "NaN"), "{line}");
    }

    #[test]
    fn the_block_never_grows() {
        let mut writer = TruthWriter::hash_only();
        let before = writer.block.capacity();
        let longest = row_of(&[-2.225_073_858_507_201_4e-308; COLUMNS]);
        for _ in 0..1000 {
            writer.record(&longest);
        }
        assert_eq!(writer.block.capacity(), before);
    }

    /// A disk with room for so many bytes.
    struct FullDisk(usize);

    impl Write for FullDisk {
        fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
            if self.0 < bytes.len() {
                return Err(io::ErrorKind::StorageFull.into());
            }
            self.0 -= bytes.len();
            Ok(bytes.len())
        }

        fn flush(&mut self) -> io::Result<()> {
            Ok(())
        }
    }

    #[test]
    fn a_full_disk_is_reported_at_the_end() {
        let mut writer = TruthWriter::new(FullDisk(BLOCK));
        let row = row_of(&[0.1; COLUMNS]);
        for _ in 0..5000 {
            writer.record(&row);
        }
        let error = format!("{:#}", writer.finish().expect_err("the disk was full"));
        assert!(error.contains("truth.csv") && error.contains("free some space"), "{error}");
    }
}

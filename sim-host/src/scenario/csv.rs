//! Trajectories as CSV: a header, and a row for each time.

use std::path::Path;

use anyhow::{Context, Result, anyhow, bail, ensure};

use crate::files::read_regular;

/// Columns that must be there, in any order; others are ignored. Without `yaw_rad`, yaw is 0.
const COLUMNS: [&str; 4] = ["t_s", "x_m", "y_m", "z_m"];
const YAW: &str = "yaw_rad";
/// Fewer rows than this are no path.
const ROWS_MIN: usize = 4;
/// Greatest coordinate, m, and greatest yaw and time: an f32 still resolves a millimetre.
const LARGEST: f64 = 1e4;
/// Larger files are refused, bytes: a flight of hours at 100 rows a second.
const LARGEST_FILE: u64 = 64 << 20;

/// One row.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Row {
    /// Where it stands in the file, from 1.
    pub(super) line: usize,
    /// Time, s.
    pub(super) t: f64,
    /// x, y, z (m) and yaw (rad), unwrapped: never more than half a turn from the row before.
    pub(super) value: [f64; 4],
}

/// Reads a file.
///
/// # Errors
/// In one line: the file, and where in it what is wrong.
pub(super) fn read(path: &Path) -> Result<Vec<Row>> {
    let context = || format!("trajectory file `{}`", path.display());
    let text = read_regular(path, LARGEST_FILE).with_context(|| {
        format!("cannot read trajectory file `{}` (a path from the scenario file's folder)", path.display())
    })?;
    rows(&text).with_context(context)
}

fn rows(text: &str) -> Result<Vec<Row>> {
    // As spreadsheets leave it: a byte-order mark at the beginning, and lines that end with CR LF, or CR alone.
    let text = text.trim_start_matches('\u{feff}').replace("\r\n", "\n").replace('\r', "\n");
    let mut lines = text.lines().enumerate().map(|(i, line)| (i + 1, line.trim())).filter(|(_, line)| !line.is_empty());
    let (line, header) = lines.next().ok_or_else(|| anyhow!("it is empty: the first line names the columns"))?;
    let names = columns_of(line, header)?;
    let place = |name: &str| names.iter().position(|known| *known == name);
    let mut columns = [0; 4];
    for (column, name) in columns.iter_mut().zip(COLUMNS) {
        *column = place(name).ok_or_else(|| {
            anyhow!(
                "line {line}: no column `{name}` in `{header}`: it must have t_s, x_m, y_m, z_m, and may have yaw_rad"
            )
        })?;
    }
    let yaw = place(YAW);
    let mut rows: Vec<Row> = Vec::new();
    for (line, text) in lines {
        require_no_more(line, text, names.len())?;
        let row = row(line, text, columns, yaw)?;
        rows.push(after(rows.last(), row)?);
    }
    ensure!(
        rows.len() >= ROWS_MIN,
        "it must have {ROWS_MIN} rows or more below the columns' names, not {}",
        rows.len()
    );
    Ok(rows)
}

/// The names of the columns.
fn columns_of(line: usize, header: &str) -> Result<Vec<&str>> {
    for (separator, name) in [(';', "`;`"), ('\t', "tabs")] {
        ensure!(
            header.contains(',') || !header.contains(separator),
            "line {line}: columns are separated by {name}: separate them by commas, and write decimals with a point"
        );
    }
    let names: Vec<&str> = header.trim_start_matches('#').split(',').map(str::trim).collect();
    if let Some(other) = names.iter().find(|name| name.starts_with("yaw") && **name != YAW) {
        bail!("line {line}: column `{other}`: yaw is given in radians, as `{YAW}`");
    }
    Ok(names)
}

/// Refuses a row of more values than there are columns: decimals with a comma would be taken for two.
fn require_no_more(line: usize, text: &str, columns: usize) -> Result<()> {
    let cells = text.trim_end_matches([',', ' ']).split(',').count();
    ensure!(
        cells <= columns,
        "line {line}: {cells} values for {columns} columns: write decimals with a point, and name every column in line 1"
    );
    Ok(())
}

fn row(line: usize, text: &str, columns: [usize; 4], yaw: Option<usize>) -> Result<Row> {
    let cells: Vec<&str> = text.split(',').map(str::trim).collect();
    let number = |column: usize, name: &str| {
        let cell = cells.get(column).ok_or_else(|| anyhow!("line {line}: column `{name}` is missing"))?;
        let value = cell.parse::<f64>().ok().filter(|value| value.abs() <= LARGEST);
        value.ok_or_else(|| {
            anyhow!("line {line}, column `{name}`: `{cell}` must be a number between -{LARGEST} and {LARGEST}")
        })
    };
    let mut values = [0.0; 4];
    for ((value, column), name) in values.iter_mut().zip(columns).zip(COLUMNS) {
        *value = number(column, name)?;
    }
    let [t, x, y, z] = values;
    let yaw = yaw.map_or(Ok(0.0), |column| number(column, YAW))?;
    Ok(Row { line, t, value: [x, y, z, yaw] })
}

/// A row as it follows another: later, and with the yaw that is nearest to the other's.
fn after(last: Option<&Row>, mut row: Row) -> Result<Row> {
    if let Some(last) = last {
        let (line, t, before) = (row.line, row.t, last.t);
        ensure!(t > before, "line {line}, column `t_s`: {t} must be later than {before} in line {}", last.line);
        row.value[3] = nearest(row.value[3], last.value[3]);
    }
    Ok(row)
}

/// The angle that differs from `angle` by whole turns and is nearest to `to`, rad.
pub(super) fn nearest(angle: f64, to: f64) -> f64 {
    let turn = std::f64::consts::TAU;
    angle - turn * ((angle - to) / turn).round()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn columns_are_found_by_name_and_yaw_is_unwrapped() {
        let text =
            "z_m, t_s,x_m,y_m,q,yaw_rad\n2,0,1,5,9,3.1\n\n2,0.1,1,5,9,-3.1\n2,0.2,1,5,9,-3.0\n2,0.3,1,5,9,-2.9\n";
        let rows = rows(text).expect("valid");
        assert_eq!((rows[0].line, rows[0].t, rows[0].value), (2, 0.0, [1.0, 5.0, 2.0, 3.1]));
        assert_eq!(rows[1].line, 4);
        assert!((rows[3].value[3] - 3.383_185).abs() < 1e-6, "{:?}", rows[3]);
    }

    #[test]
    fn a_file_of_a_spreadsheet_reads_like_a_plain_one() {
        let plain = "t_s,x_m,y_m,z_m\n0,0,0,2\n1,0,0,2\n2,0,0,3\n3,0,0,3\n";
        let expected = rows(plain).expect("valid");
        for ending in ["\r\n", "\r"] {
            let text = format!("\u{feff}{}", plain.replace('\n', ending));
            assert_eq!(rows(&text).expect("valid"), expected, "{ending:?}");
        }
        assert_eq!(rows(&plain.replace('\n', ",,\n")).expect("empty columns at the end are none"), expected);
    }

    #[test]
    fn what_is_wrong_is_named_with_line_and_column() {
        let header = "t_s,x_m,y_m,z_m,yaw_rad\n0,0,0,2,0\n";
        for (text, error) in [
            (String::new(), "it is empty: the first line names the columns"),
            ("t_s,x_m,y_m,z_m,yaw_deg\n".to_owned(), "line 1: column `yaw_deg`: yaw is given in radians, as `yaw_rad`"),
            (
                "t,x,y,z\n".to_owned(),
                "line 1: no column `t_s` in `t,x,y,z`: it must have t_s, x_m, y_m, z_m, and may have yaw_rad",
            ),
            (format!("{header}0.1,0,up,2,0\n"), "line 3, column `y_m`: `up` must be a number between -10000 and 10000"),
            (
                format!("{header}0.1,nan,0,2,0\n"),
                "line 3, column `x_m`: `nan` must be a number between -10000 and 10000",
            ),
            (format!("{header}0.1,0,0\n"), "line 3: column `z_m` is missing"),
            (format!("{header}0,0,0,2,0\n"), "line 3, column `t_s`: 0 must be later than 0 in line 2"),
            (header.to_owned(), "it must have 4 rows or more below the columns' names, not 1"),
            (
                "t_s;x_m;y_m;z_m\n0;0;0;2\n".to_owned(),
                "line 1: columns are separated by `;`: separate them by commas, and write decimals with a point",
            ),
            (
                "\nt_s\tx_m\ty_m\tz_m\n".to_owned(),
                "line 2: columns are separated by tabs: separate them by commas, and write decimals with a point",
            ),
            (
                format!("{header}0,1,0,0,2,0,0\n"),
                "line 3: 7 values for 5 columns: write decimals with a point, and name every column in line 1",
            ),
        ] {
            assert_eq!(rows(&text).expect_err("refused").to_string(), error);
        }
    }
}

//! Complaints: one line on standard error each, as a terminal can show it.

use std::io::Write as _;
use std::process::ExitCode;

use clap::CommandFactory as _;
use clap::error::{ContextKind, ContextValue, ErrorKind};

use super::{Cli, names};
use crate::refusal::did_you_mean;
use crate::words::printable;

/// Help and version as clap prints them; its complaints, which take several lines, in one.
pub(super) fn refuse(error: &clap::Error) -> ExitCode {
    if !error.use_stderr() {
        let _ = error.print();
        return ExitCode::SUCCESS;
    }
    let text = error.to_string();
    let (complaint, tip) = complaint(&text);
    let tip = misplaced_name(error)
        .or(tip)
        .or_else(|| misplaced_setting(error))
        .or_else(|| meant_command(error))
        .map_or(String::new(), |tip| format!(": {tip}"));
    complain(&format!("{complaint}{tip} (see --help)"));
    ExitCode::from(2)
}

/// What clap complains of in its first paragraph, and the tip that may follow it.
fn complaint(text: &str) -> (String, Option<String>) {
    let before_usage = text.split("Usage:").next().unwrap_or(text);
    let lines = || before_usage.lines().map(str::trim);
    let complaint = lines().take_while(|line| !line.is_empty()).collect::<Vec<_>>().join(" ");
    // "To pass '-1' as a value, use '-- -1'" helps nobody here: no argument begins with a dash.
    let tips = lines().filter_map(|line| line.strip_prefix("tip: "));
    let tip = tips.filter(|tip| !tip.starts_with("to pass")).map(str::to_owned).next();
    (complaint.trim_start_matches("error: ").to_owned(), tip)
}

/// `sim-host helix` means `sim-host run helix`.
fn misplaced_name(error: &clap::Error) -> Option<String> {
    let Some(ContextValue::String(word)) = error.get(ContextKind::InvalidSubcommand) else { return None };
    names::meant(word).map(|meant| format!("it is {meant}"))
}

/// What an argument that there is not may have meant: a key of a scenario, or the rest of a setting.
fn misplaced_setting(error: &clap::Error) -> Option<String> {
    // A value out of its range has the name of its argument here too.
    if error.kind() != ErrorKind::UnknownArgument {
        return None;
    }
    let Some(ContextValue::String(word)) = error.get(ContextKind::InvalidArg) else { return None };
    let given = |name: &str| std::env::args().any(|argument| argument == name);
    let of = |name: &str| std::env::args().nth(1).is_some_and(|command| command == name);
    let (of_paper, is_serve) = (of("paper"), of("serve"));
    let remedy = match word.as_str() {
        "--set" | "--seed" if of_paper => {
            "`paper` flies the paper's own numbers; fly others as `sim-host run paper-ideal --set KEY=VALUE --out DIR`"
        }
        "--duration" => "set the scenario's: --set duration_s=5",
        "-o" | "--output" => "use --out DIR",
        "--out" if is_serve => {
            "record the flight by --record FILE, and fly it again by `run SCENARIO --replay FILE --out DIR`"
        }
        flag if flag.starts_with("--") => "keys of a scenario are set by --set KEY=VALUE",
        word if word.contains('=') && !given("--set") => "put --set before it",
        word if !word.starts_with('-') && given("--set") => {
            "a setting is one word, in quotes if it has spaces, braces or quotes: --set 'KEY=VALUE'"
        }
        _ => return None,
    };
    Some(remedy.to_owned())
}

/// The command that an unknown one may have meant, or all.
fn meant_command(error: &clap::Error) -> Option<String> {
    let Some(ContextValue::String(word)) = error.get(ContextKind::InvalidSubcommand) else { return None };
    let cli = Cli::command();
    let names: Vec<&str> = cli.get_subcommands().map(clap::Command::get_name).collect();
    Some(did_you_mean(word, &names))
}

/// Writes a line to standard error. If nobody can read it, the exit code still tells.
pub(super) fn complain(line: &str) {
    let _ = writeln!(std::io::stderr(), "sim-host: {}", printable(line));
}

/// Writes what is no complaint to standard error. That nobody can read it ends nothing.
pub(super) fn tell(text: &str) {
    let _ = writeln!(std::io::stderr(), "{}", text.trim_end());
}

/// An error with its causes, in a line.
pub(super) fn one_line(error: &anyhow::Error) -> String {
    // The system's number of an error, "(os error 2)", tells nobody more than its text does.
    let text = format!("{error:#}").replace('\n', " ");
    let mut pieces = text.split(" (os error ");
    let first = pieces.next().unwrap_or_default().to_owned();
    printable(&pieces.fold(first, |text, piece| text + piece.split_once(')').map_or("", |(_, rest)| rest)))
}

#[cfg(test)]
mod tests {
    use clap::Parser as _;

    use super::*;

    #[test]
    fn a_complaint_keeps_its_tip() {
        let refused = |arguments: &[&str]| complaint(&Cli::try_parse_from(arguments).expect_err("refused").to_string());
        let (text, tip) = refused(&["sim-host", "asses"]);
        assert!(text.contains("'asses'") && tip.is_some_and(|tip| tip.contains("'assess'")), "{text}");
        let (text, tip) = refused(&["sim-host", "run"]);
        assert!(text.contains("<SCENARIO>") && tip.is_none(), "{text}");
    }
}

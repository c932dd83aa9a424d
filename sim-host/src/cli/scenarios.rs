//! `scenarios`: what can be flown by name.

use std::fmt::Write as _;

use anyhow::Result;

use crate::scenario::{self, Group, Listed};

/// The groups in the order in which they are listed, and what stands above each.
const GROUPS: [(Group, &str); 3] = [
    (Group::OnSensors, "on sensors: the vehicle knows what it measures"),
    (Group::IdealState, "ideal state: the vehicle is given its true motion"),
    (Group::Paper, "the paper: its own equations"),
];

pub(super) fn run(as_json: bool) -> Result<()> {
    let list = scenario::list()?;
    super::say(&if as_json { serde_json::to_string(&list)? } else { grouped(&list) })
}

fn grouped(list: &[Listed]) -> String {
    let width = list.iter().map(|listed| listed.name.len()).max().unwrap_or(0);
    let mut text = String::new();
    for (group, heading) in GROUPS {
        let _ = writeln!(text, "{heading}");
        for Listed { name, summary, .. } in list.iter().filter(|listed| listed.group == group) {
            let _ = writeln!(text, "  {name:width$}  {summary}");
        }
        text.push('\n');
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_scenario_stands_once_under_its_group() {
        let list = scenario::list().expect("all load");
        let text = grouped(&list);
        let mut group = None;
        let mut seen = 0;
        for line in text.lines().filter(|line| !line.is_empty()) {
            if let Some(name) = line.strip_prefix("  ").and_then(|line| line.split_whitespace().next()) {
                let listed = list.iter().find(|listed| listed.name == name).expect("one of the list");
                assert_eq!(Some(listed.group), group, "{name}");
                seen += 1;
            } else {
                group = GROUPS.iter().find(|(_, heading)| *heading == line).map(|(group, _)| *group);
            }
        }
        assert_eq!(seen, list.len());
    }
}

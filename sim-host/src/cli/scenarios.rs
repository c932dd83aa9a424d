//! `scenarios`: what can be flown by name.

use anyhow::Result;
use serde_json::json;

use crate::scenario;

pub(super) fn run(as_json: bool) -> Result<()> {
    let list = scenario::list()?;
    if as_json {
        let all: Vec<_> = list.iter().map(|(name, summary)| json!({ "name": name, "summary": summary })).collect();
        return super::say(&serde_json::Value::from(all).to_string());
    }
    let width = list.iter().map(|(name, _)| name.len()).max().unwrap_or(0);
    let lines: Vec<_> = list.iter().map(|(name, summary)| format!("{name:width$}  {summary}")).collect();
    super::say(&lines.join("\n"))
}

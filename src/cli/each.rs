//! `--each`: the same command for every study of a folder, one table out. A test rig's archive is looked through so.

use std::path::{Path, PathBuf};

use serde_json::{Value, json};

use super::{CliError, Context, Outcome, folder};
use crate::report::{Staging, atomic};

/// A column of the table: its name, and its value in a study's document.
pub(super) type Column = (&'static str, fn(&Value) -> Value);

/// Does `one` for each study in `home` (its path and where its results go) and writes a table of `columns` of their documents.
///
/// A study that fails is a row with its reason, and the exit code is 1.
///
/// # Errors
/// [`CliError`] if there are no studies, or the table's folder cannot be used.
pub(super) fn each(
    home: &Path,
    output: Option<&Path>,
    command: &'static str,
    columns: &[Column],
    context: &Context,
    one: impl Fn(&Path, &Path) -> Result<Outcome, CliError>,
) -> Result<Outcome, CliError> {
    if !home.is_dir() {
        return Err(CliError::Unusable(format!(
            "--each {}: no such folder; name one that holds studies",
            home.display()
        )));
    }
    let studies = studies(home)?;
    if studies.is_empty() {
        return Err(CliError::Unusable(format!(
            "--each {}: no study in it; studies are NAME.toml in the folder, or NAME/study.toml below it",
            home.display()
        )));
    }
    let target = output.map_or_else(|| default(home, command), Path::to_path_buf);
    atomic::check(&target)?;
    let mut rows = Vec::new();
    for (i, study) in studies.iter().enumerate() {
        let name = study
            .strip_prefix(home)
            .unwrap_or(study)
            .display()
            .to_string();
        context.tell(&format!("{} of {}: {name}", i + 1, studies.len()));
        let outcome = one(study, &folder::default_path(study, command));
        rows.push(row(name, outcome, columns));
    }
    let failures = rows.iter().filter(|row| !row["error"].is_null()).count();
    let table = table(&rows, columns);
    let document = json!(rows);
    let mut staging = Staging::begin(&target)?;
    staging.write("each.csv", csv(&table).as_bytes())?;
    staging.write(
        "each.json",
        &crate::report::json::text("each.json", &document)?,
    )?;
    let folder = staging.commit()?;
    let mut text = String::new();
    for line in &table {
        text += &format!("  {}\n", line.join("  ").trim_end());
    }
    if failures > 0 {
        text += &format!("{failures} of {} studies failed\n", studies.len());
    }
    text += &format!(
        "Written to {}\n  each.csv, each.json; each study's own results beside it\n",
        folder.display()
    );
    Ok(Outcome {
        json: document,
        text,
        success: failures == 0,
    })
}

/// The values of the columns for a study, or why it has none.
fn row(name: String, outcome: Result<Outcome, CliError>, columns: &[Column]) -> Value {
    let mut row = json!({"study": name});
    match outcome {
        Ok(outcome) => {
            for (column, of) in columns {
                row[*column] = of(&outcome.json);
            }
            row["error"] = Value::Null;
        }
        Err(error) => {
            for (column, _) in columns {
                row[*column] = Value::Null;
            }
            row["error"] = json!(reason(&error));
        }
    }
    row
}

/// The rows as texts below a header.
fn table(rows: &[Value], columns: &[Column]) -> Vec<Vec<String>> {
    let names = columns.iter().map(|(name, _)| *name);
    let names: Vec<&str> = std::iter::once("study")
        .chain(names)
        .chain(["error"])
        .collect();
    let head = names.iter().map(|&name| name.to_owned()).collect();
    let line = |row: &Value| names.iter().map(|&name| cell(&row[name])).collect();
    std::iter::once(head).chain(rows.iter().map(line)).collect()
}

fn csv(table: &[Vec<String>]) -> String {
    let mut text = String::new();
    for line in table {
        let quoted: Vec<String> = line.iter().map(|cell| quoted(cell)).collect();
        text += &(quoted.join(",") + "\n");
    }
    text
}

/// `NAME.toml` in the folder and `NAME/study.toml` below it, by name.
fn studies(home: &Path) -> Result<Vec<PathBuf>, CliError> {
    let entries = std::fs::read_dir(home).map_err(|source| CliError::Io {
        doing: "read",
        path: home.to_owned(),
        source,
    })?;
    let mut found: Vec<PathBuf> = entries
        .flatten()
        .map(|entry| entry.path())
        .filter_map(|path| {
            if path.is_file() {
                return path
                    .extension()
                    .is_some_and(|e| e == "toml")
                    .then_some(path);
            }
            Some(path.join("study.toml")).filter(|study| study.is_file())
        })
        .collect();
    found.sort();
    Ok(found)
}

/// `FOLDER.out/COMMAND-each` beside the folder.
fn default(home: &Path, command: &str) -> PathBuf {
    let home = home.canonicalize().unwrap_or_else(|_| home.to_owned());
    let mut name = home.file_name().unwrap_or_default().to_owned();
    name.push(".out");
    home.with_file_name(name).join(format!("{command}-each"))
}

/// The first lines of a message as one.
fn reason(error: &CliError) -> String {
    let text = error.render(false);
    let text = text.strip_prefix("error: ").unwrap_or(&text);
    text.lines().next().unwrap_or_default().to_owned()
}

/// `name = value ± sigma`, one after the other.
pub(super) fn parameters(list: &Value) -> Value {
    let each = list.as_array().into_iter().flatten().map(|parameter| {
        let text = |key: &str| cell(&parameter[key]);
        match parameter["sigma"].is_null() {
            true => format!("{} = {}", text("name"), text("value")),
            false => format!("{} = {} ± {}", text("name"), text("value"), text("sigma")),
        }
    });
    json!(each.collect::<Vec<_>>().join("; "))
}

/// Names joined by a plus.
pub(super) fn joined(names: &Value) -> Value {
    match names.as_array() {
        Some(list) => json!(list.iter().map(cell).collect::<Vec<_>>().join("+")),
        None => names.clone(),
    }
}

fn cell(value: &Value) -> String {
    match value {
        Value::Null => String::new(),
        Value::String(text) => text.clone(),
        other => other.to_string(),
    }
}

fn quoted(text: &str) -> String {
    if text.contains([',', '"', '\n']) {
        format!("\"{}\"", text.replace('"', "\"\"").replace('\n', " "))
    } else {
        text.to_owned()
    }
}

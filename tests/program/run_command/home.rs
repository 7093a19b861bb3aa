//! A folder with a coarse study in it, the program started there, and its files read back.
use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::LazyLock;

use serde_json::Value;
use tempfile::TempDir;

use crate::common::{self, gears};

/// The gears of the paper's study at a resolution of about a second; one line per key, so that tests can replace lines.
pub(crate) const STUDY: &str = concat!(
    "title = \"coarse\"\n",
    gears!("centre_distance = 80.0\n"),
    r#"[lubricant]
friction_coefficient = 0.06
[operation]
torque = 100.0
speed = 2000.0
misalignment = 0.0
[wear]
coefficient = 6e-10
cycles = 50000
[model]
contact = "fem"
[numerics]
order = 1
elements_per_half_width = 2
positions = 30
stored_states = 2
fields = 1
"#
);

/// [`STUDY`] with some keys' values replaced; a key that it does not have is appended to `[numerics]`.
pub(crate) fn study_with(values: &[(&str, &str)]) -> String {
    let mut text = STUDY.to_owned();
    for (key, value) in values {
        let line = |l: &str| l.split(" =").next() == Some(key);
        if text.lines().any(line) {
            let new: Vec<String> = text
                .lines()
                .map(|l| {
                    if line(l) {
                        format!("{key} = {value}")
                    } else {
                        l.to_owned()
                    }
                })
                .collect();
            text = new.join("\n") + "\n";
        } else {
            text.push_str(&format!("{key} = {value}\n"));
        }
    }
    text
}

/// A fresh folder with a `study.toml`.
pub(crate) struct Home(TempDir);

/// What the program answered.
pub(crate) struct Answer {
    pub(crate) code: Option<i32>,
    pub(crate) out: String,
    pub(crate) err: String,
}

impl Home {
    pub(crate) fn with(values: &[(&str, &str)]) -> Self {
        let home = Self(tempfile::tempdir().unwrap());
        home.write("study.toml", &study_with(values));
        home
    }

    pub(crate) fn path(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    pub(crate) fn write(&self, name: &str, text: &str) {
        fs::write(self.path(name), text).unwrap();
    }

    /// Starts the program here with these arguments, separated by blanks.
    pub(crate) fn gearwear(&self, arguments: &str) -> Answer {
        let (code, out, err) = common::line(self.0.path(), arguments);
        Answer { code, out, err }
    }

    /// As [`Home::gearwear`], and it has to succeed.
    pub(crate) fn succeed(&self, arguments: &str) -> Answer {
        let answer = self.gearwear(arguments);
        assert_eq!(answer.code, Some(0), "{arguments}: {}", answer.err);
        answer
    }

    /// The result folder `name`.
    pub(crate) fn result(&self, name: &str) -> Folder {
        Folder(self.path(name))
    }

    /// Names of everything below, sorted.
    pub(crate) fn tree(&self) -> Vec<String> {
        tree(self.0.path())
    }
}

/// Names of everything below `folder`, relative, sorted.
pub(crate) fn tree(folder: &Path) -> Vec<String> {
    fn walk(folder: &Path, root: &Path, found: &mut Vec<String>) {
        for entry in fs::read_dir(folder).unwrap() {
            let path = entry.unwrap().path();
            found.push(
                path.strip_prefix(root)
                    .unwrap()
                    .to_string_lossy()
                    .into_owned(),
            );
            if path.is_dir() {
                walk(&path, root, found);
            }
        }
    }
    let mut found = Vec::new();
    walk(folder, folder, &mut found);
    found.sort();
    found
}

/// A result folder.
pub(crate) struct Folder(pub(crate) PathBuf);

impl Folder {
    pub(crate) fn text(&self, name: &str) -> String {
        fs::read_to_string(self.0.join(name)).unwrap_or_else(|e| panic!("{name}: {e}"))
    }

    pub(crate) fn summary(&self) -> Value {
        serde_json::from_str(&self.text("summary.json")).unwrap()
    }

    pub(crate) fn table(&self, name: &str) -> Table {
        Table::read(&self.text(name))
    }

    /// All files by name.
    pub(crate) fn files(&self) -> BTreeMap<String, Vec<u8>> {
        tree(&self.0)
            .into_iter()
            .filter(|name| self.0.join(name).is_file())
            .map(|name| {
                let bytes = fs::read(self.0.join(&name)).unwrap();
                (name, bytes)
            })
            .collect()
    }
}

/// A number in a JSON document, by pointer.
pub(crate) fn number(document: &Value, place: &str) -> f64 {
    document
        .pointer(place)
        .and_then(Value::as_f64)
        .unwrap_or_else(|| panic!("{place} is {:?}", document.pointer(place)))
}

/// A table of a CSV file, texts as they stand.
pub(crate) struct Table {
    pub(crate) header: Vec<String>,
    rows: Vec<Vec<String>>,
}

impl Table {
    fn read(text: &str) -> Self {
        let mut lines = text
            .lines()
            .map(|l| l.split(',').map(str::to_owned).collect::<Vec<_>>());
        let header = lines.next().unwrap();
        let rows: Vec<_> = lines.collect();
        assert!(rows.iter().all(|row| row.len() == header.len()));
        Self { header, rows }
    }

    fn index(&self, name: &str) -> usize {
        self.header
            .iter()
            .position(|h| h == name)
            .unwrap_or_else(|| panic!("no column {name}"))
    }

    pub(crate) fn texts(&self, name: &str) -> Vec<&str> {
        let at = self.index(name);
        self.rows.iter().map(|row| row[at].as_str()).collect()
    }

    pub(crate) fn numbers(&self, name: &str) -> Vec<f64> {
        self.texts(name)
            .iter()
            .map(|t| t.parse().unwrap())
            .collect()
    }

    /// The rows in which a column reads so.
    pub(crate) fn only(&self, name: &str, value: &str) -> Self {
        let at = self.index(name);
        let rows = self.rows.iter().filter(|row| row[at] == value);
        Self {
            header: self.header.clone(),
            rows: rows.cloned().collect(),
        }
    }

    /// The rows in which a column's number is such.
    pub(crate) fn only_where(&self, name: &str, wanted: impl Fn(f64) -> bool) -> Self {
        let at = self.index(name);
        let rows = self
            .rows
            .iter()
            .filter(|row| wanted(row[at].parse().unwrap()));
        Self {
            header: self.header.clone(),
            rows: rows.cloned().collect(),
        }
    }

    /// Rows with all the load on one pair.
    pub(crate) fn single(&self) -> Self {
        self.only_where("load_share", |share| (share - 1.0).abs() < 1e-9)
    }

    /// Different texts of a column in the order they first stand.
    pub(crate) fn distinct(&self, name: &str) -> Vec<&str> {
        let mut found = Vec::new();
        for text in self.texts(name) {
            if !found.contains(&text) {
                found.push(text);
            }
        }
        found
    }

    pub(crate) fn len(&self) -> usize {
        self.rows.len()
    }
}

/// The finished run of [`STUDY`] that several tests read.
pub(crate) static FEM: LazyLock<Home> = LazyLock::new(|| {
    let home = Home::with(&[]);
    home.succeed("run study.toml -o run --threads 1 --quiet");
    home
});

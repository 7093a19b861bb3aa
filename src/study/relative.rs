//! The same file named from another folder.

use std::path::{Component, Path, PathBuf};

/// A path relative to the folder `from`, as it is named from the folder `to`; `None` if it stays as it is: both are the same
/// folder, or the path does not depend on one. Where no relative name exists (another drive) it becomes absolute.
pub(super) fn moved(path: &Path, from: &Path, to: &Path) -> Option<PathBuf> {
    if path.is_absolute() {
        return None;
    }
    let (mut from, to) = (resolved(from)?, resolved(to)?);
    if from == to {
        return None;
    }
    // links are resolved, so that going up is what it says
    let mut rest = path.components().peekable();
    while let Some(Component::ParentDir | Component::CurDir) = rest.peek() {
        if rest.next() == Some(Component::ParentDir) && !from.pop() {
            return None;
        }
    }
    let target = from.join(rest.collect::<PathBuf>());
    let (a, b): (Vec<_>, Vec<_>) = (target.components().collect(), to.components().collect());
    let common = a.iter().zip(&b).take_while(|(x, y)| x == y).count();
    if common == 0 {
        return Some(target);
    }
    let up = std::iter::repeat_n(Component::ParentDir, b.len() - common);
    Some(up.chain(a[common..].iter().copied()).collect())
}

/// A file as it is named from `folder`. Going up from a folder that is still to be made is leaving off its name.
pub(super) fn joined(folder: &Path, file: &Path) -> PathBuf {
    let path = folder.join(file);
    if folder.as_os_str().is_empty() || folder.is_dir() {
        return path;
    }
    let mut plain = PathBuf::new();
    for part in path.components() {
        let up = part == Component::ParentDir && plain.file_name().is_some();
        if !(up && plain.pop()) {
            plain.push(part);
        }
    }
    plain
}

/// The folder without links; the part that does not exist yet as it is written.
fn resolved(folder: &Path) -> Option<PathBuf> {
    let absolute = std::path::absolute(if folder.as_os_str().is_empty() {
        Path::new(".")
    } else {
        folder
    })
    .ok()?;
    let mut missing = Vec::new();
    for above in absolute.ancestors() {
        if let Ok(real) = above.canonicalize() {
            return Some(
                missing
                    .iter()
                    .rev()
                    .fold(real, |path, name| path.join(name)),
            );
        }
        missing.push(above.file_name()?.to_owned());
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_is_found_from_a_folder_to_be_made() {
        let joined = |folder: &str, file: &str| joined(Path::new(folder), Path::new(file));
        assert_eq!(joined("not/there", "../p.csv"), Path::new("not/p.csv"));
        assert_eq!(joined("not/there", "../../../p.csv"), Path::new("../p.csv"));
        assert_eq!(joined("src", "../p.csv"), Path::new("src/../p.csv"));
        assert_eq!(joined("", "../p.csv"), Path::new("../p.csv"));
    }

    #[test]
    fn a_file_keeps_its_place_when_the_study_moves() {
        let home = tempfile::tempdir().unwrap();
        let at = |name: &str| home.path().join(name);
        std::fs::create_dir_all(at("a/deep")).unwrap();
        let cases = [
            ("m.csv", "a", "a/deep", Some("../m.csv")),
            ("m.csv", "a", "b", Some("../a/m.csv")),
            ("m.csv", "a", "b/new", Some("../../a/m.csv")),
            ("../m.csv", "a", "a/deep", Some("../../m.csv")),
            ("./deep/m.csv", "a", "a/deep", Some("m.csv")),
            ("m.csv", "a/deep", "a", Some("deep/m.csv")),
            ("m.csv", "a", "a", None),
            ("m.csv", "a", "a/deep/..", None),
            ("/m.csv", "a", "b", None),
        ];
        for (path, from, to, expected) in cases {
            let found = moved(Path::new(path), &at(from), &at(to));
            assert_eq!(
                found.as_deref(),
                expected.map(Path::new),
                "{path} from {from} to {to}"
            );
        }
    }
}

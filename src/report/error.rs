//! What can go wrong while results are written.
use std::path::PathBuf;

/// Why results could not be written. Nothing stands under the final name when one of these comes back.
#[derive(Debug, thiserror::Error)]
pub enum OutputError {
    /// The target folder holds files that no earlier run of this program wrote.
    #[error("{} is not a result folder of gearwear and is not empty (it holds {found}); choose another folder with -o or empty this one", folder.display())]
    Foreign {
        /// The folder.
        folder: PathBuf,
        /// One of the entries found.
        found: String,
    },
    /// The target exists and is not a folder.
    #[error("{} exists and is not a folder; choose another with -o", path.display())]
    NotAFolder {
        /// The path.
        path: PathBuf,
    },
    /// The target has no name of its own, such as `/` or `..`.
    #[error("{} cannot be used as a result folder: it has no name of its own", path.display())]
    Nameless {
        /// The path.
        path: PathBuf,
    },
    /// Another program computes what it will put there.
    #[error("{} is being written by another run of gearwear; wait for its end or choose another folder with -o", folder.display())]
    Taken {
        /// The folder.
        folder: PathBuf,
    },
    /// Too many programs write to the same folder, or too many dead partial folders could not be removed.
    #[error("{} is being written by too many other runs (hidden folders .NAME.partial-N beside it)", folder.display())]
    Busy {
        /// The folder.
        folder: PathBuf,
    },
    /// A name that would leave the result folder.
    #[error("file name {name:?} leads out of the result folder")]
    OutsideFolder {
        /// The name.
        name: String,
    },
    /// The operating system refused.
    #[error("cannot {action} {}: {source}", path.display())]
    Io {
        /// What was tried, as a verb phrase.
        action: &'static str,
        /// On which path.
        path: PathBuf,
        /// What the system said.
        source: std::io::Error,
    },
    /// A result that is not a number must not reach a file.
    #[error("{file}: {what} is {value}, not a finite number")]
    NotFinite {
        /// The file it was meant for.
        file: String,
        /// Which figure.
        what: String,
        /// The value.
        value: f64,
    },
    /// Columns of one table differ in length.
    #[error("{file}: {what} has {found} entries, expected {expected}")]
    Length {
        /// The file it was meant for.
        file: String,
        /// Which column.
        what: String,
        /// Its length.
        found: usize,
        /// The length it should have.
        expected: usize,
    },
    /// The VTK library refused.
    #[error("{file}: {message}")]
    Vtk {
        /// The file.
        file: String,
        /// What the library said.
        message: String,
    },
    /// The plotting library refused.
    #[error("plot {title:?}: {message}")]
    Plot {
        /// The plot.
        title: String,
        /// What the library said.
        message: String,
    },
    /// JSON could not be formed.
    #[error("{file}: {source}")]
    Json {
        /// The file.
        file: String,
        /// What the library said.
        source: serde_json::Error,
    },
}

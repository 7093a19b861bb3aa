//! What an interrupted run needs to go on, as bytes; reading and writing files is left to the caller.

use sha2::{Digest, Sha256};

use crate::simulate::forward::Preparation;
use crate::simulate::history::Progress;

/// A run's state after a wear step.
#[derive(Debug, Clone, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct Checkpoint {
    /// How the contact was prepared.
    pub preparation: Preparation,
    /// The integration.
    pub progress: Option<Progress>,
    /// States stored so far.
    pub stored: Vec<Stored>,
}

/// A stored state: its contact is solved again from it, prepared as it was then.
#[derive(Debug, Clone, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct Stored {
    /// How the contact was prepared.
    pub preparation: Preparation,
    /// The integration.
    pub progress: Progress,
}

/// Why a checkpoint cannot be used.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum CheckpointError {
    /// Truncated, damaged or of another format.
    #[error("the checkpoint is damaged or was written by another version")]
    Damaged,
    /// It belongs to other input.
    #[error("the checkpoint belongs to another study, test or resolution")]
    OtherRun,
}

/// Fingerprint of everything a run's results depend on.
pub type Fingerprint = [u8; 32];

/// Changes with the layout of [`Checkpoint`].
const FORMAT: &[u8; 8] = b"gwcheck3";

/// Fingerprint of the given contents and of this program's version.
pub fn fingerprint(parts: &[&[u8]]) -> Fingerprint {
    let mut hash = Sha256::new();
    hash.update(env!("CARGO_PKG_VERSION"));
    for part in parts {
        hash.update((part.len() as u64).to_le_bytes());
        hash.update(part);
    }
    hash.finalize().into()
}

/// A checkpoint's body behind what says of which run and how whole it is.
pub fn seal(body: &[u8], run: &Fingerprint) -> Vec<u8> {
    let sum: [u8; 32] = Sha256::digest(body).into();
    [&FORMAT[..], run, &sum, body].concat()
}

impl Checkpoint {
    /// The checkpoint as bytes: format, fingerprint, checksum of the body, body.
    pub fn to_bytes(&self, run: &Fingerprint) -> Vec<u8> {
        let body = postcard::to_stdvec(self).expect("plain numbers always serialise to memory");
        seal(&body, run)
    }

    /// Reads a checkpoint of the run with this fingerprint.
    ///
    /// # Errors
    /// [`CheckpointError`].
    pub fn from_bytes(bytes: &[u8], run: &Fingerprint) -> Result<Self, CheckpointError> {
        let rest = bytes
            .strip_prefix(&FORMAT[..])
            .ok_or(CheckpointError::Damaged)?;
        let (owner, rest) = rest.split_at_checked(32).ok_or(CheckpointError::Damaged)?;
        let (sum, body) = rest.split_at_checked(32).ok_or(CheckpointError::Damaged)?;
        if sum != Sha256::digest(body).as_slice() {
            return Err(CheckpointError::Damaged);
        }
        if owner != run {
            return Err(CheckpointError::OtherRun);
        }
        postcard::from_bytes(body).map_err(|_| CheckpointError::Damaged)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn survives_a_round_trip_and_nothing_else() {
        let run = fingerprint(&[b"study", b"test"]);
        let checkpoint = Checkpoint {
            preparation: Preparation {
                reach: 0.02,
                window: 0.25,
                condensed_at: Some(vec![1.0]),
                condensed_for: Some([0.25, 0.02]),
            },
            progress: None,
            stored: Vec::new(),
        };
        let bytes = checkpoint.to_bytes(&run);
        assert_eq!(Checkpoint::from_bytes(&bytes, &run).unwrap(), checkpoint);
        assert_eq!(
            Checkpoint::from_bytes(&bytes, &fingerprint(&[b"study", b"other"])),
            Err(CheckpointError::OtherRun)
        );
        for cut in 0..bytes.len() {
            assert_eq!(
                Checkpoint::from_bytes(&bytes[..cut], &run),
                Err(CheckpointError::Damaged)
            );
        }
        for flip in 0..bytes.len() {
            let mut damaged = bytes.clone();
            damaged[flip] ^= 1;
            assert!(Checkpoint::from_bytes(&damaged, &run).is_err());
        }
    }
}

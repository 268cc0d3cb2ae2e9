//! A file of results, so that an interrupted run goes on where it was.

use crate::files::sha256;
use anyhow::{Context, bail};
use pompeiu::core::request::hexadecimal;
use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};
use sha2::{Digest, Sha256};
use std::collections::BTreeMap;
use std::fs::{File, OpenOptions};
use std::io::{Read, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};

/// What the first line of a journal is, byte for byte.
const HEADER: &str = "{\"pompeiu_journal\":2}\n";

/// How the first line of a journal of any version begins.
const ANY_HEADER: &str = "{\"pompeiu_journal\":";

/// SHA-256 of the content of a file, and of those of other files that its mesh is made of.
pub(crate) type Fingerprint = String;

/// The fingerprint of a mesh file.
pub(crate) fn fingerprint(path: &Path) -> std::io::Result<Fingerprint> {
    let mut all: Fingerprint = sha256(path)?;
    for other in pompeiu::io::referenced_files(path) {
        // What is not there is told when the mesh is read; here it only differs from all that is.
        all = all + " " + &sha256(&other).unwrap_or_else(|error: std::io::Error| error.to_string());
    }
    Ok(all)
}

/// Results by what they depend on: the contents of the files, the options, the task and the version of the algorithm. A file
/// that has changed since has other keys, so that nothing stale is used. One journal may serve many runs.
///
/// A result is what the library serialises: a directed report for a pair of a matrix, an outcome for a task of a ranking. Results
/// that a limit cut short are not noted.
///
/// Each result is a line of JSON, written at once when it is there; what is torn at the end when a run is killed is dropped by the
/// next.
pub(crate) struct Journal {
    path: PathBuf,
    known: BTreeMap<String, serde_json::Value>,
    file: Mutex<File>,
}

#[derive(Serialize, Deserialize)]
struct Line<V> {
    key: String,
    result: V,
}

impl Journal {
    /// Opens a journal, or begins one.
    pub(crate) fn open(path: &Path) -> anyhow::Result<Self> {
        let shown = path.display();
        let mut file = OpenOptions::new()
            .read(true)
            .append(true)
            .create(true)
            .open(path)
            .with_context(|| format!("{shown}: the journal cannot be opened"))?;
        if file.try_lock().is_err() {
            bail!("{shown}: another run writes to this journal; wait for it or name another file");
        }
        let mut text = Vec::new();
        file.read_to_end(&mut text).with_context(|| format!("{shown}: the journal cannot be read"))?;
        let (known, whole) = parse(&text).with_context(|| shown.to_string())?;
        if whole < text.len() {
            file.set_len(whole as u64).with_context(|| format!("{shown}: its torn end cannot be dropped"))?;
        }
        file.seek(SeekFrom::End(0))?;
        if whole == 0 {
            file.write_all(HEADER.as_bytes()).with_context(|| format!("{shown}: cannot be written"))?;
        }
        Ok(Self { path: path.to_owned(), known, file: Mutex::new(file) })
    }

    /// Number of results that were there.
    pub(crate) fn len(&self) -> usize {
        self.known.len()
    }

    /// The key of a result that depends on all of this.
    pub(crate) fn key(parts: &impl Serialize) -> anyhow::Result<String> {
        let parts = serde_json::to_vec(&(env!("CARGO_PKG_VERSION"), pompeiu::matching::ALGORITHM, parts))?;
        let mut hasher = Sha256::new();
        hasher.update(&parts);
        Ok(hexadecimal(&hasher.finalize()))
    }

    /// A result that was there.
    pub(crate) fn get<V: DeserializeOwned>(&self, key: &str) -> Option<V> {
        serde_json::from_value(self.known.get(key)?.clone()).ok()
    }

    /// Adds a result.
    pub(crate) fn add(&self, key: String, result: &impl Serialize) -> anyhow::Result<()> {
        let line = serde_json::to_string(&Line { key, result })? + "\n";
        let mut file = self.file.lock().unwrap_or_else(PoisonError::into_inner);
        file.write_all(line.as_bytes())
            .and_then(|()| file.flush())
            .with_context(|| format!("{}: the journal cannot be written", self.path.display()))
    }
}

/// The results in a journal, and how many of its bytes are whole lines.
fn parse(text: &[u8]) -> anyhow::Result<(BTreeMap<String, serde_json::Value>, usize)> {
    let mut known = BTreeMap::new();
    if HEADER.as_bytes().starts_with(text) && text.len() < HEADER.len() {
        return Ok((known, 0));
    }
    let Some(lines) = text.strip_prefix(HEADER.as_bytes()) else {
        if text.starts_with(ANY_HEADER.as_bytes()) {
            bail!("is a journal of another version of this program, and is left as it is; name a new file");
        }
        bail!("is no journal of this program, and is left as it is; name a new file or a journal");
    };
    let mut whole = HEADER.len();
    for (number, line) in lines.split_inclusive(|byte| *byte == b'\n').enumerate() {
        match serde_json::from_slice::<Line<serde_json::Value>>(line) {
            Ok(entry) if line.ends_with(b"\n") => {
                known.insert(entry.key, entry.result);
                whole += line.len();
            }
            _ if whole + line.len() == text.len() => break,
            _ => bail!("line {} of the journal is damaged; remove that line or the file", number + 2),
        }
    }
    Ok((known, whole))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn results_come_back_bit_for_bit_and_torn_ends_are_dropped() {
        let folder = tempfile::TempDir::new().unwrap();
        let path = folder.path().join("journal");
        let values = [0.1 + 0.2, 1e-300, 5e-324, 0.0, f64::MAX, 1.0 / 3.0];
        let key = |i: usize| Journal::key(&("task", i)).unwrap();
        let journal = Journal::open(&path).unwrap();
        for (i, value) in values.iter().enumerate() {
            journal.add(key(i), value).unwrap();
        }
        assert!(Journal::open(&path).is_err(), "one run at a time");
        drop(journal);
        let whole = std::fs::read(&path).unwrap();
        for torn in 0..whole.len() {
            std::fs::write(&path, &whole[..torn]).unwrap();
            let journal = Journal::open(&path).unwrap();
            let lines = whole[..torn].split(|byte| *byte == b'\n').count() - 1;
            assert_eq!(journal.len(), lines.saturating_sub(1));
            for (i, value) in values.iter().enumerate() {
                let expected = (i + 1 < lines).then_some(value.to_bits());
                assert_eq!(journal.get::<f64>(&key(i)).map(f64::to_bits), expected);
            }
            journal.add(key(9), &7.0).unwrap();
            drop(journal);
            assert_eq!(Journal::open(&path).unwrap().get::<f64>(&key(9)), Some(7.0));
        }
    }

    #[test]
    fn other_files_are_left_alone() {
        let folder = tempfile::TempDir::new().unwrap();
        let path = folder.path().join("mesh.obj");
        for text in [
            "v 0 0 0\n",
            "{\"pompeiu_journal\":1}\n",
            "{\"pompeiu_journal\":2}\nx\n{\"key\":\"\",\"result\":1}\n",
        ] {
            std::fs::write(&path, text).unwrap();
            assert!(Journal::open(&path).is_err());
            assert_eq!(std::fs::read_to_string(&path).unwrap(), text);
        }
    }
}

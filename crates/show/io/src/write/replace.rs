//! A file appears whole or not at all.

use super::EncodeError;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};

/// Lets `fill` write a temporary file next to `path` and gives it that name once all is well.
///
/// A link is followed; anything at `path` that is not a file (a folder, a device) is left alone with an error. The
/// temporary file is removed on every error and panic; only a killed process can leave it behind.
pub(super) fn replace_file(
    path: &Path,
    fill: impl FnOnce(&mut fs::File) -> Result<(), EncodeError>,
) -> Result<(), EncodeError> {
    let path = destination(path)?;
    let folder = match path.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder,
        _ => Path::new("."),
    };
    let mut builder = tempfile::Builder::new();
    builder.prefix(".pompeiu-").suffix(".tmp");
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt;
        // The mode of any new file, of which the process's mask takes its part; without this only the owner may read.
        builder.permissions(fs::Permissions::from_mode(0o666));
    }
    let mut file = builder.tempfile_in(folder)?;
    fill(file.as_file_mut())?;
    file.persist(&path).map_err(|failure| failure.error)?;
    Ok(())
}

fn destination(path: &Path) -> io::Result<PathBuf> {
    match fs::canonicalize(path) {
        Ok(target) if target.is_file() => Ok(target),
        Ok(target) if target.is_dir() => Err(io::ErrorKind::IsADirectory.into()),
        Ok(_) => Err(io::Error::other("exists and is not a regular file")),
        Err(_) => Ok(path.to_owned()),
    }
}

//! Atomic replacement of files.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};

/// Lets `fill` write a temporary file next to `path`, and renames it when all has succeeded.
///
/// Links are followed. If `path` is not a regular file (a folder, a device), it is left unchanged and an error is returned. The
/// temporary file is removed on every error and panic. On Linux, if the file system supports it, the file has no name while it is
/// written, so that the system removes it even when the process is killed.
pub(super) fn replace_file<R, E: From<io::Error>>(
    path: &Path,
    fill: impl FnOnce(&mut fs::File) -> Result<R, E>,
) -> Result<R, E> {
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
        // The usual permissions of a new file, restricted by the process's umask; without this only the owner may read it.
        builder.permissions(fs::Permissions::from_mode(0o666));
    }
    #[cfg(target_os = "linux")]
    if let Some(mut file) = unnamed::file(folder) {
        let filled = fill(&mut file)?;
        builder
            .make_in(folder, |name| unnamed::give_name(&file, name))?
            .persist(&path)
            .map_err(|failure| failure.error)?;
        return Ok(filled);
    }
    let mut file = builder.tempfile_in(folder)?;
    let filled = fill(file.as_file_mut())?;
    file.persist(&path).map_err(|failure| failure.error)?;
    Ok(filled)
}

/// Files that have no name until they are complete.
#[cfg(target_os = "linux")]
mod unnamed {
    use rustix::fs::{AtFlags, CWD, Mode, OFlags, linkat, open};
    use std::fs::File;
    use std::io;
    use std::os::fd::AsRawFd;
    use std::path::{Path, PathBuf};

    /// Names of the open files of this process, through which a file without a name is linked.
    const OPEN_FILES: &str = "/proc/self/fd";

    /// A nameless file in a folder; `None` if the file system does not support them.
    pub(super) fn file(folder: &Path) -> Option<File> {
        let flags = OFlags::TMPFILE | OFlags::RDWR | OFlags::CLOEXEC;
        let mode = Mode::from_raw_mode(0o666);
        Path::new(OPEN_FILES).is_dir().then(|| open(folder, flags, mode).ok().map(File::from)).flatten()
    }

    /// Gives the file its name.
    pub(super) fn give_name(file: &File, name: &Path) -> io::Result<()> {
        let opened: PathBuf = Path::new(OPEN_FILES).join(file.as_raw_fd().to_string());
        Ok(linkat(CWD, &opened, CWD, name, AtFlags::SYMLINK_FOLLOW)?)
    }
}

fn destination(path: &Path) -> io::Result<PathBuf> {
    match fs::canonicalize(path) {
        Ok(target) if target.is_file() => Ok(target),
        Ok(target) if target.is_dir() => Err(io::ErrorKind::IsADirectory.into()),
        Ok(_) => Err(io::Error::other("exists and is not a regular file")),
        Err(_) => Ok(path.to_owned()),
    }
}

#[cfg(all(test, target_os = "linux"))]
#[allow(clippy::unwrap_used, reason = "helpers of tests may panic")]
mod tests {
    use super::*;
    use std::io::Write;

    /// The names in a folder.
    fn names(folder: &Path) -> Vec<String> {
        let entries = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().file_name());
        entries.map(|name| name.into_string().unwrap()).collect()
    }

    #[test]
    fn nothing_is_there_until_all_is() {
        let folder = tempfile::TempDir::new().unwrap();
        let path = folder.path().join("mesh.obj");
        if unnamed::file(folder.path()).is_none() {
            return;
        }
        for text in ["first", "second"] {
            let before = names(folder.path());
            replace_file(&path, |file| {
                file.write_all(text.as_bytes())?;
                file.flush()?;
                assert_eq!(names(folder.path()), before, "a killed process leaves nothing");
                io::Result::Ok(())
            })
            .unwrap();
            assert_eq!((fs::read_to_string(&path).unwrap().as_str(), names(folder.path()).len()), (text, 1));
        }
    }
}

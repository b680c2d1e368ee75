//! Writes files whole or not at all: to a temporary file beside the target, which then takes its name.

use std::io::{self, Write};
use std::path::{Path, PathBuf};

/// Why a file was not written.
#[derive(Debug, thiserror::Error, miette::Diagnostic)]
pub enum WriteError {
    /// The directory is not there.
    #[error("cannot write {}: there is no directory {}", path.display(), directory.display())]
    #[diagnostic(help("create the directory, or write elsewhere"))]
    NoDirectory {
        /// The file that was to be written.
        path: PathBuf,
        /// The directory that is missing.
        directory: PathBuf,
    },
    /// The system refuses.
    #[error("cannot write {}: {source}", path.display())]
    #[diagnostic(help("check that its directory may be written to and has room, or write elsewhere"))]
    Io {
        /// The file that was to be written.
        path: PathBuf,
        /// The system's reason.
        source: io::Error,
    },
    /// What was to be written cannot be put in that format.
    #[error("cannot write {} as {format}: {reason}", path.display())]
    Encode {
        /// The file that was to be written.
        path: PathBuf,
        /// The format, with its article.
        format: &'static str,
        /// What is wrong.
        reason: String,
    },
}

/// Writes `bytes` to `path`. Whatever happens, `path` holds either what it held before or all of `bytes`, and nothing else
/// is left beside it. The file gets the permissions of any new file, not the private ones of a temporary one.
///
/// # Errors
/// Where the directory is missing or cannot be written to, or the disk is full.
pub fn write_file(path: &Path, bytes: &[u8]) -> Result<(), WriteError> {
    let directory = match path.parent() {
        Some(parent) if !parent.as_os_str().is_empty() => parent,
        _ => Path::new("."),
    };
    if !directory.is_dir() {
        return Err(WriteError::NoDirectory {
            path: path.to_owned(),
            directory: directory.to_owned(),
        });
    }
    replace(directory, path, bytes).map_err(|source| WriteError::Io {
        path: path.to_owned(),
        source,
    })
}

fn replace(directory: &Path, path: &Path, bytes: &[u8]) -> io::Result<()> {
    let mut builder = tempfile::Builder::new();
    builder.prefix(".chainlight-").suffix(".part");
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt;
        // The process's umask applies to this, as to any new file.
        builder.permissions(std::fs::Permissions::from_mode(0o666));
    }
    let mut file = builder.tempfile_in(directory)?;
    file.write_all(bytes)?;
    // The data must be on the disk before the name is: after a crash, a name with nothing behind it is a partial file.
    file.as_file().sync_all()?;
    file.persist(path).map(drop).map_err(|e| e.error)
}

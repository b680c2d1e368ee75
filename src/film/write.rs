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

#[cfg(test)]
mod tests {
    use super::*;

    fn names(directory: &Path) -> Vec<String> {
        let entries = std::fs::read_dir(directory).expect("the directory is there");
        entries
            .map(|e| e.expect("an entry").file_name().to_string_lossy().into_owned())
            .collect()
    }

    #[test]
    fn a_file_is_written_and_replaced_whole() {
        let directory = tempfile::tempdir().expect("a directory");
        let path = directory.path().join("picture.bin");
        for content in [&b"a longer first version"[..], b"second"] {
            write_file(&path, content).expect("written");
            assert_eq!(std::fs::read(&path).expect("read"), content);
        }
        assert_eq!(names(directory.path()), ["picture.bin"]);
    }

    #[test]
    fn a_missing_directory_is_named() {
        let directory = tempfile::tempdir().expect("a directory");
        let error = write_file(&directory.path().join("none/picture.bin"), b"x").expect_err("nowhere to write");
        assert!(
            matches!(&error, WriteError::NoDirectory { directory, .. } if directory.ends_with("none")),
            "{error}"
        );
        assert!(names(directory.path()).is_empty());
    }

    #[test]
    fn a_write_that_fails_at_the_end_leaves_nothing_behind() {
        let directory = tempfile::tempdir().expect("a directory");
        // A directory cannot be replaced by a file: all is written, and the rename fails.
        let path = directory.path().join("taken");
        std::fs::create_dir(&path).expect("a directory");
        let error = write_file(&path, b"x").expect_err("cannot replace a directory");
        assert!(
            matches!(error, WriteError::Io { .. }) && error.to_string().contains("taken"),
            "{error}"
        );
        assert_eq!(names(directory.path()), ["taken"]);
    }

    #[cfg(unix)]
    #[test]
    fn the_file_has_the_permissions_of_any_new_file() {
        use std::os::unix::fs::PermissionsExt;
        let directory = tempfile::tempdir().expect("a directory");
        let [ours, plain] = ["ours", "plain"].map(|name| directory.path().join(name));
        write_file(&ours, b"x").expect("written");
        std::fs::write(&plain, b"x").expect("written");
        let mode = |path: &Path| std::fs::metadata(path).expect("metadata").permissions().mode();
        assert_eq!(mode(&ours), mode(&plain));
    }
}

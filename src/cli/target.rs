//! Files that a command will write.

use miette::{Result, miette};
use std::path::Path;

/// Says before any work what would keep `path` from being written after it. Nothing is left behind.
///
/// # Errors
/// A folder that does not exist or cannot be written to, or a folder of that name.
pub fn check_writable(path: &Path) -> Result<()> {
    let parent = path.parent().filter(|parent| !parent.as_os_str().is_empty());
    let folder = parent.unwrap_or(Path::new("."));
    if !folder.is_dir() {
        return Err(miette!(
            help = "make the folder first, or give another name",
            "{}: there is no such folder to write {} to",
            folder.display(),
            path.display()
        ));
    }
    if path.is_dir() {
        return Err(miette!(help = "give a file's name", "{} is a folder", path.display()));
    }
    // What is written goes to a temporary file beside its name first: try just that.
    tempfile::NamedTempFile::new_in(folder).map_err(|error| {
        miette!(
            help = "give a name in a folder that you may write to",
            "{}: cannot write to {}: {error}",
            path.display(),
            folder.display()
        )
    })?;
    Ok(())
}

//! Reads a scene file: RON, or JSON where the name ends in `.json`.

use super::description::{FORMAT_VERSION, SceneDescription};
use super::error::{SceneError, SceneWarning, nearest_name};
use super::locate::{describe, locate};
use super::syntax;
use std::fs::File;
use std::io::Read;
use std::path::{Path, PathBuf};
use std::sync::Arc;

pub use super::locate::Step;

/// The largest scene file, in bytes. Meshes live in files of their own.
pub const MAX_SCENE_BYTES: u64 = 64 << 20;

/// How a scene file is written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// Rusty Object Notation, with comments.
    Ron,
    /// JSON.
    Json,
}

impl Format {
    /// The format that the extension of `path` stands for: `ron` or `json`, in any case.
    ///
    /// # Errors
    /// Where it is neither.
    pub fn of(path: &Path) -> Result<Self, SceneError> {
        let extension = path
            .extension()
            .map(|extension| extension.to_string_lossy().to_lowercase());
        match extension.as_deref() {
            Some("ron") => Ok(Self::Ron),
            Some("json") => Ok(Self::Json),
            Some(other) => Err(SceneError::about(
                &path.display().to_string(),
                format!("unknown kind of scene file `.{other}`: expected `.ron` or `.json`"),
                nearest_name(other, ["ron", "json"]),
            )),
            None => Err(SceneError::about(
                &path.display().to_string(),
                "a scene file's name must end in `.ron` or `.json`",
                "rename the file, so that its ending says how it is written",
            )),
        }
    }
}

/// A scene as it was read, with the text that it came from, so that later findings can point into it.
#[derive(Clone, Debug)]
pub struct SceneSource {
    /// What the file says. Not yet validated.
    pub description: SceneDescription,
    /// The file, as it was named.
    pub path: PathBuf,
    /// Its text.
    pub text: Arc<str>,
    /// How it is written.
    pub format: Format,
    /// The folder that file names in it are relative to.
    pub base_dir: PathBuf,
}

impl SceneSource {
    /// An error at the value that `at` leads to, or at the nearest value around it that the text has. An empty `help`
    /// is left out.
    #[must_use]
    pub fn error(&self, at: &[Step], message: impl Into<String>, help: impl Into<String>) -> SceneError {
        let span = locate(&self.text, self.format, at);
        SceneError::at(
            &self.path.display().to_string(),
            &self.text,
            span,
            describe(at),
            message,
            help,
        )
    }

    /// A warning, placed like [`SceneSource::error`].
    #[must_use]
    pub fn warning(&self, at: &[Step], message: impl Into<String>, help: impl Into<String>) -> SceneWarning {
        let span = locate(&self.text, self.format, at);
        SceneWarning::at(
            &self.path.display().to_string(),
            &self.text,
            span,
            describe(at),
            message,
            help,
        )
    }
}

/// Reads the scene file at `path`. Checks its syntax and its types, not its values: see
/// [`flatten`](crate::scene::flatten()).
///
/// # Errors
/// Where the file cannot be read, is larger than [`MAX_SCENE_BYTES`], is not UTF-8, or does not follow the format.
pub fn read_scene(path: &Path) -> Result<SceneSource, SceneError> {
    let format = Format::of(path)?;
    let name = path.display().to_string();
    let bytes = read_bounded(path, MAX_SCENE_BYTES)
        .map_err(|problem| SceneError::about(&name, format!("cannot read the scene: {problem}"), ""))?;
    let text = String::from_utf8(bytes).map_err(|error| {
        SceneError::about(
            &name,
            format!(
                "not UTF-8 text: the first bad byte is number {}",
                error.utf8_error().valid_up_to() + 1
            ),
            "save the file as UTF-8",
        )
    })?;
    let base_dir = path.parent().unwrap_or(Path::new(""));
    parse_scene(&name, &text, format, base_dir)
}

/// Reads a scene from `text`; `name` is what messages call it, `base_dir` the folder that file names in it are relative
/// to.
///
/// # Errors
/// Where the text does not follow the format.
pub fn parse_scene(name: &str, text: &str, format: Format, base_dir: &Path) -> Result<SceneSource, SceneError> {
    // Editors on some systems begin a file with a byte order mark; no format wants it.
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    if text.len() as u64 > MAX_SCENE_BYTES {
        return Err(SceneError::about(
            name,
            too_large(MAX_SCENE_BYTES),
            "put large meshes into OBJ files",
        ));
    }
    let text: Arc<str> = Arc::from(text);
    let description = match format {
        Format::Ron => syntax::parse_ron(name, &text)?,
        Format::Json => syntax::parse_json(name, &text)?,
    };
    let path = PathBuf::from(name);
    let source = SceneSource {
        description,
        path,
        text,
        format,
        base_dir: base_dir.to_owned(),
    };
    // Before everything else: the rest of another version may mean something else.
    let version = source.description.version;
    if version != FORMAT_VERSION {
        let message = format!("version {version} of the scene format is not known: expected {FORMAT_VERSION}");
        return Err(source.error(&[Step::Key("version")], message, "write `version: 1`"));
    }
    Ok(source)
}

/// The content of a regular file of at most `limit` bytes; otherwise why not, in words.
pub(super) fn read_bounded(path: &Path, limit: u64) -> Result<Vec<u8>, String> {
    let file = open_regular(path)?;
    let mut bytes = Vec::new();
    file.take(limit.saturating_add(1))
        .read_to_end(&mut bytes)
        .map_err(|error| error.to_string())?;
    if bytes.len() as u64 > limit {
        return Err(too_large(limit));
    }
    Ok(bytes)
}

/// Opens a file, unless it is something else: a directory cannot be read, and a pipe may never end.
pub(super) fn open_regular(path: &Path) -> Result<File, String> {
    // Looked at before it is opened: opening a pipe waits for its other end.
    let about = std::fs::metadata(path).map_err(|error| match error.kind() {
        std::io::ErrorKind::NotFound => "no such file".to_owned(),
        std::io::ErrorKind::PermissionDenied => "permission denied".to_owned(),
        _ => error.to_string(),
    })?;
    if about.is_dir() {
        return Err("it is a directory, not a file".to_owned());
    }
    if !about.is_file() {
        return Err("it is not a regular file".to_owned());
    }
    File::open(path).map_err(|error| match error.kind() {
        std::io::ErrorKind::PermissionDenied => "permission denied".to_owned(),
        _ => error.to_string(),
    })
}

fn too_large(limit: u64) -> String {
    format!("it is larger than {} MiB", limit >> 20)
}

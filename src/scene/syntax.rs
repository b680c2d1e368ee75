//! From text to description: calls the RON and JSON parsers, and says in one voice what they complain of.

use super::description::SceneDescription;
use super::error::{SceneError, nearest_name, offset_of};
use ron::extensions::Extensions;
use std::ops::Range;
use std::sync::Arc;

/// What a parser complained of, in words.
struct Complaint {
    message: String,
    help: String,
    /// A name in the text that it is about, to point at.
    found: Option<String>,
}

impl Complaint {
    fn new(message: impl Into<String>, help: impl Into<String>) -> Self {
        Self {
            message: message.into(),
            help: help.into(),
            found: None,
        }
    }

    fn unknown(what: &str, found: &str, expected: &[&str]) -> Self {
        let help = nearest_name(found, expected.iter().copied());
        Self {
            message: format!("unknown {what} `{found}`"),
            help,
            found: Some(found.to_owned()),
        }
    }
}

/// Reads a description from RON.
pub(super) fn parse_ron(name: &str, text: &Arc<str>) -> Result<SceneDescription, SceneError> {
    let options = ron::Options::default().with_default_extension(Extensions::IMPLICIT_SOME);
    options.from_str(text).map_err(|error| {
        let start = offset_of(text, error.span.start.line, error.span.start.col);
        let end = offset_of(text, error.span.end.line, error.span.end.col).max(start);
        let complaint = complain_ron(error.code);
        let span = point_at(text, start..end, complaint.found.as_deref());
        SceneError::at(name, text, span, "here", complaint.message, complaint.help)
    })
}

/// Reads a description from JSON.
pub(super) fn parse_json(name: &str, text: &Arc<str>) -> Result<SceneDescription, SceneError> {
    serde_json::from_str(text).map_err(|error| {
        // The parser counts columns in bytes, and stands after what it complains of.
        let line_start = offset_of(text, error.line(), 1);
        let end = (line_start + error.column()).min(text.len());
        let complaint = complain_json(&error);
        let span = point_at(text, line_start..end, complaint.found.as_deref());
        SceneError::at(name, text, span, "here", complaint.message, complaint.help)
    })
}

/// The last place in `span` where `found` stands, widened backwards to the start of the line if need be; the span
/// itself where it does not stand there.
fn point_at(text: &str, span: Range<usize>, found: Option<&str>) -> Range<usize> {
    let Some(found) = found.filter(|found| !found.is_empty()) else {
        return span;
    };
    let start = text[..span.start].rfind('\n').map_or(0, |newline| newline + 1);
    let end = span.end.max(span.start + found.len()).min(text.len());
    match text.get(start..end).and_then(|line| line.rfind(found)) {
        Some(offset) => start + offset..start + offset + found.len(),
        None => span,
    }
}

/// The name of a block in a message.
fn within(outer: Option<&str>) -> String {
    outer.map_or_else(String::new, |outer| format!(" in `{outer}`"))
}

fn complain_ron(code: ron::Error) -> Complaint {
    use ron::Error as E;
    match code {
        E::NoSuchStructField { expected, found, outer } => Complaint::unknown("field", &found, expected).inside(outer),
        E::NoSuchEnumVariant { expected, found, outer } => {
            Complaint::unknown(outer.as_deref().unwrap_or("variant"), &found, expected)
        }
        E::MissingStructField { field, outer } => Complaint::new(
            format!("missing field `{field}`{}", within(outer.as_deref())),
            format!("add `{field}: ...`"),
        ),
        E::DuplicateStructField { field, outer } => Complaint::new(
            format!("field `{field}` stands twice{}", within(outer.as_deref())),
            "remove one of them",
        ),
        E::InvalidValueForType { expected, found } => Complaint::new(format!("expected {expected}, found {found}"), ""),
        E::ExpectedDifferentLength { expected, found } => {
            Complaint::new(format!("expected {expected}, found {found} elements"), "")
        }
        E::ExceededRecursionLimit => Complaint::new("nested too deeply", "a scene nests fewer than ten brackets"),
        other => Complaint::new(lowercase_first(&other.to_string()), ""),
    }
}

fn complain_json(error: &serde_json::Error) -> Complaint {
    Complaint::new(error.to_string(), "")
}

fn lowercase_first(text: &str) -> String {
    let mut characters = text.chars();
    characters
        .next()
        .map_or_else(String::new, |first| first.to_lowercase().chain(characters).collect())
}

impl Complaint {
    fn inside(mut self, outer: Option<String>) -> Self {
        self.message.push_str(&within(outer.as_deref()));
        self
    }
}

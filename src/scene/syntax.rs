//! From text to description: calls the RON and JSON parsers, and says in one voice what they complain of.

use super::complaint::{Complaint, complain_json, complain_ron};
use super::description::SceneDescription;
use super::error::{SceneError, offset_of};
use super::locate::context;
use super::schema_key;
use ron::extensions::Extensions;
use std::sync::Arc;

/// Reads a description from RON.
pub(super) fn parse_ron(name: &str, text: &Arc<str>) -> Result<SceneDescription, SceneError> {
    let options = ron::Options::default().with_default_extension(Extensions::IMPLICIT_SOME);
    options.from_str(text).map_err(|error| {
        let at = offset_of(text, error.span.start.line, error.span.start.col);
        place(name, text, at, |found, before| complain_ron(error.code, found, before))
    })
}

/// Reads a description from JSON.
pub(super) fn parse_json(name: &str, text: &Arc<str>) -> Result<SceneDescription, SceneError> {
    schema_key::read(text).map_err(|error| {
        // The parser counts columns in bytes, and stands at the last byte of what it complains of.
        let line_start = offset_of(text, error.line(), 1);
        let at = text.floor_char_boundary(line_start + error.column().saturating_sub(1));
        // Comments are no tokens, so they would be passed over.
        if text[at..].starts_with("//") || text[at..].starts_with("/*") {
            let help = "leave it out, or write the scene in RON, which has comments";
            return SceneError::at(name, text, at..at + 2, "here", "JSON has no comments", help);
        }
        place(name, text, at, |found, _| complain_json(&error, found))
    })
}

/// Puts the complaint about the byte `at` into its place. `complain` is given the token there and the text before it.
fn place(name: &str, text: &Arc<str>, at: usize, complain: impl FnOnce(&str, &str) -> Complaint) -> SceneError {
    let around = context(text, at);
    let complaint = complain(&text[around.token.clone()], text[..around.token.start].trim_end());
    let span = match &complaint.found {
        // Parsers stand somewhere behind a name that they do not know.
        Some(found) => {
            let line = text[..around.token.start].rfind('\n').map_or(0, |newline| newline + 1);
            let here = text[line..around.token.end].rfind(found.as_str());
            here.map_or(around.token, |offset| line + offset..line + offset + found.len())
        }
        None if complaint.whole_bracket => around.bracket,
        None => around.token,
    };
    let label = if around.path.is_empty() {
        "here".to_owned()
    } else {
        format!("in {}", around.path)
    };
    SceneError::at(name, text, span, label, complaint.message, complaint.help)
}

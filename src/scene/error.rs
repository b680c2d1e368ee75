//! Errors and warnings about a scene, each with the place in the file, what was expected, and what to do.

use miette::{Diagnostic, LabeledSpan, NamedSource, SourceCode};
use std::fmt;
use std::ops::Range;
use std::sync::Arc;

/// Why a scene cannot be rendered. `Display` says what is wrong, with the file where no source line is there to show
/// it; [`SceneError::plain`] adds the place and the help; as a [`miette::Diagnostic`] it also shows the source line.
#[derive(Clone, Debug, thiserror::Error)]
#[error("{0}")]
pub struct SceneError(Box<Finding>);

/// Something in a scene that renders, but probably not as meant. Same faces as [`SceneError`].
#[derive(Clone, Debug, thiserror::Error)]
#[error("{0}")]
pub struct SceneWarning(Box<Finding>);

/// What both carry.
#[derive(Clone, Debug)]
struct Finding {
    message: String,
    help: String,
    place: Option<Place>,
    file: String,
}

/// A place in a text.
#[derive(Clone, Debug)]
struct Place {
    source: NamedSource<Arc<str>>,
    span: Range<usize>,
    label: String,
    line: usize,
    column: usize,
}

impl fmt::Display for Finding {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.place.is_none() {
            write!(f, "{}: ", self.file)?;
        }
        f.write_str(&self.message)
    }
}

impl Finding {
    fn new(file: &str, message: String, help: String) -> Self {
        Self {
            message,
            help,
            place: None,
            file: file.to_owned(),
        }
    }

    /// Points at `span` of `text`, shortened to its first line; `label` is what the source view says there.
    fn at(mut self, text: &Arc<str>, span: Range<usize>, label: String) -> Self {
        let start = text.floor_char_boundary(span.start);
        let end = text.floor_char_boundary(span.end.max(start));
        let line_end = text[start..].find('\n').map_or(text.len(), |offset| start + offset);
        let (line, column) = line_and_column(text, start);
        self.place = Some(Place {
            source: NamedSource::new(&self.file, Arc::clone(text)),
            span: start..end.min(line_end),
            label,
            line,
            column,
        });
        self
    }

    fn plain(&self) -> String {
        let mut plain = match &self.place {
            Some(place) => format!("{}:{}:{}: {}", self.file, place.line, place.column, self.message),
            None => format!("{}: {}", self.file, self.message),
        };
        if !self.help.is_empty() {
            plain.push_str(&format!(" (help: {})", self.help));
        }
        plain
    }
}

/// Line and column (in characters), both from 1, of a byte offset on a character boundary.
fn line_and_column(text: &str, at: usize) -> (usize, usize) {
    let before = &text[..at];
    let line_start = before.rfind('\n').map_or(0, |newline| newline + 1);
    let line = before.bytes().filter(|&byte| byte == b'\n').count() + 1;
    (line, before[line_start..].chars().count() + 1)
}

/// The byte offset of a line and column (in characters), both from 1; the end of the line or text where it is shorter.
pub(super) fn offset_of(text: &str, line: usize, column: usize) -> usize {
    let mut start = 0;
    for _ in 1..line {
        match text[start..].find('\n') {
            Some(newline) => start += newline + 1,
            None => return text.len(),
        }
    }
    let rest = text[start..].split('\n').next().unwrap_or_default();
    start
        + rest
            .char_indices()
            .nth(column.saturating_sub(1))
            .map_or(rest.len(), |(offset, _)| offset)
}

macro_rules! finding {
    ($kind:ty, $severity:expr) => {
        impl $kind {
            /// A finding about a file as a whole. An empty `help` is left out.
            #[must_use]
            pub fn about(file: &str, message: impl Into<String>, help: impl Into<String>) -> Self {
                Self(Box::new(Finding::new(file, message.into(), help.into())))
            }

            /// A finding about the bytes `span` of `text`, the content of `file`; `label` is shown under the source.
            #[must_use]
            pub fn at(
                file: &str,
                text: &Arc<str>,
                span: Range<usize>,
                label: impl Into<String>,
                message: impl Into<String>,
                help: impl Into<String>,
            ) -> Self {
                Self(Box::new(Finding::new(file, message.into(), help.into()).at(
                    text,
                    span,
                    label.into(),
                )))
            }

            /// `file:line:column: message (help: ...)`.
            #[must_use]
            pub fn plain(&self) -> String {
                self.0.plain()
            }

            /// What to do about it; empty where there is nothing to say.
            #[must_use]
            pub fn advice(&self) -> &str {
                &self.0.help
            }

            /// The file it is about, as it was named by the caller.
            #[must_use]
            pub fn file(&self) -> &str {
                &self.0.file
            }

            /// Line and column, both from 1, where there is a place in the text.
            #[must_use]
            pub fn line_and_column(&self) -> Option<(usize, usize)> {
                self.0.place.as_ref().map(|place| (place.line, place.column))
            }
        }

        impl Diagnostic for $kind {
            fn severity(&self) -> Option<miette::Severity> {
                Some($severity)
            }

            fn help<'a>(&'a self) -> Option<Box<dyn fmt::Display + 'a>> {
                (!self.0.help.is_empty()).then(|| Box::new(&self.0.help) as Box<dyn fmt::Display>)
            }

            fn source_code(&self) -> Option<&dyn SourceCode> {
                self.0
                    .place
                    .as_ref()
                    .map(|place| &place.source as &dyn SourceCode)
            }

            fn labels(&self) -> Option<Box<dyn Iterator<Item = LabeledSpan> + '_>> {
                self.0.place.as_ref().map(|place| {
                    let label = LabeledSpan::new_with_span(Some(place.label.clone()), place.span.clone());
                    Box::new(std::iter::once(label)) as Box<dyn Iterator<Item = LabeledSpan>>
                })
            }
        }
    };
}

finding!(SceneError, miette::Severity::Error);
finding!(SceneWarning, miette::Severity::Warning);

/// Advice for the name `found`, which is none of `known`: the nearest of them, and all of them where they are few. Empty
/// where there is nothing to say.
#[must_use]
pub fn nearest_name<'a>(found: &str, known: impl IntoIterator<Item = &'a str>) -> String {
    let known: Vec<&str> = known.into_iter().collect();
    let distance = |name: &str| strsim::damerau_levenshtein(&found.to_lowercase(), &name.to_lowercase());
    let nearest = (found.len() <= 64)
        .then(|| known.iter().map(|name| (distance(name), *name)).min())
        .flatten()
        .filter(|(distance, name)| *distance <= 1 + name.chars().count().max(found.chars().count()) / 3);
    let list = known
        .iter()
        .map(|name| format!("`{name}`"))
        .collect::<Vec<_>>()
        .join(", ");
    match (nearest, known.len()) {
        (_, 0) => String::new(),
        (Some((_, name)), 1) => format!("did you mean `{name}`?"),
        (None, 1) => format!("the only one is {list}"),
        (Some((_, name)), 2..=16) => format!("did you mean `{name}`? known: {list}"),
        (None, 2..=16) => format!("known: {list}"),
        (Some((_, name)), _) => format!("did you mean `{name}`?"),
        (None, _) => String::new(),
    }
}

//! Where a value of a scene stands in its text. Serde forgets places once a value is read; this walks the text again
//! when there is something to say about it.

use super::lex::{Kind, Lexer};
use super::read::Format;
use std::borrow::Cow;
use std::fmt::Write;
use std::ops::Range;

/// One step from a value to a value inside it. The same steps lead through RON and JSON.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Step<'a> {
    /// The value of a field or of a map entry.
    Key(&'a str),
    /// The name of a map entry, rather than its value.
    Name(&'a str),
    /// An element of a list or a tuple, from 0.
    Index(usize),
    /// The fields of an enum variant: `Quad` in RON's `Quad(corner: ...)` and in JSON's `{"Quad": {"corner": ...}}`.
    Variant(&'a str),
    /// The one unnamed value in an enum variant: the tuple in RON's `Scale((1, 2, 3))`. Follows `Variant`.
    Content,
}

/// The steps as a person would write them: `shapes[3].material`.
pub(super) fn describe(steps: &[Step]) -> String {
    let mut text = String::new();
    for step in steps {
        // Writing to a string cannot fail.
        let _ = match step {
            Step::Key(name) | Step::Name(name) if is_plain(name) => {
                write!(text, "{}{name}", if text.is_empty() { "" } else { "." })
            }
            Step::Key(name) | Step::Name(name) => write!(text, "[{name:?}]"),
            Step::Index(index) => write!(text, "[{index}]"),
            Step::Variant(_) | Step::Content => Ok(()),
        };
    }
    text
}

fn is_plain(name: &str) -> bool {
    !name.is_empty() && name.bytes().all(|byte| byte.is_ascii_alphanumeric() || byte == b'_')
}

/// The byte span of the value that `steps` lead to, or of the nearest enclosing value that the text has. Never
/// panics, whatever the text; an empty span at the start is the answer where there is nothing at all.
pub(super) fn locate(text: &str, format: Format, steps: &[Step]) -> Range<usize> {
    let steps: Vec<Wanted> = steps.iter().filter_map(|step| Wanted::new(*step, format)).collect();
    let mut search = Search {
        text,
        steps: &steps,
        best: None,
    };
    search.run();
    search.best.map_or(0..0, |(_, span)| span)
}

/// A step in terms of brackets and keys alone.
enum Wanted<'a> {
    Key(&'a str),
    Name(&'a str),
    Index(usize),
}

impl<'a> Wanted<'a> {
    fn new(step: Step<'a>, format: Format) -> Option<Self> {
        match (step, format) {
            (Step::Key(name), _) | (Step::Variant(name), Format::Json) => Some(Self::Key(name)),
            (Step::Name(name), _) => Some(Self::Name(name)),
            (Step::Index(index), _) => Some(Self::Index(index)),
            (Step::Content, Format::Ron) => Some(Self::Index(0)),
            (Step::Variant(_), Format::Ron) | (Step::Content, Format::Json) => None,
        }
    }
}

/// An open bracket.
struct Frame {
    start: usize,
    /// How many steps lead into this bracket, if it is on the way.
    matched: Option<usize>,
    /// The key of the element being read.
    key: Option<Range<usize>>,
    /// The number of the element being read.
    index: usize,
    /// The last value read, until a comma or a bracket ends the element: a key, if a colon follows.
    last: Option<Range<usize>>,
}

struct Search<'a> {
    text: &'a str,
    steps: &'a [Wanted<'a>],
    /// Steps matched and the span they lead to: the deepest so far, and the first of equals.
    best: Option<(usize, Range<usize>)>,
}

impl Search<'_> {
    fn run(&mut self) {
        let mut outside = Frame {
            start: 0,
            matched: None,
            key: None,
            index: 0,
            last: None,
        };
        let mut stack: Vec<Frame> = Vec::new();
        for (kind, span) in Lexer::new(self.text) {
            let frame = stack.last_mut().unwrap_or(&mut outside);
            match kind {
                Kind::Word | Kind::Text => {
                    // Two words in a row are a mistake in the text: the later one counts.
                    frame.last = Some(span.clone());
                    self.offer(frame, span);
                }
                Kind::Colon => {
                    if let Some(key) = frame.last.take() {
                        self.offer_name(frame, &key);
                        frame.key = Some(key);
                    }
                }
                Kind::Comma => {
                    frame.key = None;
                    frame.last = None;
                    frame.index += 1;
                }
                Kind::Open => {
                    let start = frame.last.take().map_or(span.start, |name| name.start);
                    let matched = if stack.is_empty() {
                        Some(0)
                    } else {
                        self.matches(stack.last())
                    };
                    stack.push(Frame {
                        start,
                        matched,
                        key: None,
                        index: 0,
                        last: None,
                    });
                    // For now as far as the bracket, in case that it never closes.
                    self.record(matched, start..span.end);
                }
                Kind::Close => {
                    if let Some(frame) = stack.pop() {
                        self.record_closed(frame.matched, frame.start..span.end);
                    }
                }
            }
        }
    }

    /// How many steps lead to the element that `frame` is reading.
    fn matches(&self, frame: Option<&Frame>) -> Option<usize> {
        let frame = frame?;
        let matched = frame.matched?;
        let hit = match (self.steps.get(matched)?, &frame.key) {
            (Wanted::Key(name), Some(key)) => decode(&self.text[key.clone()]) == *name,
            (Wanted::Index(index), None) => frame.index == *index,
            _ => false,
        };
        hit.then_some(matched + 1)
    }

    fn offer(&mut self, frame: &Frame, span: Range<usize>) {
        let matched = self.matches(Some(frame));
        self.record(matched, span);
    }

    fn offer_name(&mut self, frame: &Frame, key: &Range<usize>) {
        if let Some(matched) = frame.matched
            && let Some(Wanted::Name(name)) = self.steps.get(matched)
            && decode(&self.text[key.clone()]) == *name
        {
            self.record(Some(matched + 1), key.clone());
        }
    }

    fn record(&mut self, matched: Option<usize>, span: Range<usize>) {
        if let Some(matched) = matched
            && self.best.as_ref().is_none_or(|(best, _)| matched > *best)
        {
            self.best = Some((matched, span));
        }
    }

    /// Lengthens the record of a bracket that has closed.
    fn record_closed(&mut self, matched: Option<usize>, span: Range<usize>) {
        if let (Some(matched), Some((best, found))) = (matched, &mut self.best)
            && matched == *best
            && found.start == span.start
        {
            *found = span;
        }
    }
}

/// The text of a key: an identifier as it stands, a literal without its quotes and escapes.
fn decode(key: &str) -> Cow<'_, str> {
    if key.contains('"') {
        ron::from_str::<String>(key).map_or(Cow::Borrowed(key), Cow::Owned)
    } else {
        Cow::Borrowed(key)
    }
}

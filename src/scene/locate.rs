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

/// What stands around a byte of a text.
pub(super) struct Context {
    /// The way there as a person would write it: `shapes[3].material`. Empty outside every bracket.
    pub(super) path: String,
    /// The token that holds the byte, or the next one; empty at the end of the text.
    pub(super) token: Range<usize>,
    /// From the innermost open bracket, with the name before it, to the token.
    pub(super) bracket: Range<usize>,
}

/// What stands around the byte `at`. Never panics, whatever the text.
pub(super) fn context(text: &str, at: usize) -> Context {
    let mut stack: Vec<Frame> = vec![Frame::new(0, None)];
    for (kind, span) in Lexer::new(text) {
        if span.end > at {
            return describe_stack(text, &stack, span);
        }
        match kind {
            Kind::Open => {
                let start = stack
                    .last_mut()
                    .and_then(|frame| frame.last.take())
                    .map_or(span.start, |name| name.start);
                stack.push(Frame::new(start, None));
            }
            // The outermost frame stands for the text itself.
            Kind::Close if stack.len() > 1 => drop(stack.pop()),
            _ => {
                if let Some(frame) = stack.last_mut() {
                    frame.step(kind, span);
                }
            }
        }
    }
    describe_stack(text, &stack, text.len()..text.len())
}

fn describe_stack(text: &str, stack: &[Frame], token: Range<usize>) -> Context {
    let mut path = String::new();
    for (depth, frame) in stack.iter().enumerate().skip(1) {
        let step = match &frame.key {
            Some(key) => format!(
                "{}{}",
                if path.is_empty() { "" } else { "." },
                decode(&text[key.clone()])
            ),
            // An element without a key: a number, unless it is the outermost bracket's or a bracket's very first.
            None if text[frame.start..].starts_with('[') => format!("[{}]", frame.index),
            None if depth + 1 == stack.len() => continue,
            None => String::new(),
        };
        path.push_str(&step);
    }
    let start = stack.last().map_or(0, |frame| frame.start);
    Context {
        path,
        bracket: start..token.end.max(start),
        token,
    }
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

impl Frame {
    fn new(start: usize, matched: Option<usize>) -> Self {
        Self {
            start,
            matched,
            key: None,
            index: 0,
            last: None,
        }
    }

    /// Takes note of a token that neither opens nor closes a bracket.
    fn step(&mut self, kind: Kind, span: Range<usize>) {
        match kind {
            // Two words in a row are a mistake in the text: the later one counts.
            Kind::Word | Kind::Text => self.last = Some(span),
            Kind::Colon => self.key = self.last.take().or(self.key.take()),
            Kind::Comma => {
                *self = Self {
                    index: self.index + 1,
                    ..Self::new(self.start, self.matched)
                }
            }
            Kind::Open | Kind::Close => {}
        }
    }
}

struct Search<'a> {
    text: &'a str,
    steps: &'a [Wanted<'a>],
    /// Steps matched and the span they lead to: the deepest so far, and the first of equals.
    best: Option<(usize, Range<usize>)>,
}

impl Search<'_> {
    fn run(&mut self) {
        let mut stack: Vec<Frame> = Vec::new();
        for (kind, span) in Lexer::new(self.text) {
            match kind {
                Kind::Open => {
                    let name = stack.last_mut().and_then(|frame| frame.last.take());
                    let start = name.map_or(span.start, |name| name.start);
                    let matched = if stack.is_empty() {
                        Some(0)
                    } else {
                        self.matches(stack.last())
                    };
                    stack.push(Frame::new(start, matched));
                    // For now as far as the bracket, in case that it never closes.
                    self.record(matched, start..span.end);
                }
                Kind::Close => {
                    if let Some(frame) = stack.pop() {
                        self.record_closed(frame.matched, frame.start..span.end);
                    }
                }
                _ => {
                    let Some(frame) = stack.last_mut() else { continue };
                    frame.step(kind, span.clone());
                    if kind == Kind::Colon {
                        self.offer_name(frame);
                    } else if kind != Kind::Comma {
                        let matched = self.matches(Some(frame));
                        self.record(matched, span);
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

    /// Records the key that `frame` has just read, if its name is what is wanted.
    fn offer_name(&mut self, frame: &Frame) {
        if let Some(matched) = frame.matched
            && let Some(Wanted::Name(name)) = self.steps.get(matched)
            && let Some(key) = &frame.key
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

#[cfg(test)]
mod tests {
    use super::*;

    fn found<'a>(text: &'a str, format: Format, steps: &[Step]) -> &'a str {
        &text[locate(text, format, steps)]
    }

    const RON: &str = r##"#![enable(implicit_some)]
    ( /* a: 1, /* nested */ */ a: "not, (b:", list: [ // c: [
        (b: 'x'), Two(b: r#"raw " ("#, c: Scale((1, 2, 3))),
    ], map: { "k\"ey": 5, "other": Six(d: 7) })"##;

    #[test]
    fn values_are_found_in_ron() {
        let at = |steps: &[Step]| found(RON, Format::Ron, steps);
        assert_eq!(at(&[Step::Key("a")]), "\"not, (b:\"");
        assert_eq!(at(&[Step::Key("list"), Step::Index(0), Step::Key("b")]), "'x'");
        let two = [Step::Key("list"), Step::Index(1), Step::Variant("Two")];
        assert_eq!(at(&two), "Two(b: r#\"raw \" (\"#, c: Scale((1, 2, 3)))");
        assert_eq!(at(&[&two[..], &[Step::Key("b")]].concat()), "r#\"raw \" (\"#");
        let scale = [&two[..], &[Step::Key("c"), Step::Variant("Scale"), Step::Content]].concat();
        assert_eq!(at(&scale), "(1, 2, 3)");
        assert_eq!(at(&[&scale[..], &[Step::Index(2)]].concat()), "3");
        assert_eq!(at(&[Step::Key("map"), Step::Key("k\"ey")]), "5");
        assert_eq!(at(&[Step::Key("map"), Step::Name("other")]), "\"other\"");
    }

    #[test]
    fn values_are_found_in_json() {
        let text = r#"{"a": [1, {"Scale": [2, 3]}], "b": {"Two": {"c": "}"}}}"#;
        let at = |steps: &[Step]| found(text, Format::Json, steps);
        assert_eq!(at(&[Step::Key("a"), Step::Index(0)]), "1");
        let scale = [
            Step::Key("a"),
            Step::Index(1),
            Step::Variant("Scale"),
            Step::Content,
            Step::Index(1),
        ];
        assert_eq!(at(&scale), "3");
        assert_eq!(at(&[Step::Key("b"), Step::Variant("Two"), Step::Key("c")]), "\"}\"");
    }

    #[test]
    fn the_nearest_enclosing_value_stands_for_one_that_is_not_there() {
        let at = |steps: &[Step]| found(RON, Format::Ron, steps);
        assert_eq!(
            at(&[Step::Key("list"), Step::Index(0), Step::Key("none"), Step::Index(4)]),
            "(b: 'x')"
        );
        assert_eq!(at(&[Step::Key("map"), Step::Key("other"), Step::Key("e")]), "Six(d: 7)");
        assert!(at(&[Step::Key("none")]).starts_with("( /* a"));
        assert_eq!(found("", Format::Ron, &[Step::Key("none")]), "");
        assert_eq!(found("(a: (b: 1", Format::Ron, &[Step::Key("a"), Step::Key("c")]), "(");
    }

    #[test]
    fn the_way_to_a_byte_is_named() {
        let way = |needle: &str| context(RON, RON.find(needle).unwrap_or(0)).path;
        assert_eq!(way("'x'"), "list[0].b");
        assert_eq!(way("7)"), "map.other.d");
        assert_eq!(way("2, 3"), "list[1].c");
    }

    #[test]
    fn ways_are_described_as_people_write_them() {
        let steps = [
            Step::Key("materials"),
            Step::Key("a b"),
            Step::Variant("Diffuse"),
            Step::Key("eta"),
            Step::Index(1),
        ];
        assert_eq!(describe(&steps), "materials[\"a b\"].eta[1]");
    }
}

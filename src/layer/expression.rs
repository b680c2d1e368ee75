//! From the notation of light path expressions to regular expressions over bytes: a byte for every event and every kind of light.

use super::layers::End;
use crate::material::{Event, Lobe};
use miette::{Diagnostic, SourceSpan};
use regex_syntax::ast::parse::Parser;

/// The first byte of events, by their number.
const EVENTS: u8 = b'a';
/// The first byte of lights, by their number.
const ENDS: u8 = b'x';

/// An expression that cannot be read.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error, Diagnostic)]
#[error("the light path expression `{expression}` cannot be read: {message}")]
pub struct ExpressionError {
    message: String,
    #[source_code]
    expression: String,
    #[label("here")]
    at: SourceSpan,
    #[help]
    help: &'static str,
}

const NOTATION: &str = "from the camera to the light: C, then D, G, S, R, T, pairs such as <RD>, or . for any scattering, with * + ? {n,m} ( | ) [ ], \
                        then L for any light, O for a shape that emits, P for a light at a point, B for light from infinity";

/// The byte of an event.
pub(super) fn event_byte(event: Event) -> u8 {
    EVENTS + event.number() as u8
}

/// The byte of a light.
pub(super) fn end_byte(end: End) -> u8 {
    ENDS + end as u8
}

/// The bytes of the events that `wanted` holds of.
fn events(wanted: impl Fn(Event) -> bool) -> String {
    let bytes = Event::ALL.into_iter().filter(|&event| wanted(event)).map(event_byte);
    bytes.map(char::from).collect()
}

/// The bytes of the lights that `wanted` holds of.
fn ends(wanted: impl Fn(End) -> bool) -> String {
    let bytes = End::ALL.into_iter().filter(|&end| wanted(end)).map(end_byte);
    bytes.map(char::from).collect()
}

/// What a letter stands for, as bytes.
fn letter(letter: char) -> Option<String> {
    let lobe = |wanted: Lobe| events(|event| event.lobe == wanted);
    Some(match letter {
        'D' => lobe(Lobe::Diffuse),
        'G' => lobe(Lobe::Glossy),
        'S' => lobe(Lobe::Specular),
        'R' => events(|event| !event.transmits),
        'T' => events(|event| event.transmits),
        '.' => events(|_| true),
        'L' => ends(|_| true),
        'O' => ends(|end| end == End::Shape),
        'P' => ends(|end| end == End::Point),
        'B' => ends(|end| end == End::Infinity),
        _ => return None,
    })
}

/// What a pair such as `<RD>` stands for, as bytes.
fn pair(side: char, lobe: char) -> Option<String> {
    let sided = match side {
        'R' | 'T' | '.' => letter(side)?,
        _ => return None,
    };
    let lobed = match lobe {
        'D' | 'G' | 'S' | '.' => letter(lobe)?,
        _ => return None,
    };
    Some(sided.chars().filter(|&byte| lobed.contains(byte)).collect())
}

/// An expression under translation.
struct Translation<'a> {
    expression: &'a str,
    pattern: String,
    /// Of every byte of the pattern, where in the expression it comes from.
    origins: Vec<usize>,
}

impl Translation<'_> {
    fn error(&self, message: impl Into<String>, at: usize, length: usize) -> ExpressionError {
        ExpressionError {
            message: message.into(),
            expression: self.expression.to_owned(),
            at: (at, length).into(),
            help: NOTATION,
        }
    }

    fn push(&mut self, text: &str, origin: usize) {
        self.pattern.push_str(text);
        self.origins.resize(self.pattern.len(), origin);
    }
}

/// The regular expression over bytes that `expression` stands for, without the camera.
///
/// # Errors
/// What is no light path expression, and where.
pub(super) fn translate(expression: &str) -> Result<String, ExpressionError> {
    let mut translation = Translation {
        expression,
        pattern: String::new(),
        origins: Vec::new(),
    };
    let mut chars = expression.char_indices().filter(|(_, c)| !c.is_whitespace()).peekable();
    match chars.next() {
        Some((_, 'C')) => {}
        Some((at, c)) => return Err(translation.error("it does not begin with the camera, C", at, c.len_utf8())),
        None => return Err(translation.error("it is empty", 0, 0)),
    }
    let (mut set, mut counted) = (None, false);
    while let Some((at, c)) = chars.next() {
        let bytes =
            if c == '<' {
                let mut inside = || chars.next().map_or(' ', |(_, c)| c);
                let (side, lobe, close) = (inside(), inside(), inside());
                let bytes = pair(side, lobe).filter(|_| close == '>');
                Some(bytes.ok_or_else(|| {
                    translation.error("a pair is <, then R, T or ., then D, G, S or ., then >", at, 1)
                })?)
            } else {
                letter(c)
            };
        match (bytes, c) {
            (Some(bytes), _) if set.is_some() => translation.push(&bytes, at),
            (Some(bytes), _) => translation.push(&format!("[{bytes}]"), at),
            (None, '[') if set.is_none() => {
                set = Some(at);
                translation.push("[", at);
                if chars.next_if(|&(_, c)| c == '^').is_some() {
                    translation.push("^", at);
                }
            }
            (None, ']') if set.is_some() => {
                if translation.pattern.ends_with(['[', '^']) {
                    return Err(translation.error("this set is empty", at, 1));
                }
                set = None;
                translation.push("]", at);
            }
            (None, '*' | '+' | '?' | '(' | ')' | '|') if set.is_none() => {
                translation.push(&c.to_string(), at);
                // What regular expressions give a meaning beyond this notation: lazy repetition, and flags of groups.
                if let Some(&(next, follower @ ('*' | '+' | '?'))) = chars.peek()
                    && c != ')'
                {
                    return Err(translation.error(format!("`{follower}` stands behind `{c}`"), next, 1));
                }
            }
            (None, '{') if set.is_none() && !counted => {
                counted = true;
                translation.push("{", at);
            }
            (None, '}') if counted => {
                counted = false;
                translation.push("}", at);
            }
            (None, '0'..='9' | ',') if counted => translation.push(&c.to_string(), at),
            _ => return Err(translation.error(format!("`{c}` means nothing here"), at, c.len_utf8())),
        }
    }
    if let Some(at) = set {
        return Err(translation.error("this set is not closed", at, 1));
    }
    if let Err(error) = Parser::new().parse(&translation.pattern) {
        let start = error
            .span()
            .start
            .offset
            .min(translation.pattern.len().saturating_sub(1));
        let at = translation.origins.get(start).copied().unwrap_or(0);
        return Err(translation.error(error.kind().to_string(), at, 1));
    }
    Ok(translation.pattern)
}

#[cfg(test)]
mod tests {
    use super::translate;

    #[test]
    fn letters_become_sets_of_bytes() {
        assert_eq!(translate("CDL").as_deref(), Ok("[ab][xyz]"));
        assert_eq!(translate("C <TS>* [^S] B").as_deref(), Ok("[f]*[^ef][z]"));
        assert_eq!(
            translate("C(D|S)+.{2,3}[OP]").as_deref(),
            Ok("([ab]|[ef])+[abcdef]{2,3}[xy]")
        );
        assert_eq!(translate("C<R.><.G>L").as_deref(), Ok("[ace][cd][xyz]"));
    }

    #[test]
    fn what_is_no_expression_is_said_with_its_place() {
        for (expression, words) in [
            ("", "it is empty"),
            ("DL", "does not begin with the camera"),
            ("CXL", "`X` means nothing here"),
            ("CD[GL", "this set is not closed"),
            ("C(DL", "unclosed group"),
            ("CD)L", "unopened group"),
            ("C<DR>L", "a pair is"),
            ("C<RD", "a pair is"),
            ("C*L", "repetition operator missing expression"),
            ("CD*?L", "`?` stands behind `*`"),
            ("C(?i)L", "`?` stands behind `(`"),
            ("CD{2L", "unclosed counted repetition"),
            ("CD{3,2}L", "invalid repetition count range"),
            ("CD[]L", "this set is empty"),
            ("CD[^]L", "this set is empty"),
            ("CD[a]L", "`a` means nothing here"),
        ] {
            let error = translate(expression).expect_err(expression);
            assert!(error.to_string().contains(words), "{expression}: {error}");
        }
    }
}

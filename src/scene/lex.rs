//! A tolerant lexer over RON and JSON text: just enough to find where a value stands. It never fails, whatever the
//! text, and takes memory for one token.

use std::ops::Range;

/// What a token is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    /// `(`, `[` or `{`.
    Open,
    /// `)`, `]` or `}`.
    Close,
    /// `,`.
    Comma,
    /// `:`.
    Colon,
    /// A string or character literal, quotes included.
    Text,
    /// Anything else: a number, an identifier, or something unknown.
    Word,
}

/// The tokens of a text with their byte spans, comments left out.
pub(super) struct Lexer<'a> {
    text: &'a str,
    at: usize,
}

impl<'a> Lexer<'a> {
    pub(super) fn new(text: &'a str) -> Self {
        Self { text, at: 0 }
    }

    fn rest(&self) -> &'a str {
        &self.text[self.at..]
    }

    /// Moves past white space, comments and `#![enable(...)]`.
    fn skip_trivia(&mut self) {
        loop {
            let rest = self.rest();
            let trimmed = rest.trim_start();
            self.at += rest.len() - trimmed.len();
            if trimmed.starts_with("//") {
                self.at += trimmed.find('\n').unwrap_or(trimmed.len());
            } else if trimmed.starts_with("/*") {
                self.at += block_comment_length(trimmed);
            } else if trimmed.starts_with("#![") {
                self.at += trimmed.find(']').map_or(trimmed.len(), |end| end + 1);
            } else {
                return;
            }
        }
    }
}

impl Iterator for Lexer<'_> {
    type Item = (Kind, Range<usize>);

    fn next(&mut self) -> Option<Self::Item> {
        self.skip_trivia();
        let rest = self.rest();
        let (kind, length) = match rest.bytes().next()? {
            b'(' | b'[' | b'{' => (Kind::Open, 1),
            b')' | b']' | b'}' => (Kind::Close, 1),
            b',' => (Kind::Comma, 1),
            b':' => (Kind::Colon, 1),
            b'"' => (Kind::Text, quoted_length(rest, '"')),
            b'\'' => (Kind::Text, quoted_length(rest, '\'')),
            _ => match raw_string_length(rest) {
                Some(length) => (Kind::Text, length),
                None => (Kind::Word, word_length(rest)),
            },
        };
        let start = self.at;
        self.at += length;
        Some((kind, start..self.at))
    }
}

/// Length of the block comment that `text` begins with; they nest. The whole text where it does not end.
fn block_comment_length(text: &str) -> usize {
    let mut depth = 0_usize;
    let mut at = 0;
    while let Some(offset) = text[at..].find(['/', '*']) {
        at += offset;
        if text[at..].starts_with("/*") {
            depth += 1;
            at += 2;
        } else if text[at..].starts_with("*/") {
            depth = depth.saturating_sub(1);
            at += 2;
            if depth == 0 {
                return at;
            }
        } else {
            at += 1;
        }
    }
    text.len()
}

/// Length of the literal that `text` begins with, both quotes included.
fn quoted_length(text: &str, quote: char) -> usize {
    let mut escaped = false;
    for (offset, character) in text.char_indices().skip(1) {
        if escaped {
            escaped = false;
        } else if character == '\\' {
            escaped = true;
        } else if character == quote {
            return offset + character.len_utf8();
        }
    }
    text.len()
}

/// Length of the raw string (`r"..."`, `r#"..."#`) that `text` begins with, if it begins with one.
fn raw_string_length(text: &str) -> Option<usize> {
    let after_r = text.strip_prefix("br").or_else(|| text.strip_prefix('r'))?;
    let hashes = after_r.bytes().take_while(|&byte| byte == b'#').count();
    let content = after_r[hashes..].strip_prefix('"')?;
    let end = format!("\"{}", "#".repeat(hashes));
    let before = text.len() - content.len();
    Some(
        content
            .find(&end)
            .map_or(text.len(), |offset| before + offset + end.len()),
    )
}

/// Length of the word that `text` begins with: at least one character.
fn word_length(text: &str) -> usize {
    text.char_indices()
        .skip(1)
        .find(|(_, character)| character.is_whitespace() || "()[]{},:\"/".contains(*character))
        .map_or(text.len(), |(offset, _)| offset)
}

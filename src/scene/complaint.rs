//! What the RON and JSON parsers complain of, in the words of the format.

use super::error::nearest_name;

/// A parser's complaint, reworded.
pub(super) struct Complaint {
    pub(super) message: String,
    pub(super) help: String,
    /// A name in the text that it is about, to point at.
    pub(super) found: Option<String>,
    /// Whether it is about the bracket around the place.
    pub(super) whole_bracket: bool,
}

impl Complaint {
    fn new(message: impl Into<String>, help: impl Into<String>) -> Self {
        Self {
            message: message.into(),
            help: help.into(),
            found: None,
            whole_bracket: false,
        }
    }

    fn unknown<'a>(what: &str, found: &str, expected: impl IntoIterator<Item = &'a str>) -> Self {
        let help = nearest_name(found, expected);
        Self {
            found: Some(found.to_owned()),
            ..Self::new(format!("unknown {what} `{found}`"), help)
        }
    }

    fn missing(field: &str, outer: Option<&str>, add: &str) -> Self {
        let message = format!("missing field `{field}`{}", within(outer));
        Self {
            whole_bracket: true,
            ..Self::new(message, format!("add {add}"))
        }
    }

    fn twice(field: &str, outer: Option<&str>) -> Self {
        Self::new(
            format!("the field `{field}` stands twice{}", within(outer)),
            "keep one of them",
        )
    }
}

/// What a block is called in messages: its serde name, which RON wants to be an identifier.
fn plain_name(name: &str) -> String {
    name.replace('_', " ")
}

/// The name of a block in a message.
fn within(outer: Option<&str>) -> String {
    outer.map_or_else(String::new, |outer| format!(" in this {}", plain_name(outer)))
}

/// Rewords RON's complaint; `found` is the token where it stands, `before` the text that precedes it.
pub(super) fn complain_ron(code: ron::Error, found: &str, before: &str) -> Complaint {
    use ron::Error as E;
    match code {
        E::NoSuchStructField { expected, found, .. } => Complaint::unknown("field", &found, expected.iter().copied()),
        E::NoSuchEnumVariant { expected, found, outer } => {
            let what = plain_name(outer.as_deref().unwrap_or("name"));
            Complaint::unknown(&what, &found, expected.iter().copied())
        }
        E::MissingStructField { field, outer } => {
            Complaint::missing(field, outer.as_deref(), &format!("`{field}: ...`"))
        }
        E::DuplicateStructField { field, outer } => Complaint::twice(field, outer.as_deref()),
        E::InvalidValueForType { expected, found } => Complaint::new(expected_found(&expected, &found), ""),
        E::ExpectedDifferentLength { expected, found } => {
            Complaint::new(expected_found(&expected, &found.to_string()), "")
        }
        E::ExpectedDifferentStructName { expected, .. } => Complaint::new(
            expected_found("`(`", &quoted(found)),
            format!("a {} begins with a bracket alone", plain_name(expected)),
        ),
        E::IntegerOutOfBounds | E::InvalidIntegerDigit { .. } | E::UnderscoreAtBeginning => {
            Complaint::new(expected_found("u32", &quoted(found)), "")
        }
        E::ExceededRecursionLimit => Complaint::new("brackets are nested too deeply", ""),
        E::TrailingCharacters => Complaint::new(expected_found("the end of the file", &quoted(found)), ""),
        E::Eof => Complaint::new("the file ends too early", "is a bracket or a quote not closed?"),
        E::UnclosedBlockComment => Complaint::new("a comment begins with `/*` and never ends", "close it with `*/`"),
        E::ExpectedComma if found.parse::<f64>().is_ok() && !before.ends_with([')', ']', '}', '"']) => {
            Complaint::new(expected_found("u32", &quoted(found)), "")
        }
        E::ExpectedComma if before.ends_with('"') => Complaint::new(
            expected_found("`,`", &quoted(found)),
            "is a quotation mark missing above?",
        ),
        E::ExpectedStructLike | E::ExpectedNamedStructLike(_) => expected_bracket(found, before),
        E::ExpectedStructLikeEnd => Complaint::new(
            expected_found("`)`", &quoted(found)),
            "is there a value too many, or a bracket not closed?",
        ),
        other => {
            let message = other.to_string();
            match message.strip_prefix("Expected ") {
                Some(expected) => Complaint::new(expected_found(expected, &quoted(found)), ""),
                None => Complaint::new(message, ""),
            }
        }
    }
}

/// RON's complaint that a bracket does not open where one should.
fn expected_bracket(found: &str, before: &str) -> Complaint {
    let name = |text: &str| {
        text.rsplit(|c: char| !c.is_alphanumeric())
            .next()
            .unwrap_or_default()
            .to_owned()
    };
    let help = if let Some(name) = before.strip_suffix('(').map(name).filter(|name| !name.is_empty()) {
        format!("write the numbers in brackets of their own: `{name}((...))`")
    } else if found.starts_with('[') {
        "values that belong together stand in round brackets: `(x, y, z)`".to_owned()
    } else if found.starts_with(|c: char| c.is_ascii_digit() || "+-.".contains(c)) {
        "one number is not enough: write `(x, y, z)`".to_owned()
    } else {
        match name(before) {
            name if name.is_empty() => "is a bracket missing above?".to_owned(),
            name => format!("write `{name}(...)`, or `{name}()` for the defaults"),
        }
    };
    Complaint::new(expected_found("`(`", &quoted(found)), help)
}

/// Rewords JSON's complaint, of which serde_json gives the text alone; `found` is the token where it stands.
pub(super) fn complain_json(error: &serde_json::Error, found: &str) -> Complaint {
    let place = format!(" at line {} column {}", error.line(), error.column());
    let text = error.to_string();
    let text = text.strip_suffix(&place).unwrap_or(&text);
    // The names in it stand in backticks: the one at fault first, then the known ones.
    let names: Vec<&str> = text.split('`').skip(1).step_by(2).collect();
    let known = || names.iter().skip(1).copied();
    let first = names.first().copied().unwrap_or_default();
    if text.starts_with("unknown field") {
        Complaint::unknown("field", first, known())
    } else if text.starts_with("unknown variant") {
        Complaint::unknown("name", first, known())
    } else if text.starts_with("missing field") {
        Complaint::missing(first, None, &format!("`\"{first}\": ...`"))
    } else if text.starts_with("duplicate field") {
        Complaint::twice(first, None)
    } else if let Some((found, expected)) = text
        .strip_prefix("invalid ")
        .and_then(|text| text.split_once(", expected "))
    {
        let found = found
            .split_once(": ")
            .map_or_else(|| found.trim_start_matches("length "), |(_, found)| found);
        Complaint::new(expected_found(expected, found), "")
    } else if text.starts_with("recursion limit") {
        Complaint::new("brackets are nested too deeply", "")
    } else if text.starts_with("EOF") {
        Complaint::new("the file ends too early", "is a bracket or a quote not closed?")
    } else if text == "trailing characters" {
        Complaint::new(
            format!("unexpected {}", quoted(found)),
            "is there a value or a bracket too many?",
        )
    } else if text == "key must be a string" || text == "trailing comma" {
        let help = "JSON has no comments, and no comma before a closing bracket; RON has both";
        Complaint::new(expected_found("a string", &quoted(found)), help)
    } else if text == "number out of range" {
        Complaint::new(
            expected_found("a finite number", &quoted(found)),
            "the largest number is about 3.4e38",
        )
    } else if text == "invalid number" {
        Complaint::new(expected_found("f32", &quoted(found)), "")
    } else if let Some(expected) = text.strip_prefix("expected ") {
        Complaint::new(expected_found(expected, &quoted(found)), "")
    } else {
        Complaint::new(text, "")
    }
}

/// `expected ..., found ...`, with the parsers' and Rust's names for types in plain words.
fn expected_found(expected: &str, found: &str) -> String {
    let expected = match expected {
        "f32" | "float" | "Float" => "a number".to_owned(),
        "u32" | "integer" => "a whole number from 0 to 4294967295".to_owned(),
        "boolean" | "a boolean" => "`true` or `false`".to_owned(),
        "string" | "a string" => "a name in double quotes".to_owned(),
        "comma" => "`,`".to_owned(),
        "colon" => "`:`".to_owned(),
        "identifier" => "a name followed by `(`".to_owned(),
        "value" | "ident" => "a value".to_owned(),
        "end of string" => "`\"` at the end of the string".to_owned(),
        _ => match expected.strip_prefix("an array of length ") {
            Some(length) => format!("{length} values"),
            None => expected
                .trim_start_matches("opening ")
                .trim_start_matches("closing ")
                .to_owned(),
        },
    };
    format!("expected {expected}, found {found}")
}

/// A token as messages show it, shortened.
fn quoted(token: &str) -> String {
    if token.is_empty() {
        return "the end of the file".to_owned();
    }
    let line = token.lines().next().unwrap_or_default();
    match line.char_indices().nth(40) {
        Some((cut, _)) => format!("`{}...`", &line[..cut]),
        None => format!("`{line}`"),
    }
}

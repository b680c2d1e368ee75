//! Makes a derived schema fit to be read: descriptions without rustdoc's links and line breaks, numbers as they were meant.

use crate::scene::description::{DEFAULT_MAX_DEPTH, FORMAT_VERSION, MAX_DEPTH_LIMIT, MAX_FILM_PIXELS, MAX_FILM_SIDE};
use serde_json::{Number, Value};

/// Tidies a schema and all that is in it.
pub(super) fn tidy(schema: &mut Value) {
    match schema {
        Value::Object(entries) => {
            for (key, value) in entries.iter_mut() {
                match value {
                    Value::String(text) if key == "description" => *text = plain(text),
                    _ => tidy(value),
                }
            }
        }
        Value::Array(values) => values.iter_mut().for_each(tidy),
        Value::Number(number) => *number = short(number),
        Value::Null | Value::Bool(_) | Value::String(_) => {}
    }
}

/// Doc comments in plain words: rustdoc's links become their text, pointers at other pages are left out, constants become
/// their values.
fn plain(doc: &str) -> String {
    let mut text = doc
        .split("\n\n")
        .map(|block| block.replace('\n', " "))
        .collect::<Vec<_>>()
        .join("\n\n");
    while let Some(start) = text.find(" See [`") {
        let end = text[start..].find(". ").map_or(text.len(), |end| start + end + 1);
        text.replace_range(start..end, "");
    }
    while let Some(start) = text.find(" ([`") {
        let end = text[start..].find("))").map_or(text.len(), |end| start + end + 2);
        text.replace_range(start..end, "");
    }
    while let Some(start) = text.find("[`") {
        let Some(end) = text[start..].find("`]").map(|end| start + end) else {
            break;
        };
        let target = text[end + 2..].strip_prefix('(').and_then(|rest| rest.find(')'));
        let name = text[start + 2..end].to_owned();
        let stop = end + 2 + target.map_or(0, |target| target + 2);
        text.replace_range(start..stop, &constant(&name).unwrap_or(format!("`{name}`")));
    }
    text
}

/// The value of a constant that descriptions name.
fn constant(name: &str) -> Option<String> {
    let constants = [
        ("DEFAULT_MAX_DEPTH", u64::from(DEFAULT_MAX_DEPTH)),
        ("FORMAT_VERSION", u64::from(FORMAT_VERSION)),
        ("MAX_DEPTH_LIMIT", u64::from(MAX_DEPTH_LIMIT)),
        ("MAX_FILM_PIXELS", MAX_FILM_PIXELS),
        ("MAX_FILM_SIDE", u64::from(MAX_FILM_SIDE)),
    ];
    constants
        .into_iter()
        .find_map(|(known, value)| (known == name).then(|| value.to_string()))
}

/// A number that was an `f32` with that number's digits, and a whole one without a fraction.
fn short(number: &Number) -> Number {
    let Some(wide) = number.as_f64().filter(|_| number.is_f64()) else {
        return number.clone();
    };
    let narrow = wide as f32;
    let meant = match f64::from(narrow) == wide {
        true => narrow.to_string().parse().unwrap_or(wide),
        false => wide,
    };
    if meant.fract() == 0.0 && meant.abs() < 1.0e15 {
        return Number::from(meant as i64);
    }
    Number::from_f64(meant).unwrap_or_else(|| number.clone())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_as_they_were_meant() {
        for (value, text) in [
            (0.4_f32, "0.4"),
            (1.0e12, "1000000000000"),
            (1.0e-4, "0.0001"),
            (-2.0, "-2"),
        ] {
            let mut value = Value::from(value);
            tidy(&mut value);
            assert_eq!(value.to_string(), text);
        }
        assert_eq!(short(&Number::from(7)), Number::from(7));
    }

    #[test]
    fn links_become_words() {
        let doc =
            "Up to [`MAX_FILM_SIDE`], as\nin [`a`](b::c). See [`Sun`](x::Sun) and [`Sky`](x::Sky). End ([`M`](m)).";
        assert_eq!(plain(doc), "Up to 65536, as in `a`. End.");
        assert_eq!(plain("See [`Sun`"), "See [`Sun`");
    }
}

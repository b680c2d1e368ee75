//! Numbers in JSON: those that are not finite as text, since JSON has no other way to tell them from what is missing.

use crate::color::Rgb;
use serde::ser::{Serialize, SerializeSeq, Serializer};

/// A number, or several, of which some may not be finite.
pub trait Number {
    /// Serializes it.
    ///
    /// # Errors
    /// Those of the serializer.
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error>;
}

/// Serializes a field that may not be finite: `#[serde(serialize_with = "number")]`.
///
/// # Errors
/// Those of the serializer.
pub fn number<T: Number, S: Serializer>(value: &T, serializer: S) -> Result<S::Ok, S::Error> {
    value.serialize(serializer)
}

struct Entry<'a, T>(&'a T);

impl<T: Number> Serialize for Entry<'_, T> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        self.0.serialize(serializer)
    }
}

impl Number for f32 {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        if self.is_finite() {
            serializer.serialize_f32(*self)
        } else {
            serializer.collect_str(self)
        }
    }
}

impl Number for f64 {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        if self.is_finite() {
            serializer.serialize_f64(*self)
        } else {
            serializer.collect_str(self)
        }
    }
}

impl Number for Rgb {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut channels = serializer.serialize_seq(Some(3))?;
        for channel in &self.to_array() {
            channels.serialize_element(&Entry(channel))?;
        }
        channels.end()
    }
}

impl<T: Number> Number for Option<T> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self {
            Some(value) => serializer.serialize_some(&Entry(value)),
            None => serializer.serialize_none(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[derive(serde::Serialize)]
    struct Row {
        #[serde(serialize_with = "number")]
        narrow: f32,
        #[serde(serialize_with = "number")]
        wide: f64,
        #[serde(serialize_with = "number")]
        light: Option<Rgb>,
        #[serde(serialize_with = "number")]
        missing: Option<f32>,
    }

    #[test]
    fn what_is_not_finite_can_be_told_from_what_is_missing() {
        let row = Row {
            narrow: 0.1,
            wide: f64::NEG_INFINITY,
            light: Some(Rgb::new(f32::NAN, f32::INFINITY, 0.5)),
            missing: None,
        };
        let json = serde_json::to_string(&row).expect("JSON");
        assert_eq!(
            json,
            r#"{"narrow":0.1,"wide":"-inf","light":["NaN","inf",0.5],"missing":null}"#
        );
    }
}

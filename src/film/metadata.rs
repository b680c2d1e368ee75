//! How a picture was made, as its file tells it.

use super::layer::LONGEST_NAME;
use exr::meta::header::standard_names;

/// How a picture was made: enough to make it again, and nothing that differs between two makings.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct PictureMetadata {
    /// The scene's name or description.
    pub scene: String,
    /// The rendering technique: `pt`, `mlt`, ...
    pub technique: String,
    /// The settings, as text.
    pub settings: String,
    /// The seed of every random number.
    pub seed: u64,
    /// Steps taken: samples per pixel, or mutations per pixel.
    pub steps: u64,
    /// Program and version; stored as the standard attribute `software`.
    pub software: String,
    /// What a technique adds: names (ASCII letters, digits and underscores; none of a picture's own or of OpenEXR's) and
    /// values. Their order does not show in the file.
    pub extra: Vec<(String, String)>,
}

impl PictureMetadata {
    /// The metadata with one thing more in [`PictureMetadata::extra`].
    #[must_use]
    pub fn with(mut self, name: impl Into<String>, value: impl Into<String>) -> Self {
        self.extra.push((name.into(), value.into()));
        self
    }

    /// The attributes beside `software`, as they are named in the file.
    ///
    /// # Errors
    /// Where an extra one cannot have its name; the reason in words.
    pub(super) fn attributes(&self) -> Result<Vec<(&str, String)>, String> {
        let mut attributes = vec![
            ("scene", self.scene.clone()),
            ("technique", self.technique.clone()),
            ("settings", self.settings.clone()),
            ("seed", self.seed.to_string()),
            ("steps", self.steps.to_string()),
        ];
        for (name, value) in &self.extra {
            let letters = name.bytes().all(|b| b.is_ascii_alphanumeric() || b == b'_');
            if name.is_empty() || name.len() > LONGEST_NAME || !letters {
                return Err(format!(
                    "its attribute {name:?} is not named with 1 to {LONGEST_NAME} letters, digits and underscores"
                ));
            }
            if standard_names::ALL.contains(&name.as_bytes()) || attributes.iter().any(|(taken, _)| taken == name) {
                return Err(format!("it has more than one attribute named {name}"));
            }
            attributes.push((name, value.clone()));
        }
        Ok(attributes)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn attributes_are_the_standard_five_and_the_extra_ones() {
        let metadata = PictureMetadata::default()
            .with("groups", "16")
            .with("b_of_lengths", "(1, 2)");
        let names: Vec<String> = metadata
            .attributes()
            .expect("sound")
            .into_iter()
            .map(|(n, _)| n.to_owned())
            .collect();
        assert_eq!(
            names,
            [
                "scene",
                "technique",
                "settings",
                "seed",
                "steps",
                "groups",
                "b_of_lengths"
            ]
        );
    }

    #[test]
    fn names_that_are_taken_or_none_are_refused_in_words() {
        for taken in [
            "scene",
            "technique",
            "settings",
            "seed",
            "steps",
            "software",
            "channels",
            "view",
            "groups",
        ] {
            let metadata = PictureMetadata::default().with("groups", "16").with(taken, "x");
            let refusal = metadata.attributes().expect_err("taken");
            assert_eq!(refusal, format!("it has more than one attribute named {taken}"));
        }
        for name in ["", "a b", "a\0", "ä", &"x".repeat(32)] {
            let refusal = PictureMetadata::default()
                .with(name, "x")
                .attributes()
                .expect_err("no name");
            assert!(refusal.contains(&format!("{name:?}")), "{refusal}");
        }
    }
}

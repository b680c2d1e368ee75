//! Layers as an automaton that is walked along paths.

use super::automaton::table;
use super::expression::{ExpressionError, translate};
use crate::material::Event;
use crate::scene::Scene;
use std::collections::{HashMap, VecDeque};
use std::fmt;

/// The layer of paths that no expression matches.
pub const REST: &str = "other";

/// The most layers, that of the [rest](REST) included.
const MOST: usize = 64;

/// The kind of light that a path ends on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(u8)]
pub enum End {
    /// O: a shape that emits.
    Shape,
    /// P: a light at a point.
    Point,
    /// B: light from infinity.
    Infinity,
}

impl End {
    /// Every kind.
    pub const ALL: [Self; 3] = [Self::Shape, Self::Point, Self::Infinity];
}

/// Where the automaton stands after some of a path's vertices.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct LayerState(u16);

impl LayerState {
    /// At the camera.
    pub const CAMERA: Self = Self(0);
}

/// Why there are no such layers.
#[derive(Clone, Debug, PartialEq, thiserror::Error, miette::Diagnostic)]
pub enum LayerError {
    /// An expression that cannot be read.
    #[error(transparent)]
    #[diagnostic(transparent)]
    Expression(#[from] ExpressionError),
    /// A name that a picture's layer cannot have.
    #[error("{name:?} is no name for a layer")]
    #[diagnostic(help(
        "use the letters a to z and underscores, at most 20, and each name once; {REST} is the layer of all paths that no expression matches"
    ))]
    Name {
        /// The name.
        name: String,
    },
    /// More layers than there can be.
    #[error("{count} layers are asked for, and {MOST} can be")]
    #[diagnostic(help("leave some out: their light is then in the layer {REST}"))]
    TooMany {
        /// How many.
        count: usize,
    },
    /// An automaton that would be too large.
    #[error("these light path expressions are too complicated together")]
    #[diagnostic(help("repeat less, such as .{{2,4}} instead of .{{2,400}}, or ask for fewer layers"))]
    TooComplicated,
    /// A layer that would be black in this scene.
    #[error("no path of this scene can be in the layer {name}={expression}")]
    #[diagnostic(help("{reason}"))]
    Black {
        /// Its name.
        name: String,
        /// Its expression.
        expression: String,
        /// What the scene has, and what layers before it take.
        reason: String,
    },
}

/// The layers of a picture: classes of paths, the [rest](REST) last.
#[derive(Clone, PartialEq, Eq)]
pub struct Layers {
    names: Vec<String>,
    expressions: Vec<String>,
    /// By state and event: the next state.
    next: Vec<[u16; 6]>,
    /// By state and kind of light: the layer of a path that ends there.
    ends: Vec<[u8; 3]>,
}

impl fmt::Debug for Layers {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_map().entries(self.names.iter().zip(&self.expressions)).finish()
    }
}

impl Layers {
    /// The layers of these names and expressions; a path is in the first that it matches.
    ///
    /// # Errors
    /// Expressions that cannot be read or are too complicated, names that no layer can have, too many layers.
    pub fn new<'a>(named: impl IntoIterator<Item = (&'a str, &'a str)>) -> Result<Self, LayerError> {
        let (mut names, mut expressions, mut patterns) = (Vec::new(), Vec::new(), Vec::new());
        for (name, expression) in named {
            let fits = (1..=20).contains(&name.len()) && name.bytes().all(|b| b.is_ascii_lowercase() || b == b'_');
            if !fits || name == REST || is_taken(name) || names.iter().any(|other| other == name) {
                return Err(LayerError::Name { name: name.to_owned() });
            }
            // The whole path has to match.
            patterns.push(format!("(?:{})\\z", translate(expression)?));
            names.push(name.to_owned());
            expressions.push(expression.to_owned());
        }
        if names.len() >= MOST {
            return Err(LayerError::TooMany { count: names.len() });
        }
        let (next, ends) = table(&patterns, names.len() as u8)?;
        names.push(REST.to_owned());
        expressions.push("all others".to_owned());
        Ok(Self {
            names,
            expressions,
            next,
            ends,
        })
    }

    /// The same without the layers that no path of `scene` can be in.
    #[must_use]
    pub fn within(&self, scene: &Scene) -> Self {
        let used = self.used(scene);
        let kept = (0..self.len() - 1).filter(|&layer| used[layer]);
        let named = kept.map(|layer| (self.names[layer].as_str(), self.expressions[layer].as_str()));
        // What could be built with more can be built with less.
        Self::new(named).unwrap_or_else(|_| self.clone())
    }

    /// Refuses layers that no path of `scene` can be in.
    ///
    /// # Errors
    /// The first of them.
    pub fn refuse_black(&self, scene: &Scene) -> Result<(), LayerError> {
        let used = self.used(scene);
        let Some(black) = (0..self.len() - 1).find(|&layer| !used[layer]) else {
            return Ok(());
        };
        let (events, ends) = alphabet(scene);
        let letters: String = events.iter().map(|event| format!("<{}> ", name_of(*event))).collect();
        let lights: Vec<&str> = ends.iter().map(|end| ["O", "P", "B"][*end as usize]).collect();
        Err(LayerError::Black {
            name: self.names[black].clone(),
            expression: self.expressions[black].clone(),
            reason: format!(
                "its surfaces scatter by {}its lights are {}, its paths have at most {} edges, and a path is in the first layer that it \
                 matches: leave this one out, or ask for it earlier",
                if letters.is_empty() {
                    "nothing, ".to_owned()
                } else {
                    letters.trim_end().to_owned() + ", "
                },
                lights.join(" and "),
                scene.max_depth
            ),
        })
    }

    /// Whether some path of the scene can be in each layer.
    fn used(&self, scene: &Scene) -> Vec<bool> {
        let (events, ends) = alphabet(scene);
        let mut used = vec![false; self.len()];
        let mut depths = HashMap::from([(LayerState::CAMERA, 0)]);
        let mut queue = VecDeque::from([LayerState::CAMERA]);
        while let Some(state) = queue.pop_front() {
            for &end in &ends {
                used[self.end(state, end)] = true;
            }
            // A path of as many events has one edge more.
            let depth = depths[&state] + 1;
            if depth >= scene.max_depth {
                continue;
            }
            for &event in &events {
                let next = self.then(state, event);
                depths.entry(next).or_insert_with(|| {
                    queue.push_back(next);
                    depth
                });
            }
        }
        used
    }

    /// How many, that of the rest included.
    #[must_use]
    #[expect(clippy::len_without_is_empty, reason = "there is always the layer of the rest")]
    pub const fn len(&self) -> usize {
        self.names.len()
    }

    /// Their names.
    #[must_use]
    pub fn names(&self) -> &[String] {
        &self.names
    }

    /// Their expressions.
    #[must_use]
    pub fn expressions(&self) -> &[String] {
        &self.expressions
    }

    /// Where the automaton stands behind one event more.
    #[inline]
    #[must_use]
    pub fn then(&self, state: LayerState, event: Event) -> LayerState {
        LayerState(self.next[state.0 as usize][event.number()])
    }

    /// The layer of a path that ends here.
    #[inline]
    #[must_use]
    pub fn end(&self, state: LayerState, end: End) -> usize {
        usize::from(self.ends[state.0 as usize][end as usize])
    }
}

/// Whether another layer of pictures has the name.
fn is_taken(name: &str) -> bool {
    matches!(name, "error" | "weight" | "block_error" | "agreement")
}

/// An event in letters.
fn name_of(event: Event) -> &'static str {
    ["RD", "TD", "RG", "TG", "RS", "TS"][event.number()]
}

/// The events and lights that paths of a scene can have.
fn alphabet(scene: &Scene) -> (Vec<Event>, Vec<End>) {
    let kinds = scene.materials.kinds();
    let has = |event: &Event| kinds.iter().any(|kind| kind.events().contains(event));
    let events = Event::ALL.into_iter().filter(has).collect();
    let lights: Vec<End> = (0..scene.lights.len() as u32)
        .map(|light| scene.lights.endpoint(light).into())
        .collect();
    (
        events,
        End::ALL.into_iter().filter(|end| lights.contains(end)).collect(),
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::layer::expression::event_byte;
    use crate::layer::standard;
    use proptest::prelude::*;

    /// The layer of a path in letters, such as `<RD><TS>O`.
    fn layer(layers: &Layers, path: &[Event], end: End) -> String {
        let state = path
            .iter()
            .fold(LayerState::CAMERA, |state, &event| layers.then(state, event));
        layers.names()[layers.end(state, end)].clone()
    }

    #[test]
    fn a_path_is_in_the_first_layer_that_it_matches() {
        let layers = Layers::new([("seen", "CL"), ("sky", "C.*B"), ("matt", "CD+L")]).expect("expressions");
        let (d, s) = (Event::RD, Event::TS);
        for (path, end, expected) in [
            (&[][..], End::Shape, "seen"),
            (&[], End::Infinity, "seen"),
            (&[d], End::Infinity, "sky"),
            (&[d], End::Point, "matt"),
            (&[d, d, d], End::Shape, "matt"),
            (&[d, s], End::Shape, "other"),
            (&[s, s], End::Infinity, "sky"),
        ] {
            assert_eq!(layer(&layers, path, end), expected, "{path:?} {end:?}");
        }
    }

    #[test]
    fn no_layers_leave_everything_to_the_rest() {
        let layers = Layers::new([]).expect("nothing to refuse");
        assert_eq!(
            (layers.len(), layer(&layers, &[Event::RG], End::Point).as_str()),
            (1, REST)
        );
    }

    #[test]
    fn the_standard_layers_are_those_of_the_field() {
        let layers = standard();
        let (d, g, s) = (Event::RD, Event::RG, Event::TS);
        for (path, expected) in [
            (&[][..], "emitted"),
            (&[s], "specular"),
            (&[s, s, s], "specular"),
            (&[d], "direct"),
            (&[g], "direct"),
            (&[d, d], "diffuse"),
            (&[d, d, d], "diffuse"),
            (&[d, g], "glossy"),
            (&[g, g, d], "glossy"),
            (&[d, s], "caustic"),
            (&[d, d, s, s], "caustic"),
            (&[s, d, s], "sds"),
            (&[s, d, s, s, d, s], "sds"),
            (&[s, d, d, s], "caustic"),
            (&[s, d], "seen_specular"),
            (&[d, s, d], "other"),
        ] {
            assert_eq!(layer(&layers, path, End::Shape), expected, "{path:?}");
        }
        assert_eq!(layer(&layers, &[], End::Infinity), "environment");
        assert_eq!(layer(&layers, &[s, s], End::Infinity), "environment");
        assert_eq!(layer(&layers, &[d], End::Infinity), "direct");
    }

    #[test]
    fn names_and_numbers_of_layers_are_checked() {
        for name in [
            "",
            "Direct",
            "other",
            "error",
            "agreement",
            "much_too_long_for_a_layer",
            "a.b",
        ] {
            assert!(
                matches!(Layers::new([(name, "CL")]), Err(LayerError::Name { .. })),
                "{name}"
            );
        }
        assert!(matches!(
            Layers::new([("a", "CL"), ("a", "CDL")]),
            Err(LayerError::Name { .. })
        ));
        let complicated = "C(.*S.{60}){30}L";
        assert_eq!(Layers::new([("a", complicated)]), Err(LayerError::TooComplicated));
    }

    /// Whether a path matches an expression of this little grammar, by trying.
    fn matches(expression: &str, path: &str) -> bool {
        let pattern = format!("^(?:{expression})$");
        let classes = [("D", "[ab]"), ("S", "[ef]"), (".", "[abcdef]"), ("L", "[xyz]")];
        let pattern = classes
            .iter()
            .fold(pattern, |pattern, (letter, class)| pattern.replace(letter, class));
        regex_automata::meta::Regex::new(&pattern).is_ok_and(|regex| regex.is_match(path))
    }

    proptest! {
        #[test]
        fn the_automaton_says_what_a_regular_expression_says(
            parts in prop::collection::vec("(D|S|\\.)(\\*|\\+|\\?)?", 0..4),
            path in prop::collection::vec(0_usize..6, 0..6),
        ) {
            let expression: String = parts.concat() + "L";
            let layers = Layers::new([("found", format!("C{expression}").as_str())]).expect("a valid expression");
            let events: Vec<Event> = path.iter().map(|&number| Event::ALL[number]).collect();
            let letters: String = events.iter().map(|&event| char::from(event_byte(event))).chain(['x']).collect();
            let expected = if matches(&expression, &letters) { "found" } else { REST };
            prop_assert_eq!(layer(&layers, &events, End::Shape), expected, "{} {}", expression, letters);
        }
    }
}

//! Saving a render, so that it can go on another time as if it had never stopped: the same bytes in the end.
//!
//! A saved render names what it is of (scene, technique, settings, seed); it goes on only where all of that is the same.
//! It holds the steps taken, the films, and for chains their normalizations and every tile.

use super::bytes::{CutOff, Hash, Reader, Writer};
use super::layers::LayerSums;
use super::tile_world::lock;
use super::{ChainRender, Render, Rendering, SplatRender, Start, saved_states, saved_tile};
use crate::chain::Normalization;
use crate::film::{GroupFilm, SavedFilmError};
use crate::path::bidirectional::Weights;
use crate::plan::{Base, Plan, StateSpace};
use crate::scene::Scene;
use std::fmt::Write;

/// What a saved render begins with: its kind and version.
const KIND: &[u8; 24] = b"chainlight saved render3";

/// Steps beyond this are those of no render, and would be keys of bootstraps.
const LAST_STEP: u64 = 1 << 62;

/// Why a saved render cannot go on.
#[derive(Debug, thiserror::Error, miette::Diagnostic)]
pub enum SavedRenderError {
    /// Another kind of file, or of another version.
    #[error("this is no saved render of the kind and version that is read here")]
    #[diagnostic(help("give the file that --save wrote, with the version of chainlight that wrote it"))]
    Kind,
    /// The file is cut off or changed.
    #[error("the saved render is damaged")]
    #[diagnostic(help("the file was cut off or changed after it was written: render anew"))]
    Damaged,
    /// It is of another render.
    #[error("the saved render is of another one: {name} is {saved} there, and {own} here")]
    #[diagnostic(help("go on with the scene, the technique and the settings that it was begun with"))]
    Other {
        /// What differs.
        name: String,
        /// As it was saved.
        saved: String,
        /// As it is here.
        own: String,
    },
    /// One of its films is damaged.
    #[error(transparent)]
    #[diagnostic(transparent)]
    Film(#[from] SavedFilmError),
}

impl From<CutOff> for SavedRenderError {
    fn from(_: CutOff) -> Self {
        Self::Damaged
    }
}

/// A name and a value for everything that a render's bytes depend on.
fn identity(scene: &Scene, plan: &Plan, seed: u64) -> Vec<(String, String)> {
    let mut hash = Hash::default();
    // Writing to a hash cannot fail.
    let _ = write!(hash, "{scene:?}");
    let mut identity = vec![
        ("technique".to_owned(), plan.technique.name().to_owned()),
        ("the seed".to_owned(), seed.to_string()),
        ("the film".to_owned(), format!("{} x {}", scene.width, scene.height)),
        ("max_depth".to_owned(), scene.max_depth.to_string()),
    ];
    // Those that are set by options carry the options' names and words.
    if plan.technique.space() == Some(StateSpace::PRIMARY) {
        let base = if plan.strategies.is_some() {
            Base::Bdpt
        } else {
            Base::Pt
        };
        identity.push(("--base".to_owned(), base.to_string()));
    }
    if plan.technique.space() == Some(StateSpace::PATH) {
        identity.push(("--direct".to_owned(), plan.direct_by().to_string()));
    }
    let strategy = match plan.strategies.map(|strategies| strategies.weights) {
        Some(Weights::Only(s, t)) => format!("{s},{t}"),
        Some(Weights::All | Weights::Lens) | None => "left out".to_owned(),
    };
    identity.push(("--strategy".to_owned(), strategy));
    identity.push(("--heuristic".to_owned(), plan.tile.heuristic.to_string()));
    if let Some(chains) = &plan.chains {
        let counts = chains.counts;
        identity.push(("the number of groups".to_owned(), counts.groups.to_string()));
        identity.push(("the number of chains of a group".to_owned(), counts.chains.to_string()));
        let samples = u64::from(counts.rounds) * u64::from(counts.chains);
        identity.push(("the number of bootstrap samples".to_owned(), samples.to_string()));
        identity.push(("the number of chains of a tile".to_owned(), plan.tile.size.to_string()));
        for planned in &chains.mutations {
            let name = format!("the mutation {}", planned.mutation.name());
            identity.push((name, planned.mutation.settings().to_string()));
        }
    }
    for (name, expression) in plan
        .layers
        .iter()
        .flat_map(|layers| layers.names().iter().zip(layers.expressions()))
    {
        identity.push((format!("the layer {name}"), expression.clone()));
    }
    identity.push(("the scene (as a hash)".to_owned(), format!("{:016x}", hash.0)));
    identity
}

fn save_identity(out: &mut Writer, identity: &[(String, String)]) {
    out.number(identity.len() as u64);
    for (name, value) in identity {
        out.list(name.as_bytes());
        out.list(value.as_bytes());
    }
}

fn check_identity(saved: &mut Reader<'_>, own: &[(String, String)]) -> Result<(), SavedRenderError> {
    let count = saved.number()?;
    let mut own = own.iter();
    for _ in 0..count {
        let name = String::from_utf8_lossy(saved.list()?).into_owned();
        let value = String::from_utf8_lossy(saved.list()?).into_owned();
        let here = own.next().filter(|(own_name, _)| *own_name == name);
        let here = here.map_or_else(|| "absent".to_owned(), |(_, value)| value.clone());
        if here != value {
            return Err(SavedRenderError::Other {
                name,
                saved: value,
                own: here,
            });
        }
    }
    match own.next() {
        Some((name, value)) => Err(SavedRenderError::Other {
            name: name.clone(),
            saved: "absent".to_owned(),
            own: value.clone(),
        }),
        None => Ok(()),
    }
}

fn finish(mut out: Writer) -> Vec<u8> {
    let mut hash = Hash::default();
    hash.add(&out.bytes);
    out.number(hash.0);
    out.bytes
}

/// The body of a saved render whose frame is sound.
fn open(bytes: &[u8]) -> Result<Reader<'_>, SavedRenderError> {
    let rest = bytes.strip_prefix(KIND).ok_or(SavedRenderError::Kind)?;
    let (body, sum) = rest.split_last_chunk().ok_or(SavedRenderError::Damaged)?;
    let mut hash = Hash::default();
    hash.add(&bytes[..KIND.len() + body.len()]);
    if u64::from_le_bytes(*sum) != hash.0 {
        return Err(SavedRenderError::Damaged);
    }
    Ok(Reader { bytes: body })
}

fn begin() -> Writer {
    Writer { bytes: KIND.to_vec() }
}

impl Render {
    /// The render so far, to go on from with [`restore`](Self::restore).
    #[must_use]
    pub fn save(&self) -> Vec<u8> {
        let mut out = begin();
        save_identity(&mut out, &identity(&self.scene, &self.plan, self.seed));
        out.number(self.steps());
        let mut film = Vec::new();
        self.film.save(&mut film);
        out.list(&film);
        save_layers(&mut out, self.layers.as_ref());
        finish(out)
    }

    /// Takes a saved render up: this render, which has taken no step yet, then stands where that one stopped.
    ///
    /// # Errors
    /// Bytes that are no saved render, or one of another scene, technique, size or seed.
    pub fn restore(&mut self, bytes: &[u8]) -> Result<(), SavedRenderError> {
        let mut saved = open(bytes)?;
        check_identity(&mut saved, &identity(&self.scene, &self.plan, self.seed))?;
        let steps = saved.number()?;
        let film = saved.list()?;
        restore_layers(&mut saved, self.layers.as_ref())?;
        if !saved.bytes.is_empty() || steps > LAST_STEP {
            return Err(SavedRenderError::Damaged);
        }
        self.film.restore(film)?;
        self.samples.steps = steps;
        Ok(())
    }
}

impl SplatRender {
    /// The render so far, to go on from with [`restore`](Self::restore).
    #[must_use]
    pub fn save(&self) -> Vec<u8> {
        let mut out = begin();
        save_identity(&mut out, &identity(&self.scene, &self.plan, self.seed));
        out.number(self.steps());
        for film in self.films.iter() {
            let mut bytes = Vec::new();
            lock(film).save(&mut bytes);
            out.list(&bytes);
        }
        save_layers(&mut out, self.layers.as_ref());
        finish(out)
    }

    /// Takes a saved render up: this render, which has taken no step yet, then stands where that one stopped.
    ///
    /// # Errors
    /// Bytes that are no saved render, or one of another scene, technique, size or seed.
    pub fn restore(&mut self, bytes: &[u8]) -> Result<(), SavedRenderError> {
        let mut saved = open(bytes)?;
        check_identity(&mut saved, &identity(&self.scene, &self.plan, self.seed))?;
        let steps = saved.number()?;
        let size = (self.scene.width, self.scene.height);
        let mut films = Vec::with_capacity(self.films.len());
        for _ in 0..self.films.len() {
            let film = GroupFilm::load(saved.list()?)?;
            if (film.width(), film.height()) != size {
                return Err(SavedRenderError::Damaged);
            }
            films.push(film);
        }
        restore_layers(&mut saved, self.layers.as_ref())?;
        if !saved.bytes.is_empty() || steps > LAST_STEP {
            return Err(SavedRenderError::Damaged);
        }
        for (film, restored) in self.films.iter().zip(films) {
            *lock(film) = restored;
        }
        self.samples.steps = steps;
        Ok(())
    }
}

impl ChainRender {
    /// The render so far, to go on from with [`restore`](Self::restore).
    #[must_use]
    pub fn save(&self) -> Vec<u8> {
        let mut out = begin();
        save_identity(&mut out, &identity(&self.scene, &self.plan, self.run.seed()));
        out.number(self.run.steps());
        for start in self.run.starts() {
            out.real(start.normalization.b);
            out.real(start.normalization.standard_error);
            out.number(start.normalization.samples);
            out.number(start.distinct_seeds as u64);
            start.class_weights.iter().for_each(|&weight| out.real(weight));
        }
        for film in &self.films {
            let mut bytes = Vec::new();
            lock(film).save(&mut bytes);
            out.list(&bytes);
        }
        self.run
            .for_each_tile(&mut |_, world| out.list(&saved_tile::save(world, &self.plan.tile)));
        if let Some(direct) = &self.direct {
            let mut film = Vec::new();
            direct.film.save(&mut film);
            out.list(&film);
            save_layers(&mut out, direct.layers.as_ref());
        }
        save_layers(&mut out, self.layers.as_ref());
        finish(out)
    }

    /// Takes a saved render up: this render, which need not have been bootstrapped, then stands where that one stopped.
    ///
    /// # Errors
    /// Bytes that are no saved render, or one of another scene, technique, size, seed, or other chains.
    pub fn restore(&mut self, bytes: &[u8]) -> Result<(), SavedRenderError> {
        let mut saved = open(bytes)?;
        check_identity(&mut saved, &identity(&self.scene, &self.plan, self.run.seed()))?;
        let steps = saved.number()?;
        let counts = self.run.counts();
        let samples = u64::from(counts.rounds) * u64::from(counts.chains);
        for start in &mut self.run.starts {
            restore_start(&mut saved, start)?;
            let Normalization { b, samples: found, .. } = start.normalization;
            if !(b >= 0.0 && b.is_finite() && found == samples) {
                return Err(SavedRenderError::Damaged);
            }
        }
        for film in &self.films {
            let restored = GroupFilm::load(saved.list()?)?;
            if (restored.width(), restored.height()) != (self.scene.width, self.scene.height) {
                return Err(SavedRenderError::Damaged);
            }
            *lock(film) = restored;
        }
        let mut outcome = Ok(());
        self.run.for_each_tile(&mut |_, world| {
            if outcome.is_ok() {
                let restored = saved
                    .list()
                    .and_then(|bytes| saved_tile::restore(world, &self.plan.tile, bytes));
                outcome = restored.map_err(SavedRenderError::from);
            }
        });
        outcome?;
        let of_direct = self.direct.as_ref().map(|_| saved.list()).transpose()?;
        if let Some(direct) = &self.direct {
            restore_layers(&mut saved, direct.layers.as_ref())?;
        }
        restore_layers(&mut saved, self.layers.as_ref())?;
        if !saved.bytes.is_empty() || steps > LAST_STEP || !saved_states::are_sound(&self.run, &self.scene) {
            return Err(SavedRenderError::Damaged);
        }
        if let (Some(direct), Some(film)) = (&mut self.direct, of_direct) {
            direct.film.restore(film)?;
        }
        self.run.steps = steps;
        self.run.set_units();
        self.weigh_layers();
        let mutations = self.mutations();
        if let Some(direct) = &mut self.direct {
            direct.taken = direct.due(mutations);
        }
        Ok(())
    }
}

fn save_layers(out: &mut Writer, layers: Option<&LayerSums>) {
    for film in layers.map_or_else(Vec::new, |layers| layers.films.save()) {
        out.list(&film);
    }
}

fn restore_layers(saved: &mut Reader<'_>, layers: Option<&LayerSums>) -> Result<(), SavedRenderError> {
    let Some(layers) = layers else { return Ok(()) };
    layers.films.restore(|| Ok(saved.list()?), || SavedRenderError::Damaged)
}

fn restore_start(saved: &mut Reader<'_>, start: &mut Start) -> Result<(), CutOff> {
    start.normalization = Normalization {
        b: saved.real()?,
        standard_error: saved.real()?,
        samples: saved.number()?,
    };
    start.distinct_seeds = usize::try_from(saved.number()?).map_err(|_| CutOff)?;
    for weight in &mut start.class_weights {
        *weight = saved.real()?;
    }
    Ok(())
}

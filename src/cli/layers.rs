//! `--layers` and `--layer`: which light comes by which paths.

use super::output::duration;
use crate::layer::{Layers, standard};
use crate::render::LayerRecord;
use crate::scene::Scene;
use clap::Args;
use miette::Result;
use std::fmt::Write;
use std::sync::Arc;

/// Layers that light is split into.
#[derive(Args, Clone, Debug, Default)]
pub struct LayerArgs {
    /// Split light into layers by the paths that bring it, which sum to the picture, and are in its file and as PNGs beside it: emitted, environment, specular, direct, diffuse,
    /// glossy, sds (found by no connection), caustic, seen_specular, other, as far as the scene has such paths
    #[arg(long)]
    layers: bool,
    /// Split light into a layer of this name: the paths that match a light path expression and none asked for before, such as
    /// caustics=C.*DS+L; the rest is in the layer `other`. Can be given several times
    #[arg(long, value_name = "NAME=EXPRESSION", value_parser = parse_layer, conflicts_with = "layers")]
    layer: Vec<(String, String)>,
}

impl LayerArgs {
    /// The layers that were asked for, if any were.
    ///
    /// # Errors
    /// Expressions that cannot be read, names that cannot be used, and layers that no path of the scene can be in.
    pub fn of(&self, scene: &Scene) -> Result<Option<Arc<Layers>>> {
        if self.layers {
            return Ok(Some(Arc::new(standard().within(scene))));
        }
        if self.layer.is_empty() {
            return Ok(None);
        }
        let named = self
            .layer
            .iter()
            .map(|(name, expression)| (name.as_str(), expression.as_str()));
        let layers = Layers::new(named)?;
        layers.refuse_black(scene)?;
        Ok(Some(Arc::new(layers)))
    }

    /// Whether any were asked for.
    pub const fn is_given(&self) -> bool {
        self.layers || !self.layer.is_empty()
    }
}

/// What layers cost, as a table: of a render that took so many seconds.
pub fn table(layers: &[LayerRecord], seconds: f64) -> String {
    let mut out = format!(
        "{:<14} {:<20} {:>8} {:>26} {:>12} {:>8} {:>10}",
        "layer", "paths", "light", "its error (95 %)", "of the error", "time", "1 % after"
    );
    for layer in layers {
        let percent = |share: f64| format!("{:.1} %", 100.0 * share);
        let error = layer.error.map_or_else(
            || "not known".to_owned(),
            |error| {
                let [low, high] = error.interval.map(|bound| 100.0 * bound);
                format!("{:.2} % ({low:.2} to {high:.2})", 100.0 * error.rms)
            },
        );
        let after = layer
            .times_to(0.01)
            .map_or_else(String::new, |times| duration(times * seconds));
        // Writing to a String cannot fail.
        let _ = write!(
            out,
            "\n{:<14} {:<20} {:>8} {error:>26} {:>12} {:>8} {after:>10}",
            layer.name,
            layer.expression,
            percent(layer.light_share),
            percent(layer.error_share),
            percent(layer.time_share),
        );
    }
    out
}

fn parse_layer(text: &str) -> Result<(String, String), String> {
    let named = text.split_once('=').filter(|(name, _)| !name.is_empty());
    let (name, expression) = named.ok_or("expected NAME=EXPRESSION, such as caustics=C.*DS+L")?;
    Ok((name.to_owned(), expression.to_owned()))
}

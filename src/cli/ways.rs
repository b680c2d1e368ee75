//! Ways to render, as commands that compare several are told of them.

use super::load::{SceneArgs, TechniqueChoice};
use crate::plan::Technique;
use crate::study::WaySettings;
use clap::{Args, Parser};
use miette::{Result, miette};
use std::path::Path;

/// Which ways to compare.
#[derive(Args, Clone, Debug)]
pub struct WayArgs {
    /// Techniques to render with, each with its defaults; the first is the one that others are compared with
    #[arg(
        long,
        value_name = "NAME,...",
        value_delimiter = ',',
        value_parser = parse_technique,
        default_value = "pt,bdpt,pssmlt,mlt"
    )]
    techniques: Vec<Technique>,
    /// One more way to render: a name, and options of `render`, such as "no lens=--technique mlt --mutation lens:weight=0"
    #[arg(long, value_name = "NAME=OPTIONS")]
    way: Vec<String>,
}

impl WayArgs {
    /// The ways, techniques first.
    ///
    /// # Errors
    /// A way without a name, or two of the same.
    pub fn settings(&self) -> Result<Vec<WaySettings>> {
        let mut ways: Vec<WaySettings> = self.techniques.iter().copied().map(way_of).collect();
        for text in &self.way {
            let parts = text.split_once('=').filter(|(name, _)| !name.trim().is_empty());
            let (name, options) = parts
                .ok_or_else(|| miette!("--way {text}: expected NAME=OPTIONS, such as \"bdpt=--technique bdpt\""))?;
            ways.push(WaySettings {
                name: name.trim().to_owned(),
                options: options.split_whitespace().map(str::to_owned).collect(),
            });
        }
        let twice = |(i, way): &(usize, &WaySettings)| ways[..*i].iter().any(|other| other.name == way.name);
        if let Some((_, way)) = ways.iter().enumerate().find(twice) {
            return Err(miette!("there are two ways named {}: give one another name", way.name));
        }
        Ok(ways)
    }
}

/// A technique with its defaults, as a way.
pub fn way_of(technique: Technique) -> WaySettings {
    WaySettings {
        name: technique.name().to_owned(),
        options: vec!["--technique".to_owned(), technique.name().to_owned()],
    }
}

/// The options of a way, as `render` reads them.
#[derive(Parser, Debug)]
#[command(no_binary_name = true)]
struct WayOptions {
    #[command(flatten)]
    scene: SceneArgs,
}

/// What `options` say of how to render the scene in `file`, on a film of `size` where one is given.
///
/// # Errors
/// Options that `render` does not have.
pub fn way_options(file: &Path, options: &[String], size: Option<(u32, u32)>) -> Result<SceneArgs> {
    let mut words = vec![file.as_os_str().to_owned()];
    words.extend(options.iter().map(Into::into));
    let mut parsed = WayOptions::try_parse_from(words)
        .map_err(|error| miette!("options of a way: {}", error.to_string().trim_start_matches("error: ")))?
        .scene;
    parsed.size = size.or(parsed.size);
    Ok(parsed)
}

/// A technique, and no choice among them.
fn parse_technique(text: &str) -> Result<Technique, String> {
    match text
        .parse()
        .map_err(|error: crate::plan::UnknownTechnique| error.to_string())?
    {
        TechniqueChoice::One(technique) => Ok(technique),
        TechniqueChoice::Auto => {
            Err("`auto` is a choice among techniques, and here they are compared: name them, such as pt,mlt".to_owned())
        }
    }
}

//! `--groups`, `--chains` and `--bootstrap`: how chains are run.

use crate::plan::ChainSettings;
use clap::Args;
use miette::{Result, miette};

/// The most chains of a render: their numbers have 32 bits.
const MOST_CHAINS: u64 = 1 << 26;

/// How chains are run, for techniques that have some.
#[derive(Args, Clone, Copy, Debug, Default)]
pub struct ChainArgs {
    /// Independent groups of chains, whose spread is the picture's error [default: 16]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=4096))]
    groups: Option<u32>,
    /// Chains of each group [default: one for every 8 pixels of the film in all, from 64 to 1024 a group]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=1 << 20))]
    chains: Option<u32>,
    /// Samples of each group's bootstrap [default: 64 for each chain, at least 4096]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=1 << 26))]
    bootstrap: Option<u32>,
}

impl ChainArgs {
    /// The first of these options that was given, as it was written.
    #[must_use]
    pub fn given(self) -> Option<String> {
        let options = [
            ("--groups", self.groups),
            ("--chains", self.chains),
            ("--bootstrap", self.bootstrap),
        ];
        options
            .into_iter()
            .find_map(|(name, value)| Some(format!("{name} {}", value?)))
    }

    /// The settings, defaults where nothing was given.
    ///
    /// # Errors
    /// More chains in all than there are numbers for, or more samples of a bootstrap.
    pub fn settings(self) -> Result<ChainSettings> {
        let defaults = ChainSettings::default();
        let groups = self.groups.unwrap_or(defaults.groups);
        let all = u64::from(groups) * u64::from(self.chains.unwrap_or(1));
        if all > MOST_CHAINS {
            return Err(miette!(
                help = "ask for fewer with --groups or --chains",
                "{all} chains are too many: there can be {MOST_CHAINS}"
            ));
        }
        Ok(ChainSettings {
            groups,
            chains: self.chains,
            bootstrap: self.bootstrap,
            ..defaults
        })
    }
}

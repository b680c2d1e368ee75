//! The `settings` block.

use crate::scene::schema::quantity;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// `max_depth` where the file does not say.
pub const DEFAULT_MAX_DEPTH: u32 = 16;
/// The largest `max_depth`.
pub const MAX_DEPTH_LIMIT: u32 = 1024;

/// How to render. The command line overrides all of it.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, rename = "settings")]
#[schemars(rename = "Settings")]
pub struct SettingsDescription {
    /// The most edges of a path, in 1..=[`MAX_DEPTH_LIMIT`]: 1 shows emitters seen directly, 2 adds direct light.
    /// Default [`DEFAULT_MAX_DEPTH`].
    #[serde(default = "default_max_depth")]
    #[schemars(with = "quantity::MaxDepth")]
    pub max_depth: u32,
    /// The technique to render with. Default: none, the command line's default. Its name is checked where techniques
    /// are registered, not here.
    #[serde(default)]
    pub technique: Option<String>,
}

impl Default for SettingsDescription {
    fn default() -> Self {
        Self {
            max_depth: DEFAULT_MAX_DEPTH,
            technique: None,
        }
    }
}

fn default_max_depth() -> u32 {
    DEFAULT_MAX_DEPTH
}

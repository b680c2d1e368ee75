//! Reads a map whose keys must differ: serde's own maps keep the last of two silently.

use serde::de::{Deserialize, Deserializer, Error, MapAccess, Visitor};
use std::collections::BTreeMap;
use std::fmt;
use std::marker::PhantomData;

/// Reads a map from names to materials, and refuses a second entry of the same name.
pub(super) fn materials<'de, D, V>(deserializer: D) -> Result<BTreeMap<String, V>, D::Error>
where
    D: Deserializer<'de>,
    V: Deserialize<'de>,
{
    deserializer.deserialize_map(UniqueMap("materials", PhantomData))
}

/// Reads a map from names to textures, and refuses a second entry of the same name.
pub(super) fn textures<'de, D, V>(deserializer: D) -> Result<BTreeMap<String, V>, D::Error>
where
    D: Deserializer<'de>,
    V: Deserialize<'de>,
{
    deserializer.deserialize_map(UniqueMap("textures", PhantomData))
}

/// What the entries are called, and what they are.
struct UniqueMap<V>(&'static str, PhantomData<V>);

impl<'de, V: Deserialize<'de>> Visitor<'de> for UniqueMap<V> {
    type Value = BTreeMap<String, V>;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "a map from names to {}", self.0)
    }

    fn visit_map<A: MapAccess<'de>>(self, mut entries: A) -> Result<Self::Value, A::Error> {
        let mut map = BTreeMap::new();
        while let Some(name) = entries.next_key::<String>()? {
            // Before the value is read, so that the error stands at the second name.
            if map.contains_key(&name) {
                return Err(A::Error::custom(format_args!("two {} are named `{name}`", self.0)));
            }
            let value = entries.next_value()?;
            map.insert(name, value);
        }
        Ok(map)
    }
}

//! What scattering does to a path, as light path expressions write it (Heckbert 1990, extended by what production renderers tell apart).

/// How widely a lobe scatters.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Lobe {
    /// D: about all directions.
    Diffuse,
    /// G: about a mirrored or refracted direction, with a density.
    Glossy,
    /// S: into one of a few directions.
    Specular,
}

/// An event at a vertex where a path is scattered.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Event {
    /// The lobe.
    pub lobe: Lobe,
    /// Whether the path goes through the surface (T), or stays on its side (R).
    pub transmits: bool,
}

impl Event {
    /// Matt reflection.
    pub const RD: Self = Self::new(Lobe::Diffuse, false);
    /// Matt transmission.
    pub const TD: Self = Self::new(Lobe::Diffuse, true);
    /// Glossy reflection.
    pub const RG: Self = Self::new(Lobe::Glossy, false);
    /// Glossy transmission.
    pub const TG: Self = Self::new(Lobe::Glossy, true);
    /// A mirror's reflection.
    pub const RS: Self = Self::new(Lobe::Specular, false);
    /// Refraction at a smooth interface.
    pub const TS: Self = Self::new(Lobe::Specular, true);

    /// Every event, by [`number`](Self::number).
    pub const ALL: [Self; 6] = [Self::RD, Self::TD, Self::RG, Self::TG, Self::RS, Self::TS];

    /// The event of a lobe.
    #[inline]
    #[must_use]
    pub const fn new(lobe: Lobe, transmits: bool) -> Self {
        Self { lobe, transmits }
    }

    /// Its place in [`ALL`](Self::ALL).
    #[inline]
    #[must_use]
    pub const fn number(self) -> usize {
        self.lobe as usize * 2 + self.transmits as usize
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn events_are_numbered_as_they_are_listed() {
        for (number, event) in Event::ALL.into_iter().enumerate() {
            assert_eq!(event.number(), number, "{event:?}");
        }
    }
}

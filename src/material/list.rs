//! The list of material models: a line each. Tables, lists of chains, scatter systems and plans follow from it.

/// Calls a macro with every model: its name (of the type, and of its variant of [`MaterialKind`](super::MaterialKind)), the
/// name of its table, what plans call it, its scatter system, whether all its lobes are discrete, whether it needs a number to
/// choose between them, and the events they are in light path expressions.
macro_rules! for_each_material {
    ($callback:ident) => {
        $callback! {
            Diffuse, diffuse, "diffuse", scatter_diffuse, discrete: false, lobes: false, events: [RD];
            Conductor, conductor, "conductor", scatter_conductor, discrete: true, lobes: false, events: [RS];
            Dielectric, dielectric, "dielectric", scatter_dielectric, discrete: true, lobes: false, events: [RS, TS];
            RoughConductor, rough_conductor, "rough conductor", scatter_rough_conductor, discrete: false, lobes: false, events: [RG];
            RoughDielectric, rough_dielectric, "rough dielectric", scatter_rough_dielectric, discrete: false, lobes: true, events: [RG, TG];
            Plastic, plastic, "plastic", scatter_plastic, discrete: false, lobes: true, events: [RD, RS];
        }
    };
}

pub(crate) use for_each_material;

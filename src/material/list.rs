//! The list of material models: a line each. Tables, lists of chains, scatter systems and plans follow from it.

/// Calls a macro with every model: its name (of the type, and of its variant of [`MaterialKind`](super::MaterialKind)), the
/// name of its table, what plans call it, its scatter system, whether all its lobes are discrete, and whether it needs a
/// number to choose between them.
macro_rules! for_each_material {
    ($callback:ident) => {
        $callback! {
            Diffuse, diffuse, "diffuse", scatter_diffuse, discrete: false, lobes: false;
            Conductor, conductor, "conductor", scatter_conductor, discrete: true, lobes: false;
            Dielectric, dielectric, "dielectric", scatter_dielectric, discrete: true, lobes: false;
            RoughConductor, rough_conductor, "rough conductor", scatter_rough_conductor, discrete: false, lobes: false;
            RoughDielectric, rough_dielectric, "rough dielectric", scatter_rough_dielectric, discrete: false, lobes: true;
            Plastic, plastic, "plastic", scatter_plastic, discrete: false, lobes: true;
        }
    };
}

pub(crate) use for_each_material;

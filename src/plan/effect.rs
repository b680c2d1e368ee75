//! Effects: the classes of light transport that a scene may call for.

use crate::material::MaterialKind;
use crate::scene::Scene;

/// A class of light transport.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Effect {
    /// Surfaces that emit.
    Emission,
    /// Light connected to from a surface that scatters with a density.
    DirectLight,
    /// Light from outside the scene that rays meet which leave it.
    Environment,
    /// Scattering off matt surfaces.
    DiffuseReflection,
    /// Blurred mirrors of metal.
    GlossyReflection,
    /// Scattering off matt surfaces under a clear coat, and mirroring in it.
    CoatedReflection,
    /// Mirrors of metal.
    SpecularReflection,
    /// Interfaces that reflect and refract.
    Refraction,
    /// Colours that vary over a surface.
    Textures,
}

impl Effect {
    /// Every effect.
    pub const ALL: [Self; 9] = [
        Self::Emission,
        Self::DirectLight,
        Self::Environment,
        Self::DiffuseReflection,
        Self::GlossyReflection,
        Self::CoatedReflection,
        Self::SpecularReflection,
        Self::Refraction,
        Self::Textures,
    ];

    /// The effect that materials of a model bring.
    #[must_use]
    pub const fn of(kind: MaterialKind) -> Self {
        match kind {
            MaterialKind::Diffuse => Self::DiffuseReflection,
            MaterialKind::RoughConductor => Self::GlossyReflection,
            MaterialKind::Plastic => Self::CoatedReflection,
            MaterialKind::Conductor => Self::SpecularReflection,
            MaterialKind::Dielectric | MaterialKind::RoughDielectric => Self::Refraction,
        }
    }

    /// Why a scatter system runs where the effect is on.
    #[must_use]
    pub(super) const fn reason(self) -> &'static str {
        match self {
            Self::DiffuseReflection => "a shape has a diffuse material",
            Self::SpecularReflection => "a shape has a conductor material",
            Self::GlossyReflection => "a shape has a rough conductor material",
            Self::CoatedReflection => "a shape has a plastic material",
            Self::Refraction => "a shape has a dielectric material",
            Self::Emission | Self::DirectLight | Self::Environment => "light arrives",
            Self::Textures => "some material has a texture",
        }
    }

    /// The effect's name as plans print it.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Emission => "emission",
            Self::DirectLight => "direct light",
            Self::Environment => "environment",
            Self::DiffuseReflection => "diffuse reflection",
            Self::GlossyReflection => "glossy reflection",
            Self::CoatedReflection => "coated reflection",
            Self::SpecularReflection => "specular reflection",
            Self::Refraction => "refraction",
            Self::Textures => "textures",
        }
    }
}

/// Whether an effect is on, and why.
#[derive(Clone, Debug)]
pub struct EffectPlan {
    /// The effect.
    pub effect: Effect,
    /// Whether the scene calls for it.
    pub on: bool,
    /// Why, or why not.
    pub reason: String,
}

/// Whether `effect` is on in `effects`.
pub(super) fn is_on(effects: &[EffectPlan], effect: Effect) -> bool {
    effects.iter().any(|plan| plan.effect == effect && plan.on)
}

/// Decides every effect for a scene.
pub(super) fn effects(scene: &Scene) -> Vec<EffectPlan> {
    Effect::ALL
        .map(|effect| {
            let (on, reason) = decide(scene, effect);
            EffectPlan { effect, on, reason }
        })
        .into()
}

fn decide(scene: &Scene, effect: Effect) -> (bool, String) {
    if scene.lights.is_empty() {
        return (
            false,
            "nothing emits: the picture is black and no path is traced".to_owned(),
        );
    }
    if !matches!(effect, Effect::Emission | Effect::Environment) && scene.max_depth < 2 {
        return (
            false,
            "max_depth is 1: emitters seen directly, nothing scatters".to_owned(),
        );
    }
    match effect {
        Effect::Emission => (true, emitters(scene)),
        Effect::DirectLight => {
            let used = materials(scene, |kind| !kind.is_discrete());
            if used.is_empty() {
                (
                    false,
                    "every material is discrete: no light can be connected to".to_owned(),
                )
            } else {
                (true, format!("lights can be sampled from {}", list(&used)))
            }
        }
        Effect::DiffuseReflection
        | Effect::GlossyReflection
        | Effect::CoatedReflection
        | Effect::SpecularReflection
        | Effect::Refraction => by_kind(scene, effect),
        Effect::Environment => environment(scene),
        Effect::Textures if scene.materials.needs().textures => {
            let names = scene.materials.textures.names().iter().map(String::as_str);
            (true, list(&names.collect::<Vec<_>>()))
        }
        Effect::Textures => (false, "no material of a shape has a texture".to_owned()),
    }
}

fn emitters(scene: &Scene) -> String {
    let names: Vec<&str> = scene.light_names.iter().map(String::as_str).collect();
    let (primitives, all) = (scene.lights.emitter_count(), scene.lights.len());
    let what = match all - primitives {
        0 => format!("{primitives} emitting primitives"),
        others => format!("{primitives} emitting primitives and {others} lights that are no shapes"),
    };
    format!("{what}: {}", list(&names))
}

fn environment(scene: &Scene) -> (bool, String) {
    let count = scene.lights.infinite().count();
    if count == 0 {
        (
            false,
            "nothing shines from outside the scene on rays that leave it".to_owned(),
        )
    } else {
        (
            true,
            format!("rays that leave the scene meet {count} lights at infinity"),
        )
    }
}

/// Effects that materials of some models bring.
fn by_kind(scene: &Scene, effect: Effect) -> (bool, String) {
    let kinds = || MaterialKind::ALL.iter().filter(|&&kind| Effect::of(kind) == effect);
    let used = materials(scene, |kind| Effect::of(kind) == effect);
    let names: Vec<&str> = kinds().map(|kind| kind.name()).collect();
    if used.is_empty() {
        let null = scene.null_primitives;
        let mut reason = format!("no shape has a {} material", names.join(" or "));
        if effect == Effect::Refraction && null > 0 {
            reason += &format!(" that does something; {null} primitives between equal indices are not there");
        }
        (false, reason)
    } else {
        (true, format!("{}: {}", names.join(", "), list(&used)))
    }
}

fn materials(scene: &Scene, wanted: impl Fn(MaterialKind) -> bool) -> Vec<&str> {
    let table = &scene.materials;
    (0..table.len() as u32)
        .filter(|&m| wanted(table.kind(m)))
        .map(|m| table.name(m))
        .collect()
}

/// A few names, and how many more there are.
pub(super) fn list(names: &[&str]) -> String {
    const SHOWN: usize = 4;
    let shown = names.iter().take(SHOWN).copied().collect::<Vec<_>>().join(", ");
    if names.len() > SHOWN {
        format!("{shown} and {} more", names.len() - SHOWN)
    } else {
        shown
    }
}

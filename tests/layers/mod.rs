//! Layers: light split by the paths that bring it.

mod agree;
mod depth;
mod films;
mod plans;

use chainlight::layer::{Layers, standard};
use chainlight::plan::{Base, ChainSettings, Plan, PlanOptions, Technique};
use chainlight::render::{Rendering, start};
use chainlight::scene::Scene;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

/// Every technique in stages, and what its chains run over.
const TECHNIQUES: [(Technique, Base); 6] = [
    (Technique::Pt, Base::Pt),
    (Technique::Lt, Base::Pt),
    (Technique::Bdpt, Base::Pt),
    (Technique::Pssmlt, Base::Pt),
    (Technique::Pssmlt, Base::Bdpt),
    (Technique::Mlt, Base::Pt),
];

/// The standard layers of a scene.
fn standard_layers(scene: &Scene) -> Option<Arc<Layers>> {
    Some(Arc::new(standard().within(scene)))
}

/// A plan with a few chains.
fn plan(scene: &Scene, technique: (Technique, Base), layers: Option<Arc<Layers>>) -> Plan {
    tiled(scene, technique, layers, None)
}

/// The same in tiles of this size.
fn tiled(
    scene: &Scene,
    (technique, base): (Technique, Base),
    layers: Option<Arc<Layers>>,
    tile_size: Option<u32>,
) -> Plan {
    let options = PlanOptions {
        tile_size,
        base,
        layers,
        chains: ChainSettings {
            groups: 4,
            chains: Some(64),
            bootstrap: Some(4096),
            ..ChainSettings::default()
        },
        ..PlanOptions::default()
    };
    Plan::with(scene, technique, &options).expect("the mutations there are make a plan")
}

/// A render that has taken no step.
fn begun(scene: &Arc<Scene>, plan: Plan, seed: u64, threads: usize) -> Box<dyn Rendering> {
    let never = AtomicBool::new(false);
    start(Arc::clone(scene), plan, seed, threads, &never, &|_| {}).expect("a small film")
}

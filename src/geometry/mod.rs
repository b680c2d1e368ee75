//! Geometry: shapes in world space, the tree over them, and queues of rays and segments traced against it.
//!
//! The one public way to trace is a queue ([`Geometry::closest_hits`], [`Geometry::transmittances`]): structure of
//! arrays in, structure of arrays out, so that whatever walks the tree may reorder and interleave rays. A hit is the
//! lexicographic minimum of (distance, instance, primitive), whatever order the tree is walked in. Intersections are
//! computed in f64 from f32 vertices and origins: near hits are found at any scale, shared edges do not leak.

mod bounding_sphere;
mod cylinder;
mod disk;
mod leaf;
mod octahedral;
mod queue;
mod sphere;
mod surface;
mod texture;
mod trace;
mod tracer;
mod tree;
mod triangle;

pub use bounding_sphere::BoundingSphere;
pub use queue::{
    HitColumns, HitDistance, HitInstance, HitPrimitive, HitUv, NO_HIT, RayColumns, RayDirection, RayOrigin,
    SegmentColumns, SegmentTarget, SegmentTransmittance,
};
pub(crate) use surface::offset_distance;
pub use surface::{Hit, Instance, InstanceShape, SurfacePoint, offset_origin};
pub use texture::TexturePoint;
pub use tracer::{Instructions, MissingInstructions, Tracer, Tracing, UnknownTracer};

use glam::{Mat3, Vec2, Vec3};
use leaf::LeafPrimitive;
use tree::Tree;

/// No light: this primitive does not emit.
pub const NOT_EMITTING: u32 = u32::MAX;

/// All shapes of a scene in world space, as tables, and the tree over their primitives. Read-only while rendering.
#[derive(Clone, Debug, Default)]
pub struct Geometry {
    /// One row per shape of the scene.
    pub(crate) instances: Vec<Instance>,
    /// Vertex positions of all meshes, world space.
    pub(crate) positions: Vec<Vec3>,
    /// Vertex normals of those meshes that have any, world space.
    pub(crate) normals: Vec<Vec3>,
    /// Texture coordinates of those meshes that have any; empty where no material asks for them.
    pub(crate) uvs: Vec<Vec2>,
    /// The axes of every instance's own space, world space, unit, by instance number: round shapes are textured by them. Empty
    /// where no material asks for them.
    pub(crate) frames: Vec<Mat3>,
    /// Corner indices of all triangles, relative to their instance's first vertex.
    pub(crate) triangles: Vec<[u32; 3]>,
    /// Material of every primitive, by global primitive number.
    pub(crate) materials: Vec<u32>,
    /// Light of every primitive, or [`NOT_EMITTING`], by global primitive number.
    pub(crate) lights: Vec<u32>,
    tree: Tree,
    tracing: Tracing,
}

impl Geometry {
    /// Builds the tree over all primitives, and chooses how rays are traced. Primitives without area, or with a number that is not
    /// finite, are left out: no ray meets them.
    pub fn build_tree(&mut self) {
        let leaves = self.leaves();
        self.tree = Tree::build(&leaves);
        let triangles = leaves.iter().filter(|leaf| leaf.is_triangle()).count();
        let instructions = Instructions::best();
        let tracer = Tracer::fastest(triangles, leaves.len() - triangles, self.tree.bytes(), instructions);
        self.tree.keep_few((tracer == Tracer::All).then_some(&leaves));
        self.tracing = Tracing {
            tracer,
            instructions,
            asked_for: false,
        };
    }

    /// Traces rays otherwise than [`build_tree`](Self::build_tree) chose; hits are the same. Instructions that the machine lacks are not used.
    pub fn trace_with(&mut self, tracer: Tracer, instructions: Instructions) {
        if (tracer == Tracer::All) != (self.tracing.tracer == Tracer::All) {
            let leaves = (tracer == Tracer::All).then(|| self.leaves());
            self.tree.keep_few(leaves.as_deref());
        }
        self.tracing = Tracing {
            tracer,
            instructions,
            asked_for: true,
        };
    }

    /// How rays are traced.
    #[must_use]
    pub const fn tracing(&self) -> Tracing {
        self.tracing
    }

    /// All primitives that a ray can meet.
    fn leaves(&self) -> Vec<LeafPrimitive> {
        let mut leaves = Vec::with_capacity(self.materials.len());
        for (number, instance) in self.instances.iter().enumerate() {
            for primitive in 0..instance.primitive_count() {
                let leaf = LeafPrimitive::new(self, number as u32, primitive);
                leaves.extend(leaf.filter(LeafPrimitive::can_be_hit));
            }
        }
        leaves
    }

    /// Number of primitives, those without area included.
    #[must_use]
    pub fn primitive_count(&self) -> usize {
        self.materials.len()
    }

    /// Number of instances.
    #[must_use]
    pub fn instance_count(&self) -> usize {
        self.instances.len()
    }

    /// Memory of the tree and of the primitives in its leaves, in bytes.
    #[must_use]
    pub fn tree_bytes(&self) -> usize {
        self.tree.bytes()
    }

    /// A triangle's corners, world space; `None` if there is no such triangle.
    #[must_use]
    pub fn triangle(&self, instance: u32, primitive: u32) -> Option<[Vec3; 3]> {
        self.corners(self.instances.get(instance as usize)?, primitive)
    }

    /// The corners of all triangles, world space, instance by instance.
    pub fn triangles(&self) -> impl Iterator<Item = [Vec3; 3]> {
        let instances = self.instances.iter();
        instances.flat_map(|instance| {
            (0..instance.primitive_count()).filter_map(|primitive| self.corners(instance, primitive))
        })
    }

    /// The box around everything, or `None` for an empty scene.
    #[must_use]
    pub fn bounds(&self) -> Option<(Vec3, Vec3)> {
        self.tree.bounds()
    }
}

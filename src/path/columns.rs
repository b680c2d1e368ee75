//! The columns of chains and of path vertices, and the markers that tell tables apart.
//!
//! A chain has one subpath or two, see [`TilePlace`](crate::systems::tile::TilePlace): number c, from the camera, is that of
//! the tile's chain c, and so is number `lights_from + c`, from a light. Columns of the chain table that say something of the
//! chain are addressed by its number; those of its subpaths ([`Direction`], [`Throughput`], [`RadianceScale`], [`PathLength`],
//! the lists) by theirs. Vertex rows are bounce-major: vertex `depth` of subpath `p` is number `depth * capacity + p`, for
//! as many subpaths as the tile has room for. Index lists (`…List`) are dense: their first entries name the subpaths that
//! wait for a system; how many is in the tile's queue lengths.

use crate::color::Rgb;
use crate::columns;
use crate::table::Table;
use bevy_ecs::component::Component;
use glam::{DVec2, Vec2, Vec3};

/// Marks the rows of the chain table.
#[derive(Component, Clone, Copy, Debug, Default)]
pub struct ChainTable;

impl Table for ChainTable {
    type Apart = ();
}

/// Marks the rows of the table of proposed path vertices.
#[derive(Component, Clone, Copy, Debug, Default)]
pub struct ProposalTable;

impl Table for ProposalTable {
    type Apart = ();
}

/// Marks the rows of the table of subpaths that wait to be scattered: entry i of the list of the scene's model number m (in
/// the order of [`MaterialTable::kinds`](crate::material::MaterialTable::kinds)) has number m · capacity + i.
#[derive(Component, Clone, Copy, Debug, Default)]
pub struct ScatterTable;

impl Table for ScatterTable {
    type Apart = ();
}

/// Marks the rows of the ray table: as many rays, or segments, at a time as the tile has room for subpaths. Each subpath has
/// one ray or segment at most, but for segments that join subpaths: of these a chain can have many, and what finds no room
/// waits for the next round.
#[derive(Component, Clone, Copy, Debug, Default)]
pub struct RayTable;

impl Table for RayTable {
    type Apart = ();
}

/// Vertex kind: the point on the lens where a camera subpath starts.
pub const VERTEX_LENS: u32 = 0;
/// Vertex kind: a point on a surface, scattering with a density per solid angle, or where the subpath ended.
pub const VERTEX_SURFACE: u32 = 1;
/// Vertex kind: a point on a surface that scattered into one of a few directions (discrete measure).
pub const VERTEX_DISCRETE: u32 = 2;

/// Vertex kind: where a subpath starts on a light that is somewhere: a point of a shape that emits, or a light at a point.
pub const VERTEX_LIGHT: u32 = 3;
/// Vertex kind: an end with a direction and no position: light from infinity, whether a subpath starts there or meets it, or a
/// camera of parallel rays.
pub const VERTEX_INFINITE: u32 = 4;

/// The length of a subpath that has no vertex.
pub const NO_SUBPATH: u32 = u32::MAX;

/// The pixel of a segment whose light counts for the one that its chain samples.
pub const OWN_PIXEL: u32 = u32::MAX;

columns! {
    /// Mixed key of the chain's random streams in this step, see [`StreamKey`](crate::sampling::StreamKey).
    pub ChainKey: u64;
    /// Number of the pixel that this step's sample counts for, row by row from the top left.
    pub FilmPixel: u32;
    /// Direction of travel: into the current vertex, and after scattering out of it. World space, unit length.
    pub Direction: Vec3;
    /// f/p of the subpath so far, roulette included.
    pub Throughput: Rgb;
    /// Squared ratio of indices accumulated by refraction: what roulette multiplies throughput with.
    pub RadianceScale: f32;
    /// Depth of the subpath's last vertex: its number of edges; [`NO_SUBPATH`] if it has none.
    pub PathLength: u32;
    /// The proposal's contribution: radiance divided by the density of sampling it, W sr⁻¹ m⁻².
    pub Contribution: Rgb;
    /// Weight booked for the proposal in this step's decision.
    pub BookedWeight: f32;
    /// Decisions that the chain has taken since the tile was placed.
    pub Decisions: u32;

    /// Subpaths that wait for their next ray.
    pub ActiveList: u32;
    /// Subpaths whose last vertex waits for a connection to a light.
    pub ConnectList: u32;
    /// Subpaths that stand on materials of a model: a list for each model of the scene, one behind the other, see
    /// [`ScatterTable`].
    pub ScatterList: u32;
    /// Subpaths that were scattered and wait for roulette.
    pub ScatteredList: u32;
    /// The subpath that a ray belongs to, or a segment to a light; the chain of a segment that joins subpaths.
    pub RayChain: u32;

    /// What the vertex is: [`VERTEX_LENS`], [`VERTEX_SURFACE`], [`VERTEX_DISCRETE`], [`VERTEX_LIGHT`] or [`VERTEX_INFINITE`].
    pub VertexKind: u32;
    /// World-space position; of a vertex at infinity where its ray starts, or the vertex before it that it was met from.
    pub VertexPosition: Vec3;
    /// Unit geometric normal, world space; of a vertex at infinity the direction in which light or rays travel from there.
    pub VertexNormal: Vec3;
    /// Unit shading normal, world space.
    pub VertexShadingNormal: Vec3;
    /// How far a ray has to start off the surface, see [`offset_origin`](crate::geometry::offset_origin).
    pub VertexOffset: f32;
    /// Instance of the surface.
    pub VertexInstance: u32;
    /// Primitive of the surface, counted inside the instance.
    pub VertexPrimitive: u32;
    /// Coordinates on the primitive.
    pub VertexUv: DVec2;
    /// Material number, of the side that the path arrived on.
    pub VertexMaterial: u32;
    /// Texture coordinates.
    pub VertexTexture: Vec2;
    /// Unit tangent, world space: the first axis of materials that are not the same all around.
    pub VertexTangent: Vec3;
    /// f · |cos| / p of scattering at the vertex (and of surviving roulette there); 1 on the lens; of a light that a subpath
    /// starts at, what it sends over the density of drawing that.
    pub VertexRatio: Rgb;
    /// Density of the direction sampled at the vertex, per solid angle; a probability if the vertex is discrete.
    pub VertexDensity: f32;
    /// Radiance emitted at the vertex back along the path, weighted against light sampling.
    pub VertexEmission: Rgb;
    /// The light that the vertex is on, or that its subpath starts at, or [`NOT_EMITTING`](crate::geometry::NOT_EMITTING).
    pub VertexLight: u32;
    /// Unit direction in which the path arrived at the vertex, world space.
    pub VertexArrival: Vec3;
    /// Density of the vertex, drawn from its own end of the path, see [`measure`](super::measure).
    pub VertexForward: f64;
    /// Density of scattering the other way, see [`Scattered::reverse`](crate::material::Scattered::reverse).
    pub VertexReverse: f32;
    /// Odds of the strategies that would end this subpath two vertices earlier, or before, see
    /// [`bidirectional`](super::bidirectional).
    pub VertexTail: f64;
    /// What a segment brings if nothing is in its way.
    pub SegmentLight: Rgb;
    /// Length and signature of the path that a segment completes.
    pub SegmentClass: u32;
    /// The target of the brightest path of a sample so far.
    pub BrightestLight: f32;
    /// The pixel that a segment's light counts for, or [`OWN_PIXEL`].
    pub SegmentPixel: u32;
    /// Light that was connected to at the vertex: f · |cos| · radiance / density · transmittance, weighted against
    /// meeting the light by scattering.
    pub VertexConnection: Rgb;
}

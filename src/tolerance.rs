//! Every tolerance of the renderer, in one place, each with its reason and the test that guards it. All are relative:
//! they scale with the coordinates or the distances at hand, so that a scene renders alike at any size.

/// How far a ray's origin is moved off its surface, in units of the rounding error of the surface point:
/// 2⁻²⁴ · Σ|nᵢ||pᵢ|. One unit covers the rounding of the point itself, one the rounding of the moved origin, and as much
/// again is margin. Guarded by `rays_that_leave_a_surface_never_hit_it_again`.
pub const ORIGIN_OFFSET_UNITS: f32 = 4.0;

/// The least offset of an origin, relative to the size of the shape: 2⁻⁴⁰. Intersections are computed in f64 (2⁻⁵³), so
/// this keeps a surface through the world's origin, whose points round exactly, from being hit by its own rays.
/// Guarded by `rays_that_leave_a_surface_never_hit_it_again`.
pub const ORIGIN_OFFSET_FLOOR: f32 = 1.0 / (1u64 << 40) as f32;

/// How far surface points keep from the edges of their triangle, in units of 2⁻²⁴ · the point's largest coordinate. Two
/// units cover the rounding of the point and of the moved origin; the others make room for the offset where the
/// neighbour leans over the triangle, down to 45 degrees. Guarded by `closed_rooms_keep_paths_in_and_light_out`.
pub const EDGE_INSET_UNITS: f32 = 8.0;

/// The least height over an edge, relative to the triangle's size, that surface points are kept from the edge in
/// proportion to: it bounds how far a point of a needle moves. Guarded by `points_hardly_move_when_kept_off_edges`.
pub const LEAST_INSET_HEIGHT: f64 = 0.125;

/// How far beyond its rim a disk or a tube is still met, relative to its radius: 2⁻²³. Normals in f32 turn a disk by up to
/// √3 · 2⁻²⁵ against the tube that it closes, which would leave a gap. Guarded by `nothing_leaves_a_closed_can`.
pub const RIM_SLACK: f64 = 1.0 / (1u64 << 23) as f64;

/// A box is entered if the computed entry is below the computed exit times this, the bound of Ize (2013, "Robust BVH ray
/// traversal") under which no hit box is missed: three roundings in the entry, three in the exit, and here one more for
/// the product with this number, rounded up to a number that f32 has. Guarded by `the_tree_finds_what_a_scan_finds` and
/// `nothing_leaves_a_closed_mesh`.
pub const BOX_EXIT_SLACK: f32 = 1.0 + 8.0 * F32_ROUNDING;

/// A box farther than the nearest hit times this is skipped. The slack covers three roundings of the box's distance, one
/// of the hit's and one of the product with this number, rounded up to a number that f32 has, so that hits that tie are
/// all seen and the least primitive wins whatever order the tree is walked in. Guarded by
/// `coincident_triangles_return_the_lowest_primitive`.
pub const CULL_SLACK: f32 = 1.0 + 6.0 * F32_ROUNDING;

/// How far off distances of triangles may be, relative to the coordinates that they are computed from: 2⁻⁴⁸, some thirty roundings. Boxes no
/// farther than that behind the nearest hit are looked into too: of hits very near the origin, a rounding of the coordinates is a large
/// part. Guarded by `few_triangles_are_found_as_by_a_scan`.
pub const DISTANCE_SLACK: f64 = 1.0 / (1u64 << 48) as f64;

/// The smallest roughness of microfacets; scenes that ask for less are refused and pointed at the smooth material, with whose
/// albedo this one agrees to a thousandth, so that nothing jumps. Directions are rounded to 2⁻²⁴, which moves a half vector by
/// 3e-8 over the cosine of incidence: a thousandth of this lobe's width, but all of it where light grazes at cosines below
/// 1e-3, where only what is drawn is exact. A lobe ten times narrower would be lost to rounding at ordinary angles. Guarded
/// by `the_smoothest_rough_surfaces_agree_with_smooth_ones` and `rough_lobes_follow_their_densities`.
pub const LEAST_ROUGHNESS: f32 = 1e-4;

/// Half the distance from 1 to the next f32: the largest relative error of one rounding.
pub const F32_ROUNDING: f32 = f32::EPSILON * 0.5;

//! The scene: from a file on disk to validated, flattened shapes in world space.
//!
//! [`read_scene`] reads the file, [`flatten()`] checks its values, reads the meshes that it names, and places every shape
//! in the world. Errors and warnings say where in the file they belong.
//!
//! # The format
//!
//! A scene is a `.ron` file ([Rusty Object Notation](https://github.com/ron-rs/ron), with comments), or a `.json` file
//! of the same structure. Unknown fields are errors, and so are two materials of one name.
//!
//! ```ron
//! (
//!     version: 1,                                     // required
//!     settings: (max_depth: 16, technique: "pt"),     // optional, and so is each field
//!     camera: Perspective(origin: (0, 1, 5), target: (0, 1, 0), up: (0, 1, 0), fov: 40, fov_axis: Vertical),
//!     film: (width: 512, height: 512, filter: Tent(radius: 1)),
//!     materials: {
//!         "white": Diffuse(reflectance: (0.7, 0.7, 0.7)),
//!         "gold": Conductor(eta: (0.14, 0.38, 1.44), k: (3.98, 2.39, 1.6)),
//!         "glass": Dielectric(interior_ior: 1.5),
//!     },
//!     lights: [                                       // optional: lights that are no shapes
//!         Sky(sun_direction: (1, 2, 1), turbidity: 3),
//!         Sun(direction: (1, 2, 1), turbidity: 3),
//!     ],
//!     shapes: [
//!         (name: "floor", shape: Quad(corner: (-1, 0, 1), edge_u: (2, 0, 0), edge_v: (0, 0, -2)), material: "white"),
//!         (shape: Box(min: (0, 0, 0), max: (1, 1, 1)), material: "gold",
//!             transform: [Rotate(axis: (0, 1, 0), degrees: 15), Translate((1, 2, 3))]),
//!         (shape: Sphere(center: (0, 1, 0), radius: 0.5), material: "glass"),
//!         (shape: Sphere(center: (0, 3, 0), radius: 0.1), material: "white", emission: (17, 12, 4)),
//!     ],
//! )
//! ```
//!
//! The same structure in JSON: brackets of fields and `{}` become objects, brackets of numbers and `[]` become arrays,
//! and a name before a bracket becomes an object of one key: `{"Sphere": {"radius": 0.5}}`, `{"Translate": [1, 2, 3]}`.
//!
//! # Units and conventions
//!
//! - Lengths are in scene units, metres by convention. Axes are right-handed, +Y points up by convention.
//! - Angles are in degrees.
//! - Colours are linear sRGB (Rec. 709 primaries, D65 white): `(1, 1, 1)` reflects everything. `emission` is radiance in
//!   W sr⁻¹ m⁻² per channel.
//! - `max_depth` counts the edges of a path: 1 shows emitters seen directly, 2 adds direct light.
//! - Numbers are single precision, and finite. Coordinates are at most 1e9 in magnitude, before and after transforms.
//!
//! # The blocks
//!
//! Every block, variant and field, with type, range, unit, default and meaning, is on the reference page,
//! `scenes/REFERENCE.md`; `chainlight schema` prints the same as a JSON Schema, for editors ([`schema`]). In code they are
//! [`SettingsDescription`], [`CameraDescription`], [`FilmDescription`] with [`FilterDescription`], [`TextureDescription`],
//! [`MaterialDescription`], [`LightDescription`], [`ShapeDescription`] with [`ShapeKind`] and [`TransformStep`].
//!
//! A JSON scene may name the schema for its editor under the key `$schema`, beside its blocks; it is passed over.
//!
//! # Sides and transforms
//!
//! Every surface has a geometric normal: a quad's and a height field's are on the side of `edge_u` x `edge_v`; a disk has its
//! own; those of a box, a sphere, a cylinder and a torus point outward; a mesh's is on the side from which its triangles are counter-clockwise. `emission` leaves on that side alone. It is the
//! exterior of a `Dielectric`. Materials with `two_sided: true`, which is the default, shade both sides alike.
//!
//! Transforms apply in the order listed, about the origin of the world. Those that mirror keep normals on the side of the
//! surface where they were: closed shapes stay outward, and a mesh's triangles are turned over. The transform of a sphere, a
//! disk or a cylinder, which are exact and no triangles, must scale all lengths alike, within a relative tolerance of 1e-4 ([`SIMILARITY_TOLERANCE`](transform::SIMILARITY_TOLERANCE)).
//!
//! # Textures
//!
//! A material's colour is three numbers, or the name of a texture: `reflectance: "wood"`. Textures are looked up at the
//! texture coordinates of the surface: u to the right, v up, the picture's lower left corner at (0, 0). Where shapes have
//! theirs:
//!
//! | shape | u | v |
//! |---|---|---|
//! | `Quad`, `HeightField` | along `edge_u`, in [0, 1] | along `edge_v` |
//! | `Box` | over each face to the right, as seen from outside | up each face; towards -z on top, towards +z below |
//! | `Sphere` | around its y axis, to the right as seen from outside; the middle towards +z | from -y to +y, in equal angles |
//! | `Disk` | over the square around it, to the right as seen from its front | up that square: towards +y, or -z where it lies flat |
//! | `Cylinder` | around it, to the right as seen from outside with `to` above; the middle towards +z (+x if it runs along z) | from `from` to `to` |
//! | `Torus` | around its axis, as a cylinder | around the tube: from the inside over the bottom to the outside, and over the top |
//! | `Obj` | `vt` | `vt` |
//!
//! Textures turn with the transforms of their shapes. Values of a texture are shares of light, from 0 to 1.
//!
//! # Meshes
//!
//! `Obj(file: "meshes/x.obj")` reads polygons, and cuts them into fans of triangles: concave ones should be cut before.
//! The file's name is relative to the folder of the scene file. Vertex normals shade it unless `smooth: false`; a corner
//! without one, or with one that points away from the geometric normal, is shaded flat. Triangles without an area are left out, with a
//! warning. Where the shape has no `material`, the mesh's own material library (MTL) is read:
//!
//! | in the library | becomes |
//! |---|---|
//! | `d` below 1 (or `Tr` above 0), or `illum` 4, 6, 7, 9 | `Dielectric` with `Ni` inside (1.5 where there is none) |
//! | else `illum` 3, 5 | `Conductor` that mirrors every direction alike, scaled by `Ks` (1 where there is none) |
//! | else | `Diffuse` with `Kd` (black where there is none) |
//! | `Ke` | emission, unless the shape has its own |
//!
//! Textures and all else are left out, with a warning.

mod at;
mod compile;
mod complaint;
pub mod description;
mod environment_picture;
pub mod error;
pub mod flatten;
mod lex;
mod lights;
mod limits;
mod locate;
pub mod mesh;
pub mod read;
pub mod schema;
mod schema_key;
mod shapes;
mod syntax;
#[cfg(test)]
mod testing;
mod textures;
pub mod transform;
pub mod validate;

pub use compile::{Scene, SceneOverrides};
pub use description::{
    CameraDescription, ColorDescription, FilmDescription, FilterDescription, FovAxis, LightDescription,
    MaterialDescription, SceneDescription, SettingsDescription, ShapeDescription, ShapeKind, TextureDescription,
    TextureEncoding, TextureFilter, TextureWrap, TransformStep,
};
pub use error::{SceneError, SceneWarning, nearest_name};
pub use flatten::{Emission, Flattened, Geometry, Instance, flatten};
pub use mesh::{MAX_COORDINATE, Mesh, triangle_cross};
pub use read::{Format, SceneSource, Step, parse_scene, read_scene};
pub use validate::validate;

#[cfg(test)]
mod tests {
    use super::*;
    use std::path::Path;

    /// The example in the manual above.
    fn example() -> String {
        let lines = include_str!("mod.rs")
            .lines()
            .map(|line| line.trim_start_matches("//!"));
        lines
            .skip_while(|line| line.trim() != "```ron")
            .skip(1)
            .take_while(|line| line.trim() != "```")
            .collect::<Vec<_>>()
            .join("\n")
    }

    #[test]
    fn the_manuals_example_is_a_valid_scene() {
        let source = parse_scene("manual.ron", &example(), Format::Ron, Path::new(""));
        let flattened = source.and_then(|source| flatten(&source)).expect("a valid scene");
        assert_eq!(flattened.instances.len(), 4);
        assert!(flattened.warnings.is_empty());
        assert_eq!(flattened.instances[0].name, "floor");
        assert_eq!(flattened.instances[1].name, "shapes[1]");
    }

    #[test]
    fn a_description_survives_being_written_and_read() {
        let description = parse_scene("manual.ron", &example(), Format::Ron, Path::new(""))
            .expect("valid")
            .description;
        let ron = ron::ser::to_string_pretty(&description, ron::ser::PrettyConfig::default()).expect("RON");
        let json = serde_json::to_string(&description).expect("JSON");
        for (text, format) in [(ron, Format::Ron), (json, Format::Json)] {
            let again = parse_scene("again", &text, format, Path::new("")).expect("valid");
            assert_eq!(again.description, description);
        }
    }

    #[test]
    fn defaults_are_those_documented() {
        let text = r#"(version: 1, camera: Perspective(origin: (0, 0, 1), target: (0, 0, 0), fov: 40),
            film: (width: 1, height: 1), shapes: [])"#;
        let scene = parse_scene("test.ron", text, Format::Ron, Path::new(""))
            .expect("valid")
            .description;
        assert_eq!(
            scene.settings,
            SettingsDescription {
                max_depth: 16,
                technique: None
            }
        );
        assert_eq!(scene.film.filter, FilterDescription::Box { radius: 0.5 });
        let CameraDescription::Perspective { up, fov_axis, .. } = scene.camera else {
            panic!("{:?}", scene.camera)
        };
        assert_eq!((up, fov_axis), ([0.0, 1.0, 0.0], FovAxis::Vertical));
    }

    #[test]
    fn a_byte_order_mark_is_passed_over() {
        let text = format!("\u{feff}{}", testing::scene_of("Sphere(radius: 1)", ""));
        assert!(parse_scene("test.ron", &text, Format::Ron, Path::new("")).is_ok());
    }
}

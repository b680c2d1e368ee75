//! Triangle meshes from Wavefront OBJ files.

use super::mtl::{self, Libraries};
use super::obj_lines::ObjLines;
use super::too_far;
use crate::color::Rgb;
use crate::scene::at::At;
use crate::scene::error::{SceneError, SceneWarning};
use crate::scene::flatten::{Emission, Materials};
use crate::scene::mesh::Mesh;
use crate::scene::read::open_regular;
use glam::{DAffine3, DMat3, DVec3, Vec2};
use std::io::{BufReader, Read};
use std::path::Path;

/// The largest OBJ file, in bytes.
const MAX_OBJ_BYTES: u64 = 16 << 30;

const OPTIONS: tobj::LoadOptions = tobj::LoadOptions {
    single_index: true,
    triangulate: true,
    ignore_points: true,
    ignore_lines: true,
};

/// A mesh in the world, with what its file says besides.
pub(in crate::scene) struct Loaded {
    pub(in crate::scene) mesh: Mesh,
    /// What the file's own materials emit.
    pub(in crate::scene) emission: Emission,
    pub(in crate::scene) warnings: Vec<SceneWarning>,
}

/// Reads the mesh `file`, and places it by `map`. With a `material` the file's own ones are not read; without, they
/// join `materials`. `at` is the place of the file's name in the scene.
pub(in crate::scene) fn load(
    at: &At,
    file: &Path,
    smooth: bool,
    map: &DAffine3,
    material: Option<u32>,
    materials: &mut Materials,
) -> Result<Loaded, SceneError> {
    let path = at.source.base_dir.join(file);
    let shown = file.display().to_string();
    let folder = path.parent().unwrap_or(Path::new(""));
    let cannot = |problem: String| at.error(format!("cannot read the mesh {}: {problem}", path.display()), "");
    let input = open_regular(&path).map_err(cannot)?;
    let size = input.metadata().map_err(|error| cannot(error.to_string()))?.len();
    if size > MAX_OBJ_BYTES {
        return Err(cannot(format!("it is larger than {} GiB", MAX_OBJ_BYTES >> 30)));
    }
    let libraries = Libraries::new(folder);
    let names = material.is_none().then_some(&libraries.names);
    // No more than it had: what grows while it is read might grow for ever.
    let input = BufReader::with_capacity(1 << 16, input.take(size));
    let mut lines = ObjLines::new(input, folder, names, smooth);
    let loaded = tobj::load_obj_buf(&mut lines, &OPTIONS, |library| libraries.load(library));
    if let Some(problem) = libraries.problem.take() {
        return Err(at.error(
            format!("{shown}: {problem}"),
            "correct it, or give the shape a `material` of the scene",
        ));
    }
    if let Some((problem, help)) = lines.problem {
        return Err(at.error(format!("{shown}, {problem}"), help));
    }
    let (models, libraries_loaded) =
        loaded.map_err(|error| at.error(format!("{shown}: the OBJ reader stopped: {error}"), ""))?;
    let brought = libraries_loaded.unwrap_or_default();
    let mut builder = Builder {
        mesh: Mesh::default(),
        emission: Vec::new(),
        map,
        normal_map: map.matrix3.inverse().transpose(),
        has_normals: smooth && lines.counts[2] > 0,
        has_uvs: lines.counts[1] > 0,
    };
    for model in models.iter().filter(|model| !model.mesh.indices.is_empty()) {
        let own = model.mesh.material_id.and_then(|id| brought.get(id));
        let (index, radiance) = match (material, own) {
            (Some(index), _) => (index, Rgb::BLACK),
            (None, Some(own)) => (
                materials.add(format!("{shown}:{}", own.name), &mtl::describe(own)),
                mtl::emission(own),
            ),
            (None, None) => return Err(at.error(format!("{shown}: a face has no material"), "give the shape one")),
        };
        builder.add(&model.mesh, index, radiance);
    }
    let ignored = lines.ignored;
    let mut warnings = Vec::new();
    let mut warn = |message: String, help: &str| warnings.push(at.warning(format!("{shown}: {message}"), help));
    if !ignored.is_empty() {
        let list: Vec<String> = ignored
            .iter()
            .take(8)
            .map(|(what, count)| format!("{what} ({count} times)"))
            .collect();
        warn(format!("left out what has no meaning here: {}", list.join(", ")), "");
    }
    for (library, ignored) in libraries.ignored.take() {
        let list: Vec<String> = ignored.into_iter().collect();
        let message = format!(
            "the material library {library} says more than is read: {}",
            list.join(", ")
        );
        warn(
            message,
            "textures and highlights are left out; give the shape a `material` for another look",
        );
    }
    builder.finish(at, &shown, &mut warn).map(|(mesh, emission)| Loaded {
        mesh,
        emission,
        warnings,
    })
}

/// A mesh that grows by the parts of a file.
struct Builder<'a> {
    mesh: Mesh,
    /// One radiance per triangle.
    emission: Vec<Rgb>,
    map: &'a DAffine3,
    normal_map: DMat3,
    has_normals: bool,
    has_uvs: bool,
}

impl Builder<'_> {
    fn add(&mut self, part: &tobj::Mesh, material: u32, radiance: Rgb) {
        let points: Vec<DVec3> = triples(&part.positions)
            .map(|p| DVec3::from_array(p.map(f64::from)))
            .collect();
        self.mesh.add(&points, triples(&part.indices), self.map, material);
        self.emission.resize(self.mesh.triangles.len(), radiance);
        if self.has_normals {
            let map = self.normal_map;
            self.mesh.normals.extend(triples(&part.normals).map(|normal| {
                // Zero stays zero.
                (map * DVec3::from_array(normal.map(f64::from)).normalize_or_zero())
                    .normalize_or_zero()
                    .as_vec3()
            }));
        }
        if self.has_uvs {
            self.mesh
                .uvs
                .extend(part.texcoords.chunks_exact(2).map(|uv| Vec2::new(uv[0], uv[1])));
        }
    }

    /// Drops triangles without an area, and makes normals usable.
    fn finish(
        mut self,
        at: &At,
        shown: &str,
        warn: &mut impl FnMut(String, &str),
    ) -> Result<(Mesh, Emission), SceneError> {
        let mesh = &mut self.mesh;
        if !mesh.is_within_bounds() {
            return Err(too_far(at));
        }
        let all = mesh.triangles.len();
        if all == 0 {
            return Err(at.error(format!("{shown} has no faces"), "is it an OBJ file with `f` lines?"));
        }
        let kept: Vec<usize> = (0..all).filter(|&triangle| mesh.has_area(triangle)).collect();
        if kept.is_empty() {
            let message = format!("{shown}: none of its triangles has an area ({all} read)");
            return Err(at.error(message, "is it scaled down too far?"));
        }
        if kept.len() < all {
            mesh.triangles = kept.iter().map(|&triangle| mesh.triangles[triangle]).collect();
            mesh.materials = kept.iter().map(|&triangle| mesh.materials[triangle]).collect();
            self.emission = kept.iter().map(|&triangle| self.emission[triangle]).collect();
            let dropped = all - kept.len();
            warn(
                format!("triangles without an area are left out: {dropped} of {all}"),
                "",
            );
        }
        let repairs = mesh.repair_normals();
        let corners = 3 * mesh.triangles.len();
        if repairs.missing > 0 {
            warn(
                format!(
                    "corners without a normal are shaded flat: {} of {corners}",
                    repairs.missing
                ),
                "",
            );
        }
        if repairs.opposed > 0 {
            let message = format!(
                "corners whose normal points away from the front, as the winding has it, are shaded flat: {} of \
                 {corners}",
                repairs.opposed
            );
            warn(message, "turn the faces or the normals over, or set `smooth: false`");
        }
        Ok((self.mesh, Emission::per_triangle(self.emission)))
    }
}

/// The elements of a slice, three by three.
fn triples<T: Copy>(flat: &[T]) -> impl Iterator<Item = [T; 3]> {
    flat.chunks_exact(3).map(|chunk| [chunk[0], chunk[1], chunk[2]])
}

#[cfg(test)]
mod tests {
    use crate::color::Rgb;
    use crate::scene::testing::{areas, mesh_of, normals, scene_of, volume};
    use crate::scene::{Emission, Flattened, Format, MaterialDescription, flatten, parse_scene};
    use glam::{Vec2, Vec3};
    use std::fs;
    use std::path::Path;

    /// A tetrahedron with outward faces.
    const TETRAHEDRON: &str = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";

    /// The scene of one mesh, with the scene's own material unless the mesh brings a library.
    fn scene(files: &[(&str, &str)], rest: &str, transform: &str) -> Flattened {
        let folder = tempfile::tempdir().expect("a folder");
        for (name, content) in files {
            fs::write(folder.path().join(name), content).expect("a file");
        }
        let text = scene_of(&format!("Obj(file: \"{}\"{rest})", files[0].0), transform);
        let text = if files.len() > 1 {
            text.replace("material: \"white\",", "")
        } else {
            text
        };
        read(&text, folder.path())
    }

    fn read(text: &str, folder: &Path) -> Flattened {
        match parse_scene("test.ron", text, Format::Ron, folder).and_then(|source| flatten(&source)) {
            Ok(flattened) => flattened,
            Err(error) => panic!("{}", error.plain()),
        }
    }

    fn said(flattened: &Flattened) -> String {
        flattened
            .warnings
            .iter()
            .map(|warning| format!("{warning}\n"))
            .collect()
    }

    #[test]
    fn a_mesh_faces_outward_also_when_mirrored() {
        for (transform, expected) in [
            ("", 1.0 / 6.0),
            ("Scale((-2, 1, 1))", 2.0 / 6.0),
            ("Scale((-1, -1, -1))", 1.0 / 6.0),
        ] {
            let mesh = mesh_of(&scene(&[("t.obj", TETRAHEDRON)], "", transform).instances[0]);
            assert!((volume(&mesh) - expected).abs() < 1.0e-6, "{transform}");
            assert!(mesh.normals.is_empty() && mesh.uvs.is_empty());
        }
    }

    #[test]
    fn polygons_negative_indices_and_continued_lines_are_read() {
        let text = "# caf\u{e9}\r\nv 0 0 0\r\nv 2 0 0\r\nv 3 1 0 1.0\r\nv 1 2 0 0.5 0.5 0.5\r\nv 0 1 0\r\nf -5 -4 \\\r\n -3 4 5 # a pentagon\r\n";
        let mesh = mesh_of(&scene(&[("p.obj", text)], "", "").instances[0]);
        assert_eq!(mesh.triangles.len(), 3);
        assert_eq!(areas(&mesh).iter().sum::<f32>(), 4.0);
        assert_eq!(normals(&mesh), [Vec3::Z; 3]);
    }

    #[test]
    fn normals_follow_the_inverse_transpose() {
        let text = "v 0 0 0\nv 1 0 -1\nv 0 1 0\nvn 2 0 2\nf 1//1 2//1 3//1\n";
        let flattened = scene(&[("n.obj", text)], "", "Scale((2, 1, 1))");
        let mesh = mesh_of(&flattened.instances[0]);
        let expected = Vec3::new(0.5, 0.0, 1.0).normalize();
        for normal in &mesh.normals {
            assert!(normal.distance(expected) < 1.0e-6 && normal.is_normalized(), "{normal}");
        }
        assert!(normals(&mesh)[0].distance(expected) < 1.0e-6);
        let flat = mesh_of(&scene(&[("n.obj", text)], ", smooth: false", "").instances[0]);
        assert!(flat.normals.is_empty());
    }

    #[test]
    fn a_corner_without_a_usable_normal_gets_that_of_its_face() {
        let text = "v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 1 0 2\nvn 0 0 0\nvn 0 0 -1\nf 1//1 2//2 3\nf 1//3 2//1 3//1\n";
        let flattened = scene(&[("n.obj", text)], "", "");
        let mesh = mesh_of(&flattened.instances[0]);
        let shading = |triangle: usize, corner: usize| mesh.normals[mesh.triangles[triangle][corner] as usize];
        let given = Vec3::new(1.0, 0.0, 2.0).normalize();
        assert_eq!([shading(0, 0), shading(0, 1), shading(0, 2)], [given, Vec3::Z, Vec3::Z]);
        assert_eq!([shading(1, 0), shading(1, 1), shading(1, 2)], [Vec3::Z, given, given]);
        assert!(
            said(&flattened).contains("corners without a normal are shaded flat: 2 of 6"),
            "{}",
            said(&flattened)
        );
    }

    #[test]
    fn texture_coordinates_stay_with_their_corners() {
        let text = "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0.25 0.5\nvt 1 1\nf 1/1 2/2 3\n";
        let mesh = mesh_of(&scene(&[("u.obj", text)], "", "").instances[0]);
        let uv = mesh.triangles[0].map(|vertex| mesh.uvs[vertex as usize]);
        assert_eq!(uv, [Vec2::new(0.25, 0.5), Vec2::ONE, Vec2::ZERO]);
    }

    #[test]
    fn materials_of_the_file_are_translated() {
        let library = "newmtl wall\nKd 0.5\nnewmtl lamp\nKd 0 0 0\nKe 3 2 1\nillum 2\nnewmtl glass\nd 0.2\nNi 1.33\n\
                       newmtl mirror\nillum 3\nKs 0.9 0.8 0.7\nnewmtl unused\nKd 1 1 1\n";
        let face = "f 1 2 3\n";
        let text = format!(
            "mtllib my library.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl lamp\n{face}f 1 2 2\nusemtl wall\n{face}o x\n{face}\
             usemtl glass\n{face}usemtl mirror\n{face}usemtl lamp\n{face}"
        );
        let flattened = scene(&[("m.obj", &text), ("my library.mtl", library)], "", "");
        let mesh = mesh_of(&flattened.instances[0]);
        let names: Vec<&str> = flattened.materials.iter().map(|(name, _)| name.as_str()).collect();
        assert_eq!(
            names,
            ["white", "m.obj:lamp", "m.obj:wall", "m.obj:glass", "m.obj:mirror"]
        );
        assert_eq!(mesh.materials, [1, 2, 2, 3, 4, 1]);
        let lamp = Rgb::new(3.0, 2.0, 1.0);
        let black = Rgb::BLACK;
        let emission = &flattened.instances[0].emission;
        assert_eq!(
            *emission,
            Emission::PerTriangle(vec![lamp, black, black, black, black, lamp])
        );
        assert_eq!((emission.of(0), emission.of(1)), (lamp, black));
        let described = |index: usize| &flattened.materials[index].1;
        let grey = Rgb::splat(0.5).into();
        assert_eq!(
            *described(2),
            MaterialDescription::Diffuse {
                reflectance: grey,
                two_sided: true
            }
        );
        assert!(matches!(described(3), MaterialDescription::Dielectric { interior_ior, .. } if *interior_ior == 1.33));
        let mirror = Rgb::new(0.9, 0.8, 0.7).into();
        assert!(matches!(described(4), MaterialDescription::Conductor { reflectance, .. } if *reflectance == mirror));
    }

    #[test]
    fn the_same_file_twice_brings_its_materials_once_and_the_shapes_emission_wins() {
        let folder = tempfile::tempdir().expect("a folder");
        let mesh = "mtllib l.mtl\nusemtl lamp\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
        fs::write(folder.path().join("m.obj"), mesh).expect("a file");
        fs::write(folder.path().join("l.mtl"), "newmtl lamp\nKe 1 1 1\n").expect("a file");
        let shape = "(shape: Obj(file: \"m.obj\")), (shape: Obj(file: \"m.obj\"), emission: (5, 5, 5))";
        let text = scene_of("Sphere(radius: 1)", "").replace("shapes: [", &format!("shapes: [{shape}, "));
        let flattened = read(&text, folder.path());
        assert_eq!(flattened.materials.len(), 2);
        assert_eq!(flattened.instances[0].emission, Emission::Uniform(Rgb::ONE));
        assert_eq!(flattened.instances[1].emission, Emission::Uniform(Rgb::splat(5.0)));
        assert_eq!(flattened.instances[2].emission, Emission::None);
    }
}

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

//! Height fields: parallelograms with hills, as meshes with smooth shading normals.

use super::{checked, normal_map};
use crate::scene::at::{At, wide};
use crate::scene::description::TextureEncoding;
use crate::scene::error::SceneError;
use crate::scene::mesh::Mesh;
use crate::scene::read::read_bounded;
use crate::texture::decode;
use glam::{DAffine3, DVec3, Vec2};
use std::path::Path;

/// The most heights: 4096 x 4096.
pub(in crate::scene) const MAX_HEIGHTS: usize = 1 << 24;
/// The largest picture file, in bytes.
const MAX_PICTURE_BYTES: u64 = 2 << 30;

/// Heights over a grid: rows along u, from v = 0 to v = 1.
pub(in crate::scene) struct Heights {
    columns: usize,
    values: Vec<f32>,
}

/// Where a height field lies.
#[derive(Clone, Copy, Debug)]
pub(in crate::scene) struct Ground {
    pub(in crate::scene) corner: [f32; 3],
    pub(in crate::scene) edge_u: [f32; 3],
    pub(in crate::scene) edge_v: [f32; 3],
    /// By how much heights are scaled.
    pub(in crate::scene) height: f32,
}

impl Heights {
    /// Heights listed row by row; validation has seen to it that all rows are equally long.
    pub(in crate::scene) fn listed(rows: &[Vec<f32>]) -> Self {
        Self {
            columns: rows.first().map_or(0, Vec::len),
            values: rows.concat(),
        }
    }

    /// Heights from a picture: the mean of the channels, as numbers and not as colours; its bottom row is at v = 0. `at` is
    /// the place of the file's name.
    pub(in crate::scene) fn read(at: &At, file: &Path) -> Result<Self, SceneError> {
        let path = at.source.base_dir.join(file);
        let shown = file.display();
        let bytes = read_bounded(&path, MAX_PICTURE_BYTES)
            .map_err(|problem| at.error(format!("cannot read the heights {}: {problem}", path.display()), ""))?;
        let picture =
            decode(&bytes, TextureEncoding::Linear).map_err(|problem| at.error(format!("{shown}: {problem}"), ""))?;
        let (columns, rows) = (picture.width(), picture.height());
        if columns < 2 || rows < 2 || columns * rows > MAX_HEIGHTS {
            let message = format!(
                "{shown} has {columns} x {rows} texels: a height field needs 2 x 2 heights or more, and at most {MAX_HEIGHTS} in all"
            );
            return Err(at.error(message, "scale the picture"));
        }
        let value = |row: usize, column: usize| picture.at(column, rows - 1 - row).mean();
        Ok(Self {
            columns,
            values: (0..rows * columns).map(|i| value(i / columns, i % columns)).collect(),
        })
    }

    fn rows(&self) -> usize {
        self.values.len() / self.columns
    }

    fn at(&self, column: usize, row: usize) -> f64 {
        f64::from(self.values[row * self.columns + column])
    }

    /// How fast the height grows along u and along v at a vertex, per unit of each: over both neighbours, or over one and the
    /// vertex itself at an edge.
    fn slopes(&self, column: usize, row: usize) -> [f64; 2] {
        let around = |i: usize, count: usize| (i.saturating_sub(1), (i + 1).min(count - 1));
        let slope = |(low, high): (usize, usize), count: usize, at: &dyn Fn(usize) -> f64| {
            (at(high) - at(low)) * (count - 1) as f64 / (high - low) as f64
        };
        let (columns, rows) = (self.columns, self.rows());
        [
            slope(around(column, columns), columns, &|i| self.at(i, row)),
            slope(around(row, rows), rows, &|j| self.at(column, j)),
        ]
    }
}

/// The triangles of a height field, two for each four neighbouring heights.
pub(in crate::scene) fn mesh(
    at: &At,
    heights: &Heights,
    ground: &Ground,
    map: &DAffine3,
    material: u32,
) -> Result<Mesh, SceneError> {
    let [corner, edge_u, edge_v] = [ground.corner, ground.edge_u, ground.edge_v].map(wide);
    let up = edge_u.cross(edge_v).normalize() * f64::from(ground.height);
    let normals = normal_map(map);
    let (columns, rows) = (heights.columns, heights.rows());
    let mut mesh = Mesh::default();
    let mut points: Vec<DVec3> = Vec::with_capacity(columns * rows);
    for row in 0..rows {
        for column in 0..columns {
            let (u, v) = (column as f64 / (columns - 1) as f64, row as f64 / (rows - 1) as f64);
            points.push(corner + edge_u * u + edge_v * v + up * heights.at(column, row));
            let [slope_u, slope_v] = heights.slopes(column, row);
            let normal = (edge_u + up * slope_u).cross(edge_v + up * slope_v).normalize();
            mesh.normals.push((normals * normal).normalize().as_vec3());
            mesh.uvs.push(Vec2::new(u as f32, v as f32));
        }
    }
    let columns = columns as u32;
    let faces = (0..rows as u32 - 1).flat_map(|j| (0..columns - 1).map(move |i| j * columns + i));
    let triangles = faces.flat_map(|a| [[a, a + 1, a + columns + 1], [a, a + columns + 1, a + columns]]);
    mesh.add(&points, triangles, map, material);
    let mut mesh = checked(at, mesh)?;
    mesh.repair_normals();
    Ok(mesh)
}

#[cfg(test)]
mod tests {
    use crate::scene::testing::{areas, flatten_one, mesh_of, normals, scene_of};
    use crate::scene::{Format, flatten, parse_scene};
    use glam::Vec3;
    use image::{ExtendedColorType, ImageEncoder, codecs::png::PngEncoder};

    const GROUND: &str = "corner: (0, 0, 0), edge_u: (2, 0, 0), edge_v: (0, 0, -2)";

    fn field(heights: &str, transform: &str) -> crate::scene::Mesh {
        mesh_of(&flatten_one(&format!("HeightField({GROUND}, {heights})"), transform))
    }

    #[test]
    fn heights_stand_on_the_ground_along_its_normal() {
        let mesh = field("heights: [[0, 1, 0], [0, 0, 3]], height: 0.5", "");
        let expected = [
            (0.0, 0.0, 0.0),
            (1.0, 0.5, 0.0),
            (2.0, 0.0, 0.0),
            (0.0, 0.0, -2.0),
            (1.0, 0.0, -2.0),
            (2.0, 1.5, -2.0),
        ];
        assert_eq!(mesh.positions, expected.map(|(x, y, z)| Vec3::new(x, y, z)));
        assert_eq!(
            (mesh.triangles.len(), mesh.uvs[1].to_array(), mesh.uvs[5].to_array()),
            (4, [0.5, 0.0], [1.0, 1.0])
        );
        assert!(normals(&mesh).iter().all(|normal| normal.y > 0.0));
    }

    #[test]
    fn a_plane_is_flat_and_has_its_area_and_normal() {
        // Rises by one over two along u, and falls by two over two along v.
        let mesh = field(
            "heights: [[0, 0.25, 0.5, 0.75, 1], [-1, -0.75, -0.5, -0.25, 0], [-2, -1.75, -1.5, -1.25, -1]]",
            "",
        );
        let normal = Vec3::new(-0.5, 1.0, -1.0).normalize();
        assert!(
            mesh.normals
                .iter()
                .chain(&normals(&mesh))
                .all(|n| n.distance(normal) < 1e-6)
        );
        let area: f32 = areas(&mesh).iter().sum();
        assert!((area - 4.0 * 1.5).abs() < 1e-5, "{area}");
        let mirrored = field("heights: [[0, 0.5], [0, 0.5]]", "Scale((1, -1, 1))");
        assert!(mirrored.normals.iter().chain(&normals(&mirrored)).all(|n| n.y < 0.0));
    }

    #[test]
    fn shading_normals_are_smooth_over_a_paraboloid() {
        let size = 33;
        let height = |i: usize| {
            let x = i as f32 / (size - 1) as f32 - 0.5;
            x * x
        };
        let rows: Vec<String> = (0..size)
            .map(|j| {
                let row: Vec<String> = (0..size).map(|i| (height(i) + height(j)).to_string()).collect();
                format!("[{}]", row.join(", "))
            })
            .collect();
        let mesh = field(&format!("heights: [{}], height: 2", rows.join(", ")), "");
        for (position, normal) in mesh.positions.iter().zip(&mesh.normals) {
            // y = 2 ((x/2 - 1/2)² + (z/2 + 1/2)²): central differences of it are exact.
            let inside = |c: f32| (c.abs() - 1.0).abs() < 0.9;
            if inside(position.x) && inside(position.z) {
                let expected = Vec3::new(-(position.x - 1.0), 1.0, -(position.z + 1.0)).normalize();
                assert!(normal.distance(expected) < 1e-4, "{position}: {normal} for {expected}");
            }
        }
    }

    #[test]
    fn a_pictures_bottom_row_lies_at_the_corner() {
        let folder = tempfile::tempdir().expect("a folder");
        let mut png = Vec::new();
        // Top row 255 0, bottom row 0 51.
        let encoded = PngEncoder::new(&mut png).write_image(&[255, 0, 0, 51], 2, 2, ExtendedColorType::L8);
        encoded.expect("encoded");
        std::fs::write(folder.path().join("h.png"), png).expect("a file");
        let text = scene_of(&format!("HeightField({GROUND}, file: \"h.png\", height: 10)"), "");
        let source = parse_scene("test.ron", &text, Format::Ron, folder.path()).expect("a scene");
        let mesh = mesh_of(&flatten(&source).expect("a height field").instances[0]);
        let heights: Vec<f32> = mesh.positions.iter().map(|p| p.y).collect();
        for (found, expected) in heights.into_iter().zip([0.0, 2.0, 10.0, 0.0]) {
            assert!((found - expected).abs() < 1e-5, "{found} for {expected}");
        }
    }
}

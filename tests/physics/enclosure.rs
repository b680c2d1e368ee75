//! A closed room whose walls all emit alike: what the furnaces are built from.

/// Six quads of material `wall` that face into the cube from −1 to 1 on every axis, with radiance 1.
pub fn walls() -> String {
    let mut shapes = String::new();
    for axis in 0..3 {
        for high in [false, true] {
            let unit = |axis: usize, length: i32| {
                let mut edge = [0; 3];
                edge[axis % 3] = length;
                let [x, y, z] = edge;
                format!("({x}, {y}, {z})")
            };
            let mut corner = [-1, -1, -1];
            if high {
                corner[axis] = 1;
            }
            let [x, y, z] = corner;
            // The next two axes in turn make this one; swapped, its opposite.
            let (u, v) = if high {
                (axis + 2, axis + 1)
            } else {
                (axis + 1, axis + 2)
            };
            shapes += &format!(
                "(shape: Quad(corner: ({x}, {y}, {z}), edge_u: {}, edge_v: {}), material: \"wall\", emission: (1, 1, 1)),",
                unit(u, 2),
                unit(v, 2)
            );
        }
    }
    shapes
}

//! Binary glTF 2.0, and its smooth normals for round surfaces.

use std::ops::AddAssign;

use nalgebra::Vector3;
use serde_json::{Value, json};

use crate::mesh::{Mesh, double_area_normal};
use crate::read::Part;
use crate::surface::Groups;
use crate::write::{WriteError, checked, single};

const FLOAT: u32 = 5126;
const UNSIGNED_SHORT: u32 = 5123;
const UNSIGNED_INT: u32 = 5125;
const ARRAY_BUFFER: u32 = 34962;
const ELEMENT_ARRAY_BUFFER: u32 = 34963;

/// Writes all parts as one GLB: one scene, one node without a transform, one mesh with one primitive per part.
///
/// A part's colour becomes the base colour of a material, without conversion between sRGB and linear values. A part
/// without a colour has no material. Equal materials are written once. The axes of the parts are kept, although glTF
/// has y up.
///
/// # Errors
/// [`WriteError`] if there are no triangles, or if a part is invalid.
pub fn glb(parts: &[Part]) -> Result<Vec<u8>, WriteError> {
    write(parts, false)
}

/// As [`glb`], with normals, so that round surfaces render smoothly. Vertices at a crease are duplicated, once per
/// normal. Positions equal those of the parts, bit for bit.
///
/// # Errors
/// As [`glb`].
pub fn smooth_glb(parts: &[Part]) -> Result<Vec<u8>, WriteError> {
    write(parts, true)
}

fn write(parts: &[Part], smooth: bool) -> Result<Vec<u8>, WriteError> {
    let parts = checked(parts, "GLB")?;
    let mut data = Data::default();
    let mut materials: Vec<Value> = Vec::new();
    let mut primitives = Vec::with_capacity(parts.len());
    for part in parts {
        let shaded = smooth.then(|| shaded(&part.mesh));
        let mesh = shaded.as_ref().map_or(&part.mesh, |shaded| &shaded.mesh);
        let mut attributes = json!({ "POSITION": data.push_positions(mesh) });
        if let Some(shaded) = &shaded {
            attributes["NORMAL"] = json!(data.push_normals(&shaded.normals));
        }
        let indices = data.push_indices(mesh);
        let mut primitive = json!({ "attributes": attributes, "indices": indices });
        if let Some(color) = part.color {
            let material = material(part.material.as_deref(), color);
            let index =
                materials.iter().position(|known| *known == material).unwrap_or(materials.len());
            if index == materials.len() {
                materials.push(material);
            }
            primitive["material"] = json!(index);
        }
        primitives.push(primitive);
    }
    let mut root = json!({
        "asset": { "version": "2.0", "generator": "urdd" },
        "scene": 0,
        "scenes": [{ "nodes": [0] }],
        "nodes": [{ "mesh": 0 }],
        "meshes": [{ "primitives": primitives }],
    });
    if !materials.is_empty() {
        root["materials"] = json!(materials);
    }
    root["accessors"] = json!(data.accessors);
    root["bufferViews"] = json!(data.views);
    root["buffers"] = json!([{ "byteLength": data.bytes.len() }]);
    container(&root, &data.bytes)
}

/// The header and the two chunks. The JSON is padded to 4 bytes with spaces; the data already has a multiple of 4
/// bytes.
fn container(root: &Value, data: &[u8]) -> Result<Vec<u8>, WriteError> {
    let mut json = root.to_string().into_bytes();
    json.resize(json.len().next_multiple_of(4), b' ');
    let length = |length: usize| u32::try_from(length).map_err(|_| WriteError::TooLarge("GLB"));
    let total = 12 + 8 + json.len() + 8 + data.len();
    let mut bytes = Vec::with_capacity(total);
    bytes.extend(b"glTF");
    bytes.extend(2_u32.to_le_bytes());
    bytes.extend(length(total)?.to_le_bytes());
    bytes.extend(length(json.len())?.to_le_bytes());
    bytes.extend(b"JSON");
    bytes.extend(json);
    bytes.extend(length(data.len())?.to_le_bytes());
    bytes.extend(b"BIN\0");
    bytes.extend(data);
    Ok(bytes)
}

/// A matt material: glTF's default is bare metal, which is black in a viewer without an environment map.
fn material(name: Option<&str>, color: [f64; 4]) -> Value {
    let mut material = name.map_or(json!({}), |name| json!({ "name": name }));
    material["pbrMetallicRoughness"] =
        json!({ "baseColorFactor": color, "metallicFactor": 0, "roughnessFactor": 0.75 });
    if color[3] < 1.0 {
        material["alphaMode"] = json!("BLEND");
    }
    material
}

/// The binary chunk, its views and accessors. Each accessor has its own view, which starts at a multiple of 4.
#[derive(Default)]
struct Data {
    bytes: Vec<u8>,
    views: Vec<Value>,
    accessors: Vec<Value>,
}

impl Data {
    fn push_positions(&mut self, mesh: &Mesh) -> usize {
        let start = self.bytes.len();
        let mut low = [f32::INFINITY; 3];
        let mut high = [f32::NEG_INFINITY; 3];
        for vertex in &mesh.vertices {
            let vertex = single(*vertex);
            for (axis, coordinate) in vertex.iter().enumerate() {
                low[axis] = low[axis].min(*coordinate);
                high[axis] = high[axis].max(*coordinate);
                self.bytes.extend(coordinate.to_le_bytes());
            }
        }
        let index = self.push(start, ARRAY_BUFFER, FLOAT, mesh.vertices.len(), "VEC3");
        self.accessors[index]["min"] = json!(low.map(f64::from));
        self.accessors[index]["max"] = json!(high.map(f64::from));
        index
    }

    fn push_normals(&mut self, normals: &[[f32; 3]]) -> usize {
        let start = self.bytes.len();
        let numbers = normals.as_flattened().iter();
        self.bytes.extend(numbers.flat_map(|x| x.to_le_bytes()));
        self.push(start, ARRAY_BUFFER, FLOAT, normals.len(), "VEC3")
    }

    fn push_indices(&mut self, mesh: &Mesh) -> usize {
        let start = self.bytes.len();
        let corners = mesh.triangles.iter().flatten();
        // The index 65535 would restart the primitive.
        let component = if mesh.vertices.len() <= 65535 {
            self.bytes.extend(
                corners.filter_map(|corner| u16::try_from(*corner).ok()).flat_map(u16::to_le_bytes),
            );
            UNSIGNED_SHORT
        } else {
            self.bytes.extend(corners.flat_map(|corner| corner.to_le_bytes()));
            UNSIGNED_INT
        };
        let count = mesh.triangles.len() * 3;
        let index = self.push(start, ELEMENT_ARRAY_BUFFER, component, count, "SCALAR");
        self.bytes.resize(self.bytes.len().next_multiple_of(4), 0);
        index
    }

    /// Adds a view of the bytes from `start` on, and its accessor; returns the index of both.
    fn push(
        &mut self,
        start: usize,
        target: u32,
        component: u32,
        count: usize,
        shape: &str,
    ) -> usize {
        let (view, length) = (self.views.len(), self.bytes.len() - start);
        self.views.push(
            json!({ "buffer": 0, "byteOffset": start, "byteLength": length, "target": target }),
        );
        self.accessors.push(json!({ "bufferView": view, "componentType": component, "count": count, "type": shape }));
        view
    }
}

/// Cosine of the crease angle, 35 degrees. Faces that meet at a smaller angle belong to a round surface. Cylinders of
/// robots have at least a dozen corners, which is 30 degrees; chamfers have 45.
const CREASE: f64 = 0.819_152_044_288_991_8;

/// A mesh with one normal per vertex. The vertices start with those of the mesh, in order. Copies of vertices with
/// several normals, at creases of the surface, follow.
struct Shaded {
    mesh: Mesh,
    normals: Vec<[f32; 3]>,
}

/// Computes the normals of a mesh. Faces around a vertex share a normal as long as adjacent ones meet, along an edge,
/// at less than the crease angle. Each face is weighted by its angle at the vertex.
///
/// The mesh must be welded and have no index out of range.
fn shaded(mesh: &Mesh) -> Shaded {
    let units: Vec<Vector3<f64>> = mesh
        .triangles
        .iter()
        .map(|triangle| unit(double_area_normal(mesh.corners(*triangle))))
        .collect();
    // Corners that share a normal.
    let mut groups = Groups::new(mesh.triangles.len() * 3);
    // Each edge of a triangle: its ends in ascending order, and the corner at which it starts.
    let mut edges: Vec<([u32; 2], usize)> = Vec::with_capacity(mesh.triangles.len() * 3);
    for (at, triangle) in mesh.triangles.iter().enumerate() {
        for k in 0..3 {
            let (a, b) = (triangle[k], triangle[(k + 1) % 3]);
            edges.push(([a.min(b), a.max(b)], 3 * at + k));
        }
    }
    edges.sort_unstable();
    for pair in edges.windows(2) {
        let ((ends, first), (others, second)) = (pair[0], pair[1]);
        if ends != others || units[first / 3].dot(&units[second / 3]) < CREASE {
            continue;
        }
        // The corners at which the edge starts and ends.
        let corners = |corner: usize| [corner, corner / 3 * 3 + (corner + 1) % 3];
        let vertex = |corner: usize| mesh.triangles[corner / 3][corner % 3];
        for one in corners(first) {
            for other in corners(second) {
                if vertex(one) == vertex(other) {
                    groups.join(one, other);
                }
            }
        }
    }
    drop(edges);
    let mut sums = vec![Vector3::zeros(); mesh.triangles.len() * 3];
    for (at, triangle) in mesh.triangles.iter().enumerate() {
        let corners = mesh.corners(*triangle).map(Vector3::from);
        for k in 0..3 {
            let (u, v) = (corners[(k + 1) % 3] - corners[k], corners[(k + 2) % 3] - corners[k]);
            let angle = u.cross(&v).norm().atan2(u.dot(&v));
            sums[groups.first(3 * at + k)].add_assign(units[at] * angle);
        }
    }
    let mut out =
        Shaded { mesh: mesh.clone(), normals: vec![[0.0, 0.0, 1.0]; mesh.vertices.len()] };
    const FREE: u32 = u32::MAX;
    let mut vertex_of = vec![FREE; mesh.triangles.len() * 3];
    let mut is_taken = vec![false; mesh.vertices.len()];
    for at in 0..mesh.triangles.len() * 3 {
        let group = groups.first(at);
        let vertex = mesh.triangles[at / 3][at % 3];
        if vertex_of[group] == FREE {
            // If opposite faces cancel, use the normal of the first face.
            let sum = sums[group];
            let normal = if sum.norm() > 1e-6 { unit(sum) } else { units[group / 3] };
            let normal: [f32; 3] = normal.map(|x| x as f32 + 0.0).into();
            if is_taken[vertex as usize] {
                // The number of corners fits the index type.
                vertex_of[group] = u32::try_from(out.mesh.vertices.len()).unwrap_or(vertex);
                out.mesh.vertices.push(mesh.vertices[vertex as usize]);
                out.normals.push(normal);
            } else {
                is_taken[vertex as usize] = true;
                vertex_of[group] = vertex;
                out.normals[vertex as usize] = normal;
            }
        }
        out.mesh.triangles[at / 3][at % 3] = vertex_of[group];
    }
    out
}

fn unit(vector: Vector3<f64>) -> Vector3<f64> {
    vector.try_normalize(0.0).unwrap_or_else(Vector3::z)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::primitives::{cuboid, cylinder, sphere};

    #[test]
    fn a_box_has_three_normals_at_each_corner() {
        let found = shaded(&cuboid([1.0, 2.0, 3.0]));
        assert_eq!(found.mesh.vertices.len(), 24);
        assert_eq!(found.mesh.vertices[..8], cuboid([1.0, 2.0, 3.0]).vertices);
        for (triangle, normal) in
            found.mesh.triangles.iter().flat_map(|t| t.map(|v| (*t, found.normals[v as usize])))
        {
            let face = unit(double_area_normal(found.mesh.corners(triangle)));
            assert_eq!(face.map(|x| x as f32), Vector3::from(normal));
        }
    }

    #[test]
    fn a_sphere_has_the_normals_of_a_sphere() {
        let mesh = sphere(0.5);
        let found = shaded(&mesh);
        assert_eq!(found.mesh, mesh);
        for (vertex, normal) in found.mesh.vertices.iter().zip(&found.normals) {
            let radial = Vector3::from(*vertex) / 0.5;
            let normal = Vector3::from(normal.map(f64::from));
            assert!((normal.norm() - 1.0).abs() < 1e-6);
            // One degree.
            assert!(normal.dot(&radial) > 0.9998, "{vertex:?} {normal:?}");
        }
    }

    #[test]
    fn a_cylinder_is_round_and_its_caps_are_flat() {
        let found = shaded(&cylinder(0.1, 0.4));
        for (vertex, normal) in found.mesh.vertices.iter().zip(&found.normals) {
            let along = f64::from(normal[2]);
            let radial =
                (f64::from(normal[0]) * vertex[0] + f64::from(normal[1]) * vertex[1]) / 0.1;
            assert!(along.abs() > 0.9999 || radial > 0.9999, "{vertex:?} {normal:?}");
        }
    }
}

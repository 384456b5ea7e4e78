//! Binary glTF 2.0.

use serde_json::{Value, json};

use super::super::mesh::Mesh;
use super::super::read::Part;
use super::normals::shaded;
use super::{WriteError, checked, single};

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

//! Binary glTF 2.0.

use serde_json::{Map, Value, json};

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
        let mut primitive = Map::new();
        let (attributes, indices) = if smooth {
            let shaded = shaded(&part.mesh);
            let position = data.push_positions(&shaded.mesh);
            let normal = data.push_normals(&shaded.normals);
            let attributes = json!({ "POSITION": position, "NORMAL": normal });
            (attributes, data.push_indices(&shaded.mesh))
        } else {
            let attributes = json!({ "POSITION": data.push_positions(&part.mesh) });
            (attributes, data.push_indices(&part.mesh))
        };
        primitive.insert("attributes".to_owned(), attributes);
        primitive.insert("indices".to_owned(), json!(indices));
        if let Some(color) = part.color {
            let material = material(part.material.as_deref(), color);
            let index =
                materials.iter().position(|known| *known == material).unwrap_or(materials.len());
            if index == materials.len() {
                materials.push(material);
            }
            primitive.insert("material".to_owned(), json!(index));
        }
        primitives.push(Value::Object(primitive));
    }
    let mut root = Map::new();
    let mut set = |key: &str, value: Value| root.insert(key.to_owned(), value);
    set("asset", json!({ "version": "2.0", "generator": "urdd" }));
    set("scene", json!(0));
    set("scenes", json!([{ "nodes": [0] }]));
    set("nodes", json!([{ "mesh": 0 }]));
    set("meshes", json!([{ "primitives": primitives }]));
    if !materials.is_empty() {
        set("materials", json!(materials));
    }
    set("accessors", json!(data.accessors));
    set("bufferViews", json!(data.views));
    set("buffers", json!([{ "byteLength": data.bytes.len() }]));
    container(&Value::Object(root), &data.bytes)
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
    let mut material = Map::new();
    if let Some(name) = name {
        material.insert("name".to_owned(), json!(name));
    }
    material.insert(
        "pbrMetallicRoughness".to_owned(),
        json!({ "baseColorFactor": color, "metallicFactor": 0, "roughnessFactor": 0.75 }),
    );
    if color[3] < 1.0 {
        material.insert("alphaMode".to_owned(), json!("BLEND"));
    }
    Value::Object(material)
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
        let view = self.push_view(start, ARRAY_BUFFER);
        let (low, high) = (low.map(f64::from), high.map(f64::from));
        self.accessors.push(json!({
            "bufferView": view, "componentType": FLOAT, "count": mesh.vertices.len(), "type": "VEC3", "min": low, "max": high,
        }));
        self.accessors.len() - 1
    }

    fn push_normals(&mut self, normals: &[[f32; 3]]) -> usize {
        let start = self.bytes.len();
        let numbers = normals.as_flattened().iter();
        self.bytes.extend(numbers.flat_map(|x| x.to_le_bytes()));
        let view = self.push_view(start, ARRAY_BUFFER);
        self.accessors.push(json!({
            "bufferView": view, "componentType": FLOAT, "count": normals.len(), "type": "VEC3",
        }));
        self.accessors.len() - 1
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
        let view = self.push_view(start, ELEMENT_ARRAY_BUFFER);
        self.bytes.resize(self.bytes.len().next_multiple_of(4), 0);
        self.accessors.push(json!({
            "bufferView": view, "componentType": component, "count": mesh.triangles.len() * 3, "type": "SCALAR",
        }));
        self.accessors.len() - 1
    }

    fn push_view(&mut self, start: usize, target: u32) -> usize {
        self.views.push(json!({ "buffer": 0, "byteOffset": start, "byteLength": self.bytes.len() - start, "target": target }));
        self.views.len() - 1
    }
}

//! glTF 2.0, as JSON and as GLB: the nodes, and the meshes that they place.

mod accessor;
mod json;

use std::collections::{BTreeMap, HashMap};
use std::sync::Arc;

use nalgebra::{Matrix4, Quaternion, UnitQuaternion, Vector3};
use serde_json::Value;

use crate::mesh::Mesh;
use crate::polygon::{fan, strip};
use crate::read::assembly::{Assembly, FIRST_SCENE, Material, Nesting, Picker, UvCorners, mark};
use crate::read::bytes::skip_byte_order_mark;
use crate::read::collada::path_of_url;
use crate::read::scene::{Failure, Fault, GltfUp, NoteCode, Place, Texture};
use accessor::{Buffers, Fetch, decode, is_data};
use json::{Node, Primitive, Root};

/// What is behind the vendor in names of extensions for textures, lights and materials, which leave positions as they are.
const LOOKS: [&str; 3] = ["_texture_", "_lights_", "_materials_"];

fn behind_vendor(extension: &str) -> &str {
    extension.trim_start_matches(|c: char| c.is_ascii_alphanumeric())
}

pub(super) fn read_json(
    bytes: &[u8],
    fetch: Fetch<'_>,
    assembly: &mut Assembly,
) -> Result<(), Failure> {
    read_document(skip_byte_order_mark(bytes), None, fetch, assembly)
}

/// Reads a .glb: a 12-byte header, a JSON chunk, and optionally a binary chunk. Clamps lengths beyond the end of the
/// file. A wrong total length adds a note; missing data fails where it is used.
pub(super) fn read_binary(
    bytes: &[u8],
    fetch: Fetch<'_>,
    assembly: &mut Assembly,
) -> Result<(), Failure> {
    let word = |at: usize| {
        bytes.get(at..at + 4).and_then(|word| word.try_into().ok()).map(u32::from_le_bytes)
    };
    let cut = || Fault::Truncated("a GLB has a header of 12 bytes and a chunk of JSON".to_owned());
    let version = word(4).ok_or_else(cut)?;
    if version != 2 {
        let text = format!("GLB version {version} is not supported, only version 2");
        return Err(Fault::not_supported(text));
    }
    let length = word(8).ok_or_else(cut)? as usize;
    if length != bytes.len() {
        let text = format!("the header states {length} bytes, but the file has {}", bytes.len());
        let is_cut = length > bytes.len();
        assembly.notes.add(if is_cut { NoteCode::CutOff } else { NoteCode::WrongCount }, text);
    }
    let mut chunks = Vec::new();
    let mut at = 12;
    while let (Some(length), Some(kind), true) = (word(at), word(at + 4), chunks.len() < 2) {
        let start = at + 8;
        let end = start.saturating_add(length as usize).min(bytes.len());
        chunks.push((kind, &bytes[start..end]));
        at = end;
    }
    const JSON: u32 = u32::from_le_bytes(*b"JSON");
    const BIN: u32 = u32::from_le_bytes(*b"BIN\0");
    match chunks[..] {
        [(JSON, json), (BIN, data), ..] => read_document(json, Some(data), fetch, assembly),
        [(JSON, json), ..] => read_document(json, None, fetch, assembly),
        [] => Err(cut().into()),
        _ => Err(Fault::malformed("the first chunk is not JSON").at(|| Place::Byte(12))),
    }
}

fn read_document(
    json: &[u8],
    data: Option<&[u8]>,
    fetch: Fetch<'_>,
    assembly: &mut Assembly,
) -> Result<(), Failure> {
    let root: json::Root = serde_json::from_slice(json.trim_ascii_end()).map_err(|error| {
        let line = error.line();
        Fault::malformed(format!("the JSON is not glTF ({error})")).at(|| Place::Line(line))
    })?;
    if !root.asset.version.starts_with("2.") {
        let version = &root.asset.version;
        let text = format!("glTF version '{version}' is not supported, only 2.x");
        return Err(Fault::not_supported(text));
    }
    for extension in &root.extensions_required {
        match extension.as_str() {
            "KHR_draco_mesh_compression"
            | "EXT_meshopt_compression"
            | "KHR_meshopt_compression" => {
                return Err(Fault::not_supported(format!("the mesh is compressed ({extension})")));
            }
            "KHR_mesh_quantization" => {}
            other if LOOKS.iter().any(|look| behind_vendor(other).starts_with(look)) => {}
            other => {
                let text = format!("the extension {other} is required, but not supported");
                assembly.notes.add(NoteCode::LeftOut, text);
            }
        }
    }
    if !root.animations.is_empty() {
        assembly.notes.add(NoteCode::ShownOtherwise, "its animations were left out");
    }
    let files = root.images.iter().chain(&root.buffers);
    for uri in files.filter_map(|file| file.uri.as_deref()) {
        if !is_data(uri) {
            assembly.add_side_file(&path_of_url(uri));
        }
    }
    walk(&mut Buffers::new(&root, data, fetch), assembly)
}

const TRIANGLES: u32 = 4;
const STRIP: u32 = 5;
const FAN: u32 = 6;

/// Adds every mesh of the default scene; without scenes, of all root nodes.
fn walk(buffers: &mut Buffers<'_, '_>, assembly: &mut Assembly) -> Result<(), Failure> {
    let root = buffers.root;
    let start = match assembly.options.gltf_up {
        GltfUp::Keep => Matrix4::identity(),
        GltfUp::Turn => {
            let text = "the y-up axes of glTF were converted to z-up, as in RViz 2";
            assembly.notes.add(NoteCode::TurnedToZUp, text);
            // This matrix is exact; a computed rotation by 90 degrees would have rounding errors.
            Matrix4::new(
                1.0, 0.0, 0.0, 0.0, 0.0, 0.0, -1.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0,
            )
        }
    };
    let nodes = if root.scenes.is_empty() && root.scene.is_none() {
        assembly.notes.add(NoteCode::Assumed, "the file has no scene; all its nodes were used");
        let mut is_child = vec![false; root.nodes.len()];
        for child in root.nodes.iter().flat_map(|node| &node.children) {
            if let Some(flag) = is_child.get_mut(*child) {
                *flag = true;
            }
        }
        (0..root.nodes.len()).filter(|node| !is_child[*node]).collect()
    } else {
        if root.scene.is_none() && root.scenes.len() > 1 {
            assembly.notes.add(NoteCode::Assumed, FIRST_SCENE);
        }
        let index = root.scene.unwrap_or(0);
        let missing = || Fault::malformed(format!("scene {index} does not exist"));
        root.scenes.get(index).ok_or_else(missing)?.nodes.clone()
    };
    let mut walker = Walker {
        root,
        buffers,
        assembly,
        picker: Picker::default(),
        meshes: HashMap::new(),
        positions: HashMap::new(),
        images: HashMap::new(),
        used: BTreeMap::new(),
        num_positions: 0,
        num_triangles: 0,
        nesting: Nesting::new(),
    };
    for node in nodes {
        walker.node(node, &start)?;
    }
    let Walker { positions, used, assembly, .. } = walker;
    for (accessor, used) in used {
        assembly.note_unused(&positions[&(accessor, 3)], &used);
    }
    Ok(())
}

/// A mesh, and the texture coordinates of its vertices.
type Surface = (Mesh, Vec<[f64; 2]>);

struct Walker<'r, 'b, 'f, 'a> {
    root: &'r Root,
    buffers: &'b mut Buffers<'r, 'f>,
    assembly: &'a mut Assembly,
    picker: Picker,
    /// Meshes by index, so that each is read once.
    meshes: HashMap<usize, Vec<(Mesh, Material)>>,
    /// Positions (3 numbers) and texture coordinates (2) by accessor, so that each is read once even if primitives share
    /// it.
    positions: HashMap<(usize, usize), Vec<[f64; 3]>>,
    /// Embedded images.
    images: HashMap<usize, Option<Arc<[u8]>>>,
    /// For each of these accessors, which positions a triangle uses.
    used: BTreeMap<usize, Vec<bool>>,
    /// Numbers of vertices and triangles read, placed or not: many accessors may reference the same bytes.
    num_positions: usize,
    num_triangles: usize,
    nesting: Nesting<usize>,
}

impl Walker<'_, '_, '_, '_> {
    fn node(&mut self, index: usize, parent: &Matrix4<f64>) -> Result<(), Failure> {
        let missing = || Fault::malformed(format!("node {index} does not exist"));
        let node = self.root.nodes.get(index).ok_or_else(missing)?;
        self.nesting.enter(index, index)?;
        let own = local(node).map_err(|failure| failure.within("node", index))?;
        if own != Matrix4::identity() {
            let text = "a node has a transform of its own";
            self.assembly.notes.add(NoteCode::NodeTransform, text);
        }
        if node.extensions.get("EXT_mesh_gpu_instancing").is_some() {
            let text = "its instances (EXT_mesh_gpu_instancing) were left out";
            self.assembly.notes.add(NoteCode::ShownOtherwise, text);
        }
        let matrix = parent * own;
        if node.skin.is_some() {
            let text = "a skinned mesh was read without its skin";
            self.assembly.notes.add(NoteCode::SkinAsShape, text);
        }
        if let Some(mesh) = node.mesh {
            self.mesh(mesh, &matrix).map_err(|failure| failure.within("mesh", mesh))?;
        }
        for child in &node.children {
            self.node(*child, &matrix)?;
        }
        self.nesting.leave();
        Ok(())
    }

    fn mesh(&mut self, index: usize, matrix: &Matrix4<f64>) -> Result<(), Failure> {
        if !self.meshes.contains_key(&index) {
            let mesh =
                self.root.meshes.get(index).ok_or_else(|| Fault::malformed("it does not exist"))?;
            let mut parts = Vec::new();
            for primitive in &mesh.primitives {
                if let Some((mesh, uv)) = self.primitive(primitive)? {
                    let own = primitive.material.and_then(|own| self.root.materials.get(own));
                    let mut material = own.map(material).unwrap_or_default();
                    material.texture = own.and_then(|own| self.texture(own, uv));
                    parts.push((mesh, material));
                }
            }
            self.meshes.insert(index, parts);
        }
        let parts = &self.meshes[&index];
        self.nesting.visited += parts.len();
        for (mesh, material) in parts {
            self.assembly.add(mesh, matrix, material)?;
        }
        Ok(())
    }

    /// Reads positions, or texture coordinates, unless they are there.
    fn read(&mut self, accessor: usize, width: usize) -> Result<(), Failure> {
        if !self.positions.contains_key(&(accessor, width)) {
            let read = accessor::positions(accessor, width, self.buffers, self.assembly)
                .map_err(|failure| failure.within("accessor", accessor))?;
            self.num_positions += read.len();
            self.assembly.check_vertices(self.num_positions)?;
            self.positions.insert((accessor, width), read);
        }
        Ok(())
    }

    /// The texture of a material's base colour, with the first texture coordinates if it takes these as they are.
    fn texture(&mut self, material: &json::Material, uv: Vec<[f64; 2]>) -> Option<Texture> {
        let index = |value: &Value| usize::try_from(value.as_u64()?).ok();
        let (values, _, texture) = base(material);
        let info = values.get(texture).filter(|_| self.assembly.options.textures)?;
        let named = self.root.textures.get(index(info.get("index")?)?)?;
        // An extension has an image of another format.
        let others = named["extensions"].as_object().into_iter().flat_map(|of| of.values());
        let mut sources = std::iter::once(named).chain(others).filter_map(|of| of.get("source"));
        let image = sources.find_map(index)?;
        let file = self.root.images.get(image)?;
        let is_plain = matches!(info.get("texCoord").map(Value::as_u64), None | Some(Some(0)))
            && info["extensions"].get("KHR_texture_transform").is_none();
        let uv = if is_plain { uv } else { Vec::new() };
        if let Some(uri) = file.uri.as_ref().filter(|uri| !is_data(uri)) {
            return Some(Texture { name: path_of_url(uri), embedded: None, uv });
        }
        let (buffers, assembly) = (&mut self.buffers, &mut self.assembly);
        let bytes = self.images.entry(image).or_insert_with(|| match &file.uri {
            Some(uri) => decode(uri).map(Arc::from),
            None => {
                let view = buffers.view(index(&file.buffer_view)?, assembly);
                view.ok().map(|(bytes, _)| Arc::from(bytes))
            }
        });
        let embedded = Some(bytes.clone().unwrap_or_default());
        Some(Texture { name: format!("image {image}"), embedded, uv })
    }

    /// The mesh of a primitive, and the first texture coordinates of its vertices.
    fn primitive(&mut self, primitive: &Primitive) -> Result<Option<Surface>, Failure> {
        let mode = primitive.mode.unwrap_or(TRIANGLES);
        if !(TRIANGLES..=FAN).contains(&mode) {
            self.assembly.notes.add(NoteCode::LeftOut, "points or lines were left out");
            return Ok(None);
        }
        if primitive.extensions.get("KHR_draco_mesh_compression").is_some() {
            let text = "the mesh is compressed (KHR_draco_mesh_compression)";
            return Err(Fault::not_supported(text));
        }
        let Some(position) = primitive.attributes.position else {
            self.assembly.notes.add(NoteCode::LeftOut, "faces without positions were left out");
            return Ok(None);
        };
        self.read(position, 3)?;
        let uv = primitive.attributes.uv.as_u64().filter(|_| self.assembly.options.textures);
        let uv = uv.and_then(|uv| usize::try_from(uv).ok()).filter(|uv| self.read(*uv, 2).is_ok());
        if !primitive.targets.is_empty() {
            let text = "its morph targets were left out";
            self.assembly.notes.add(NoteCode::ShownOtherwise, text);
        }
        let vertices = &self.positions[&(position, 3)];
        if let Some(normal) = primitive.attributes.normal {
            let count = vertices.len();
            // The surface does not depend on the normals.
            if accessor::check_normals(normal, count, self.buffers, self.assembly).is_err() {
                let text = "its normals cannot be read";
                self.assembly.notes.add(NoteCode::WrongNormals, text);
            }
        }
        let corners = match primitive.indices {
            Some(indices) => accessor::indices(indices, self.buffers, self.assembly)
                .map_err(|failure| failure.within("accessor", indices))?,
            None => (0..u32::try_from(vertices.len()).unwrap_or(u32::MAX)).collect(),
        };
        let triangles: Vec<[u32; 3]> = match mode {
            STRIP => strip(&corners).collect(),
            FAN => fan(&corners).collect(),
            _ => corners.chunks_exact(3).map(|three| [three[0], three[1], three[2]]).collect(),
        };
        if mode == TRIANGLES && !corners.len().is_multiple_of(3) {
            let text = "one or two corners at the end, which are no whole triangle, were left out";
            self.assembly.notes.add(NoteCode::CutOff, text);
        }
        self.num_triangles += triangles.len();
        self.assembly.check_triangles(self.num_triangles)?;
        let used = self.used.entry(position).or_default();
        used.resize(vertices.len(), false);
        mark(used, &triangles);
        let (mesh, left_out) = self.picker.pick(vertices, &triangles);
        let text = "a triangle was dropped: a vertex index is out of range";
        self.assembly.notes.add_many(NoteCode::IndexOutOfRange, text, left_out);
        let Some(uv) = uv else { return Ok(Some((mesh, Vec::new()))) };
        let corners = UvCorners::of(triangles.clone());
        let (mesh, mut uvs) = corners.mesh(vertices, &triangles, &self.positions[&(uv, 2)]);
        // glTF counts from the top.
        uvs.iter_mut().for_each(|uv| uv[1] = 1.0 - uv[1]);
        Ok(Some((mesh, uvs)))
    }
}

fn local(node: &Node) -> Result<Matrix4<f64>, Failure> {
    let matrix = if let Some(matrix) = node.matrix {
        let mut matrix = Matrix4::from_column_slice(&matrix);
        matrix.set_row(3, &nalgebra::RowVector4::new(0.0, 0.0, 0.0, 1.0));
        matrix
    } else {
        let [x, y, z, w] = node.rotation.unwrap_or([0.0, 0.0, 0.0, 1.0]);
        // A quaternion of length 0 becomes the identity.
        let rotation =
            UnitQuaternion::try_new(Quaternion::new(w, x, y, z), 0.0).unwrap_or_default();
        let translation = node.translation.map_or(Vector3::zeros(), Vector3::from);
        let scale = node.scale.map_or(Vector3::repeat(1.0), Vector3::from);
        Matrix4::new_translation(&translation)
            * rotation.to_homogeneous()
            * Matrix4::new_nonuniform_scaling(&scale)
    };
    let is_finite = matrix.iter().all(|value| value.is_finite());
    is_finite.then_some(matrix).ok_or_else(|| Fault::malformed("its transform is not finite"))
}

/// Name and base colour; no colour with a texture.
fn material(material: &json::Material) -> Material {
    let (values, factor, texture) = base(material);
    let color = values.get(texture).is_none().then(|| rgba(values.get(factor)));
    Material { name: material.name.clone(), color, texture: None }
}

/// What describes the base colour, and the names of its factor and its texture.
fn base(material: &json::Material) -> (&Value, &'static str, &'static str) {
    let pbr = &material.pbr_metallic_roughness;
    match material.extensions.get("KHR_materials_pbrSpecularGlossiness") {
        Some(old) if pbr.is_null() => (old, "diffuseFactor", "diffuseTexture"),
        _ => (pbr, "baseColorFactor", "baseColorTexture"),
    }
}

/// Four numbers, clamped to 0 to 1; 1 for missing ones.
fn rgba(factor: Option<&Value>) -> [f64; 4] {
    std::array::from_fn(|at| {
        let value = factor.and_then(|factor| factor.get(at)?.as_f64());
        value.unwrap_or(1.0).clamp(0.0, 1.0)
    })
}

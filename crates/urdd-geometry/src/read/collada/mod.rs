//! COLLADA 1.4 and 1.5 (.dae): the text, and the visual scene with its nodes, the geometries that they place, and their materials.

mod document;
mod geometry;

use std::collections::HashMap;

use nalgebra::{Matrix4, Vector3};

use crate::read::assembly::{Assembly, FIRST_SCENE, Material, Nesting, within};
use crate::read::bytes::{Words, is_utf16, skip_byte_order_mark};
use crate::read::scene::{Failure, Fault, NoteCode, Place, Texture};
use document::{Document, child, children, file_of_image, rows, text, transform_of};
use geometry::{Primitive, Tools};
use urdd_xml::{Node, NodeId};

pub(super) use document::path_of_url;

/// Reads a document: adds every geometry of its visual scene where the nodes place it.
pub(super) fn read(bytes: &[u8], assembly: &mut Assembly) -> Result<(), Failure> {
    let text = decode(bytes, assembly)?;
    let (above, text) = begun(&text, assembly);
    let xml = urdd_xml::parse(text, urdd_xml::Kind::Other).map_err(|error| {
        let line = above + error.pos().row as usize;
        Fault::malformed(error.sentence(text)).at(|| Place::Line(line))
    })?;
    let root = xml.root_element();
    let tag = root.tag_name().name();
    if tag != "COLLADA" {
        return Err(Fault::malformed(format!("the outermost element is `{tag}`, not `COLLADA`")));
    }
    let document = Document::new(root, root.descendants());
    for image in document.images() {
        assembly.add_side_file(&image);
    }
    let unit = unit(root, assembly);
    note_up_axis(root, assembly);
    walk(&document, unit, assembly)
}

/// Decodes UTF-8 with or without a byte order mark, or UTF-16 with one. Invalid UTF-8, such as an author's name in
/// Latin-1, becomes replacement characters.
fn decode<'a>(
    bytes: &'a [u8],
    assembly: &mut Assembly,
) -> Result<std::borrow::Cow<'a, str>, Failure> {
    if is_utf16(bytes) {
        let decode = if bytes[0] == 0xff { u16::from_le_bytes } else { u16::from_be_bytes };
        let units: Vec<u16> = bytes[2..].as_chunks().0.iter().map(|pair| decode(*pair)).collect();
        return String::from_utf16(&units)
            .map(Into::into)
            .map_err(|_| Fault::malformed("the text is not UTF-16"));
    }
    let bytes = skip_byte_order_mark(bytes);
    let text = String::from_utf8_lossy(bytes);
    if matches!(text, std::borrow::Cow::Owned(_)) {
        assembly.notes.add(NoteCode::Assumed, "the text is not UTF-8; invalid bytes were replaced");
    }
    Ok(text)
}

/// The number of lines above the text, and the text. Assimp and PyBullet skip white space before `<?xml`, which XML does not
/// allow there.
fn begun<'t>(text: &'t str, assembly: &mut Assembly) -> (usize, &'t str) {
    let inside = text.trim_start();
    if inside.len() == text.len() || !inside.starts_with("<?xml ") {
        return (0, text);
    }
    let note = "there is white space before the declaration `<?xml …?>`; it was skipped";
    assembly.notes.add(NoteCode::Assumed, note);
    let above = &text[..text.len() - inside.len()];
    (above.matches('\n').count(), inside)
}

/// Length of one unit of the document, metres.
fn unit(root: Node<'_, '_>, assembly: &mut Assembly) -> f64 {
    let meter = child(root, "asset")
        .and_then(|asset| child(asset, "unit"))
        .and_then(|unit| unit.attribute("meter"));
    let Some(meter) = meter else { return 1.0 };
    match meter.trim().parse::<f64>() {
        Ok(unit) if unit.is_finite() && unit > 0.0 => {
            if unit != 1.0 {
                let text = format!("lengths were multiplied by the file's unit, {unit} m");
                assembly.notes.add(NoteCode::UnitApplied, text);
            }
            unit
        }
        _ => {
            let text = format!("the unit '{meter}' is not a positive number; metres were assumed");
            assembly.notes.add(NoteCode::Assumed, text);
            1.0
        }
    }
}

fn note_up_axis(root: Node<'_, '_>, assembly: &mut Assembly) {
    let up =
        child(root, "asset").and_then(|asset| child(asset, "up_axis")).and_then(|up| up.text());
    if let Some(up) = up.map(str::trim).filter(|up| *up != "Z_UP") {
        let text = format!("`up_axis` {up} was not applied, as in RViz and Pinocchio");
        assembly.notes.add(NoteCode::UpAxisIgnored, text);
    }
}

/// Maximum number of node bytes processed, counted for each placement.
const MAX_TEXT: usize = 1 << 28;

/// Adds every geometry of the scene with its placement.
///
/// Without a `scene` element, takes the first visual scene; without a visual scene, adds every geometry unplaced.
fn walk(document: &Document<'_>, unit: f64, assembly: &mut Assembly) -> Result<(), Failure> {
    let root = Matrix4::new_nonuniform_scaling(&Vector3::repeat(unit));
    let mut walker = Walker {
        document,
        tools: Tools::new(&assembly.options),
        assembly,
        geometries: HashMap::new(),
        looks: Looks::new(),
        nesting: Nesting::new(),
        text: 0,
    };
    let named = child(document.root, "scene")
        .and_then(|scene| child(scene, "instance_visual_scene"))
        .and_then(|instance| document.find("visual_scene", instance.attribute("url")?));
    if let Some(scene) = named {
        return walker.nodes(scene, &root);
    }
    let mut libraries = children(document.root, "library_visual_scenes");
    if let Some(scene) = libraries.find_map(|library| child(library, "visual_scene")) {
        walker.assembly.notes.add(NoteCode::Assumed, FIRST_SCENE);
        return walker.nodes(scene, &root);
    }
    let text = "the file has no scene; every geometry was read without a transform";
    walker.assembly.notes.add(NoteCode::Assumed, text);
    for library in children(document.root, "library_geometries") {
        for geometry in children(library, "geometry") {
            walker.geometry(geometry, None, &root)?;
        }
    }
    Ok(())
}

struct Walker<'a, 'd> {
    document: &'d Document<'a>,
    assembly: &'d mut Assembly,
    tools: Tools,
    /// Geometries by element, so that each is read once.
    geometries: HashMap<NodeId, Vec<Primitive<'a>>>,
    looks: Looks,
    nesting: Nesting<NodeId>,
    text: usize,
}

impl<'a> Walker<'a, '_> {
    fn nodes(&mut self, parent: Node<'a, 'a>, matrix: &Matrix4<f64>) -> Result<(), Failure> {
        for node in children(parent, "node") {
            self.node(node, matrix)?;
        }
        Ok(())
    }

    fn node(&mut self, node: Node<'a, 'a>, parent: &Matrix4<f64>) -> Result<(), Failure> {
        let name = node.attribute("id").or_else(|| node.attribute("name"));
        let name = name.unwrap_or("");
        self.nesting.enter(node.id(), name)?;
        let parts = node.children().filter(Node::is_element);
        self.text += parts
            .filter(|part| part.tag_name().name() != "node")
            .map(|part| part.range().len())
            .sum::<usize>();
        within("bytes of nodes, counted once per instance", self.text, MAX_TEXT)?;
        let matrix = parent * transform_of(node).map_err(|failure| failure.within("node", name))?;
        self.note_if_not_finite(&matrix);
        for element in node.children().filter(Node::is_element) {
            let url = element.attribute("url").unwrap_or("");
            match element.tag_name().name() {
                "node" => self.node(element, &matrix)?,
                "instance_node" => match self.document.find("node", url) {
                    Some(target) => self.node(target, &matrix)?,
                    None => self.missing("node", url),
                },
                "instance_geometry" => match self.document.find("geometry", url) {
                    Some(geometry) => self.geometry(geometry, Some(element), &matrix)?,
                    None => self.missing("geometry", url),
                },
                "instance_controller" => self.controller(element, url, &matrix)?,
                _ => {}
            }
        }
        self.nesting.leave();
        Ok(())
    }

    /// Adds a skin's geometry in its bind shape, or a morph's base, without joint motion.
    fn controller(
        &mut self,
        instance: Node<'a, 'a>,
        url: &str,
        matrix: &Matrix4<f64>,
    ) -> Result<(), Failure> {
        let mut url = url;
        let mut matrix = *matrix;
        // A skin may deform a morph, which deforms a geometry. Longer chains do not occur.
        for _ in 0..4 {
            if let Some(geometry) = self.document.find("geometry", url) {
                let text = "a skinned mesh was read in its bind shape";
                self.assembly.notes.add(NoteCode::SkinAsShape, text);
                return self.geometry(geometry, Some(instance), &matrix);
            }
            let Some(controller) = self.document.find("controller", url) else { break };
            let is_deformer = |node: &Node| matches!(node.tag_name().name(), "skin" | "morph");
            let Some(deformer) = controller.children().find(is_deformer) else { break };
            if let Some(shape) = child(deformer, "bind_shape_matrix") {
                matrix *= rows(shape)?;
                self.note_if_not_finite(&matrix);
            }
            // Both `skin` and `morph` reference what they deform by `source`.
            url = deformer.attribute("source").unwrap_or("");
        }
        self.missing("controller", url);
        Ok(())
    }

    fn geometry(
        &mut self,
        geometry: Node<'a, 'a>,
        instance: Option<Node<'a, 'a>>,
        matrix: &Matrix4<f64>,
    ) -> Result<(), Failure> {
        let name = geometry.attribute("id").unwrap_or("");
        if !self.geometries.contains_key(&geometry.id()) {
            let read =
                geometry::read(self.document, geometry, &mut self.tools, &mut self.assembly.notes);
            self.geometries
                .insert(geometry.id(), read.map_err(|failure| failure.within("geometry", name))?);
        }
        let bindings = bindings(instance);
        let primitives = &self.geometries[&geometry.id()];
        self.nesting.visited += primitives.len();
        for primitive in primitives {
            let mut material =
                material_of(self.document, &bindings, primitive.symbol, &mut self.looks);
            if let Some(texture) = &mut material.texture {
                texture.uv.clone_from(&primitive.uv);
            }
            self.assembly.add(&primitive.mesh, matrix, &material)?;
        }
        Ok(())
    }

    fn note_if_not_finite(&mut self, matrix: &Matrix4<f64>) {
        if !matrix.iter().all(|value| value.is_finite()) {
            let text = "a transform that is not finite: what it places was left out";
            self.assembly.notes.add(NoteCode::ReadOtherwise, text);
        }
    }

    fn missing(&mut self, kind: &str, url: &str) {
        let text = format!("the {kind} '{url}' is placed by a node, but does not exist");
        self.assembly.notes.add(NoteCode::LeftOut, text);
    }
}

/// The colour and the texture of each effect that was read.
type Looks = HashMap<NodeId, (Option<[f64; 4]>, Option<Texture>)>;

/// The bindings of a geometry instance: from symbol to material URL.
fn bindings<'a>(instance: Option<Node<'a, 'a>>) -> HashMap<&'a str, &'a str> {
    let mut bindings = HashMap::new();
    for node in instance.into_iter().flat_map(|instance| instance.descendants()) {
        if let ("instance_material", Some(symbol), Some(target)) =
            (node.tag_name().name(), node.attribute("symbol"), node.attribute("target"))
        {
            bindings.entry(symbol).or_insert(target);
        }
    }
    bindings
}

/// The material that the instance binds to the symbol, or else the material with that id.
fn material_of(
    document: &Document<'_>,
    bindings: &HashMap<&str, &str>,
    symbol: Option<&str>,
    looks: &mut Looks,
) -> Material {
    let Some(symbol) = symbol else { return Material::default() };
    let material = document.find("material", bindings.get(symbol).unwrap_or(&symbol));
    let name = material
        .and_then(|material| material.attribute("name").or_else(|| material.attribute("id")));
    let (color, texture) = material
        .and_then(|material| child(material, "instance_effect"))
        .and_then(|effect| document.find("effect", effect.attribute("url")?))
        .map(|effect| {
            let read = || (diffuse(effect), texture(document, effect));
            looks.entry(effect.id()).or_insert_with(read).clone()
        })
        .unwrap_or_default();
    Material { name: Some(name.unwrap_or(symbol).to_owned()), color, texture }
}

/// The diffuse colour of an effect, or the emission of a `constant` one, which has no diffuse colour; `None` for a
/// texture.
fn diffuse(effect: Node<'_, '_>) -> Option<[f64; 4]> {
    let (scopes, value) = value(effect)?;
    if let Some(color) = child(value, "color") {
        return rgba(color);
    }
    // A named parameter of the technique, profile or effect.
    parameter(scopes, child(value, "param")?.attribute("ref")?)
        .and_then(|parameter| {
            parameter
                .children()
                .find(|node| matches!(node.tag_name().name(), "float4" | "float3" | "color"))
        })
        .and_then(rgba)
}

/// That texture, whose image is named by a sampler and its surface (1.4), by a sampler (1.5), or directly.
fn texture(document: &Document<'_>, effect: Node<'_, '_>) -> Option<Texture> {
    let (scopes, value) = value(effect)?;
    let mut id = child(value, "texture")?.attribute("texture")?;
    let sampler = parameter(scopes, id).and_then(|found| child(found, "sampler2D"));
    if let Some(image) = sampler.and_then(|sampler| child(sampler, "instance_image")) {
        id = image.attribute("url")?;
    } else if let Some(source) = sampler.and_then(|sampler| child(sampler, "source")) {
        let surface = child(parameter(scopes, source.text()?.trim())?, "surface")?;
        id = child(surface, "init_from")?.text()?;
    }
    let name = file_of_image(document.find("image", id)?)?;
    Some(Texture { name, ..Texture::default() })
}

/// The diffuse value of an effect, or the emission of a `constant` one; and the scopes of its parameters.
fn value<'a>(effect: Node<'a, 'a>) -> Option<([Node<'a, 'a>; 3], Node<'a, 'a>)> {
    let profile = child(effect, "profile_COMMON")?;
    let technique = child(profile, "technique")?;
    let shader = technique.children().find(|node| {
        matches!(node.tag_name().name(), "phong" | "blinn" | "lambert" | "constant")
    })?;
    let wanted = if shader.tag_name().name() == "constant" { "emission" } else { "diffuse" };
    Some(([technique, profile, effect], child(shader, wanted)?))
}

fn parameter<'a>(scopes: [Node<'a, 'a>; 3], name: &str) -> Option<Node<'a, 'a>> {
    let mut parameters = scopes.into_iter().flat_map(|scope| children(scope, "newparam"));
    parameters.find(|parameter| parameter.attribute("sid") == Some(name))
}

/// Three or four numbers, clamped to 0 to 1.
fn rgba(node: Node<'_, '_>) -> Option<[f64; 4]> {
    let text = text(node);
    let mut words = Words::new(text.as_bytes());
    let mut value = || words.float().filter(|value| value.is_finite());
    let color = [value()?, value()?, value()?, value().unwrap_or(1.0)];
    Some(color.map(|value| value.clamp(0.0, 1.0)))
}

//! The visual scene: nodes, and the geometries that they place.

use std::collections::HashMap;

use nalgebra::{Matrix4, Vector3};
use urdd_xml::Node;

use super::super::assembly::{Assembly, FIRST_SCENE, Nesting, within};
use super::super::error::{Failure, NoteCode};
use super::document::{Document, child, children};
use super::geometry::{self, Primitive, Tools};
use super::material::{self, Looks};
use super::transform;

/// Maximum number of node bytes processed, counted for each placement.
const MAX_TEXT: usize = 1 << 28;

/// Adds every geometry of the scene with its placement.
///
/// Without a `scene` element, takes the first visual scene; without a visual scene, adds every geometry unplaced.
pub(super) fn walk(
    document: &Document<'_>,
    unit: f64,
    assembly: &mut Assembly,
) -> Result<(), Failure> {
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
    geometries: HashMap<urdd_xml::NodeId, Vec<Primitive<'a>>>,
    looks: Looks,
    nesting: Nesting<urdd_xml::NodeId>,
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
        let matrix =
            parent * transform::of_node(node).map_err(|failure| failure.within("node", name))?;
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
            let Some(controller) = self.document.find("controller", url) else {
                break;
            };
            let is_deformer = |node: &Node| matches!(node.tag_name().name(), "skin" | "morph");
            let Some(deformer) = controller.children().find(is_deformer) else {
                break;
            };
            if let Some(shape) = child(deformer, "bind_shape_matrix") {
                matrix *= transform::rows(transform::numbers::<16>(shape)?);
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
        let bindings = material::bindings(instance);
        let primitives = &self.geometries[&geometry.id()];
        self.nesting.visited += primitives.len();
        for primitive in primitives {
            let mut material =
                material::of_symbol(self.document, &bindings, primitive.symbol, &mut self.looks);
            if let Some(texture) = &mut material.texture {
                texture.uv.clone_from(&primitive.uv);
            }
            self.assembly.add(&primitive.mesh, matrix, &material)?;
        }
        Ok(())
    }

    fn missing(&mut self, kind: &str, url: &str) {
        let text = format!("the {kind} '{url}' is placed by a node, but does not exist");
        self.assembly.notes.add(NoteCode::LeftOut, text);
    }
}

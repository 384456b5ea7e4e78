//! Vertex positions of COLLADA meshes.

use std::collections::HashMap;

use roxmltree::{Node, NodeId};

use super::super::error::{Failure, Fault};
use super::super::number::{Words, float};
use super::document::{Document, child, children, text};

/// The positions of each source that was read, shared between meshes.
pub(super) type Read = HashMap<NodeId, Vec<[f64; 3]>>;

/// Vertex positions of one mesh.
pub(super) struct Positions<'a, 'd> {
    document: &'d Document<'a>,
    own: HashMap<(&'a str, &'a str), Node<'a, 'a>>,
    sources: HashMap<&'a str, NodeId>,
    read: &'d mut Read,
}

impl<'a, 'd> Positions<'a, 'd> {
    pub(super) fn new(document: &'d Document<'a>, mesh: Node<'a, 'a>, read: &'d mut Read) -> Self {
        let mut own = HashMap::new();
        for node in mesh.children().filter(Node::is_element) {
            if let Some(id) = node.attribute("id") {
                own.entry((node.tag_name().name(), id)).or_insert(node);
            }
        }
        Self { document, own, sources: HashMap::new(), read }
    }

    /// The positions that an input references through a `vertices` element or a `source`.
    pub(super) fn of(&mut self, url: &'a str) -> Result<&[[f64; 3]], Failure> {
        let id = match self.sources.get(url) {
            Some(id) => *id,
            None => self.find_source(url)?,
        };
        Ok(&self.read[&id])
    }

    /// Finds a source, and reads it unless it was read before.
    fn find_source(&mut self, url: &'a str) -> Result<NodeId, Failure> {
        let source = match self.find("vertices", url) {
            Some(vertices) => children(vertices, "input")
                .find(|input| input.attribute("semantic") == Some("POSITION"))
                .and_then(|input| self.find("source", input.attribute("source")?)),
            None => self.find("source", url),
        };
        let source = source
            .ok_or_else(|| Fault::malformed(format!("the positions '{url}' do not exist")))?;
        if !self.read.contains_key(&source.id()) {
            let positions = self.read_source(source)?;
            self.read.insert(source.id(), positions);
        }
        self.sources.insert(url, source.id());
        Ok(source.id())
    }

    /// Searches this mesh first: some exporters reuse the same ids in each mesh.
    fn find(&self, tag: &str, url: &str) -> Option<Node<'a, 'a>> {
        let id = url.trim().strip_prefix('#').unwrap_or(url.trim());
        self.own.get(&(tag, id) as &(&str, &str)).copied().or_else(|| self.document.find(tag, url))
    }

    fn read_source(&self, source: Node<'a, 'a>) -> Result<Vec<[f64; 3]>, Failure> {
        let name = source.attribute("id").unwrap_or("");
        let accessor =
            child(source, "technique_common").and_then(|technique| child(technique, "accessor"));
        let array = accessor
            .and_then(|accessor| accessor.attribute("source"))
            .and_then(|url| {
                children(source, "float_array")
                    .find(|array| array.attribute("id") == url.trim().strip_prefix('#'))
            })
            .or_else(|| child(source, "float_array"))
            .or_else(|| self.document.find("float_array", accessor?.attribute("source")?));
        let array =
            array.ok_or_else(|| Fault::malformed("no float_array").within("source", name))?;
        let number = |key: &str| {
            accessor
                .and_then(|accessor| accessor.attribute(key))
                .and_then(|value| value.trim().parse::<usize>().ok())
        };
        let stride = number("stride").unwrap_or(3).max(1);
        let offset = number("offset").unwrap_or(0);
        let axes = axes(accessor).filter(|axes| axes.iter().all(|axis| *axis < stride));
        let axes = axes.ok_or_else(|| {
            Fault::malformed(format!("positions have {stride} numbers instead of 3"))
                .within("source", name)
        })?;
        let text = text(array);
        let mut words = Words::new(text.as_bytes());
        if words.by_ref().take(offset).count() < offset {
            return Ok(Vec::new());
        }
        // The file's counts are only capacity hints: the end of the text ends the list.
        let mut positions = Vec::with_capacity(
            array
                .attribute("count")
                .and_then(|count| count.parse::<usize>().ok())
                .unwrap_or(0)
                .min(text.len() / 2)
                / stride
                + 1,
        );
        if stride == 3 && axes == [0, 1, 2] {
            while let (Some(x), Some(y), Some(z)) = (words.float(), words.float(), words.float()) {
                positions.push([x, y, z]);
            }
            return Ok(positions);
        }
        loop {
            let mut position = [0.0; 3];
            for at in 0..stride {
                let Some(word) = words.next() else {
                    return Ok(positions);
                };
                if let Some(axis) = axes.iter().position(|axis| *axis == at) {
                    position[axis] = float(word);
                }
            }
            positions.push(position);
        }
    }
}

/// The indices of an accessor's x, y and z parameters; `None` if it has fewer than three.
fn axes(accessor: Option<Node<'_, '_>>) -> Option<[usize; 3]> {
    let Some(accessor) = accessor else {
        return Some([0, 1, 2]);
    };
    let params = children(accessor, "param");
    let names: Vec<Option<&str>> = params.map(|param| param.attribute("name")).collect();
    let of = |name: &str| names.iter().position(|found| *found == Some(name));
    match (of("X"), of("Y"), of("Z")) {
        (Some(x), Some(y), Some(z)) => Some([x, y, z]),
        // By the specification, parameters without names are skipped. Files without any names mean the first three.
        _ if names.is_empty() || names.len() >= 3 => Some([0, 1, 2]),
        _ => None,
    }
}

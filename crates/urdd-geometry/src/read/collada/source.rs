//! Vertex positions of COLLADA meshes.

use std::collections::HashMap;

use urdd_xml::{Node, NodeId};

use super::super::error::{Failure, Fault};
use super::super::number::{Words, float};
use super::document::{Document, Elements, child, children, text};

/// The positions, or the texture coordinates (true), of each source that was read, shared between meshes.
pub(super) type Read = HashMap<(NodeId, bool), Vec<[f64; 3]>>;

/// Vertex positions of one mesh.
pub(super) struct Positions<'a, 'd> {
    document: &'d Document<'a>,
    own: Elements<'a>,
    sources: HashMap<&'a str, NodeId>,
    read: &'d mut Read,
}

impl<'a, 'd> Positions<'a, 'd> {
    pub(super) fn new(document: &'d Document<'a>, mesh: Node<'a, 'a>, read: &'d mut Read) -> Self {
        Self { document, own: Elements::new(mesh.children()), sources: HashMap::new(), read }
    }

    /// The positions that an input references through a `vertices` element or a `source`, and the texture coordinates of
    /// which another references the source. These are none if they cannot be read.
    pub(super) fn of(
        &mut self,
        url: &'a str,
        uv: Option<&str>,
    ) -> Result<[&[[f64; 3]]; 2], Failure> {
        let id = match self.sources.get(url) {
            Some(id) => *id,
            None => self.find_source(url)?,
        };
        let uv = uv.and_then(|url| self.find("source", url));
        if let Some(source) = uv.filter(|source| !self.read.contains_key(&(source.id(), true))) {
            let uvs = self.read_source(source, ["S", "T", "T"]).unwrap_or_default();
            self.read.insert((source.id(), true), uvs);
        }
        let uvs = uv.and_then(|source| self.read.get(&(source.id(), true)));
        Ok([&self.read[&(id, false)], uvs.map_or(&[], Vec::as_slice)])
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
        if !self.read.contains_key(&(source.id(), false)) {
            let positions = self.read_source(source, ["X", "Y", "Z"])?;
            self.read.insert((source.id(), false), positions);
        }
        self.sources.insert(url, source.id());
        Ok(source.id())
    }

    /// Searches this mesh first: some exporters reuse the same ids in each mesh.
    fn find(&self, tag: &str, url: &str) -> Option<Node<'a, 'a>> {
        self.own.find(tag, url).or_else(|| self.document.find(tag, url))
    }

    fn read_source(
        &self,
        source: Node<'a, 'a>,
        names: [&str; 3],
    ) -> Result<Vec<[f64; 3]>, Failure> {
        let name = source.attribute("id").unwrap_or("");
        let accessor =
            child(source, "technique_common").and_then(|technique| child(technique, "accessor"));
        let url = accessor.and_then(|accessor| accessor.attribute("source"));
        let is_named = |array: &Node| {
            url.is_some_and(|url| array.attribute("id") == url.trim().strip_prefix('#'))
        };
        let array = children(source, "float_array")
            .find(is_named)
            .or_else(|| child(source, "float_array"))
            .or_else(|| self.document.find("float_array", url?));
        let array =
            array.ok_or_else(|| Fault::malformed("no float_array").within("source", name))?;
        let number = |key: &str| accessor?.attribute(key)?.trim().parse::<usize>().ok();
        let axes = axes(accessor, names);
        let stride = number("stride").unwrap_or(axes.map_or(3, |axes| axes[2] + 1)).max(1);
        let offset = number("offset").unwrap_or(0);
        let axes = axes.filter(|axes| axes.iter().all(|axis| *axis < stride));
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
        let count = array.attribute("count").and_then(|count| count.parse::<usize>().ok());
        let most = text.len() / 2;
        let mut positions = Vec::with_capacity(count.unwrap_or(0).min(most) / stride + 1);
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

/// The indices of an accessor's parameters of these names, of which the last two may be one; `None` if there are too
/// few parameters.
fn axes(accessor: Option<Node<'_, '_>>, wanted: [&str; 3]) -> Option<[usize; 3]> {
    let first = [0, 1, if wanted[1] == wanted[2] { 1 } else { 2 }];
    let Some(accessor) = accessor else {
        return Some(first);
    };
    let params = children(accessor, "param");
    let names: Vec<Option<&str>> = params.map(|param| param.attribute("name")).collect();
    let of = |name: &str| names.iter().position(|found| *found == Some(name));
    match wanted.map(of) {
        [Some(x), Some(y), Some(z)] => Some([x, y, z]),
        // By the specification, parameters without names are skipped. Files without any names mean the first ones.
        _ if names.is_empty() || names.len() > first[2] => Some(first),
        _ => None,
    }
}

//! COLLADA geometries: vertex positions, faces and their triangles.

use std::collections::HashMap;

use urdd_xml::{Node, NodeId};

use super::document::{Document, child, children, text};
use crate::mesh::Mesh;
use crate::polygon::{Splitter, fan, strip};
use crate::read::assembly::{Picker, UvCorners};
use crate::read::bytes::{Words, float};
use crate::read::scene::{Failure, Fault, NoteCode, Notes, Options};

/// The positions, or the texture coordinates (true), of each source that was read, shared between meshes.
type Read = HashMap<(NodeId, bool), Vec<[f64; 3]>>;

struct Positions<'a, 'd> {
    document: &'d Document<'a>,
    own: Document<'a>,
    sources: HashMap<&'a str, NodeId>,
    read: &'d mut Read,
    /// Whether some have more than three numbers each.
    wide: bool,
}

impl<'a, 'd> Positions<'a, 'd> {
    fn new(document: &'d Document<'a>, mesh: Node<'a, 'a>, read: &'d mut Read) -> Self {
        let own = Document::new(mesh, mesh.children());
        Self { document, own, sources: HashMap::new(), read, wide: false }
    }

    /// The positions that an input references through a `vertices` element or a `source`, and the texture coordinates of
    /// which another references the source. These are none if they cannot be read.
    fn of(&mut self, url: &'a str, uv: Option<&str>) -> Result<[&[[f64; 3]]; 2], Failure> {
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
        &mut self,
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
        self.wide |= stride > 3 && names == ["X", "Y", "Z"];
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
                let Some(word) = words.next() else { return Ok(positions) };
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
    let Some(accessor) = accessor else { return Some(first) };
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

/// The triangles of one material symbol, in the axes and lengths of the document.
pub(super) struct Primitive<'a> {
    pub(super) symbol: Option<&'a str>,
    pub(super) mesh: Mesh,
    /// Texture coordinates of the vertices; none unless they are read.
    pub(super) uv: Vec<[f64; 2]>,
}

/// State that geometries share while they are read.
pub(super) struct Tools {
    picker: Picker,
    splitter: Splitter,
    read: Read,
    textures: bool,
}

impl Tools {
    pub(super) fn new(options: &Options) -> Self {
        Self {
            picker: Picker::default(),
            splitter: Splitter::new(options.uncut),
            read: Read::default(),
            textures: options.textures,
        }
    }
}

pub(super) fn read<'a>(
    document: &Document<'a>,
    geometry: Node<'a, 'a>,
    tools: &mut Tools,
    notes: &mut Notes,
) -> Result<Vec<Primitive<'a>>, Failure> {
    let Some(mesh) = child(geometry, "mesh") else {
        let id = geometry.attribute("id").unwrap_or("");
        let text = format!("the geometry '{id}' is not a mesh and was left out");
        notes.add(NoteCode::LeftOut, text);
        return Ok(Vec::new());
    };
    let Tools { picker, splitter, read, textures } = tools;
    let mut positions = Positions::new(document, mesh, read);
    let mut primitives = Vec::new();
    for element in mesh.children().filter(Node::is_element) {
        let tag = element.tag_name().name();
        if !["triangles", "polylist", "polygons", "trifans", "tristrips"].contains(&tag) {
            continue;
        }
        let Some(mut layout) = Layout::of(element)? else { continue };
        layout.uv.take_if(|_| !*textures);
        let [vertices, uvs] = positions.of(layout.source, layout.uv.map(|(source, _)| source))?;
        let mut faces = Faces {
            layout,
            triangles: Vec::new(),
            corners: Vec::new(),
            uvs: UvCorners::default(),
            bad: 0,
        };
        faces.read(element, vertices, splitter, notes);
        let (mut mesh, left_out) = picker.pick(vertices, &faces.triangles);
        let mut uv = Vec::new();
        if !faces.uvs.is_empty() {
            (mesh, uv) = faces.uvs.mesh(vertices, &faces.triangles, uvs);
        }
        let text = "a triangle was dropped: a vertex index is out of range, or is not an index";
        notes.add_many(NoteCode::IndexOutOfRange, text, left_out + faces.bad);
        primitives.push(Primitive { symbol: element.attribute("material"), mesh, uv });
    }
    if positions.wide {
        let text = "positions have more than three numbers each: x, y and z were taken";
        notes.add(NoteCode::ReadOtherwise, text);
    }
    Ok(primitives)
}

/// Index layout of a primitive: `stride` indices per corner, the vertex at `offset`.
#[derive(Clone, Copy)]
struct Layout<'a> {
    source: &'a str,
    offset: usize,
    stride: usize,
    /// The first texture coordinates: their source, and their offset.
    uv: Option<(&'a str, usize)>,
}

/// Maximum number of indices per corner; real files have up to 6.
const MAX_INPUTS: usize = 1024;

impl<'a> Layout<'a> {
    /// `None` for a primitive without faces, which needs no inputs.
    fn of(element: Node<'a, 'a>) -> Result<Option<Self>, Failure> {
        let (mut vertex, mut uv) = (None, None);
        let mut stride = 0;
        for input in children(element, "input") {
            let text = input.attribute("offset").or_else(|| input.attribute("idx")).unwrap_or("0");
            let offset = text.trim().parse::<usize>().ok().filter(|offset| *offset < MAX_INPUTS);
            let fault = "an `input` whose offset is not a small whole number";
            let offset = offset.ok_or_else(|| Fault::malformed(fault))?;
            stride = stride.max(offset + 1);
            if matches!(input.attribute("semantic"), Some("VERTEX" | "POSITION"))
                && vertex.is_none()
            {
                vertex = Some((input.attribute("source").unwrap_or(""), offset));
            }
            if input.attribute("semantic") == Some("TEXCOORD") && uv.is_none() {
                uv = input.attribute("source").map(|source| (source, offset));
            }
        }
        match vertex {
            Some((source, offset)) => Ok(Some(Self { source, offset, stride, uv })),
            None if child(element, "p").is_none() => Ok(None),
            None => {
                let tag = element.tag_name().name();
                Err(Fault::malformed(format!("a `{tag}` without a VERTEX input")))
            }
        }
    }
}

struct Faces<'a> {
    layout: Layout<'a>,
    triangles: Vec<[u32; 3]>,
    corners: Vec<u32>,
    uvs: UvCorners,
    bad: usize,
}

/// An index out of range for every mesh. It marks a malformed index until its triangle is dropped.
const NO_INDEX: u32 = u32::MAX;

impl Faces<'_> {
    fn read(
        &mut self,
        element: Node<'_, '_>,
        vertices: &[[f64; 3]],
        splitter: &mut Splitter,
        notes: &mut Notes,
    ) {
        let counts = child(element, "vcount").map(text);
        let mut counts = counts.as_ref().map(|counts| Words::new(counts.as_bytes()));
        for list in element.children() {
            let list = match list.tag_name().name() {
                "p" => list,
                "ph" => {
                    notes.add(NoteCode::LeftOut, "holes of a polygon were filled");
                    let Some(outline) = child(list, "p") else { continue };
                    outline
                }
                _ => continue,
            };
            let text = text(list);
            let mut words = Words::new(text.as_bytes());
            match (element.tag_name().name(), counts.as_mut()) {
                // In real files, a polylist without counts contains triangles.
                ("triangles", _) | ("polylist", None) => self.read_triangles(&mut words, splitter),
                ("polylist", Some(counts)) => {
                    while let Some(count) = counts.index() {
                        self.read_corners(&mut words, count.map_or(0, |count| count as usize));
                        if self.corners.is_empty() && words.clone().next().is_none() {
                            break;
                        }
                        splitter.split(vertices, &self.corners, &mut self.triangles);
                        self.uvs.follow(&self.triangles);
                    }
                }
                (tag, _) => {
                    self.read_corners(&mut words, usize::MAX);
                    let (corners, out) = (&self.corners, &mut self.triangles);
                    match tag {
                        "polygons" => splitter.split(vertices, corners, out),
                        "trifans" => fan(corners).for_each(|fan| splitter.push(fan, out)),
                        _ => strip(corners).for_each(|strip| splitter.push(strip, out)),
                    }
                }
            }
            self.uvs.follow(&self.triangles);
        }
    }

    fn read_triangles(&mut self, words: &mut Words<'_>, splitter: &Splitter) {
        loop {
            let mut triangle = [0; 3];
            for corner in &mut triangle {
                match self.corner(words) {
                    Some(index) => *corner = index,
                    None => return,
                }
            }
            splitter.push(triangle, &mut self.triangles);
            self.uvs.follow(&self.triangles);
        }
    }

    /// Reads up to `count` corners, fewer at the end of the text.
    fn read_corners(&mut self, words: &mut Words<'_>, count: usize) {
        self.corners.clear();
        while self.corners.len() < count {
            match self.corner(words) {
                Some(index) => self.corners.push(index),
                None => return,
            }
        }
    }

    /// The vertex of the next corner; `None` at the end.
    #[inline]
    fn corner(&mut self, words: &mut Words<'_>) -> Option<u32> {
        let Layout { offset, stride, uv, .. } = self.layout;
        let [mut vertex, mut of_uv] = [NO_INDEX; 2];
        for at in 0..stride {
            match (at == offset, uv) {
                (true, _) => vertex = words.index()?.unwrap_or(NO_INDEX),
                (_, Some((_, uv))) if at == uv => of_uv = words.index()?.unwrap_or(NO_INDEX),
                _ => _ = words.next()?,
            }
        }
        if let Some((_, uv)) = uv {
            self.uvs.note(vertex, if uv == offset { vertex } else { of_uv });
        }
        Some(vertex)
    }
}

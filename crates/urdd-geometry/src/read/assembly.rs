//! Collects the output of a reader into a [`Scene`].

use std::collections::HashMap;
use std::fmt;

use nalgebra::Matrix4;

use super::scene::{Failure, Fault, Format, NoteCode, Notes, Options, Part, Scene, Texture};
use crate::mesh::Mesh;

/// A scene under construction: one part per material, in the order of first use.
#[derive(Default)]
pub(super) struct Assembly {
    parts: Vec<Part>,
    part_of: HashMap<Look, usize>,
    triangles: usize,
    pub(super) options: Options,
    side_files: Vec<String>,
    pub(super) notes: Notes,
}

/// Maximum number of parts. Further materials share the part without a material. Real files have up to some hundred
/// materials. A part takes some hundred bytes of memory, for the ten bytes in the file that name it.
pub(super) const MAX_PARTS: usize = 4096;

#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Material {
    pub(super) name: Option<String>,
    pub(super) color: Option<[f64; 4]>,
    pub(super) texture: Option<Texture>,
}

type Look = (Option<String>, Option<[u64; 4]>, Option<(String, bool)>);

impl Assembly {
    pub(super) fn new(options: &Options) -> Self {
        Self { options: *options, ..Self::default() }
    }

    /// Adds a mesh, placed by `matrix`, to the part with the same material.
    pub(super) fn add(
        &mut self,
        mesh: &Mesh,
        matrix: &Matrix4<f64>,
        material: &Material,
    ) -> Result<(), Failure> {
        if mesh.triangles.is_empty() {
            return Ok(());
        }
        self.triangles += mesh.triangles.len();
        self.check_triangles(self.triangles)?;
        let mut placed = mesh.clone();
        if *matrix != Matrix4::identity() {
            placed.transform(matrix);
        }
        let dropped = placed.drop_non_finite();
        let text = "a triangle with a corner that is not finite was dropped";
        self.notes.add_many(NoteCode::NotFinite, text, dropped);
        if placed.triangles.is_empty() {
            return Ok(());
        }
        let mut material = material.clone();
        material.texture.take_if(|_| !self.options.textures);
        let texture = material.texture.as_mut();
        let uv = texture.map(|texture| std::mem::take(&mut texture.uv)).unwrap_or_default();
        let mut look = look_of(&material);
        if self.parts.len() >= MAX_PARTS && !self.part_of.contains_key(&look) {
            self.notes.add(NoteCode::Assumed, TOO_MANY_PARTS);
            material = Material::default();
            look = look_of(&material);
        }
        let count = placed.vertices.len();
        let at = *self.part_of.entry(look).or_insert(self.parts.len());
        match self.parts.get_mut(at) {
            Some(part) => part.mesh.append(&placed),
            None => self.parts.push(Part {
                mesh: placed,
                color: material.color,
                material: material.name,
                texture: material.texture,
            }),
        }
        let part = &mut self.parts[at];
        // A mesh whose vertices were dropped, since some are not finite, gets no coordinates.
        let uv = Some(uv).filter(|uv| uv.len() == count).unwrap_or_default();
        if let Some(texture) = &mut part.texture
            && !(uv.is_empty() && texture.uv.is_empty())
        {
            texture.uv.resize(part.mesh.vertices.len() - count, [0.0; 2]);
            texture.uv.extend(uv);
            texture.uv.resize(part.mesh.vertices.len(), [0.0; 2]);
        }
        Ok(())
    }

    /// Adds a note if no triangle uses some vertices of an array.
    pub(super) fn note_unused(&mut self, vertices: &[[f64; 3]], used: &[bool]) {
        let mut unused = vertices.iter().zip(used).filter(|(_, used)| !**used);
        let Some(([x, y, z], _)) = unused.next() else { return };
        let text = match unused.count() {
            0 => format!("no triangle uses the vertex ({x}, {y}, {z})"),
            more => format!("no triangle uses {} vertices, the first at ({x}, {y}, {z})", more + 1),
        };
        self.notes.add(NoteCode::UnusedVertices, text);
    }

    pub(super) fn check_triangles(&self, count: usize) -> Result<(), Failure> {
        within("triangles", count, self.options.max_triangles)
    }

    /// Checks a number of vertices against the limit: three for each triangle.
    pub(super) fn check_vertices(&self, count: usize) -> Result<(), Failure> {
        let limit = self.options.max_triangles.saturating_mul(3);
        within("vertices", count, limit)
    }

    pub(super) fn add_side_file(&mut self, name: &str) {
        if !name.is_empty() {
            self.side_files.push(name.to_owned());
        }
    }

    pub(super) fn into_scene(mut self, format: Format) -> Scene {
        if self.parts.is_empty() {
            self.notes.add(NoteCode::NoTriangles, "the file has no triangles");
        }
        self.side_files.sort();
        self.side_files.dedup();
        Scene { format, parts: self.parts, side_files: self.side_files, notes: self.notes.0 }
    }
}

/// Note for a file with scenes of which none is the default.
pub(super) const FIRST_SCENE: &str =
    "the file does not say which scene to show; the first one was used";

pub(super) const TOO_MANY_PARTS: &str =
    "more than 4096 materials; faces with any other material are read without one";

fn look_of(material: &Material) -> Look {
    let texture = material.texture.as_ref();
    let texture = texture.map(|texture| (texture.name.clone(), texture.embedded.is_some()));
    (material.name.clone(), material.color.map(|color| color.map(f64::to_bits)), texture)
}

pub(super) fn within(what: &'static str, count: usize, limit: usize) -> Result<(), Failure> {
    if count > limit { Err(Fault::TooLarge { what, limit }.into()) } else { Ok(()) }
}

/// The nodes from the root of a scene to the current one. Instances can multiply the nodes of a file.
pub(super) struct Nesting<Id> {
    path: Vec<Id>,
    /// Visits of nodes, and meshes that they place.
    pub(super) visited: usize,
}

impl<Id: PartialEq> Nesting<Id> {
    const DEEPEST: usize = 200;
    const MAX_NODES: usize = 100_000;

    pub(super) fn new() -> Self {
        Self { path: Vec::new(), visited: 0 }
    }

    /// Enters a node, unless it contains itself or a limit is exceeded.
    pub(super) fn enter(&mut self, node: Id, name: impl fmt::Display) -> Result<(), Failure> {
        self.visited += 1;
        within("nodes", self.visited, Self::MAX_NODES)?;
        if self.path.contains(&node) {
            return Err(Fault::malformed("the node contains itself").within("node", name));
        }
        self.path.push(node);
        within("levels of nested nodes", self.path.len(), Self::DEEPEST)
    }

    pub(super) fn leave(&mut self) {
        self.path.pop();
    }
}

/// Marks the vertices that triangles use; ignores indices out of range.
pub(super) fn mark(used: &mut [bool], triangles: &[[u32; 3]]) {
    for corner in triangles.as_flattened() {
        if let Some(used) = used.get_mut(*corner as usize) {
            *used = true;
        }
    }
}

/// Extracts the vertices that some triangles use from a shared array.
#[derive(Default)]
pub(super) struct Picker {
    index_of: Vec<u32>,
}

const UNSEEN: u32 = u32::MAX;

impl Picker {
    /// A mesh of these triangles and the vertices they use, in the order of first use. Skips triangles that reference a
    /// missing vertex, and also returns their number.
    pub(super) fn pick(&mut self, vertices: &[[f64; 3]], triangles: &[[u32; 3]]) -> (Mesh, usize) {
        if self.index_of.len() < vertices.len() {
            self.index_of.resize(vertices.len(), UNSEEN);
        }
        let mut mesh =
            Mesh { vertices: Vec::new(), triangles: Vec::with_capacity(triangles.len()) };
        let mut used: Vec<u32> = Vec::new();
        for triangle in triangles {
            if triangle.iter().any(|index| *index as usize >= vertices.len()) {
                continue;
            }
            mesh.triangles.push(triangle.map(|old| {
                let new = &mut self.index_of[old as usize];
                if *new == UNSEEN {
                    // There are at most as many as `vertices`, whose indices fit.
                    *new = u32::try_from(used.len()).unwrap_or(UNSEEN);
                    used.push(old);
                }
                *new
            }));
        }
        mesh.vertices.extend(used.iter().map(|old| vertices[*old as usize]));
        for old in used {
            self.index_of[old as usize] = UNSEEN;
        }
        let left_out = triangles.len() - mesh.triangles.len();
        (mesh, left_out)
    }
}

/// Texture coordinates of the corners of polygons, while these become triangles. Without textures, it does nothing.
#[derive(Default)]
pub(super) struct UvCorners {
    of_vertex: HashMap<u32, u32>,
    triangles: Vec<[u32; 3]>,
}

impl UvCorners {
    /// Those of triangles whose corners have the same index for both.
    pub(super) fn of(triangles: Vec<[u32; 3]>) -> Self {
        Self { of_vertex: HashMap::new(), triangles }
    }

    pub(super) fn is_empty(&self) -> bool {
        self.of_vertex.is_empty()
    }

    /// Notes the texture coordinate of a corner of the current polygon.
    pub(super) fn note(&mut self, vertex: u32, uv: u32) {
        self.of_vertex.insert(vertex, uv);
    }

    /// Gives texture coordinates to the triangles that the current polygon became, the last ones.
    pub(super) fn follow(&mut self, triangles: &[[u32; 3]]) {
        if self.is_empty() {
            return;
        }
        let uv_of = |vertex: u32| self.of_vertex.get(&vertex).copied().unwrap_or(u32::MAX);
        let new = triangles.iter().skip(self.triangles.len());
        self.triangles.extend(new.map(|triangle| triangle.map(uv_of)));
    }

    /// A mesh of these triangles with a vertex for each pair of position and texture coordinate, and these coordinates,
    /// of which two numbers count; none without values. Leaves out a triangle with a missing vertex.
    pub(super) fn mesh(
        &self,
        vertices: &[[f64; 3]],
        triangles: &[[u32; 3]],
        values: &[[f64; 3]],
    ) -> (Mesh, Vec<[f64; 2]>) {
        let (mut mesh, mut uvs, mut places) = (Mesh::default(), Vec::new(), HashMap::new());
        for (triangle, corners) in triangles.iter().zip(&self.triangles) {
            if triangle.iter().any(|index| *index as usize >= vertices.len()) {
                continue;
            }
            mesh.triangles.push([0, 1, 2].map(|at| {
                *places.entry((triangle[at], corners[at])).or_insert_with(|| {
                    let uv = values
                        .get(corners[at] as usize)
                        .filter(|uv| uv[..2].iter().all(|value| (*value as f32).is_finite()));
                    uvs.push(uv.map_or([0.0; 2], |uv| [uv[0], uv[1]]));
                    mesh.vertices.push(vertices[triangle[at] as usize]);
                    mesh.vertices.len() as u32 - 1
                })
            }));
        }
        uvs.truncate(if values.is_empty() { 0 } else { uvs.len() });
        (mesh, uvs)
    }
}

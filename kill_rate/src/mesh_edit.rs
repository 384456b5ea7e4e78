//! Edits of a mesh that are applicable to files of every format.

use super::dice::Dice;
use super::glb_node::{self, NodeChange};
use urdd_geometry::Mesh;
use urdd_geometry::read::Part;
use urdd_geometry::write;

/// An edit. Random numbers select a triangle, a corner or an axis of the mesh.
#[derive(Debug, Clone, Copy)]
pub(crate) enum MeshEdit {
    /// Moves a vertex along an axis, by this proportion of the mesh's size.
    MoveVertex(f64, usize),
    /// Removes a triangle.
    LeaveOut(usize),
    /// Reverses the winding of a triangle.
    Turn(usize),
    /// Moves all vertices along an axis, by this proportion of the mesh's size.
    MoveAll(f64, usize),
    /// Scales all vertices about the origin.
    Scale(f64),
    /// Changes a colour. Only .glb has colours.
    Colour,
    /// Adds a vertex that no face uses, at this multiple of the mesh's size. Not for .stl, which only has triangles.
    StrayVertex(f64),
    /// Transforms its node. Only .glb has nodes.
    Node(NodeChange),
}

/// The location of an edit.
#[derive(Debug, Clone)]
pub(crate) struct Spot {
    triangle: [[f32; 3]; 3],
    shift: [f64; 3],
    extent: f64,
    pub from: String,
    pub to: String,
}

impl MeshEdit {
    /// Every kind of edit.
    pub(crate) fn each(dice: &mut Dice) -> Vec<(&'static str, MeshEdit)> {
        let mut drawn = || dice.below(1 << 30);
        vec![
            ("a vertex moved by 2e-5 of its size", MeshEdit::MoveVertex(2e-5, drawn())),
            ("a vertex moved by 1e-3 of its size", MeshEdit::MoveVertex(1e-3, drawn())),
            ("a vertex moved by 0.1 of its size", MeshEdit::MoveVertex(0.1, drawn())),
            ("a triangle left out", MeshEdit::LeaveOut(drawn())),
            ("a triangle turned round", MeshEdit::Turn(drawn())),
            ("moved by 1e-3 of its size", MeshEdit::MoveAll(1e-3, drawn())),
            ("moved by 0.1 of its size", MeshEdit::MoveAll(0.1, drawn())),
            ("larger by 1e-3", MeshEdit::Scale(1.001)),
            ("in other units", MeshEdit::Scale(1000.0)),
            ("another colour", MeshEdit::Colour),
            ("a vertex without faces", MeshEdit::StrayVertex(10.0)),
            ("a vertex without faces, within", MeshEdit::StrayVertex(0.01)),
            ("its node moved by 1e-3 m", MeshEdit::Node(NodeChange::Moved(1e-3))),
            ("its node turned", MeshEdit::Node(NodeChange::Turned)),
            ("its node larger by 1e-3", MeshEdit::Node(NodeChange::Larger(1.001))),
        ]
    }

    /// Whether files of a format support the edit.
    pub(crate) fn is_possible(&self, format: &str) -> bool {
        match self {
            MeshEdit::Colour | MeshEdit::Node(_) => format == "glb",
            MeshEdit::StrayVertex(_) => format != "stl",
            _ => true,
        }
    }

    /// Whether it changes something other than the triangles and their colours.
    pub(crate) fn is_beside_triangles(&self) -> bool {
        matches!(self, MeshEdit::StrayVertex(_))
    }

    /// Selects the location of the edit; `None` for a mesh without triangles.
    pub(crate) fn spot(&self, mesh: &Mesh) -> Option<Spot> {
        // The largest absolute coordinate, to which the resolution is relative. At least half the extent.
        let bounds = mesh.bounds()?;
        let coordinates = bounds.min.iter().chain(&bounds.max);
        let extent = coordinates.fold(0.0_f64, |largest, x| largest.max(x.abs()));
        let (drawn, step) = match *self {
            MeshEdit::MoveVertex(step, drawn) | MeshEdit::MoveAll(step, drawn) => (drawn, step),
            MeshEdit::LeaveOut(drawn) | MeshEdit::Turn(drawn) => (drawn, 0.0),
            _ => (0, 0.0),
        };
        let triangle = mesh.corners(mesh.triangles[drawn % mesh.triangles.len()]);
        let mut shift = [0.0; 3];
        let sign = if drawn / 8 % 2 == 0 { 1.0 } else { -1.0 };
        shift[drawn / 16 % 3] = sign * step * extent;
        let (from, to) = match self {
            MeshEdit::MoveVertex(..) => {
                let moved: Vec<f64> = (0..3).map(|axis| triangle[0][axis] + shift[axis]).collect();
                (format!("{:?}", triangle[0]), format!("{moved:?}"))
            }
            MeshEdit::LeaveOut(_) => (format!("{triangle:?}"), "nothing".to_owned()),
            MeshEdit::Turn(_) => (format!("{triangle:?}"), "the other way round".to_owned()),
            MeshEdit::MoveAll(..) => ("the mesh".to_owned(), format!("moved by {shift:?}")),
            MeshEdit::Scale(factor) => ("the mesh".to_owned(), format!("times {factor}")),
            MeshEdit::Colour => ("a colour".to_owned(), "another".to_owned()),
            MeshEdit::StrayVertex(times) => {
                ("the vertices of its faces".to_owned(), format!("one more, at {}", times * extent))
            }
            MeshEdit::Node(change) => ("its node".to_owned(), format!("{change:?}")),
        };
        Some(Spot { triangle: triangle.map(single), shift, extent, from, to })
    }

    /// Applies the edit to a file in one of the three formats. `None` if the spot is not in it. `parts` is its content.
    pub(crate) fn applied(
        &self,
        spot: &Spot,
        bytes: &[u8],
        mut parts: Vec<Part>,
        format: &str,
    ) -> Option<Vec<u8>> {
        if let MeshEdit::Node(change) = self {
            return glb_node::changed(bytes, *change);
        }
        let mut found = false;
        for part in &mut parts {
            let mesh = &mut part.mesh;
            match *self {
                MeshEdit::MoveVertex(..) | MeshEdit::MoveAll(..) | MeshEdit::Scale(_) => {
                    for vertex in &mut mesh.vertices {
                        let factor = match *self {
                            MeshEdit::MoveVertex(..) if single(*vertex) != spot.triangle[0] => {
                                continue;
                            }
                            MeshEdit::Scale(factor) => factor,
                            _ => 1.0,
                        };
                        for (coordinate, shift) in vertex.iter_mut().zip(spot.shift) {
                            *coordinate = *coordinate * factor + shift;
                        }
                        found = true;
                    }
                }
                MeshEdit::LeaveOut(_) | MeshEdit::Turn(_) => {
                    let at = |triangle: &[u32; 3]| {
                        is_turned(mesh.corners(*triangle).map(single), spot.triangle)
                    };
                    let Some(at) = mesh.triangles.iter().position(at).filter(|_| !found) else {
                        continue;
                    };
                    match self {
                        MeshEdit::Turn(_) => mesh.triangles[at].swap(1, 2),
                        _ => drop(mesh.triangles.remove(at)),
                    }
                    found = true;
                }
                MeshEdit::Colour => {
                    let Some(color) = part.color.as_mut().filter(|_| !found) else {
                        continue;
                    };
                    color[0] = if color[0] > 0.5 { 0.25 } else { 0.75 };
                    found = true;
                }
                MeshEdit::StrayVertex(times) if !found => {
                    mesh.vertices.push([times * spot.extent; 3]);
                    found = true;
                }
                MeshEdit::StrayVertex(_) | MeshEdit::Node(_) => {}
            }
        }
        if !found {
            return None;
        }
        match format {
            "stl" => write::stl(&parts),
            "obj" => write::obj(&parts),
            _ => write::glb(&parts),
        }
        .ok()
    }
}

/// A position in the precision of mesh files.
#[allow(clippy::cast_possible_truncation)]
fn single(position: [f64; 3]) -> [f32; 3] {
    position.map(|coordinate| coordinate as f32 + 0.0)
}

/// Whether two triangles are equal up to the choice of the first corner.
fn is_turned(a: [[f32; 3]; 3], b: [[f32; 3]; 3]) -> bool {
    (0..3).any(|turn| (0..3).all(|corner| a[(corner + turn) % 3] == b[corner]))
}

//! Bounding boxes and bounding spheres compared with their hulls and pieces.

use nalgebra::{Point3, Rotation3, Vector3};

use crate::solids::Solids;
use crate::tolerance::HULL_IN_VOLUME;
use urdd_document::shapes::{Volume, approximations};
use urdd_document::urdd::Urdd;
use urdd_findings::part::Part;
use urdd_format::registry::ModuleKind;
use urdd_format::shape_kind::ShapeKind;
use urdd_geometry::{Mesh, farthest};

/// A box or sphere with the hull or piece that it bounds.
#[derive(Debug, Clone)]
pub struct Enclosure<'a> {
    pub kind: ShapeKind,
    /// JSON Pointer in the document.
    pub pointer: String,
    pub link: usize,
    /// The piece; 0 for a hull.
    pub piece: usize,
    pub volume: Volume,
    pub mesh: &'a Mesh,
    /// Maximum distance of vertices outside, and of sides off the mesh, m.
    pub tolerance: f64,
    pub fit: Fit,
}

/// How a box or sphere fits a mesh.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Fit {
    /// The vertex farthest outside and its distance, m; 0 if all are inside.
    pub outside: (usize, f64),
    /// The side farthest off the mesh and its distance, m.
    pub off: (Side, f64),
}

/// A part of the surface of a box or sphere.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Side {
    Round,
    /// The side of a box at the lower (false) or upper end of one of its own axes.
    Of(usize, bool),
}

impl Fit {
    pub fn new(volume: &Volume, mesh: &Mesh) -> Fit {
        match *volume {
            Volume::Sphere { radius, offset } => {
                let away = |p: &[f64; 3]| (Vector3::from(*p) - Vector3::from(offset)).norm();
                let (vertex, most) = most(mesh.vertices.iter().map(away));
                Fit {
                    outside: (vertex, (most - radius).max(0.0)),
                    off: (Side::Round, (radius - most).max(0.0)),
                }
            }
            Volume::Box { half_extents, offset, rpy: [roll, pitch, yaw] } => {
                let to_box = Rotation3::from_euler_angles(roll, pitch, yaw).inverse();
                let half = Vector3::from(half_extents);
                let inside = |p: &[f64; 3]| to_box * (Point3::from(*p) - Point3::from(offset));
                let inside: Vec<Vector3<f64>> = mesh.vertices.iter().map(inside).collect();
                let beyond = |p: &Vector3<f64>| (p.abs() - half).sup(&Vector3::zeros()).norm();
                let mut off = (Side::Round, 0.0);
                for axis in 0..3 {
                    let (_, upper) = most(inside.iter().map(|p| p[axis]));
                    let (_, lower) = most(inside.iter().map(|p| -p[axis]));
                    for (end, reach) in [(false, lower), (true, upper)] {
                        if half[axis] - reach > off.1 {
                            off = (Side::Of(axis, end), half[axis] - reach);
                        }
                    }
                }
                Fit { outside: most(inside.iter().map(beyond)), off }
            }
        }
    }

    /// Whether the box or sphere contains the mesh and touches it with all sides.
    pub fn is_tight(&self, mesh: &Mesh) -> bool {
        self.outside.1.max(self.off.1) <= tolerance(mesh)
    }
}

/// Maximum distance of vertices outside, and of sides off the mesh, m.
fn tolerance(mesh: &Mesh) -> f64 {
    HULL_IN_VOLUME * farthest::of_mesh(mesh)
}

/// The largest number and its first index.
fn most(numbers: impl Iterator<Item = f64>) -> (usize, f64) {
    let largest =
        |best: (usize, f64), next: (usize, f64)| if next.1 > best.1 { next } else { best };
    numbers.enumerate().reduce(largest).unwrap_or((0, 0.0))
}

impl Enclosure<'_> {
    pub fn holds(&self) -> bool {
        self.fit.outside.1 <= self.tolerance
    }

    /// Whether every side, or the sphere, touches the mesh.
    pub fn touches(&self) -> bool {
        self.fit.off.1 <= self.tolerance
    }

    /// Its name: `box` or `sphere`.
    pub fn noun(&self) -> &'static str {
        match self.volume {
            Volume::Box { .. } => "box",
            Volume::Sphere { .. } => "sphere",
        }
    }

    /// The hull or piece, as a part of the robot.
    pub fn part(&self) -> Part {
        Part::of_shape(self.kind, self.link, self.piece)
    }

    /// The hull or piece in words.
    pub fn of_what(&self, urdd: &Urdd) -> String {
        let link = urdd.link_label(self.link);
        match self.kind.is_of_links() {
            true => format!("the hull of {link}"),
            false => format!("piece {} of {link}", self.piece),
        }
    }
}

/// Every box and sphere whose hull or piece is readable.
pub fn enclosures<'a>(urdd: &Urdd, solids: &'a Solids) -> Vec<Enclosure<'a>> {
    let document = urdd.document(ModuleKind::LinkShapesApproximations);
    let Some(lists) = document.and_then(approximations) else { return Vec::new() };
    let mut enclosures = Vec::new();
    for list in lists {
        for (link, piece, volume) in list.entries() {
            let Some(mesh) = solids.sound(list.kind.meshes(), link, piece) else { continue };
            enclosures.push(Enclosure {
                kind: list.kind,
                pointer: list.pointer(link, piece),
                link,
                piece,
                volume,
                mesh,
                tolerance: tolerance(mesh),
                fit: Fit::new(&volume, mesh),
            });
        }
    }
    enclosures
}

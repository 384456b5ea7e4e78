//! The shapes of links and bodies, as the corners of their convex hulls. A body is what fixed joints hold together.

use std::collections::{BTreeMap, BTreeSet, HashMap};
use std::path::{Path, PathBuf};
use std::sync::Arc;

use nalgebra::{Isometry3, Point3, Vector3};
use rayon::prelude::*;
use urdd_document::robot::Robot;
use urdd_document::tree::Tree;
use urdd_findings::part::Why;
use urdd_format::meshes::GeometryKind;
use urdd_format::urdf::{Geometry, JointType};
use urdd_geometry::hull::ConvexHull;
use urdd_geometry::read::{Format, Note, Scene};
use urdd_source::{SourceMesh, SourceMeshes};

use crate::hull::{Hull, Solid, solid};
use crate::pose::mass;

/// Maximum number of corners of one robot: it may name one large mesh very often.
const MAX_CORNERS: usize = 3_000_000;
/// Maximum number of corners of a body, times the inertials in it: each is compared with all.
const MAX_COMPARED: usize = 10_000_000;

/// Formats that are read here. Nobody reads all of the others.
const READ: [&str; 5] = ["stl", "dae", "obj", "gltf", "glb"];

pub fn is_read_here(file: &Path) -> bool {
    let ending = file.extension().unwrap_or_default();
    READ.contains(&ending.to_string_lossy().to_lowercase().as_str())
}

/// What rules need of a mesh file.
#[derive(Debug)]
pub struct MeshFacts {
    /// Corners of the convex hull, before the element's scale; all vertices where they have no volume.
    pub solid: Arc<Solid>,
    /// The lengths of the smallest box along the axes around them.
    pub lengths: Vector3<f64>,
    pub triangles: usize,
    /// Format of the content.
    pub format: Format,
    /// What the reader assumed, repaired and left out.
    pub notes: Vec<Note>,
    /// The files that it names, as it names them.
    pub side_files: Vec<String>,
}

/// A mesh file as it was read, or why it cannot be.
pub type ReadMesh = Result<MeshFacts, String>;

#[derive(Debug)]
pub struct RobotGeometry {
    pub links: Vec<Shapes>,
    /// The shapes of each body, by its topmost link.
    pub bodies: BTreeMap<usize, Shapes>,
    /// Every mesh file that is there.
    pub files: HashMap<PathBuf, ReadMesh>,
    /// The links of which a mesh was not read though no rule finds a fault in it, and why.
    pub not_verified: Vec<(usize, Why)>,
}

/// A mesh of the robot whose file is there.
#[derive(Debug, Clone, Copy)]
pub struct NamedMesh<'a> {
    pub kind: GeometryKind,
    pub scale: [f64; 3],
    pub file: &'a Path,
    /// What it holds, or why it cannot be read.
    pub facts: Result<&'a MeshFacts, &'a str>,
}

/// The shapes of a link, in its frame, or of a body, in its topmost link's frame.
#[derive(Debug, Default)]
pub struct Shapes {
    /// The shapes; those of a link visual before collision.
    pub shapes: Vec<Shape>,
    /// Whether a shape is missing: its mesh was not found or read, or there are too many corners.
    pub is_partial: bool,
    /// Whether one of them is turned, as in [`Shape::is_turned`].
    pub is_turned: bool,
}

#[derive(Debug, Clone)]
pub struct Shape {
    pub kind: GeometryKind,
    /// Whether it is of a glTF, which some programs turn from y-up to z-up and others do not.
    pub is_turned: bool,
    solid: Arc<Solid>,
    scale: Vector3<f64>,
    /// Its pose in the link's frame, and the link's in that of the shapes.
    poses: [Isometry3<f64>; 2],
}

impl Shape {
    /// A link's shape, with the link at a pose.
    pub fn placed(&self, pose: &Isometry3<f64>) -> Shape {
        Shape { poses: [self.poses[0], *pose], ..self.clone() }
    }

    /// Points whose convex hull is that of the shape, m.
    pub fn corners(&self) -> impl Iterator<Item = Vector3<f64>> {
        let scaled = self.solid.corners.iter().map(|corner| corner.component_mul(&self.scale));
        scaled.map(|corner| self.place(corner))
    }

    fn place(&self, corner: Vector3<f64>) -> Vector3<f64> {
        let place = |corner, pose: &Isometry3<f64>| pose.transform_point(&corner);
        self.poses.iter().fold(Point3::from(corner), place).coords
    }

    /// The volume of their convex hull, m³.
    pub fn volume(&self) -> f64 {
        self.solid.hull.as_ref().map_or(0.0, |hull| hull.volume * self.scale.product().abs())
    }

    fn is_like(&self, other: &Shape) -> bool {
        let is_same = self.scale == other.scale && self.poses == other.poses;
        is_same && Arc::ptr_eq(&self.solid, &other.solid)
    }
}

impl Shapes {
    /// The convex hull of all shapes; `None` if they span no volume. It is not kept: each would take some 100 kB.
    pub fn hull(&self) -> Option<Hull> {
        match &self.shapes[..] {
            [first, others @ ..] if others.iter().all(|other| other.is_like(first)) => {
                let hull = first.solid.hull.as_ref()?;
                hull.mapped(&first.scale, |corner| first.place(corner))
            }
            _ => Hull::of(self.corners()),
        }
    }

    pub fn corners(&self) -> impl Iterator<Item = Vector3<f64>> {
        self.shapes.iter().flat_map(Shape::corners)
    }

    pub fn corners_of(&self, kind: GeometryKind) -> impl Iterator<Item = Vector3<f64>> {
        let of_kind = self.shapes.iter().filter(move |shape| shape.kind == kind);
        of_kind.flat_map(Shape::corners)
    }

    /// The corners of all shapes in the frame whose pose is given.
    pub fn in_frame(&self, frame: &Isometry3<f64>) -> impl Iterator<Item = Vector3<f64>> {
        self.corners().map(|corner| frame.inverse_transform_point(&Point3::from(corner)).coords)
    }
}

/// The smallest box along the axes: its lowest and its highest corner. `None` without points.
pub fn bounds(points: impl Iterator<Item = Vector3<f64>>) -> Option<(Vector3<f64>, Vector3<f64>)> {
    points.fold(None, |bounds, point| match bounds {
        None => Some((point, point)),
        Some((low, high)) => Some((point.inf(&low), point.sup(&high))),
    })
}

/// Length of the diagonal of the smallest box along the axes, m; 0 without points.
pub fn diagonal(points: impl Iterator<Item = Vector3<f64>>) -> f64 {
    bounds(points).map_or(0.0, |(low, high)| (high - low).norm())
}

impl RobotGeometry {
    /// Reads each mesh file of a robot once, in parallel, and places its hull.
    pub fn read(source: &SourceMeshes, robot: &Robot, bodies: &Bodies) -> Self {
        let files: BTreeSet<&PathBuf> =
            source.meshes.iter().filter_map(|mesh| mesh.file.as_ref().ok()).collect();
        let files: HashMap<PathBuf, ReadMesh> = files
            .into_par_iter()
            .map(|file| {
                let facts = source.read(file).map(|scene| facts(&scene));
                (file.clone(), facts)
            })
            .collect();
        let links = of_links(source, robot, &files);
        let bodies = bodies.tops().map(|top| (top, of_body(top, robot, bodies, &links)));
        RobotGeometry {
            bodies: bodies.collect(),
            links,
            not_verified: not_verified(source, &files),
            files,
        }
    }
}

fn not_verified(source: &SourceMeshes, files: &HashMap<PathBuf, ReadMesh>) -> Vec<(usize, Why)> {
    let why = |mesh: &SourceMesh| match &mesh.file {
        Ok(file) => {
            let is_unread = files.get(file).is_some_and(Result::is_err);
            (is_unread && !is_read_here(file)).then_some(Why::OtherFormat)
        }
        Err(missing) if missing.outside.is_some() => Some(Why::Outside),
        Err(missing) if missing.is_in_near_package() => None,
        Err(missing) => missing.no_package.as_ref().map(|_| Why::NoPackage),
    };
    let meshes = source.meshes.iter();
    meshes.filter_map(|mesh| Some((mesh.link, why(mesh)?))).collect()
}

fn facts(scene: &Scene) -> MeshFacts {
    let vertices = scene.parts.iter().flat_map(|part| {
        let used = part.mesh.triangles.iter().flatten();
        used.map(|index| part.mesh.vertices[*index as usize])
    });
    let mut vertices: Vec<[f64; 3]> = vertices.collect();
    vertices.sort_by(|a, b| {
        a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1])).then(a[2].total_cmp(&b[2]))
    });
    vertices.dedup();
    let solid = match ConvexHull::new(&vertices) {
        Ok(hull) => Solid::of_hull(hull),
        Err(_) => Solid::of(vertices.into_iter().map(Vector3::from).collect()),
    };
    let lengths = bounds(solid.corners.iter().copied());
    MeshFacts {
        solid,
        lengths: lengths.map_or_else(Vector3::zeros, |(low, high)| high - low),
        triangles: scene.triangle_count(),
        format: scene.format,
        notes: scene.notes.clone(),
        side_files: scene.side_files.clone(),
    }
}

fn of_links(
    source: &SourceMeshes,
    robot: &Robot,
    files: &HashMap<PathBuf, ReadMesh>,
) -> Vec<Shapes> {
    let key = |mesh: &SourceMesh| (mesh.link, mesh.geometry, mesh.element);
    let meshes: HashMap<_, &SourceMesh> =
        source.meshes.iter().map(|mesh| (key(mesh), mesh)).collect();
    let mut left = MAX_CORNERS;
    let mut links = Vec::with_capacity(robot.links.len());
    for (index, link) in robot.links.iter().enumerate() {
        let mut geometry = Shapes::default();
        for kind in [GeometryKind::Visual, GeometryKind::Collision] {
            for (place, element) in link.elements(kind).iter().enumerate() {
                let Some(shape) = &element.geometry else {
                    continue;
                };
                let mut is_turned = false;
                let found = match shape {
                    Geometry::Mesh(mesh) => {
                        let named = meshes.get(&(index, kind, place));
                        let file = named.and_then(|mesh| mesh.file.as_ref().ok());
                        let facts = file.and_then(|file| files.get(file)?.as_ref().ok());
                        is_turned = facts.is_some_and(|facts| {
                            matches!(facts.format, Format::Gltf | Format::Glb)
                        });
                        let scale = mesh.scale.unwrap_or([1.0; 3]).into();
                        facts.map(|facts| (Arc::clone(&facts.solid), scale))
                    }
                    primitive => solid(primitive),
                };
                let found = found.and_then(|found| {
                    left = left.checked_sub(found.0.corners.len())?;
                    Some(found)
                });
                match found {
                    Some((solid, scale)) => {
                        geometry.is_turned |= is_turned;
                        let poses = [element.origin.motion(), Isometry3::identity()];
                        geometry.shapes.push(Shape { kind, is_turned, solid, scale, poses });
                    }
                    None => geometry.is_partial = true,
                }
            }
        }
        links.push(geometry);
    }
    links
}

fn of_body(top: usize, robot: &Robot, bodies: &Bodies, links: &[Shapes]) -> Shapes {
    let mut body = Shapes::default();
    let (mut corners, mut inertials) = (0, 0);
    for link in bodies.members(top) {
        let geometry = &links[link];
        body.is_partial |= geometry.is_partial;
        body.is_turned |= geometry.is_turned;
        let place = |shape: &Shape| shape.placed(&bodies.pose[link]);
        body.shapes.extend(geometry.shapes.iter().map(place));
        corners += geometry.shapes.iter().map(|shape| shape.solid.corners.len()).sum::<usize>();
        inertials += usize::from(robot.links[link].inertial.is_some());
    }
    body.is_partial |= corners.saturating_mul(inertials) > MAX_COMPARED;
    body
}

#[derive(Debug)]
pub struct Bodies {
    pub tree: Tree,
    /// The topmost link of each link's body.
    pub top: Vec<usize>,
    /// Each link's pose in the frame of its body's topmost link.
    pub pose: Vec<Isometry3<f64>>,
    /// The links of each body, by its topmost link; none for the other links.
    members: Vec<Vec<usize>>,
}

impl Bodies {
    /// Those of a robot; `None` if it is no tree (URD004 to URD007 say so).
    pub fn new(robot: &Robot) -> Option<Self> {
        let tree = Tree::new(robot)?;
        let links = robot.links.len();
        let (mut top, mut pose) =
            ((0..links).collect::<Vec<_>>(), vec![Isometry3::identity(); links]);
        for &link in &tree.order {
            let (Some(joint), Some(parent)) = (tree.parent_joint[link], tree.parent_link[link])
            else {
                continue;
            };
            let joint = &robot.joints[joint];
            if joint.joint_type == JointType::Fixed {
                top[link] = top[parent];
                pose[link] = pose[parent] * joint.origin.motion();
            }
        }
        let mut members = vec![Vec::new(); links];
        for (link, &top) in top.iter().enumerate() {
            members[top].push(link);
        }
        Some(Bodies { tree, top, pose, members })
    }

    /// The links of a body, by its topmost link.
    pub fn members(&self, top: usize) -> impl Iterator<Item = usize> {
        self.members[top].iter().copied()
    }

    /// The topmost links, in link order.
    pub fn tops(&self) -> impl Iterator<Item = usize> {
        let all = self.top.iter().enumerate();
        all.filter(|(link, top)| link == *top).map(|(link, _)| link)
    }
}

/// The links that can only slide: prismatic and fixed joints lead to them from a base that is fixed to the world, so that
/// their inertia has no effect. A base is fixed if it is called `world`, or has no mass to move by.
pub fn slide_only(robot: &Robot, bodies: &Bodies) -> Vec<bool> {
    let root = bodies.tree.root;
    let has_mass = |link: usize| mass(&robot.links[link]) > Some(0.0);
    let is_fixed = robot.links[root].name == "world" || !bodies.members(root).any(has_mass);
    let mut slides = vec![false; robot.links.len()];
    for &link in &bodies.tree.order {
        slides[link] = match (bodies.tree.parent_joint[link], bodies.tree.parent_link[link]) {
            (Some(joint), Some(parent)) => {
                let kind = robot.joints[joint].joint_type;
                slides[parent] && matches!(kind, JointType::Fixed | JointType::Prismatic)
            }
            _ => is_fixed,
        };
    }
    slides
}

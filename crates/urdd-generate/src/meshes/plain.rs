//! `plain_meshes_module` from the URDF and its mesh files: SPEC 7.2 and 7.4; how large links may be, and which elements shapes
//! are made of, where that is not what a person may expect.

use std::collections::{BTreeMap, HashMap};
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

use nalgebra::Vector3;
use rayon::prelude::*;

use crate::context::Context;
use crate::error::first_names;
use urdd_format::colors::Colors;
use urdd_format::meshes::GeometryKind;
use urdd_format::original_meshes::OriginalMeshesModule;
use urdd_format::plain_meshes::PlainMeshesModule;
use urdd_format::short::Short;
use urdd_format::urdf::{Geometry, Link, Material, Origin, UrdfModule};
use urdd_geometry::mesh::placement;
use urdd_geometry::read::{Part, Scene};
use urdd_geometry::{Mesh, primitives};
use urdd_source::fault::Fault;
use urdd_source::note::{Note, NoteKind};
use urdd_source::origin;

/// The geometry of a link: its triangles by colour, in the link's frame.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct LinkGeometry {
    pub geometry: GeometryKind,
    pub parts: Vec<Part>,
}

struct Element<'a> {
    origin: Option<&'a Origin>,
    geometry: Option<&'a Geometry>,
    material: Option<&'a Material>,
    /// The referenced mesh, if it is usable.
    scene: Option<&'a Scene>,
}

/// The geometry of every link; `None` for a link without any. `scenes` are the meshes by their paths in the URDD.
/// `have` returns true for links whose geometry is not needed.
/// Fails if a link has too many triangles, or a shape too small for its distance from the frame.
pub(crate) fn link_geometries(
    robot: &UrdfModule,
    original: &OriginalMeshesModule,
    scenes: &BTreeMap<String, Arc<Scene>>,
    preferred: GeometryKind,
    have: &(dyn Fn(usize) -> bool + Sync),
) -> Result<Vec<Option<LinkGeometry>>, Fault> {
    let named: BTreeMap<(usize, GeometryKind, usize), &Scene> = original
        .references
        .iter()
        .filter_map(|reference| {
            let scene = scenes.get(reference.path.as_ref()?)?;
            let place = (reference.link_idx.get(), reference.geometry, reference.element_idx.get());
            Some((place, scene.as_ref()))
        })
        .collect();
    let other = match preferred {
        GeometryKind::Visual => GeometryKind::Collision,
        GeometryKind::Collision => GeometryKind::Visual,
    };
    let quaternions = origin::has_quaternions(robot.version.as_deref());
    let colors = Colors::of(robot);
    // Counted before they are built: even a tiny URDF can reference a mesh or a sphere many times.
    let all = AtomicUsize::new(0);
    let links: Vec<_> = robot.links.iter().enumerate().collect();
    let geometries: Vec<Result<Option<LinkGeometry>, Fault>> = links
        .into_par_iter()
        .map(|(link_idx, link)| {
            if have(link_idx) {
                return Ok(None);
            }
            for kind in [preferred, other] {
                let mut elements = elements(link, kind);
                for (element_idx, element) in elements.iter_mut().enumerate() {
                    element.scene = named.get(&(link_idx, kind, element_idx)).copied();
                }
                elements.retain(is_usable);
                let found: usize = elements.iter().map(num_triangles).sum();
                if found > MOST_LINK_TRIANGLES {
                    let (link, limit) = (link.name.as_str().into(), MOST_LINK_TRIANGLES);
                    return Err(Fault::TooManyTriangles { link, found, limit });
                }
                if all.fetch_add(found, Ordering::Relaxed) + found > MOST_TRIANGLES {
                    return Ok(None);
                }
                let parts: Vec<Part> = elements
                    .iter()
                    .flat_map(|element| placed(element, &colors, quaternions))
                    .collect();
                if !elements.is_empty() {
                    check_resolved(&link.name, &parts)?;
                    return Ok(Some(LinkGeometry { geometry: kind, parts: by_look(parts) }));
                }
            }
            Ok(None)
        })
        .collect();
    let geometries = geometries.into_iter().collect::<Result<_, Fault>>()?;
    if all.into_inner() > MOST_TRIANGLES {
        return Err(Fault::TooManyTrianglesInAll { limit: MOST_TRIANGLES });
    }
    Ok(geometries)
}

fn elements(link: &Link, kind: GeometryKind) -> Vec<Element<'_>> {
    fn element<'a>(
        origin: &'a Option<Origin>,
        geometry: &'a Option<Geometry>,
        material: Option<&'a Material>,
    ) -> Element<'a> {
        let (origin, geometry) = (origin.as_ref(), geometry.as_ref());
        Element { origin, geometry, material, scene: None }
    }
    match kind {
        GeometryKind::Visual => (link.visual.iter())
            .map(|of| element(&of.origin, &of.geometry, of.material.as_ref()))
            .collect(),
        GeometryKind::Collision => {
            link.collision.iter().map(|of| element(&of.origin, &of.geometry, None)).collect()
        }
    }
}

/// Whether an element has a surface with positive area.
fn is_usable(element: &Element) -> bool {
    let extends = |numbers: [f64; 3]| numbers.iter().filter(|number| **number != 0.0).count() >= 2;
    match element.geometry {
        None => false,
        Some(Geometry::Mesh(mesh)) => {
            element.scene.is_some() && extends(mesh.scale.unwrap_or([1.0; 3]))
        }
        Some(Geometry::Box(cuboid)) => {
            extends(cuboid.size) && cuboid.size.iter().all(|side| *side >= 0.0)
        }
        Some(Geometry::Cylinder(of)) => of.radius > 0.0 && of.length >= 0.0,
        Some(Geometry::Capsule(of)) => of.radius > 0.0 && of.length >= 0.0,
        Some(Geometry::Sphere(of)) => of.radius > 0.0,
    }
}

/// Number of triangles of a usable element, before those with zero area are dropped.
fn num_triangles(element: &Element) -> usize {
    match element.geometry {
        None => 0,
        Some(Geometry::Mesh(_)) => element.scene.map_or(0, Scene::triangle_count),
        Some(Geometry::Box(_)) => primitives::CUBOID_TRIANGLES,
        Some(Geometry::Cylinder(_)) => primitives::CYLINDER_TRIANGLES,
        Some(Geometry::Capsule(_)) => primitives::CAPSULE_TRIANGLES,
        Some(Geometry::Sphere(_)) => primitives::SPHERE_TRIANGLES,
    }
}

/// The parts of an element in the link's frame, rounded to the precision of files.
fn placed(element: &Element, colors: &Colors<'_>, quaternions: bool) -> Vec<Part> {
    let mut scale = [1.0; 3];
    let parts = match (element.geometry, element.scene) {
        (None, _) | (Some(Geometry::Mesh(_)), None) => return Vec::new(),
        (Some(Geometry::Mesh(mesh)), Some(scene)) => {
            scale = mesh.scale.unwrap_or(scale);
            scene.parts.clone()
        }
        (Some(Geometry::Box(of)), _) => vec![primitives::cuboid(of.size).into()],
        (Some(Geometry::Cylinder(of)), _) => {
            vec![primitives::cylinder(of.radius, of.length).into()]
        }
        (Some(Geometry::Capsule(of)), _) => vec![primitives::capsule(of.radius, of.length).into()],
        (Some(Geometry::Sphere(of)), _) => vec![primitives::sphere(of.radius).into()],
    };
    // Values must be in the range that a .glb allows.
    let color = colors.get(element.material).map(|rgba| rgba.map(|part| part.clamp(0.0, 1.0)));
    let pose = origin::of(element.origin, quaternions);
    let rotation = pose.rotation.to_rotation_matrix();
    let rows = [0, 1, 2].map(|row| [0, 1, 2].map(|column| rotation[(row, column)]));
    let place = placement(scale, rows, pose.translation.vector.into());
    let moved = parts.into_iter().map(|part: Part| Part {
        mesh: tidy(part.mesh, &place),
        color: part.color.or(color),
        material: part.material,
        texture: None,
    });
    moved.filter(|part| !part.mesh.triangles.is_empty()).collect()
}

/// Merges parts of the same look, in the order of first appearance. A link may have many thousands of elements, and a
/// viewer draws each part separately.
fn by_look(parts: Vec<Part>) -> Vec<Part> {
    let mut place: HashMap<(Option<[u64; 4]>, Option<String>), usize> = HashMap::new();
    let mut joined: Vec<Part> = Vec::new();
    for part in parts {
        let look = (part.color.map(|color| color.map(f64::to_bits)), part.material.clone());
        match place.get(&look) {
            Some(at) => joined[*at].mesh.append(&part.mesh),
            None => {
                place.insert(look, joined.len());
                joined.push(part);
            }
        }
    }
    joined
}

fn tidy(mut mesh: Mesh, place: &nalgebra::Matrix4<f64>) -> Mesh {
    mesh.transform(place);
    mesh.round_to_f32();
    mesh.weld();
    mesh.drop_degenerate();
    mesh.drop_unused_vertices();
    mesh
}

/// Maximum number of triangles of a link: its .obj stays below the 512 MiB that URDD readers accept.
pub const MOST_LINK_TRIANGLES: usize = 3_000_000;

/// Maximum number of triangles of all links together.
pub const MOST_TRIANGLES: usize = 10_000_000;

/// Minimum ratio of a shape's width to its largest coordinate. Files store coordinates as binary32, and readers assume
/// an accuracy of eight steps of that, some 1e-6. A thinner shape has no width for them.
const LEAST_WIDTH: f64 = 4e-6;

/// Refuses a link whose shape would have no width in its mesh files.
fn check_resolved(link: &str, parts: &[Part]) -> Result<(), Fault> {
    let vertices = || parts.iter().flat_map(|part| &part.mesh.vertices);
    let mut largest = 0.0_f64;
    for vertex in vertices() {
        largest = vertex.iter().fold(largest, |most, x| most.max(x.abs()));
    }
    let width = width(vertices().map(|vertex| Vector3::from(*vertex)));
    if width > LEAST_WIDTH * largest {
        return Ok(());
    }
    Err(Fault::Unresolved { link: link.into() })
}

/// The largest distance of a point from a line through two distant points; 0 without points.
fn width(points: impl Iterator<Item = Vector3<f64>> + Clone) -> f64 {
    let Some(first) = points.clone().next() else { return 0.0 };
    let farthest = |distance: &dyn Fn(&Vector3<f64>) -> f64| {
        points.clone().map(|point| distance(&point)).fold(0.0, f64::max)
    };
    let length = farthest(&|point| (point - first).norm());
    let Some(last) = points.clone().find(|point| (point - first).norm() >= length) else {
        return 0.0;
    };
    let along = (last - first) / length;
    farthest(&|point| (point - first).cross(&along).norm())
}

/// Notes about the links that collide by their visual elements, and about a robot in which nothing can collide.
pub(crate) fn notes(context: &Context, plain: &PlainMeshesModule) -> Vec<Note> {
    let links = &context.source.reading.robot.links;
    let note = |problem: String, assumed: &str| {
        vec![context.note(NoteKind::GeometryTaken, problem, assumed)]
    };
    if plain.link_meshes.iter().all(Option::is_none) {
        // A single link has no pair, whatever it is made of.
        if links.len() < 2 {
            return Vec::new();
        }
        let problem = "no link has a visual or collision element with a surface";
        return note(problem.to_owned(), "nothing can collide: there is no pair to check");
    }
    let is_visual = |link: usize| {
        let mesh = plain.link_meshes.get(link).and_then(Option::as_ref);
        mesh.is_some_and(|mesh| mesh.geometry == GeometryKind::Visual)
    };
    let taken = |collides: bool| {
        let all = links.iter().enumerate();
        let those =
            all.filter(|(at, link)| is_visual(*at) && link.collision.is_empty() != collides);
        those.map(|(_, link)| link.name.as_str()).collect::<Vec<_>>()
    };
    let (instead, only) = (taken(true), taken(false));
    let mut notes = Vec::new();
    if links.iter().all(|link| link.collision.is_empty()) {
        let problem = "no link has a collision element".to_owned();
        let assumed =
            format!("the collision shapes of {} are made of visual elements", listed(&only));
        notes.extend(note(problem, &assumed));
    } else if !only.is_empty() {
        let problem = format!("{} {} no collision element", listed(&only), has(&only));
        notes.extend(note(problem, "collision shapes are made of visual elements there"));
    }
    if !instead.is_empty() {
        let problem =
            format!("{} {} visual and collision elements", listed(&instead), has(&instead));
        let assumed = match plain.preferred_geometry {
            GeometryKind::Visual => {
                "collision shapes are made of the visual elements; `--geometry collision` takes the collision elements"
            }
            GeometryKind::Collision => {
                "collision shapes are made of the visual elements, since the collision elements cannot be used"
            }
        };
        notes.extend(note(problem, assumed));
    }
    notes
}

fn has(names: &[&str]) -> &'static str {
    if names.len() == 1 { "has" } else { "have" }
}

/// The number of these links and the names of the first.
fn listed(names: &[&str]) -> String {
    let links = if names.len() == 1 { "link" } else { "links" };
    let shown = first_names(names.iter().map(|name| Short::of(name)));
    format!("{} {links} ({shown})", names.len())
}

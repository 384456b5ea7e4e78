//! Compares plain meshes with the robot's elements at their places (SPEC 7.8).

use rayon::prelude::*;

use super::derived::{self, Derived};
use super::expected::{self, Expected};
use super::polytope::step;
use super::{Solids, cut, file};
use crate::tolerance::{PRIMITIVE_AREA, PRIMITIVE_SAG, placing_resolution};
use urdd_document::urdd::Urdd;
use urdd_document::usable_geometry::UsableGeometry;
use urdd_findings::finding::point;
use urdd_findings::part::Why;
use urdd_format::meshes::GeometryKind;
use urdd_format::readable::metres;
use urdd_format::registry::{ModuleDocument, ModuleKind};
use urdd_geometry::Mesh;
use urdd_geometry::surface::{self, Likeness, needs_counterpart};

/// A link with a wrong mesh.
#[derive(Debug)]
pub struct Misplaced {
    pub link: usize,
    /// JSON Pointer of its mesh.
    pub pointer: String,
    pub what: String,
    pub expected: String,
    pub actual: String,
    /// Maximum distance of corners, m.
    pub tolerance: f64,
}

/// The result for the meshes of all links, in link order.
#[derive(Debug, Default)]
pub struct Placed {
    pub wrong: Vec<Misplaced>,
    /// The links that could not be judged: files differ or are broken, or a source is missing.
    pub unknown: Vec<(usize, Why)>,
}

/// Compares the mesh of every link.
pub fn all(urdd: &Urdd, solids: &Solids) -> Placed {
    let usable = UsableGeometry::new(urdd);
    let look = |mesh: &Derived| -> Result<Option<Misplaced>, Why> {
        let found = mesh.sound().ok_or(Why::Unreadable)?;
        let Some(kind) = kind_of(urdd, mesh.link) else { return Ok(None) };
        let original = |path: &str| solids.original(path)?.mesh.as_ref().ok().cloned();
        let expected = expected::of_link(urdd, &original, &usable, mesh.link, kind);
        let expected = expected.ok_or(Why::SourceMissing)?;
        // MSH011 reports a mesh of a link without geometry.
        let fault = fault(&expected, found).filter(|_| !expected.is_empty());
        // A face that is not convex may be cut otherwise.
        let fault = fault.filter(|_| {
            let uncut = |path: &str| file::uncut(urdd, path).or_else(|| original(path));
            let expected = expected::of_link(urdd, &uncut, &usable, mesh.link, kind);
            let cut = expected.and_then(|expected| cut::as_found(expected, found));
            cut.is_none_or(|expected| self::fault(&expected, found).is_some())
        });
        let file = mesh.files.get(mesh.mesh_of);
        Ok(fault.zip(file).map(|((what, tolerance), file)| Misplaced {
            link: mesh.link,
            pointer: mesh.pointer().to_owned(),
            expected: in_words(&expected),
            actual: format!("`{}`: {what}", file.path),
            what,
            tolerance,
        }))
    };
    let meshes = solids.derived(ModuleKind::PlainMeshes);
    let looks: Vec<_> = meshes.par_iter().map(|mesh| (mesh.link, look(mesh))).collect();
    let mut placed = Placed::default();
    for (link, look) in looks {
        match look {
            Ok(misplaced) => placed.wrong.extend(misplaced),
            Err(why) => placed.unknown.push((link, why)),
        }
    }
    placed
}

/// The geometry that a link's mesh was made from. Legacy modules used the visual geometry.
fn kind_of(urdd: &Urdd, link: usize) -> Option<GeometryKind> {
    match urdd.document(ModuleKind::PlainMeshes)? {
        ModuleDocument::PlainMeshes(module) => {
            Some(module.link_meshes.get(link)?.as_ref()?.geometry)
        }
        _ => Some(GeometryKind::Visual),
    }
}

/// The other link whose placed geometry is this link's mesh.
pub fn owner(urdd: &Urdd, solids: &Solids, link: usize) -> Option<usize> {
    let usable = UsableGeometry::new(urdd);
    let mesh = solids.mesh(ModuleKind::PlainMeshes, link, 0)?;
    let others = urdd.robot()?.links.len();
    let original = |path: &str| solids.original(path)?.mesh.as_ref().ok().cloned();
    (0..others).filter(|other| *other != link).find(|other| {
        let expected = kind_of(urdd, *other)
            .and_then(|kind| expected::of_link(urdd, &original, &usable, *other, kind));
        expected.is_some_and(|expected| {
            !expected.is_empty()
                && !are_apart(&expected.mesh, mesh, tolerance(&expected, mesh))
                && fault(&expected, mesh).is_none()
        })
    })
}

/// Maximum distance of corners, m.
fn tolerance(expected: &Expected, found: &Mesh) -> f64 {
    placing_resolution(expected.extent.max(surface::extent(found)))
}

/// The fault of a mesh and the tolerance; `None` if it is right.
pub fn fault(expected: &Expected, found: &Mesh) -> Option<(String, f64)> {
    let tolerance = tolerance(expected, found);
    let difference = surface::difference(&expected.mesh, found, tolerance, Likeness::SameSurface);
    let fault = || Some((derived::in_words(&difference), tolerance));
    if difference.missing > 0 || difference.turned > 0 {
        return fault();
    }
    if expected.primitives.is_empty() {
        return if difference.extra.is_empty() { None } else { fault() };
    }
    primitives(expected, found, &difference.extra, tolerance).map(|what| (what, tolerance))
}

/// What is wrong with the triangles of the primitives: a corner off the surface, a face too far inside it, or too little
/// or too much area. Thin triangles need not be of a primitive, and may: small ones are made of them.
fn primitives(
    expected: &Expected,
    found: &Mesh,
    extra: &[usize],
    tolerance: f64,
) -> Option<String> {
    let is_thin = |at: &usize| !needs_counterpart(found.corners(found.triangles[*at]), tolerance);
    let thin: Vec<usize> = (0..found.triangles.len()).filter(is_thin).collect();
    let count = extra.len() + thin.len();
    let triangles = extra.iter().map(|at| (at, true)).chain(thin.iter().map(|at| (at, false)));
    let mut areas = vec![0.0; expected.primitives.len()];
    let mut total = 0.0;
    // With many triangles and shapes, only some triangles are compared with all shapes; their area counts in full.
    let every = step(count, expected.primitives.len());
    for (number, (at, is_extra)) in triangles.enumerate() {
        let corners = found.corners(found.triangles[*at]);
        let vectors = corners.map(nalgebra::Vector3::from);
        let [a, b, c] = vectors;
        let area = (b - a).cross(&(c - a)).norm() / 2.0;
        let middle: [f64; 3] = ((a + b + c) / 3.0).into();
        total += if is_extra { area } else { 0.0 };
        if number % every != 0 {
            continue;
        }
        let mut on_any = false;
        for (primitive, sum) in expected.primitives.iter().zip(&mut areas) {
            let on = corners.iter().all(|p| primitive.distance(*p).abs() <= tolerance);
            if on
                && primitive.depth(vectors) <= primitive.sag(PRIMITIVE_SAG) + tolerance
                && primitive.faces_outward(vectors, tolerance)
            {
                on_any = true;
                *sum += area;
            }
        }
        if is_extra && !on_any {
            return Some(off_surface(expected, corners, middle));
        }
    }
    let most: f64 = expected.primitives.iter().map(|p| p.area()).sum();
    let rounding = |area: f64| tolerance * area.sqrt() * 8.0 + area * 1e-9;
    for (primitive, area) in expected.primitives.iter().zip(areas) {
        if every > 1 {
            break;
        }
        let whole = primitive.area();
        if area < whole * PRIMITIVE_AREA - rounding(whole) {
            return Some(format!(
                "{area:.6} m² of the {whole:.6} m² of its {} are there",
                primitive.name()
            ));
        }
    }
    (total > most + rounding(most))
        .then(|| format!("{total:.6} m² of surface where its shapes have {most:.6} m²"))
}

/// Describes a triangle that is on no primitive.
fn off_surface(expected: &Expected, corners: [[f64; 3]; 3], middle: [f64; 3]) -> String {
    let nearest = |p: [f64; 3]| {
        expected.primitives.iter().map(|one| one.distance(p).abs()).fold(f64::INFINITY, f64::min)
    };
    let worst = corners.into_iter().fold((middle, nearest(middle)), |worst, corner| {
        let distance = nearest(corner);
        if distance > worst.1 { (corner, distance) } else { worst }
    });
    format!(
        "a triangle at {} is {} off the surface, or faces inward",
        point(worst.0),
        metres(worst.1)
    )
}

/// Describes the expected geometry of a link.
fn in_words(expected: &Expected) -> String {
    let mut parts = Vec::new();
    if !expected.mesh.triangles.is_empty() {
        parts.push(format!("{} triangles of its meshes", expected.mesh.triangles.len()));
    }
    parts.extend(expected.primitives.iter().map(|one| format!("a {}", one.name())));
    if parts.is_empty() { "nothing".to_owned() } else { parts.join(", ") }
}

/// Whether [`surface::difference`](urdd_geometry::surface::difference) is certain to find a triangle of `expected` missing in
/// `found`. Looks at a few triangles only, so false says nothing.
pub fn are_apart(expected: &Mesh, found: &Mesh, tolerance: f64) -> bool {
    const TRIANGLES: usize = 3;
    let near = |p: &[f64; 3], q: &[f64; 3]| (0..3).all(|i| (p[i] - q[i]).abs() <= tolerance);
    // Points within the tolerance are merged, in chains too, so points of both meshes count.
    let is_alone = |p: &&[f64; 3]| {
        !found.vertices.iter().any(|q| near(p, q))
            && !expected.vertices.iter().any(|q| *p != q && near(p, q))
    };
    let triangles = expected.triangles.iter();
    let needed = triangles
        .map(|triangle| expected.corners(*triangle))
        .filter(|corners| needs_counterpart(*corners, tolerance));
    // With two such corners, none of the three is merged with another, and the triangle counts.
    needed.take(TRIANGLES).any(|corners| corners.iter().filter(is_alone).count() >= 2)
}

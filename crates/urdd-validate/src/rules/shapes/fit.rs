//! Boxes and spheres: their sizes, how they fit what they hold, and how far shapes reach.

use crate::rules::prelude::*;
use crate::views::enclosure::{Enclosure, Side};
use crate::views::judged::enclosures;
use urdd_document::shapes::{ShapeList, Volume, approximations, max_distances};
use urdd_geometry::bounding_sphere::BoundingSphere;
use urdd_geometry::farthest;
use urdd_geometry::hull::ConvexHull;
use urdd_geometry::oriented_box::OrientedBox;

declare_rule! {
    /// A box has a negative half extent or no extent at all, or a sphere's radius is not positive.
    ///
    /// No box or sphere of such a size holds a link. Geometry libraries turn a negative size inside
    /// out, or answer every question about it with no. (A flat link may have a box that is flat in one
    /// or two directions.)
    ///
    /// Write `half_extents` as half of each side's length, and the radius as a length: both positive.
    SHP003 "impossible-shape-size", Error, clause "8.2", since "0.1.0",
    phase References, needs [Module(Kind::LinkShapesApproximations)], check impossible_shape_size,

    /// A box or sphere leaves out a part of the hull or piece that it should hold.
    ///
    /// Programs test boxes and spheres first, and look no further where these are apart: a part that
    /// sticks out is never tested, and collisions with it are missed. Most often the box or sphere was
    /// made of another mesh, or its rotation is taken the other way round.
    ///
    /// Make it again from the vertices of the hull or piece, as its file has them.
    SHP017 "shape-leaves-out-part", Error, clause "8.2", since "0.1.0",
    phase Geometry, needs [ENCLOSURES], check shape_leaves_out_part,

    /// A box does not touch its hull or piece on all six sides, or a sphere does not touch it.
    ///
    /// The extents of a box follow from its orientation, and the radius of a sphere from its centre:
    /// larger ones hold the same and gain nothing. A side that does not touch is a sign that the
    /// numbers were computed from another mesh, or with a margin, which programs that want one add
    /// themselves.
    ///
    /// Keep the orientation, and take the least and the largest coordinate of the vertices along each
    /// of the box's axes; keep the centre of a sphere, and take the distance of the farthest vertex.
    SHP018 "shape-does-not-touch", Error, clause "8.2", since "0.1.0",
    phase Geometry, needs [Version1, ENCLOSURES], check shape_does_not_touch,

    /// A box has more than 1.1 times the volume of a smaller one that holds the same hull or piece.
    ///
    /// Boxes are tested in place of what they hold: excess volume causes false collisions, and
    /// paths that are not found. For a flat hull or piece areas are compared, as volumes are of
    /// boxes thickened by a millionth of the reach.
    ///
    /// Turn the box: of all orientations one has the least volume. `urdd generate` finds it.
    SHP019 "needlessly-large-box", Warning, clause "8.2", since "0.1.0",
    phase Geometry, consequence Looseness, needs [ENCLOSURES],
    check |context, findings| report(context, findings, NEEDLESSLY_LARGE_BOX, ["box", "volume"], box_ratio),

    /// A sphere has more than 1.05 times the radius of a smaller one that holds the same hull or piece.
    ///
    /// Spheres are tested in place of what they hold: where they are larger than they need to be,
    /// programs report false collisions. Most often the centre is the mean of the vertices, or the
    /// middle of a box.
    ///
    /// Move the centre: there is one smallest sphere. `urdd generate` finds it.
    SHP020 "needlessly-large-sphere", Warning, clause "8.2", since "0.1.0",
    phase Geometry, consequence Looseness, needs [ENCLOSURES],
    check |context, findings| report(context, findings, NEEDLESSLY_LARGE_SPHERE, ["sphere", "radius"], sphere_ratio),

    /// A shape's largest distance from its link's origin is not what its box or sphere gives.
    ///
    /// The value is exact for a box (its farthest corner) and for a sphere (distance of its centre, plus
    /// its radius), and a hull or convex piece cannot reach farther than the box and the sphere that
    /// hold it. Programs bound by it how far a link's points move when joints turn; where it is too
    /// small, they miss collisions.
    ///
    /// Write the value from the same boxes and spheres as `link_shapes_approximations_module`. (Legacy
    /// spheres were measured at the corners of a tessellated one: up to 0.5 % of the radius too little passes.)
    SHP004 "max-distance-wrong", Error, clause "8.3", since "0.1.0",
    phase References, needs [
        Module(Kind::LinkShapesApproximations), Module(Kind::LinkShapesMaxDistanceFromOrigin), NotFailed(MSH004),
        SHAPES_LISTED, NotFailed(SHP003),
        // The distance may be that of the right box, where the box itself does not fit.
        NotFailed(SHP017), NotFailed(SHP018),
    ], check max_distance_wrong,

    /// The largest distance of a hull or piece from its link's origin is not that of its farthest vertex.
    ///
    /// Programs bound by it how far a link's points move when joints turn; where it is too small, they
    /// miss collisions.
    ///
    /// Write the distance of the farthest vertex from the origin of the link's frame, as the mesh file
    /// has it.
    SHP021 "hull-distance-wrong", Error, clause "8.3", since "0.1.0",
    phase Geometry, needs [
        Module(Kind::LinkShapesMaxDistanceFromOrigin), HULLS_OR_PIECES, PIECES_LISTED, OWN_FILES, SOUND_SHAPES,
        SHAPES_LISTED,
        // It reports a value beyond the box and the sphere.
        NotFailed(SHP004),
    ], check hull_distance_wrong,
}

fn impossible_shape_size(context: &Context, findings: &mut Findings) -> Option<()> {
    let kind = Kind::LinkShapesApproximations;
    for list in approximations(context.document(kind)?)? {
        for (link, piece, volume) in list.entries() {
            if let Some((field, expected, actual)) = fault(&volume) {
                let pointer = format!("{}/{field}", list.pointer(link, piece));
                let message =
                    format!("this cannot enclose a shape of {}", context.link_label(link));
                let finding = finding_in(Kind::LinkShapesApproximations, pointer, message);
                findings.report(finding.values(expected, actual));
            }
        }
    }
    Some(())
}

/// What is impossible about a size: field, expected, actual.
fn fault(volume: &Volume) -> Option<(String, &'static str, String)> {
    match volume {
        Volume::Sphere { radius, .. } => {
            let fault = || ("radius".to_owned(), "more than 0", radius.to_string());
            (*radius <= 0.0).then(fault)
        }
        Volume::Box { half_extents, .. } => {
            let mut axes = half_extents.iter().enumerate();
            if let Some((axis, half)) = axes.find(|(_, half)| **half < 0.0) {
                return Some((format!("half_extents/{axis}"), "0 or more", half.to_string()));
            }
            let expected = "at least one of three more than 0";
            let fault = || ("half_extents".to_owned(), expected, "[0, 0, 0]".to_owned());
            (*half_extents == [0.0; 3]).then(fault)
        }
    }
}

fn shape_leaves_out_part(context: &Context, findings: &mut Findings) -> Option<()> {
    let module = context.module(Kind::LinkShapesApproximations)?;
    for enclosure in enclosures(context, findings).into_iter().filter(|one| !one.holds()) {
        let (vertex, away) = enclosure.fit.outside;
        let (noun, what) = (enclosure.noun(), enclosure.of_what(context));
        let (place, distance) = (point(*enclosure.mesh.vertices.get(vertex)?), metres(away));
        let message = format!(
            "the {noun} leaves out a part of {what}: the vertex at {place} is {distance} outside"
        );
        finding_in(module, &enclosure.pointer, message)
            .values("every vertex inside", format!("{distance} outside"))
            .tolerance(enclosure.tolerance)
            .off_by(away, "m")
            .report(findings);
    }
    Some(())
}

fn shape_does_not_touch(context: &Context, findings: &mut Findings) -> Option<()> {
    let module = context.module(Kind::LinkShapesApproximations)?;
    for enclosure in enclosures(context, findings) {
        // A shape that leaves a part out is off on the other side: SHP017 reports it.
        if !enclosure.holds() || enclosure.touches() {
            continue;
        }
        let (side, off) = enclosure.fit.off;
        let (what, distance) = (enclosure.of_what(context), metres(off));
        let message = match side {
            Side::Round => format!("the sphere is {distance} away from {what} on all sides"),
            Side::Of(axis, upper) => {
                let sign = if upper { '+' } else { '-' };
                let axis = ['x', 'y', 'z'].get(axis)?;
                format!("the box's side at its own {sign}{axis} is {distance} away from {what}")
            }
        };
        finding_in(module, &enclosure.pointer, message)
            .values("a vertex on every side", format!("{distance} away"))
            .tolerance(enclosure.tolerance)
            .off_by(off, "m")
            .report(findings);
    }
    Some(())
}

/// The volume of a box over that of the smallest one. `None` if it is not too large, for a sphere, or without a hull.
fn box_ratio(enclosure: &Enclosure) -> Option<f64> {
    let Volume::Box { half_extents, .. } = enclosure.volume else { return None };
    // A box around a flat hull has no thickness.
    let thick = |half: [f64; 3]| half.map(|h| h + enclosure.tolerance).iter().product::<f64>();
    // Most boxes are not too large, which is found quickly.
    let may_be = |hull: &ConvexHull| {
        let enough = 8.0 * thick(half_extents) / NEEDLESSLY_LARGE_BOX;
        hull.is_flat() || OrientedBox::exists_within(hull, enough)
    };
    let vertices = &enclosure.mesh.vertices;
    // The smallest box of some vertices is found much faster, and no box around all of them is smaller.
    let some = ConvexHull::new(&outermost(vertices)).ok();
    if some.is_some_and(|hull| !may_be(&hull)) {
        return None;
    }
    let hull = ConvexHull::new(vertices).ok().filter(may_be)?;
    let least = OrientedBox::around(&hull);
    Some(thick(half_extents) / thick(least.half_extents))
}

/// The farthest vertices in the directions of a coarse grid.
fn outermost(vertices: &[[f64; 3]]) -> Vec<[f64; 3]> {
    let steps = [-2.0, -1.0, 0.0, 1.0, 2.0];
    let directions = steps
        .into_iter()
        .flat_map(|x| steps.into_iter().map(move |y| [x, y]))
        .flat_map(|[x, y]| steps.into_iter().map(move |z| [x, y, z]));
    let farthest = directions.filter_map(|[x, y, z]| {
        let along = |p: &[f64; 3]| x * p[0] + y * p[1] + z * p[2];
        let pairs = vertices.iter().map(|p| (along(p), *p));
        pairs.reduce(|best, next| if next.0 > best.0 { next } else { best }).map(|(_, p)| p)
    });
    farthest.collect()
}

/// The radius of a sphere over that of the smallest one; `None` if it is surely not too large, for a box, or without a
/// hull.
fn sphere_ratio(enclosure: &Enclosure) -> Option<f64> {
    let Volume::Sphere { radius, .. } = enclosure.volume else { return None };
    let vertices = &enclosure.mesh.vertices;
    // Well below the bound, so that rounding does not matter.
    if exceeds(vertices, radius / NEEDLESSLY_LARGE_SPHERE * (1.0 + 1e-6)) {
        return None;
    }
    let hull = ConvexHull::new(vertices).ok()?;
    Some(radius / BoundingSphere::around(&hull).radius)
}

/// Whether every sphere around these points has a larger radius than this, if a few steps show it.
///
/// The variance of the points under any weights is at most the square of the smallest radius. Each step moves weight to
/// the point farthest from the mean, as much as increases the variance most (Frank and Wolfe 1956, on the dual of the
/// smallest enclosing ball).
pub fn exceeds(points: &[[f64; 3]], radius: f64) -> bool {
    const STEPS: usize = 32;
    let mut mean = points.first().map_or_else(Vector3::zeros, |p| Vector3::from(*p));
    let mut variance = 0.0;
    for _ in 0..STEPS {
        let away = |p: &[f64; 3]| (Vector3::from(*p) - mean).norm_squared();
        let pairs = points.iter().map(|p| (away(p), p));
        let Some((squared, farthest)) = pairs.reduce(|a, b| if b.0 > a.0 { b } else { a }) else {
            return false;
        };
        let weight = (squared - variance) / (2.0 * squared);
        mean += (Vector3::from(*farthest) - mean) * weight;
        variance = (1.0 - weight) * (variance + weight * squared);
        if variance > radius * radius {
            return true;
        }
    }
    false
}

/// Reports every box or sphere whose `ratio` of size to that of the smallest one is above `most`. `words` names shape and
/// size: "box", "volume".
fn report(
    context: &Context,
    findings: &mut Findings,
    most: f64,
    [shape, size]: [&str; 2],
    ratio: impl Fn(&Enclosure) -> Option<f64> + Sync,
) -> Option<()> {
    let module = context.module(Kind::LinkShapesApproximations)?;
    let tight = context.profile() == Profile::V1;
    // SHP017 and SHP018 report those that do not fit.
    let fits = |e: &Enclosure| e.noun() == shape && e.holds() && (e.touches() || !tight);
    let mut found: Vec<(Enclosure, f64)> = enclosures(context, findings)
        .into_par_iter()
        .filter(fits)
        .filter_map(|enclosure| {
            let (meshes, solids) = (enclosure.kind.meshes(), context.solids());
            let content = solids.content(meshes, enclosure.link, enclosure.piece)?;
            let size = match enclosure.volume {
                Volume::Box { half_extents: [x, y, z], .. } => [x, y, z, 0.0],
                Volume::Sphere { radius, .. } => [0.0, 0.0, 0.0, radius],
            };
            let key = (content, size.map(f64::to_bits));
            let found = context.memos.ratios.get(key, || ratio(&enclosure));
            let ratio = found.filter(|ratio| *ratio > most)?;
            Some((enclosure, ratio))
        })
        .collect();
    // The worst first: only a few are shown.
    found.sort_by(|a, b| b.1.total_cmp(&a.1));
    for (enclosure, ratio) in found {
        let of_what = enclosure.of_what(context);
        let message =
            format!("the {shape} of {of_what} has {ratio:.2} times the {size} of the smallest one");
        finding_in(module, &enclosure.pointer, message)
            .values(format!("at most {most} times"), format!("{ratio:.2} times"))
            .report(findings);
    }
    Some(())
}

fn max_distance_wrong(context: &Context, findings: &mut Findings) -> Option<()> {
    let kind = Kind::LinkShapesMaxDistanceFromOrigin;
    let document = context.document(kind)?;
    let distances = max_distances(document)?;
    let [full_hulls, full_box_values, full_sphere_values, pieces, box_values, sphere_values] =
        &distances;
    let volumes = approximations(context.document(Kind::LinkShapesApproximations)?)?;
    let [full_boxes, full_spheres, boxes, spheres] = &volumes;
    let module = context.module(kind)?;
    for (values, volumes) in [
        (full_box_values, full_boxes),
        (full_sphere_values, full_spheres),
        (box_values, boxes),
        (sphere_values, spheres),
    ] {
        for (link, piece, value) in values.entries() {
            let Some(volume) = entry(volumes, link, piece) else { continue };
            let expected = volume.reach();
            let tolerance = number_tolerance(expected, value);
            let shortfall = match volume {
                Volume::Sphere { radius, .. } if module.is_legacy() => {
                    radius * LEGACY_SPHERE_SHORTFALL
                }
                _ => tolerance,
            };
            if value > expected + tolerance || value < expected - shortfall {
                let what = match volume {
                    Volume::Sphere { .. } => "distance of the sphere's centre plus its radius",
                    Volume::Box { .. } => "distance of the box's farthest corner",
                };
                let message = format!(
                    "this is not the {what} ({}) for {}",
                    volumes.pointer(link, piece),
                    context.link_label(link)
                );
                finding_in(module, values.pointer(link, piece), message)
                    .values(expected, value)
                    .tolerance(shortfall.max(tolerance))
                    .report(findings);
            }
        }
    }
    // Hulls and pieces are inside their boxes and spheres.
    for (values, around) in [(full_hulls, [full_boxes, full_spheres]), (pieces, [boxes, spheres])] {
        for (link, piece, value) in values.entries() {
            let volumes = around.map(|list| entry(list, link, piece));
            let reaches = volumes.iter().flatten().map(Volume::reach);
            let most = reaches.fold(f64::INFINITY, f64::min);
            let tolerance = most * HULL_IN_VOLUME;
            let label = context.link_label(link);
            let message = if value < 0.0 {
                format!("a distance cannot be negative ({label})")
            } else if value > most + tolerance {
                format!("{label} reaches farther here than the box and the sphere that enclose it")
            } else {
                continue;
            };
            finding_in(module, values.pointer(link, piece), message)
                .values(format!("from 0 to {most}"), value)
                .tolerance(tolerance)
                .report(findings);
        }
    }
    Some(())
}

fn entry(list: &ShapeList<Volume>, link: usize, piece: usize) -> Option<Volume> {
    list.links.get(link)?.get(piece).copied()
}

fn hull_distance_wrong(context: &Context, findings: &mut Findings) -> Option<()> {
    let kind = Kind::LinkShapesMaxDistanceFromOrigin;
    let [hulls, _, _, pieces, _, _] = max_distances(context.document(kind)?)?;
    for (list, meshes) in
        [(hulls, Kind::ConvexHullMeshes), (pieces, Kind::ConvexDecompositionMeshes)]
    {
        for (link, piece, value) in list.entries() {
            let part = Part::of_shape(list.kind, link, piece);
            if !judged(context, findings, part, &[]) {
                continue;
            }
            let Some(mesh) = context.solids().sound(meshes, link, piece) else { continue };
            let expected = farthest::of_mesh(mesh);
            let tolerance = HULL_IN_VOLUME * expected;
            if (value - expected).abs() <= tolerance {
                continue;
            }
            let what = match list.kind.is_of_links() {
                true => "the hull".to_owned(),
                false => format!("piece {piece}"),
            };
            let message = format!(
                "this is not the distance of the farthest vertex of {what} of {}",
                context.link_label(link)
            );
            finding_in(Kind::LinkShapesMaxDistanceFromOrigin, list.pointer(link, piece), message)
                .values(expected, value)
                .tolerance(tolerance)
                .off_by(value - expected, "m")
                .report(findings);
        }
    }
    Some(())
}

use crate::rules::prelude::*;
use crate::views::enclosure::Side;
use crate::views::judged::enclosures;
use urdd_document::shapes::{Volume, approximations};

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

use crate::rules::prelude::*;
use crate::views::enclosure::Side;
use crate::views::judged::enclosures;

declare_rule! {
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
    phase Geometry, needs [Version1, ENCLOSURES],
}

fn check(context: &Context, findings: &mut Findings) -> Option<()> {
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

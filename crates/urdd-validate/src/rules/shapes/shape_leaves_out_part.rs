use crate::rules::prelude::*;
use crate::views::judged::enclosures;

declare_rule! {
    /// A box or sphere leaves out a part of the hull or piece that it should hold.
    ///
    /// Programs test boxes and spheres first, and look no further where these are apart: a part that
    /// sticks out is never tested, and collisions with it are missed. Most often the box or sphere was
    /// made of another mesh, or its rotation is taken the other way round.
    ///
    /// Make it again from the vertices of the hull or piece, as its file has them.
    SHP017 "shape-leaves-out-part", Error, clause "8.2", since "0.1.0",
    phase Geometry, needs [ENCLOSURES],
}

fn check(context: &Context, findings: &mut Findings) -> Option<()> {
    let module = context.module(Kind::LinkShapesApproximations)?;
    for enclosure in enclosures(context, findings) {
        if enclosure.holds() {
            continue;
        }
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

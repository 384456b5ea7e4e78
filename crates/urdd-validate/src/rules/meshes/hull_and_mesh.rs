//! Compares the hulls of links with their plain meshes, for MSH018 and MSH019.

use rayon::prelude::*;

use crate::rules::prelude::*;
use crate::solids::derived::Derived;

/// Reports for a rule every hull for which `off`, given the hull and the plain mesh, finds a vertex. `words` describes it, given
/// the link, the place and the distance: message, expected, actual.
pub fn report(
    context: &Context,
    findings: &mut Findings,
    code: Code,
    off: impl Fn(&Mesh, &Mesh) -> Option<Farthest> + Sync,
    words: impl Fn(&str, &str, &str) -> (String, &'static str, String),
) -> Option<()> {
    let kind = Kind::ConvexHullMeshes;
    let module = context.module(kind)?;
    // Computed before the threads start, so that the computation itself can use all of them.
    context.placed();
    let solids = context.solids();
    let hulls = solids.derived(kind).iter().filter(|hull| {
        let by = [Part::Plain(hull.link)];
        judged(context, findings, Part::Hull(hull.link), &by)
    });
    let hulls: Vec<&Derived> = hulls.collect();
    let off_of = |link| {
        let mesh = solids.sound(Kind::PlainMeshes, link, 0)?;
        let hull = solids.sound(kind, link, 0)?;
        let contents = [kind, Kind::PlainMeshes].map(|kind| solids.content(kind, link, 0));
        let key = (code, contents.into_iter().flatten().collect());
        context.memos.farthest.get(key, || off(hull, mesh))
    };
    let off: Vec<Option<Farthest>> = hulls.par_iter().map(|hull| off_of(hull.link)).collect();
    for (hull, off) in hulls.iter().zip(off) {
        let Some(off) = off else {
            continue;
        };
        let label = context.link_label(hull.link);
        let (message, expected, actual) = words(&label, &point(off.place), &metres(off.distance));
        finding_in(module, hull.pointer(), message)
            .values(expected, actual)
            .tolerance(off.tolerance)
            .off_by(off.distance, "m")
            .part(Part::Hull(hull.link))
            .report(findings);
    }
    Some(())
}

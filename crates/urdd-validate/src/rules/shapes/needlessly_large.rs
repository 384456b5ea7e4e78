//! Boxes and spheres that are larger than needed, for SHP019 and SHP020.

use rayon::prelude::*;

use crate::rules::prelude::*;
use crate::views::enclosure::Enclosure;
use crate::views::judged::enclosures;
use urdd_document::shapes::Volume;

/// Reports every box or sphere whose `ratio` of size to that of the smallest one is above `most`. `words` names shape and
/// size: "box", "volume".
pub fn report(
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

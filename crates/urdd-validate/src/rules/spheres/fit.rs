use crate::reference::spheres::budget::Budget;
use crate::reference::spheres::fit::{Standoff, Uncovered, standoff, uncovered};
use crate::reference::spheres::link_pieces::{LinkPieces, balls};
use crate::rules::prelude::*;
use urdd_format::link_shapes_spheres::LinkShapesSpheresModule;

declare_rule! {
    /// The spheres of a link are not as far from its pieces as their fit says.
    ///
    /// By the standoff a person chooses between levels: by that much, a check with the spheres keeps away from what it need
    /// not keep away from.
    ///
    /// SPEC 8.9.5 defines the points, so the validator computes them again. Where spheres were edited or pieces changed, do
    /// the same: `urdd generate --modules all,link_shapes_spheres` keeps spheres that are given.
    SPH006 "sphere-standoff-differs", Error, clause "8.9.5", since "1.4.0",
    phase Statistics, needs [
        ModuleV1(Kind::LinkShapesSpheres), Module(Kind::ConvexDecompositionMeshes), PIECES_LISTED, OWN_FILES, CONVEX_PIECE,
        Passed(SPH001), Passed(SPH002), Passed(SPH003), Passed(SPH004), NotFailed(SPH005),
    ], check standoff_differs,

    /// Not so much of the surface of a link is outside of its spheres as their fit says, or not so far.
    ///
    /// What is outside of all spheres, a check with the spheres does not see.
    ///
    /// SPEC 8.9.5 defines the points, so the validator computes them again. Where spheres were edited or pieces changed, do
    /// the same: `urdd generate --modules all,link_shapes_spheres` keeps spheres that are given.
    SPH007 "sphere-uncovered-differs", Error, clause "8.9.5", since "1.4.0",
    phase Statistics, needs [
        ModuleV1(Kind::LinkShapesSpheres), Module(Kind::ConvexDecompositionMeshes), PIECES_LISTED, OWN_FILES, CONVEX_PIECE,
        Passed(SPH001), Passed(SPH002), Passed(SPH003), Passed(SPH004), NoneFailed(&[SPH005, SPH006]),
    ], check uncovered_differs,
}

/// The links of which all pieces are judged, each with its number of pieces.
fn links(context: &Context, findings: &mut Findings) -> Option<Vec<(usize, usize)>> {
    let meshes = context.meshes(Kind::ConvexDecompositionMeshes)?;
    let mut links: Vec<(usize, usize)> =
        (0..meshes.num_links()).map(|link| (link, meshes.count(link))).collect();
    links.retain(|(link, count)| {
        let pieces = (0..*count).map(|piece| Part::Piece { link: *link, piece });
        let pieces: Vec<Part> = pieces.collect();
        let judged = pieces.iter().filter(|piece| judged(context, findings, **piece, &pieces));
        judged.count() == *count && *count > 0
    });
    Some(links)
}

/// A figure of a link in a level: its key, what was found, what may be between, and its unit.
type Figure = (&'static str, f64, f64, &'static str);

/// Compares figures with what is stated.
fn compare(
    context: &Context,
    findings: &mut Findings,
    module: &LinkShapesSpheresModule,
    found: Vec<(usize, usize, [Figure; 2])>,
) {
    let mut fold = Fold::new(findings);
    for (level, link, figures) in found {
        let stated = module.levels.get(level).and_then(|level| level.fits.get(link)?.as_ref());
        for (key, found, tolerance, unit) in figures {
            let stated = stated.map_or(f64::NAN, |stated| match key {
                "max_standoff" => stated.max_standoff,
                "mean_standoff" => stated.mean_standoff,
                "uncovered_fraction" => stated.uncovered_fraction,
                _ => stated.max_uncovered,
            });
            // NaN is reported too.
            if (found - stated).abs() <= tolerance {
                continue;
            }
            fold.add(|| {
                let message = format!(
                    "the points of the specification give another `{key}` of {}",
                    context.link_label(link)
                );
                let pointer = format!("/levels/{level}/fits/{link}/{key}");
                finding_in(Kind::LinkShapesSpheres, pointer, message)
                    .values(found, stated)
                    .tolerance(tolerance)
                    .off_by(found - stated, unit)
            });
        }
    }
}

fn standoff_differs(context: &Context, findings: &mut Findings) -> Option<()> {
    let module = document!(context, LinkShapesSpheres)?;
    let links = links(context, findings)?;
    let budget = Budget::new(context.deep);
    let of_link = |(link, count): &(usize, usize)| {
        let pieces = LinkPieces::new(context.solids(), *link, *count);
        let levels = module.levels.iter().enumerate();
        let with_spheres = levels.map(|(place, level)| (place, balls(level, *link)));
        let with_spheres = with_spheres.filter(|(_, balls)| !balls.is_empty());
        let figures = with_spheres.filter_map(|(place, balls)| {
            let pieces = pieces.as_ref()?;
            let tolerance = FIT_LENGTH * pieces.diagonal;
            let found = standoff(pieces, &balls, &budget);
            Some(found.map(|Standoff { max, mean }| {
                let max = ("max_standoff", max, tolerance, "m");
                (place, *link, [max, ("mean_standoff", mean, tolerance, "m")])
            }))
        });
        figures.collect::<Result<Vec<_>, SkipReason>>()
    };
    let found: Result<Vec<Vec<_>>, SkipReason> = links.par_iter().map(of_link).collect();
    let found = findings.or_skip(found)?;
    compare(context, findings, module, found.concat());
    Some(())
}

fn uncovered_differs(context: &Context, findings: &mut Findings) -> Option<()> {
    let module = document!(context, LinkShapesSpheres)?;
    let links = links(context, findings)?;
    let budget = Budget::new(context.deep);
    let of_link = |(link, count): &(usize, usize)| {
        let Some(pieces) = LinkPieces::new(context.solids(), *link, *count) else {
            return Ok(Vec::new());
        };
        let levels = module.levels.iter().enumerate();
        let levels = levels.map(|(place, level)| (place, balls(level, *link)));
        let (places, balls): (Vec<usize>, Vec<_>) =
            levels.filter(|(_, balls)| !balls.is_empty()).unzip();
        let found = uncovered(&pieces, &balls, &budget)?;
        let figures = places.into_iter().zip(found).map(|(place, Uncovered { fraction, max })| {
            let fraction = ("uncovered_fraction", fraction, FIT_FRACTION, "1");
            let tolerance = FIT_LENGTH * pieces.diagonal;
            (place, *link, [fraction, ("max_uncovered", max, tolerance, "m")])
        });
        Ok(figures.collect())
    };
    let found: Result<Vec<Vec<_>>, SkipReason> = links.par_iter().map(of_link).collect();
    let found = findings.or_skip(found)?;
    compare(context, findings, module, found.concat());
    Some(())
}

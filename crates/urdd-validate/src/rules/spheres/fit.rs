use crate::reference::samples::Budget;
use crate::reference::spheres::cells::{self, Outside};
use crate::reference::spheres::fit::{
    Ball, LinkPieces, Solid, Standoff, Uncovered, balls, standoff, uncovered,
};
use crate::rules::prelude::*;
use urdd_format::link_shapes_spheres::SphereFit;

declare_rule! {
    /// A level says that it covers the pieces, and a part of a piece is in no sphere of its link; or the first level does not
    /// say so.
    ///
    /// By such a level programs call configurations free without asking the pieces. They pass over contacts of the part that
    /// sticks out.
    ///
    /// The finding says where it sticks out, in the frame of the link. Make the spheres larger, or write `covers` as false;
    /// the first level covers always. Where pieces changed, make the module again:
    /// `urdd generate --modules all,link_shapes_spheres`.
    SPH005 "spheres-do-not-cover", Error, clause "8.9.4", since "1.4.0",
    phase Statistics, needs [ModuleV1(Kind::LinkShapesSpheres), SPHERES_AND_PIECES], check do_not_cover,

    /// The spheres of a link are not as far from its pieces as their fit says.
    ///
    /// By the standoff a person chooses between levels: by that much, a check with the spheres keeps away from what it need
    /// not keep away from.
    ///
    /// SPEC 8.9.5 defines the points, so the validator computes them again. Where spheres were edited or pieces changed, do
    /// the same: `urdd generate --modules all,link_shapes_spheres` keeps spheres that are given.
    SPH006 "sphere-standoff-differs", Error, clause "8.9.5", since "1.4.0",
    phase Statistics, needs [ModuleV1(Kind::LinkShapesSpheres), SPHERES_AND_PIECES, NotFailed(SPH005)], check standoff_differs,

    /// Not so much of the surface of a link is outside of its spheres as their fit says, or not so far.
    ///
    /// What is outside of all spheres, a check with the spheres does not see.
    ///
    /// SPEC 8.9.5 defines the points, so the validator computes them again. Where spheres were edited or pieces changed, do
    /// the same: `urdd generate --modules all,link_shapes_spheres` keeps spheres that are given.
    SPH007 "sphere-uncovered-differs", Error, clause "8.9.5", since "1.4.0",
    phase Statistics, needs [ModuleV1(Kind::LinkShapesSpheres), SPHERES_AND_PIECES, NoneFailed(&[SPH005, SPH006])],
    check uncovered_differs,
}

/// A level, the tolerance, m, and what is outside of it.
type Found = (usize, f64, Outside);

fn do_not_cover(context: &Context, findings: &mut Findings) -> Option<()> {
    let module = document!(context, LinkShapesSpheres)?;
    let kind = Kind::ConvexDecompositionMeshes;
    let meshes = context.meshes(kind)?;
    if module.levels.first().is_some_and(|level| !level.covers) {
        finding_in(
            Kind::LinkShapesSpheres,
            "/levels/0/covers",
            "the first level covers the pieces",
        )
        .values(true, false)
        .report(findings);
    }
    let mut pieces: Vec<(usize, usize)> = Vec::new();
    for link in 0..meshes.num_links() {
        let all = (0..meshes.count(link)).map(|piece| (link, piece));
        let is_judged = |(link, piece): &(usize, usize)| {
            judged(context, findings, Part::Piece { link: *link, piece: *piece }, &[])
        };
        pieces.extend(all.filter(is_judged));
    }
    let budget = Budget::of_spheres(context.deep);
    let covering = module.levels.iter().enumerate().filter(|(_, level)| level.covers);
    let covering: Vec<_> = covering.collect();
    let judge = |(link, piece): (usize, usize)| {
        let Some(mesh) = context.solids().sound(kind, link, piece) else { return Ok(Vec::new()) };
        let Some(solid) = Solid::new(mesh) else { return Ok(Vec::new()) };
        let tolerance = SPHERES_COVER * urdd_geometry::farthest::of_mesh(mesh);
        let in_levels = covering.iter().map(|(place, level)| {
            let found = cells::uncovered(&solid, &balls(level, link), tolerance, &budget)?;
            Ok(found.map(|found| (*place, tolerance, found)))
        });
        in_levels.filter_map(Result::transpose).collect::<Result<Vec<Found>, SkipReason>>()
    };
    let found: Result<Vec<Vec<Found>>, SkipReason> =
        pieces.par_iter().map(|piece| judge(*piece)).collect();
    let found = findings.or_skip(found)?;
    let mut fold = Fold::new(findings);
    for ((link, piece), found) in pieces.into_iter().zip(found) {
        for (level, tolerance, Outside { point: at, distance }) in found {
            fold.add(|| {
                let out = if distance.is_finite() { metres(distance) } else { "all".to_owned() };
                let message = format!(
                    "piece {piece} of {} is not in the spheres: {} is outside of them",
                    context.link_label(link),
                    point(at.into())
                );
                let pointer = format!("/levels/{level}/spheres/{link}");
                finding_in(Kind::LinkShapesSpheres, pointer, message)
                    .values("the whole piece in spheres", format!("{out} outside"))
                    .tolerance(tolerance)
                    .off_by(distance, "m")
            });
        }
    }
    Some(())
}

fn standoff_differs(context: &Context, findings: &mut Findings) -> Option<()> {
    report(context, findings, |pieces, levels, budget| {
        let tolerance = (FIT_LENGTH * pieces.diagonal).max(FIT_LENGTH_FAR * pieces.farthest());
        let of_level = |balls: &Vec<Ball>| {
            let Standoff { max, mean } = standoff(pieces, balls, budget)?;
            Ok([
                Figure::of("max_standoff", |fit| fit.max_standoff, max, (tolerance, "m")),
                Figure::of("mean_standoff", |fit| fit.mean_standoff, mean, (tolerance, "m")),
            ])
        };
        levels.iter().map(of_level).collect()
    })
}

fn uncovered_differs(context: &Context, findings: &mut Findings) -> Option<()> {
    report(context, findings, |pieces, levels, budget| {
        let tolerance = (FIT_LENGTH * pieces.diagonal).max(FIT_LENGTH_FAR * pieces.farthest());
        let figures = |Uncovered { fraction, max }| {
            let part = (FIT_FRACTION, "1");
            [
                Figure::of("uncovered_fraction", |fit| fit.uncovered_fraction, fraction, part),
                Figure::of("max_uncovered", |fit| fit.max_uncovered, max, (tolerance, "m")),
            ]
        };
        Ok(uncovered(pieces, levels, budget)?.into_iter().map(figures).collect())
    })
}

/// A figure of a link in a level: what is stated, what was found, least and most, and how far they may be apart.
struct Figure {
    key: &'static str,
    stated: fn(&SphereFit) -> f64,
    found: [f64; 2],
    tolerance: f64,
    unit: &'static str,
}

impl Figure {
    fn of(
        key: &'static str,
        stated: fn(&SphereFit) -> f64,
        found: [f64; 2],
        (tolerance, unit): (f64, &'static str),
    ) -> Self {
        Figure { key, stated, found, tolerance, unit }
    }
}

/// Computes the figures of each level with spheres again, link by link, and compares them with what is stated.
fn report(
    context: &Context,
    findings: &mut Findings,
    figures: impl Fn(&LinkPieces, &[Vec<Ball>], &Budget) -> Result<Vec<[Figure; 2]>, SkipReason> + Sync,
) -> Option<()> {
    let module = document!(context, LinkShapesSpheres)?;
    let links = links(context, findings)?;
    let budget = Budget::of_spheres(context.deep);
    let of_link = |(link, count): &(usize, usize)| {
        let Some(pieces) = LinkPieces::new(context.solids(), *link, *count) else {
            return Ok(Vec::new());
        };
        let levels = module.levels.iter().map(|level| balls(level, *link)).enumerate();
        let (places, balls): (Vec<usize>, Vec<_>) =
            levels.filter(|(_, balls)| !balls.is_empty()).unzip();
        let figures = figures(&pieces, &balls, &budget)?.into_iter();
        Ok(places.into_iter().zip(figures).map(|(place, two)| (place, *link, two)).collect())
    };
    let found: Result<Vec<Vec<_>>, SkipReason> = links.par_iter().map(of_link).collect();
    let found = findings.or_skip(found)?;
    let mut fold = Fold::new(findings);
    for (level, link, figures) in found.into_iter().flatten() {
        let fit = module.levels.get(level).and_then(|level| level.fits.get(link)?.as_ref());
        for Figure { key, stated, found, tolerance, unit } in figures {
            let stated = fit.map_or(f64::NAN, stated);
            let found = stated.max(found[0]).min(found[1]);
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
    Some(())
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

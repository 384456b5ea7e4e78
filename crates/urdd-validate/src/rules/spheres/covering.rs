use crate::reference::spheres::budget::Budget;
use crate::reference::spheres::cells::{Outside, uncovered};
use crate::reference::spheres::link_pieces::balls;
use crate::reference::spheres::solid::Solid;
use crate::rules::prelude::*;

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
    phase Statistics, needs [
        ModuleV1(Kind::LinkShapesSpheres), Module(Kind::ConvexDecompositionMeshes), PIECES_LISTED, OWN_FILES, CONVEX_PIECE,
        Passed(SPH001), Passed(SPH002), Passed(SPH003), Passed(SPH004),
    ], check do_not_cover,
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
    let budget = Budget::new(context.deep);
    let covering = module.levels.iter().enumerate().filter(|(_, level)| level.covers);
    let covering: Vec<_> = covering.collect();
    let judge = |(link, piece): (usize, usize)| {
        let Some(mesh) = context.solids().sound(kind, link, piece) else { return Ok(Vec::new()) };
        let Some(solid) = Solid::new(mesh) else { return Ok(Vec::new()) };
        let tolerance = SPHERES_COVER * urdd_geometry::farthest::of_mesh(mesh);
        let in_levels = covering.iter().map(|(place, level)| {
            let found = uncovered(&solid, &balls(level, link), tolerance, &budget)?;
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

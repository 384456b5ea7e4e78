use crate::rules::prelude::*;
use urdd_format::link_shapes_spheres::{
    SPHERES_MAX_IN_LEVEL, SPHERES_MAX_LEVELS, SPHERES_MAX_SAMPLES, SphereLevel,
};

declare_rule! {
    /// There are more levels, spheres or samples than there may be, or none.
    ///
    /// Spheres are worth having where they are fewer and faster than what they stand for. Without levels or samples, the
    /// module says nothing.
    ///
    /// Write 1 to 16 levels of at most 65,536 spheres each, and take their pairs and counts from 1 to 100,000 samples.
    SPH001 "sphere-levels-out-of-range", Error, clause "8.9.2", since "1.4.0",
    phase References, needs [ModuleV1(Kind::LinkShapesSpheres)], check out_of_range,

    /// The lists of a level do not fit the links: they are not one for each link, a link without a piece has spheres, one with
    /// a piece has not exactly one in the first level, or there is a fit without spheres, or the reverse.
    ///
    /// A program that looks up the spheres of a link finds none, or those of another link.
    ///
    /// Make the module again, from the pieces as they are now: `urdd generate --modules all,link_shapes_spheres`.
    SPH002 "sphere-lists-wrong", Error, clause "8.9.2", since "1.4.0",
    phase References, needs [
        ModuleV1(Kind::LinkShapesSpheres), Module(Kind::Urdf), Module(Kind::ConvexDecompositionMeshes), PIECES_LISTED,
    ], check lists_wrong,

    /// The radius of a sphere is 0 or negative.
    ///
    /// Such a sphere stands for nothing, and a distance from it is too large.
    ///
    /// Leave the sphere out, or give it a radius.
    SPH003 "sphere-radius-not-positive", Error, clause "8.9.2", since "1.4.0",
    phase References, needs [ModuleV1(Kind::LinkShapesSpheres)], check radius_not_positive,
}

fn out_of_range(context: &Context, findings: &mut Findings) -> Option<()> {
    let spheres = document!(context, LinkShapesSpheres)?;
    let mut judge = |pointer: String, what: &str, least: usize, most: usize, actual: usize| {
        if !(least..=most).contains(&actual) {
            let message = format!("the number of {what} is out of range");
            finding_in(Kind::LinkShapesSpheres, pointer, message)
                .counts(format!("{least} to {most}"), actual, what)
                .report(findings);
        }
    };
    let levels = &spheres.levels;
    judge("/levels".to_owned(), "levels", 1, SPHERES_MAX_LEVELS, levels.len());
    for (place, level) in levels.iter().enumerate() {
        let count = level.spheres.iter().map(Vec::len).sum();
        let pointer = format!("/levels/{place}/spheres");
        judge(pointer, "spheres", 0, SPHERES_MAX_IN_LEVEL, count);
    }
    let (samples, most) = (spheres.num_samples.0 as usize, SPHERES_MAX_SAMPLES as usize);
    judge("/num_samples".to_owned(), "samples", 1, most, samples);
    Some(())
}

fn lists_wrong(context: &Context, findings: &mut Findings) -> Option<()> {
    let spheres = document!(context, LinkShapesSpheres)?;
    let num_links = context.robot()?.links.len();
    let pieces = context.meshes(Kind::ConvexDecompositionMeshes)?;
    let pieces: Vec<usize> = (0..num_links).map(|link| pieces.count(link)).collect();
    for (place, level) in spheres.levels.iter().enumerate() {
        let lists = [("spheres", level.spheres.len()), ("fits", level.fits.len())];
        match wrong_lengths(&lists, num_links) {
            None => lists_of(context, findings, place, level, &pieces),
            Some(wrong) => {
                let message = format!(
                    "a level has one entry for each of the {num_links} links, but {}",
                    wrong.in_words
                );
                let pointer = format!("/levels/{place}{}", wrong.pointer);
                finding_in(Kind::LinkShapesSpheres, pointer, message)
                    .counts(num_links, wrong.length, "entries")
                    .report(findings);
            }
        }
    }
    Some(())
}

/// The lists of a level that are as long as they should be.
fn lists_of(
    context: &Context,
    findings: &mut Findings,
    place: usize,
    level: &SphereLevel,
    pieces: &[usize],
) {
    for (link, (spheres, pieces)) in level.spheres.iter().zip(pieces).enumerate() {
        let expected = match (pieces, place) {
            (0, _) => Some(0),
            (_, 0) => Some(1),
            _ => None,
        };
        if let Some(expected) = expected.filter(|expected| *expected != spheres.len()) {
            let what = if expected == 0 { "without a piece" } else { "with a piece" };
            let message = format!(
                "{}, a link {what}, has {expected} spheres in this level",
                context.link_label(link)
            );
            let pointer = format!("/levels/{place}/spheres/{link}");
            finding_in(Kind::LinkShapesSpheres, pointer, message)
                .counts(expected, spheres.len(), "spheres")
                .report(findings);
        }
    }
    for (link, (spheres, fit)) in level.spheres.iter().zip(&level.fits).enumerate() {
        if spheres.is_empty() == fit.is_some() {
            let message = format!(
                "the fit is null exactly for a link without spheres; {} has {}",
                context.link_label(link),
                spheres.len()
            );
            let pointer = format!("/levels/{place}/fits/{link}");
            let expected = if spheres.is_empty() { "null" } else { "a fit" };
            finding_in(Kind::LinkShapesSpheres, pointer, message)
                .expected(expected)
                .report(findings);
        }
    }
}

fn radius_not_positive(context: &Context, findings: &mut Findings) -> Option<()> {
    let spheres = document!(context, LinkShapesSpheres)?;
    let mut fold = Fold::new(findings);
    for (level, of) in spheres.levels.iter().enumerate() {
        for (link, spheres) in of.spheres.iter().enumerate() {
            for (place, sphere) in spheres.iter().enumerate().filter(|(_, one)| one.radius <= 0.0) {
                fold.add(|| {
                    let pointer = format!("/levels/{level}/spheres/{link}/{place}/radius");
                    finding_in(Kind::LinkShapesSpheres, pointer, "a radius is positive")
                        .values("more than 0", sphere.radius)
                });
            }
        }
    }
    Some(())
}

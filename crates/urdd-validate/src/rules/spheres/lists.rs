use crate::rules::prelude::*;
use urdd_format::link_shapes_spheres::{
    LinkSphere, SPHERES_MAX_IN_LEVEL, SPHERES_MAX_LEVELS, SPHERES_MAX_SAMPLES,
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

    /// A sphere is not inside of the one that it names in an outer level, or names none that is there.
    ///
    /// A program asks the outer level first and leaves out what is inside of a sphere that touches nothing. It misses what
    /// sticks out of that sphere.
    ///
    /// The first level is in no other. Each other level names one before it, and each of its spheres a sphere of the same
    /// link there that holds it: the distance of the centres and the inner radius come to no more than the outer radius.
    SPH004 "sphere-not-in-outer", Error, clause "8.9.3", since "1.4.0",
    phase References, needs [ModuleV1(Kind::LinkShapesSpheres), Passed(SPH002), Passed(SPH003)], check not_in_outer,
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
        if let Some(wrong) = wrong_lengths(&lists, num_links) {
            let message = format!(
                "a level has one entry for each of the {num_links} links, but {}",
                wrong.in_words
            );
            let pointer = format!("/levels/{place}{}", wrong.pointer);
            finding_in(Kind::LinkShapesSpheres, pointer, message)
                .counts(num_links, wrong.length, "entries")
                .report(findings);
            continue;
        }
        for (link, (spheres, pieces)) in level.spheres.iter().zip(&pieces).enumerate() {
            let (expected, what) = match (pieces, place) {
                (0, _) => (0, "without a piece"),
                (_, 0) => (1, "with a piece"),
                _ => continue,
            };
            if expected != spheres.len() {
                let label = context.link_label(link);
                let message =
                    format!("{label}, a link {what}, has {expected} spheres in this level");
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
    Some(())
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

fn not_in_outer(context: &Context, findings: &mut Findings) -> Option<()> {
    let module = document!(context, LinkShapesSpheres)?;
    for (place, level) in module.levels.iter().enumerate() {
        let outer = level.outer_level_idx.map(|idx| idx.get());
        let expected = match place {
            0 => "null, since this is the first level".to_owned(),
            _ => format!("a level before this one: an index below {place}"),
        };
        if outer.is_some() == (place == 0) || outer.is_some_and(|outer| outer >= place) {
            let pointer = format!("/levels/{place}/outer_level_idx");
            finding_in(Kind::LinkShapesSpheres, pointer, "this is no level before this one")
                .values(expected, or_null(outer))
                .report(findings);
            continue;
        }
        let outer = outer.and_then(|outer| module.levels.get(outer));
        let mut fold = Fold::new(findings);
        for (link, spheres) in level.spheres.iter().enumerate() {
            let around = outer.and_then(|level| level.spheres.get(link));
            for (at, sphere) in spheres.iter().enumerate() {
                if let Some(fault) = fault(sphere, around.map(Vec::as_slice)) {
                    fold.add(|| fault.finding(context, [place, link, at]));
                }
            }
        }
    }
    Some(())
}

/// What is wrong with the sphere that one names.
enum Fault {
    /// It names this one, which is not there; or should name none.
    Named { expected: String, actual: Option<usize> },
    /// It sticks out of the other by this distance, m, of which so much is allowed.
    SticksOut { by: f64, tolerance: f64 },
}

/// The fault of a sphere; `outer` are those of the link in the outer level, if there is one.
fn fault(sphere: &LinkSphere, outer: Option<&[LinkSphere]>) -> Option<Fault> {
    let named = sphere.outer_sphere_idx.map(|idx| idx.get());
    let Some(outer) = outer else {
        let expected = "null, since this is the first level".to_owned();
        return named.map(|_| Fault::Named { expected, actual: named });
    };
    let Some(around) = named.and_then(|named| outer.get(named)) else {
        let expected = format!("an index below {}", outer.len());
        return Some(Fault::Named { expected, actual: named });
    };
    let apart = Vector3::from(sphere.offset_xyz) - Vector3::from(around.offset_xyz);
    let by = apart.norm() + sphere.radius - around.radius;
    let tolerance = SPHERE_IN_SPHERE * around.radius;
    // NaN, of numbers beyond all sizes, is reported too.
    let holds = by <= tolerance;
    (!holds).then_some(Fault::SticksOut { by, tolerance })
}

impl Fault {
    fn finding(self, context: &Context, [level, link, at]: [usize; 3]) -> Finding {
        let pointer = format!("/levels/{level}/spheres/{link}/{at}/outer_sphere_idx");
        let of = context.link_label(link);
        let finding = |message| finding_in(Kind::LinkShapesSpheres, pointer, message);
        match self {
            Fault::Named { expected, actual } => {
                let message = format!("sphere {at} of {of} names no sphere of an outer level");
                finding(message).values(expected, or_null(actual))
            }
            Fault::SticksOut { by, tolerance } => {
                let out = metres(by);
                let message = format!("sphere {at} of {of} sticks out of its outer one by {out}");
                finding(message)
                    .values("a sphere that holds this one", format!("{out} outside"))
                    .tolerance(tolerance)
                    .off_by(by, "m")
            }
        }
    }
}

use crate::reference::distances::poses::Poses;
use crate::reference::learned::counts::PER_TOLERANCE;
use crate::reference::learned::pairs;
use crate::reference::spheres::budget::Budget;
use crate::reference::spheres::collisions::collisions;
use crate::rules::prelude::*;

declare_rule! {
    /// The counts of a level cannot be: they do not add up to the samples, or are larger than what they count among.
    ///
    /// The rates that follow from them mean nothing.
    ///
    /// Count again: each of the sampled configurations is in collision or free.
    SPH011 "sphere-counts-impossible", Error, clause "8.9.7", since "1.4.0",
    phase References, needs [ModuleV1(Kind::LinkShapesSpheres), Passed(SPH001)], check counts_impossible,

    /// The counts of a level are not those of the sampled configurations.
    ///
    /// By them a person sees how often a check by these spheres is right: which part of the collisions it misses, and how
    /// many free configurations it takes for collisions.
    ///
    /// Count again, with the pieces and skips as they are now, and sampled configurations 2^31 to 2^31 + `num_samples` - 1 of
    /// SPEC 9.3: `urdd generate --modules all,link_shapes_spheres`. Where that takes too much work, the counts are reported
    /// as not verified; `--deep` allows more.
    SPH012 "sphere-counts-differ", Error, clause "8.9.7", since "1.4.0",
    phase Statistics, needs [
        ModuleV1(Kind::LinkShapesSpheres), Module(Kind::ConvexHullMeshes), Module(Kind::ConvexDecompositionMeshes),
        Module(Kind::LinkShapesSkips), POSES_KNOWN, BOUNDS_SOUND, PIECES_LISTED, NoneFailed(&[MSH020, MSH021, MSH022]),
        Passed(SHP005), NoneFailed(&[SHP010, SHP013]), Passed(SPH001), Passed(SPH002), Passed(SPH003), Passed(SPH009),
        Passed(SPH010), Passed(SPH011), NotFailed(SPH008), NoneFailed(&[SPH004, SPH005, SPH006, SPH007]),
    ], check counts_differ,
}

fn counts_impossible(context: &Context, findings: &mut Findings) -> Option<()> {
    let module = document!(context, LinkShapesSpheres)?;
    for (place, level) in module.levels.iter().enumerate() {
        let at = |key: &str| format!("/levels/{place}/evaluation{key}");
        let stated = &level.evaluation;
        let all = u64::from(stated.num_colliding.0) + u64::from(stated.num_free.0);
        if all != u64::from(module.num_samples.0) {
            let message = "`num_colliding` and `num_free` together are not all samples";
            finding_in(Kind::LinkShapesSpheres, at(""), message)
                .values(module.num_samples, all)
                .report(findings);
        }
        for (key, count, what, most) in [
            ("num_missed", stated.num_missed, "num_colliding", stated.num_colliding),
            ("num_false_contacts", stated.num_false_contacts, "num_free", stated.num_free),
        ] {
            if count.0 > most.0 {
                let message = format!("this is more than `{what}`");
                finding_in(Kind::LinkShapesSpheres, at(&format!("/{key}")), message)
                    .values(format!("at most {most}"), count)
                    .report(findings);
            }
        }
    }
    Some(())
}

fn counts_differ(context: &Context, findings: &mut Findings) -> Option<()> {
    let module = document!(context, LinkShapesSpheres)?;
    let levels = findings.or_skip(context.sphere_contacts())?;
    let poses = findings.or_skip(Poses::new(context))?;
    let pieces = findings.or_skip(pairs::pieces(context, context.solids()))?;
    let samples = module.num_samples.0;
    let budget = Budget::new(context.deep);
    let collides = findings.or_skip(collisions(&pieces, &poses, samples, &budget))?;
    for (place, (level, found)) in module.levels.iter().zip(levels).enumerate() {
        let both = || collides.iter().zip(&found.touches);
        let count = |wanted: (bool, bool)| {
            let counted = both().filter(|(collides, touches)| (**collides, **touches) == wanted);
            counted.count() as u32
        };
        let (missed, seen) = (count((true, false)), count((true, true)));
        let (free, alarms) = (count((false, false)) + count((false, true)), count((false, true)));
        let stated = &level.evaluation;
        for (key, stated, found, among) in [
            ("num_colliding", stated.num_colliding, missed + seen, samples),
            ("num_missed", stated.num_missed, missed, missed + seen),
            ("num_free", stated.num_free, free, samples),
            ("num_false_contacts", stated.num_false_contacts, alarms, free),
        ] {
            let tolerance = among.div_ceil(PER_TOLERANCE);
            if found.abs_diff(stated.0) > tolerance {
                let message = "counting these configurations again gives a different number";
                let pointer = format!("/levels/{place}/evaluation/{key}");
                finding_in(Kind::LinkShapesSpheres, pointer, message)
                    .values(found, stated)
                    .tolerance(f64::from(tolerance))
                    .report(findings);
            }
        }
    }
    Some(())
}

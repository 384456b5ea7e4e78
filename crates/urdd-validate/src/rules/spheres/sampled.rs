use super::pairs::indices;
use crate::reference::spheres::contacts::Often;
use crate::rules::prelude::*;

declare_rule! {
    /// Two links are in contact by their spheres in more, or fewer, of the sampled configurations than the lists of a level
    /// say.
    ///
    /// A program leaves out a pair that is never in contact, and one that always is. It then misses contacts, or computes what
    /// tells nothing.
    ///
    /// SPEC 8.9.6 defines the configurations, so the validator computes them again. Where joints, bounds or spheres changed,
    /// do the same: `urdd generate --modules all,link_shapes_spheres`. Poses are golden in `kinematics_samples_module`.
    SPH008 "sphere-pairs-differ", Error, clause "8.9.6", since "1.4.0",
    phase Statistics, needs [
        ModuleV1(Kind::LinkShapesSpheres), Module(Kind::Urdf), POSES_KNOWN, BOUNDS_SOUND, Passed(SPH001), Passed(SPH002),
        Passed(SPH003), Passed(SPH009), NoneFailed(&[SPH004, SPH005, SPH006, SPH007, SPH010]),
    ], check pairs_differ,
}

fn pairs_differ(context: &Context, findings: &mut Findings) -> Option<()> {
    let module = document!(context, LinkShapesSpheres)?;
    let levels = findings.or_skip(context.sphere_contacts())?;
    let named = |links: [usize; 2]| {
        let [a, b] = links.map(|link| context.link_label(link));
        format!("{a} and {b}")
    };
    let mut fold = Fold::new(findings);
    for (place, (stated, found)) in module.levels.iter().zip(levels).enumerate() {
        let always = stated.always_pairs.iter().enumerate();
        let always = always.map(|(at, pair)| (indices(pair), (Often::Always, at)));
        let sometimes = stated.sometimes_pairs.iter().enumerate();
        let sometimes = sometimes.map(|(at, pair)| (indices(pair), (Often::Sometimes, at)));
        let stated: HashMap<[usize; 2], (Often, usize)> = always.chain(sometimes).collect();
        for pair in &found.pairs {
            let (often, at) = stated.get(&pair.links).copied().unwrap_or((Often::Never, 0));
            let [least, most] = pair.often;
            if (least..=most).contains(&often) {
                continue;
            }
            // The tolerance can move a pair by one, or by two.
            let right = if often < least { least } else { most };
            fold.add(|| {
                let message =
                    format!("by their spheres, {} are in contact {right}", named(pair.links));
                let pointer = match often {
                    Often::Always => format!("/levels/{place}/always_pairs/{at}"),
                    Often::Sometimes => format!("/levels/{place}/sometimes_pairs/{at}"),
                    Often::Never if right == Often::Always => {
                        format!("/levels/{place}/always_pairs")
                    }
                    Often::Never => format!("/levels/{place}/sometimes_pairs"),
                };
                finding_in(Kind::LinkShapesSpheres, pointer, message).values(right, often)
            });
        }
    }
    Some(())
}

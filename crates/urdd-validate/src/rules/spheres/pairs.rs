use crate::reference::learned::{self, not_skipped};
use crate::reference::samples::{Budget, Poses};
use crate::reference::spheres::contacts::{Often, collisions};
use crate::rules::learned::results::report_counted_again;
use crate::rules::prelude::*;
use urdd_format::index::Count;
use urdd_format::link_shapes_spheres::SphereLevel;
use urdd_format::self_collision_model::LinkPair;

declare_rule! {
    /// A list of pairs of links is out of order, or names a link without spheres, or a pair twice.
    ///
    /// A program that looks up a pair finds nothing, or two answers.
    ///
    /// Give each pair once, the lower link first, pairs ascending, in `always_pairs` or in `sometimes_pairs`.
    SPH009 "sphere-pairs-disordered", Error, clause "8.9.6", since "1.4.0",
    phase References, needs [ModuleV1(Kind::LinkShapesSpheres), Passed(SPH002)], check pairs_disordered,

    /// A level ignores pairs though it covers, or ignores one that is skipped anyway.
    ///
    /// By a level that covers, programs call configurations free: it may leave out no pair that can collide. Of a pair that
    /// is skipped nothing is asked.
    ///
    /// Take the pair out of `ignored_pairs`. Where the skips changed, make the module again:
    /// `urdd generate --modules all,link_shapes_spheres`.
    SPH010 "sphere-pairs-ignored-wrong", Error, clause "8.9.7", since "1.4.0",
    phase References, needs [
        ModuleV1(Kind::LinkShapesSpheres), Module(Kind::ConvexHullMeshes), Module(Kind::ConvexDecompositionMeshes),
        Module(Kind::LinkShapesSkips), PIECES_LISTED, Passed(SHP005), NoneFailed(&[SHP010, SHP013]), Passed(SPH009),
    ], check ignored_wrong,

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

/// The indices of two links.
fn indices(pair: &LinkPair) -> [usize; 2] {
    [pair.link_a_idx.get(), pair.link_b_idx.get()]
}

fn pairs_disordered(context: &Context, findings: &mut Findings) -> Option<()> {
    let module = document!(context, LinkShapesSpheres)?;
    for (place, level) in module.levels.iter().enumerate() {
        if let Some((pointer, message, expected)) = disorder(level) {
            finding_in(Kind::LinkShapesSpheres, format!("/levels/{place}/{pointer}"), message)
                .expected(expected)
                .report(findings);
        }
    }
    Some(())
}

/// The first fault of the lists of pairs of a level: where, what, and what is expected.
fn disorder(level: &SphereLevel) -> Option<(String, &'static str, String)> {
    let lists = [
        ("ignored_pairs", &level.ignored_pairs),
        ("always_pairs", &level.always_pairs),
        ("sometimes_pairs", &level.sometimes_pairs),
    ];
    for (key, list) in lists {
        for (place, pair) in list.iter().enumerate() {
            let indices = indices(pair);
            for (end, link) in ["link_a_idx", "link_b_idx"].into_iter().zip(indices) {
                if level.spheres.get(link).is_none_or(Vec::is_empty) {
                    let message = "there is no such link with spheres in this level";
                    let expected = "the index of a link with spheres".to_owned();
                    return Some((format!("{key}/{place}/{end}"), message, expected));
                }
            }
            let expected = match place.checked_sub(1).and_then(|before| list.get(before)) {
                _ if indices[0] >= indices[1] => "the lower link comes first",
                Some(before) if self::indices(before) >= indices => "ascending pairs, each once",
                _ => continue,
            };
            let message = "this pair is out of order";
            return Some((format!("{key}/{place}"), message, expected.to_owned()));
        }
    }
    let always: HashSet<[usize; 2]> = level.always_pairs.iter().map(indices).collect();
    let twice = level.sometimes_pairs.iter().position(|pair| always.contains(&indices(pair)))?;
    let expected = "each pair in one of the two lists".to_owned();
    Some((format!("sometimes_pairs/{twice}"), "this pair is also in `always_pairs`", expected))
}

fn ignored_wrong(context: &Context, findings: &mut Findings) -> Option<()> {
    let module = document!(context, LinkShapesSpheres)?;
    let asked: HashSet<[usize; 2]> = not_skipped(context)?.into_iter().collect();
    let mut fold = Fold::new(findings);
    for (level, of) in module.levels.iter().enumerate() {
        for (place, pair) in of.ignored_pairs.iter().enumerate() {
            let [a, b] = indices(pair).map(|link| context.link_label(link));
            let (message, expected) = match () {
                () if of.covers => (format!("a level that covers ignores {a} and {b}"), "no pairs"),
                () if !asked.contains(&indices(pair)) => {
                    (format!("{a} and {b} are skipped anyway"), "pairs that are not skipped")
                }
                () => continue,
            };
            fold.add(|| {
                let pointer = format!("/levels/{level}/ignored_pairs/{place}");
                finding_in(Kind::LinkShapesSpheres, pointer, message).expected(expected)
            });
        }
    }
    Some(())
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
    let pieces = findings.or_skip(learned::pieces(context, context.solids()))?;
    let samples = module.num_samples.0;
    let budget = Budget::of_spheres(context.deep);
    let collides = findings.or_skip(collisions(&pieces, &poses, samples, &budget))?;
    for (place, (level, found)) in module.levels.iter().zip(levels).enumerate() {
        // Least and most, by what is undecided.
        let touching = |collided: bool| {
            let both = || collides.iter().zip(&found.touches).filter(|(of, _)| **of == collided);
            let [least, most] = [0, 1].map(|kind| both().filter(|(_, touch)| touch[kind]).count());
            [least as u32, most as u32, both().count() as u32]
        };
        let ([least, most, colliding], [alarms, most_alarms, free]) =
            (touching(true), touching(false));
        let stated = &level.evaluation;
        for (key, stated, found, among) in [
            ("num_colliding", stated.num_colliding, [colliding; 2], samples),
            ("num_missed", stated.num_missed, [colliding - most, colliding - least], colliding),
            ("num_free", stated.num_free, [free; 2], samples),
            ("num_false_contacts", stated.num_false_contacts, [alarms, most_alarms], free),
        ] {
            let found = stated.0.clamp(found[0], found[1]);
            let pointer = format!("/levels/{place}/evaluation/{key}");
            let both = [stated, Count(found)];
            report_counted_again(Kind::LinkShapesSpheres, pointer, both, among, findings);
        }
    }
    Some(())
}

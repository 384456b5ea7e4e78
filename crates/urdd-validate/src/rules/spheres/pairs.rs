use crate::reference::learned::pairs::not_skipped;
use crate::rules::prelude::*;
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
}

/// The indices of two links.
pub(super) fn indices(pair: &LinkPair) -> [usize; 2] {
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

//! `link_shapes_simple_skips_module`, SPEC 8.6, and `link_shapes_skips_module`, SPEC 8.7. And what checks for self-collision do
//! not see: pairs of links that are skipped because they touch in one configuration, and that are apart in others.

use std::collections::{BTreeMap, HashSet};
use std::sync::Arc;

use rayon::prelude::*;

use super::statistics::{Shapes, distances_at, sampled_motion};
use crate::context::Context;
use crate::error::Result;
use crate::made::{self, Shared, streamed};
use urdd_format::link_shapes_distance_statistics::{
    DistanceStatistics, LinkShapesDistanceStatisticsModule,
};
use urdd_format::link_shapes_simple_skips::{
    CONTACT, LinkShapesSimpleSkipsModule as SimpleSkips, SeenPair, SkipReason, SkipReasons,
};
use urdd_format::link_shapes_skips::{LinkShapesSkipsModule as Skips, SkipEdit};
use urdd_format::short::Short;
use urdd_format::skips::{HiddenContacts, TouchesIn, skips_module};
use urdd_geometry::convex::pair_distances;
use urdd_source::note::{Note, NoteKind};

type Reasons = Vec<Vec<SkipReason>>;

pub(crate) fn simple_skips(
    context: &Context,
    shapes: &Shapes,
    statistics: &LinkShapesDistanceStatisticsModule,
) -> Shared<SimpleSkips> {
    let name = "the default configuration";
    let default = distances_at(context, shapes, name, &context.space.default_configuration())?;
    let joined: HashSet<[usize; 2]> = context
        .chain
        .joints_in_chain
        .iter()
        .map(|joint| [joint.parent_link_idx.get(), joint.child_link_idx.get()])
        .collect();
    let full: Vec<usize> = statistics.full_shapes.iter().map(|l| l.get()).collect();
    let pieces: Vec<usize> =
        statistics.decomposition_shapes.iter().map(|piece| piece.link_idx.get()).collect();
    let of_full =
        |kind: usize, of: &DistanceStatistics| reasons(&full, of, &default[kind], &joined);
    let of_pieces = |kind: usize, of: &Option<DistanceStatistics>| {
        let both = of.as_ref().zip(default.get(kind));
        both.map(|(of, default)| reasons(&pieces, of, default, &joined))
    };
    let reasons = SkipReasons {
        full_convex_hulls: of_full(0, &statistics.full_convex_hulls),
        full_obbs: of_full(1, &statistics.full_obbs),
        full_bounding_spheres: of_full(2, &statistics.full_bounding_spheres),
        decomposition_convex_hulls: of_pieces(3, &statistics.decomposition_convex_hulls),
        decomposition_obbs: of_pieces(4, &statistics.decomposition_obbs),
        decomposition_bounding_spheres: of_pieces(5, &statistics.decomposition_bounding_spheres),
    };
    let of_pieces = |reasons: &Option<Reasons>| reasons.as_ref().map(skips);
    let module = Arc::new(SimpleSkips {
        full_shapes: statistics.full_shapes.clone(),
        decomposition_shapes: statistics.decomposition_shapes.clone(),
        full_convex_hulls_simple_skips: skips(&reasons.full_convex_hulls),
        full_obbs_simple_skips: skips(&reasons.full_obbs),
        full_bounding_spheres_simple_skips: skips(&reasons.full_bounding_spheres),
        decomposition_convex_hulls_simple_skips: of_pieces(&reasons.decomposition_convex_hulls),
        decomposition_obbs_simple_skips: of_pieces(&reasons.decomposition_obbs),
        decomposition_bounding_spheres_simple_skips: of_pieces(
            &reasons.decomposition_bounding_spheres,
        ),
        reasons,
    });
    streamed(made::simple_skips(&module), module)
}

/// The reason of each pair. `links[i]` is the link of shape i.
fn reasons(
    links: &[usize],
    statistics: &DistanceStatistics,
    default: &[Vec<f64>],
    joined: &HashSet<[usize; 2]>,
) -> Reasons {
    let reason = |i: usize, j: usize| {
        let (a, b) = (links[i], links[j]);
        let seen = SeenPair {
            is_same_link: a == b,
            is_joined: joined.contains(&[a, b]) || joined.contains(&[b, a]),
            range: [statistics.min_distances[i][j], statistics.max_distances[i][j]],
            at_default: default[i][j],
        };
        seen.reason()
    };
    let all = 0..links.len();
    all.clone().map(|i| all.clone().map(|j| reason(i, j)).collect()).collect()
}

fn skips(reasons: &Reasons) -> Vec<Vec<bool>> {
    reasons.iter().map(|row| row.iter().map(|reason| reason.is_simple()).collect()).collect()
}

/// Maximum number of pairs of links that a note names.
const MOST_NAMED: usize = 5;

/// Two links, the lower index first.
type Links = [usize; 2];

/// The reasons of the shapes that decide, those of pieces where the robot has them, and the link of each shape.
fn deciding(simple: &SimpleSkips) -> (&[Vec<SkipReason>], Vec<usize>) {
    match &simple.reasons.decomposition_convex_hulls {
        Some(rows) => {
            (rows, simple.decomposition_shapes.iter().map(|one| one.link_idx.get()).collect())
        }
        None => (
            &simple.reasons.full_convex_hulls,
            simple.full_shapes.iter().map(|link| link.get()).collect(),
        ),
    }
}

/// The pairs of shapes of which `wanted` returns something, by links: the first of what it returned, and the pairs.
fn pairs<T>(
    simple: &SimpleSkips,
    wanted: impl Fn(Links, SkipReason, (usize, usize)) -> Option<T>,
) -> BTreeMap<Links, (T, Vec<(usize, usize)>)> {
    let (reasons, links) = deciding(simple);
    let mut found: BTreeMap<Links, (T, Vec<_>)> = BTreeMap::new();
    for (i, row) in reasons.iter().enumerate() {
        for (j, reason) in row.iter().enumerate().skip(i + 1) {
            let both = [links[i].min(links[j]), links[i].max(links[j])];
            if let Some(why) = wanted(both, *reason, (i, j)) {
                found.entry(both).or_insert_with(|| (why, Vec::new())).1.push((i, j));
            }
        }
    }
    found
}

/// The edits by which pairs of links that touch in the reference configuration are skipped; none without one.
fn of_reference<'a>(
    context: &Context,
    shapes: impl FnOnce() -> Result<&'a Shapes>,
    simple: &SimpleSkips,
) -> Result<Vec<SkipEdit>> {
    let Some(reference) = &context.reference else { return Ok(Vec::new()) };
    let name = format!("the reference configuration `{}`", reference.name.as_str());
    let shapes = shapes()?;
    let kind = shapes.deciding_kind();
    let distances = distances_at(context, shapes, &name, &reference.configuration)?;
    let touches = |(i, j): (usize, usize)| {
        let row = distances.get(kind).and_then(|rows| rows.get(i));
        row.and_then(|row| row.get(j)).is_some_and(|distance| *distance <= CONTACT)
    };
    let found =
        pairs(simple, |_, reason, both| (reason.can_collide() && touches(both)).then_some(()));
    let link = |at: usize| context.chain.links_in_chain[at].name.as_str();
    let edit = |[a, b]: &Links| SkipEdit::of_reference(reference.name.as_str(), link(*a), link(*b));
    Ok(found.keys().map(edit).collect())
}

/// Builds the module. Edits that follow from the reference configuration come first, then those of a person.
pub(crate) fn edited_skips<'a>(
    context: &Context,
    shapes: impl FnOnce() -> Result<&'a Shapes>,
    simple: &SimpleSkips,
) -> Shared<Skips> {
    let by_reference = of_reference(context, shapes, simple)?;
    let links = context.chain.links_in_chain.iter();
    let names: Vec<&str> = links.map(|link| link.name.as_str()).collect();
    let edits = [by_reference, context.edits.kept.clone()].concat();
    let module = Arc::new(skips_module(simple, context.skipped_reasons(), edits, &names));
    let mut made = streamed(made::skips(&module), module)?;
    let lost = context.edits.lost.iter().map(|edit| {
        let problem = format!(
            "the previous URDD has an edit of the skips between `{}` and `{}`, but the robot no longer has both links",
            edit.link_a, edit.link_b
        );
        context.note(NoteKind::LeftOut, problem, "the edit is left out")
    });
    made.notes.extend(lost);
    Ok(made)
}

/// Notes about the pairs of links that are skipped because they touch in the default configuration, or in the reference.
pub(crate) fn notes<'a>(
    context: &Context,
    shapes: impl FnOnce() -> Result<&'a Shapes>,
    simple: &SimpleSkips,
    skips: &Skips,
) -> Result<Vec<Note>> {
    let names = context.chain.links_in_chain.iter().map(|link| link.name.as_str());
    let always = pairs(simple, |_, reason, _| (reason == SkipReason::Always).then_some(()));
    let contacts = HiddenContacts::new(&skips.edits, names, always.into_keys());
    let matrix = skips.decomposition_convex_hulls_skips.as_ref();
    let matrix = matrix.unwrap_or(&skips.full_convex_hulls_skips);
    let is_skipped = |i: usize, j: usize| matrix.get(i).and_then(|row| row.get(j)) == Some(&true);
    let hidden =
        pairs(simple, |links, reason, (i, j)| contacts.touches_in(links, reason, is_skipped(i, j)));
    if hidden.is_empty() {
        return Ok(Vec::new());
    }
    let shapes = shapes()?.deciding();
    let motion = sampled_motion(context)?;
    let mut counted: Vec<(usize, Links, TouchesIn)> = hidden
        .into_par_iter()
        .map(|(links, (place, of_links))| {
            let mut touches = vec![false; motion.num_samples()];
            for (i, j) in of_links {
                let distances = pair_distances(&shapes[i], &shapes[j], &motion).unwrap_or_default();
                for (touches, distance) in touches.iter_mut().zip(distances) {
                    *touches |= distance <= 0.0;
                }
            }
            (touches.into_iter().filter(|touches| *touches).count(), links, place)
        })
        .collect();
    context.settings.source.cancellation.check()?;
    // Links that touch in all samples are as those that always do.
    counted.retain(|(touching, ..)| *touching < motion.num_samples());
    // The most collisions first.
    counted.sort_by_key(|(touching, links, _)| (std::cmp::Reverse(*touching), *links));
    let mut places: Vec<TouchesIn> = Vec::new();
    for (.., place) in &counted {
        if !places.contains(place) {
            places.push(*place);
        }
    }
    let of_place = |place: &TouchesIn| {
        let these: Vec<(usize, Links)> = (counted.iter())
            .filter(|(.., of)| of == place)
            .map(|(touching, links, _)| (*touching, *links))
            .collect();
        note(context, *place, &these, motion.num_samples())
    };
    Ok(places.iter().map(of_place).collect())
}

/// The note about pairs that are skipped for one configuration, most contacts first.
fn note(context: &Context, place: TouchesIn, pairs: &[(usize, Links)], samples: usize) -> Note {
    let place = match place {
        TouchesIn::Reference(name) => format!("reference configuration `{}`", Short::of(name)),
        TouchesIn::Default => "default configuration".to_owned(),
    };
    let pair = |(touching, links): &(usize, Links)| {
        let [a, b] = links.map(|link| Short::of(&context.chain.links_in_chain[link].name));
        let share = 100.0 * *touching as f64 / samples as f64;
        format!("`{a}` and `{b}` {share:.1} %")
    };
    let named = if pairs.len() <= MOST_NAMED + 1 { pairs.len() } else { MOST_NAMED };
    let mut list: Vec<String> = pairs.iter().take(named).map(pair).collect();
    if let Some((most, _)) = pairs.get(named) {
        let share = 100.0 * *most as f64 / samples as f64;
        list.push(format!("{} more at most {share:.1} % each", pairs.len() - named));
    }
    let (number, list) = (pairs.len(), list.join(", "));
    let [what, them, they] = match number {
        1 => ["pair of links touches", "it", "it touches"],
        _ => ["pairs of links touch", "them", "they touch"],
    };
    let problem = format!(
        "{number} {what} in the {place}, so collision checks skip {them}; share of {samples} sampled configurations in which {they}: {list}"
    );
    let assumed = "these collisions count as free; to check a pair, add an edit with `\"skip\": false`, or choose another reference configuration by `--reference`";
    context.note(NoteKind::SkippedContact, problem, assumed)
}

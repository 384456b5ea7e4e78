//! Builds the matrices of `link_shapes_skips_module` (SPEC 8.7), an allowed collision matrix per
//! kind of shape, from the reasons of the pairs, the skipped reasons and manual edits.
//!
//! The generator and editors of URDDs write the module with this code. The validator does not use
//! it; it checks each pair independently.

use std::collections::{HashMap, HashSet};

use crate::link_shapes_simple_skips::{LinkShapesSimpleSkipsModule, SkipReason};
use crate::link_shapes_skips::{LinkShapesSkipsModule, SkipEdit, SkippedReason};

/// The reasons of all pairs of one kind of shape.
type Reasons = Vec<Vec<SkipReason>>;
/// Whether each pair is skipped.
type Skips = Vec<Vec<bool>>;

/// Builds the module. `link_names` are the names of the robot's links in link order. An edit that
/// names an unknown link has no effect.
pub fn skips_module(
    simple: &LinkShapesSimpleSkipsModule,
    skipped_reasons: Vec<SkippedReason>,
    edits: Vec<SkipEdit>,
    link_names: &[&str],
) -> LinkShapesSkipsModule {
    let full = simple.full_shapes.iter().map(|link| link.get());
    let full = ShapesOfLinks::new(full, link_names);
    let pieces = simple.decomposition_shapes.iter();
    let pieces = ShapesOfLinks::new(pieces.map(|piece| piece.link_idx.get()), link_names);
    let of_full = |reasons: &Reasons| skips(reasons, &full, &skipped_reasons, &edits);
    let of_pieces = |reasons: &Option<Reasons>| {
        let reasons = reasons.as_ref();
        reasons.map(|reasons| skips(reasons, &pieces, &skipped_reasons, &edits))
    };
    let reasons = &simple.reasons;
    LinkShapesSkipsModule {
        full_shapes: simple.full_shapes.clone(),
        decomposition_shapes: simple.decomposition_shapes.clone(),
        full_convex_hulls_skips: of_full(&reasons.full_convex_hulls),
        full_obbs_skips: of_full(&reasons.full_obbs),
        full_bounding_spheres_skips: of_full(&reasons.full_bounding_spheres),
        decomposition_convex_hulls_skips: of_pieces(&reasons.decomposition_convex_hulls),
        decomposition_obbs_skips: of_pieces(&reasons.decomposition_obbs),
        decomposition_bounding_spheres_skips: of_pieces(&reasons.decomposition_bounding_spheres),
        skipped_reasons,
        edits,
    }
}

/// The pairs of links that are skipped because they touch in one configuration, whatever others do: contact of these is a
/// collision that no check sees.
pub struct HiddenContacts {
    by_reference: HashMap<[usize; 2], String>,
    /// Pairs that a person decided on, and pairs of which some shapes always touch.
    left_out: HashSet<[usize; 2]>,
}

/// The configuration in which two links touch, so that they are skipped.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum TouchesIn<'a> {
    /// The default configuration.
    Default,
    /// The reference configuration of this name.
    Reference(&'a str),
}

impl HiddenContacts {
    /// `link_names` are the names of the robot's links in link order. `always` are the links, the lower index first, of
    /// which some shapes always touch.
    pub fn new<'a>(
        edits: &[SkipEdit],
        link_names: impl Iterator<Item = &'a str>,
        always: impl Iterator<Item = [usize; 2]>,
    ) -> Self {
        let mut indices: HashMap<&str, usize> = HashMap::new();
        for (at, name) in link_names.enumerate() {
            indices.entry(name).or_insert(at);
        }
        let mut hidden = Self { by_reference: HashMap::new(), left_out: always.collect() };
        for edit in edits {
            let links = [&edit.link_a, &edit.link_b].map(|name| indices.get(name.as_str()));
            let [Some(&a), Some(&b)] = links else {
                continue;
            };
            let links = [a.min(b), a.max(b)];
            match edit.reference() {
                Some(name) => drop(hidden.by_reference.insert(links, name.to_owned())),
                None => drop(hidden.left_out.insert(links)),
            }
        }
        hidden
    }

    /// Where a pair of shapes of two links, the lower index first, touches, if it is skipped for that; `None` for one that
    /// is not skipped, that a person decided on, or that never is apart.
    pub fn touches_in(
        &self,
        links: [usize; 2],
        reason: SkipReason,
        is_skipped: bool,
    ) -> Option<TouchesIn<'_>> {
        if !is_skipped || !reason.can_collide() || self.left_out.contains(&links) {
            return None;
        }
        match self.by_reference.get(&links) {
            Some(name) => Some(TouchesIn::Reference(name)),
            None => (reason == SkipReason::Default).then_some(TouchesIn::Default),
        }
    }
}

/// Indices of the shapes of each link that has any, by link name.
struct ShapesOfLinks<'a>(HashMap<&'a str, Vec<usize>>);

impl<'a> ShapesOfLinks<'a> {
    fn new(links: impl Iterator<Item = usize>, names: &[&'a str]) -> Self {
        let mut shapes: HashMap<&str, Vec<usize>> = HashMap::new();
        for (shape, link) in links.enumerate() {
            if let Some(name) = names.get(link) {
                shapes.entry(name).or_default().push(shape);
            }
        }
        ShapesOfLinks(shapes)
    }

    fn of(&self, link: &str) -> &[usize] {
        self.0.get(link).map_or(&[], Vec::as_slice)
    }
}

/// The matrix of one kind of shape.
fn skips(
    reasons: &Reasons,
    shapes: &ShapesOfLinks,
    skipped: &[SkippedReason],
    edits: &[SkipEdit],
) -> Skips {
    let is_skipped =
        |reason: &SkipReason| skipped.iter().any(|skipped| skipped.of_pair() == *reason);
    let rows = reasons.iter().enumerate().map(|(i, row)| {
        let row = row.iter().enumerate();
        row.map(|(j, reason)| i == j || is_skipped(reason)).collect()
    });
    let mut skips: Skips = rows.collect();
    let mut set = |i: usize, j: usize, skip: bool| {
        if i != j
            && let Some(element) = skips.get_mut(i).and_then(|row| row.get_mut(j))
        {
            *element = skip;
        }
    };
    for edit in edits {
        for &i in shapes.of(&edit.link_a) {
            for &j in shapes.of(&edit.link_b) {
                set(i, j, edit.skip);
                set(j, i, edit.skip);
            }
        }
    }
    skips
}

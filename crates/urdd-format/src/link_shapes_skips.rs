//! `link_shapes_simple_skips_module`: pairs that need no collision check, found by sampling. `link_shapes_skips_module`: the
//! pairs to skip, by reason and by manual edits.
//!
//! Builds the matrices of `link_shapes_skips_module` (SPEC 8.7), an allowed collision matrix per
//! kind of shape, from the reasons of the pairs, the skipped reasons and manual edits.
//!
//! The generator and editors of URDDs write the module with this code. The validator does not use
//! it; it checks each pair independently.

use std::collections::{HashMap, HashSet};
use std::str::FromStr;

use crate::index::LinkIdx;
use crate::link_shapes_approximations::PieceShape;
use crate::types::module;
use crate::word::{UnknownWord, with_word};

module! {
    /// For each pair of shapes, whether the two are always in contact, so that checking them for
    /// collision says nothing, and the reason of the pair.
    pub struct LinkShapesSimpleSkipsModule {
        /// What index i of a `full_…` matrix stands for: the links that have a shape, ascending.
        pub full_shapes: Vec<LinkIdx> where { length: "full_shapes" },
        /// What index i of a `decomposition_…` matrix stands for: links ascending, pieces in order.
        pub decomposition_shapes: Vec<PieceShape> where { length: "decomposition_shapes" },
        /// Skips between the links' convex hulls: true where both shapes are on one link, or where
        /// the largest sampled distance is at most 0.001 m.
        pub full_convex_hulls_simple_skips: Vec<Vec<bool>> where { square: "full_shapes" },
        /// Skips between the links' boxes.
        pub full_obbs_simple_skips: Vec<Vec<bool>> where { square: "full_shapes" },
        /// Skips between the links' spheres.
        pub full_bounding_spheres_simple_skips: Vec<Vec<bool>> where { square: "full_shapes" },
        /// Skips between convex pieces; null where the statistics are.
        pub decomposition_convex_hulls_simple_skips: Option<Vec<Vec<bool>>> where { square: "decomposition_shapes" },
        /// Skips between the boxes of convex pieces; null where the statistics are.
        pub decomposition_obbs_simple_skips: Option<Vec<Vec<bool>>> where { square: "decomposition_shapes" },
        /// Skips between the spheres of convex pieces; null where the statistics are.
        pub decomposition_bounding_spheres_simple_skips: Option<Vec<Vec<bool>>> where { square: "decomposition_shapes" },
        /// The reason of each pair, for each of the matrices above.
        pub reasons: SkipReasons,
    }

    /// The reason of each pair, for each kind of shape.
    pub struct SkipReasons {
        /// Between the links' convex hulls.
        pub full_convex_hulls: Vec<Vec<SkipReason>> where { square: "full_shapes" },
        /// Between the links' boxes.
        pub full_obbs: Vec<Vec<SkipReason>> where { square: "full_shapes" },
        /// Between the links' spheres.
        pub full_bounding_spheres: Vec<Vec<SkipReason>> where { square: "full_shapes" },
        /// Between convex pieces; null where the statistics are.
        pub decomposition_convex_hulls: Option<Vec<Vec<SkipReason>>> where { square: "decomposition_shapes" },
        /// Between the boxes of convex pieces; null where the statistics are.
        pub decomposition_obbs: Option<Vec<Vec<SkipReason>>> where { square: "decomposition_shapes" },
        /// Between the spheres of convex pieces; null where the statistics are.
        pub decomposition_bounding_spheres: Option<Vec<Vec<SkipReason>>> where { square: "decomposition_shapes" },
    }

    /// The reason of a pair of shapes: the first of these that applies.
    pub enum SkipReason {
        /// Both shapes are on one link. A simple skip.
        SameLink,
        /// The largest sampled distance is at most 0.001 m: always in contact. A simple skip.
        Always,
        /// A joint connects the two links. Not a simple skip.
        Adjacent,
        /// The distance in the default configuration is at most 0.001 m: in contact when the robot
        /// stands still at zero. Not a simple skip.
        Default,
        /// The smallest sampled distance is more than 0.001 m: never in contact, as far as the samples
        /// show. Not a simple skip.
        Never,
        /// None of these: in contact in some of the sampled configurations and not in others.
        None,
    }
}

/// Shapes are in contact if their distance is at most this, metres (SPEC 8.6).
pub const CONTACT: f64 = 0.001;

/// What decides the reason of a pair of shapes.
pub struct SeenPair {
    /// Both shapes are on one link.
    pub is_same_link: bool,
    /// A joint connects the two links.
    pub is_joined: bool,
    /// The smallest and the largest sampled distance, metres.
    pub range: [f64; 2],
    /// The distance in the default configuration, metres.
    pub at_default: f64,
}

impl SeenPair {
    /// The reason: the first that applies.
    pub fn reason(&self) -> SkipReason {
        let [least, most] = self.range;
        if self.is_same_link {
            SkipReason::SameLink
        } else if most <= CONTACT {
            SkipReason::Always
        } else if self.is_joined {
            SkipReason::Adjacent
        } else if self.at_default <= CONTACT {
            SkipReason::Default
        } else if least > CONTACT {
            SkipReason::Never
        } else {
            SkipReason::None
        }
    }
}

impl SkipReason {
    /// Whether a pair with this reason is a simple skip.
    pub fn is_simple(self) -> bool {
        matches!(self, SkipReason::SameLink | SkipReason::Always)
    }

    /// Whether the pair is apart in some configuration and is no neighbour: its contact is a collision.
    pub fn can_collide(self) -> bool {
        matches!(self, SkipReason::Default | SkipReason::Never | SkipReason::None)
    }
}

module! {
    /// The pairs of shapes that a collision check skips: those with one of the skipped reasons, and
    /// then a person's edits, applied in order.
    pub struct LinkShapesSkipsModule {
        /// The reasons of `link_shapes_simple_skips_module` for which a pair is skipped, each once, in
        /// the order of the specification.
        pub skipped_reasons: Vec<SkippedReason>,
        /// The edits, applied in order. What a person decides is free; the names must exist.
        pub edits: Vec<SkipEdit>,
        /// What index i of a `full_…` matrix stands for: the links that have a shape, ascending.
        pub full_shapes: Vec<LinkIdx> where { length: "full_shapes" },
        /// What index i of a `decomposition_…` matrix stands for: links ascending, pieces in order.
        pub decomposition_shapes: Vec<PieceShape> where { length: "decomposition_shapes" },
        /// Skips between the links' convex hulls.
        pub full_convex_hulls_skips: Vec<Vec<bool>> where { square: "full_shapes" },
        /// Skips between the links' boxes.
        pub full_obbs_skips: Vec<Vec<bool>> where { square: "full_shapes" },
        /// Skips between the links' spheres.
        pub full_bounding_spheres_skips: Vec<Vec<bool>> where { square: "full_shapes" },
        /// Skips between convex pieces; null where the statistics are.
        pub decomposition_convex_hulls_skips: Option<Vec<Vec<bool>>> where { square: "decomposition_shapes" },
        /// Skips between the boxes of convex pieces; null where the statistics are.
        pub decomposition_obbs_skips: Option<Vec<Vec<bool>>> where { square: "decomposition_shapes" },
        /// Skips between the spheres of convex pieces; null where the statistics are.
        pub decomposition_bounding_spheres_skips: Option<Vec<Vec<bool>>> where { square: "decomposition_shapes" },
    }

    /// A person's decision on a pair of links, for all their shapes of every kind.
    pub struct SkipEdit {
        /// Name of one link.
        pub link_a: String,
        /// Name of the other link; may be the same.
        pub link_b: String,
        /// Whether checks between the two are skipped.
        pub skip: bool,
        /// Why.
        pub reason: String,
    }

    /// A reason of `link_shapes_simple_skips_module` for which pairs can be skipped: all but `None`.
    pub enum SkippedReason {
        /// Both shapes are on one link.
        SameLink,
        /// Always in contact, as far as the samples show.
        Always,
        /// A joint connects the two links.
        Adjacent,
        /// In contact in the default configuration.
        Default,
        /// Never in contact, as far as the samples show: the number of samples is `num_samples` of
        /// `link_shapes_distance_statistics_module`.
        Never,
    }
}

/// Begins the reason of an edit that skips a pair because it touches in a reference configuration.
const IN_REFERENCE: &str = "in contact in the reference configuration ";

impl SkipEdit {
    /// The edit that skips two links because they touch in the configuration `reference`.
    pub fn of_reference(reference: &str, link_a: &str, link_b: &str) -> Self {
        let reason = format!("{IN_REFERENCE}`{reference}`");
        SkipEdit { link_a: link_a.to_owned(), link_b: link_b.to_owned(), skip: true, reason }
    }

    /// The reference configuration in which the two touch, if this is why the edit skips them.
    pub fn reference(&self) -> Option<&str> {
        let name = self.reason.strip_prefix(IN_REFERENCE).filter(|_| self.skip)?;
        name.strip_prefix('`')?.strip_suffix('`')
    }
}

impl SkippedReason {
    /// The reasons skipped by default.
    pub const USUAL: &[SkippedReason] = &[
        SkippedReason::SameLink,
        SkippedReason::Always,
        SkippedReason::Adjacent,
        SkippedReason::Default,
    ];

    /// Its word for users.
    fn word(self) -> &'static str {
        match self {
            SkippedReason::SameLink => "same-link",
            SkippedReason::Always => "always",
            SkippedReason::Adjacent => "adjacent",
            SkippedReason::Default => "default",
            SkippedReason::Never => "never",
        }
    }

    /// The pair reason that corresponds to this skipped reason.
    pub fn of_pair(self) -> SkipReason {
        match self {
            SkippedReason::SameLink => SkipReason::SameLink,
            SkippedReason::Always => SkipReason::Always,
            SkippedReason::Adjacent => SkipReason::Adjacent,
            SkippedReason::Default => SkipReason::Default,
            SkippedReason::Never => SkipReason::Never,
        }
    }
}

impl FromStr for SkippedReason {
    type Err = UnknownWord;

    fn from_str(word: &str) -> Result<SkippedReason, UnknownWord> {
        with_word(word, SkippedReason::ALL, SkippedReason::word, "is no reason")
    }
}

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

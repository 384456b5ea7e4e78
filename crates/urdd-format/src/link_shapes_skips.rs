//! `link_shapes_skips_module`: the pairs to skip, by reason and by manual edits.

use std::str::FromStr;

use super::index::LinkIdx;
use super::link_shapes_simple_skips::SkipReason;
use super::shapes::PieceShape;
use super::types::module;
use super::word::{UnknownWord, with_word};

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

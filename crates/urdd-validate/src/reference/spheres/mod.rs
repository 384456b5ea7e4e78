//! Spheres that stand for links, judged by SPEC 8.9 alone: whether they cover the pieces ([`cells`]), how far they are from
//! these ([`fit`]), which of them touch in sampled configurations, and how often that is right ([`contacts`]). Shares nothing
//! with the making of spheres; poses and contacts of pieces are those of the other rules.

pub mod cells;
pub mod contacts;
pub mod fit;
pub mod link_pieces;
pub mod polyhedron;
pub mod solid;

use super::budget::Budget;
use crate::skip;

/// Operations by default: about 10 seconds of one core.
const DEFAULT: u64 = 10_000_000_000;
/// The same with `--deep`: some minutes.
const DEEP: u64 = 400_000_000_000;

/// The work of a rule about spheres. `deep` allows more.
pub fn budget(deep: bool) -> Budget {
    Budget::of(if deep { DEEP } else { DEFAULT }, skip::spheres_take_too_long(deep))
}

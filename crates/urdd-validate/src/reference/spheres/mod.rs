//! Spheres that stand for links, judged by SPEC 8.9 alone: whether they cover the pieces ([`cells`]), how far they are from
//! these ([`fit`]), which of them touch in sampled configurations ([`contacts`]), and how often that is right
//! ([`collisions`]). Shares nothing with the making of spheres; poses and contacts of pieces are those of the other rules.

pub mod budget;
pub mod cells;
pub mod collisions;
pub mod contacts;
pub mod fit;
pub mod link_pieces;
pub mod polyhedron;
pub mod solid;

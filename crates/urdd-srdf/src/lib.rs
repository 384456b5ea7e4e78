//! SRDF, MoveIt's Semantic Robot Description Format: its words, reading, merging and writing, without a robot. What a URDD
//! takes of an SRDF is in `urdd-export`, and what is wrong with one beside a URDF in `urdd-lint`.

mod merge;
mod read;
pub mod vocabulary;
pub mod write;

pub use merge::{MergedSrdf, merge_srdf};
pub use read::{LeftOut, ReadError, Srdf, elements};

//! Crate files: versions 0.4 to 0.13.
//!
//! A file has a table of sections: tokens, strings (as tokens), fields (a name and where its value is), sets of fields,
//! paths as a tree, and specs (a path, a set of fields, a kind). Values are anywhere in the file; those that are equal may
//! be one. Older versions, from before 2017, are refused.

mod cursor;
mod lists;
mod packed;
mod path_tree;
mod paths;
mod sections;
mod specs;
mod values;

pub use specs::read;

/// The first bytes of a crate file.
pub const START: &[u8] = b"PXR-USDC";

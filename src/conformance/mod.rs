//! The conformance suite: its data, which a release build carries, and what is done with it.
//!
//! `conformance/README.md` describes the data. A [`case::Case`] is a base with some changes, and
//! becomes a [`tree::Tree`], which is written to disk to be examined.

mod archive;
pub mod case;
pub mod catalogue;
pub mod change;
pub mod data;
pub mod export;
pub mod judge;
pub mod process;
pub mod producer;
pub mod seal;
pub mod skips;
pub mod suite;
pub mod tree;
pub mod valid;
pub mod validator;
pub mod workplace;

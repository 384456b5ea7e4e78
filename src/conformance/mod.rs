//! The conformance suite: its data, embedded in release builds, and its commands.
//!
//! `conformance/README.md` describes the data. A [`case::Case`] is a base with changes. It becomes a [`tree::Tree`],
//! which is written to disk for validation.

mod archive;
pub mod case;
pub mod catalogue;
pub mod change;
pub mod data;
pub mod examined;
pub mod export;
pub mod judge;
pub mod printed_codes;
pub mod process;
pub mod producer;
pub mod refused;
pub mod run_error;
pub mod seal;
pub mod skips;
pub mod suite;
pub mod tally;
pub mod tree;
pub mod valid;
pub mod validator;
pub mod workplace;

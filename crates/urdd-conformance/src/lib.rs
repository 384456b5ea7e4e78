//! Internal to urdd; no stability promise.
//!
//! The conformance suite: its cases, and what runs a producer or a validator on them (`urdd conformance`).
//!
//! The caller brings the suite's files ([`data::Data`]); `conformance/README.md` describes them. A [`suite::Case`] is a
//! base with changes. It becomes a [`tree::Tree`], which is written to disk for validation.

mod archive;
mod batch;
pub mod change;
pub mod data;
pub mod export;
mod looped;
pub mod process;
pub mod producer;
pub mod profile;
pub mod refused;
pub mod running;
mod score;
pub mod suite;
pub mod tree;
pub mod validator;

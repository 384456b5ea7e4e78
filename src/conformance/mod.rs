//! The conformance suite: its data, which the program carries, and what is done with it.
//!
//! `conformance/README.md` describes the data.

pub mod data;
pub mod export;
pub mod kill_rate;

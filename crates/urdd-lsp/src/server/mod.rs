//! Receives an editor's messages, and keeps the open documents.

mod analyses;
mod documents;
mod handshake;
mod requests;
mod serve;
mod state;

pub(crate) use serve::run;
pub use state::Ended;

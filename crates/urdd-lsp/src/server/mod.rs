//! Receives an editor's messages, and keeps the open documents.

mod analyses;
mod documents;
mod ended;
mod handshake;
mod open_document;
mod requests;
mod serve;
mod state;

pub use ended::Ended;
pub(crate) use serve::run;

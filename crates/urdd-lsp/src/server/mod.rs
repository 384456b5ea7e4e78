//! Receives an editor's messages, and keeps the open documents.

mod documents;
mod requests;
mod serve;
mod state;

pub(crate) use serve::run;
pub use state::Ended;

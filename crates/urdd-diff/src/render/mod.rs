//! A comparison as text for people, and as Markdown for a pull request.

mod content;
mod markdown;
mod text;

pub use markdown::markdown;
pub use text::text;

//! The elements of an XML text that may be half typed. No text is refused: what is missing ends where the next thing
//! begins.

mod element;
mod place;
mod scan;
mod tree;

pub use place::Place;
pub use tree::{Markup, escaped, unescaped};

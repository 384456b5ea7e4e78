//! The elements of an XML text that may be half typed. No text is refused: what is missing ends where the next thing
//! begins.

mod element;
#[doc(hidden)]
pub mod place;
mod scan;
#[doc(hidden)]
pub mod tree;

pub use element::Attribute;
pub use place::Place;
pub use tree::{Markup, escaped, unescaped};

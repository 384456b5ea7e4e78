//! The elements of an XML text that may be half typed. No text is refused: what is missing ends where the next thing
//! begins.

#[doc(hidden)]
pub mod place;
mod scan;
#[doc(hidden)]
pub mod tree;

pub use place::Place;
pub use scan::Attribute;
pub use tree::{Markup, escaped, unescaped};

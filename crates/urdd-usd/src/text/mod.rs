//! Text layers: `#usda 1.0`.

mod lexer;
mod metadata;
mod reader;
mod values;

pub use reader::read;

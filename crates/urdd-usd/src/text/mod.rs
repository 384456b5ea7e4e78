//! Text layers: `#usda 1.0`.

mod lexer;
mod metadata;
mod reader;
mod values;
mod words;

pub use reader::read;

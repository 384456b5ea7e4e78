//! Data that several rules use: schemas of extensions and what their annotations say, names, shapes and pairs of shapes.

pub mod annotated;
pub mod enclosure;
pub mod extension_schema;
pub mod judged;
pub mod lists;
mod pattern;
pub mod schema_work;
pub mod shared_meshes;
pub mod tangled;

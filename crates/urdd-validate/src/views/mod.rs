//! Data that several rules use: schemas of extensions and what their annotations say, names, shapes and pairs of shapes.

pub mod annotated;
pub mod counts;
pub mod enclosure;
pub mod extension_schema;
pub mod judged;
pub mod list_lengths;
pub mod repeated;
pub mod schema_parts;
pub mod schema_work;
pub mod shape_pair;
pub mod shared_meshes;
pub mod tangled;

//! What several rules look at or compute: texts, schemas of extensions, shapes and their pairs.

pub mod enclosure;
pub mod extension_schema;
pub mod judged;
pub mod schema_work;
pub mod shape_pair;
pub mod shared_meshes;
pub mod tangled;
pub mod text_faults;

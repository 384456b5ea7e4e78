//! Modules as rules look at them, whatever their version: one shape for version 1 and legacy.
//! Where a field has the same name in both, its pointer is the same too.

pub mod bounds;
pub mod chain;
pub mod connections;
pub mod consumer;
pub mod dofs;
pub mod enclosure;
pub mod entries;
pub mod extension_schema;
pub mod freedom;
pub mod mesh_files;
pub mod meshes;
pub mod mimics;
pub mod paths;
pub mod rigid_groups;
pub mod robot;
pub mod schema_work;
pub mod shape_matrices;
pub mod shape_pair;
pub mod shapes;
pub mod shared_meshes;
pub mod tangled;
pub mod text_faults;
pub mod tree;
pub mod usable_geometry;

pub use bounds::Bounds;
pub use chain::Chain;
pub use connections::Connections;
pub use dofs::Dofs;
pub use meshes::Meshes;

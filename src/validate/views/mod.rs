//! Modules as rules look at them, whatever their version: one shape for version 1 and legacy.
//! Where a field has the same name in both, its pointer is the same too.

pub mod bounds;
pub mod chain;
pub mod connections;
pub mod consumer;
pub mod dofs;
pub mod freedom;
pub mod mimics;
pub mod rigid_groups;
pub mod robot;
pub mod tree;

pub use bounds::Bounds;
pub use chain::Chain;
pub use connections::Connections;
pub use dofs::Dofs;

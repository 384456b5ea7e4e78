//! CON: `connections_module`.
//!
//! Every table is compared with the tree that follows from `urdf_module`, in time proportional to
//! what is written in it: the table of lowest common ancestors is made row by row, and paths are
//! walked without being made.

mod connection_table_size;
pub mod explicit_paths_missing;
mod paths;
pub mod walk;

use crate::rule::rules;

rules! {
    connection_table_size, explicit_paths_missing, paths
}

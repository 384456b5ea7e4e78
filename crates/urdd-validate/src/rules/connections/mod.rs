//! CON: `connections_module`.
//!
//! Every table is compared with the tree that follows from `urdf_module`, in time proportional to
//! what is written in it: the table of lowest common ancestors is made row by row, and paths are
//! walked without being made.

mod common_ancestor_wrong;
mod connection_table_size;
mod descendant_path_wrong;
pub mod explicit_paths_missing;
mod link_to_link_path_wrong;
mod root_path_wrong;
pub mod walk;

use crate::rule::rules;

rules! {
    common_ancestor_wrong, connection_table_size, descendant_path_wrong, explicit_paths_missing,
    link_to_link_path_wrong, root_path_wrong
}

//! CON: `connections_module`.
//!
//! Every table is compared with the tree that follows from `urdf_module`, in time proportional to
//! what is written in it: the table of lowest common ancestors is made row by row, and paths are
//! walked without being made.

pub mod paths;
pub mod tables;

use crate::rule::rules;

rules! {
    paths, tables
}

//! SHP: the link shape modules, on their own and compared with meshes and kinematics.

pub mod fit;
mod lists;
mod matrices;
mod reaches;
mod reasons;
mod sampled;
mod skips;
mod statistics;

use crate::rule::rules;

rules! {
    matrices, fit, lists, reaches, reasons, sampled, skips, statistics
}

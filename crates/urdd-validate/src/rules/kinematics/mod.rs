//! KIN: poses.

mod poses;
pub mod samples;

use crate::rule::rules;

rules! {
    poses, samples
}

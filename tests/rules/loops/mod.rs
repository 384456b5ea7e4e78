//! Robots with kinematic loops. Their closed configurations follow from closed forms.

mod linkage;
mod made;
mod planar;
mod spatial;

use testkit::fixture::Fixture;

/// The bases with loops that cases change, by their names. The base `loops` is the computed case's that made it.
pub fn shared() -> Vec<(&'static str, fn() -> Fixture)> {
    vec![
        ("loops_ankle", spatial::ankle),
        ("loops_delta", spatial::delta),
        ("loops_five_bar", planar::five_bar),
        ("loops_free", linkage::free),
        ("loops_gripper", planar::gripper),
        ("loops_wheels", planar::wheels),
    ]
}

pub use linkage::{free, linkage};

//! Robots with kinematic loops. Their closed configurations follow from closed forms.

mod linkage;
mod made;
mod mixed;
mod planar;
mod spatial;

use testkit::fixture::Fixture;

/// A name, and how the base is built.
type Base = (&'static str, fn() -> Fixture);

/// The bases with loops that cases change, by their names. The base `loops` is the computed case's that made it.
pub fn shared() -> Vec<Base> {
    vec![
        ("loops_ankle", spatial::ankle),
        ("loops_ball", mixed::ball),
        ("loops_delta", spatial::delta),
        ("loops_far", mixed::far),
        ("loops_five_bar", planar::five_bar),
        ("loops_free", linkage::free),
        ("loops_gripper", planar::gripper),
        ("loops_mimics", mixed::mimics),
        ("loops_mixed", mixed::mixed),
        ("loops_wheels", planar::wheels),
    ]
}

pub use linkage::{free, linkage};

//! Kinematic loops (SPEC 6.8): how far they are from closed, the Jacobian of what they hold, which DOFs move freely, and the
//! nearest closed configuration.

mod close;
mod equations;
mod independent;
mod model;
mod rows;
mod stacked;
mod velocities;

pub use close::{Closing, NotClosed, Scratch};
pub use equations::{FirstOpen, Gap};
pub use independent::Mobility;
pub use model::Loops;
pub(crate) use stacked::Linearised;
pub use velocities::VelocityScratch;

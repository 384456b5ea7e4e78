//! Kinematic loops (SPEC 6.8): how far they are from closed, the Jacobian of what they hold, which DOFs move freely, and the
//! nearest closed configuration.

mod close;
mod equations;
mod independent;
mod model;

pub(crate) use close::solve_cholesky;
pub use close::{NotClosed, Scratch};
pub use equations::{FirstOpen, Gap};
pub use independent::{Mobility, VelocityScratch};
pub use model::Loops;

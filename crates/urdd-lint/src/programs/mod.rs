//! What programs do with a URDF: their readers are asked, and what they say becomes findings and a line a program.

mod asked;
mod attach;
mod faults;
mod fixes;
mod meshes;
mod seen;

pub use asked::Asked;
pub use attach::{attach, attach_to};
pub use faults::Left;

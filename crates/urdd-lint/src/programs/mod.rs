//! What programs do with a URDF: their readers are asked, and what they say becomes findings and a line a program.

mod answers;
mod asked;
mod attach;
mod faults;
mod fixes;
mod left;
mod meshes;
mod places;
mod seen;
mod severity;
mod words;

pub use asked::Asked;
pub use attach::{attach, attach_all};
pub use left::Left;

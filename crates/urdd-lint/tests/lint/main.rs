//! Each rule has a URDF that only it finds a fault in, and one that is nearly the same and has none.

mod cases;

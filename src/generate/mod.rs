//! The reference generator: a URDF becomes a URDD, each module a pure function of those before it.
//!
//! It imports nothing from `validate`, nor the other way about: both are written from SPEC.md.

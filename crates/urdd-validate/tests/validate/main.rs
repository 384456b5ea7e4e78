//! The validator as a library: valid robots, random faults, documents that only match their schemas, figures from other
//! implementations.

// A test may stop anywhere.
#![allow(clippy::restriction)]

mod core_rules_random;
mod corpus;
mod extension_schema;
mod kinematics_figures;
mod no_crash;
mod reference;
mod shape_rules_random;
mod soundness;
mod undeclared_need;
mod urdf_text;

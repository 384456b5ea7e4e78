//! The learned self-collision model, evaluated and counted again from SPEC 8.8. Shares nothing with training and use of
//! models except the distances of shapes.

pub mod counts;
pub mod network;
pub mod pairs;

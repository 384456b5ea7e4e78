//! The learned self-collision model, evaluated again from SPEC 8.8, and counted again. Nothing of it is shared with
//! those who train and use models but the distances of shapes.

pub mod counts;
pub mod network;
pub mod pairs;

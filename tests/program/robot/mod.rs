//! `urdd check-collisions` as a process. Its crate's tests say what a robot answers.

mod command;
mod skipped;

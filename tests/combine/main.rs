//! `urdd::combine`: robots that are put together, held to their parts.

#[path = "../support/dice.rs"]
mod dice;
#[path = "../support/program.rs"]
mod program;
#[path = "../support/robots.rs"]
#[allow(dead_code)] // Not every file of tests needs all.
mod robots;

mod bad_input;
mod command;
mod elements;
mod legacy;
mod making;
mod property;
mod published;
mod strangers;
mod support;

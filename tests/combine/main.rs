//! `urdd::combine`: robots that are put together, held to their parts.

mod bad_input;
mod command;
mod elements;
mod making;
mod support;

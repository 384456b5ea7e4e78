//! `urdd_generate::combine`: robots that are put together, held to their parts.

mod bad_input;
mod command;
mod elements;
mod legacy;
mod making;
mod property;
mod published;
mod strangers;
mod support;

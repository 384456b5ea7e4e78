//! `urdd_generate::combine`: composed robots, compared with their parts.

mod bad_input;
mod command;
mod configurations;
mod elements;
mod legacy;
mod making;
mod property;
mod published;
mod strangers;
mod support;

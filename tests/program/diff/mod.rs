//! `urdd diff` as a process. Its crate's tests say what differs.

mod bad_input;
mod command;
#[cfg(unix)]
mod expanded;
#[cfg(unix)]
mod folders;

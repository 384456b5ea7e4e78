//! `urdd view` as a process.

mod comparing;
mod exporting;
mod serving;

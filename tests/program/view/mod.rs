//! `urdd view` as a process.

mod exporting;
mod serving;

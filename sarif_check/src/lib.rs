//! Nothing: see `tests/sarif.rs`.

//! Spheres of links, compared with closed forms.

// A test may stop anywhere.
#![allow(clippy::restriction, clippy::disallowed_methods)]

mod cover_cell;
mod cover_filled;
mod figures;
mod judge;
mod levels;
mod surface;

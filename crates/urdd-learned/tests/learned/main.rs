//! The network's functions and the choice of margins, compared with closed forms.

// A test may stop anywhere.
#![allow(clippy::restriction, clippy::disallowed_methods)]

mod calibration;
mod network;

//! Internal to urdd; no stability promise. What is promised is the header, `include/urdd.h`, by its ABI number.
//!
//! The C interface of `urdd-robot` and `urdd-validate`: opaque handles, a status from every function, and arrays that
//! the caller owns. A function is named as the Rust method, with `urdd_` and the type in front. The head of the header
//! has the rules for ownership, threads and errors.
//!
//! The head also has the contract of pointers, which is that of every unsafe function here: its callers keep it, and the
//! functions hand their pointers on to `memory`, which says what they must be. So `unsafe` in the other files
//! needs no comment.

#![allow(clippy::missing_safety_doc, reason = "the contract is in the head of the header, once")]

mod bodies;
mod checks;
mod collision_model;
mod failure;
mod inverse;
mod kinematics;
mod loops;
mod memory;
mod names;
mod obstacle;
mod planning;
mod proximity;
mod queries;
mod robot;
mod space;
mod spheres;
mod validate;
mod world;

use std::sync::LazyLock;

use urdd_format::registry::PROGRAM_VERSION;

use failure::Owned;

pub use bodies::*;
pub use checks::*;
pub use collision_model::*;
pub use failure::*;
pub use inverse::*;
pub use kinematics::*;
pub use loops::*;
pub use names::*;
pub use obstacle::*;
pub use planning::*;
pub use proximity::*;
pub use robot::*;
pub use space::*;
pub use spheres::*;
pub use validate::*;
pub use world::*;

/// The ABI number of this header. A library with another one must not be used with it: `urdd_abi_version` gives that of
/// the library.
pub const URDD_ABI_VERSION: u32 = 1;

/// The ABI number of the library.
#[unsafe(no_mangle)]
pub extern "C" fn urdd_abi_version() -> u32 {
    URDD_ABI_VERSION
}

/// The version of the library, such as "1.4.0". It lives as long as the library.
#[unsafe(no_mangle)]
pub extern "C" fn urdd_version() -> Text {
    VERSION.text()
}

static VERSION: LazyLock<Owned> = LazyLock::new(|| Owned::new(PROGRAM_VERSION));

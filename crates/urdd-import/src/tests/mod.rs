//! The tests of this crate.

// A test may stop anywhere.
#![allow(clippy::restriction, clippy::disallowed_methods)]

mod bounds;
mod bounds_loops;
mod bounds_of_places;
mod bounds_usd;
mod gate;
mod mjcf;
mod mjcf_faults;
mod mjcf_meaning;
mod mjcf_seen;
mod run;
mod sdf;
mod usd;
mod usd_mujoco;
mod usd_shapes;

use urdd_directory::account::{Account, Charged};

/// The entries of a list, of which a test knows that they are few.
pub trait Entries<T> {
    fn all(&self) -> &[T];

    fn iter(&self) -> std::slice::Iter<'_, T> {
        self.all().iter()
    }
}

impl<T> Entries<T> for Charged<T> {
    fn all(&self) -> &[T] {
        self.walk(&Account::default()).unwrap().as_slice()
    }
}

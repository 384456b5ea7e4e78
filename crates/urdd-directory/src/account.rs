//! What may be made of what was read.
//!
//! Whoever reads a stranger's file keeps an [`Account`]: each file that is read adds to it, and whatever is made of it
//! (elements, names, pairs, vertices, text) is charged, in bytes of memory. So an answer takes at most
//! [`MULTIPLE`] times what was read and [`ALLOWANCE`] bytes, whatever a small file asks for. Work without a result,
//! such as reading the same file again, is charged too, a byte for some nanoseconds: time has the same bound.

use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};

use thiserror::Error;

/// Bytes that may be made of any input.
pub const ALLOWANCE: u64 = 128 << 20;

/// Bytes that may be made of each byte that was read. Ordinary descriptions use a tenth.
pub const MULTIPLE: u64 = 100;

/// The account of one run on one description. Clones share it.
#[derive(Debug, Clone, Default)]
pub struct Account(Arc<Sums>);

#[derive(Debug, Default)]
struct Sums {
    read: AtomicU64,
    spent: AtomicU64,
}

/// More would be made than [`Account`] allows.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Error)]
#[error(
    "more would be made of the description than {MULTIPLE} times its size and {} MiB; shorten what is repeated: names, replicas, configurations, or uses of one file", ALLOWANCE >> 20
)]
pub struct Overdrawn;

impl Account {
    /// Adds a file that was read, by its size in bytes. A file that is read twice is added once.
    pub fn deposit(&self, bytes: usize) {
        add(&self.0.read, bytes);
    }

    /// Charges what is about to be made, in bytes.
    ///
    /// # Errors
    /// If the account does not have them. They are not to be made then.
    pub fn charge(&self, bytes: usize) -> Result<(), Overdrawn> {
        let spent = add(&self.0.spent, bytes);
        let most = self.0.read.load(Ordering::Relaxed).saturating_mul(MULTIPLE);
        if spent > most.saturating_add(ALLOWANCE) { Err(Overdrawn) } else { Ok(()) }
    }
}

/// The new sum, which never wraps.
fn add(sum: &AtomicU64, bytes: usize) -> u64 {
    let added = |sum: u64| sum.saturating_add(bytes as u64);
    let old = sum.fetch_update(Ordering::Relaxed, Ordering::Relaxed, |sum| Some(added(sum)));
    added(old.unwrap_or_else(|sum| sum))
}

/// A list whose entries were charged: there is no other way to add one.
#[derive(Debug, Clone, PartialEq)]
pub struct Charged<T>(Vec<T>);

/// The bytes of an entry, with its texts, as they are charged.
pub trait Cost {
    /// In bytes.
    fn cost(&self) -> usize;
}

impl<T> Default for Charged<T> {
    fn default() -> Self {
        Charged(Vec::new())
    }
}

impl<T: Cost> Charged<T> {
    /// Adds an entry, if the account has its cost.
    ///
    /// # Errors
    /// If it does not.
    pub fn push(&mut self, entry: T, account: &Account) -> Result<(), Overdrawn> {
        account.charge(entry.cost())?;
        self.0.push(entry);
        Ok(())
    }
}

impl<T> std::ops::Deref for Charged<T> {
    type Target = [T];
    fn deref(&self) -> &[T] {
        &self.0
    }
}

impl<T> std::ops::DerefMut for Charged<T> {
    fn deref_mut(&mut self) -> &mut [T] {
        &mut self.0
    }
}

impl<'a, T> IntoIterator for &'a Charged<T> {
    type Item = &'a T;
    type IntoIter = std::slice::Iter<'a, T>;
    fn into_iter(self) -> Self::IntoIter {
        self.0.iter()
    }
}

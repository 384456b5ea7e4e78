//! The account of one run on one description: what may be made of what was read, and how much may be done with it.
//!
//! Whoever reads a stranger's file keeps an [`Account`]. Each file that is read adds to it. Whatever is made of it
//! (elements, names, pairs, vertices, text) is charged in bytes of memory, and whatever is done with it (a search by name,
//! a walk of a list, a value that is taken again) in steps of some nanoseconds. Both are one sum: an answer takes at most
//! [`MULTIPLE`] times what was read and [`ALLOWANCE`] bytes, and about as many steps, whatever a small file asks for. A
//! charge also asks whether the run was cancelled, so whatever is charged can be stopped.
//!
//! Types make a charge hard to forget. Entries of [`Charged`] lists are charged when they are added, and once more for each
//! walk of the list: only an index is free. What prims of USD inherit (`Authored` of `urdd-usd`) is charged each time that it
//! is taken. None of them gives its content to anyone without an account.

use std::ops::{Index, IndexMut};
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};

use thiserror::Error;

use crate::cancellation::{Cancellation, Cancelled};
use crate::limits::{ALLOWANCE, MULTIPLE};

/// The account of one run on one description. Clones share it. By default, the run is never cancelled.
#[derive(Debug, Clone, Default)]
pub struct Account {
    sums: Arc<Sums>,
    cancellation: Cancellation,
}

#[derive(Debug, Default)]
struct Sums {
    read: AtomicU64,
    spent: AtomicU64,
}

/// Why a charge is refused.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Error)]
pub enum AccountError {
    /// The account does not have it.
    #[error(transparent)]
    Overdrawn(#[from] Overdrawn),
    /// The run was cancelled.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}

/// More would be made of a description, or done with it, than an [`Account`] allows.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Error)]
#[error(
    "the description needs more memory or work than {MULTIPLE} times its size and {} MiB; shorten what is repeated: names, replicas, configurations, references, or uses of one file", ALLOWANCE >> 20
)]
pub struct Overdrawn;

impl Account {
    /// An account of a run that can be cancelled.
    pub fn new(cancellation: &Cancellation) -> Self {
        Account { sums: Arc::default(), cancellation: cancellation.clone() }
    }

    /// Adds a file that was read, by its size in bytes. A file that is read twice is added once.
    pub fn deposit(&self, bytes: usize) {
        add(&self.sums.read, bytes);
    }

    /// Charges what is about to be made, in bytes, or done, in steps.
    ///
    /// # Errors
    /// If the account does not have it, or the run was cancelled. It is not to be made or done then.
    pub fn charge(&self, cost: usize) -> Result<(), AccountError> {
        self.cancellation.check()?;
        let spent = add(&self.sums.spent, cost);
        let most = self.sums.read.load(Ordering::Relaxed).saturating_mul(MULTIPLE);
        if spent > most.saturating_add(ALLOWANCE) { Err(Overdrawn.into()) } else { Ok(()) }
    }

    /// The cancellation of the run.
    pub fn cancellation(&self) -> &Cancellation {
        &self.cancellation
    }
}

/// The new sum, which never wraps.
fn add(sum: &AtomicU64, cost: usize) -> u64 {
    let added = |sum: u64| sum.saturating_add(cost as u64);
    let old = sum.fetch_update(Ordering::Relaxed, Ordering::Relaxed, |sum| Some(added(sum)));
    added(old.unwrap_or_else(|sum| sum))
}

/// What an entry or a value costs.
pub trait Cost {
    /// In bytes, with its texts: what it takes to make it, and about the steps to go through it.
    fn cost(&self) -> usize;
}

/// A list of a description. Its entries are charged when they are added, and the list whenever it is walked.
#[derive(Debug, Clone, PartialEq)]
pub struct Charged<T>(Vec<T>);

impl<T> Default for Charged<T> {
    fn default() -> Self {
        Charged(Vec::new())
    }
}

impl<T: Cost> Charged<T> {
    /// Adds an entry.
    ///
    /// # Errors
    /// If the account does not have its cost.
    pub fn push(&mut self, entry: T, account: &Account) -> Result<(), AccountError> {
        account.charge(entry.cost())?;
        self.0.push(entry);
        Ok(())
    }
}

impl<T> Charged<T> {
    /// All entries, a step each.
    ///
    /// # Errors
    /// If the account does not have these steps.
    pub fn walk(&self, account: &Account) -> Result<std::slice::Iter<'_, T>, AccountError> {
        account.charge(self.0.len())?;
        Ok(self.0.iter())
    }

    /// As [`Charged::walk`], to change them.
    ///
    /// # Errors
    /// If the account does not have these steps.
    pub fn walk_mut(
        &mut self,
        account: &Account,
    ) -> Result<std::slice::IterMut<'_, T>, AccountError> {
        account.charge(self.0.len())?;
        Ok(self.0.iter_mut())
    }

    /// The entry at an index.
    pub fn get(&self, index: usize) -> Option<&T> {
        self.0.get(index)
    }

    /// The entry at an index, to change it.
    pub fn get_mut(&mut self, index: usize) -> Option<&mut T> {
        self.0.get_mut(index)
    }

    /// The last entry.
    pub fn last(&self) -> Option<&T> {
        self.0.last()
    }

    /// The last entry, to change it.
    pub fn last_mut(&mut self) -> Option<&mut T> {
        self.0.last_mut()
    }

    /// The number of entries.
    pub fn len(&self) -> usize {
        self.0.len()
    }

    /// Whether there is no entry.
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }
}

impl<T> Index<usize> for Charged<T> {
    type Output = T;
    fn index(&self, index: usize) -> &T {
        &self.0[index]
    }
}

impl<T> IndexMut<usize> for Charged<T> {
    fn index_mut(&mut self, index: usize) -> &mut T {
        &mut self.0[index]
    }
}

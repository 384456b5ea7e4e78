//! Unique names for what has none.

use std::collections::{HashMap, HashSet};

use urdd_directory::account::{Account, Overdrawn};

/// What a name costs beside its bytes.
const NAME: usize = 100;
/// Copies of a name until it is in a model: here, in a list and in a table.
const COPIES: usize = 4;

/// The names that are taken. Each is charged: names that are made of others may grow.
#[derive(Debug)]
pub struct Names {
    account: Account,
    taken: HashSet<String>,
    /// The last number that was tried, by name.
    last: HashMap<String, usize>,
}

impl Names {
    /// None is taken.
    pub fn new(account: &Account) -> Self {
        Names { account: account.clone(), taken: HashSet::new(), last: HashMap::new() }
    }

    /// Takes a name; `false` if it was taken.
    ///
    /// # Errors
    /// If the account does not have its cost.
    pub fn take(&mut self, name: &str) -> Result<bool, Overdrawn> {
        self.account.charge(NAME + COPIES * name.len())?;
        Ok(self.taken.insert(name.to_owned()))
    }

    /// The first free of `wanted`, `wanted_2`, `wanted_3` and so on.
    ///
    /// # Errors
    /// If the account does not have its cost.
    pub fn free(&mut self, wanted: &str) -> Result<String, Overdrawn> {
        let mut name = wanted.to_owned();
        while !self.take(&name)? {
            let number = self.last.entry(wanted.to_owned()).or_insert(1);
            *number += 1;
            name = format!("{wanted}_{number}");
        }
        Ok(name)
    }
}

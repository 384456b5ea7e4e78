//! Unique names for what has none.

use std::collections::{HashMap, HashSet};

/// The names that are taken.
#[derive(Debug, Default)]
pub struct Names {
    taken: HashSet<String>,
    /// The last number that was tried, by name.
    last: HashMap<String, usize>,
}

impl Names {
    /// Takes a name; `false` if it was taken.
    pub fn take(&mut self, name: &str) -> bool {
        self.taken.insert(name.to_owned())
    }

    /// The first free of `wanted`, `wanted_2`, `wanted_3` and so on.
    pub fn free(&mut self, wanted: &str) -> String {
        let mut name = wanted.to_owned();
        while !self.take(&name) {
            let number = self.last.entry(wanted.to_owned()).or_insert(1);
            *number += 1;
            name = format!("{wanted}_{number}");
        }
        name
    }
}

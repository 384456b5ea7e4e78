//! The results, by module and by field.

use std::collections::BTreeMap;

use super::mutation::Target;
use super::outcome::{Outcome, Trial};

/// Counts of mutations and their outcomes.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Tally {
    /// Applied mutations.
    pub changes: usize,
    /// Mutations with an error.
    pub noticed: usize,
    /// Mutations with only warnings or infos.
    pub warned: usize,
    /// Mutations without findings, or with a crashed rule.
    pub missed: usize,
}

impl Tally {
    fn add(&mut self, outcome: &Outcome) {
        self.changes += 1;
        match outcome {
            Outcome::Noticed(_) | Outcome::Unreadable => self.noticed += 1,
            Outcome::Warned(_) => self.warned += 1,
            Outcome::Missed | Outcome::Crashed(_) => self.missed += 1,
        }
    }

    /// The kill rate: the proportion of mutations with findings; 1 without mutations.
    pub fn rate(&self) -> f64 {
        match self.changes {
            0 => 1.0,
            changes => (self.noticed + self.warned) as f64 / changes as f64,
        }
    }
}

/// Counts for a module.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ModuleCount {
    /// The module's name, `urdd.json`, or `source`.
    pub module: String,
    /// In the plain run.
    pub plain: Tally,
    /// In the deep run.
    pub deep: Option<Tally>,
}

/// Counts for a field.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct FieldCount {
    /// The module's name, `urdd.json`, or `source`.
    pub module: String,
    /// The field.
    pub field: String,
    /// The files that were changed.
    pub target: Target,
    /// In the plain run.
    pub plain: Tally,
    /// In the deep run.
    pub deep: Option<Tally>,
}

/// Results for one URDD.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Measured {
    /// The URDD's name.
    pub name: String,
    /// Every mutation, in order of module and field.
    pub trials: Vec<Trial>,
}

impl Measured {
    pub(crate) fn new(name: String, trials: Vec<Trial>) -> Self {
        Measured { name, trials }
    }

    /// Counts for each module, in the order of the trials.
    pub fn modules(&self) -> Vec<ModuleCount> {
        modules_of(std::slice::from_ref(self))
    }

    /// Counts for each field, in the order of the trials.
    pub fn fields(&self) -> Vec<FieldCount> {
        let of = |trial: &Trial| {
            let change = &trial.change;
            (change.module.clone(), change.field.clone(), change.target)
        };
        let tallies = tallies(self.trials.iter(), of).into_iter();
        tallies
            .map(|((module, field, target), plain, deep)| FieldCount {
                module,
                field,
                target,
                plain,
                deep,
            })
            .collect()
    }

    /// The mutations that the last run does not detect.
    pub fn survivors(&self) -> impl Iterator<Item = &Trial> {
        self.trials.iter().filter(|trial| !trial.deep.as_ref().unwrap_or(&trial.plain).is_noticed())
    }
}

/// Counts for each module, over all URDDs together, in the order of the trials.
pub fn modules_of(measured: &[Measured]) -> Vec<ModuleCount> {
    let trials = measured.iter().flat_map(|urdd| &urdd.trials);
    let tallies = tallies(trials, |trial| trial.change.module.clone());
    let count = |(module, plain, deep)| ModuleCount { module, plain, deep };
    tallies.into_iter().map(count).collect()
}

fn tallies<'a, K: Ord + Clone>(
    trials: impl Iterator<Item = &'a Trial>,
    key: impl Fn(&Trial) -> K,
) -> Vec<(K, Tally, Option<Tally>)> {
    let mut places: BTreeMap<K, usize> = BTreeMap::new();
    let mut out: Vec<(K, Tally, Option<Tally>)> = Vec::new();
    for trial in trials {
        let key = key(trial);
        let place = *places.entry(key.clone()).or_insert_with(|| {
            out.push((key, Tally::default(), None));
            out.len() - 1
        });
        let (_, plain, deep) = &mut out[place];
        plain.add(&trial.plain);
        if let Some(outcome) = &trial.deep {
            deep.get_or_insert_default().add(outcome);
        }
    }
    out
}

//! Files in memory.
#![allow(clippy::unwrap_used, clippy::expect_used, reason = "a helper of tests")]

use std::cell::Cell;
use std::collections::BTreeMap;
use std::sync::Arc;

use urdd_directory::account::{Account, AccountError, Overdrawn};
use urdd_usd::{Authored, Door, Stage, UsdError, Value, open};

/// Files by path, and what may be made of them.
#[derive(Default)]
pub struct Memory {
    pub files: BTreeMap<String, Arc<[u8]>>,
    pub left: Cell<usize>,
    /// The most that was charged at once.
    pub most: Cell<usize>,
}

impl Door for Memory {
    fn read(&mut self, path: &str) -> Result<Arc<[u8]>, String> {
        self.files.get(path).cloned().ok_or_else(|| "no such file".to_owned())
    }

    fn charge(&self, cost: usize) -> Result<(), AccountError> {
        self.most.set(self.most.get().max(cost));
        self.left.set(self.left.get().checked_sub(cost).ok_or(Overdrawn)?);
        Ok(())
    }
}

/// Files of text.
pub fn memory(files: &[(&str, &str)]) -> Memory {
    let files = files.iter().map(|(path, text)| ((*path).to_owned(), Arc::from(text.as_bytes())));
    Memory { files: files.collect(), left: Cell::new(1 << 30), most: Cell::new(0) }
}

/// What files compose; the first is the root.
pub fn stage(files: &[(&str, &str)]) -> Result<Stage, UsdError> {
    open(files[0].0, &mut memory(files))
}

/// What text composes.
#[allow(dead_code, reason = "not all tests use all")]
pub fn composed(text: &str) -> Stage {
    stage(&[("root.usda", &format!("#usda 1.0\n{text}"))]).expect("a stage")
}

/// The error of text.
#[allow(dead_code, reason = "not all tests use all")]
pub fn refused(text: &str) -> String {
    stage(&[("root.usda", &format!("#usda 1.0\n{text}"))]).expect_err("an error").to_string()
}

/// The prim at a path.
#[allow(dead_code, reason = "not all tests use all")]
pub fn find(stage: &Stage, path: &str) -> Option<usize> {
    stage.find(path, &Account::default()).unwrap()
}

/// A value that is authored.
#[allow(dead_code, reason = "not all tests use all")]
pub fn take(value: Option<Authored<'_>>) -> &Value {
    value.unwrap().take(&Account::default()).unwrap()
}

/// All that a stage says, as text.
#[allow(dead_code, reason = "not all tests use all")]
pub fn said(stage: &Stage) -> Vec<String> {
    let mut lines = Vec::new();
    for (at, prim) in stage.prims.iter().enumerate() {
        let path = stage.path(at, &Account::default()).unwrap();
        let account = Account::default();
        let mut fields: Vec<_> = (prim.fields())
            .map(|name| (name, prim.field(name).unwrap().take(&account).unwrap()))
            .collect();
        fields.sort_by(|one, other| one.0.cmp(other.0));
        lines.push(format!("{path} {} {:?} {fields:?}", prim.type_name, prim.schemas));
        for property in &prim.properties {
            let value = property.value().map(|value| value.take(&account).unwrap());
            let targets: Vec<_> = property.targets().walk(&account).unwrap().collect();
            lines.push(format!(
                "{path}.{} {} {value:?} {targets:?}",
                property.name, property.type_name
            ));
        }
    }
    lines
}

//! What reading a layer of text has at hand.

use std::collections::{HashMap, HashSet};
use std::sync::Arc;

use super::super::layer::Layer;
use super::super::value::Name;
use super::lexer::Lexer;

/// Reads the words of a layer.
#[derive(Debug)]
pub struct Reader<'t> {
    pub lexer: Lexer<'t>,
    pub layer: Layer,
    pub names: HashSet<Name>,
    /// The properties of specs, by name.
    pub properties: HashMap<(u32, Name), usize>,
}

impl Reader<'_> {
    /// A name, which is there once.
    pub fn name(&mut self, text: &str) -> Name {
        if let Some(known) = self.names.get(text) {
            return known.clone();
        }
        let name: Name = Arc::from(text);
        self.names.insert(name.clone());
        name
    }
}

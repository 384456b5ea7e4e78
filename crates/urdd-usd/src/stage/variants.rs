//! Variants: which of a set is chosen, and what it brings in.

use std::collections::HashSet;

use super::super::error::{Fault, UsdError};
use super::super::layer::field;
use super::super::value::Name;
use super::sources::{Composer, MAX_SITES, SITE};
use super::tree::{Arc, Site, Tree};

impl Composer<'_> {
    /// Adds the chosen variant of a set that was not looked at before; false if there is none.
    pub fn variant(
        &mut self,
        tree: &mut Tree,
        names: &[Name],
        chosen: &mut HashSet<(usize, Name)>,
    ) -> Result<bool, UsdError> {
        let has_sets =
            |spec: &(u32, u32)| field(&self.spec(*spec).fields, "variantSetNames").is_some();
        if !tree.0.iter().any(|site| site.specs.iter().any(has_sets)) {
            return Ok(false);
        }
        let order = tree.ordered();
        for at in &order {
            let mut sets = Vec::new();
            for spec in tree.0[*at].specs.iter().rev() {
                if let Some(list) = self.list(*spec, "variantSetNames") {
                    list.apply(&mut sets);
                }
            }
            for set in sets {
                let set = set.text().clone();
                if !chosen.insert((*at, set.clone())) {
                    continue;
                }
                let Some(name) = self.selection(tree, &order, &set) else { continue };
                let name: Name = format!("{{{set}={name}}}").into();
                let specs = tree.0[*at].specs.iter().filter_map(|(layer, spec)| {
                    Some((*layer, self.layers.all[*layer as usize].layer.child(*spec, &name)?))
                });
                let specs: Vec<_> = specs.collect();
                if specs.is_empty() {
                    continue;
                }
                if tree.0.len() >= MAX_SITES {
                    return Err(self.wrong(tree, names, Fault::Sources(MAX_SITES)));
                }
                let own = tree.0[*at].path(names);
                self.charge(tree, names, SITE + own.len())?;
                let (stack, level) = (tree.0[*at].stack, names.len());
                let mut site = Site::new(*at, Arc::Variant, level as i32, stack, own.into(), level);
                site.specs = specs;
                tree.0.push(site);
                return Ok(true);
            }
        }
        Ok(false)
    }

    /// The strongest choice of a variant.
    fn selection(&self, tree: &Tree, order: &[usize], set: &str) -> Option<Name> {
        let specs = order.iter().flat_map(|at| &tree.0[*at].specs);
        let mut all = specs.filter_map(|spec| {
            let selection = field(&self.spec(*spec).fields, "variantSelection")?;
            selection.get(set)?.text().cloned()
        });
        all.find(|name| !name.is_empty())
    }
}

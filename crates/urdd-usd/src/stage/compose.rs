//! What the opinions of a prim come to: the variants that are chosen, its type, metadata and properties.

use std::collections::{BTreeMap, HashMap, HashSet};
use std::sync;

use super::composed::{Prim, Property};
use super::sources::{Composer, MAX_SITES, SITE, absolute, shared};
use super::tree::{Arc, Site, Tree};
use crate::door::{beside, is_remote};
use crate::error::{Fault, UsdError};
use crate::layer::{Item, ListOp, Name, PropertySpec, Value, field};

/// Bytes of a prim and of a property in memory, about.
const PRIM: usize = 400;
const PROPERTY: usize = 250;

/// Fields of prims that say how they are composed; they are used up by then.
const COMPOSITION: &[&str] = &[
    "specifier",
    "typeName",
    "apiSchemas",
    "active",
    "inheritPaths",
    "references",
    "payload",
    "specializes",
    "variantSetNames",
    "variantSetChildren",
    "variantSelection",
    "variantChildren",
    "primChildren",
    "properties",
    "primOrder",
    "propertyOrder",
    "comment",
];

/// The same of properties.
const OF_PROPERTY: &[&str] = &[
    "default",
    "timeSamples",
    "typeName",
    "targetPaths",
    "connectionPaths",
    "connectionChildren",
    "targetChildren",
    "custom",
    "variability",
    "comment",
];

/// An opinion of a property: the site, the layer, and what it says.
type Opinion<'l> = (usize, u32, &'l PropertySpec);

impl Composer<'_> {
    /// A prim; none if it is not defined, is abstract or is not active.
    pub fn prim(
        &mut self,
        tree: &Tree,
        names: &[Name],
        parent: Option<usize>,
    ) -> Result<Option<Prim>, UsdError> {
        let order = tree.ordered();
        let specs: Vec<(usize, (u32, u32))> =
            order.iter().flat_map(|at| tree.0[*at].specs.iter().map(|spec| (*at, *spec))).collect();
        let first =
            |name: &str| specs.iter().find_map(|(_, spec)| field(&self.spec(*spec).fields, name));
        // That a prim inherits a class does not make it one.
        let mut is_of_class = vec![false; tree.0.len()];
        for (at, site) in tree.0.iter().enumerate() {
            is_of_class[at] = is_of_class[site.above] || tree.is_class(at);
        }
        let specifier = specs.iter().find_map(|(at, spec)| {
            let specifier = field(&self.spec(*spec).fields, "specifier")?.text()?;
            let counts = **specifier == *"def" || **specifier == *"class" && !is_of_class[*at];
            counts.then_some(specifier)
        });
        if specifier.is_none_or(|specifier| **specifier != *"def")
            || first("active").and_then(Value::bool) == Some(false)
        {
            return Ok(None);
        }
        let types = specs
            .iter()
            .filter_map(|(_, spec)| field(&self.spec(*spec).fields, "typeName")?.text());
        let type_name = types.into_iter().find(|name| !name.is_empty()).cloned();
        let mut schemas = Vec::new();
        for (_, spec) in specs.iter().rev() {
            if let Some(list) = self.list(*spec, "apiSchemas") {
                list.apply(&mut schemas);
            }
        }
        let all = specs.iter().map(|(_, spec)| (spec.0, &self.spec(*spec).fields));
        let fields = self.fields(all, COMPOSITION);
        let is_instance = first("instanceable").and_then(Value::bool) == Some(true)
            && tree.0.iter().any(|site| site.arc != Arc::Root && site.depth == names.len() as i32);
        let mut opinions: BTreeMap<Name, Vec<Opinion<'_>>> = BTreeMap::new();
        for (at, spec) in &specs {
            for property in &self.spec(*spec).properties {
                opinions.entry(property.name.clone()).or_default().push((*at, spec.0, property));
            }
        }
        let (mut properties, mut sampled, mut cost) = (Vec::new(), 0, PRIM);
        for opinions in opinions.values() {
            let (property, is_sampled) = self.property(opinions, tree, names);
            sampled += usize::from(is_sampled);
            cost += PROPERTY + property.targets.iter().map(|path| path.len() + 40).sum::<usize>();
            properties.push(property);
        }
        let place = self.place(tree);
        self.sampled += sampled;
        self.charge(tree, names, cost + 64 * fields.len())?;
        Ok(Some(Prim {
            name: names.last().cloned().unwrap_or_else(|| Name::from("")),
            parent,
            children: Vec::new(),
            type_name: type_name.unwrap_or_else(|| Name::from("")),
            schemas: schemas.iter().map(|item| item.text().clone()).collect(),
            fields,
            properties,
            is_instance,
            place,
        }))
    }

    /// Metadata, of which the strongest counts; dictionaries are merged.
    fn fields<'l>(
        &self,
        all: impl Iterator<Item = (u32, &'l Vec<(Name, Value)>)>,
        without: &[&str],
    ) -> Vec<(Name, Value)> {
        let mut fields: Vec<(Name, Value)> = Vec::new();
        for (layer, own) in all {
            for (name, value) in own.iter().filter(|(name, _)| !without.contains(&&**name)) {
                match fields.iter_mut().find(|(known, _)| known == name) {
                    Some((_, stronger)) => merge(stronger, value),
                    None => fields.push((name.clone(), self.anchored(layer, value))),
                }
            }
        }
        fields
    }

    /// A value whose path of a file is relative to the root layer.
    fn anchored(&self, layer: u32, value: &Value) -> Value {
        match value {
            Value::Asset(asset) if !asset.is_empty() && !is_remote(asset) => {
                Value::Asset(shared(beside(&self.layers.all[layer as usize].path, asset)))
            }
            other => other.clone(),
        }
    }

    fn property(&self, opinions: &[Opinion<'_>], tree: &Tree, names: &[Name]) -> (Property, bool) {
        let (_, _, strongest) = opinions[0];
        let find = |name: &str| {
            opinions.iter().find_map(|(_, layer, of)| Some((*layer, field(&of.fields, name)?)))
        };
        let default = find("default");
        let samples = find("timeSamples").filter(|_| default.is_none());
        let (value, is_sampled) = match (default, samples) {
            (Some((layer, value)), _) => (Some(self.anchored(layer, value)), false),
            (None, Some((layer, Value::Samples(sample)))) => {
                (Some(self.anchored(layer, &sample.1)), true)
            }
            _ => (None, false),
        };
        let kind = if strongest.is_relationship { "targetPaths" } else { "connectionPaths" };
        let mut targets = Vec::new();
        for (at, _, of) in opinions.iter().rev() {
            let Some(list) = field(&of.fields, kind).and_then(Value::list) else { continue };
            let own = tree.0[*at].path(names);
            let mapped: ListOp = list.map(|item| {
                let path = absolute(&own, item.text());
                Some(Item::Path(shared(tree.mapped(*at, &path)?)))
            });
            mapped.apply(&mut targets);
        }
        let type_name = find("typeName").and_then(|(_, value)| value.text().cloned());
        let fields = opinions.iter().map(|(_, layer, of)| (*layer, &of.fields));
        let property = Property {
            name: strongest.name.clone(),
            type_name: type_name.unwrap_or_else(|| Name::from("")),
            value: value.filter(|value| *value != Value::Blocked),
            targets: targets.iter().map(|item| item.text().clone()).collect(),
            fields: self.fields(fields, OF_PROPERTY),
        };
        (property, is_sampled)
    }
}

/// Adds what a weaker dictionary says.
fn merge(stronger: &mut Value, weaker: &Value) {
    let (Value::Dictionary(own), Value::Dictionary(more)) = (&*stronger, weaker) else { return };
    let mut all: Vec<(Name, Value)> = own.to_vec();
    let known: HashMap<Name, usize> =
        own.iter().enumerate().map(|(at, (name, _))| (name.clone(), at)).collect();
    for (name, value) in more.iter() {
        match known.get(name) {
            Some(at) => merge(&mut all[*at].1, value),
            None => all.push((name.clone(), value.clone())),
        }
    }
    *stronger = Value::Dictionary(sync::Arc::from(all));
}

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

//! What the opinions of a prim come to: the variants that are chosen, its type, metadata and properties.

use std::collections::{BTreeMap, HashMap, HashSet};

use urdd_directory::account::AccountError;

use super::composed::{Prim, Property};
use super::sources::{Composer, MAX_SITES, absolute, shared};
use super::tree::{Arc, SITE, Site, Tree};
use crate::door::{Door, beside, is_remote};
use crate::error::{Fault, UsdError};
use crate::layer::{Item, Name, PropertySpec, Value, field};

/// Bytes of a prim and of a property in memory, about.
const PRIM: usize = 400;
const PROPERTY: usize = 250;
/// The same of an entry of a dictionary that is merged, and of a target.
const ENTRY: usize = 60;
const TARGET: usize = 40;
/// The fields of a prim or property up to which they are searched one by one.
const FEW: usize = 16;

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
                self.edit(&mut schemas, list).map_err(|why| self.too_much(tree, names, why))?;
            }
        }
        let all = specs.iter().map(|(_, spec)| (spec.0, &self.spec(*spec).fields));
        let fields = self.fields(all, COMPOSITION);
        let fields = fields.map_err(|why| self.too_much(tree, names, why))?;
        let is_instance = first("instanceable").and_then(Value::bool) == Some(true)
            && tree.0.iter().any(|site| site.arc != Arc::Root && site.depth == names.len() as i32);
        let mut opinions: BTreeMap<Name, Vec<Opinion<'_>>> = BTreeMap::new();
        for (at, spec) in &specs {
            for property in &self.spec(*spec).properties {
                opinions.entry(property.name.clone()).or_default().push((*at, spec.0, property));
            }
        }
        self.charge(tree, names, PRIM + PROPERTY * opinions.len() + 64 * fields.len())?;
        let (mut properties, mut sampled) = (Vec::new(), 0);
        for opinions in opinions.values() {
            let property = self.property(opinions, tree, names);
            let (property, is_sampled) = property.map_err(|why| self.too_much(tree, names, why))?;
            sampled += usize::from(is_sampled);
            properties.push(property);
        }
        let place = self.place(tree);
        self.sampled += sampled;
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
    ) -> Result<Vec<(Name, Value)>, AccountError> {
        let mut fields: Vec<(&Name, u32, Merged<'_>)> = Vec::new();
        let mut places: HashMap<&Name, usize> = HashMap::new();
        for (layer, own) in all {
            for (name, value) in own.iter().filter(|(name, _)| !without.contains(&&**name)) {
                let known = match fields.len() {
                    ..FEW => fields.iter().position(|(known, ..)| *known == name),
                    _ => places.get(name).copied(),
                };
                if let Some(known) = known {
                    fields[known].2.add(value, self.layers.door)?;
                    continue;
                }
                fields.push((name, layer, Merged::One(value)));
                let new = if fields.len() == FEW { 0 } else { fields.len() - 1 };
                if fields.len() >= FEW {
                    let each = fields.iter().enumerate().skip(new);
                    places.extend(each.map(|(at, (name, ..))| (*name, at)));
                }
            }
        }
        let made = fields.into_iter().map(|(name, layer, value)| match value {
            Merged::One(value) => Ok((name.clone(), self.anchored(layer, value)?)),
            merged => Ok((name.clone(), merged.into_value())),
        });
        made.collect()
    }

    /// A value whose path of a file is relative to the root layer.
    fn anchored(&self, layer: u32, value: &Value) -> Result<Value, AccountError> {
        Ok(match value {
            Value::Asset(asset) if !asset.is_empty() && !is_remote(asset) => {
                let layer = &self.layers.all[layer as usize].path;
                self.layers.door.charge(ENTRY + layer.len() + asset.len())?;
                Value::Asset(shared(beside(layer, asset)))
            }
            other => other.clone(),
        })
    }

    fn property(
        &self,
        opinions: &[Opinion<'_>],
        tree: &Tree,
        names: &[Name],
    ) -> Result<(Property, bool), AccountError> {
        let (_, _, strongest) = opinions[0];
        let find = |name: &str| {
            opinions.iter().find_map(|(_, layer, of)| Some((*layer, field(&of.fields, name)?)))
        };
        let default = find("default");
        let samples = find("timeSamples").filter(|_| default.is_none());
        let (value, is_sampled) = match (default, samples) {
            (Some((layer, value)), _) => (Some(self.anchored(layer, value)?), false),
            (None, Some((layer, Value::Samples(sample)))) => {
                (Some(self.anchored(layer, &sample.1)?), true)
            }
            _ => (None, false),
        };
        let kind = if strongest.is_relationship { "targetPaths" } else { "connectionPaths" };
        let mut targets = Vec::new();
        for (at, _, of) in opinions.iter().rev() {
            let Some(list) = field(&of.fields, kind).and_then(Value::list) else { continue };
            let mapped = list.map(|item| self.target(item, tree, *at, names))?;
            self.edit(&mut targets, &mapped)?;
        }
        let type_name = find("typeName").and_then(|(_, value)| value.text().cloned());
        let fields = opinions.iter().map(|(_, layer, of)| (*layer, &of.fields));
        let property = Property {
            name: strongest.name.clone(),
            type_name: type_name.unwrap_or_else(|| Name::from("")),
            value: value.filter(|value| *value != Value::Blocked),
            targets: targets.iter().map(|item| item.text().clone()).collect(),
            fields: self.fields(fields, OF_PROPERTY)?,
        };
        Ok((property, is_sampled))
    }

    /// A target that a site says, as it is in the stage.
    fn target(
        &self,
        item: &Item,
        tree: &Tree,
        at: usize,
        names: &[Name],
    ) -> Result<Option<Item>, AccountError> {
        let (door, path) = (&*self.layers.door, item.text());
        door.charge(TARGET + path.len())?;
        if at == 0 && path.starts_with('/') {
            return Ok(Some(Item::Path(path.clone())));
        }
        let path = match path.starts_with('/') {
            true => path.to_string(),
            false => absolute(&tree.0[at].path(names, door)?, path),
        };
        Ok(tree.mapped(at, &path, door)?.map(|path| Item::Path(shared(path))))
    }
}

/// What the opinions of a field come to: the strongest; of dictionaries, what all say.
enum Merged<'l> {
    One(&'l Value),
    /// The entries, and where each is.
    Entries(Vec<(&'l Name, Merged<'l>)>, HashMap<&'l Name, usize>),
}

impl<'l> Merged<'l> {
    /// Adds what a weaker dictionary says.
    fn add(&mut self, weaker: &'l Value, door: &dyn Door) -> Result<(), AccountError> {
        let Value::Dictionary(more) = weaker else { return Ok(()) };
        let cost = |entries: &[(Name, Value)]| {
            entries.iter().map(|(name, _)| ENTRY + name.len()).sum::<usize>()
        };
        if let Merged::One(own) = self {
            let Value::Dictionary(own) = own else { return Ok(()) };
            door.charge(cost(own))?;
            let places = own.iter().enumerate().map(|(at, (name, _))| (name, at)).collect();
            let each = own.iter().map(|(name, value)| (name, Merged::One(value)));
            *self = Merged::Entries(each.collect(), places);
        }
        let Merged::Entries(all, places) = self else { return Ok(()) };
        door.charge(cost(more))?;
        for (name, value) in more.iter() {
            match places.get(name) {
                Some(at) => all[*at].1.add(value, door)?,
                None => {
                    places.insert(name, all.len());
                    all.push((name, Merged::One(value)));
                }
            }
        }
        Ok(())
    }

    fn into_value(self) -> Value {
        match self {
            Merged::One(value) => value.clone(),
            Merged::Entries(all, _) => {
                let each = all.into_iter().map(|(name, of)| (name.clone(), of.into_value()));
                Value::Dictionary(each.collect())
            }
        }
    }
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
        // All is looked at again for each set.
        self.charge(tree, names, tree.steps())?;
        let order = tree.ordered();
        for at in &order {
            let mut sets = Vec::new();
            for spec in tree.0[*at].specs.iter().rev() {
                if let Some(list) = self.list(*spec, "variantSetNames") {
                    let edited = self.edit(&mut sets, list);
                    edited.map_err(|why| self.too_much(tree, names, why))?;
                }
            }
            for set in sets {
                let set = set.text().clone();
                if !chosen.insert((*at, set.clone())) {
                    continue;
                }
                let specs = self.selection(tree, &order, &set).and_then(|name| {
                    let name: Option<Name> = name.map(|name| format!("{{{set}={name}}}").into());
                    name.map(|name| self.layers.inside(&tree.0[*at].specs, &name)).transpose()
                });
                let specs = specs.map_err(|why| self.too_much(tree, names, why))?;
                let Some(specs) = specs else { continue };
                if specs.is_empty() {
                    continue;
                }
                if tree.0.len() >= MAX_SITES {
                    return Err(self.wrong(tree, names, Fault::Sources(MAX_SITES)));
                }
                let own = self.path(tree, *at, names)?;
                self.charge(tree, names, SITE)?;
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
    fn selection(
        &self,
        tree: &Tree,
        order: &[usize],
        set: &str,
    ) -> Result<Option<Name>, AccountError> {
        self.layers.door.charge(tree.steps())?;
        for spec in order.iter().flat_map(|at| tree.0[*at].specs.iter()) {
            let selection = field(&self.spec(*spec).fields, "variantSelection");
            let Some(Value::Dictionary(entries)) = selection else { continue };
            self.layers.door.charge(entries.len())?;
            let name = selection.and_then(|all| all.get(set)?.text());
            if let Some(name) = name.filter(|name| !name.is_empty()) {
                self.layers.door.charge(set.len() + name.len())?;
                return Ok(Some(name.clone()));
            }
        }
        Ok(None)
    }
}

//! The layers of a stage, each read once, and what their sublayers add to them.

use std::collections::{HashMap, HashSet};
use std::sync::Arc;

use urdd_directory::account::AccountError;

use crate::door::{Door, PACKAGE_START, Package, beside, is_remote};
use crate::error::{Fault, Place, UsdError};
use crate::layer::{Layer, Name, Spec, Value, field};
use crate::{binary, text};

/// Bytes that are made of each byte of text, at most: `int a` becomes a property with a field.
const OF_TEXT: usize = 60;
/// The most packages in each other.
const MAX_PACKAGES: usize = 8;
/// The most layers of a stack.
const MAX_LAYERS: usize = 1000;
/// Steps of a look at a layer of a stack, at a spec for one inside of it, and at a path.
const LOOK: usize = 20;

/// A layer, and where it is from.
#[derive(Debug)]
pub struct Loaded {
    pub path: Name,
    pub layer: Layer,
}

/// Layers with their specs of a prim, strongest first. That these are composed once was charged: none are had otherwise than
/// from [`Layers::roots`] and [`Layers::inside`].
#[derive(Debug, Default)]
pub struct Specs {
    all: Vec<(u32, u32)>,
    /// The steps of their composition.
    pub steps: usize,
}

impl std::ops::Deref for Specs {
    type Target = [(u32, u32)];
    fn deref(&self) -> &[(u32, u32)] {
        &self.all
    }
}

pub struct Layers<'d> {
    pub door: &'d mut dyn Door,
    pub all: Vec<Loaded>,
    /// Layers with all their sublayers, strongest first.
    pub stacks: Vec<Vec<u32>>,
    by_path: HashMap<String, u32>,
    stack_of: HashMap<u32, usize>,
    packages: HashMap<String, Package>,
}

pub fn error(layer: &str, place: Place, fault: Fault) -> UsdError {
    UsdError { layer: Arc::from(layer), place, fault }
}

impl<'d> Layers<'d> {
    pub fn new(door: &'d mut dyn Door) -> Self {
        Layers {
            door,
            all: Vec::new(),
            stacks: Vec::new(),
            by_path: HashMap::new(),
            stack_of: HashMap::new(),
            packages: HashMap::new(),
        }
    }

    pub fn spec(&self, (layer, spec): (u32, u32)) -> &Spec {
        &self.all[layer as usize].layer.specs[spec as usize]
    }

    fn specs(&self, all: Vec<(u32, u32)>) -> Result<Specs, AccountError> {
        let steps = all.iter().map(|spec| self.spec(*spec).steps).sum();
        self.door.charge(steps)?;
        Ok(Specs { all, steps })
    }

    /// The layers of a stack, as specs.
    pub fn roots(&self, stack: usize) -> Result<Specs, AccountError> {
        self.specs(self.stacks[stack].iter().map(|layer| (*layer, 0)).collect())
    }

    /// What layers say of a child or a variant.
    pub fn inside(&self, specs: &Specs, name: &Name) -> Result<Specs, AccountError> {
        self.door.charge((LOOK + name.len()) * specs.len())?;
        let inside = specs.iter().filter_map(|(layer, spec)| {
            Some((*layer, self.all[*layer as usize].layer.child(*spec, name)?))
        });
        self.specs(inside.collect())
    }

    /// The path of a file that a layer names, if such a file can be read.
    pub fn named(&self, layer: u32, asset: &str) -> Result<String, Fault> {
        self.door.charge(LOOK + self.all[layer as usize].path.len() + asset.len())?;
        if is_remote(asset) {
            return Err(Fault::Network(asset.to_owned()));
        }
        if asset.starts_with('`') {
            return Err(Fault::Expression(asset.to_owned()));
        }
        Ok(beside(&self.all[layer as usize].path, asset))
    }

    /// The stack of a layer: itself and its sublayers. Of a layer that is there several times, the first and the last count:
    /// the strongest of its opinions, and the weakest place in lists and orders. Those between say nothing new.
    pub fn stack(&mut self, path: &str) -> Result<usize, UsdError> {
        let root = self.load(path)?;
        if let Some(known) = self.stack_of.get(&root) {
            return Ok(*known);
        }
        let mut stack = Vec::new();
        // What is open: the layers from the root to the one that is read, and the sublayers that wait.
        let mut open: Vec<(u32, Vec<u32>)> = Vec::new();
        let mut next = Some(root);
        loop {
            if let Some(layer) = next {
                let path = self.all[layer as usize].path.clone();
                if open.iter().any(|(above, _)| *above == layer) {
                    let fault = Fault::LayerCircle(path.to_string());
                    return Err(error(&path, Place::Layer, fault));
                }
                if stack.len() >= MAX_LAYERS {
                    return Err(error(&path, Place::Layer, Fault::Sources(MAX_LAYERS)));
                }
                let charged = self.door.charge(LOOK + LOOK * open.len());
                charged.map_err(|why| error(&path, Place::Layer, why.into()))?;
                stack.push(layer);
                let mut below = self.sublayers(layer)?;
                below.reverse();
                open.push((layer, below));
            }
            let Some((_, waiting)) = open.last_mut() else { break };
            next = waiting.pop();
            if next.is_none() {
                open.pop();
            }
        }
        let each = stack.iter().enumerate();
        let last: HashMap<u32, usize> = each.map(|(at, layer)| (*layer, at)).collect();
        let mut known = HashSet::new();
        let each = stack.into_iter().enumerate();
        let counts = each.filter(|(at, layer)| known.insert(*layer) || last[layer] == *at);
        let stack = counts.map(|(_, layer)| layer).collect();
        self.stacks.push(stack);
        self.stack_of.insert(root, self.stacks.len() - 1);
        Ok(self.stacks.len() - 1)
    }

    fn sublayers(&mut self, layer: u32) -> Result<Vec<u32>, UsdError> {
        let of = &self.all[layer as usize];
        let names = of.layer.metadata("subLayers").and_then(Value::texts);
        let names: Vec<Name> = names.unwrap_or_default().to_vec();
        let path = of.path.clone();
        let mut all = Vec::new();
        for name in names {
            let named =
                self.named(layer, &name).map_err(|fault| error(&path, Place::Layer, fault))?;
            let read = self.load(&named).map_err(|mut wrong| {
                if matches!(wrong.fault, Fault::File { .. }) && *wrong.layer == *named {
                    (wrong.layer, wrong.place) = (path.clone(), Place::Layer);
                }
                wrong
            });
            all.push(read?);
        }
        Ok(all)
    }

    /// Reads a layer, if it was not read yet.
    pub fn load(&mut self, path: &str) -> Result<u32, UsdError> {
        if let Some(known) = self.by_path.get(path) {
            return Ok(*known);
        }
        let wrong = |(place, fault)| error(path, place, fault);
        let layer = |fault| error(path, Place::Layer, fault);
        let bytes = self.bytes(path).map_err(layer)?;
        let at = if bytes.starts_with(PACKAGE_START) {
            let mut package = Package::open(bytes, self.door).map_err(layer)?;
            let root = package.root().map_err(layer)?;
            self.packages.insert(path.to_owned(), package);
            let (outer, ends) = path.split_at(path.trim_end_matches(']').len());
            self.load(&format!("{outer}[{root}]{ends}"))?
        } else {
            let mut read = if bytes.starts_with(binary::START) {
                binary::read(&bytes, self.door).map_err(wrong)?
            } else {
                let charged = self.door.charge(bytes.len().saturating_mul(OF_TEXT));
                charged.map_err(|why| layer(why.into()))?;
                text::read(&bytes).map_err(wrong)?
            };
            let says = |spec: &Spec, name| field(&spec.fields, name).is_some_and(is_said);
            if says(&read.specs[0], "layerRelocates")
                || read.specs.iter().any(|spec| says(spec, "relocates"))
            {
                return Err(layer(Fault::Relocates));
            }
            read.weigh();
            self.all.push(Loaded { path: Arc::from(path), layer: read });
            self.all.len() as u32 - 1
        };
        self.by_path.insert(path.to_owned(), at);
        Ok(at)
    }

    /// The content of a file, which may be in a package, and this in another one: `a.usdz[b.usdz[c.usda]]`.
    pub fn bytes(&mut self, path: &str) -> Result<Arc<[u8]>, Fault> {
        let file = |why| Fault::File { asset: path.to_owned(), why };
        let (outer, ends) = path.split_at(path.trim_end_matches(']').len());
        let Some((package, inside)) = outer.rsplit_once('[').filter(|_| !ends.is_empty()) else {
            return self.door.read(path).map_err(file);
        };
        if ends.len() > MAX_PACKAGES {
            let why = format!("packages are nested more than {MAX_PACKAGES} levels deep");
            return Err(Fault::Zip(why));
        }
        let package = format!("{package}{}", &ends[1..]);
        if !self.packages.contains_key(&package) {
            let bytes = self.bytes(&package)?;
            self.packages.insert(package.clone(), Package::open(bytes, self.door)?);
        }
        match self.packages.get_mut(&package) {
            Some(package) => package.read(inside, self.door).map_err(|fault| match fault {
                Fault::File { why, .. } => file(why),
                fault => fault,
            }),
            None => Err(file("the package is missing".to_owned())),
        }
    }
}

fn is_said(value: &Value) -> bool {
    !matches!(value, Value::Dictionary(entries) if entries.is_empty())
}

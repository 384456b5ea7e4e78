//! Finds where the opinions of prims are from, and walks through all prims.

use std::collections::HashSet;
use std::rc::Rc;
use std::sync;

use urdd_directory::account::AccountError;

use super::composed::Stage;
use super::layers::{Layers, error};
use super::tree::{Arc, LOOK, SITE, Site, Tree};
use crate::error::{Fault, Place, UsdError};
use crate::layer::{Item, ListOp, Name, Spec, Value, field};

/// The most sites of one prim. Robots have up to ten.
pub const MAX_SITES: usize = 1000;
/// The deepest chain of references to prims inside of what is referenced itself.
const MAX_CHAIN: usize = 64;
/// Bytes of an error in memory, about.
const MISSING: usize = 200;
/// Steps of a child in the list of those that wait, and of an entry of a list that is edited.
const CHILD: usize = 20;
const ITEM: usize = 40;

/// Fields that bring in other sites.
const ARCS: [(&str, Arc); 4] = [
    ("inheritPaths", Arc::Inherit),
    ("references", Arc::Reference),
    ("payload", Arc::Payload),
    ("specializes", Arc::Specialize),
];

pub struct Composer<'d> {
    pub layers: Layers<'d>,
    /// What is being looked up, so that circles are seen.
    chain: Vec<(usize, Name)>,
    /// What the prim that is composed brings in and is not there.
    missing: Vec<UsdError>,
    pub sampled: usize,
}

impl<'d> Composer<'d> {
    pub fn new(layers: Layers<'d>) -> Self {
        Composer { layers, chain: Vec::new(), missing: Vec::new(), sampled: 0 }
    }

    pub fn stage(mut self, stack: usize) -> Result<Stage, UsdError> {
        let mut stage = Stage::default();
        let root = self.layers.stacks[stack][0];
        stage.metadata = self.layers.all[root as usize].layer.specs[0].fields.clone();
        let tree = Tree::root(stack, &self.layers);
        let root = &self.layers.all[root as usize].path;
        let tree = Rc::new(tree.map_err(|why| error(root, Place::Layer, why.into()))?);
        let mut waiting = Vec::new();
        self.wait(&mut waiting, None, &tree, &[])?;
        let mut names: Vec<Name> = Vec::new();
        while let Some((parent, above, name, level)) = waiting.pop() {
            names.truncate(level);
            names.push(name.clone());
            let tree = above.child(&name, &self.layers);
            let mut tree = tree.map_err(|why| self.too_much(&above, &names, why))?;
            drop(above);
            self.expand(&mut tree, &names, true)?;
            let prim = self.prim(&tree, &names, parent)?;
            let next = stage.prims.len();
            let holder = if prim.is_some() { Some(next) } else { parent };
            stage.missing.extend(self.missing.drain(..).map(|error| (holder, error)));
            let Some(prim) = prim else { continue };
            let is_instance = prim.is_instance;
            let at = stage.push(prim);
            if is_instance {
                tree.close(level + 1);
            }
            self.wait(&mut waiting, Some(at), &Rc::new(tree), &names)?;
        }
        stage.layers = self.layers.all.iter().map(|layer| layer.path.clone()).collect();
        stage.sampled = self.sampled;
        Ok(stage)
    }

    /// Adds the children of a prim to what waits, the first one last.
    fn wait(
        &mut self,
        waiting: &mut Vec<(Option<usize>, Rc<Tree>, Name, usize)>,
        parent: Option<usize>,
        tree: &Rc<Tree>,
        names: &[Name],
    ) -> Result<(), UsdError> {
        let (mut known, mut children) = (HashSet::new(), Vec::new());
        for at in tree.ordered().into_iter().rev() {
            for (layer, spec) in tree.0[at].specs.iter().rev() {
                let specs = &self.layers.all[*layer as usize].layer.specs;
                self.charge(tree, names, CHILD * specs[*spec as usize].children.len())?;
                for child in &specs[*spec as usize].children {
                    let name = &specs[*child as usize].name;
                    if known.insert(name.clone()) {
                        self.charge(tree, names, SITE + name.len())?;
                        children.push(name.clone());
                    }
                }
            }
        }
        let (each, level) = (children.into_iter().rev(), names.len());
        let each = each.map(|name| (parent, Rc::clone(tree), name, level));
        waiting.extend(each);
        Ok(())
    }

    pub fn spec(&self, spec: (u32, u32)) -> &Spec {
        self.layers.spec(spec)
    }

    /// Edits a list. All edits of lists are made here.
    pub fn edit(&self, list: &mut Vec<Item>, edit: &ListOp) -> Result<(), AccountError> {
        let cost = |item: &Item| ITEM + item.len();
        let known: usize = list.iter().map(cost).sum();
        self.layers.door.charge(known + edit.all().map(cost).sum::<usize>())?;
        edit.apply(list);
        Ok(())
    }

    /// How a layer edits a list.
    pub fn list(&self, spec: (u32, u32), name: &str) -> Option<&ListOp> {
        field(&self.spec(spec).fields, name)?.list()
    }

    /// The layer of the strongest opinion, and the line.
    pub fn place(&self, tree: &Tree) -> (usize, u32) {
        let first = tree.ordered().into_iter().find_map(|at| tree.0[at].specs.first().copied());
        first.map_or((0, 0), |(layer, spec)| (layer as usize, self.spec((layer, spec)).line))
    }

    /// An error at the strongest opinion of a prim.
    pub fn wrong(&self, tree: &Tree, names: &[Name], fault: Fault) -> UsdError {
        let (layer, line) = self.place(tree);
        let place = match line {
            0 => Place::Path(tree.0[0].shown(names)),
            line => Place::Text(line, 1),
        };
        error(&self.layers.all[layer].path, place, fault)
    }

    pub fn charge(&self, tree: &Tree, names: &[Name], cost: usize) -> Result<(), UsdError> {
        self.layers.door.charge(cost).map_err(|why| self.too_much(tree, names, why))
    }

    pub fn too_much(&self, tree: &Tree, names: &[Name], why: AccountError) -> UsdError {
        self.wrong(tree, names, why.into())
    }

    /// The path of a site of a prim.
    pub fn path(&self, tree: &Tree, at: usize, names: &[Name]) -> Result<String, UsdError> {
        let path = tree.0[at].path(names, self.layers.door);
        path.map_err(|why| self.too_much(tree, names, why))
    }

    /// Adds all sites that those of a prim bring in; variants only if they are wanted.
    fn expand(
        &mut self,
        tree: &mut Tree,
        names: &[Name],
        has_variants: bool,
    ) -> Result<(), UsdError> {
        let mut next = 0;
        let mut chosen = HashSet::new();
        loop {
            while next < tree.0.len() {
                self.arcs(tree, next, names)?;
                next += 1;
            }
            if !(has_variants && self.variant(tree, names, &mut chosen)?) {
                return Ok(());
            }
        }
    }

    /// Adds the sites that one site brings in.
    fn arcs(&mut self, tree: &mut Tree, at: usize, names: &[Name]) -> Result<(), UsdError> {
        for (name, arc) in ARCS {
            let specs = &tree.0[at].specs;
            if !specs.iter().any(|spec| field(&self.spec(*spec).fields, name).is_some()) {
                continue;
            }
            let mut items = Vec::new();
            let mut faults = Vec::new();
            for (layer, spec) in specs.iter().rev() {
                let Some(list) = self.list((*layer, *spec), name) else { continue };
                let anchored = list.map(|item| match item {
                    Item::Reference { asset, path } if !asset.is_empty() => {
                        match self.layers.named(*layer, asset) {
                            Ok(asset) => {
                                let (asset, path) = (asset.into(), path.clone());
                                Ok(Some(Item::Reference { asset, path }))
                            }
                            Err(Fault::TooMuch(why)) => Err(why),
                            Err(why) => {
                                faults.push(why);
                                Ok(None)
                            }
                        }
                    }
                    other => Ok(Some(other.clone())),
                });
                let edited = anchored.and_then(|edit| self.edit(&mut items, &edit));
                edited.map_err(|why| self.too_much(tree, names, why))?;
            }
            for fault in faults {
                self.miss(tree, names, fault)?;
            }
            for item in items {
                self.bring(tree, at, names, arc, &item)?;
                if matches!(arc, Arc::Inherit | Arc::Specialize) {
                    self.imply(tree, at, names, arc, &item)?;
                }
            }
        }
        Ok(())
    }

    /// Keeps why something is not there that a prim brings in; an expression is an error at once.
    fn miss(&mut self, tree: &Tree, names: &[Name], fault: Fault) -> Result<(), UsdError> {
        let error = self.wrong(tree, names, fault);
        if matches!(error.fault, Fault::Expression(_)) {
            return Err(error);
        }
        self.charge(tree, names, MISSING + 2 * error.to_string().len())?;
        self.missing.push(error);
        Ok(())
    }

    /// A class that is brought in counts in the layers of all that bring in its user, too.
    fn imply(
        &mut self,
        tree: &mut Tree,
        at: usize,
        names: &[Name],
        arc: Arc,
        item: &Item,
    ) -> Result<(), UsdError> {
        let mut path = absolute(&self.path(tree, at, names)?, item.text());
        let mut site = at;
        while site != 0 {
            // All sites are compared.
            let each = 1 + path.len() / 16;
            self.charge(tree, names, path.len() + each * tree.0.len())?;
            let (above, stack) = (tree.0[site].above, tree.0[site].stack);
            let mapped = tree.above(site, &path);
            let is_same = mapped == path && tree.0[above].stack == stack;
            (path, site) = (mapped, above);
            let is_known = |one: &Site| {
                let target = one.map.as_ref().map(|(target, _)| &**target);
                one.above == above && one.arc == arc && target == Some(path.as_str())
            };
            let own = self.path(tree, site, names)?;
            if is_same || is_inside(&own, &path) || tree.0.iter().any(is_known) {
                continue;
            }
            self.bring(tree, site, names, arc, &Item::Path(path.as_str().into()))?;
        }
        Ok(())
    }

    /// Adds one site that another one brings in, with what it brings in by what it is inside of.
    fn bring(
        &mut self,
        tree: &mut Tree,
        at: usize,
        names: &[Name],
        arc: Arc,
        item: &Item,
    ) -> Result<(), UsdError> {
        let own = self.path(tree, at, names)?;
        let (asset, path) = match item {
            Item::Reference { asset, path } => (&**asset, &**path),
            Item::Text(path) | Item::Path(path) => ("", &**path),
        };
        // Nothing: what clears the references of weaker layers.
        if asset.is_empty() && path.is_empty() {
            return Ok(());
        }
        let stack = match asset {
            "" => tree.0[at].stack,
            asset => match self.layers.stack(asset) {
                Ok(stack) => stack,
                Err(error) if matches!(&error.fault, Fault::File { asset: gone, .. } if gone == asset) =>
                {
                    return self.miss(tree, names, error.fault);
                }
                Err(error) => return Err(error),
            },
        };
        let root = self.layers.stacks[stack][0] as usize;
        let path = match path {
            "" => match self.layers.all[root].layer.metadata("defaultPrim").and_then(Value::text) {
                Some(name) if !name.is_empty() => format!("/{}", name.trim_start_matches('/')),
                _ => return self.miss(tree, names, Fault::NoDefault(asset.to_owned())),
            },
            path => absolute(&own, path),
        };
        let target: Name = path.as_str().into();
        let is_class = matches!(arc, Arc::Inherit | Arc::Specialize);
        let mut above = at;
        loop {
            let site = &tree.0[above];
            let one = self.path(tree, above, names)?;
            let is_circle = site.stack == stack
                && (is_inside(&one, &path) || !is_class && is_inside(&path, &one));
            if is_circle {
                return Err(self.wrong(tree, names, Fault::Circle(path)));
            }
            if above == 0 {
                break;
            }
            above = site.above;
        }
        let (inside, own_names) = self.index(stack, &target, tree, names)?;
        if inside.0[0].specs.is_empty() && inside.0.len() == 1 {
            if is_class {
                return Ok(());
            }
            let asset = self.layers.all[root].path.to_string();
            return self.miss(tree, names, Fault::Missing { asset, path });
        }
        if tree.0.len() + inside.0.len() > MAX_SITES {
            return Err(self.wrong(tree, names, Fault::Sources(MAX_SITES)));
        }
        self.charge(tree, names, inside.0.len() * (SITE + path.len()))?;
        let depth = names.len() as i32;
        let mut site = Site::new(at, arc, depth, stack, target.clone(), names.len());
        site.map = Some((target, own.into()));
        let grafted = tree.graft(site, inside, &own_names, self.layers.door);
        grafted.map_err(|why| self.too_much(tree, names, why))
    }

    /// The sites of a path in a stack, with what is brought in by the prims that it is inside of.
    fn index(
        &mut self,
        stack: usize,
        path: &Name,
        of: &Tree,
        of_names: &[Name],
    ) -> Result<(Tree, Vec<Name>), UsdError> {
        let key = (stack, path.clone());
        if self.chain.contains(&key) || self.chain.len() >= MAX_CHAIN {
            return Err(self.wrong(of, of_names, Fault::Circle(path.to_string())));
        }
        self.chain.push(key);
        let path = path.trim_matches('/');
        self.charge(of, of_names, LOOK * path.len())?;
        let names: Vec<Name> = path.split('/').map(Name::from).collect();
        let too_much = |this: &Self, why| this.too_much(of, of_names, why);
        let mut tree = Tree::root(stack, &self.layers).map_err(|why| too_much(self, why))?;
        for level in 1..=names.len() {
            let child = tree.child(&names[level - 1], &self.layers);
            tree = child.map_err(|why| too_much(self, why))?;
            if level < names.len() {
                self.expand(&mut tree, &names[..level], true)?;
            }
        }
        self.chain.pop();
        Ok((tree, names))
    }
}

/// Whether a path is another one, or inside of it.
fn is_inside(path: &str, of: &str) -> bool {
    path.strip_prefix(of).is_some_and(|rest| rest.is_empty() || rest.starts_with('/'))
}

/// A path that may be relative to a prim.
pub fn absolute(prim: &str, path: &str) -> String {
    if path.starts_with('/') {
        return path.to_owned();
    }
    let mut parts: Vec<&str> = prim.split('/').filter(|part| !part.is_empty()).collect();
    let (prims, property) = match path.find('.').filter(|at| !path[*at..].starts_with("..")) {
        Some(at) if !path.starts_with("..") => path.split_at(at),
        _ => match path.rsplit_once('/') {
            Some((_, last)) if last.contains('.') && last != ".." => {
                let dot = path.len() - last.len() + last.find('.').unwrap_or(last.len());
                path.split_at(dot)
            }
            _ => (path, ""),
        },
    };
    for part in prims.split('/') {
        match part {
            "" | "." => {}
            ".." => drop(parts.pop()),
            name => parts.push(name),
        }
    }
    format!("/{}{property}", parts.join("/"))
}

pub fn shared(text: String) -> Name {
    sync::Arc::from(text)
}

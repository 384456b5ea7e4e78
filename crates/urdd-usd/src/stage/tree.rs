//! Where the opinions of a prim are from: a tree of sites, each in a stack of layers.

use std::cmp::Reverse;

use urdd_directory::account::AccountError;

use super::layers::{Layers, Specs};
use crate::door::Door;
use crate::layer::Name;

/// Bytes of a site in memory, about; and steps of a look at a name of a path or at a site.
pub const SITE: usize = 120;
pub const LOOK: usize = 10;
/// Characters of a path in an error.
const SHOWN: usize = 1000;

/// How a site comes in, strongest first.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Arc {
    Root,
    Inherit,
    Variant,
    Reference,
    Payload,
    Specialize,
}

/// A place in a stack of layers that has opinions of a prim.
#[derive(Debug)]
pub struct Site {
    pub above: usize,
    pub arc: Arc,
    /// The level of the prim where it came in, of that the tree is of; deeper ones are stronger.
    pub depth: i32,
    pub stack: usize,
    /// A path here, and what it is in the site above. None: paths are the same.
    pub map: Option<(Name, Name)>,
    /// The path of the site: this, and the names of the prim from `since` on.
    base: Name,
    since: usize,
    /// The layers and their specs that are there, strongest first.
    pub specs: Specs,
}

/// The sites of a prim. The first is where it is in the stage; each stands behind the one that brought it in.
#[derive(Debug)]
pub struct Tree(pub Vec<Site>);

impl Site {
    /// A site at a path that the prim has where it comes in.
    pub fn new(above: usize, arc: Arc, depth: i32, stack: usize, base: Name, since: usize) -> Self {
        Site { above, arc, depth, stack, map: None, base, since, specs: Specs::default() }
    }

    /// Its path, for the prim of these names.
    pub fn path(&self, names: &[Name], door: &dyn Door) -> Result<String, AccountError> {
        let below = names.get(self.since..).unwrap_or_default();
        let length: usize = below.iter().map(|name| LOOK + name.len()).sum();
        door.charge(LOOK + self.base.len() + length)?;
        let base = if &*self.base == "/" { "" } else { &*self.base };
        let path = below.iter().fold(base.to_owned(), |path, name| path + "/" + name);
        Ok(if path.is_empty() { "/".to_owned() } else { path })
    }

    /// Its path for a person: of a long one the start.
    pub fn shown(&self, names: &[Name]) -> String {
        let below = names.get(self.since..).unwrap_or_default();
        let all = std::iter::once(&self.base).chain(below).map(|part| part.trim_matches('/'));
        let each = all.filter(|part| !part.is_empty()).flat_map(|part| ["/", part]);
        each.flat_map(str::chars).take(SHOWN).collect()
    }

    /// The same site of another prim.
    fn of(&self, above: usize, specs: Specs) -> Site {
        let (map, base) = (self.map.clone(), self.base.clone());
        Site { above, map, base, specs, ..*self }
    }
}

impl Tree {
    pub fn root(stack: usize, layers: &Layers<'_>) -> Result<Self, AccountError> {
        let mut site = Site::new(0, Arc::Root, 0, stack, Name::from("/"), 0);
        site.specs = layers.roots(stack)?;
        Ok(Tree(vec![site]))
    }

    /// The sites of a child, without those that say nothing.
    pub fn child(&self, name: &Name, layers: &Layers<'_>) -> Result<Tree, AccountError> {
        layers.door.charge(SITE * self.0.len())?;
        let all = self.0.iter().map(|site| layers.inside(&site.specs, name));
        let all: Vec<Specs> = all.collect::<Result<_, _>>()?;
        let mut is_kept: Vec<bool> = all.iter().map(|specs| !specs.is_empty()).collect();
        is_kept[0] = true;
        for at in (1..all.len()).rev() {
            is_kept[self.0[at].above] |= is_kept[at];
        }
        let mut places = vec![0; all.len()];
        let mut kept = Vec::new();
        for (at, specs) in all.into_iter().enumerate().filter(|(at, _)| is_kept[*at]) {
            places[at] = kept.len();
            let above = places[self.0[at].above];
            kept.push(self.0[at].of(above, specs));
        }
        Ok(Tree(kept))
    }

    /// The sites, strongest first.
    pub fn ordered(&self) -> Vec<usize> {
        if self.0.len() == 1 {
            return vec![0];
        }
        let mut below: Vec<Vec<usize>> = vec![Vec::new(); self.0.len()];
        for (at, site) in self.0.iter().enumerate().skip(1) {
            below[site.above].push(at);
        }
        for inside in &mut below {
            inside.sort_by_key(|at| (self.0[*at].arc, Reverse(self.0[*at].depth)));
        }
        let (mut order, mut open) = (Vec::new(), vec![0]);
        while let Some(at) = open.pop() {
            order.push(at);
            open.extend(below[at].iter().rev());
        }
        order
    }

    /// Puts the sites of another tree under one of these: the other's first becomes `site`.
    pub fn graft(
        &mut self,
        site: Site,
        other: Tree,
        names: &[Name],
        door: &dyn Door,
    ) -> Result<(), AccountError> {
        let (first, since) = (self.0.len(), site.since);
        let base = site.depth - names.len() as i32;
        let mut others = other.0.into_iter();
        let specs = others.next().map(|one| one.specs).unwrap_or_default();
        self.0.push(Site { specs, ..site });
        for mut one in others {
            // Of the levels of its own names to those of the prim.
            (one.base, one.since) = (Name::from(one.path(names, door)?), since);
            one.above += first;
            one.depth += base;
            self.0.push(one);
        }
        Ok(())
    }

    /// The steps of the composition of all specs.
    pub fn steps(&self) -> usize {
        self.0.iter().map(|site| site.specs.steps).sum()
    }

    pub fn is_class(&self, at: usize) -> bool {
        matches!(self.0[at].arc, Arc::Inherit | Arc::Specialize)
    }

    /// Whether a site is in the layers of the one that brought it in.
    fn is_in_place(&self, at: usize) -> bool {
        let site = &self.0[at];
        site.stack == self.0[site.above].stack || self.is_class(at)
    }

    /// A path of a site in the site above, which may be the same.
    pub fn above(&self, at: usize, path: &str) -> String {
        let map = self.0[at].map.as_ref();
        let inside = map.and_then(|(here, above)| {
            let rest = path.strip_prefix(&**here)?;
            (rest.is_empty() || rest.starts_with('/')).then(|| format!("{above}{rest}"))
        });
        inside.unwrap_or_else(|| path.to_owned())
    }

    /// Forgets what is said of the insides of an instance, at some level, but by what the instance itself brings in.
    pub fn close(&mut self, level: usize) {
        let mut is_kept = vec![false; self.0.len()];
        for at in 0..self.0.len() {
            let site = &self.0[at];
            is_kept[at] = site.depth == level as i32 || at > 0 && is_kept[site.above];
            if !is_kept[at] {
                self.0[at].specs = Specs::default();
            }
        }
    }

    /// A path of a site as it is in the stage; none of a path that is not brought in.
    pub fn mapped(
        &self,
        site: usize,
        path: &str,
        door: &dyn Door,
    ) -> Result<Option<String>, AccountError> {
        let (mut at, mut path) = (site, path.to_owned());
        while at != 0 {
            door.charge(LOOK + path.len())?;
            if let Some((here, above)) = &self.0[at].map {
                let rest = path.strip_prefix(&**here);
                match rest.filter(|rest| rest.is_empty() || rest.starts_with(['/', '.'])) {
                    Some(rest) => path = format!("{above}{rest}"),
                    // In the same layers, other paths are as they are.
                    None if self.is_in_place(at) => {}
                    None => return Ok(None),
                }
            }
            at = self.0[at].above;
        }
        Ok(Some(path))
    }
}

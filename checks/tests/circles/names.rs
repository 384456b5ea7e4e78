//! Which names each file uses from each other file. A path is followed through modules and imports to the file that
//! defines the name. If another file re-exports the name, the path needs that file too, unless it is a `mod.rs` or a root
//! that re-exports what its children define. Methods do not count.

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

use super::modules::Crate;

/// The names that a file uses from others.
pub type Ties<'a> = BTreeMap<&'a Path, BTreeMap<&'a Path, BTreeSet<String>>>;

/// Where a path leads.
enum Place {
    Module(usize),
    Item(usize, String),
    OtherCrate,
}

/// The modules and names whose imports are being followed.
type Seen = BTreeSet<(usize, String)>;

struct Resolver<'a> {
    read: &'a Crate,
    /// For each module, those that its globs name.
    opened: Vec<Vec<usize>>,
}

impl<'a> Resolver<'a> {
    fn new(read: &'a Crate) -> Self {
        let count = read.modules.len();
        let opened = vec![Vec::new(); count];
        let mut resolver = Resolver { read, opened };
        resolver.opened = (0..count).map(|module| resolver.globs(module)).collect();
        resolver
    }

    /// The modules that the globs of a module name.
    fn globs(&self, module: usize) -> Vec<usize> {
        let globs = self.read.modules[module].globs.iter();
        let opened = globs.filter_map(|glob| match self.resolve(module, glob)? {
            Place::Module(at) if at != module => Some(at),
            _ => None,
        });
        opened.collect()
    }

    /// Where a path in a module leads; `None` if to another crate.
    fn resolve(&self, module: usize, path: &[String]) -> Option<Place> {
        self.follow(module, path, &mut Seen::new())
    }

    fn follow(&self, module: usize, path: &[String], seen: &mut Seen) -> Option<Place> {
        let (first, mut rest) = path.split_first()?;
        let known = &self.read.modules[module];
        let mut at = match first.as_str() {
            "crate" => self.root(module),
            "self" => module,
            "super" => known.parent,
            name => match self.inside(module, name, rest.is_empty(), seen) {
                Some(Place::Module(at)) => at,
                None if known.defined.contains(name) => module,
                other => return other,
            },
        };
        while let Some((name, after)) = rest.split_first() {
            match self.inside(at, name, after.is_empty(), seen) {
                _ if name == "super" => at = self.read.modules[at].parent,
                Some(Place::Module(child)) => at = child,
                Some(other) => return Some(other),
                None => return Some(Place::Item(at, name.clone())),
            }
            rest = after;
        }
        Some(Place::Module(at))
    }

    /// What a name in a module refers to; `None` if the module itself defines it, or nothing in this crate does.
    fn inside(&self, module: usize, name: &str, is_last: bool, seen: &mut Seen) -> Option<Place> {
        let known = &self.read.modules[module];
        let child = known.children.get(name).copied().map(Place::Module);
        let import = known.imports.get(name);
        if child.is_some() && !(is_last && import.is_some()) {
            return child;
        }
        let step = (module, name.to_owned());
        if !seen.insert(step.clone()) {
            return child;
        }
        let found = match import {
            Some(path) => self.follow(module, path, seen).or(Some(Place::OtherCrate)),
            None if known.defined.contains(name) => None,
            None => self.opened[module].iter().find_map(|at| {
                let is_defined = self.read.modules[*at].defined.contains(name);
                let item = || is_defined.then(|| Place::Item(*at, name.to_owned()));
                self.inside(*at, name, is_last, seen).or_else(item)
            }),
        };
        seen.remove(&step);
        found
    }

    fn root(&self, module: usize) -> usize {
        match self.read.modules[module].parent {
            parent if parent == module => module,
            parent => self.root(parent),
        }
    }

    /// The module that a path names, if it re-exports the name: of another crate, or outside of roots and `mod.rs` of any
    /// file.
    fn re_exporter(&self, module: usize, path: &[String], place: Option<&Place>) -> Option<usize> {
        let (name, above) = path.split_last()?;
        let Place::Module(at) = self.resolve(module, above)? else {
            return None;
        };
        let known = &self.read.modules[at];
        let is_parent = known.parent == at || known.file.ends_with("mod.rs");
        let is_ours = matches!(place, Some(Place::Item(..) | Place::Module(_)));
        (known.imports.contains_key(name) && !(is_parent && is_ours)).then_some(at)
    }

    /// The names that each file uses from each other file.
    fn ties(&self) -> Ties<'a> {
        let mut ties = Ties::new();
        for (index, module) in self.read.modules.iter().enumerate() {
            let own = ties.entry(&module.file).or_default();
            let mut tie = |to: usize, name: &str| {
                let to = &*self.read.modules[to].file;
                if to != module.file {
                    own.entry(to).or_default().insert(name.to_owned());
                }
            };
            for path in &module.used {
                let called = match path.as_slice() {
                    [name] => name.strip_suffix('!'),
                    _ => None,
                };
                let place = match called {
                    Some(name) => {
                        let place = self.resolve(index, &[name.to_owned()]);
                        let textual =
                            || Some(Place::Item(*self.read.macros.get(name)?, name.to_owned()));
                        place.or_else(textual)
                    }
                    None => self.resolve(index, path),
                };
                if let (Some(at), Some(name)) =
                    (self.re_exporter(index, path, place.as_ref()), path.last())
                {
                    tie(at, name);
                }
                if let Some(Place::Item(to, name)) = place {
                    tie(to, &name);
                }
            }
            for name in &module.listed {
                if let Some(child) = module.children.get(name) {
                    tie(*child, name);
                }
            }
        }
        ties
    }
}

/// The names that each file of a crate uses from each other file.
pub fn ties(read: &Crate) -> Ties<'_> {
    Resolver::new(read).ties()
}

//! The contents of a URDD's mesh files, read once for all rules: the derived meshes (mesh and hull of each link, and
//! its pieces) and those that the URDF names.
//!
//! The three files of a mesh are compared while they are read, and one of them is kept.

pub mod cut;
pub mod derived;
pub mod expected;
pub mod file;
pub mod placed;
pub mod polytope;

use std::collections::HashMap;
use std::hash::{BuildHasher, RandomState};

use rayon::prelude::*;

use self::derived::Derived;
use self::file::Original;
use urdd_document::urdd::Urdd;
use urdd_format::registry::ModuleKind;
use urdd_geometry::Mesh;

#[derive(Debug, Default)]
pub struct Solids {
    /// In order of links and pieces.
    derived: HashMap<ModuleKind, Vec<Derived>>,
    contents: HashMap<(ModuleKind, usize, usize), usize>,
    originals: HashMap<String, Original>,
}

impl Solids {
    /// Reads every mesh file that the modules name, in parallel.
    pub fn read(urdd: &Urdd) -> Self {
        let mut solids = Solids { originals: file::read_originals(urdd), ..Solids::default() };
        for kind in urdd_document::meshes::DERIVED {
            let Some(meshes) = urdd.meshes(*kind) else { continue };
            solids.derived.insert(*kind, derived::read_all(urdd, &meshes));
        }
        solids.contents = solids.compare();
        solids
    }

    /// Numbers the contents of all sound meshes.
    fn compare(&self) -> HashMap<(ModuleKind, usize, usize), usize> {
        let all = self.derived.iter().flat_map(|(kind, meshes)| {
            let sound = meshes.iter().filter_map(|one| Some((one, one.sound()?)));
            sound.map(|(one, mesh)| ((*kind, one.link, one.piece), mesh))
        });
        let all: Vec<_> = all.collect();
        // Seeded at random: no one can make many meshes with the same hash.
        let seed = RandomState::new();
        let hashes: Vec<u64> = all
            .par_iter()
            .map(|(_, mesh)| {
                let numbers = mesh.vertices.as_flattened().iter();
                let bits: Vec<u64> = numbers.map(|x| x.to_bits()).collect();
                seed.hash_one((bits, mesh.triangles.as_flattened()))
            })
            .collect();
        let mut first: HashMap<u64, (usize, &Mesh)> = HashMap::new();
        let numbered =
            all.into_iter().zip(hashes).enumerate().map(|(at, ((place, mesh), hash))| {
                let (content, other) = *first.entry(hash).or_insert((at, mesh));
                (place, if mesh == other { content } else { at })
            });
        numbered.collect()
    }

    /// A number that is the same for meshes of the same vertices and triangles; `None` for a mesh that is not
    /// [sound](Solids::sound).
    pub fn content(&self, kind: ModuleKind, link: usize, piece: usize) -> Option<usize> {
        self.contents.get(&(kind, link, piece)).copied()
    }

    /// The meshes of a module of derived meshes, in order of links and pieces.
    pub fn derived(&self, kind: ModuleKind) -> &[Derived] {
        self.derived.get(&kind).map_or(&[], Vec::as_slice)
    }

    fn at(&self, kind: ModuleKind, link: usize, piece: usize) -> Option<&Derived> {
        let meshes = self.derived(kind);
        let place = meshes.binary_search_by_key(&(link, piece), |mesh| (mesh.link, mesh.piece));
        meshes.get(place.ok()?)
    }

    /// The mesh of a link (piece 0) or one of its pieces; `None` if the module has none, or none of its files can be
    /// read.
    pub fn mesh(&self, kind: ModuleKind, link: usize, piece: usize) -> Option<&Mesh> {
        self.at(kind, link, piece)?.mesh.as_ref()
    }

    /// The same, if all its files are sound and equal.
    pub fn sound(&self, kind: ModuleKind, link: usize, piece: usize) -> Option<&Mesh> {
        self.at(kind, link, piece)?.sound()
    }

    /// Whether a module names a mesh for a link (piece 0) or a piece.
    pub fn holds(&self, kind: ModuleKind, link: usize, piece: usize) -> bool {
        self.at(kind, link, piece).is_some()
    }

    /// A mesh that the URDF names, by its path in `original_meshes_module`.
    pub fn original(&self, path: &str) -> Option<&Original> {
        self.originals.get(path)
    }
}

//! The documents of the suite's valid URDDs of version 1, and what they count.

use std::collections::BTreeMap;
use std::path::Path;

use serde_json::{Value, json};
use testkit::files;
use testkit::fixture::{Fixture, ROOT, toy_robot};
use urdd_format::annotations::Thing;
use urdd_format::registry::ModuleKind;
use urdd_format::schema::Subject;

/// The documents of a URDD.
pub struct Urdd {
    /// Its folder's name.
    pub name: String,
    /// Those with a schema of version 1.
    pub documents: Vec<(Subject, Value)>,
    /// What it was made from.
    pub fixture: Option<Fixture>,
}

impl Urdd {
    fn new(name: &str, documents: impl Iterator<Item = (String, Value)>) -> Urdd {
        let found = documents.filter_map(|(name, document)| {
            let name = if name == ROOT { "root_metadata" } else { name.as_str() };
            let mut all = Subject::all().filter(|subject| subject.is_version_1());
            Some((all.find(|subject| subject.name() == name)?, document))
        });
        Urdd { name: name.to_owned(), documents: found.collect(), fixture: None }
    }

    /// That of a fixture.
    pub fn of_fixture(name: &str, fixture: Fixture) -> Urdd {
        let documents = fixture.documents.iter().map(|(folder, document)| {
            let name = folder.rsplit('/').next().unwrap_or_default();
            (name.to_owned(), document.clone())
        });
        let mut urdd = Urdd::new(name, documents.collect::<Vec<_>>().into_iter());
        urdd.fixture = Some(fixture);
        urdd
    }

    fn list(&self, module: &str, key: &str) -> Option<&Vec<Value>> {
        let (_, document) = self.documents.iter().find(|(subject, _)| subject.name() == module)?;
        document[key].as_array()
    }

    /// The number of a thing; of the elements and pieces, those of this link. `None` where the URDD does not have it.
    pub fn count(&self, thing: Thing, link: Option<usize>) -> Option<usize> {
        let length = |module, key| Some(self.list(module, key)?.len());
        let pieces = || self.list("convex_decomposition_meshes_module", "link_pieces");
        let of_link =
            |key: &str| Some(self.list("urdf_module", "links")?[link?][key].as_array()?.len());
        match thing {
            Thing::Link => length("urdf_module", "links"),
            Thing::Joint => length("urdf_module", "joints"),
            Thing::Dof => length("dof_module", "dofs"),
            Thing::Visual => of_link("visual"),
            Thing::Collision => of_link("collision"),
            Thing::Piece => Some(pieces()?[link?].as_array()?.len()),
            Thing::FullShape => {
                let hulls = self.list("convex_hull_meshes_module", "link_hulls")?;
                Some(hulls.iter().filter(|hull| !hull.is_null()).count())
            }
            Thing::DecompositionShape => {
                let lists = pieces()?.iter().map(|pieces| pieces.as_array().map_or(0, Vec::len));
                Some(lists.sum())
            }
            Thing::Part => length("composition_module", "parts"),
            Thing::Pair => length("self_collision_model_module", "pairs"),
            Thing::Sample => Some(1 << 32),
            Thing::Other => None,
        }
    }
}

/// The bases of `conformance/`, but those of legacy URDDs, and the examples.
pub fn bases() -> Vec<Urdd> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("conformance/bases");
    let mut all = files::below(&folder);
    let copies: BTreeMap<String, String> =
        serde_json::from_slice(&all["copies.json"]).expect("the list of copies");
    for (copy, stored) in copies {
        all.insert(copy, all[&stored].clone());
    }
    let mut documents: BTreeMap<String, Vec<(String, Value)>> = BTreeMap::new();
    for (path, bytes) in &all {
        let parts: Vec<&str> = path.split('/').collect();
        let (name, version) = match parts[..] {
            [base, "robot", "urdd.json"] => ((base, ROOT), "1.0.0".to_owned()),
            [base, "robot", .., module, "module.json"] => {
                let file = path.replace("module.json", "VERSION");
                let version =
                    all.get(&file).map(|bytes| String::from_utf8_lossy(bytes).trim().to_owned());
                ((base, module), version.unwrap_or_default())
            }
            _ => continue,
        };
        if version == "1.0.0" {
            let document = serde_json::from_slice(bytes).expect("JSON");
            documents.entry(name.0.to_owned()).or_default().push((name.1.to_owned(), document));
        }
    }
    let found = documents.into_iter();
    found
        .map(|(name, documents)| Urdd::new(&name, documents.into_iter()))
        .chain([with_named_configurations()])
        .collect()
}

/// The suite has this module in its cases, and in none of its bases.
fn with_named_configurations() -> Urdd {
    let home = json!({ "name": "home", "positions": [], "configuration": vec![0.0; 18] });
    let document = json!({ "configurations": [home] });
    let kind = ModuleKind::NamedConfigurations;
    let fixture = Fixture::core_with(&toy_robot(), kind, document);
    Urdd::of_fixture("named configurations", fixture)
}

//! The door to XML, and the readers behind it that are as those of other programs.

use std::sync::Arc;

use urdd_programs::{File, Mesh, MeshFacts, Program};
use urdd_xml::{Counted, Kind, MAX_ATTRIBUTES, MAX_LEVELS, MAX_NODES, MAX_ROBOT_ELEMENTS};

/// What is parsed is within the limits, and each program says of any bytes what it does and where, also if they are those
/// of the meshes.
pub fn programs(bytes: &[u8]) {
    if let Ok(text) = std::str::from_utf8(bytes) {
        is_within_limits(text);
    }
    let Ok(counted) = Counted::new(bytes, Kind::Robot) else {
        return;
    };
    let names = ["a.dae", "a.obj", "a.stl", "a"];
    let facts = names.map(|name| Mesh::Found(Arc::new(MeshFacts::of(name, bytes))));
    let meshes = |name: &str| {
        let known = names.iter().zip(&facts).find(|(known, _)| name.ends_with(**known));
        known.map_or(Mesh::Missing, |(_, mesh)| mesh.clone())
    };
    let file = File::new(counted, &meshes);
    for program in Program::ALL {
        for effect in program.read(&file).into_kept() {
            assert!(effect.at <= bytes.len(), "{}: {effect:?}", program.id());
            assert!(!effect.fault.to_string().is_empty(), "{}: {effect:?}", program.id());
        }
    }
}

fn is_within_limits(text: &str) {
    for (kind, most) in [(Kind::Robot, MAX_ROBOT_ELEMENTS), (Kind::Lenient, MAX_NODES)] {
        let document = match urdd_xml::parse(text, kind) {
            Ok(document) => document,
            Err(error) => {
                assert!(!error.words(text).is_empty());
                continue;
            }
        };
        let elements = document.descendants().filter(|node| node.is_element());
        let mut count = 0;
        for element in elements {
            count += 1;
            assert!(element.attributes().len() <= MAX_ATTRIBUTES);
            // The element itself, and the document, are among them.
            assert!(element.ancestors().count() <= MAX_LEVELS + 1);
        }
        assert!(count <= most);
    }
}

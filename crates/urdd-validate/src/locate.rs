//! Adds line, column and subject to places that only have a pointer: for the findings that are kept, in one pass
//! through each text.

use std::collections::BTreeMap;

use super::context::Subject;
use urdd_directory::discover::ROOT_METADATA;
use urdd_directory::position::{self, LineIndex, Position};
use urdd_document::shapes::Shapes;
use urdd_findings::finding::{Finding, Place};
use urdd_format::index::Count;
use urdd_format::registry::{ModuleDocument, ModuleKind};
use urdd_format::shape_kind::ShapeKind;

/// Completes the places of findings, and then those related to them.
pub(super) fn locate(subject: Subject<'_>, findings: &mut [Finding]) {
    let names = Names::new(subject);
    let places = findings.iter_mut().flat_map(Finding::places_mut);
    complete(subject, &names, places);
    let related = findings.iter_mut().flat_map(Finding::places_mut);
    complete(subject, &names, related.flat_map(|place| &mut place.related));
}

fn complete<'a>(subject: Subject<'_>, names: &Names, places: impl Iterator<Item = &'a mut Place>) {
    let mut by_file: BTreeMap<String, Vec<&mut Place>> = BTreeMap::new();
    for place in places {
        if let (Some(file), Some(_)) = (&place.file, &place.pointer) {
            by_file.entry(file.clone()).or_default().push(place);
        }
    }
    for (file, mut places) in by_file {
        let urdf = subject.described.urdf.ok().filter(|urdf| urdf.path == file);
        if let Some((text, kind)) = json_text(subject, &file) {
            let pointers: Vec<String> = places.iter().map(|place| pointer(place)).collect();
            let pointers: Vec<&str> = pointers.iter().map(String::as_str).collect();
            let positions = position::locate_all(text, &pointers);
            for (place, found) in places.iter_mut().zip(positions) {
                put_position(place, found);
                place.subject = kind.and_then(|kind| names.subject(kind, &pointer(place)));
            }
        } else if let (Some(urdf), Some(reading)) = (urdf, subject.described.urdf_text()) {
            let lines = LineIndex::new(&urdf.text);
            for place in places {
                place.subject = names.subject(ModuleKind::Urdf, &pointer(place));
                if place.line.is_none() {
                    // The pointer is into urdf_module, not into the XML.
                    put_position(place, reading.position(&lines, &pointer(place)));
                    place.pointer = None;
                }
            }
        }
    }
}

/// Sets line and column if the place has none.
fn put_position(place: &mut Place, position: Option<Position>) {
    if let (None, Some(position)) = (place.line, position) {
        place.line = Some(Count(position.line));
        place.column = Some(Count(position.column));
    }
}

fn pointer(place: &Place) -> String {
    place.pointer.clone().unwrap_or_default()
}

/// The text of a document, and its module.
fn json_text<'a>(subject: Subject<'a>, file: &str) -> Option<(&'a str, Option<ModuleKind>)> {
    let urdd = subject.urdd?;
    if file == ROOT_METADATA {
        return Some((urdd.metadata_file().json.text()?, None));
    }
    let folder = file.strip_suffix("/module.json")?;
    let mut modules = urdd.modules();
    let module = modules.find(|module| module.folder == folder)?;
    Some((module.json.text()?, module.kind))
}

/// Maximum length of a name in messages, characters.
const LONGEST: usize = 60;

struct Names<'a> {
    subject: Subject<'a>,
    shapes: Option<Shapes>,
}

impl<'a> Names<'a> {
    fn new(subject: Subject<'a>) -> Self {
        let shapes = subject.urdd.and_then(|urdd| urdd.shapes());
        Names { subject, shapes }
    }

    /// The target of a pointer into a module's document; `None` if it has no name.
    fn subject(&self, kind: ModuleKind, pointer: &str) -> Option<String> {
        let mut parts = pointer.split('/').skip(1);
        let key = parts.next()?;
        let rest: Vec<&str> = parts.collect();
        let index = |place: usize| rest.get(place)?.parse::<usize>().ok();
        match kind {
            ModuleKind::Urdf | ModuleKind::Chain => match key {
                "links" | "links_in_chain" => self.link(index(0)?),
                "joints" | "joints_in_chain" => self.joint(index(0)?),
                _ => None,
            },
            ModuleKind::Dof if key.starts_with("joint_idx") => self.joint(index(0)?),
            ModuleKind::Dof | ModuleKind::Bounds => self.dof(index(0)?),
            ModuleKind::Connections if key == "root_paths" => self.link(index(0)?),
            ModuleKind::Connections => match index(1) {
                Some(other) => {
                    Some(format!("{}, {}", self.link_name(index(0)?)?, self.link_name(other)?))
                }
                None => self.link(index(0)?),
            },
            ModuleKind::OriginalMeshes => match self.subject.urdd?.document(kind)? {
                ModuleDocument::OriginalMeshes(module) if key == "references" => {
                    self.link(module.references.get(index(0)?)?.link_idx.get())
                }
                ModuleDocument::OriginalMeshes(_) => None,
                _ => self.link(index(0)?),
            },
            ModuleKind::PlainMeshes | ModuleKind::ConvexHullMeshes => self.link(index(0)?),
            ModuleKind::ConvexDecompositionMeshes => self.piece(index(0)?, index(1)),
            ModuleKind::LinkShapesApproximations | ModuleKind::LinkShapesMaxDistanceFromOrigin => {
                match key.starts_with("decomposition") {
                    true => self.piece(index(0)?, index(1)),
                    false => self.link(index(0)?),
                }
            }
            ModuleKind::KinematicsSamples => match (key, rest.get(1), index(2)) {
                ("samples", Some(&"link_poses"), Some(link)) => self.link(link),
                _ => None,
            },
            ModuleKind::LinkShapesDistanceStatistics
            | ModuleKind::LinkShapesSimpleSkips
            | ModuleKind::LinkShapesSkips
            | ModuleKind::LinkShapesLieAlgErrorModels => self.shapes(pointer),
            _ => None,
        }
    }

    /// An element of a matrix over shapes: its two shapes.
    fn shapes(&self, pointer: &str) -> Option<String> {
        let shapes = self.shapes.as_ref()?;
        let parts = || pointer.split('/').skip(1);
        let kind = ShapeKind::ALL
            .into_iter()
            .find(|kind| parts().any(|part| part.starts_with(kind.key())))?;
        let mut indices = parts().filter_map(|part| part.parse::<usize>().ok());
        let shape = |index: usize| match kind.is_of_links() {
            true => self.link_name(*shapes.full.get(index)?),
            false => {
                let (link, piece) = *shapes.pieces.get(index)?;
                Some(format!("{} piece {piece}", self.link_name(link)?))
            }
        };
        let first = shape(indices.next()?)?;
        match indices.next() {
            Some(second) => Some(format!("{first}, {}", shape(second)?)),
            None => Some(first),
        }
    }

    fn link(&self, link: usize) -> Option<String> {
        Some(format!("link {}", self.link_name(link)?))
    }

    fn piece(&self, link: usize, piece: Option<usize>) -> Option<String> {
        let link = self.link(link)?;
        Some(match piece {
            Some(piece) => format!("{link} piece {piece}"),
            None => link,
        })
    }

    fn joint(&self, joint: usize) -> Option<String> {
        let joint = self.subject.described.robot()?.joints.get(joint)?;
        Some(format!("joint {}", quoted(&joint.name)))
    }

    fn dof(&self, dof: usize) -> Option<String> {
        let joint = self.subject.urdd?.dofs()?.dof_idx_to_joint_idx_mapping.get(dof)?.get();
        Some(format!("DOF {dof} of {}", self.joint(joint)?))
    }

    fn link_name(&self, link: usize) -> Option<String> {
        let link = self.subject.described.robot()?.links.get(link)?;
        Some(quoted(&link.name))
    }
}

fn quoted(name: &str) -> String {
    match name.char_indices().nth(LONGEST) {
        Some((end, _)) => format!("`{}…`", &name[..end]),
        None => format!("`{name}`"),
    }
}

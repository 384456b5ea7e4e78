//! What programs do with a URDF: asks their readers, with the mesh files that they ask for.

pub mod attach;
mod faults;

use std::cell::RefCell;
use std::collections::HashMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use urdd_directory::limits::MAX_DOCUMENT_BYTES;
use urdd_directory::position::LineIndex;
use urdd_format::index::Count;
use urdd_format::report::{ProgramEffect, ProgramResult};
use urdd_programs::{Effect, Effects, File, Mesh, MeshFacts, Program};
use urdd_source::gate::Gate;
use urdd_source::{FoundMesh, TextOffsets};
use urdd_xml::Counted;

use crate::settings::LintSettings;
use faults::{Faulty, Said, faults};

/// Maximum number of effects of a program in a report; the rest are counted.
const KEPT: usize = 1_000;

pub struct Asked {
    /// What reports say.
    pub results: Vec<ProgramResult>,
    /// The faults that programs name, in order of place.
    faults: Vec<Faulty>,
    /// Whether the settings name programs.
    has_chosen: bool,
}

impl Asked {
    /// Asks the programs that the settings name, and those that are always asked, about a file of which `text` is the text;
    /// `offsets` says where its bytes are there. Relative names refer to `folder`.
    pub fn about(
        file: Counted<'_>,
        text: &str,
        offsets: &TextOffsets,
        folder: &Path,
        settings: &LintSettings,
    ) -> Self {
        let meshes = MeshFiles::new(folder, settings);
        meshes.gate.account().deposit(text.len());
        let find = |name: &str| meshes.mesh(name);
        let file = File::new(file, &find);
        let lines = LineIndex::new(text);
        let mut chosen: Vec<Program> = Vec::new();
        for program in settings.report.programs.iter().flat_map(|name| Program::of_name(name)) {
            if !chosen.contains(&program) {
                chosen.push(program);
            }
        }
        chosen.retain(|program| program.is_for(&file));
        let others = Program::ALL.into_iter().filter(|one| one.is_asked() && !chosen.contains(one));
        let others = others.filter(|one| one.is_for(&file));
        let (mut results, mut said) = (Vec::new(), Vec::new());
        for program in chosen.iter().copied().chain(others) {
            if settings.source.cancellation.is_cancelled() {
                break;
            }
            let is_chosen = chosen.contains(&program);
            let mut effects = program.read(&file);
            for effect in effects.kept_mut() {
                effect.at = offsets.of(effect.at);
            }
            results.push(result(program, is_chosen, &effects, &lines));
            let effects = effects.into_kept().into_iter();
            said.extend(effects.map(|effect| Said { program, is_chosen, effect }));
        }
        let has_chosen = !settings.report.programs.is_empty();
        Asked { results, faults: faults(said, text), has_chosen }
    }
}

/// What a program does, as reports have it.
fn result(
    program: Program,
    is_chosen: bool,
    effects: &Effects,
    lines: &LineIndex,
) -> ProgramResult {
    let effect = |effect: &Effect| {
        let at = lines.position(effect.at);
        ProgramEffect {
            does: effect.deed,
            line: Some(Count(at.line)),
            column: Some(Count(at.column)),
            part: Some(effect.part.to_string()).filter(|part| !part.is_empty()),
            reason: effect.fault.to_string(),
            makes: effect.makes.clone(),
            is_usual: effect.fault.is_usual(),
            is_supposed: effect.is_supposed,
        }
    };
    let mut all: Vec<_> = effects.kept().iter().collect();
    all.sort_by_key(|effect| (effect.at, effect.deed));
    ProgramResult {
        program: program.id().to_owned(),
        name: program.name().to_owned(),
        family: program.family().to_owned(),
        version: program.version().to_owned(),
        is_chosen,
        does: effects.worst_unusual(),
        effects_cut: Count::saturating(all.len().saturating_sub(KEPT) + effects.cut()),
        effects: all.into_iter().take(KEPT).map(effect).collect(),
    }
}

/// Maximum length of a name that is looked for once, bytes.
const MOST_BYTES: usize = 250;

/// The mesh files around a URDF. Each name is looked for once, and each file is read once.
struct MeshFiles<'a> {
    folder: PathBuf,
    settings: &'a LintSettings,
    gate: Gate,
    by_name: RefCell<HashMap<String, Mesh>>,
    /// By the ending of their names, which says as what a file is read.
    by_file: RefCell<HashMap<(PathBuf, String), Mesh>>,
}

impl<'a> MeshFiles<'a> {
    fn new(folder: &Path, settings: &'a LintSettings) -> Self {
        let folder = settings.source.files.canonicalize(folder);
        let folder = folder.unwrap_or_else(|_| PathBuf::from("."));
        let gate = Gate::new(&folder, &settings.source);
        let (by_name, by_file) = (RefCell::default(), RefCell::default());
        MeshFiles { folder, settings, gate, by_name, by_file }
    }

    /// What is there under a name. Where packages are missing, or files are outside of those that may be read, nothing is known.
    fn mesh(&self, name: &str) -> Mesh {
        if self.settings.without_meshes {
            return Mesh::Unknown;
        }
        if let Some(known) = self.by_name.borrow().get(name) {
            return known.clone();
        }
        let mesh = match name.split_once("://") {
            // A program may fetch it.
            Some(("http" | "https" | "ftp", _)) => Mesh::Unknown,
            Some(_) => self.packaged(name),
            None => self.plain(name),
        };
        // Programs put folders before names: many long ones are not kept.
        if name.len() <= MOST_BYTES {
            self.by_name.borrow_mut().insert(name.to_owned(), mesh.clone());
        }
        mesh
    }

    /// A path from the URDF's folder. Most of those that programs try are not there.
    fn plain(&self, name: &str) -> Mesh {
        let path = self.folder.join(name);
        if name.is_empty() || !self.gate.files().is_file(&path) {
            return Mesh::Missing;
        }
        self.gate.at(&path).map_or(Mesh::Unknown, |found| self.read(&found, name))
    }

    fn packaged(&self, name: &str) -> Mesh {
        match self.gate.find(name) {
            // Other programs take names as they are written.
            Ok(found) if found.assumed.is_some() || name.trim() != name => Mesh::Missing,
            Ok(found) => self.read(&found, name),
            Err(why) if why.stopped.is_some() => Mesh::Unknown,
            Err(why) if why.outside.is_some() => Mesh::Unknown,
            Err(why) if why.no_package.is_some() => Mesh::NoPackage,
            Err(_) => Mesh::Missing,
        }
    }

    fn read(&self, found: &FoundMesh, name: &str) -> Mesh {
        let ending = name.rsplit_once('.').map_or("", |(_, ending)| ending).to_lowercase();
        let key = (found.file.clone(), ending);
        if let Some(known) = self.by_file.borrow().get(&key) {
            return known.clone();
        }
        let bytes = self.gate.bytes(found, MAX_DOCUMENT_BYTES);
        let facts = bytes.map(|bytes| Arc::new(MeshFacts::of(name, &bytes)));
        let mesh = facts.map_or(Mesh::Unknown, Mesh::Found);
        self.by_file.borrow_mut().insert(key, mesh.clone());
        mesh
    }
}

//! Imports a description: what is written of it, and where what is written came from.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use serde_json::{Value, json};
use sha2::{Digest, Sha256};
use urdd_directory::account::AccountError;
use urdd_directory::limits::{MAX_DOCUMENT_BYTES, MAX_SETUP_BYTES, MAX_SRDF_BYTES};
use urdd_directory::path::{self, portable};
use urdd_directory::writer::sha256;
use urdd_format::link_shapes_skips::SkipEdit;
use urdd_format::named_configurations::ConfigurationEdit;
use urdd_format::registry::PROGRAM_VERSION;
use urdd_geometry::primitives;
use urdd_geometry::read::Part;
use urdd_geometry::write::obj;
use urdd_source::beside::{Beside, Carried};
use urdd_source::gate::Gate;
use urdd_source::note::{Note, NoteKind};
use urdd_source::{
    Files, Format, ImportOptions, MAX_SOURCE_BYTES, Packages, Settings, Source, SourceError,
    SourceMeshes, format_of, load, load_with, stem,
};
use urdd_xml::Xml;

use crate::fault::ImportFault;
use crate::features::Report;
use crate::model::{Geometry, Model};
use crate::place::{Place, Placed, Positions, Refusal, TextFile, at, placed};
use crate::tree::Tree;
use crate::urdf::{self, UNIT_SPHERE, urdf};
use crate::{mjcf, sdf, usd};

/// What is put behind a name for the file that exports read.
const SETUP: &str = ".export.toml";
/// The same for what closes chains.
const LOOPS: &str = ".loops.toml";
/// The same for named configurations and pairs.
const SRDF: &str = ".srdf";

/// A description of another format as a URDF and its companions, in memory.
#[derive(Debug, Clone)]
pub struct Imported {
    /// The name of the URDF: `NAME.urdf`.
    pub urdf: String,
    /// The files, by path relative to the folder of the URDF: the URDF, `NAME.srdf`, `NAME.export.toml`,
    /// meshes and images.
    pub files: BTreeMap<String, Arc<[u8]>>,
    /// The named configurations.
    pub configurations: Vec<ConfigurationEdit>,
    /// The pairs of links that are never checked.
    pub skips: Vec<SkipEdit>,
    /// What was carried, and what was lost.
    pub report: Report,
    /// The original, for `urdd.json`.
    pub origin: Value,
    /// The description, as the user named it.
    pub shown: String,
    /// Its text.
    pub original: String,
    /// The other files that were read: what it includes, meshes, images.
    pub read: Vec<PathBuf>,
    /// The place of each link and joint in the original, by kind and name: file, line, column.
    places: BTreeMap<(&'static str, String), (Arc<str>, u32, u32)>,
}

impl Imported {
    /// Settings by which the URDF is found in memory.
    ///
    /// # Errors
    /// If the files are more than memory may hold.
    pub fn settings(&self, settings: &Settings) -> Result<Settings, SourceError> {
        let files = self.files.iter().map(|(path, bytes)| (path.clone(), Arc::clone(bytes)));
        let files = Files::in_memory(files);
        let files = files.map_err(|why| SourceError::unread(&self.shown, why))?;
        let packages = Packages::default();
        Ok(Settings {
            files,
            packages,
            allowed_folders: Vec::new(),
            loops: self.at(LOOPS).map(|name| Path::new("/").join(name)),
            ..settings.clone()
        })
    }

    /// Reads the URDF. Errors and notes name the description, without a place: nobody has the URDF on disk. `settings` are
    /// those of [`Imported::settings`].
    ///
    /// # Errors
    /// If it is not a valid robot.
    pub fn load(&self, settings: &Settings) -> Result<Source, SourceError> {
        Ok(self.load_with(settings, |_, _| ())?.0)
    }

    /// As [`Imported::load`]; `also` reads the text, too: see [`load_with`].
    fn load_with<T>(
        &self,
        settings: &Settings,
        also: impl FnOnce(&Xml<'_>, bool) -> T,
    ) -> Result<(Source, T), SourceError> {
        let loaded = load_with(&Path::new("/").join(&self.urdf), settings, also);
        let (mut source, also) = loaded.map_err(|error| match error {
            SourceError::Refused { mut faults, .. } => {
                faults.iter_mut().for_each(|fault| (fault.line, fault.column) = (0, 0));
                SourceError::Refused { file: self.shown.clone(), faults }
            }
            error => error,
        })?;
        for note in &mut source.notes {
            note.file.clone_from(&self.shown);
            (note.line, note.column) = (0, 0);
        }
        Ok((source, also))
    }

    /// What exports need and a URDF does not say: the content of `NAME.export.toml`.
    pub fn setup(&self) -> Option<&[u8]> {
        self.beside(SETUP)
    }

    /// The named configurations, and the pairs that never collide: the content of `NAME.srdf`.
    pub fn srdf(&self) -> Option<&[u8]> {
        self.beside(SRDF)
    }

    /// What is in the folder that the files are written to, and will be read with the URDF, though this import has none of
    /// its kind: an earlier import may have left it. A sentence for each.
    pub fn left_in(&self, folder: &Path) -> Vec<String> {
        let base = self.urdf.strip_suffix(".urdf").unwrap_or(&self.urdf);
        let names = [SRDF, LOOPS, SETUP].map(|ending| format!("{base}{ending}"));
        let left = names.iter().filter(|name| !self.files.contains_key(*name));
        let left = left.map(|name| folder.join(name)).filter(|path| path.exists());
        let words = "is not of this import, and commands read it with the URDF: delete it if an earlier import made it";
        left.map(|path| format!("{}: {words}", path.display())).collect()
    }

    fn beside(&self, ending: &str) -> Option<&[u8]> {
        self.files.get(&self.at(ending)?).map(|bytes| &**bytes)
    }

    /// The file of this ending, if it is there.
    fn at(&self, ending: &str) -> Option<String> {
        let name = self.urdf.strip_suffix(".urdf").unwrap_or(&self.urdf);
        Some(name.to_owned() + ending).filter(|name| self.files.contains_key(name))
    }

    /// The text of the URDF.
    pub fn text(&self) -> &str {
        let bytes = self.files.get(&self.urdf);
        bytes.and_then(|bytes| std::str::from_utf8(bytes).ok()).unwrap_or_default()
    }

    /// Where a `link` or `joint` of the URDF stands in the original: file, line, column.
    pub fn place(&self, kind: &str, name: &str) -> Option<(&str, u32, u32)> {
        let kind = if kind == "link" { "link" } else { "joint" };
        let (file, line, column) = self.places.get(&(kind, name.to_owned()))?;
        Some((file, *line, *column))
    }
}

/// Imports a description, if it is MJCF, SDF or USD by its content; `None` of anything else.
///
/// # Errors
/// If it is refused, with the place.
pub fn import(path: &Path, settings: &Settings) -> Result<Option<Imported>, SourceError> {
    let options = &settings.import;
    // A URDF is not read twice.
    let Some(format) = format_of(path, &settings.files) else { return Ok(None) };
    let shown = path.display().to_string();
    if settings.loops.is_some() {
        return Err(SourceError::SaysItsLoops { file: shown, format: format.name() });
    }
    let most = match format {
        Format::Mjcf | Format::Sdf => MAX_SOURCE_BYTES,
        // With meshes in it.
        Format::Usd => MAX_DOCUMENT_BYTES,
    };
    let bytes = settings.files.read(path, most);
    let bytes = bytes.map_err(|why| SourceError::unread(&shown, why))?;
    let canonical = settings.files.canonicalize(path);
    let canonical = canonical.map_err(|why| SourceError::unread(&shown, why))?;
    let folder = canonical.parent().unwrap_or(Path::new("/"));
    let gate = Gate::of_project(folder, settings);
    gate.account().deposit(bytes.len());
    let file = match format {
        Format::Mjcf | Format::Sdf => TextFile::new(shown.clone(), canonical.clone(), bytes),
        Format::Usd => Ok(TextFile::any(shown.clone(), canonical.clone(), bytes.into())),
    };
    let Ok(file) = file else { return Ok(None) };
    let read = match format {
        Format::Mjcf => mjcf::read(file, &gate, options),
        Format::Sdf => sdf::read(file, &gate, options),
        Format::Usd => usd::read(file, &gate, options),
    };
    let mut model = read.map_err(refused)?;
    if model.name.trim().is_empty() {
        model.name = stem(&canonical);
    }
    let made = written(model, format, shown, options, &gate)?;
    Ok(Some(Imported { read: gate.into_read(), ..made }))
}

fn refused(Placed { file, line, column, fault }: Placed) -> SourceError {
    if let ImportFault::Account(AccountError::Cancelled(why)) = fault {
        return why.into();
    }
    SourceError::Import { file, line, column, fault: fault.to_string() }
}

/// As [`import`], and checks that what comes out is a robot.
///
/// # Errors
/// As for [`import`]; also if the file is a URDF, or cannot be read.
pub fn import_whole(path: &Path, settings: &Settings) -> Result<(Imported, Source), SourceError> {
    let Some(imported) = import(path, settings)? else {
        // An error that says more, if it cannot be read.
        load(path, settings)?;
        return Err(SourceError::IsUrdf { file: path.display().to_string() });
    };
    let source = imported.load(&imported.settings(settings)?)?;
    Ok((imported, source))
}

/// Opens a description and finds its mesh files. Those of one that is imported are in memory. `also` reads the text, too: see
/// [`load_with`].
///
/// # Errors
/// If it cannot be read or is not a valid robot. A missing mesh is not an error.
pub fn open<T>(
    path: &Path,
    settings: &Settings,
    also: impl FnOnce(&Xml<'_>, bool) -> T,
) -> Result<(SourceMeshes, T), SourceError> {
    let Some(imported) = import(path, settings)? else {
        let (source, also) = load_with(path, settings, also)?;
        return Ok((SourceMeshes::of(source, settings, None)?, also));
    };
    let settings = imported.settings(settings)?;
    let (source, also) = imported.load_with(&settings, |xml, _| also(xml, false))?;
    let text = |bytes: &[u8]| Ok(String::from_utf8_lossy(bytes).into_owned());
    let beside = Beside {
        srdf: imported.srdf().map(text),
        setup: imported.setup().map(text),
        import: Some(Carried {
            lost: imported.report.lost().map(|(what, n)| (what.to_owned(), n)).collect(),
            configurations: imported.configurations,
        }),
    };
    Ok((SourceMeshes::of(source, &settings, Some(beside))?, also))
}

fn written(
    model: Model,
    format: Format,
    shown: String,
    options: &ImportOptions,
    gate: &Gate,
) -> Result<Imported, SourceError> {
    let too_much = |why: Refusal| refused(placed(&model.files, why));
    let account = gate.account();
    let tree = Tree::of(&model, options, account).map_err(too_much)?;
    let whole = |why: AccountError| too_much(at(Place::default(), why));
    let original = portable(shown.rsplit(['/', '\\']).next().unwrap_or_default());
    let base = match model.name.trim_start_matches(['.', '-']) {
        "" => "robot",
        name => name,
    };
    // With the longest ending that one of its files has.
    let base = path::file_name(base, SETUP);
    let base = base.strip_suffix(SETUP).unwrap_or(&base);
    let name = format!("{base}.urdf");
    let mut files: BTreeMap<String, Arc<[u8]>> = BTreeMap::new();
    let text = urdf(&model, &tree, &original, options, account).map_err(too_much)?;
    files.insert(name.clone(), text.into_bytes().into());
    let companions = [
        (SRDF, urdf::srdf(&model, &tree, &original, account).map_err(whole)?),
        (LOOPS, urdf::loops(&model, account).map_err(whole)?),
        (SETUP, urdf::setup(&model, &tree, account).map_err(whole)?),
    ];
    for (ending, text) in companions {
        let Some(text) = text else { continue };
        let limit = if ending == SRDF { MAX_SRDF_BYTES } else { MAX_SETUP_BYTES };
        // What is written must be readable.
        if text.len() as u64 > limit {
            let reason = format!(
                "its `{base}{ending}` would be longer than {} MiB; shorten what is repeated: names, configurations, pairs",
                limit >> 20
            );
            return Err(SourceError::unread(&shown, reason));
        }
        files.insert(base.to_owned() + ending, text.into_bytes().into());
    }
    let mut has_ellipsoids = false;
    for body in model.bodies.walk(account).map_err(whole)? {
        let mut shapes = body.shapes.walk(account).map_err(whole)?;
        has_ellipsoids |= shapes.any(|shape| matches!(shape.geometry, Geometry::Ellipsoid(_)));
    }
    if has_ellipsoids {
        let part = Part { mesh: primitives::sphere(1.0), ..Part::default() };
        let sphere = obj(&[part]).map_err(|error| SourceError::Internal {
            file: shown.clone(),
            reason: error.to_string(),
        })?;
        files.insert(UNIT_SPHERE.to_owned(), sphere.into());
    }
    for asset in model.assets.walk(account).map_err(whole)? {
        files.insert(asset.path.clone(), Arc::clone(&asset.bytes));
    }
    let links =
        tree.links.walk(account).map_err(whole)?.map(|link| ("link", &link.name, link.place));
    let joints =
        tree.joints.walk(account).map_err(whole)?.map(|edge| ("joint", &edge.name, edge.place));
    let positions = Positions::of(&model.files);
    let shown_files: Vec<Arc<str>> = model.files.iter().map(|file| (&*file.shown).into()).collect();
    let places = links.chain(joints).filter_map(|(kind, name, place)| {
        let (_, line, column) = positions.at(place)?;
        Some(((kind, name.clone()), (Arc::clone(&shown_files[place.file]), line, column)))
    });
    let mut report =
        Report::of(&model.name, &model.tally, format, &positions, &gate.all_elsewhere());
    if base != model.name {
        report.remarks.push(Note::of_file(
            &shown,
            NoteKind::Otherwise,
            "the name of the robot is not one that all file systems take",
            format!("its files are named after `{base}`"),
        ));
    }
    Ok(Imported {
        places: places.collect(),
        configurations: urdf::configurations(&model, &tree, account).map_err(whole)?,
        skips: urdf::skips(&model, account).map_err(whole)?,
        report,
        origin: origin(format, &model.files),
        original: model.files.first().map_or_else(String::new, |file| file.text.clone()),
        urdf: name,
        files,
        shown,
        read: Vec::new(),
    })
}

/// The value of `x_urdd_imported`: the format, each file with its size and hash, and the importer.
fn origin(format: Format, files: &[TextFile]) -> Value {
    let entry = |file: &TextFile| {
        let name = file.shown.rsplit(['/', '\\']).next().unwrap_or_default();
        json!({
            "name": name,
            "size": file.bytes.len(),
            "sha256": sha256(&Sha256::digest(&file.bytes)).as_str(),
        })
    };
    json!({
        "format": format.name(),
        "files": files.iter().map(entry).collect::<Vec<_>>(),
        "importer": format!("urdd {PROGRAM_VERSION}"),
    })
}

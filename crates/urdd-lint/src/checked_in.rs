//! A URDF beside the xacro file that makes it: what xacro makes of that file now, and where the URDF says something else.

use std::collections::{BTreeMap, HashSet};
use std::path::{Path, PathBuf};

use urdd_directory::file_type::FileType;
use urdd_format::escape;
use urdd_format::readable::first_of;
use urdd_source::checked_in::xacros_of;
use urdd_source::described::{FileKind, describe};
use urdd_source::gate::Gate;
use urdd_source::macros::has_no_link;
use urdd_source::robots::Job;
use urdd_source::{Settings, SourceError, SourceText, read_source, robots_of};
use urdd_xml::{Node, Xml};

use crate::meaning::{Differences, differences};

/// Maximum number of files that are named.
const MAX_NAMED: usize = 5;

/// What xacro makes of a file: a text for each declared robot.
pub fn made(xacro: &Path, settings: &Settings) -> Vec<Result<SourceText, SourceError>> {
    let robots = robots_of(xacro.to_owned(), &settings.robots);
    let made =
        robots.iter().map(|robot| read_source(xacro, &settings.with_declared(&robot.arguments)));
    made.collect()
}

/// The xacro files beside the URDFs of a run that nobody runs, although they may be robots.
pub fn not_made(jobs: &[Job], settings: &Settings) -> Vec<PathBuf> {
    if settings.xacro.expand_urdf {
        return Vec::new();
    }
    let all: HashSet<&Path> = jobs.iter().map(|job| job.source.as_path()).collect();
    let urdfs = all.iter().filter(|file| FileType::Urdf.is_of(file));
    let xacros = urdfs.flat_map(|urdf| xacros_of(urdf, &settings.files));
    let mut xacros: Vec<PathBuf> = xacros.filter(|one| !all.contains(one.as_path())).collect();
    xacros.retain(|xacro| may_be_robot(xacro, settings));
    xacros.sort();
    xacros
}

/// What is said of xacro files that make the `.urdf` beside them, and of those that nobody ran.
pub fn asides(same: &[&Path], not_made: &[PathBuf]) -> Vec<String> {
    let named = |files: &mut dyn Iterator<Item = &Path>| {
        let shown: Vec<String> = files.map(|file| format!("`{}`", file.display())).collect();
        (!shown.is_empty()).then(|| (shown.len(), first_of(shown.into_iter(), MAX_NAMED)))
    };
    let same = named(&mut same.iter().copied()).map(|(count, files)| {
        let makes = if count == 1 { "xacro file makes" } else { "xacro files make" };
        format!("{count} {makes} the `.urdf` of the same name, which is examined: {files}")
    });
    let not_made = named(&mut not_made.iter().map(PathBuf::as_path)).map(|(count, files)| {
        let was = if count == 1 { "xacro file was" } else { "xacro files were" };
        format!(
            "{count} {was} not compared with the `.urdf` of the same name: {files}; --xacro runs and compares them"
        )
    });
    let lines = same.into_iter().chain(not_made);
    lines.map(|line| escape::line(&line).to_string()).collect()
}

/// Whether a xacro file may be a robot by its text. Nothing is run.
pub fn may_be_robot(xacro: &Path, settings: &Settings) -> bool {
    let described = describe(&[xacro.to_owned()], &BTreeMap::new(), settings);
    described.files.iter().all(|file| file.kind == FileKind::Robot)
}

/// The differences of a URDF in a folder from what xacro makes; `None` if that is no robot.
pub fn compared<'a>(
    urdf: Node<'a, 'a>,
    made: &Xml<'_>,
    folder: &Path,
    settings: &Settings,
) -> Option<Differences<'a>> {
    let root = made.document().ok().filter(|_| !has_no_link(made))?.root_element();
    let gate = Gate::of_project(folder, settings);
    let file = |name: &str| gate.find(name).ok().map(|found| found.file);
    Some(differences(urdf, root, &|a, b| file(a).is_some_and(|a| file(b) == Some(a))))
}

/// The text of a URDF that is checked in; `None` if it is not there, is not well-formed, or is xacro itself.
pub fn text(urdf: &Path, settings: &Settings) -> Option<SourceText> {
    let mut plain = settings.clone();
    plain.xacro.expand_urdf = false;
    let read = read_source(urdf, &plain).ok()?;
    let is_plain = !read.text.contains("<xacro:") && Xml::new(&read.text).document().is_ok();
    is_plain.then_some(read)
}

/// Whether a URDF is what xacro makes.
pub fn is_same(urdf: &Path, made: &Xml<'_>, settings: &Settings) -> bool {
    let Some(read) = text(urdf, settings) else { return false };
    let xml = Xml::new(&read.text);
    let compared =
        |root| compared(root, made, &read.folder, settings).is_some_and(|found| found.count == 0);
    xml.document().is_ok_and(|document| compared(document.root_element()))
}

//! The SRDFs of a URDF: where they are looked for, and which of them are of its robot.

use std::cell::LazyCell;
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use urdd_directory::file_type::{self, FileType};
use urdd_directory::limits::MAX_SRDF_BYTES;
use urdd_format::escape;
use urdd_format::readable::first_of;
use urdd_source::arguments::arguments;
use urdd_source::robots::Batch;
use urdd_source::{Files, Settings, Trail, read_source};
use urdd_srdf::vocabulary::parts;
use urdd_xml::Node;

use crate::beside::{Srdf, SrdfFile};
use crate::subject::Subject;

/// Maximum number of SRDFs that xacro is run for to find those of a robot.
const MAX_EXPANDED: usize = 10;
/// Maximum number of SRDFs that are read to find those of a robot.
const MAX_SRDFS: usize = 100;
/// How far up from the URDF's folder its package and those of MoveIt are looked for: from `urdf/NAME` of a package.
const LEVELS: usize = 4;
/// The folders of SRDFs, which may have a folder for each robot.
const FOLDERS: [&str; 2] = ["config", "srdf"];
/// Maximum number of folders that are looked in.
const MAX_FOLDERS: usize = 200;
/// Maximum number of files that are named.
const MAX_NAMED: usize = 5;
/// What the name of MoveIt's package of a robot has.
const MOVEIT: &str = "moveit_config";

/// The SRDFs of the robot: each whose file has the URDF's name, unless its robot has another URDF's beside it, those of its own
/// package before others; or else the only one whose robot has the robot's name, or the only one there is, beside the only URDF,
/// if most of the names in it are the URDF's. No other URDF beside this one has its file's name.
pub fn of_robot<'s, 'a>(urdf: &'s Subject<'a>) -> &'s [Srdf<'a>] {
    urdf.srdfs.get_or_init(|| read(urdf))
}

fn read<'a>(urdf: &Subject<'a>) -> Vec<Srdf<'a>> {
    let all = urdf.srdf_files.get_or_init(|| candidates(urdf));
    let has_stem = all.iter().any(|one| one.has_stem);
    let has_own = all.iter().any(|one| one.has_stem && one.is_own);
    let is_urdf = |name: &String| FileType::Urdf.is_of(Path::new(name));
    let is_only_urdf = urdfs(urdf).filter(is_urdf).count() < 2;
    let is_only = all.len() == 1 && is_only_urdf;
    let mut found: Vec<Srdf> = all.iter().map(Srdf::new).collect();
    found.retain(|one| match has_stem {
        true if has_own && !one.file.is_own => false,
        true => one.file.has_stem && !names_another(urdf, one) && is_of(urdf, one, true),
        false => {
            let is_near = is_only && one.file.is_own;
            let own = stem(&one.file.path);
            // No other URDF beside this one has its name.
            !urdfs(urdf).any(|name| stem(Path::new(&name)) == own) && is_of(urdf, one, is_near)
        }
    });
    if !has_stem && found.len() > 1 {
        return Vec::new();
    }
    found
}

/// The pairs of links, each in order, of which an SRDF says that their collisions are not checked.
pub fn disabled_pairs(urdf: &Subject) -> BTreeSet<(String, String)> {
    let mut pairs = BTreeSet::new();
    for srdf in of_robot(urdf) {
        let Ok(document) = srdf.document() else { continue };
        let disabled = document
            .descendants()
            .filter(|node: &Node| node.tag_name().name() == "disable_collisions");
        pairs.extend(disabled.filter_map(|node| {
            let (a, b) = (node.attribute("link1")?, node.attribute("link2")?);
            Some((a.min(b).to_owned(), a.max(b).to_owned()))
        }));
    }
    pairs
}

/// Whether what an SRDF says fits the robot. `is_near` if where it is speaks for it; then the robot's name need not be its own.
fn is_of(urdf: &Subject, one: &Srdf, is_near: bool) -> bool {
    let name = urdf.root.attribute("name").unwrap_or_default();
    let Ok(document) = one.document() else {
        return is_near || one.file.text.contains(&format!("\"{name}\""));
    };
    let root = document.root_element();
    let has_name = root.attribute("name").is_some_and(|found| found.trim() == name);
    if has_name && one.file.has_stem && one.file.is_own {
        return true;
    }
    let known: BTreeSet<&str> = urdf.names(&urdf.links).chain(urdf.names(&urdf.joints)).collect();
    let named = root.descendants().flat_map(parts);
    let named: BTreeSet<&str> = named.map(|(_, _, name)| name).collect();
    let fits = 2 * named.intersection(&known).count() >= named.len();
    fits && (has_name || is_near)
}

/// Whether the robot of an SRDF, by its name, is that of another URDF beside this one.
fn names_another(urdf: &Subject, one: &Srdf) -> bool {
    let Ok(document) = one.document() else { return false };
    let name = document.root_element().attribute("name").unwrap_or_default().trim();
    let is_own = |name: &str| urdf.root.attribute("name") == Some(name);
    let wanted = name.to_lowercase();
    !is_own(name)
        && wanted != stem(Path::new(urdf.file))
        && urdfs(urdf).any(|file| stem(Path::new(&file)) == wanted)
}

/// The names of the URDFs in the URDF's folder.
fn urdfs(urdf: &Subject) -> impl Iterator<Item = String> {
    let is_urdf = |name: &String| {
        matches!(FileType::of(Path::new(name)), Some(FileType::Urdf | FileType::Xacro))
    };
    names(urdf.files, urdf.folder).into_iter().filter(is_urdf)
}

/// A file's name without its endings, in small letters.
fn stem(path: &Path) -> String {
    file_type::stem(path).to_lowercase()
}

fn candidates(urdf: &Subject) -> Vec<SrdfFile> {
    let wanted = stem(Path::new(urdf.file));
    let (mut seen, mut found) = (BTreeSet::new(), Vec::new());
    let mut expanded = 0;
    let of_urdf = LazyCell::new(|| defaults(urdf));
    let ends = |name: &String| FileType::of_made(Path::new(name)) == Some(FileType::Srdf);
    for (folder, shown, is_own) in folders(urdf.files, urdf.folder) {
        for name in names(urdf.files, &folder).into_iter().filter(ends) {
            let path = folder.join(&name);
            let has_stem = stem(&path) == wanted;
            let Ok(file) = urdf.files.canonicalize(&path) else { continue };
            if found.len() == MAX_SRDFS || !seen.insert(file) {
                continue;
            }
            let Ok(bytes) = urdf.files.read(&path, MAX_SRDF_BYTES) else { continue };
            let mut text = String::from_utf8_lossy(&bytes).into_owned();
            let mut trail = None;
            if FileType::Xacro.is_of(&path) {
                let may_run = urdf.settings.source.xacro.expand_urdf && expanded < MAX_EXPANDED;
                if !may_run || !has_name(&text) {
                    continue;
                }
                expanded += 1;
                let Some(made) = expand(urdf, &path, &of_urdf) else { continue };
                (text, trail) = made;
            }
            let shown = format!("{shown}{name}");
            found.push(SrdfFile { shown, path, text, trail, is_own, has_stem });
        }
    }
    found
}

/// What xacro makes of an SRDF with these arguments; `None` where it makes nothing: LNT063 is about what is read.
fn expand(urdf: &Subject, path: &Path, arguments: &[String]) -> Option<(String, Option<Trail>)> {
    let mut source = urdf.settings.source.with_declared(arguments);
    // They are those of the URDF: the SRDF need not take them all.
    source.xacro.declared = 0;
    let made = read_source(path, &source).ok()?;
    Some((made.text, made.trail))
}

/// The defaults of the URDF's arguments: an SRDF that takes the same ones is of the same robot.
fn defaults(urdf: &Subject) -> Vec<String> {
    let name = Path::new(urdf.file).file_name();
    let Some(name) = name else { return Vec::new() };
    let all = arguments(&urdf.folder.join(name), &urdf.settings.source).unwrap_or_default();
    let is_plain = |text: &String| !text.contains('$');
    let plain = all.into_iter().filter_map(|one| Some((one.name, one.default.filter(is_plain)?)));
    plain.map(|(name, default)| format!("{name}:={default}")).collect()
}

/// Whether an SRDF makes a robot: files of macros alone name none.
fn has_name(text: &str) -> bool {
    let document = urdd_xml::parse(text, urdd_xml::Kind::Robot);
    document.is_ok_and(|document| document.root_element().has_attribute("name"))
}

/// The folders that SRDFs are looked for in, each as seen from the URDF's, and whether it is of its own package.
fn folders(files: &Files, urdf: &Path) -> Vec<(PathBuf, String, bool)> {
    let mut shown = vec![(String::new(), true)];
    let mut add = |above: &str, is_own: bool| {
        for name in FOLDERS {
            let folder = format!("{above}{name}/");
            let inside = names(files, &urdf.join(&folder)).into_iter();
            let inside = inside.map(|name| format!("{folder}{name}/"));
            let inside = inside.filter(|inside| files.is_dir(&urdf.join(inside)));
            let inside: Vec<String> = inside.collect();
            shown.push((folder, is_own));
            shown.extend(inside.into_iter().map(|inside| (inside, is_own)));
        }
    };
    let mut up = String::new();
    for level in 0..LEVELS {
        add(&up, true);
        if level > 0 && files.is_file(&urdf.join(format!("{up}package.xml"))) || level > 1 {
            break;
        }
        up.push_str("../");
    }
    up.clear();
    for _ in 0..LEVELS {
        let packages = names(files, &urdf.join(&up)).into_iter();
        for package in packages.filter(|name| name.contains(MOVEIT)) {
            add(&format!("{up}{package}/"), false);
        }
        up.push_str("../");
    }
    shown.truncate(MAX_FOLDERS);
    shown.into_iter().map(|(shown, is_own)| (urdf.join(&shown), shown, is_own)).collect()
}

/// What is said of SRDFs in the folders of a run that are of no robot which was examined; `used` are the others.
pub fn unmatched(batch: &Batch, used: &BTreeSet<PathBuf>, settings: &Settings) -> Option<String> {
    let files = &settings.files;
    let makes_one = |path: &&PathBuf| {
        let bytes = files.read(path, MAX_SRDF_BYTES).unwrap_or_default();
        FileType::of_made(path) == Some(FileType::Srdf)
            && has_name(&String::from_utf8_lossy(&bytes))
    };
    let made = batch.description.files.iter().map(|file| &file.path);
    let made = made.filter(|_| settings.xacro.expand_urdf).filter(makes_one);
    let is_left =
        |path: &&PathBuf| !files.canonicalize(path).is_ok_and(|path| used.contains(&path));
    let left: Vec<String> = (batch.srdfs.iter().chain(made).filter(is_left))
        .map(|path| format!("`{}`", path.display()))
        .collect();
    let what = match left.len() {
        0 => return None,
        1 => "1 SRDF was matched with no robot".to_owned(),
        several => format!("{several} SRDFs were matched with no robot"),
    };
    let listed = first_of(left.into_iter(), MAX_NAMED);
    let line = format!("{what} that was examined, so that its names were not compared: {listed}");
    Some(escape::line(&line).to_string())
}

/// The names in a folder, in order.
fn names(files: &Files, folder: &Path) -> Vec<String> {
    // The folder of a plain file name.
    let folder = if folder.as_os_str().is_empty() { Path::new(".") } else { folder };
    let names = files.names(folder).into_iter().filter_map(|name| name.into_string().ok());
    let mut names: Vec<String> = names.collect();
    names.sort();
    names
}

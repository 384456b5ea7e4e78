//! What the xacro files of a folder are: robots, or parts of robots. Their texts decide, and nothing is expanded.

use std::collections::{BTreeMap, HashMap, HashSet};
use std::path::{Path, PathBuf};

use urdd_directory::account::Account;
use urdd_directory::file_type::FileType;
use urdd_format::short::Short;

use crate::beside::text;
use crate::files::MAX_SOURCE_BYTES;
use crate::folder_facts::FolderFacts;
use crate::gate::Gate;
use crate::macros::{self, Content, Macro, MacroFile};
use crate::settings::Settings;

/// Charged for a package that is looked up: the files that are looked at for it.
const LOOK_UP: usize = 16 << 10;

/// What a file of a folder is.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum FileKind {
    /// A robot, as far as its text says: what it includes, or the macro that it calls, may be unknown.
    Robot,
    /// It defines macros, properties, arguments or other parts for files that include it, and makes no link.
    Fragment,
    /// It has no robot.
    Neither(Reason),
}

/// Why a file has no robot.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Reason {
    /// It cannot be read, or is not well-formed.
    Unreadable(String),
    /// It makes an SRDF.
    Srdf,
    /// Its outermost element, which is not `<robot>`.
    Root(Short),
}

/// A file of a folder.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Described {
    /// The file.
    pub path: PathBuf,
    /// What it is.
    pub kind: FileKind,
}

/// The files of a folder, and their macros.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Description {
    /// The files, in the order in which they were given.
    pub files: Vec<Described>,
    /// Those that may be robots, and that another file includes.
    included: HashSet<PathBuf>,
    /// The macros that nothing calls, each with its file, in packages with a robot. None where a name is computed.
    pub uncalled: Vec<(PathBuf, Macro)>,
}

impl Description {
    /// Whether a file may be a part of robots that cannot be expanded by itself: a well-formed one that another one includes.
    pub fn may_be_part(&self, path: &Path) -> bool {
        self.included.contains(path)
    }
}

/// Says what files are. `packages` are the packages that are known to be around them, by name.
pub fn describe(
    paths: &[PathBuf],
    packages: &BTreeMap<String, PathBuf>,
    settings: &Settings,
) -> Description {
    let facts = settings.folder_facts();
    let account = settings.run_account();
    let settings = &Settings {
        facts: Some(facts.clone()),
        account: Some(account.clone()),
        ..settings.clone()
    };
    let mut texts = Texts {
        settings,
        packages,
        facts,
        account,
        looked_up: HashMap::new(),
        gates: HashMap::new(),
        known: BTreeMap::new(),
    };
    let keys: Vec<PathBuf> = paths.iter().map(|path| texts.key(path)).collect();
    texts.read_all(&keys);
    let links = Links::of(&texts);
    let files = paths.iter().zip(&keys).map(|(path, key)| {
        let kind = match &texts.known[key] {
            Ok(text) => links.kind(key, &text.file),
            Err(reason) => FileKind::Neither(reason.clone()),
        };
        Described { path: path.clone(), kind }
    });
    let files: Vec<Described> = files.collect();
    let given = keys.iter().filter_map(|key| Some((key, texts.known[key].as_ref().ok()?)));
    let all = given
        .flat_map(|(key, text)| text.includes.values().flatten().filter(move |file| *file != key));
    let all: HashSet<&PathBuf> = all.collect();
    let included = files.iter().zip(&keys);
    let included = included.filter(|(file, key)| file.kind == FileKind::Robot && all.contains(key));
    let included = included.map(|(file, _)| file.path.clone()).collect();
    let mut uncalled = uncalled(&texts, paths, &keys);
    // A package without a robot has its macros for others.
    let folders: HashSet<&Path> = packages.values().map(PathBuf::as_path).collect();
    let package = |path: &Path| {
        path.ancestors().find_map(|above| folders.get(above).map(|folder| folder.to_path_buf()))
    };
    let robots = files.iter().filter(|file| file.kind == FileKind::Robot);
    let robots: HashSet<Option<PathBuf>> = robots.map(|file| package(&file.path)).collect();
    uncalled.retain(|(path, _)| robots.contains(&package(path)));
    Description { files, included, uncalled }
}

struct Text {
    file: MacroFile,
    /// The files that it includes, by their names as they are written; `None` if it is not known which.
    includes: BTreeMap<String, Option<PathBuf>>,
}

/// The files that were read, by their paths with symbolic links resolved.
struct Texts<'a> {
    settings: &'a Settings,
    packages: &'a BTreeMap<String, PathBuf>,
    facts: FolderFacts,
    account: Account,
    looked_up: HashMap<(String, PathBuf), Option<PathBuf>>,
    /// By the folder of the file that includes others.
    gates: HashMap<PathBuf, Gate>,
    known: BTreeMap<PathBuf, Result<Text, Reason>>,
}

impl Texts<'_> {
    fn key(&self, path: &Path) -> PathBuf {
        self.settings.files.canonicalize(path).unwrap_or_else(|_| path.to_owned())
    }

    /// Reads files, and what they include.
    fn read_all(&mut self, keys: &[PathBuf]) {
        let mut waiting = keys.to_vec();
        while let Some(path) = waiting.pop() {
            if self.known.contains_key(&path) {
                continue;
            }
            let text = self.read(&path).map(|file| {
                let contents = file.macros.iter().map(|one| &one.content).chain([&file.content]);
                let names: HashSet<&String> = contents.flat_map(|one| &one.includes).collect();
                let found = names
                    .into_iter()
                    .map(|name| (name.clone(), self.included(&file.by_default(name), &path)));
                let includes: BTreeMap<String, Option<PathBuf>> = found.collect();
                waiting.extend(includes.values().flatten().cloned());
                Text { file, includes }
            });
            self.known.insert(path, text);
        }
    }

    fn read(&self, path: &Path) -> Result<MacroFile, Reason> {
        let unreadable = Reason::Unreadable;
        let bytes = self.settings.files.read(path, MAX_SOURCE_BYTES);
        let bytes = bytes.map_err(|error| unreadable(error.to_string()))?;
        self.account.deposit(bytes.len());
        let text = text(bytes).map_err(unreadable)?;
        let text = text.strip_prefix('\u{feff}').unwrap_or(&text);
        if !text.contains("xacro") {
            return Ok(MacroFile::plain(text));
        }
        macros::read(text).map_err(|error| unreadable(error.words(text)))
    }

    /// The file that a file includes, if its name is not computed and it is there.
    fn included(&mut self, name: &str, from: &Path) -> Option<PathBuf> {
        let folder = from.parent()?;
        let (package, path) =
            match name.strip_prefix("$(find ").and_then(|rest| rest.split_once(')')) {
                Some((package, rest)) if !rest.contains('$') => {
                    let (package, path) = (package.trim(), rest.trim_start_matches('/'));
                    let folder = self.package(package, folder)?;
                    let files = &self.settings.files;
                    let is_there = |path: &str| files.is_file(&folder.join(path));
                    let installed = self.facts.installed(&folder);
                    let source = installed.source(path, &self.account, is_there).ok()?;
                    let path = folder.join(source.as_deref().unwrap_or(path));
                    (Some(folder), path)
                }
                None if !name.contains('$') => (None, folder.join(name)),
                _ => return None,
            };
        let files = &self.settings.files;
        let path = files.canonicalize(&path).ok().filter(|path| files.is_file(path))?;
        // A file of the package, or of what the gate opens.
        let of =
            |package: PathBuf| files.canonicalize(&package).is_ok_and(|it| path.starts_with(it));
        let gate = || Gate::of_project(folder, self.settings);
        let is_open = package.is_some_and(of)
            || self.gates.entry(folder.to_owned()).or_insert_with(gate).at(&path).is_ok();
        is_open.then_some(path)
    }

    fn package(&mut self, name: &str, folder: &Path) -> Option<PathBuf> {
        if let Some(found) = self.packages.get(name) {
            return Some(found.clone());
        }
        let key = (name.to_owned(), folder.to_owned());
        if let Some(found) = self.looked_up.get(&key) {
            return found.clone();
        }
        self.account.charge(LOOK_UP).ok()?;
        let files = &self.settings.files;
        let folders = self.settings.packages.folders(name, folder, false, &self.facts);
        let found = folders.into_iter().find(|folder| files.is_dir(folder));
        self.looked_up.insert(key, found.clone());
        found
    }
}

/// A file, or all macros of a name.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
enum Maker<'t> {
    File(&'t Path),
    Macro(&'t str),
}

/// What makes links, or may.
struct Links<'t> {
    makers: HashSet<Maker<'t>>,
    srdf: HashSet<Maker<'t>>,
}

impl<'t> Links<'t> {
    fn of(texts: &'t Texts) -> Self {
        let mut contents: Vec<(Maker, &Content, &Text, bool)> = Vec::new();
        for (path, text) in &texts.known {
            let Ok(text) = text else { continue };
            let defines = text.file.has_properties || !text.file.macros.is_empty();
            contents.push((Maker::File(path), &text.file.content, text, defines));
            let macros = text.file.macros.iter();
            contents.extend(macros.map(|one| (Maker::Macro(&one.name), &one.content, text, true)));
        }
        let defined: HashSet<&str> = contents
            .iter()
            .filter_map(|(maker, ..)| match maker {
                Maker::Macro(name) => Some(*name),
                Maker::File(_) => None,
            })
            .collect();
        let (mut makers, mut srdf) = (HashSet::new(), HashSet::new());
        // By what is used: who uses it.
        let mut users: HashMap<Maker, Vec<Maker>> = HashMap::new();
        for (maker, content, text, defines) in contents {
            let mut may_make = content.has_link;
            for name in &content.includes {
                match text.includes.get(name).and_then(Option::as_deref) {
                    Some(file) => users.entry(Maker::File(file)).or_default().push(maker.clone()),
                    // A library for what this file defines, most likely.
                    None => may_make |= !defines,
                }
            }
            for call in content.calls.iter().filter(|call| call.is_beside_links) {
                match call.name.as_deref().filter(|name| defined.contains(name)) {
                    Some(name) => users.entry(Maker::Macro(name)).or_default().push(maker.clone()),
                    // Without an include, the macro is of a file that includes this one.
                    None => may_make |= !content.includes.is_empty(),
                }
            }
            if may_make {
                makers.insert(maker.clone());
            }
            if content.has_srdf {
                srdf.insert(maker);
            }
        }
        let spread = |found: &mut HashSet<Maker<'t>>| {
            let mut waiting: Vec<Maker> = found.iter().cloned().collect();
            while let Some(maker) = waiting.pop() {
                for user in users.get(&maker).into_iter().flatten() {
                    if found.insert(user.clone()) {
                        waiting.push(user.clone());
                    }
                }
            }
        };
        spread(&mut makers);
        spread(&mut srdf);
        Links { makers, srdf }
    }

    fn kind(&self, path: &'t Path, file: &MacroFile) -> FileKind {
        let maker = Maker::File(path);
        // What is wrong with one that is empty, or a URDF, is what its reader says.
        let is_urdf = FileType::Urdf.is_of(path);
        let is_empty = file.root == "robot" && !file.content.is_some;
        if is_empty || (is_urdf && !file.has_xacro) {
            return FileKind::Robot;
        }
        // `NAME.srdf.xacro`: what its macros make may be unknown.
        let is_srdf = FileType::of_made(path) == Some(FileType::Srdf);
        match (file.root.as_str(), self.makers.contains(&maker), self.srdf.contains(&maker)) {
            ("robot", ..) if is_srdf => FileKind::Neither(Reason::Srdf),
            ("robot", true, _) => FileKind::Robot,
            ("robot", false, true) => FileKind::Neither(Reason::Srdf),
            ("robot", false, false) => FileKind::Fragment,
            (root, ..) => FileKind::Neither(Reason::Root(root.into())),
        }
    }
}

/// The macros of these files that nothing calls which is expanded.
fn uncalled(texts: &Texts, paths: &[PathBuf], keys: &[PathBuf]) -> Vec<(PathBuf, Macro)> {
    let files = texts.known.values().flatten().map(|text| &text.file);
    let mut bodies: HashMap<&str, Vec<&Content>> = HashMap::new();
    for one in files.clone().flat_map(|file| &file.macros) {
        bodies.entry(&one.name).or_default().push(&one.content);
    }
    let mut called: HashSet<&str> = HashSet::new();
    let mut waiting: Vec<&Content> = files.map(|file| &file.content).collect();
    while let Some(content) = waiting.pop() {
        for call in &content.calls {
            let Some(name) = call.name.as_deref() else { return Vec::new() };
            if called.insert(name) {
                waiting.extend(bodies.get(name).into_iter().flatten());
            }
        }
    }
    let of = |(path, key): (&PathBuf, &PathBuf)| {
        let text = texts.known[key].as_ref().ok()?;
        let macros = text.file.macros.iter().filter(|one| !called.contains(one.name.as_str()));
        Some(macros.map(|one| (path.clone(), one.clone())).collect::<Vec<_>>())
    };
    paths.iter().zip(keys).filter_map(of).flatten().collect()
}

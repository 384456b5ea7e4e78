//! Resolves a mesh file name of a URDF to a file.

use std::cell::Cell;
use std::path::{Component, Path, PathBuf};

use percent_encoding::percent_decode_str;
use urdd_directory::account::{Account, AccountError};
use urdd_format::escape;

use crate::folder_facts::FolderFacts;
use crate::installed::LOOK_UP;
use crate::packages::{NearPackage, Packages, is_plain};
use crate::roots::{Place, Roots};

/// Maximum number of searched places in a message.
const MOST_TOLD: usize = 4;
/// Maximum number of folders or files that are taken for a name in another case.
const MOST_ALIKE: usize = 16;
/// Maximum number of folders in a name that is compared in another case.
const MOST_PARTS: usize = 32;

/// How a name without a package is read, and what to do about one.
const UNNAMED: &str = "without the name of a package, read as a path from the URDF's folder";
const NO_NAME: &str =
    "the name has no package; write `package://NAME/PATH`, or a path from the URDF's folder";

/// A resolved mesh file.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct FoundMesh {
    /// The file with symbolic links resolved, so that two names for one file are equal.
    pub file: PathBuf,
    /// The allowed folder that contains it.
    pub place: Place,
    /// The assumption under which it was found, if any.
    pub assumed: Option<String>,
}

/// Why no mesh file was found.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct NotFound {
    /// The places that were tried, each with the reason if it is known.
    pub tried: Vec<String>,
    /// A hint for the user.
    pub hint: Option<String>,
    /// An existing file outside all allowed folders.
    pub outside: Option<PathBuf>,
    /// An existing file whose path differs in case alone.
    pub other_case: Option<Box<OtherCase>>,
    /// The package, if there is none of this name.
    pub no_package: Option<String>,
    /// The package of a near name that is there instead.
    pub near_package: Option<Box<NearPackage>>,
    /// Why nobody looked to the end.
    pub stopped: Option<AccountError>,
}

/// A file whose path differs from a name in the case of letters alone.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct OtherCase {
    /// The file.
    pub file: PathBuf,
    /// Its path from the folder that the name refers to, with forward slashes; of an absolute name, the last part.
    pub written: String,
    /// Whether no other file fits as well.
    pub is_only: bool,
}

impl NotFound {
    fn because(hint: &str) -> Self {
        NotFound { hint: Some(hint.to_owned()), ..NotFound::default() }
    }

    /// The places and the hint, for people.
    pub fn in_words(&self) -> String {
        if let Some(why) = self.stopped {
            return why.to_string();
        }
        let mut words = String::new();
        if !self.tried.is_empty() {
            words = format!("tried {}", self.tried[..self.tried.len().min(MOST_TOLD)].join(", "));
            if self.tried.len() > MOST_TOLD {
                words += &format!(" and {} more places", self.tried.len() - MOST_TOLD);
            }
        }
        if let Some(hint) = &self.hint {
            if !words.is_empty() {
                words.push_str("; ");
            }
            words.push_str(hint);
        }
        words
    }
}

/// Finds the file of a mesh.
///
/// # Errors
/// If there is none: the places that were searched.
pub fn resolve(
    filename: &str,
    urdf_folder: &Path,
    packages: &Packages,
    roots: &Roots,
    account: &Account,
) -> Result<FoundMesh, NotFound> {
    let trimmed = filename.trim();
    let mut search = Search { roots, account, not_found: NotFound::default() };
    let found = search.as_written(trimmed, urdf_folder, packages);
    if let Some(found) = found {
        return Ok(found);
    }
    // Nonstandard spellings with only one meaning.
    let others = [
        (trimmed.replace('\\', "/"), "backslashes read as `/`"),
        (percent_decoded(trimmed), "`%` and two digits read as a character"),
    ];
    for (name, assumed) in others {
        if name == trimmed || search.not_found.stopped.is_some() {
            continue;
        }
        if let Some(found) = search.as_written(&name, urdf_folder, packages) {
            let assumed = Some(assumed.to_owned());
            return Ok(FoundMesh { assumed, ..found });
        }
    }
    Err(search.not_found)
}

struct Search<'a> {
    roots: &'a Roots,
    account: &'a Account,
    not_found: NotFound,
}

impl Search<'_> {
    fn as_written(
        &mut self,
        name: &str,
        urdf_folder: &Path,
        packages: &Packages,
    ) -> Option<FoundMesh> {
        // A macro that was not expanded; it means the same as `package://`.
        let find = name.strip_prefix("$(find ").and_then(|rest| rest.split_once(')'));
        if let Some((package, rest)) = find {
            let rest = rest.trim_start_matches('/');
            return self.in_package(package.trim(), rest, urdf_folder, packages, false);
        }
        match name.split_once("://") {
            Some((scheme, rest)) => match scheme.to_ascii_lowercase().as_str() {
                scheme @ ("package" | "model") => {
                    let inside = rest.trim_start_matches('/');
                    let named = inside.split_once('/').filter(|(package, _)| is_plain(package));
                    let found = named.and_then(|(package, rest)| {
                        self.in_package(package, rest, urdf_folder, packages, scheme == "model")
                    });
                    let is_named = named.is_some() && inside.len() == rest.len();
                    found
                        .or_else(|| if is_named { None } else { self.unnamed(inside, urdf_folder) })
                }
                "file" => {
                    let path = rest.strip_prefix("localhost/").map(|rest| format!("/{rest}"));
                    self.plain(path.as_deref().unwrap_or(rest), urdf_folder)
                }
                "http" | "https" | "ftp" => {
                    self.not_found = NotFound::because(
                        "nothing is fetched over the network; download the file and give its path",
                    );
                    None
                }
                other => {
                    let words =
                        format!("file names that begin with `{other}://` are not supported");
                    self.not_found = NotFound::because(&words);
                    None
                }
            },
            None => self.plain(name, urdf_folder),
        }
    }

    fn plain(&mut self, name: &str, urdf_folder: &Path) -> Option<FoundMesh> {
        if name.is_empty() {
            self.not_found = NotFound::because("the file name is empty");
            return None;
        }
        // `join` replaces the folder if the name is an absolute path.
        self.try_file(urdf_folder, name, None)
    }

    /// A path behind `package://` that begins with no name of a package, as exporters of CAD write it. PyBullet reads it
    /// from the URDF's folder or those above, and MuJoCo from the URDF's folder where it strips paths.
    fn unnamed(&mut self, path: &str, urdf_folder: &Path) -> Option<FoundMesh> {
        let roots = self.roots;
        let mut above = urdf_folder.ancestors().take_while(|folder| roots.is_own(folder));
        if let Some(found) = above.find_map(|folder| self.try_file(folder, path, None)) {
            return Some(FoundMesh { assumed: Some(UNNAMED.to_owned()), ..found });
        }
        // It is no name of a package that is missing.
        (self.not_found.no_package, self.not_found.near_package) = (None, None);
        if self.not_found.other_case.is_none() {
            self.not_found.hint = Some(NO_NAME.to_owned());
        }
        None
    }

    fn in_package(
        &mut self,
        package: &str,
        rest: &str,
        urdf_folder: &Path,
        packages: &Packages,
        is_model: bool,
    ) -> Option<FoundMesh> {
        if !is_plain(package) {
            let words = format!("`{package}` cannot be the name of a package");
            self.not_found.hint.get_or_insert(words);
            return None;
        }
        let files = self.roots.files();
        let folders = packages.folders(package, urdf_folder, is_model, self.roots.facts());
        let folders = folders.into_iter().filter(|folder| files.is_dir(folder));
        let mut folders: Vec<PathBuf> = folders.collect();
        folders.dedup();
        for folder in &folders {
            if let Some(found) = self.in_folder(folder, rest, package) {
                return Some(found);
            }
        }
        if let Some(folder) = self.roots.crawled(package, packages) {
            if let Some(found) = self.in_folder(folder, rest, package) {
                return Some(found);
            }
            folders.push(folder.to_owned());
        }
        let around = self.roots.around(urdf_folder);
        if let Some(folder) =
            around.package(package).map(|one| &one.folder).filter(|one| !folders.contains(one))
        {
            if let Some(found) = self.in_folder(folder, rest, package) {
                return Some(found);
            }
            folders.push(folder.clone());
        }
        let mut near_package = None;
        if folders.is_empty() {
            self.not_found.no_package.get_or_insert(package.to_owned());
            let (account, stopped) = (self.account, Cell::new(None));
            near_package = around.near(package, |folder| {
                let charged = account.charge(LOOK_UP).map_err(|why| stopped.set(Some(why)));
                charged.is_ok() && !rest.is_empty() && files.is_file(&folder.join(rest))
            });
            self.not_found.stopped = self.not_found.stopped.or(stopped.get());
        }
        let option = format!("--package {}=FOLDER", escape::shell(package));
        let hint = match folders.is_empty() {
            true => format!(
                "there is no package `{package}` at or above {}, on ROS_PACKAGE_PATH or AMENT_PREFIX_PATH; give its folder: {option}",
                urdf_folder.display()
            ),
            false => {
                let mut all = folders.iter();
                let why = all.find_map(|one| self.roots.facts().installed(one).is_not_known(one));
                let by_a_build = why.map_or_else(String::new, |why| {
                    format!("{why}: build the package and source its install/setup.bash; or, ")
                });
                format!("{by_a_build}if the package is elsewhere, give its folder: {option}")
            }
        };
        let hint = near_package.as_ref().map_or(hint, |near| near.in_words(package));
        self.not_found.hint.get_or_insert(hint);
        if let Some(near) = near_package {
            self.not_found.near_package.get_or_insert(Box::new(near));
        }
        None
    }

    /// A file of a package in a folder: from where it is installed, or else where it has this path.
    fn in_folder(&mut self, folder: &Path, path: &str, package: &str) -> Option<FoundMesh> {
        let installed = self.roots.facts().installed(folder);
        let is_there = |path: &str| self.roots.files().is_file(&folder.join(path));
        let source = match installed.source(path, self.account, is_there) {
            Ok(source) => source,
            Err(why) => {
                self.not_found.stopped = Some(why);
                return None;
            }
        };
        self.try_file(folder, source.as_deref().unwrap_or(path), Some((package, folder)))
    }

    fn try_file(
        &mut self,
        folder: &Path,
        name: &str,
        package: Option<(&str, &Path)>,
    ) -> Option<FoundMesh> {
        let path = folder.join(name);
        let files = self.roots.files();
        // A name that is long is in each message about it.
        if let Err(why) = self.account.charge(LOOK_UP + path.as_os_str().len()) {
            self.not_found.stopped = Some(why);
            return None;
        }
        if files.is_file(&path) {
            let file = files.canonicalize(&path).ok()?;
            if let Some(place) = self.roots.place(&file, package) {
                return Some(FoundMesh { file, place, assumed: None });
            }
            self.not_found.outside.get_or_insert(file);
        } else if !files.exists(&path)
            && let Some(near) = other_case(folder, name, self.roots.facts(), self.account)
        {
            let hint = format!("there is {}, whose case differs", near.file.display());
            self.not_found.hint.get_or_insert(hint);
            self.not_found.other_case.get_or_insert(Box::new(near));
        }
        let mut tried = path.display().to_string();
        if files.is_dir(&path) {
            tried += ", which is a folder";
        } else if files.exists(&path) && !files.is_file(&path) {
            tried += ", which is not a regular file";
        } else if files.is_dangling(&path) {
            tried += ", a link that leads nowhere";
        }
        if !self.not_found.tried.contains(&tried) {
            self.not_found.tried.push(tried);
        }
        None
    }
}

/// The file in a folder whose path differs from a name only in case.
fn other_case(
    folder: &Path,
    name: &str,
    facts: &FolderFacts,
    account: &Account,
) -> Option<OtherCase> {
    let mut folder = folder.to_owned();
    let mut parts: Vec<Component> = Path::new(name).components().collect();
    if Path::new(name).is_absolute() {
        // Above the last folder is the machine's own matter.
        folder = Path::new(name).parent()?.to_owned();
        parts = parts.pop().into_iter().collect();
    }
    if parts.len() > MOST_PARTS {
        return None;
    }
    let mut near = vec![(folder, String::new())];
    let mut is_cut = false;
    for part in parts {
        let mut next = Vec::new();
        for (folder, written) in near {
            account.charge(LOOK_UP).ok()?;
            for name in alike(&folder, part, facts)? {
                let slash = if written.is_empty() { "" } else { "/" };
                next.push((folder.join(&name), format!("{written}{slash}{name}")));
            }
        }
        is_cut |= next.len() > MOST_ALIKE;
        next.truncate(MOST_ALIKE);
        near = next;
    }
    let files = facts.files();
    near.retain(|(path, _)| files.exists(path) && !files.is_dir(path));
    let is_only = near.len() == 1 && !is_cut;
    let (file, written) = near.into_iter().next()?;
    Some(OtherCase { file, written, is_only })
}

/// The names in a folder that differ from a part of a path in case at most, that part itself first, a few of very many. `None`
/// if a path does not go on with it.
fn alike(folder: &Path, part: Component, facts: &FolderFacts) -> Option<Vec<String>> {
    let name = match part {
        Component::Normal(name) => name.to_str()?,
        Component::ParentDir => return Some(vec!["..".to_owned()]),
        Component::CurDir => return Some(vec![".".to_owned()]),
        Component::RootDir | Component::Prefix(_) => return None,
    };
    let spellings = facts.spellings(folder);
    let names = spellings.get(&name.to_lowercase()).map(Vec::as_slice).unwrap_or_default();
    let own = names.binary_search_by(|other| other.as_str().cmp(name)).ok();
    let others = names.iter().enumerate().filter(|(place, _)| Some(*place) != own);
    let own = own.map(|place| names[place].clone());
    let others = others.map(|(_, name)| name.clone()).take(MOST_ALIKE + 1);
    Some(own.into_iter().chain(others).collect())
}

/// Decodes percent-encoding such as `%20`; returns the name unchanged if the result is not UTF-8.
fn percent_decoded(name: &str) -> String {
    let decoded = percent_decode_str(name).decode_utf8();
    decoded.unwrap_or(name.into()).into_owned()
}

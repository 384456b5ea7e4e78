//! What a set of files holds that somebody dropped: descriptions, and the folders of the packages that they name.

use std::collections::{BTreeMap, HashMap, HashSet};
use std::path::{Path, PathBuf};

use urdd_directory::account::Account;
use urdd_directory::discover::ROOT_METADATA;
use urdd_directory::file_type::FileType;
use urdd_directory::path;

use crate::described::{FileKind, describe};
use crate::files::Files;
use crate::format::{Format, RobotFile, parts_of_others, robot_file};
use crate::inspect::is_of_mesh;
use crate::robots::{Job, named};
use crate::settings::{Declared, Settings};

/// Maximum number of packages of one description for which a folder is searched. Descriptions name a few.
const MAX_PACKAGES: usize = 1000;
/// The prefixes of names of files in a package.
const IN_PACKAGE: [&str; 2] = ["package://", "model://"];

/// A description in a set of files.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Dropped {
    /// Its path, and its unique name.
    pub job: Job,
    /// What it is written in.
    pub kind: DroppedKind,
}

/// What a description is written in.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum DroppedKind {
    /// URDF.
    Urdf,
    /// URDF with macros, which a program has to expand.
    Xacro,
    /// A format that is imported.
    Imported(Format),
}

impl DroppedKind {
    /// Its name in JSON.
    pub fn name(self) -> &'static str {
        match self {
            DroppedKind::Urdf => "urdf",
            DroppedKind::Xacro => "xacro",
            DroppedKind::Imported(format) => format.name(),
        }
    }
}

/// The descriptions among files in memory, in the order of their paths; none of files on a disk. Hidden folders are passed
/// over, and URDDs, a `.urdf.xacro` beside its `.urdf` or without a robot, and an MJCF or USD that is a part of
/// another. Where there is none, those count whose names are of something else.
pub fn descriptions(files: &Files) -> Vec<Dropped> {
    let Files::Memory(all) = files else {
        return Vec::new();
    };
    let is_passed = |file: &Path| {
        let folder = file.parent().unwrap_or(file);
        let hidden = |part: &std::ffi::OsStr| part.to_string_lossy().starts_with('.');
        folder.iter().any(hidden)
            || folder.ancestors().any(|above| all.has(&above.join(ROOT_METADATA)))
    };
    let of = |kind: fn(&Path, &Files) -> Option<DroppedKind>| -> Vec<(PathBuf, DroppedKind)> {
        let found = all.paths().filter(|file| !is_passed(file));
        found.filter_map(|file| Some((file.clone(), kind(file, files)?))).collect()
    };
    let mut found = of(kind);
    if found.is_empty() {
        found = of(misnamed);
    }
    let imported = found.iter().filter_map(|(file, kind)| match kind {
        DroppedKind::Imported(format) => Some((file.as_path(), RobotFile::Imported(*format))),
        DroppedKind::Urdf | DroppedKind::Xacro => None,
    });
    let mut parts = parts_of_others(imported, files, &Account::default());
    let is_xacro = |(_, kind): &&(PathBuf, DroppedKind)| *kind == DroppedKind::Xacro;
    let xacro: Vec<PathBuf> = found.iter().filter(is_xacro).map(|(file, _)| file.clone()).collect();
    let settings = Settings { files: files.clone(), ..Settings::default() };
    let described = describe(&xacro, &BTreeMap::new(), &settings).files.into_iter();
    parts.extend(described.filter(|file| file.kind == FileKind::Fragment).map(|file| file.path));
    // A part alone is shown with what is wrong with it.
    if found.iter().any(|(file, _)| !parts.contains(file)) {
        found.retain(|(file, _)| !parts.contains(file));
    }
    let (paths, kinds): (Vec<PathBuf>, Vec<DroppedKind>) = found.into_iter().unzip();
    named(paths.into_iter().map(Declared::from).collect())
        .into_iter()
        .zip(kinds)
        .map(|(job, kind)| Dropped { job, kind })
        .collect()
}

fn kind(file: &Path, files: &Files) -> Option<DroppedKind> {
    match FileType::of(file)? {
        FileType::Xacro => {
            let urdf = file.with_extension("");
            (FileType::Urdf.is_of(&urdf) && !files.is_file(&urdf)).then_some(DroppedKind::Xacro)
        }
        FileType::Archive | FileType::Document | FileType::Srdf => None,
        of_description => match robot_file(file, files)? {
            RobotFile::Urdf if of_description != FileType::Urdf => None,
            is => of_content(is),
        },
    }
}

/// What a file is whose name does not say that it is a description of this kind.
fn misnamed(file: &Path, files: &Files) -> Option<DroppedKind> {
    match FileType::of(file) {
        Some(FileType::Xacro | FileType::Document | FileType::Srdf) => None,
        None if is_of_mesh(file) => None,
        _ => of_content(robot_file(file, files)?),
    }
}

fn of_content(is: RobotFile) -> Option<DroppedKind> {
    match is {
        RobotFile::Urdf => Some(DroppedKind::Urdf),
        RobotFile::Imported(format) => Some(DroppedKind::Imported(format)),
        RobotFile::Xacro | RobotFile::Srdf => None,
    }
}

/// The folders of a set of files, by which packages are found: all endings of the paths, such as `meshes/a.obj` of
/// `arm/meshes/a.obj`. Building it takes time and memory proportional to the paths, and each question time proportional to
/// the path that is asked for.
#[derive(Debug)]
pub struct PackageFolders<'a> {
    /// The number of the ending that begins one part earlier, by that part and the number of an ending. The empty
    /// ending has number 0.
    longer: HashMap<(usize, &'a str), usize>,
    /// The highest folder with each ending; of several, the first by name.
    folders: Vec<&'a str>,
    /// The names of all folders.
    names: HashSet<&'a str>,
}

impl<'a> PackageFolders<'a> {
    /// Of these paths: relative, with `/` between their parts.
    pub fn of(mut paths: Vec<&'a str>) -> Self {
        paths.sort_by_cached_key(|path| (path.split('/').count(), *path));
        let mut longer = HashMap::new();
        let mut folders = vec![""];
        for path in &paths {
            let mut ending = 0;
            let mut before = *path;
            while !before.is_empty() {
                let (folder, part) = before.rsplit_once('/').unwrap_or(("", before));
                let next = folders.len();
                ending = *longer.entry((ending, part)).or_insert(next);
                if ending == next {
                    folders.push(folder);
                }
                before = folder;
            }
        }
        let names = paths.into_iter().filter_map(|path| path.rsplit_once('/'));
        PackageFolders {
            longer,
            folders,
            names: names.flat_map(|(folder, _)| folder.split('/')).collect(),
        }
    }

    /// The packages that a text names, each with the highest folder of its name in which a file is that the text names; or,
    /// where no folder has the name, with the folder in which the first file that is there is found, as when the content
    /// of a package was dropped without its folder.
    ///
    /// Of a set that is searched (`is_searched`), a package is otherwise the whole set, if that has a file of the last name.
    pub fn of_text<'t>(&self, text: &'t str, is_searched: bool) -> BTreeMap<&'t str, String> {
        let mut found = BTreeMap::new();
        let mut lost = BTreeMap::new();
        let named = IN_PACKAGE.iter().flat_map(|prefix| text.split(prefix).skip(1));
        for rest in named {
            let end = rest.find(['"', '\'', '<']).unwrap_or(rest.len());
            let Some((package, file)) = rest[..end].split_once('/') else {
                continue;
            };
            if found.contains_key(package)
                || path::check(package).is_err()
                || path::check(file).is_err()
            {
                continue;
            }
            let folder = match self.folder_with(&format!("{package}/{file}")) {
                Some("") => Some(package.to_owned()),
                Some(above) => Some(format!("{above}/{package}")),
                None if self.has_folder(package) => None,
                None => self.folder_with(file).map(str::to_owned),
            };
            let last = file.rsplit('/').next().unwrap_or(file);
            if let Some(folder) = folder {
                found.insert(package, folder);
            } else if is_searched && !self.has_folder(package) && self.folder_with(last).is_some() {
                lost.insert(package, String::new());
            }
            if found.len() + lost.len() >= MAX_PACKAGES {
                break;
            }
        }
        lost.append(&mut found);
        lost
    }

    /// Whether a folder has this name.
    fn has_folder(&self, name: &str) -> bool {
        self.names.contains(name)
    }

    /// The highest folder below which a file has this path; the empty path is that of the whole set.
    fn folder_with(&self, file: &str) -> Option<&'a str> {
        let mut parts = file.rsplit('/');
        let ending = parts.try_fold(0, |ending, part| self.longer.get(&(ending, part)).copied())?;
        self.folders.get(ending).copied()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::sync::Arc;

    #[test]
    fn packages_are_where_their_meshes_are_and_their_number_is_bounded() {
        let paths =
            ["x/meshes/a.obj", "y/meshes/b.obj", "known/meshes/a.obj", "deep/in/known/b.obj"];
        let dropped = PackageFolders::of(paths.to_vec());
        let text = "<m f='package://p/meshes/none.obj'/><m f='package://p/meshes/b.obj'/>
            <m f=\"package://q/meshes/a.obj\"/><m f=\"package://known/meshes/b.obj\"/>
            <m f='package://../meshes/a.obj'/><m f='package://r/../a.obj'/><m>package://s/meshes/a.obj</m>
            <m f='package://in/known/b.obj'/><m f='model://deep/in/known/b.obj'/>";
        let found = dropped.of_text(text, false);
        let found: Vec<_> = found.iter().map(|(name, folder)| (*name, &**folder)).collect();
        let expected =
            [("deep", "deep"), ("in", "deep/in"), ("p", "y"), ("q", "known"), ("s", "known")];
        assert_eq!(found, expected);
        let many: String = (0..2 * MAX_PACKAGES)
            .map(|k| format!("<m f='package://p{k}/meshes/a.obj'/>"))
            .collect();
        assert_eq!(dropped.of_text(&many, false).len(), MAX_PACKAGES);
    }

    #[test]
    fn content_is_asked_before_names() {
        let urdf = "<robot name='r'><link name='l'/></robot>";
        let kinds = |all: &[(&str, &str)]| -> Vec<(String, &'static str)> {
            let file = |(path, text): &(&str, &str)| (path.to_string(), Arc::from(text.as_bytes()));
            let files = Files::in_memory(all.iter().map(file)).expect("files");
            let found = descriptions(&files).into_iter();
            found.map(|one| (one.job.name, one.kind.name())).collect()
        };
        for path in ["a.xml", "a.txt", "a.sdf", "a.mjcf", "a.usda", "a.zip", "a"] {
            let found = kinds(&[(path, urdf), ("a.stl", "<robot/>"), ("a.json", "{}")]);
            assert_eq!(found.len(), 1, "{path}: {found:?}");
            assert_eq!(found[0].1, "urdf", "{path}");
        }
        let mjcf = "<mujoco><worldbody><body/></worldbody></mujoco>";
        assert_eq!(kinds(&[("a.urdf", mjcf)]), [("a".to_owned(), "mjcf")]);
        // A part of the robot, most likely.
        let found = kinds(&[("a.urdf", urdf), ("part.xml", urdf)]);
        assert_eq!(found, [("a".to_owned(), "urdf")]);
    }

    #[test]
    fn descriptions_are_told_by_their_names_and_content() {
        let file = |(path, text): &(&str, &str)| (path.to_string(), Arc::from(text.as_bytes()));
        let all = [
            ("a/urdf/arm.urdf", "<robot/>"),
            ("a/urdf/arm.urdf.xacro", "<robot/>"),
            ("a/urdf/hand.urdf.xacro", "<robot/>"),
            ("a/urdf/macros.xacro", "<robot/>"),
            (
                "a/urdf/finger.urdf.xacro",
                "<robot xmlns:xacro='http://www.ros.org/wiki/xacro'><xacro:macro name='f'><link name='l'/></xacro:macro></robot>",
            ),
            ("a/.git/old.urdf", "<robot/>"),
            ("b/robot.xml", "<mujoco><include file='../b/legs.xml'/><worldbody/></mujoco>"),
            ("b/legs.xml", "<mujoco/>"),
            ("b/package.xml", "<package/>"),
            ("c/model.sdf", "<sdf version='1.7'><model name='m'/></sdf>"),
            ("d/arm.usda", "#usda 1.0\n(subLayers = [@parts/base.usda@, @../b/none.usda@])\n"),
            (
                "d/parts/base.usda",
                "#usda 1.0\ndef \"b\" (prepend apiSchemas = [\"PhysicsRigidBodyAPI\"]) {}\n",
            ),
            ("d/table.usda", "#usda 1.0\ndef Cube \"c\" (references = @parts/look.usda@) {}\n"),
            ("d/parts/look.usda", "#usda 1.0\ndef Material \"m\" {}\n"),
            ("d/broken.usda", "#usda 1.0\ndef {\n"),
            ("c/lamp.sdf", "<sdf version='1.7'><light name='l'/></sdf>"),
            ("c/model.config", "<model/>"),
            ("made/urdd.json", "{}"),
            ("made/arm.urdf", "<robot/>"),
        ];
        let files = Files::in_memory(all.iter().map(file)).expect("files");
        let found = descriptions(&files);
        let found: Vec<_> = found
            .iter()
            .map(|one| (&*one.job.name, one.job.source.to_string_lossy(), one.kind.name()))
            .collect();
        let expected = [
            ("urdf-arm", "/a/urdf/arm.urdf", "urdf"),
            ("hand", "/a/urdf/hand.urdf.xacro", "xacro"),
            ("robot", "/b/robot.xml", "mjcf"),
            ("model", "/c/model.sdf", "sdf"),
            ("d-arm", "/d/arm.usda", "usd"),
            ("broken", "/d/broken.usda", "usd"),
        ];
        let expected = expected.map(|(name, path, kind)| (name, path.into(), kind));
        assert_eq!(found, expected);
    }

    #[test]
    fn the_highest_folder_with_a_file_is_found() {
        let files = ["b/m/a.obj", "c/a/m/a.obj", "a/m/a.obj", "m/b.obj", "top.obj"];
        let endings = PackageFolders::of(files.to_vec());
        assert_eq!(endings.folder_with("m/a.obj"), Some("a"));
        assert_eq!(endings.folder_with("a.obj"), Some("a/m"));
        assert_eq!(endings.folder_with("c/a/m/a.obj"), Some(""));
        assert_eq!(endings.folder_with("m/b.obj"), Some(""));
        assert_eq!(endings.folder_with("top.obj"), Some(""));
        for none in ["c.obj", "x/m/a.obj", "m", "m/", "", "obj"] {
            assert_eq!(endings.folder_with(none), None, "{none:?}");
        }
        assert!(endings.has_folder("m") && !endings.has_folder("a.obj"));
    }
}

//! Finds the folder, of a set of files, below which a file has a given path.

use std::collections::{HashMap, HashSet};

/// All endings of the paths of a set of files, such as `meshes/a.obj` of `arm/meshes/a.obj`. Building it takes time and memory
/// proportional to the paths, and each question time proportional to the path that is asked for.
#[derive(Debug)]
pub(crate) struct Endings<'a> {
    /// The number of the ending that begins one part earlier, by that part and the number of an ending. The empty
    /// ending has number 0.
    longer: HashMap<(usize, &'a str), usize>,
    /// The highest folder with each ending; of several, the first by name.
    folders: Vec<&'a str>,
    /// The names of all folders.
    names: HashSet<&'a str>,
}

impl<'a> Endings<'a> {
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
        Endings {
            longer,
            folders,
            names: names.flat_map(|(folder, _)| folder.split('/')).collect(),
        }
    }

    /// Whether a folder has this name.
    pub fn has_folder(&self, name: &str) -> bool {
        self.names.contains(name)
    }

    /// The highest folder below which a file has this path; the empty path is that of the whole set.
    pub fn folder_with(&self, file: &str) -> Option<&'a str> {
        let mut parts = file.rsplit('/');
        let ending = parts.try_fold(0, |ending, part| self.longer.get(&(ending, part)).copied())?;
        self.folders.get(ending).copied()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_highest_folder_with_a_file_is_found() {
        let files = ["b/m/a.obj", "c/a/m/a.obj", "a/m/a.obj", "m/b.obj", "top.obj"];
        let endings = Endings::of(files.to_vec());
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

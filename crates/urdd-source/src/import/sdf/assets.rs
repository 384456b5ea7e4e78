//! The meshes and images of a robot, with the files that meshes name, under paths below its URDF.

use std::collections::BTreeMap;
use std::path::{Component, Path, PathBuf};
use std::sync::Arc;

use nalgebra::Vector3;
use thiserror::Error;

use super::super::model::Asset;
use super::super::reach::Reach;
use super::super::unreachable::Unreachable;
use crate::inspect::Inspected;
use crate::sniff::is_image;
use urdd_directory::path::file_name;

/// The most bytes of an image.
const MAX_BYTES: u64 = 1 << 30;

/// Why there is no file.
#[derive(Debug, Error)]
pub enum NoAsset {
    #[error("{0}")]
    Unreachable(Unreachable),
    #[error("`{file}` cannot be read as a mesh: {reason}")]
    Mesh { file: String, reason: String },
    #[error("`{file}` is not an image")]
    Image { file: String },
    #[error("`{file}` has no part `{part}`")]
    Part { file: String, part: String },
}

/// The files.
#[derive(Debug, Default)]
pub struct Assets {
    pub files: Vec<Asset>,
    /// Where each file is in the list, by the file that it was.
    known: BTreeMap<PathBuf, usize>,
    /// The middle of each part of a mesh.
    middles: BTreeMap<usize, Vector3<f64>>,
    /// What each path is taken by, in lower case.
    taken: BTreeMap<String, PathBuf>,
    /// The number of groups of files that have a folder of their own.
    groups: usize,
}

impl Assets {
    /// Adds the mesh that a URI names, or a part of it, with the files that it names. Gives its place in the list.
    ///
    /// # Errors
    /// If it is not found, may not be read, or is no mesh.
    pub fn mesh(
        &mut self,
        reach: &Reach,
        uri: &str,
        folder: &Path,
        part: Option<&str>,
    ) -> Result<usize, NoAsset> {
        let found = reach.find(uri, folder).map_err(NoAsset::Unreachable)?;
        let source = of_part(&found, part);
        if let Some(known) = self.known.get(&source) {
            return Ok(*known);
        }
        let Inspected { bytes, side_files, scene, .. } = reach.inspect(&found);
        let unread = |reason| NoAsset::Mesh { file: uri.to_owned(), reason };
        scene.map_err(unread)?;
        let mut bytes = bytes.map_or_else(Vec::new, Arc::unwrap_or_clone);
        let mut middle = None;
        if let Some(name) = part {
            let missing = || NoAsset::Part { file: uri.to_owned(), part: name.to_owned() };
            bytes = super::part::part(&bytes, name).ok_or_else(missing)?;
            middle = middle_of(&bytes, &source).map_err(unread)?;
        }
        let sides = side_files.into_iter().filter(|(path, _)| *path != found);
        let sides = sides.map(|(path, side)| (path, Arc::unwrap_or_clone(side.bytes)));
        let index = self.add([(source, bytes)].into_iter().chain(sides).collect());
        self.middles.extend(middle.map(|middle| (index, middle)));
        Ok(index)
    }

    /// Adds the image that a URI names.
    ///
    /// # Errors
    /// If it is not found, may not be read, or is no image.
    pub fn image(&mut self, reach: &Reach, uri: &str, folder: &Path) -> Result<usize, NoAsset> {
        let found = reach.find(uri, folder).map_err(NoAsset::Unreachable)?;
        if let Some(known) = self.known.get(&found) {
            return Ok(*known);
        }
        let (file, bytes) = reach.read(&found, MAX_BYTES).map_err(NoAsset::Unreachable)?;
        match is_image(&bytes) {
            true => Ok(self.add(vec![(file, bytes)])),
            false => Err(NoAsset::Image { file: uri.to_owned() }),
        }
    }

    /// The middle of a part of a mesh.
    pub fn middle(&self, index: usize) -> Vector3<f64> {
        self.middles.get(&index).copied().unwrap_or_default()
    }

    /// Adds a file that was made, once.
    pub fn made(&mut self, path: &str, bytes: Vec<u8>) -> usize {
        let source = PathBuf::from(path);
        match self.known.get(&source) {
            Some(known) => *known,
            None => self.push(source, path.to_owned(), bytes),
        }
    }

    /// Adds a file with those that it names. Gives the place of the first in the list.
    fn add(&mut self, group: Vec<(PathBuf, Vec<u8>)>) -> usize {
        let top = common(group.iter().map(|(path, _)| path.as_path()));
        let base = self.base(&top, group.iter().map(|(path, _)| path.as_path()));
        let mut first = None;
        for (number, (path, bytes)) in group.into_iter().enumerate() {
            let written = written(&base, &top, &path, number == 0);
            let is_there = self.taken.contains_key(&written.to_lowercase());
            let known = self.known.get(&path).copied().filter(|_| is_there);
            let index = known.unwrap_or_else(|| self.push(path, written, bytes));
            first.get_or_insert(index);
        }
        first.unwrap_or_default()
    }

    /// The folder for files below another, in which no path is taken by another file.
    fn base<'p>(&mut self, top: &Path, group: impl Iterator<Item = &'p Path> + Clone) -> String {
        let is_free = |base: &str| {
            group.clone().enumerate().all(|(number, path)| {
                let written = written(base, top, path, number == 0);
                let taken = self.taken.get(&written.to_lowercase());
                taken.is_none_or(|taken| taken == path)
            })
        };
        let mut base = "meshes".to_owned();
        while !is_free(&base) {
            self.groups += 1;
            base = format!("meshes/{}", self.groups + 1);
        }
        base
    }

    fn push(&mut self, source: PathBuf, path: String, bytes: Vec<u8>) -> usize {
        let index = self.files.len();
        self.taken.insert(path.to_lowercase(), source.clone());
        self.known.insert(source, index);
        self.files.push(Asset { path, bytes: Arc::from(bytes) });
        index
    }
}

/// The middle of a mesh in a format that keeps its vertices in one file.
fn middle_of(bytes: &[u8], file: &Path) -> Result<Option<Vector3<f64>>, String> {
    let name = file.file_name().unwrap_or_default().to_string_lossy();
    let scene = urdd_geometry::read::read(bytes, &name, &mut |_| None);
    let bounds = scene.map_err(|error| error.to_string())?.merged().bounds();
    Ok(bounds.map(|bounds| (Vector3::from(bounds.min) + Vector3::from(bounds.max)) / 2.0))
}

/// The path of a file, or of a part of it, which is beside it.
fn of_part(file: &Path, part: Option<&str>) -> PathBuf {
    let Some(part) = part else { return file.to_owned() };
    let plain = |c: char| if c.is_alphanumeric() || matches!(c, '-' | '_') { c } else { '_' };
    let [stem, extension] = [file.file_stem(), file.extension()]
        .map(|name| name.unwrap_or_default().to_string_lossy().into_owned());
    let part: String = part.chars().map(plain).collect();
    file.with_file_name(format!("{stem}.{part}.{extension}"))
}

/// The folder that all files are in.
fn common<'p>(paths: impl Iterator<Item = &'p Path>) -> PathBuf {
    let mut common: Option<Vec<Component>> = None;
    for path in paths {
        let folder: Vec<Component> = path.parent().unwrap_or(Path::new("/")).components().collect();
        common = Some(match common {
            None => folder,
            Some(common) => {
                let same = common.iter().zip(&folder).take_while(|(left, right)| left == right);
                common[..same.count()].to_vec()
            }
        });
    }
    common.unwrap_or_default().iter().collect()
}

/// The path of a file below the URDF, with forward slashes. The first of a group is named by the URDF alone, so that its
/// name can be one for every file system. The first names the others, which keep their names.
fn written(base: &str, top: &Path, path: &Path, is_first: bool) -> String {
    let below = path.strip_prefix(top).unwrap_or(path).components();
    let parts = below.filter_map(|part| match part {
        Component::Normal(name) => Some(name.to_string_lossy().into_owned()),
        _ => None,
    });
    let mut parts: Vec<String> = [base.to_owned()].into_iter().chain(parts).collect();
    if let Some(name) = parts.last_mut().filter(|_| is_first) {
        let (stem, ending) = name.split_at(name.rfind('.').unwrap_or(name.len()));
        *name = file_name(stem, ending);
    }
    parts.join("/")
}

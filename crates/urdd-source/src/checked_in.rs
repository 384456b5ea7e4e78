//! URDFs that are checked in beside the xacro files that make them, known by their names.

use std::path::{Path, PathBuf};

use urdd_directory::file_type::FileType;

use crate::files::Files;

/// The URDF of a xacro file's name beside it: `arm.urdf` of `arm.xacro` and of `arm.urdf.xacro`.
pub fn urdf_of(xacro: &Path) -> PathBuf {
    let stem = xacro.with_extension("");
    if FileType::Urdf.is_of(&stem) { stem } else { stem.with_extension("urdf") }
}

/// The xacro files of a URDF's name beside it.
pub fn xacros_of(urdf: &Path, files: &Files) -> Vec<PathBuf> {
    let mut all = vec![urdf.with_extension("urdf.xacro"), urdf.with_extension("xacro")];
    all.retain(|xacro| urdf_of(xacro) == urdf && files.is_file(xacro));
    all
}

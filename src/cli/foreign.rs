//! Advice on files that are not URDDs.

use std::path::Path;

use super::output::one_line;
use urdd_directory::discover::DiscoverError;
use urdd_directory::file_type::FileType;
use urdd_source::{Files, Format, root_of};

/// The message of an error, with advice if the file has a known format.
pub fn advice(error: &DiscoverError) -> String {
    let DiscoverError::NotAFolder { path } = error else {
        return one_line(error);
    };
    format!("{}: {}", one_line(path), of_file(Path::new(path)).unwrap_or(NEITHER))
}

fn of_file(path: &Path) -> Option<&'static str> {
    let by_name = match FileType::of(path) {
        Some(FileType::Xacro) => Some(
            "this is a xacro file; `urdd generate` makes a URDD of it, `urdd lint` checks it, `urdd diff` compares it",
        ),
        Some(FileType::Sdf) => Some(SDF),
        Some(FileType::Srdf) => Some(
            "this is SRDF, which adds groups and skipped collisions to a URDF; \
             give the URDF that it belongs to, or a URDD",
        ),
        Some(FileType::Mjcf) => Some(MJCF),
        Some(FileType::Usd) => Some(
            "this is USD; URDDs are generated from URDF: export one (Isaac Sim has a URDF exporter), then `urdd generate`",
        ),
        Some(FileType::Document) => Some(
            "a URDD is a folder, not a single file; give the folder that contains urdd.json and the module folders",
        ),
        Some(FileType::Urdf | FileType::Xml | FileType::Archive) | None => None,
    };
    by_name.or_else(|| by_content(path))
}

const NEITHER: &str = "this is a file, but neither a URDF (its name would end in .urdf) nor a URDD \
    (a folder that holds urdd.json or the module folders, or a zip archive of one)";
const SDF: &str = "this is SDF; `urdd generate` makes a URDD of it, `urdd lint` checks it, `urdd import` makes a URDF";
const MJCF: &str = "this is MJCF, the format of MuJoCo; `urdd generate` makes a URDD of it, `urdd lint` checks it, \
    `urdd import` makes a URDF";

fn by_content(path: &Path) -> Option<&'static str> {
    let root = root_of(path, &Files::Disk)?;
    match Format::of_root(&root) {
        Some(Format::Mjcf) => Some(MJCF),
        Some(Format::Sdf) => Some(SDF),
        None => (root == "robot").then_some(
            "this looks like a URDF; give it a name that ends in .urdf, or use `urdd generate` to generate a URDD from it",
        ),
    }
}

//! Internal to urdd; no stability promise.
//!
//! A robot description as its author has it: a URDF, or a xacro file that makes one, and the mesh files that it names.
//! [`load`] reads one, [`SourceMeshes`] also finds and reads its meshes, [`robots`] finds descriptions below folders. Files
//! are on the disk or in memory ([`Files`]). Nothing is judged, and nothing is derived.

pub mod arguments;
mod around;
pub mod beside;
mod cmake;
mod cycles;
mod deciding;
mod declared;
mod decode;
pub mod described;
pub mod dropped;
mod endings;
mod error;
pub mod fault;
mod files;
mod format;
pub mod gate;
mod includes;
mod inspect;
mod installed;
mod installs;
mod launch;
mod load;
pub mod loops;
pub mod macros;
mod made_from;
mod meshes;
pub mod note;
pub mod origin;
mod package_index;
mod packages;
pub mod process;
mod repair;
mod resolve;
pub mod robots;
mod roots;
mod settings;
mod setup_py;
pub mod sniff;
#[cfg(test)]
mod tests;
mod tree;
pub mod urdf;
mod usd_layers;
mod watch;
pub mod written;
mod xacro;
mod xacro_argument;

pub use around::{Around, NearPackage};
pub use cycles::cycles;
pub use declared::{Declared, declared_of, robots_of};
pub use decode::{Decoded, Decoding, Original, TextOffsets, decode};
pub use error::{SourceError, XacroFault};
pub use files::{Files, MAX_SOURCE_BYTES, MemoryFault};
pub use format::{Format, RobotFile, format_of, robot_file};
pub use includes::included;
pub use inspect::{Inspected, SideFile, inspect_alone};
pub use load::{
    Source, SourceRobot, SourceText, file_name, load, load_text, load_with, read_source, read_urdf,
    stem,
};
pub use meshes::{MissingMesh, NamedMesh, SourceMesh, SourceMeshes, named};
pub use packages::{PackagePathError, Packages, package_name};
pub use repair::{Repaired, mend_xml, undeclared_prefix};
pub use resolve::{FoundMesh, NotFound, OtherCase};
pub use roots::Place;
pub use settings::{ImportOptions, Settings};
pub use watch::Trail;
pub use xacro::{XACRO_TIMEOUT, XacroSettings};

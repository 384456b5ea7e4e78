//! Internal to urdd; no stability promise.
//!
//! A robot description as its author has it: a URDF, or a xacro file that makes one, and the mesh files that it names.
//! [`load`] reads one, [`SourceMeshes`] also finds and reads its meshes, [`robots`] finds descriptions below folders. Files
//! are on the disk or in memory ([`Files`]). Nothing is judged, and nothing is derived.

pub mod arguments;
pub mod beside;
pub mod checked_in;
mod decode;
pub mod described;
pub mod dropped;
mod error;
pub mod fault;
mod files;
mod folder_facts;
mod format;
pub mod gate;
mod inspect;
mod installed;
mod job_names;
mod launched;
mod load;
pub mod loops;
pub mod macros;
mod meshes;
pub mod note;
pub mod origin;
mod package_index;
mod packages;
pub mod process;
mod python_tokens;
mod resolve;
pub mod robots;
mod roots;
mod settings;
mod suggested;
#[cfg(test)]
mod tests;
mod trail;
mod unused_arguments;
pub mod urdf;
pub mod written;
mod xacro;

pub use decode::{
    Decoded, Decoding, Original, Repaired, TextOffsets, decode, mend_xml, undeclared_prefix,
};
pub use error::{SourceError, XacroFault};
pub use files::{Files, MAX_SOURCE_BYTES, MemoryFault};
pub use folder_facts::FolderFacts;
pub use format::{Format, RobotFile, format_of, robot_file};
pub use inspect::{Inspected, SideFile, inspect_alone, is_image, is_plain_mesh, lines};
pub use load::{
    Source, SourceRobot, SourceText, file_name, load, load_text, load_with, read_source, read_urdf,
    stem,
};
pub use meshes::{MissingMesh, NamedMesh, SourceMesh, SourceMeshes, mesh_files, named};
pub use note::MacroCall;
pub use packages::{Around, NearPackage, PackagePathError, Packages};
pub use resolve::{FoundMesh, NotFound, OtherCase};
pub use roots::Place;
pub use settings::{
    Declared, ImportOptions, Settings, XACRO_TIMEOUT, XacroSettings, declared_of, robots_of,
};
pub use trail::Trail;
pub use unused_arguments::UnusedArgument;
pub use urdf::cycles;
pub use xacro::included;

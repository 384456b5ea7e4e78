//! `urdd.json`: identity, origin and contents of a URDD.

use super::index::Count;
use super::object::pattern;
use super::types::{module, types};

pattern! {
    /// A semantic version (semver.org, 2.0.0) of three numbers and nothing after them.
    pub struct Version matches r"^(0|[1-9][0-9]{0,8})\.(0|[1-9][0-9]{0,8})\.(0|[1-9][0-9]{0,8})$" by is_version;

    /// SHA-256 of a file's bytes, as 64 lower-case hexadecimal digits.
    pub struct Sha256 matches r"^[0-9a-f]{64}$" by |text| {
        text.len() == 64 && text.bytes().all(|b| matches!(b, b'0'..=b'9' | b'a'..=b'f'))
    };
}

fn is_version(text: &str) -> bool {
    let mut parts = 0;
    let all_numbers = text.split('.').all(|part| {
        parts += 1;
        matches!(part.len(), 1..=9)
            && part.bytes().all(|b| b.is_ascii_digit())
            && (part == "0" || !part.starts_with('0'))
    });
    all_numbers && parts == 3
}

types! {
    /// How much of the specification a URDD carries and fulfils; each class holds those before it.
    pub enum ConformanceClass {
        /// Kinematics: urdf, dof, chain, connections, bounds (and kinematics samples, recommended).
        Core,
        /// Core, and the four mesh modules.
        Geometry,
        /// Geometry, and the link shape modules.
        Shapes,
    }
}

module! {
    /// Root metadata of a URDD (`urdd.json`): names the robot, the specification's version, the
    /// source, and every module with its files.
    pub struct RootMetadata {
        /// Version of the URDD specification that this directory follows.
        pub urdd_version: Version,
        /// Name of the robot; equal to `name` of `urdf_module`.
        pub robot_name: String,
        /// The conformance class that the directory claims to fulfil.
        pub conformance_class: ConformanceClass,
        /// The program that wrote the directory; null when written by hand. Free: not checked.
        pub generator: Option<Generator>,
        /// What the directory was made from; null when from nothing that can be named.
        pub source: Option<Source>,
        /// Every module, in the order of the specification's table of modules, extensions last.
        pub modules: Vec<ModuleEntry>,
    }

    /// The program that wrote a URDD.
    pub struct Generator {
        /// Name of the program.
        pub name: String,
        /// Its version, in its own numbering.
        pub version: String,
    }

    /// What a URDD was made from: one key, which says of what kind the source is.
    pub enum Source {
        /// A URDF, carried verbatim in the URDD's root.
        Urdf(FileEntry),
    }

    /// One module of the directory.
    pub struct ModuleEntry {
        /// Name of the module, such as `dof_module`: the last part of its path.
        pub name: String,
        /// Version of the module's format; equal to the module's `VERSION` file.
        pub version: Version,
        /// Folder of the module, relative to the URDD's root, with forward slashes.
        pub path: String,
        /// Names of the modules that this one was derived from.
        pub depends_on: Vec<String>,
        /// Every file of the module, sorted by path (byte order).
        pub files: Vec<FileEntry>,
    }

    /// A file of the directory, with what is needed to see that it is unchanged.
    pub struct FileEntry {
        /// Path relative to the URDD's root, with forward slashes.
        pub path: String,
        /// Size in bytes.
        pub size: Count where { unit: "byte" },
        /// SHA-256 of the bytes.
        pub sha256: Sha256,
    }
}

//! What a file is, by its name and by its content; names that are reserved.

use std::io::Read;
use std::path::{Path, PathBuf};

use FileType::{Archive, Document, Mjcf, Sdf, Srdf, Urdf, Usd, Xacro, Xml};

use crate::regular;
use urdd_xml::foreign::signature;
pub use urdd_xml::foreign::{Foreign, foreign};
use urdd_xml::root_name;

/// What the ending of a file's name says.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FileType {
    /// URDF.
    Urdf,
    /// A program that xacro runs. It makes a URDF, or an SRDF.
    Xacro,
    /// SRDF.
    Srdf,
    /// SDF: a model or a world.
    Sdf,
    /// MJCF.
    Mjcf,
    /// XML, of which the content has to be looked at.
    Xml,
    /// A zip archive.
    Archive,
    /// USD.
    Usd,
    /// JSON or YAML.
    Document,
}

/// All endings that are known. Those before [`NO_STEMS`] are no part of the name of a robot; each is taken off once, in this
/// order: `arm.urdf.xacro` is `arm`.
const ENDINGS: [(&str, FileType); 15] = [
    ("zip", Archive),
    ("xacro", Xacro),
    ("xml", Xml),
    ("urdf", Urdf),
    ("srdf", Srdf),
    ("sdf", Sdf),
    ("world", Sdf),
    ("mjcf", Mjcf),
    ("usd", Usd),
    ("usda", Usd),
    ("usdc", Usd),
    ("usdz", Usd),
    ("json", Document),
    ("yaml", Document),
    ("yml", Document),
];
/// The number of endings of descriptions and archives.
const NO_STEMS: usize = 12;

impl FileType {
    /// What a file is; `None` if its name does not say.
    pub fn of(path: &Path) -> Option<FileType> {
        let name = path.file_name()?.to_string_lossy();
        let (_, found) = name.rsplit_once('.')?;
        let known = ENDINGS.iter().find(|(ending, _)| found.eq_ignore_ascii_case(ending));
        known.map(|(_, of)| *of)
    }

    /// What a file is, or where it is xacro, what its name says that xacro makes of it: an SRDF of `NAME.srdf.xacro`.
    pub fn of_made(path: &Path) -> Option<FileType> {
        match FileType::of(path)? {
            FileType::Xacro => FileType::of(&path.with_extension("")),
            other => Some(other),
        }
    }

    /// Whether a path has the name of a file of this type.
    pub fn is_of(self, path: &Path) -> bool {
        FileType::of(path) == Some(self)
    }
}

/// The name of a file without its endings: `arm` of `arm.URDF`, `m.mjcf` and `x/arm.urdf.xacro`. Empty if it has only those.
pub fn stem(path: &Path) -> String {
    let mut name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
    for (ending, _) in &ENDINGS[..NO_STEMS] {
        let dot = name.len().saturating_sub(ending.len() + 1);
        let end = name.get(dot..).and_then(|end| end.strip_prefix('.'));
        if end.is_some_and(|end| end.eq_ignore_ascii_case(ending)) {
            name.truncate(dot);
        }
    }
    name
}

/// How many bytes at the start of a file are searched for its outermost element.
pub const HEAD: u64 = 1 << 20;

/// A format that is imported.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Format {
    /// The XML of MuJoCo.
    Mjcf,
    /// The simulation description format of Gazebo.
    Sdf,
    /// Universal Scene Description.
    Usd,
}

impl Format {
    /// All of them, in the order of the table in docs/import.md.
    pub const ALL: [Format; 3] = [Format::Mjcf, Format::Sdf, Format::Usd];

    /// The name in reports.
    pub fn name(self) -> &'static str {
        match self {
            Format::Mjcf => "mjcf",
            Format::Sdf => "sdf",
            Format::Usd => "usd",
        }
    }

    /// The format of a description with this outermost element; none of a URDF, and of anything else.
    pub fn of_root(name: &str) -> Option<Self> {
        match name {
            "mujoco" => Some(Format::Mjcf),
            "sdf" | "gazebo" => Some(Format::Sdf),
            _ => None,
        }
    }

    /// The format of a text, by its outermost element, or the first line of a USD.
    pub fn of(text: &str) -> Option<Self> {
        match is_usd(text.as_bytes()) {
            true => Some(Format::Usd),
            false => Format::of_root(root_name(text)?),
        }
    }
}

/// Whether bytes begin as a USD layer does.
fn is_usd(bytes: &[u8]) -> bool {
    let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    bytes.starts_with(b"#usda ") || bytes.starts_with(b"PXR-USDC")
}

/// How a zip archive begins: with an entry, or with its end where it has none.
const ZIP: [&[u8]; 2] = [b"PK\x03\x04", b"PK\x05\x06"];

fn begins(head: &[u8], signatures: &[&[u8]]) -> bool {
    signatures.iter().any(|signature| head.starts_with(signature))
}

/// Whether a file is a package of USD: a zip archive with that ending. Others are URDDs.
fn is_usd_package(path: &Path, head: &[u8]) -> bool {
    let ending = path.extension().map(|ending| ending.to_ascii_lowercase());
    let is_named = ending.is_some_and(|ending| ending == "usdz" || ending == "usd");
    is_named && begins(head, &ZIP)
}

/// A description of a robot, or what belongs to one.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum RobotFile {
    /// URDF.
    Urdf,
    /// A program that xacro runs. It makes a URDF, or an SRDF.
    Xacro,
    /// SRDF.
    Srdf,
    /// What a URDF is made of.
    Imported(Format),
}

impl RobotFile {
    /// What a file is that begins so: by its signature, its outermost element, its name. `<robot>` is the outermost element
    /// of URDF, xacro and SRDF: of these the name tells which. `None` of anything else.
    pub fn of(path: &Path, head: &[u8]) -> Option<RobotFile> {
        if is_usd(head) || is_usd_package(path, head) {
            return Some(RobotFile::Imported(Format::Usd));
        }
        if begins(head, &ZIP) {
            return None;
        }
        // By its byte order mark, if it has one. What is stored in a binary file is not its outermost element.
        let (text, ..) = encoding_rs::UTF_8.decode(head);
        let root = root_name(&text).filter(|_| signature(head).is_none());
        if let Some(format) = root.and_then(Format::of_root) {
            return Some(RobotFile::Imported(format));
        }
        match FileType::of(path) {
            Some(FileType::Urdf) => Some(RobotFile::Urdf),
            Some(FileType::Xacro) => Some(RobotFile::Xacro),
            Some(FileType::Srdf) => Some(RobotFile::Srdf),
            _ => (root == Some("robot")).then_some(RobotFile::Urdf),
        }
    }

    /// What a file on the disk is. Of one that cannot be read, its name says it.
    pub fn at(path: &Path) -> Option<RobotFile> {
        let mut head = Vec::new();
        // What is read until it fails is enough.
        let _ = regular::open(path).map(|file| file.take(HEAD).read_to_end(&mut head));
        RobotFile::of(path, &head)
    }

    /// The format, if it is imported.
    pub fn format(self) -> Option<Format> {
        match self {
            RobotFile::Imported(format) => Some(format),
            _ => None,
        }
    }
}

/// Whether a file on the disk is a zip archive, by its first bytes, or by its name if it is no description of a robot. A
/// package of USD is none.
pub fn is_archive(path: &Path) -> bool {
    let mut head = [0; 4];
    let mut read = || regular::open(path).ok()?.read_exact(&mut head).ok();
    let is_one = path.is_file()
        && (read().is_some_and(|()| begins(&head, &ZIP)) || FileType::Archive.is_of(path));
    is_one && RobotFile::at(path).is_none()
}

/// Name of the root metadata file.
pub const ROOT_METADATA: &str = "urdd.json";

/// Prefix of the files and folders that a run creates beside a URDD while writing it.
pub const STAGING_PREFIX: &str = ".urdd-";

/// What exports need and a URDD does not say: `NAME.export.toml` beside the folder `NAME` or the archive `NAME.zip`.
#[must_use]
pub fn setup_beside(urdd: &Path) -> PathBuf {
    // `.` and `..` have no name of their own.
    let named = match urdd.file_name() {
        Some(_) => urdd.to_owned(),
        None => urdd.canonicalize().unwrap_or_else(|_| urdd.to_owned()),
    };
    let name = named.file_name().unwrap_or_default().to_string_lossy();
    let stem = name.strip_suffix(".zip").unwrap_or(&name);
    named.with_file_name(format!("{stem}.export.toml"))
}

/// Whether this is the name of a staging folder, in use or left behind by a crashed run.
pub fn is_staging(name: &str) -> bool {
    // Version 0.1.0 wrote `.NAME.urdd-PROCESS-NUMBER`.
    let of_0_1_0 = || {
        let (_, ending) = name.strip_prefix('.')?.rsplit_once(STAGING_PREFIX)?;
        let (process, number) = ending.split_once('-')?;
        let digits = |text: &str| !text.is_empty() && text.bytes().all(|b| b.is_ascii_digit());
        Some(digits(process) && digits(number))
    };
    name.starts_with(STAGING_PREFIX) || of_0_1_0().unwrap_or(false)
}

//! What a file of a robot is: its content says it, and its name where the content does not.

use std::io::Read;
use std::path::Path;

use super::file_type::FileType;
use super::regular;
use urdd_xml::root_name;

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

/// Whether a file is a package of USD: a zip archive with that ending. Others are URDDs.
fn is_usd_package(path: &Path, head: &[u8]) -> bool {
    let ending = path.extension().map(|ending| ending.to_ascii_lowercase());
    let is_named = ending.is_some_and(|ending| ending == "usdz" || ending == "usd");
    is_named && head.starts_with(b"PK\x03\x04")
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
    /// What a file is that begins so. `<robot>` is the outermost element of URDF, xacro and SRDF: of these the name tells
    /// which. `None` of anything else.
    pub fn of(path: &Path, head: &[u8]) -> Option<RobotFile> {
        if is_usd(head) || is_usd_package(path, head) {
            return Some(RobotFile::Imported(Format::Usd));
        }
        // By its byte order mark, if it has one.
        let (text, ..) = encoding_rs::UTF_8.decode(head);
        let root = root_name(&text);
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

//! What a file is, by the ending of its name, whatever the case of its letters.

use std::path::Path;

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

use FileType::{Archive, Document, Mjcf, Sdf, Srdf, Urdf, Usd, Xacro, Xml};

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

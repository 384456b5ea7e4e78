//! Why a URDD could not be generated.

use std::fmt;
use std::path::PathBuf;

use thiserror::Error;

use urdd_directory::cancellation::{Cancelled, Limit};
use urdd_directory::position::Position;
use urdd_directory::range::OutOfRange;
use urdd_directory::staging::StagingError;
use urdd_format::escape;
use urdd_format::short::Short;
use urdd_source::SourceError;
use urdd_source::note::{Note, SourcePlace};

pub(crate) type Result<T, E = GenerateError> = std::result::Result<T, E>;

/// Maximum number of faults of a file, or of names, that are shown one by one.
const MOST_SHOWN: usize = 5;

/// Why a URDD could not be generated. Nothing was written, and an existing URDD is unchanged.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum GenerateError {
    /// The source cannot be read, or is not a valid robot description.
    #[error(transparent)]
    Source(SourceError),
    /// A setting is out of its range.
    #[error(transparent)]
    Range(#[from] OutOfRange),
    /// The URDF names files outside its folders; it must not make the user publish them.
    #[error("{}", outside_meshes(file, meshes))]
    Outside {
        /// The file, as the user named it.
        file: String,
        /// The meshes, in the order of the file; never empty.
        meshes: Vec<OutsideMesh>,
    },
    /// Something had to be assumed, and `Settings::strict` forbids that.
    #[error("{}", assumptions(notes))]
    Strict {
        /// What was assumed; never empty.
        notes: Vec<Note>,
    },
    /// The user's edits in the URDD that is to be replaced would be lost.
    #[error(
        "{}{}: {fault}; a new run would lose a person's {lost} in it. Correct the file, or drop all its edits: `--drop-edits`",
        file.display(),
        at.map(|at| format!(":{at}")).unwrap_or_default()
    )]
    Edits {
        /// The file of the module.
        file: PathBuf,
        /// The position in the file.
        at: Option<Position>,
        /// What would be lost: `edits of skips` or `named configurations`.
        lost: &'static str,
        /// Why they would be lost.
        fault: EditsFault,
    },
    /// The configuration that is to be the reference cannot be it.
    #[error("{file}: --reference: {fault}")]
    Reference {
        /// The file, as the user named it.
        file: String,
        /// Why.
        fault: ReferenceFault,
    },
    /// The output would replace its own source.
    #[error("{file}: it is in the output folder {}, which would be replaced; give another output folder", target.display())]
    SourceInTarget {
        /// The file, as the user named it.
        file: String,
        /// The output folder.
        target: PathBuf,
    },
    /// The URDD cannot be written.
    #[error(transparent)]
    Write(StagingError),
    /// Generation was cancelled: `Settings::cancellation`.
    #[error("stopped before it was finished; nothing was changed")]
    Cancelled,
    /// The robot takes more than it may.
    #[error("{file}: {limit}")]
    Limit {
        /// The file, as the user named it.
        file: String,
        /// What it takes more of.
        limit: Limit,
    },
    /// The robot's geometry is out of the range that can be computed.
    #[error("{file}: {reason}; fix the mesh, or leave out the distances: `--modules geometry`")]
    Geometry {
        /// The file, as the user named it.
        file: String,
        /// Why.
        reason: String,
    },
    /// A bug in this program.
    #[error(
        "{file}: the generator failed: {reason}; this is a bug in the program, please report it with the file"
    )]
    Internal {
        /// The file, as the user named it.
        file: String,
        /// What happened.
        reason: String,
    },
}

impl From<StagingError> for GenerateError {
    fn from(error: StagingError) -> Self {
        match error {
            StagingError::Cancelled => GenerateError::Cancelled,
            error => GenerateError::Write(error),
        }
    }
}

impl From<SourceError> for GenerateError {
    fn from(error: SourceError) -> Self {
        match error {
            SourceError::Cancelled => GenerateError::Cancelled,
            error => GenerateError::Source(error),
        }
    }
}

impl From<Cancelled> for GenerateError {
    fn from(_: Cancelled) -> Self {
        GenerateError::Cancelled
    }
}

impl GenerateError {
    /// A bug in this program, found at a file.
    pub(crate) fn internal(file: &str, reason: impl fmt::Display) -> Self {
        GenerateError::Internal { file: file.to_owned(), reason: reason.to_string() }
    }

    /// A machine-readable code for the kind of error.
    pub fn code(&self) -> &'static str {
        match self {
            GenerateError::Source(error) => error.code(),
            GenerateError::Range(_) => "range",
            GenerateError::Outside { .. } => "outside",
            GenerateError::Strict { .. } => "strict",
            GenerateError::Edits { .. } => "edits",
            GenerateError::Reference { .. } => "reference",
            GenerateError::SourceInTarget { .. } => "source-in-output",
            GenerateError::Write(_) => "not-written",
            GenerateError::Cancelled => "cancelled",
            GenerateError::Limit { .. } => "limit",
            GenerateError::Geometry { .. } => "geometry",
            GenerateError::Internal { .. } => "internal",
        }
    }
}

/// Why a configuration cannot be the reference.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum ReferenceFault {
    /// No configuration has this name.
    #[error("the URDD that is replaced has no configuration `{name}`; {}", known_names(known))]
    Unknown {
        /// The name.
        name: Short,
        /// The names that there are.
        known: Vec<Short>,
    },
    /// A position in it is not one of this robot.
    #[error("{0}; correct it by `urdd configurations set`")]
    Position(String),
}

fn known_names(known: &[Short]) -> String {
    match known {
        [] => {
            "it has none: add one by `urdd configurations set` or `import`, and generate it again"
                .to_owned()
        }
        _ => format!("it has {}", first_names(known.iter())),
    }
}

/// The first of these names, and the number of the others.
pub(crate) fn first_names(names: impl ExactSizeIterator<Item: fmt::Display>) -> String {
    let more = names.len().saturating_sub(MOST_SHOWN);
    let shown: Vec<String> = names.take(MOST_SHOWN).map(|name| format!("`{name}`")).collect();
    let more = if more > 0 { format!(" and {more} more") } else { String::new() };
    format!("{}{more}", shown.join(", "))
}

/// Why the edits of a module would be lost.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum EditsFault {
    /// They cannot be read, or cannot be used: what is wrong.
    #[error("{0}")]
    Unusable(String),
    /// The selected modules do not include the edits.
    #[error(
        "it holds {0} edit{s}, but the requested modules leave out link_shapes_skips_module; add `link_shapes_skips` to `--modules`",
        s = if *.0 == 1 { "" } else { "s" }
    )]
    NotAskedFor(usize),
    /// The module that would hold given spheres is not requested.
    #[error(
        "it holds {0} given sphere{s}, but the requested modules leave out link_shapes_spheres_module; add `link_shapes_spheres` to `--modules`",
        s = if *.0 == 1 { "" } else { "s" }
    )]
    SpheresNotAskedFor(usize),
}

/// A mesh outside the folders from which files may be read.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct OutsideMesh {
    /// Where the description names it.
    pub place: SourcePlace,
    /// The mesh file name as written in the URDF.
    pub name: String,
    /// The file that it resolves to, with symbolic links followed.
    pub path: PathBuf,
}

/// One line for each of the first items, and one with the number of the others, `more` of them.
fn shown<T>(items: &[T], line: impl Fn(&T) -> String, more: impl Fn(usize) -> String) -> String {
    let (first, others) = items.split_at(items.len().min(MOST_SHOWN));
    let others = (!others.is_empty()).then(|| more(others.len()));
    first.iter().map(line).chain(others).map(|line| line + "\n").collect()
}

fn outside_meshes(file: &str, meshes: &[OutsideMesh]) -> String {
    let file = escape::line(file);
    let mesh = |OutsideMesh { place, name, path }: &OutsideMesh| {
        let (name, path) = (escape::line(name), path.display().to_string());
        let path = escape::line(&path);
        format!(
            "{place}: mesh `{name}` is outside of the folders of the robot and its packages, at {path}"
        )
    };
    let lines = shown(meshes, mesh, |more| format!("{file}: and {more} more such meshes"));
    format!(
        "{lines}{file}: a URDD carries its meshes, and a URDF must not make you publish other files; if you want to publish these, give their folder: `--allow-folder FOLDER`, or `--package NAME=FOLDER`"
    )
}

fn assumptions(notes: &[Note]) -> String {
    let lines = shown(notes, ToString::to_string, |more| format!("and {more} more"));
    format!("{lines}nothing was written: --strict allows no assumption that changes the robot")
}

//! Exports robots to the formats of programs that do not read URDDs.
//!
//! [`export`] creates the text and the mesh files that it references in memory; the caller writes them. Every file
//! states its source. The same URDD gives the same bytes.
//!
//! | format | for | holds |
//! |---|---|---|
//! | [`Format::Srdf`] | MoveIt, and what reads SRDF | the pairs of links that need no check, and why |
//! | [`Format::Urdf`] | any reader of URDF | the robot, with our shapes as collision geometry |
//! | [`Format::Drake`] | Drake | the same, with pairs of links as collision filter groups |
//! | [`Format::Mjcf`] | MuJoCo | bodies, joints, our shapes as geoms, `<exclude>` and `<pair>` for pairs |
//! | [`Format::Curobo`] | cuRobo | spheres by link, and pairs of links that are ignored, as YAML |
//! | [`Format::Foam`] | readers of Foam's JSON | spheres by link |
//!
//! ```
//! use urdd_export::{Format, Options, export};
//! use urdd_robot::Robot;
//!
//! # let folder = tempfile::tempdir()?;
//! # let urdf = concat!(env!("CARGO_MANIFEST_DIR"), "/../../conformance/robots/gripper.urdf");
//! # let path = folder.path().join("gripper");
//! # urdd_generate::generate(urdf.as_ref(), &path, &Default::default(), &())?;
//! let robot = Robot::open(&path)?;
//! let srdf = export(&robot, Format::Srdf, &Options::default())?;
//! assert!(srdf.text.contains("<disable_collisions "));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod contacts;
mod drake;
mod element;
mod error;
mod joints;
mod meshes;
mod mjcf;
mod names;
mod numbers;
mod pairs;
mod spheres;
mod srdf;
mod srdf_import;
mod srdf_merge;
mod subject;
mod urdf;
mod urdf_elements;

use urdd_format::link_shapes_skips::SkippedReason;
use urdd_robot::{Robot, ShapeKind};

pub use contacts::link_pairs;
pub use error::{ExportError, Note};
pub use pairs::{Contacts, LinkPair, MixedPair};
pub use spheres::{SphereBudget, SphereRates, interval};
pub use srdf_import::{ImportError, ImportedSkips, import_srdf};
pub use srdf_merge::{MergedSrdf, SrdfError, merge_srdf};

use subject::Subject;

/// An export format.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Format {
    /// MoveIt's Semantic Robot Description Format.
    Srdf,
    /// URDF with the URDD's shapes as collision geometry.
    Urdf,
    /// URDF for Drake.
    Drake,
    /// MuJoCo's XML.
    Mjcf,
    /// cuRobo's spheres, YAML.
    Curobo,
    /// Foam's spheres, JSON.
    Foam,
}

impl Format {
    /// All formats.
    pub const ALL: &[Format] = &[
        Format::Srdf,
        Format::Urdf,
        Format::Drake,
        Format::Mjcf,
        Format::Curobo,
        Format::Foam,
    ];

    /// Its name in messages and comments.
    pub fn name(self) -> &'static str {
        match self {
            Format::Srdf => "SRDF",
            Format::Urdf => "URDF",
            Format::Drake => "URDF for Drake",
            Format::Mjcf => "MJCF",
            Format::Curobo => "cuRobo's YAML",
            Format::Foam => "Foam's JSON",
        }
    }
}

/// Options of an export.
#[derive(Debug, Clone, PartialEq)]
pub struct Options {
    /// The shapes that approximate links: the collision geometry, and the shapes of the pairs.
    pub shapes: ShapeKind,
    /// The reasons for which pairs are disabled; `None` for those of the URDD. The user's edits apply in either case.
    pub reasons: Option<Vec<SkippedReason>>,
    /// Whether a link-level format checks a pair of links of which the URDD skips some pairs of pieces and checks
    /// others. Otherwise the pair is disabled, since pieces that are always in contact would collide in every
    /// configuration.
    pub keep_pairs: bool,
    /// Number of spheres, for the sphere formats.
    pub spheres: SphereBudget,
    /// Whether the spheres cover each link completely. Otherwise they are fitted to give the same collision results as
    /// the shapes.
    pub cover: bool,
    /// Number of sampled configurations in which the spheres are evaluated; fewer if that is too expensive.
    pub samples: usize,
    /// Whether to add visual geometry: the plain meshes by colour, besides the shapes.
    pub visuals: bool,
    /// The folder of the mesh files, relative to the text: without a trailing `/`, and empty for the same folder.
    pub mesh_folder: String,
}

impl Default for Options {
    fn default() -> Self {
        Options {
            shapes: ShapeKind::Pieces,
            reasons: None,
            keep_pairs: false,
            spheres: SphereBudget::default(),
            cover: false,
            samples: 10_000,
            visuals: true,
            mesh_folder: "meshes".to_owned(),
        }
    }
}

/// The result of an export.
#[derive(Debug, Clone, PartialEq)]
pub struct Export {
    /// The text of the file.
    pub text: String,
    /// The files that it references, with paths relative to it, sorted.
    pub files: Vec<(String, Vec<u8>)>,
    /// What the format cannot express, or expresses differently.
    pub notes: Vec<Note>,
}

/// Exports a robot.
///
/// # Errors
/// If a required module is missing or unusable, and in the other cases of [`ExportError`].
pub fn export(robot: &Robot, format: Format, options: &Options) -> Result<Export, ExportError> {
    let subject = Subject::new(robot, format, options)?;
    match format {
        Format::Srdf => srdf::export(&subject),
        Format::Urdf => urdf::export(&subject),
        Format::Drake => drake::export(&subject),
        Format::Mjcf => mjcf::export(&subject),
        Format::Curobo => spheres::curobo::export(&subject),
        Format::Foam => spheres::foam::export(&subject),
    }
}

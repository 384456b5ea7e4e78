//! Settings of the generator, and who is told of its progress.

use std::path::Path;

use crate::selection::Selection;
use urdd_directory::range::{OutOfRange, Range};
use urdd_directory::root::Root;
use urdd_format::link_shapes_skips::SkippedReason;
use urdd_format::meshes::GeometryKind;
use urdd_format::registry::ModuleKind;
use urdd_learned::train::Effort;

/// [`Pieces::most`].
pub const PIECES: Range = Range::whole("pieces", 1, 64);

/// [`Pieces::tolerance`].
pub const PIECE_TOLERANCE: Range = Range::above_zero("piece_tolerance", "metres");

/// [`Settings::num_samples`].
pub const SAMPLES: Range = Range::whole("samples", 1, 100_000);

/// Settings of the generator.
#[derive(Debug, Clone)]
pub struct Settings {
    /// The modules to generate.
    pub selection: Selection,
    /// Where packages and meshes are, and how xacro files are expanded.
    pub source: urdd_source::Settings,
    /// The geometry that link meshes are built from. A link without it uses the other kind.
    pub preferred_geometry: GeometryKind,
    /// The file formats of derived meshes.
    pub mesh_formats: MeshFormats,
    /// How finely links are divided into convex pieces.
    pub pieces: Pieces,
    /// Sampled configurations of the distance statistics: [`SAMPLES`].
    pub num_samples: u32,
    /// The reasons for which pairs are skipped. `None` keeps those of the URDD that is replaced, or uses the usual ones
    /// for a new URDD.
    pub skipped_reasons: Option<Vec<SkippedReason>>,
    /// The named configuration in which pairs of links that touch are skipped, in place of the default configuration:
    /// edits of skips say so, and the reason `Default` is not among those that are skipped. `default`, where no
    /// configuration has this name, is the default configuration again. `None` changes nothing.
    pub reference: Option<String>,
    /// Whether a missing mesh, or any assumption that changes the robot, is an error.
    pub strict: bool,
    /// Whether to drop the skip edits and the named configurations of the URDD that is replaced.
    pub drop_edits: bool,
    /// Whether to write into a folder that has other content.
    pub force: bool,
    /// URDDs of this program from which the meshes, hulls, pieces, boxes and spheres of links are taken, if the link's
    /// geometry is identical to the byte and the settings are the same. The result is the same as without donors,
    /// except for the last digits of distances, and takes less time. Donors are trusted: pass only URDDs that a
    /// validator accepts.
    pub donors: Vec<Root>,
    /// The effort for training a self-collision model.
    pub model_effort: Effort,
}

/// The files of a derived mesh besides its .glb, which is always written: SPEC 7.1.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct MeshFormats {
    /// Binary STL.
    pub stl: bool,
    /// Wavefront OBJ.
    pub obj: bool,
}

impl Default for MeshFormats {
    /// Both formats.
    fn default() -> Self {
        MeshFormats { stl: true, obj: true }
    }
}

/// How finely links are divided into convex pieces.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pieces {
    /// Maximum number of pieces of a link: [`PIECES`].
    pub most: u8,
    /// Mean distance, metres, from the pieces' outside to the link's surface. The search uses no more pieces than this
    /// needs, by its estimate: [`PIECE_TOLERANCE`]. `None` uses as many pieces as save enough, in proportion to the link.
    pub tolerance: Option<f64>,
}

impl Default for Pieces {
    /// At most 7.
    fn default() -> Self {
        Pieces { most: 7, tolerance: None }
    }
}

impl Settings {
    /// Checks that each number is in its range, as generation does.
    ///
    /// # Errors
    /// If one is not.
    pub fn check(&self) -> Result<(), OutOfRange> {
        PIECES.check(self.pieces.most.into())?;
        self.pieces.tolerance.map(|length| PIECE_TOLERANCE.check(length)).transpose()?;
        SAMPLES.check(self.num_samples.into()).map(drop)
    }
}

impl Default for Settings {
    /// Every module except those that have to be trained, from visual geometry, with at most 7 pieces per link, 1,000
    /// samples, and only the packages around the URDF.
    fn default() -> Self {
        Settings {
            selection: Selection::all(),
            source: urdd_source::Settings::default(),
            preferred_geometry: GeometryKind::Visual,
            mesh_formats: MeshFormats::default(),
            pieces: Pieces::default(),
            num_samples: 1000,
            skipped_reasons: None,
            reference: None,
            strict: false,
            drop_edits: false,
            force: false,
            donors: Vec::new(),
            model_effort: Effort::default(),
        }
    }
}

/// Receives the progress of a run.
pub trait Progress: Sync {
    /// A module is started; `done` of `total` modules are finished.
    fn module(&self, kind: ModuleKind, done: usize, total: usize);

    /// Progress within a slow module: `done` of `total` steps are finished.
    fn part(&self, _kind: ModuleKind, _done: usize, _total: usize) {}

    /// A module's work on the mesh of a link is finished. Links with the same mesh are reported once, by the first.
    fn link(&self, _kind: ModuleKind, _name: &str) {}

    /// A file of the source is about to be read: the URDF, a mesh, a texture. Also called for the places where a missing
    /// mesh was searched, since the robot changes when the file appears. Files that xacro includes are not reported.
    fn reads(&self, _file: &Path) {}
}

impl Progress for () {
    fn module(&self, _: ModuleKind, _: usize, _: usize) {}
}

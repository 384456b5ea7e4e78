//! How URDDs are made.

use std::path::PathBuf;

use super::meshes::package::Packages;
use super::selection::Selection;
use super::source::xacro::XacroSettings;
use crate::train::Effort;
use urdd_directory::cancellation::Cancellation;
use urdd_directory::root::Root;
use urdd_format::link_shapes_skips::SkippedReason;
use urdd_format::meshes::GeometryKind;

/// How URDDs are made.
#[derive(Debug, Clone)]
pub struct Settings {
    /// The modules to make.
    pub selection: Selection,
    /// Where packages are.
    pub packages: Packages,
    /// Folders besides the robot's own and its packages from which mesh files may be taken.
    pub allowed_folders: Vec<PathBuf>,
    /// Which geometry links are made from; the other one where a link has none of it.
    pub preferred_geometry: GeometryKind,
    /// The files of each derived mesh.
    pub mesh_formats: MeshFormats,
    /// How finely links are divided into convex pieces.
    pub pieces: Pieces,
    /// Sampled configurations of the distance statistics.
    pub num_samples: u32,
    /// For which reasons pairs of shapes are skipped; `None` for those of the URDD that is replaced,
    /// or the usual ones where there is none.
    pub skipped_reasons: Option<Vec<SkippedReason>>,
    /// How xacro files are expanded.
    pub xacro: XacroSettings,
    /// Whether a mesh that is not found, and all that is assumed and changes the robot, is an error.
    pub strict: bool,
    /// Whether edits of skips in the URDD that is replaced may be dropped.
    pub drop_edits: bool,
    /// Whether to write into a folder that holds something else.
    pub force: bool,
    /// URDDs of this program from which the meshes, hulls, pieces, boxes and spheres of links are taken over, where
    /// the link's geometry is the same to the byte, and so are the settings. The URDD that is made is the same as
    /// without them, but for the last digits of distances, in less time. They are believed: give none that a validator
    /// refuses.
    pub reuse: Vec<Root>,
    /// How much work training a self-collision model is.
    pub model_effort: Effort,
    /// Where it is asked to stop: before the next module or mesh, with [`GenerateError::Cancelled`], and nothing is
    /// changed.
    ///
    /// [`GenerateError::Cancelled`]: super::GenerateError::Cancelled
    pub cancellation: Cancellation,
}

/// Which files a derived mesh has besides its .glb, which is always made: SPEC 7.1.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct MeshFormats {
    /// Binary STL.
    pub stl: bool,
    /// Wavefront OBJ.
    pub obj: bool,
}

impl Default for MeshFormats {
    /// All of them.
    fn default() -> Self {
        MeshFormats {
            stl: true,
            obj: true,
        }
    }
}

/// How finely links are divided into convex pieces.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pieces {
    /// Most pieces of a link, 1 to 64; what is outside of that counts as the nearer end.
    pub most: u8,
    /// The mean distance from the pieces' outside to the link's surface, metres, for which no more pieces are made
    /// than it needs (as the search estimates it); `None` for as many as save enough, in proportion to the link.
    pub tolerance: Option<f64>,
}

impl Default for Pieces {
    /// At most 7.
    fn default() -> Self {
        Pieces {
            most: 7,
            tolerance: None,
        }
    }
}

impl Default for Settings {
    /// Every module but what has to be trained, from visual geometry, with at most 7 pieces for a link, 1,000 samples, and no packages but those
    /// around the URDF.
    fn default() -> Self {
        Settings {
            selection: Selection::all(),
            packages: Packages::none(),
            allowed_folders: Vec::new(),
            preferred_geometry: GeometryKind::Visual,
            mesh_formats: MeshFormats::default(),
            pieces: Pieces::default(),
            num_samples: 1000,
            skipped_reasons: None,
            xacro: XacroSettings::default(),
            strict: false,
            drop_edits: false,
            force: false,
            reuse: Vec::new(),
            model_effort: Effort::default(),
            cancellation: Cancellation::default(),
        }
    }
}

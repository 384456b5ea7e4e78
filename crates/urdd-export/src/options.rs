//! Options of an export.

use urdd_format::link_shapes_skips::SkippedReason;
use urdd_robot::ShapeKind;

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

/// Number of spheres.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum SphereBudget {
    /// Twelve per link with shapes on average, at most 150 in total. For covering spheres: at most eight per link.
    #[default]
    Auto,
    /// Maximum number per link.
    PerLink(usize),
    /// Maximum number for all links together, but at least one per link.
    Total(usize),
}

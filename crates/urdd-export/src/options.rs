//! Options of exports, by format.

use urdd_format::link_shapes_skips::SkippedReason;

use super::actuator_kind::ActuatorKind;
use super::fit::Fit;
use super::format::Format;
use super::ros::Ros;
use super::setup::Setup;
use super::shapes::Shapes;

/// A format and its options. [`Choices::options`](super::Choices::options) makes it of what a person chose.
#[derive(Debug, Clone, PartialEq)]
pub enum Options {
    /// [`Format::Srdf`].
    Srdf(PairOptions),
    /// [`Format::Urdf`].
    Urdf(UrdfOptions),
    /// [`Format::Drake`].
    Drake(DrakeOptions),
    /// [`Format::Mjcf`].
    Mjcf(MjcfOptions),
    /// [`Format::Curobo`].
    Curobo(CuroboOptions),
    /// [`Format::Foam`].
    Foam(SphereOptions),
    /// [`Format::Spherized`].
    Spherized(SpherizedOptions),
    /// [`Format::Moveit`].
    Moveit(MoveitOptions),
    /// [`Format::Sdf`].
    Sdf(SdfOptions),
    /// [`Format::Usd`].
    Usd(UsdOptions),
}

impl Options {
    /// The format.
    pub fn format(&self) -> Format {
        self.common().0
    }

    /// Whether the root link was asked to move freely.
    pub(super) fn is_floating(&self) -> bool {
        match self {
            Options::Mjcf(of) => of.floating_base,
            Options::Sdf(of) => of.floating_base,
            Options::Usd(of) => of.floating_base,
            _ => false,
        }
    }

    /// The pairs that the format has.
    pub(super) fn pairs(&self) -> Option<Pairs<'_>> {
        Some(match self {
            Options::Srdf(of) | Options::Usd(UsdOptions { pairs: of, .. }) => Pairs::OfLinks(of),
            Options::Drake(DrakeOptions { model, .. })
            | Options::Moveit(MoveitOptions { model, .. })
            | Options::Sdf(SdfOptions { model, .. }) => Pairs::OfLinks(&model.pairs),
            Options::Mjcf(of) => Pairs::OfPieces(of.reasons.as_deref()),
            Options::Urdf(_) | Options::Curobo(_) | Options::Foam(_) | Options::Spherized(_) => {
                return None;
            }
        })
    }

    /// What is done to links; `None` for formats of spheres.
    pub(super) fn links(&self) -> Option<&LinkOptions> {
        match (self.pairs(), self) {
            (Some(Pairs::OfLinks(of)), _) => Some(&of.links),
            (_, Options::Urdf(of)) => Some(&of.links),
            (_, Options::Mjcf(of)) => Some(&of.links),
            _ => None,
        }
    }

    /// The format, the shapes that approximate links, and what the URDD does not say.
    pub(super) fn common(&self) -> (Format, Shapes, Option<&Setup>) {
        match self {
            Options::Srdf(of) => (Format::Srdf, of.shapes, None),
            Options::Urdf(of) => (Format::Urdf, of.shapes, None),
            Options::Drake(of) => (Format::Drake, of.model.pairs.shapes, of.model.setup.as_ref()),
            Options::Mjcf(of) => (Format::Mjcf, of.shapes, of.setup.as_ref()),
            Options::Curobo(of) => (Format::Curobo, of.spheres.shapes, of.setup.as_ref()),
            Options::Foam(of) => (Format::Foam, of.shapes, None),
            Options::Spherized(of) => (Format::Spherized, of.spheres.shapes, None),
            Options::Moveit(of) => (Format::Moveit, of.model.pairs.shapes, of.model.setup.as_ref()),
            Options::Sdf(of) => (Format::Sdf, of.model.pairs.shapes, of.model.setup.as_ref()),
            Options::Usd(of) => (Format::Usd, of.pairs.shapes, of.setup.as_ref()),
        }
    }
}

/// What is done to links and their shapes before they are exported.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct LinkOptions {
    /// Whether links that are fixed to each other become one, that nearest to the root. Each of the others is a frame on
    /// it, without mass and shapes.
    pub merge_fixed: bool,
    /// The link that becomes the root. Joints between it and the old root are turned round.
    pub root: Option<String>,
    /// What primitives in the place of convex meshes may cost; `None` for the meshes.
    pub fit: Option<Fit>,
}

/// Options of formats that list pairs of links that need no check: all options of SRDF.
#[derive(Debug, Clone, PartialEq)]
pub struct PairOptions {
    /// The shapes that approximate links: the collision geometry, and the shapes of the pairs.
    pub shapes: Shapes,
    /// The reasons for which pairs are disabled; `None` for those of the URDD. The user's edits apply in either case.
    pub reasons: Option<Vec<SkippedReason>>,
    /// Whether a pair of links is checked of which the URDD skips some pairs of pieces and checks others. Otherwise the
    /// pair is disabled, since pieces that are always in contact would collide in every configuration.
    pub keep_pairs: bool,
    /// What is done to links and shapes.
    pub links: LinkOptions,
}

/// The pairs that a format has.
#[derive(Clone, Copy)]
pub(super) enum Pairs<'a> {
    /// Of links.
    OfLinks(&'a PairOptions),
    /// Of pieces: exactly those of the URDD, or for these reasons.
    OfPieces(Option<&'a [SkippedReason]>),
}

/// Options of mesh files.
#[derive(Debug, Clone, PartialEq)]
pub struct MeshOptions {
    /// Visual geometry: the plain meshes by colour, besides the shapes. `None` leaves it out.
    pub visuals: Option<Detail>,
    /// The folder of the mesh files, relative to the text: without a trailing `/`, and empty for the same folder.
    pub folder: String,
}

/// Number of triangles of visual geometry: fewer for simulators.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub enum Detail {
    /// All.
    #[default]
    Full,
    /// At most this part of them, between 0 and 1.
    Ratio(f64),
    /// At most as many in total, where collapses allow it. All meshes get the same error.
    Triangles(usize),
}

/// Options of spheres: all options of Foam's format.
#[derive(Debug, Clone, PartialEq)]
pub struct SphereOptions {
    /// The shapes that the spheres approximate: pieces or hulls.
    pub shapes: Shapes,
    /// The reasons for which pairs are ignored; `None` for those of the URDD. The user's edits apply in either case.
    pub reasons: Option<Vec<SkippedReason>>,
    /// Number of spheres.
    pub budget: SphereBudget,
    /// Whether the spheres cover each link completely. Otherwise they are fitted to give the same collision results as
    /// the shapes.
    pub cover: bool,
    /// Number of sampled configurations in which the spheres are evaluated; fewer if that is too expensive.
    pub samples: usize,
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

impl SphereBudget {
    /// The budget for a number per link, or for all links together, which counts first.
    pub fn new(per_link: Option<impl Into<usize>>, total: Option<impl Into<usize>>) -> Self {
        let total = total.map(|count| SphereBudget::Total(count.into()));
        let per_link = per_link.map(|count| SphereBudget::PerLink(count.into()));
        total.or(per_link).unwrap_or_default()
    }
}

/// Options of URDF.
#[derive(Debug, Clone, PartialEq)]
pub struct UrdfOptions {
    /// The collision geometry.
    pub shapes: Shapes,
    /// The mesh files.
    pub meshes: MeshOptions,
    /// The tree of links.
    pub links: LinkOptions,
}

/// Options of formats that have a whole robot, with pairs of links.
#[derive(Debug, Clone, PartialEq)]
pub struct ModelOptions {
    /// The shapes, and the pairs that are disabled.
    pub pairs: PairOptions,
    /// The mesh files.
    pub meshes: MeshOptions,
    /// What the URDD does not say.
    pub setup: Option<Setup>,
}

/// Options of URDF for Drake.
#[derive(Debug, Clone, PartialEq)]
pub struct DrakeOptions {
    /// The robot.
    pub model: ModelOptions,
    /// The name of a ROS package, for a `package.xml` and a model directive beside the file.
    pub package: Option<String>,
    /// The name of the file, which the model directive refers to.
    pub file: Option<String>,
}

/// Options of MJCF.
#[derive(Debug, Clone, PartialEq)]
pub struct MjcfOptions {
    /// The shapes that approximate links: the geoms, and the shapes of the pairs.
    pub shapes: Shapes,
    /// The reasons for which pairs are excluded; `None` for those of the URDD. The user's edits apply in either case.
    pub reasons: Option<Vec<SkippedReason>>,
    /// The mesh files.
    pub meshes: MeshOptions,
    /// Whether the root link moves freely. Otherwise it is fixed to the world, unless `setup` says that it moves.
    pub floating_base: bool,
    /// The actuators of the joints of one DOF; `None` for no actuators.
    pub actuators: Option<ActuatorKind>,
    /// The frequency below which a joint follows its actuator, Hz. Gains are computed from it and from inertias. `None`
    /// for that of `setup`, or [`MjcfOptions::BANDWIDTH`].
    pub bandwidth: Option<f64>,
    /// Whether the IMU frames of `setup` get a gyroscope and an accelerometer.
    pub sensors: bool,
    /// The name of the file, for a scene with floor and light beside it that includes it: `NAME_scene.xml` for
    /// `NAME.xml`. `None` for no scene.
    pub scene_of: Option<String>,
    /// The tree of links.
    pub links: LinkOptions,
    /// What the URDD does not say.
    pub setup: Option<Setup>,
}

impl MjcfOptions {
    /// The bandwidth of actuators where none is given, Hz.
    pub const BANDWIDTH: f64 = 10.0;
}

/// Options of cuRobo's YAML.
#[derive(Debug, Clone, PartialEq)]
pub struct CuroboOptions {
    /// The spheres.
    pub spheres: SphereOptions,
    /// The path of a URDF, for the whole robot file. Otherwise, only what belongs to spheres is written.
    pub robot_file: Option<String>,
    /// What the URDD does not say. The robot file needs it: without it, it is guessed.
    pub setup: Option<Setup>,
}

/// Options of URDF with spheres.
#[derive(Debug, Clone, PartialEq)]
pub struct SpherizedOptions {
    /// The spheres.
    pub spheres: SphereOptions,
    /// The mesh files of visual geometry.
    pub meshes: MeshOptions,
}

/// Options of MoveIt's configuration. Without a setup, it is guessed.
#[derive(Debug, Clone, PartialEq)]
pub struct MoveitOptions {
    /// The robot.
    pub model: ModelOptions,
    /// The name of the package.
    pub package: String,
    /// The distribution whose MoveIt and ros2_control read it.
    pub ros: Ros,
}

/// Options of SDF.
#[derive(Debug, Clone, PartialEq)]
pub struct SdfOptions {
    /// The robot.
    pub model: ModelOptions,
    /// Whether the root link moves freely. Otherwise it is fixed to the world, unless the setup says that it moves.
    pub floating_base: bool,
}

/// Options of USD.
#[derive(Debug, Clone, PartialEq)]
pub struct UsdOptions {
    /// The shapes, and the pairs that are filtered. With [`keep_pairs`](PairOptions::keep_pairs), pairs of pieces are.
    pub pairs: PairOptions,
    /// The files of meshes and textures.
    pub meshes: MeshOptions,
    /// Whether the root link moves freely. Otherwise it is fixed to the world, unless `setup` says that it moves.
    pub floating_base: bool,
    /// What the drives of joints of one DOF are told; `None` for no drives.
    pub actuators: Option<ActuatorKind>,
    /// As [`MjcfOptions::bandwidth`].
    pub bandwidth: Option<f64>,
    /// The name of the file: that of a binary one is refused.
    pub file: Option<String>,
    /// What the URDD does not say.
    pub setup: Option<Setup>,
}

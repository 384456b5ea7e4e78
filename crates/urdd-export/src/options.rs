//! Options of exports, by format, and their ranges for all languages.

use urdd_directory::range::{OutOfRange, Range};
use urdd_format::link_shapes_skips::SkippedReason;

use crate::{Fit, Format, Ros, Setup, Shapes};
use urdd_directory::export_toml::ActuatorKind;

/// [`SphereBudget::PerLink`].
pub const SPHERES: Range = Range::whole("spheres", 1, 10_000);

/// [`SphereBudget::Total`].
pub const TOTAL_SPHERES: Range = Range::whole("total_spheres", 1, 65_535);

/// [`SphereOptions::samples`].
pub const SAMPLES: Range = Range::whole("samples", 100, 1_000_000);

/// [`ModelOptions::bandwidth`], in an `export.toml` too.
pub const BANDWIDTH: Range = Range::real("bandwidth", 0.01, 1000.0, "Hz");

/// [`Detail`].
const VISUALS: Range =
    Range::above_zero("visuals", "(a part between 0 and 1, or a whole number of triangles)");

/// A format and its options. [`Choices::options`](super::Choices::options) makes it of what a person chose.
#[derive(Debug, Clone, PartialEq)]
pub enum Options {
    /// [`Format::Srdf`].
    Srdf(ModelOptions),
    /// [`Format::Urdf`].
    Urdf(ModelOptions),
    /// [`Format::Drake`].
    Drake(DrakeOptions),
    /// [`Format::Mjcf`].
    Mjcf(MjcfOptions),
    /// [`Format::Curobo`].
    Curobo(SphereOptions),
    /// [`Format::Foam`].
    Foam(SphereOptions),
    /// [`Format::Spherized`].
    Spherized(SphereOptions),
    /// [`Format::Moveit`].
    Moveit(MoveitOptions),
    /// [`Format::Sdf`].
    Sdf(ModelOptions),
    /// [`Format::Usd`].
    Usd(UsdOptions),
}

impl Options {
    /// The format.
    pub fn format(&self) -> Format {
        match self {
            Options::Srdf(_) => Format::Srdf,
            Options::Urdf(_) => Format::Urdf,
            Options::Drake(_) => Format::Drake,
            Options::Mjcf(_) => Format::Mjcf,
            Options::Curobo(_) => Format::Curobo,
            Options::Foam(_) => Format::Foam,
            Options::Spherized(_) => Format::Spherized,
            Options::Moveit(_) => Format::Moveit,
            Options::Sdf(_) => Format::Sdf,
            Options::Usd(_) => Format::Usd,
        }
    }

    /// The options of a format with a whole robot, or those of one of spheres.
    fn either(&self) -> Result<&ModelOptions, &SphereOptions> {
        match self {
            Options::Srdf(model)
            | Options::Urdf(model)
            | Options::Drake(DrakeOptions { model, .. })
            | Options::Mjcf(MjcfOptions { model, .. })
            | Options::Moveit(MoveitOptions { model, .. })
            | Options::Sdf(model)
            | Options::Usd(UsdOptions { model, .. }) => Ok(model),
            Options::Curobo(of) | Options::Foam(of) | Options::Spherized(of) => Err(of),
        }
    }

    /// The options of a format with a whole robot; `None` for formats of spheres.
    pub(super) fn model(&self) -> Option<&ModelOptions> {
        self.either().ok()
    }

    /// The shapes that approximate links.
    pub(super) fn shapes(&self) -> Shapes {
        self.either().map_or_else(|of| of.shapes, |of| of.shapes)
    }

    /// What the URDD does not say.
    pub(super) fn setup(&self) -> Option<&Setup> {
        self.either().map_or_else(|of| of.setup.as_ref(), |of| of.setup.as_ref())
    }

    /// Checks that each option is in its range.
    pub(super) fn check(&self) -> Result<(), OutOfRange> {
        let meshes = match self.either() {
            Ok(of) => {
                of.bandwidth.map_or(Ok(0.0), |given| BANDWIDTH.check(given))?;
                &of.meshes
            }
            Err(of) => {
                match of.budget {
                    SphereBudget::Auto => {}
                    SphereBudget::PerLink(count) => _ = SPHERES.check(count as f64)?,
                    SphereBudget::Total(count) => _ = TOTAL_SPHERES.check(count as f64)?,
                }
                SAMPLES.check(of.samples as f64)?;
                &of.meshes
            }
        };
        meshes.visuals.map_or(Ok(()), Detail::check)
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

impl Detail {
    /// A part of all triangles, or a number of them.
    ///
    /// # Errors
    /// If it is neither.
    pub fn new(given: f64) -> Result<Detail, OutOfRange> {
        match VISUALS.check(given)? {
            ratio if ratio < 1.0 => Ok(Detail::Ratio(ratio)),
            count if count.fract() == 0.0 => Ok(Detail::Triangles(count as usize)),
            given => Err(OutOfRange { range: VISUALS, given }),
        }
    }

    fn check(self) -> Result<(), OutOfRange> {
        let (given, is_wrong) = match self {
            Detail::Full => return Ok(()),
            Detail::Ratio(ratio) => (ratio, !(ratio > 0.0 && ratio < 1.0)),
            Detail::Triangles(count) => (count as f64, count == 0),
        };
        if is_wrong { Err(OutOfRange { range: VISUALS, given }) } else { Ok(()) }
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

impl SphereBudget {
    /// The budget for a number per link, or for all links together, which counts first.
    pub fn new(per_link: Option<impl Into<usize>>, total: Option<impl Into<usize>>) -> Self {
        let total = total.map(|count| SphereBudget::Total(count.into()));
        let per_link = per_link.map(|count| SphereBudget::PerLink(count.into()));
        total.or(per_link).unwrap_or_default()
    }
}

/// Options of formats that have a whole robot: all options of SRDF, URDF and SDF. What a format has no place for is not
/// read.
#[derive(Debug, Clone, PartialEq)]
pub struct ModelOptions {
    /// The shapes that approximate links: the collision geometry, and the shapes of the pairs.
    pub shapes: Shapes,
    /// The reasons for which pairs are disabled; `None` for those of the URDD. The user's edits apply in either case.
    pub reasons: Option<Vec<SkippedReason>>,
    /// Whether a pair of links is checked of which the URDD skips some pairs of pieces and checks others. Otherwise the
    /// pair is disabled, since pieces that are always in contact would collide in every configuration. MJCF has pairs of
    /// pieces in any case, and USD then has.
    pub keep_pairs: bool,
    /// What is done to links and shapes.
    pub links: LinkOptions,
    /// The files of meshes and textures.
    pub meshes: MeshOptions,
    /// Whether the root link moves freely. Otherwise it is fixed to the world, unless `setup` says that it moves.
    pub floating_base: bool,
    /// What actuators and drives of joints of one DOF are told; `None` for none.
    pub actuators: Option<ActuatorKind>,
    /// The frequency below which a joint follows its actuator, Hz. Gains are computed from it and from inertias. `None`
    /// for that of `setup`, or [`ModelOptions::BANDWIDTH`].
    pub bandwidth: Option<f64>,
    /// What the URDD does not say.
    pub setup: Option<Setup>,
}

impl ModelOptions {
    /// The bandwidth of actuators where none is given, Hz.
    pub const BANDWIDTH: f64 = 10.0;
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
    /// The robot.
    pub model: ModelOptions,
    /// Whether the IMU frames of the setup get a gyroscope and an accelerometer.
    pub sensors: bool,
    /// The name of the file, for a scene with floor and light beside it that includes it: `NAME_scene.xml` for
    /// `NAME.xml`. `None` for no scene.
    pub scene_of: Option<String>,
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

/// Options of USD.
#[derive(Debug, Clone, PartialEq)]
pub struct UsdOptions {
    /// The robot.
    pub model: ModelOptions,
    /// The name of the file: that of a binary one is refused.
    pub file: Option<String>,
}

/// Options of formats of spheres.
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
    /// URDF: the mesh files of visual geometry.
    pub meshes: MeshOptions,
    /// cuRobo: the path of a URDF, for the whole robot file. Otherwise, only what belongs to spheres is written.
    pub robot_file: Option<String>,
    /// What the URDD does not say. The robot file needs it: without it, it is guessed.
    pub setup: Option<Setup>,
}

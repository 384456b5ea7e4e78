//! Options of an export.

use urdd_format::link_shapes_skips::SkippedReason;
use urdd_robot::ShapeKind;

use super::setup::{JointGains, Setup};

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
    /// How much of it: fewer triangles for simulators.
    pub detail: Detail,
    /// The folder of the mesh files, relative to the text: without a trailing `/`, and empty for the same folder.
    pub mesh_folder: String,
    /// The name of the exported file, which others that are written beside it refer to: a scene of MJCF, a model directive
    /// of Drake.
    pub file: Option<String>,
    /// The name of a ROS package: of MoveIt's configuration, by default [`Options::PACKAGE`]; or of a file for Drake, which
    /// then comes with a `package.xml` and a model directive.
    pub package: Option<String>,
    /// The path of a URDF, for cuRobo's whole robot file. Otherwise, only what belongs to spheres is written.
    pub robot_file: Option<String>,
    /// Whether the root link of an MJCF or SDF moves freely. Otherwise it is fixed to the world, unless
    /// [`Options::setup`] says that it moves.
    pub floating_base: bool,
    /// What the URDD does not say. Without it, formats that need it guess.
    pub setup: Option<Setup>,
    /// What MJCF alone has.
    pub mjcf: MjcfOptions,
}

impl Options {
    /// The name of the package of a configuration of MoveIt.
    pub const PACKAGE: &str = "robot_moveit_config";

    /// What a person set for the actuator of a joint.
    pub(super) fn gains(&self, joint: usize) -> JointGains {
        let setup = self.setup.as_ref();
        let gains = setup.and_then(|setup| setup.gains.joints.get(&joint));
        gains.copied().unwrap_or_default()
    }

    /// The coefficient of friction of all shapes, if a person set one.
    pub(super) fn friction(&self) -> Option<f64> {
        self.setup.as_ref().and_then(|setup| setup.friction)
    }

    pub(super) fn package(&self) -> &str {
        self.package.as_deref().unwrap_or(Self::PACKAGE)
    }

    /// Whether the root link moves freely.
    pub(super) fn floating(&self) -> bool {
        let setup = self.setup.as_ref();
        self.floating_base || setup.is_some_and(|setup| setup.floating.value)
    }
}

/// Number of triangles of visual geometry.
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

/// Options of MJCF.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct MjcfOptions {
    /// The actuators of the joints of one DOF; `None` for no actuators.
    pub actuators: Option<ActuatorKind>,
    /// The frequency below which a joint follows its actuator, Hz. Gains are computed from it and from inertias. `None`
    /// for that of [`Options::setup`], or 10 Hz.
    pub bandwidth: Option<f64>,
    /// Whether the IMU frames of [`Options::setup`] get a gyroscope and an accelerometer.
    pub sensors: bool,
    /// Whether a scene with floor and light is written beside the file [`Options::file`]: `NAME_scene.xml` for `NAME.xml`.
    pub scene: bool,
}

impl MjcfOptions {
    /// The bandwidth of actuators where none is given, Hz.
    pub const BANDWIDTH: f64 = 10.0;
}

/// What an actuator is told.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum ActuatorKind {
    /// A position, rad or m.
    Position,
    /// A velocity, rad/s or m/s.
    Velocity,
    /// A torque or a force, N m or N.
    Motor,
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
            detail: Detail::Full,
            mesh_folder: "meshes".to_owned(),
            file: None,
            package: None,
            robot_file: None,
            floating_base: false,
            setup: None,
            mjcf: MjcfOptions::default(),
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

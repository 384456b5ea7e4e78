//! Arguments of `urdd export`.

use std::path::PathBuf;

use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
use clap::{Args, ValueEnum};

use crate::cli::words::{Shapes, Skip};
use urdd_export::{
    ActuatorKind, BANDWIDTH, Detail, Fit, Format, Ros, SAMPLES, SPHERES, TOTAL_SPHERES,
};

/// Arguments of `urdd export`.
#[derive(Args)]
#[command(
    after_help = "Meshes are written to a folder beside the file: the file's name without its extension, followed by `_meshes`.\n\n\
    `urdd export init URDD` writes `NAME.export.toml` beside the URDD `NAME`: groups, end effectors, tool frames, gains. \
    Every export reads it.\n\n\
    Exit status: 0 written; 2 nothing was written."
)]
pub struct ExportArguments {
    /// The format.
    #[arg(value_enum)]
    pub format: Target,

    /// A URDD: a folder or a zip archive.
    #[arg(value_name = "URDD")]
    pub path: PathBuf,

    /// The file to write; `-` prints a format that has no mesh files. For `moveit`, a folder. For `init`, by default
    /// `NAME.export.toml` beside the URDD.
    #[arg(long, short, value_name = "FILE")]
    pub output: Option<PathBuf>,

    /// What the URDD does not say: groups, end effectors, tool frames, gains. Default: `NAME.export.toml` beside the URDD,
    /// if it is there.
    #[arg(long, value_name = "FILE")]
    pub setup: Option<PathBuf>,

    /// Shapes that represent the links, in the collision geometry and in the disabled pairs.
    #[arg(long, value_parser = shapes(), default_value = "pieces")]
    pub shapes: urdd_export::Shapes,

    /// Reasons for which pairs of links are disabled, separated by commas. Default: those of the URDD. A person's edits
    /// apply in either case.
    #[arg(long, value_enum, value_name = "REASONS", value_delimiter = ',')]
    pub reasons: Option<Vec<Skip>>,

    /// Checks a pair of links if the URDD skips some pairs of their pieces and checks others. By default, such a pair is
    /// disabled. Applies to formats that list pairs of links; MJCF always follows the URDD for each piece, and USD then
    /// does.
    #[arg(long)]
    pub keep_pairs: bool,

    /// Maximum number of spheres per link. Default: 12 on average and at most 150 in total; with `--cover`, 8.
    #[arg(long, value_name = "N", value_parser = |word: &str| SPHERES.parse::<u16>(word))]
    pub spheres: Option<u16>,

    /// Maximum number of spheres for all links together; each link has at least one.
    #[arg(long, value_name = "N", conflicts_with = "spheres", value_parser = |word: &str| TOTAL_SPHERES.parse::<u16>(word))]
    pub total_spheres: Option<u16>,

    /// Makes the spheres enclose each link completely. No collision is missed then, but often every configuration is in
    /// contact; the file states how often. By default, spheres are fitted to give the same answers as the shapes.
    #[arg(long)]
    pub cover: bool,

    /// Number of sampled configurations in which spheres are measured; fewer where that would take long.
    #[arg(long, value_name = "N", default_value_t = 10_000, value_parser = |word: &str| SAMPLES.parse::<u32>(word))]
    pub samples: u32,

    /// Leaves out visual geometry.
    #[arg(long)]
    pub no_visuals: bool,

    /// Visual geometry with fewer triangles: at most a part of them (`0.1`), or at most as many in total (`20000`).
    #[arg(long, value_name = "RATIO|TRIANGLES", conflicts_with = "no_visuals", value_parser = detail)]
    pub visuals: Option<Detail>,

    /// MJCF, SDF and USD: the root link moves freely. Otherwise it is fixed to the world.
    #[arg(long)]
    pub floating_base: bool,

    /// Puts a box, cylinder, capsule or sphere around each convex mesh in its place, the tightest that has at most VOLUME
    /// times the volume of the mesh and is at most STANDOFF metres off it. Default: 1.2,0.005. Pairs are judged by these
    /// shapes. Not for formats of spheres.
    #[arg(long, value_name = "VOLUME,STANDOFF", num_args = 0..=1, require_equals = true)]
    pub fit: Option<Option<Fit>>,

    /// Makes one body of links that are fixed to each other, with their masses, shapes and pairs. Each keeps its frame: a
    /// site, a frame, an empty `Xform`, or in URDF an empty link. Not for formats of spheres.
    #[arg(long)]
    pub merge_fixed: bool,

    /// Makes another link the root: joints between it and the old root are turned round. Values, limits and names of joints
    /// stay. Not for formats of spheres.
    #[arg(long, value_name = "LINK")]
    pub root: Option<String>,

    /// MJCF and USD: adds an actuator, or a drive, to each joint of one DOF. Gains are computed from inertias, for `--bandwidth`.
    #[arg(long, value_enum, value_name = "KIND", default_value_t = Actuators::None)]
    pub actuators: Actuators,

    /// MJCF and USD: the frequency below which a joint follows its actuator, Hz.
    /// Default: that of `NAME.export.toml`, or 10.
    #[arg(long, value_name = "HZ", value_parser = |word: &str| BANDWIDTH.parse::<f64>(word))]
    pub bandwidth: Option<f64>,

    /// MJCF: a gyroscope and an accelerometer at each IMU frame of `NAME.export.toml`.
    #[arg(long)]
    pub sensors: bool,

    /// MJCF: writes a scene with floor and light beside the file: `NAME_scene.xml`.
    #[arg(long)]
    pub scene: bool,

    /// cuRobo: writes the whole robot file, for the URDF of this path. Default: the name of the source.
    #[arg(long, value_name = "URDF", num_args = 0..=1, require_equals = true)]
    pub config: Option<Option<String>>,

    /// MoveIt: the name of the package. Default: the name of the folder. Drake: writes `package.xml` and a model directive
    /// beside the file.
    #[arg(long, value_name = "NAME")]
    pub package: Option<String>,

    /// MoveIt: the distribution of ROS 2 whose MoveIt and ros2_control read the package. Default: jazzy, whose files Kilted
    /// reads too.
    #[arg(long, value_name = "DISTRIBUTION", value_parser = ros())]
    pub ros: Option<Ros>,

    /// Replaces the pairs of links in an existing SRDF, except those that a person wrote (their reason is `User` or free
    /// text). Everything else in the file is unchanged. For `moveit`, all other files that exist stay as they are.
    #[arg(long, conflicts_with = "force")]
    pub update: bool,

    /// Writes what was carried, carried otherwise and lost of this robot to a file, as JSON.
    #[arg(long, value_name = "FILE")]
    pub report: Option<PathBuf>,

    /// Overwrites existing files.
    #[arg(long)]
    pub force: bool,
}

/// The kinds of shapes, and those of the source.
fn shapes() -> impl TypedValueParser<Value = urdd_export::Shapes> {
    let kinds = Shapes::value_variants().iter().filter_map(ValueEnum::to_possible_value);
    let source = PossibleValue::new(urdd_export::Shapes::SOURCE).help(
        "The collision elements of the source: boxes, cylinders, capsules, spheres and meshes as it has them, and \
         pieces for links that have none. Visual primitives stay primitives too",
    );
    PossibleValuesParser::new(kinds.chain([source]))
        .try_map(|word| word.parse::<urdd_export::Shapes>())
}

/// The distributions of ROS 2.
fn ros() -> impl TypedValueParser<Value = Ros> {
    PossibleValuesParser::new(Ros::ALL.iter().map(|ros| ros.word()))
        .try_map(|word| word.parse::<Ros>())
}

/// A part of all triangles, or a number of them.
fn detail(word: &str) -> Result<Detail, String> {
    let detail = word.parse().ok().and_then(|number| Detail::new(number).ok());
    detail.ok_or_else(|| "a part between 0 and 1, such as 0.1, or a number of triangles".to_owned())
}

#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Target {
    /// Pairs of links that need no check, for MoveIt.
    Srdf,
    /// URDF of the robot, with the URDD's shapes as collision geometry.
    Urdf,
    /// The same for Drake, with collision filter groups.
    Drake,
    /// For MuJoCo: bodies, joints, shapes, excluded pairs.
    Mjcf,
    /// Spheres and ignored pairs per link, for cuRobo.
    Curobo,
    /// Spheres per link, in Foam's format.
    Foam,
    /// URDF of the robot, with these spheres as collision geometry.
    Spherized,
    /// A configuration package for MoveIt 2: a folder.
    Moveit,
    /// For Gazebo and Drake: links, joints, shapes.
    Sdf,
    /// For Isaac, Newton and Omniverse: a `.usda` of rigid bodies, joints, shapes, filtered pairs.
    Usd,
    /// What exports need and the URDD does not say, guessed: groups, end effectors, tool frames.
    Init,
}

impl Target {
    /// The format, which has the same word; `None` for what is no robot.
    pub fn format(self) -> Option<Format> {
        self.to_possible_value()?.get_name().parse().ok()
    }
}

#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Actuators {
    /// No actuators.
    None,
    /// They are told positions, rad or m.
    Position,
    /// They are told velocities, rad/s or m/s.
    Velocity,
    /// They are told torques or forces, N m or N.
    Motor,
}

impl Actuators {
    /// The kind, which has the same word; `None` for no actuators.
    pub fn kind(self) -> Option<ActuatorKind> {
        self.to_possible_value()?.get_name().parse().ok()
    }
}

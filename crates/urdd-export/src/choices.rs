//! What a person can choose of an export: one table. The command line, Python, JavaScript and docs/export.md have their
//! options of it.

use std::path::PathBuf;

use serde_json::Value;
use thiserror::Error;

use crate::setup::BANDWIDTH;
use crate::{Detail, Fit, Format, NoFit, Ros, Setup, Shapes};
use urdd_directory::export_toml::ActuatorKind;
use urdd_directory::range::{OutOfRange, Range};
use urdd_format::link_shapes_skips::SkippedReason;
use urdd_format::shape_kind::UnknownShapeKind;
use urdd_format::word::{UnknownWord, Word, with_word};
use urdd_robot::ShapeKind;

const SHAPES: [Word; 7] = [
    ("pieces", "The convex pieces of links"),
    ("hulls", "The convex hulls of links"),
    ("boxes", "The bounding boxes of hulls"),
    ("spheres", "The bounding spheres of hulls"),
    ("piece-boxes", "The bounding boxes of pieces"),
    ("piece-spheres", "The bounding spheres of pieces"),
    (
        Shapes::SOURCE,
        "The collision elements of the source: boxes, cylinders, capsules, spheres and meshes as it has them, and pieces for links that have none. Visual primitives stay primitives too",
    ),
];

/// The kinds of shapes.
pub const KINDS: [Word; 6] = {
    let [kinds @ .., _] = SHAPES;
    kinds
};

/// The reasons to skip a pair of shapes.
pub const REASONS: &[Word] = &[
    ("same-link", "Both shapes belong to the same link"),
    ("always", "In contact in every sampled configuration"),
    ("adjacent", "A joint connects the two links"),
    ("default", "In contact in the default configuration: zero, clamped to the bounds"),
    ("never", "In contact in no sampled configuration"),
];

const ALL: &[Format] = Format::ALL;

/// Formats of links with shapes. Spheres are fitted to links as the URDD has them.
const TREE: &[Format] = &[
    Format::Srdf,
    Format::Urdf,
    Format::Drake,
    Format::Mjcf,
    Format::Moveit,
    Format::Sdf,
    Format::Usd,
    Format::UrdfPlus,
    Format::ExtendedUrdf,
];

/// Declares [`Choices`], and what front ends know of each.
macro_rules! choices {
    ($($(#[doc = $about:literal])+ $name:ident: $type:ty = $default:expr, $shown:literal $kind:expr, $of:expr;)+) => {
        /// What a person chose, by the names that options have in Python.
        #[derive(Debug, Clone, PartialEq)]
        pub struct Choices {
            $($(#[doc = $about])+ pub $name: $type,)+
            /// Where the file, or the folder of a package, will be written.
            pub output: Option<PathBuf>,
            /// What the URDD does not say.
            pub setup: Option<Setup>,
        }

        impl Default for Choices {
            fn default() -> Self {
                Choices { $($name: $default,)+ output: None, setup: None }
            }
        }

        /// All options but those of files, in the order of the command line.
        pub const CHOICES: &[Choice] = &[$(Choice {
            name: stringify!($name),
            shown: $shown,
            about: concat!($($about),+),
            kind: $kind,
            of: $of,
            default: || <$type as Chosen>::write(&$default),
            is_chosen: |choices| choices.$name != $default,
            check: |choices| choices.$name.check($kind),
            set: |choices, value| {
                Some(Chosen::read(value, $kind)?.map(|read| choices.$name = read))
            },
        },)+];
    };
}

choices! {
    /// Shapes that represent the links, in the collision geometry and in the disabled pairs.
    shapes: Shapes = ShapeKind::Pieces.into(), "SHAPES" Kind::Word(&SHAPES), ALL;
    /// Reasons for which pairs of links are disabled[, separated by commas]. Default: those of the URDD. A person's edits
    /// apply in either case.
    reasons: Option<Vec<SkippedReason>> = None, "REASONS" Kind::Words(REASONS), ALL;
    /// Checks a pair of links if the URDD skips some pairs of their pieces and checks others. By default, such a pair is
    /// disabled. Applies to formats that list pairs of links; MJCF always follows the URDD for each piece, and USD then
    /// does.
    keep_pairs: bool = false, "" Kind::Flag, ALL;
    /// Maximum number of spheres per link. Default: 12 on average and at most 150 in total; with `--cover`, 8.
    spheres: Option<usize> = None, "N" Kind::Number(Range::whole("spheres", 1, 10_000)), ALL;
    /// Maximum number of spheres for all links together; each link has at least one.
    total_spheres: Option<usize> = None, "N" Kind::Number(Range::whole("total_spheres", 1, 65_535)), ALL;
    /// Makes the spheres enclose each link completely. No collision is missed then, but often every configuration is in
    /// contact; the file states how often. By default, spheres are fitted to give the same answers as the shapes.
    cover: bool = false, "" Kind::Flag, ALL;
    /// Number of sampled configurations in which spheres are measured; fewer where that would take long.
    samples: usize = 10_000, "N" Kind::Number(Range::whole("samples", 100, 1_000_000)), ALL;
    /// Visual geometry with fewer triangles: at most a part of them (`0.1`), or at most as many in total (`20000`).
    visuals: Detail = Detail::Full, "RATIO|TRIANGLES" Kind::Detail, ALL;
    /// The folder of the mesh files, relative to the file. Default: the name of the file without its extension, followed by
    /// `_meshes`.
    mesh_folder: Option<String> = None, "FOLDER" Kind::Text, ALL;
    /// MJCF, SDF and USD: the root link moves freely. Otherwise it is fixed to the world.
    floating_base: bool = false, "" Kind::Flag, &[Format::Mjcf, Format::Sdf, Format::Usd];
    /// Puts a box, cylinder, capsule or sphere around each convex mesh in its place, the tightest that has at most VOLUME
    /// times the volume of the mesh and is at most STANDOFF metres off it. [Default: 1.2,0.005. ]Pairs are judged by these
    /// shapes. Not for formats of spheres.
    fit: Option<Fit> = None, "VOLUME,STANDOFF" Kind::Fit, TREE;
    /// Makes one body of links that are fixed to each other, with their masses, shapes and pairs. Each keeps its frame: a
    /// site, a frame, an empty `Xform`, or in URDF an empty link. Not for formats of spheres.
    merge_fixed: bool = false, "" Kind::Flag, TREE;
    /// Makes another link the root: joints between it and the old root are turned round. Values, limits and names of joints
    /// stay. Not for formats of spheres.
    root: Option<String> = None, "LINK" Kind::Text, TREE;
    /// MJCF and USD: adds an actuator, or a drive, to each joint of one DOF. Gains are computed from inertias, for `--bandwidth`.
    actuators: Option<ActuatorKind> = None, "KIND" Kind::Word(ActuatorKind::WORDS), &[Format::Mjcf, Format::Usd];
    /// MJCF and USD: the frequency below which a joint follows its actuator, Hz.
    /// Default: that of `NAME.export.toml`, or 10.
    bandwidth: Option<f64> = None, "HZ" Kind::Number(BANDWIDTH), ALL;
    /// MJCF: a gyroscope and an accelerometer at each IMU frame of `NAME.export.toml`.
    sensors: bool = false, "" Kind::Flag, &[Format::Mjcf];
    /// MJCF: writes a scene with floor and light beside the file: `NAME_scene.xml`.
    scene: bool = false, "" Kind::Flag, &[Format::Mjcf];
    /// cuRobo: writes the whole robot file, for the URDF of this path.[ Default: the name of the source.]
    robot_file: Option<String> = None, "URDF" Kind::Text, &[Format::Curobo];
    /// MoveIt: the name of the package. Default: the name of the folder. Drake: writes `package.xml` and a model directive
    /// beside the file.
    package: Option<String> = None, "NAME" Kind::Text, &[Format::Moveit, Format::Drake];
    /// MoveIt: the distribution of ROS 2 whose MoveIt and ros2_control read the package. Default: jazzy, whose files Kilted
    /// reads too.
    ros: Option<Ros> = None, "DISTRIBUTION" Kind::Word(Ros::WORDS), &[Format::Moveit];
}

/// What front ends know of an option.
pub struct Choice {
    /// Its name in Python and JavaScript.
    pub name: &'static str,
    /// What stands for its value on the command line.
    pub shown: &'static str,
    about: &'static str,
    /// What it takes.
    pub kind: Kind,
    /// The formats that it is for. Others refuse it.
    pub of: &'static [Format],
    /// What it is where nobody chose.
    pub default: fn() -> Value,
    pub(super) is_chosen: fn(&Choices) -> bool,
    pub(super) check: fn(&Choices) -> Result<(), OutOfRange>,
    set: fn(&mut Choices, &Value) -> Option<Result<(), ChoiceError>>,
}

/// What an option takes, as JSON.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Kind {
    /// Whether something is done.
    Flag,
    /// A number.
    Number(Range),
    /// One of these words.
    Word(&'static [Word]),
    /// A list of these words.
    Words(&'static [Word]),
    /// A name, or a path.
    Text,
    /// A volume and a distance; `true` for the usual ones.
    Fit,
    /// Whether there is visual geometry, or how much.
    Detail,
}

/// What is wrong with a choice.
#[derive(Debug, Clone, PartialEq, Error)]
#[expect(missing_docs, reason = "each says it")]
pub enum ChoiceError {
    #[error(transparent)]
    Range(#[from] OutOfRange),
    #[error(transparent)]
    Word(#[from] UnknownWord),
    #[error(transparent)]
    Shapes(#[from] UnknownShapeKind),
    #[error(transparent)]
    Fit(#[from] NoFit),
    #[error("`{option}` must be {expected}")]
    Type { option: &'static str, expected: &'static str },
}

impl Choice {
    /// The option of a name.
    ///
    /// # Errors
    /// If there is none.
    pub fn named(name: &str) -> Result<&'static Choice, UnknownWord> {
        let all: Vec<&Choice> = CHOICES.iter().collect();
        with_word(name, &all, |choice| choice.name, "is no option")
    }

    /// What it does, with names of options as on the command line. What is in brackets is said there alone.
    pub fn about(&self, is_command_line: bool) -> String {
        let parts = self.about.trim().split(['[', ']']).enumerate();
        parts.filter_map(|(at, part)| (at % 2 == 0 || is_command_line).then_some(part)).collect()
    }

    /// The value that a word of the command line is.
    ///
    /// # Errors
    /// What is expected instead.
    pub fn parse(&self, word: &str) -> Result<Value, String> {
        Ok(match self.kind {
            Kind::Number(range) if range.unit.is_none() => range.parse::<u32>(word)?.into(),
            Kind::Number(range) => range.parse::<f64>(word)?.into(),
            Kind::Fit => word.parse::<Fit>().map_err(|error| error.to_string())?.write(),
            Kind::Detail => {
                let detail = word.parse().ok().and_then(|number| Detail::new(number).ok());
                let expected = "a part between 0 and 1, such as 0.1, or a number of triangles";
                detail.ok_or(expected)?.write()
            }
            Kind::Flag | Kind::Word(_) | Kind::Words(_) | Kind::Text => word.into(),
        })
    }

    /// Chooses a value; `null` leaves what it is.
    ///
    /// # Errors
    /// If it does not take the value.
    pub fn set(&self, choices: &mut Choices, value: &Value) -> Result<(), ChoiceError> {
        if value.is_null() {
            return Ok(());
        }
        (self.set)(choices, value).unwrap_or_else(|| {
            let expected = match self.kind {
                Kind::Flag => "true or false",
                Kind::Number(_) => "a number",
                Kind::Word(_) | Kind::Text => "a text",
                Kind::Words(_) => "a list of words",
                Kind::Fit => "two numbers",
                Kind::Detail => "true, false or a number",
            };
            Err(ChoiceError::Type { option: self.name, expected })
        })
    }
}

/// What an option is in the library, from and to JSON.
trait Chosen: Sized {
    /// `None` for a value of another type.
    fn read(value: &Value, kind: Kind) -> Option<Result<Self, ChoiceError>>;

    fn write(&self) -> Value {
        Value::Null
    }

    fn check(&self, _kind: Kind) -> Result<(), OutOfRange> {
        Ok(())
    }
}

/// How a value of a type is read, and, where one is a default, written.
macro_rules! chosen {
    ($($type:ty: $read:expr $(, $write:expr)?;)*) => {$(
        impl Chosen for $type {
            fn read(value: &Value, _kind: Kind) -> Option<Result<Self, ChoiceError>> {
                let read: fn(&Value) -> Option<Result<Self, ChoiceError>> = $read;
                read(value)
            }

            $(fn write(&self) -> Value {
                let write: fn(&Self) -> Value = $write;
                write(self)
            })?
        }
    )*};
}

chosen! {
    bool: |value| value.as_bool().map(Ok), |of| (*of).into();
    String: |value| value.as_str().map(|text| Ok(text.to_owned()));
    ActuatorKind: |value| value.as_str().map(|word| Ok(word.parse()?));
    Ros: |value| value.as_str().map(|word| Ok(word.parse()?));
    Shapes: |value| value.as_str().map(|word| Ok(word.parse()?)), |of| of.word().into();
    Vec<SkippedReason>: |value| {
        let words: Option<Vec<&str>> = value.as_array()?.iter().map(Value::as_str).collect();
        Some(words?.into_iter().map(|word| Ok(word.parse()?)).collect())
    };
    Fit: |value| match value.as_array().map(Vec::as_slice) {
        None if value == &Value::Bool(true) => Some(Ok(Fit::default())),
        Some([volume, standoff]) => {
            // JSON has no number that is not finite.
            let [volume, standoff] = [volume, standoff].map(|of| of.as_f64().unwrap_or(f64::NAN));
            Some(Fit::new(volume, standoff).map_err(Into::into))
        }
        _ => None,
    }, |of| vec![of.volume, of.standoff].into();
}

impl<T: Chosen> Chosen for Option<T> {
    fn read(value: &Value, kind: Kind) -> Option<Result<Self, ChoiceError>> {
        Some(T::read(value, kind)?.map(Some))
    }

    fn check(&self, kind: Kind) -> Result<(), OutOfRange> {
        self.as_ref().map_or(Ok(()), |of| of.check(kind))
    }
}

impl Chosen for f64 {
    fn read(value: &Value, kind: Kind) -> Option<Result<Self, ChoiceError>> {
        let number = value.as_f64()?;
        Some(number.check(kind).map(|()| number).map_err(Into::into))
    }

    fn check(&self, kind: Kind) -> Result<(), OutOfRange> {
        let Kind::Number(range) = kind else { return Ok(()) };
        range.check(*self).map(|_| ())
    }
}

impl Chosen for usize {
    fn read(value: &Value, kind: Kind) -> Option<Result<Self, ChoiceError>> {
        Some(f64::read(value, kind)?.map(|number| number as usize))
    }

    fn write(&self) -> Value {
        (*self).into()
    }

    fn check(&self, kind: Kind) -> Result<(), OutOfRange> {
        (*self as f64).check(kind)
    }
}

impl Chosen for Detail {
    fn read(value: &Value, _kind: Kind) -> Option<Result<Self, ChoiceError>> {
        match value {
            Value::Bool(true) => Some(Ok(Detail::Full)),
            Value::Bool(false) => Some(Ok(Detail::Nothing)),
            number => Some(Detail::new(number.as_f64()?).map_err(Into::into)),
        }
    }

    fn write(&self) -> Value {
        match self {
            Detail::Full => true.into(),
            Detail::Nothing => false.into(),
            Detail::Ratio(ratio) => (*ratio).into(),
            Detail::Triangles(count) => (*count).into(),
        }
    }

    fn check(&self, _kind: Kind) -> Result<(), OutOfRange> {
        self.is_in_range()
    }
}

//! Arguments that several commands share: how a description is read, and terms of the format as values.

use std::error::Error;
use std::path::{Path, PathBuf};
use std::str::FromStr;
use std::time::Duration;

use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
use clap::{Args, ValueEnum};

use super::output::{Failure, one_line, shown};
use urdd_export::Word;
use urdd_format::meshes::GeometryKind;
use urdd_format::report::Severity;
use urdd_format::root_metadata::ConformanceClass;
use urdd_lint::declared;
use urdd_source::{
    Declared, ImportOptions, Packages, Settings, XACRO_TIMEOUT, XacroSettings, declared_of,
};
use urdd_validate::settings_file::{SETTINGS_FILE, SettingsFile};

/// Where the mesh files of a URDF are.
#[derive(Args)]
pub(super) struct PackageArguments {
    /// Folder of a ROS package that a URDF names. May be repeated.
    #[arg(long = "package", value_name = "NAME=PATH")]
    packages: Vec<String>,

    /// Additional folder that the mesh files of a URDF may be read from, and the parts of a recipe, besides those of the
    /// robot, its packages and the recipe. May be repeated.
    #[arg(long = "allow-folder", value_name = "DIR")]
    allowed_folders: Vec<PathBuf>,

    /// The body of an MJCF or USD that is the root of the robot; default: told by the structure.
    #[arg(long, value_name = "NAME")]
    body: Option<String>,

    /// The model of an SDF file that has several.
    #[arg(long, value_name = "NAME")]
    model: Option<String>,

    /// How a ball joint of an MJCF, SDF or USD is written: as a spherical joint, which few programs read, or as three revolute
    /// joints.
    #[arg(long, value_enum, default_value_t = Ball::Spherical, value_name = "JOINTS")]
    ball: Ball,

    /// The mass of the links between several joints of one body of an MJCF, SDF or USD: none, or 1e-9 kg and 1e-9 kg m², which
    /// MuJoCo asks of what moves.
    #[arg(long, value_enum, default_value_t = Massless::None, value_name = "MASS")]
    massless: Massless,
}

/// The mass of links between joints.
#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Massless {
    /// None.
    None,
    /// 1e-9 kg and 1e-9 kg m².
    Tiny,
}

/// How a ball joint is written.
#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Ball {
    /// As one joint of the type `spherical`.
    Spherical,
    /// As three revolute joints.
    Revolute,
}

/// Settings with the packages that the environment names; the others are the defaults.
pub(super) fn around() -> Settings {
    let packages = Packages::from_environment(|name| std::env::var_os(name));
    Settings { packages, ..Settings::default() }
}

impl PackageArguments {
    /// Settings that use them; the others are the defaults.
    pub(super) fn settings(&self) -> Result<Settings, Failure> {
        let mut settings = around();
        for argument in &self.packages {
            let added = settings.packages.add(argument);
            added.map_err(|error| format!("--package: {}", one_line(error)))?;
        }
        if let Some(folder) = self.allowed_folders.iter().find(|it| !it.is_dir()) {
            Err(format!("--allow-folder: {} is not a folder", shown(folder)))?;
        }
        Ok(Settings {
            allowed_folders: self.allowed_folders.clone(),
            import: ImportOptions {
                body: self.body.clone(),
                model: self.model.clone(),
                has_revolute_balls: self.ball == Ball::Revolute,
                has_tiny_masses: self.massless == Massless::Tiny,
            },
            ..settings
        })
    }
}

/// What closes the loops of a URDF.
#[derive(Args)]
pub(super) struct LoopsArguments {
    /// File that says what closes the loops of a URDF, which says trees alone: a TOML, or the YAML of Extended URDF; default:
    /// NAME.loops.toml beside NAME.urdf, or NAME.yaml there if it has `closed_loop`.
    #[arg(long, value_name = "FILE")]
    pub(super) loops: Option<PathBuf>,
}

/// How xacro files are expanded.
#[derive(Args)]
pub(super) struct XacroArguments {
    /// Also expands macros in .urdf files, and the xacro files named in a recipe, found in a folder by `view` or `lint`, or found
    /// by `lint` as an SRDF of the robot.
    #[arg(long)]
    pub(super) xacro: bool,

    /// Time limit for xacro per file, in seconds.
    #[arg(long, value_name = "SECONDS", default_value = "60", value_parser = timeout)]
    xacro_timeout: Duration,
}

fn timeout(word: &str) -> Result<Duration, String> {
    let seconds = XACRO_TIMEOUT.parse(word)?;
    XacroSettings::seconds(seconds).map_err(|error| error.to_string())
}

impl XacroArguments {
    /// Settings that use them, with these arguments for the files.
    pub(super) fn settings(&self, arguments: Vec<String>) -> XacroSettings {
        XacroSettings {
            expand_urdf: self.xacro,
            arguments,
            time_limit: self.xacro_timeout,
            ..XacroSettings::default()
        }
    }
}

/// Splits the words into robots and xacro arguments.
pub(super) fn split(words: &[PathBuf]) -> (Vec<PathBuf>, Vec<String>) {
    let (mut robots, mut arguments) = (Vec::new(), Vec::new());
    for word in words {
        let text = word.to_str().unwrap_or_default();
        let is_argument = text.split_once(":=").is_some_and(|(name, _)| {
            let is_of_name = |c: char| c.is_alphanumeric() || c == '_';
            !name.is_empty() && name.chars().all(is_of_name)
        });
        if is_argument { arguments.push(text.to_owned()) } else { robots.push(word.clone()) }
    }
    (robots, arguments)
}

/// The xacro arguments, where nothing else may be.
pub(super) fn only_arguments(words: &[PathBuf]) -> Result<Vec<String>, Failure> {
    match split(words) {
        (others, arguments) if others.is_empty() => Ok(arguments),
        (others, _) => Err(format!(
            "{}: not an argument of xacro, which has the form name:=value",
            shown(&others[0])
        ))?,
    }
}

/// The settings file that is named, else that of the current folder, if there is one.
pub(super) fn settings_file(named: Option<&Path>) -> Result<SettingsFile, Failure> {
    let default = Path::new(SETTINGS_FILE);
    let file = named.or_else(|| default.is_file().then_some(default));
    Ok(file.map(SettingsFile::read).transpose()?.unwrap_or_default())
}

/// Where robots are declared.
#[derive(Args)]
pub(super) struct RobotArguments {
    /// Settings file that declares robots of xacro files, as [[robot]]; default: urdd.toml in the current folder, if it
    /// exists.
    #[arg(long, value_name = "FILE")]
    config: Option<PathBuf>,
}

impl RobotArguments {
    /// The robots that the settings file declares.
    pub(super) fn declared(&self) -> Result<Vec<Declared>, Failure> {
        Ok(declared(&settings_file(self.config.as_deref())?))
    }

    /// The arguments of the only robot that it declares of a file; `None` where it declares none.
    pub(super) fn arguments_of(&self, file: &Path) -> Result<Option<Vec<String>>, Failure> {
        match declared_of(file, &self.declared()?).as_slice() {
            [] => Ok(None),
            [one] => Ok(Some(one.arguments.clone())),
            several @ [first, ..] => {
                let settings = self.config.as_deref().unwrap_or(Path::new(SETTINGS_FILE));
                let words = format!(
                    "{}: {} declares {} robots of it; give the arguments of one, such as `{}`",
                    shown(file),
                    shown(settings),
                    several.len(),
                    one_line(first.arguments.join(" "))
                );
                Err(words.into())
            }
        }
    }
}

/// Declares values with the names of a type's, and what they say in `--help`.
macro_rules! words {
    ($($(#[$about:meta])* $word:ident for $term:ident { $($(#[$help:meta])* $variant:ident,)+ })+) => {$(
        $(#[$about])*
        #[derive(Debug, Clone, Copy, PartialEq, Eq, clap::ValueEnum)]
        pub enum $word {
            $($(#[$help])* $variant,)+
        }

        impl From<$word> for $term {
            fn from(word: $word) -> Self {
                match word {
                    $($word::$variant => $term::$variant,)+
                }
            }
        }
    )+};
}

words! {
    /// A conformance class.
    Class for ConformanceClass {
        /// The robot and its kinematics.
        Core,
        /// Core, and meshes.
        Geometry,
        /// Geometry, and boxes, spheres, distances and skips.
        Shapes,
    }

    /// A severity.
    Level for Severity {
        /// What programs refuse or get wrong, or what a URDD must not have.
        Error,
        /// What is wrong or risky for some programs, or what a URDD should not have.
        Warning,
        /// An outdated convention, or something worth knowing.
        Info,
    }

    /// The elements that geometry is taken from.
    Preferred for GeometryKind {
        /// The visual elements.
        Visual,
        /// The collision elements.
        Collision,
    }
}

/// Takes one of these words of the library, as what it stands for.
pub fn value_of<T>(words: &[Word]) -> impl TypedValueParser<Value = T>
where
    T: FromStr<Err: Error + Send + Sync> + Clone + Send + Sync + 'static,
{
    parser(words).try_map(|word| word.parse::<T>())
}

/// Takes one of these words of the library.
pub fn parser(words: &[Word]) -> PossibleValuesParser {
    let value = |(word, about): &Word| match about.trim().trim_end_matches('.') {
        "" => PossibleValue::new(*word),
        about => PossibleValue::new(*word).help(about),
    };
    words.iter().map(value).collect::<Vec<_>>().into()
}

/// How a command answers that writes files.
#[derive(Clone, Copy, PartialEq, Eq, clap::ValueEnum)]
pub(super) enum AnswerFormat {
    /// Text for people.
    Human,
    /// JSON, the same as --report writes.
    Json,
}

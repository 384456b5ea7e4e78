//! Arguments of `urdd export`.

use std::path::PathBuf;

use clap::builder::TypedValueParser;
use clap::{Arg, ArgAction, ArgMatches, Args, Command, FromArgMatches};
use serde_json::Value;

use crate::cli::words::parser;
use urdd_export::{CHOICES, Choice, Format, Kind};

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
    #[arg(value_parser = targets())]
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

    #[command(flatten)]
    pub chosen: Chosen,

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

/// What was chosen of the options that the library has.
pub struct Chosen(pub Vec<(&'static Choice, Value)>);

impl Args for Chosen {
    fn augment_args(command: Command) -> Command {
        CHOICES.iter().filter(|of| of.name != NAMED_AFTER_OUTPUT).fold(command, |command, of| {
            let command = match of.kind {
                Kind::Detail => command.arg(
                    Arg::new(NO_VISUALS)
                        .long(NO_VISUALS)
                        .action(ArgAction::SetTrue)
                        .help("Leaves out visual geometry"),
                ),
                _ => command,
            };
            command.arg(argument(of))
        })
    }

    fn augment_args_for_update(command: Command) -> Command {
        Self::augment_args(command)
    }
}

impl FromArgMatches for Chosen {
    fn from_arg_matches(matches: &ArgMatches) -> Result<Self, clap::Error> {
        let mut all = Vec::new();
        for of in CHOICES.iter().filter(|of| of.name != NAMED_AFTER_OUTPUT) {
            let given = || matches.get_many::<Value>(of.name).into_iter().flatten().cloned();
            let value = match of.kind {
                Kind::Flag => Some(matches.get_flag(of.name).into()),
                Kind::Words(_) => matches.contains_id(of.name).then(|| given().collect()),
                Kind::Detail if matches.get_flag(NO_VISUALS) => Some(false.into()),
                _ => match given().next() {
                    Some(Value::String(word)) if word == NONE && of.name == ACTUATORS => None,
                    // An option without its value.
                    None if matches.contains_id(of.name) => Some(true.into()),
                    given => given,
                },
            };
            all.extend(value.map(|value| (of, value)));
        }
        Ok(Chosen(all))
    }

    fn update_from_arg_matches(&mut self, matches: &ArgMatches) -> Result<(), clap::Error> {
        *self = Self::from_arg_matches(matches)?;
        Ok(())
    }
}

/// The option that follows from `--output` here.
const NAMED_AFTER_OUTPUT: &str = "mesh_folder";

const NO_VISUALS: &str = "no-visuals";

const ACTUATORS: &str = "actuators";

/// No actuators, in a word.
const NONE: &str = "none";

/// The name of an option here.
pub fn name_of(option: &str) -> String {
    match option {
        "robot_file" => "config".to_owned(),
        option => option.replace('_', "-"),
    }
}

/// An option of the library as an argument.
fn argument(of: &'static Choice) -> Arg {
    let help = of.about(true).trim_end_matches('.').to_owned();
    // clap keeps what is known when it is compiled.
    let argument = Arg::new(of.name).long(name_of(of.name).leak() as &str).help(help);
    let argument = match of.kind {
        Kind::Flag => return argument.action(ArgAction::SetTrue),
        Kind::Word(words) if of.name == ACTUATORS => {
            let words = [&[(NONE, "No actuators")], words].concat();
            argument.value_parser(parser(&words).map(Value::String)).default_value(NONE)
        }
        Kind::Word(words) => argument.value_parser(parser(words).map(Value::String)),
        Kind::Words(words) => (argument.value_parser(parser(words).map(Value::String)))
            .action(ArgAction::Append)
            .value_delimiter(','),
        _ => argument.value_parser(|word: &str| of.parse(word)).allow_negative_numbers(true),
    };
    let argument = argument.value_name(of.shown);
    match (of.name, (of.default)()) {
        ("fit" | "robot_file", _) => argument.num_args(0..=1).require_equals(true),
        ("total_spheres", _) => argument.conflicts_with("spheres"),
        ("visuals", _) => argument.conflicts_with(NO_VISUALS),
        (_, Value::String(word)) => argument.default_value(word.leak() as &str),
        (_, Value::Number(number)) => argument.default_value(number.to_string().leak() as &str),
        _ => argument,
    }
}

/// The words of formats, and that for what is no robot.
fn targets() -> impl TypedValueParser<Value = Target> {
    let init =
        "What exports need and the URDD does not say, guessed: groups, end effectors, tool frames";
    parser(&[Format::WORDS, &[("init", init)]].concat()).map(|word| Target(word.parse().ok()))
}

/// A format; `None` for what is no robot.
#[derive(Clone, Copy)]
pub struct Target(pub Option<Format>);

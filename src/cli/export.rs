//! `urdd export`.

use std::path::{Path, PathBuf};

use clap::builder::TypedValueParser;
use clap::{Arg, ArgAction, ArgMatches, Args, Command, FromArgMatches};
use serde_json::Value;

use super::arguments::{AnswerFormat, parser};
use super::inputs;
use super::output::{self, Failure, about, shown};
use super::watch::Watch;
use urdd_directory::account::Account;
use urdd_directory::cancellation::Cancellation;
use urdd_directory::outputs::{self, Output, Target as Place};
use urdd_export::{CHOICES, Choice, Choices, Export, Format, Kind, Note, Setup, export_within};
use urdd_format::readable::counted;
use urdd_robot::Robot;
use urdd_srdf::merge_srdf;

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
    format: Target,

    /// A URDD: a folder or a zip archive.
    #[arg(value_name = "URDD")]
    path: PathBuf,

    /// The file to write; `-` prints a format that has no mesh files. For `moveit`, a folder. For `init`, by default
    /// `NAME.export.toml` beside the URDD.
    #[arg(long, short, value_name = "FILE")]
    output: Option<PathBuf>,

    /// What the URDD does not say: groups, end effectors, tool frames, gains. Default: `NAME.export.toml` beside the URDD,
    /// if it is there.
    #[arg(long, value_name = "FILE")]
    setup: Option<PathBuf>,

    #[command(flatten)]
    chosen: Chosen,

    /// Replaces the pairs of links in an existing SRDF, except those that a person wrote (their reason is `User` or free
    /// text). Everything else in the file is unchanged. For `moveit`, all other files that exist stay as they are.
    #[arg(long, conflicts_with = "force")]
    update: bool,

    /// Writes what was carried, carried otherwise and lost of this robot to a file, as JSON.
    #[arg(long, value_name = "FILE")]
    report: Option<PathBuf>,

    /// Format of the answer on standard output: nothing, or JSON as --report writes it.
    #[arg(long = "format", value_name = "FORMAT", value_enum, default_value_t = AnswerFormat::Human)]
    answer: AnswerFormat,

    /// Overwrites existing files.
    #[arg(long)]
    force: bool,
}

/// What was chosen of the options that the library has.
struct Chosen(Vec<(&'static Choice, Value)>);

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
fn name_of(option: &str) -> String {
    match option {
        "robot_file" => "config".to_owned(),
        option => option.replace('_', "-"),
    }
}

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
struct Target(Option<Format>);

pub fn run(arguments: &ExportArguments, watch: &Watch) -> Result<u8, Failure> {
    watch.run_one(&arguments.path, None, |cancellation| {
        match arguments.format.0 {
            Some(format) => write_robot(arguments, format, cancellation)?,
            None => write_setup(arguments)?,
        }
        Ok(0)
    })
}

fn write_robot(
    arguments: &ExportArguments,
    format: Format,
    cancellation: &Cancellation,
) -> Result<(), Failure> {
    let output = arguments.output.as_deref().ok_or("give the file to write with -o")?;
    let is_alone = matches!(format, Format::Srdf | Format::Curobo | Format::Foam);
    if output.as_os_str() == "-" && !is_alone {
        Err("this format writes other files beside its own: give a file with -o")?;
    }
    if arguments.update && !matches!(format, Format::Srdf | Format::Moveit) {
        Err("--update is for srdf and moveit only; --force overwrites a file")?;
    }
    let robot = inputs::open(&arguments.path)?;
    let options = choices(arguments, &robot)?.options(format).map_err(|misfit| {
        format!("--{} is for {} only", name_of(misfit.option), misfit.formats())
    })?;
    let made = export_within(&robot, &options, &Account::new(cancellation));
    cancellation.check()?;
    let made = made.map_err(about(&arguments.path))?;
    for note in &made.notes {
        output::error(&format!("note: {note}"));
    }
    let is_disabled = |note: &Note| matches!(note, Note::Mixed { disabled: true, .. });
    if made.notes.iter().any(is_disabled) {
        let how = if format == Format::Usd { "by piece" } else { "as a whole" };
        output::error(&format!("note: --keep-pairs checks these pairs of links {how}"));
    }
    let is_json = arguments.answer == AnswerFormat::Json;
    if is_json && output.as_os_str() == "-" {
        Err(
            "standard output can have the file or the answer: give a file with -o, or leave out --format json",
        )?;
    }
    let report = is_json.then(|| made.report.clone());
    write(arguments, output, made)?;
    report.map_or(Ok(()), |report| Ok(output::print(&report)?))
}

fn choices(arguments: &ExportArguments, robot: &Robot) -> Result<Choices, Failure> {
    let mut choices = Choices {
        output: arguments.output.clone(),
        setup: Setup::find(arguments.setup.as_deref(), &arguments.path, robot)?,
        ..Choices::default()
    };
    for (choice, value) in &arguments.chosen.0 {
        let set = match (choice.name, value) {
            ("robot_file", Value::Bool(true)) => choice.set(&mut choices, &urdf_of(robot)?.into()),
            _ => choice.set(&mut choices, value),
        };
        set.map_err(|error| error.to_string())?;
    }
    Ok(choices)
}

/// The name of the URDF from which a URDD was made.
fn urdf_of(robot: &Robot) -> Result<String, Failure> {
    let path = robot.source()?.map(|source| source.path);
    let name = path.as_deref().and_then(|path| path.rsplit('/').next());
    Ok(name.unwrap_or("robot.urdf").to_owned())
}

/// The existing SRDF, merged with the new pairs.
fn merged(file: &Path, new: &str) -> Result<String, Failure> {
    let help = |error| format!("{error}; omit --update to write a new file");
    let merged = merge_srdf(&inputs::srdf(file).map_err(help)?, new).map_err(about(file))?;
    let pairs = |count| format!("{} of links", counted(count, "pair"));
    if merged.kept > 0 {
        let pairs = pairs(merged.kept);
        output::error(&format!(
            "note: kept {pairs} that a person disabled: their reason is not Adjacent, Always, Default or Never"
        ));
    }
    if merged.enabled > 0 {
        let pairs = pairs(merged.enabled);
        output::error(&format!("note: did not disable {pairs} that a person enabled"));
    }
    Ok(merged.text)
}

/// Writes the text, the other files and the report. What exists is overwritten on request only.
fn write(arguments: &ExportArguments, output: &Path, mut made: Export) -> Result<(), Failure> {
    let report = arguments.report.as_deref().map(|file| (file, made.report.as_bytes()));
    let force = arguments.force;
    if output.as_os_str() == "-" {
        if let Some((file, _)) = report {
            output::write_files(Place::File(file), Vec::new(), report, force, "")?;
        }
        return Ok(output::print_raw(&made.text)?);
    }
    let (own, target) = match &made.path {
        Some(path) => (PathBuf::from(path), Place::Folder(output)),
        None => (outputs::name_of(output).into(), Place::File(output)),
    };
    let place = target.folder().join(&own);
    let is_merged = arguments.update && (made.path.is_none() || place.exists());
    if is_merged {
        made.text = merged(&place, &made.text)?;
    }
    // The file that references the others is last.
    let mut files: Vec<Output> = (made.files.iter())
        .map(|(path, bytes)| Output { path: path.into(), bytes, replaces: force })
        .collect();
    if arguments.update {
        files.retain(|file| {
            let place = target.folder().join(&file.path);
            let stays = outputs::is_other(&place, file.bytes);
            if stays {
                output::error(&format!("note: {} stays as it is", shown(&place)));
            }
            !stays
        });
    }
    files.push(Output { path: own, bytes: made.text.as_bytes(), replaces: force || is_merged });
    let also = match arguments.format.0 {
        Some(Format::Srdf) => "; --update replaces the pairs of links in it",
        Some(Format::Moveit) => {
            "; --update replaces the pairs of links in the SRDF, and leaves other files as they are"
        }
        _ => "",
    };
    Ok(output::write_files(target, files, report, force, also)?)
}

/// Writes `NAME.export.toml`, or another file. One that exists is a person's: it stays.
fn write_setup(arguments: &ExportArguments) -> Result<(), Failure> {
    let path = &arguments.path;
    let robot = inputs::open(path)?;
    let setup = Setup::guess(&robot).map_err(about(path))?;
    let text = setup.to_toml(&robot).map_err(about(path))?;
    let file = arguments.output.clone().unwrap_or_else(|| Setup::path(path));
    if file.as_os_str() == "-" {
        return Ok(output::print_raw(&text)?);
    }
    if file.symlink_metadata().is_ok() && !arguments.force {
        Err(format!(
            "{} already exists and was left as it is: `-o -` prints the guesses, --force overwrites it",
            shown(&file)
        ))?;
    }
    output::write_alone(&file, text.as_bytes(), arguments.force)?;
    let file = shown(&file);
    let text = format!("{file}: written; check the lines that begin with `# Guess`\n");
    Ok(output::print(&text)?)
}

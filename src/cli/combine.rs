//! `urdd combine`.

use std::path::{Path, PathBuf};

use clap::Args;

use super::generate::MakingArguments;
use super::generate_output::{FAILED, Printer};
use super::output::{self, Failure, Signals};
use urdd_generate::batch::Observer;
use urdd_generate::combine::{Recipe, check_parts, combine};
use urdd_source::robots::Job;

/// Arguments of `urdd combine`.
#[derive(Args)]
#[command(
    after_help = "A recipe lists the parts, and where each one is attached (docs/combine.md explains all keys):\n\n  \
    name = \"cell\"\n\n  [[part]]\n  id = \"arm\"\n  source = \"arm_urdd\"\n  prefix = \"\"\n\n  [[part]]\n  id = \"gripper\"\n  \
    source = \"gripper.urdf\"\n  attach = { to = \"arm/tool0\", xyz = [0, 0, 0.1] }\n\n\
    A part is a URDD (a folder or a zip archive), or a URDF or xacro file. URDDs are validated first, and one with errors is \
    refused.\n\n\
    Parts must be in the recipe's folder, or in a folder given by --allow-folder. A xacro file named in a recipe is \
    expanded only with --xacro.\n\n\
    Exit status: 0 combined; 1 not combined; 2 usage error, or results could not be written; 129, 130 or 143 stopped by a signal."
)]
pub struct CombineArguments {
    /// A recipe; or two robots, where the second is attached to the link `--at` of the first.
    #[arg(required_unless_present = "from", conflicts_with = "from", num_args = 1..=2, value_name = "RECIPE.toml|ROBOT")]
    sources: Vec<PathBuf>,

    /// A published URDD from before version 1 that was combined, adjusted or created, with its parts beside it. Without
    /// --output, prints its recipe.
    #[arg(long, value_name = "LEGACY_DIR")]
    from: Option<PathBuf>,

    /// The folder of the URDD.
    #[arg(long, short, value_name = "DIR", required_unless_present = "from")]
    output: Option<PathBuf>,

    /// For two robots: link of the first robot that the second one is attached to.
    #[arg(long, value_name = "LINK")]
    at: Option<String>,

    /// For two robots: position of the second one's root in the frame of that link, in metres.
    #[arg(long, num_args = 3, value_names = ["X", "Y", "Z"], allow_negative_numbers = true, requires = "at")]
    xyz: Option<Vec<f64>>,

    /// For two robots: fixed-axis roll, pitch, yaw of the second one's root in that frame, in radians.
    #[arg(long, num_args = 3, value_names = ["ROLL", "PITCH", "YAW"], allow_negative_numbers = true, requires = "at")]
    rpy: Option<Vec<f64>>,

    /// For two robots: name of the combined robot; default: the names of both.
    #[arg(long, requires = "at")]
    name: Option<String>,

    /// Has no effect: parts are always validated. Up to 1.2, parts that passed were remembered without it.
    #[arg(long = "no-cache", hide = true)]
    _no_cache: bool,

    #[command(flatten)]
    making: MakingArguments,
}

pub fn run(arguments: &CombineArguments) -> Result<u8, Failure> {
    let stopped = "stopped by a signal; nothing was changed";
    output::stoppable(Some(stopped), |signals| put_together(arguments, signals))
}

fn put_together(arguments: &CombineArguments, signals: &Signals) -> Result<u8, Failure> {
    let settings = arguments.making.settings(Vec::new(), signals)?;
    let pool = arguments.making.pool()?;
    let printer = Printer::new(arguments.making.format, false);
    if let (Some(legacy), None) = (&arguments.from, &arguments.output) {
        return print_recipe(legacy);
    }
    let target = arguments.output.clone().unwrap_or_default();
    let source = arguments.from.as_ref().or(arguments.sources.first());
    let job = Job::new(source.cloned().unwrap_or_default(), target.display().to_string());
    let mut legacy_notes = Vec::new();
    let recipe = match (arguments.sources.as_slice(), &arguments.at) {
        ([], _) => Recipe::of_legacy(&job.source).map(|(recipe, notes)| {
            legacy_notes = notes;
            recipe
        }),
        ([file], None) => Recipe::read(file),
        ([holder, held], Some(at)) => {
            let three = |numbers: &Option<Vec<f64>>| {
                let numbers = numbers.as_deref().unwrap_or_default();
                <[f64; 3]>::try_from(numbers).unwrap_or_default()
            };
            let pose = [three(&arguments.xyz), three(&arguments.rpy)];
            Recipe::of_two(holder, held, arguments.name.as_deref(), at, pose)
        }
        ([_], Some(_)) => Err("--at attaches a second robot: give two robots")?,
        _ => Err(
            "two robots need --at: give the link of the first robot that the second one is attached to",
        )?,
    };
    let make = |recipe: Recipe| {
        let progress = printer.begin(&job);
        pool.install(|| {
            let find_errors =
                |part: &Path| urdd_validate::find_errors(part, &settings.source.cancellation);
            let distrusted = check_parts(&recipe, &settings, find_errors)?;
            let mut made = combine(&recipe, &target, &settings, &distrusted, &*progress)?;
            made.notes.splice(..0, legacy_notes);
            Ok(made)
        })
    };
    let outcome = output::without_panic_messages(|| recipe.and_then(make));
    if signals.status().is_none() {
        printer.combined(&job, &outcome);
    }
    printer.status(outcome.is_err())
}

/// Prints the recipe of a legacy URDD, and what it leaves open.
fn print_recipe(legacy: &Path) -> Result<u8, Failure> {
    let here = std::env::current_dir().unwrap_or_default();
    let recipe = Recipe::of_legacy(legacy);
    match recipe.and_then(|(recipe, notes)| Ok((recipe.to_toml(&here)?, notes))) {
        Err(error) => {
            output::error(&error.to_string());
            Ok(FAILED)
        }
        Ok((recipe, notes)) => {
            for note in notes {
                output::error(&format!("note: {note}"));
            }
            output::print_raw(&recipe)?;
            Ok(0)
        }
    }
}

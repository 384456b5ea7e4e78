//! `urdd picture`.

use std::path::{Path, PathBuf};

use clap::Args;

use super::arguments::{PackageArguments, XacroArguments, split};
use super::configurations::Lines;
use super::inputs;
use super::output::{self, Failure, about, shown};
use super::watch::Watch;
use urdd_directory::cancellation::Cancellation;
use urdd_directory::file_type::is_archive;
use urdd_directory::root::Root;
use urdd_directory::source::Memory;
use urdd_format::readable::counted;
use urdd_generate::{Settings, generate_in_memory};
use urdd_robot::Robot;
use urdd_source::note::{Note, NoteKind};
use urdd_view::picture::{Drawing, MAX_SIDE, modules, png};

/// Maximum number of meshes that are named as not drawn.
const MOST_NOTES: usize = 5;

/// Arguments of `urdd picture`.
#[derive(Args)]
#[command(
    after_help = "Without a browser or a display. The background is transparent; the robot fills the picture.\n\n\
    Exit status: 0 drawn; 2 nothing was written."
)]
pub struct PictureArguments {
    /// A URDD: a folder or a zip archive; or a URDF, xacro file, MJCF, SDF or USD. `name:=value` is an argument for xacro.
    #[arg(required = true, value_name = "ROBOT")]
    paths: Vec<PathBuf>,

    /// The file to write; `-` is standard output.
    #[arg(long, short, value_name = "FILE.png")]
    output: PathBuf,

    /// Width and height, in pixels.
    #[arg(long, value_name = "WIDTHxHEIGHT", default_value = "800x600", value_parser = size)]
    size: [u32; 2],

    /// The configuration: the name of a named one, or a value for each DOF (rad or m) as a line of `check-collisions` has
    /// them, such as `0,1.2,-0.5`. Default: the default configuration.
    #[arg(long, short, value_name = "NAME|VALUES", allow_hyphen_values = true)]
    configuration: Option<String>,

    /// The direction from the robot to the viewer, in the frame of the root link: 1,0,0 is the front, 0,0,1 from above.
    #[arg(long, value_name = "X,Y,Z", default_value = "1,-0.75,0.45", allow_hyphen_values = true, value_parser = direction)]
    from: [f64; 3],

    /// Overwrites the file if it exists.
    #[arg(long)]
    force: bool,

    #[command(flatten)]
    packages: PackageArguments,

    #[command(flatten)]
    xacro: XacroArguments,
}

fn size(word: &str) -> Result<[u32; 2], String> {
    let side = |word: &str| word.parse().ok().filter(|side| (1..=MAX_SIDE).contains(side));
    let sides =
        word.split_once('x').and_then(|(width, height)| Some([side(width)?, side(height)?]));
    sides.ok_or_else(|| format!("expected WIDTHxHEIGHT, each 1 to {MAX_SIDE}, such as 800x600"))
}

fn direction(word: &str) -> Result<[f64; 3], String> {
    let values: Result<Vec<f64>, _> = word.split(',').map(|value| value.trim().parse()).collect();
    let values = values.ok().and_then(|values| <[f64; 3]>::try_from(values).ok());
    let is_direction = |values: &[f64; 3]| {
        values.iter().all(|value| value.is_finite()) && values.iter().any(|value| *value != 0.0)
    };
    let message = "expected three numbers that are not all 0, such as 1,-0.75,0.45";
    values.filter(is_direction).ok_or_else(|| message.to_owned())
}

pub fn run(arguments: &PictureArguments, watch: &Watch) -> Result<u8, Failure> {
    let (paths, words) = split(&arguments.paths);
    let [path] = paths.as_slice() else {
        let count = counted(paths.len(), "path");
        return Err(format!("a picture is of one robot; found {count}").into());
    };
    watch.run_one(path, None, |cancellation| {
        let robot = match path.is_file() && !is_archive(path) {
            true => generated(path, words, arguments, cancellation)?,
            false => inputs::open(path)?,
        };
        let configuration = configuration(&robot, arguments.configuration.as_deref())
            .map_err(|error| about(path)(error))?;
        let drawing = Drawing { size: arguments.size, from: arguments.from };
        let picture = png(&robot, &configuration, &drawing, cancellation);
        let picture = picture.map_err(about(path))?;
        let picture = picture.ok_or_else(|| about(path)("it has no shape to draw"))?;
        if arguments.output.as_os_str() == "-" {
            output::print_bytes(&picture)?;
            return Ok(0);
        }
        output::write_alone(&arguments.output, &picture, arguments.force)?;
        output::print(&format!("{}\n", shown(&arguments.output)))?;
        Ok(0)
    })
}

/// The robot of a description, with what a picture needs.
fn generated(
    path: &Path,
    words: Vec<String>,
    arguments: &PictureArguments,
    cancellation: &Cancellation,
) -> Result<Robot, Failure> {
    let settings = Settings {
        selection: modules(),
        source: urdd_source::Settings {
            xacro: arguments.xacro.settings(words),
            cancellation: cancellation.clone(),
            ..arguments.packages.settings()?
        },
        ..Settings::default()
    };
    let (made, files) = generate_in_memory(path, &settings, &()).map_err(output::one_line)?;
    let is_missing =
        |note: &&Note| matches!(note.kind, NoteKind::MeshNotFound | NoteKind::MeshNotUsable);
    let missing: Vec<&Note> = made.notes.iter().filter(is_missing).collect();
    for note in missing.iter().take(MOST_NOTES) {
        output::error(&format!("note: {note}"));
    }
    if let Some(more @ 1..) = missing.len().checked_sub(MOST_NOTES) {
        output::error(&format!("note: and {more} more that are not drawn; `urdd lint` tells all"));
    }
    let root = Memory::new("robot", files);
    let root = root.map_err(|(file, _)| about(Path::new(&file))("not a name of a file of a URDD"));
    Ok(Robot::of(Root::of(root?)))
}

fn configuration(robot: &Robot, given: Option<&str>) -> Result<Vec<f64>, Failure> {
    let Some(given) = given else { return Ok(robot.configurations()?.zero()) };
    let is_number = given.trim().is_empty()
        || given.starts_with(|c: char| c.is_ascii_digit() || "+-.[{".contains(c));
    let is_named = |given: &str| {
        robot.named_configurations().map(|all| all.iter().any(|named| named.name.as_str() == given))
    };
    if !is_number || is_named(given)? {
        return Ok(robot.named_configuration(given)?.to_vec());
    }
    let read = Lines::new(robot)?.next(given)?;
    read.ok_or_else(|| "--configuration: expected a name, or a value for each DOF".into())
}

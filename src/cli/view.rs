//! `urdd view`.

use std::io::{BufRead, Read, Write};
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::sync::Arc;
use std::time::Duration;

use clap::Args;

use super::configurations::Lines;
use super::generate_output::{FAILED, Format, Printer};
use super::output::{self, Failure, one_line};
use super::packages::PackageArguments;
use super::signals::Signals;
use super::xacro::{self, XacroArguments};
use urdd_directory::discover::DiscoverError;
use urdd_format::escape;
use urdd_generate::Settings;
use urdd_robot::Robot;
use urdd_source::Files;
use urdd_source::import::format_of;
use urdd_source::process;
use urdd_source::robots::{self, BatchError, Job};
use urdd_view::{
    Collection, ExportError, Live, Server, Shown, Source, Temporary, export, may_hold_page,
    page_with,
};

/// Pause before the rest of a robot is generated.
const FIRST_THE_PICTURE: Duration = Duration::from_secs(2);

/// Arguments of `urdd view`.
#[derive(Args)]
#[command(
    after_help = "The page is served only on 127.0.0.1, and opens only from the printed address. A URDF is shown at once, and again \
    whenever it, a file that its xacro includes, or a mesh changes; its URDD is generated in a temporary folder. Robots of \
    a folder of URDFs are generated when they are opened.\n\n\
    Exit status: 0 after Ctrl-C, or when the site is written; 1 a robot to export could not be generated; 2 usage error, \
    no robot was found, or the server could not start."
)]
pub struct ViewArguments {
    /// URDDs, folders of them, zip archives of them; URDFs or xacro files; folders of URDFs, such as a ROS package: its
    /// .urdf.xacro files only with --xacro. `name:=value` is an argument for xacro.
    #[arg(required = true, value_name = "PATH")]
    paths: Vec<PathBuf>,

    /// The port; default: 8642, or any free port.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..))]
    port: Option<u16>,

    /// Does not open a browser.
    #[arg(long)]
    no_open: bool,

    /// Reads configurations from standard input, and shows each as it arrives: lines of CSV or JSON, as those of
    /// `check-collisions`. For one robot.
    #[arg(long)]
    follow: bool,

    /// Writes the page and the robots into a folder instead, as a site for any web server. A name that ends in `.html`
    /// writes the page with one robot into a single file that opens without a server.
    #[arg(long, value_name = "DIR|FILE.html", conflicts_with_all = ["port", "no_open", "follow"])]
    export: Option<PathBuf>,

    #[command(flatten)]
    packages: PackageArguments,

    #[command(flatten)]
    xacro: XacroArguments,
}

/// Maximum length of a line of standard input, in bytes.
const MAX_LINE: u64 = 1 << 20;

/// Runs `urdd view`.
pub fn run(arguments: &ViewArguments) -> ExitCode {
    match view(arguments) {
        Ok(status) => ExitCode::from(status),
        Err((status, message)) => {
            output::error(&escape::line(&message));
            ExitCode::from(status)
        }
    }
}

/// An exit status, and what to say.
type Stop = (u8, String);

fn usage(message: impl ToString) -> Stop {
    (output::USAGE, message.to_string())
}

fn view(arguments: &ViewArguments) -> Result<u8, Stop> {
    let signals = Signals::listen().map_err(usage)?;
    process::adopt_orphans();
    let (paths, xacro_arguments) = xacro::split(&arguments.paths);
    let settings = Settings {
        source: urdd_source::Settings {
            xacro: arguments.xacro.settings(xacro_arguments),
            ..arguments.packages.settings().map_err(usage)?
        },
        cancellation: signals.cancellation(),
        ..Settings::default()
    };
    // Generated URDDs exist as long as this value.
    let temporary = Temporary::begin(&std::env::temp_dir()).map_err(usage)?;
    let drops = temporary.path().join("dropped");
    let collection = Collection::default()
        .with_drops(drops, arguments.xacro.xacro)
        .with_settings(settings.clone());
    for path in &paths {
        add(path, arguments.xacro.xacro, &collection)?;
    }
    let robots = collection.robots();
    let live = Live {
        folder: temporary.path(),
        settings: &settings,
        observer: &Printer::new(Format::Human, false),
        pause: FIRST_THE_PICTURE,
    };
    if let Some(folder) = &arguments.export {
        for robot in &robots {
            let is_made = live.generate(robot);
            if let Some(status) = signals.status() {
                return Ok(status);
            }
            if !is_made {
                return Err((FAILED, "there is nothing to show".to_owned()));
            }
        }
        return written(&collection, folder, &signals);
    }
    // A robot by itself is opened at once; others when somebody chooses them.
    if let [robot] = robots.as_slice() {
        robot.see();
    }
    let followed = match (arguments.follow, robots.as_slice()) {
        (false, _) => None,
        (true, [robot]) => Some(Arc::clone(robot)),
        (true, several) => {
            let count = several.len();
            return Err(usage(format!("--follow shows one robot, and there are {count}")));
        }
    };
    let collection = Arc::new(collection);
    let server = Server::bind(Arc::clone(&collection), arguments.port).map_err(usage)?;
    std::thread::scope(|scope| {
        scope.spawn(|| live.run(&collection));
        if let Some(robot) = followed {
            // It waits for input when the others end.
            std::thread::spawn(move || {
                if let Err(message) = follow(&robot) {
                    output::error(&one_line(message));
                }
            });
        }
        let address = server.address();
        let count = output::counted(robots.len(), "robot");
        let printed = output::print(&format!("{count}: {address}\nCtrl-C stops it.\n"));
        let printed = printed.map_err(usage);
        if printed.is_err() {
            signals.cancellation().cancel();
        }
        let _ = std::io::stdout().flush();
        if !arguments.no_open
            && let Err(error) = temporary.page_to(&address).and_then(open::that_detached)
        {
            output::error(&format!(
                "no browser could be opened ({error}); open the address above yourself"
            ));
        }
        server.run(&signals.cancellation());
        printed.map(|()| 0)
    })
}

/// Shows the configurations of standard input. A line that is wrong is said, and left out.
fn follow(shown: &Shown) -> Result<(), Failure> {
    // A URDF is generated first.
    while !shown.is_ready() {
        std::thread::sleep(Duration::from_millis(50));
    }
    let robot = Robot::open(shown.path())?;
    let mut lines = Lines::new(&robot)?;
    let mut input = std::io::stdin().lock();
    let mut line = Vec::new();
    for number in 1u64.. {
        line.clear();
        let read = input.by_ref().take(MAX_LINE).read_until(b'\n', &mut line);
        read.map_err(|error| format!("standard input: {error}"))?;
        if line.is_empty() {
            break;
        }
        if line.len() as u64 == MAX_LINE {
            Err(format!("standard input:{number}: longer than 1 MiB"))?;
        }
        let read = match std::str::from_utf8(&line) {
            Ok(line) => lines.next(line),
            Err(_) => Err("it is not UTF-8".into()),
        };
        match read {
            Ok(Some(configuration)) => shown.states.set(&configuration),
            Ok(None) => {}
            Err(why) => {
                output::error(&escape::line(&format!("standard input:{number}: {why}")));
            }
        }
    }
    Ok(())
}

/// Adds the robots at a path: a URDF or xacro file; the URDDs at or below a folder, or else its URDFs.
fn add(path: &Path, with_xacro: bool, collection: &Collection) -> Result<(), Stop> {
    let ends = |path: &Path, ending: &str| {
        path.extension().is_some_and(|found| found.eq_ignore_ascii_case(ending))
    };
    let is_imported = || format_of(path, &Files::Disk).is_some();
    let is_source = ends(path, "xacro") || ends(path, "urdf") || is_imported();
    if is_source && path.is_file() {
        let mut jobs = robots::jobs(&[path.to_owned()]).map_err(usage)?;
        for job in &mut jobs {
            // Often the file is `robot.urdf`, and the folder has the robot's name.
            if job.name == "robot"
                && let Some(parent) = path.canonicalize().ok().as_deref().and_then(Path::parent)
                && let Some(parent) = parent.file_name()
            {
                job.name = parent.to_string_lossy().into_owned();
            }
        }
        add_jobs(jobs, collection);
        return Ok(());
    }
    match collection.add(path) {
        Err(DiscoverError::NoUrdd { .. }) if path.is_dir() => {}
        other => return other.map_err(usage),
    }
    let mut jobs = robots::jobs(&[path.to_owned()]).map_err(|error| match error {
        BatchError::Empty { path } => usage(format!(
            "{path}: there is no URDD, and no .urdf or .urdf.xacro file, at any depth"
        )),
        error => usage(error),
    })?;
    let count = jobs.len();
    if !with_xacro {
        jobs.retain(|job| !ends(&job.source, "xacro"));
    }
    let left = count - jobs.len();
    if left > 0 {
        let files = output::counted(left, ".urdf.xacro file");
        let told = format!("{}: left out {files}; --xacro runs them", path.display());
        if jobs.is_empty() {
            return Err(usage(told));
        }
        output::error(&escape::line(&told));
    }
    add_jobs(jobs, collection);
    Ok(())
}

fn add_jobs(jobs: Vec<Job>, collection: &Collection) {
    for Job { source, name } in jobs {
        // The working directory may change later.
        let file = std::path::absolute(&source).unwrap_or(source);
        collection.add_source(name, Source { file, packages: Vec::new() });
    }
}

/// Writes the site.
fn written(collection: &Collection, folder: &Path, signals: &Signals) -> Result<u8, Stop> {
    let mut tell = |robot: &Shown| {
        let _ = writeln!(std::io::stderr().lock(), "{}", one_line(&robot.name));
    };
    if folder.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("html")) {
        let robots = collection.robots();
        let [robot] = robots.as_slice() else {
            let count = robots.len();
            return Err(usage(format!(
                "a page in one file shows one robot, but {count} were given; give one of them, or a folder to --export"
            )));
        };
        if !may_hold_page(folder) {
            return Err(usage(ExportError::InTheWay(vec![folder.to_owned()])));
        }
        let page = page_with(robot).map_err(usage)?;
        output::write_file(folder, &page).map_err(usage)?;
        return Ok(0);
    }
    let stay = export(collection, folder, &signals.cancellation(), &mut tell).map_err(usage)?;
    for file in stay {
        output::error(&escape::line(&format!(
            "{}: kept, since it was changed after the last export; the site does not need it any more",
            file.display()
        )));
    }
    let shown = folder.display();
    let told = format!(
        "{shown}: a site of {} robots. Browsers fetch nothing from file://: put it on a web server, or try\n  \
         python3 -m http.server --bind 127.0.0.1 --directory {shown}\n",
        collection.robots().len()
    );
    output::print(&escape::lines(&told)).map_err(usage)?;
    Ok(0)
}

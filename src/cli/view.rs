//! `urdd view`.

use std::collections::HashMap;
use std::io::{BufRead, Read, Write};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::Duration;

use clap::Args;

use super::arguments::{LoopsArguments, PackageArguments, RobotArguments, XacroArguments, split};
use super::configurations::Lines;
use super::generate_output::{FAILED, Printer, ResultFormat};
use super::inputs::advice;
use super::output::{self, Failure, one_line};
use super::watch::{LimitArguments, Watch, Work};
use urdd_directory::cancellation::Cancellation;
use urdd_directory::discover::DiscoverError;
use urdd_directory::file_type::FileType;
use urdd_directory::target_lock::Temporary;
use urdd_format::escape;
use urdd_format::readable::counted;
use urdd_robot::Robot;
use urdd_source::robots::{self, BatchError, Job};
use urdd_source::{RobotFile, Settings};
use urdd_view::{
    Collection, ExportError, Live, Server, Shown, Source, export, may_hold_page, page_with,
};

/// Pause before the rest of a robot is generated.
const FIRST_THE_PICTURE: Duration = Duration::from_secs(2);

/// Arguments of `urdd view`.
#[derive(Args)]
#[command(
    after_help = "The page is served only on 127.0.0.1, and opens only from the printed address. A URDF is shown at once, and again \
    whenever it, a file that its xacro includes, or a mesh changes; its URDD is generated in a temporary folder. Robots of \
    a folder of URDFs are generated when they are opened, and drawn on their cards before.\n\n\
    Exit status: 0 after Ctrl-C, or when the site is written; 1 a robot to export could not be generated: the site has the others; 2 usage error, \
    no robot was found, or the server could not start."
)]
pub struct ViewArguments {
    /// URDDs, folders of them, zip archives of them; URDFs or xacro files; folders of URDFs, such as a ROS package: its
    /// xacro files only with --xacro. `name:=value` is an argument for xacro.
    #[arg(required = true, value_name = "PATH")]
    paths: Vec<PathBuf>,

    /// The port; default: 8642, or any free port.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..))]
    port: Option<u16>,

    /// Does not open a browser.
    #[arg(long)]
    no_open: bool,

    /// Opens the second of two robots with the first beside it, before and after a change: links that differ are coloured.
    #[arg(long)]
    compare: bool,

    /// Reads configurations from standard input, and shows each as it arrives: lines of CSV or JSON, as those of
    /// `check-collisions`. For one robot.
    #[arg(long, conflicts_with = "compare")]
    follow: bool,

    /// Writes the page and the robots into a folder instead, as a site for any web server. A name that ends in `.html`
    /// writes the page with one robot into a single file that opens without a server.
    #[arg(long, value_name = "DIR|FILE.html", conflicts_with_all = ["port", "no_open", "follow"])]
    export: Option<PathBuf>,

    #[command(flatten)]
    packages: PackageArguments,

    #[command(flatten)]
    named_loops: LoopsArguments,

    #[command(flatten)]
    declared: RobotArguments,

    #[command(flatten)]
    xacro: XacroArguments,
}

/// Maximum length of a line of standard input, in bytes.
const MAX_LINE: u64 = 1 << 20;

/// Runs `urdd view`. All words of its errors may be of others.
pub fn run(
    arguments: &ViewArguments,
    watch: &Watch,
    limits: LimitArguments,
) -> Result<u8, Failure> {
    if arguments.export.is_none() {
        limits.refuse()?;
    }
    view(arguments, watch).map_err(|error| escape::line(&error.to_string()).into())
}

fn view(arguments: &ViewArguments, watch: &Watch) -> Result<u8, Failure> {
    let work = if arguments.export.is_some() { Work::Robots } else { Work::Requests };
    watch.begin(work, None)?;
    let (paths, xacro_arguments) = split(&arguments.paths);
    if arguments.compare && paths.len() != 2 {
        let count = counted(paths.len(), "path");
        Err(format!(
            "--compare takes two robots, before and after: `urdd view --compare BEFORE AFTER`; found {count}"
        ))?;
    }
    let settings = urdd_generate::Settings {
        source: Settings {
            xacro: arguments.xacro.settings(xacro_arguments),
            robots: arguments.declared.declared()?.into(),
            loops: arguments.named_loops.loops.clone(),
            cancellation: watch.cancellation(),
            ..arguments.packages.settings()?
        },
        ..urdd_generate::Settings::default()
    };
    // Generated URDDs exist as long as this value.
    let temporary = Temporary::begin(&std::env::temp_dir(), "shown")?;
    let drops = temporary.path().join("dropped");
    let collection = Collection::default()
        .with_drops(drops, arguments.xacro.xacro)
        .with_settings(settings.clone());
    let counts = add(&paths, &settings.source, &collection)?;
    let robots = collection.robots();
    let opens = arguments.compare.then(|| comparison(&paths, &counts, &robots)).transpose()?;
    let live = Live {
        folder: temporary.path(),
        settings: &settings,
        observer: &Printer::new(ResultFormat::Human, false),
        pause: FIRST_THE_PICTURE,
    };
    if let Some(folder) = &arguments.export {
        let mut unmade = Vec::new();
        for robot in &robots {
            let is_made = live.generate(robot);
            if let Some(status) = watch.status() {
                return Ok(status);
            }
            if !is_made {
                collection.remove(&robot.id);
                unmade.push(one_line(&robot.name));
            }
        }
        // A site shows the others; a comparison is of both.
        if unmade.len() == robots.len() || (opens.is_some() && !unmade.is_empty()) {
            output::error("there is nothing to show");
            return Ok(FAILED);
        }
        let written = write_site(&collection, folder, opens.as_deref(), &watch.cancellation());
        if let (Err(_), Some(status)) = (&written, watch.status()) {
            return Ok(status);
        }
        written?;
        if unmade.is_empty() {
            return Ok(0);
        }
        let count = counted(unmade.len(), "robot");
        output::error(&format!("without {count} that could not be made: {}", unmade.join(", ")));
        return Ok(FAILED);
    }
    // A robot by itself is opened at once, as are two that are compared; others when somebody chooses them.
    if opens.is_some() || robots.len() == 1 {
        robots.iter().for_each(|robot| robot.see());
    }
    let followed = match (arguments.follow, robots.as_slice()) {
        (false, _) => None,
        (true, [robot]) => Some(Arc::clone(robot)),
        (true, several) => {
            let count = several.len();
            Err(format!("--follow shows one robot, and there are {count}"))?
        }
    };
    let collection = Arc::new(collection);
    let server = Server::bind(Arc::clone(&collection), arguments.port)?;
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
        let begin = opens.map(|view| format!("&{view}")).unwrap_or_default();
        let address = format!("{}{begin}", server.address());
        let count = counted(robots.len(), "robot");
        let printed = output::print(&format!("{count}: {address}\nCtrl-C stops it.\n"));
        if printed.is_err() {
            watch.cancellation().cancel();
        }
        let _ = std::io::stdout().flush();
        if !arguments.no_open
            && let Err(error) = page_to(&temporary, &address).and_then(open::that_detached)
        {
            output::error(&format!(
                "no browser could be opened ({error}); open the address above yourself"
            ));
        }
        server.run(&watch.cancellation());
        printed?;
        Ok(0)
    })
}

/// The view that shows the second robot beside the first, as the page has it in its address.
fn comparison(
    paths: &[PathBuf],
    counts: &[usize],
    robots: &[Arc<Shown>],
) -> Result<String, String> {
    for (path, count) in paths.iter().zip(counts) {
        if *count != 1 {
            let path = path.display();
            return Err(format!(
                "{path}: found {count} robots; --compare takes one robot at each path: name one of them"
            ));
        }
    }
    let [before, after] = robots else {
        return Err(format!("--compare takes two robots; found {}", robots.len()));
    };
    Ok(format!("r={}&v={}", after.id, before.id))
}

/// Writes a page that only this user can read, and that leads to an address. A browser is given its path: everybody on the
/// machine can read the arguments of programs, and the address has a token.
fn page_to(temporary: &Temporary, address: &str) -> std::io::Result<PathBuf> {
    let text = format!(
        "<!doctype html>\n<meta charset=\"utf-8\">\n<title>urdd view</title>\n\
         <meta http-equiv=\"refresh\" content=\"0; url={address}\">\n<a href=\"{address}\">The robot</a>\n"
    );
    temporary.private("open.html", &text)
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

/// Writes the site. `opens` is the view that it shows first.
fn write_site(
    collection: &Collection,
    folder: &Path,
    opens: Option<&str>,
    cancellation: &Cancellation,
) -> Result<(), Failure> {
    let mut tell = |robot: &Shown| {
        let _ = writeln!(std::io::stderr().lock(), "{}", one_line(&robot.name));
    };
    if folder.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("html")) {
        if opens.is_some() {
            Err("a page in one file shows one robot; for a comparison, give --export a folder")?;
        }
        let robots = collection.robots();
        let [robot] = robots.as_slice() else {
            let count = robots.len();
            Err(format!(
                "a page in one file shows one robot, but {count} were given; give one of them, or a folder to --export"
            ))?
        };
        if !may_hold_page(folder) {
            Err(ExportError::InTheWay(vec![folder.to_owned()]))?;
        }
        return Ok(output::write_alone(folder, page_with(robot, None)?.as_bytes(), true)?);
    }
    for file in export(collection, folder, opens, cancellation, &mut tell)? {
        output::error(&escape::line(&format!(
            "{}: kept, since it was changed after the last export; the site does not need it any more",
            file.display()
        )));
    }
    let shown = folder.display();
    let told = format!(
        "{shown}: a site of {}. Browsers fetch nothing from file://: put it on a web server, or try\n  \
         python3 -m http.server --bind 127.0.0.1 --directory {shown}\n",
        counted(collection.robots().len(), "robot")
    );
    Ok(output::print(&escape::lines(&told))?)
}

/// Adds the robots at these paths. Returns how many there are at each.
fn add(
    paths: &[PathBuf],
    settings: &Settings,
    collection: &Collection,
) -> Result<Vec<usize>, String> {
    let named = named(paths, settings)?;
    let one = |path: &PathBuf| {
        let before = collection.robots().len();
        match named.get(path) {
            Some(jobs) => jobs.iter().for_each(|job| add_source(job.clone(), collection)),
            None => add_folder(path, settings, collection)?,
        }
        Ok(collection.robots().len() - before)
    };
    paths.iter().map(one).collect()
}

/// The robots of files, by path: URDFs, xacro files, and what is imported.
fn named(paths: &[PathBuf], settings: &Settings) -> Result<HashMap<PathBuf, Vec<Job>>, String> {
    let is_source = |path: &&PathBuf| match RobotFile::at(path) {
        Some(RobotFile::Srdf) | None => false,
        Some(_) => path.is_file(),
    };
    let files: Vec<PathBuf> = paths.iter().filter(is_source).cloned().collect();
    let jobs = robots::jobs(&files, settings).map_err(|error| error.to_string())?;
    let of = |file: PathBuf| {
        let place = file.canonicalize().ok();
        let its = jobs.iter().filter(|job| job.source.canonicalize().ok() == place);
        // Often the file is `robot.urdf`, and the folder has the robot's name.
        let parent = place.as_deref().and_then(Path::parent).and_then(Path::file_name);
        let named = |job: &Job| match parent {
            Some(parent) if job.name == "robot" => {
                Job { name: parent.to_string_lossy().into_owned(), ..job.clone() }
            }
            _ => job.clone(),
        };
        let its = its.map(named).collect();
        (file, its)
    };
    Ok(files.into_iter().map(of).collect())
}

/// Adds the URDDs at or below a folder, or else its URDFs.
fn add_folder(path: &Path, settings: &Settings, collection: &Collection) -> Result<(), String> {
    match collection.add(path) {
        Err(DiscoverError::NoUrdd { .. }) if path.is_dir() => {}
        other => return other.map_err(|error| advice(&error)),
    }
    let batch = robots::found(&[path.to_owned()], settings).map_err(|error| match error {
        BatchError::Empty { path } => {
            format!("{path}: there is no URDD, and no .urdf or .xacro file, at any depth")
        }
        error => error.to_string(),
    })?;
    batch.asides(0).iter().for_each(|aside| output::error(aside));
    let mut jobs = batch.jobs;
    let count = jobs.len();
    if !settings.xacro.expand_urdf {
        jobs.retain(|job| !FileType::Xacro.is_of(&job.source));
    }
    let left = count - jobs.len();
    if left > 0 {
        let files = counted(left, ".xacro file");
        let told = format!("{}: left out {files}; --xacro runs them", path.display());
        if jobs.is_empty() {
            return Err(told);
        }
        output::error(&escape::line(&told));
    }
    for job in jobs {
        add_source(job, collection);
    }
    Ok(())
}

fn add_source(Job { source, name, arguments, .. }: Job, collection: &Collection) {
    // The working directory may change later.
    let file = std::path::absolute(&source).unwrap_or(source);
    collection.add_source(name, Source { file, packages: Vec::new(), arguments });
}

//! `urdd view`.

use std::io::{IsTerminal, Write};
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::sync::Arc;
use std::time::{Duration, Instant};

use clap::Args;

use super::generate_output::{Format, Printer};
use super::output;
use super::packages::PackageArguments;
use super::signals::Signals;
use crate::view::{
    Collection, ExportError, Making, Server, Shown, Temporary, export, may_hold_page, page_with,
};
use urdd_directory::discover::DiscoverError;
use urdd_format::escape;
use urdd_format::registry::ModuleKind;
use urdd_generate::batch::{Job, Observer, caught};
use urdd_generate::{Progress, Settings};

/// Arguments of `urdd view`.
#[derive(Args)]
#[command(
    after_help = "The page is served only on 127.0.0.1, and opens only from the printed address. A folder without URDDs that \
    contains one URDF is shown too: a URDD is first generated in a temporary folder.\n\n\
    Exit status: 0 after Ctrl-C, or when the site is written; 1 no URDD could be generated; 2 usage error, no robot was \
    found, or the server could not start."
)]
pub struct ViewArguments {
    /// URDDs, folders of them, zip archives of them, or a URDF.
    #[arg(required = true, value_name = "PATH")]
    paths: Vec<PathBuf>,

    /// The port; default: 8642, or any free port.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..))]
    port: Option<u16>,

    /// Does not open a browser.
    #[arg(long)]
    no_open: bool,

    /// Writes the page and the robots into a folder instead, as a site for any web server. A name that ends in `.html`
    /// writes the page with one robot into a single file that opens without a server.
    #[arg(long, value_name = "DIR|FILE.html", conflicts_with_all = ["port", "no_open"])]
    export: Option<PathBuf>,

    #[command(flatten)]
    packages: PackageArguments,
}

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

/// Exit status: a robot could not be generated.
const FAILED: u8 = 1;

type Failure = (u8, String);

fn usage(message: impl ToString) -> Failure {
    (output::USAGE, message.to_string())
}

fn view(arguments: &ViewArguments) -> Result<u8, Failure> {
    let signals = Signals::listen().map_err(usage)?;
    // Generated URDDs exist as long as this value.
    let temporary = Temporary::begin(&std::env::temp_dir()).map_err(usage)?;
    let mut collection = Collection::default();
    let mut wanted = Vec::new();
    for path in &arguments.paths {
        match urdf_at(path)? {
            Some(urdf) => wanted.push(want(urdf, temporary.path(), &mut collection)),
            None => collection.add(path).map_err(usage)?,
        }
    }
    let settings = arguments.packages.settings(&signals).map_err(usage)?;
    if let Some(folder) = &arguments.export {
        for robot in &wanted {
            let is_made = make(robot, &settings);
            if let Some(status) = signals.status() {
                return Ok(status);
            }
            if !is_made {
                return Err((FAILED, "there is nothing to show".to_owned()));
            }
        }
        return written(&collection, folder, &signals);
    }
    let count = collection.robots().len();
    let server = Server::bind(collection, arguments.port).map_err(usage)?;
    let address = server.address();
    let robots = if count == 1 { "robot" } else { "robots" };
    let told = format!("{count} {robots}: {address}\nCtrl-C stops it.\n");
    output::print(&told).map_err(usage)?;
    let _ = std::io::stdout().flush();
    if !arguments.no_open
        && let Err(error) = open::that_detached(&address)
    {
        output::error(&format!(
            "no browser could be opened ({error}); open the address above yourself"
        ));
    }
    // The page shows the progress of the generation, and its result.
    let failed = std::thread::scope(|scope| {
        let making = scope.spawn(|| {
            let failed = wanted
                .iter()
                .filter(|robot| !make(robot, &settings))
                .count();
            if failed == count && !signals.cancellation().is_cancelled() {
                let begun = Instant::now();
                let is_told = || wanted.iter().all(|robot| robot.shown.is_failure_told());
                while !is_told() && begun.elapsed() < BROWSER_STARTS {
                    if signals.cancellation().is_cancelled() {
                        return failed;
                    }
                    std::thread::sleep(Duration::from_millis(20));
                }
                std::thread::sleep(LAST_WORD);
                signals.cancellation().cancel();
            }
            failed
        });
        server.run(&signals.cancellation());
        making.join().unwrap_or(0)
    });
    match failed == count {
        true => Err((FAILED, "there is nothing to show".to_owned())),
        false => Ok(0),
    }
}

/// How long to wait for the page to fetch the errors if there is no robot to show.
const BROWSER_STARTS: Duration = Duration::from_secs(30);
/// How long the page may send further requests after that.
const LAST_WORD: Duration = Duration::from_secs(1);

/// The URDF for a path: the file itself, or the only URDF in a folder without URDDs.
fn urdf_at(path: &Path) -> Result<Option<PathBuf>, Failure> {
    let ends_with = |path: &Path, ending: &str| {
        let extension = path.extension().unwrap_or_default();
        extension.eq_ignore_ascii_case(ending) && path.is_file()
    };
    if ends_with(path, "xacro") {
        return Err(usage(format!(
            "{}: `urdd view` does not expand xacro macros; `urdd generate` does",
            path.display()
        )));
    }
    if ends_with(path, "urdf") {
        return Ok(Some(path.to_owned()));
    }
    if !path.is_dir() {
        return Ok(None);
    }
    match urdd_directory::discover::discover(path) {
        Err(DiscoverError::NoUrdd { .. }) => {}
        _ => return Ok(None),
    }
    let entries = std::fs::read_dir(path).map_err(usage)?.flatten();
    let mut found: Vec<PathBuf> = entries
        .map(|entry| entry.path())
        .filter(|path| ends_with(path, "urdf"))
        .collect();
    found.sort();
    match found.as_slice() {
        [] => Ok(None),
        [one] => Ok(Some(one.clone())),
        several => {
            let names: Vec<String> = several
                .iter()
                .map(|path| path.display().to_string())
                .collect();
            Err(usage(format!(
                "{}: contains several URDFs; give one of them: {}",
                path.display(),
                names.join(", ")
            )))
        }
    }
}

/// A robot to generate from a URDF.
struct Wanted {
    job: Job,
    target: PathBuf,
    shown: Arc<Shown>,
}

/// Adds a robot to generate to the collection.
fn want(urdf: PathBuf, folder: &Path, collection: &mut Collection) -> Wanted {
    let stem = urdf.file_stem().unwrap_or_default();
    let mut name = stem.to_string_lossy().into_owned();
    if name == "robot"
        && let Some(parent) = urdf.canonicalize().ok().as_deref().and_then(Path::parent)
        && let Some(parent) = parent.file_name()
    {
        // Often the file is `robot.urdf`, and the folder has the robot's name.
        name = parent.to_string_lossy().into_owned();
    }
    let number = collection.robots().len();
    let target = folder.join(number.to_string()).join(&name);
    let shown = collection.add_making(name.clone(), target.clone());
    let source = urdf;
    Wanted {
        job: Job { source, name },
        target,
        shown,
    }
}

/// Reports a robot's progress to the terminal and the page.
struct Told<'a> {
    terminal: Box<dyn Progress>,
    page: &'a Shown,
}

impl Progress for Told<'_> {
    fn module(&self, kind: ModuleKind, done: usize, total: usize) {
        self.terminal.module(kind, done, total);
        self.page.set_making(Making::Running {
            what: kind.name().to_owned(),
            done,
            of: total,
        });
    }

    fn part(&self, kind: ModuleKind, done: usize, total: usize) {
        self.terminal.part(kind, done, total);
    }
}

/// Generates a URDD from a URDF in a temporary folder. Returns whether it succeeded.
fn make(wanted: &Wanted, settings: &Settings) -> bool {
    let Wanted { job, target, shown } = wanted;
    let is_terminal = std::io::stderr().is_terminal() && !output::is_dumb();
    let printer = Printer::new(Format::Human, false, is_terminal);
    let progress = Told {
        terminal: printer.begin_robot(job),
        page: shown,
    };
    // A panic is caught and reported; the default hook would print it as well.
    std::panic::set_hook(Box::new(|_| {}));
    let outcome = caught(&job.source, || {
        urdd_generate::generate(&job.source, target, settings, &progress)
    });
    let _ = std::panic::take_hook();
    drop(progress);
    printer.done(job, &outcome);
    match &outcome {
        Ok(generated) => shown.made(generated.notes.iter().map(ToString::to_string).collect()),
        Err(error) => shown.set_making(Making::Failed(error.to_string())),
    }
    outcome.is_ok()
}

/// Writes the site.
fn written(collection: &Collection, folder: &Path, signals: &Signals) -> Result<u8, Failure> {
    let mut tell = |robot: &crate::view::Shown| {
        let name = escape::line(&robot.name).into_owned();
        let _ = writeln!(std::io::stderr().lock(), "{name}");
    };
    if folder
        .extension()
        .is_some_and(|ending| ending.eq_ignore_ascii_case("html"))
    {
        let [robot] = collection.robots() else {
            let count = collection.robots().len();
            return Err(usage(format!(
                "a page in one file shows one robot, but {count} were given; give one of them, or a folder to --export"
            )));
        };
        if !may_hold_page(folder) {
            let files = vec![folder.to_owned()];
            return Err(usage(ExportError::InTheWay { files }));
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

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
use super::robots::RobotArguments;
use super::signals::Signals;
use super::viewed;
use super::xacro::{self, XacroArguments};
use urdd_directory::temporary::Temporary;
use urdd_format::escape;
use urdd_generate::Settings;
use urdd_robot::Robot;
use urdd_source::process;
use urdd_view::{Collection, ExportError, Live, Server, Shown, export, may_hold_page, page_with};

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
    declared: RobotArguments,

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
    if arguments.compare && paths.len() != 2 {
        let count = output::counted(paths.len(), "path");
        return Err(usage(format!(
            "--compare takes two robots, before and after: `urdd view --compare BEFORE AFTER`; found {count}"
        )));
    }
    let settings = Settings {
        source: urdd_source::Settings {
            xacro: arguments.xacro.settings(xacro_arguments),
            robots: arguments.declared.declared().map_err(usage)?.into(),
            ..arguments.packages.settings().map_err(usage)?
        },
        cancellation: signals.cancellation(),
        ..Settings::default()
    };
    // Generated URDDs exist as long as this value.
    let temporary = Temporary::begin(&std::env::temp_dir(), "shown").map_err(usage)?;
    let drops = temporary.path().join("dropped");
    let collection = Collection::default()
        .with_drops(drops, arguments.xacro.xacro)
        .with_settings(settings.clone());
    let counts = viewed::add(&paths, &settings.source, &collection).map_err(usage)?;
    let robots = collection.robots();
    let opens = match arguments.compare {
        true => Some(comparison(&paths, &counts, &robots)?),
        false => None,
    };
    let live = Live {
        folder: temporary.path(),
        settings: &settings,
        observer: &Printer::new(Format::Human, false),
        pause: FIRST_THE_PICTURE,
    };
    if let Some(folder) = &arguments.export {
        let mut unmade = Vec::new();
        for robot in &robots {
            let is_made = live.generate(robot);
            if let Some(status) = signals.status() {
                return Ok(status);
            }
            if !is_made {
                collection.remove(&robot.id);
                unmade.push(one_line(&robot.name));
            }
        }
        // A site shows the others; a comparison is of both.
        if unmade.len() == robots.len() || (opens.is_some() && !unmade.is_empty()) {
            return Err((FAILED, "there is nothing to show".to_owned()));
        }
        if !unmade.is_empty() {
            let status = written(&collection, folder, None, &signals)?;
            let count = output::counted(unmade.len(), "robot");
            output::error(&format!(
                "without {count} that could not be made: {}",
                unmade.join(", ")
            ));
            return Ok(status.max(FAILED));
        }
        return written(&collection, folder, opens.as_deref(), &signals);
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
        let begin = opens.map(|view| format!("&{view}")).unwrap_or_default();
        let address = format!("{}{begin}", server.address());
        let count = output::counted(robots.len(), "robot");
        let printed = output::print(&format!("{count}: {address}\nCtrl-C stops it.\n"));
        let printed = printed.map_err(usage);
        if printed.is_err() {
            signals.cancellation().cancel();
        }
        let _ = std::io::stdout().flush();
        if !arguments.no_open
            && let Err(error) = page_to(&temporary, &address).and_then(open::that_detached)
        {
            output::error(&format!(
                "no browser could be opened ({error}); open the address above yourself"
            ));
        }
        server.run(&signals.cancellation());
        printed.map(|()| 0)
    })
}

/// The view that shows the second robot beside the first, as the page has it in its address.
fn comparison(paths: &[PathBuf], counts: &[usize], robots: &[Arc<Shown>]) -> Result<String, Stop> {
    for (path, count) in paths.iter().zip(counts) {
        if *count != 1 {
            let path = path.display();
            return Err(usage(format!(
                "{path}: found {count} robots; --compare takes one robot at each path: name one of them"
            )));
        }
    }
    let [before, after] = robots else {
        return Err(usage(format!("--compare takes two robots; found {}", robots.len())));
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
fn written(
    collection: &Collection,
    folder: &Path,
    opens: Option<&str>,
    signals: &Signals,
) -> Result<u8, Stop> {
    let mut tell = |robot: &Shown| {
        let _ = writeln!(std::io::stderr().lock(), "{}", one_line(&robot.name));
    };
    if folder.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("html")) {
        if opens.is_some() {
            return Err(usage(
                "a page in one file shows one robot; for a comparison, give --export a folder",
            ));
        }
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
        output::write_alone(folder, &page, true).map_err(usage)?;
        return Ok(0);
    }
    let stay =
        export(collection, folder, opens, &signals.cancellation(), &mut tell).map_err(usage)?;
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

//! Cancelled validation returns a cancellation error, and no report.

use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Arc, OnceLock};

use testkit::robots::{made, our_robots};
use urdd_directory::cancellation::{Cancellation, Limit};
use urdd_directory::listing::ReadError;
use urdd_directory::source::{Disk, OpenFile, Source};
use urdd_directory::take::take;
use urdd_findings::code::Code;
use urdd_findings::description::{Consequence, Description, Phase};
use urdd_format::report::{Severity, Verdict};
use urdd_validate::rule::{CheckOf, Rule};
use urdd_validate::rules;
use urdd_validate::settings::Settings;
use urdd_validate::{ValidateError, validate, validate_source, validate_with};

/// A folder that cancels when a file is opened for the n-th time.
#[derive(Debug)]
struct StopsWhenRead {
    disk: Disk,
    left: AtomicUsize,
    cancellation: Cancellation,
}

impl Source for StopsWhenRead {
    fn folder_name(&self) -> String {
        self.disk.folder_name()
    }

    fn list(&self) -> Result<urdd_directory::listing::Listing, ReadError> {
        self.disk.list()
    }

    fn open(&self, path: &str) -> Result<(OpenFile, u64), ReadError> {
        if self.left.fetch_sub(1, Ordering::Relaxed) == 1 {
            self.cancellation.cancel();
        }
        self.disk.open(path)
    }
}

#[test]
fn validate_says_nothing_of_what_it_did_not_finish() {
    let (_folder, path) = made(&our_robots()[8].1);
    let ask = |reads: usize| {
        let cancellation = Cancellation::default();
        let settings = Settings { cancellation: cancellation.clone(), ..Settings::default() };
        let source = StopsWhenRead {
            disk: Disk::open(&path).unwrap(),
            left: AtomicUsize::new(reads),
            cancellation,
        };
        validate_source(source, "robot", &settings)
    };
    // While modules are loaded, and while rules read meshes.
    for reads in [1, 2, 20, 40] {
        let stopped = ask(reads).err().expect("it stopped");
        assert!(matches!(stopped, ValidateError::Cancelled(_)), "{reads}: {stopped}");
    }
    assert!(ask(usize::MAX).is_ok());
    let cancellation = Cancellation::default();
    cancellation.cancel();
    let settings = Settings { cancellation, ..Settings::default() };
    let stopped = validate(&[&path], &settings).err().expect("it stopped");
    assert!(matches!(stopped, ValidateError::Cancelled(_)), "{stopped}");
    assert_eq!(stopped.to_string(), "stopped before it was finished");
}

/// What is watched. The rule below is its watch.
static RUN: OnceLock<Cancellation> = OnceLock::new();

/// Finds that one robot takes more than it may, while it is examined.
static WATCHING: Rule = Rule {
    description: Description {
        code: Code::TST001,
        name: "watches",
        severity: Severity::Error,
        clause: None,
        since: "0.1.0",
        consequence: Consequence::Format,
        phase: Phase::Files,
        doc: &[],
    },
    needs: &[],
    check: CheckOf::Urdd(|_, _| {
        let robots = RUN.get()?.in_work();
        // Two at once: nobody knows which of them takes it.
        assert_eq!(robots.len(), 1);
        for robot in robots.iter().filter(|robot| robot.name == "b_slow") {
            robot.cancellation.exceed(Limit::Memory(7));
        }
        Some(())
    }),
};

#[test]
fn a_robot_beyond_its_limits_is_not_examined_and_the_others_are() {
    let (folder, path) = made(&our_robots()[5].1);
    let paths = ["a_good", "b_slow", "c_good"].map(|name| folder.path().join(name));
    paths.iter().for_each(|to| take(&path, to).unwrap());
    let cancellation = RUN.get_or_init(|| Cancellation::watched(Arc::default()));
    let settings = Settings { cancellation: cancellation.clone(), ..Settings::default() };
    let rules = [vec![&WATCHING], rules::all()].concat();
    let run = validate_with(&paths, &settings, &rules).unwrap();
    assert!(cancellation.in_work().is_empty() && !cancellation.is_cancelled());
    let [good, slow, last] = run.report.urdds.as_slice() else { panic!("three") };
    for good in [good, last] {
        assert_eq!((good.verdict, good.reason.as_deref()), (Verdict::Pass, None));
    }
    assert_eq!((slow.verdict, slow.checks.len()), (Verdict::Unreadable, 0));
    let reason =
        "more than 7 MB of memory, the limit of --max-memory; raise it for a robot that you trust";
    assert_eq!(slow.reason.as_deref(), Some(reason));
}

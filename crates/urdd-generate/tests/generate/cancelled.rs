//! Cancelled generation returns a cancellation error, and leaves nothing behind.

use std::collections::BTreeMap;

use testkit::files::below;
use testkit::repository;
use testkit::robots::{made, our_robots};
use urdd_directory::cancellation::Cancellation;
use urdd_format::registry::ModuleKind;
use urdd_generate::{GenerateError, Progress, Settings, generate};

/// Cancels when the module with this number begins.
struct StopsAt(usize, Cancellation);

impl Progress for StopsAt {
    fn module(&self, _: ModuleKind, done: usize, _: usize) {
        if done == self.0 {
            self.1.cancel();
        }
    }
}

fn settings(cancellation: &Cancellation) -> Settings {
    let mut settings = Settings { num_samples: 10, ..Settings::default() };
    settings.source.cancellation = cancellation.clone();
    settings
}

#[test]
fn generate_leaves_what_was_there() {
    let (_, urdf) = our_robots().swap_remove(8);
    let modules = 15;
    for stop in [0, 1, 7, 8, 9, 10, 12, modules - 1] {
        let folder = testkit::temporary::folder();
        let target = folder.path().join("robot");
        let cancellation = Cancellation::default();
        let settings = settings(&cancellation);
        let progress = StopsAt(stop, cancellation);
        let stopped = generate(&urdf, &target, &settings, &progress).unwrap_err();
        assert!(matches!(stopped, GenerateError::Cancelled), "{stop}: {stopped}");
        assert_eq!(stopped.code(), "cancelled");
        assert_eq!(below(folder.path()), BTreeMap::new(), "{stop}");
    }
    // Over an existing URDD.
    let (folder, target) = made(&urdf);
    let before = below(folder.path());
    let cancellation = Cancellation::default();
    let settings = settings(&cancellation);
    let progress = StopsAt(12, cancellation);
    let stopped = generate(&urdf, &target, &settings, &progress).unwrap_err();
    assert!(matches!(stopped, GenerateError::Cancelled), "{stopped}");
    assert_eq!(below(folder.path()), before);
}

/// Before any module begins: URDFs, and what is imported.
#[test]
fn generate_stops_while_it_reads() {
    let arm = our_robots().swap_remove(8).1;
    let models = ["mjcf/arm.xml", "sdf/model.sdf", "usd/scara.usda"];
    let models = models.map(|model| repository().join("examples").join(model));
    for source in models.into_iter().chain([arm]) {
        let folder = testkit::temporary::folder();
        let cancellation = Cancellation::default();
        cancellation.cancel();
        let begun = StopsAt(0, Cancellation::default());
        let settings = settings(&cancellation);
        let stopped = generate(&source, &folder.path().join("robot"), &settings, &begun);
        let stopped = stopped.expect_err("cancelled");
        assert_eq!(stopped.code(), "cancelled", "{}: {stopped}", source.display());
        assert!(begun.1.check().is_ok(), "{}: a module began", source.display());
        assert_eq!(below(folder.path()), BTreeMap::new(), "{}", source.display());
    }
}

//! Published URDDs that were put together, read into recipes. They are not in this repository: `URDD_CORPUS` names their
//! folder.

use std::collections::BTreeSet;
use std::path::PathBuf;

use urdd::combine::{CombineError, PartFault, Recipe, combine};
use urdd::generate::Settings;

use crate::support::findings;

#[test]
#[ignore = "needs ../shared/corpus, or what URDD_CORPUS names"]
fn a_published_composition_becomes_a_urdd_that_passes() {
    let corpus = std::env::var_os("URDD_CORPUS").map(PathBuf::from);
    let corpus = corpus.unwrap_or_else(|| PathBuf::from("../shared/corpus"));
    let folder = tempfile::tempdir().expect("a folder");
    let target = folder.path().join("robot");
    let legacy = corpus.join("z1_robotiq_140");
    let (recipe, notes) = Recipe::of_legacy(&legacy).expect("a recipe");
    assert_eq!(notes, []);
    let settings = Settings {
        num_samples: 50,
        ..Settings::default()
    };
    combine(&recipe, &target, &settings, &BTreeSet::new(), &()).expect("a URDD");
    assert_eq!(findings(&target), [] as [String; 0]);
    // The names are those that the published robot has.
    let names = |file: PathBuf, key: &str| {
        let text = std::fs::read_to_string(file).expect("a module");
        let module: serde_json::Value = serde_json::from_str(&text).expect("JSON");
        let list = module[key].as_array().expect("a list").clone();
        let names = list.into_iter().map(|of| of["name"].to_string());
        names.collect::<BTreeSet<String>>()
    };
    for key in ["links", "joints"] {
        let module = "urdf_module/module.json";
        assert_eq!(
            names(target.join(module), key),
            names(legacy.join(module), key)
        );
    }
    // What was not put together is none.
    let error = Recipe::of_legacy(&corpus.join("ur5")).expect_err("no recipe");
    assert!(matches!(
        error,
        CombineError::Part {
            fault: PartFault::NotComposed,
            ..
        }
    ));
}

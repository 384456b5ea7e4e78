//! `--pieces` and `--piece-tolerance`.

use std::path::Path;

use crate::generate::{findings_of, read_json, urdd};

fn run(target: &Path, more: &[&str]) -> std::process::Output {
    let robot = Path::new(env!("CARGO_MANIFEST_DIR")).join("conformance/robots/hand.urdf");
    let robot = robot.to_str().unwrap();
    let mut arguments = vec!["generate", robot, "-o", target.to_str().unwrap()];
    arguments.extend(["--samples", "10", "--modules", "geometry"]);
    arguments.extend(more);
    urdd(&arguments).output().unwrap()
}

/// The number of pieces of each link.
fn counts(target: &Path, more: &[&str]) -> Vec<usize> {
    let output = run(target, more);
    let errors = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{errors}");
    assert_eq!(findings_of(target), []);
    let path = "mesh_modules/convex_decomposition_meshes_module/module.json";
    let module = read_json(&target.join(path));
    let links = module["link_pieces"].as_array().unwrap().iter();
    links.map(|link| link.as_array().unwrap().len()).collect()
}

#[test]
fn a_urdd_is_made_again_with_as_many_pieces_as_asked_for() {
    let folder = testkit::temporary::folder();
    let target = folder.path().join("hand");
    let usual = counts(&target, &[]);
    let most = *usual.iter().max().unwrap();
    assert!(2 < most && most <= 7, "{usual:?}");

    // Replaced: the stage's key contains the requested settings.
    let at_most = |n: usize| usual.iter().map(move |&count| count.min(n)).collect::<Vec<_>>();
    assert_eq!(counts(&target, &["--pieces", "1"]), at_most(1));
    assert!(counts(&target, &["--pieces", "2"]).iter().all(|&n| n <= 2));
    // 10 m is not a plausible tolerance for a hand.
    assert_eq!(counts(&target, &["--piece-tolerance", "10"]), at_most(1));
    assert_eq!(counts(&target, &["--pieces", "7"]), usual);
}

#[test]
fn numbers_that_make_no_sense_are_wrong_usage() {
    let folder = testkit::temporary::folder();
    for (option, word) in [
        ("--pieces", "0"),
        ("--pieces", "65"),
        ("--piece-tolerance", "0"),
        ("--piece-tolerance", "nan"),
        ("--piece-tolerance", "inf"),
        ("--piece-tolerance", "5mm"),
    ] {
        let output = run(&folder.path().join("hand"), &[option, word]);
        let errors = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{option} {word}: {errors}");
        assert!(errors.contains(option), "{errors}");
    }
}

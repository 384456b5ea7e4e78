//! Recipes and legacy URDDs from untrusted sources: what they may open, run and consume.

use std::fs;
use std::path::Path;
use std::time::{Duration, Instant};

use serde_json::json;
use urdd_format::escape;
use urdd_generate::combine::{CombineError, PartFault, Recipe, check_parts};

use crate::combine::support::{core, findings, ours, put_together};
use crate::export::texts::texts;
use crate::program::urdd;
use testkit::xml::parsed;

const CORE: [&str; 2] = ["--modules", "core"];

const LINK: &str = "<robot name=\"r\"><link name=\"a\"/></robot>";

/// A robot with two links.
const TWO: &str = "<robot name=\"two\"><link name=\"base\"/><link name=\"tip\"/><joint name=\"j\" type=\"fixed\"><parent link=\"base\"/><child link=\"tip\"/></joint></robot>";

/// A recipe of one part.
fn one(source: &str) -> String {
    format!("name = \"cell\"\n[[part]]\nid = \"p\"\nsource = \"{source}\"\n")
}

/// Recipes in the folder `repository` take no part from outside it, by any name.
#[test]
#[cfg(unix)]
fn a_recipe_takes_parts_from_its_own_folder() {
    use std::os::unix::fs::symlink;
    let folder = testkit::temporary::folder();
    let folder = folder.path().canonicalize().expect("a folder");
    let (repository, outside) = (folder.join("repository"), folder.join("outside"));
    fs::create_dir_all(repository.join("sub")).expect("a folder");
    fs::create_dir(&outside).expect("a folder");
    fs::write(outside.join("robot.urdf"), LINK).expect("a file");
    fs::write(repository.join("robot.urdf"), LINK).expect("a file");
    symlink(outside.join("robot.urdf"), repository.join("linked.urdf")).expect("a link");
    symlink(&outside, repository.join("linked")).expect("a link");
    let absolute = outside.join("robot.urdf").display().to_string();
    for source in [
        "../outside/robot.urdf",
        "sub/../../outside/robot.urdf",
        "linked.urdf",
        "linked/robot.urdf",
        &absolute,
    ] {
        let made = put_together(&one(source), &repository, &core());
        let error = made.expect_err("a part from outside");
        let allow = escape::shell(outside.to_str().expect("a path"));
        let words = error.to_string();
        assert!(words.contains("the folder of the recipe"), "{source}: {words}");
        assert!(words.ends_with(&format!("add --allow-folder {allow}")), "{source}: {words}");
        // Nothing in it is read either.
        let recipe = Recipe::from_toml(&one(source), "cell.toml", &repository).expect("a recipe");
        let look = |path: &Path| -> Result<Vec<String>, _> { panic!("{} is read", path.display()) };
        assert!(check_parts(&recipe, &core(), look).is_err());
        let mut settings = core();
        settings.source.allowed_folders.push(outside.clone());
        put_together(&one(source), &repository, &settings).expect("it is allowed");
        fs::remove_dir_all(repository.join("cell")).expect("a folder");
    }
    for source in ["robot.urdf", "sub/../robot.urdf", "../repository/robot.urdf"] {
        put_together(&one(source), &repository, &core()).expect("it is inside");
        fs::remove_dir_all(repository.join("cell")).expect("a folder");
    }
}

/// A program that leaves a trace when it runs.
#[cfg(unix)]
fn with_xacro(folder: &Path, arguments: &[&str]) -> (i32, String, bool) {
    use std::os::unix::fs::PermissionsExt;
    let programs = folder.join("bin");
    fs::create_dir_all(&programs).expect("a folder");
    let (xacro, ran) = (programs.join("xacro"), folder.join("ran"));
    let script = format!("#!/bin/sh\necho > {}\necho '{LINK}'\n", ran.display());
    fs::write(&xacro, script).expect("a file");
    fs::set_permissions(&xacro, fs::Permissions::from_mode(0o755)).expect("a mode");
    let output = std::process::Command::new(env!("CARGO_BIN_EXE_urdd"))
        .args(arguments)
        .args(CORE)
        .current_dir(folder)
        .env("PATH", programs)
        .output()
        .expect("the program");
    let said = String::from_utf8(output.stderr).expect("UTF-8");
    let has_run = fs::remove_file(ran).is_ok();
    (output.status.code().expect("a status"), said, has_run)
}

#[test]
#[cfg(unix)]
fn xacro_runs_for_no_file_that_only_a_recipe_names() {
    let folder = testkit::temporary::folder();
    let folder = folder.path();
    for file in ["evil.xacro", "tool.urdf"] {
        fs::write(folder.join(file), LINK).expect("a file");
    }
    std::os::unix::fs::symlink("evil.xacro", folder.join("arm.urdf")).expect("a link");
    // A recipe, directly and through a harmless-looking link.
    for source in ["evil.xacro", "arm.urdf"] {
        fs::write(folder.join("cell.toml"), one(source)).expect("a file");
        let (status, said, ran) = with_xacro(folder, &["combine", "cell.toml", "-o", "out"]);
        assert_eq!((status, ran), (1, false), "{said}");
        assert!(said.contains("allow it with --xacro"), "{said}");
        let (status, said, ran) =
            with_xacro(folder, &["combine", "cell.toml", "-o", "out", "--xacro"]);
        assert_eq!((status, ran), (0, true), "{said}");
        fs::remove_dir_all(folder.join("out")).expect("a folder");
    }
    // A legacy URDD.
    let module = folder.join("legacy/adjusted_robot_module");
    fs::create_dir_all(&module).expect("a folder");
    for name in ["evil.xacro", "legacy/../evil.xacro", "../evil.xacro", "/etc", ".."] {
        let document = json!({
            "name": "short", "base_robot_name": name, "dead_end_link_names": [],
            "fixed_base_joints": [], "deleted_base_links": [], "deleted_base_joints": [],
            "adjusted_link_idx_to_base_link_idx_mapping": [],
            "base_link_idx_to_adjusted_link_idx_mapping": [],
            "adjusted_joint_idx_to_base_joint_idx_mapping": [],
            "base_joint_idx_to_adjusted_joint_idx_mapping": [],
        });
        fs::write(module.join("module.json"), document.to_string()).expect("a file");
        for more in [&[][..], &["--xacro"]] {
            let from = ["combine", "--from", "legacy", "-o", "out"];
            let (status, said, ran) = with_xacro(folder, &[&from[..], more].concat());
            assert_eq!((status, ran), (1, false), "{name}: {said}");
            assert!(said.contains("not the name of a folder"), "{said}");
        }
        let error = Recipe::of_legacy(&folder.join("legacy")).expect_err("not beside it");
        assert!(error.to_string().contains("not the name of a folder"), "{error}");
    }
    // The user names it.
    let two = ["combine", "evil.xacro", "tool.urdf", "--at", "a", "-o", "out"];
    let (status, said, ran) = with_xacro(folder, &two);
    assert_eq!((status, ran), (0, true), "{said}");
}

/// The URDF of a legacy URDD may be a link, or no file at all.
#[test]
#[cfg(unix)]
fn the_urdf_of_a_legacy_part_is_inside_of_it() {
    let folder = testkit::temporary::folder();
    let folder = folder.path();
    fs::write(folder.join("secret.urdf"), LINK).expect("a file");
    let part = folder.join("part");
    fs::create_dir_all(part.join("urdf_module")).expect("a folder");
    fs::write(part.join("urdf_module/module.json"), "{}").expect("a file");
    let urdf = part.join("robot.urdf");
    for target in ["../secret.urdf", "/dev/zero"] {
        std::os::unix::fs::symlink(target, &urdf).expect("a link");
        let error = put_together(&one("part"), folder, &core()).expect_err("not a file of it");
        let CombineError::Part { fault: PartFault::Unusable(why), .. } = &error else {
            panic!("{error:?}");
        };
        assert!(why.starts_with("robot.urdf: "), "{why}");
        fs::remove_file(&urdf).expect("a link");
    }
    let made = std::process::Command::new("mkfifo").arg(&urdf).status();
    assert!(made.expect("mkfifo").success());
    assert!(put_together(&one("part"), folder, &core()).is_err());
}

/// Whatever the case of its ending.
#[test]
fn the_urdf_of_a_legacy_part_is_found_by_any_case() {
    let folder = testkit::temporary::folder();
    let folder = folder.path();
    let part = folder.join("part");
    fs::create_dir_all(part.join("urdf_module")).expect("a folder");
    fs::write(part.join("urdf_module/module.json"), "{}").expect("a file");
    fs::write(part.join("ARM.URDF"), LINK).expect("a file");
    let made = put_together(&one("part"), folder, &core());
    assert!(made.is_ok(), "{:?}", made.err());
}

/// Parts in a line, each attached to the one before.
fn chain(parts: usize) -> String {
    let part = |idx: usize| {
        let attach = match idx {
            0 => String::new(),
            _ => format!("attach = {{ to = \"p{}/tip\" }}\n", idx - 1),
        };
        format!("[[part]]\nid = \"p{idx}\"\nsource = \"two.urdf\"\n{attach}")
    };
    // The last first: nothing can be decided on the way.
    (0..parts).rev().map(part).collect()
}

#[test]
fn very_many_parts_are_refused_before_they_are_read() {
    let folder = testkit::temporary::folder();
    let folder = folder.path();
    let start = Instant::now();
    let error = Recipe::from_toml(&chain(10_000), "cell.toml", folder).expect_err("too many");
    let CombineError::Recipe { fault, .. } = error else {
        panic!("{error}");
    };
    assert!(
        fault.starts_with("a robot has at most 2000 links, and the parts have 10000"),
        "{fault}"
    );
    // Few parts with too many links: none is read after the one that exceeds the limit.
    fs::write(folder.join("two.urdf"), TWO).expect("a file");
    let error = put_together(&chain(1_001), folder, &core()).expect_err("too many");
    let CombineError::Recipe { fault, .. } = error else {
        panic!("{error}");
    };
    assert!(
        fault.starts_with("a robot has at most 2000 links, and the parts have 2002"),
        "{fault}"
    );
    // This once took minutes: the checks took time cubic in the number of parts.
    assert!(start.elapsed() < Duration::from_secs(20), "{:?}", start.elapsed());
}

/// Whether a recipe is refused for a word that a URDF cannot hold.
fn is_of_word(fault: &str) -> bool {
    let kinds = ["the name `", "the prefix `", "the link `", "the joint `"];
    let reasons =
        ["only white space; write a name", "cannot contain; remove it", "; write at most"];
    kinds.iter().any(|kind| fault.starts_with(kind))
        && reasons.iter().any(|why| fault.contains(why))
}

#[test]
fn words_that_no_urdf_can_hold_are_refused_with_their_place() {
    let folder = testkit::temporary::folder();
    fs::copy(ours("gripper"), folder.path().join("g.urdf")).expect("a file");
    let long = "n".repeat(300);
    for (recipe, line, column) in [
        ("prefix = \"a\\u0000\"".to_owned(), 5, 10),
        ("prefix = \"a\\nb\"".to_owned(), 5, 10),
        ("prefix = \"\\uFFFE\"".to_owned(), 5, 10),
        (format!("prefix = \"{long}\""), 5, 10),
        ("[base]\nname = \"\\u0001\"".to_owned(), 6, 8),
        ("[base]\nlink = \" \"".to_owned(), 6, 8),
    ] {
        let text = one("g.urdf") + &recipe;
        let error = put_together(&text, folder.path(), &core()).expect_err("no name");
        let CombineError::Recipe { fault, at, .. } = error else {
            panic!("{recipe:?}: {error}");
        };
        assert!(is_of_word(&fault), "{fault}");
        let at = at.expect("a place");
        assert_eq!((at.line, at.column), (line, column), "{recipe:?}");
    }
    for name in ["", "a\\u0000", &long] {
        let text = format!("name = \"{name}\"\n[[part]]\nid = \"g\"\nsource = \"g.urdf\"\n");
        let error = Recipe::from_toml(&text, "cell.toml", folder.path()).expect_err("no name");
        let CombineError::Recipe { fault, .. } = error else {
            panic!("{error}");
        };
        assert!(is_of_word(&fault) && fault.starts_with("the name `"), "{fault}");
    }
}

/// A signal ends the run, at any moment.
#[test]
#[cfg(unix)]
fn a_signal_ends_combining_at_any_moment() {
    let folder = testkit::temporary::folder();
    let folder = folder.path();
    // Different files, so that each is read separately.
    fs::write(folder.join("two.urdf"), TWO).expect("a file");
    let mut recipe = chain(900);
    for idx in 0..900 {
        let file = format!("{idx}.urdf");
        fs::write(folder.join(&file), TWO).expect("a file");
        recipe = recipe.replacen("two.urdf", &file, 1);
    }
    fs::write(folder.join("cell.toml"), recipe).expect("a file");
    for wait in [50, 300, 1000] {
        let mut child = std::process::Command::new(env!("CARGO_BIN_EXE_urdd"))
            .args(["combine", "cell.toml", "-o", "out"])
            .current_dir(folder)
            .stderr(std::process::Stdio::null())
            .spawn()
            .expect("the program");
        std::thread::sleep(Duration::from_millis(wait));
        let pid = child.id().to_string();
        let kill = std::process::Command::new("kill").args(["-TERM", &pid]).status();
        assert!(kill.expect("kill").success());
        let status = child.wait().expect("a status");
        assert_eq!(status.code(), Some(143), "after {wait} ms");
        assert!(!folder.join("out").exists());
    }
}

/// A word of a megabyte gets no suggestion: comparing it with each link took gigabytes.
#[test]
fn very_long_names_are_not_compared() {
    let folder = testkit::temporary::folder();
    fs::copy(ours("gripper"), folder.path().join("g.urdf")).expect("a file");
    let long = "n".repeat(900_000);
    let name = "m".repeat(900_000);
    let urdf = format!("<robot name=\"r\"><link name=\"{name}\"/></robot>");
    fs::write(folder.path().join("long.urdf"), urdf).expect("a file");
    let text = one("long.urdf") + &format!("drop = [\"{long}\"]\n");
    let error = put_together(&text, folder.path(), &core()).expect_err("no such link");
    let CombineError::Recipe { fault, .. } = error else {
        panic!("{error}");
    };
    assert!(fault.starts_with("part `p` has no link `nnn") && !fault.contains("mean"), "{fault}");
}

#[test]
fn a_recipe_is_a_regular_file_up_to_a_limit() {
    let folder = testkit::temporary::folder();
    let folder = folder.path();
    fs::write(folder.join("long.toml"), vec![b'#'; (1 << 20) + 1]).expect("a file");
    let (status, _, said) = urdd(&["combine", "long.toml", "-o", "out"], folder);
    assert_eq!(status, 1);
    assert!(said.contains("cannot be read"), "{said}");
    #[cfg(unix)]
    {
        let made = std::process::Command::new("mkfifo").arg(folder.join("pipe.toml")).status();
        assert!(made.expect("mkfifo").success());
        assert_eq!(urdd(&["combine", "pipe.toml", "-o", "out"], folder).0, 1);
    }
}

/// A recipe with a text in each place for names; `{0}` to `{4}`.
const NAMED: &str = r#"name = "{0}"
base = { link = "{1}", name = "{2}" }
[[part]]
id = "first"
source = "two.urdf"
prefix = "{3}"
[[part]]
id = "second"
source = "two.urdf"
attach = { to = "first/tip", name = "{4}" }
"#;

/// Text of a recipe is a name, or refused; it is no markup and no path.
#[test]
fn every_text_in_a_recipe_stays_a_text() {
    let folder = testkit::temporary::folder();
    let folder = folder.path();
    fs::write(folder.join("two.urdf"), TWO).expect("a file");
    let cases = (0..5).flat_map(|place| texts().into_iter().map(move |text| (place, text)));
    let mut held = 0;
    for (place, text) in testkit::trials::sample(cases, 17) {
        let mut recipe = NAMED.to_owned();
        for at in 0..5 {
            let escaped = text.chars().map(|c| format!("\\U{:08X}", u32::from(c)));
            let name = if at == place { escaped.collect() } else { format!("n{at}") };
            recipe = recipe.replace(&format!("{{{at}}}"), &name);
        }
        match put_together(&recipe, folder, &core()) {
            Ok((_, made)) => {
                assert_eq!(findings(&made), Vec::<String>::new(), "{text:?}");
                let files = testkit::files::below(&made);
                let (file, urdf) =
                    files.iter().find(|(file, _)| file.ends_with(".urdf")).expect("it");
                assert!(!file.starts_with(['.', '-']) && !file.contains(['/', '\\']), "{file:?}");
                let urdf = String::from_utf8_lossy(urdf).into_owned();
                let document = parsed(&urdf);
                let elements = document.descendants().filter(|node| node.is_element());
                let names: Vec<&str> = elements.filter_map(|node| node.attribute("name")).collect();
                assert!(names.iter().any(|name| name.contains(&text)), "{text:?}: {urdf}");
                // The robot, the base, two links of each part; a joint to each link but the base.
                assert_eq!(names.len(), 1 + 5 + 4, "{text:?}: {urdf}");
                held += 1;
                fs::remove_dir_all(made).expect("a folder");
            }
            Err(CombineError::Recipe { fault, .. }) => {
                assert!(is_of_word(&fault), "{text:?}: {fault}");
            }
            Err(error) => panic!("{text:?}: {error}"),
        }
    }
    assert!(held > 8, "{held}");
}

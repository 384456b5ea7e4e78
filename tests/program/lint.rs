//! `urdd lint` as people run it.

use std::fs;
use std::path::Path;

use serde_json::Value;

use crate::program::output;

/// A joint whose axis is not of length 1.
const SLIDE: &str = "<joint name=\"slide\" type=\"prismatic\"><parent link=\"a\"/><child link=\"b\"/>\
    <axis xyz=\"0 0 2\"/><limit lower=\"-1\" upper=\"1\" effort=\"1\" velocity=\"1\"/></joint>";

fn write(folder: &Path, name: &str, text: &str) {
    let path = folder.join(name);
    fs::create_dir_all(path.parent().expect("a folder")).expect("a folder");
    fs::write(path, text).expect("written");
}

/// A folder with a URDF.
fn slide() -> tempfile::TempDir {
    let folder = testkit::temporary::folder();
    let text = format!("<robot name=\"r\"><link name=\"a\"/><link name=\"b\"/>{SLIDE}</robot>");
    write(folder.path(), "robots/slide.urdf", &text);
    folder
}

/// The codes that `urdd lint` finds in a folder.
fn codes(folder: &Path, arguments: &[&str]) -> Vec<String> {
    let output = output(&[&["lint", ".", "--format", "json"], arguments].concat(), folder);
    let report: Value = serde_json::from_slice(&output.stdout).expect("JSON");
    let findings = report["urdds"][0]["findings"].as_array().expect("a list");
    let codes = findings.iter().map(|finding| finding["code"].as_str().expect("a code"));
    codes.map(ToOwned::to_owned).collect()
}

#[test]
fn urdd_toml_names_a_baseline() {
    let folder = slide();
    let folder = folder.path();
    let all = codes(folder, &[]);
    assert!(all.contains(&"LNT012".to_owned()), "{all:?}");
    let write_baseline = |name: &str| {
        let output = output(&["lint", ".", "--write-baseline", name], folder);
        assert_eq!(output.status.code(), Some(0), "{output:?}");
    };
    fs::create_dir(folder.join("ci")).expect("a folder");
    write_baseline("ci/known.json");
    // Its name is seen from the settings file.
    write(folder, "urdd.toml", "baseline = \"ci/known.json\"\n");
    assert_eq!(codes(folder, &[]), [""; 0]);
    write(folder, "ci/settings.toml", "baseline = \"known.json\"\n");
    assert_eq!(codes(folder, &["--config", "ci/settings.toml"]), [""; 0]);
    // The command line comes first, and a new baseline has all that is found.
    write(folder, "none.json", "{\"urdd_baseline\": 1, \"files\": {}}");
    assert_eq!(codes(folder, &["--baseline", "none.json"]), all);
    write_baseline("ci/known.json");
    assert_eq!(codes(folder, &[]), [""; 0]);
    // `validate` has the same settings, and no baseline.
    let validated = output(&["validate", "robots/slide.urdf"], folder);
    assert_ne!(validated.status.code(), Some(2), "{validated:?}");
    fs::remove_file(folder.join("ci/known.json")).expect("removed");
    let missing = output(&["lint", "."], folder);
    assert_eq!(missing.status.code(), Some(2));
    let words = String::from_utf8_lossy(&missing.stderr);
    assert!(words.contains("known.json: there is no such file"), "{words}");
}

#[test]
fn a_fault_in_urdd_toml_is_said_with_its_place() {
    let folder = slide();
    for (text, place) in [
        ("\ncolour = true\n", ":2:1: "),
        ("[severity]\nLNT999 = \"info\"\n", ":2:1: "),
        ("[[ignore]]\npath = \"**\"\nreason = \" \"\n", ":3:10: "),
    ] {
        write(folder.path(), "urdd.toml", text);
        let output = output(&["lint", "."], folder.path());
        assert_eq!(output.status.code(), Some(2), "{text}");
        let words = String::from_utf8_lossy(&output.stderr);
        assert!(words.contains(&format!("urdd.toml{place}")), "{words}");
    }
}

/// What `--fix` writes to.
#[cfg(unix)]
mod fix {
    use std::os::unix::fs::{MetadataExt, PermissionsExt, symlink};

    use super::*;

    /// Runs `urdd lint` on `home`, and returns what it says of files, with its exit status.
    fn fix(folder: &Path, arguments: &[&str]) -> (String, Option<i32>) {
        let output =
            output(&[&["lint", "--quiet", "--fail-on", "warning"], arguments].concat(), folder);
        let said = String::from_utf8(output.stderr).expect("UTF-8");
        (said, output.status.code())
    }

    fn is_mended(file: &Path) -> bool {
        let text = fs::read_to_string(file).expect("a file");
        assert_ne!(text.contains("0 0 2"), text.contains("0 0 1"), "{text}");
        text.contains("0 0 1")
    }

    #[test]
    fn a_fix_stays_in_what_was_named_whatever_links_say() {
        let folder = slide();
        let root = folder.path();
        let outside = root.join("robots/slide.urdf");
        fs::create_dir_all(root.join("home/inner")).expect("a folder");
        fs::copy(&outside, root.join("home/own.txt")).expect("a copy");
        let link =
            |to: &str, name: &str| symlink(to, root.join("home").join(name)).expect("a link");
        link("../robots/slide.urdf", "led.urdf");
        link("own.txt", "inner.urdf");
        link("gone", "gone.urdf");
        link("itself.urdf", "itself.urdf");
        link("round-b.urdf", "round-a.urdf");
        link("round-a.urdf", "round-b.urdf");
        link("/dev/zero", "endless.urdf");
        link("/", "all");
        link("/", "all.urdf");
        link("..", "inner/up");
        link("../robots", "elsewhere");
        let pipe = std::process::Command::new("mkfifo").arg(root.join("home/pipe.urdf")).status();
        assert!(pipe.expect("mkfifo").success());
        for changed in ["--diff", "--fix"] {
            let (said, status) = fix(root, &["home", changed]);
            let led =
                said.lines().filter(|line| line.contains("home/led.urdf")).collect::<Vec<_>>();
            assert_eq!(led.len(), 1, "{said}");
            assert!(
                led[0].contains("left as it is: the link leads to")
                    && led[0].ends_with(
                        "robots/slide.urdf, outside of what was named; name that file to mend it"
                    ),
                "{said}"
            );
            assert_eq!(status, Some(1), "{said}");
            assert!(!is_mended(&outside));
        }
        assert!(is_mended(&root.join("home/own.txt")));
        let is_link = |name: &str| root.join("home").join(name).is_symlink();
        assert!(is_link("inner.urdf") && is_link("led.urdf") && is_link("endless.urdf"));
        // No option leads out. The link by its name, or the file's folder, does.
        assert!(fix(root, &["home", "--fix", "--force"]).0.contains("outside of what was named"));
        assert!(!is_mended(&outside));
        fix(root, &["home/led.urdf", "--fix"]);
        assert!(is_mended(&outside) && is_link("led.urdf"));
    }

    #[test]
    fn read_only_files_and_hard_links_are_left_alone_unless_forced() {
        let folder = slide();
        let root = folder.path();
        let (own, other) = (root.join("robots/slide.urdf"), root.join("other.txt"));
        let mode = |mode| fs::set_permissions(&own, fs::Permissions::from_mode(mode)).expect("it");
        let left = |words: &str| {
            for changed in ["--diff", "--fix"] {
                let (said, status) = fix(root, &["robots/slide.urdf", changed]);
                assert!(said.contains(words) && said.lines().count() == 1, "{said}");
                assert_eq!(status, Some(1), "{changed}: it is not mended");
                assert!(!is_mended(&own));
            }
        };
        mode(0o444);
        left("robots/slide.urdf: left as it is: the file is read-only");
        mode(0o644);
        fs::hard_link(&own, &other).expect("a link");
        left("robots/slide.urdf: left as it is: the file has 2 names (hard links)");
        assert_eq!(fs::metadata(&own).expect("it").nlink(), 2);
        mode(0o444);
        let (said, _) = fix(root, &["robots/slide.urdf", "--fix", "--force"]);
        assert_eq!(said, "urdd: mended 1 place in robots/slide.urdf\n");
        assert!(is_mended(&own) && !is_mended(&other));
        assert_eq!(fs::metadata(&own).expect("it").mode() & 0o777, 0o444);
    }
}

/// With a program in place of xacro, which knows includes and macros of one parameter.
#[cfg(unix)]
pub mod xacro {
    use std::os::unix::fs::PermissionsExt;
    use std::process::Command;

    use super::*;

    const MAIN: &str = "<robot name=\"hand\" xmlns:xacro=\"http://www.ros.org/wiki/xacro\">\n\
        <xacro:include filename=\"parts/finger.xacro\"/>\n\
        <link name=\"a\"/>\n\
        <xacro:finger prefix=\"left\"/>\n\
        </robot>\n";
    const MACRO: &str = "<robot xmlns:xacro=\"http://www.ros.org/wiki/xacro\">\n\
        <xacro:macro name=\"finger\" params=\"prefix\">\n\
        <link name=\"${prefix}_tip\"/>\n\
        <joint name=\"${prefix}_slide\" type=\"prismatic\">\n  \
        <parent link=\"a\"/><child link=\"${prefix}_tip\"/>\n  \
        <axis xyz=\"0 0 2\"/>\n  \
        <limit lower=\"-1\" upper=\"1\" effort=\"1\"\n   velocity=\"1\"/></joint>\n\
        <transmission name=\"t\"><joint name=\"${prefix}_slid\"/></transmission>\n\
        </xacro:macro>\n\
        </robot>\n";

    /// A folder with the two files, and the program.
    pub fn hand(name: &str) -> tempfile::TempDir {
        let folder = testkit::temporary::folder();
        let root = folder.path();
        write(root, &format!("{name}/hand.urdf.xacro"), MAIN);
        write(root, &format!("{name}/parts/finger.xacro"), MACRO);
        write(root, "python/xacro/__init__.py", include_str!("xacro.py"));
        let python = root.join("python");
        let script = format!(
            "#!/bin/sh\nPATH=/usr/local/bin:/usr/bin:/bin\n\
            PYTHONPATH=\"$PYTHONPATH:{}\" exec python3 -c 'import xacro; xacro.main()' \"$@\"\n",
            python.display()
        );
        write(root, "bin/xacro", &script);
        let mode = fs::Permissions::from_mode(0o755);
        fs::set_permissions(root.join("bin/xacro"), mode).expect("a program");
        folder
    }

    fn lint(folder: &Path, arguments: &[&str]) -> String {
        let output = Command::new(env!("CARGO_BIN_EXE_urdd"))
            .arg("lint")
            .args(arguments)
            .current_dir(folder)
            .env("PATH", folder.join("bin"))
            .output()
            .expect("the program");
        String::from_utf8(output.stdout).expect("UTF-8")
    }

    #[test]
    fn every_form_names_the_place_in_the_xacro_file() {
        let folder = hand("my hand");
        let file = "my hand/hand.urdf.xacro";
        let text = lint(folder.path(), &[file]);
        // The attribute: `  <axis xyz=` is the line.
        let people = "at parts/finger.xacro:6:9 (joint `left_slide`) in the macro \"finger\"\n";
        assert!(text.contains(people), "{text}");
        assert!(text.contains("\n  the URDF\n"), "{text}");
        // An element of no link or joint.
        assert!(text.contains("at parts/finger.xacro:9:"), "{text}");
        let json = lint(folder.path(), &[file, "--format", "json"]);
        let report: Value = serde_json::from_str(&json).expect("JSON");
        let findings = report["urdds"][0]["findings"].as_array().expect("a list");
        let axis = findings.iter().find(|one| one["code"] == "LNT012").expect("it");
        let place = (&axis["file"], &axis["line"], &axis["column"]);
        assert_eq!(place, (&"parts/finger.xacro".into(), &6.into(), &9.into()));
        let written = &axis["places"][0]["written_at"];
        assert_eq!((&written["line"], &written["macro_name"]), (&6.into(), &"finger".into()));
        let sarif = lint(folder.path(), &[file, "--format", "sarif"]);
        let sarif: Value = serde_json::from_str(&sarif).expect("JSON");
        let results = sarif["runs"][0]["results"].as_array().expect("a list");
        let axis = results.iter().find(|one| one["ruleId"] == "LNT012").expect("it");
        let place = &axis["locations"][0]["physicalLocation"];
        assert_eq!(place["artifactLocation"]["uri"], "my%20hand/parts/finger.xacro");
        assert_eq!(place["region"]["startLine"], 6);
        assert!(axis["message"]["text"].as_str().expect("a text").contains("\nMacro: finger"));
        let github = lint(folder.path(), &[file, "--format", "github"]);
        let place = "file=my hand/parts/finger.xacro,line=6,col=9,title=LNT012";
        assert!(github.contains(place) && github.contains("; macro: finger"), "{github}");
        let junit = lint(folder.path(), &[file, "--format", "junit"]);
        assert!(junit.contains("at parts/finger.xacro:6:9 (joint"), "{junit}");
    }

    #[test]
    fn a_file_outside_of_the_folder_has_no_line_in_annotations() {
        let folder = hand("hand");
        let urdf = folder.path().join("hand/urdf");
        write(&urdf, "hand.urdf.xacro", &MAIN.replace("parts/", "../parts/"));
        std::os::unix::fs::symlink(folder.path().join("bin"), urdf.join("bin")).expect("a link");
        let github = lint(&urdf, &["hand.urdf.xacro", "--format", "github"]);
        let axis = github.lines().find(|line| line.contains("title=LNT012")).expect("it");
        assert!(axis.starts_with("::warning file=./,title=LNT012"), "{axis}");
        assert!(axis.contains("; at: ../parts/finger.xacro:6:9 (joint `left_slide`)"), "{axis}");
        let sarif = lint(&urdf, &["hand.urdf.xacro", "--format", "sarif"]);
        assert!(!sarif.contains("startLine\": 6"), "{sarif}");
    }

    /// As by a xacro of another language: then no line is named, rather than one of the expansion.
    #[test]
    fn a_program_that_cannot_be_watched_leaves_the_file() {
        let folder = hand("hand");
        let script = "#!/bin/sh\nPATH=/usr/bin:/bin\n\
            exec env -u URDD_XACRO_PLACES sh \"${0%/*}/real\" \"$@\"\n";
        fs::rename(folder.path().join("bin/xacro"), folder.path().join("bin/real")).expect("it");
        write(folder.path(), "bin/xacro", script);
        let mode = fs::Permissions::from_mode(0o755);
        fs::set_permissions(folder.path().join("bin/xacro"), mode).expect("a program");
        let text = lint(folder.path(), &["hand/hand.urdf.xacro"]);
        assert!(text.contains("at hand.urdf.xacro (joint `left_slide`)\n"), "{text}");
        assert!(!text.contains(".xacro:"), "{text}");
    }

    #[test]
    fn an_srdf_that_is_xacro_is_expanded_by_leave_alone() {
        let folder = hand("hand");
        write(
            folder.path(),
            "hand/config/pairs.xacro",
            &MACRO.replace(
                "<link name=\"${prefix}_tip\"/>",
                "<disable_collisions link1=\"a\" link2=\"${prefix}_top\"/>",
            ),
        );
        let srdf = MAIN.replace("parts/finger", "pairs").replace("<link name=\"a\"/>\n", "");
        write(folder.path(), "hand/config/hand.srdf.xacro", &srdf);
        let file = "hand/hand.urdf.xacro";
        let text = lint(folder.path(), &[file]);
        assert!(!text.contains("LNT045"), "{text}");
        let text = lint(folder.path(), &[file, "--xacro"]);
        assert!(text.contains("at config/pairs.xacro:3:"), "{text}");
        assert!(text.contains("`left_top`"), "{text}");
    }

    /// The stand-in for xacro makes the SRDF name a link `cap`, unless it is told otherwise.
    #[test]
    fn an_srdf_that_is_xacro_takes_the_defaults_of_the_urdf() {
        let folder = hand("hand");
        let pair = "<disable_collisions link1='a' link2='cap'/>";
        let srdf = "<group name='g'><link name='a'/><link name='b'/></group>";
        let joint = "<joint name='j' type='fixed'><parent link='a'/><child link='b'/></joint>";
        let script = format!(
            "#!/bin/sh\ncase \"$*\" in *srdf.xacro*) case \"$*\" in *has_cap:=false) PAIR= ;; *) PAIR=\"{pair}\";; esac; \
             echo \"<robot name='hand'>{srdf}$PAIR</robot>\";; *) echo \"<robot name='hand'><link name='a'/><link name='b'/>{joint}</robot>\";; esac\n"
        );
        write(folder.path(), "bin/xacro", &script);
        write(folder.path(), "hand/config/hand.srdf.xacro", "<robot name='hand'/>");
        let said = |declared: &str, words: &[&str]| {
            let declared = format!("{declared}<link name=\"a\"/>");
            let urdf = MAIN.replace("<link name=\"a\"/>", &declared);
            write(folder.path(), "hand/hand.urdf.xacro", &urdf);
            let all = [&["hand/hand.urdf.xacro", "--xacro"], words].concat();
            lint(folder.path(), &all)
        };
        let with = |default: &str| format!("<xacro:arg name=\"has_cap\" default=\"{default}\"/>");
        assert!(said("", &[]).contains("`cap`"));
        assert!(said(&with("true"), &[]).contains("`cap`"));
        assert!(!said(&with("false"), &[]).contains("`cap`"));
        // What is given is stronger.
        assert!(said(&with("false"), &["has_cap:=true"]).contains("`cap`"));
    }

    #[test]
    fn what_xacro_refuses_is_said_as_xacro_says_it() {
        let folder = hand("hand");
        let script = "#!/bin/sh\necho \"error: name 'lft' is not defined \n\
            when evaluating expression 'lft'\nwhen instantiating macro: finger (parts/finger.xacro)\n\
            in file: hand.urdf.xacro\" >&2; exit 2\n";
        write(folder.path(), "bin/xacro", script);
        let text = lint(folder.path(), &["hand/hand.urdf.xacro"]);
        assert!(text.contains("name 'lft' is not defined"), "{text}");
        assert!(text.contains("in file: hand.urdf.xacro"), "{text}");
        assert!(!text.contains("`urdd lint` finds more"), "{text}");
    }
}

#[cfg(unix)]
#[test]
fn no_baseline_is_written_where_a_link_leads() {
    let folder = slide();
    let (folder, elsewhere) = (folder.path(), testkit::temporary::folder());
    let target = elsewhere.path().join("new.json");
    std::os::unix::fs::symlink(&target, folder.join("known.json")).expect("a link");
    let refused = output(&["lint", ".", "--write-baseline", "known.json"], folder);
    assert_eq!(refused.status.code(), Some(2), "{refused:?}");
    let words = String::from_utf8_lossy(&refused.stderr);
    assert!(words.contains("known.json: it is a link that leads nowhere"), "{words}");
    assert!(!target.exists());
}

#[test]
fn what_cannot_be_read_is_told_at_its_file_in_a_pull_request() {
    let folder = slide();
    write(folder.path(), "robots/broken.xml", "<mujoco><worldbody>");
    let printed = output(&["lint", "robots/broken.xml", "--format", "github"], folder.path());
    let words = String::from_utf8_lossy(&printed.stdout);
    assert!(words.contains("::error file=robots/broken.xml,line=1,"), "{words}");
}

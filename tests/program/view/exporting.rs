//! `urdd view --export` as a process: what it replaces, and what a kill leaves.

use std::fs;
use std::path::Path;
use std::process::{Command, Stdio};
use std::time::Duration;

use testkit::files::below;
use testkit::robots::made_named;
use testkit::site::{OF_A_PERSON, listed, put, robot_files};
use testkit::trials::trials;

#[test]
fn a_page_that_a_person_edited_stays() {
    let (_folder, path) = made_named("gripper");
    let folder = testkit::temporary::folder();
    let file = folder.path().join("robot.html");
    let export = || {
        let mut command = Command::new(env!("CARGO_BIN_EXE_urdd"));
        command.arg("view").arg(&path).arg("--export").arg(&file);
        command.output().expect("the program runs")
    };
    assert!(export().status.success());
    assert!(export().status.success(), "again, in the place of its own");
    let edited = fs::read_to_string(&file).expect("a page") + "<p>mine</p>";
    fs::write(&file, &edited).expect("written");
    let refused = export();
    assert_eq!(refused.status.code(), Some(2));
    let words = String::from_utf8_lossy(&refused.stderr);
    assert!(words.contains("changed since") && words.contains("Move it away"), "{words}");
    assert_eq!(fs::read_to_string(&file).expect("it stays"), edited);
}

/// Whenever an export is killed, the site is the old one or the new one, and the next export completes it.
#[test]
fn a_killed_export_leaves_a_whole_site() {
    let (folder, path) = made_named("gripper");
    let (_other, other) = made_named("welding_arm");
    let site = folder.path().join("site");
    let export = |urdd: &Path, site: &Path| {
        let mut command = Command::new(env!("CARGO_BIN_EXE_urdd"));
        command.arg("view").arg(urdd).arg("--export").arg(site);
        command.stdout(Stdio::null()).stderr(Stdio::null());
        command.spawn().expect("the program runs")
    };
    let exported = |urdd: &Path, site: &Path| {
        assert!(export(urdd, site).wait().expect("it ends").success());
    };
    exported(&path, &site);
    put(&site, OF_A_PERSON);
    let robots = [listed(&path), listed(&other)];
    let begun = std::time::Instant::now();
    exported(&other, &site);
    let usual = begun.elapsed();
    let kills = trials(6);
    for k in 0..kills {
        let mut child = export(if k % 2 == 0 { &path } else { &other }, &site);
        // Most of the time passes before the first file is moved into place.
        let share = usual.mul_f64(0.5 + 0.6 * f64::from(k) / f64::from(kills));
        std::thread::sleep(share.max(Duration::from_millis(1)));
        let _ = child.kill();
        let _ = child.wait();
        assert!(robots.contains(&robot_files(&site)), "killed after {share:?}");
        for (name, text) in OF_A_PERSON {
            assert_eq!(fs::read_to_string(site.join(name)).expect(name), *text);
        }
    }
    exported(&path, &site);
    let fresh = folder.path().join("fresh");
    exported(&path, &fresh);
    let mut expected = below(&fresh);
    expected.extend(
        OF_A_PERSON.iter().map(|(name, text)| ((*name).to_owned(), text.as_bytes().to_vec())),
    );
    assert_eq!(below(&site).keys().collect::<Vec<_>>(), expected.keys().collect::<Vec<_>>());
}

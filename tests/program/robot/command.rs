use std::io::Write;
use std::path::Path;
use std::process::{Command, Stdio};

use testkit::robots::{made, our_robots};

/// The result of `urdd check-collisions`: exit status, standard output, standard error.
fn check(urdd: &Path, arguments: &[&str], input: &str) -> (i32, String, String) {
    let mut child = Command::new(env!("CARGO_BIN_EXE_urdd"))
        .arg("check-collisions")
        .arg(urdd)
        .args(arguments)
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    child.stdin.take().unwrap().write_all(input.as_bytes()).unwrap();
    let output = child.wait_with_output().unwrap();
    let text = |bytes: Vec<u8>| String::from_utf8(bytes).unwrap();
    (output.status.code().unwrap(), text(output.stdout), text(output.stderr))
}

#[test]
fn it_reads_configurations_in_each_form() {
    let (_folder, path) = made(&our_robots()[8].1);
    let json = "[0.5, 0, 0, 0, 0.25, 0]\n\n[0, 0, 0, 0, 0, 0]\n";
    let by_name = "{\"axis_5\": 0.25, \"axis_1\": 0.5}\n{}\n";
    let plain = "# by hand\n0.5, 0, 0, 0, 0.25, 0\n0,0,0,0,0,0\n";
    let table = "axis_6,axis_5,axis_4,axis_3,axis_2,axis_1\n0,0.25,0,0,0,0.5\n0,0,0,0,0,0\n";
    let asked: Vec<_> = [json, by_name, plain, table]
        .map(|input| check(&path, &["-c", "-", "--format", "json"], input))
        .into_iter()
        .collect();
    let lines: Vec<serde_json::Value> =
        asked[0].1.lines().map(|line| serde_json::from_str(line).unwrap()).collect();
    assert_eq!(lines.len(), 2, "{asked:?}");
    assert_eq!(lines[0]["values"], serde_json::json!([0.5, 0.0, 0.0, 0.0, 0.25, 0.0]));
    assert_eq!(lines[1]["in_collision"], false);
    assert_eq!(lines[1]["nearest"].as_array().unwrap().len(), 3);
    assert!(asked.iter().all(|one| *one == asked[0]), "{asked:?}");
}

#[test]
fn its_exit_status_says_whether_the_robot_is_free() {
    let (_folder, path) = made(&our_robots()[8].1);
    let (status, text, _) = check(&path, &[], "");
    assert_eq!(status, 0);
    assert!(text.starts_with("configuration 0: free\n"), "{text}");
    let (status, text, _) = check(&path, &["--random", "200"], "");
    assert_eq!(status, 1);
    assert!(text.contains(" of 200 configurations collide ("), "{text}");
    assert_eq!(check(&path, &["--random", "200"], "").1, text);
}

#[test]
fn what_is_wrong_is_said_with_the_line() {
    let (_folder, path) = made(&our_robots()[8].1);
    let said = |input: &str| {
        let (status, out, error) = check(&path, &["-c", "-"], input);
        assert_eq!((status, out.as_str()), (2, ""), "{error}");
        error
    };
    let dofs = "axis_1, axis_2, axis_3, axis_4, axis_5, axis_6";
    assert_eq!(
        said("[0,0,0,0,0,0]\n[1,2]\n"),
        format!("urdd: standard input:2: 2 values, but the robot has 6 DOFs: {dofs}\n")
    );
    assert_eq!(
        said("0,0,0,0,0,0\n0,0,0,0,0,x\u{7}\n"),
        "urdd: standard input:2: `x\\u{7}` is not a number\n"
    );
    assert_eq!(
        said("0,0,0,0,0,inf\n"),
        "urdd: standard input:1: the value of `axis_6` is inf, not a finite number\n"
    );
    assert_eq!(
        said("{\"axis_7\": 1}"),
        "urdd: standard input:1: there is no DOF `axis_7`; did you mean `axis_1`?\n"
    );
    assert_eq!(
        said("axis_1,axis_2\n1,2\n"),
        "urdd: standard input:1: the column for the DOF `axis_3` is missing\n"
    );
    let (status, _, error) = check(&our_robots()[8].1, &[], "");
    assert_eq!(status, 2);
    assert!(
        error.contains("this is a URDF; generate a URDD from it first: urdd generate"),
        "{error}"
    );
    let (status, _, error) = check(&path.join("nowhere"), &[], "");
    assert_eq!(status, 2);
    assert!(error.contains("nowhere: "), "{error}");
}

#[test]
fn very_many_random_configurations_are_not_held_in_memory() {
    let (_folder, path) = made(&our_robots()[8].1);
    for count in ["18446744073709551615", "1000000001", "0", "-1"] {
        let (status, _, said) = check(&path, &[&format!("--random={count}")], "");
        assert_eq!(status, 2, "{said}");
        assert!(said.contains("--random"), "{said}");
    }
    // The first line appears before the last configuration is checked, and closing the pipe ends the program.
    let mut child = Command::new(env!("CARGO_BIN_EXE_urdd"))
        .arg("check-collisions")
        .arg(&path)
        .args(["--random", "1000000000", "--format", "json", "--nearest", "18446744073709551615"])
        .stdout(Stdio::piped())
        .spawn()
        .unwrap();
    let mut first = String::new();
    let mut reader = std::io::BufReader::new(child.stdout.take().unwrap());
    std::io::BufRead::read_line(&mut reader, &mut first).unwrap();
    drop(reader);
    let value: serde_json::Value = serde_json::from_str(&first).unwrap();
    assert_eq!(value["configuration"], 0);
    assert!(child.wait().unwrap().code().is_some_and(|code| code < 2));
    // The same answers for any batch size.
    let (_, text, _) = check(&path, &["--random", "5000"], "");
    let (_, lines, _) = check(&path, &["--random", "5000", "--format", "json", "--nearest=0"], "");
    let colliding = lines.matches("\"in_collision\":true").count();
    assert!(text.starts_with(&format!("{colliding} of 5000 configurations collide")), "{text}");
    assert!(colliding > 0 && lines.lines().count() == 5000);
}

#[test]
fn a_robot_without_dofs_collides_in_each_configuration_or_in_none() {
    let boxes = "<robot name='still'><link name='a'/><link name='b'><visual><geometry><box size='1 1 1'/></geometry></visual></link>\
        <link name='c'><visual><geometry><box size='1 1 1'/></geometry></visual></link>\
        <joint name='j' type='fixed'><parent link='a'/><child link='b'/></joint>\
        <joint name='k' type='fixed'><parent link='a'/><child link='c'/></joint></robot>";
    let folder = testkit::temporary::folder();
    let urdf = folder.path().join("still.urdf");
    std::fs::write(&urdf, boxes).unwrap();
    let settings =
        urdd_generate::Settings { skipped_reasons: Some(Vec::new()), ..Default::default() };
    let path = folder.path().join("still");
    urdd_generate::generate(&urdf, &path, &settings, &()).unwrap();
    let (status, text, _) = check(&path, &["--random", "20"], "");
    assert_eq!(status, 1, "{text}");
    assert!(text.starts_with("20 of 20 configurations collide"), "{text}");
}

//! Configurations that a program shows: who may send them, and what pages get.

use std::io::{BufRead, BufReader, Write};
use std::net::TcpStream;
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

use serde_json::{Value, json};

use super::asking::{Running, made};

const STATES: &str = "/robots/gripper/states";

/// The lines that a page gets, and the headers before them.
fn listen(server: &Running, token: &str) -> BufReader<TcpStream> {
    let mut stream = TcpStream::connect(("127.0.0.1", server.port)).expect("a connection");
    let time = Some(Duration::from_secs(30));
    stream.set_read_timeout(time).expect("a time limit");
    let request = format!(
        "GET {STATES} HTTP/1.1\r\nHost: {}\r\nX-Urdd-Token: {token}\r\n\r\n",
        server.host()
    );
    stream.write_all(request.as_bytes()).expect("sent");
    BufReader::new(stream)
}

fn status(reader: &mut impl BufRead) -> String {
    let mut first = String::new();
    reader.read_line(&mut first).expect("a line");
    loop {
        let mut line = String::new();
        reader.read_line(&mut line).expect("a line");
        if line.trim().is_empty() {
            return first;
        }
    }
}

/// The next configuration.
fn next(reader: &mut impl BufRead) -> Value {
    loop {
        let mut line = String::new();
        assert!(reader.read_line(&mut line).expect("a line") > 0, "it ended");
        if !line.trim().is_empty() {
            return serde_json::from_str(&line).expect("JSON");
        }
    }
}

#[test]
fn pages_get_the_last_configuration_and_those_after_it() {
    let (_folder, path) = made("gripper");
    let server = Running::on(&path);
    let follows = || server.json("/robots.json")[0]["follows"].clone();
    assert_eq!(follows(), false);
    for q in [0.1, 0.2] {
        assert_eq!(server.post(STATES, &json!({ "q": [q] })).status, 204);
    }
    assert_eq!(follows(), true);
    let mut pages = [(); 2].map(|()| listen(&server, &server.token));
    for page in &mut pages {
        assert!(status(page).contains("200"));
        assert_eq!(next(page), json!({ "q": [0.2] }));
    }
    server.post(STATES, &json!({ "q": [0.3] }));
    for page in &mut pages {
        assert_eq!(next(page), json!({ "q": [0.3] }));
    }
}

#[test]
fn nobody_without_the_token_and_nothing_else() {
    let (_folder, path) = made("gripper");
    let server = Running::on(&path);
    assert!(status(&mut listen(&server, "0123")).contains("403"));
    let headers = [("Host", &*server.host())];
    let sent = server.raw(&format!("POST {STATES}"), &headers, br#"{"q": [0]}"#);
    assert_eq!(sent.status, 403);
    let long = format!("{{\"q\": [{}0]}}", "0,".repeat(100_000));
    for wrong in [
        r#"{"q": [NaN]}"#,
        r#"{"q": [1e999]}"#,
        r#"{"q": ["0"]}"#,
        r#"{"q": 0}"#,
        r#"{"q": [0], "r": 1}"#,
        "",
        &long,
    ] {
        let answer = server.send(STATES, wrong.as_bytes());
        assert_eq!(answer.status, 400, "{wrong:.40}");
    }
    let huge = vec![b' '; (1 << 20) + 1];
    assert_eq!(server.send(STATES, &huge).status, 413);
    let none = server.post("/robots/nobody/states", &json!({ "q": [0] }));
    assert_eq!(none.status, 404);
    assert_eq!(server.json("/robots.json")[0]["follows"], false);
}

#[test]
fn a_configuration_of_another_length_is_refused() {
    let (_folder, path) = made("gripper");
    let server = Running::on(&path);
    for wrong in [&[][..], &[0.0, 0.0], &[0.0, 0.0, 0.0]] {
        let answer = server.post(STATES, &json!({ "q": wrong }));
        assert_eq!(answer.status, 400);
        let found = wrong.len();
        let expected = format!("expected one value for each DOF, so 1; found {found}\n");
        assert_eq!(answer.text(), expected);
    }
    assert_eq!(server.json("/robots.json")[0]["follows"], false);
    // The robot of the files that are there now counts.
    let other = testkit::repository().join("conformance/robots/planar_base_arm.urdf");
    urdd_generate::generate(&other, &path, &Default::default(), &()).expect("a URDD");
    let dofs = urdd_robot::Robot::open(&path).expect("a robot").dof_names().expect("names").len();
    assert_ne!(dofs, 1);
    assert_eq!(server.post(STATES, &json!({ "q": vec![0.0; dofs] })).status, 204);
    assert_eq!(server.post(STATES, &json!({ "q": [0.0] })).status, 400);
}

/// A page that does not read misses configurations, and holds up nobody; one that is gone frees its place.
#[test]
fn pages_that_stall_hold_up_nobody() {
    let (_folder, path) = made("gripper");
    let server = Running::on(&path);
    server.post(STATES, &json!({ "q": [0] }));
    let stalled: Vec<_> = (0..20).map(|_| listen(&server, &server.token)).collect();
    let mut page = listen(&server, &server.token);
    status(&mut page);
    let began = Instant::now();
    for k in 1..=300 {
        server.post(STATES, &json!({ "q": [k] }));
    }
    let last = loop {
        let found = next(&mut page);
        if found["q"][0] == json!(300.0) {
            break found;
        }
    };
    assert_eq!(last, json!({ "q": [300.0] }));
    assert!(began.elapsed() < Duration::from_secs(60));
    drop(stalled);
    drop(page);
    // 60 pages, one after another: more than there are places for connections.
    for _ in 0..60 {
        let mut page = listen(&server, &server.token);
        status(&mut page);
        next(&mut page);
    }
}

#[test]
fn the_command_shows_what_it_reads() {
    let (_folder, path) = made("gripper");
    let mut child = Command::new(env!("CARGO_BIN_EXE_urdd"))
        .args(["view", "--no-open", "--follow"])
        .arg(&path)
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .expect("started");
    let mut input = child.stdin.take().expect("standard input");
    let mut output = BufReader::new(child.stdout.take().expect("standard output"));
    let mut line = String::new();
    output.read_line(&mut line).expect("a line");
    let server = Running::at(line.split_whitespace().last().expect("an address"));
    let dofs = server.json("/robots/gripper/summary.json")["dofs"].clone();
    assert!(dofs.is_number(), "{dofs}");
    let names = urdd_robot::Robot::open(&path).expect("a robot");
    let names = names.dof_names().expect("DOFs");
    let head = names.iter().rev().cloned().collect::<Vec<_>>().join(",");
    let row = |value: f64| vec![value.to_string(); names.len()].join(",");
    write!(input, "{head}\n{}\n", row(0.01)).expect("written");
    let mut page = listen(&server, &server.token);
    assert!(status(&mut page).contains("200"));
    assert_eq!(next(&mut page)["q"], json!(vec![0.01; names.len()]));
    // A wrong line is said, and the next one is shown.
    write!(input, "1,x\n{}\n", row(0.02)).expect("written");
    assert_eq!(next(&mut page)["q"], json!(vec![0.02; names.len()]));
    // A line without an end takes no more memory than that.
    input.write_all(&[b'1'; 1 << 20]).expect("written");
    let mut errors = BufReader::new(child.stderr.take().expect("errors"));
    let mut said = String::new();
    while !said.contains("longer than 1 MiB") {
        assert!(errors.read_line(&mut said).expect("text") > 0, "{said}");
    }
    assert!(said.contains("standard input:3: ") && said.contains("standard input:5: "), "{said}");
    drop(input);
    child.kill().expect("ended");
    child.wait().expect("ended");
}

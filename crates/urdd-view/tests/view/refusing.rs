//! How a server handles clients that send too much, too slowly, or too often.

use std::fs;
use std::io::{ErrorKind, Read, Write};
use std::net::TcpStream;
use std::time::{Duration, Instant};

use super::asking::Running;
use testkit::robots::made_named;

/// The first line of the response to a request of which only the head is sent.
fn answer_to_head(server: &Running, head: &str) -> String {
    let mut stream = TcpStream::connect(("127.0.0.1", server.port)).expect("a connection");
    stream.set_read_timeout(Some(Duration::from_secs(5))).expect("set");
    stream.write_all(head.as_bytes()).expect("sent");
    let mut answer = [0; 64];
    let read = stream.read(&mut answer).expect("an answer before the body");
    let text = String::from_utf8_lossy(&answer[..read]).into_owned();
    text.lines().next().unwrap_or_default().to_owned()
}

/// An unauthorised client gets its response before it sends any of the body.
#[test]
fn who_may_not_ask_is_refused_before_a_body_is_read() {
    let (_folder, path) = made_named("gripper");
    let server = Running::on(&path);
    let (host, token) = (server.host(), server.token.clone());
    let skips = "POST /robots/gripper/skips HTTP/1.1\r\n";
    let keep = "POST /robots/gripper/keep HTTP/1.1\r\n";
    let long = "Content-Length: 67108864\r\n";
    for (line, headers, status) in [
        (skips, "Host: evil.example\r\n".to_owned(), 403),
        (skips, format!("Host: {host}\r\n"), 403),
        (skips, format!("Host: {host}\r\nX-Urdd-Token: 0\r\n"), 403),
        (
            skips,
            format!("Host: {host}\r\nOrigin: http://evil.example\r\nX-Urdd-Token: {token}\r\n"),
            403,
        ),
        // An authorised client sends no more than the route accepts.
        (keep, format!("Host: {host}\r\nX-Urdd-Token: {token}\r\n"), 413),
        (
            "GET /robots.json HTTP/1.1\r\n",
            format!("Host: {host}\r\nX-Urdd-Token: {token}\r\n"),
            413,
        ),
        ("POST / HTTP/1.1\r\n", format!("Host: {host}\r\n"), 413),
    ] {
        let first = answer_to_head(&server, &format!("{line}{headers}{long}\r\n"));
        assert!(first.contains(&format!(" {status} ")), "{line}{headers}: {first}");
    }
}

/// The response arrives although the request was not read to its end.
#[test]
fn a_refusal_arrives_whole() {
    let (_folder, path) = made_named("gripper");
    let server = Running::on(&path);
    let headers = [("Host", "evil.example")];
    for _ in 0..20 {
        let answer = server.raw("POST /robots/gripper/skips", &headers, &vec![b'x'; 300_000]);
        assert_eq!(answer.status, 403);
    }
}

/// Connections that send slowly, and some that are silent, while a page makes requests.
#[test]
fn who_says_nothing_does_not_shut_the_page_out() {
    let (_folder, path) = made_named("gripper");
    let server = Running::on(&path);
    let mut dripping: Vec<TcpStream> = (0..64)
        .map(|_| TcpStream::connect(("127.0.0.1", server.port)).expect("a connection"))
        .collect();
    for stream in &mut dripping {
        let _ = stream.write_all(b"GET / HTTP/1.1\r\nHost");
    }
    for _ in 0..5 {
        for stream in &mut dripping {
            let _ = stream.write_all(b"x");
        }
        let begun = Instant::now();
        assert_eq!(server.get("/robots.json").status, 200);
        assert_eq!(server.get("/robots/gripper/files/urdd.json").status, 200);
        assert!(begun.elapsed() < Duration::from_secs(5), "{:?}", begun.elapsed());
    }
}

/// Pages that stay open, and programs with the token that do not end what they begin.
#[test]
fn who_has_the_token_does_not_shut_others_out_either() {
    let (_folder, path) = made_named("gripper");
    let server = Running::on(&path);
    let known = format!("Host: {}\r\nX-Urdd-Token: {}\r\n", server.host(), server.token);
    for request in [
        format!("GET /robots/gripper/states HTTP/1.1\r\n{known}\r\n"),
        format!("POST /robots/gripper/skips HTTP/1.1\r\n{known}Content-Length: 1000\r\n\r\n"),
    ] {
        let mut open = Vec::new();
        for _ in 0..48 {
            let mut stream = TcpStream::connect(("127.0.0.1", server.port)).expect("a connection");
            stream.write_all(request.as_bytes()).expect("sent");
            open.push(stream);
        }
        // All of them were accepted.
        std::thread::sleep(Duration::from_millis(500));
        let begun = Instant::now();
        assert_eq!(server.get("/robots.json").status, 200);
        assert_eq!(server.raw("GET /", &[("Host", &*server.host())], b"").status, 200);
        assert!(begun.elapsed() < Duration::from_secs(5), "{:?}", begun.elapsed());
        drop(open);
    }
}

/// A connection that sends a byte now and then is closed, like a silent one.
#[test]
fn a_dripping_connection_ends() {
    let (_folder, path) = made_named("gripper");
    let server = Running::on(&path);
    let mut stream = TcpStream::connect(("127.0.0.1", server.port)).expect("a connection");
    stream.set_read_timeout(Some(Duration::from_millis(200))).expect("set");
    let begun = Instant::now();
    loop {
        let sent = stream.write_all(b"x");
        let ended = match stream.read(&mut [0]) {
            Ok(0) => true,
            Ok(_) => false,
            Err(error) => !matches!(error.kind(), ErrorKind::WouldBlock | ErrorKind::TimedOut),
        };
        if sent.is_err() || ended {
            break;
        }
        assert!(begun.elapsed() < Duration::from_secs(30), "it goes on");
    }
    assert!(begun.elapsed() > Duration::from_secs(4), "{:?}", begun.elapsed());
}

/// An archive is read once for all requests, and its files are sent as they are inflated.
#[test]
fn an_archive_is_served_as_its_folder() {
    let (folder, path) = made_named("gripper");
    fs::write(path.join(".env"), "SECRET").expect("written");
    let zip = folder.path().join("gripper.zip");
    let mut writer = zip::ZipWriter::new(fs::File::create(&zip).expect("a file"));
    let of_folder = Running::on(&path);
    let listed = of_folder.json("/robots/gripper/files.json");
    let mut names: Vec<&str> = listed["files"]
        .as_array()
        .expect("a list")
        .iter()
        .map(|file| file["path"].as_str().expect("a path"))
        .collect();
    names.push(".env");
    for name in &names {
        writer.start_file(*name, zip::write::SimpleFileOptions::default()).expect("an entry");
        writer.write_all(&fs::read(path.join(name)).expect("a file")).expect("written");
    }
    writer.finish().expect("an archive");
    let of_zip = Running::on(&zip);
    let packed = of_zip.json("/robots/gripper_zip/files.json");
    assert_eq!(packed["files"], listed["files"]);
    names.pop();
    for name in names {
        let own = of_zip.get(&format!("/robots/gripper_zip/files/{name}"));
        assert_eq!(
            (own.status, own.body),
            (200, fs::read(path.join(name)).expect("a file")),
            "{name}"
        );
    }
    assert_eq!(of_zip.get("/robots/gripper_zip/files/.env").status, 404);
    assert_eq!(of_folder.get("/robots/gripper/files/.env").status, 404);
    let report = of_zip.json("/robots/gripper_zip/report.json");
    assert_eq!(report["urdds"][0]["verdict"], "pass");
}

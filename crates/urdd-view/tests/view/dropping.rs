//! URDFs that are dropped on the page.

use std::fs;
use std::io::{Cursor, Write};
use std::net::TcpStream;
use std::path::Path;
use std::time::{Duration, Instant};

use serde_json::{Value, json};
use urdd_view::Collection;

use super::asking::Running;
use super::living::living;
use testkit::requests::{Answer, is_whole};

const MESH: &str = "v 0 0 0\nv .1 0 0\nv 0 .1 0\nv 0 0 .1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";
const URDF: &str = r#"<robot name="arm"><link name="a"><visual><geometry>
    <mesh filename="package://arm_description/meshes/a.obj"/></geometry></visual></link></robot>"#;

/// Whether the notes have no more to say than that the robot has no collision elements.
fn says_no_collision_alone(notes: &Value) -> bool {
    let all: Vec<&str> = notes.as_array().into_iter().flatten().filter_map(Value::as_str).collect();
    matches!(&all[..], [one] if one.contains("no link has a collision element"))
}

fn body(files: &[(&str, &str)]) -> Vec<u8> {
    let list: Vec<Value> =
        files.iter().map(|(path, text)| json!({ "path": path, "size": text.len() })).collect();
    let mut body = Value::from(list).to_string();
    body.push('\n');
    body.extend(files.iter().map(|(_, text)| *text));
    body.into_bytes()
}

fn drop_on(server: &Running, files: &[(&str, &str)]) -> Answer {
    server.send("/drops", &body(files))
}

/// The paths of all files below a folder.
fn files(folder: &Path) -> Vec<String> {
    let mut found = Vec::new();
    let mut waiting = vec![folder.to_owned()];
    while let Some(at) = waiting.pop() {
        for entry in fs::read_dir(&at).expect("a folder") {
            let path = entry.expect("an entry").path();
            match path.is_dir() {
                true => waiting.push(path),
                false => found.push(path.display().to_string()),
            }
        }
    }
    found
}

#[test]
fn meshes_are_found_in_what_was_dropped() {
    let folder = testkit::temporary::folder();
    let collection = Collection::default().with_drops(folder.path().join("in"), false);
    living(collection, |server| {
        let whole =
            [("arm_description/urdf/arm.urdf", URDF), ("arm_description/meshes/a.obj", MESH)];
        // The content of the package, without the folder of its name.
        let content = [("urdf/arm.urdf", URDF), ("meshes/a.obj", MESH)];
        for files in [whole, content] {
            let answer = drop_on(server, &files);
            assert_eq!(answer.status, 200, "{}", answer.text());
            let made: Value = serde_json::from_slice(&answer.body).expect("JSON");
            let id = made["robots"][0].as_str().expect("an id").to_owned();
            let answer = server.until(&id, is_whole);
            assert!(says_no_collision_alone(&answer["entry"]["notes"]), "{files:?}: {answer}");
            assert_eq!(answer["entry"]["temporary"], true);
        }
        let alone = drop_on(server, &[("arm.urdf", URDF)]);
        let made: Value = serde_json::from_slice(&alone.body).expect("JSON");
        let id = made["robots"][0].as_str().expect("an id").to_owned();
        let notes = server.until(&id, is_whole)["entry"]["notes"].to_string();
        assert!(notes.contains("was not found"), "{notes}");
    });
}

#[test]
fn no_path_leaves_the_folder_and_nothing_is_replaced() {
    let folder = testkit::temporary::folder();
    let within = folder.path().join("in");
    let collection = Collection::default().with_drops(within.clone(), false);
    let server = Running::with(collection);
    let long = "a/".repeat(5000) + "x.urdf";
    let wide = "a".repeat(3000) + ".urdf";
    for path in [
        "../x.urdf",
        "a/../../x.urdf",
        "/x.urdf",
        "//x.urdf",
        "a\\..\\x.urdf",
        "C:x.urdf",
        "a//x.urdf",
        "./x.urdf",
        "x.urdf/",
        "",
        ".",
        "..",
        "a\0.urdf",
        "a\n.urdf",
        &long,
        &wide,
    ] {
        let answer = drop_on(&server, &[("good.urdf", URDF), (path, "x")]);
        assert_eq!(answer.status, 400, "{path:?}: {}", answer.text());
    }
    let twice = [("a.urdf", URDF), ("a.urdf", URDF)];
    let inside = [("a.urdf", URDF), ("a.urdf/b.urdf", URDF)];
    let around = [("a/b.urdf", URDF), ("a", "x")];
    for files in [twice, inside, around] {
        let answer = drop_on(&server, &files);
        assert_eq!(answer.status, 400, "{files:?}");
        let told = "another file or folder of this drop has the same name\n";
        assert!(answer.text().ends_with(told), "{}", answer.text());
    }
    for bad in [
        &b"[]"[..],
        b"\n",
        b"{}\n",
        b"[{\"path\":\"a.urdf\",\"size\":5}]\nabc",
        b"[{\"path\":\"a.urdf\",\"size\":1}]\nabc",
        b"[{\"path\":\"a.urdf\",\"size\":-1}]\n",
        b"[{\"path\":\"a.urdf\",\"size\":18446744073709551615},{\"path\":\"b.urdf\",\"size\":4}]\nabc",
        b"[{\"path\":\"a.urdf\",\"size\":3,\"mode\":511}]\nabc",
    ] {
        assert_eq!(server.send("/drops", bad).status, 400, "{bad:?}");
    }
    let many = vec![("a.urdf", ""); 10_001];
    assert_eq!(drop_on(&server, &many).status, 400);
    assert_eq!(drop_on(&server, &[("a.txt", "x")]).status, 400);
    let refused = drop_on(&server, &[("a.urdf.xacro", URDF)]);
    assert_eq!(refused.status, 403);
    assert!(refused.text().contains("--xacro"), "{}", refused.text());
    // Nothing of all this is left, and nobody else may drop anything.
    assert_eq!(files(folder.path()), Vec::<String>::new());
    assert_eq!(server.json("/robots.json"), json!([]));
    let host = server.host();
    let answer = server.raw("POST /drops", &[("Host", &host)], &body(&[("a.urdf", URDF)]));
    assert_eq!(answer.status, 403);
    let other =
        [("Host", &*host), ("Origin", "http://evil.example"), ("X-Urdd-Token", &*server.token)];
    let answer = server.raw("POST /drops", &other, &body(&[("a.urdf", URDF)]));
    assert_eq!(answer.status, 403);
    assert_eq!(files(folder.path()), Vec::<String>::new());
}

/// A package of 1,500 folders, whose URDF names 20,000 packages that are not there.
fn vast() -> Vec<u8> {
    let meshes = (0..1500).map(|k| format!("vast/a{}/b{k}/{k}.obj", k % 90));
    let mut list: Vec<Value> =
        meshes.map(|path| json!({ "path": path, "size": MESH.len() })).collect();
    let named = (0..20_000).map(|k| {
        format!(
            r#"<visual><geometry><mesh filename="package://p{k}/m/{k}.obj"/></geometry></visual>"#
        )
    });
    let named: String = named.collect();
    let urdf = format!(r#"<robot name="vast"><link name="a">{named}</link></robot>"#);
    let content = MESH.repeat(list.len()) + &urdf;
    list.push(json!({ "path": "vast/vast.urdf", "size": urdf.len() }));
    format!("{}\n{content}", Value::from(list)).into_bytes()
}

/// A .zip of these files.
fn zipped(files: &[(&str, &[u8])]) -> Vec<u8> {
    let mut zip = zip::ZipWriter::new(Cursor::new(Vec::new()));
    let options = zip::write::SimpleFileOptions::default();
    for (path, bytes) in files {
        zip.start_file(*path, options).expect("a name");
        zip.write_all(bytes).expect("written");
    }
    zip.finish().expect("an archive").into_inner()
}

fn drop_zip(server: &Running, zip: &[u8]) -> Answer {
    let list = json!([{ "path": "arm.ZIP", "size": zip.len() }]);
    let mut body = format!("{list}\n").into_bytes();
    body.extend(zip);
    server.send("/drops", &body)
}

#[test]
fn a_zip_stands_for_the_files_in_it() {
    let folder = testkit::temporary::folder();
    let collection = Collection::default().with_drops(folder.path().join("in"), false);
    living(collection, |server| {
        let zip = zipped(&[
            ("package/urdf/arm.urdf", URDF.as_bytes()),
            ("package/meshes/a.obj", MESH.as_bytes()),
        ]);
        let answer = drop_zip(server, &zip);
        assert_eq!(answer.text(), r#"{"robots":["arm"]}"#);
        let made = server.until("arm", is_whole);
        assert!(says_no_collision_alone(&made["entry"]["notes"]), "{made}");
    });
}

#[test]
fn a_hostile_zip_is_refused_and_leaves_nothing() {
    let folder = testkit::temporary::folder();
    let collection = Collection::default().with_drops(folder.path().join("in"), false);
    let server = Running::with(collection);
    let vast = vec![b' '; 257 << 20];
    let inner = zipped(&[("arm.urdf", URDF.as_bytes())]);
    let mut cut = inner.clone();
    cut.truncate(inner.len() - 30);
    let cases: [(Vec<u8>, u16, &str); 6] = [
        (zipped(&[("../arm.urdf", URDF.as_bytes())]), 400, "../arm.urdf"),
        (zipped(&[("/arm.urdf", URDF.as_bytes())]), 400, "/arm.urdf"),
        (zipped(&[("arm.urdf", &vast)]), 400, "limit"),
        (zipped(&[("inner.zip", &inner)]), 400, "no .urdf"),
        (cut, 400, "cannot be read"),
        (b"PK nothing".to_vec(), 400, "cannot be read"),
    ];
    for (zip, status, word) in &cases {
        let answer = drop_zip(&server, zip);
        assert_eq!(answer.status, *status, "{}", answer.text());
        assert!(answer.text().contains(word), "{}", answer.text());
    }
    assert_eq!(files(folder.path()), Vec::<String>::new());
    assert_eq!(server.json("/robots.json"), json!([]));
}

#[test]
fn packages_that_are_not_there_take_seconds_and_not_minutes() {
    let folder = testkit::temporary::folder();
    let collection = Collection::default().with_drops(folder.path().join("in"), false);
    let server = Running::with(collection);
    let begun = Instant::now();
    let answer = server.send("/drops", &vast());
    assert_eq!(answer.text(), r#"{"robots":["vast"]}"#);
    let took = begun.elapsed();
    assert!(took < Duration::from_secs(20), "{took:?}");
}

#[test]
fn a_drop_that_the_page_takes_back_leaves_nothing() {
    let folder = testkit::temporary::folder();
    let within = folder.path().join("in");
    let collection = Collection::default().with_drops(within.clone(), false);
    let server = Running::with(collection);
    let body = vast();
    let mut stream = TcpStream::connect(("127.0.0.1", server.port)).expect("a connection");
    let (host, token, size) = (server.host(), &server.token, body.len());
    let head = format!(
        "POST /drops HTTP/1.1\r\nHost: {host}\r\nX-Urdd-Token: {token}\r\nContent-Length: {size}\r\n\r\n"
    );
    stream.write_all(head.as_bytes()).expect("sent");
    stream.write_all(&body).expect("sent");
    drop(stream);
    let begun = Instant::now();
    let is_empty = || fs::read_dir(&within).is_ok_and(|entries| entries.count() == 0);
    while !is_empty() {
        assert!(begun.elapsed() < Duration::from_secs(60), "it stays");
        std::thread::sleep(Duration::from_millis(20));
    }
    assert_eq!(server.json("/robots.json"), json!([]));
}

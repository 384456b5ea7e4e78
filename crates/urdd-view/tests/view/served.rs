//! What is served, and to whom.

use std::fs;

use urdd_validate::settings::Settings;

use super::asking::Running;
use testkit::robots::made_named;

#[test]
fn the_page_has_a_strict_policy_and_no_robot_in_it() {
    let (_folder, path) = made_named("gripper");
    let server = Running::on(&path);
    let answer = server.raw("GET /", &[("Host", &*server.host())], b"");
    assert_eq!(answer.status, 200);
    assert!(answer.text().contains(r#"content="live""#), "{}", answer.text());
    assert!(!answer.text().contains("gripper"));
    let policy = answer.header("content-security-policy").expect("a policy");
    assert!(policy.starts_with("default-src 'none';"), "{policy}");
    let unsafe_words: Vec<&str> =
        policy.split([' ', ';']).filter(|word| word.contains("unsafe")).collect();
    assert_eq!(unsafe_words, ["'wasm-unsafe-eval'"], "{policy}");
    assert_eq!(answer.header("x-content-type-options"), Some("nosniff"));
    assert_eq!(answer.header("cross-origin-resource-policy"), Some("same-origin"));
    for name in ["app.js", "editor.js", "worker.js", "style.css", "urdd.wasm"] {
        let line = format!("GET /{name}");
        let plain = server.raw(&line, &[("Host", &*server.host())], b"");
        assert_eq!((plain.status, plain.header("content-encoding")), (200, None), "{name}");
        let headers = [("Host", &*server.host()), ("Accept-Encoding", "gzip, br;q=1")];
        let short = server.raw(&line, &headers, b"");
        assert_eq!((short.status, short.header("content-encoding")), (200, Some("br")), "{name}");
        assert!(short.body.len() < plain.body.len(), "{name}");
    }
}

#[test]
fn files_and_the_report_are_those_on_disk() {
    let (_folder, path) = made_named("welding_arm");
    let server = Running::on(&path);
    let robots = server.json("/robots.json");
    assert_eq!(robots[0]["id"], "welding_arm");
    assert_eq!(robots[0]["writable"], true);
    let listed = server.json("/robots/welding_arm/files.json");
    let files = listed["files"].as_array().expect("a list");
    assert!(files.len() > 30, "{} files", files.len());
    for file in files {
        let name = file["path"].as_str().expect("a path");
        let content = fs::read(path.join(name)).expect("a file");
        let answer = server.get(&format!("/robots/welding_arm/files/{name}"));
        assert_eq!(answer.body, content, "{name}");
        assert_eq!(answer.header("content-type"), Some("application/octet-stream"));
    }
    let run = urdd_validate::validate(&[&path], &Settings::default()).expect("a run");
    let report = urdd_validate::report::json(&run.report).expect("a report");
    let served = server.get("/robots/welding_arm/report.json");
    assert_eq!(served.text(), report);
}

#[test]
fn the_revision_follows_the_files() {
    let (_folder, path) = made_named("gripper");
    let server = Running::on(&path);
    let revision = || server.json("/robots/gripper/revision.json")["revision"].clone();
    let first = revision();
    assert_eq!(first, revision());
    assert_eq!(first, server.json("/robots/gripper/files.json")["revision"]);
    fs::write(path.join("dof_module/VERSION"), "1.0.0 ").expect("written");
    let second = revision();
    assert_ne!(first, second);
    let report = server.json("/robots/gripper/report.json");
    assert!(report["totals"]["error"].as_u64() > Some(0), "the change is judged");
    fs::remove_dir_all(&path).expect("removed");
    assert_eq!(revision(), "gone");
    assert_eq!(server.get("/robots/gripper/files.json").status, 404);
}

#[test]
fn others_are_refused() {
    let (_folder, path) = made_named("gripper");
    let server = Running::on(&path);
    let (host, token) = (server.host(), server.token.clone());
    let own = format!("http://{host}");
    let refused = |line: &str, headers: &[(&str, &str)]| {
        let answer = server.raw(line, headers, b"{}");
        assert_eq!(answer.status, 403, "{line} {headers:?}: {}", answer.text());
        assert!(!answer.text().contains("gripper"), "{}", answer.text());
    };
    for line in [
        "GET /robots.json",
        "GET /robots/gripper/files.json",
        "GET /robots/gripper/files/urdd.json",
        "GET /robots/gripper/report.json",
        "GET /robots/gripper/revision.json",
        "GET /robots/nobody/files.json",
        "POST /robots/gripper/skips",
    ] {
        refused(line, &[("Host", &host)]);
        refused(line, &[("Host", &host), ("X-Urdd-Token", "0")]);
        refused(line, &[("Host", "evil.example"), ("X-Urdd-Token", &token)]);
        refused(line, &[("X-Urdd-Token", &token)]);
        let foreign =
            [("Host", &*host), ("Origin", "http://evil.example"), ("X-Urdd-Token", &*token)];
        refused(line, &foreign);
    }
    refused("GET /", &[("Host", "evil.example")]);
    refused("GET /app.js", &[("Host", &host), ("Sec-Fetch-Site", "cross-site")]);
    // A user who follows a link on any page reaches the page: its HTML, and nothing of a robot.
    let followed = [
        ("Host", &*host),
        ("Sec-Fetch-Site", "cross-site"),
        ("Sec-Fetch-Mode", "navigate"),
        ("Sec-Fetch-Dest", "document"),
    ];
    let page = server.raw("GET /", &followed, b"");
    assert_eq!(page.status, 200);
    assert!(!page.text().contains("gripper") && !page.text().contains(&*token));
    refused("POST /", &followed);
    refused("GET /app.js", &followed);
    refused("GET /robots.json", &followed);
    let framed = followed.map(|(name, value)| match name {
        "Sec-Fetch-Dest" => (name, "iframe"),
        _ => (name, value),
    });
    refused("GET /", &framed);
    let right = [("Host", &*host), ("Origin", &*own), ("X-Urdd-Token", &*token)];
    assert_eq!(server.raw("GET /robots.json", &right, b"").status, 200);
    assert_eq!(server.raw("DELETE /robots.json", &right, b"").status, 405);
}

#[test]
fn nothing_outside_of_the_urdd_is_read() {
    let (folder, path) = made_named("gripper");
    fs::write(folder.path().join("secret"), "secret").expect("written");
    #[cfg(unix)]
    std::os::unix::fs::symlink(folder.path().join("secret"), path.join("link")).expect("a link");
    let server = Running::on(&path);
    for rest in [
        "../secret",
        "%2e%2e/secret",
        "%2e%2e%2fsecret",
        "dof_module/../../secret",
        "..%5csecret",
        "link",
        "/etc/passwd",
        "%2fetc%2fpasswd",
        "dof_module",
        "nothing",
    ] {
        let answer = server.get(&format!("/robots/gripper/files/{rest}"));
        assert!(matches!(answer.status, 403 | 404), "{rest}: {}", answer.status);
        assert!(!answer.text().contains("secret\n") && answer.text() != "secret", "{rest}");
    }
}

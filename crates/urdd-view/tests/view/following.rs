//! Configurations that a program shows: who may send them, and what pages get.

use std::time::{Duration, Instant};

use serde_json::json;

use super::asking::Running;
use testkit::requests::{next, status};
use testkit::robots::made_named;

const STATES: &str = "/robots/gripper/states";

#[test]
fn pages_get_the_last_configuration_and_those_after_it() {
    let (_folder, path) = made_named("gripper");
    let server = Running::on(&path);
    let follows = || server.json("/robots.json")[0]["follows"].clone();
    assert_eq!(follows(), false);
    for q in [0.1, 0.2] {
        assert_eq!(server.post(STATES, &json!({ "q": [q] })).status, 204);
    }
    assert_eq!(follows(), true);
    let mut pages = [(); 2].map(|()| server.listen(STATES, &server.token));
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
    let (_folder, path) = made_named("gripper");
    let server = Running::on(&path);
    assert!(status(&mut server.listen(STATES, "0123")).contains("403"));
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
    let (_folder, path) = made_named("gripper");
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
    let (_folder, path) = made_named("gripper");
    let server = Running::on(&path);
    server.post(STATES, &json!({ "q": [0] }));
    let stalled: Vec<_> = (0..20).map(|_| server.listen(STATES, &server.token)).collect();
    let mut page = server.listen(STATES, &server.token);
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
        let mut page = server.listen(STATES, &server.token);
        status(&mut page);
        next(&mut page);
    }
}

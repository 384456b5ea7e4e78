//! The pictures on the cards of robots that nobody has opened.

use std::fs;
use std::path::Path;
use std::sync::Arc;
use std::thread;
use std::time::{Duration, Instant};

use urdd_directory::cancellation::Cancellation;
use urdd_generate::Settings;
use urdd_view::Live;

use super::asking::Running;
use super::living::{Quiet, of};
use testkit::requests::{PATIENCE, is_whole};
use testkit::urdfs::arm;

const PICTURE: &str = "/robots/arm/picture.png";

fn is_png(bytes: &[u8]) -> bool {
    bytes.starts_with(b"\x89PNG")
}

/// Acts on a server while its robots are drawn, and returns the files that are in the temporary folder then.
fn drawing(urdfs: &[&Path], act: impl FnOnce(&Running)) -> Vec<String> {
    drawing_after(Duration::from_millis(50), urdfs, act)
}

/// As [`drawing`], with a pause between the picture of a robot that is open and the rest of it.
fn drawing_after(pause: Duration, urdfs: &[&Path], act: impl FnOnce(&Running)) -> Vec<String> {
    let folder = testkit::temporary::folder();
    let settings = Settings::default();
    let collection = Arc::new(of(urdfs));
    let live = Live { folder: folder.path(), settings: &settings, observer: &Quiet, pause };
    thread::scope(|scope| {
        scope.spawn(|| live.run(&collection));
        let _ends = super::living::Ends(settings.source.cancellation.clone());
        act(&Running::with(Arc::clone(&collection)));
        testkit::files::below(folder.path()).into_keys().collect()
    })
}

#[test]
fn a_robot_that_nobody_opened_is_drawn_without_a_file() {
    let folder = testkit::temporary::folder();
    let urdf = folder.path().join("arm.urdf");
    fs::write(&urdf, arm(1.0, r#"<sphere radius="0.3"/>"#)).expect("written");
    let left = drawing(&[&urdf], |server| {
        let first = server.get(PICTURE);
        assert_eq!((first.status, is_png(&first.body)), (200, true));
        let entry = &server.json("/robots.json")[0];
        assert_eq!((&entry["ready"], &entry["failure"]), (&false.into(), &().into()));
        // It is kept until the URDF changes.
        assert_eq!(server.get(PICTURE).body, first.body);
        fs::write(&urdf, arm(1.0, r#"<sphere radius="2"/>"#)).expect("written");
        let other = server.get(PICTURE);
        assert!(is_png(&other.body) && other.body != first.body);
    });
    assert_eq!(left, Vec::<String>::new());
}

#[test]
fn a_robot_that_cannot_be_drawn_has_no_picture_and_no_failure() {
    let folder = testkit::temporary::folder();
    let urdf = folder.path().join("arm.urdf");
    fs::write(&urdf, "<robot name=").expect("written");
    drawing(&[&urdf], |server| {
        let answer = server.get(PICTURE);
        assert_eq!((answer.status, answer.body.len()), (204, 0));
        assert!(server.json("/robots.json")[0]["failure"].is_null());
        fs::write(&urdf, arm(1.0, r#"<sphere radius="0.3"/>"#)).expect("written");
        assert!(is_png(&server.get(PICTURE).body));
    });
}

/// The picture of the robot that is open is the same as that of its card.
#[test]
fn a_robot_that_is_open_comes_first() {
    let folder = testkit::temporary::folder();
    let [urdf, other] = ["arm.urdf", "other.urdf"].map(|name| folder.path().join(name));
    for file in [&urdf, &other] {
        fs::write(file, arm(1.0, r#"<sphere radius="0.3"/>"#)).expect("written");
    }
    // Longer than a card takes.
    drawing_after(Duration::from_secs(4), &[&urdf, &other], |server| {
        server.until("other", |answer| answer["entry"]["ready"] == true);
        let (card, whole) = thread::scope(|scope| {
            let card = scope.spawn(|| {
                let answer = server.get(PICTURE);
                (Instant::now(), answer.body)
            });
            server.until("other", is_whole);
            let whole = Instant::now();
            (card.join().expect("an answer"), whole)
        });
        assert!(is_png(&card.1));
        assert!(card.0 + Duration::from_millis(100) > whole, "the card was drawn first");
        let opened = server.get("/robots/other/picture.png");
        assert_eq!(opened.body, card.1);
    });
}

/// Requests that wait end with the program.
#[test]
fn nobody_waits_for_a_program_that_ended() {
    let folder = testkit::temporary::folder();
    let urdf = folder.path().join("arm.urdf");
    fs::write(&urdf, arm(1.0, r#"<sphere radius="0.3"/>"#)).expect("written");
    // Nothing draws here.
    let server = urdd_view::Server::bind(of(&[&urdf]), None).expect("a port");
    let requests = testkit::requests::Requests::to(&server.address());
    let ended = Cancellation::default();
    thread::scope(|scope| {
        scope.spawn(|| server.run(&ended));
        let answer = scope.spawn(|| requests.get(PICTURE).status);
        thread::sleep(Duration::from_millis(300));
        assert!(!answer.is_finished());
        let begun = Instant::now();
        ended.cancel();
        assert_eq!(answer.join().expect("an answer"), 204);
        assert!(begun.elapsed() < PATIENCE.min(Duration::from_secs(5)));
    });
}

//! Maps URLs to responses, and says what they and a site have of a robot.

use percent_encoding::percent_decode_str;
use serde_json::{Value, json};

use crate::collection::{Collection, MAX_DROP};
use crate::http::{Body, Reply};
use crate::report::{report_of, report_on};
use crate::shown::{Making, Shown};
use crate::{assets, picture, revision, save};
use urdd_directory::cancellation::Cancellation;
use urdd_directory::limits::MAX_FILE_BYTES;
use urdd_directory::root::{EntryKind, ReadError, Root};

/// The resource that a URL identifies.
#[derive(Debug, PartialEq, Eq)]
pub enum Route {
    Asset(String),
    Robots,
    Robot(String, Asked),
    /// Takes URDFs that were dropped on the page.
    Drops,
    Unknown,
}

#[derive(Debug, PartialEq, Eq)]
pub enum Asked {
    Revision,
    Files,
    Report,
    File(String),
    Summary,
    Picture,
    Skips,
    Configurations,
    /// Saves a generated robot.
    Keep,
    /// The configurations that a program shows of it.
    States,
}

impl Route {
    /// Parses a URL, still percent-encoded.
    pub fn of(url: &str) -> Self {
        let path = url.split(['?', '#']).next().unwrap_or_default();
        let Some(path) = path.strip_prefix('/') else { return Route::Unknown };
        // Decodes after splitting: an encoded slash would be part of a name, and no name contains one.
        let parts: Option<Vec<String>> = path
            .split('/')
            .map(|part| {
                let part = percent_decode_str(part).decode_utf8().ok()?;
                let is_plain = !part.contains(['/', '\\', '\0']) && part != "." && part != "..";
                is_plain.then(|| part.into_owned())
            })
            .collect();
        let Some(parts) = parts else { return Route::Unknown };
        let words: Vec<&str> = parts.iter().map(String::as_str).collect();
        match words.as_slice() {
            [""] => Route::Asset("index.html".to_owned()),
            ["robots.json"] => Route::Robots,
            ["drops"] => Route::Drops,
            [name] => Route::Asset((*name).to_owned()),
            ["robots", id, about @ ..] => match Asked::of(about) {
                Some(asked) => Route::Robot((*id).to_owned(), asked),
                None => Route::Unknown,
            },
            _ => Route::Unknown,
        }
    }

    /// Maximum size of a request body, in bytes.
    pub fn max_body(&self) -> u64 {
        match self {
            Route::Robot(_, Asked::Skips) => 64 << 20,
            Route::Robot(_, Asked::Configurations | Asked::States) => 1 << 20,
            Route::Robot(_, Asked::Keep) => 64 << 10,
            Route::Drops => MAX_DROP,
            _ => 0,
        }
    }

    /// Whether it is served without the token: only files that are the same on every machine.
    pub fn is_public(&self) -> bool {
        matches!(self, Route::Asset(_))
    }

    /// Whether it is the page's HTML, the target of links.
    pub fn is_entrance(&self) -> bool {
        matches!(self, Route::Asset(name) if name == "index.html")
    }
}

impl Asked {
    fn of(words: &[&str]) -> Option<Self> {
        Some(match words {
            ["revision.json"] => Asked::Revision,
            ["files.json"] => Asked::Files,
            ["report.json"] => Asked::Report,
            ["summary.json"] => Asked::Summary,
            ["picture.png"] => Asked::Picture,
            ["keep"] => Asked::Keep,
            ["configurations"] => Asked::Configurations,
            ["states"] => Asked::States,
            ["skips"] => Asked::Skips,
            ["files", path @ ..] if !path.is_empty() => Asked::File(path.join("/")),
            _ => return None,
        })
    }
}

/// The response to a read request that is not about one robot. `brotli` says whether the client accepts Brotli.
pub fn answer(collection: &Collection, route: &Route, brotli: bool) -> Reply {
    match route {
        Route::Asset(name) => asset(name, brotli),
        Route::Robots => {
            let robots = collection.robots();
            Reply::json(&robots.iter().map(|robot| entry(robot)).collect())
        }
        _ => no_page(),
    }
}

fn no_page() -> Reply {
    Reply::failure(404, "there is no such page\n")
}

pub fn cannot_be_done() -> Reply {
    Reply::failure(405, "this cannot be done here\n")
}

/// The response to a request about a robot whose files cannot be read.
pub fn unread(error: ReadError) -> Reply {
    let status = match error {
        ReadError::Missing | ReadError::NotAFile | ReadError::NotAUrdd => 404,
        ReadError::LeavesRoot | ReadError::Path(_) => 403,
        ReadError::Changed => 409,
        _ => 500,
    };
    Reply::failure(status, format!("{error}\n"))
}

/// The response to a request about a robot, by its method: GET, HEAD or POST.
pub fn answer_about(
    collection: &Collection,
    robot: &Shown,
    asked: (&str, &Asked),
    body: &[u8],
    ended: &Cancellation,
) -> Result<Reply, ReadError> {
    Ok(match asked {
        ("POST", Asked::Skips) => save::skips(robot, body),
        ("POST", Asked::Configurations) => save::configuration(robot, body),
        ("POST", Asked::States) => save::state(robot, body),
        ("POST", Asked::Keep) => save::keep(robot, body),
        ("POST", _) => cannot_be_done(),
        ("GET", Asked::States) => robot.states.stream(ended),
        (_, Asked::Revision) => {
            // Whoever asks for this shows the robot, or waits for it: see `live`.
            robot.see();
            // The entry first: a revision may be newer than what is said of the robot, and never older.
            let entry = entry(robot);
            let revision = robot.is_ready().then(|| revision::of(&robot.path()));
            Reply::json(&json!({ "revision": revision, "entry": entry }))
        }
        (_, Asked::Files) => {
            let (revision, opened) = robot.open()?;
            let name = opened.own.folder_name();
            let files = files(&opened.own)?;
            Reply::json(&json!({ "name": name, "files": files, "revision": revision }))
        }
        (_, Asked::Report) => Reply::json_text(report_of(collection, robot)),
        (_, Asked::File(path)) => {
            let (file, size) = robot.own_files()?.open_file(path)?;
            if size > MAX_FILE_BYTES {
                return Err(ReadError::TooLarge { size, limit: MAX_FILE_BYTES });
            }
            // Never displayed as a page.
            Reply::ok("application/octet-stream", Body::File(file, size))
        }
        (_, Asked::Summary) => Reply::json(&entry_with(robot, &report_of(collection, robot))),
        (_, Asked::Picture) => match picture_of(robot) {
            Some(bytes) => Reply::ok("image/png", Body::Bytes(bytes)),
            None => Reply::nothing(),
        },
        (_, Asked::Skips | Asked::Configurations | Asked::Keep | Asked::States) => no_page(),
    })
}

fn asset(name: &str, brotli: bool) -> Reply {
    let Some(asset) = assets::find(name) else { return no_page() };
    let body = match name {
        "index.html" => assets::live_page().map(String::into_bytes),
        _ if brotli => Ok(asset.brotli.to_vec()),
        _ => asset.bytes(),
    };
    match body {
        Ok(body) => Reply {
            brotli: brotli && name != "index.html",
            ..Reply::ok(asset.media_type, Body::Bytes(body))
        },
        Err(error) => Reply::failure(500, error.to_string()),
    }
}

/// An entry of `robots.json`.
pub fn entry(robot: &Shown) -> Value {
    let (making, failure) = match robot.making() {
        Making::Done | Making::Waiting => (Value::Null, Value::Null),
        Making::Running { what, done, of } => {
            (json!({ "what": what, "done": done, "of": of }), Value::Null)
        }
        Making::Failed(why) => (Value::Null, json!(why)),
    };
    json!({
        "id": robot.id,
        "name": robot.name,
        "writable": robot.is_writable(),
        "temporary": robot.is_temporary(),
        "ready": robot.is_ready(),
        "making": making,
        "failure": failure,
        "notes": robot.notes(),
        "follows": robot.states.are_sent(),
        "links": null,
        "dofs": null,
        "verdict": null,
        "findings": null,
        "picture": null,
    })
}

/// An entry of `robots.json` with the results of the report.
pub fn entry_with(robot: &Shown, report: &str) -> Value {
    let mut entry = entry(robot);
    let report: Value = serde_json::from_str(report).unwrap_or_default();
    let found = &report["urdds"][0];
    entry["links"] = found["size"]["links"].clone();
    entry["dofs"] = found["size"]["dofs"].clone();
    let has = |key: &str| found[key].as_array().is_some_and(|all| !all.is_empty());
    let is_in_part = has("geometry_not_verified") || found["model_not_verified"].is_object();
    entry["verdict"] = match found["verdict"].as_str() {
        Some("pass") if is_in_part => json!("part"),
        _ => found["verdict"].clone(),
    };
    let total = |key: &str| report["totals"][key].clone();
    entry["findings"] =
        json!({ "error": total("error"), "warning": total("warning"), "info": total("info") });
    entry
}

/// A robot as published: the URDD's own files, and the validator's report on them.
pub struct Published {
    pub root: Root,
    pub report: String,
    pub entry: Value,
}

pub fn published(robot: &Shown) -> Result<Published, ReadError> {
    let root = robot.open()?.1.own;
    let report =
        report_on(&root, &robot.name).unwrap_or_else(|error| json!({ "error": error }).to_string());
    let mut entry = entry_with(robot, &report);
    // A site is read-only, and notes name files of this machine.
    entry["writable"] = json!(false);
    entry["temporary"] = json!(false);
    entry["notes"] = json!([]);
    Ok(Published { root, report, entry })
}

/// The picture of a robot, if it has one. Rendered once for each revision.
pub fn picture_of(robot: &Shown) -> Option<Vec<u8>> {
    let mut known = robot.picture.lock();
    let (revision, opened) = robot.open().ok()?;
    if let Some((of, picture)) = known.as_ref()
        && *of == revision
    {
        return picture.clone();
    }
    // A robot that cannot be drawn has no picture. The page shows the reason.
    let drawn = picture::card(&opened.robot, &Cancellation::default());
    *known = Some((revision, drawn.clone()));
    drawn
}

fn files(root: &Root) -> Result<Value, ReadError> {
    let entries = root.list()?.entries.into_iter().filter(|entry| entry.kind == EntryKind::File);
    Ok(entries.map(|entry| json!({ "path": entry.path, "size": entry.size })).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn addresses() {
        let of_a = |asked: Asked| Route::Robot("a".to_owned(), asked);
        assert_eq!(Route::of("/"), Route::Asset("index.html".to_owned()));
        assert_eq!(Route::of("/app.js?1#2"), Route::Asset("app.js".to_owned()));
        assert_eq!(Route::of("/robots.json"), Route::Robots);
        assert_eq!(Route::of("/robots/a/files/b/c%20d"), of_a(Asked::File("b/c d".to_owned())));
        assert_eq!(Route::of("/robots/a/files.json"), of_a(Asked::Files));
    }

    #[test]
    fn addresses_that_lead_nowhere() {
        let bad = [
            "",
            "http://a/",
            "/robots/a/files/../x",
            "/robots/a/files/%2e%2e/x",
            "/robots/a/files/%2E%2E%2Fx",
            "/robots/a/files/..%5cx",
            "/robots/a/files/b%00",
            "/robots/a/files/%ff",
            "/robots/a/files",
            "/robots/a",
            "/x/y",
        ];
        for url in bad {
            assert_eq!(Route::of(url), Route::Unknown, "{url}");
        }
        assert!(Route::of("/app.js").is_public());
        assert!(!Route::of("/robots.json").is_public());
        assert!(!Route::of("/robots/a/files/b").is_public());
    }
}

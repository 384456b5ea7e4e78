//! Maps URLs to responses.

use percent_encoding::percent_decode_str;
use serde_json::{Value, json};

use crate::assets;
use crate::collection::{Collection, Making, Shown};
use crate::drops;
use crate::picture;
use crate::reply::{Body, Reply};
use crate::report::report_of;
use crate::revision;
use urdd_directory::root::{EntryKind, ReadError, Root};

/// Maximum size of a file that is sent, in bytes.
const MAX_FILE_BYTES: u64 = 1 << 30;

/// The resource that a URL identifies.
#[derive(Debug, PartialEq, Eq)]
pub enum Route {
    /// A file of the page.
    Asset(String),
    /// The list of robots.
    Robots,
    /// The fingerprint of a robot's files.
    Revision(String),
    /// The list of a robot's files.
    Files(String),
    /// The report of a robot.
    Report(String),
    /// A file of a robot.
    File(String, String),
    /// The gallery's summary of a robot.
    Summary(String),
    /// A small picture of a robot.
    Picture(String),
    /// Saves the skips of a robot.
    Skips(String),
    /// Saves a named configuration of a robot.
    Configurations(String),
    /// Saves a generated robot.
    Keep(String),
    /// The configurations that a program shows of a robot.
    States(String),
    /// Takes URDFs that were dropped on the page.
    Drops,
    /// No known resource.
    Unknown,
}

impl Route {
    /// Parses a URL, still percent-encoded.
    pub fn of(url: &str) -> Self {
        let path = url.split(['?', '#']).next().unwrap_or_default();
        let Some(path) = path.strip_prefix('/') else {
            return Route::Unknown;
        };
        // Decodes after splitting: an encoded slash would be part of a name, and no name contains one.
        let parts: Option<Vec<String>> = path
            .split('/')
            .map(|part| {
                let part = percent_decode_str(part).decode_utf8().ok()?;
                let is_plain = !part.contains(['/', '\\', '\0']) && part != "." && part != "..";
                is_plain.then(|| part.into_owned())
            })
            .collect();
        let Some(parts) = parts else {
            return Route::Unknown;
        };
        let words: Vec<&str> = parts.iter().map(String::as_str).collect();
        match words.as_slice() {
            [""] => Route::Asset("index.html".to_owned()),
            ["robots.json"] => Route::Robots,
            ["drops"] => Route::Drops,
            ["robots", id, "revision.json"] => Route::Revision((*id).to_owned()),
            ["robots", id, "files.json"] => Route::Files((*id).to_owned()),
            ["robots", id, "report.json"] => Route::Report((*id).to_owned()),
            ["robots", id, "summary.json"] => Route::Summary((*id).to_owned()),
            ["robots", id, "picture.png"] => Route::Picture((*id).to_owned()),
            ["robots", id, "keep"] => Route::Keep((*id).to_owned()),
            ["robots", id, "configurations"] => Route::Configurations((*id).to_owned()),
            ["robots", id, "states"] => Route::States((*id).to_owned()),
            ["robots", id, "skips"] => Route::Skips((*id).to_owned()),
            ["robots", id, "files", rest @ ..] if !rest.is_empty() => {
                Route::File((*id).to_owned(), rest.join("/"))
            }
            [name] => Route::Asset((*name).to_owned()),
            _ => Route::Unknown,
        }
    }

    /// Maximum size of a request body, in bytes.
    pub fn max_body(&self) -> u64 {
        match self {
            Route::Skips(_) => 64 << 20,
            Route::Configurations(_) | Route::States(_) => 1 << 20,
            Route::Keep(_) => 64 << 10,
            Route::Drops => drops::MAX_BODY,
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

/// The response to a read request. `brotli` says whether the client accepts Brotli.
pub fn answer(collection: &Collection, route: &Route, brotli: bool) -> Reply {
    let with = |id: &str, answer: &dyn Fn(&Shown) -> Result<Reply, ReadError>| {
        let Some(robot) = collection.find(id) else {
            return Reply::failure(404, "there is no such robot\n");
        };
        answer(&robot).unwrap_or_else(|error| failure(&error))
    };
    match route {
        Route::Asset(name) => asset(name, brotli),
        Route::Robots => {
            let robots = collection.robots();
            Reply::json(&robots.iter().map(|robot| entry(robot)).collect())
        }
        Route::Revision(id) => with(id, &|robot| {
            // Whoever asks for this shows the robot, or waits for it: see `live`.
            robot.see();
            // The entry first: a revision may be newer than what is said of the robot, and never older.
            let entry = entry(robot);
            let revision = robot.is_ready().then(|| revision::of(&robot.path()));
            Ok(Reply::json(&json!({ "revision": revision, "entry": entry })))
        }),
        Route::Files(id) => with(id, &|robot| {
            let (revision, opened) = robot.open()?;
            Ok(Reply::json(&json!({
                "name": opened.own.folder_name(),
                "files": files(&opened.own)?,
                "revision": revision,
            })))
        }),
        Route::Report(id) => with(id, &|robot| Ok(Reply::json_text(report_of(collection, robot)))),
        Route::File(id, path) => with(id, &|robot| {
            let (file, size) = robot.own_files()?.open_file(path)?;
            match size > MAX_FILE_BYTES {
                true => Err(ReadError::TooLarge { size, limit: MAX_FILE_BYTES }),
                false => Ok(Reply::file(file, size)),
            }
        }),
        Route::Summary(id) => {
            with(id, &|robot| Ok(Reply::json(&entry_with(robot, &report_of(collection, robot)))))
        }
        Route::Picture(id) => with(id, &|robot| {
            Ok(match picture_of(robot) {
                Some(bytes) => Reply::picture(bytes),
                None => Reply::nothing(),
            })
        }),
        Route::Skips(_)
        | Route::Configurations(_)
        | Route::Keep(_)
        | Route::States(_)
        | Route::Drops
        | Route::Unknown => Reply::failure(404, "there is no such page\n"),
    }
}

fn failure(error: &ReadError) -> Reply {
    let status = match error {
        ReadError::Missing | ReadError::NotAFile | ReadError::NotAUrdd => 404,
        ReadError::LeavesRoot | ReadError::Path(_) => 403,
        ReadError::Changed => 409,
        _ => 500,
    };
    Reply::failure(status, format!("{error}\n"))
}

fn asset(name: &str, brotli: bool) -> Reply {
    let Some(asset) = assets::find(name) else {
        return Reply::failure(404, "there is no such page\n");
    };
    let body = match name {
        "index.html" => assets::live_page().map(String::into_bytes),
        _ if brotli => Ok(asset.brotli.to_vec()),
        _ => asset.bytes(),
    };
    match body {
        Ok(body) => Reply {
            status: 200,
            media_type: asset.media_type,
            brotli: brotli && name != "index.html",
            body: Body::Bytes(body),
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
    entry["verdict"] = found["verdict"].clone();
    let total = |key: &str| report["totals"][key].clone();
    entry["findings"] =
        json!({ "error": total("error"), "warning": total("warning"), "info": total("info") });
    entry
}

/// The picture of a robot, if it has one. Rendered once for each revision.
pub fn picture_of(robot: &Shown) -> Option<Vec<u8>> {
    let mut known = robot.picture.lock().unwrap_or_else(std::sync::PoisonError::into_inner);
    let (revision, opened) = robot.open().ok()?;
    if let Some((of, picture)) = known.as_ref()
        && *of == revision
    {
        return picture.clone();
    }
    // A robot that cannot be drawn has no picture. The page shows the reason.
    let drawn = picture::png(&opened.robot).ok().flatten();
    *known = Some((revision, drawn.clone()));
    drawn
}

/// The path and size of each file below a root.
///
/// # Errors
/// If they cannot be listed.
fn files(root: &Root) -> Result<Value, ReadError> {
    let entries = root.list()?.entries;
    let files = entries.iter().filter(|entry| entry.kind == EntryKind::File);
    Ok(files.map(|entry| json!({ "path": entry.path, "size": entry.size })).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn addresses() {
        let file = |path: &str| Route::File("a".to_owned(), path.to_owned());
        assert_eq!(Route::of("/"), Route::Asset("index.html".to_owned()));
        assert_eq!(Route::of("/app.js?1#2"), Route::Asset("app.js".to_owned()));
        assert_eq!(Route::of("/robots.json"), Route::Robots);
        assert_eq!(Route::of("/robots/a/files/b/c%20d"), file("b/c d"));
        assert_eq!(Route::of("/robots/a/files.json"), Route::Files("a".to_owned()));
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

//! The page and one robot in a single HTML file, which opens from disk or in a notebook frame. It contains the robot's
//! data that the page needs, not every file of the URDD.

use std::collections::BTreeSet;
use std::io::{self, Cursor, Write};
use std::path::Path;

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use flate2::Compression;
use flate2::write::DeflateEncoder;
use serde_json::{Value, json};
use sha2::{Digest, Sha256};
use zip::CompressionMethod;
use zip::write::{SimpleFileOptions, ZipWriter};

use crate::assets;
use crate::report::meanings;
use crate::route::{Published, published};
use crate::shown::Shown;
use crate::site::{ExportError, unread};
use urdd_directory::limits::MAX_DOCUMENT_BYTES;
use urdd_directory::regular;
use urdd_directory::root::{EntryKind, ReadError, Root};
use urdd_format::hexadecimal::hexadecimal;
use urdd_format::registry::ModuleKind;

/// Maximum size of a robot in a page, in bytes.
const MAX_ROBOT_BYTES: u64 = 100_000_000;

/// Unpacks the page's program and runs it.
const START: &str = include_str!("one_file.js");

/// The beginning of a page's last line.
const SEAL: &str = "<!-- written by urdd; SHA-256 of what is above: ";

/// The last line of a page, which identifies an unchanged page.
fn seal(above: &str) -> String {
    let hash = hexadecimal(&Sha256::digest(above));
    format!("{SEAL}{hash} -->\n")
}

/// Whether a page may be written to a path: there is no file, or it is empty, or an unchanged page of [`page_with`].
pub fn may_hold_page(file: &Path) -> bool {
    if !file.is_file() {
        return true;
    }
    let read = regular::read(file, 2 * MAX_ROBOT_BYTES).ok();
    let Some(page) = read.and_then(|bytes| String::from_utf8(bytes).ok()) else { return false };
    let is_sealed = |at| {
        let (above, last) = page.split_at(at);
        seal(above) == last
    };
    page.is_empty() || page.rfind(SEAL).is_some_and(is_sealed)
}

/// The page with a robot in it, as HTML. It requests nothing else, and needs no origin: a frame may be sandboxed with
/// `allow-scripts` only. `showing` is what it shows of the robot: a JSON object with the keys `q`, `world` and `path`, as
/// `page/src/showing.ts` has them.
///
/// # Errors
/// [`ExportError`]; [`ExportError::TooLarge`] if the robot is too large for a page.
pub fn page_with(robot: &Shown, showing: Option<&str>) -> Result<String, ExportError> {
    let asset = |name: &str| {
        let found = assets::find(name).map_or_else(|| Ok(Vec::new()), assets::Asset::bytes);
        found.map_err(ExportError::Page)
    };
    let text = |name: &str| {
        let text = String::from_utf8(asset(name)?).map_err(io::Error::other);
        text.map_err(ExportError::Page)
    };
    let (index, script, style) = (text("index.html")?, text("app.js")?, text("style.css")?);
    let hash = |text: &str| format!("'sha256-{}'", STANDARD.encode(Sha256::digest(text)));
    let policy = format!(
        "default-src 'none'; script-src {} {} 'wasm-unsafe-eval'; style-src {}; connect-src blob: data:; \
         img-src blob: data:; worker-src blob:; base-uri 'none'; form-action 'none'",
        hash(START),
        hash(&script),
        hash(&style),
    );
    let Published { root, report, mut entry } =
        published(robot).map_err(|error| unread(robot, error))?;
    let (zip, left_out) = archive(robot, &root)?;
    entry["left_out"] = json!(left_out);
    let mut carried = String::new();
    let mut carry = |id: &str, packed: &[u8]| {
        let text = STANDARD.encode(packed);
        carried.push_str(&format!("<script type=\"text/plain\" id=\"{id}\">{text}</script>\n"));
    };
    let rules = meanings(&serde_json::from_str(&report).unwrap_or_default());
    for (id, bytes) in [
        ("robots.json", json!([entry]).to_string().into_bytes()),
        ("rules.json", rules.to_string().into_bytes()),
        ("report.json", report.into_bytes()),
        ("robot.zip", zip),
        ("app.js", script.into_bytes()),
        ("worker.js", asset("worker.js")?),
    ] {
        carry(id, &deflated(&bytes).map_err(ExportError::Page)?);
    }
    if let Some(showing) = showing {
        carry("showing.json", &deflated(showing.as_bytes()).map_err(ExportError::Page)?);
    }
    carry("urdd.wasm", assets::ROBOT_MODULE.brotli);
    let mut page = String::new();
    for line in index.lines() {
        let of_page = line.trim_start();
        if of_page.starts_with("<meta name=\"urdd-mode\"") {
            page.push_str("<meta name=\"urdd-mode\" content=\"inline\" />");
        } else if of_page.starts_with("<meta http-equiv=\"Content-Security-Policy\"") {
            page +=
                &format!("<meta http-equiv=\"Content-Security-Policy\" content=\"{policy}\" />");
        } else if of_page.starts_with("<link rel=\"stylesheet\"") {
            page += &format!("<style>{style}</style>");
        } else if of_page.starts_with("<script src=") {
            continue;
        } else if of_page.starts_with("</body>") {
            page += &format!("{carried}<script>{START}</script>\n</body>");
        } else {
            page.push_str(line);
        }
        page.push('\n');
    }
    page.push_str(&seal(&page));
    Ok(page)
}

fn deflated(bytes: &[u8]) -> io::Result<Vec<u8>> {
    let mut encoder = DeflateEncoder::new(Vec::new(), Compression::best());
    encoder.write_all(bytes)?;
    encoder.finish()
}

/// The files that the page needs, in an archive, and the original meshes that it leaves out: it draws the plain ones.
fn archive(robot: &Shown, root: &Root) -> Result<(Vec<u8>, Vec<String>), ExportError> {
    let unread = |error: ReadError| unread(robot, error);
    let listing = root.list().map_err(unread)?;
    let files = || listing.entries.iter().filter(|entry| entry.kind == EntryKind::File);
    let needed = needed(root, &files().map(|file| file.path.as_str()).collect());
    let is_needed = |path: &str| needed.contains(path);
    let originals = files().filter(|file| is_below(&file.path, ModuleKind::OriginalMeshes));
    let left_out = originals.filter(|file| !is_needed(&file.path)).map(|file| file.path.clone());
    let left_out = left_out.collect();
    let size = files().filter(|file| is_needed(&file.path)).map(|file| file.size).sum();
    if size > MAX_ROBOT_BYTES {
        return Err(ExportError::TooLarge(robot.name.clone(), size));
    }
    let mut zip = ZipWriter::new(Cursor::new(Vec::new()));
    // Stored: the archive is compressed as a whole.
    let options = SimpleFileOptions::default().compression_method(CompressionMethod::Stored);
    let failed = |error: zip::result::ZipError| ExportError::Page(io::Error::other(error));
    for path in needed {
        match root.read(path, MAX_ROBOT_BYTES) {
            Ok(mut bytes) => {
                if path.ends_with(".glb") {
                    round_normals(&mut bytes);
                }
                zip.start_file(path, options).map_err(failed)?;
                zip.write_all(&bytes).map_err(ExportError::Page)?;
            }
            Err(ReadError::Path(_)) => {}
            Err(error) => return Err(unread(error)),
        }
    }
    Ok((zip.finish().map_err(failed)?.into_inner(), left_out))
}

/// Rounds the normals in a .glb written by urdd to multiples of 1/128: an invisible change of less than half a degree,
/// and they deflate to a third. Positions, indices and all other files are unchanged.
fn round_normals(glb: &mut [u8]) -> Option<()> {
    let number = |value: &Value| usize::try_from(value.as_u64()?).ok();
    let length = u32::from_le_bytes(glb.get(12..16)?.try_into().ok()?) as usize;
    let json: Value = serde_json::from_slice(glb.get(20..)?.get(..length)?).ok()?;
    // Other writers may interleave attributes.
    if json["asset"]["generator"] != "urdd" {
        return None;
    }
    let data = glb.get_mut(28 + length..)?;
    // Do not trust the generator field: bounds the work to each byte once on average.
    let mut left = data.len();
    for primitive in json["meshes"][0]["primitives"].as_array()? {
        let accessor = &json["accessors"][number(&primitive["attributes"]["NORMAL"])?];
        let view = &json["bufferViews"][number(&accessor["bufferView"])?];
        let length = number(&view["byteLength"])?;
        left = left.checked_sub(length)?;
        let normals = data.get_mut(number(&view["byteOffset"])?..)?;
        for bytes in normals.get_mut(..length)?.chunks_exact_mut(4) {
            let x = f32::from_le_bytes((&*bytes).try_into().ok()?);
            // Turns -0 into 0.
            let rounded = (x * 128.0).round() / 128.0 + 0.0;
            bytes.copy_from_slice(&rounded.to_le_bytes());
        }
    }
    Some(())
}

/// The files of a URDD that the page reads: one format of each mesh, one copy of each document, and the original meshes
/// that the page draws.
fn needed<'a>(root: &Root, all: &BTreeSet<&'a str>) -> BTreeSet<&'a str> {
    use ModuleKind::{ConvexDecompositionMeshes, ConvexHullMeshes, PlainMeshes};
    let derived = [PlainMeshes, ConvexHullMeshes, ConvexDecompositionMeshes];
    let stem = |path: &str| -> Option<(ModuleKind, String)> {
        let kind = derived.iter().find(|kind| is_below(path, **kind))?;
        let name = path.rsplit('/').next()?;
        Some((*kind, name.rsplit_once('.')?.0.to_owned()))
    };
    let glb = all.iter().filter(|path| path.ends_with(".glb"));
    let with_glb: BTreeSet<(ModuleKind, String)> = glb.filter_map(|path| stem(path)).collect();
    let drawn = drawn_originals(root);
    let is_needed = |path: &&str| {
        if path.ends_with("/module.yaml") {
            return false;
        }
        if path.ends_with(".stl") || path.ends_with(".obj") {
            let other = stem(path);
            if other.is_some_and(|other| with_glb.contains(&other)) {
                return false;
            }
        }
        match &drawn {
            Some(drawn) if is_below(path, ModuleKind::OriginalMeshes) => {
                path.ends_with("/module.json")
                    || path.ends_with("/VERSION")
                    || drawn.contains(*path)
            }
            _ => true,
        }
    };
    all.iter().copied().filter(|path| is_needed(path)).collect()
}

fn is_below(path: &str, kind: ModuleKind) -> bool {
    let rest = path.strip_prefix(kind.folder());
    rest.is_some_and(|rest| rest.starts_with('/'))
}

/// The original meshes that the page reads: those of collision elements, and the visual ones of links with a texture.
/// Other links look the same as plain meshes. `None` if the module does not list them.
fn drawn_originals(root: &Root) -> Option<BTreeSet<String>> {
    let path = format!("{}/module.json", ModuleKind::OriginalMeshes.folder());
    let bytes = root.read(&path, MAX_DOCUMENT_BYTES).ok()?;
    let module: Value = serde_json::from_slice(&bytes).ok()?;
    let side_files = |path: &str| -> Vec<&str> {
        let files = module["files"].as_array().into_iter().flatten();
        let mut own = files.filter(|file| file["path"] == path);
        let listed = own.next().and_then(|file| file["side_files"].as_array());
        listed.into_iter().flatten().filter_map(Value::as_str).collect()
    };
    let references = module["references"].as_array()?;
    let with_path = || references.iter().filter_map(|it| Some((it, it["path"].as_str()?)));
    let is_visual = |reference: &Value| reference["geometry"] == "Visual";
    let textured: BTreeSet<u64> = with_path()
        .filter(|(reference, path)| is_visual(reference) && !side_files(path).is_empty())
        .filter_map(|(reference, _)| reference["link_idx"].as_u64())
        .collect();
    let mut drawn = BTreeSet::new();
    for (reference, path) in with_path() {
        let link = reference["link_idx"].as_u64();
        if !is_visual(reference) || link.is_some_and(|link| textured.contains(&link)) {
            drawn.insert(path.to_owned());
            drawn.extend(side_files(path).into_iter().map(str::to_owned));
        }
    }
    Some(drawn)
}

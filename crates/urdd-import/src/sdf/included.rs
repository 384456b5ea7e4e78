//! Finds what an `<include>` names.

use nalgebra::Isometry3;

use super::super::fault::Unreachable;
use super::super::features;
use super::super::refusal::{Fallible, Placing, at};
use super::assets::LOOKED_AT;
use super::fault::SdfFault;
use super::reader::SdfReader;
use super::tag::{Tag, is_true};
use urdd_directory::limits::MAX_MANIFEST_BYTES;
use urdd_source::{FoundMesh, NotFound};
use urdd_xml::{Mended, parse_leniently};

/// The files that say which file of a folder is the model.
const MANIFESTS: &[&str] = &["model.config", "manifest.xml"];
/// What an `<include>` says of a model.
const KNOWN: &[&str] = &["uri", "name", "pose", "placement_frame", "static", "plugin"];

/// What an `<include>` says of the model that it includes.
#[derive(Debug, Default, Clone)]
pub struct Overrides {
    pub name: Option<String>,
    pub pose: Option<(Isometry3<f64>, Option<String>)>,
    pub placement: Option<String>,
    pub is_static: Option<bool>,
    /// Its elements take part in the scope around it.
    pub is_merged: bool,
}

/// A file, and what is said of the model in it.
pub struct Included {
    pub file: FoundMesh,
    pub overrides: Overrides,
}

/// Finds the file that an `<include>` names.
///
/// # Errors
/// If there is none, or what it says is not read.
pub fn included(reader: &mut SdfReader, tag: Tag) -> Fallible<Included> {
    let Some(uri) = tag.words("uri") else {
        return tag.lacks("uri");
    };
    if tag.child("experimental:params").is_some() {
        return Err(at(tag.place(), SdfFault::Params));
    }
    tag.unread(KNOWN, &mut reader.tally);
    let pose = tag.child("pose").map(|_| tag.pose()).transpose()?;
    reader.tally.count(features::INCLUDES);
    Ok(Included {
        file: find(reader, tag, &uri)?,
        overrides: Overrides {
            name: tag.words("name"),
            pose,
            placement: tag.words("placement_frame"),
            is_static: tag.words("static").map(|text| is_true(&text)),
            is_merged: tag.says("merge"),
        },
    })
}

/// The file of a URI: itself, or the model of the folder that it names. libsdformat looks for what is behind any scheme,
/// or without one, where it looks for models.
///
/// # Errors
/// If there is none, or it may not be read.
pub fn find(reader: &SdfReader, tag: Tag, uri: &str) -> Fallible<FoundMesh> {
    let missing = match find_as(reader, tag, uri)? {
        Ok(found) => return Ok(found),
        Err(missing) => missing,
    };
    if missing.outside.is_some() {
        return Err(at(tag.place(), Unreachable::of(uri, missing)));
    }
    let bare = uri.split_once("://").map_or(uri, |(_, rest)| rest).trim_start_matches("./");
    let model = format!("model://{bare}");
    if !bare.starts_with('/')
        && model != uri
        && let Ok(found) = find_as(reader, tag, &model)?
    {
        return Ok(found);
    }
    let (uri, why) = (uri.to_owned(), missing.in_words());
    Err(at(tag.place(), SdfFault::NoInclude { uri, why }))
}

/// The file of a name as it is written.
fn find_as(reader: &SdfReader, tag: Tag, uri: &str) -> Fallible<Result<FoundMesh, NotFound>> {
    let folder = reader.folder(tag.file);
    reader.charge(LOOKED_AT * (uri.len() + folder.as_os_str().len()), tag.place())?;
    let gate = reader.gate;
    // A folder is not a file, but may have a manifest.
    let missing = match gate.find_from(uri, &folder) {
        Ok(found) => return Ok(Ok(found)),
        Err(missing) => missing,
    };
    let trimmed = uri.trim_end_matches('/');
    for manifest in MANIFESTS {
        let Ok(manifest) = gate.find_from(&format!("{trimmed}/{manifest}"), &folder) else {
            continue;
        };
        let Ok(bytes) = gate.bytes(&manifest, MAX_MANIFEST_BYTES) else { continue };
        reader.charge(bytes.len(), tag.place())?;
        let text = String::from_utf8_lossy(&bytes);
        if let Some((model, folder)) = newest(&text).zip(manifest.file.parent()) {
            let path = folder.join(model);
            let shown = path.display().to_string();
            let found = gate.at(&path).map_err(|why| Unreachable::of(&shown, why));
            return found.map(Ok).at(tag.place());
        }
    }
    Ok(Err(missing))
}

/// The file of the newest version that a manifest names.
fn newest(text: &str) -> Option<String> {
    let mended = Mended::default();
    let document = parse_leniently(text, "model", &mended).ok()?;
    let files = document.root_element().children().filter(|child| child.has_tag_name("sdf"));
    let files = files.filter_map(|file| {
        let version = file.attribute("version").unwrap_or_default().trim();
        let minor: u32 = version.strip_prefix("1.").and_then(|minor| minor.parse().ok())?;
        Some((minor, file.text()?.trim().to_owned()))
    });
    files.max_by_key(|(minor, _)| *minor).map(|(_, file)| file)
}

//! Paths in documents (SPEC 2.8): relative to the URDD's root, portable, never outside it.

use thiserror::Error;

/// What is wrong with a path in a document.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Error)]
#[expect(missing_docs, reason = "the messages say it")]
pub enum PathFault {
    #[error("the path is empty")]
    Empty,
    #[error("the path is absolute; write it relative to the URDD's root")]
    Absolute,
    #[error("the path has an empty part; write single slashes, and none at the end")]
    EmptyPart,
    #[error("the path has a `.` or `..` part; write it straight from the URDD's root")]
    DotPart,
    #[error("the path has a backslash; separate parts with forward slashes")]
    Backslash,
    #[error(
        "the path has a colon, as a drive letter or URI has; write it relative to the URDD's root"
    )]
    Colon,
    #[error("the path has a control character")]
    ControlCharacter,
    #[error("the path is listed both as a file and as a folder")]
    Taken,
}

/// Checks that SPEC 2.8 allows a path.
///
/// # Errors
/// The first fault, from the left.
pub fn check(path: &str) -> Result<(), PathFault> {
    if path.is_empty() {
        return Err(PathFault::Empty);
    }
    if path.starts_with('/') {
        return Err(PathFault::Absolute);
    }
    for part in path.split('/') {
        match part {
            "" => return Err(PathFault::EmptyPart),
            "." | ".." => return Err(PathFault::DotPart),
            _ => {}
        }
        for character in part.chars() {
            match character {
                '\\' => return Err(PathFault::Backslash),
                ':' => return Err(PathFault::Colon),
                c if c.is_control() => return Err(PathFault::ControlCharacter),
                _ => {}
            }
        }
    }
    Ok(())
}

/// Makes a name usable as a part of a path: replaces what SPEC 2.8 forbids by `_`.
pub fn portable(name: &str) -> String {
    let allowed = |c: char| match c {
        '\\' | ':' | '/' => '_',
        c if c.is_control() => '_',
        c => c,
    };
    match name.chars().map(allowed).collect::<String>() {
        dots if dots.is_empty() || dots == "." || dots == ".." => "_".to_owned(),
        name => name,
    }
}

/// Maximum length of a file name that this program makes, in bytes. File systems take 255.
pub const LONGEST_NAME: usize = 240;

/// Makes a file name of any name, for every file system: without characters, ends and names of devices that Windows
/// refuses, and at most [`LONGEST_NAME`] bytes long with its ending, such as `.urdf`.
pub fn file_name(stem: &str, ending: &str) -> String {
    let mut name = portable(stem).replace(['<', '>', '"', '|', '?', '*'], "_");
    while name.len() + ending.len() > LONGEST_NAME && name.pop().is_some() {}
    name += ending;
    if name.ends_with(['.', ' ']) {
        name.pop();
        name.push('_');
    }
    if is_device(&name) { format!("_{name}") } else { name }
}

/// Whether Windows has a device of that name, whatever its extension.
pub fn is_device(name: &str) -> bool {
    let stem = name.split('.').next().unwrap_or_default().trim_end().to_ascii_lowercase();
    let numbered = ["com", "lpt"].iter().find_map(|port| stem.strip_prefix(port));
    let is_digit = |number: &str| number.chars().all(|c| matches!(c, '0'..='9' | '¹' | '²' | '³'));
    matches!(stem.as_str(), "con" | "prn" | "aux" | "nul" | "conin$" | "conout$")
        || numbered.is_some_and(|number| number.chars().count() == 1 && is_digit(number))
}

/// The path of a file that a mesh names (SPEC 7.5): from the mesh's own folder, with portable names. `None` if it leads
/// out of the root.
pub fn beside(mesh: &str, named: &str) -> Option<String> {
    let mut parts: Vec<String> = mesh.split('/').map(str::to_owned).collect();
    parts.pop();
    for part in named.replace('\\', "/").split('/') {
        match part {
            "" | "." => {}
            ".." => {
                parts.pop()?;
            }
            name => parts.push(portable(name)),
        }
    }
    Some(parts.join("/"))
}

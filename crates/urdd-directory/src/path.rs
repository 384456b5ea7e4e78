//! Paths in documents (SPEC 2.8): relative to the URDD's root, portable, never outside it.

use thiserror::Error;

/// What is wrong with a path in a document.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Error)]
pub enum PathFault {
    /// An empty path.
    #[error("the path is empty")]
    Empty,
    /// Begins with `/`.
    #[error("the path is absolute; write it relative to the URDD's root")]
    Absolute,
    /// An empty part: `a//b`, or a slash at the end.
    #[error("the path has an empty part; write single slashes, and none at the end")]
    EmptyPart,
    /// A part that is `.` or `..`.
    #[error("the path has a `.` or `..` part; write it straight from the URDD's root")]
    DotPart,
    /// A backslash.
    #[error("the path has a backslash; separate parts with forward slashes")]
    Backslash,
    /// A colon, as in a drive letter or a URI.
    #[error(
        "the path has a colon, as a drive letter or URI has; write it relative to the URDD's root"
    )]
    Colon,
    /// A control character.
    #[error("the path has a control character")]
    ControlCharacter,
    /// The path of another file, or of a folder.
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

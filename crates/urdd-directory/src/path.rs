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

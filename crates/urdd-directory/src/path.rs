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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_fault_is_told_apart() {
        for (path, fault) in [
            ("", PathFault::Empty),
            ("/etc/passwd", PathFault::Absolute),
            ("a//b", PathFault::EmptyPart),
            ("a/", PathFault::EmptyPart),
            ("a/../b", PathFault::DotPart),
            ("./a", PathFault::DotPart),
            ("a\\b", PathFault::Backslash),
            ("C:/a", PathFault::Colon),
            ("a/b\n", PathFault::ControlCharacter),
        ] {
            assert_eq!(check(path), Err(fault), "{path:?}");
        }
    }

    #[test]
    fn dots_and_spaces_within_a_part_are_fine() {
        for path in ["a", "a/b.stl", "..a/b..", "ä b/c", ".gitattributes"] {
            assert_eq!(check(path), Ok(()), "{path:?}");
        }
    }

    #[test]
    fn what_is_made_portable_is_one_sound_part() {
        for (name, part) in [
            ("a b.stl", "a b.stl"),
            ("a\\b/c:d\n", "a_b_c_d_"),
            ("", "_"),
            (".", "_"),
            ("..", "_"),
            ("..a", "..a"),
        ] {
            assert_eq!(portable(name), part);
            assert_eq!(check(part), Ok(()));
        }
    }

    #[test]
    fn what_a_mesh_names_is_found_from_its_folder() {
        let of = |named| beside("m/meshes/arm/base.obj", named);
        assert_eq!(of("base.mtl").as_deref(), Some("m/meshes/arm/base.mtl"));
        assert_eq!(of("./../tex\\a.png").as_deref(), Some("m/meshes/tex/a.png"));
        assert_eq!(of("/tex//a:b.png").as_deref(), Some("m/meshes/arm/tex/a_b.png"));
        assert_eq!(of("../../../../a.png"), None);
    }
}

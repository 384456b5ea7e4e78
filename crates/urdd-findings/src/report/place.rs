//! Paths of URDDs relative to the working directory, for tools that show a report beside the files. Reports contain no
//! absolute paths.

use std::path::{Component, Path, PathBuf};

use crate::run::Run;
use urdd_format::report::Urdd;

/// The folder of every URDD of a run, relative to `current`, with forward slashes: empty if it is `current` itself. For
/// a URDD outside of `current`, its name.
pub fn places(run: &Run, current: &Path) -> Vec<String> {
    let urdds = run.report.urdds.iter().zip(&run.folders);
    let place = |(urdd, folder): (&Urdd, &PathBuf)| {
        relative(folder, current).unwrap_or_else(|| urdd.path.clone())
    };
    urdds.map(place).collect()
}

/// Path of a file of the URDD at `place`, relative to the same folder as `place`. The URDD's folder if `file` is `None`
/// or leads outside of that folder.
pub fn file_in(place: &str, file: Option<&str>) -> String {
    let folder = |place: &str| match place {
        "" => "./".to_owned(),
        place => format!("{place}/"),
    };
    let Some(file) = file else {
        return folder(place);
    };
    let mut parts: Vec<&str> = place.split('/').filter(|part| !part.is_empty()).collect();
    for part in file.split('/') {
        match part {
            "" | "." => {}
            ".." => {
                if parts.pop().is_none() {
                    return folder(place);
                }
            }
            part => parts.push(part),
        }
    }
    if parts.is_empty() { folder(place) } else { parts.join("/") }
}

/// Whether a file of the URDD at `place` is in the folder that `place` is relative to: tools show no other.
pub fn is_inside(place: &str, file: Option<&str>) -> bool {
    file.is_none() || !file_in(place, file).ends_with('/')
}

/// A path as seen from the current folder, with `/`. None if it is outside.
#[doc(hidden)]
pub fn relative(path: &Path, current: &Path) -> Option<String> {
    let whole = plain(&current.join(path));
    let inside = whole.strip_prefix(plain(current)).ok()?;
    let parts: Vec<_> =
        inside.components().map(|part| part.as_os_str().to_string_lossy()).collect();
    Some(parts.join("/"))
}

/// Resolves `.` and `..` in a path.
fn plain(path: &Path) -> PathBuf {
    let mut plain = PathBuf::new();
    for part in path.components() {
        match part {
            Component::CurDir => {}
            Component::ParentDir => {
                plain.pop();
            }
            part => plain.push(part),
        }
    }
    plain
}

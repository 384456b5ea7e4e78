//! Where the files of a package are when it is installed: what its CMakeLists.txt or setup.py installs below `share/NAME`, as
//! far as it says so literally. `$(find NAME)` and `package://NAME` mean that tree.

use std::path::Path;

/// Maximum length of a value that a variable stands for, in bytes: it may be put in very often.
pub const MAX_VALUE: usize = 255;

/// A file or folder that is installed. Paths are relative, with forward slashes.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Rule {
    /// Its path in the package; empty for the package itself.
    pub source: String,
    /// Its path in `share/NAME`; empty for that itself.
    pub target: String,
}

/// What a package installs.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Installed {
    /// What it installs.
    pub rules: Vec<Rule>,
    /// The first statement that was not understood: its file, and the line.
    pub unknown: Option<(&'static str, u32)>,
}

impl Installed {
    /// Adds what is installed in a folder below the prefix of the installation; `own` is the package's, as `share/NAME`.
    /// Nothing for another package, or for programs and libraries.
    pub(super) fn add(&mut self, source: &str, destination: &str, name: Option<&str>, own: &str) {
        let Some(destination) = plain(destination) else { return };
        let inside = match destination.strip_prefix(own) {
            Some("") => Some(""),
            Some(rest) => rest.strip_prefix('/'),
            None => None,
        };
        let (Some(source_path), Some(inside)) = (plain(source), inside) else { return };
        let last = source_path.rsplit('/').next().unwrap_or_default();
        // The content of a folder, where its name ends in a slash.
        let last = match name {
            Some(name) => name,
            None if source.ends_with('/') || source_path.is_empty() => "",
            None => last,
        };
        let slash = if inside.is_empty() || last.is_empty() { "" } else { "/" };
        self.rules.push(Rule { target: format!("{inside}{slash}{last}"), source: source_path });
    }

    /// That the package in a folder says in words which are not understood what it installs.
    pub fn by_variables(&self, folder: &Path) -> Option<String> {
        let (file, line) = self.unknown?;
        let file = folder.join(file);
        Some(format!(
            "{}:{line} installs files by variables that only a build knows",
            file.display()
        ))
    }

    /// Whether everything is installed where it is in the sources.
    pub fn is_as_source(&self) -> bool {
        self.rules.iter().all(|rule| rule.source == rule.target)
    }

    /// The paths in the package that a path in `share/NAME` may be.
    pub fn sources<'a>(&'a self, path: &'a str) -> impl Iterator<Item = String> + 'a {
        self.rules.iter().filter_map(move |rule| {
            let rest = match path.strip_prefix(&rule.target)? {
                "" => return Some(rule.source.clone()),
                rest if rule.target.is_empty() => rest,
                rest => rest.strip_prefix('/')?,
            };
            let slash = if rule.source.is_empty() { "" } else { "/" };
            Some(format!("{}{slash}{rest}", rule.source))
        })
    }
}

/// A path without `.` and doubled slashes; `None` if it leads out of its folder, or is a pattern.
fn plain(path: &str) -> Option<String> {
    let parts: Vec<&str> = path.split('/').filter(|part| !matches!(*part, "" | ".")).collect();
    let is_odd = |part: &&str| *part == ".." || part.contains(['*', '$', '\\', ':']);
    (!parts.iter().any(is_odd)).then(|| parts.join("/"))
}

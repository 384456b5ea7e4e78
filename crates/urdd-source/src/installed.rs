//! Where the files of a package are when it is installed: what its CMakeLists.txt or setup.py installs below `share/NAME`, as
//! far as it says so literally. `$(find NAME)` and `package://NAME` mean that tree. Nothing is run.

use std::path::Path;

use urdd_directory::limits::MAX_MANIFEST_BYTES;

use crate::files::Files;
use crate::suggested::{Token, tokens};

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

/// Maximum number of files and folders that a package installs one by one.
const MAX_RULES: usize = 1000;

/// Reads what the package in a folder says.
pub fn installed(folder: &Path, files: &Files) -> Installed {
    let read = |name: &str| {
        let bytes = files.read(&folder.join(name), MAX_MANIFEST_BYTES).ok()?;
        Some(String::from_utf8_lossy(&bytes).into_owned())
    };
    let mut installed = match (read("CMakeLists.txt"), read("setup.py")) {
        (Some(text), _) => by_cmake(&text),
        (None, Some(text)) => by_setup_py(&text),
        (None, None) => Installed::default(),
    };
    installed.rules.truncate(MAX_RULES);
    installed
}

const CMAKE: &str = "CMakeLists.txt";
/// Words in `install(...)` that end a list of names.
const KEYWORDS: &[&str] = &[
    "DIRECTORY",
    "FILES",
    "PROGRAMS",
    "TARGETS",
    "DESTINATION",
    "RENAME",
    "TYPE",
    "PERMISSIONS",
    "FILE_PERMISSIONS",
    "DIRECTORY_PERMISSIONS",
    "USE_SOURCE_PERMISSIONS",
    "OPTIONAL",
    "MESSAGE_NEVER",
    "CONFIGURATIONS",
    "COMPONENT",
    "EXCLUDE_FROM_ALL",
    "FILES_MATCHING",
    "PATTERN",
    "REGEX",
    "EXCLUDE",
];
/// Variables of folders that every package has; the first is its own.
const FOLDERS: &[(&str, &str)] = &[
    ("${CMAKE_CURRENT_SOURCE_DIR}", "."),
    ("${CMAKE_CURRENT_LIST_DIR}", "."),
    ("${CMAKE_SOURCE_DIR}", "."),
    ("${PROJECT_SOURCE_DIR}", "."),
    ("${CMAKE_INSTALL_PREFIX}", "."),
    ("${CMAKE_INSTALL_DATADIR}", "share"),
    ("${CMAKE_INSTALL_DATAROOTDIR}", "share"),
];

/// What a text installs below `share/NAME`.
fn by_cmake(text: &str) -> Installed {
    let (mut installed, mut project) = (Installed::default(), None);
    for Command { name, line, words } in commands(text) {
        if name.eq_ignore_ascii_case("project") {
            let is_plain = |name: &&String| name.len() <= MAX_VALUE && !name.contains('$');
            project = words.first().filter(is_plain).cloned();
        }
        let is_data = |word: &String| matches!(word.as_str(), "DIRECTORY" | "FILES");
        if !name.eq_ignore_ascii_case("install") || !words.first().is_some_and(is_data) {
            continue;
        }
        let Some(project) = &project else { continue };
        let (mut names, mut destination, mut rename, mut keyword) = (Vec::new(), None, None, "");
        let mut is_known = true;
        for word in &words {
            if KEYWORDS.contains(&word.as_str()) {
                keyword = word;
                continue;
            }
            let mut value = word.replace("${PROJECT_NAME}", project);
            for (variable, folder) in FOLDERS {
                value = value.replace(variable, folder);
            }
            match keyword {
                "DIRECTORY" | "FILES" => names.push(value.clone()),
                "DESTINATION" => destination = Some(value.clone()),
                "RENAME" => rename = Some(value.clone()),
                _ => continue,
            }
            is_known &= !value.contains('$');
        }
        let own = format!("share/{project}");
        let is_own = |one: &String| one.contains('$') || one.contains(&own);
        if !is_known && destination.as_ref().is_some_and(is_own) {
            installed.unknown.get_or_insert((CMAKE, line));
        }
        let Some(destination) = destination.filter(|one| !one.contains('$')) else { continue };
        for name in names.iter().filter(|name| !name.contains('$')) {
            installed.add(name, &destination, rename.as_deref(), &own);
        }
    }
    installed
}

/// A command, such as `install(...)`.
struct Command {
    name: String,
    line: u32,
    words: Vec<String>,
}

/// The commands of a text. Brackets in brackets are words like others.
fn commands(text: &str) -> Vec<Command> {
    let (mut found, mut open, mut word) = (Vec::new(), None::<Command>, String::new());
    let (mut line, mut depth) = (1, 0_usize);
    let mut rest = text.chars();
    while let Some(c) = rest.next() {
        line += u32::from(c == '\n');
        match c {
            '#' => {
                let (text, end) = match rest.as_str() {
                    text if text.starts_with("[[") => (text, text.find("]]")),
                    text => (text, text.find('\n')),
                };
                let (comment, behind) = text.split_at(end.unwrap_or(text.len()));
                line += u32::try_from(comment.matches('\n').count()).unwrap_or_default();
                rest = behind.trim_start_matches(']').chars();
            }
            '"' if open.is_some() => {
                while let Some(c) = rest.next().filter(|c| *c != '"') {
                    line += u32::from(c == '\n');
                    word.extend(if c == '\\' { rest.next() } else { Some(c) });
                }
            }
            '(' if open.is_none() => {
                let (name, words) = (std::mem::take(&mut word), Vec::new());
                (open, depth) = (Some(Command { name, line, words }), 0);
            }
            c if c.is_whitespace() || matches!(c, '(' | ')' | ';') => {
                let word = std::mem::take(&mut word);
                let Some(command) = &mut open else { continue };
                command.words.extend(Some(word).filter(|word| !word.is_empty()));
                match (c, depth) {
                    ('(', _) => depth += 1,
                    (')', 0) => found.extend(open.take()),
                    (')', _) => depth -= 1,
                    _ => {}
                }
            }
            c => word.push(c),
        }
    }
    found
}

const SETUP_PY: &str = "setup.py";

/// What a text installs below `share/NAME`.
fn by_setup_py(text: &str) -> Installed {
    let mut installed = Installed::default();
    let Some((before, data)) = text.split_once("data_files") else { return installed };
    let variables = before.lines().filter_map(assignment).collect();
    let name = ["package_name", "PACKAGE_NAME"].iter().find_map(|word| value(&variables, word));
    let literal = || {
        let (_, rest) = text.split_once("name=")?;
        assignment(&format!("name={}", rest.lines().next()?.trim_end_matches(',')))
    };
    let Some(name) = name.map(str::to_owned).or_else(|| Some(literal()?.1)) else {
        return installed;
    };
    let line = u32::try_from(before.lines().count().max(1)).unwrap_or(u32::MAX);
    let tokens = tokens(data);
    let mut reader = SetupPyReader { tokens: &tokens, at: 0, variables };
    if !(reader.skip('=') && reader.skip('[')) {
        installed.unknown = Some((SETUP_PY, line));
        return installed;
    }
    while reader.skip('(') {
        let Some((destination, sources)) = reader.entry() else {
            installed.unknown = Some((SETUP_PY, line));
            return installed;
        };
        for source in sources {
            installed.add(&source, &destination, None, &format!("share/{name}"));
        }
        reader.skip(',');
    }
    if !reader.skip(']') {
        installed.unknown = Some((SETUP_PY, line));
    }
    installed
}

type Variables = Vec<(String, String)>;

fn value<'v>(variables: &'v Variables, name: &str) -> Option<&'v str> {
    variables.iter().find(|(known, _)| known == name).map(|(_, value)| value.as_str())
}

/// A line that gives a name a literal text.
fn assignment(line: &str) -> Option<(String, String)> {
    let (name, value) = line.split_once('=')?;
    match &tokens(value)[..] {
        [Token::Text(value)] if value.len() <= MAX_VALUE => {
            Some((name.trim().to_owned(), value.clone()))
        }
        _ => None,
    }
}

struct SetupPyReader<'t> {
    tokens: &'t [Token],
    at: usize,
    variables: Variables,
}

impl SetupPyReader<'_> {
    fn skip(&mut self, mark: char) -> bool {
        let is_it = self.tokens.get(self.at) == Some(&Token::Mark(mark));
        self.at += usize::from(is_it);
        is_it
    }

    /// A destination, and the files; behind the bracket that opens it.
    fn entry(&mut self) -> Option<(String, Vec<String>)> {
        let destination = self.text()?;
        let mut sources = Vec::new();
        if self.skip(',') && self.skip('[') {
            while !self.skip(']') {
                sources.push(self.text()?);
                self.skip(',');
            }
        } else {
            // Of a pattern, the files of its folder.
            let pattern = self.text()?;
            let folder = pattern.rsplit_once('/').map_or("", |(folder, _)| folder);
            sources.push(format!("{folder}/"));
        }
        self.skip(',');
        self.skip(')').then_some((destination, sources))
    }

    /// Texts and names, joined by `+`, `os.path.join(...)` or in `glob(...)`.
    fn text(&mut self) -> Option<String> {
        let mut all = self.part()?;
        while self.skip('+') {
            all += &self.part()?;
        }
        Some(all)
    }

    fn part(&mut self) -> Option<String> {
        let token = self.tokens.get(self.at)?;
        self.at += 1;
        let mut name = match token {
            Token::Text(text) => return Some(text.clone()),
            Token::Word(word) => word.clone(),
            Token::Mark(_) => return None,
        };
        while self.skip('.') {
            let Token::Word(word) = self.tokens.get(self.at)? else { return None };
            self.at += 1;
            name = word.clone();
        }
        if !self.skip('(') {
            return value(&self.variables, &name).map(str::to_owned);
        }
        if !matches!(name.as_str(), "join" | "glob") {
            return None;
        }
        let mut parts = Vec::new();
        while !self.skip(')') {
            // The calls nest as often as the tokens of one statement allow, which are few.
            parts.push(self.text()?);
            self.skip(',');
        }
        Some(parts.join("/"))
    }
}

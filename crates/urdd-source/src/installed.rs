//! Where the files of a package are when it is installed: what its CMakeLists.txt or setup.py installs below `share/NAME`, as
//! far as it says so literally. `$(find NAME)` and `package://NAME` mean that tree. Nothing is run.

use std::collections::HashMap;
use std::path::Path;

use urdd_directory::account::{Account, AccountError};
use urdd_directory::limits::{MAX_MANIFEST_BYTES, MAX_NAME_BYTES};

use crate::files::Files;
use crate::python_tokens::{Token, tokens};

/// Maximum length of a value that a variable stands for, in bytes: it may be put in very often.
pub const MAX_VALUE: usize = 255;
/// Charged for a file that is looked for.
pub const LOOK_UP: usize = 1 << 10;

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
    by_target: HashMap<String, Vec<usize>>,
    /// The first statement that was not understood, or that is beyond [`MAX_RULES`]: its file, and the line.
    pub unknown: Option<(&'static str, u32)>,
}

impl Installed {
    /// Adds files that are installed in a folder below the prefix of the installation; `own` is the package's, as `share/NAME`.
    /// `name` is that of the only one, if it gets another. Nothing for another package, or for programs and libraries.
    fn add<'s>(
        &mut self,
        sources: impl IntoIterator<Item = &'s String>,
        destination: &str,
        name: Option<&str>,
        own: &str,
        at: (&'static str, u32),
    ) {
        let Some(destination) = plain(destination) else { return };
        let inside = match destination.strip_prefix(own) {
            Some("") => Some(""),
            Some(rest) => rest.strip_prefix('/'),
            None => None,
        };
        let Some(inside) = inside else { return };
        for source in sources {
            let Some(source_path) = plain(source) else { continue };
            if self.rules.len() == MAX_RULES {
                self.unknown.get_or_insert(at);
                return;
            }
            let last = source_path.rsplit('/').next().unwrap_or_default();
            // The content of a folder, where its name ends in a slash.
            let last = match name {
                Some(name) => name,
                None if source.ends_with('/') || source_path.is_empty() => "",
                None => last,
            };
            let slash = if inside.is_empty() || last.is_empty() { "" } else { "/" };
            let target = format!("{inside}{slash}{last}");
            self.by_target.entry(target.clone()).or_default().push(self.rules.len());
            self.rules.push(Rule { target, source: source_path });
        }
    }

    /// That it is not known what the package in a folder installs, and why.
    pub fn is_not_known(&self, folder: &Path) -> Option<String> {
        let (file, line) = self.unknown?;
        let file = folder.join(file);
        let why = match self.rules.len() < MAX_RULES {
            true => "installs files by variables that only a build knows",
            false => "installs more files and folders one by one than are looked at",
        };
        Some(format!("{}:{line} {why}", file.display()))
    }

    /// Whether everything is installed where it is in the sources.
    pub fn is_as_source(&self) -> bool {
        self.rules.iter().all(|rule| rule.source == rule.target)
    }

    /// The path in the package that a path in `share/NAME` is: the first that is there of those that it may be. Each that is
    /// looked for is charged.
    ///
    /// # Errors
    /// If the account does not have it.
    pub fn source(
        &self,
        path: &str,
        account: &Account,
        is_there: impl Fn(&str) -> bool,
    ) -> Result<Option<String>, AccountError> {
        // No file has a longer name.
        if path.len() > MAX_NAME_BYTES {
            return Ok(None);
        }
        let ends = path.match_indices('/').map(|(end, _)| (&path[..end], &path[end + 1..]));
        let ways = ends.chain([("", path), (path, "")]);
        let mut rules: Vec<(usize, &str)> = Vec::new();
        for (target, rest) in ways {
            let known = self.by_target.get(target).into_iter().flatten();
            rules.extend(known.map(|rule| (*rule, rest)));
        }
        rules.sort_unstable();
        rules.dedup_by_key(|(rule, _)| *rule);
        for (rule, rest) in rules {
            account.charge(LOOK_UP)?;
            let source = &self.rules[rule].source;
            let slash = if source.is_empty() || rest.is_empty() { "" } else { "/" };
            let path = format!("{source}{slash}{rest}");
            if is_there(&path) {
                return Ok(Some(path));
            }
        }
        Ok(None)
    }
}

/// A path without `.` and doubled slashes; `None` if it leads out of its folder, is a pattern, or longer than that of a file.
fn plain(path: &str) -> Option<String> {
    if path.len() > MAX_NAME_BYTES {
        return None;
    }
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
    // What is not there is the source of nothing.
    if matches!(files, Files::Disk) {
        installed.rules.retain(|rule| folder.join(&rule.source).exists());
        installed.by_target.clear();
        for (place, rule) in installed.rules.iter().enumerate() {
            installed.by_target.entry(rule.target.clone()).or_default().push(place);
        }
    }
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
        let names = names.iter().filter(|name| !name.contains('$'));
        installed.add(names, &destination, rename.as_deref(), &own, (CMAKE, line));
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
    let mut variables = Variables::new();
    for (name, value) in before.lines().filter_map(assignment) {
        variables.entry(name).or_insert(value);
    }
    let name = ["package_name", "PACKAGE_NAME"].iter().find_map(|word| variables.get(*word));
    let literal = || {
        let (_, rest) = text.split_once("name=")?;
        assignment(&format!("name={}", rest.lines().next()?.trim_end_matches(',')))
    };
    let Some(name) = name.cloned().or_else(|| Some(literal()?.1)) else {
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
        installed.add(&sources, &destination, None, &format!("share/{name}"), (SETUP_PY, line));
        reader.skip(',');
    }
    if !reader.skip(']') {
        installed.unknown = Some((SETUP_PY, line));
    }
    installed
}

/// Values by names, the first of each.
type Variables = HashMap<String, String>;

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
            return self.variables.get(&name).cloned();
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

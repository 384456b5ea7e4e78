//! What a CMakeLists.txt installs, as far as it is literal.

use crate::installed::{Installed, MAX_VALUE};

const FILE: &str = "CMakeLists.txt";
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
pub fn installed(text: &str) -> Installed {
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
            installed.unknown.get_or_insert((FILE, line));
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

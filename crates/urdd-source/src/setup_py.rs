//! What the `data_files` of a setup.py install, as far as they are literal. Nothing is run.

use crate::installed::{Installed, MAX_VALUE};
use crate::launch::{Token, tokens};

const FILE: &str = "setup.py";

/// What a text installs below `share/NAME`.
pub fn installed(text: &str) -> Installed {
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
        installed.unknown = Some((FILE, line));
        return installed;
    }
    while reader.skip('(') {
        let Some((destination, sources)) = reader.entry() else {
            installed.unknown = Some((FILE, line));
            return installed;
        };
        for source in sources {
            installed.add(&source, &destination, None, &format!("share/{name}"));
        }
        reader.skip(',');
    }
    if !reader.skip(']') {
        installed.unknown = Some((FILE, line));
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

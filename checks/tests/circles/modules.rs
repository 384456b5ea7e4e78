//! The modules of a crate, and the paths in them. Reads tokens, including those of macro calls. Tests are left out.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

use proc_macro2::{Delimiter, TokenStream, TokenTree};

/// The segments of a path.
pub type Names = Vec<String>;

/// A module, in a file of its own or inline.
#[derive(Default)]
pub struct Module {
    pub file: PathBuf,
    /// The folder of the files of its children.
    folder: PathBuf,
    /// Itself for a root.
    pub parent: usize,
    pub children: BTreeMap<String, usize>,
    pub imports: BTreeMap<String, Names>,
    pub globs: Vec<Names>,
    /// The items that it defines, including those in macro calls.
    pub defined: BTreeSet<String>,
    /// The paths in its code and in its private imports.
    pub used: BTreeSet<Names>,
    /// The words of macro calls between its items: lists of its children.
    pub listed: BTreeSet<String>,
}

/// All modules of a package's library and program.
#[derive(Default)]
pub struct Crate {
    pub modules: Vec<Module>,
    /// Where macros that can be called without a path are defined, by name.
    pub macros: BTreeMap<String, usize>,
}

impl Crate {
    /// Reads the package in a folder.
    pub fn read(package: &Path) -> Crate {
        let mut read = Crate::default();
        let source = package.join("src");
        for root in ["lib.rs", "main.rs"] {
            if source.join(root).is_file() {
                let index = read.modules.len();
                read.add_file(source.join(root), source.clone(), index);
            }
        }
        read
    }

    fn add_file(&mut self, file: PathBuf, folder: PathBuf, parent: usize) -> usize {
        let text = fs::read_to_string(&file).unwrap_or_else(|e| panic!("{}: {e}", file.display()));
        let tokens = text.parse();
        let tokens = tokens.unwrap_or_else(|e| panic!("{}: {e}", file.display()));
        self.add(file, folder, parent, tokens)
    }

    fn add(&mut self, file: PathBuf, folder: PathBuf, parent: usize, code: TokenStream) -> usize {
        let index = self.modules.len();
        self.modules.push(Module { file, folder, parent, ..Module::default() });
        self.scan(index, code, true);
        index
    }

    /// Reads tokens of a module: its items, or the content of brackets.
    fn scan(&mut self, module: usize, code: TokenStream, are_items: bool) {
        let tokens: Vec<TokenTree> = code.into_iter().collect();
        let word = |at: usize| match tokens.get(at) {
            Some(TokenTree::Ident(ident)) => Some(ident.to_string()),
            _ => None,
        };
        let mut file = None;
        let mut at = 0;
        while at < tokens.len() {
            if let Some(attribute) = attribute(&tokens[at..]) {
                at += 2;
                let text = attribute.to_string().replace(' ', "");
                if text == "cfg(test)" || text.starts_with("cfg(all(test,") {
                    at = after_item(&tokens, at);
                } else if let Some(path) = text.strip_prefix("path=") {
                    file = Some(path.trim_matches('"').to_owned());
                } else if !text.starts_with("doc=") {
                    self.scan_attribute(module, attribute);
                }
                continue;
            }
            match (&tokens[at], word(at).as_deref(), word(at + 1)) {
                (_, Some("use"), _) => {
                    let ends = |at: &usize| is_punct(tokens.get(*at), ';');
                    let end = (at..tokens.len()).find(ends).unwrap_or(tokens.len());
                    let is_public = ends_in_visibility(&tokens[..at]);
                    self.import(module, &tokens[at + 1..end], &[], is_public);
                    at = end;
                }
                (_, Some("mod"), Some(name)) => {
                    at += 2;
                    let child = match &tokens[at] {
                        TokenTree::Group(body) => {
                            let Module { file, folder, .. } = &self.modules[module];
                            let (file, folder) = (file.clone(), folder.join(&name));
                            self.add(file, folder, module, body.stream())
                        }
                        _ => self.add_child(module, &name, file.take()),
                    };
                    self.modules[module].children.insert(name, child);
                }
                (_, Some("macro_rules"), _) => {
                    at += 2;
                    let name = word(at).expect("a macro's name");
                    self.macros.insert(name.clone(), module);
                    self.modules[module].defined.insert(name);
                }
                (_, Some(keyword), Some(name)) if DEFINING.contains(&keyword) => {
                    at += 1;
                    self.modules[module].defined.insert(name);
                }
                (TokenTree::Ident(_), ..) => {
                    let (names, length) = path(&tokens[at..]);
                    let follows_dot = ends_in_dot(&tokens[..at]);
                    at += length - 1;
                    if let Some(TokenTree::Group(group)) = tokens.get(at + 2)
                        && are_items
                        && names[0].ends_with('!')
                    {
                        let words = group.stream().into_iter();
                        let words = words.filter(|token| matches!(token, TokenTree::Ident(_)));
                        let listed = &mut self.modules[module].listed;
                        listed.extend(words.map(|word| word.to_string()));
                    }
                    if !follows_dot {
                        self.modules[module].used.insert(names);
                    }
                }
                (TokenTree::Group(group), ..) => self.scan(module, group.stream(), false),
                _ => {}
            }
            at += 1;
        }
    }

    /// Reads `mod name;`, with the path of a `#[path = "..."]`.
    fn add_child(&mut self, module: usize, name: &str, path: Option<String>) -> usize {
        let Module { file, folder, .. } = &self.modules[module];
        let (plain, inside) = (folder.join(format!("{name}.rs")), folder.join(name));
        match path {
            Some(path) => {
                let file = file.with_file_name(path);
                let beside = file.parent().expect("a folder").to_owned();
                self.add_file(file, beside, module)
            }
            None if plain.is_file() => self.add_file(plain, inside, module),
            None => self.add_file(inside.join("mod.rs"), inside, module),
        }
    }

    /// Attributes also name functions in quotes: `#[serde(with = "super::hexadecimal")]`.
    fn scan_attribute(&mut self, module: usize, content: TokenStream) {
        for token in content.clone() {
            match token {
                TokenTree::Literal(literal) => {
                    let quoted = literal.to_string();
                    let quoted = quoted.trim_matches('"');
                    if let (true, Ok(path)) = (quoted.contains("::"), quoted.parse()) {
                        self.scan(module, path, false);
                    }
                }
                TokenTree::Group(group) => self.scan_attribute(module, group.stream()),
                _ => {}
            }
        }
        self.scan(module, content, false);
    }

    /// Reads one tree of a `use`, which is below the path `above`.
    fn import(&mut self, module: usize, tree: &[TokenTree], above: &[String], is_public: bool) {
        let mut names = above.to_vec();
        let mut alias = None;
        let mut tokens = tree.iter();
        while let Some(token) = tokens.next() {
            match token {
                TokenTree::Ident(ident) if ident == "as" => {
                    alias = tokens.next().map(ToString::to_string);
                }
                TokenTree::Ident(ident) => names.push(ident.to_string()),
                TokenTree::Group(group) => {
                    let inner: Vec<TokenTree> = group.stream().into_iter().collect();
                    for tree in inner.split(|token| is_punct(Some(token), ',')) {
                        self.import(module, tree, &names, is_public);
                    }
                    return;
                }
                other if is_punct(Some(other), '*') => {
                    self.modules[module].globs.push(names);
                    return;
                }
                _ => {}
            }
        }
        if names.last().is_some_and(|last| last == "self") {
            names.pop();
        }
        let Some(last) = names.last() else {
            return;
        };
        let name = alias.unwrap_or_else(|| last.clone());
        let module = &mut self.modules[module];
        if !is_public {
            module.used.insert(names.clone());
        }
        // Otherwise the name of a macro, made visible: `pub(crate) use object;`.
        if names != [name.as_str()] {
            module.imports.insert(name, names);
        }
    }
}

/// The words before the name of an item.
const DEFINING: [&str; 8] = ["const", "enum", "fn", "static", "struct", "trait", "type", "union"];

/// The content of the attribute that the tokens begin with.
fn attribute(tokens: &[TokenTree]) -> Option<TokenStream> {
    match tokens {
        [hash, TokenTree::Group(group), ..]
            if is_punct(Some(hash), '#') && group.delimiter() == Delimiter::Bracket =>
        {
            Some(group.stream())
        }
        _ => None,
    }
}

/// The index after the item that begins at `at`.
fn after_item(tokens: &[TokenTree], at: usize) -> usize {
    let ends = |token: &TokenTree| match token {
        TokenTree::Group(group) => group.delimiter() == Delimiter::Brace,
        token => is_punct(Some(token), ';'),
    };
    let length = tokens[at..].iter().position(ends);
    length.map_or(tokens.len(), |length| at + length + 1)
}

/// Whether the tokens end in `pub` or `pub(...)`.
fn ends_in_visibility(tokens: &[TokenTree]) -> bool {
    let is_pub = |token: &TokenTree| matches!(token, TokenTree::Ident(ident) if ident == "pub");
    match tokens {
        [.., before, TokenTree::Group(_)] | [.., before] => is_pub(before),
        [] => false,
    }
}

/// Whether a name after the tokens is a field or a method, a lifetime, or within another path.
fn ends_in_dot(tokens: &[TokenTree]) -> bool {
    let back = |count: usize| tokens.len().checked_sub(count).map(|at| &tokens[at]);
    let is = |count, character| is_punct(back(count), character);
    is(1, '.') && !is(2, '.') || is(1, '\'') || is(1, ':') && is(2, ':')
}

/// The path that the tokens begin with, and how many of them it has. The name of a macro call ends in `!`.
fn path(tokens: &[TokenTree]) -> (Names, usize) {
    let mut names = Names::new();
    let mut at = 0;
    while let Some(TokenTree::Ident(ident)) = tokens.get(at) {
        names.push(ident.to_string());
        at += 1;
        let is_longer = is_punct(tokens.get(at), ':') && is_punct(tokens.get(at + 1), ':');
        match (is_longer, tokens.get(at + 2)) {
            (true, Some(TokenTree::Ident(_))) => at += 2,
            _ => break,
        }
    }
    let is_call = matches!(tokens.get(at + 1), Some(TokenTree::Group(_)));
    if names.len() == 1 && is_call && is_punct(tokens.get(at), '!') {
        names[0].push('!');
    }
    (names, at)
}

fn is_punct(token: Option<&TokenTree>, character: char) -> bool {
    matches!(token, Some(TokenTree::Punct(punct)) if punct.as_char() == character)
}

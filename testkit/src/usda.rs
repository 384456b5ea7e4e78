//! USD's text, as far as our exports write it, read strictly: a second implementation of its grammar.

use std::collections::BTreeMap;

/// A value.
#[derive(Debug, Clone, PartialEq)]
pub enum Value {
    Number(f64),
    Text(String),
    Asset(String),
    Path(String),
    Word(String),
    /// An array or a tuple.
    List(Vec<Value>),
    Dictionary(BTreeMap<String, Value>),
}

impl Value {
    /// All numbers in it, in order.
    pub fn numbers(&self) -> Vec<f64> {
        match self {
            Value::Number(number) => vec![*number],
            Value::List(values) => values.iter().flat_map(Value::numbers).collect(),
            Value::Word(word) if word == "inf" => vec![f64::INFINITY],
            other => panic!("not a number: {other:?}"),
        }
    }

    /// A text, a token, a path or a file.
    pub fn text(&self) -> &str {
        match self {
            Value::Text(text) | Value::Asset(text) | Value::Path(text) | Value::Word(text) => text,
            other => panic!("not a text: {other:?}"),
        }
    }

    /// The values of a list; a single one is a list of it.
    pub fn list(&self) -> Vec<&Value> {
        match self {
            Value::List(values) => values.iter().collect(),
            one => vec![one],
        }
    }
}

/// A prim, or the file itself.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Prim {
    pub kind: String,
    pub path: String,
    pub metadata: BTreeMap<String, Value>,
    /// By name, without the type.
    pub properties: BTreeMap<String, Value>,
    pub children: Vec<Prim>,
}

impl Prim {
    pub fn name(&self) -> &str {
        self.path.rsplit('/').next().unwrap_or_default()
    }

    /// The name that it shows.
    pub fn shown(&self) -> &str {
        self.metadata.get("displayName").map_or(self.name(), Value::text)
    }

    pub fn child(&self, name: &str) -> &Prim {
        let found = self.children.iter().find(|child| child.name() == name);
        found.unwrap_or_else(|| panic!("no `{name}` in `{}`", self.path))
    }

    pub fn get(&self, property: &str) -> &Value {
        let found = self.properties.get(property);
        found.unwrap_or_else(|| panic!("no `{property}` of `{}`", self.path))
    }

    pub fn numbers(&self, property: &str) -> Vec<f64> {
        self.get(property).numbers()
    }

    pub fn applies(&self, schema: &str) -> bool {
        let schemas = self.metadata.get("apiSchemas").map(Value::list).unwrap_or_default();
        schemas.iter().any(|of| of.text() == schema)
    }

    /// This prim and all below it.
    pub fn all(&self) -> Vec<&Prim> {
        std::iter::once(self).chain(self.children.iter().flat_map(Prim::all)).collect()
    }

    /// The structure: kinds of prims, names of metadata and properties; the same whatever texts there are.
    pub fn structure(&self) -> Vec<String> {
        let one = |prim: &Prim| {
            let depth = prim.path.matches('/').count();
            let metadata = prim.metadata.keys().filter(|key| *key != "displayName");
            let metadata: Vec<_> = metadata.collect();
            format!("{depth} {} {metadata:?} {:?}", prim.kind, prim.properties.keys())
        };
        self.all().into_iter().map(one).collect()
    }
}

/// The file, with its default prim as the only child. Panics on what is not of our grammar.
pub fn parsed(text: &str) -> Prim {
    let body = text.strip_prefix("#usda 1.0\n").expect("a head");
    let mut reader = Reader { tokens: tokens(body), at: 0 };
    let mut file = Prim { metadata: reader.metadata(), ..Prim::default() };
    while reader.at < reader.tokens.len() {
        file.children.push(reader.prim(""));
    }
    assert_eq!(file.children.len(), 1);
    assert_eq!(file.metadata["defaultPrim"].text(), file.children[0].name());
    file
}

#[derive(Debug, Clone, PartialEq)]
enum Token {
    Mark(char),
    Value(Value),
}

fn tokens(text: &str) -> Vec<Token> {
    let mut tokens = Vec::new();
    let mut rest = text.trim_start();
    while let Some(first) = rest.chars().next() {
        let (token, length) = match first {
            '"' => string(rest),
            '@' => {
                let mark = if rest.starts_with("@@@") { "@@@" } else { "@" };
                let end = rest[mark.len()..].find(mark).expect("the end of a path") + mark.len();
                let path = rest[mark.len()..end].to_owned();
                (Token::Value(Value::Asset(path)), end + mark.len())
            }
            '<' => {
                let end = rest.find('>').expect("the end of a path");
                let is_kept = |c: char| c.is_ascii_alphanumeric() || "/_.:".contains(c);
                assert!(rest[1..end].chars().all(is_kept), "{}", &rest[..end]);
                (Token::Value(Value::Path(rest[1..end].to_owned())), end + 1)
            }
            '(' | ')' | '{' | '}' | '[' | ']' | '=' | ',' | ';' => (Token::Mark(first), 1),
            '0'..='9' | '-' => {
                let end = rest.find(|c: char| !c.is_ascii_alphanumeric() && !".+-".contains(c));
                let word = &rest[..end.unwrap_or(rest.len())];
                (Token::Value(Value::Number(word.parse().expect("a number"))), word.len())
            }
            'a'..='z' | 'A'..='Z' | '_' => {
                let end = rest.find(|c: char| !c.is_ascii_alphanumeric() && !"_:.".contains(c));
                let mut word = &rest[..end.unwrap_or(rest.len())];
                if rest[word.len()..].starts_with("[]") {
                    word = &rest[..word.len() + 2];
                }
                (Token::Value(Value::Word(word.to_owned())), word.len())
            }
            other => panic!("`{other}` is not of the grammar: {}", &rest[..rest.len().min(80)]),
        };
        tokens.push(token);
        rest = rest[length..].trim_start();
    }
    tokens
}

fn string(rest: &str) -> (Token, usize) {
    // Escapes are of bytes.
    let mut text: Vec<u8> = Vec::new();
    let mut chars = rest.char_indices().skip(1);
    while let Some((at, c)) = chars.next() {
        match c {
            '"' => {
                let text = String::from_utf8(text).expect("UTF-8");
                return (Token::Value(Value::Text(text)), at + 1);
            }
            '\n' => panic!("a string over several lines"),
            '\\' => match chars.next().expect("an escape").1 {
                'n' => text.push(b'\n'),
                't' => text.push(b'\t'),
                'x' => {
                    let digits: String = chars.by_ref().take(2).map(|(_, c)| c).collect();
                    let code = u8::from_str_radix(&digits, 16).expect("two digits");
                    text.push(code);
                }
                c @ ('"' | '\\') => text.extend_from_slice(c.encode_utf8(&mut [0; 4]).as_bytes()),
                other => panic!("an escape `{other}`"),
            },
            _ => text.extend_from_slice(c.encode_utf8(&mut [0; 4]).as_bytes()),
        }
    }
    panic!("a string without an end")
}

struct Reader {
    tokens: Vec<Token>,
    at: usize,
}

impl Reader {
    fn next(&mut self) -> Token {
        self.at += 1;
        self.tokens[self.at - 1].clone()
    }

    fn takes(&mut self, mark: char) -> bool {
        let is_there = self.tokens.get(self.at) == Some(&Token::Mark(mark));
        self.at += usize::from(is_there);
        is_there
    }

    fn expect(&mut self, mark: char) {
        assert!(self.takes(mark), "`{mark}` before {:?}", self.tokens.get(self.at));
    }

    fn word(&mut self) -> String {
        match self.next() {
            Token::Value(Value::Word(word)) => word,
            other => panic!("no word: {other:?}"),
        }
    }

    fn is_word(&self, word: &str) -> bool {
        self.tokens.get(self.at) == Some(&Token::Value(Value::Word(word.to_owned())))
    }

    fn metadata(&mut self) -> BTreeMap<String, Value> {
        let mut found = BTreeMap::new();
        self.expect('(');
        while !self.takes(')') {
            if self.is_word("prepend") {
                self.at += 1;
            }
            let key = self.word();
            self.expect('=');
            let value = self.value();
            assert!(found.insert(key, value).is_none(), "metadata twice");
        }
        found
    }

    fn value(&mut self) -> Value {
        match self.next() {
            Token::Value(value) => value,
            Token::Mark('[') => self.list(']'),
            Token::Mark('(') => self.list(')'),
            Token::Mark('{') => {
                let mut entries = BTreeMap::new();
                while !self.takes('}') {
                    let _kind = self.word();
                    let key = self.value().text().to_owned();
                    self.expect('=');
                    let value = self.value();
                    assert!(entries.insert(key, value).is_none(), "an entry twice");
                    self.takes(';');
                }
                Value::Dictionary(entries)
            }
            other => panic!("no value: {other:?}"),
        }
    }

    fn list(&mut self, end: char) -> Value {
        let mut values = Vec::new();
        while !self.takes(end) {
            values.push(self.value());
            if !self.takes(',') {
                self.expect(end);
                break;
            }
        }
        Value::List(values)
    }

    fn prim(&mut self, above: &str) -> Prim {
        assert_eq!(self.word(), "def");
        let kind = self.word();
        let name = match self.next() {
            Token::Value(Value::Text(name)) => name,
            other => panic!("no name: {other:?}"),
        };
        let is_kept = |c: char| c.is_ascii_alphanumeric() || c == '_';
        let is_name = name.chars().all(is_kept) && !name.starts_with(|c: char| c.is_ascii_digit());
        assert!(is_name && !name.is_empty(), "USD has no name `{name}`");
        let mut prim = Prim { kind, path: format!("{above}/{name}"), ..Prim::default() };
        if self.tokens[self.at] == Token::Mark('(') {
            prim.metadata = self.metadata();
        }
        self.expect('{');
        while !self.takes('}') {
            if self.is_word("def") {
                let child = self.prim(&prim.path);
                assert!(
                    prim.children.iter().all(|of| of.path != child.path),
                    "{} twice",
                    child.path
                );
                prim.children.push(child);
                continue;
            }
            if self.is_word("uniform") {
                self.at += 1;
            }
            let _kind = self.word();
            let name = self.word();
            if !self.takes('=') {
                continue;
            }
            let value = self.value();
            if self.tokens[self.at] == Token::Mark('(') {
                self.metadata();
            }
            assert!(prim.properties.insert(name, value).is_none(), "a property twice");
        }
        prim
    }
}

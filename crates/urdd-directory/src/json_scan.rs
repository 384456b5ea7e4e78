//! A lexical scan of JSON text: finds positions without building a tree and without recursion.
//!
//! Used only for reports, on text that a parser has accepted, at least up to the position in question. On other text it
//! ends early, and never panics.

use std::borrow::Cow;
use std::collections::{HashMap, HashSet};

/// A duplicate key.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct RepeatedKey {
    /// Byte offset of the second or later occurrence of the key.
    pub offset: usize,
    /// RFC 6901 pointer to the member.
    pub pointer: String,
}

/// Calls `found` for every repeated occurrence of a key in its object.
pub fn repeated_keys(text: &str, mut found: impl FnMut(&dyn Fn() -> RepeatedKey)) {
    let mut walk = Walk::new(text, true);
    while let Some(token) = walk.next() {
        if token.repeats {
            found(&|| RepeatedKey { offset: token.offset, pointer: walk.pointer() });
        }
    }
}

/// RFC 6901 pointer to the value that contains `offset`.
pub fn pointer_at(text: &str, offset: usize) -> String {
    let mut walk = Walk::new(text, false);
    while walk.scan.at < offset {
        let at = walk.scan.at;
        if walk.next().is_none() || walk.scan.at == at {
            break;
        }
    }
    walk.pointer()
}

/// Appends one segment to a pointer.
pub fn push_segment(pointer: &mut String, segment: &str) {
    pointer.push('/');
    for c in segment.chars() {
        match c {
            '~' => pointer.push_str("~0"),
            '/' => pointer.push_str("~1"),
            c => pointer.push(c),
        }
    }
}

struct Scan<'a> {
    text: &'a str,
    /// Byte offset of the next byte.
    at: usize,
}

impl<'a> Scan<'a> {
    fn peek(&self) -> Option<u8> {
        self.text.as_bytes().get(self.at).copied()
    }

    fn skip_space(&mut self) {
        while matches!(self.peek(), Some(b' ' | b'\t' | b'\n' | b'\r')) {
            self.at += 1;
        }
    }

    /// Skips white space, then moves past `byte` if it is next.
    fn eat(&mut self, byte: u8) -> Option<()> {
        self.skip_space();
        (self.peek() == Some(byte)).then(|| self.at += 1)
    }

    /// Moves past the string that begins here, and returns it with its quotes.
    fn string(&mut self) -> Option<&'a str> {
        let start = self.at;
        let bytes = self.text.as_bytes();
        if self.peek() != Some(b'"') {
            return None;
        }
        self.at += 1;
        while let Some(&byte) = bytes.get(self.at) {
            self.at += 1;
            match byte {
                b'"' => return self.text.get(start..self.at),
                b'\\' => self.at += 1,
                _ => {}
            }
        }
        None
    }

    fn key(&mut self) -> Option<Cow<'a, str>> {
        let quoted = self.string()?;
        let inner = quoted.get(1..quoted.len() - 1)?;
        if inner.contains('\\') {
            serde_json::from_str(quoted).ok().map(Cow::Owned)
        } else {
            Some(Cow::Borrowed(inner))
        }
    }

    fn word(&mut self) {
        while !matches!(
            self.peek(),
            None | Some(b',' | b']' | b'}' | b':' | b' ' | b'\t' | b'\n' | b'\r')
        ) {
            self.at += 1;
        }
    }

    /// Moves past one whole value.
    fn skip_value(&mut self) -> Option<()> {
        let mut depth = 0_usize;
        loop {
            self.skip_space();
            match self.peek()? {
                b'"' => {
                    self.string()?;
                }
                b'{' | b'[' => {
                    depth += 1;
                    self.at += 1;
                    continue;
                }
                b'}' | b']' => {
                    depth = depth.checked_sub(1)?;
                    self.at += 1;
                }
                b',' | b':' if depth > 0 => {
                    self.at += 1;
                    continue;
                }
                _ => {
                    let start = self.at;
                    self.word();
                    (self.at > start).then_some(())?;
                }
            }
            if depth == 0 {
                return Some(());
            }
        }
    }
}

/// One open container of a [`Walk`].
enum Open<'a> {
    List(usize),
    Object { key: Option<Cow<'a, str>>, keys: HashSet<Cow<'a, str>>, at_value: bool },
}

struct Token {
    offset: usize,
    repeats: bool,
}

/// A scan over all tokens that tracks its position in the document.
struct Walk<'a> {
    scan: Scan<'a>,
    open: Vec<Open<'a>>,
    with_keys: bool,
}

impl<'a> Walk<'a> {
    fn new(text: &'a str, with_keys: bool) -> Self {
        Self { scan: Scan { text, at: 0 }, open: Vec::new(), with_keys }
    }

    fn next(&mut self) -> Option<Token> {
        self.scan.skip_space();
        let offset = self.scan.at;
        let mut token = Token { offset, repeats: false };
        match self.scan.peek()? {
            b'{' => {
                self.open.push(Open::Object { key: None, keys: HashSet::new(), at_value: false })
            }
            b'[' => self.open.push(Open::List(0)),
            b'}' | b']' => {
                self.open.pop();
            }
            b',' => match self.open.last_mut() {
                Some(Open::List(index)) => *index += 1,
                Some(Open::Object { at_value, .. }) => *at_value = false,
                None => {}
            },
            b':' => {
                if let Some(Open::Object { at_value, .. }) = self.open.last_mut() {
                    *at_value = true;
                }
            }
            b'"' => {
                if let Some(Open::Object { key, keys, at_value: false }) = self.open.last_mut() {
                    let name = self.scan.key()?;
                    if self.with_keys {
                        token.repeats = !keys.insert(name.clone());
                    }
                    *key = Some(name);
                } else {
                    self.scan.string()?;
                }
                return Some(token);
            }
            _ => {
                self.scan.word();
                return (self.scan.at > offset).then_some(token);
            }
        }
        self.scan.at += 1;
        Some(token)
    }

    fn pointer(&self) -> String {
        let mut pointer = String::new();
        for open in &self.open {
            match open {
                Open::List(index) => push_segment(&mut pointer, &index.to_string()),
                Open::Object { key: Some(key), .. } => push_segment(&mut pointer, key),
                Open::Object { key: None, .. } => {}
            }
        }
        pointer
    }
}

/// Byte offsets of the values at many pointers, in one pass through the text.
pub fn find_values(text: &str, pointers: &[&str]) -> Vec<Option<usize>> {
    let mut wanted = Wanted::default();
    for (number, pointer) in pointers.iter().enumerate() {
        let mut parts = pointer.split('/');
        // A pointer is empty or begins with a slash.
        if parts.next() != Some("") {
            continue;
        }
        let place = parts.fold(&mut wanted, |place, part| {
            let key = part.replace("~1", "/").replace("~0", "~");
            place.below.entry(key).or_default()
        });
        place.numbers.push(number);
    }
    let mut found = vec![None; pointers.len()];
    wanted.visit(&mut Scan { text, at: 0 }, &mut found);
    found
}

/// The pointers that end at a value, and those that continue below it.
#[derive(Default)]
struct Wanted {
    numbers: Vec<usize>,
    below: HashMap<String, Wanted>,
}

impl Wanted {
    /// Records the value that begins here, and moves past it.
    fn visit(&self, scan: &mut Scan<'_>, found: &mut [Option<usize>]) -> Option<()> {
        scan.skip_space();
        scan.peek()?;
        for number in &self.numbers {
            found[*number] = Some(scan.at);
        }
        let list = match scan.peek() {
            Some(b'[') if !self.below.is_empty() => true,
            Some(b'{') if !self.below.is_empty() => false,
            _ => return scan.skip_value(),
        };
        scan.at += 1;
        for index in 0.. {
            scan.skip_space();
            if matches!(scan.peek(), Some(b']' | b'}')) {
                break;
            }
            let below = match list {
                true => self.below.get(index.to_string().as_str()),
                false => {
                    let key = scan.key()?;
                    scan.eat(b':')?;
                    self.below.get(&*key)
                }
            };
            match below {
                // For a duplicate key, only the last value counts.
                Some(below) => {
                    below.forget(found);
                    below.visit(scan, found)?;
                }
                None => scan.skip_value()?,
            }
            if scan.eat(b',').is_none() {
                break;
            }
        }
        scan.eat(if list { b']' } else { b'}' })
    }

    fn forget(&self, found: &mut [Option<usize>]) {
        for number in &self.numbers {
            found[*number] = None;
        }
        self.below.values().for_each(|below| below.forget(found));
    }
}

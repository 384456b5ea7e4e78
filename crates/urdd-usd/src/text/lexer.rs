//! Words of a text layer.

use std::borrow::Cow;

use super::super::error::{Fault, Place, Wrong};

#[derive(Debug, Clone, PartialEq)]
pub enum Token<'t> {
    /// A name, with `:` inside.
    Name(&'t str),
    Number(f64),
    Text(Cow<'t, str>),
    Asset(Cow<'t, str>),
    Path(&'t str),
    /// Any other character.
    Mark(char),
    End,
}

impl Token<'_> {
    fn shown(&self) -> String {
        match self {
            Token::Name(name) => format!("`{}`", short(name)),
            Token::Number(number) => format!("{number}"),
            Token::Text(text) => format!("\"{}\"", short(text)),
            Token::Asset(path) => format!("@{}@", short(path)),
            Token::Path(path) => format!("<{}>", short(path)),
            Token::Mark(mark) => format!("`{mark}`"),
            Token::End => "the end of the file".to_owned(),
        }
    }
}

/// At most 60 characters of a text.
fn short(text: &str) -> String {
    text.chars().take(60).collect()
}

#[derive(Debug)]
pub struct Lexer<'t> {
    text: &'t str,
    at: usize,
    line: u32,
    line_start: usize,
    /// The line on which the word before the one ahead ends.
    last_line: u32,
    /// The word ahead, and where it begins.
    ahead: Option<Token<'t>>,
    start: usize,
    start_line: u32,
    start_of_line: usize,
}

impl<'t> Lexer<'t> {
    pub fn new(text: &'t str) -> Self {
        Lexer {
            text,
            at: 0,
            line: 1,
            line_start: 0,
            last_line: 1,
            ahead: None,
            start: 0,
            start_line: 1,
            start_of_line: 0,
        }
    }

    /// The line of the word ahead, or of the last one.
    pub fn word_line(&self) -> u32 {
        self.start_line
    }

    /// That a statement ends: by `;`, a line break or the bracket around it, as usd-core has it. The latter alone ends the last
    /// one, too.
    pub fn ends(&mut self) -> Result<(), Wrong> {
        let next = self.peek()?.clone();
        let is_end = matches!(next, Token::Mark(';' | ',' | '}' | ')') | Token::End);
        match is_end || self.start_line > self.last_line {
            true => Ok(()),
            false => Err(self.expected("`;` or a line break after a statement", &next)),
        }
    }

    /// A fault at the word ahead, or at the last one.
    pub fn wrong(&self, fault: Fault) -> Wrong {
        let before = self.text.get(self.start_of_line..self.start).unwrap_or_default();
        (Place::Text(self.start_line, before.chars().count() as u32 + 1), fault)
    }

    /// That another word was expected.
    pub fn expected(&self, expected: &'static str, found: &Token<'_>) -> Wrong {
        self.wrong(Fault::Syntax { expected, found: found.shown() })
    }

    /// The next word, which stays ahead.
    pub fn peek(&mut self) -> Result<&Token<'t>, Wrong> {
        if self.ahead.is_none() {
            let token = self.read()?;
            self.ahead = Some(token);
        }
        // It was put there just now.
        Ok(self.ahead.as_ref().unwrap_or(&Token::End))
    }

    pub fn next(&mut self) -> Result<Token<'t>, Wrong> {
        match self.ahead.take() {
            Some(token) => Ok(token),
            None => self.read(),
        }
    }

    /// Takes a character if it is next.
    pub fn takes(&mut self, mark: char) -> Result<bool, Wrong> {
        let is_next = *self.peek()? == Token::Mark(mark);
        if is_next {
            self.ahead = None;
        }
        Ok(is_next)
    }

    /// Takes a character, which has to be next.
    pub fn take(&mut self, mark: char, expected: &'static str) -> Result<(), Wrong> {
        match self.next()? {
            Token::Mark(found) if found == mark => Ok(()),
            other => Err(self.expected(expected, &other)),
        }
    }

    /// Takes a name, which has to be next.
    pub fn name(&mut self, expected: &'static str) -> Result<&'t str, Wrong> {
        match self.next()? {
            Token::Name(name) => Ok(name),
            other => Err(self.expected(expected, &other)),
        }
    }

    fn rest(&self) -> &'t str {
        &self.text[self.at..]
    }

    /// Moves on, over lines.
    fn skip(&mut self, bytes: usize) {
        let passed = &self.text.as_bytes()[self.at..self.at + bytes];
        for (index, _) in passed.iter().enumerate().filter(|(_, byte)| **byte == b'\n') {
            self.line += 1;
            self.line_start = self.at + index + 1;
        }
        self.at += bytes;
    }

    fn blanks(&mut self) -> Result<(), Wrong> {
        loop {
            let rest = self.rest();
            let blank = rest.bytes().take_while(|byte| byte.is_ascii_whitespace()).count();
            self.skip(blank);
            let rest = self.rest();
            if rest.starts_with('#') || rest.starts_with("//") {
                self.skip(rest.find('\n').unwrap_or(rest.len()));
            } else if rest.starts_with("/*") {
                let Some(end) = rest.find("*/") else {
                    return Err(self.wrong(Fault::Unfinished("a comment")));
                };
                self.skip(end + 2);
            } else {
                return Ok(());
            }
        }
    }

    fn read(&mut self) -> Result<Token<'t>, Wrong> {
        self.last_line = self.line;
        self.blanks()?;
        (self.start, self.start_line, self.start_of_line) = (self.at, self.line, self.line_start);
        let rest = self.rest();
        let Some(first) = rest.chars().next() else { return Ok(Token::End) };
        match first {
            '"' | '\'' => self.quoted(first),
            '@' => self.asset(),
            '<' => {
                let end = rest.find(['>', '\n']).filter(|end| rest[*end..].starts_with('>'));
                let Some(end) = end else { return Err(self.wrong(Fault::Unfinished("a path"))) };
                self.skip(end + 1);
                Ok(Token::Path(&rest[1..end]))
            }
            '0'..='9' | '-' | '+' | '.' => Ok(self.number(first)),
            _ if first == '_' || first.is_alphabetic() => {
                let name = name(rest);
                self.skip(name.len());
                Ok(Token::Name(name))
            }
            _ => {
                self.skip(first.len_utf8());
                Ok(Token::Mark(first))
            }
        }
    }

    fn number(&mut self, first: char) -> Token<'t> {
        let rest = self.rest();
        let bytes = rest.as_bytes();
        for (word, value) in
            [("-inf", f64::NEG_INFINITY), ("+inf", f64::INFINITY), ("-nan", f64::NAN)]
        {
            if rest.starts_with(word) {
                self.skip(word.len());
                return Token::Number(value);
            }
        }
        let is_part = |at: &usize| match bytes.get(*at) {
            Some(b'0'..=b'9' | b'.') => true,
            Some(b'e' | b'E') => {
                matches!(bytes.get(at + 1), Some(b'0'..=b'9' | b'-' | b'+'))
            }
            Some(b'-' | b'+') => *at == 0 || matches!(bytes[at - 1], b'e' | b'E'),
            _ => false,
        };
        let length = (0..).take_while(is_part).count();
        match rest[..length].parse() {
            Ok(number) => {
                self.skip(length);
                Token::Number(number)
            }
            Err(_) => {
                self.skip(1);
                Token::Mark(first)
            }
        }
    }

    fn quoted(&mut self, quote: char) -> Result<Token<'t>, Wrong> {
        let rest = self.rest();
        let three: String = std::iter::repeat_n(quote, 3).collect();
        let mark = if rest.starts_with(&three) { three.as_str() } else { &three[..1] };
        let body = &rest[mark.len()..];
        let mut at = 0;
        let mut is_escaped = false;
        loop {
            let Some(found) = body[at..].find([quote, '\\', '\n']) else {
                return Err(self.wrong(Fault::Unfinished("a text in quotes")));
            };
            at += found;
            if body[at..].starts_with('\\') {
                is_escaped = true;
                let after = body[at + 1..].chars().next().map_or(0, char::len_utf8);
                at += 1 + after;
            } else if body[at..].starts_with(mark) {
                break;
            } else if body[at..].starts_with('\n') && mark.len() == 1 {
                return Err(self.wrong(Fault::Unfinished("a text in quotes")));
            } else {
                at += 1;
            }
        }
        let inside = &body[..at];
        self.skip(2 * mark.len() + at);
        let text = if is_escaped { Cow::Owned(unescaped(inside)) } else { Cow::Borrowed(inside) };
        Ok(Token::Text(text))
    }

    fn asset(&mut self) -> Result<Token<'t>, Wrong> {
        let rest = self.rest();
        let (mark, body) = match rest.strip_prefix("@@@") {
            Some(body) => ("@@@", body),
            None => ("@", &rest[1..]),
        };
        let mut at = 0;
        loop {
            let Some(found) = body[at..].find(mark) else {
                return Err(self.wrong(Fault::Unfinished("a path of a file")));
            };
            at += found;
            if mark.len() == 3 && body[..at].ends_with('\\') {
                at += mark.len();
                continue;
            }
            break;
        }
        let inside = &body[..at];
        self.skip(2 * mark.len() + at);
        Ok(Token::Asset(match mark.len() {
            3 if inside.contains("\\@@@") => Cow::Owned(inside.replace("\\@@@", "@@@")),
            _ => Cow::Borrowed(inside),
        }))
    }
}

/// The name that a text begins with; parts are joined by `:`.
fn name(text: &str) -> &str {
    let is_part = |one: char| one == '_' || one.is_alphanumeric();
    let mut end = 0;
    loop {
        let part = text[end..].find(|one| !is_part(one)).unwrap_or(text.len() - end);
        end += part;
        let mut after = text[end..].chars();
        if !(after.next() == Some(':') && after.next().is_some_and(is_part)) {
            return &text[..end];
        }
        end += 1;
    }
}

fn unescaped(text: &str) -> String {
    let mut bytes = Vec::with_capacity(text.len());
    let mut rest = text;
    while let Some(at) = rest.find('\\') {
        bytes.extend_from_slice(&rest.as_bytes()[..at]);
        rest = &rest[at + 1..];
        let Some(next) = rest.chars().next() else { break };
        rest = &rest[next.len_utf8()..];
        let is_octal = |one: &char| matches!(one, '0'..='7');
        match next {
            'n' => bytes.push(b'\n'),
            't' => bytes.push(b'\t'),
            'r' => bytes.push(b'\r'),
            'a' => bytes.push(7),
            'b' => bytes.push(8),
            'f' => bytes.push(12),
            'v' => bytes.push(11),
            'x' => {
                let digits = rest.chars().take(2).take_while(char::is_ascii_hexdigit).count();
                bytes.push(u8::from_str_radix(&rest[..digits], 16).unwrap_or_default());
                rest = &rest[digits..];
            }
            '0'..='7' => {
                let digits: String = std::iter::once(next)
                    .chain(rest.chars().take(2).take_while(is_octal))
                    .collect();
                bytes.push(u16::from_str_radix(&digits, 8).unwrap_or_default() as u8);
                rest = &rest[digits.len() - 1..];
            }
            other => bytes.extend_from_slice(other.encode_utf8(&mut [0; 4]).as_bytes()),
        }
    }
    bytes.extend_from_slice(rest.as_bytes());
    String::from_utf8_lossy(&bytes).into_owned()
}

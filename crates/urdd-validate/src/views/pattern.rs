//! Patterns of JavaScript in Unicode mode (11.1): their grammar, and where the library that matches them reads one otherwise,
//! the same pattern in its words.

use std::borrow::Cow;

/// What no text matches.
const NEVER: &str = "[^\\s\\S]";
/// `.`: all but the four ends of lines.
const NOT_AN_END_OF_LINE: &str = "[^\\n\\r\\u{2028}\\u{2029}]";

type Fault = &'static str;

const UNCLOSED: Fault = "a `[` is not closed";
const NOTHING_TO_REPEAT: Fault = "there is nothing to repeat before `*`, `+`, `?` or `{`";
const WRONG_COUNT: Fault =
    "`{` needs a number, or two that ascend, and `}`; as a character it is `\\{`";
const ALONE: Fault = "`]` and `}` are characters only behind a backslash";
const WRONG_GROUP: Fault = "`(?` begins no group that there is";
const WRONG_ESCAPE: Fault = "a backslash is before what needs none, or has too little behind it";
const WRONG_RANGE: Fault = "a range has a set at one of its ends; write the `-` as `\\-`";

/// The pattern as the library has it. What it refuses by itself (groups that are open, lookaround, references) stays.
///
/// # Errors
/// Why it is not a pattern of JavaScript in Unicode mode.
pub fn in_words_of_the_library(pattern: &str) -> Result<Cow<'_, str>, Fault> {
    let mut reader = PatternReader { rest: pattern, out: String::with_capacity(pattern.len()) };
    let mut can_repeat = false;
    while let Some(next) = reader.take() {
        can_repeat = match next {
            '^' | '$' | '|' => reader.put(next, false),
            '(' => reader.group()?,
            '*' | '+' | '?' | '{' if !can_repeat => return Err(NOTHING_TO_REPEAT),
            '*' | '+' | '?' => reader.repetition(next),
            '{' => reader.count()?,
            ']' | '}' => return Err(ALONE),
            '[' => reader.class()?,
            '.' => reader.put_all(NOT_AN_END_OF_LINE),
            '\\' => reader.escape(false)? != Escape::Place,
            other => reader.put(other, true),
        };
    }
    let out = reader.out;
    Ok(if out == pattern { Cow::Borrowed(pattern) } else { Cow::Owned(out) })
}

/// What an escape stands for.
#[derive(Clone, Copy, PartialEq)]
enum Escape {
    Character,
    Set,
    /// The edge of a word, or none.
    Place,
}

struct PatternReader<'p> {
    rest: &'p str,
    out: String,
}

impl<'p> PatternReader<'p> {
    fn take(&mut self) -> Option<char> {
        let next = self.rest.chars().next()?;
        self.rest = &self.rest[next.len_utf8()..];
        Some(next)
    }

    fn put(&mut self, character: char, can_repeat: bool) -> bool {
        self.out.push(character);
        can_repeat
    }

    fn put_all(&mut self, text: &str) -> bool {
        self.out += text;
        true
    }

    fn put_code(&mut self, code: u32) {
        self.out += &format!("\\u{{{code:X}}}");
    }

    /// Takes and copies what begins as this says, up to and with an end.
    fn copy_until(&mut self, end: char, is_part: fn(char) -> bool) -> Option<&'p str> {
        let (inside, rest) = self.rest.split_once(end)?;
        if !inside.chars().all(is_part) {
            return None;
        }
        self.out += inside;
        self.out.push(end);
        self.rest = rest;
        Some(inside)
    }

    /// Behind `(`.
    fn group(&mut self) -> Result<bool, Fault> {
        self.out.push('(');
        let Some(kind) = self.rest.strip_prefix('?') else { return Ok(false) };
        self.rest = kind;
        self.out.push('?');
        // Lookaround is left to the library, which refuses it.
        let is_other = kind.starts_with(['<', '=', '!']);
        let is_flag = |character| "ims-".contains(character);
        if !is_other && self.copy_until(':', is_flag).is_none() {
            return Err(WRONG_GROUP);
        }
        Ok(false)
    }

    /// Behind `*`, `+` or `?`.
    fn repetition(&mut self, kind: char) -> bool {
        self.out.push(kind);
        if let Some(rest) = self.rest.strip_prefix('?') {
            self.rest = rest;
            self.out.push('?');
        }
        false
    }

    /// Behind `{`.
    fn count(&mut self) -> Result<bool, Fault> {
        self.out.push('{');
        let inside =
            self.copy_until('}', |character| character.is_ascii_digit() || character == ',');
        let (least, most) = inside.map_or(("", ""), |of| of.split_once(',').unwrap_or((of, of)));
        let number = |digits: &str| digits.parse().unwrap_or(u64::MAX);
        if least.is_empty()
            || most.contains(',')
            || !most.is_empty() && number(most) < number(least)
        {
            return Err(WRONG_COUNT);
        }
        let end = self.out.pop().unwrap_or('}');
        Ok(self.repetition(end))
    }

    /// Behind `[`.
    fn class(&mut self) -> Result<bool, Fault> {
        let start = self.out.len();
        self.out.push('[');
        let is_negated = self.rest.starts_with('^');
        if is_negated {
            self.take();
            self.out.push('^');
        }
        let inside = self.out.len();
        // What a range could begin with.
        let mut before = None;
        loop {
            let next = self.take().ok_or(UNCLOSED)?;
            if next == ']' {
                break;
            }
            let is_range = next == '-' && before.is_some() && !self.rest.starts_with(']');
            let atom = if is_range {
                self.out.push('-');
                self.take().ok_or(UNCLOSED)?
            } else {
                next
            };
            let kind = match atom {
                '\\' => self.escape(true)?,
                other => {
                    self.out.push(other);
                    Escape::Character
                }
            };
            if is_range && (before == Some(Escape::Set) || kind == Escape::Set) {
                return Err(WRONG_RANGE);
            }
            before = (!is_range).then_some(kind);
        }
        if self.out.len() > inside {
            return Ok(self.put(']', true));
        }
        self.out.truncate(start);
        Ok(self.put_all(if is_negated { "[\\s\\S]" } else { NEVER }))
    }

    /// Behind a backslash.
    fn escape(&mut self, is_in_class: bool) -> Result<Escape, Fault> {
        let next = self.take().ok_or(WRONG_ESCAPE)?;
        match next {
            'b' if is_in_class => self.put_code(8),
            '0' if !self.rest.starts_with(|next: char| next.is_ascii_digit()) => self.put_code(0),
            'c' => {
                let letter = self.take().filter(char::is_ascii_alphabetic).ok_or(WRONG_ESCAPE)?;
                self.put_code(u32::from(letter) % 32);
            }
            'x' => {
                let code = self.digits(2)?;
                self.put_code(code);
            }
            'u' => return self.code_point(is_in_class),
            '-' if !is_in_class => return Err(WRONG_ESCAPE),
            // References to groups are left to the library, which refuses them.
            'b' | 'B' | 'k' | '1'..='9' if is_in_class => return Err(WRONG_ESCAPE),
            'f' | 'n' | 'r' | 't' | 'v' | '-' | '/' | 'k' | '1'..='9' => self.plain(next),
            '^' | '$' | '\\' | '.' | '*' | '+' | '?' | '(' | ')' | '[' | ']' | '{' | '}' | '|' => {
                self.plain(next);
            }
            'b' | 'B' => {
                // Its words are of ASCII.
                self.out += "(?-u:";
                self.plain(next);
                self.out.push(')');
                return Ok(Escape::Place);
            }
            'd' | 'D' | 's' | 'S' | 'w' | 'W' => {
                self.plain(next);
                return Ok(Escape::Set);
            }
            'p' | 'P' if self.rest.starts_with('{') => {
                self.plain(next);
                let is_part =
                    |part: char| part.is_ascii_alphanumeric() || matches!(part, '{' | '_' | '=');
                self.copy_until('}', is_part).ok_or(WRONG_ESCAPE)?;
                return Ok(Escape::Set);
            }
            _ => return Err(WRONG_ESCAPE),
        }
        Ok(Escape::Character)
    }

    fn plain(&mut self, escaped: char) {
        self.out.push('\\');
        self.out.push(escaped);
    }

    /// Takes so many hexadecimal digits.
    fn digits(&mut self, count: usize) -> Result<u32, Fault> {
        let digits = self.rest.get(..count).ok_or(WRONG_ESCAPE)?;
        self.rest = &self.rest[count..];
        hexadecimal(digits)
    }

    /// Behind `\u`: a pair of surrogates is one character, and half of one is in no text.
    fn code_point(&mut self, is_in_class: bool) -> Result<Escape, Fault> {
        let code = match self.rest.strip_prefix('{').and_then(|inside| inside.split_once('}')) {
            Some((digits, rest)) => {
                self.rest = rest;
                hexadecimal(digits)?
            }
            None => self.digits(4)?,
        };
        let code = match (code, self.rest.strip_prefix("\\u")) {
            (0xD800..0xDC00, Some(rest)) => {
                let low = rest.get(..4).and_then(|digits| hexadecimal(digits).ok());
                match low.filter(|low| (0xDC00..0xE000).contains(low)) {
                    Some(low) => {
                        self.rest = &rest[4..];
                        0x10000 + ((code - 0xD800) << 10) + (low - 0xDC00)
                    }
                    None => code,
                }
            }
            _ => code,
        };
        match char::from_u32(code) {
            None if code > 0x10_FFFF => return Err(WRONG_ESCAPE),
            None if !is_in_class => self.out += NEVER,
            // The library refuses half a pair in a class.
            _ => self.put_code(code),
        }
        Ok(Escape::Character)
    }
}

fn hexadecimal(digits: &str) -> Result<u32, Fault> {
    let is_right = !digits.is_empty() && digits.bytes().all(|digit| digit.is_ascii_hexdigit());
    let digits = digits.trim_start_matches('0');
    match (is_right, digits) {
        (true, "") => Ok(0),
        (true, digits) => u32::from_str_radix(digits, 16).map_err(|_| WRONG_ESCAPE),
        (false, _) => Err(WRONG_ESCAPE),
    }
}

//! Characters and names of XML, and the grammar of what the parser skips: the XML declaration, the heads of processing
//! instructions, and document types (XML 1.0, productions 16, 17, 23 to 28, 45 to 60, 75 to 83). Entities are refused
//! elsewhere, so no reference to one can be right here.

/// Whether a name has at most one `:`, between two parts.
pub fn is_qualified(name: &str) -> bool {
    !name.starts_with(':') && !name.ends_with(':') && name.matches(':').count() <= 1
}

/// Whether a text, from its `<?xml` on, begins with an XML declaration. What version and encoding are is not asked.
pub fn has_declaration(text: &str) -> bool {
    let mut reader = Reader { rest: text, is_inside: false };
    reader.declaration().is_some()
}

/// Whether a text, from its `<?` on, begins with a processing instruction.
pub fn has_instruction(text: &str) -> bool {
    let mut reader = Reader { rest: text, is_inside: false };
    reader.expect("<?").and_then(|()| reader.instruction()).is_some()
}

/// Whether `&#…;` with this between its marks is a reference to a character of XML.
pub fn is_character_number(digits: &str) -> bool {
    let number = match digits.strip_prefix('x') {
        Some(digits) => u32::from_str_radix(digits, 16),
        None => digits.parse(),
    };
    let is_signed = digits.contains('+');
    !is_signed && number.ok().and_then(char::from_u32).is_some_and(is_character)
}

/// Whether XML 1.0 allows a character (production 2).
pub fn is_character(c: char) -> bool {
    matches!(c, '\t' | '\n' | '\r' | ' '..='\u{d7ff}' | '\u{e000}'..='\u{fffd}' | '\u{10000}'..)
}

const SPACE: [char; 4] = [' ', '\t', '\r', '\n'];
const HEAD: &str = "the document type (`<!DOCTYPE`) is not well-formed; remove it";
const INSIDE: &str =
    "a declaration within `<!DOCTYPE ...>` cannot be read; remove the document type";

/// The fault of a document type declaration, and its offset in the text, which begins with `<!DOCTYPE`.
pub fn fault(text: &str) -> Option<(usize, &'static str)> {
    let mut reader = Reader { rest: &text["<!DOCTYPE".len()..], is_inside: false };
    let is_read = reader.document_type().is_some();
    let end = text.len() - reader.rest.len();
    let odd = text[..end].find(|c: char| !is_character(c));
    let at = odd.or_else(|| (!is_read).then_some(end))?;
    Some((at, if reader.is_inside || odd.is_some() { INSIDE } else { HEAD }))
}

/// Reads from the start of what is left; `None` is a fault there.
struct Reader<'t> {
    rest: &'t str,
    /// Whether it is between `[` and `]`.
    is_inside: bool,
}

impl<'t> Reader<'t> {
    fn declaration(&mut self) -> Option<()> {
        self.expect("<?xml")?;
        self.stated("version")?;
        if self.comes("encoding") {
            self.stated("encoding")?;
        }
        if self.comes("standalone") {
            matches!(self.stated("standalone")?, "yes" | "no").then_some(())?;
        }
        self.skip_space();
        self.expect("?>")
    }

    /// White space, a name, and what it is said to be.
    fn stated(&mut self, name: &str) -> Option<&'t str> {
        self.space()?;
        self.expect(name)?;
        self.skip_space();
        self.expect("=")?;
        self.skip_space();
        self.quoted().filter(|value| !value.contains("?>"))
    }

    fn comes(&self, word: &str) -> bool {
        self.rest.trim_start_matches(SPACE).starts_with(word)
    }

    fn document_type(&mut self) -> Option<()> {
        self.space()?;
        self.qualified()?;
        if self.skip_space() && !self.rest.starts_with(['[', '>']) {
            self.external(true)?;
            self.skip_space();
        }
        if self.take("[") {
            self.is_inside = true;
            self.subset()?;
            self.is_inside = false;
            self.skip_space();
        }
        self.expect(">")
    }

    fn subset(&mut self) -> Option<()> {
        loop {
            self.skip_space();
            if self.take("]") {
                return Some(());
            } else if self.take("<!--") {
                self.until("--")?;
                self.expect(">")?;
            } else if self.take("<?") {
                self.instruction()?;
            } else if self.take("<!ELEMENT") {
                self.element()?;
            } else if self.take("<!ATTLIST") {
                self.attributes()?;
            } else {
                self.expect("<!NOTATION")?;
                self.space()?;
                self.name().filter(|name| !name.contains(':'))?;
                self.space()?;
                self.external(false)?;
                self.skip_space();
                self.expect(">")?;
            }
        }
    }

    fn instruction(&mut self) -> Option<()> {
        let target = self.name()?;
        if target.eq_ignore_ascii_case("xml") || target.contains(':') {
            return None;
        }
        if !self.rest.starts_with("?>") {
            self.space()?;
        }
        self.until("?>").map(|_| ())
    }

    fn element(&mut self) -> Option<()> {
        self.space()?;
        self.qualified()?;
        self.space()?;
        if !self.take("EMPTY") && !self.take("ANY") {
            self.expect("(")?;
            self.skip_space();
            if self.take("#PCDATA") { self.mixed()? } else { self.children()? }
        }
        self.skip_space();
        self.expect(">")
    }

    /// What follows `(#PCDATA`.
    fn mixed(&mut self) -> Option<()> {
        let mut is_repeated = false;
        loop {
            self.skip_space();
            if self.take(")") {
                return if self.take("*") || !is_repeated { Some(()) } else { None };
            }
            self.expect("|")?;
            self.skip_space();
            self.qualified()?;
            is_repeated = true;
        }
    }

    /// What follows the first `(`. Groups in groups are on a stack of their own, each with what separates its parts.
    fn children(&mut self) -> Option<()> {
        let mut open: Vec<Option<char>> = vec![None];
        loop {
            self.skip_space();
            if self.take("(") {
                open.push(None);
                continue;
            }
            self.qualified()?;
            loop {
                // How often the part before may stand.
                let _ = self.take("?") || self.take("*") || self.take("+");
                if open.is_empty() {
                    return Some(());
                }
                self.skip_space();
                if self.take(")") {
                    open.pop();
                    continue;
                }
                let found = self.rest.chars().next().filter(|c| matches!(c, '|' | ','))?;
                let separator = open.last_mut()?;
                if *separator.get_or_insert(found) != found {
                    return None;
                }
                self.rest = &self.rest[1..];
                break;
            }
        }
    }

    fn attributes(&mut self) -> Option<()> {
        self.space()?;
        self.qualified()?;
        loop {
            let spaced = self.skip_space();
            if self.take(">") {
                return Some(());
            }
            spaced.then_some(())?;
            self.qualified()?;
            self.space()?;
            self.attribute_type()?;
            self.space()?;
            if self.take("#REQUIRED") || self.take("#IMPLIED") {
                continue;
            }
            if self.take("#FIXED") {
                self.space()?;
            }
            let value = self.quoted()?;
            (!value.contains('<') && has_right_references(value)).then_some(())?;
        }
    }

    fn attribute_type(&mut self) -> Option<()> {
        // The longer ones first.
        const WORDS: [&str; 8] =
            ["CDATA", "IDREFS", "IDREF", "ID", "ENTITIES", "ENTITY", "NMTOKENS", "NMTOKEN"];
        if WORDS.iter().any(|word| self.take(word)) {
            return Some(());
        }
        let is_notation = self.take("NOTATION");
        if is_notation {
            self.space()?;
        }
        self.expect("(")?;
        loop {
            self.skip_space();
            if is_notation {
                self.name().filter(|name| !name.contains(':'))?;
            } else {
                self.token()?;
            }
            self.skip_space();
            if self.take(")") {
                return Some(());
            }
            self.expect("|")?;
        }
    }

    /// `SYSTEM "…"` or `PUBLIC "…" "…"`, of which the last may be absent in a notation.
    fn external(&mut self, needs_system: bool) -> Option<()> {
        let is_public = self.take("PUBLIC");
        if is_public {
            self.space()?;
            let is_public =
                |c: char| c.is_ascii_alphanumeric() || " \r\n-'()+,./:=?;!*#@$_%".contains(c);
            self.quoted()?.chars().all(is_public).then_some(())?;
        } else {
            self.expect("SYSTEM")?;
        }
        let before = self.rest;
        let spaced = self.skip_space();
        if is_public && !needs_system && !self.rest.starts_with(['"', '\'']) {
            self.rest = before;
            return Some(());
        }
        spaced.then_some(())?;
        self.quoted().map(|_| ())
    }

    fn quoted(&mut self) -> Option<&'t str> {
        let quote = self.rest.chars().next().filter(|c| matches!(c, '"' | '\''))?;
        self.rest = &self.rest[1..];
        self.until(if quote == '"' { "\"" } else { "'" })
    }

    /// What stands before a mark, which is passed over too.
    fn until(&mut self, mark: &str) -> Option<&'t str> {
        let (before, after) = self.rest.split_once(mark)?;
        self.rest = after;
        Some(before)
    }

    fn qualified(&mut self) -> Option<&'t str> {
        let name = self.name().filter(|name| is_qualified(name))?;
        let (_, local) = name.split_once(':').unwrap_or_default();
        (local.is_empty() || local.starts_with(begins_name)).then_some(name)
    }

    fn name(&mut self) -> Option<&'t str> {
        self.rest.starts_with(begins_name).then_some(())?;
        self.token()
    }

    fn token(&mut self) -> Option<&'t str> {
        let end = self.rest.find(|c| !continues_name(c)).unwrap_or(self.rest.len());
        let (token, rest) = self.rest.split_at(end);
        self.rest = rest;
        (!token.is_empty()).then_some(token)
    }

    fn space(&mut self) -> Option<()> {
        self.skip_space().then_some(())
    }

    fn skip_space(&mut self) -> bool {
        let rest = self.rest.trim_start_matches(SPACE);
        let is_found = rest.len() < self.rest.len();
        self.rest = rest;
        is_found
    }

    fn take(&mut self, word: &str) -> bool {
        let rest = self.rest.strip_prefix(word);
        self.rest = rest.unwrap_or(self.rest);
        rest.is_some()
    }

    fn expect(&mut self, word: &str) -> Option<()> {
        self.take(word).then_some(())
    }
}

/// Whether each `&` of an attribute's default begins a reference to a character or one of XML's five entities.
fn has_right_references(value: &str) -> bool {
    value.split('&').skip(1).all(|after| {
        after.split_once(';').is_some_and(|(name, _)| match name.strip_prefix('#') {
            Some(number) => is_character_number(number),
            None => matches!(name, "amp" | "lt" | "gt" | "quot" | "apos"),
        })
    })
}

/// Production 4.
fn begins_name(c: char) -> bool {
    matches!(c, ':' | '_' | 'A'..='Z' | 'a'..='z' | '\u{c0}'..='\u{d6}' | '\u{d8}'..='\u{f6}'
        | '\u{f8}'..='\u{2ff}' | '\u{370}'..='\u{37d}' | '\u{37f}'..='\u{1fff}' | '\u{200c}'..='\u{200d}'
        | '\u{2070}'..='\u{218f}' | '\u{2c00}'..='\u{2fef}' | '\u{3001}'..='\u{d7ff}'
        | '\u{f900}'..='\u{fdcf}' | '\u{fdf0}'..='\u{fffd}' | '\u{10000}'..='\u{effff}')
}

/// Production 4a.
fn continues_name(c: char) -> bool {
    begins_name(c)
        || matches!(c, '-' | '.' | '0'..='9' | '\u{b7}' | '\u{300}'..='\u{36f}' | '\u{203f}'..='\u{2040}')
}

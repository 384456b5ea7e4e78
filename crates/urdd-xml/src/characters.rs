//! Characters and names of XML.

/// Whether a name has at most one `:`, between two parts.
pub fn is_qualified(name: &str) -> bool {
    !name.starts_with(':') && !name.ends_with(':') && name.matches(':').count() <= 1
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

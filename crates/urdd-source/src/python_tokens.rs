//! The tokens of a call in Python: in setup.py and in launch files.

/// Maximum length of such a call, in bytes.
const MAX_CALL: usize = 4096;

/// A part of a call.
#[derive(PartialEq)]
pub(super) enum Token {
    Text(String),
    Word(String),
    Mark(char),
}

/// The tokens of a call to its end; of texts, only plain ones.
pub(super) fn tokens(text: &str) -> Vec<Token> {
    let mut tokens = Vec::new();
    let mut depth = 0;
    let mut rest = text.char_indices().peekable();
    while let Some((at, c)) = rest.next().filter(|(at, _)| *at < MAX_CALL) {
        match c {
            '#' => while rest.next_if(|(_, c)| *c != '\n').is_some() {},
            '"' | '\'' => {
                let end = text[at + 1..].find(c).map_or(text.len(), |end| at + 1 + end);
                tokens.push(Token::Text(text[at + 1..end].to_owned()));
                while rest.next_if(|(at, _)| *at <= end).is_some() {}
            }
            ')' if depth == 0 => break,
            c if c.is_alphanumeric() || c == '_' => {
                let mut word = String::from(c);
                while let Some((_, c)) = rest.next_if(|(_, c)| c.is_alphanumeric() || *c == '_') {
                    word.push(c);
                }
                tokens.push(Token::Word(word));
            }
            c if c.is_whitespace() => {}
            c => {
                depth += i32::from(c == '(') - i32::from(c == ')');
                tokens.push(Token::Mark(c));
            }
        }
    }
    tokens
}

//! The choices that launch files in Python give for arguments, read as text: nothing is run.

/// The call that declares an argument.
const DECLARES: &str = "DeclareLaunchArgument(";
/// Maximum length of such a call, in bytes.
const MAX_CALL: usize = 4096;

/// The arguments with `choices=[...]` of literals, and these.
pub fn choices(text: &str) -> impl Iterator<Item = (String, Vec<String>)> {
    text.match_indices(DECLARES).filter_map(|(at, call)| of_call(&text[at + call.len()..]))
}

/// A part of a call.
#[derive(PartialEq)]
pub(super) enum Token {
    Text(String),
    Word(String),
    Mark(char),
}

/// The argument of a call that begins here, and its choices.
fn of_call(text: &str) -> Option<(String, Vec<String>)> {
    let tokens = tokens(text);
    let first = match (tokens.first()?, tokens.get(1), tokens.get(2)) {
        (Token::Text(name), ..) => name,
        (Token::Word(word), Some(Token::Mark('=')), Some(Token::Text(name))) if word == "name" => {
            name
        }
        _ => return None,
    };
    let begin = [Token::Word("choices".to_owned()), Token::Mark('='), Token::Mark('[')];
    let at = tokens.windows(begin.len()).position(|window| *window == begin)?;
    let mut values = Vec::new();
    for pair in tokens[at + begin.len()..].chunks(2) {
        match pair {
            [Token::Mark(']'), ..] => break,
            [Token::Text(value), Token::Mark(end @ (',' | ']'))] => {
                values.push(value.clone());
                if *end == ']' {
                    break;
                }
            }
            _ => return None,
        }
    }
    Some((first.clone(), values))
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

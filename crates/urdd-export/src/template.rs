//! Files that are nearly the same for every robot, as templates.

/// Puts values in the place of words between `@`. A value may have the word of another: a line has one word at most. A
/// word alone on its line stands for any number of whole lines.
pub(super) fn fill(template: &str, values: &[(&str, String)]) -> String {
    let mut text = String::new();
    for line in template.lines() {
        let word = |word: &str| format!("@{word}@");
        let filled = match values.iter().find(|(name, _)| line.contains(&word(name))) {
            Some((name, value)) => line.replace(&word(name), value),
            None => format!("{line}\n"),
        };
        text += &filled;
        if !filled.is_empty() && !filled.ends_with('\n') {
            text.push('\n');
        }
    }
    text
}

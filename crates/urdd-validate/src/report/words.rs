//! Words that several reports use.

/// Codes, or where they are many, how many of which families.
pub(super) fn list(codes: &[String]) -> String {
    const MOST: usize = 8;
    if codes.len() <= MOST {
        return codes.join(" ");
    }
    let mut families: Vec<&str> = codes
        .iter()
        .map(|code| &code[..code.len().min(3)])
        .collect();
    families.sort_unstable();
    families.dedup();
    format!("{} ({})", plural(codes.len(), "rule"), families.join(", "))
}

/// A number of things.
pub(super) fn plural(count: usize, unit: &str) -> String {
    format!("{count} {unit}{}", if count == 1 { "" } else { "s" })
}

//! Lists in messages.

/// A list of indices, as a report has it: cut where it is long.
pub(super) fn list(indices: &[usize]) -> String {
    const LONGEST: usize = 12;
    let shown: Vec<String> = indices.iter().take(LONGEST).map(usize::to_string).collect();
    match indices.len() {
        0..=LONGEST => format!("[{}]", shown.join(", ")),
        all => format!("[{}, … {all} in all]", shown.join(", ")),
    }
}

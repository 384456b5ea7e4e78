//! Groups of groups.

/// A group and all groups in it, each once; `None` if it contains itself. `inner` has the groups that are directly in one
/// of the `count` groups.
pub(super) fn within<'a>(
    group: usize,
    count: usize,
    inner: impl Fn(usize) -> &'a [usize],
) -> Option<Vec<usize>> {
    let mut found = vec![group];
    let mut is_seen = vec![false; count];
    let mut next = 0;
    while let Some(&at) = found.get(next) {
        next += 1;
        for other in inner(at) {
            if *other == group {
                return None;
            }
            if !std::mem::replace(&mut is_seen[*other], true) {
                found.push(*other);
            }
        }
    }
    Some(found)
}

/// What is wrong with a group that contains itself.
pub(super) fn contains_itself(group: &str) -> String {
    format!("the group `{}` contains itself", group.escape_debug())
}

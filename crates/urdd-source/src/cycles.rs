//! Cycles among things of which each leads to at most one other: links to parents, joints to the joints that they mimic.

/// The cycles of `next`, in the order in which walks from 0, 1, … meet them. Each begins where its walk enters it; those
/// that only lead into a cycle are not part of it. Visits nothing twice.
pub fn cycles(next: &[Option<usize>]) -> Vec<Vec<usize>> {
    // For each, the walk that visited it first. A walk that meets itself has found a cycle.
    let mut walk_of = vec![usize::MAX; next.len()];
    let mut found = Vec::new();
    for start in 0..next.len() {
        let mut now = start;
        while walk_of[now] == usize::MAX {
            walk_of[now] = start;
            match next[now] {
                Some(other) => now = other,
                None => break,
            }
        }
        if walk_of[now] == start && next[now].is_some() {
            let around = std::iter::successors(next[now], |at| next[*at]);
            let others = around.take_while(|at| *at != now);
            found.push(std::iter::once(now).chain(others).collect());
        }
    }
    found
}

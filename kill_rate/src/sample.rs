//! Samples from the possible mutations.

use std::collections::BTreeMap;

use super::dice::Dice;
use super::mutation::Mutation;
use super::plan::Plan;

/// Samples mutations of one field, so that every kind occurs once before any kind occurs again.
///
/// `changes` returns the mutations of a place; `count` is the number of places.
pub(crate) fn draw(
    plan: &Plan,
    count: usize,
    dice: &mut Dice,
    mut changes: impl FnMut(usize, &mut Dice) -> Vec<Mutation>,
) -> Vec<Mutation> {
    let most = plan.per_field.unwrap_or(usize::MAX);
    let mut by_kind: BTreeMap<&'static str, Vec<Mutation>> = BTreeMap::new();
    for place in dice.choose(count, most) {
        for change in changes(place, dice) {
            by_kind.entry(change.description.kind).or_default().push(change);
        }
    }
    // Shuffle the kinds, so that small samples have different kinds in each field.
    let mut kinds: Vec<_> = by_kind.into_values().collect();
    let order = dice.choose(kinds.len(), kinds.len());
    let kinds = order.into_iter().map(|kind| std::mem::take(&mut kinds[kind]));
    in_turn(kinds.collect(), most)
}

/// Round-robin: one of each list in turn, up to `most` in total.
pub(crate) fn in_turn<T>(lists: Vec<Vec<T>>, most: usize) -> Vec<T> {
    let mut lists: Vec<_> = lists.into_iter().map(Vec::into_iter).collect();
    let mut out = Vec::new();
    loop {
        let before = out.len();
        for list in &mut lists {
            if out.len() < most {
                out.extend(list.next());
            }
        }
        if out.len() == before {
            return out;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn takes_one_of_each_in_turn() {
        let lists = vec![vec![1, 2, 3], vec![], vec![10], vec![20, 21]];
        assert_eq!(in_turn(lists.clone(), 5), [1, 10, 20, 2, 21]);
        assert_eq!(in_turn(lists, 100).len(), 6);
    }
}

//! Orders that have no meaning of their own.

use crate::parts::matched;
use crate::side::Side;

/// Notes on links and joints in another order. What an order of joints means, the indices of DOFs, is in `dofs`.
pub(super) fn notes(before: &Side, after: &Side) -> Vec<String> {
    let is_other = |a: Vec<&str>, b: Vec<&str>| {
        let both = matched(&a, &b).into_iter().filter_map(|part| part.both());
        !both.map(|(_, j)| j).is_sorted()
    };
    let orders = [
        ("links", is_other(before.link_names(), after.link_names())),
        ("joints", is_other(before.joint_names(), after.joint_names())),
    ];
    let others = orders.into_iter().filter(|(_, is_other)| *is_other);
    let note = |word| format!("the {word} are in another order, so their indices in a URDD differ");
    others.map(|(word, _)| note(word)).collect()
}

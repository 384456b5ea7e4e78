//! Elements of an SRDF that is written.

use urdd_xml::writer::Element;

/// A pair of links that is not checked, and why.
pub fn disabled([a, b]: [&str; 2], reason: &str) -> Element {
    Element::new("disable_collisions").with("link1", a).with("link2", b).with("reason", reason)
}

/// A group, or a group in another one.
pub fn group(name: &str) -> Element {
    Element::new("group").with("name", name)
}

/// A joint, in a group.
pub fn joint(name: &str) -> Element {
    Element::new("joint").with("name", name)
}

/// A state of a group: the values of its joints.
pub fn state<'a>(
    name: &str,
    group: &str,
    values: impl IntoIterator<Item = (&'a str, String)>,
) -> Element {
    let mut state = Element::new("group_state").with("name", name).with("group", group);
    state.extend(values.into_iter().map(|(name, value)| joint(name).with("value", value)));
    state
}

//! Element lookup in a COLLADA document.

use std::borrow::Cow;
use std::collections::HashMap;

use percent_encoding::percent_decode_str;
use urdd_xml::Node;

/// Elements by tag and id. Of those with the same tag and id, the first counts. The tag is part of the key because real
/// files reuse ids across tags.
pub(super) struct Elements<'a>(HashMap<(&'a str, &'a str), Node<'a, 'a>>);

impl<'a> Elements<'a> {
    pub(super) fn new(nodes: impl Iterator<Item = Node<'a, 'a>>) -> Self {
        let mut by_id = HashMap::new();
        for node in nodes.filter(Node::is_element) {
            if let Some(id) = node.attribute("id") {
                by_id.entry((node.tag_name().name(), id)).or_insert(node);
            }
        }
        Self(by_id)
    }

    /// The element with this tag that a document-internal URL references.
    pub(super) fn find(&self, tag: &str, url: &str) -> Option<Node<'a, 'a>> {
        let url = url.trim();
        let id = url.strip_prefix('#').unwrap_or(url);
        // The keys have the document's lifetime; look up with a shorter one.
        self.0.get(&(tag, id) as &(&str, &str)).copied()
    }
}

/// A document.
pub(super) struct Document<'a> {
    pub(super) root: Node<'a, 'a>,
    elements: Elements<'a>,
}

impl<'a> Document<'a> {
    pub(super) fn new(root: Node<'a, 'a>) -> Self {
        Self { root, elements: Elements::new(root.descendants()) }
    }

    /// The element with this tag that a document-internal URL references.
    pub(super) fn find(&self, tag: &str, url: &str) -> Option<Node<'a, 'a>> {
        self.elements.find(tag, url)
    }

    /// The names of all image files, relative to the document.
    pub(super) fn images(&self) -> Vec<String> {
        children(self.root, "library_images")
            .flat_map(|library| children(library, "image"))
            .filter_map(file_of_image)
            .collect()
    }
}

/// The name of an image's file, relative to the document.
pub(super) fn file_of_image(image: Node<'_, '_>) -> Option<String> {
    let from = child(image, "init_from")?;
    Some(path_of_url(child(from, "ref").unwrap_or(from).text()?.trim()))
}

/// The children with this tag, in any namespace (1.4 and 1.5 have different ones).
pub(super) fn children<'a>(node: Node<'a, 'a>, tag: &'a str) -> impl Iterator<Item = Node<'a, 'a>> {
    node.children().filter(move |child| child.is_element() && child.tag_name().name() == tag)
}

/// The first child with this tag.
pub(super) fn child<'a>(node: Node<'a, 'a>, tag: &'a str) -> Option<Node<'a, 'a>> {
    children(node, tag).next()
}

/// All text of an element; comments may split it.
pub(super) fn text<'a>(node: Node<'a, 'a>) -> Cow<'a, str> {
    let mut texts = node.children().filter(Node::is_text).filter_map(|part| part.text());
    let first = texts.next().unwrap_or("");
    match texts.next() {
        None => Cow::Borrowed(first),
        Some(second) => {
            Cow::Owned([first, second].into_iter().chain(texts).collect::<Vec<_>>().join(" "))
        }
    }
}

/// Converts a relative URL to a file name: decodes `%20` and the like, and replaces backslashes by slashes.
pub(crate) fn path_of_url(url: &str) -> String {
    let path = percent_decode_str(url).decode_utf8();
    path.unwrap_or(url.into()).replace('\\', "/")
}

//! Texts and elements that xacro gives back as they are: MoveIt's launch file expands the URDF and the SRDF by it.

use urdd_xml::{Kind, Node};

use urdd_xml::writer::escaped;

/// Text that xacro gives back unchanged, in attributes and characters. Of several `$` before a brace, xacro drops one; it
/// takes no others, but an expression whose value is `$`.
pub fn text(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    let mut rest = text;
    while let Some(at) = rest.find('$') {
        let (before, from) = rest.split_at(at);
        rest = from.trim_start_matches('$');
        let count = from.len() - rest.len();
        out += before;
        out += &match rest.starts_with(['{', '(']) {
            true => "$".repeat(count + 1),
            false => "${'$'}".repeat(count - 1) + "$",
        };
    }
    out + rest
}

/// An element that xacro gives back. `None` if something in it is named as xacro names its own: there is no escape for it.
pub fn element(raw: &str) -> Option<String> {
    let document = urdd_xml::parse(raw, Kind::Other).ok()?;
    let mut out = String::with_capacity(raw.len());
    write(document.root_element(), raw, &mut out)?;
    Some(out)
}

/// Writes an element again, without comments, some of which xacro evaluates. `None` if it, or one inside, is xacro's.
fn write(node: Node, source: &str, out: &mut String) -> Option<()> {
    let name = source[node.range().start + 1..].split(['/', '>', ' ', '\t', '\r', '\n']).next()?;
    is_plain(name, node.tag_name().namespace())?;
    *out += &format!("<{name}");
    let mut attribute = |key: &str, value: &str| {
        *out += &format!(" {key}=\"{}\"", escaped(&self::text(value)));
    };
    let outer = node.parent_element();
    for namespace in node.namespaces() {
        let prefix = namespace.name();
        let is_known = outer.and_then(|outer| outer.lookup_namespace_uri(prefix));
        match prefix {
            // xacro removes the declaration of its own prefix.
            Some("xml" | "xacro") => {}
            _ if is_known == Some(namespace.uri()) => {}
            Some(prefix) => attribute(&format!("xmlns:{prefix}"), namespace.uri()),
            None => attribute("xmlns", namespace.uri()),
        }
    }
    for found in node.attributes() {
        let key = &source[found.range_qname()];
        is_plain(key, found.namespace())?;
        attribute(key, found.value());
    }
    out.push('>');
    // What is joined is escaped as a whole: a comment may have been between `$` and `{`.
    let mut text = String::new();
    for child in node.children() {
        text += child.text().filter(|_| child.is_text()).unwrap_or_default();
        if child.is_element() {
            *out += &content(&std::mem::take(&mut text));
            write(child, source, out)?;
        }
    }
    *out += &content(&text);
    *out += &format!("</{name}>");
    Some(())
}

fn content(text: &str) -> String {
    escaped(&self::text(text)).replace("&#10;", "\n").replace("&#9;", "\t")
}

/// Whether a name is not xacro's, by its prefix or by its namespace.
fn is_plain(name: &str, namespace: Option<&str>) -> Option<()> {
    let namespace = namespace.unwrap_or_default().trim_end_matches('/').to_ascii_lowercase();
    (!name.starts_with("xacro:") && !namespace.ends_with("/xacro")).then_some(())
}

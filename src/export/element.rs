//! XML as a tree, and its text.

use quick_xml::escape::escape;

/// An element.
#[derive(Debug, Clone, Default)]
pub(super) struct Element {
    name: &'static str,
    attributes: Vec<(&'static str, String)>,
    children: Vec<Child>,
}

#[derive(Debug, Clone)]
enum Child {
    Element(Element),
    /// Text of XML as it is.
    Raw(String),
}

impl Element {
    pub fn new(name: &'static str) -> Self {
        Element {
            name,
            ..Element::default()
        }
    }

    /// With an attribute.
    pub fn with(mut self, key: &'static str, value: impl Into<String>) -> Self {
        self.attributes.push((key, value.into()));
        self
    }

    /// With an attribute, where there is a value.
    pub fn with_some(self, key: &'static str, value: Option<impl Into<String>>) -> Self {
        match value {
            Some(value) => self.with(key, value),
            None => self,
        }
    }

    /// With an element in it.
    pub fn holding(mut self, child: Element) -> Self {
        self.push(child);
        self
    }

    pub fn push(&mut self, child: Element) {
        self.children.push(Child::Element(child));
    }

    /// Text of XML, which must be an element by itself.
    pub fn push_raw(&mut self, text: impl Into<String>) {
        self.children.push(Child::Raw(text.into()));
    }

    pub fn is_empty(&self) -> bool {
        self.children.is_empty()
    }

    /// The text of a document with this element, and comments before it.
    pub fn document(&self, comments: &[String]) -> String {
        let mut text = String::from("<?xml version=\"1.0\" encoding=\"utf-8\"?>\n");
        for comment in comments {
            text += &format!("<!-- {} -->\n", quiet(comment));
        }
        self.write(&mut text, 0);
        text
    }

    fn write(&self, text: &mut String, depth: usize) {
        let margin = "  ".repeat(depth);
        *text += &format!("{margin}<{}", self.name);
        for (key, value) in &self.attributes {
            *text += &format!(" {key}=\"{}\"", escape(value.as_str()));
        }
        if self.children.is_empty() {
            *text += "/>\n";
            return;
        }
        *text += ">\n";
        for child in &self.children {
            match child {
                Child::Element(element) => element.write(text, depth + 1),
                Child::Raw(raw) => *text += &format!("{margin}  {}\n", raw.trim()),
            }
        }
        *text += &format!("{margin}</{}>\n", self.name);
    }
}

/// Text that can stand in a comment: without `--`, and without what XML has no character for.
fn quiet(text: &str) -> String {
    let text = crate::format::escape::line(text).replace("--", "- -");
    match text.ends_with('-') {
        true => text + " ",
        false => text,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn text_from_anybody_stays_inside_its_place() {
        let mut root = Element::new("robot").with("name", "a\"<b>&'");
        root.push_raw("<gazebo><a/></gazebo>");
        let text = root.document(&["x -- y-".to_owned(), "--> <evil/> \u{1b}--".to_owned()]);
        let parsed = roxmltree::Document::parse(&text).expect("well-formed");
        let robot = parsed.root_element();
        assert_eq!(robot.attribute("name"), Some("a\"<b>&'"));
        let names: Vec<_> = robot.children().filter(|n| n.is_element()).collect();
        assert_eq!(names.len(), 1);
        assert!(!text.contains('\u{1b}'));
    }
}

//! What is at an offset.

use super::tree::Markup;

/// What is at an offset of a text.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Place {
    /// The name in a start tag.
    TagName { element: usize },
    /// In an end tag, or where one is typed.
    EndTag {
        /// The element to close.
        element: usize,
    },
    /// The name of an attribute, or the blank where one is typed.
    AttributeName {
        element: usize,
        /// Index of the attribute; `None` at a blank.
        attribute: Option<usize>,
    },
    /// The value of an attribute.
    Value { element: usize, attribute: usize },
    /// Between tags.
    Content {
        /// The innermost element.
        element: Option<usize>,
    },
}

impl Place {
    /// The element.
    pub fn element(self) -> Option<usize> {
        match self {
            Place::TagName { element }
            | Place::EndTag { element }
            | Place::AttributeName { element, .. }
            | Place::Value { element, .. } => Some(element),
            Place::Content { element } => element,
        }
    }
}

impl Markup {
    /// What is at an offset.
    pub fn place(&self, text: &str, offset: usize) -> Place {
        let after = self.elements.partition_point(|one| one.tag.start < offset);
        let Some(last) = after.checked_sub(1) else {
            return Place::Content { element: None };
        };
        let tag = &self.elements[last].tag;
        let is_unfinished = !self.elements[last].is_finished;
        // In an unfinished tag, one more blank still belongs to it.
        let blank = text.get(tag.end..offset.max(tag.end)).unwrap_or_default();
        let beyond = is_unfinished && blank.chars().all(|c| c == ' ');
        if offset < tag.end || (is_unfinished && offset == tag.end) || beyond {
            return self.in_tag(last, offset);
        }
        let before = text.get(tag.end..offset).unwrap_or_default();
        let end_tag = before.rfind('<').filter(|at| {
            let typed = &before[*at..];
            typed.starts_with("</") && !typed.contains('>')
        });
        // What an end tag closes is what it is in, though it ends with it.
        let within = end_tag.map_or(offset, |at| tag.end + at);
        let element = self.ancestors(last).find(|one| {
            let one = &self.elements[*one];
            let is_inside = within < one.end || within == text.len();
            one.tag.end <= within && one.tag.end < one.end && is_inside
        });
        match (end_tag, element) {
            (Some(_), Some(element)) => Place::EndTag { element },
            _ => Place::Content { element },
        }
    }

    fn in_tag(&self, element: usize, offset: usize) -> Place {
        let one = &self.elements[element];
        if offset <= one.name.end {
            return Place::TagName { element };
        }
        for (attribute, at) in one.attributes.iter().enumerate() {
            if at.name.start <= offset && offset <= at.name.end {
                let attribute = Some(attribute);
                return Place::AttributeName { element, attribute };
            }
            if at.value.start > at.name.end && at.value.start <= offset && offset <= at.value.end {
                return Place::Value { element, attribute };
            }
        }
        Place::AttributeName { element, attribute: None }
    }
}

//! XML as two readers see it.

use roxmltree::Document;

/// A document, read by two parsers: either alone would miss some faults.
pub fn parsed(text: &str) -> Document<'_> {
    let mut reader = quick_xml::Reader::from_str(text);
    reader.config_mut().check_comments = true;
    loop {
        match reader.read_event().expect("well-formed for quick-xml") {
            quick_xml::events::Event::Eof => break,
            quick_xml::events::Event::DocType(_) => panic!("a document type"),
            _ => {}
        }
    }
    Document::parse(text).expect("well-formed for roxmltree")
}

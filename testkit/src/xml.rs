//! XML as two readers see it.

use urdd_xml::Document;

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
    urdd_xml::parse(text, urdd_xml::Kind::Other).expect("well-formed for urdd-xml")
}

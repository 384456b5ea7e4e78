//! What tinyxml2 reads, as MuJoCo and libsdformat do, is read.

use urdd_xml::tinyxml2::{Event, Parser};
use urdd_xml::{Counted, Document, Kind, MAX_ATTRIBUTES, Mended, parse, parse_leniently};

/// Reads a text, and gives each element with its attributes and text, and where it is in the text.
fn read(text: &str) -> Result<Vec<String>, String> {
    let mended = Mended::default();
    let document: Document<'_> = parse_leniently(text, "sdf", &mended).map_err(|error| {
        format!("{}:{}: {}", error.pos().row, error.pos().col, error.words(text))
    })?;
    let elements = document.descendants().filter(urdd_xml::Node::is_element);
    Ok(elements
        .map(|node| {
            let attributes =
                node.attributes().map(|one| format!(" {}={}", one.name(), one.value()));
            let at = mended.original(node.range().start);
            let name: String =
                text[at..].chars().take_while(|c| !matches!(c, '>' | '/' | '\n')).collect();
            // Of `</a/>` the name is behind the slash.
            let is_there = name.contains(node.tag_name().name()) || name.contains("::");
            assert!(is_there || name == "<", "{name}");
            let attributes: String = attributes.collect();
            format!("{}{attributes}|{}", node.tag_name().name(), node.text().unwrap_or_default())
        })
        .collect())
}

#[track_caller]
fn reads(text: &str, wanted: &[&str]) {
    assert_eq!(read(text).expect("tinyxml2 reads it"), wanted, "{text}");
    assert!(parse(text, Kind::Other).is_err(), "it is XML: {text}");
}

#[test]
fn comments_may_have_two_hyphens() {
    reads("<!-- a --b c --><sdf v='1'><a>1</a></sdf>", &["sdf v=1|", "a|1"]);
    reads("<sdf><!-- run: gz sim --verbose --></sdf>", &["sdf|"]);
    reads("<sdf><!-----><a/></sdf><!-- -- -->", &["sdf|", "a|"]);
}

#[test]
fn what_is_around_the_root_is_passed_over() {
    reads("?xml version='1.0'?>\n<sdf><a/></sdf>", &["sdf|", "a|"]);
    reads("text <!-- c --> more <sdf/>", &["sdf|"]);
    reads("<other><sdf x='1'/></other><sdf><b/></sdf><sdf><c/></sdf>", &["sdf|", "b|"]);
    reads("<one><b/></one><two/>", &["one|", "b|"]);
    reads(" \n <?xml version='1.0'?><sdf><a/></sdf>", &["sdf|", "a|"]);
    reads("<?xml version='1.0'?><?xml version='1.0'?><sdf/>", &["sdf|"]);
    reads("<sdf><a/></sdf></sdf> anything < at all", &["sdf|", "a|"]);
    reads("<!DOCTYPE sdf SYSTEM 'x'><sdf/>", &["sdf|"]);
    reads("<!DOCTYPE sdf [<!ELEMENT sdf ANY>]><sdf/>", &["sdf|"]);
}

#[test]
fn values_and_text_are_those_of_tinyxml2() {
    reads(
        "<sdf a='x & y' b='1 < 2' c='&none;'>a & b &amp; &lt; &none;</sdf>",
        &["sdf a=x & y b=1 < 2 c=&none;|a & b & < &none;"],
    );
    reads("<sdf a='1'b='2'/>", &["sdf a=1 b=2|"]);
    reads("<sdf>]]></sdf>", &["sdf|]]>"]);
    reads("<sdf a='\u{1}b'>\u{2}c</sdf>", &["sdf a=b|c"]);
    reads("< sdf><a></a ></sdf>", &["sdf|", "a|"]);
    reads("<sdf></a/></sdf>", &["sdf|", "a|"]);
    reads("<sdf><a><![CDATA[1 <]]> & 2</a></sdf>", &["sdf|", "a|1 < & 2"]);
}

#[test]
fn names_need_no_namespace() {
    reads("<sdf><gz:a gz:b='1'/></sdf>", &["sdf|", "a b=1|"]);
    reads("<sdf><a::b/></sdf>", &["sdf|", "a__b|"]);
    reads("<sdf xmlns:xml='x' xmlns=''><a/></sdf>", &["sdf|", "a|"]);
}

#[test]
fn places_are_those_of_the_text_as_it_was() {
    let text = "junk <!-- a -- b --> <sdf q='&x'>\n  <gz:a/>é<b c='<'/></sdf>";
    let mended = Mended::default();
    let document = parse_leniently(text, "sdf", &mended).expect("a document");
    let at: Vec<usize> = (document.descendants().filter(urdd_xml::Node::is_element))
        .map(|node| mended.original(node.range().start))
        .collect();
    let wanted = ["<sdf", "<gz:a", "<b"].map(|tag| text.find(tag).expect("a tag"));
    assert_eq!(at, wanted);
}

#[test]
fn what_tinyxml2_refuses_is_refused_where_it_is_wrong() {
    let refused = |text: &str, wanted: &str| {
        let said = read(text).expect_err("refused");
        assert!(said.starts_with(wanted), "{said}");
    };
    refused("<sdf><a></sdf>", "1:9: `</sdf>` where `</a>` is expected");
    refused("<sdf>\n<a b='1' b='2'/></sdf>", "2:10: an element has the attribute `b` twice");
    refused("<!-- -- -->\n<sdf>\n <a b=1/></sdf>", "3:5: the value of an attribute is not in");
    refused("<!-- -- -->\n<sdf>é<", "2:7: `<` is not followed by a name");
    refused("<sdf><!-- -- ", "1:");
    refused("<!DOCTYPE a [<!ENTITY b 'c'>]><sdf>&b;</sdf>", "1:14: it declares entities");
}

#[test]
fn the_limits_are_those_of_other_documents() {
    let refused = |text: &str, wanted: &str| {
        let mended = Mended::default();
        let error = parse_leniently(text, "sdf", &mended).expect_err("too much");
        assert!(error.words(text).contains(wanted), "{}", error.words(text));
    };
    let deep = format!("x<sdf>{}{}</sdf>", "<a>".repeat(300), "</a>".repeat(300));
    refused(&deep, "nested");
    // A quote hides from the count what is a tag for tinyxml2.
    let attributes: String = (0..400).map(|k| format!(" a{k}=''")).collect();
    refused(&format!("<!DOCTYPE '><sdf{attributes}/><b a=''/>"), "attributes");
    let prefixes: String = (0..100).map(|k| format!("<p{k}:a/>")).collect();
    refused(&format!("<!DOCTYPE '><sdf>{prefixes}</sdf><b a=''/>"), "prefixes");
    let deep =
        format!("<!DOCTYPE '><sdf>{}{}</sdf><b a=''/>", "<a>".repeat(300), "</a>".repeat(300));
    refused(&deep, "nested too deep");
}

#[test]
fn documents_that_are_xml_are_not_touched() {
    let text = "<sdf xmlns='a'><a b='1'/><!-- c --></sdf>";
    let mended = Mended::default();
    let document = parse_leniently(text, "sdf", &mended).expect("a document");
    assert_eq!((document.input_text(), mended.original(7)), (text, 7));
    assert_eq!(mended.size(), 0);
}

/// What begins like an entity is searched for its end in a few bytes.
#[test]
fn entities_that_do_not_end_take_a_moment() {
    // The last semicolon is too far away.
    reads("<sdf a='& &#65; &#0000000000065;'/>", &["sdf a=& A &#0000000000065;|"]);
    let text = format!("<sdf>{}</sdf>", "&".repeat(1 << 18));
    let start = std::time::Instant::now();
    assert_eq!(read(&text).expect("a document").len(), 1);
    assert!(start.elapsed().as_secs() < 10, "{:?}", start.elapsed());
}

/// The parser itself counts them: nobody counts again what is read of a text that was counted.
#[test]
fn attributes_that_a_document_type_hides_are_bounded() {
    let attributes = |count: usize| -> String { (0..count).map(|k| format!(" a{k}=''")).collect() };
    for (count, is_read) in [(MAX_ATTRIBUTES, true), (MAX_ATTRIBUTES + 1, false)] {
        let text = format!("<!DOCTYPE '><sdf{}/><b a=''/>", attributes(count));
        let counted = Counted::new(text.as_bytes(), Kind::Other).expect("within the limits");
        let mut parser = Parser::new(counted.bytes()).expect("a text");
        assert!(matches!(parser.event(), Ok(Some(Event::Unknown))));
        assert_eq!(parser.event().is_ok(), is_read, "{count}");
    }
}

#[test]
fn what_is_made_has_a_size() {
    let text = format!("<sdf><a>{}</a><!-- -- --></sdf>", "&".repeat(1000));
    let mended = Mended::default();
    let document = parse_leniently(&text, "sdf", &mended).expect("a document");
    assert!(mended.size() > document.input_text().len() && mended.size() > 5000);
}

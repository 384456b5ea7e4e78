//! Reads elements.

use urdd_lsp::markup::Markup;

/// Names with the depth of each, and attributes.
fn shape(text: &str) -> Vec<String> {
    let markup = Markup::new(text);
    let shape = |element: usize| {
        let one = &markup.elements[element];
        let values = one.attributes.iter().map(|attribute| {
            format!(" {}={}", &text[attribute.name.clone()], &text[attribute.value.clone()])
        });
        let depth = markup.ancestors(element).count() - 1;
        let values: String = values.collect();
        format!("{depth}{}{values}", markup.name(text, element))
    };
    (0..markup.elements.len()).map(shape).collect()
}

#[test]
fn whole_texts_are_read_as_xml_is() {
    let text = "<?xml version='1.0'?><!-- <no/> --><robot name = \"a b\"><link name='l'><visual/></link>\n<joint/></robot>";
    assert_eq!(shape(text), ["0robot name=a b", "1link name=l", "2visual", "1joint"]);
}

#[test]
fn what_is_missing_ends_where_the_next_begins() {
    let cases: [(&str, &[&str]); 6] = [
        ("<robot><li <link name='b'/></robot>", &["0robot", "1li", "1link name=b"]),
        (
            "<robot><link name='a'><visual><link name='b'/></robot>",
            &["0robot", "1link name=a", "2visual", "1link name=b"],
        ),
        (
            "<joint name='j'\n<parent link='a'/></joint><link/>",
            &["0joint name=j", "1parent link=a", "0link"],
        ),
        (
            "<joint><parent link=\"ba />\n<child link=\"x\"/></joint>",
            &["0joint", "1parent link=ba ", "1child link=x"],
        ),
        ("<robot><", &["0robot", "1"]),
        (
            "<transmission><joint name='a'/><joint name='b'>",
            &["0transmission", "1joint name=a", "1joint name=b"],
        ),
    ];
    for (text, expected) in cases {
        assert_eq!(shape(text), expected, "{text}");
    }
}

#[test]
fn any_text_is_read() {
    let text = "<r a='1\u{1F916}'><!--x--><l n=\"é\" b = c/><![CDATA[<]]></r>\r\n<?p?>";
    for (start, _) in text.char_indices() {
        for (end, _) in text.char_indices().filter(|(end, _)| *end >= start) {
            let part = &text[start..end];
            let markup = Markup::new(part);
            for offset in 0..=part.len() + 1 {
                markup.place(part, offset);
            }
            let without = format!("{}{}", &text[..start], &text[end..]);
            Markup::new(&without);
        }
    }
}

//! Tests of the limits and of the error messages.

// A test may stop anywhere.
#![allow(clippy::restriction, clippy::disallowed_methods)]

mod doctype;
mod growth;
mod lenient;
mod writer;

use urdd_xml::*;

fn attributes(count: usize) -> String {
    (0..count).map(|n| format!(" a{n}=\"=\"")).collect()
}

fn result(text: &str) -> Result<(), String> {
    let parsed = parse(text, Kind::Robot).map(|_| ());
    parsed.map_err(|error| format!("{}: {}", error.pos(), error.words(text)))
}

#[test]
fn attributes_are_bounded() {
    let most = attributes(MAX_ATTRIBUTES);
    assert_eq!(result(&format!("<r><a{most}/><b{most}/></r>")), Ok(()));
    let text = format!("<r>\n é<a b='>'{most}/></r>");
    let expected = "2:3: there are more than 256 attributes of one element";
    assert_eq!(result(&text), Err(expected.to_owned()));
}

#[test]
fn prefixes_are_bounded() {
    let declared = |from: usize, to: usize| -> String {
        let one = |n: usize| format!("<a xmlns:p{n} = 'u'>");
        (from..to).map(one).collect()
    };
    let ends = |count: usize| "</a>".repeat(count);
    let most = declared(0, MAX_PREFIXES) + &ends(MAX_PREFIXES);
    assert_eq!(result(&format!("<r>{most}{most}</r>")), Ok(()));
    let more = declared(0, MAX_PREFIXES + 1) + &ends(MAX_PREFIXES + 1);
    assert!(result(&more).unwrap_err().contains("more than 64 prefixes"));
}

#[test]
fn quotes_elsewhere_hide_no_attributes() {
    let many = format!("<a{}/>", attributes(MAX_ATTRIBUTES + 1));
    let before = [
        "<r><!--> <b ' -->",
        "<r><?p <b '?>",
        "<r><![CDATA[<b ']]>",
        "<r>'",
        "<!DOCTYPE r [ <!-- ' --> <!ATTLIST r a CDATA \"b '\"> <?p <b '?> ]><r>",
    ];
    for before in before {
        assert_eq!(result(&format!("{before}<a/>'</r>")), Ok(()), "{before}");
        let error = result(&format!("{before}{many}'</r>")).unwrap_err();
        assert!(error.contains("256 attributes"), "{before}: {error}");
    }
}

#[test]
fn text_that_looks_like_attributes_is_not_counted() {
    let signs = "=".repeat(2 * MAX_ATTRIBUTES);
    let text = format!(
        "<?p <{signs}?><r><!-- <{signs}> --><![CDATA[<{signs}]]>{signs}<a b=\"{signs}\"/></r>"
    );
    assert_eq!(result(&text), Ok(()));
}

#[test]
fn what_is_broken_is_left_to_the_parser() {
    for text in ["", "<", "<r", "<!--", "<r a='", "<![CDATA[", "<?", "<r a=b>", "<!DOCTYPE"] {
        assert!(result(text).is_err(), "{text}");
    }
}

#[test]
fn levels_are_bounded() {
    let nested = |levels: usize| format!("{}{}", "<a b='>'>".repeat(levels), "</a>".repeat(levels));
    assert_eq!(result(&nested(MAX_LEVELS)), Ok(()));
    let expected = "there are more than 256 levels of nested elements";
    let error = result(&nested(MAX_LEVELS + 1)).unwrap_err();
    assert_eq!(error, format!("1:{}: {expected}", 9 * MAX_LEVELS + 1));
    // Not nested: empty elements, closed elements, text, and declarations in a document type.
    let flat = "<b/><c d='/>'></c><!-- <e> --><![CDATA[<f>]]><?g <h>?>".repeat(MAX_LEVELS + 1);
    assert_eq!(result(&format!("<r>{flat}</r>")), Ok(()));
    let types = "<!ELEMENT r ANY>".repeat(MAX_LEVELS + 1);
    assert_eq!(result(&format!("<!DOCTYPE r [{types}]><r/>")), Ok(()));
    // Two million levels are rejected as fast.
    let start = std::time::Instant::now();
    assert!(result(&"<a>".repeat(2_000_000)).is_err());
    assert!(start.elapsed().as_secs() < 5);
}

#[test]
fn elements_of_a_robot_are_bounded() {
    let many = |count: usize| format!("<r>{}</r>", "<a/>".repeat(count - 1));
    assert_eq!(result(&many(MAX_ROBOT_ELEMENTS)), Ok(()));
    let error = result(&many(MAX_ROBOT_ELEMENTS + 1)).unwrap_err();
    assert!(error.ends_with("there are more than 500000 elements"), "{error}");
    assert!(parse(&many(MAX_ROBOT_ELEMENTS + 1), Kind::Other).is_ok());
}

/// Comments and texts are no elements; the parser counts them.
#[test]
fn nodes_are_bounded() {
    let text = format!("<r>{}</r>", "<!---->".repeat(MAX_NODES));
    let error = result(&text).unwrap_err();
    assert!(error.ends_with("more than 4000000 elements, texts and comments"), "{error}");
}

#[test]
fn entities_are_refused_where_they_are_declared() {
    let error = result("<!DOCTYPE r [\n <!ENTITY a '0'>]><r/>").unwrap_err();
    assert!(error.starts_with("2:2: it declares entities"), "{error}");
    let nested = "<!DOCTYPE r [ <!ELEMENT r ANY> <!-- ] --> <!ENTITY % a '0'> ]><r/>";
    assert!(result(nested).unwrap_err().contains("declares entities"));
    // Elsewhere these characters do not declare anything.
    for text in [
        "<!DOCTYPE r><!-- <!ENTITY a '0'> --><r/>",
        "<!DOCTYPE r [ <!-- <!ENTITY a '0'> --> ]><r/>",
        "<!DOCTYPE r><r a='&lt;!ENTITY'><![CDATA[<!ENTITY]]></r>",
    ] {
        assert_eq!(result(text), Ok(()), "{text}");
    }
}

#[test]
fn the_declaration_says_what_the_file_is() {
    for declaration in [
        "version='1.0'",
        "version=\"1.1\"",
        "version = '1.0' encoding = 'UTF-8'",
        "version='1.0' encoding='utf8' standalone='yes'",
    ] {
        assert_eq!(result(&format!("<?xml {declaration}?><r/>")), Ok(()), "{declaration}");
    }
    for (declaration, expected) in [
        ("version='0.0'", "1:16: the XML declaration names version `0.0`"),
        ("version='1.'", "1:16: the XML declaration names version `1.`"),
        ("version='2.0'", "1:16: the XML declaration names version `2.0`"),
        (
            "version='1.0' encoding='latin-1'",
            "1:31: the XML declaration names the encoding `latin-1`",
        ),
    ] {
        let error = result(&format!("<?xml {declaration}?><r/>")).unwrap_err();
        assert!(error.starts_with(expected), "{declaration}: {error}");
    }
}

#[test]
fn each_fault_says_what_to_do() {
    for (text, expected) in [
        ("", "1:1: the file is empty"),
        ("r/>", "1:1: the file does not begin with `<`"),
        ("<r><a></r>", "1:7: `</r>` where `</a>` is expected; close"),
        ("<r><a>", "1:1: the file ends before its outermost element is closed"),
        ("<r/><s/>", "1:5: there is more after the end of the outermost element"),
        ("<r/> text", "1:6: there is more after the end of the outermost element"),
        (
            "<!DOCTYPE r [<!ATTLIST r q CDATA '>'>]><r/>",
            "1:36: a declaration within `<!DOCTYPE ...>` cannot be read; remove",
        ),
        (
            "<!DOCTYPE r [%foo;]><r/>",
            "1:14: a declaration within `<!DOCTYPE ...>` cannot be read; remove",
        ),
        ("<r a='1' a='2'/>", "1:10: an element has the attribute `a` twice; remove"),
        ("<r><!-- a -- b --></r>", "1:4: a comment contains `--`"),
        ("<r>]]></r>", "1:7: text contains `]]>`; write `]]&gt;`"),
        ("<r a='<'/>", "1:7: an attribute's value contains `<`; write `&lt;`"),
        ("<r>a & b</r>", "1:6: `&` does not begin an entity here; write `&amp;`"),
        ("<r>&deg;</r>", "1:4: the entity `&deg;` is not declared"),
        ("<r><x:a/></r>", "1:5: the prefix `x` is not declared; declare it"),
        ("<r><xacro:a/></r>", "1:5: the prefix `xacro` is not declared; expand"),
        ("<r a=1/>", "1:6: expected a quote, found `1`"),
        ("<r a b='1'/>", "1:6: expected `=`, found `b`"),
        ("<r><1/></r>", "1:5: a name begins with"),
        ("<r>\u{1}</r>", "1:4: XML does not allow the character U+0001; remove it"),
        (" <?xml version='1.0'?><r/>", "1:2: the XML declaration"),
    ] {
        let error = result(text).unwrap_err();
        assert!(error.starts_with(expected), "{text:?}: {error}");
    }
}

#[test]
fn faults_that_the_parser_does_not_see_are_faults() {
    for (text, expected) in [
        ("<r a='x&#xD800;'/>", "1:8: a reference"),
        ("<r>&#0;</r>", "1:4: a reference"),
        ("<r>&#xFFFE;</r>", "1:4: a reference"),
        ("<?XML version='1.0'?><r/>", "1:1: `<?xml"),
        ("<r xmlns:q=''/>", "1:4: a prefix"),
        ("<r><:c/></r>", "1:5: a name"),
        ("<r :a='1'/>", "1:4: a name"),
        ("<r><?a:b c?></r>", "1:4: the target"),
        ("<r xmlns='a' xmlns='b'/>", "1:14: an element has the attribute `xmlns` twice"),
        ("<r a:xmlns='u'/>", "1:4: the prefix `a` is not declared"),
        (
            "<r xmlns:a='u' a:xmlns='' a:xmlns=''/>",
            "1:27: an element has the attribute `xml_s` twice",
        ),
    ] {
        let error = result(text).unwrap_err();
        assert!(error.starts_with(expected), "{text:?}: {error}");
    }
    for text in [
        "<r a='&#x9;&#10;&#x1F600;&#xE000;'>&#13;</r>",
        "\u{feff}<?xml version='1.0' standalone = \"no\" ?><r/>",
        "<r xmlns='' a='xmlns:q=\"\"'/>",
        "<r><!-- &#0; <:c/> <?XML?> --><![CDATA[&#0;<:c/>]]><?p &#0; <:c/> a:b ?></r>",
        "<r><?xml-model a:b?><a b = ':' c=\"'>:\"/></r>",
        "<r xmlns:a='u' xmlns='v' a:xmlns='w'/>",
    ] {
        assert_eq!(result(text), Ok(()), "{text}");
    }
}

/// What is right is what Expat 2 reads (`xml.parsers.expat` of Python 3.11).
#[test]
fn declarations_and_instructions_are_read_as_by_expat() {
    let begin = "<?xml version='1.0'";
    for text in [
        "<?xml\tversion\n=\r'1.0'?><r/>",
        &format!("{begin} encoding = 'utf-8'\tstandalone\t=\"no\" ?><r/>"),
        &format!("{begin} standalone='yes'?><r/>"),
        "<?p?><r><?p ?><?p ?a?b?><?p\n<&?></r><?xmlx a?>",
    ] {
        assert_eq!(result(text), Ok(()), "{text}");
    }
    let declarations = [
        "<?xml?>",
        "<?xml ?>",
        "<?xml encoding='utf-8'?>",
        "<?xml versionx='1.0'?>",
        "<?xml\tversion='1.0\"?>",
        "<?xml\nversion=1.0?>",
        &format!("{begin}encoding='utf-8'?>"),
        &format!("{begin} encodingx='utf-8'?>"),
        &format!("{begin} standalone='maybe'?>"),
        &format!("{begin} standalone='YES'?>"),
        &format!("{begin} standalone=''?>"),
        &format!("{begin} standalone='yes' encoding='utf-8'?>"),
        &format!("{begin} encoding='utf-8' encoding='utf-8'?>"),
        &format!("{begin} a='b'?>"),
        &format!("{begin}  ? >"),
        &format!("{begin}  >"),
        "<?XML version='1.0'?>",
        "<?xMl?>",
    ];
    for text in declarations {
        assert!(result(&format!("{text}<r/>")).is_err(), "{text}");
    }
    for text in [
        "<?a=\"b\"?>",
        "<?a?b?>",
        "<??>",
        "<? a?>",
        "<?1?>",
        "<?a\u{a0}b?>",
        "<?xml\tversion='1.0'?>",
        "<?xml?>",
        "<?Xml a?>",
        "<?a",
    ] {
        for place in [format!("<!---->{text}<r/>"), format!("<r>{text}</r>"), format!("<r/>{text}")]
        {
            assert!(result(&place).is_err(), "{place}");
        }
    }
}

#[test]
fn numbers_are_short_and_mean_the_same() {
    assert_eq!(number::numbers(&[1.0, -0.0, 0.1, 1e-9, 1e300]), "1 0 0.1 1e-9 1e300");
    for value in [std::f64::consts::PI, 1.0 / 3.0, 5e-324, -1e22] {
        assert_eq!(number::number(value).parse::<f64>(), Ok(value));
    }
}

#[test]
fn what_urdf_does_not_define_is_found_where_it_is() {
    use urdd_xml::other_parts::{OtherParts, Owner, other_parts};
    let urdf = "<robot name='r' a='1'><gazebo b='x'/><link name='l'><x c='x'/><visual/>\
        <visual name='v'><geometry d='2'><box size='1 1 1' q:e='3' xmlns:q='u'/></geometry><surface> <s/></surface></visual></link>\
        <joint name='j' type='fixed' f='4'><limit lower='0' g='5'/></joint><material name='m' h='6'/></robot>";
    let parts: OtherParts = other_parts(&Xml::new(urdf));
    let of = |owner: Owner| -> Vec<String> {
        let parts = parts.get(&owner).into_iter().flatten();
        parts.map(|part| format!("{}:{}={}", part.path, part.name, part.value)).collect()
    };
    assert_eq!(of(Owner::Robot), [":a=1", "material:h=6"]);
    assert_eq!(
        of(Owner::Link("l".to_owned())),
        [
            "visual[1]:surface=<surface> <s/></surface>",
            "visual[1]/geometry:d=2",
            "visual[1]/geometry/box:q:e=3"
        ]
    );
    assert_eq!(of(Owner::Joint("j".to_owned())), [":f=4", "limit:g=5"]);
    assert!(other_parts(&Xml::new("<robot")).is_empty());
    // URDF has three levels. A path has at most six, whatever is below it.
    let deep = "<geometry>".repeat(200) + "<box a=''/>" + &"</geometry>".repeat(200);
    let urdf = format!("<robot name='r'><link name='l'>{deep}</link></robot>");
    let parts = &other_parts(&Xml::new(&urdf))[&Owner::Link("l".to_owned())];
    let [part] = parts.as_slice() else { panic!("{parts:?}") };
    assert_eq!(part.path, ["geometry"; 6].join("/"));
    assert_eq!((part.name.as_str(), part.is_attribute), ("geometry", false));
    assert!(part.value.contains("<box a=''/>"), "{}", part.value);
}

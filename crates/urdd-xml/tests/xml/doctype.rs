//! The grammar of document types. What is right is what Expat 2 reads (`xml.parsers.expat` of Python 3.11).

use super::result;

const RIGHT: &[&str] = &[
    r##"<!DOCTYPE r>"##,
    r##"<!DOCTYPE r >"##,
    r##"<!DOCTYPE r SYSTEM "a">"##,
    r##"<!DOCTYPE r SYSTEM 'a' >"##,
    r##"<!DOCTYPE r PUBLIC "a" "b">"##,
    r##"<!DOCTYPE r PUBLIC "a'b" 'c"d'>"##,
    r##"<!DOCTYPE r []>"##,
    r##"<!DOCTYPE r[]>"##,
    r##"<!DOCTYPE r [ ] >"##,
    r##"<!DOCTYPE r SYSTEM "a"[]>"##,
    r##"<!DOCTYPE r [<!-- a -->]>"##,
    r##"<!DOCTYPE r [<?p?>]>"##,
    r##"<!DOCTYPE r [<?p a?>]>"##,
    r##"<!DOCTYPE r [<!ELEMENT r EMPTY>]>"##,
    r##"<!DOCTYPE r [<!ELEMENT r ANY >]>"##,
    r##"<!DOCTYPE r [<!ELEMENT r (a)>]>"##,
    r##"<!DOCTYPE r [<!ELEMENT r (a)*>]>"##,
    r##"<!DOCTYPE r [<!ELEMENT r (a?)+>]>"##,
    r##"<!DOCTYPE r [<!ELEMENT r ( a , b )>]>"##,
    r##"<!DOCTYPE r [<!ELEMENT r (a|b|c)>]>"##,
    r##"<!DOCTYPE r [<!ELEMENT r ((a|b),c)>]>"##,
    r##"<!DOCTYPE r [<!ELEMENT r ((a,b)*|(c,d)?)+>]>"##,
    r##"<!DOCTYPE r [<!ELEMENT r (#PCDATA)>]>"##,
    r##"<!DOCTYPE r [<!ELEMENT r ( #PCDATA )*>]>"##,
    r##"<!DOCTYPE r [<!ELEMENT r (#PCDATA|a)*>]>"##,
    r##"<!DOCTYPE r [<!ELEMENT r (#PCDATA | a | b )*>]>"##,
    r##"<!DOCTYPE r [<!ATTLIST r>]>"##,
    r##"<!DOCTYPE r [<!ATTLIST r >]>"##,
    r##"<!DOCTYPE r [<!ATTLIST r a CDATA #IMPLIED>]>"##,
    r##"<!DOCTYPE r [<!ATTLIST r a CDATA #REQUIRED b ID #IMPLIED >]>"##,
    r##"<!DOCTYPE r [<!ATTLIST r a CDATA "b">]>"##,
    r##"<!DOCTYPE r [<!ATTLIST r a CDATA #FIXED "b">]>"##,
    r##"<!DOCTYPE r [<!ATTLIST r a CDATA "a&lt;b&#33;&#x21;">]>"##,
    r##"<!DOCTYPE r [<!ATTLIST r a IDREFS #IMPLIED b ENTITIES #IMPLIED c NMTOKENS #IMPLIED>]>"##,
    r##"<!DOCTYPE r [<!ATTLIST r a (b) #IMPLIED>]>"##,
    r##"<!DOCTYPE r [<!ATTLIST r a ( b | 1 | -c ) 'b'>]>"##,
    r##"<!DOCTYPE r [<!ATTLIST r a NOTATION (b|c) #IMPLIED>]>"##,
    r##"<!DOCTYPE r [<!NOTATION n SYSTEM "a">]>"##,
    r##"<!DOCTYPE r [<!NOTATION n PUBLIC "a">]>"##,
    r##"<!DOCTYPE r [<!NOTATION n PUBLIC "a" "b" >]>"##,
    r##"<!DOCTYPE r [<!NOTATION n PUBLIC "a" >]>"##,
    r##"<!DOCTYPE r [<!ELEMENT ä ANY><!ATTLIST ä· é CDATA 'ü'>]>"##,
];

const WRONG: &[&str] = &[
    r##"<!DOCTYPEr>"##,
    r##"<!DOCTYPE>"##,
    r##"<!DOCTYPE 1>"##,
    r##"<!DOCTYPE r SYSTEM>"##,
    r##"<!DOCTYPE r SYSTEM"a">"##,
    r##"<!DOCTYPE r PUBLIC "a">"##,
    r##"<!DOCTYPE r PUBLIC "a""b">"##,
    r##"<!DOCTYPE r PUBLIC "{" "b">"##,
    r##"<!DOCTYPE r system "a">"##,
    r##"<!DOCTYPE r [] x>"##,
    r##"<!DOCTYPE r [x]>"##,
    r##"<!DOCTYPE r [<!-- a -- b -->]>"##,
    r##"<!DOCTYPE r [<!--->]>"##,
    r##"<!DOCTYPE r [<?xml a?>]>"##,
    r##"<!DOCTYPE r [<??>]>"##,
    r##"<!DOCTYPE r [<!ELEMENT r>]>"##,
    r##"<!DOCTYPE r [<!ELEMENT r empty>]>"##,
    r##"<!DOCTYPE r [<!ELEMENT EMPTY>]>"##,
    r##"<!DOCTYPE r [<!ELEMENT r EMPTY x>]>"##,
    r##"<!DOCTYPE r [<!ELEMENT r ()>]>"##,
    r##"<!DOCTYPE r [<!ELEMENT r (a) *>]>"##,
    r##"<!DOCTYPE r [<!ELEMENT r (a ?)>]>"##,
    r##"<!DOCTYPE r [<!ELEMENT r (a??)>]>"##,
    r##"<!DOCTYPE r [<!ELEMENT r (a|b,c)>]>"##,
    r##"<!DOCTYPE r [<!ELEMENT r (a,)>]>"##,
    r##"<!DOCTYPE r [<!ELEMENT r (,a)>]>"##,
    r##"<!DOCTYPE r [<!ELEMENT r ((a)>]>"##,
    r##"<!DOCTYPE r [<!ELEMENT r (a))>]>"##,
    r##"<!DOCTYPE r [<!ELEMENT r (a b)>]>"##,
    r##"<!DOCTYPE r [<!ELEMENT r (#PCDATA)+>]>"##,
    r##"<!DOCTYPE r [<!ELEMENT r (#PCDATA|a)>]>"##,
    r##"<!DOCTYPE r [<!ELEMENT r (#PCDATA,a)*>]>"##,
    r##"<!DOCTYPE r [<!ELEMENT r (a|#PCDATA)*>]>"##,
    r##"<!DOCTYPE r [<!ELEMENT r (#PCDATA|(a))*>]>"##,
    r##"<!DOCTYPE r [<!ELEMENT r (#PCDATA|a?)*>]>"##,
    r##"<!DOCTYPE r [<!ATTLIST>]>"##,
    r##"<!DOCTYPE r [<!ATTLIST r a CDATA #REQUIREDb ID #IMPLIED>]>"##,
    r##"<!DOCTYPE r [<!ATTLIST r a CDATA>]>"##,
    r##"<!DOCTYPE r [<!ATTLIST r a #IMPLIED>]>"##,
    r##"<!DOCTYPE r [<!ATTLIST r a cdata #IMPLIED>]>"##,
    r##"<!DOCTYPE r [<!ATTLIST r a CDATA"b">]>"##,
    r##"<!DOCTYPE r [<!ATTLIST r a CDATA #FIXED"b">]>"##,
    r##"<!DOCTYPE r [<!ATTLIST r a CDATA #FIXED>]>"##,
    r##"<!DOCTYPE r [<!ATTLIST r a CDATA "a<b">]>"##,
    r##"<!DOCTYPE r [<!ATTLIST r a CDATA "a&b;">]>"##,
    r##"<!DOCTYPE r [<!ATTLIST r a CDATA "a&b">]>"##,
    r##"<!DOCTYPE r [<!ATTLIST r a CDATA "&#0;">]>"##,
    r##"<!DOCTYPE r [<!ATTLIST r a CDATA "&#+65;">]>"##,
    r##"<!DOCTYPE r [<!ATTLIST r a IDX #IMPLIED>]>"##,
    r##"<!DOCTYPE r [<!ATTLIST r a () #IMPLIED>]>"##,
    r##"<!DOCTYPE r [<!ATTLIST r a (b,c) #IMPLIED>]>"##,
    r##"<!DOCTYPE r [<!ATTLIST r a (b|) #IMPLIED>]>"##,
    r##"<!DOCTYPE r [<!ATTLIST r a NOTATION(b) #IMPLIED>]>"##,
    r##"<!DOCTYPE r [<!ATTLIST r a NOTATION (1) #IMPLIED>]>"##,
    r##"<!DOCTYPE r [<!ATTLIST r a (b)#IMPLIED>]>"##,
    r##"<!DOCTYPE r [<!NOTATION n PUBLIC "a""b">]>"##,
    r##"<!DOCTYPE r [<!NOTATION n>]>"##,
    r##"<!DOCTYPE r [<!NOTATION n SYSTEM>]>"##,
    r##"<!DOCTYPE r [<!NOTATION n "a">]>"##,
    r##"<!DOCTYPE r [<!LINK a>]>"##,
    r##"<!DOCTYPE r [<! ELEMENT r ANY>]>"##,
    r##"<!DOCTYPE r [<!element r ANY>]>"##,
    r##"<!DOCTYPE r [<a/>]>"##,
    r##"<!DOCTYPE r [text]>"##,
    r##"<!DOCTYPE r [<![INCLUDE[]]>]>"##,
];

#[test]
fn document_types_are_read_as_by_expat() {
    for text in RIGHT {
        assert_eq!(result(&format!("{text}<r/>")), Ok(()), "{text}");
    }
    for text in WRONG {
        assert!(result(&format!("{text}<r/>")).is_err(), "{text}");
    }
}

/// Names with two colons, and notations with one, break the namespaces of XML, which Expat leaves to its caller.
#[test]
fn names_in_document_types_are_qualified() {
    for inside in [
        "<!ELEMENT a:b:c ANY>",
        "<!ELEMENT a:1 ANY>",
        "<!ATTLIST r a:b: CDATA 'a'>",
        "<!NOTATION a:b SYSTEM 'c'>",
    ] {
        assert!(result(&format!("<!DOCTYPE r [{inside}]><r/>")).is_err(), "{inside}");
    }
    assert_eq!(result("<!DOCTYPE r [<!ELEMENT a:b ANY>]><r/>"), Ok(()));
}

/// Groups in groups take no stack.
#[test]
fn groups_may_be_deep() {
    let deep = |ends: usize| {
        let (begin, end) = ("(".repeat(1_000_000), ")".repeat(ends));
        result(&format!("<!DOCTYPE r [<!ELEMENT r {begin}a{end}>]><r/>"))
    };
    assert_eq!(deep(1_000_000), Ok(()));
    let fault = deep(999_999).unwrap_err();
    assert!(fault.ends_with("cannot be read; remove the document type"), "{fault}");
}

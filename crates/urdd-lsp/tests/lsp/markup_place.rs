//! What is at an offset.

use urdd_lsp::markup::*;

fn at(text: &str) -> (Place, String) {
    let offset = text.find('|').unwrap();
    let text = text.replace('|', "");
    let place = Markup::new(&text).place(&text, offset);
    let name = place.element().map(|element| Markup::new(&text).name(&text, element).to_owned());
    (place, name.unwrap_or_default())
}

#[test]
fn an_offset_is_in_a_tag_a_value_or_between() {
    let value = |attribute| Place::Value { element: 1, attribute };
    assert_eq!(at("<r><a b=\"x|\" c='y'/></r>"), (value(0), "a".to_owned()));
    assert_eq!(at("<r><a b=\"x\" c='|'/></r>"), (value(1), "a".to_owned()));
    assert_eq!(at("<r><a b=\"|").0, value(0));
    assert_eq!(at("<r><a|></r>").0, Place::TagName { element: 1 });
    assert_eq!(at("<r><|").0, Place::TagName { element: 1 });
    let blank = Place::AttributeName { element: 1, attribute: None };
    assert_eq!(at("<r><a |/></r>").0, blank);
    assert_eq!(at("<r><a  |\n</r>").0, blank);
    assert_eq!(at("<r><a/>|</r>").1, "r");
    assert_eq!(at("<r><a>x|</a></r>").1, "a");
    assert_eq!(at("<r><a></|").0, Place::EndTag { element: 1 });
    assert_eq!(at("<r><a></|</r>").0, Place::EndTag { element: 1 });
    assert_eq!(at("|<r/>").0, Place::Content { element: None });
    assert_eq!(at("<r/> |").0, Place::Content { element: None });
}

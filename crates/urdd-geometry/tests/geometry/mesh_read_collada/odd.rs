//! Files that are odd or broken.

use urdd_geometry::read::{Fault, NoteCode, Place, read};

use super::{File, PLAIN, bounds, codes, load};

#[test]
fn a_skin_is_read_in_its_bind_shape() {
    let libraries = "<library_controllers><controller id='c'><skin source='#g'><bind_shape_matrix>1 0 0 5 0 1 0 0 0 0 1 0 0 0 0 1</bind_shape_matrix></skin></controller></library_controllers>";
    let nodes = "<node><scale>2 2 2</scale><instance_controller url='#c'/></node>";
    let scene = File { libraries, nodes, ..PLAIN }.load().unwrap();
    assert_eq!(
        (bounds(&scene), codes(&scene)),
        (([10.0, 0.0, 0.0], [12.0, 4.0, 6.0]), vec![NoteCode::SkinAsShape])
    );
}

#[test]
fn scenes_that_are_missing() {
    let text = PLAIN.text().replace("<scene><instance_visual_scene url='#vs'/></scene>", "");
    let scene = load(&text).unwrap();
    assert_eq!((scene.triangle_count(), codes(&scene)), (4, vec![NoteCode::Assumed]));
    let scene = load(&text.replace("library_visual_scenes", "library_other")).unwrap();
    assert_eq!((scene.triangle_count(), codes(&scene)), (4, vec![NoteCode::Assumed]));
    let scene =
        File { nodes: "<node><instance_geometry url='#nowhere'/></node>", ..PLAIN }.load().unwrap();
    assert_eq!(
        (scene.triangle_count(), codes(&scene)),
        (0, vec![NoteCode::LeftOut, NoteCode::NoTriangles])
    );
}

#[test]
fn bad_numbers_and_indices_cost_their_triangles_only() {
    let faces = "<triangles><input semantic='VERTEX' source='#v'/><p>0 1 2  0 1 4  0 1 -1  0 1 x  0 1</p></triangles>";
    let scene = File { faces, ..PLAIN }.load().unwrap();
    assert_eq!(
        (scene.triangle_count(), codes(&scene), scene.notes[0].count),
        (1, vec![NoteCode::IndexOutOfRange], 3)
    );
    let scene =
        load(&PLAIN.text().replace("0 0 0 1 0 0 0 2 0 0 0 3", "0 0 0 1 0 0 0 2 0 0 0 1.#QNAN"))
            .unwrap();
    assert_eq!((scene.triangle_count(), codes(&scene)), (1, vec![NoteCode::NotFinite]));
}

/// SPEC 7.5: what such a transform places has no finite corner, and the other node counts.
#[test]
fn a_transform_that_is_not_finite_spoils_what_it_places_alone() {
    for transform in [
        "<translate>inf 0 0</translate>",
        "<scale>1e999 1 1</scale>",
        "<rotate>0 0 0 nan</rotate>",
        "<matrix>1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 -inf</matrix>",
        "<lookat>0 0 0 0 0 1 0 0 inf</lookat>",
        "<skew>inf 0 0 0 0 1 0</skew>",
    ] {
        let beside = "<node><instance_geometry url='#g'/></node>";
        let nodes = format!("{beside}<node id='n'>{transform}<instance_geometry url='#g'/></node>");
        let whole = File { nodes: beside, ..PLAIN }.load().unwrap();
        let scene = File { nodes: &nodes, ..PLAIN }.load().unwrap();
        assert_eq!(scene.merged(), whole.merged(), "{transform}");
        assert_eq!(codes(&scene), [NoteCode::ReadOtherwise, NoteCode::NotFinite], "{transform}");
    }
}

#[test]
fn what_has_no_meaning_is_refused_with_its_place() {
    let error = File {
        nodes: "<node id='n'><matrix>1 0 0</matrix><instance_geometry url='#g'/></node>",
        ..PLAIN
    }
    .load()
    .unwrap_err();
    assert_eq!(error.place, Some(Place::Element("node 'n'".to_owned())));
    assert_eq!(
        error.to_string(),
        "a.dae: node 'n': a `matrix` does not have 16 numbers; repair the file or export it again"
    );
    let error = File {
        faces: "<triangles><input semantic='VERTEX' source='#nowhere'/><p>0 1 2</p></triangles>",
        ..PLAIN
    }
    .load()
    .unwrap_err();
    assert_eq!(error.place, Some(Place::Element("geometry 'g'".to_owned())));
    let error = load(&PLAIN.text().replace("</COLLADA>", "")).unwrap_err();
    assert!(
        matches!((&error.place, &error.fault), (Some(Place::Line(_)), Fault::Malformed(_))),
        "{error}"
    );
    let bomb = "<?xml version='1.0'?><!DOCTYPE COLLADA [<!ENTITY a 'aaaaaaaaaa'><!ENTITY b '&a;&a;&a;&a;'>]><COLLADA>&b;</COLLADA>";
    assert!(matches!(load(bomb).unwrap_err().fault, Fault::Malformed(_)));
}

#[test]
fn nodes_that_hold_themselves_or_multiply_without_end() {
    let libraries =
        "<library_nodes><node id='loop'><instance_node url='#loop'/></node></library_nodes>";
    let error = File { libraries, nodes: "<node><instance_node url='#loop'/></node>", ..PLAIN }
        .load()
        .unwrap_err();
    assert!(error.to_string().contains("contains itself"), "{error}");
    let laughs: String = (0..40)
        .map(|level| format!("<node id='n{level}'><instance_node url='#n{next}'/><instance_node url='#n{next}'/></node>", next = level + 1))
        .collect();
    let libraries = format!(
        "<library_nodes>{laughs}<node id='n40'><instance_geometry url='#g'/></node></library_nodes>"
    );
    let error =
        File { libraries: &libraries, nodes: "<node><instance_node url='#n0'/></node>", ..PLAIN }
            .load()
            .unwrap_err();
    assert!(matches!(error.fault, Fault::TooLarge { .. }), "{error}");
    let deep = format!("{}{}", "<node>".repeat(5000), "</node>".repeat(5000));
    let error = File { nodes: &deep, ..PLAIN }.load().unwrap_err();
    assert!(error.to_string().contains("more than 256 levels"), "{error}");
    let deep = format!(
        "<COLLADA>{}{}</COLLADA>",
        "<extra>".repeat(1_000_000),
        "</extra>".repeat(1_000_000)
    );
    // Read or rejected: the reader must return.
    let _ = load(&deep);
}

#[test]
fn other_encodings() {
    let text = PLAIN.text();
    let utf16: Vec<u8> =
        [0xff, 0xfe].into_iter().chain(text.encode_utf16().flat_map(u16::to_le_bytes)).collect();
    assert_eq!(read(&utf16, "a.dae", &mut |_| None).unwrap().triangle_count(), 4);
    let latin = text
        .replace("<asset>", "<asset><author>Ren@</author>")
        .bytes()
        .map(|byte| if byte == b'@' { 0xe9 } else { byte })
        .collect::<Vec<u8>>();
    let scene = read(&latin, "a.dae", &mut |_| None).unwrap();
    assert_eq!((scene.triangle_count(), codes(&scene)), (4, vec![NoteCode::Assumed]));
}

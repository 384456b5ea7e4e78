//! COLLADA: placement, faces, materials, and broken files. All files are written here.

mod odd;

use urdd_geometry::mesh::Bounds;
use urdd_geometry::read::{Format, MeshError, NoteCode, Scene, read};

fn load(text: &str) -> Result<Scene, MeshError> {
    read(text.as_bytes(), "a.dae", &mut |_| None)
}

fn codes(scene: &Scene) -> Vec<NoteCode> {
    scene.notes.iter().map(|note| note.code).collect()
}

fn bounds(scene: &Scene) -> ([f64; 3], [f64; 3]) {
    let Bounds { min, max } = scene.merged().bounds().unwrap();
    (min, max)
}

/// A tetrahedron with its corner at the origin and legs 1, 2, 3 long: volume 1.
const POSITIONS: &str = "<source id='s'><float_array id='sa' count='12'>0 0 0 1 0 0 0 2 0 0 0 3</float_array><technique_common>
    <accessor source='#sa' count='4' stride='3'><param name='X' type='float'/><param name='Y' type='float'/><param name='Z' type='float'/></accessor>
    </technique_common></source><vertices id='v'><input semantic='POSITION' source='#s'/></vertices>";
const TETRAHEDRON: &str = "<triangles count='4' material='red'><input semantic='VERTEX' source='#v' offset='0'/><p>0 2 1 0 1 3 1 2 3 0 3 2</p></triangles>";

struct File<'a> {
    asset: &'a str,
    libraries: &'a str,
    faces: &'a str,
    nodes: &'a str,
}

const PLAIN: File<'static> = File {
    asset: "",
    libraries: "",
    faces: TETRAHEDRON,
    nodes: "<node id='n'><instance_geometry url='#g'/></node>",
};

impl File<'_> {
    fn text(&self) -> String {
        let Self { asset, libraries, faces, nodes } = self;
        format!(
            "<?xml version='1.0'?><COLLADA xmlns='http://www.collada.org/2005/11/COLLADASchema' version='1.4.1'><asset>{asset}</asset>{libraries}
            <library_geometries><geometry id='g'><mesh>{POSITIONS}{faces}</mesh></geometry></library_geometries>
            <library_visual_scenes><visual_scene id='vs'>{nodes}</visual_scene></library_visual_scenes>
            <scene><instance_visual_scene url='#vs'/></scene></COLLADA>"
        )
    }

    fn load(&self) -> Result<Scene, MeshError> {
        load(&self.text())
    }
}

#[test]
fn white_space_before_the_declaration_is_skipped_and_noted() {
    let text = PLAIN.text();
    let scene = load(&format!("  \n{text}")).unwrap();
    assert_eq!(
        (bounds(&scene), codes(&scene)),
        (([0.0; 3], [1.0, 2.0, 3.0]), vec![NoteCode::Assumed])
    );
    // Lines are those of the file, and anything else before it is refused.
    let wrong = text.replace("</scene></COLLADA>", "</scene></WRONG>");
    let why = load(&format!("\n\n{wrong}")).unwrap_err().to_string();
    let line = 2 + text.lines().count();
    assert!(why.contains(&format!("line {line}")), "{why}");
    assert!(load(&format!("<!-- a -->\n{text}")).is_err());
}

#[test]
fn a_tetrahedron_is_read() {
    let scene = PLAIN.load().unwrap();
    assert_eq!(scene.format, Format::Collada);
    assert_eq!(scene.merged().signed_volume(), 1.0);
    // Three right triangles, and one whose squared area is the sum of theirs (de Gua).
    let legs: [f64; 3] = [1.0, 3.0, 1.5];
    let area = legs.iter().sum::<f64>() + legs.iter().map(|leg| leg * leg).sum::<f64>().sqrt();
    assert!((scene.merged().area() - area).abs() < 1e-14);
    assert_eq!(scene.notes, []);
}

#[test]
fn the_unit_is_applied_and_the_up_axis_is_not() {
    for (asset, factor, expected) in [
        (
            "<unit name='millimeter' meter='0.001'/><up_axis>Z_UP</up_axis>",
            0.001,
            vec![NoteCode::UnitApplied],
        ),
        (
            "<unit meter='0.0254'/><up_axis>Y_UP</up_axis>",
            0.0254,
            vec![NoteCode::UnitApplied, NoteCode::UpAxisIgnored],
        ),
        ("<up_axis> X_UP </up_axis>", 1.0, vec![NoteCode::UpAxisIgnored]),
        ("<unit meter='1'/>", 1.0, vec![]),
        ("<unit meter='-1'/>", 1.0, vec![NoteCode::Assumed]),
        ("<unit meter='1,5'/>", 1.0, vec![NoteCode::Assumed]),
    ] {
        let scene = File { asset, ..PLAIN }.load().unwrap();
        assert_eq!(bounds(&scene), ([0.0; 3], [factor, 2.0 * factor, 3.0 * factor]), "{asset}");
        assert_eq!(codes(&scene), expected, "{asset}");
    }
}

#[test]
fn transforms_apply_in_their_order_and_nodes_nest() {
    for (transforms, low, high) in [
        ("<translate>10 0 0</translate><scale>2 2 2</scale>", [10.0, 0.0, 0.0], [12.0, 4.0, 6.0]),
        ("<scale>2 2 2</scale><translate>10 0 0</translate>", [20.0, 0.0, 0.0], [22.0, 4.0, 6.0]),
        (
            "<matrix>0 -1 0 10  1 0 0 20  0 0 1 30  0 0 0 1</matrix>",
            [8.0, 20.0, 30.0],
            [10.0, 21.0, 33.0],
        ),
        (
            "<rotate>0 0 1 90</rotate><translate>0 0 5</translate>",
            [-2.0, 0.0, 5.0],
            [0.0, 1.0, 8.0],
        ),
        // Looks from (0, 0, 5) at the origin with y up: nothing turns.
        ("<lookat>0 0 5 0 0 0 0 1 0</lookat>", [0.0, 0.0, 5.0], [1.0, 2.0, 8.0]),
        // Shears x by y: the corner at y = 2 moves by 2 tan 45 degrees.
        ("<skew>45 0 1 0 1 0 0</skew>", [0.0, 0.0, 0.0], [2.0, 2.0, 3.0]),
    ] {
        let nodes = format!("<node>{transforms}<instance_geometry url='#g'/></node>");
        let (min, max) = bounds(&File { nodes: &nodes, ..PLAIN }.load().unwrap());
        for axis in 0..3 {
            assert!(
                (min[axis] - low[axis]).abs() < 1e-14 && (max[axis] - high[axis]).abs() < 1e-14,
                "{transforms}: {min:?} {max:?}"
            );
        }
    }
    let nodes = "<node><translate>0 0 1</translate><node><scale>10 10 10</scale><node><translate>1 0 0</translate><instance_geometry url='#g'/></node></node></node>";
    let scene = File { nodes, asset: "<unit meter='0.1'/>", ..PLAIN }.load().unwrap();
    let (min, max) = bounds(&scene);
    for (found, expected) in min.into_iter().chain(max).zip([1.0, 0.0, 0.1, 2.0, 2.0, 3.1]) {
        assert!((found - expected).abs() < 1e-14, "{found} for {expected}");
    }
}

#[test]
fn a_mirroring_node_keeps_faces_outward() {
    let nodes = "<node><scale>-1 1 1</scale><instance_geometry url='#g'/></node>";
    assert_eq!(File { nodes, ..PLAIN }.load().unwrap().merged().signed_volume(), 1.0);
}

#[test]
fn one_geometry_is_placed_often_also_through_instance_node() {
    let libraries = "<library_nodes><node id='twin'><node><instance_geometry url='#g'/></node><node><translate>0 0 10</translate><instance_geometry url='#g'/></node></node></library_nodes>";
    let nodes = "<node><instance_node url='#twin'/></node><node><translate>100 0 0</translate><instance_node url='#twin'/><instance_geometry url='#g'/></node>";
    let scene = File { libraries, nodes, ..PLAIN }.load().unwrap();
    assert_eq!(scene.triangle_count(), 5 * 4);
    assert_eq!(bounds(&scene), ([0.0; 3], [101.0, 2.0, 13.0]));
}

#[test]
fn every_kind_of_face() {
    // A unit square in the corners of `POSITIONS` has area 1; here the square is 0 1 2 3 of another source.
    let square = "<source id='q'><float_array>0 0 0 1 0 0 1 1 0 0 1 0</float_array></source><vertices id='w'><input semantic='POSITION' source='#q'/></vertices>";
    let input = "<input semantic='NORMAL' source='#none' offset='1'/><input semantic='VERTEX' source='#w' offset='0'/>";
    for (faces, triangles, area) in [
        (format!("<triangles>{input}<p>0 9 1 9 2 9  0 9 2 9 3 9</p></triangles>"), 2, 1.0),
        (
            format!(
                "<polylist>{input}<vcount>4 3</vcount><p>0 0 1 0 2 0 3 0  0 0 1 0 2 0</p></polylist>"
            ),
            3,
            1.5,
        ),
        (format!("<polygons>{input}<p>0 0 1 0 2 0 3 0</p><p>0 0 1 0 2 0</p></polygons>"), 3, 1.5),
        (
            format!(
                "<polygons>{input}<ph><p>0 0 1 0 2 0 3 0</p><h>0 0 1 0 2 0</h></ph></polygons>"
            ),
            2,
            1.0,
        ),
        (format!("<trifans>{input}<p>0 0 1 0 2 0 3 0</p></trifans>"), 2, 1.0),
        (format!("<tristrips>{input}<p>0 0 1 0 3 0 2 0</p></tristrips>"), 2, 1.0),
        (format!("<lines>{input}<p>0 0 1 0</p></lines>"), 0, 0.0),
    ] {
        let scene = File { faces: &format!("{square}{faces}"), ..PLAIN }.load().unwrap();
        let mesh = scene.merged();
        assert_eq!((mesh.triangles.len(), mesh.area()), (triangles, area), "{faces}");
        for triangle in &mesh.triangles {
            let [a, b, c] = mesh.corners(*triangle);
            assert!(
                (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]) > 0.0,
                "{faces} faces up"
            );
        }
    }
}

#[test]
fn a_polygon_that_is_not_convex_keeps_its_area_and_winding() {
    // An L of three unit squares, from a corner where a fan would leave it, in both windings and in another plane.
    let corners = ["0 1 0", "0 0 0", "2 0 0", "2 1 0", "1 1 0", "1 2 0", "0 2 0"];
    for (order, sign) in [("0 1 2 3 4 5 6", 1.0), ("6 5 4 3 2 1 0", -1.0), ("3 4 5 6 0 1 2", 1.0)] {
        let faces = format!(
            "<source id='q'><float_array>{}</float_array></source><polylist><input semantic='VERTEX' source='#q'/><vcount>7</vcount><p>{order}</p></polylist>",
            corners.join(" ")
        );
        for nodes in [
            "<node><instance_geometry url='#g'/></node>",
            "<node><rotate>1 0 0 90</rotate><instance_geometry url='#g'/></node>",
        ] {
            let mesh = File { faces: &faces, nodes, ..PLAIN }.load().unwrap().merged();
            assert!((mesh.area() - 3.0).abs() < 1e-14, "{order}: {}", mesh.area());
            if !nodes.contains("rotate") {
                for triangle in &mesh.triangles {
                    let [a, b, c] = mesh.corners(*triangle);
                    let turn = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
                    assert!(turn * sign >= 0.0, "{order}");
                }
            }
        }
    }
}

#[test]
fn sources_with_stride_offset_names_and_comments() {
    let faces = "<source id='q'><float_array id='qa'>99 7 2 0 0 <!-- y x z --> 7 0 3 0 7 0 0 4</float_array><technique_common>
        <accessor source='#qa' offset='1' stride='4'><param/><param name='Y'/><param name='X'/><param name='Z'/></accessor></technique_common></source>
        <triangles><input semantic='VERTEX' source='#q'/><p>0 1 2</p></triangles>";
    let mesh = File { faces, ..PLAIN }.load().unwrap().merged();
    assert_eq!(mesh.vertices, [[0.0, 2.0, 0.0], [3.0, 0.0, 0.0], [0.0, 0.0, 4.0]]);
}

#[test]
fn colours_come_through_the_binding() {
    let effect = |id: &str, inside: &str| {
        format!("<effect id='{id}'><profile_COMMON>{inside}</profile_COMMON></effect>")
    };
    let libraries = format!(
        "<library_images><image id='i'><init_from>sub%20dir/skin.png</init_from></image><image id='j'><init_from><ref>b.png</ref></init_from></image></library_images>
        <library_effects>{}{}{}{}</library_effects>
        <library_materials><material id='m1' name='Paint'><instance_effect url='#e1'/></material><material id='m2'><instance_effect url='#e2'/></material>
        <material id='m3'><instance_effect url='#e3'/></material><material id='m4'><instance_effect url='#e4'/></material></library_materials>",
        effect("e1", "<technique><phong><emission><color>0 0 0 1</color></emission><diffuse><color sid='d'>0.25 0.5 1 0.75</color></diffuse></phong></technique>"),
        effect("e2", "<technique><lambert><diffuse><texture texture='i'/></diffuse></lambert></technique>"),
        effect("e3", "<technique><constant><emission><color>1 2 -1</color></emission></constant></technique>"),
        effect("e4", "<newparam sid='p'><float4>0 1 0 1</float4></newparam><technique><blinn><diffuse><param ref='p'/></diffuse></blinn></technique>"),
    );
    for (target, color, name) in [
        ("m1", Some([0.25, 0.5, 1.0, 0.75]), "Paint"),
        ("m2", None, "m2"),
        ("m3", Some([1.0, 1.0, 0.0, 1.0]), "m3"),
        ("m4", Some([0.0, 1.0, 0.0, 1.0]), "m4"),
        ("none", None, "red"),
    ] {
        let nodes = format!(
            "<node><instance_geometry url='#g'><bind_material><technique_common><instance_material symbol='red' target='#{target}'/></technique_common></bind_material></instance_geometry></node>"
        );
        let scene = File { libraries: &libraries, nodes: &nodes, ..PLAIN }.load().unwrap();
        assert_eq!(scene.parts[0].color, color, "{target}");
        assert_eq!(scene.parts[0].material.as_deref(), Some(name));
        assert_eq!(scene.side_files, ["b.png", "sub dir/skin.png"]);
    }
}

#[test]
fn parts_go_by_material() {
    let faces = "<triangles material='a'><input semantic='VERTEX' source='#v'/><p>0 2 1</p></triangles><triangles material='b'><input semantic='VERTEX' source='#v'/><p>0 1 3</p></triangles><triangles material='a'><input semantic='VERTEX' source='#v'/><p>1 2 3</p></triangles>";
    let scene = File { faces, ..PLAIN }.load().unwrap();
    let counts: Vec<_> = scene
        .parts
        .iter()
        .map(|part| (part.material.as_deref(), part.mesh.triangles.len(), part.mesh.vertices.len()))
        .collect();
    assert_eq!(counts, [(Some("a"), 2, 6), (Some("b"), 1, 3)]);
}

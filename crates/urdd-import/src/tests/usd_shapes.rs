//! Shapes, looks and pairs read of USD.

use nalgebra::Vector3;
use urdd_source::ImportOptions;

use super::usd::{body, given, inside};
use crate::features;
use crate::model::{Geometry, Model, Shape, Use};
use crate::tests::Entries as _;

const HEAD: &str = "#usda 1.0\n( metersPerUnit = 1\n upAxis = \"Z\" )\n";

#[test]
fn meshes_and_colours() {
    let model = inside(
        "def Xform \"a\" (apiSchemas = [\"PhysicsRigidBodyAPI\"]) {
            rel material:binding = </looks/red>
            def Mesh \"square\" (apiSchemas = [\"PhysicsCollisionAPI\", \"PhysicsMeshCollisionAPI\"]) {
                uniform token physics:approximation = \"boundingCube\"
                point3f[] points = [(0,0,0), (2,0,0), (2,1,0), (0,1,0), (0,0,1)]
                int[] faceVertexCounts = [4, 3]
                int[] faceVertexIndices = [0, 1, 2, 3, 0, 1, 4]
                def GeomSubset \"side\" { int[] indices = [1]
                    rel material:binding = </looks/blue> }
            }
        }
        def Scope \"looks\" {
            def Material \"red\" { token outputs:surface.connect = </looks/red/s.outputs:surface>
                def Shader \"s\" { color3f inputs:diffuseColor = (0.8, 0.1, 0)\n float inputs:opacity = 0.5\n token outputs:surface } }
            def Material \"blue\" { token outputs:surface.connect = </looks/blue/s.outputs:surface>
                def Shader \"s\" { color3f inputs:diffuseColor.connect = </looks/blue.inputs:c> }
                color3f inputs:c = (0, 0, 1) }
        }",
    );
    let [solid, side, rest] = body(&model, "a").shapes.all() else { panic!("{:?}", model.bodies) };
    assert_eq!(
        (solid.used, solid.geometry.clone()),
        (Use::Collision, Geometry::Box([2.0, 1.0, 1.0]))
    );
    assert_eq!(solid.pose.translation.vector, Vector3::new(1.0, 0.5, 0.5));
    // 1.055 × 0.8^(1/2.4) - 0.055, and the same of 0.1.
    let colour = |shape: &crate::model::Shape| shape.material.as_ref().and_then(|of| of.rgba);
    assert_eq!(
        (colour(side), colour(rest)),
        (Some([0.0, 0.0, 1.0, 1.0]), Some([0.906332, 0.34919, 0.0, 0.5]))
    );
    // One triangle, and two of the square: 84 bytes of head, and 50 each.
    let sizes: Vec<usize> = model.assets.iter().map(|asset| asset.bytes.len()).collect();
    assert_eq!(sizes, [134, 184]);
}

/// A GIF of one pixel.
const GIF: &[u8] = b"GIF89a\x01\0\x01\0\0\0\0";

/// A body with two triangles that share two points, and a material with an image.
fn painted(primvar: &str, file: &str) -> Result<Model, String> {
    let text = format!(
        "{HEAD}def Xform \"a\" (apiSchemas = [\"PhysicsRigidBodyAPI\"]) {{
            def Mesh \"m\" {{
                rel material:binding = </look>
                point3f[] points = [(0,0,0), (1,0,0), (1,1,0), (0,1,0)]
                int[] faceVertexCounts = [3, 3]
                int[] faceVertexIndices = [0, 1, 2, 0, 2, 3]
                {primvar}
            }}
        }}
        def Material \"look\" {{
            token outputs:surface.connect = </look/s.outputs:surface>
            def Shader \"s\" {{ color3f inputs:diffuseColor.connect = </look/i.outputs:rgb>
                float inputs:opacity = 0.25 }}
            def Shader \"i\" {{ asset inputs:file = @{file}@
                float2 inputs:st.connect = </look/t.outputs:result>
                float3 outputs:rgb }}
            def Shader \"t\" {{ float2 inputs:in.connect = </look/p.outputs:result>
                float2 inputs:scale = (2, 1)
                float2 inputs:translation = (0, 0.5)
                float2 outputs:result }}
            def Shader \"p\" {{ string inputs:varname = \"map\"
                float2 outputs:result }}
        }}"
    );
    given(&text, &[("/img/red.gif", GIF), ("/no.gif", b"GIF")], &ImportOptions::default())
}

#[test]
fn images_on_meshes() {
    let corners = "texCoord2f[] primvars:map = [(0,0), (1,0), (1,1), (0,1)] ( interpolation =";
    let indexed = "int[] primvars:map:indices = [0, 1, 2, 0, 2, 3]";
    for (primvar, points) in [
        (format!("{corners} \"vertex\" )"), 4),
        (format!("{corners} \"faceVarying\" )\n{indexed}"), 4),
        // Each triangle has one place in the image: points of both are two.
        (format!("{corners} \"uniform\" )"), 6),
    ] {
        let model = painted(&primvar, "./img/red.gif").expect("a model");
        let [shape] = body(&model, "a").shapes.all() else { panic!("one shape") };
        let Geometry::Mesh { asset, .. } = shape.geometry else { panic!("{:?}", shape.geometry) };
        let material = shape.material.as_ref().expect("a material");
        assert_eq!(material.rgba, Some([1.0, 1.0, 1.0, 0.25]));
        let image = &model.assets[material.texture.expect("an image")];
        assert_eq!((&*image.path, &*image.bytes), ("textures/red.gif", GIF));
        let text = String::from_utf8(model.assets[asset].bytes.to_vec()).expect("OBJ");
        let lines = |start: &str| text.lines().filter(|line| line.starts_with(start)).count();
        assert_eq!((lines("v "), lines("vt "), lines("f ")), (points, points, 2), "{text}");
        // Scaled by 2 along u, and moved by 0.5 along v.
        assert!(points == 6 || text.contains("vt 2 1.5\n"), "{text}");
        assert_eq!(model.tally.number_of(features::TEXTURES), 1);
    }
}

#[test]
fn images_that_are_left_out() {
    let vertex =
        "texCoord2f[] primvars:map = [(0,0), (1,0), (1,1), (0,1)] ( interpolation = \"vertex\" )";
    for (primvar, file, why) in [
        (vertex, "gone.png", "an image is left out: cannot read `gone.png`"),
        (vertex, "no.gif", "an image is left out: `no.gif` is not an image"),
        ("", "img/red.gif", "the image on `m` is left out"),
        // Fewer places than points.
        (&vertex.replace(", (0,1)]", "]"), "img/red.gif", "the image on `m` is left out"),
    ] {
        let model = painted(primvar, file).expect("a model");
        let [asset] = model.assets.all() else { panic!("{file}: {:?}", model.assets) };
        assert_eq!(asset.path, "meshes/a_m.stl");
        let remarks = &model.tally.remarks;
        assert!(remarks.iter().any(|of| of.text.starts_with(why)), "{file}: {remarks:?}");
        assert_eq!(model.tally.number_of(features::MISSING_MESHES), 1);
    }
}

fn collides(shape: &Shape) -> bool {
    shape.used != Use::Visual
}

#[test]
fn what_is_in_a_collider_collides() {
    let model = inside(
        "def Xform \"a\" (apiSchemas = [\"PhysicsRigidBodyAPI\"]) {
            def Xform \"all\" (apiSchemas = [\"PhysicsCollisionAPI\", \"PhysicsMeshCollisionAPI\"]) {
                uniform token physics:approximation = \"boundingCube\"
                def Sphere \"one\" {}
                def Mesh \"two\" { point3f[] points = [(0,0,0), (3,0,0), (0,2,0), (0,0,1)]
                    int[] faceVertexCounts = [3, 3]\n int[] faceVertexIndices = [0, 1, 2, 0, 1, 3]
                    token visibility = \"invisible\" }
            }
            def Xform \"some\" (apiSchemas = [\"PhysicsCollisionAPI\"]) {
                def Cube \"three\" (apiSchemas = [\"PhysicsCollisionAPI\"]) {}
                def Cube \"four\" {}
            }
            def Cube \"five\" {}
        }",
    );
    let shapes = &body(&model, "a").shapes;
    let all: Vec<(&str, bool)> =
        shapes.iter().map(|shape| (shape.name.as_deref().unwrap(), collides(shape))).collect();
    let expected =
        [("one", true), ("two", true), ("three", true), ("four", false), ("five", false)];
    assert_eq!(all, expected);
    assert_eq!(shapes[1].geometry, Geometry::Box([3.0, 2.0, 1.0]));
}

#[test]
fn groups_of_shapes_that_never_collide() {
    let solid = |name: &str| {
        format!("def Sphere \"{name}\" (apiSchemas = [\"PhysicsCollisionAPI\"]) {{}}\n")
    };
    let bodies = ["a", "b", "c"].map(|name| {
        format!(
            "def Xform \"{name}\" (apiSchemas = [\"PhysicsRigidBodyAPI\"]) {{ {}{} }}\n",
            solid("one"),
            solid("two")
        )
    });
    let joints = ["b", "c"].map(|child| {
        format!("def PhysicsFixedJoint \"j{child}\" {{ rel physics:body0 = </a>\n rel physics:body1 = </{child}> }}\n")
    });
    let apart = |groups: &str| {
        let model = inside(&(bodies.concat() + &joints.concat() + groups));
        let pairs: Vec<[usize; 2]> = model.apart.iter().map(|pair| pair.bodies).collect();
        (pairs, model.tally.number_of(features::PARTLY_APART))
    };
    let group = |name: &str, paths: &str, more: &str| {
        format!(
            "def PhysicsCollisionGroup \"{name}\" (apiSchemas = [\"CollectionAPI:colliders\"]) {{
            rel collection:colliders:includes = [{paths}]\n {more} }}\n"
        )
    };
    let of_a = "rel physics:filteredGroups = </g>";
    // All shapes of a, and of b.
    let both = group("g", "</a>", "") + &group("h", "</b>", of_a);
    assert_eq!(apart(&both), (vec![[0, 1]], 0));
    // But one shape of b.
    let but = "rel collection:colliders:excludes = </b/two>";
    let some = group("g", "</a>", "") + &group("h", "</b>", &format!("{of_a}\n{but}"));
    assert_eq!(apart(&some), (vec![], 1));
    // A group that collides with those alone that it names: itself.
    let inverted =
        "uniform bool physics:invertFilteredGroups = 1\n rel physics:filteredGroups = </h>";
    let not = group("g", "</a>", "") + &group("h", "</b>, </c>", inverted);
    assert_eq!(apart(&not), (vec![[0, 1], [0, 2]], 0));
    // Two groups of one name are one.
    let name = "string physics:mergeGroup = \"x\"";
    let merged = group("g", "</a>", name)
        + &group("h", "</b>", name)
        + &group("i", "</c>", "rel physics:filteredGroups = </h>");
    assert_eq!(apart(&merged), (vec![[0, 2], [1, 2]], 0));
}

#[test]
fn references_that_are_not_there() {
    let robot =
        "def Xform \"robot\" { def Xform \"a\" (apiSchemas = [\"PhysicsRigidBodyAPI\"]) {} }";
    let read = |text: &str| given(&format!("{HEAD}{text}"), &[], &ImportOptions::default());
    let ground = "def \"ground\" (payload = @https://a.b/ground.usd@) {}";
    let model = read(&format!("{robot}\n{ground}")).expect("a model");
    assert_eq!(model.tally.number_of(features::MISSING_PARTS), 1);
    let remark = &model.tally.remarks[0].text;
    assert!(remark.contains("left out: `https://a.b/ground.usd` is not a file"), "{remark}");
    let with = |more: &str| robot.replace("\"a\" (", &format!("\"a\" ( {more}; "));
    let holder = robot.replace("\"robot\"", "\"robot\" (references = @x.usd@)");
    let joint = "def PhysicsFixedJoint \"j\" { rel physics:body0 = </robot/a>\n rel physics:body1 = </ground/b> }";
    for text in [
        ground.to_owned(),
        holder,
        with("references = @x.usd@"),
        robot.replace("{}", "{ def \"v\" (references = @x.usd@) {} }"),
        format!("{robot}\n{ground}\n{joint}"),
    ] {
        let error = read(&text).unwrap_err();
        let is_said = error.contains("cannot read `x.usd`") || error.contains("is not a file");
        assert!(is_said, "{text}: {error}");
    }
    // A joint to what is not there is not one to the world.
    let lost = read(&format!("{robot}\n{joint}")).expect("a model");
    assert!(lost.is_floating && lost.tally.number_of(features::DISTANCES) == 1);
}

/// A robot of many like parts is not refused: their mesh is read once.
#[test]
fn instances_share_a_mesh() {
    let points: String = (0..4000).map(|at| format!("({at},{},0),", at % 7)).collect();
    let corners: String = (2..4000).map(|at| format!("0,{},{at},", at - 1)).collect();
    let uses: String =
        (0..150).map(|at| format!("def \"m{at}\" (references = </mesh>) {{}}\n")).collect();
    let model = inside(&format!(
        "class Mesh \"mesh\" {{ point3f[] points = [{points}]
            int[] faceVertexCounts = [{}]
            int[] faceVertexIndices = [{corners}] }}
        def Xform \"a\" (apiSchemas = [\"PhysicsRigidBodyAPI\"]) {{ {uses} }}",
        "3,".repeat(3998)
    ));
    assert_eq!((body(&model, "a").shapes.len(), model.assets.len()), (150, 1));
}

//! No input makes a reader panic, and every result is a valid mesh.

use proptest::prelude::*;
use urdd_geometry::primitives;
use urdd_geometry::read::{Part, read};
use urdd_geometry::write;

const COLLADA: &str = "<?xml version='1.0'?><COLLADA version='1.4.1'><asset><unit meter='0.01'/><up_axis>Y_UP</up_axis></asset><library_geometries><geometry id='g'><mesh>
<source id='s'><float_array id='sa' count='12'>0 0 0 1 0 0 0 2 0 0 0 3</float_array><technique_common><accessor source='#sa' count='4' stride='3'><param name='X'/><param name='Y'/><param name='Z'/></accessor></technique_common></source>
<vertices id='v'><input semantic='POSITION' source='#s'/></vertices><polylist count='2' material='m'><input semantic='VERTEX' source='#v' offset='0'/><input semantic='NORMAL' source='#v' offset='1'/><vcount>4 3</vcount><p>0 0 1 0 2 0 3 0 0 0 1 0 3 0</p></polylist>
<tristrips><input semantic='VERTEX' source='#v' offset='0'/><p>0 1 2 3</p></tristrips></mesh></geometry></library_geometries><library_visual_scenes><visual_scene id='vs'><node id='n'><rotate>0 1 0 30</rotate><matrix>1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1</matrix><skew>10 0 1 0 1 0 0</skew>
<lookat>1 2 3 0 0 0 0 1 0</lookat><instance_geometry url='#g'/><instance_node url='#o'/></node><node id='o'><scale>1 2 3</scale><instance_geometry url='#g'/></node></visual_scene></library_visual_scenes><scene><instance_visual_scene url='#vs'/></scene></COLLADA>";
const OBJ: &str = "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0.5 0.2 0\nvt 0 0\nusemtl a\nf 1/1 2/1 3/1 4/1 5/1\nf -5 -4 -3 \\\n-2\nusemtl b\nf 1 2 3\n";
const MTL: &str = "newmtl a\nKd 0.1 0.2 0.3\nd 0.5\nmap_Kd -s 1 2 3 a.png\n";
const STL: &str = "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\nendsolid a\n";
const GLTF: &str = r#"{"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0,1]}],"nodes":[{"mesh":0,"children":[1],"rotation":[0,0,1,0]},{"mesh":0,"matrix":[1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1]}],
"meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1,"mode":5,"material":0}]}],"materials":[{"pbrMetallicRoughness":{"baseColorFactor":[1,0,0,1]}}],
"accessors":[{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3","sparse":{"count":1,"indices":{"bufferView":1,"componentType":5121},"values":{"bufferView":0}}},{"bufferView":1,"componentType":5123,"count":4,"type":"SCALAR"}],
"bufferViews":[{"buffer":0,"byteLength":48,"byteStride":12},{"buffer":0,"byteOffset":48,"byteLength":8}],"buffers":[{"byteLength":56,"uri":"a.bin"}]}"#;

fn seeds() -> Vec<Vec<u8>> {
    let part = Part { color: Some([1.0; 4]), ..Part::from(primitives::cuboid([1.0, 2.0, 3.0])) };
    let parts = [part.clone(), part];
    let written = [write::stl(&parts), write::obj(&parts), write::glb(&parts)].map(Result::unwrap);
    let texts = [COLLADA, OBJ, STL, GLTF].map(|text| text.as_bytes().to_vec());
    texts.into_iter().chain(written).collect()
}

const NAMES: [&str; 6] = ["a.stl", "a.dae", "a.obj", "a.gltf", "a.glb", "a"];

/// The side files of the seeds: four positions and four indices for the glTF.
fn fetch(name: &str) -> Option<Vec<u8>> {
    if name.ends_with(".mtl") {
        return Some(MTL.into());
    }
    Some((0..48).chain([0, 0, 1, 0, 2, 0, 3, 0]).collect())
}

/// Reads under every name, and checks the result.
fn check(bytes: &[u8]) {
    for name in NAMES {
        let Ok(scene) = read(bytes, name, &mut fetch) else {
            continue;
        };
        for part in &scene.parts {
            assert!(!part.mesh.triangles.is_empty());
            assert!(part.mesh.vertices.iter().flatten().all(|value| value.is_finite()));
            assert!(
                part.mesh
                    .triangles
                    .iter()
                    .flatten()
                    .all(|index| (*index as usize) < part.mesh.vertices.len())
            );
            if let Some(color) = part.color {
                assert!(color.iter().all(|value| (0.0..=1.0).contains(value)));
            }
        }
    }
}

#[test]
fn the_seeds_themselves_are_read() {
    for seed in seeds() {
        assert!(
            read(&seed, "a", &mut fetch).unwrap().triangle_count() > 0,
            "{}",
            String::from_utf8_lossy(&seed)
        );
        check(&seed);
    }
}

#[test]
fn every_file_cut_at_every_byte() {
    for seed in seeds() {
        for end in 0..seed.len() {
            check(&seed[..end]);
        }
    }
}

/// One change to a file.
#[derive(Clone, Debug)]
enum Change {
    Set(prop::sample::Index, u8),
    Remove(prop::sample::Index, usize),
    Repeat(prop::sample::Index, usize),
    Insert(prop::sample::Index, &'static str),
}

fn change() -> impl Strategy<Value = Change> {
    let words = [
        "-1",
        "0",
        "4294967295",
        "4294967296",
        "1e308",
        "-1e-320",
        "nan",
        "inf",
        "99999999999999999999",
        "#g",
        "\0",
        "<",
        "{",
        "/",
        "\\\n",
        " ",
        "\u{1F600}",
        "9e999",
        "f 1 2 3 4 5\n",
        "<node>",
    ];
    prop_oneof![
        (any::<prop::sample::Index>(), any::<u8>()).prop_map(|(at, byte)| Change::Set(at, byte)),
        (any::<prop::sample::Index>(), 1..40_usize)
            .prop_map(|(at, length)| Change::Remove(at, length)),
        (any::<prop::sample::Index>(), 1..200_usize)
            .prop_map(|(at, length)| Change::Repeat(at, length)),
        (any::<prop::sample::Index>(), prop::sample::select(words.to_vec()))
            .prop_map(|(at, word)| Change::Insert(at, word)),
    ]
}

fn apply(bytes: &mut Vec<u8>, change: &Change) {
    if bytes.is_empty() {
        return;
    }
    match change {
        Change::Set(at, byte) => {
            let at = at.index(bytes.len());
            bytes[at] = *byte;
        }
        Change::Remove(at, length) => {
            let at = at.index(bytes.len());
            bytes.drain(at..(at + length).min(bytes.len()));
        }
        Change::Repeat(at, length) => {
            let at = at.index(bytes.len());
            let copy = bytes[at..(at + length).min(bytes.len())].to_vec();
            bytes.splice(at..at, copy);
        }
        Change::Insert(at, word) => {
            let at = at.index(bytes.len());
            bytes.splice(at..at, word.bytes());
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2000))]

    #[test]
    fn changed_files_never_panic(seed in 0..7_usize, changes in prop::collection::vec(change(), 1..8)) {
        let mut bytes = seeds().swap_remove(seed);
        for change in &changes {
            apply(&mut bytes, change);
        }
        check(&bytes);
    }

    #[test]
    fn random_bytes_never_panic(bytes in prop::collection::vec(any::<u8>(), 0..400)) {
        check(&bytes);
    }
}

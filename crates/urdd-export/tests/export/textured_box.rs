//! Boxes with a texture, in each format of meshes that can have one.

use std::fmt::Write;
use std::fs::write;
use std::path::Path;

/// Half the sides of the box, m.
const HALF: [f64; 3] = [0.5, 1.0, 1.5];

type Corner = ([f64; 3], [f64; 2]);

/// The corners of its faces, from outside counter-clockwise: position, and place in the image. Each face has a stripe.
pub fn faces() -> Vec<[Corner; 4]> {
    let of_face = |face: usize| {
        let (axis, side) = (face / 2, [1.0, -1.0][face % 2]);
        let mut corners = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)].map(|(a, b)| {
            let mut position = [0.0; 3];
            position[axis] = side * HALF[axis];
            position[(axis + 1) % 3] = a * HALF[(axis + 1) % 3];
            position[(axis + 2) % 3] = b * HALF[(axis + 2) % 3];
            let across = if a > 0.0 { 1.0 } else { 0.0 };
            (position, [(face as f64 + across) / 8.0, if b > 0.0 { 0.75 } else { 0.125 }])
        });
        if side < 0.0 {
            corners.reverse();
        }
        corners
    };
    (0..6).map(of_face).collect()
}

/// A PNG of 4 by 4 pixels.
pub fn png(shade: u8) -> Vec<u8> {
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, 4, 4);
    encoder.set_color(png::ColorType::Rgb);
    let mut writer = encoder.write_header().expect("a header");
    let pixels: Vec<u8> = (0..48).map(|at| at * 5 + shade).collect();
    writer.write_image_data(&pixels).expect("pixels");
    writer.finish().expect("an end");
    bytes
}

/// A JPEG of 4 by 4 pixels.
pub fn jpeg() -> Vec<u8> {
    let hex = "ffd8ffe000104a46494600010100000100010000ffdb004300100b0c0e0c0a100e0d0e1211101318281a181616183123251d283a\
        333d3c3933383740485c4e404457453738506d51575f626768673e4d71797064785c656763ffc0000b080004000401011100ffc400140001\
        00000000000000000000000000000005ffc4001a100000070000000000000000000000000000020405061323ffda0008010100003f006924\
        61ae82e03fffd9";
    let digits = hex.as_bytes().chunks(2).map(|pair| std::str::from_utf8(pair).expect("digits"));
    digits.map(|pair| u8::from_str_radix(pair, 16).expect("a byte")).collect()
}

/// `NAME.obj` and `NAME.mtl`, which names an image. Without `placed`, it has no texture coordinates.
pub fn obj(folder: &Path, name: &str, image: &str, placed: bool) {
    let mut text = format!("mtllib {name}.mtl\nusemtl paint\n");
    let corners: Vec<Corner> = faces().into_iter().flatten().collect();
    for ([x, y, z], _) in &corners {
        let _ = writeln!(text, "v {x} {y} {z}");
    }
    // In another order than the positions.
    for (_, [u, v]) in corners.iter().rev().filter(|_| placed) {
        let _ = writeln!(text, "vt {u} {v}");
    }
    for face in 0..6 {
        text += "f";
        for at in face * 4 + 1..=face * 4 + 4 {
            let _ = match placed {
                true => write!(text, " {at}/{}", 25 - at),
                false => write!(text, " {at}"),
            };
        }
        text += "\n";
    }
    write(folder.join(format!("{name}.obj")), text).expect("written");
    let library = format!("newmtl paint\nKd 0.2 0.4 0.6\nmap_Kd {image}\n");
    write(folder.join(format!("{name}.mtl")), library).expect("written");
}

/// `NAME.dae`, whose effect names an image by a sampler and a surface, in centimetres.
pub fn collada(folder: &Path, name: &str, image: &str) {
    let [mut positions, mut uvs, mut p] = [const { String::new() }; 3];
    for (at, (position, [u, v])) in faces().into_iter().flatten().enumerate() {
        let [x, y, z] = position.map(|coordinate| coordinate * 100.0);
        let _ = write!(positions, "{x} {y} {z} ");
        let _ = write!(uvs, "{u} {v} ");
        let _ = write!(p, "{at} 0 {at} ");
    }
    let text = format!(
        r##"<?xml version="1.0"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
  <asset><unit meter="0.01"/><up_axis>Z_UP</up_axis></asset>
  <library_images><image id="paint"><init_from>{image}</init_from></image></library_images>
  <library_effects><effect id="painted"><profile_COMMON>
    <newparam sid="surface"><surface type="2D"><init_from>paint</init_from></surface></newparam>
    <newparam sid="sampler"><sampler2D><source>surface</source></sampler2D></newparam>
    <technique sid="common"><lambert><diffuse><texture texture="sampler" texcoord="uv"/></diffuse></lambert></technique>
  </profile_COMMON></effect></library_effects>
  <library_materials><material id="m"><instance_effect url="#painted"/></material></library_materials>
  <library_geometries><geometry id="box"><mesh>
    <source id="at"><float_array id="at-array" count="72">{positions}</float_array><technique_common>
      <accessor source="#at-array" count="24" stride="3"><param name="X"/><param name="Y"/><param name="Z"/></accessor>
    </technique_common></source>
    <source id="normal"><float_array id="n" count="3">0 0 1</float_array><technique_common>
      <accessor source="#n" count="1" stride="3"><param name="X"/><param name="Y"/><param name="Z"/></accessor>
    </technique_common></source>
    <source id="uv"><float_array id="uv-array" count="48">{uvs}</float_array><technique_common>
      <accessor source="#uv-array" count="24" stride="2"><param name="S"/><param name="T"/></accessor>
    </technique_common></source>
    <vertices id="v"><input semantic="POSITION" source="#at"/></vertices>
    <polylist count="6" material="symbol"><input semantic="VERTEX" source="#v" offset="0"/>
      <input semantic="NORMAL" source="#normal" offset="1"/>
      <input semantic="TEXCOORD" source="#uv" offset="2" set="0"/>
      <vcount>4 4 4 4 4 4</vcount><p>{p}</p></polylist>
  </mesh></geometry></library_geometries>
  <library_visual_scenes><visual_scene id="s"><node><instance_geometry url="#box"><bind_material><technique_common>
    <instance_material symbol="symbol" target="#m"/></technique_common></bind_material></instance_geometry></node>
  </visual_scene></library_visual_scenes>
  <scene><instance_visual_scene url="#s"/></scene>
</COLLADA>"##
    );
    write(folder.join(format!("{name}.dae")), text).expect("written");
}

/// `NAME.gltf` with `NAME.bin`, which names an image; or, with the image, `NAME.glb` that holds it. y is up.
pub fn gltf(folder: &Path, name: &str, image: Result<&str, &[u8]>) {
    let mut data = Vec::new();
    let corners: Vec<Corner> = faces().into_iter().flatten().collect();
    let mut push = |numbers: &[f64]| {
        numbers.iter().for_each(|number| data.extend((*number as f32).to_le_bytes()));
    };
    corners.iter().for_each(|([x, y, z], _)| push(&[*x, *z, -y]));
    corners.iter().for_each(|(_, [u, v])| push(&[*u, 1.0 - v]));
    for face in 0..6_u16 {
        for corner in [0, 1, 2, 0, 2, 3] {
            data.extend((face * 4 + corner).to_le_bytes());
        }
    }
    let (image, buffer, length) = match image {
        Ok(image) => (format!(r#""uri": "{image}""#), format!(r#""uri": "{name}.bin","#), 0),
        Err(bytes) => {
            data.extend(bytes);
            (r#""bufferView": 3, "mimeType": "image/png""#.to_owned(), String::new(), bytes.len())
        }
    };
    let total = data.len();
    let json = format!(
        r#"{{"asset": {{"version": "2.0"}}, "scene": 0, "scenes": [{{"nodes": [0]}}], "nodes": [{{"mesh": 0}}],
        "meshes": [{{"primitives": [{{"attributes": {{"POSITION": 0, "TEXCOORD_0": 1}}, "indices": 2, "material": 0}}]}}],
        "materials": [{{"pbrMetallicRoughness": {{"baseColorTexture": {{"index": 0}}}}}}],
        "textures": [{{"source": 0}}], "images": [{{{image}}}],
        "accessors": [{{"bufferView": 0, "componentType": 5126, "count": 24, "type": "VEC3",
            "min": [-0.5, -1.5, -1.0], "max": [0.5, 1.5, 1.0]}},
          {{"bufferView": 1, "componentType": 5126, "count": 24, "type": "VEC2"}},
          {{"bufferView": 2, "componentType": 5123, "count": 36, "type": "SCALAR"}}],
        "bufferViews": [{{"buffer": 0, "byteLength": 288}},
          {{"buffer": 0, "byteOffset": 288, "byteLength": 192}}, {{"buffer": 0, "byteOffset": 480, "byteLength": 72}},
          {{"buffer": 0, "byteOffset": 552, "byteLength": {length}}}],
        "buffers": [{{{buffer} "byteLength": {total}}}]}}"#
    );
    if length == 0 {
        write(folder.join(format!("{name}.bin")), data).expect("written");
        write(folder.join(format!("{name}.gltf")), json).expect("written");
        return;
    }
    let [mut json, mut data] = [json.into_bytes(), data];
    json.resize(json.len().next_multiple_of(4), b' ');
    data.resize(data.len().next_multiple_of(4), 0);
    let mut bytes = b"glTF".to_vec();
    let word = |bytes: &mut Vec<u8>, value: usize| bytes.extend((value as u32).to_le_bytes());
    word(&mut bytes, 2);
    word(&mut bytes, 12 + 8 + json.len() + 8 + data.len());
    for (kind, chunk) in [(b"JSON", json), (b"BIN\0", data)] {
        word(&mut bytes, chunk.len());
        bytes.extend(kind);
        bytes.extend(chunk);
    }
    write(folder.join(format!("{name}.glb")), bytes).expect("written");
}

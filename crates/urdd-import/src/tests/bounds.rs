//! What a little may ask for: everything that an import makes is charged, and what is beyond the account is refused with
//! the place. Each of these took gigabytes or minutes.

use std::fmt::Write;
use std::path::Path;
use std::sync::Arc;

use urdd_directory::account::Overdrawn;
use urdd_source::Files;
use urdd_source::SourceError;

use crate::import;
use urdd_source::Settings;

pub fn in_memory(files: &[(&str, &[u8])]) -> Settings {
    let files = files.iter().map(|(path, bytes)| ((*path).to_owned(), Arc::from(*bytes)));
    let mut settings = Settings { files: Files::in_memory(files).unwrap(), ..Settings::default() };
    settings.import.body = None;
    settings
}

/// The place at which a description is refused because too much would be made of it.
pub fn refused(name: &str, settings: &Settings) -> (u32, u32) {
    match import(&Path::new("/").join(name), settings) {
        Err(SourceError::Import { line, column, fault, .. }) => {
            assert_eq!(fault, Overdrawn.to_string());
            (line, column)
        }
        other => panic!("{name} is not refused: {:?}", other.map(|found| found.is_some())),
    }
}

pub fn mjcf(before: &str, body: &str, after: &str) -> String {
    format!("<mujoco>{before}<worldbody>{body}</worldbody>{after}</mujoco>")
}

pub fn long(length: usize) -> String {
    "n".repeat(length)
}

#[test]
fn names_of_mjcf_that_are_made_of_long_ones() {
    let name = long(300_000);
    for body in [
        format!(
            "<body><geom size=\"1\"/><replicate count=\"20000\"><body name=\"{name}\"/></replicate></body>"
        ),
        format!("<body name=\"{name}\"><geom size=\"1\"/>{}</body>", "<site/>".repeat(20_000)),
        format!("<body name=\"{name}\"><geom size=\"1\"/>{}</body>", "<camera/>".repeat(20_000)),
        format!("<body name=\"{name}\"><geom size=\"1\"/>{}</body>", "<body/>".repeat(20_000)),
        format!(
            "<body name=\"b\"><joint name=\"{name}\" type=\"ball\"/><geom size=\"1\"/><replicate count=\"9000\"><body><joint name=\"{name}\"/></body></replicate></body>"
        ),
        format!(
            "<body><geom size=\"1\"/><replicate count=\"9000\"><geom size=\"1\" type=\"mesh\" mesh=\"{name}\"/></replicate></body>"
        ),
    ] {
        let text = mjcf("", &body, "");
        let (line, column) = refused("r.xml", &in_memory(&[("r.xml", text.as_bytes())]));
        assert!(line == 1 && column > 1, "{line}:{column}");
    }
}

#[test]
fn values_of_default_classes_that_are_long() {
    let name = long(100_000);
    for attribute in ["material", "mesh", "user"] {
        let defaults = format!("<default><geom {attribute}=\"{name}\"/></default>");
        let body = format!("<body>{}</body>", "<geom size=\"1\"/>".repeat(20_000));
        let text = mjcf(&defaults, &body, "");
        refused("r.xml", &in_memory(&[("r.xml", text.as_bytes())]));
    }
}

#[test]
fn products_of_replicas() {
    let replicas = |count: usize, what: &str| {
        format!(
            "<body><geom size=\"1\"/><replicate count=\"{count}\" offset=\"1 0 0\">{what}</replicate></body>"
        )
    };
    let moving = replicas(2000, "<body><joint/><geom size=\"1\" mass=\"1\"/></body>");
    let named = replicas(5000, "<body name=\"b\"><joint name=\"j\"/></body>");
    let attributes = (0..250).fold(String::new(), |all, at| all + &format!(" a{at}=\"1\""));
    let classes: String =
        (0..30).map(|at| format!("<default class=\"c{at}\"><geom{attributes}/>")).collect();
    let classes = format!("<default>{classes}{}", "</default>".repeat(31));
    for (before, body, after) in [
        ("", &moving, format!("<keyframe>{}</keyframe>", "<key/>".repeat(3000))),
        (
            "",
            &named,
            format!("<contact>{}</contact>", "<exclude body1=\"b\" body2=\"b\"/>".repeat(10_000)),
        ),
        ("", &named, format!("<equality>{}</equality>", "<joint joint1=\"j\"/>".repeat(10_000))),
        ("", &named, format!("<actuator>{}</actuator>", "<motor joint=\"j\"/>".repeat(10_000))),
        (
            "",
            &replicas(1_000_000, "<replicate count=\"1000000\"><site/></replicate>"),
            String::new(),
        ),
        (
            &classes,
            &replicas(90_000, &format!("<geom class=\"c29\" size=\"1\"{attributes}/>")),
            String::new(),
        ),
    ] {
        let text = mjcf(before, body, &after);
        refused("r.xml", &in_memory(&[("r.xml", text.as_bytes())]));
    }
}

#[test]
fn one_file_by_very_many_names() {
    let spelled = |at: usize| format!(".{}{}", "/".repeat(at % 40 + 1), "./".repeat(at / 40));
    let includes: String =
        (0..6000).map(|at| format!("<include file=\"{}b.xml\"/>", spelled(at))).collect();
    let text = mjcf("", "<body><geom size=\"1\"/></body>", &includes);
    let large = format!("<mujoco><!--{}--></mujoco>", long(400_000));
    refused("r.xml", &in_memory(&[("r.xml", text.as_bytes()), ("b.xml", large.as_bytes())]));

    let mut triangles = vec![0; 80];
    triangles.extend(10_000_u32.to_le_bytes());
    for at in 0..30_000_u32 {
        let corner = [at % 97, at % 89, at % 83];
        if at % 3 == 0 {
            triangles.extend([0; 12]);
        }
        corner.iter().for_each(|x| triangles.extend((*x as f32).to_le_bytes()));
        if at % 3 == 2 {
            triangles.extend([0; 2]);
        }
    }
    // As it is, by many names: it is one file. Turned and stretched, each is another.
    let meshes = |more: &str| {
        let (mut assets, mut geoms) = (String::new(), String::new());
        for at in 0..3000 {
            let file = spelled(at);
            write!(assets, "<mesh name=\"m{at}\" file=\"{file}a.stl\" {more}/>").unwrap();
            write!(geoms, "<geom type=\"mesh\" mesh=\"m{at}\" mass=\"1\"/>").unwrap();
        }
        let inertial = "<inertial pos=\"0 0 0\" mass=\"1\" diaginertia=\"1 1 1\"/>";
        mjcf(&format!("<asset>{assets}</asset>"), &format!("<body>{inertial}{geoms}</body>"), "")
    };
    let text = meshes("");
    let same = in_memory(&[("r.xml", text.as_bytes()), ("a.stl", &triangles)]);
    let imported = import(Path::new("/r.xml"), &same).unwrap().unwrap();
    assert_eq!(imported.files.keys().filter(|path| path.ends_with(".stl")).count(), 1);
    let text = meshes("scale=\"1 1 2\" refquat=\"1 2 3 4\"");
    refused("r.xml", &in_memory(&[("r.xml", text.as_bytes()), ("a.stl", &triangles)]));
}

#[test]
fn includes_in_one_another_are_levels() {
    let mut files: Vec<(String, String)> = (0..6300)
        .map(|at| (format!("{at}.xml"), format!("<m><include file=\"{}.xml\"/></m>", at + 1)))
        .collect();
    files.push(("6300.xml".to_owned(), "<m/>".to_owned()));
    files.push(("r.xml".to_owned(), "<mujoco><include file=\"0.xml\"/></mujoco>".to_owned()));
    let files: Vec<(&str, &[u8])> =
        files.iter().map(|(path, text)| (path.as_str(), text.as_bytes())).collect();
    let error = import(Path::new("/r.xml"), &in_memory(&files)).unwrap_err().to_string();
    assert!(error.contains("nested more than 256 deep"), "{error}");
}

#[test]
fn names_of_sdf_that_are_made_of_long_ones() {
    let name = long(300_000);
    let links: String = (0..20_000).map(|at| format!("<link name=\"{at}\"/>")).collect();
    let sensors = "<sensor name=\"x\" type=\"camera\"/>".repeat(15_000);
    let pose = "<pose relative_to=\"__model__\">1 0 0 0 0 0</pose>";
    let posed = format!("<sensor name=\"x\" type=\"imu\">{pose}</sensor>").repeat(15_000);
    let middle = long(5000);
    let nested = format!("<model name=\"{middle}\"><link name=\"b\"/>");
    for inside in [
        format!("<link name=\"r\"/><model name=\"{name}\">{links}</model>"),
        format!("<link name=\"{name}\">{sensors}</link>"),
        format!("<link name=\"{name}\">{posed}</link>"),
        format!("{}{links}{}", nested.repeat(60), "</model>".repeat(60)),
    ] {
        let text = format!("<sdf version=\"1.10\"><model name=\"m\">{inside}</model></sdf>");
        let (line, column) = refused("r.sdf", &in_memory(&[("r.sdf", text.as_bytes())]));
        assert!(line == 1 && column > 1, "{line}:{column}");
    }
}

#[test]
fn names_of_included_models_that_are_long() {
    let name = long(300_000);
    let part =
        format!("<sdf version=\"1.9\"><model name=\"{name}\"><link name=\"l\"/></model></sdf>");
    let includes = "<include><uri>b.sdf</uri></include>".repeat(1000);
    let text = format!("<sdf version=\"1.9\"><world name=\"w\">{includes}</world></sdf>");
    refused("r.sdf", &in_memory(&[("r.sdf", text.as_bytes()), ("b.sdf", part.as_bytes())]));
}

/// A part of a mesh has its own points, and is what it was as a part of the whole.
#[test]
fn parts_of_meshes_hold_what_they_need() {
    let mut obj = String::from("mtllib none.mtl\n");
    for at in 0..300 {
        let z = at * 3;
        writeln!(
            obj,
            "o s{at}\nv {at} 0 {z}\nv {at} 1 {z}\nv {at} 0 {}\nvt 0 0\nusemtl m{at}",
            z + 1
        )
        .unwrap();
        writeln!(obj, "f -3/-1 -2/-1 \\\n-1/-1").unwrap();
    }
    let visual = |at: usize| {
        format!(
            "<visual name=\"{at}\"><geometry><mesh><uri>a.obj</uri><submesh><name>s{at}</name></submesh></mesh></geometry></visual>"
        )
    };
    let visuals: String = (0..300).map(visual).collect();
    let text = format!(
        "<sdf version=\"1.10\"><model name=\"m\"><link name=\"l\">{visuals}</link></model></sdf>"
    );
    let settings = in_memory(&[("r.sdf", text.as_bytes()), ("a.obj", obj.as_bytes())]);
    let imported = import(Path::new("/r.sdf"), &settings).unwrap().unwrap();
    let parts: Vec<&Arc<[u8]>> =
        (0..300).map(|at| &imported.files[&format!("meshes/a.s{at}.obj")]).collect();
    assert_eq!(
        std::str::from_utf8(parts[7]).unwrap(),
        "mtllib none.mtl\no s7\nv 7 0 21\nv 7 1 21\nv 7 0 22\nvt 0 0\nusemtl m7\nf 1/1 2/1 3/1\n"
    );
    let sum: usize = parts.iter().map(|part| part.len()).sum();
    assert!(sum < 2 * obj.len(), "{sum} of {}", obj.len());
}

/// Two names that differ in what file names can have are two parts.
#[test]
fn parts_whose_names_are_alike_are_told_apart() {
    let part =
        |name: &str, x: u8| format!("o {name}\nv {x} 0 0\nv {x} 1 0\nv {x} 0 1\nf -3 -2 -1\n");
    let obj = part("a b", 1) + &part("a_b", 2);
    let visual = |name: &str| {
        format!(
            "<visual name=\"{name}\"><geometry><mesh><uri>a.obj</uri><submesh><name>{name}</name></submesh></mesh></geometry></visual>"
        )
    };
    let text = format!(
        "<sdf version=\"1.10\"><model name=\"m\"><link name=\"l\">{}{}</link></model></sdf>",
        visual("a b"),
        visual("a_b")
    );
    let settings = in_memory(&[("r.sdf", text.as_bytes()), ("a.obj", obj.as_bytes())]);
    let imported = import(Path::new("/r.sdf"), &settings).unwrap().unwrap();
    let parts = imported.files.iter().filter(|(path, _)| path.ends_with(".obj"));
    let parts: Vec<&[u8]> = parts.map(|(_, bytes)| &**bytes).collect();
    assert!(parts.len() == 2 && parts[0] != parts[1], "{:?}", imported.files.keys());
}

#[test]
fn models_that_are_attached_very_often() {
    let part = mjcf("", &format!("<body name=\"x\">{}</body>", "<body/>".repeat(3000)), "");
    let attach = "<attach model=\"m\" body=\"x\" prefix=\"p\"/>".repeat(300);
    let assets = "<asset><model name=\"m\" file=\"b.xml\"/></asset>";
    let text = mjcf(assets, &format!("<body><geom size=\"1\"/>{attach}</body>"), "");
    let files = in_memory(&[("r.xml", text.as_bytes()), ("b.xml", part.as_bytes())]);
    let error = import(Path::new("/r.xml"), &files).unwrap_err().to_string();
    // At an `<attach>`, before anything is copied.
    assert!(
        error.starts_with("/r.xml:1:") && error.contains("needs more memory or work"),
        "{error}"
    );
}

#[test]
fn pairs_of_bodies_with_long_names() {
    let name = long(20_000);
    let body = |at: usize| {
        let geom = "<geom size=\"1\" contype=\"1\" conaffinity=\"2\"/>";
        format!("<body name=\"{at}{name}\"><joint/>{geom}</body>")
    };
    let bodies = |count: usize| mjcf("", &(0..count).map(body).collect::<String>(), "");
    let read = |text: &str| import(Path::new("/r.xml"), &in_memory(&[("r.xml", text.as_bytes())]));
    assert!(read(&bodies(20)).is_ok());
    refused("r.xml", &in_memory(&[("r.xml", bodies(200).as_bytes())]));
}

/// An STL of 10,000 triangles.
fn stl() -> Vec<u8> {
    let mut bytes = vec![0; 80];
    bytes.extend(10_000_u32.to_le_bytes());
    for corner in corners() {
        if corner.0 % 3 == 0 {
            bytes.extend([0; 12]);
        }
        corner.1.iter().for_each(|x| bytes.extend(x.to_le_bytes()));
        if corner.0 % 3 == 2 {
            bytes.extend([0; 2]);
        }
    }
    bytes
}

/// The numbers and places of 30,000 corners.
fn corners() -> impl Iterator<Item = (u32, [f32; 3])> {
    (0..30_000).map(|at: u32| (at, [at % 97, at % 89, at % 83].map(|x| x as f32)))
}

/// What is made of one mesh: its points again for each content type, its measures for each scale, a copy for each
/// primitive that is fitted to it. Of a few it is read.
#[test]
fn meshes_that_are_read_measured_and_fitted_very_often() {
    let mut msh: Vec<u8> =
        [30_000_u32, 0, 0, 10_000].iter().flat_map(|x| x.to_le_bytes()).collect();
    msh.extend(corners().flat_map(|(_, corner)| corner).flat_map(f32::to_le_bytes));
    msh.extend((0..30_000_u32).flat_map(u32::to_le_bytes));
    let obj =
        corners().fold(String::new(), |text, (_, [x, y, z])| text + &format!("v {x} {y} {z}\n"));
    let files = [("a.stl", stl()), ("a.msh", msh), ("a.obj", obj.into_bytes())];
    let robot = |count: usize, asset: &dyn Fn(usize) -> String, geom: &dyn Fn(usize) -> String| {
        let [assets, geoms]: [String; 2] = [asset, geom].map(|of| (0..count).map(of).collect());
        let before = format!("<compiler fitaabb=\"true\"/><asset>{assets}</asset>");
        mjcf(&before, &format!("<body><geom size=\"1\"/>{geoms}</body>"), "")
    };
    let seen = |at: usize| {
        format!("<geom type=\"mesh\" mesh=\"m{at}\" contype=\"0\" conaffinity=\"0\" mass=\"0\"/>")
    };
    let of_type = |kind: &'static str| {
        move |at: usize| {
            format!("<mesh name=\"m{at}\" file=\"a.{kind}\" content_type=\"{at}/{kind}\"/>")
        }
    };
    let scaled = |at: usize| format!("<mesh name=\"m{at}\" file=\"a.stl\" scale=\"1 1 {at}.5\"/>");
    let weighed = |at: usize| format!("<geom type=\"mesh\" mesh=\"m{at}\" mass=\"1\"/>");
    let first = |at: usize| if at == 0 { scaled(0) } else { String::new() };
    let fitted = |_: usize| "<geom type=\"box\" mesh=\"m0\" mass=\"1\"/>".to_owned();
    type Of<'a> = &'a dyn Fn(usize) -> String;
    let cases: [(&str, usize, Of, Of); 4] = [
        ("read as MSH", 100, &of_type("msh"), &seen),
        ("read as OBJ", 100, &of_type("obj"), &seen),
        ("measured", 100, &scaled, &weighed),
        ("fitted", 500, &first, &fitted),
    ];
    for (what, count, asset, geom) in cases {
        for (count, is_read) in [(5, true), (count, false)] {
            let text = robot(count, asset, geom);
            let own = [("r.xml", text.as_bytes())].into_iter();
            let all: Vec<_> = own.chain(files.iter().map(|(path, of)| (*path, &**of))).collect();
            match is_read {
                true => assert!(import(Path::new("/r.xml"), &in_memory(&all)).is_ok(), "{what}"),
                false => _ = refused("r.xml", &in_memory(&all)),
            }
        }
    }
}

#[test]
fn work_that_grows_with_a_square() {
    let robot = |count: usize, after: &dyn Fn(usize) -> String, tag: &str| {
        let bodies: String = (0..count)
            .map(|at| format!("<body><joint name=\"{at}\"/><geom size=\"1\" contype=\"0\" conaffinity=\"0\"/></body>"))
            .collect();
        let after: String = (1..count).map(after).collect();
        mjcf("", &format!("<body name=\"b\">{bodies}</body>"), &format!("<{tag}>{after}</{tag}>"))
    };
    // Each joint follows the one before: whether it leads itself is looked for along all of them.
    let follows = |at: usize| format!("<joint joint1=\"{at}\" joint2=\"{}\"/>", at - 1);
    // The mass that each servo moves.
    let servo = |at: usize| format!("<position joint=\"{at}\" kp=\"1\" dampratio=\"1\"/>");
    for text in [robot(10_000, &follows, "equality"), robot(5000, &servo, "actuator")] {
        refused("r.xml", &in_memory(&[("r.xml", text.as_bytes())]));
    }
    // Which shapes of each pair of bodies collide, by their bits.
    let geoms: String = (1..=32)
        .map(|at| format!("<geom size=\"1\" contype=\"{at}\" conaffinity=\"1\"/>"))
        .collect();
    let bodies = format!("<body><joint/>{geoms}</body>").repeat(900);
    let text = mjcf("", &format!("<body name=\"b\"><geom size=\"1\"/>{bodies}</body>"), "");
    refused("r.xml", &in_memory(&[("r.xml", text.as_bytes())]));
    // What each class around an actuator says of it.
    let classes: String = (0..30).map(|at| format!("<default class=\"c{at}\">")).collect();
    let classes = format!("<default>{classes}{}", "</default>".repeat(31));
    let motors = "<motor joint=\"j\" class=\"c29\"/>".repeat(10_000);
    let body = "<body><geom size=\"1\"/><body><joint name=\"j\"/><geom size=\"1\"/></body></body>";
    let text = mjcf(&classes, body, &format!("<actuator>{motors}</actuator>"));
    refused("r.xml", &in_memory(&[("r.xml", text.as_bytes())]));
    // Names of files behind a long folder.
    let folder = long(300_000);
    let meshes: String =
        (0..100).map(|at| format!("<mesh name=\"m{at}\" file=\"a.obj\"/>")).collect();
    let geoms: String =
        (0..100).map(|at| format!("<geom type=\"mesh\" mesh=\"m{at}\"/>")).collect();
    let before = format!("<compiler meshdir=\"{folder}\"/><asset>{meshes}</asset>");
    let text = mjcf(&before, &format!("<body><geom size=\"1\"/>{geoms}</body>"), "");
    let mesh = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n";
    let files = [("r.xml", text.as_bytes()), (&*format!("{folder}/a.obj"), mesh.as_bytes())];
    refused("r.xml", &in_memory(&files));
}

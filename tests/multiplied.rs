//! Descriptions that multiply: long names and many elements, replicas and keys, one file by many names. Whatever is drawn,
//! an answer takes at most a stated multiple of the input and a constant, in memory; and so do all allocations on the way
//! to it together, which measure the work.
//!
//! A program of its own, with one test: it counts what all threads allocate. `URDD_TRIALS=625 cargo test --release --test
//! multiplied -- --nocapture` tries 10,000 and prints the largest; `URDD_FIRST` is the number of the first,
//! for several processes.

// A test may stop anywhere; an allocator is unsafe.
#![allow(clippy::restriction, clippy::disallowed_methods, unsafe_code)]

use std::alloc::{GlobalAlloc, Layout, System};
use std::collections::BTreeMap;
use std::path::Path;
use std::sync::atomic::{AtomicUsize, Ordering::Relaxed};
use std::sync::{Arc, Mutex};

use testkit::dice::Dice;
use testkit::trials::trials;
use urdd_diff::{Side, compare};
use urdd_directory::limits::{ALLOWANCE, MULTIPLE};
use urdd_generate::{Selection, generate_in_memory};
use urdd_import::import_whole;
use urdd_lint::{LintSettings, lint_with_text};
use urdd_source::{Files, Settings};

/// How many times the allowance lint and diff may take of a description that is imported: what the import makes is their
/// input.
const OF_IMPORT: usize = 3;
/// Number of descriptions by default.
const FEW: u32 = 16;
/// Maximum bytes of all allocations together: for each byte of the input, and in any case.
const WORK: usize = 50_000;
const LEAST_WORK: usize = 2 << 30;
/// Live bytes at which the program ends: the machine may not have more.
const ABORT: usize = 3 << 30;
const FORMATS: [Format; 4] = [Format::Urdf, Format::Mjcf, Format::Sdf, Format::Usd];

#[derive(Clone, Copy, Debug, PartialEq)]
enum Format {
    Urdf,
    Mjcf,
    Sdf,
    Usd,
}

struct Counting;

static LIVE: AtomicUsize = AtomicUsize::new(0);
static PEAK: AtomicUsize = AtomicUsize::new(0);
static ALL: AtomicUsize = AtomicUsize::new(0);
static MOST: AtomicUsize = AtomicUsize::new(usize::MAX);
/// What is being tried.
static NOW: Mutex<String> = Mutex::new(String::new());

fn add(size: usize) {
    ALL.fetch_add(size, Relaxed);
    let live = LIVE.fetch_add(size, Relaxed) + size;
    PEAK.fetch_max(live, Relaxed);
    if live > MOST.load(Relaxed) {
        MOST.store(usize::MAX, Relaxed);
        eprintln!("{live} bytes are live: {}", NOW.lock().unwrap());
        std::process::abort();
    }
}

// SAFETY: the system's allocator does the work.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        add(layout.size());
        // SAFETY: guaranteed by the caller.
        unsafe { System.alloc(layout) }
    }

    unsafe fn dealloc(&self, at: *mut u8, layout: Layout) {
        LIVE.fetch_sub(layout.size(), Relaxed);
        // SAFETY: guaranteed by the caller.
        unsafe { System.dealloc(at, layout) }
    }

    unsafe fn realloc(&self, at: *mut u8, layout: Layout, size: usize) -> *mut u8 {
        add(size);
        LIVE.fetch_sub(layout.size(), Relaxed);
        // SAFETY: guaranteed by the caller.
        unsafe { System.realloc(at, layout, size) }
    }
}

#[global_allocator]
static ALLOCATOR: Counting = Counting;

/// What is drawn.
struct Draw {
    dice: Dice,
    /// About the size of the description, bytes.
    size: usize,
    /// What was drawn, in words.
    said: Vec<String>,
    files: BTreeMap<String, Vec<u8>>,
}

impl Draw {
    fn chance(&mut self, one_in: usize) -> bool {
        self.dice.below(one_in) == 0
    }

    fn one_of<T: Copy>(&mut self, all: &[T]) -> T {
        all[self.dice.below(all.len())]
    }

    /// A name, perhaps a long one.
    fn name(&mut self, short: &str) -> String {
        if !self.chance(3) {
            return short.to_owned();
        }
        let length = self.size >> self.dice.below(6);
        self.said.push(format!("{short} of {length} bytes"));
        short.repeat(1 + length / short.len())
    }

    /// Elements, of each of which the text is made of its number.
    fn many(&mut self, what: &str, each: impl Fn(usize) -> String) -> String {
        let count = (self.size / each(0).len().max(1)).max(1) >> self.dice.below(6);
        self.said.push(format!("{count} {what}"));
        (0..count).map(each).collect()
    }

    /// Some of these.
    fn some<T: Copy>(&mut self, all: &[T]) -> Vec<T> {
        let count = 1 + self.dice.below(3);
        (0..count).map(|_| self.one_of(all)).collect()
    }

    fn file(&mut self, name: &str, content: impl Into<Vec<u8>>) {
        self.files.insert(name.to_owned(), content.into());
    }

    fn stl(&mut self, name: &str) {
        let count = (self.size / 50) >> self.dice.below(6);
        let mut bytes = vec![0; 80];
        bytes.extend(u32::try_from(count).unwrap().to_le_bytes());
        for _ in 0..count {
            bytes.extend([0; 12]);
            let corner = |dice: &mut Dice| (dice.below(2000) as f32 - 1000.0).to_le_bytes();
            (0..9).for_each(|_| bytes.extend(corner(&mut self.dice)));
            bytes.extend([0; 2]);
        }
        self.said.push(format!("a mesh of {count} triangles"));
        self.file(name, bytes);
    }
}

/// Another spelling of a file's name for each number.
fn spelled(name: &str, number: usize) -> String {
    format!(".{}{}{name}", "/".repeat(number % 40 + 1), "./".repeat(number / 40))
}

const MASS: &str = "<inertial><mass value=\"1\"/><inertia ixx=\"1\" ixy=\"0\" ixz=\"0\" iyy=\"1\" iyz=\"0\" izz=\"1\"/></inertial>";
const LIMIT: &str = "<limit lower=\"-1\" upper=\"1\" effort=\"1\" velocity=\"1\"/>";
const SHAPES: [&str; 4] = [
    "<sphere radius=\"1\"/>",
    "<cylinder radius=\"1\" length=\"1\"/>",
    "<box size=\"1 1 1\"/>",
    "<capsule radius=\"1\" length=\"1\"/>",
];

fn urdf(draw: &mut Draw) {
    let (robot, link, joint) = (draw.name("r"), draw.name("l"), draw.name("j"));
    let (material, tag, value) = (draw.name("m"), draw.name("tag"), draw.name("v"));
    let (mut in_robot, mut in_link, mut in_joint) = (String::new(), String::new(), String::new());
    let all: Vec<usize> = (0..22).collect();
    for what in draw.some(&all) {
        let shape = draw.one_of(&SHAPES);
        let kind = draw.one_of(&["visual", "collision"]);
        let part = draw.one_of(&["limit", "axis", "mimic", "dynamics", "origin"]);
        let below = |number: usize| {
            format!(
                "<link name=\"k{number}\">{MASS}<{kind}><geometry>{shape}</geometry></{kind}></link>"
            )
        };
        match what {
            0 => in_link += &draw.many("empty shapes", |_| format!("<{kind}/>")),
            1 => {
                in_link += &draw.many("shapes", |number| {
                    format!("<{kind}><origin xyz=\"{number} 0 0\"/><geometry>{shape}</geometry></{kind}>")
                });
            }
            2 => in_link += &draw.many("inertials", |_| "<inertial/>".to_owned()),
            3 => {
                in_link += &draw.many("uses of a material", |_| {
                    format!("<visual><geometry>{shape}</geometry><material name=\"m\"/></visual>")
                });
            }
            4 | 5 => {
                let kind = draw.one_of(&["fixed", "revolute", "continuous"]);
                in_robot += &draw.many("links below one", |number| {
                    format!("{}<joint name=\"i{number}\" type=\"{kind}\"><parent link=\"base\"/><child link=\"k{number}\"/>{LIMIT}</joint>", below(number))
                });
            }
            6 => {
                in_robot += &draw.many("links in a line", |number| {
                    let above = number.checked_sub(1).map_or("base".to_owned(), |above| format!("k{above}"));
                    format!("{}<joint name=\"i{number}\" type=\"fixed\"><parent link=\"{above}\"/><child link=\"k{number}\"/></joint>", below(number))
                });
            }
            7 => {
                in_robot += &draw.many("references of Gazebo", |number| {
                    format!("<gazebo reference=\"g{number}\"><mu1>1</mu1></gazebo>")
                });
            }
            8 => {
                in_robot += &draw.many("references to one", |_| {
                    "<gazebo reference=\"base\"><mu1>1</mu1></gazebo>".to_owned()
                })
            }
            9 => {
                in_robot += &draw.many("transmissions", |number| {
                    format!("<transmission name=\"t{number}\"><joint name=\"x{number}\"/><actuator name=\"a\"/></transmission>")
                });
            }
            10 => {
                in_link += &format!(
                    "<{tag}>{}</{tag}>",
                    draw.many("meshes in an unknown element", |_| "<mesh filename=\"/x\"/>"
                        .to_owned())
                )
            }
            11 => {
                in_link += &draw
                    .many("unknown attributes", |_| "<visual nmae=\"1\" Name=\"2\"/>".to_owned())
            }
            12 => {
                in_robot += &draw.many("comments", |_| "<!-- urdd: allow LNT001 x -->\n".to_owned())
            }
            13 => {
                in_robot += &format!("<material name=\"m\"><color rgba=\"{value}\"/></material>");
                in_robot += &draw.many("materials", |_| {
                    "<material name=\"m\"><color rgba=\"1 0 0 1\"/></material>".to_owned()
                });
            }
            14 | 15 => {
                draw.stl("m.stl");
                in_link += &draw.many("names of a mesh", |number| {
                    format!("<{kind}><geometry><mesh filename=\"{}\" scale=\"1 1 {}\"/></geometry></{kind}>", spelled("m.stl", number), number + 1)
                });
            }
            16 => {
                in_robot += &draw.many("mimics", |number| {
                    format!("{}<joint name=\"i{number}\" type=\"revolute\"><parent link=\"base\"/><child link=\"k{number}\"/>{LIMIT}<mimic joint=\"j\"/></joint>", below(number))
                });
            }
            17 => in_link += &draw.many("misspelt elements", |_| "<vsual/>".to_owned()),
            18 => in_joint += &draw.many("elements of a joint", |_| format!("<{part}/>")),
            19 => {
                in_robot += &format!(
                    "<ros2_control>{}</ros2_control>",
                    draw.many("joints of a control", |number| format!(
                        "<joint name=\"c{number}\"/>"
                    ))
                )
            }
            20 => {
                in_robot += &format!(
                    "<mujoco><compiler meshdir=\"{value}\" strippath=\"false\"/></mujoco>"
                );
                in_link += &draw.many("meshes that are missing", |number| {
                    format!(
                        "<visual><geometry><mesh filename=\"{number}.stl\"/></geometry></visual>"
                    )
                });
            }
            _ => {
                let pairs = draw.many("pairs", |number| {
                    format!("<disable_collisions link1=\"base\" link2=\"p{number}\"/>")
                });
                draw.file("r.srdf", format!("<robot name=\"{robot}\">{pairs}</robot>"));
            }
        }
    }
    let in_namespace = if draw.chance(6) { format!(" xmlns=\"{value}\"") } else { String::new() };
    let text = format!(
        "<robot name=\"{robot}\"{in_namespace}><link name=\"base\"/><link name=\"{link}\">{in_link}</link>\
        <joint name=\"{joint}\" type=\"revolute\"><parent link=\"base\"/><child link=\"{link}\"/>{LIMIT}{in_joint}</joint>\
        <material name=\"{material}\"/>{in_robot}</robot>"
    );
    draw.file("r.urdf", text);
}

fn mjcf(draw: &mut Draw) {
    let (body, joint, class) = (draw.name("b"), draw.name("j"), draw.name("c"));
    let (mut top, mut world, mut inside) = (String::new(), String::new(), String::new());
    let all: Vec<usize> = (0..14).collect();
    for what in draw.some(&all) {
        let count = draw.size >> draw.dice.below(10);
        let replicated = |inside: &str| {
            format!("<replicate count=\"{count}\" offset=\"1 0 0\">{inside}</replicate>")
        };
        match what {
            0 | 1 => {
                draw.said.push(format!("{count} replicas"));
                inside += &replicated(&format!(
                    "<body name=\"{body}\"><joint/><geom size=\"1\" mass=\"1\"/></body>"
                ));
            }
            2 => {
                draw.said.push(format!("{count} replicas, twice"));
                inside += &replicated(&replicated("<body><geom size=\"1\"/></body>"));
            }
            3 | 4 => {
                top +=
                    &format!("<keyframe>{}</keyframe>", draw.many("keys", |_| "<key/>".to_owned()))
            }
            5 => {
                world += &replicated(&format!("<body name=\"{body}\"/>"));
                top += &format!(
                    "<contact>{}</contact>",
                    draw.many("excludes", |_| format!(
                        "<exclude body1=\"{body}\" body2=\"{body}\"/>"
                    ))
                );
            }
            6 => {
                let attributes: String =
                    (0..draw.dice.below(250)).map(|one| format!(" a{one}=\"1\"")).collect();
                let depth = 1 + draw.dice.below(30);
                let open: String = (0..depth)
                    .map(|one| format!("<default class=\"{class}{one}\"><geom{attributes}/>"))
                    .collect();
                top += &format!("<default>{open}{}", "</default>".repeat(depth + 1));
                inside += &draw
                    .many("geoms of a class", |_| format!("<geom class=\"{class}0\" size=\"1\"/>"));
            }
            7 | 8 => {
                top += &draw.many("includes", |number| {
                    format!("<include file=\"{}\"/>", spelled("b.xml", number))
                });
                let text = format!("<mujoco><!--{}--></mujoco>", "x".repeat(draw.size));
                draw.file("b.xml", text);
            }
            9 => inside += &draw.many("sites", |_| "<site/>".to_owned()),
            10 => inside += &draw.many("bodies", |_| "<body/>".to_owned()),
            11 | 12 => {
                draw.stl("a.stl");
                let assets = draw.many("assets of a mesh", |number| {
                    format!("<mesh name=\"m{number}\" file=\"a.stl\" scale=\"1 1 {}\" refquat=\"1 2 3 4\"/>", number + 1)
                });
                let count = assets.matches("<mesh").count();
                top += &format!("<asset>{assets}</asset>");
                world += &(0..count)
                    .map(|number| format!("<geom type=\"mesh\" mesh=\"m{number}\"/>"))
                    .collect::<String>();
            }
            _ => {
                top += &format!(
                    "<actuator>{}</actuator>",
                    draw.many("motors", |_| format!("<motor joint=\"{joint}\"/>"))
                )
            }
        }
    }
    let text = format!(
        "<mujoco>{top}<worldbody>{world}<body name=\"{body}\"><joint name=\"{joint}\"/><geom size=\"1\"/>{inside}</body></worldbody></mujoco>"
    );
    draw.file("r.xml", text);
}

fn sdf(draw: &mut Draw) {
    let (model, link, joint) = (draw.name("n"), draw.name("l"), draw.name("j"));
    let (mut in_model, mut in_link) = (String::new(), String::new());
    let all: Vec<usize> = (0..10).collect();
    for what in draw.some(&all) {
        match what {
            0 | 1 => {
                let links = draw.many("links of a nested model", |number| format!("<link name=\"a{number}\"/>"));
                let depth = 1 + draw.dice.below(60);
                in_model += &format!("<model name=\"{model}\"><link name=\"b\"/>").repeat(depth);
                in_model += &(links + &"</model>".repeat(depth));
            }
            2 => in_link += &draw.many("sensors", |_| "<sensor name=\"x\" type=\"camera\"/>".to_owned()),
            3 | 4 => {
                let parts = draw.many("objects", |number| {
                    let at = 3 * number;
                    format!("o s{number}\nv {number} 0 0\nv {number} 1 0\nv {number} 0 1\nf {} {} {}\n", at + 1, at + 2, at + 3)
                });
                draw.file("a.obj", parts);
                in_link += &draw.many("submeshes", |number| {
                    format!("<visual name=\"v{number}\"><geometry><mesh><uri>a.obj</uri><submesh><name>s{number}</name></submesh></mesh></geometry></visual>")
                });
            }
            5 => {
                in_model += &draw.many("includes", |number| format!("<include><uri>s.sdf</uri><name>i{number}</name></include>"));
                let text = format!("<sdf version=\"1.10\"><model name=\"s\"><link name=\"k\"/><!--{}--></model></sdf>", "x".repeat(draw.size));
                draw.file("s.sdf", text);
            }
            6 => in_link += &draw.many("visuals", |_| "<visual name=\"v\"><geometry><sphere><radius>1</radius></sphere></geometry></visual>".to_owned()),
            7 => {
                in_model += &draw.many("frames", |number| format!("<frame name=\"f{number}\" attached_to=\"f{}\"/>", number + 1));
            }
            8 => {
                in_model += &draw.many("joints", |number| {
                    format!("<link name=\"k{number}\"/><joint name=\"{number}\" type=\"fixed\"><parent>l</parent><child>k{number}</child></joint>")
                });
            }
            _ => in_model += &draw.many("plugins", |_| "<plugin name=\"p\" filename=\"f\"/>".to_owned()),
        }
    }
    let text = format!(
        "<sdf version=\"1.10\"><model name=\"{model}\"><link name=\"{link}\">{in_link}</link><link name=\"e\"/>\
        <joint name=\"{joint}\" type=\"fixed\"><parent>{link}</parent><child>e</child></joint>{in_model}</model></sdf>"
    );
    draw.file("r.sdf", text);
}

/// A robot of two bodies whose class has what is drawn, and prims that inherit it.
fn usd(draw: &mut Draw) {
    let (name, body, attribute) = (draw.name("n"), draw.name("b"), draw.name("a"));
    let (mut metadata, mut inside, mut top) = (String::new(), String::new(), String::new());
    let mut kind = draw.one_of(&["", "Xform", "Cube", "MjcActuator", "PhysicsFixedJoint", "Mesh"]);
    let all: Vec<usize> = (0..16).collect();
    for what in draw.some(&all) {
        match what {
            0 => metadata += &draw.many("fields", |number| format!("f{number} = 1\n")),
            1 => {
                let entries = draw.many("entries", |number| format!("int e{number} = 1\n"));
                metadata += &format!("customData = {{\n{entries}}}\n");
            }
            2 => {
                let each = draw.many("configurations", |number| {
                    format!("dictionary c{number} = {{\ndouble j = 1\n}}\n")
                });
                metadata += &format!(
                    "customData = {{\ndictionary urdd = {{\ndictionary configurations = {{\n{each}}}\n}}\n}}\n"
                );
            }
            3 => {
                let names = draw.many("schemas", |number| format!("\"s{number}\", "));
                metadata += &format!("append apiSchemas = [\"PhysicsRigidBodyAPI\", {names}]\n");
            }
            4 => {
                let paths = draw.many("targets", |number| format!("</t{number}>, "));
                inside += &format!("rel physics:body0 = [{paths}</bot/b0>]\n");
            }
            5 => {
                let ops = draw.many("transforms", |_| "\"xformOp:translate\", ".to_owned());
                inside += &format!(
                    "double3 xformOp:translate = (1, 0, 0)\nuniform token[] xformOpOrder = [{ops}]\n"
                );
            }
            6 => {
                let numbers = draw.many("numbers", |_| "1, ".to_owned());
                inside +=
                    &format!("rel mjc:target = </bot/j>\ndouble[] mjc:gainPrm = [{numbers}]\n");
                kind = "MjcActuator";
            }
            7 => inside += &draw.many("attributes", |number| format!("int {attribute}{number}\n")),
            8 => {
                inside += &draw.many("children", |number| format!("def Cube \"k{number}\" {{}}\n"))
            }
            9 => {
                let sets = draw.many("variant sets", |number| {
                    format!("variantSet \"v{number}\" = {{\n\"a\" {{}}\n}}\n")
                });
                let count = sets.matches("variantSet").count().min(900);
                let names: Vec<String> =
                    (0..count).map(|number| format!("\"v{number}\"")).collect();
                let chosen: String =
                    (0..count).map(|number| format!("string v{number} = \"a\"\n")).collect();
                metadata +=
                    &format!("variantSets = [{}]\nvariants = {{\n{chosen}}}\n", names.join(", "));
                inside += &sets;
            }
            10 => {
                let count = draw.dice.below(900);
                draw.said.push(format!("one sublayer {count} times"));
                let layer = draw
                    .many("prims of a layer", |number| format!("def Xform \"l{number}\" {{}}\n"));
                draw.file("b.usda", format!("#usda 1.0\n{layer}"));
                top += &format!("subLayers = [{}]\n", "@b.usda@, ".repeat(count));
            }
            11 => {
                let depth = 1 + draw.dice.below(1000);
                draw.said.push(format!("{depth} levels"));
                inside += &("def \"d\" {\n".repeat(depth) + &"}\n".repeat(depth));
            }
            12 => metadata += &format!("displayName = \"{name}\"\n"),
            13 => {
                let faces = draw.many("faces", |_| "3, ".to_owned());
                let corners = "0, 1, 2, ".repeat(faces.len() / 3);
                let parts = draw.many("subsets", |number| {
                    format!("def GeomSubset \"s{number}\" {{\nint[] indices = [{number}]\nrel material:binding = </bot>\n}}\n")
                });
                inside += &format!(
                    "point3f[] points = [(0, 0, 0), (1, 0, 0), (0, 1, 0)]\nint[] faceVertexCounts = [{faces}]\nint[] faceVertexIndices = [{corners}]\n{parts}"
                );
                kind = "Mesh";
            }
            14 => {
                let words = draw.many("letters of a file", |_| "letter".to_owned());
                inside += &format!(
                    "asset file = @{words}@\ntoken mjc:gainType = \"{words}\"\nrel mjc:target = </bot/j>\n"
                );
            }
            _ => {
                let count = draw.dice.below(900);
                let paths: Vec<String> = (0..count).map(|number| format!("</c{number}>")).collect();
                draw.said.push(format!("{count} classes"));
                metadata += &format!("inherits = [{}]\n", paths.join(", "));
            }
        }
    }
    let classes: String = (0..900).map(|number| format!("class \"c{number}\" {{}}\n")).collect();
    let heirs = draw.many("heirs", |number| {
        format!("def {kind} \"p{number}\" (prepend apiSchemas = [\"x\"]\nreferences = </C>) {{}}\n")
    });
    let inner = draw.chance(2);
    let (before, after) = if inner { ("def Xform \"in\" {\n", "}\n") } else { ("", "") };
    let text = format!(
        "#usda 1.0\n(\nupAxis = \"Z\"\nmetersPerUnit = 1\n{top})\nclass \"C\" (\n{metadata}) {{\n{inside}}}\n{classes}\
        def Xform \"bot\" {{\ndef Cube \"b0\" (apiSchemas = [\"PhysicsRigidBodyAPI\", \"PhysicsCollisionAPI\"]) {{}}\n\
        def Cube \"b1\" (displayName = \"{body}\"\napiSchemas = [\"PhysicsRigidBodyAPI\"]) {{\n{before}{heirs}{after}}}\n\
        def PhysicsRevoluteJoint \"j\" {{\nrel physics:body0 = </bot/b0>\nrel physics:body1 = </bot/b1>\n}}\n}}\n"
    );
    draw.file("r.usda", text);
}

/// Peak of live bytes, and bytes of all allocations, while something is done.
fn counted(what: impl FnOnce()) -> (usize, usize) {
    let (live, all) = (LIVE.load(Relaxed), ALL.load(Relaxed));
    PEAK.store(live, Relaxed);
    MOST.store(ABORT, Relaxed);
    what();
    MOST.store(usize::MAX, Relaxed);
    (PEAK.load(Relaxed) - live, ALL.load(Relaxed) - all)
}

#[test]
fn whatever_multiplies_is_bounded() {
    let mut largest = [(0.0, String::new()), (0.0, String::new())];
    let first: u64 = std::env::var("URDD_FIRST").map_or(0, |first| first.parse().unwrap());
    for trial in first..first + u64::from(trials(FEW)) {
        let mut dice = Dice(trial << 20);
        let size = (16 << 10) << dice.below(4);
        let mut draw = Draw { dice, size, said: Vec::new(), files: BTreeMap::new() };
        let format = draw.one_of(&FORMATS);
        let file = match format {
            Format::Urdf => {
                urdf(&mut draw);
                "/r.urdf"
            }
            Format::Mjcf => {
                mjcf(&mut draw);
                "/r.xml"
            }
            Format::Sdf => {
                sdf(&mut draw);
                "/r.sdf"
            }
            Format::Usd => {
                usd(&mut draw);
                "/r.usda"
            }
        };
        let path = Path::new(file);
        let input: usize = draw.files.values().map(Vec::len).sum();
        let folder = tempfile::tempdir().unwrap();
        for (name, bytes) in &draw.files {
            std::fs::write(folder.path().join(name), bytes).unwrap();
        }
        let files = draw.files.into_iter().map(|(name, bytes)| (name, Arc::from(bytes)));
        let source = Settings { files: Files::in_memory(files).unwrap(), ..Settings::default() };
        let lints = LintSettings { source: source.clone(), ..LintSettings::default() };
        let lint = || {
            let (run, _) = lint_with_text(path, &[], None, &lints).unwrap();
            serde_json::to_string(&run.report).unwrap();
        };
        let make = || match format {
            Format::Urdf => {
                let selection = Selection::parse(["core"]).unwrap();
                let settings = urdd_generate::Settings {
                    source: source.clone(),
                    selection,
                    ..Default::default()
                };
                drop(generate_in_memory(path, &settings, &()));
            }
            _ => drop(import_whole(path, &source)),
        };
        let diff = || {
            let options = urdd_diff::Options { without_findings: true, ..Default::default() };
            if let Ok(side) = Side::open(&folder.path().join(&file[1..]), &options) {
                serde_json::to_string(&compare(&side, &side, 0.0).unwrap()).unwrap();
            }
        };
        let runs: [(&str, &dyn Fn()); 3] = [("lint", &lint), ("make", &make), ("diff", &diff)];
        for (what, run) in runs {
            let said =
                format!("{what} of {format:?} {trial}, {input} bytes: {}", draw.said.join(", "));
            NOW.lock().unwrap().clone_from(&said);
            let (peak, work) = counted(run);
            let of_import = if what == "make" || format == Format::Urdf { 1 } else { OF_IMPORT };
            let most = input * MULTIPLE as usize + ALLOWANCE as usize * of_import;
            assert!(peak <= most, "{peak} bytes at once: {said}");
            assert!(work <= input * WORK + LEAST_WORK, "{work} bytes in all: {said}");
            for (largest, bytes) in largest.iter_mut().zip([peak, work]) {
                let ratio = bytes as f64 / input as f64;
                if ratio > largest.0 {
                    *largest = (ratio, said.clone());
                }
            }
        }
    }
    for (what, (ratio, said)) in ["at once", "in all"].iter().zip(&largest) {
        println!("{ratio:.0} times the input {what}: {said}");
    }
}

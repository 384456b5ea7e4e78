//! What little USD may ask for: whatever any number of prims inherit, reference or list is charged for each of them, in memory
//! and in steps, and what is beyond the account is refused at a prim. Each of these took gigabytes or minutes.

use std::fmt::Write;
use std::path::Path;
use std::sync::Arc;

use urdd_directory::account::Overdrawn;
use urdd_directory::limits::ALLOWANCE;
use urdd_source::gate::Gate;
use urdd_source::{Files, ImportOptions, Settings};

use crate::place::TextFile;
use crate::usd;

/// A robot of two bodies and a hinge.
const ROBOT: &str = "def Xform \"bot\" {
    def Cube \"b0\" (apiSchemas = [\"PhysicsRigidBodyAPI\", \"PhysicsCollisionAPI\"]) {}
    def Cube \"b1\" (apiSchemas = [\"PhysicsRigidBodyAPI\", \"PhysicsCollisionAPI\"]) {}
    def PhysicsRevoluteJoint \"j\" {
        rel physics:body0 = </bot/b0>
        rel physics:body1 = </bot/b1>
    }
}
";

fn whole(text: &str) -> String {
    format!("#usda 1.0\n(\n    upAxis = \"Z\"\n    metersPerUnit = 1\n)\n{ROBOT}{text}\n")
}

/// What is left of an account, so that little is refused.
const LEFT: u64 = 8 << 20;

/// The error of files, of which the first is imported: its place and what it says; none if they are read.
fn error(files: &[(&str, &str)]) -> Option<(u32, String)> {
    let all = files.iter().map(|(name, of)| ((*name).to_owned(), Arc::from(of.as_bytes())));
    let files_in_memory = Files::in_memory(all).unwrap();
    let settings = Settings { files: files_in_memory, ..Settings::default() };
    let gate = Gate::of_project(Path::new("/"), &settings);
    let (name, text) = files[0];
    gate.account().deposit(text.len());
    gate.account().charge((ALLOWANCE - LEFT) as usize).unwrap();
    let path = Path::new("/").join(name);
    let file = TextFile::any(name.to_owned(), path, Arc::from(text.as_bytes()));
    let read = usd::read(file, &gate, &ImportOptions::default());
    read.err().map(|fault| (fault.line, fault.fault.to_string()))
}

fn each(count: usize, of: impl Fn(usize) -> String) -> String {
    (0..count).fold(String::new(), |mut all, at| {
        writeln!(all, "{}", of(at)).unwrap();
        all
    })
}

/// So many entries between commas.
fn list(count: usize, of: impl Fn(usize) -> String) -> String {
    (0..count).map(of).collect::<Vec<_>>().join(", ")
}

/// Prims that inherit `/C`, of a type.
fn heirs(kind: &str, count: usize, inside: &str) -> String {
    each(count, |at| format!("def {kind} \"p{at}\" (inherits = </C>) {{{inside}}}"))
}

/// A long thing, by its length, and how many prims have it: few are read, many are refused with the line of a prim.
type Product = (&'static str, Box<dyn Fn(usize) -> String>, usize);

fn products() -> Vec<Product> {
    let long = |length: usize| "x".repeat(length);
    let class =
        |metadata: String, inside: String| format!("class \"C\" ({metadata}) {{\n{inside}\n}}\n");
    let order = |count: usize| {
        let names = list(count, |_| "\"xformOp:translate\"".to_owned());
        format!("double3 xformOp:translate = (0, 0, 0)\nuniform token[] xformOpOrder = [{names}]")
    };
    let drives = "rel mjc:target = </bot/j>\n";
    let in_bot = |text: String| text.replace("def ", "    def ");
    vec![
        (
            "transforms",
            Box::new(move |n| class(String::new(), order(5000)) + &heirs("", n, "")),
            400,
        ),
        (
            "letters of a transform",
            Box::new(move |n| {
                let op = format!("xformOp:rotate{}", "X".repeat(100_000));
                let op =
                    format!("double3 {op} = (0, 0, 0)\nuniform token[] xformOpOrder = [\"{op}\"]");
                class(String::new(), op) + &heirs("", n, "")
            }),
            400,
        ),
        (
            "numbers of actuators",
            Box::new(move |n| {
                let numbers = list(5000, |_| "1".to_owned());
                let inside = format!("{drives}double[] mjc:gainPrm = [{numbers}]");
                class(String::new(), inside) + &heirs("MjcActuator", n, "")
            }),
            400,
        ),
        (
            "names of actuators",
            Box::new(move |n| {
                let name = format!("displayName = \"{}\"", long(100_000));
                class(name, drives.to_owned()) + &heirs("MjcActuator", n, "")
            }),
            400,
        ),
        (
            "names of bodies that nothing holds",
            Box::new(move |n| {
                let name = format!(
                    "displayName = \"{}\"\napiSchemas = [\"PhysicsRigidBodyAPI\"]",
                    long(100_000)
                );
                class(name, String::new()) + &heirs("", n, "")
            }),
            400,
        ),
        (
            "names of loops",
            Box::new(move |n| {
                let ends = "rel physics:body0 = </bot/b0>\nrel physics:body1 = </bot/b1>\nuniform bool physics:excludeFromArticulation = 1";
                let name = format!("displayName = \"{}\"", long(100_000));
                class(name, ends.to_owned()) + &heirs("PhysicsFixedJoint", n, "")
            }),
            400,
        ),
        (
            "names of meshes that are left out",
            Box::new(move |n| {
                let name = format!("displayName = \"{}\"", long(100_000));
                let meshes = in_bot(heirs("Mesh", n, ""));
                class(name, String::new())
                    + &format!(
                        "def \"more\" (apiSchemas = [\"PhysicsRigidBodyAPI\"]) {{\n{meshes}}}\n"
                    )
                    + "def PhysicsFixedJoint \"k\" {\nrel physics:body0 = </bot/b0>\nrel physics:body1 = </more>\n}\n"
            }),
            400,
        ),
        (
            "configurations",
            Box::new(move |n| {
                let each = each(500, |at| format!("dictionary c{at} = {{\ndouble none = 1\n}}"));
                let data = format!(
                    "customData = {{\ndictionary urdd = {{\ndictionary configurations = {{\n{each}}}\n}}\n}}"
                );
                class(data, String::new()) + &heirs("", n, "")
            }),
            400,
        ),
        (
            "dictionaries that are merged",
            Box::new(move |n| {
                let entries = each(5000, |at| format!("int e{at} = 1"));
                class(format!("customData = {{\n{entries}}}"), String::new())
                    + &each(n, |at| {
                        format!(
                            "def \"p{at}\" (inherits = </C>\ncustomData = {{\nint own = 1\n}}) {{}}"
                        )
                    })
            }),
            400,
        ),
        (
            "schemas",
            Box::new(move |n| {
                let names = list(5000, |at| format!("\"s{at}\""));
                class(format!("apiSchemas = [{names}]"), String::new())
                    + &each(n, |at| {
                        format!(
                            "def \"p{at}\" (inherits = </C>\nprepend apiSchemas = [\"one\"]) {{}}"
                        )
                    })
            }),
            400,
        ),
        (
            "targets",
            Box::new(move |n| {
                let paths = list(5000, |at| format!("</a{at}>"));
                class(String::new(), format!("rel r = [{paths}]")) + &heirs("", n, "")
            }),
            400,
        ),
        (
            "files",
            Box::new(move |n| {
                class(String::new(), format!("asset a = @{}@", long(100_000))) + &heirs("", n, "")
            }),
            400,
        ),
        (
            "fields",
            Box::new(move |n| {
                class(each(900, |at| format!("f{at} = 1")), String::new()) + &heirs("", n, "")
            }),
            1000,
        ),
        (
            "properties",
            Box::new(move |n| {
                class(String::new(), each(3000, |at| format!("int a{at}"))) + &heirs("", n, "")
            }),
            400,
        ),
        (
            "children",
            Box::new(move |n| {
                class(String::new(), each(1000, |at| format!("over \"a{at}\" {{}}")))
                    + &heirs("", n, "")
            }),
            400,
        ),
        (
            "variant sets",
            Box::new(move |n| {
                let chosen = each(60, |at| format!("string v{at} = \"a\""));
                let names = list(60, |at| format!("\"v{at}\""));
                let sets = each(60, |at| format!("variantSet \"v{at}\" = {{\n\"a\" {{}}\n}}"));
                class(format!("variants = {{\n{chosen}}}\nvariantSets = [{names}]"), sets)
                    + &heirs("", n, "")
            }),
            400,
        ),
        (
            "classes",
            Box::new(move |n| {
                each(300, |at| format!("class \"c{at}\" {{}}"))
                    + &class(
                        format!("inherits = [{}]", list(300, |at| format!("</c{at}>"))),
                        String::new(),
                    )
                    + &each(n, |at| format!("def \"p{at}\" (references = </C>) {{}}"))
            }),
            400,
        ),
        (
            "levels of a reference",
            Box::new(move |n| {
                let deep = "def \"a\" {\n".repeat(1000) + &"}\n".repeat(1000);
                format!(
                    "class \"D\" {{\n{deep}}}\nclass \"C\" (references = </D{}>) {{}}\n",
                    "/a".repeat(1000)
                ) + &heirs("", n, "")
            }),
            400,
        ),
        (
            "a path of a target",
            Box::new(move |n| {
                let path = "/a".repeat(50_000);
                class(String::new(), format!("rel physics:body0 = <{path}>"))
                    + &heirs("PhysicsFixedJoint", n, "")
            }),
            400,
        ),
        (
            "groups of shapes",
            Box::new(move |n| {
                each(n, |at| {
                    format!(
                        "def PhysicsCollisionGroup \"g{at}\" {{\nbool physics:invertFilteredGroups = 1\n}}"
                    )
                })
            }),
            1500,
        ),
    ]
}

#[test]
fn what_many_prims_have_is_charged_for_each() {
    let mut wrong = Vec::new();
    for (what, text, many) in products() {
        let few = error(&[("r.usda", &whole(&text(3)))]);
        let refused = error(&[("r.usda", &whole(&text(many)))]);
        let is_placed =
            |(line, fault): &(u32, String)| *line > 0 && fault.contains(&Overdrawn.to_string());
        if few.is_some() || !refused.as_ref().is_some_and(is_placed) {
            wrong.push((what, few, refused));
        }
    }
    assert!(wrong.is_empty(), "{wrong:#?}");
}

/// Ancestors that bring in ancestors: what each has is small, and there are two to the power of their number.
#[test]
fn references_through_ancestors() {
    let pair = |at: usize| {
        let next = at + 1;
        let of = |name: &str| {
            format!(
                "class \"{name}{at}\" (references = [</A{next}/x>, </B{next}/x>]) {{\ndef \"x\" {{}}\n}}\n"
            )
        };
        of("A") + &of("B")
    };
    let last = "class \"A40\" {\ndef \"x\" {}\n}\nclass \"B40\" {\ndef \"x\" {}\n}\n";
    let text = each(40, pair) + last + "def \"p\" (references = </A0/x>) {}\n";
    let (line, fault) = error(&[("r.usda", &whole(&text))]).unwrap();
    assert!(line > 0 && fault.contains(&Overdrawn.to_string()), "{line}: {fault}");
}

/// A layer counts at most twice in a stack, however often it is named, and says what it says once.
#[test]
fn a_layer_that_is_named_very_often() {
    let layer = "#usda 1.0\n".to_owned()
        + &each(3000, |at| format!("def Xform \"p{at}\" {{\nint x = 1\n}}"));
    let root = |count: usize| {
        let names = list(count, |_| "@b.usda@".to_owned());
        whole("").replacen("upAxis", &format!("subLayers = [{names}]\n    upAxis"), 1)
    };
    assert_eq!(error(&[("r.usda", &root(900)), ("b.usda", &layer)]), None);
    let (line, fault) = error(&[("r.usda", &root(1100)), ("b.usda", &layer)]).unwrap();
    assert!(line == 0 && fault.contains("more than 1000"), "{fault}");
}

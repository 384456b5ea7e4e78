//! What checks for self-collision do not see is said, with the share of samples that the closed form gives.

use std::fmt::Write;
use std::fs;
use std::path::Path;

use urdd_format::link_shapes_skips::{LinkShapesSkipsModule, SkippedReason};
use urdd_generate::note::NoteKind;
use urdd_generate::{GenerateError, Generated, ReferenceFault, Settings, generate};

/// Boxes of 0.2 m on the base and on slides along x, which reach from `lower` to `upper`: one touches the base where its
/// position is between -0.2 and 0.2 m. Links without shapes are between them, so that no joint connects the boxes. Slides
/// are 1 m apart along y.
fn slides(ranges: &[(f64, f64)], collision: bool) -> String {
    let element = if collision { "collision" } else { "visual" };
    let cube = |y: f64| {
        format!(
            "<{element}><origin xyz=\"0 {y} 0\"/><geometry><box size=\"0.2 0.2 0.2\"/></geometry></{element}>"
        )
    };
    let mut text = "<robot name=\"slides\"><link name=\"base\">".to_owned();
    (0..ranges.len()).for_each(|at| text += &cube(at as f64));
    text += "</link>";
    for (at, (lower, upper)) in ranges.iter().enumerate() {
        write!(
            text,
            "<link name=\"mid{at}\"/><joint name=\"f{at}\" type=\"fixed\"><parent link=\"base\"/><child link=\"mid{at}\"/></joint>
            <link name=\"box{at}\">{}</link><joint name=\"j{at}\" type=\"prismatic\"><origin xyz=\"0 {at} 0\"/><parent link=\"mid{at}\"/>
            <child link=\"box{at}\"/><axis xyz=\"1 0 0\"/><limit lower=\"{lower}\" upper=\"{upper}\" effort=\"1\" velocity=\"1\"/></joint>",
            cube(0.0)
        )
        .unwrap();
    }
    text + "</robot>"
}

/// u(k, i) of SPEC 9.3.
fn uniform(k: u64, i: u64) -> f64 {
    let mut z = ((k << 32) + i + 1).wrapping_mul(0x9E37_79B9_7F4A_7C15);
    z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
    ((z ^ (z >> 31)) >> 11) as f64 * 2f64.powi(-53)
}

/// The number of samples in which slide `i` is within 0.2 m of 0.
fn touching(i: u64, (lower, upper): (f64, f64), samples: u64) -> usize {
    let position = |k: u64| {
        let u = uniform(k, i);
        lower * (1.0 - u) + upper * u
    };
    (0..samples).filter(|k| position(*k).abs() <= 0.2).count()
}

fn make(folder: &Path, urdf: &str, settings: &Settings) -> Result<Generated, GenerateError> {
    let source = folder.join("slides.urdf");
    fs::write(&source, urdf).unwrap();
    generate(&source, &folder.join("urdd"), settings, &())
}

fn skips(folder: &Path) -> LinkShapesSkipsModule {
    let path = folder.join("urdd/link_shapes_modules/link_shapes_skips_module/module.json");
    serde_json::from_slice(&fs::read(path).unwrap()).unwrap()
}

fn notes(made: &Generated, kind: NoteKind) -> Vec<String> {
    let notes = made.notes.iter().filter(|note| note.kind == kind);
    notes.map(|note| note.problem.clone()).collect()
}

#[test]
fn the_samples_in_which_a_skipped_pair_touches_are_counted() {
    assert_eq!(uniform(2, 5), 0.9660916392335607, "SPEC 9.3");
    let folder = tempfile::tempdir().unwrap();
    let ranges = [(-0.5, 1.5), (-0.21, 0.25), (-0.15, 4.0), (1.0, 2.0)];
    let urdf = slides(&ranges, true);
    let settings = Settings { num_samples: 500, ..Settings::default() };
    let counts: Vec<usize> = (0..).zip(ranges).map(|(i, range)| touching(i, range, 500)).collect();
    // 20 %, 87 %, 8 % of the range; the last slide never touches.
    assert!(counts[1] > 400 && (70..130).contains(&counts[0]) && (20..60).contains(&counts[2]));
    assert_eq!(counts[3], 0);
    // The second run keeps all modules, and says the same.
    for _ in 0..2 {
        let made = make(folder.path(), &urdf, &settings).unwrap();
        let said = notes(&made, NoteKind::SkippedContact);
        let share = |at: usize| counts[at] as f64 / 5.0;
        let expected = format!(
            "3 pairs of links touch in the default configuration, so collision checks skip them; share of 500 sampled configurations in which they touch: `base` and `box1` {:.1} %, `base` and `box0` {:.1} %, `base` and `box2` {:.1} %",
            share(1),
            share(0),
            share(2)
        );
        assert_eq!(said, [expected]);
    }
}

#[test]
fn of_many_pairs_the_worst_are_named() {
    let folder = tempfile::tempdir().unwrap();
    let ranges: Vec<(f64, f64)> = (1..=12).map(|at| (-0.3, 0.3 * f64::from(at))).collect();
    let made = make(folder.path(), &slides(&ranges, true), &Settings::default()).unwrap();
    let said = notes(&made, NoteKind::SkippedContact);
    let [said] = &said[..] else { panic!("{said:#?}") };
    let most = touching(5, ranges[5], 1000) as f64 / 10.0;
    assert!(said.starts_with("12 pairs of links touch in the default configuration"), "{said}");
    let end = format!(
        "`base` and `box4` {:.1} %, 7 more at most {most:.1} % each",
        touching(4, ranges[4], 1000) as f64 / 10.0
    );
    assert!(said.ends_with(&end), "{said}");
}

/// Adds named configurations to the URDD: SPEC 6.7. Its YAML, hashes and list go: what a person writes is read all the same.
fn name_configurations(folder: &Path, all: &[(&str, f64)]) {
    let module = folder.join("urdd/named_configurations_module");
    fs::create_dir_all(&module).unwrap();
    let one = |(name, position): &(&str, f64)| {
        serde_json::json!({
            "name": name, "configuration": [position, 0.0],
            "positions": [{ "dof_name": "j0", "position": position }],
        })
    };
    let all: Vec<_> = all.iter().map(one).collect();
    let text = serde_json::json!({ "configurations": all }).to_string();
    fs::write(module.join("module.json"), text).unwrap();
    fs::write(module.join("VERSION"), "1.0.0\n").unwrap();
}

#[test]
fn a_named_configuration_is_the_reference() {
    let folder = tempfile::tempdir().unwrap();
    // The first touches at 0, the second does not where the reference has it: at its bound.
    let ranges = [(-0.5, 1.5), (-0.5, 1.5)];
    let urdf = slides(&ranges, true);
    let with = |reference: &str| Settings {
        reference: Some(reference.to_owned()),
        num_samples: 200,
        ..Settings::default()
    };
    let reference = |name: &str| make(folder.path(), &urdf, &with(name));
    let unknown = reference("home").unwrap_err();
    assert_eq!(unknown.code(), "reference");
    assert!(unknown.to_string().contains("it has none"), "{unknown}");

    let made = make(folder.path(), &urdf, &Settings::default()).unwrap();
    let [said] = &notes(&made, NoteKind::SkippedContact)[..] else { panic!("no note") };
    assert!(said.starts_with("2 pairs of links touch in the default configuration"), "{said}");
    name_configurations(folder.path(), &[("home", 1.0), ("beyond", 9.0)]);
    let unknown = reference("hme").unwrap_err();
    assert!(
        matches!(&unknown, GenerateError::Reference { fault: ReferenceFault::Unknown { known, .. }, .. } if known.len() == 2),
        "{unknown}"
    );
    let beyond = reference("beyond").unwrap_err();
    assert!(
        matches!(&beyond, GenerateError::Reference { fault: ReferenceFault::Position(_), .. }),
        "{beyond}"
    );

    // In `home`, box 0 is 0.8 m from the base and is checked; box 1 touches.
    let made = reference("home").unwrap();
    let count = touching(1, ranges[1], 200);
    assert_eq!(
        notes(&made, NoteKind::SkippedContact),
        [format!(
            "1 pair of links touches in the reference configuration `home`, so collision checks skip it; share of 200 sampled configurations in which it touches: `base` and `box1` {:.1} %",
            count as f64 / 2.0
        )]
    );
    let skips_now = skips(folder.path());
    assert!(!skips_now.skipped_reasons.contains(&SkippedReason::Default));
    let edits: Vec<_> = skips_now.edits.iter().map(|edit| (&*edit.link_a, &*edit.link_b)).collect();
    assert_eq!(edits, [("base", "box1")]);
    let at = |a: usize, b: usize| skips_now.full_convex_hulls_skips[a][b];
    assert_eq!((at(0, 1), at(0, 2)), (false, true));

    // A run that says nothing keeps it; `default` takes it back.
    make(folder.path(), &urdf, &Settings::default()).unwrap();
    assert_eq!(skips(folder.path()).edits.len(), 1);
    reference("default").unwrap();
    let back = skips(folder.path());
    assert!(back.edits.is_empty() && back.skipped_reasons.contains(&SkippedReason::Default));
}

#[test]
fn the_geometry_that_was_taken_is_said() {
    let folder = tempfile::tempdir().unwrap();
    let taken = |urdf: &str| {
        let made = make(folder.path(), urdf, &Settings::default()).unwrap();
        notes(&made, NoteKind::GeometryTaken)
    };
    assert!(taken(&slides(&[(0.0, 1.0)], true)).is_empty());
    assert_eq!(taken(&slides(&[(0.0, 1.0)], false)), ["no link has a collision element"]);
    let both = slides(&[(0.0, 1.0)], true).replacen(
        "<link name=\"box0\">",
        "<link name=\"box0\"><visual><geometry><sphere radius=\"0.1\"/></geometry></visual>",
        1,
    );
    assert_eq!(taken(&both), ["1 link (`box0`) has visual and collision elements"]);
    let bare = "<robot name=\"bare\"><link name=\"a\"/></robot>";
    assert!(taken(bare).is_empty());
    let bare = bare.replace(
        "</robot>",
        "<link name=\"b\"/><joint name=\"j\" type=\"fixed\"><parent link=\"a\"/><child link=\"b\"/></joint></robot>",
    );
    assert_eq!(taken(&bare), ["no link has a visual or collision element with a surface"]);
}

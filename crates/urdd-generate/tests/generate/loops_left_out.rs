//! Loops and couplings that say nothing or cannot be used, what moves freely, and how much work loops may take.

use std::fs;
use std::path::Path;

use urdd_format::loops::LoopsModule;
use urdd_generate::note::{Note, NoteKind};
use urdd_generate::{GenerateError, Generated, Selection, Settings, generate};

/// A chain of hinges `j1` to `jN` from `l0` to `lN`, 0.1 m apart; `more(k)` are attributes of joint k.
fn chain(hinges: usize, more: impl Fn(usize) -> &'static str, rest: &str) -> String {
    let mut urdf = "<robot name=\"p\">\n<link name=\"l0\"/>".to_owned();
    for k in 1..=hinges {
        let (parent, more) = (k - 1, more(k));
        urdf += &format!(
            "<link name=\"l{k}\"/><joint name=\"j{k}\" type=\"continuous\"{more}><parent link=\"l{parent}\"/><child link=\"l{k}\"/><origin xyz=\"0.1 0 0\"/><axis xyz=\"0 0 1\"/></joint>"
        );
    }
    format!("{urdf}\n{rest}</robot>")
}

/// Closes a four-bar of three hinges: its last link ends 0.12 m beside the base's frame.
const PIN: &str = r#"<loop name="pin" type="revolute"><predecessor link="l3"><origin xyz="0.1 0 0"/></predecessor><successor link="l0"><origin xyz="0.2 0.02 0"/></successor><axis xyz="0 0 1"/></loop>"#;

fn made(folder: &Path, urdf: &str) -> Result<Generated, GenerateError> {
    fs::write(folder.join("p.urdf"), urdf).unwrap();
    let selection = Selection::parse(["core"]).unwrap();
    let settings = Settings { selection, ..Settings::default() };
    generate(&folder.join("p.urdf"), &folder.join("urdd"), &settings, &())
}

fn module(folder: &Path) -> LoopsModule {
    let text = fs::read(folder.join("urdd/loops_module/module.json")).expect("the module");
    serde_json::from_slice(&text).unwrap()
}

fn note<'a>(generated: &'a Generated, words: &str) -> &'a Note {
    let found = generated.notes.iter().find(|note| note.problem.contains(words));
    found.unwrap_or_else(|| panic!("no note with {words}: {:?}", generated.notes))
}

fn free(module: &LoopsModule) -> Vec<usize> {
    module.independent_dof_idxs.iter().map(|idx| idx.get()).collect()
}

/// What a TOML beside three hinges, the third of which follows the first, makes.
fn coupled(toml: &str) -> (tempfile::TempDir, Result<Generated, GenerateError>) {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("p.loops.toml"), toml).unwrap();
    let urdf = chain(3, |_| "", "");
    let follows = "<mimic joint=\"j1\" multiplier=\"0.1\" offset=\"0.3\"/></joint>\n</robot>";
    let urdf = urdf.replace("</joint>\n</robot>", follows);
    let generated = made(folder.path(), &urdf);
    (folder, generated)
}

#[test]
fn couplings_that_cancel_are_left_out_with_a_note() {
    // j3 = 0.1 j1 + 0.3, three times: what is left is of rounding alone.
    let (folder, generated) = coupled(
        "[[coupling]]\nname = \"same\"\nconstant = 0.9\nterms = { j3 = [-3.0], j1 = [0.3] }\n[[coupling]]\nname = \"gear\"\nterms = { j1 = [1.0], j2 = [2.0] }\n",
    );
    let generated = generated.expect("a URDD");
    let of = note(&generated, "`same` adds nothing");
    assert_eq!(of.kind, NoteKind::LeftOut);
    assert_eq!(module(folder.path()).couplings.len(), 1);
    let (folder, generated) = coupled(
        "[[coupling]]\nname = \"other\"\nconstant = 0.5\nterms = { j3 = [-1.0], j1 = [0.1] }\n",
    );
    let generated = generated.expect("a URDD");
    assert!(note(&generated, "`other` contradicts").problem.contains("0.2 is left"));
    assert!(!folder.path().join("urdd/loops_module").exists());
}

#[test]
fn a_joint_that_is_said_to_be_independent_comes_before_those_that_say_nothing() {
    let folder = tempfile::tempdir().unwrap();
    for joint in 1..=3 {
        let said = |k: usize| if k == joint { " independent=\" TRUE\"" } else { "" };
        let generated = made(folder.path(), &chain(3, said, PIN)).expect("a URDD");
        assert_eq!(free(&module(folder.path())), [joint - 1]);
        assert!(generated.notes.iter().all(|note| note.kind != NoteKind::Otherwise));
        // And those that say false after.
        let said = |k: usize| if k == joint { "" } else { " independent=\"False \"" };
        made(folder.path(), &chain(3, said, PIN)).expect("a URDD");
        assert_eq!(free(&module(folder.path())), [joint - 1]);
    }
    let said = |k: usize| if k == 2 { " independent=\"maybe\"" } else { "" };
    let generated = made(folder.path(), &chain(3, said, PIN)).expect("a URDD");
    let of = note(&generated, "`independent=\"maybe\"` is neither true nor false");
    assert_eq!(of.line, 2);
}

#[test]
fn a_note_names_what_moves_freely_and_is_not_said_to() {
    let toml = |said: &str| {
        format!(
            "independent = {said}\n[[loop]]\nname = \"pin\"\nkind = \"rEvolute\"\nlink_a = \"l4\"\nframe_a = {{ xyz = [0.1, 0.0, 0.0] }}\nlink_b = \"l0\"\nframe_b = {{ xyz = [0.2, 0.1, 0.0] }}\n"
        )
    };
    let folder = tempfile::tempdir().unwrap();
    let fixed = "<link name=\"lf\"/><joint name=\"f\" type=\"fixed\"><parent link=\"l0\"/><child link=\"lf\"/></joint>";
    for (said, expected, words) in [
        ("[]", "`j1`, `j2` move freely", "move freely"),
        ("[\"f\"]", "`j1`, `j2` move freely", "`f` cannot move freely"),
        ("[\"j3\"]", "move freely, and are not said to", "not said to"),
        ("[\"j1\", \"j2\", \"j3\"]", "follow from others, and are said", "follow from others"),
    ] {
        fs::write(folder.path().join("p.loops.toml"), toml(said)).unwrap();
        let generated = made(folder.path(), &chain(4, |_| "", fixed)).expect("a URDD");
        note(&generated, words);
        let of = note(&generated, "other DOFs move freely than the source says");
        assert_eq!(of.kind, NoteKind::Otherwise);
        if said.starts_with("[]") || said.contains('f') {
            assert!(free(&module(folder.path())).contains(&0), "the one nearest to the root");
        } else {
            assert!(of.problem.contains(expected), "{}", of.problem);
        }
    }
    // Where they are as said, there is none.
    fs::write(folder.path().join("p.loops.toml"), toml("[\"j1\", \"j4\"]")).unwrap();
    let generated = made(folder.path(), &chain(4, |_| "", fixed)).expect("a URDD");
    assert!(generated.notes.iter().all(|note| note.kind != NoteKind::Otherwise));
}

#[test]
fn the_rank_of_a_square_that_is_0_is_that_of_its_reference() {
    let folder = tempfile::tempdir().unwrap();
    let toml = "[[coupling]]\nname = \"square\"\nterms = { j1 = [0.0, 1.0] }\n";
    fs::write(folder.path().join("p.loops.toml"), toml).unwrap();
    made(folder.path(), &chain(3, |_| "", "")).expect("a URDD");
    let module = module(folder.path());
    assert_eq!(module.reference_configuration[0], 0.0);
    assert_eq!(free(&module), [0, 1, 2]);
}

#[test]
fn large_loops_end_soon_with_a_note() {
    let folder = tempfile::tempdir().unwrap();
    let loops: String = (1..=19)
        .map(|k| format!("<loop name=\"o{k}\" type=\"spherical\"><predecessor link=\"l0\"/><successor link=\"l{}\"/></loop>", 100 * k))
        .collect();
    let generated = made(folder.path(), &chain(1900, |_| "", &loops)).expect("a URDD");
    let of = note(&generated, "the loops depend on too many joints at once");
    assert_eq!(of.kind, NoteKind::LeftOut);
    assert!(!folder.path().join("urdd/loops_module").exists());
}

#[test]
fn one_faulty_loop_of_urdf_plus_is_left_out_and_has_a_place() {
    let folder = tempfile::tempdir().unwrap();
    let other = PIN.replace("\"pin\"", "\"other\"");
    for (faulty, said) in [
        (other.replace("link=\"l3\"", "link=\"l33\""), "there is no link `l33`"),
        (other.replace("link=\"l3\"", "link=\"l0\""), "connects a link with itself"),
        (PIN.to_owned(), "another loop or coupling is called `pin`"),
        (other.replace("revolute", "helical"), "`helical` is no kind of loop"),
        (other.replace("0.1 0 0", "0.1 0"), "`xyz` is not three finite numbers"),
        (
            "<coupling name=\"other\"><predecessor link=\"nix\"/><successor link=\"l3\"/><ratio value=\"2\"/></coupling>".to_owned(),
            "there is no link `nix`",
        ),
    ] {
        let urdf = chain(3, |_| "", &format!("{PIN}\n  {faulty}\n"));
        let generated = made(folder.path(), &urdf).expect("a URDD");
        let of = note(&generated, said);
        assert_eq!((of.kind, of.line), (NoteKind::LeftOut, 4), "{of}");
        assert!(of.column >= 3 && of.assumed.contains("is left out"), "{of}");
        let module = module(folder.path());
        assert_eq!((module.loops.len(), module.couplings.len()), (1, 0), "{said}");
    }
}

#[test]
fn faults_of_a_toml_and_a_yaml_have_lines() {
    let one = "\n[[loop]]\nname = \"l\"\nkind = \"Revolute\"\nlink_a = \"l1\"\n";
    let coupling = |terms: &str| format!("\n[[coupling]]\nname = \"c\"\nterms = {terms}\n");
    let yaml = "robot: p\nclosed_loop: [[l1, l3],\n  [l3, l9]]\n";
    for (name, text, said) in [
        ("p.loops.toml", format!("{one}link_b = \"l1\"\n"), ":6:10: the loop `l` connects"),
        (
            "p.loops.toml",
            format!("{one}link_b = \"l3\"\nframe_a = {{ xyz = [nan, 0.0, 0.0] }}\n"),
            ":2:1: a number in `frame_a` of the loop `l` is not finite",
        ),
        (
            "p.loops.toml",
            format!("{one}link_b = \"l3\"\n").replace("Revolute", "helical"),
            ":4:8: `helical` is no kind of loop; there are fixed, revolute,",
        ),
        ("p.loops.toml", coupling("{}"), ":2:1: the coupling `c` says nothing of a DOF"),
        ("p.loops.toml", coupling("{ fix = [1.0] }"), ":2:1: the coupling `c` says nothing"),
        (
            "p.loops.toml",
            coupling("{ plane = [1.0] }"),
            ":4:11: the joint `plane` has several DOFs: name one of `plane/trans_x`",
        ),
        (
            "p.loops.toml",
            coupling("{ j1 = [1.0] }\nconstant = inf"),
            ":2:1: the constant of the coupling `c` is not finite",
        ),
        ("p.yaml", format!("{yaml}type: [3d, 6d]\n"), ":3:8: there is no link `l9`"),
        ("p.yaml", format!("{yaml}type: [3d, 5d]\n"), ":4:12: `5d` in `type` is neither"),
        ("p.yaml", format!("{yaml}type: [3d]\n"), ":4:1: `closed_loop` and `type` need as many"),
    ] {
        let folder = tempfile::tempdir().unwrap();
        fs::write(folder.path().join(name), &text).unwrap();
        let more = "<link name=\"lf\"/><joint name=\"fix\" type=\"fixed\"><parent link=\"l0\"/><child link=\"lf\"/></joint><link name=\"lp\"/><joint name=\"plane\" type=\"planar\"><parent link=\"l0\"/><child link=\"lp\"/></joint>";
        let error = made(folder.path(), &chain(3, |_| "", more)).expect_err("refused").to_string();
        assert!(error.contains(said), "{error}, not {said}");
    }
}

#[test]
fn couplings_that_do_not_hold_are_named() {
    let (_, generated) =
        coupled("[[coupling]]\nname = \"never\"\nconstant = 2.0\nterms = { j1 = [0.0, 1.0] }\n");
    let generated = generated.expect("a URDD");
    assert!(note(&generated, "no configuration was found").problem.contains("`never` stays 2"));
}

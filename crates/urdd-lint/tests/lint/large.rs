//! Inputs that are large in one respect.

use std::path::Path;
use std::time::{Duration, Instant};

use urdd_findings::check::Outcome;
use urdd_format::report::Place;
use urdd_lint::vocabulary::Names;
use urdd_lint::{LintSettings, lint_text};

/// Longest text of a report that is not quoted once, bytes.
const SHORT: usize = 2_000;
/// A name of a hundred times an ordinary one.
const LONG: usize = 20_000;
const MANY: usize = 300;

/// Every text of a place.
fn texts(place: &Place) -> Vec<&str> {
    let own = [&place.subject, &place.message, &place.expected, &place.actual, &place.pointer];
    let fixes = place.fixes.iter().flat_map(|fix| fix.edits.iter().map(|edit| edit.text.as_str()));
    let related = place.related.iter().flat_map(texts);
    own.into_iter().flatten().map(String::as_str).chain(fixes).chain(related).collect()
}

/// A long name, wherever a URDF has names, beside many elements that rules or programs find something in: only the few
/// places that are about the name itself have it whole.
#[test]
fn a_long_name_is_not_said_of_each_element() {
    let long = "x".repeat(LONG);
    let faulty = "<visual/><collision/><visual><geometry><sphere radius=\"-1\"/></geometry><material name=\"m\"/></visual>\
        <vsual/><visual nmae=\"a\" Name=\"b\"/><inertial><mass value=\"x\"/></inertial><visual><geometry>\
        <mesh filename=\"/m.stl\" scale=\"1 1\"/></geometry></visual><limit/>"
        .repeat(MANY);
    let limits =
        "<limit lower=\"1\" upper=\"0\"/><mimic joint=\"u\"/><axis xyz=\"0 0 0\"/>".repeat(MANY);
    let transmissions =
        "<transmission name=\"t\"><joint name=\"u\"/></transmission><gazebo reference=\"u\"/>"
            .repeat(MANY);
    let slots = ["ROBOT", "LINK", "JOINT", "MATERIAL", "TAG", "VALUE", "SPACE", "COLOUR", "FOLDER"];
    for slot in slots {
        let text = "<robot name=\"ROBOT\" xmlns:p=\"SPACE\"><link name=\"base\"/><link name=\"LINK\">FAULTY</link>\
            <joint name=\"JOINT\" type=\"revolute\"><parent link=\"base\"/><child link=\"LINK\"/>LIMITS</joint>\
            <material name=\"MATERIAL\"><color rgba=\"COLOUR\"/></material><mujoco><compiler meshdir=\"FOLDER\"/></mujoco>\
            <TAG a=\"VALUE\">FAULTY</TAG>TRANSMISSIONS</robot>";
        let mut text = text.replace(slot, &long);
        for (other, short) in
            slots.iter().zip(["r", "l", "j", "m", "tag", "v", "space", "1 0 0 1", "d"])
        {
            text = text.replace(other, short);
        }
        for (what, many) in
            [("FAULTY", &faulty), ("LIMITS", &limits), ("TRANSMISSIONS", &transmissions)]
        {
            text = text.replace(what, many);
        }
        let start = Instant::now();
        let examined = lint_text(&text, "r.urdf", Path::new("/"), &LintSettings::default());
        assert!(start.elapsed() < Duration::from_secs(60), "{slot}");
        let findings = examined.checks.iter().flat_map(|check| &check.findings);
        let places: Vec<&Place> = findings.clone().flat_map(|finding| finding.places()).collect();
        assert!(places.len() > MANY, "{slot}: {}", places.len());
        let of_places = places.iter().flat_map(|place| texts(place));
        let messages = findings.map(|finding| finding.message.as_str());
        let effects = examined.report.programs.iter().flat_map(|program| &program.effects);
        let effects = effects.flat_map(|effect| {
            let own = [effect.part.as_deref(), Some(&effect.reason), effect.makes.as_deref()];
            own.into_iter().flatten()
        });
        let long_ones = of_places.chain(messages).chain(effects).filter(|text| text.len() > SHORT);
        assert!(
            long_ones.clone().count() <= 10,
            "{slot}: {:?}",
            long_ones.map(|text| &text[..50]).collect::<Vec<_>>()
        );
    }
}

#[test]
fn very_many_names_that_are_not_there_have_no_hint() {
    let names: Vec<String> =
        (0..20_000).map(|number| format!("a_link_of_a_robot_{number}")).collect();
    let known = Names::new(names.iter().map(String::as_str));
    assert_eq!(known.hint("a_link_of_a_robt_7"), ", but there is `a_link_of_a_robot_7`");
    let hints = (0..10_000).map(|_| known.hint("a_link_of_a_robt_7"));
    assert!((2..20).contains(&hints.filter(|hint| !hint.is_empty()).count()));
}

#[test]
fn very_many_comments_and_misspelt_names_take_a_moment() {
    let comments = "<!-- urdd: allow LNT001 x -->".repeat(20_000);
    let misspelt = "<visual naem=\"1\"/>".repeat(10_000);
    let text = format!("<robot name=\"r\">{comments}<link name=\"l\">{misspelt}</link></robot>");
    let start = Instant::now();
    lint_text(&text, "r.urdf", Path::new("/"), &LintSettings::default());
    assert!(start.elapsed() < Duration::from_secs(60));
}

/// A mesh by many scales names its files once, and has its lengths once.
#[test]
fn a_mesh_of_many_scales_is_looked_at_once() {
    let folder = tempfile::tempdir().unwrap();
    let names: String = (0..200).map(|at| format!("newmtl m{at}\nmap_Kd t{at}.png\n")).collect();
    std::fs::write(folder.path().join("m.mtl"), names).unwrap();
    let mesh = "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nusemtl m0\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";
    std::fs::write(folder.path().join("m.obj"), mesh).unwrap();
    let missing = |scales: usize| {
        let visual = |at| {
            format!(
                "<visual><geometry><mesh filename=\"m.obj\" scale=\"1 1 1.{at}\"/></geometry></visual>"
            )
        };
        let visuals: String = (0..scales).map(visual).collect();
        let text = format!("<robot name=\"r\"><link name=\"a\">{visuals}</link></robot>");
        let examined = lint_text(&text, "r.urdf", folder.path(), &LintSettings::default());
        let check = examined.checks.iter().find(|check| check.rule.code.as_str() == "LNT030");
        check.unwrap().findings.iter().map(|finding| finding.count).sum::<usize>()
    };
    let once = missing(1);
    assert!(once > 0);
    assert_eq!(missing(40), once);
}

/// Couplings of a long chain cost more than the file allows: what closes the robot is not examined, and no rule crashes.
#[test]
fn couplings_of_a_long_chain_are_not_examined() {
    let (links, couplings) = (1500, 4000);
    let chain: String = (1..links)
        .map(|at| format!("<link name='l{at}'/><joint name='jointname{at}' type='revolute'><parent link='l{}'/><child link='l{at}'/><axis xyz='0 0 1'/><limit lower='-1' upper='1' effort='1' velocity='1'/></joint>", at - 1))
        .collect();
    let ends = format!("<predecessor link='l0'/><successor link='l{}'/>", links - 1);
    let all: String = (0..couplings)
        .map(|at| format!("<coupling name='c{at}'>{ends}<ratio value='1'/></coupling>"))
        .collect();
    let text = format!("<robot name='r'><link name='l0'/>{chain}{all}</robot>");
    let folder = tempfile::tempdir().unwrap();
    let examined = lint_text(&text, "r.urdf", folder.path(), &LintSettings::default());
    assert!(examined.checks.iter().all(|check| !matches!(check.outcome, Outcome::Crashed(_))));
    let check = examined.checks.iter().find(|check| check.rule.code.as_str() == "LNT066");
    let Outcome::Skipped(why) = &check.unwrap().outcome else { panic!("it was examined") };
    assert!(why.to_string().contains("memory or work"), "{why}");
}

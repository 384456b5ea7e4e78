//! `link_shapes_spheres_module`: made on request, and what a person gave to it is kept.

use std::fs;
use std::path::Path;

use serde_json::{Value, json};
use urdd_format::link_shapes_spheres::{LinkShapesSpheresModule, SphereOrigin};
use urdd_generate::note::NoteKind;
use urdd_generate::{GenerateError, Generated, Selection, Settings, generate};

/// A post, and an arm that swings through a block on it.
const ROBOT: &str = r#"<robot name="swing">
<link name="post"><collision><origin xyz="0 0 0.1"/><geometry><box size="0.1 0.1 0.2"/></geometry></collision></link>
<link name="block"><collision><geometry><box size="0.1 0.1 0.1"/></geometry></collision></link>
<link name="arm"><collision><origin xyz="0.25 0 0"/><geometry><box size="0.5 0.04 0.04"/></geometry></collision></link>
<link name="frame"/>
<joint name="of_block" type="fixed"><parent link="post"/><child link="block"/><origin xyz="0.3 0 0.1"/></joint>
<joint name="of_arm" type="revolute"><parent link="post"/><child link="arm"/><origin xyz="0 0 0.4"/><axis xyz="0 1 0"/>
<limit lower="-2" upper="2" effort="1" velocity="1"/></joint>
<joint name="of_frame" type="fixed"><parent link="arm"/><child link="frame"/></joint>
</robot>"#;

const MODULE: &str = "urdd/link_shapes_modules/link_shapes_spheres_module";

fn made(folder: &Path, modules: &[&str], drop_edits: bool) -> Result<Generated, GenerateError> {
    fs::write(folder.join("swing.urdf"), ROBOT).unwrap();
    let selection = Selection::parse(modules.iter().copied()).unwrap();
    let settings = Settings { selection, drop_edits, num_samples: 50, ..Settings::default() };
    generate(&folder.join("swing.urdf"), &folder.join("urdd"), &settings, &())
}

fn document(folder: &Path) -> Value {
    serde_json::from_slice(&fs::read(folder.join(MODULE).join("module.json")).unwrap()).unwrap()
}

#[test]
fn spheres_are_made_on_request_and_kept_while_nothing_changes() {
    let folder = tempfile::tempdir().unwrap();
    made(folder.path(), &["all"], false).unwrap();
    assert!(!folder.path().join(MODULE).exists());
    let version = |folder: &Path| -> Value {
        let metadata = fs::read(folder.join("urdd/urdd.json")).unwrap();
        serde_json::from_slice::<Value>(&metadata).unwrap()["urdd_version"].clone()
    };
    assert_eq!(version(folder.path()), "1.0.0");
    made(folder.path(), &["all", "spheres"], false).unwrap();
    assert_eq!(version(folder.path()), "1.1.0");
    let module: LinkShapesSpheresModule = serde_json::from_value(document(folder.path())).unwrap();
    let [one, few, many, fitted] = &module.levels[..] else { panic!("four levels") };
    assert!(one.covers && few.covers && many.covers && !fitted.covers);
    assert_eq!(fitted.origin, SphereOrigin::Computed);
    let counts = |level: usize| -> Vec<usize> {
        module.levels[level].spheres.iter().map(Vec::len).collect()
    };
    // Links in the order of the URDF; the last has no shape.
    assert_eq!(
        [counts(0), counts(1), counts(2)],
        [[1, 1, 1, 0], [4, 4, 4, 0], [16, 16, 16, 0]].map(Vec::from)
    );
    // The arm reaches the block from 0.3 m above it: some configurations collide, and the spheres find nearly all.
    let of = &fitted.evaluation;
    assert!(of.num_colliding.0 > 200 && of.num_free.0 > 5000);
    assert!(of.num_missed.0 * 100 <= of.num_colliding.0, "{of:?}");
    assert!(of.num_false_contacts.0 * 20 <= of.num_free.0, "{of:?}");
    for level in [one, few, many] {
        assert_eq!(level.evaluation.num_missed.0, 0);
        assert_eq!(level.evaluation.num_colliding, of.num_colliding);
    }
    let kept = made(folder.path(), &["all", "spheres"], false).unwrap();
    assert!(
        !kept.changed
            && kept.modules.iter().any(|of| of.kept && of.kind.name().contains("spheres"))
    );
}

#[test]
fn what_a_person_gave_is_kept_or_refused_and_never_lost_in_silence() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    made(folder, &["all", "spheres"], false).unwrap();
    // As an import leaves it: the last level is given.
    let mut document = document(folder);
    let last = &mut document["levels"][3];
    last["origin"] = json!("Given");
    let own = json!([{ "radius": 0.03, "offset_xyz": [0.1, 0.0, 0.0], "outer_sphere_idx": 0 }]);
    last["spheres"] = json!([[], [], own, []]);
    fs::write(folder.join(MODULE).join("module.json"), document.to_string()).unwrap();
    fs::remove_file(folder.join(MODULE).join("module.yaml")).unwrap();
    let refused = made(folder, &["all"], false).unwrap_err().to_string();
    assert!(
        refused.contains("1 given sphere") && refused.contains("`link_shapes_spheres`"),
        "{refused}"
    );
    made(folder, &["all", "spheres"], false).unwrap();
    let module: LinkShapesSpheresModule = serde_json::from_value(self::document(folder)).unwrap();
    let given = &module.levels[3];
    assert_eq!(given.origin, SphereOrigin::Given);
    let own: Vec<_> = given.spheres.iter().flatten().map(|of| (of.radius, of.offset_xyz)).collect();
    assert_eq!(own, [(0.03, [0.1, 0.0, 0.0])]);
    // Of an arm of 0.5 m, one ball covers little.
    let fit = given.fits[2].as_ref().unwrap();
    assert!(fit.uncovered_fraction > 0.8 && fit.max_uncovered > 0.36, "{fit:?}");
    made(folder, &["all"], true).unwrap();
    assert!(!folder.join(MODULE).exists());
}

#[test]
fn a_robot_without_shapes_has_a_note_in_its_place() {
    let folder = tempfile::tempdir().unwrap();
    let urdf = folder.path().join("r.urdf");
    fs::write(&urdf, "<robot name=\"r\"><link name=\"a\"/></robot>").unwrap();
    let settings =
        Settings { selection: Selection::parse(["spheres"]).unwrap(), ..Settings::default() };
    let made = generate(&urdf, &folder.path().join("urdd"), &settings, &()).unwrap();
    assert!(!folder.path().join(MODULE).exists());
    let of_no_use: Vec<_> =
        made.notes.iter().filter(|note| note.kind == NoteKind::OfNoUse).collect();
    assert_eq!(of_no_use.len(), 1);
}

//! Nothing is dropped in silence.

use super::{fixture, given, inside};
use crate::features::{self, Feature};
use crate::model::Model;
use crate::tests::Entries as _;

fn counts(model: &Model, wanted: &[(Feature, usize)]) {
    for (feature, count) in wanted {
        assert_eq!(model.tally.number_of(*feature), *count, "{}", feature.name);
    }
}

#[test]
fn what_is_lost_is_counted() {
    let shapes = fixture("shapes.sdf");
    counts(
        &shapes,
        &[
            (features::MISSING_MESHES, 1),
            (features::SURFACES, 1),
            (features::CONTACTS, 1),
            (features::FRICTION, 3),
            (features::LIGHTING, 1),
            (features::SETTINGS, 1),
            (features::KEPT, 5),
        ],
    );
    let graph = fixture("graph.sdf");
    let expected = [(features::CLOSED, 1), (features::TURNED, 1), (features::DETACHED, 1)];
    counts(&graph, &expected);
    assert_eq!(graph.closings.len(), 1);
    assert_eq!(graph.closings[0].name.as_deref(), Some("closing"));
    let joints = fixture("joints.sdf");
    counts(&joints, &[(features::GEARBOXES, 1), (features::SCREWS, 1), (features::ONE_SIDED, 1)]);
    let frames = fixture("frames.sdf");
    counts(
        &frames,
        &[(features::FRAMES, 3), (features::IN_WORLD, 1), (features::DEFAULT_MASSES, 2)],
    );
}

#[test]
fn what_is_not_known_is_named() {
    let text = "<link name='a'><inertial><fluid_added_mass/></inertial><wings/></link><tail/>";
    let model = inside("1.9", text).expect("a model");
    let unread: Vec<&str> = model.tally.all_unread().keys().map(String::as_str).collect();
    let wanted =
        ["`<fluid_added_mass>` of `<inertial>`", "`<tail>` of `<model>`", "`<wings>` of `<link>`"];
    assert_eq!(unread, wanted);
}

#[test]
fn text_for_gazebo_is_kept() {
    let model = fixture("shapes.sdf");
    assert!(model.elements.iter().any(|element| {
        element.0.starts_with("<gazebo>\n  <plugin name=\"p\"") && element.0.contains("a &amp; b")
    }));
    let of_link = model.elements.iter().filter(|it| it.0.starts_with("<gazebo reference=\"a\">"));
    assert_eq!(of_link.count(), 3);
}

#[test]
fn a_world_has_its_only_robot() {
    let world = |rest: &str| {
        let text = format!(
            "<sdf version='1.9'><world name='w'><gravity>0 0 -9</gravity><model name='arm'><pose>1 0 0 0 0 0</pose>\
             <link name='a'/></model><include><uri>model://ground_plane</uri></include>{rest}</world></sdf>"
        );
        given(&text, &[])
    };
    let model = world("<model name='table'><static>true</static><link name='b'/></model>");
    let model = model.expect("a model");
    assert_eq!((&*model.name, model.bodies.len()), ("arm", 1));
    counts(&model, &[(features::IN_WORLD, 1), (features::SETTINGS, 1)]);
    let two = world("<model name='other'><link name='b'/></model>").expect_err("two robots");
    let said = two.fault.to_string();
    assert!(said.contains("`arm`, `ground_plane`, `other`") && said.contains("--model"), "{said}");
}

#[test]
fn texts_that_gazebo_reads_are_read() {
    let text = "\n<?xml version='1.0'?><sdf version='1.7'><model name='m'><link name='a'><gz:mark/>\
        <ignition::corrected_offsets>1</ignition::corrected_offsets>\
        <visual name='v'><geometry><sphere><radius>0</radius></sphere></geometry></visual><odd/></link></model></sdf>";
    let model = given(text, &[]).expect("a model");
    assert!(model.bodies[0].shapes.is_empty());
    let unread: Vec<&str> = model.tally.all_unread().keys().map(String::as_str).collect();
    let wanted = [
        "`<gz:mark>` of `<link>`",
        "`<ignition__corrected_offsets>` of `<link>`",
        "`<odd>` of `<link>`",
        "shapes without a volume",
    ];
    assert_eq!(unread, wanted);
    // Places are those of the text as it was.
    let offset = model.tally.remarks[0].place.offset;
    assert!(text[offset..].starts_with("<visual"), "{}", &text[offset..]);
}

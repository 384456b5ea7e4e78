//! Which shapes of an MJCF are visuals: those that MuJoCo's viewer shows from the start.

use std::path::Path;

use super::mjcf::of_text;
use crate::features::{ONLY_COLLIDING, UNSEEN};
use crate::model::{Model, Use};
use crate::tests::Entries as _;

fn read(geoms: &str) -> Model {
    let text = format!(
        r#"<mujoco><asset><material name="glass" rgba="1 1 1 0"/></asset><worldbody><body name="b"><joint/>
        {geoms}</body></worldbody></mujoco>"#
    );
    of_text(Path::new("/nowhere/m.xml"), text, None).unwrap()
}

/// What each shape is for, in order.
fn used(geoms: &str) -> Vec<Use> {
    read(geoms).bodies[1].shapes.iter().map(|shape| shape.used).collect()
}

const TUBE: &str = r#"type="capsule" fromto="0 0 0 0 0 0.5" size="0.05""#;
const BADGE: &str =
    r#"type="box" pos="0.05 0 0.25" size="0.005 0.01 0.01" contype="0" conaffinity="0""#;
const COVER: &str =
    r#"type="capsule" fromto="0 0 0 0 0 0.52" size="0.06" contype="0" conaffinity="0""#;

#[test]
fn a_shape_that_only_is_seen_does_not_hide_those_that_collide() {
    // In one group, and in two: a badge is not the look of the tube.
    for group in ["0", "1", "2"] {
        let geoms = format!(r#"<geom {TUBE}/><geom {BADGE} group="{group}"/>"#);
        assert_eq!(used(&geoms), [Use::Both, Use::Visual], "{group}");
    }
    // A cover in the same group, too, is shown beside it.
    assert_eq!(used(&format!("<geom {TUBE}/><geom {COVER}/>")), [Use::Both, Use::Visual]);
}

#[test]
fn groups_from_3_on_are_hidden() {
    let geoms =
        format!(r#"<geom {TUBE} group="3"/><geom {BADGE} group="2"/><geom {BADGE} group="4"/>"#);
    let model = read(&geoms);
    let used: Vec<Use> = model.bodies[1].shapes.iter().map(|shape| shape.used).collect();
    assert_eq!(used, [Use::Collision, Use::Visual]);
    assert_eq!([ONLY_COLLIDING, UNSEEN].map(|of| model.tally.number_of(of)), [1, 1]);
    // Without any that is shown, nothing would be seen of the robot.
    assert_eq!(self::used(&format!(r#"<geom {TUBE} group="3"/>"#)), [Use::Both]);
}

#[test]
fn shapes_that_collide_in_a_group_of_their_own_have_a_look() {
    let geoms = format!(r#"<geom {TUBE} group="0"/><geom {COVER} group="1"/>"#);
    let model = read(&geoms);
    assert_eq!(model.tally.number_of(ONLY_COLLIDING), 1);
    let used: Vec<Use> = model.bodies[1].shapes.iter().map(|shape| shape.used).collect();
    assert_eq!(used, [Use::Collision, Use::Visual]);
    // Elsewhere in the robot, their group is that of a look.
    let geoms = format!(
        r#"<geom {TUBE} group="0"/><geom {COVER} group="1"/><body><joint/><geom {BADGE} group="0"/><geom size="0.1"/></body>"#
    );
    assert_eq!(self::used(&geoms)[0], Use::Both);
}

#[test]
fn what_is_transparent_is_not_seen() {
    let geoms = format!(
        r#"<geom {TUBE} material="glass"/><geom {BADGE} rgba="1 0 0 0"/><geom size="0.1"/>"#
    );
    assert_eq!(used(&geoms), [Use::Collision, Use::Both]);
}

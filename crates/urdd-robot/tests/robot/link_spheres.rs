//! The spheres of a URDD, as programs use them: covering levels never call a collision free.

use serde_json::{Value, json};
use testkit::robots::made_bars;
use urdd_robot::spheres::{ApproximateAnswer, CoveringAnswer};
use urdd_robot::{Queries, Robot, RobotError, ShapeKind};

const MODULE: &str = "link_shapes_modules/link_shapes_spheres_module/module.json";

#[test]
fn what_covering_spheres_call_free_is_free_and_fitted_ones_are_as_good_as_they_say() {
    let folder = tempfile::tempdir().expect("a folder");
    let robot = Robot::open(made_bars(folder.path(), &["all", "spheres"])).expect("a robot");
    let pieces = robot.proximity(ShapeKind::Pieces).expect("pieces");
    let (covering, fitted) = (robot.covering_checker(), robot.approximating_checker());
    let (covering, fitted) = (covering.expect("a checker"), fitted.expect("a checker"));
    let space = robot.configurations().expect("configurations");
    let [mut colliding, mut free, mut maybe, mut wrong] = [0; 4];
    for k in 0..3000 {
        let q = space.random(k);
        let collides = pieces.in_collision(&q).expect("an answer");
        let certain = covering.in_collision(&q).expect("an answer");
        if collides {
            colliding += 1;
            assert_eq!(certain, CoveringAnswer::Maybe, "{q:?}");
        } else {
            free += 1;
            maybe += u32::from(certain == CoveringAnswer::Maybe);
        }
        let answer = fitted.in_collision(&q).expect("an answer");
        wrong += u32::from((answer == ApproximateAnswer::Contact) != collides);
    }
    assert!(colliding > 100 && free > 1000, "{colliding} {free}");
    // The covering level is of use, and the fitted one is good.
    assert!(maybe * 2 < free, "{maybe} of {free}");
    assert!(wrong < 100, "{wrong}");
}

#[test]
fn without_spheres_or_with_those_of_another_robot_there_is_no_checker() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = made_bars(folder.path(), &["all"]);
    let robot = Robot::open(&path).expect("a robot");
    assert!(robot.spheres_module().expect("readable").is_none());
    assert!(matches!(robot.covering_checker(), Err(RobotError::Missing(_))));
    made_bars(folder.path(), &["all", "spheres"]);
    let text = std::fs::read(path.join(MODULE)).expect("a module");
    let good: Value = serde_json::from_slice(&text).expect("JSON");
    let bad = |change: &dyn Fn(&mut Value)| {
        let mut document = good.clone();
        change(&mut document);
        std::fs::write(path.join(MODULE), document.to_string()).expect("a file");
        Robot::open(&path).expect("a robot").covering_checker().map(|_| ())
    };
    assert_eq!(bad(&|_| ()), Ok(()));
    let unusable = |found: Result<(), RobotError>| {
        assert!(matches!(found, Err(RobotError::Unusable { .. })), "{found:?}");
    };
    unusable(bad(&|of| of["levels"][2]["spheres"] = json!([])));
    unusable(bad(&|of| of["levels"][1]["spheres"][0][0]["radius"] = json!(-1.0)));
    unusable(bad(&|of| {
        of["levels"][3]["ignored_pairs"] = json!([{ "link_a_idx": 0, "link_b_idx": 7 }]);
    }));
    // A level that is inside of itself: it is used alone.
    assert_eq!(bad(&|of| of["levels"][2]["outer_level_idx"] = json!(2)), Ok(()));
    let none = bad(&|of| of["levels"].as_array_mut().expect("levels").drain(..3).for_each(drop));
    assert!(matches!(none, Err(RobotError::Missing(_))), "{none:?}");
}

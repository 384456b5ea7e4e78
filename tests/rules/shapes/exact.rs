//! SHP008, SHP011 and SHP012: distances that are exactly those of SPEC 8.6, or agree with them.

use serde_json::json;
use urdd_validate::code::Code::{self, *};

use super::{SIMPLE, SKIPS, STATISTICS, set_pair, sliding};
use crate::meshes::{boxy, robot_of};
use crate::{Case, changed};
use testkit::fixture::Fixture;
use testkit::robot::origin;

const MILLIMETRE: f64 = 0.001;
/// Less and more, by half of what agrees (5.6).
const LESS: f64 = MILLIMETRE * (1.0 - 5e-10);
const MORE: f64 = MILLIMETRE * (1.0 + 5e-10);

/// What is stated of two boxes: whether they are skipped, and why.
#[derive(Clone, Copy)]
struct Said {
    code: Code,
    name: &'static str,
    caught: bool,
    distance: f64,
    skip: bool,
    reason: &'static str,
}

fn said(
    (code, name, caught): (Code, &'static str, bool),
    distance: f64,
    skip: bool,
    reason: &'static str,
) -> Said {
    Said { code, name, caught, distance, skip, reason }
}

/// Two boxes that stay so far apart.
fn apart(x: f64) -> Fixture {
    let mut robot = robot_of(vec![boxy("a"), boxy("b")]);
    robot.urdf.joints[0].origin = origin([x, 0.0, 0.0], [0.0; 3]);
    Fixture::full_with_edits(&robot, Vec::new())
}

/// States these of the three distances.
fn state(f: &mut Fixture, keys: &[&str], said: Said) {
    let pair = (0, 1);
    for key in keys {
        set_pair(f, STATISTICS, &format!("/full_obbs/{key}_distances"), pair, json!(said.distance));
    }
    set_pair(f, SIMPLE, "/full_obbs_simple_skips", pair, json!(said.skip));
    set_pair(f, SIMPLE, "/reasons/full_obbs", pair, json!(said.reason));
    let skipped = matches!(said.reason, "Always" | "Adjacent" | "Default");
    set_pair(f, SKIPS, "/full_obbs_skips", pair, json!(skipped));
}

pub fn cases() -> Vec<Case> {
    let largest = [
        said((SHP011, "a-millimetre", false), MILLIMETRE, true, "Always"),
        said((SHP011, "a-millimetre-not-skipped", true), MILLIMETRE, false, "Always"),
        said((SHP012, "adjacent-at-a-millimetre", true), MILLIMETRE, true, "Adjacent"),
        said((SHP012, "adjacent-at-hardly-less-than-a-millimetre", false), LESS, true, "Adjacent"),
        said((SHP012, "always-at-hardly-more-than-a-millimetre", false), MORE, true, "Always"),
        said((SHP011, "skipped-at-hardly-more-than-a-millimetre", false), MORE, true, "Adjacent"),
    ];
    let smallest = [
        said((SHP012, "smallest-of-a-millimetre", false), MILLIMETRE, false, "None"),
        said((SHP012, "never-at-a-millimetre", true), MILLIMETRE, false, "Never"),
        said((SHP012, "none-at-hardly-more-than-a-millimetre", false), MORE, false, "None"),
        said((SHP012, "never-at-hardly-less-than-a-millimetre", false), LESS, false, "Never"),
    ];
    let mut cases: Vec<Case> = Vec::new();
    for said in largest {
        let Said { code, name, caught, .. } = said;
        let all = move |f: &mut Fixture| state(f, &["mean", "min", "max"], said);
        cases.push(changed(code, name, caught, || apart(0.101), all));
    }
    for said in smallest {
        let Said { code, name, caught, .. } = said;
        let base = || sliding(0.101, 0.0, 2e-5);
        cases.push(changed(code, name, caught, base, move |f| state(f, &["min"], said)));
    }
    // In contact in all configurations: a mean above the maximum by the rounding of a sum, beside a minimum of 0.
    cases.push(changed(
        SHP008,
        "mean-above-all-by-rounding",
        false,
        || apart(0.0),
        |f| {
            for (key, distance) in [("max", 1e-9), ("mean", f64::from_bits(1e-9_f64.to_bits() + 2))]
            {
                let matrix = format!("/full_obbs/{key}_distances");
                set_pair(f, STATISTICS, &matrix, (0, 1), json!(distance));
            }
        },
    ));
    cases
}

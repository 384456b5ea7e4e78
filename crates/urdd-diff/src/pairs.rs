//! Pairs of links that checks for self-collision gain or lose, and where the links are, relative to the root link, with all
//! joints at zero.

use std::collections::{BTreeMap, BTreeSet, HashMap};

use nalgebra::{Matrix3, Vector3};
use urdd_directory::account::AccountError;
use urdd_document::tree::Tree;
use urdd_format::diff_report::{PairChange, PairDifference, PoseDifference};
use urdd_robot::{Robot, ShapeKind};

use crate::side::Side;

/// What is checked of a pair of links with one kind of shapes.
#[derive(Debug, Default, PartialEq)]
struct Checked {
    pieces: BTreeSet<(usize, usize)>,
    all: usize,
}

/// What is checked of each pair of links. Links are named by their indices in the first robot, the smaller one first.
type Pairs = BTreeMap<(usize, usize), Checked>;

/// The pairs that differ, among links that both robots have; `None` where one robot has no skips. What could not be
/// compared is added to `notes`.
pub fn differences(
    before: &Side,
    after: &Side,
    notes: &mut Vec<String>,
) -> Option<Vec<PairDifference>> {
    let (a, b) = match (open(before), open(after)) {
        (Ok(a), Ok(b)) => (a, b),
        // Two URDFs have none, which is no news.
        _ if before.urdd.is_none() && after.urdd.is_none() => return None,
        (a, b) => {
            let missing = [("A", a.err()), ("B", b.err())].into_iter();
            let missing = missing.filter_map(|(side, why)| Some(format!("{side} {}", why?)));
            let missing: Vec<String> = missing.collect();
            notes.push(format!("skipped pairs are not compared: {}", missing.join(", ")));
            return None;
        }
    };
    let names = before.link_names();
    let mut index: HashMap<&str, usize> = HashMap::new();
    for (link, name) in names.iter().enumerate() {
        index.entry(name).or_insert(link);
    }
    let of = |side: &Side| -> Vec<Option<usize>> {
        side.link_names().into_iter().map(|name| index.get(name).copied()).collect()
    };
    let (of_before, of_after) = (of(before), of(after));
    let mut both = vec![false; names.len()];
    for link in of_after.iter().flatten() {
        both[*link] = true;
    }
    let nothing = Checked::default();
    let mut found: BTreeMap<((usize, usize), PairChange), Vec<String>> = BTreeMap::new();
    for kind in ShapeKind::ALL {
        let (Some(x), Some(y)) = (checked(&a, kind, &of_before), checked(&b, kind, &of_after))
        else {
            let name = kind.name();
            notes.push(format!("skipped pairs of {name} are not compared: one URDD has none"));
            continue;
        };
        let pairs: BTreeSet<(usize, usize)> = x.keys().chain(y.keys()).copied().collect();
        for pair in pairs.into_iter().filter(|(i, j)| both[*i] && both[*j]) {
            let was = x.get(&pair).unwrap_or(&nothing);
            let now = y.get(&pair).unwrap_or(&nothing);
            if let Some(change) = change(was, now) {
                let kinds = found.entry((pair, change)).or_default();
                kinds.push(kind.name().to_owned());
            }
        }
    }
    // Each pair has the names of its links; a URDD has an entry for each pair.
    let account = &before.account;
    account.deposit(names.len() * names.len());
    let found = found.into_iter().map(|(((i, j), change), shapes)| {
        account.charge(names[i].len() + names[j].len())?;
        let links = [i, j].map(|link| names[link].to_owned());
        Ok(PairDifference { links, change, shapes })
    });
    let found = found.collect::<Result<Vec<_>, AccountError>>();
    found.map_err(|why| notes.push(format!("skipped pairs are not compared: {why}"))).ok()
}

fn change(before: &Checked, after: &Checked) -> Option<PairChange> {
    match (before.pieces.is_empty(), after.pieces.is_empty()) {
        (true, false) => Some(PairChange::Gained),
        (false, true) => Some(PairChange::Lost),
        // With other pieces there is nothing to compare one by one.
        _ if before.all == after.all && before.pieces != after.pieces => Some(PairChange::Pieces),
        _ => None,
    }
}

fn open(side: &Side) -> Result<Robot, &'static str> {
    let Some(urdd) = &side.urdd else { return Err("is a URDF, which states none") };
    let robot = Robot::of(urdd.root().clone());
    match robot.skips(ShapeKind::Hulls) {
        Ok(_) => Ok(robot),
        Err(_) => Err("has no usable link_shapes_skips_module"),
    }
}

/// What is checked with one kind of shapes. `index` says for each link its index in the first robot.
fn checked(robot: &Robot, kind: ShapeKind, index: &[Option<usize>]) -> Option<Pairs> {
    let skips = robot.skips(kind).ok()?;
    let place = |(link, piece): (usize, usize)| Some((*index.get(link)?.as_ref()?, piece));
    let places: Vec<_> = skips.places().iter().map(|it| place(*it)).collect();
    let mut pairs = Pairs::new();
    for (i, first) in places.iter().enumerate() {
        for (j, second) in places.iter().enumerate().skip(i + 1) {
            let (Some(first), Some(second)) = (first, second) else { continue };
            let (first, second) = (first.min(second), first.max(second));
            let pair = pairs.entry((first.0, second.0)).or_default();
            pair.all += 1;
            // The matrix is symmetric, or the findings say so. A pair is skipped where both elements say so.
            if !(skips.is_skipped(i, j) && skips.is_skipped(j, i)) {
                pair.pieces.insert((first.1, second.1));
            }
        }
    }
    Some(pairs)
}

/// Differences up to this, metres and radians, are due to rounding.
const ROUNDING: f64 = 1e-9;

type Pose = (Matrix3<f64>, Vector3<f64>);

/// The links that are elsewhere; `None` if there are none, or if the joints of one robot form no tree.
pub fn poses(before: &Side, after: &Side, tolerance: f64) -> Option<PoseDifference> {
    let tolerance = tolerance.max(ROUNDING);
    let (a, b) = (poses_of(&before.view)?, poses_of(&after.view)?);
    let by_name: HashMap<&str, &Pose> = after.link_names().into_iter().zip(&b).collect();
    let mut found: Option<PoseDifference> = None;
    for (name, (turn, place)) in before.link_names().into_iter().zip(&a) {
        let Some((other_turn, other_place)) = by_name.get(name) else { continue };
        let distance = (other_place - place).norm();
        // Half of the norm of the difference is the sine of half the angle, times the square root of 2.
        let sine = (other_turn - turn).norm() / (2.0 * std::f64::consts::SQRT_2);
        let angle = 2.0 * sine.clamp(0.0, 1.0).asin();
        let is_finite = distance.is_finite() && angle.is_finite();
        if !is_finite || (distance <= tolerance && angle <= tolerance) {
            continue;
        }
        let found = found.get_or_insert_with(|| PoseDifference {
            links: Vec::new(),
            farthest: name.to_owned(),
            distance,
            angle,
        });
        found.links.push(name.to_owned());
        found.angle = found.angle.max(angle);
        if distance > found.distance {
            (found.distance, found.farthest) = (distance, name.to_owned());
        }
    }
    found
}

/// The pose of each link in the frame of the root link.
fn poses_of(robot: &urdd_document::robot::Robot) -> Option<Vec<Pose>> {
    let tree = Tree::new(robot)?;
    let mut poses = vec![(Matrix3::identity(), Vector3::zeros()); robot.links.len()];
    for &link in &tree.order {
        let (Some(parent), Some(joint)) = (tree.parent_link[link], tree.parent_joint[link]) else {
            continue;
        };
        let origin = robot.joints.get(joint)?.origin;
        let (turn, place) = poses[parent];
        poses[link] = (turn * origin.rotation(), place + turn * Vector3::from(origin.xyz));
    }
    Some(poses)
}

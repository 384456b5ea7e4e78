//! What closes a chain: `connect` and `weld` between two bodies of the robot.

use std::collections::HashMap;

use nalgebra::{Isometry3, Point3, Quaternion, Translation3, UnitQuaternion};

use super::super::model::{Closing, End};
use super::super::refusal::Fallible;
use super::body::Made;
use super::reading::{Attributes, View};
use urdd_format::loops::LoopKind;

/// The bodies of a robot in its first body's frame, in the pose of the model (`qpos0`), and its sites by name.
pub struct Placed<'m> {
    poses: Vec<Isometry3<f64>>,
    sites: HashMap<&'m str, usize>,
}

impl<'m> Placed<'m> {
    /// Those of a robot that is made.
    pub fn of(made: &'m Made) -> Self {
        let mut poses: Vec<Isometry3<f64>> = Vec::with_capacity(made.bodies.len());
        for body in &made.bodies {
            let parent = body.parent.and_then(|parent| poses.get(parent));
            poses.push(parent.map_or_else(Isometry3::identity, |parent| parent * body.pose));
        }
        let sites = made.bodies.iter().enumerate().filter(|(_, body)| body.is_frame);
        let sites = sites.map(|(index, body)| (body.name.as_str(), index)).collect();
        Placed { poses, sites }
    }

    /// The loop of a `connect` or `weld` between two bodies, by raw index. `None` if one is not of the robot, or it is of
    /// another kind.
    pub fn bodies(
        &self,
        view: View<'_>,
        [one, other]: [usize; 2],
        made: &Made,
    ) -> Fallible<Option<Closing>> {
        let ends = made.index.get(&one).copied().zip(made.index.get(&other).copied());
        let Some((a, b)) = ends.filter(|(a, b)| a != b) else { return Ok(None) };
        let (at_a, at_b) = (self.poses[a], self.poses[b]);
        let anchor = view.numbers::<3>("anchor")?.unwrap_or_default();
        let (kind, frames) = match view.element.tag.as_str() {
            "connect" => {
                // A point of the first body, where the model has it.
                let point = Isometry3::from(Translation3::from(anchor));
                (LoopKind::Spherical, [point, at_b.inverse() * at_a * point])
            }
            "weld" => {
                let written = view.numbers::<7>("relpose")?.unwrap_or_default();
                let [x, y, z, w, i, j, k] = written;
                let turn = UnitQuaternion::try_new(Quaternion::new(w, i, j, k), 0.0);
                let relative = match turn {
                    Some(turn) => Isometry3::from_parts(Translation3::new(x, y, z), turn),
                    None => at_a.inverse() * at_b,
                };
                // Where it is held, in the second body.
                let point = Isometry3::from(Translation3::from(Point3::from(anchor)));
                (welded(view)?, [relative * point, point])
            }
            _ => return Ok(None),
        };
        let [frame_a, frame_b] = frames;
        let ends = [End { body: a, frame: frame_a }, End { body: b, frame: frame_b }];
        Ok(Some(closing(view, kind, ends)))
    }

    /// The loop of a `connect` or `weld` between two sites.
    pub fn sites(&self, view: View<'_>, names: [&str; 2]) -> Fallible<Option<Closing>> {
        let [a, b] = names.map(|name| self.sites.get(name).copied());
        let kind = match view.element.tag.as_str() {
            "connect" => LoopKind::Spherical,
            "weld" => welded(view)?,
            _ => return Ok(None),
        };
        let Some((a, b)) = a.zip(b).filter(|(a, b)| a != b) else { return Ok(None) };
        let ends = [a, b].map(|body| End { body, frame: Isometry3::identity() });
        Ok(Some(closing(view, kind, ends)))
    }
}

/// What a weld holds: without `torquescale` no rotation, as in MuJoCo.
fn welded(view: View<'_>) -> Fallible<LoopKind> {
    let scale = view.numbers::<1>("torquescale")?;
    Ok(match scale {
        Some([0.0]) => LoopKind::Spherical,
        _ => LoopKind::Fixed,
    })
}

fn closing(view: View<'_>, kind: LoopKind, ends: [End; 2]) -> Closing {
    let name = view.element.text("name").map(str::to_owned);
    Closing { name, kind, ends, place: view.element.place }
}

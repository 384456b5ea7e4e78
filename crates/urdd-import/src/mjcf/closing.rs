//! What closes a chain: `connect` and `weld` between two bodies of the robot.

use std::collections::HashMap;

use nalgebra::{Isometry3, Point3, Quaternion, Translation3, UnitQuaternion};

use super::super::model::{Closing, End};
use super::super::refusal::Fallible;
use super::body::{Made, RawBody, WORLD};
use super::reading::View;
use urdd_format::loops::LoopKind;

/// The bodies of a robot in its first body's frame, in the pose of the model (`qpos0`), and its sites by name.
pub struct Placed<'m> {
    poses: Vec<Isometry3<f64>>,
    sites: HashMap<&'m str, usize>,
    /// The world in the frame of the first body, if that does not move in it.
    world: Option<Isometry3<f64>>,
}

impl<'m> Placed<'m> {
    /// Those of a robot that is made.
    pub fn of(made: &'m Made, all: &[RawBody<'_>]) -> Self {
        let mut poses: Vec<Isometry3<f64>> = Vec::with_capacity(made.bodies.len());
        for body in &made.bodies {
            let parent = body.parent.and_then(|parent| poses.get(parent));
            poses.push(parent.map_or_else(Isometry3::identity, |parent| parent * body.pose));
        }
        let sites = made.bodies.iter().enumerate().filter(|(_, body)| body.is_frame);
        let sites = sites.map(|(index, body)| (body.name.as_str(), index)).collect();
        let first = made.index.iter().find(|(_, index)| **index == 0).map(|(raw, _)| &all[*raw]);
        let is_fixed = |raw: &&RawBody<'_>| {
            !made.is_floating && raw.joints.is_empty() && raw.parent == Some(WORLD)
        };
        let world = first.filter(is_fixed).map(|raw| raw.pose.inverse());
        Placed { poses, sites, world }
    }

    /// A body by its raw index, as the body that carries it and its pose there; the world too.
    fn body(&self, raw: usize, made: &Made) -> Option<(usize, Isometry3<f64>)> {
        match made.index.get(&raw) {
            Some(index) => Some((*index, Isometry3::identity())),
            None if raw == WORLD => Some((0, self.world?)),
            None => None,
        }
    }

    /// The loop of a `connect` or `weld` between two bodies, by raw index. `None` if one is not of the robot, or it is of
    /// another kind.
    pub fn bodies(
        &self,
        view: View<'_>,
        [one, other]: [usize; 2],
        made: &Made,
    ) -> Fallible<Option<Closing>> {
        let ends = self.body(one, made).zip(self.body(other, made));
        let Some(((a, in_a), (b, in_b))) = ends.filter(|((a, _), (b, _))| a != b) else {
            return Ok(None);
        };
        let (at_a, at_b) = (self.poses[a] * in_a, self.poses[b] * in_b);
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
                (LoopKind::Fixed, [relative * point, point])
            }
            _ => return Ok(None),
        };
        let [frame_a, frame_b] = frames;
        let ends = [End { body: a, frame: in_a * frame_a }, End { body: b, frame: in_b * frame_b }];
        Ok(Some(closing(view, kind, ends)))
    }

    /// The loop of a `connect` or `weld` between two sites.
    pub fn sites(&self, view: View<'_>, names: [&str; 2]) -> Option<Closing> {
        let [a, b] = names.map(|name| self.sites.get(name).copied());
        let kind = match view.element.tag.as_str() {
            "connect" => LoopKind::Spherical,
            "weld" => LoopKind::Fixed,
            _ => return None,
        };
        let (a, b) = a.zip(b).filter(|(a, b)| a != b)?;
        let ends = [a, b].map(|body| End { body, frame: Isometry3::identity() });
        Some(closing(view, kind, ends))
    }
}

fn closing(view: View<'_>, kind: LoopKind, ends: [End; 2]) -> Closing {
    let name = view.element.text("name").map(str::to_owned);
    Closing { name, kind, ends, place: view.element.place }
}

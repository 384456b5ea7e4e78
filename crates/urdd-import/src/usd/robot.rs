//! The robot of a scene, as a model.

use std::collections::HashMap;

use nalgebra::{Isometry3, Translation3, Vector3};
use urdd_directory::account::{Account, Charged};
use urdd_format::loops::LoopKind;
use urdd_kinematics::rotation::from_z;
use urdd_source::ImportOptions;
use urdd_source::gate::Gate;
use urdd_usd::Value;

use super::drive::{self, drive};
use super::frames::{self, Made, clean};
use super::gprim::Shapes;
use super::joint::{Graph, JointEnd, MOTIONS, Motion, UsdJoint, graph, joints};
use super::scene::{Scene, flag, number};
use super::{mass, pairs};
use crate::features::{self, Tally};
use crate::graph::{Branch, limits, say_closed};
use crate::model::{Body, Closing, End, Joint, JointKind, Mimic, Model};
use crate::place::{Fallible, Place, Placing};
use crate::tree::Names;

pub fn robot(scene: &Scene<'_>, gate: &Gate, options: &ImportOptions) -> Fallible<Model> {
    let (mut tally, account) = (Tally::default(), gate.account());
    tally.add(features::SAMPLES, scene.stage.sampled);
    say_missing(scene, &mut tally);
    let joints = joints(scene, &mut tally)?;
    let graph = graph(scene, &joints, options.body.as_deref(), &mut tally)?;
    let mut maker = Maker {
        scene,
        joints: &joints,
        account,
        names: [Names::new(account), Names::new(account)],
        of_joint: HashMap::new(),
    };
    let mut made = maker.bodies(&graph, &mut tally)?;
    maker.mimics(&mut made, &mut tally)?;
    if graph.is_floating {
        tally.count(features::FREE);
    }
    let mut shapes = Shapes::new(scene, gate);
    shapes.add(&mut made, &mut tally)?;
    mass::add(scene, &mut made, &shapes, &mut tally)?;
    let (moving, of_joint) = (&mut made.bodies, &maker.of_joint);
    drive::give(scene, of_joint, moving, graph.is_floating, account, &mut tally)?;
    let closings = maker.closings(&graph, &made, &mut tally)?;
    let (apart, checked) =
        pairs::pairs(scene, &joints, &made, &shapes.solids, account, &mut tally)?;
    frames::frames(scene, &mut maker.names[0], &mut made, account, &mut tally)?;
    let configurations = frames::configurations(scene, &made, account, &mut tally)?;
    let friction = shapes.friction(&made, &mut tally);
    let mut model = Model {
        name: maker.name(&graph),
        bodies: made.bodies,
        is_floating: graph.is_floating,
        assets: shapes.into_assets(),
        configurations,
        apart,
        checked,
        closings,
        friction,
        tally,
        ..Model::default()
    };
    if scene.is_y_up {
        frames::turn(&mut model, account).at(Place::default())?;
    }
    Ok(model)
}

/// A step from a joint to the one that it follows, as bytes: a chain of them is walked for each.
const STEP: usize = 50;

struct Maker<'a, 's> {
    scene: &'a Scene<'s>,
    joints: &'a [UsdJoint],
    account: &'a Account,
    /// Of bodies and of joints.
    names: [Names; 2],
    /// The joints of the model by the prim of each: body, place, and whether it is turned.
    of_joint: HashMap<usize, (usize, usize)>,
}

impl Maker<'_, '_> {
    /// The name of the robot: that of the default prim, or of what all its bodies are in.
    fn name(&self, graph: &Graph) -> String {
        let default = self.scene.stage.metadata("defaultPrim").and_then(Value::text);
        let default = default.and_then(|name| self.scene.stage.find(&format!("/{name}")));
        let first = graph.branches.iter().find_map(|branch| graph.bodies.get(branch.body));
        let above = first.copied().map(|mut at| {
            while let Some(parent) = self.scene.prim(at).parent {
                at = parent;
            }
            at
        });
        default.or(above).map_or_else(String::new, |at| self.scene.name(at).to_owned())
    }

    fn bodies(&mut self, graph: &Graph, tally: &mut Tally) -> Fallible<Made> {
        let mut made =
            Made { bodies: Charged::default(), index: HashMap::new(), shifts: Vec::new() };
        for branch in &graph.branches {
            let body = self.body(graph, branch, &mut made, tally)?;
            let (index, place) = (made.bodies.len(), body.place);
            made.index.extend(graph.bodies.get(branch.body).map(|prim| (*prim, index)));
            tally.count(features::BODIES);
            made.bodies.push(body, self.account).at(place)?;
        }
        Ok(made)
    }

    fn body(
        &mut self,
        graph: &Graph,
        branch: &Branch,
        made: &mut Made,
        tally: &mut Tally,
    ) -> Fallible<Body> {
        let scene = self.scene;
        let prim = graph.bodies.get(branch.body);
        let (wanted, place) = match prim {
            Some(prim) => (scene.name(*prim), scene.place(*prim)),
            None => ("world", Default::default()),
        };
        let name = self.names[0].free(wanted).at(place)?;
        let Some((parent, joint)) = branch.joint else {
            made.shifts.push(Vector3::zeros());
            return Ok(Body::new(name, None, Isometry3::identity(), place));
        };
        let further = graph.further.get(&joint).map_or(&[][..], Vec::as_slice);
        let joint = &self.joints[joint];
        let [in_parent, in_child] = match branch.is_turned {
            false => [&joint.ends[0], &joint.ends[1]],
            true => [&joint.ends[1], &joint.ends[0]],
        };
        // Where it turns is the frame of the link, unless it turns about several points.
        let is_still = joint.motions.iter().all(Motion::is_slide) || !further.is_empty();
        let shift = if is_still { Vector3::zeros() } else { in_child.frame.translation.vector };
        let above = made.shifts[parent];
        made.shifts.push(shift);
        let pose = Translation3::from(-above)
            * in_parent.frame
            * in_child.frame.inverse()
            * Translation3::from(shift);
        let mut body = Body::new(name, Some(parent), clean(pose), place);
        if branch.is_turned {
            tally.count(features::TURNED);
        }
        let further = further.iter().map(|at| &self.joints[*at]);
        let mut all: Vec<&UsdJoint> = std::iter::once(joint).chain(further).collect();
        if branch.is_turned {
            all.reverse();
        }
        for joint in &all {
            let of = scene.place(joint.prim);
            let name = self.names[1].free(scene.name(joint.prim)).at(of)?;
            if all.len() == 1 && joint.motions.is_empty() {
                body.fixed_by = Some(name);
                return Ok(body);
            }
            let end = &joint.ends[usize::from(!branch.is_turned)];
            let mut moves = self.moves(joint, &name, end, branch.is_turned, tally)?;
            if let [_] = &moves[..] {
                self.of_joint.insert(joint.prim, (made.bodies.len(), body.joints.len()));
            }
            for moving in &mut moves {
                if all.len() > 1 {
                    moving.frame = Translation3::from(end.frame.translation.vector).into();
                }
            }
            for moving in moves {
                body.joints.push(moving, self.account).at(of)?;
            }
        }
        if all.len() > 1 {
            tally.count(features::MORE_JOINTS);
        }
        Ok(body)
    }

    /// What a joint leaves free, together or one after the other.
    fn moves(
        &mut self,
        joint: &UsdJoint,
        name: &str,
        end: &JointEnd,
        is_turned: bool,
        tally: &mut Tally,
    ) -> Fallible<Vec<Joint>> {
        let (scene, place) = (self.scene, self.scene.place(joint.prim));
        let axis_of = |motion: &Motion| {
            let sign = if is_turned { -1.0 } else { 1.0 };
            clean_axis(end.frame.rotation * motion.axis * sign)
        };
        if let (Some(kind), Some(last)) = (joint.whole, joint.motions.last()) {
            let mut whole = Joint::new(name.to_owned(), kind, Isometry3::identity(), place);
            whole.axis = axis_of(last);
            tally.count(whole.feature());
            return Ok(vec![whole]);
        }
        let mut parts: Vec<&Motion> = joint.motions.iter().collect();
        if is_turned {
            parts.reverse();
        }
        if parts.len() > 1 {
            tally.count(features::MORE_JOINTS);
        }
        let mut moves = Vec::new();
        for motion in &parts {
            let own = match parts.len() {
                1 => name.to_owned(),
                _ => {
                    let own = self.names[1].free(&format!("{name}/{}", MOTIONS[motion.which]));
                    own.at(place)?
                }
            };
            let kind = if motion.is_slide() { JointKind::Slide } else { JointKind::Hinge };
            let mut moving = Joint::new(own, kind, Isometry3::identity(), place);
            moving.axis = axis_of(motion);
            let reference = number(scene.prim(joint.prim), "mjc:ref").unwrap_or(0.0);
            moving.reference =
                reference * if motion.is_slide() { scene.metre } else { scene.mujoco_angle };
            moving.range = limits(motion.range, kind, (&moving.name, place), tally);
            drive(scene, joint.prim, motion, &mut moving, tally);
            tally.count(moving.feature());
            moves.push(moving);
        }
        Ok(moves)
    }

    /// Joints that follow others, as Newton says it, or PhysX.
    fn mimics(&self, made: &mut Made, tally: &mut Tally) -> Fallible<()> {
        let mut followed: HashMap<String, String> = HashMap::new();
        for joint in self.joints {
            let prim = self.scene.prim(joint.prim);
            let physx = ["rotX", "rotY", "rotZ", "transX", "transY", "transZ"];
            let physx = physx.iter().find(|axis| prim.has(&format!("PhysxMimicJointAPI:{axis}")));
            let (leader, offset, multiplier) = if prim.has("NewtonMimicAPI") {
                if !flag(prim, "newton:mimicEnabled", true) {
                    continue;
                }
                let value = |name: &str, none| number(prim, name).unwrap_or(none);
                (
                    self.scene.target(prim, "newton:mimicJoint"),
                    value("newton:mimicCoef0", 0.0),
                    value("newton:mimicCoef1", 1.0),
                )
            } else if let Some(axis) = physx {
                let value = |name: &str, none| {
                    number(prim, &format!("physxMimicJoint:{axis}:{name}")).unwrap_or(none)
                };
                let leader = format!("physxMimicJoint:{axis}:referenceJoint");
                // Own + gearing × other + offset = 0.
                (self.scene.target(prim, &leader), -value("offset", 0.0), -value("gearing", 1.0))
            } else {
                continue;
            };
            let own = self.of_joint.get(&joint.prim).copied();
            let other = leader.and_then(|leader| self.of_joint.get(&leader)).copied();
            let Some((own, other)) = own.zip(other).filter(|(own, other)| own != other) else {
                tally.count(features::COUPLINGS);
                continue;
            };
            let leader = made.bodies[other.0].joints[other.1].name.clone();
            let follower = &mut made.bodies[own.0].joints[own.1];
            // A circle of joints that follow each other has no leader: what comes last moves by itself.
            let mut above = Some(&leader);
            while let Some(name) = above.filter(|name| **name != follower.name) {
                let place = self.scene.place(joint.prim);
                self.account.charge(STEP).at(place)?;
                above = followed.get(name);
            }
            if above.is_some() {
                tally.count(features::COUPLINGS);
                continue;
            }
            followed.insert(follower.name.clone(), leader.clone());
            let unit = match follower.kind {
                JointKind::Slide => self.scene.metre,
                _ => 1f64.to_radians(),
            };
            follower.mimic = Some(Mimic { joint: leader, multiplier, offset: offset * unit });
            tally.count(features::MIMICS);
        }
        Ok(())
    }

    fn closings(
        &self,
        graph: &Graph,
        made: &Made,
        tally: &mut Tally,
    ) -> Fallible<Charged<Closing>> {
        let mut closings = Charged::default();
        for joint in graph.outside.iter().map(|at| &self.joints[*at]) {
            let place = self.scene.place(joint.prim);
            let slides = joint.motions.iter().filter(|motion| motion.is_slide()).count();
            let axes: Vec<Vector3<f64>> = joint.motions.iter().map(|motion| motion.axis).collect();
            let (kind, axis) = match (slides, &axes[..]) {
                _ if joint.whole == Some(JointKind::Ball) => {
                    (Some(LoopKind::Spherical), Vector3::z())
                }
                (0, []) => (Some(LoopKind::Fixed), Vector3::z()),
                (0, [axis]) => (Some(LoopKind::Revolute), *axis),
                (1, [axis]) => (Some(LoopKind::Prismatic), *axis),
                (1, [slide, hinge]) if slide == hinge => (Some(LoopKind::Cylindrical), *slide),
                (2, [one, other, hinge]) if one.cross(other).cross(hinge).norm() == 0.0 => {
                    (Some(LoopKind::Planar), *hinge)
                }
                _ => (None, Vector3::z()),
            };
            let bodies =
                joint.ends.map(|end| end.body.and_then(|body| made.index.get(&body).copied()));
            let (Some(kind), [Some(one), Some(other)]) = (kind, bodies) else {
                let name = self.scene.name(joint.prim);
                let text = format!("the joint `{name}` is left out: it closes a chain");
                tally.say(features::OPEN, place, text);
                continue;
            };
            let ranges = joint.motions.iter().map(|motion| motion.range);
            say_closed(ranges, (self.scene.name(joint.prim), place), tally);
            let end = |body: usize, which: usize| {
                let shifted = Translation3::from(-made.shifts[body]) * joint.ends[which].frame;
                let turned = if axis == Vector3::z() { shifted } else { shifted * from_z(&axis) };
                End { body, frame: turned }
            };
            let name = Some(self.scene.name(joint.prim).to_owned());
            let closing = Closing { name, kind, ends: [end(one, 0), end(other, 1)], place };
            closings.push(closing, self.account).at(place)?;
        }
        Ok(closings)
    }
}

/// An axis without components that the rounding of a rotation to single precision made of 0.
fn clean_axis(axis: Vector3<f64>) -> Vector3<f64> {
    axis.map(|value| if value.abs() < 1e-7 { 0.0 } else { value })
}

/// Counts what is left out, so that the report has it.
fn say_missing(scene: &Scene<'_>, tally: &mut Tally) {
    for prim in &scene.stage.prims {
        match &*prim.type_name {
            "MjcTendon" => tally.count(features::TENDONS),
            "MjcKeyframe" => tally.unread("keyframes of MuJoCo"),
            _ => {}
        }
        let starts = |start: &str| prim.schemas.iter().any(|schema| schema.starts_with(start));
        if starts("PhysxTendon") {
            tally.count(features::TENDONS);
        }
        if starts("PhysxVehicle") || starts("PhysxParticle") || starts("PhysxDeformable") {
            tally.count(features::SOFT);
        }
    }
    for (prim, error) in &scene.stage.missing {
        let place = prim.map_or_else(Default::default, |prim| scene.place(prim));
        let text = format!("a reference is left out: {}", error.fault);
        tally.say(features::MISSING_PARTS, place, text);
    }
}

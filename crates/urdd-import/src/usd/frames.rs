//! Frames of bodies while these are made, named configurations, and a robot of a stage whose y is up turned so that z is.

use std::collections::HashMap;
use std::f64::consts::FRAC_PI_2;

use nalgebra::{Isometry3, Point3, Translation3, UnitQuaternion, Vector3};
use urdd_directory::account::{Account, AccountError, Charged};
use urdd_usd::Value;

use super::scene::{Scene, is_name, is_site};
use crate::features::{self, Tally};
use crate::mass;
use crate::model::{Body, Configuration, JointValue, Model};
use crate::place::{Fallible, Placing};
use crate::tree::Names;

/// The bodies of the robot, while they are made.
pub struct Made {
    pub bodies: Charged<Body>,
    /// The body of each prim that is one.
    pub index: HashMap<usize, usize>,
    /// Where the frame of each link is in its body: the joint that leads to it is there.
    pub shifts: Vec<Vector3<f64>>,
}

/// Looking for the values of a body in a configuration, as bytes.
const BODY: usize = 20;

/// Prims of a body that are frames alone.
pub fn frames(
    scene: &Scene<'_>,
    names: &mut Names,
    made: &mut Made,
    account: &Account,
    tally: &mut Tally,
) -> Fallible<()> {
    let prims = &scene.stage.prims;
    // What is a transform or a site, and has nothing but such in it, and bodies.
    let mut is_frame = vec![false; prims.len()];
    for (prim, of) in prims.iter().enumerate().rev() {
        let is_plain = &*of.type_name == "Xform"
            && !of.properties.is_empty()
            && of.properties.iter().all(|property| property.name.starts_with("xformOp"));
        let is_one = |child: &usize| is_frame[*child] || scene.body[*child] == Some(*child);
        is_frame[prim] = (is_plain || is_site(of))
            && scene.body[prim] != Some(prim)
            && of.children.iter().all(is_one);
    }
    for (prim, of) in prims.iter().enumerate() {
        // In a body, or in a frame of it.
        let is_in =
            of.parent.is_some_and(|parent| scene.body[parent] == Some(parent) || is_frame[parent]);
        let body = scene.body[prim].filter(|_| is_in && is_frame[prim]);
        let Some((body, index)) = body.and_then(|body| Some((body, *made.index.get(&body)?)))
        else {
            continue;
        };
        let place = scene.place(prim);
        let pose = scene.frame(body)?.0.inverse() * scene.frame(prim)?.0;
        let pose = clean(Translation3::from(-made.shifts[index]) * pose);
        let name = names.free(scene.name(prim)).at(place)?;
        tally.count(features::FRAMES);
        let frame = Body { is_frame: true, ..Body::new(name, Some(index), pose, place) };
        made.bodies.push(frame, account).at(place)?;
    }
    Ok(())
}

/// Named configurations, which `urdd export` writes into custom data.
pub fn configurations(
    scene: &Scene<'_>,
    made: &Made,
    account: &Account,
    tally: &mut Tally,
) -> Fallible<Charged<Configuration>> {
    let mut all = Charged::default();
    for (prim, of) in scene.stage.prims.iter().enumerate() {
        let data = of.field("customData").and_then(|data| data.get("urdd")?.get("configurations"));
        let Some(Value::Dictionary(named)) = data else { continue };
        let place = scene.place(prim);
        for (name, values) in named.iter() {
            let Value::Dictionary(values) = values else { continue };
            if !is_name(name) {
                continue;
            }
            account.charge(BODY * made.bodies.len()).at(place)?;
            let known: HashMap<&str, f64> = values
                .iter()
                .filter_map(|(name, value)| Some((&**name, value.number()?)))
                .collect();
            let mut configuration =
                Configuration { name: name.to_string(), values: Charged::default(), base: None };
            for (body, part) in made.bodies.walk(account).at(place)?.enumerate() {
                for (which, joint) in part.joints.walk(account).at(place)?.enumerate() {
                    let dofs = joint.kind.dofs().iter();
                    let name = joint.name.clone();
                    let values = dofs.map(|dof| known.get(&*format!("{name}{dof}")).copied());
                    let Some(values) = values.collect() else { continue };
                    let value = JointValue { joint: (body, which), name, values };
                    configuration.values.push(value, account).at(place)?;
                }
            }
            tally.count(features::POSES);
            all.push(configuration, account).at(place)?;
        }
    }
    Ok(all)
}

/// A pose without what rounding alone made, when frames of a stage became those of a body: to 1e-12 m.
pub fn clean(pose: Isometry3<f64>) -> Isometry3<f64> {
    // Further away, the digits do not reach so far.
    let round =
        |value: f64| if value.abs() < 1e3 { (value * 1e12).round() / 1e12 + 0.0 } else { value };
    let vector = pose.translation.vector.map(round);
    let rotation = if pose.rotation.angle() < 1e-9 { Default::default() } else { pose.rotation };
    Isometry3::from_parts(Translation3::from(vector), rotation)
}

/// Turns the axes of all frames alike: what was along y is along z.
pub fn turn(model: &mut Model, account: &Account) -> Result<(), AccountError> {
    let up = UnitQuaternion::from_axis_angle(&Vector3::x_axis(), FRAC_PI_2);
    // Exactly, and not by a quaternion: (x, y, z) becomes (x, -z, y).
    let point = |of: Vector3<f64>| Vector3::new(of.x, -of.z, of.y);
    let turned = |frame: &Isometry3<f64>| {
        let vector = frame.rotation.into_inner().vector().into_owned();
        let [i, j, k]: [f64; 3] = point(vector).into();
        let rotation = nalgebra::Quaternion::new(frame.rotation.w, i, j, k);
        let place = point(frame.translation.vector);
        Isometry3::from_parts(place.into(), UnitQuaternion::new_unchecked(rotation))
    };
    for body in model.bodies.walk_mut(account)? {
        body.pose = turned(&body.pose);
        for joint in body.joints.walk_mut(account)? {
            joint.frame = turned(&joint.frame);
            joint.axis = point(joint.axis);
        }
        for shape in body.shapes.walk_mut(account)? {
            let place = point(shape.pose.translation.vector);
            shape.pose = Isometry3::from_parts(place.into(), up * shape.pose.rotation);
        }
        if let Some(inertial) = &mut body.inertial {
            inertial.centre = Point3::from(point(inertial.centre.coords));
            inertial.inertia = mass::turned(&inertial.inertia, &up);
        }
    }
    for closing in model.closings.walk_mut(account)? {
        for end in &mut closing.ends {
            // Its z is an axis of the loop, which turns with the body.
            let place = point(end.frame.translation.vector);
            end.frame = Isometry3::from_parts(place.into(), up * end.frame.rotation);
        }
    }
    Ok(())
}

//! The data of a legacy `urdf_module` for a URDF: defaults where the URDF has no value.

use serde_json::Value;

use urdd_format::legacy::urdf as old;
use urdd_format::urdf as v1;

/// The document that the converter of legacy URDDs would have written, apart from what it wrote inconsistently. `None`
/// if it could not write it (an element without a shape).
pub fn as_legacy(robot: &v1::UrdfModule) -> Option<Value> {
    let module = old::UrdfModule {
        name: robot.name.clone(),
        links: robot.links.iter().map(link).collect::<Option<_>>()?,
        joints: robot.joints.iter().map(joint).collect(),
        materials: robot.materials.iter().map(material).collect(),
    };
    let mut document = serde_json::to_value(module).ok()?;
    let joints = document.get_mut("joints")?.as_array_mut()?;
    for (joint, value) in robot.joints.iter().zip(joints) {
        // An axis that is neither present nor used was written as 1 0 0 by some versions, and as zeros by others.
        if joint.axis.is_none() && joint.joint_type == v1::JointType::Fixed {
            value.as_object_mut()?.shift_remove("axis");
        }
    }
    Some(document)
}

fn link(link: &v1::Link) -> Option<old::Link> {
    let inertial = link.inertial.as_ref();
    let inertia = inertial.and_then(|inertial| inertial.inertia.as_ref());
    let element = |pick: fn(&v1::Inertia) -> Option<f64>| inertia.and_then(pick).unwrap_or(0.0);
    let visual = link.visual.iter().map(|visual| {
        Some(old::Visual {
            name: visual.name.clone(),
            origin: origin(visual.origin.as_ref()),
            geometry: geometry(visual.geometry.as_ref()?),
            material: visual.material.as_ref().map(material),
        })
    });
    let collision = link.collision.iter().map(|collision| {
        Some(old::Collision {
            name: collision.name.clone(),
            origin: origin(collision.origin.as_ref()),
            geometry: geometry(collision.geometry.as_ref()?),
        })
    });
    Some(old::Link {
        name: link.name.clone(),
        inertial: old::Inertial {
            origin: origin(inertial.and_then(|inertial| inertial.origin.as_ref())),
            mass: old::Mass {
                value: inertial
                    .and_then(|inertial| inertial.mass.as_ref())
                    .map_or(0.0, |mass| mass.value),
            },
            inertia: old::Inertia {
                ixx: element(|i| i.ixx),
                ixy: element(|i| i.ixy),
                ixz: element(|i| i.ixz),
                iyy: element(|i| i.iyy),
                iyz: element(|i| i.iyz),
                izz: element(|i| i.izz),
            },
        },
        visual: visual.collect::<Option<_>>()?,
        collision: collision.collect::<Option<_>>()?,
    })
}

fn origin(origin: Option<&v1::Origin>) -> old::Origin {
    old::Origin {
        xyz: origin.and_then(|origin| origin.xyz).unwrap_or_default(),
        rpy: origin.and_then(|origin| origin.rpy).unwrap_or_default(),
    }
}

fn geometry(geometry: &v1::Geometry) -> old::Geometry {
    match geometry {
        v1::Geometry::Mesh(mesh) => old::Geometry::Mesh(old::Mesh {
            filename: mesh.filename.clone(),
            scale: mesh.scale,
        }),
        v1::Geometry::Box(cuboid) => old::Geometry::Box(cuboid.clone()),
        v1::Geometry::Cylinder(cylinder) => old::Geometry::Cylinder(cylinder.clone()),
        v1::Geometry::Capsule(capsule) => old::Geometry::Capsule(old::Capsule {
            radius: capsule.radius,
            length: capsule.length,
        }),
        v1::Geometry::Sphere(sphere) => old::Geometry::Sphere(sphere.clone()),
    }
}

fn material(material: &v1::Material) -> old::Material {
    old::Material {
        name: material.name.clone().unwrap_or_default(),
        color: material.color.clone(),
        texture: material.texture.clone(),
    }
}

fn joint(joint: &v1::Joint) -> old::Joint {
    use v1::JointType as New;
    let limit = joint.limit.as_ref();
    let bound = |pick: fn(&v1::Limit) -> Option<f64>| limit.and_then(pick).unwrap_or(0.0);
    old::Joint {
        name: joint.name.clone(),
        joint_type: match joint.joint_type {
            New::Revolute => old::JointType::Revolute,
            New::Continuous => old::JointType::Continuous,
            New::Prismatic => old::JointType::Prismatic,
            New::Fixed => old::JointType::Fixed,
            New::Floating => old::JointType::Floating,
            New::Planar => old::JointType::Planar,
            New::Spherical => old::JointType::Spherical,
        },
        origin: origin(joint.origin.as_ref()),
        parent: joint.parent.clone(),
        child: joint.child.clone(),
        axis: old::Axis {
            xyz: joint
                .axis
                .as_ref()
                .and_then(|axis| axis.xyz)
                .unwrap_or([1.0, 0.0, 0.0]),
        },
        limit: old::Limit {
            lower: bound(|l| l.lower),
            upper: bound(|l| l.upper),
            effort: bound(|l| l.effort),
            velocity: bound(|l| l.velocity),
        },
        dynamics: joint.dynamics.as_ref().map(|dynamics| old::Dynamics {
            damping: dynamics.damping.unwrap_or(0.0),
            friction: dynamics.friction.unwrap_or(0.0),
        }),
        mimic: joint.mimic.clone(),
        safety_controller: joint
            .safety_controller
            .as_ref()
            .map(|soft| old::SafetyController {
                soft_lower_limit: soft.soft_lower_limit.unwrap_or(0.0),
                soft_upper_limit: soft.soft_upper_limit.unwrap_or(0.0),
                k_position: soft.k_position.unwrap_or(0.0),
                k_velocity: soft.k_velocity.unwrap_or(0.0),
            }),
    }
}

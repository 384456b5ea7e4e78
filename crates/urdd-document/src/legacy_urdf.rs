//! Converts a legacy `urdf_module` to version 1.

use urdd_format::legacy::urdf as legacy;
use urdd_format::urdf::{
    Axis, Capsule, Collision, Dynamics, Geometry, Inertia, Inertial, Joint, JointType, Limit, Link,
    Material, Mesh, Origin, SafetyController, UrdfModule, Visual,
};

/// The same robot in version 1. Legacy modules write zeros for missing masses and limits; these become absent.
pub fn of_legacy(module: &legacy::UrdfModule) -> UrdfModule {
    UrdfModule {
        name: module.name.clone(),
        version: None,
        links: module.links.iter().map(link).collect(),
        joints: module.joints.iter().map(joint).collect(),
        materials: module.materials.iter().map(material).collect(),
        unknown_elements: Vec::new(),
    }
}

fn origin(origin: &legacy::Origin) -> Option<Origin> {
    Some(Origin { xyz: Some(origin.xyz), rpy: Some(origin.rpy), quat_xyzw: None })
}

fn link(link: &legacy::Link) -> Link {
    let i = &link.inertial.inertia;
    let inertia = [i.ixx, i.ixy, i.ixz, i.iyy, i.iyz, i.izz];
    let absent = link.inertial.mass.value == 0.0 && inertia == [0.0; 6];
    let [ixx, ixy, ixz, iyy, iyz, izz] = inertia.map(Some);
    Link {
        name: link.name.clone(),
        inertial: (!absent).then(|| Inertial {
            origin: origin(&link.inertial.origin),
            mass: Some(link.inertial.mass.clone()),
            inertia: Some(Inertia { ixx, ixy, ixz, iyy, iyz, izz }),
        }),
        visual: link
            .visual
            .iter()
            .map(|visual| Visual {
                name: visual.name.clone(),
                origin: origin(&visual.origin),
                geometry: Some(geometry(&visual.geometry)),
                material: visual.material.as_ref().map(material),
            })
            .collect(),
        collision: link
            .collision
            .iter()
            .map(|collision| Collision {
                name: collision.name.clone(),
                origin: origin(&collision.origin),
                geometry: Some(geometry(&collision.geometry)),
            })
            .collect(),
        unknown_elements: Vec::new(),
    }
}

fn geometry(geometry: &legacy::Geometry) -> Geometry {
    match geometry {
        legacy::Geometry::Mesh(mesh) => {
            Geometry::Mesh(Mesh { filename: mesh.filename.clone(), scale: mesh.scale })
        }
        legacy::Geometry::Box(cuboid) => Geometry::Box(cuboid.clone()),
        legacy::Geometry::Cylinder(cylinder) => Geometry::Cylinder(cylinder.clone()),
        legacy::Geometry::Capsule(capsule) => {
            Geometry::Capsule(Capsule { radius: capsule.radius, length: capsule.length })
        }
        legacy::Geometry::Sphere(sphere) => Geometry::Sphere(sphere.clone()),
    }
}

fn material(material: &legacy::Material) -> Material {
    Material {
        name: Some(material.name.clone()),
        color: material.color.clone(),
        texture: material.texture.clone(),
    }
}

fn joint(joint: &legacy::Joint) -> Joint {
    use legacy::JointType as Old;
    let limit = &joint.limit;
    let absent = [limit.lower, limit.upper, limit.effort, limit.velocity] == [0.0; 4];
    Joint {
        name: joint.name.clone(),
        joint_type: match joint.joint_type {
            Old::Revolute => JointType::Revolute,
            Old::Continuous => JointType::Continuous,
            Old::Prismatic => JointType::Prismatic,
            Old::Fixed => JointType::Fixed,
            Old::Floating => JointType::Floating,
            Old::Planar => JointType::Planar,
            Old::Spherical => JointType::Spherical,
        },
        origin: origin(&joint.origin),
        parent: joint.parent.clone(),
        child: joint.child.clone(),
        axis: Some(Axis { xyz: Some(joint.axis.xyz) }),
        limit: (!absent).then_some(Limit {
            lower: Some(limit.lower),
            upper: Some(limit.upper),
            effort: Some(limit.effort),
            velocity: Some(limit.velocity),
            acceleration: None,
            deceleration: None,
            jerk: None,
        }),
        dynamics: joint.dynamics.as_ref().map(|dynamics| Dynamics {
            damping: Some(dynamics.damping),
            friction: Some(dynamics.friction),
        }),
        mimic: joint.mimic.clone(),
        safety_controller: joint.safety_controller.as_ref().map(|safety| SafetyController {
            soft_lower_limit: Some(safety.soft_lower_limit),
            soft_upper_limit: Some(safety.soft_upper_limit),
            k_position: Some(safety.k_position),
            k_velocity: Some(safety.k_velocity),
        }),
        calibration: None,
        unknown_elements: Vec::new(),
    }
}

//! Converts a legacy `urdf_module` to version 1.

use urdd_format::legacy::urdf as legacy;
use urdd_format::urdf::{
    Axis, Capsule, Collision, Color, Cuboid, Cylinder, Dynamics, Geometry, Inertia, Inertial,
    Joint, JointType, Limit, Link, LinkName, Mass, Material, Mesh, Mimic, Origin, SafetyController,
    Sphere, Texture, UrdfModule, Visual,
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
    Some(Origin {
        xyz: Some(origin.xyz),
        rpy: Some(origin.rpy),
        quat_xyzw: None,
    })
}

fn link(link: &legacy::Link) -> Link {
    let i = &link.inertial.inertia;
    let inertia = [i.ixx, i.ixy, i.ixz, i.iyy, i.iyz, i.izz];
    let mass = link.inertial.mass.value;
    let absent = mass == 0.0 && inertia == [0.0; 6];
    let [ixx, ixy, ixz, iyy, iyz, izz] = inertia.map(Some);
    Link {
        name: link.name.clone(),
        inertial: (!absent).then(|| Inertial {
            origin: origin(&link.inertial.origin),
            mass: Some(Mass { value: mass }),
            inertia: Some(Inertia {
                ixx,
                ixy,
                ixz,
                iyy,
                iyz,
                izz,
            }),
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
        legacy::Geometry::Mesh(mesh) => Geometry::Mesh(Mesh {
            filename: mesh.filename.clone(),
            scale: mesh.scale,
        }),
        legacy::Geometry::Box(cuboid) => Geometry::Box(Cuboid { size: cuboid.size }),
        legacy::Geometry::Cylinder(cylinder) => Geometry::Cylinder(Cylinder {
            radius: cylinder.radius,
            length: cylinder.length,
        }),
        legacy::Geometry::Capsule(capsule) => Geometry::Capsule(Capsule {
            radius: capsule.radius,
            length: capsule.length,
        }),
        legacy::Geometry::Sphere(sphere) => Geometry::Sphere(Sphere {
            radius: sphere.radius,
        }),
    }
}

fn material(material: &legacy::Material) -> Material {
    Material {
        name: Some(material.name.clone()),
        color: material
            .color
            .as_ref()
            .map(|color| Color { rgba: color.rgba }),
        texture: material.texture.as_ref().map(|texture| Texture {
            filename: texture.filename.clone(),
        }),
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
        parent: LinkName {
            link: joint.parent.link.clone(),
        },
        child: LinkName {
            link: joint.child.link.clone(),
        },
        axis: Some(Axis {
            xyz: Some(joint.axis.xyz),
        }),
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
        mimic: joint.mimic.as_ref().map(|mimic| Mimic {
            joint: mimic.joint.clone(),
            multiplier: mimic.multiplier,
            offset: mimic.offset,
        }),
        safety_controller: joint
            .safety_controller
            .as_ref()
            .map(|safety| SafetyController {
                soft_lower_limit: Some(safety.soft_lower_limit),
                soft_upper_limit: Some(safety.soft_upper_limit),
                k_position: Some(safety.k_position),
                k_velocity: Some(safety.k_velocity),
            }),
        calibration: None,
        unknown_elements: Vec::new(),
    }
}

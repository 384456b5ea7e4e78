//! Robot -> core modules and kinematics samples, implemented from SPEC with 4x4 matrices.

use std::collections::BTreeMap;
use std::f64::consts::PI;

use urdd_format::bounds::BoundsModule;
use urdd_format::chain::*;
use urdd_format::connections::*;
use urdd_format::dof::*;
use urdd_format::index::*;
use urdd_format::kinematics_samples::*;
use urdd_format::urdf::{Joint, JointType};

use super::robot::{Robot, num_dofs};
use super::transform::{
    IDENTITY, Rotation, Transform, norm, pose, product, rotation_about, rotation_by_vector,
    rotation_of_rpy, shortest_arc_from_z, transform, unit,
};

/// The typed core modules of a robot.
pub struct Core {
    pub dof: DofModule,
    pub chain: ChainModule,
    pub connections: ConnectionsModule,
    pub bounds: BoundsModule,
}

impl Core {
    pub fn new(robot: &Robot) -> Core {
        let dof = dof_module(robot);
        let chain = chain_module(robot);
        let connections = connections_module(&chain);
        let bounds = bounds_module(robot, &dof);
        Core { dof, chain, connections, bounds }
    }
}

// ---- dof_module (6.2)

fn is_mimic(joint: &Joint) -> bool {
    joint.mimic.is_some() && joint.joint_type != JointType::Fixed
}

pub fn dof_module(robot: &Robot) -> DofModule {
    let mut dofs = Vec::new();
    let mut of_joint: Vec<Vec<DofIdx>> = Vec::new();
    for (idx, joint) in robot.urdf.joints.iter().enumerate() {
        let suffixes: &[&str] = match joint.joint_type {
            _ if is_mimic(joint) => &[],
            JointType::Planar => &["/trans_x", "/trans_y", "/rot"],
            JointType::Spherical => &["/rot_x", "/rot_y", "/rot_z"],
            JointType::Floating => {
                &["/trans_x", "/trans_y", "/trans_z", "/rot_x", "/rot_y", "/rot_z"]
            }
            JointType::Fixed => &[],
            _ => &[""],
        };
        let first = dofs.len();
        for suffix in suffixes {
            let slides = joint.joint_type == JointType::Prismatic || suffix.contains("trans");
            dofs.push(Dof {
                name: format!("{}{suffix}", joint.name),
                joint_idx: JointIdx(idx as u32),
                joint_name: joint.name.clone(),
                quantity: if slides { Quantity::Length } else { Quantity::Angle },
            });
        }
        of_joint.push((first..dofs.len()).map(|i| DofIdx(i as u32)).collect());
    }
    let mimics = robot.urdf.joints.iter().map(|joint| {
        // Position of the joint = factor * position of joint `at` + shift.
        let (mut at, mut factor, mut shift) = (joint, 1.0, 0.0);
        while is_mimic(at) {
            let mimic = at.mimic.as_ref()?;
            shift += factor * mimic.offset.unwrap_or(0.0);
            factor *= mimic.multiplier.unwrap_or(1.0);
            at = &robot.urdf.joints[robot.joint_idx(&mimic.joint)];
        }
        is_mimic(joint).then(|| ResolvedMimic {
            dof_idx: of_joint[robot.joint_idx(&at.name)].first().copied(),
            multiplier: factor,
            offset: shift,
        })
    });
    DofModule {
        num_dofs: Count(dofs.len() as u32),
        dof_idx_to_joint_idx_mapping: dofs.iter().map(|dof| dof.joint_idx).collect(),
        joint_idx_to_mimic_mapping: mimics.collect(),
        joint_idx_to_dof_idxs_mapping: of_joint,
        dofs,
    }
}

// ---- chain_module (6.3)

pub fn chain_module(robot: &Robot) -> ChainModule {
    let link_idx = |name: &str| LinkIdx(robot.link_idx(name) as u32);
    let joints: Vec<JointInChain> = (0..)
        .map(JointIdx)
        .zip(&robot.urdf.joints)
        .map(|(joint_idx, joint)| JointInChain {
            joint_name: joint.name.clone(),
            joint_idx,
            parent_link_name: joint.parent.link.clone(),
            parent_link_idx: link_idx(&joint.parent.link),
            child_link_name: joint.child.link.clone(),
            child_link_idx: link_idx(&joint.child.link),
            joint_type: joint.joint_type,
            origin: pose(&origin(robot, joint)),
            axis: match joint.joint_type {
                JointType::Fixed | JointType::Floating | JointType::Spherical => None,
                _ => Some(unit_axis(joint)),
            },
        })
        .collect();
    let links: Vec<LinkInChain> = (0..)
        .map(LinkIdx)
        .zip(&robot.urdf.links)
        .map(|(link_idx, link)| {
            let above = joints.iter().find(|j| j.child_link_idx == link_idx);
            let below = joints.iter().filter(|j| j.parent_link_idx == link_idx);
            let mut children: Vec<LinkIdx> = below.clone().map(|j| j.child_link_idx).collect();
            children.sort();
            LinkInChain {
                name: link.name.clone(),
                link_idx,
                parent_joint_idx: above.map(|j| j.joint_idx),
                parent_link_idx: above.map(|j| j.parent_link_idx),
                children_joint_idxs: below.map(|j| j.joint_idx).collect(),
                children_link_idxs: children,
            }
        })
        .collect();
    let mut by_depth: BTreeMap<usize, Vec<LinkIdx>> = BTreeMap::new();
    for link in &links {
        let mut depth = 0;
        let mut at = link;
        while let Some(parent) = at.parent_link_idx {
            at = &links[parent.get()];
            depth += 1;
        }
        by_depth.entry(depth).or_default().push(link.link_idx);
    }
    let kinematic_hierarchy: Vec<Vec<LinkIdx>> = by_depth.into_values().collect();
    ChainModule {
        root_idx: kinematic_hierarchy[0][0],
        kinematic_hierarchy,
        joints_in_chain: joints,
        links_in_chain: links,
    }
}

fn unit_axis(joint: &Joint) -> [f64; 3] {
    let axis = joint.axis.as_ref().and_then(|axis| axis.xyz);
    unit(axis.unwrap_or([1.0, 0.0, 0.0]))
}

fn origin(robot: &Robot, joint: &Joint) -> Transform {
    let origin = joint.origin.as_ref();
    let xyz = origin.and_then(|o| o.xyz).unwrap_or_default();
    let rpy = origin.and_then(|o| o.rpy).unwrap_or_default();
    // The URDF versions of test robots in which `quat_xyzw` applies.
    let counts = matches!(robot.urdf.version.as_deref(), Some("1.1" | "1.2"));
    let quaternion = origin.and_then(|o| o.quat_xyzw);
    let quaternion = quaternion.filter(|q| counts && q.iter().any(|c| *c != 0.0));
    let rotation = quaternion.map_or_else(|| rotation_of_rpy(rpy), rotation_of_quaternion);
    transform(rotation, xyz)
}

/// The rotation of a quaternion (x, y, z, w) of any nonzero length.
fn rotation_of_quaternion([x, y, z, w]: [f64; 4]) -> Rotation {
    let s = 2.0 / (x * x + y * y + z * z + w * w);
    [
        [1.0 - s * (y * y + z * z), s * (x * y - z * w), s * (x * z + y * w)],
        [s * (x * y + z * w), 1.0 - s * (x * x + z * z), s * (y * z - x * w)],
        [s * (x * z - y * w), s * (y * z + x * w), 1.0 - s * (x * x + y * y)],
    ]
}

// ---- connections_module (6.4)

pub fn connections_module(chain: &ChainModule) -> ConnectionsModule {
    let every: Vec<LinkIdx> = chain.links_in_chain.iter().map(|l| l.link_idx).collect();
    // From a link up to the root: each link with its parent joint.
    let climb = |from: LinkIdx| {
        let mut up = vec![(from, chain.links_in_chain[from.get()].parent_joint_idx)];
        while let Some(parent) = chain.links_in_chain[up[up.len() - 1].0.get()].parent_link_idx {
            up.push((parent, chain.links_in_chain[parent.get()].parent_joint_idx));
        }
        up
    };
    let ancestor = |i: LinkIdx, j: LinkIdx| {
        let above_j: Vec<LinkIdx> = climb(j).into_iter().map(|(link, _)| link).collect();
        let mut above_i = climb(i).into_iter().map(|(link, _)| link);
        above_i.find(|link| above_j.contains(link)).expect("one root")
    };
    let path = |i: LinkIdx, j: LinkIdx| {
        let top = ancestor(i, j);
        let part = |from: LinkIdx| climb(from).into_iter().take_while(move |(l, _)| *l != top);
        let mut links: Vec<LinkIdx> = part(i).map(|(link, _)| link).collect();
        let mut joints: Vec<JointIdx> = part(i).filter_map(|(_, joint)| joint).collect();
        links.push(top);
        let down: Vec<_> = part(j).collect();
        links.extend(down.iter().rev().map(|(link, _)| *link));
        joints.extend(down.iter().rev().filter_map(|(_, joint)| *joint));
        LinkPath { links, joints }
    };
    let descent = |i: LinkIdx, j: LinkIdx| match () {
        () if i == j => Some(vec![i]),
        () if ancestor(i, j) == i => Some(path(i, j).links[1..].to_vec()),
        () => None,
    };
    let root_paths: Vec<LinkPath> = every.iter().map(|i| path(chain.root_idx, *i)).collect();
    // The depth of a link: the number of joints above it.
    let depth = |link: LinkIdx| root_paths[link.get()].joints.len();
    let lowest_common_ancestors = table(&every, ancestor);
    let of_pair = |i: usize, j: usize| {
        let top = lowest_common_ancestors[i][j];
        depth(every[i]) + depth(every[j]) - 2 * depth(top) + 1
    };
    let all = 0..every.len();
    let in_paths: usize =
        all.clone().map(|i| all.clone().map(|j| of_pair(i, j)).sum::<usize>()).sum();
    let explicit = every.len() <= 300 && in_paths <= 2_000_000;
    ConnectionsModule {
        root_paths,
        lowest_common_ancestors,
        link_to_link_paths: explicit.then(|| table(&every, path)),
        link_connection_paths: explicit.then(|| table(&every, descent)),
    }
}

fn table<T>(every: &[LinkIdx], element: impl Fn(LinkIdx, LinkIdx) -> T) -> Vec<Vec<T>> {
    let row = |i: &LinkIdx| every.iter().map(|j| element(*i, *j)).collect();
    every.iter().map(row).collect()
}

// ---- bounds_module (6.5)

pub fn bounds_module(robot: &Robot, dof: &DofModule) -> BoundsModule {
    let joints: Vec<&Joint> =
        dof.dofs.iter().map(|d| &robot.urdf.joints[d.joint_idx.get()]).collect();
    let ends = |joint: &Joint| joint.limit.as_ref().map_or((None, None), |l| (l.lower, l.upper));
    let dof_limited: Vec<bool> = joints
        .iter()
        .map(|joint| {
            matches!(joint.joint_type, JointType::Revolute | JointType::Prismatic)
                && ends(joint) != (None, None)
        })
        .collect();
    let bounds: Vec<[f64; 2]> = joints
        .iter()
        .zip(&dof.dofs)
        .zip(&dof_limited)
        .map(|((joint, d), limited)| match (limited, d.quantity) {
            (true, _) => [ends(joint).0.unwrap_or(0.0), ends(joint).1.unwrap_or(0.0)],
            (false, Quantity::Angle) => [-PI, PI],
            (false, Quantity::Length) => [-1.0, 1.0],
        })
        .collect();
    let single = |joint: &&Joint| num_dofs(joint.joint_type) == 1;
    let limits = joints.iter().map(|j| j.limit.as_ref().filter(|_| single(j)));
    BoundsModule {
        dof_lower_bounds: bounds.iter().map(|b| b[0]).collect(),
        dof_upper_bounds: bounds.iter().map(|b| b[1]).collect(),
        bounds,
        dof_limited,
        dof_velocity_limits: limits.clone().map(|l| l.and_then(|l| l.velocity)).collect(),
        dof_effort_limits: limits.map(|l| l.and_then(|l| l.effort)).collect(),
    }
}

// ---- kinematics_samples_module (9)

/// Number of sampled configurations in the samples.
pub const NUM_SAMPLED: u32 = 16;

pub fn kinematics_samples_module(robot: &Robot, core: &Core) -> KinematicsSamplesModule {
    let vectors = rotation_vectors(robot, &core.dof);
    let with_vectors = |mut q: Vec<f64>, x: f64| {
        for &i in &vectors {
            q[i..i + 3].copy_from_slice(&[x, 0.0, 0.0]);
        }
        q
    };
    let BoundsModule { bounds, dof_lower_bounds: lower, dof_upper_bounds: upper, .. } =
        &core.bounds;
    let middle = bounds.iter().map(|[l, u]| (l + u) / 2.0).collect();
    let mut configurations = vec![
        (ConfigurationKind::Zero, None, vec![0.0; bounds.len()]),
        (ConfigurationKind::Middle, None, with_vectors(middle, 0.0)),
        (ConfigurationKind::Lower, None, with_vectors(lower.clone(), -PI)),
        (ConfigurationKind::Upper, None, with_vectors(upper.clone(), PI)),
    ];
    for k in 0..NUM_SAMPLED {
        let q = sampled_configuration(robot, core, k);
        configurations.push((ConfigurationKind::Sampled, Some(SampleIdx(k)), q));
    }
    let sample = |(kind, sample_idx, configuration): (_, _, Vec<f64>)| KinematicsSample {
        kind,
        sample_idx,
        link_poses: link_transforms(robot, core, &configuration).iter().map(pose).collect(),
        configuration,
    };
    KinematicsSamplesModule { samples: configurations.into_iter().map(sample).collect() }
}

/// The first DOF of each rotation vector.
fn rotation_vectors(robot: &Robot, dof: &DofModule) -> Vec<usize> {
    let of_joint = dof.joint_idx_to_dof_idxs_mapping.iter();
    of_joint
        .zip(&robot.urdf.joints)
        .filter_map(|(dofs, joint)| match joint.joint_type {
            JointType::Floating => Some(dofs[3].get()),
            JointType::Spherical => Some(dofs[0].get()),
            _ => None,
        })
        .collect()
}

/// Sampled configuration k (9.3).
pub fn sampled_configuration(robot: &Robot, core: &Core, k: u32) -> Vec<f64> {
    let uniform = |i: usize| {
        let index = (u64::from(k) << 32).wrapping_add(i as u64).wrapping_add(1);
        let mut z = index.wrapping_mul(0x9E37_79B9_7F4A_7C15);
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        ((z ^ (z >> 31)) >> 11) as f64 / (1u64 << 53) as f64
    };
    let bounds = core.bounds.bounds.iter().enumerate();
    let mut q: Vec<f64> =
        bounds.map(|(i, [l, h])| l * (1.0 - uniform(i)) + h * uniform(i)).collect();
    for i in rotation_vectors(robot, &core.dof) {
        let [u1, u2, u3] = [uniform(i), uniform(i + 1), uniform(i + 2)];
        let (a, b) = (u1.sqrt(), (1.0 - u1).sqrt());
        let (s2, c2) = (2.0 * PI * u2).sin_cos();
        let (s3, c3) = (2.0 * PI * u3).sin_cos();
        let sign = if a * c3 < 0.0 { -1.0 } else { 1.0 };
        let v = [b * s2, b * c2, a * s3].map(|c| sign * c);
        let angle = 2.0 * norm(v).atan2(sign * a * c3);
        q[i..i + 3].copy_from_slice(&unit(v).map(|c| c * angle));
    }
    q
}

/// The default configuration (9.4): 0, or the bound nearest to 0 if 0 is not between the bounds, in either order; 0 for
/// rotation vectors.
pub fn default_configuration(robot: &Robot, core: &Core) -> Vec<f64> {
    let bounds = core.bounds.bounds.iter();
    let mut q: Vec<f64> = bounds
        .map(|[l, h]| match l.signum() * h.signum() > 0.0 {
            true if l.abs() < h.abs() => *l,
            true => *h,
            false => 0.0,
        })
        .collect();
    for i in rotation_vectors(robot, &core.dof) {
        q[i..i + 3].fill(0.0);
    }
    q
}

/// The transform of every link in the root's frame (9.1), computed from the URDF.
pub fn link_transforms(robot: &Robot, core: &Core, q: &[f64]) -> Vec<Transform> {
    let place = |mut at: usize| {
        // From the link up to the root, premultiply by each joint's transform.
        let mut total = IDENTITY;
        while let Some(joint) = core.chain.links_in_chain[at].parent_joint_idx {
            let moved = product(&origin(robot, &robot.urdf.joints[joint.get()]), &{
                motion(robot, core, joint, q)
            });
            total = product(&moved, &total);
            at = core.chain.joints_in_chain[joint.get()].parent_link_idx.get();
        }
        total
    };
    (0..robot.urdf.links.len()).map(place).collect()
}

fn motion(robot: &Robot, core: &Core, joint_idx: JointIdx, q: &[f64]) -> Transform {
    let joint = &robot.urdf.joints[joint_idx.get()];
    let dofs = &core.dof.joint_idx_to_dof_idxs_mapping[joint_idx.get()];
    let mut own: Vec<f64> = dofs.iter().map(|d| q[d.get()]).collect();
    if let Some(mimic) = &core.dof.joint_idx_to_mimic_mapping[joint_idx.get()] {
        let driver = mimic.dof_idx.map_or(0.0, |d| q[d.get()]);
        own = vec![mimic.multiplier * driver + mimic.offset];
    }
    const STILL: Rotation = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    match joint.joint_type {
        JointType::Fixed => IDENTITY,
        JointType::Revolute | JointType::Continuous => {
            transform(rotation_about(unit_axis(joint), own[0]), [0.0; 3])
        }
        JointType::Prismatic => transform(STILL, unit_axis(joint).map(|c| c * own[0])),
        JointType::Planar => {
            let axis = unit_axis(joint);
            let basis = shortest_arc_from_z(axis);
            let shift = [0, 1, 2].map(|row| own[0] * basis[row][0] + own[1] * basis[row][1]);
            transform(rotation_about(axis, own[2]), shift)
        }
        JointType::Floating => {
            transform(rotation_by_vector([own[3], own[4], own[5]]), [own[0], own[1], own[2]])
        }
        JointType::Spherical => transform(rotation_by_vector([own[0], own[1], own[2]]), [0.0; 3]),
    }
}

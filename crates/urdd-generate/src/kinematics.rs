//! The modules that follow from the robot's tree and limits: DOFs (SPEC 6.2), the chain (6.3), connections (6.4), bounds (6.5)
//! and kinematics samples (9.2).

use std::f64::consts::PI;

use urdd_format::bounds::BoundsModule;
use urdd_format::chain::{ChainModule, JointInChain, LinkInChain};
use urdd_format::connections::{ConnectionsModule, LinkPath};
use urdd_format::dof::{Dof, DofModule, Quantity, ResolvedMimic};
use urdd_format::index::{Count, DofIdx, JointIdx, LinkIdx, SampleIdx};
use urdd_format::kinematics_samples::{
    ConfigurationKind, KinematicsSample, KinematicsSamplesModule,
};
use urdd_format::short::Short;
use urdd_format::urdf::{JointType, UrdfModule};
use urdd_kinematics::pose::from_isometry;
use urdd_kinematics::rotation::unit_axis;
use urdd_kinematics::{ConfigurationError, ConfigurationSpace, ForwardKinematics, has_axis};
use urdd_source::fault::Fault;
use urdd_source::origin;
use urdd_source::urdf::{Tree, written_axis};

/// The name suffix and the quantity of each DOF of a joint (SPEC 5.8).
fn dofs_of(joint_type: JointType) -> Vec<(&'static str, Quantity)> {
    use Quantity::{Angle, Length};
    let translations = [("/trans_x", Length), ("/trans_y", Length), ("/trans_z", Length)];
    let rotations = [("/rot_x", Angle), ("/rot_y", Angle), ("/rot_z", Angle)];
    match joint_type {
        JointType::Fixed => Vec::new(),
        JointType::Revolute | JointType::Continuous => vec![("", Angle)],
        JointType::Prismatic => vec![("", Length)],
        JointType::Planar => [&translations[..2], &[("/rot", Angle)]].concat(),
        JointType::Floating => [translations, rotations].concat(),
        JointType::Spherical => rotations.to_vec(),
    }
}

/// Builds the module.
/// Fails if the multipliers or offsets along a chain of mimic joints overflow binary64.
pub(super) fn dof_module(robot: &UrdfModule, tree: &Tree) -> Result<DofModule, Fault> {
    let mut dofs = Vec::new();
    let mut joint_to_dofs = Vec::with_capacity(robot.joints.len());
    for (joint_idx, joint) in (0..).zip(&robot.joints) {
        let first = dofs.len();
        if joint.mimic.is_none() {
            for (suffix, quantity) in dofs_of(joint.joint_type) {
                dofs.push(Dof {
                    name: format!("{}{suffix}", joint.name),
                    joint_idx: JointIdx(joint_idx),
                    joint_name: joint.name.clone(),
                    quantity,
                });
            }
        }
        joint_to_dofs.push((first..dofs.len()).map(|dof| DofIdx(dof as u32)).collect::<Vec<_>>());
    }
    let mimics = resolve(robot, tree, &joint_to_dofs)?;
    Ok(DofModule {
        num_dofs: Count(dofs.len() as u32),
        dof_idx_to_joint_idx_mapping: dofs.iter().map(|dof| dof.joint_idx).collect(),
        joint_idx_to_dof_idxs_mapping: joint_to_dofs,
        joint_idx_to_mimic_mapping: mimics,
        dofs,
    })
}

/// Follows chains of mimic joints to a joint that is not a mimic joint, or is fixed (SPEC 5.10).
fn resolve(
    robot: &UrdfModule,
    tree: &Tree,
    joint_to_dofs: &[Vec<DofIdx>],
) -> Result<Vec<Option<ResolvedMimic>>, Fault> {
    let is_fixed = |idx: usize| robot.joints[idx].joint_type == JointType::Fixed;
    let mut resolved: Vec<Option<ResolvedMimic>> = vec![None; robot.joints.len()];
    for start in 0..robot.joints.len() {
        let mut chain = Vec::new();
        let mut end = start;
        while let (Some(mimic), false, None) =
            (&robot.joints[end].mimic, is_fixed(end), &resolved[end])
        {
            chain.push((end, mimic));
            match tree.drivers[end] {
                Some(driver) => end = driver,
                None => break,
            }
        }
        let mut driver = resolved[end].clone().unwrap_or(ResolvedMimic {
            dof_idx: joint_to_dofs[end].first().copied(),
            multiplier: 1.0,
            offset: 0.0,
        });
        // From the far end of the chain: m1 (m2 q + o2) + o1 is (m1 m2) q + (m1 o2 + o1).
        for (idx, mimic) in chain.into_iter().rev() {
            let multiplier = mimic.multiplier.unwrap_or(1.0);
            let offset = mimic.offset.unwrap_or(0.0);
            driver = ResolvedMimic {
                dof_idx: driver.dof_idx,
                multiplier: multiplier * driver.multiplier,
                offset: multiplier * driver.offset + offset,
            };
            if !(driver.multiplier.is_finite() && driver.offset.is_finite()) {
                return Err(Fault::MimicOverflow((&*robot.joints[idx].name).into()));
            }
            resolved[idx] = Some(driver.clone());
        }
    }
    Ok(resolved)
}

pub(super) fn bounds_module(robot: &UrdfModule, dof: &DofModule) -> BoundsModule {
    let mut module = BoundsModule {
        bounds: Vec::new(),
        dof_lower_bounds: Vec::new(),
        dof_upper_bounds: Vec::new(),
        dof_limited: Vec::new(),
        dof_velocity_limits: Vec::new(),
        dof_effort_limits: Vec::new(),
    };
    for dof in &dof.dofs {
        let joint = &robot.joints[dof.joint_idx.get()];
        let limit = joint.limit.as_ref();
        let kind = joint.joint_type;
        let can_be_limited = matches!(kind, JointType::Revolute | JointType::Prismatic);
        let written = limit
            .filter(|limit| can_be_limited && (limit.lower.is_some() || limit.upper.is_some()));
        let [lower, upper] = match (written, dof.quantity) {
            (Some(limit), _) => [limit.lower.unwrap_or(0.0), limit.upper.unwrap_or(0.0)],
            (None, Quantity::Angle) => [-PI, PI],
            (None, Quantity::Length) => [-1.0, 1.0],
        };
        let of_one_dof = limit.filter(|_| can_be_limited || kind == JointType::Continuous);
        module.bounds.push([lower, upper]);
        module.dof_lower_bounds.push(lower);
        module.dof_upper_bounds.push(upper);
        module.dof_limited.push(written.is_some());
        let velocity = of_one_dof.and_then(|limit| limit.velocity);
        let effort = of_one_dof.and_then(|limit| limit.effort);
        module.dof_velocity_limits.push(velocity);
        module.dof_effort_limits.push(effort);
    }
    module
}

pub fn chain_module(robot: &UrdfModule, tree: &Tree) -> ChainModule {
    let mut links: Vec<LinkInChain> = (0..)
        .zip(&robot.links)
        .map(|(idx, link)| LinkInChain {
            name: link.name.clone(),
            link_idx: LinkIdx(idx),
            parent_joint_idx: None,
            parent_link_idx: None,
            children_joint_idxs: Vec::new(),
            children_link_idxs: Vec::new(),
        })
        .collect();
    let quaternions = origin::has_quaternions(robot.version.as_deref());
    let mut joints = Vec::with_capacity(robot.joints.len());
    for ((joint_idx, joint), [parent, child]) in (0..).zip(&robot.joints).zip(&tree.ends) {
        let joint_idx = JointIdx(joint_idx);
        let [parent_idx, child_idx] = [parent, child].map(|link| LinkIdx(*link as u32));
        links[*parent].children_joint_idxs.push(joint_idx);
        links[*parent].children_link_idxs.push(child_idx);
        links[*child].parent_joint_idx = Some(joint_idx);
        links[*child].parent_link_idx = Some(parent_idx);
        let axis = unit_axis(written_axis(joint)).filter(|_| has_axis(joint.joint_type));
        joints.push(JointInChain {
            joint_name: joint.name.clone(),
            joint_idx,
            parent_link_name: joint.parent.link.clone(),
            parent_link_idx: parent_idx,
            child_link_name: joint.child.link.clone(),
            child_link_idx: child_idx,
            joint_type: joint.joint_type,
            origin: from_isometry(&origin::of(joint.origin.as_ref(), quaternions)),
            axis: axis.map(|axis| axis.into_inner().into()),
        });
    }
    for link in &mut links {
        // Joints are in order; their child links may not be.
        link.children_link_idxs.sort();
    }
    let kinematic_hierarchy = hierarchy(&links, tree.root);
    ChainModule {
        links_in_chain: links,
        joints_in_chain: joints,
        kinematic_hierarchy,
        root_idx: LinkIdx(tree.root as u32),
    }
}

fn hierarchy(links: &[LinkInChain], root: usize) -> Vec<Vec<LinkIdx>> {
    let mut levels = Vec::new();
    let mut level = vec![LinkIdx(root as u32)];
    while !level.is_empty() {
        let below = level.iter().flat_map(|link| &links[link.get()].children_link_idxs);
        let mut next: Vec<LinkIdx> = below.copied().collect();
        next.sort();
        levels.push(std::mem::replace(&mut level, next));
    }
    levels
}

/// Maximum number of links with which the path of every pair is written (SPEC 6.4.6).
pub const MOST_LINKS_WITH_PAIRS: usize = 300;

/// Maximum total number of links in the paths of all pairs.
pub const MOST_LINKS_IN_PAIRS: usize = 2_000_000;

/// Builds the module. Its size grows with links × depth and with links².
pub fn connections_module(chain: &ChainModule) -> ConnectionsModule {
    let root_paths = root_paths(chain);
    let ancestors = lowest_common_ancestors(chain, &root_paths);
    let with_pairs = chain.links_in_chain.len() <= MOST_LINKS_WITH_PAIRS
        && links_in_pairs(chain) <= MOST_LINKS_IN_PAIRS;
    let pairs = with_pairs.then(|| {
        let paths = root_paths.iter().zip(&ancestors);
        paths
            .map(|(from, row)| {
                let to = root_paths.iter().zip(row);
                to.map(|(to, ancestor)| path(from, to, *ancestor)).collect()
            })
            .collect()
    });
    let descents = with_pairs.then(|| descents(&root_paths));
    ConnectionsModule {
        root_paths,
        lowest_common_ancestors: ancestors,
        link_to_link_paths: pairs,
        link_connection_paths: descents,
    }
}

fn root_paths(chain: &ChainModule) -> Vec<LinkPath> {
    let mut paths =
        vec![LinkPath { links: Vec::new(), joints: Vec::new() }; chain.links_in_chain.len()];
    for idx in chain.kinematic_hierarchy.iter().flatten() {
        let link = &chain.links_in_chain[idx.get()];
        let mut path = match (link.parent_link_idx, link.parent_joint_idx) {
            (Some(parent), Some(joint)) => {
                let mut path = paths[parent.get()].clone();
                path.joints.push(joint);
                path
            }
            _ => paths[idx.get()].clone(),
        };
        path.links.push(*idx);
        paths[idx.get()] = path;
    }
    paths
}

/// The total number of links in the paths of all pairs. Each path has its first link, and one more for each joint on
/// it. A joint with s links below it is on every path between one of these and one of the others.
pub fn links_in_pairs(chain: &ChainModule) -> usize {
    let all = chain.links_in_chain.len();
    let mut below = vec![1; all];
    let mut links = all * all;
    for idx in chain.kinematic_hierarchy.iter().flatten().rev() {
        if let Some(parent) = chain.links_in_chain[idx.get()].parent_link_idx {
            let own = below[idx.get()];
            below[parent.get()] += own;
            links += 2 * own * (all - own);
        }
    }
    links
}

/// Row i is filled from the root downwards: a link on the path to i is its own common ancestor with i; any other link
/// has that of its parent.
fn lowest_common_ancestors(chain: &ChainModule, root_paths: &[LinkPath]) -> Vec<Vec<LinkIdx>> {
    let rows = root_paths.iter().map(|path| {
        let mut row = vec![chain.root_idx; root_paths.len()];
        let mut on_path = vec![false; root_paths.len()];
        for link in &path.links {
            on_path[link.get()] = true;
        }
        for idx in chain.kinematic_hierarchy.iter().flatten() {
            let parent = chain.links_in_chain[idx.get()].parent_link_idx;
            row[idx.get()] = match parent {
                _ if on_path[idx.get()] => *idx,
                Some(parent) => row[parent.get()],
                None => *idx,
            };
        }
        row
    });
    rows.collect()
}

/// The path up from one link to the common ancestor and down to the other.
fn path(from: &LinkPath, to: &LinkPath, ancestor: LinkIdx) -> LinkPath {
    let depth = from.links.iter().position(|link| *link == ancestor).unwrap_or_default();
    let links_up = from.links[depth..].iter().rev();
    let joints_up = from.joints[depth..].iter().rev();
    let links: Vec<LinkIdx> = links_up.chain(&to.links[depth + 1..]).copied().collect();
    let joints: Vec<JointIdx> = joints_up.chain(&to.joints[depth..]).copied().collect();
    LinkPath { links, joints }
}

/// The published table: the links below i down to j if j is a descendant of i.
fn descents(root_paths: &[LinkPath]) -> Vec<Vec<Option<Vec<LinkIdx>>>> {
    let row = |from: usize| {
        let to = root_paths.iter().enumerate();
        to.map(|(to, path)| {
            let own = LinkIdx(from as u32);
            let depth = path.links.iter().position(|link| *link == own)?;
            if to == from { Some(vec![own]) } else { Some(path.links[depth + 1..].to_vec()) }
        })
        .collect()
    };
    (0..root_paths.len()).map(row).collect()
}

/// Number of sampled configurations in the module, besides the four others: enough that a consumer with a wrong sign or
/// order cannot pass by chance, and few enough to read.
const NUM_SAMPLED: u32 = 16;

/// Builds the module, unless a link's pose overflows binary64.
pub(super) fn kinematics_samples_module(
    space: &ConfigurationSpace,
    kinematics: &ForwardKinematics,
    chain: &ChainModule,
) -> Result<KinematicsSamplesModule, Fault> {
    use ConfigurationKind::{Lower, Middle, Sampled, Upper, Zero};
    let named = [
        (Zero, None, space.zero()),
        (Middle, None, space.middle()),
        (Lower, None, space.lower()),
        (Upper, None, space.upper()),
    ];
    let sampled =
        (0..NUM_SAMPLED).map(|k| (Sampled, Some(SampleIdx(k)), space.sampled(u64::from(k))));
    let samples = named.into_iter().chain(sampled).map(|(kind, sample_idx, configuration)| {
        let poses = kinematics.link_poses(&configuration);
        let poses = poses.map_err(|error| no_poses(kind, &error, chain))?;
        let link_poses = poses.iter().map(from_isometry).collect();
        Ok(KinematicsSample { kind, sample_idx, configuration, link_poses })
    });
    Ok(KinematicsSamplesModule { samples: samples.collect::<Result<_, _>>()? })
}

/// The fault of a robot whose poses cannot be computed in a configuration; names the joint above the link where it
/// shows.
fn no_poses(kind: ConfigurationKind, error: &ConfigurationError, chain: &ChainModule) -> Fault {
    let ConfigurationError::Overflow { link_idx } = error else {
        return Fault::NoPoses(format!("{kind}: {error}"));
    };
    let mut joints = chain.joints_in_chain.iter();
    let joint = joints.find(|joint| joint.child_link_idx.get() == *link_idx);
    Fault::PosesTooLarge {
        joint: joint.map_or_else(Short::default, |joint| Short::of(&joint.joint_name)),
        configuration: kind.to_string(),
    }
}

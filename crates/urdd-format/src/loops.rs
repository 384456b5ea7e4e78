//! `loops_module`: what closes the kinematic loops of a robot that is no tree. Since version 1.1 of the specification.

use super::index::{DofIdx, LinkIdx, SampleIdx};
use super::pose::Pose;
use super::types::module;

module! {
    /// What closes the kinematic loops of a robot, and couplings between its DOFs. The links and joints of the other modules
    /// are its spanning tree.
    pub struct LoopsModule {
        /// The loops.
        pub loops: Vec<Loop>,
        /// Equations between DOFs, such as gears between joints of different branches.
        pub couplings: Vec<Coupling>,
        /// The DOFs that move freely, ascending; the others follow from them. Their number is the mobility at the reference
        /// configuration.
        pub independent_dof_idxs: Vec<DofIdx>,
        /// A configuration in which all loops are closed and all couplings hold: one value per DOF, rad or m.
        pub reference_configuration: Vec<f64> where { unit: "rad or m", length: "dofs" },
        /// Sampled configurations that are closed, numbered from 0 without gaps.
        pub closed_samples: Vec<ClosedSample>,
    }

    /// What holds two links together besides the joints of the tree.
    pub struct Loop {
        /// Its name; unique among loops and couplings.
        pub name: String,
        /// Which numbers of the pose of frame B in frame A are held.
        pub kind: LoopKind,
        /// The link that frame A is fixed to.
        pub link_a_idx: LinkIdx,
        /// Frame A, in that link's frame.
        pub frame_a: Pose where { frame: "link" },
        /// The link that frame B is fixed to: another one.
        pub link_b_idx: LinkIdx,
        /// Frame B, in that link's frame.
        pub frame_b: Pose where { frame: "link" },
        /// How far the held position may be off where the loop counts as closed, m: the precision of the source. Not
        /// negative.
        pub position_tolerance: f64 where { unit: "m" },
        /// How far the held rotation may be off there, rad. Not negative.
        pub rotation_tolerance: f64 where { unit: "rad" },
    }

    /// What a loop holds. The axes are those of its frames: z is the axis of a hinge, slide or plane.
    pub enum LoopKind {
        /// Position and rotation: a weld.
        Fixed,
        /// The position, and the direction of z: a hinge about z.
        Revolute,
        /// The position along x and y, and the rotation: a slide along z.
        Prismatic,
        /// The position along x and y, and the direction of z: a hinge about z that slides along it.
        Cylindrical,
        /// The position, and the right angle between z of both frames: a universal joint.
        Universal,
        /// The position: a ball.
        Spherical,
        /// The position along z, and the direction of z: frame B moves in the x-y plane of frame A.
        Planar,
    }

    /// An equation between DOFs: the constant and all terms add up to 0.
    pub struct Coupling {
        /// Its name; unique among loops and couplings.
        pub name: String,
        /// The constant.
        pub constant: f64 where { unit: "rad or m" },
        /// One term for each DOF, in DOF order.
        pub terms: Vec<CouplingTerm>,
    }

    /// What a DOF adds to the sum of a coupling: c1 q + c2 q^2 + c3 q^3 + c4 q^4.
    pub struct CouplingTerm {
        /// The DOF.
        pub dof_idx: DofIdx,
        /// c1, c2, c3 and c4.
        pub coefficients: [f64; 4] where {
            unit: "1 or rad/m or m/rad or 1/rad or 1/m or rad/m^2 or m/rad^2 or 1/rad^2 or 1/m^2 or rad/m^3 or m/rad^3 or 1/rad^3 or 1/m^3 or rad/m^4 or m/rad^4"
        },
    }

    /// A closed configuration whose independent DOFs have the values of a sampled configuration.
    pub struct ClosedSample {
        /// The number of the sampled configuration.
        pub sample_idx: SampleIdx,
        /// One value per DOF, rad or m; null where none was found that is closed.
        pub configuration: Option<Vec<f64>> where { unit: "rad or m", length: "dofs" },
    }
}

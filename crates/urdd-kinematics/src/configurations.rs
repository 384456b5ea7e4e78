//! The configurations that the specification defines, identical for every producer and validator in any language; and
//! batches of configurations.

use std::f64::consts::PI;

use rayon::prelude::*;

use super::error::KinematicsError;
use super::joint::{check_lengths, joint_dofs};
use super::rotation::{to_rotation_vector, uniform_rotation};
use urdd_format::chain::ChainModule;
use urdd_format::dof::DofModule;
use urdd_format::urdf::JointType;

/// Pseudo-random number `i` of sample `k`, in [0, 1), identical on every platform.
///
/// It is output `k * 2^32 + i` of the generator SplitMix64 with seed 0; its upper 53 bits are read as a binary
/// fraction. All integers have 64 bits and wrap.
pub fn unit(k: u64, i: u64) -> f64 {
    (bits(k, i) >> 11) as f64 * (0.5_f64).powi(53)
}

/// Output `k * 2^32 + i` of SplitMix64 with seed 0, counted from 0.
pub fn bits(k: u64, i: u64) -> u64 {
    let count = (k << 32).wrapping_add(i).wrapping_add(1);
    let mut z = count.wrapping_mul(0x9E37_79B9_7F4A_7C15);
    z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
    z ^ (z >> 31)
}

/// The configurations of a robot that the specification defines.
///
/// The last three DOFs of a floating joint and the three of a spherical one form a rotation vector. Its bounds contain
/// all rotations, and it is handled as a unit. No value is negative zero.
#[derive(Debug, Clone)]
pub struct ConfigurationSpace {
    bounds: Vec<[f64; 2]>,
    rotation_vectors: Vec<[usize; 3]>,
}

impl ConfigurationSpace {
    /// Builds the configuration space from two modules and the `bounds` of a `bounds_module`. Each pair may be in
    /// either order; all bounds must be finite.
    pub fn new(
        dof: &DofModule,
        chain: &ChainModule,
        bounds: &[[f64; 2]],
    ) -> Result<Self, KinematicsError> {
        check_lengths(chain, dof)?;
        let (expected, found) = (dof.num_dofs.get(), bounds.len());
        if found != expected {
            let fault =
                format!("{found} entries, expected {expected}: one for each DOF of dof_module");
            return Err(KinematicsError::bounds("/bounds", fault));
        }
        for (i, pair) in bounds.iter().enumerate() {
            if let Some(end) = pair.iter().position(|bound| !bound.is_finite()) {
                let fault = format!("{} is not a finite number", pair[end]);
                return Err(KinematicsError::bounds(format!("/bounds/{i}/{end}"), fault));
            }
        }
        let mut rotation_vectors = Vec::new();
        for (idx, joint) in chain.joints_in_chain.iter().enumerate() {
            if matches!(joint.joint_type, JointType::Floating | JointType::Spherical) {
                let dofs = joint_dofs(joint.joint_type, idx, dof)?;
                rotation_vectors.extend(dofs.last_chunk().copied());
            }
        }
        Ok(Self { bounds: bounds.to_vec(), rotation_vectors })
    }

    /// Number of DOFs, which is the length of each configuration.
    pub fn num_dofs(&self) -> usize {
        self.bounds.len()
    }

    /// The bounds of each DOF; a pair may be in either order.
    pub fn bounds(&self) -> &[[f64; 2]] {
        &self.bounds
    }

    /// The same robot with other bounds; `None` unless there is one finite pair for each DOF.
    pub fn with_bounds(&self, bounds: &[[f64; 2]]) -> Option<Self> {
        let finite = bounds.as_flattened().iter().all(|bound| bound.is_finite());
        (finite && bounds.len() == self.bounds.len()).then(|| Self {
            bounds: bounds.to_vec(),
            rotation_vectors: self.rotation_vectors.clone(),
        })
    }

    /// The three DOFs of each rotation vector: the last three of floating joints, all of spherical ones.
    pub fn rotation_vectors(&self) -> &[[usize; 3]] {
        &self.rotation_vectors
    }

    /// All DOFs 0, even if 0 is out of bounds; Pinocchio's *neutral configuration*.
    pub fn zero(&self) -> Vec<f64> {
        vec![0.0; self.bounds.len()]
    }

    /// The default configuration: every DOF 0, or the bound nearest to 0 if 0 is out of bounds. Rotation vectors are
    /// (0, 0, 0).
    pub fn default_configuration(&self) -> Vec<f64> {
        let nearest_to_zero = |[a, b]: [f64; 2]| 0.0_f64.max(f64::min(a, b)).min(f64::max(a, b));
        self.build(|_, pair| nearest_to_zero(pair), |_| [0.0; 3])
    }

    /// Every DOF at the middle of its bounds: `lower/2 + upper/2`. This cannot overflow, is 0 for symmetric bounds, and
    /// equals the bound if both are equal. Rotation vectors are (0, 0, 0).
    pub fn middle(&self) -> Vec<f64> {
        self.build(|_, [lower, upper]| lower / 2.0 + upper / 2.0, |_| [0.0; 3])
    }

    /// Every DOF at its lower bound; rotation vectors are (-pi, 0, 0).
    pub fn lower(&self) -> Vec<f64> {
        self.build(|_, [lower, _]| lower, |_| [-PI, 0.0, 0.0])
    }

    /// Every DOF at its upper bound; rotation vectors are (pi, 0, 0).
    pub fn upper(&self) -> Vec<f64> {
        self.build(|_, [_, upper]| upper, |_| [PI, 0.0, 0.0])
    }

    /// Sampled configuration `k`, with `u(i)` = [`unit()`]`(k, i)` for DOF `i`:
    /// `q = lower * (1 - u(i)) + upper * u(i)`, which cannot overflow. A rotation vector is that of the
    /// [`uniform_rotation`] from the `u(i)` of its three DOFs, in order.
    pub fn sampled(&self, k: u64) -> Vec<f64> {
        self.build(
            |i, pair| between(pair, unit(k, i as u64)),
            |dofs| to_rotation_vector(&uniform_rotation(dofs.map(|i| unit(k, i as u64)))),
        )
    }

    fn build(
        &self,
        value: impl Fn(usize, [f64; 2]) -> f64,
        rotation_vector: impl Fn([usize; 3]) -> [f64; 3],
    ) -> Vec<f64> {
        let pairs = self.bounds.iter().enumerate();
        let mut configuration: Vec<f64> = pairs.map(|(i, pair)| value(i, *pair) + 0.0).collect();
        for dofs in &self.rotation_vectors {
            for (i, component) in dofs.iter().zip(rotation_vector(*dofs)) {
                configuration[*i] = component;
            }
        }
        configuration
    }
}

fn between([lower, upper]: [f64; 2], u: f64) -> f64 {
    lower * (1.0 - u) + upper * u
}

/// Writes the results of a batch of configurations, `width` values each, into `out`, in blocks of `block`
/// configurations on rayon's thread pool. `write` gets the scratch state that a block shares, the index of the
/// configuration and its part of `out`. A single block is written on the caller's thread. Apart from the state and
/// `write`, nothing allocates.
///
/// # Errors
/// The error of `write` for the first configuration that fails. Results after it may then be missing.
pub fn fill<T: Send, S: Default, E: Send>(
    out: &mut [T],
    width: usize,
    block: usize,
    write: impl Fn(&mut S, usize, &mut [T]) -> Result<(), E> + Sync,
) -> Result<(), E> {
    if width == 0 {
        return Ok(());
    }
    let write_block = |(number, out): (usize, &mut [T])| {
        let mut shared = S::default();
        let mut each = out.chunks_mut(width).enumerate();
        each.find_map(|(k, row)| write(&mut shared, number * block + k, row).err())
    };
    let size = width.saturating_mul(block);
    let error = match out.len() <= size {
        true => write_block((0, out)),
        false => (out.par_chunks_mut(size).enumerate()).find_map_first(write_block),
    };
    error.map_or(Ok(()), Err)
}

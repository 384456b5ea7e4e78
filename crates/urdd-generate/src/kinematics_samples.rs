//! `kinematics_samples_module` from chain, DOFs and bounds: SPEC 9.2.

use thiserror::Error;

use urdd_format::bounds::BoundsModule;
use urdd_format::chain::ChainModule;
use urdd_format::dof::DofModule;
use urdd_format::index::SampleIdx;
use urdd_format::kinematics_samples::{
    ConfigurationKind, KinematicsSample, KinematicsSamplesModule,
};
use urdd_kinematics::pose::from_isometry;
use urdd_kinematics::{ConfigurationError, ConfigurationSpace, ForwardKinematics, KinematicsError};

/// Number of sampled configurations in the module, besides the four others: enough that a consumer with a wrong sign or
/// order cannot pass by chance, and few enough to read.
pub const NUM_SAMPLED: u32 = 16;

/// Why there are no samples: numbers overflow binary64.
#[derive(Debug, Error)]
pub(super) enum SamplesError {
    #[error(transparent)]
    Robot(#[from] KinematicsError),
    #[error("{kind}: {error}")]
    Sample { kind: ConfigurationKind, error: ConfigurationError },
}

/// Builds the module.
///
/// # Errors
/// If a link's pose overflows binary64.
pub(super) fn kinematics_samples_module(
    dof: &DofModule,
    chain: &ChainModule,
    bounds: &BoundsModule,
) -> Result<KinematicsSamplesModule, SamplesError> {
    use ConfigurationKind::{Lower, Middle, Sampled, Upper, Zero};
    let space = ConfigurationSpace::new(dof, chain, &bounds.bounds)?;
    let kinematics = ForwardKinematics::new(chain, dof)?;
    let named = [
        (Zero, None, space.zero()),
        (Middle, None, space.middle()),
        (Lower, None, space.lower()),
        (Upper, None, space.upper()),
    ];
    let sampled =
        (0..NUM_SAMPLED).map(|k| (Sampled, Some(SampleIdx(k)), space.sampled(u64::from(k))));
    let samples = named.into_iter().chain(sampled).map(|(kind, sample_idx, configuration)| {
        let poses = kinematics
            .link_poses(&configuration)
            .map_err(|error| SamplesError::Sample { kind, error })?;
        Ok(KinematicsSample {
            kind,
            sample_idx,
            configuration,
            link_poses: poses.iter().map(from_isometry).collect(),
        })
    });
    Ok(KinematicsSamplesModule { samples: samples.collect::<Result<_, SamplesError>>()? })
}

//! `kinematics_samples_module` from chain, DOFs and bounds: SPEC 9.2.

use urdd_format::chain::ChainModule;
use urdd_format::index::SampleIdx;
use urdd_format::kinematics_samples::{
    ConfigurationKind, KinematicsSample, KinematicsSamplesModule,
};
use urdd_format::short::Short;
use urdd_kinematics::pose::from_isometry;
use urdd_kinematics::{ConfigurationError, ConfigurationSpace, ForwardKinematics};
use urdd_source::fault::Fault;

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

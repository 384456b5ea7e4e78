//! What the files of a package have in common.

use super::hardware::Hardware;
use crate::groups::joints_of;
use crate::names::FileNames;
use crate::{ExportError, Members, MoveitOptions, Setup, Subject};
use urdd_format::named_configurations::NamedConfiguration;
use urdd_format::urdf::Limit;

/// What the files of the package have in common.
pub(super) struct Config<'a> {
    pub subject: &'a Subject<'a>,
    pub options: &'a MoveitOptions,
    pub setup: &'a Setup,
    /// The name of files.
    pub name: String,
    /// The joints of each group that move, in joint order.
    pub joints: Vec<Vec<usize>>,
    pub configurations: &'a [NamedConfiguration],
    dofs: Vec<Option<usize>>,
    pub default: Vec<f64>,
    pub hardware: Hardware,
}

impl<'a> Config<'a> {
    pub fn new(
        subject: &'a Subject<'a>,
        options: &'a MoveitOptions,
        setup: &'a Setup,
    ) -> Result<Self, ExportError> {
        let groups = 0..setup.groups.len();
        let joints: Vec<_> = groups.map(|group| joints_of(setup, group, subject)).collect();
        Ok(Config {
            hardware: Hardware::new(subject, setup, &joints),
            subject,
            options,
            setup,
            name: FileNames::default().of(&subject.urdf.name),
            joints,
            configurations: subject.robot.named_configurations()?,
            dofs: subject.dofs()?,
            default: subject.robot.configurations()?.zero(),
        })
    }

    pub fn joint(&self, joint: usize) -> &str {
        &self.subject.view.joints[joint].name
    }

    /// The position of a joint of one DOF in a configuration.
    pub fn position(&self, configuration: &[f64], joint: usize) -> f64 {
        self.dofs[joint].map_or(0.0, |dof| configuration[dof])
    }

    /// The groups that are chains, for which inverse kinematics can be solved.
    pub fn chains(&self) -> impl Iterator<Item = usize> {
        let groups = self.setup.groups.iter().enumerate();
        groups
            .filter(|(_, group)| matches!(group.value.members, Members::Chain { .. }))
            .map(|(place, _)| place)
    }

    /// The groups with controllers, each with its joints of one DOF: none that another group has.
    pub fn controlled(&self) -> Vec<(usize, Vec<usize>)> {
        let mut taken = vec![false; self.subject.view.joints.len()];
        let mut controlled = Vec::new();
        for (place, group) in self.setup.groups.iter().enumerate() {
            let joints = self.joints[place].iter().copied();
            let joints: Vec<usize> =
                joints.filter(|joint| self.subject.is_driven(*joint)).collect();
            let is_new = !joints.is_empty() && joints.iter().all(|joint| !taken[*joint]);
            if is_new && !group.value.passive {
                joints.iter().for_each(|joint| taken[*joint] = true);
                controlled.push((place, joints));
            }
        }
        controlled
    }

    /// The limits of a joint: velocity, acceleration and jerk. Those of `[limits]` where the URDF has none.
    pub fn limits(&self, joint: usize) -> [Option<f64>; 3] {
        let source = self.subject.urdf.joints[joint].limit.as_ref();
        let positive = |value: Option<f64>| value.filter(|value| *value > 0.0 && value.is_finite());
        let of = |value: fn(&Limit) -> Option<f64>| positive(source.and_then(value));
        [
            of(|limit| limit.velocity),
            of(|limit| limit.acceleration).or(self.setup.acceleration),
            of(|limit| limit.jerk).or(self.setup.jerk),
        ]
    }

    /// Says that a file was made, and of what.
    pub fn comments(&self, what: &str) -> Result<Vec<String>, ExportError> {
        let mut lines = self.subject.origin()?;
        lines.push(what.to_owned());
        Ok(lines)
    }
}

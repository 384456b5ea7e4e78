//! What the files of a package have in common.

use super::super::error::ExportError;
use super::super::groups::joints_of;
use super::super::names::FileNames;
use super::super::options::MoveitOptions;
use super::super::setup::{Members, Setup};
use super::super::subject::Subject;
use urdd_format::named_configurations::NamedConfiguration;
use urdd_xml::number::number;
use urdd_xml::writer::Element;

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
}

impl<'a> Config<'a> {
    pub fn new(
        subject: &'a Subject<'a>,
        options: &'a MoveitOptions,
        setup: &'a Setup,
    ) -> Result<Self, ExportError> {
        let groups = 0..setup.groups.len();
        Ok(Config {
            subject,
            options,
            setup,
            name: FileNames::default().of(&subject.urdf.name),
            joints: groups.map(|group| joints_of(setup, group, subject)).collect(),
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

    /// Whether the source has `<ros2_control>` of its own.
    pub fn has_hardware(&self) -> bool {
        let texts = &self.subject.urdf.unknown_elements;
        texts.iter().any(|text| {
            let document = urdd_xml::parse(text, urdd_xml::Kind::Other);
            document.is_ok_and(|document| document.root_element().has_tag_name("ros2_control"))
        })
    }

    /// Simulated hardware that does what it is told, for the launch file.
    pub fn hardware(&self) -> Element {
        let plugin = Element::text("plugin", "mock_components/GenericSystem");
        let mut hardware = Element::new("ros2_control")
            .with("name", "mock_hardware")
            .with("type", "system")
            .holding(Element::new("hardware").holding(plugin));
        let configuration = self.configurations.first();
        let configuration = configuration.map_or(&self.default, |named| &named.configuration);
        for (_, joints) in self.controlled() {
            for joint in joints {
                let initial = number(self.position(configuration, joint));
                let position = Element::new("state_interface")
                    .with("name", "position")
                    .holding(Element::text("param", &initial).with("name", "initial_value"));
                let velocity = Element::new("state_interface").with("name", "velocity");
                let command = Element::new("command_interface").with("name", "position");
                let joint = Element::new("joint").with("name", self.joint(joint));
                hardware.push(joint.holding(command).holding(position).holding(velocity));
            }
        }
        hardware
    }

    /// Says that a file was made, and of what.
    pub fn comments(&self, what: &str) -> Result<Vec<String>, ExportError> {
        let mut lines = self.subject.origin()?;
        lines.push(what.to_owned());
        Ok(lines)
    }
}

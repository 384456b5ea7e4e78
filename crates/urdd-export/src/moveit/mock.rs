//! Simulated hardware, for the launch file.

use super::config::Config;
use urdd_xml::number::number;
use urdd_xml::writer::Element;

/// Simulated hardware that does what it is told, for the launch file. A joint that takes velocities tells them, and stays
/// where it is: `calculate_dynamics` takes joints for others whose names have theirs in them.
pub(super) fn hardware(config: &Config) -> Element {
    let plugin = Element::text("plugin", "mock_components/GenericSystem");
    let mut hardware = Element::new("ros2_control")
        .with("name", "mock_hardware")
        .with("type", "system")
        .holding(Element::new("hardware").holding(plugin));
    let configuration = config.configurations.first();
    let configuration = configuration.map_or(&config.default, |named| &named.configuration);
    for joint in config.controlled().into_iter().flat_map(|(_, joints)| joints) {
        let mut element = Element::new("joint").with("name", config.joint(joint));
        for command in config.hardware.commands(joint) {
            element.push(Element::new("command_interface").with("name", command.word()));
        }
        let initial = number(config.position(configuration, joint));
        let initial = Element::text("param", &initial).with("name", "initial_value");
        element.push(Element::new("state_interface").with("name", "position").holding(initial));
        element.push(Element::new("state_interface").with("name", "velocity"));
        hardware.push(element);
    }
    hardware
}

//! `component_parser.cpp`: what an element has to have. It ends with the first fault.

use crate::prelude::*;

#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Release {
    /// Humble.
    Two,
    /// Jazzy.
    Four,
}

/// The element of ros2_control.
pub const NAME: &str = "ros2_control";

/// The elements of ros2_control, wherever they are.
pub fn controls<'t>(file: &'t File<'_>) -> impl Iterator<Item = Node<'t>> {
    let tree = file.document.within(tinyxml::MAX_DEPTH).ok();
    tree.into_iter().flat_map(|tree| tree.named(NAME))
}

/// A `<ros2_control>`.
pub struct Hardware<'t> {
    pub node: Node<'t>,
    pub name: &'t str,
    /// `system`, `sensor` or `actuator`, if nothing is wrong.
    pub kind: &'t str,
    /// Its `<plugin>`, and the name there.
    pub plugin: Option<(Node<'t>, &'t str)>,
    pub components: Vec<Component<'t>>,
}

/// A `<joint>`, `<sensor>` or `<gpio>` of it.
pub struct Component<'t> {
    pub node: Node<'t>,
    pub name: &'t str,
    /// What its attribute `mimic` says, in Jazzy.
    pub mimic: Option<bool>,
    /// First the commands, then the states.
    pub interfaces: Vec<Interface<'t>>,
}

pub struct Interface<'t> {
    pub node: Node<'t>,
    pub name: &'t str,
    /// Whether limits are enforced, in Jazzy.
    pub is_limited: bool,
}

impl<'t> Hardware<'t> {
    pub fn joints(&self) -> impl Iterator<Item = &Component<'t>> {
        self.components.iter().filter(|one| one.node.name() == "joint")
    }

    pub fn has_joint(&self, name: &str) -> bool {
        self.joints().any(|joint| joint.name == name)
    }
}

impl<'t> Interface<'t> {
    pub fn is_command(&self) -> bool {
        self.node.name() == COMMAND
    }

    pub fn part(&self, component: &Component<'_>) -> Part {
        Part::of(self.node.name(), component.name)
    }

    /// A parameter that is not a number: where, and why.
    pub fn not_a_number(&self, name: &'static str) -> Option<(Node<'t>, Fault)> {
        let (param, text) = param(self.node, name)?;
        let is_number = whole(istream(text)).is_some();
        (!is_number)
            .then(|| (param, Fault::NotANumber { attribute: name.into(), text: text.into() }))
    }
}

/// The `<param>` of a name in an element, the last if there are several, and its text.
pub fn param<'t>(node: Node<'t>, name: &str) -> Option<(Node<'t>, &'t str)> {
    let named = |param: &Node<'_>| param.value("name").is_some_and(|one| strip(one) == name);
    let param = node.named("param").filter(named).last()?;
    Some((param, strip(param.text()?))).filter(|(_, text)| !text.is_empty())
}

/// The hardware of ros2_control itself.
pub const MOCK: &str = "mock_components/GenericSystem";
/// That of gz_ros2_control, the second from before it had its name.
pub const IN_GAZEBO: [&str; 2] =
    ["gz_ros2_control/GazeboSimSystem", "ign_ros2_control/IgnitionSystem"];

const COMMAND: &str = "command_interface";
const STATE: &str = "state_interface";
const COUNT: &str = "a whole number above 0";

fn strip(text: &str) -> &str {
    text.trim_matches(is_space)
}

pub const NO_LEADER: Fault = Fault::Control(
    "the joint that it follows is not in this `<ros2_control>`",
    "add it, or write `mimic=\"false\"` on this joint",
);

struct Parser<'r> {
    release: Release,
    effects: &'r mut Effects,
}

pub fn parse<'t>(
    robot: Node<'t>,
    release: Release,
    effects: &mut Effects,
) -> Reading<Vec<Hardware<'t>>> {
    let mut parser = Parser { release, effects };
    robot.named(NAME).map(|node| parser.hardware(node)).collect()
}

impl Parser<'_> {
    fn hardware<'t>(&mut self, node: Node<'t>) -> Reading<Hardware<'t>> {
        let (name, kind) = (self.needed(node, "name")?, self.needed(node, "type")?);
        if self.release == Release::Four {
            let is_rate = |text: &str| stoi(text).is_some_and(|rate| rate >= 0);
            self.checked(node, "rw_rate", is_rate, "a whole number, 0 or more")?;
            if self.bool(node, "is_async")? == Some(true) {
                self.checked(node, "thread_priority", is_count, COUNT)?;
            }
        }
        let mut hardware = Hardware { node, name, kind, plugin: None, components: Vec::new() };
        let mut transmissions = Vec::new();
        for child in node.children() {
            match child.name() {
                "hardware" => {
                    let plugin = self.effects.needed_element(child, "plugin")?;
                    hardware.plugin = Some((plugin, self.text(plugin.text().unwrap_or_default())));
                    self.params(child)?;
                }
                "properties" if self.release == Release::Four => self.properties(child)?,
                "joint" | "sensor" | "gpio" => hardware.components.push(self.component(child)?),
                "transmission" => transmissions.push(self.transmission(child)?),
                _ => {
                    let fault = Fault::Control(
                        "`<ros2_control>` has no such element",
                        "remove it, or move it to its place",
                    );
                    return self.effects.refuse(child, fault);
                }
            }
        }
        for (transmission, joints) in &transmissions {
            if let Some(&joint) = joints.iter().find(|joint| {
                !hardware.has_joint(self.text(joint.value("name").unwrap_or_default()))
            }) {
                let fault = Fault::Control(
                    "the joint of the transmission is not in this `<ros2_control>`",
                    "mend the name, or add the joint",
                );
                return self.effects.refuse(joint, fault);
            }
            if kind == "actuator" && joints.len() != 1 {
                let fault = Fault::Control(
                    "the transmission of an `actuator` does not have one joint",
                    "write one joint, or the type `system`",
                );
                return self.effects.refuse(*transmission, fault);
            }
        }
        Ok(hardware)
    }

    /// A text as it is kept: Humble does not cut off white space.
    fn text<'t>(&self, text: &'t str) -> &'t str {
        if self.release == Release::Four { strip(text) } else { text }
    }

    fn needed<'t>(&mut self, node: Node<'t>, name: &'static str) -> Reading<&'t str> {
        let value = self.effects.needed(node, name)?;
        Ok(self.text(&value.value))
    }

    /// An attribute that has to be right if it is there.
    fn checked<'t>(
        &mut self,
        node: Node<'t>,
        name: &'static str,
        is_right: impl Fn(&str) -> bool,
        expected: &'static str,
    ) -> Reading<Option<&'t str>> {
        let Some(value) = node.attribute(name) else { return Ok(None) };
        let text = self.text(&value.value);
        match is_right(text) {
            true => Ok(Some(text)),
            false => self.effects.refuse(value, Fault::value_but(name, text, expected)),
        }
    }

    fn bool(&mut self, node: Node<'_>, name: &'static str) -> Reading<Option<bool>> {
        let is_bool =
            |text: &str| ["true", "false"].iter().any(|one| text.eq_ignore_ascii_case(one));
        let value = self.checked(node, name, is_bool, "`true` or `false`")?;
        Ok(value.map(|value| value.eq_ignore_ascii_case("true")))
    }

    fn params(&mut self, node: Node<'_>) -> Reading<()> {
        node.named("param").try_for_each(|param| self.needed(param, "name").map(|_| ()))
    }

    fn properties(&mut self, node: Node<'_>) -> Reading<()> {
        let Some(settings) = node.child("async") else { return Ok(()) };
        self.checked(settings, "affinity", is_array, "an array such as `[0, 1]`")?;
        self.checked(settings, "thread_priority", is_count, COUNT)?;
        self.bool(settings, "print_warnings").map(|_| ())
    }

    /// Whether `<limits>` lets limits be enforced.
    fn is_limited(&mut self, node: Node<'_>) -> Reading<bool> {
        let limits = node.child("limits").filter(|_| self.release == Release::Four);
        let Some(limits) = limits else { return Ok(true) };
        self.needed(limits, "enable")?;
        Ok(self.bool(limits, "enable")? != Some(false))
    }

    fn component<'t>(&mut self, node: Node<'t>) -> Reading<Component<'t>> {
        let name = self.needed(node, "name")?;
        let (is_joint, is_gpio) = (node.name() == "joint", node.name() == "gpio");
        let mimic = match is_joint && self.release == Release::Four {
            true => self.bool(node, "mimic")?,
            false => None,
        };
        let is_limited = is_gpio || self.is_limited(node)?;
        let mut interfaces = Vec::new();
        for node in [COMMAND, STATE].into_iter().flat_map(|kind| node.named(kind)) {
            let name = self.needed(node, "name")?;
            self.params(node)?;
            let is_limited = self.is_limited(node)? && is_limited;
            if is_gpio || self.release == Release::Four {
                self.checked(node, "size", is_count, COUNT)?;
            }
            interfaces.push(Interface { node, name, is_limited });
        }
        self.params(node)?;
        Ok(Component { node, name, mimic, interfaces })
    }

    /// A transmission and its joints.
    fn transmission<'t>(&mut self, node: Node<'t>) -> Reading<(Node<'t>, Vec<Node<'t>>)> {
        let name = self.needed(node, "name")?;
        self.effects.needed_element(node, "plugin")?;
        let part = Part::of("transmission", name);
        for end in ["joint", "actuator"].into_iter().flat_map(|kind| node.named(kind)) {
            self.needed(end, "name")?;
            self.needed(end, "role")?;
            if self.release == Release::Four {
                self.bool(end, "read_only")?;
            }
            for (name, default) in [("mechanical_reduction", "1"), ("offset", "0")] {
                let Some(given) = end.named(name).find(|one| one.text().is_some()) else {
                    continue;
                };
                let text = self.text(given.text().unwrap_or_default());
                if whole(istream(text)).is_none() {
                    let fault = Fault::NotANumber { attribute: name.into(), text: text.into() };
                    self.effects.read_as(given, &part, fault, default);
                }
            }
        }
        self.params(node)?;
        Ok((node, node.named("joint").collect()))
    }
}

/// `std::stoi`: the whole number that a text begins with.
fn stoi(text: &str) -> Option<i32> {
    let text = text.trim_start_matches(is_space);
    let unsigned = text.strip_prefix(['+', '-']).unwrap_or(text);
    let digits = unsigned.bytes().take_while(u8::is_ascii_digit).count();
    text[..text.len() - unsigned.len() + digits].parse().ok()
}

fn is_count(text: &str) -> bool {
    let is_plain = text.bytes().all(|byte| byte.is_ascii_digit()) && !text.starts_with('0');
    is_plain && text.parse::<i32>().is_ok()
}

/// Numbers between commas, in brackets.
fn is_array(text: &str) -> bool {
    let inside = text.strip_prefix('[').and_then(|text| text.strip_suffix(']'));
    let Some(inside) = inside.map(strip) else { return false };
    inside.is_empty() || inside.split(',').all(|number| whole(istream(strip(number))).is_some())
}

//! The elements of an SRDF, and what their attributes name.

use urdd_xml::Node;

/// What an attribute says.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Says {
    /// A link of the robot.
    Link,
    /// A joint of the robot.
    Joint,
    /// A group.
    Group,
    /// Something else.
    Other,
}

use Says::{Group, Joint, Link, Other};

/// An element, the attributes that it needs, and what may be in it.
#[derive(Debug, Clone, Copy)]
pub struct Known {
    /// Its name.
    pub name: &'static str,
    /// What it is in.
    pub inside: &'static str,
    /// The attributes that it needs.
    pub needed: &'static [(&'static str, Says)],
    /// The names of what may be in it.
    pub holds: &'static [&'static str],
}

/// The outermost element.
pub const ROBOT: &str = "robot";

macro_rules! known {
    ($($name:literal in $inside:expr, [$($attribute:literal $says:ident)*], [$($inner:literal)*];)*) => {
        &[$(Known {
            name: $name,
            inside: $inside,
            needed: &[$(($attribute, $says)),*],
            holds: &[$($inner),*],
        }),*]
    };
}

/// All of them, those of the robot first.
pub const ELEMENTS: &[Known] = known! {
    "disable_collisions" in ROBOT, ["link1" Link "link2" Link], [];
    "disable_default_collisions" in ROBOT, ["link" Link], [];
    "enable_collisions" in ROBOT, ["link1" Link "link2" Link], [];
    "end_effector" in ROBOT, ["name" Other "group" Group "parent_link" Link], [];
    "group" in ROBOT, ["name" Other], ["chain" "group" "joint" "link"];
    "group_state" in ROBOT, ["name" Other "group" Group], ["joint"];
    "joint_property" in ROBOT, ["joint_name" Joint "property_name" Other "value" Other], [];
    "link_sphere_approximation" in ROBOT, ["link" Link], ["sphere"];
    "passive_joint" in ROBOT, ["name" Joint], [];
    "virtual_joint" in ROBOT, ["name" Other "child_link" Link "parent_frame" Other "type" Other], [];
    "chain" in "group", ["base_link" Link "tip_link" Link], [];
    "group" in "group", ["name" Group], [];
    "joint" in "group", ["name" Joint], [];
    "link" in "group", ["name" Link], [];
    "joint" in "group_state", ["name" Joint "value" Other], [];
    "sphere" in "link_sphere_approximation", ["center" Other "radius" Other], [];
};

/// The element of a name in another one.
pub fn known(name: &str, inside: &str) -> Option<&'static Known> {
    ELEMENTS.iter().find(|known| known.name == name && known.inside == inside)
}

/// Whether an element of this name stands directly in the robot of an SRDF. None of a URDF has such a name.
pub fn is_of_robot(name: &str) -> bool {
    known(name, ROBOT).is_some()
}

/// The links and joints that an element names, wherever it is: each attribute with whether it is of a link, and the name.
pub fn parts<'n>(node: Node<'n, '_>) -> impl Iterator<Item = (&'static str, bool, &'n str)> {
    let known = ELEMENTS.iter().find(|known| known.name == node.tag_name().name());
    let needed = known.map(|known| known.needed).unwrap_or_default().iter();
    let of_robot = needed.filter(|(_, says)| matches!(says, Link | Joint));
    of_robot.filter_map(move |(attribute, says)| {
        let name = node.attribute(*attribute).map(str::trim).filter(|name| !name.is_empty())?;
        Some((*attribute, *says == Link, name))
    })
}

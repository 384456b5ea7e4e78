//! Elements by their qualified names, those and the attributes of URDF (SPEC 6.1.8), and text edits that leave the rest of a document
//! unchanged.

use std::ops::Range;

use roxmltree::{Attribute, Node};

use crate::MAX_PREFIXES;

/// The qualified name of an element, including its prefix: `xacro:link` is not `link`, whatever namespace `xacro` has.
pub fn name<'a>(element: Node<'a, 'a>) -> &'a str {
    name_at(element.document().input_text(), &element.range())
}

/// The qualified name of the element at a range of a text, as from [`name`].
pub fn name_at<'a>(text: &'a str, range: &Range<usize>) -> &'a str {
    let text = &text[range.clone()];
    let start = text.strip_prefix('<').unwrap_or(text);
    start
        .split(|c: char| c.is_ascii_whitespace() || c == '>' || c == '/')
        .next()
        .unwrap_or_default()
}

/// The child elements, with their names.
pub fn children<'a>(parent: Node<'a, 'a>) -> impl Iterator<Item = (&'a str, Node<'a, 'a>)> {
    parent.children().filter(Node::is_element).map(|element| (name(element), element))
}

/// An attribute without a prefix, by name.
pub fn attribute<'a>(element: Node<'a, 'a>, name: &str) -> Option<Attribute<'a, 'a>> {
    element
        .attributes()
        .find(|attribute| attribute.name() == name && attribute.namespace().is_none())
}

/// A text edit: replaces the bytes of `range` by `text`.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Edit {
    /// Byte range to replace.
    pub range: Range<usize>,
    /// The replacement.
    pub text: String,
}

impl Edit {
    /// Where the byte at an offset is after this edit; for one that it replaces, the beginning of the replacement.
    pub fn moved(&self, offset: usize) -> usize {
        match offset.checked_sub(self.range.end) {
            Some(behind) => self.range.start + self.text.len() + behind,
            None => offset.min(self.range.start),
        }
    }
}

/// Applies edits to a text. If one edit is inside another, only the outer one applies.
pub fn apply(text: &str, mut edits: Vec<Edit>) -> String {
    edits.sort_by_key(|edit| (edit.range.start, std::cmp::Reverse(edit.range.end)));
    let mut edited = String::with_capacity(text.len());
    let mut done = 0;
    for edit in edits {
        if edit.range.start < done {
            continue;
        }
        edited.push_str(&text[done..edit.range.start]);
        edited.push_str(&edit.text);
        done = edit.range.end;
    }
    edited.push_str(&text[done..]);
    edited
}

/// The element in one that declares every prefix that it may use: the robot's declarations are not in its text.
pub fn wrapped(text: &str) -> String {
    let mut prefixes: Vec<&str> = Vec::new();
    for (at, _) in text.match_indices(':') {
        let before = &text[..at];
        let word = before.rsplit(|c: char| c.is_whitespace() || "<>/\"'=&;:".contains(c));
        let prefix = word.into_iter().next().unwrap_or_default();
        let begins = prefix.starts_with(|c: char| c.is_alphabetic() || c == '_');
        let is_name = prefix.chars().all(|c| c.is_alphanumeric() || matches!(c, '_' | '-' | '.'));
        let is_reserved = prefix.to_ascii_lowercase().starts_with("xml");
        if begins && is_name && !is_reserved && !prefixes.contains(&prefix) {
            prefixes.push(prefix);
        }
        if prefixes.len() == MAX_PREFIXES - 1 {
            break;
        }
    }
    let declared: Vec<String> =
        prefixes.iter().map(|prefix| format!(" xmlns:{prefix}=\"{prefix}\"")).collect();
    format!("<x{}>{text}</x>", declared.concat())
}

/// An element: its attributes, and the elements in it.
pub struct Known {
    /// Its name.
    pub name: &'static str,
    /// Its attributes.
    pub attributes: &'static [&'static str],
    /// The elements in it.
    pub children: &'static [&'static str],
    /// Attributes of extensions.
    pub other_attributes: &'static [&'static str],
    /// Elements of extensions; nobody looks into them.
    pub other_children: &'static [&'static str],
}

/// Elements whose content is other programs' matter.
pub const CLOSED: &[&str] = &["transmission", "gazebo", "ros2_control"];

/// A line or two for each element: its name, attributes and children, then those of extensions.
macro_rules! known {
    ($($name:ident [$($attribute:ident)*] [$($child:ident)*]
        $(or [$($other_attribute:ident)*] [$($other_child:ident)*])?;)*) => {
        &[$(Known {
            name: stringify!($name),
            attributes: &[$(stringify!($attribute)),*],
            children: &[$(stringify!($child)),*],
            other_attributes: &[$($(stringify!($other_attribute)),*)?],
            other_children: &[$($(stringify!($other_child)),*)?],
        }),*]
    };
}

/// Every element of URDF.
pub const KNOWN: &[Known] = known! {
    robot [name version] [link joint material transmission gazebo ros2_control]
        or [scale] [sensor mujoco loop_joint force_element frame collision_filter_group group group_state
            disable_collisions passive_joint end_effector virtual_joint model_state property deformable gripper];
    link [name] [inertial visual collision]
        or [type concave] [contact self_collision_checking audio_source sensor gazebo inertia_scaling
            friction_anchor laser_inertia self_collision];
    inertial [] [origin mass inertia];
    visual [name] [origin geometry material] or [concave] [verbose];
    collision [name] [origin geometry]
        or [concave group mask] [verbose contact_coefficients surface contact material];
    geometry [] [mesh box cylinder capsule sphere]
        or [] [plane cdf sdf ellipsoid superellipsoid cone heightmap convex empty];
    material [name] [color texture] or [] [specular ambient emissive shininess script diffuse];
    joint [name type] [origin parent child axis limit dynamics mimic safety_controller calibration]
        or [] [transmission gazebo sensor hardware drive];
    origin [xyz rpy quat_xyzw] [];
    mass [value] [];
    // The other half of the same tensor.
    inertia [ixx ixy ixz iyy iyz izz] [] or [iyx izx izy] [];
    color [rgba] [];
    texture [filename] [];
    parent [link] [];
    child [link] [];
    axis [xyz] [];
    limit [lower upper effort velocity acceleration deceleration jerk] [] or [k_velocity k_position] [];
    dynamics [damping friction] []
        or [coulomb_window coulomb stiffness rotor_inertia armature spring_reference spring_stiffness] [];
    mimic [joint multiplier offset] [];
    safety_controller [soft_lower_limit soft_upper_limit k_position k_velocity] [];
    calibration [rising falling] [] or [reference_position] [];
    mesh [filename scale] [] or [convex] [];
    box [size] [];
    cylinder [radius length] [];
    capsule [radius length] [];
    sphere [radius] [];
};

/// The element of a name.
pub fn of(name: &str) -> Option<&'static Known> {
    KNOWN.iter().find(|known| known.name == name)
}

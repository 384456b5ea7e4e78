//! The links, joints and materials of a text that may be half typed.

use std::collections::HashMap;

use crate::markup::Markup;

#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Named {
    pub name: String,
    pub element: usize,
}

#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Joint {
    pub name: String,
    pub element: usize,
    pub kind: String,
    /// Name of the link that it moves with; empty if it is not written yet.
    pub parent: String,
    /// Name of the link that it moves; empty if it is not written yet.
    pub child: String,
}

/// What a text defines.
#[derive(Debug, Default)]
pub struct Outline {
    pub links: Vec<Named>,
    pub joints: Vec<Joint>,
    /// Where each material is defined: those of the robot before those of single shapes, each name once.
    pub materials: Vec<Named>,
    links_by_name: HashMap<String, usize>,
    joints_by_name: HashMap<String, usize>,
}

impl Outline {
    pub fn new(text: &str, markup: &Markup) -> Self {
        let mut outline = Outline::default();
        let mut inner_materials = Vec::new();
        for element in 0..markup.elements.len() {
            let kind = markup.name(text, element);
            if !matches!(kind, "link" | "joint" | "material") {
                continue;
            }
            let Some(name) = markup.value(text, element, "name") else {
                continue;
            };
            let name = name.into_owned();
            let is_of_robot = is_of_robot(text, markup, element);
            match kind {
                "link" if is_of_robot => {
                    let index = outline.links.len();
                    outline.links_by_name.entry(name.clone()).or_insert(index);
                    outline.links.push(Named { name, element });
                }
                "joint" if is_of_robot => {
                    let index = outline.joints.len();
                    outline.joints_by_name.entry(name.clone()).or_insert(index);
                    outline.joints.push(joint(text, markup, element, name));
                }
                "material" if is_of_robot => outline.materials.push(Named { name, element }),
                "material" if markup.has_children(element) => {
                    inner_materials.push(Named { name, element });
                }
                _ => {}
            }
        }
        outline.materials.extend(inner_materials);
        let mut seen = std::collections::HashSet::new();
        outline.materials.retain(|one| seen.insert(one.name.clone()));
        outline
    }

    pub fn link(&self, name: &str) -> Option<&Named> {
        self.links.get(*self.links_by_name.get(name)?)
    }

    pub fn link_index(&self, name: &str) -> Option<usize> {
        self.links_by_name.get(name).copied()
    }

    pub fn joint(&self, name: &str) -> Option<&Joint> {
        self.joints.get(*self.joints_by_name.get(name)?)
    }

    /// The element of the link, joint or material of a name.
    pub fn element(&self, kind: &str, name: &str) -> Option<usize> {
        match kind {
            "link" => Some(self.link(name)?.element),
            "joint" => Some(self.joint(name)?.element),
            "material" => Some(self.materials.iter().find(|one| one.name == name)?.element),
            _ => None,
        }
    }
}

/// Whether an element is directly in the robot, or would be after macros are expanded.
fn is_of_robot(text: &str, markup: &Markup, element: usize) -> bool {
    let mut around = markup.ancestors(element).skip(1);
    around.all(|one| {
        let name = markup.name(text, one);
        name == "robot" || name.starts_with("xacro:")
    })
}

fn joint(text: &str, markup: &Markup, element: usize, name: String) -> Joint {
    let link = |wanted: &str| {
        let mut children = markup.children(element);
        let child = children.find(|child| markup.name(text, *child) == wanted);
        let link = child.and_then(|child| markup.value(text, child, "link"));
        link.unwrap_or_default().into_owned()
    };
    Joint {
        name,
        element,
        kind: markup.value(text, element, "type").unwrap_or_default().into_owned(),
        parent: link("parent"),
        child: link("child"),
    }
}

//! A URDF as rules see it.

use std::collections::HashMap;
use std::ops::Range;
use std::path::Path;
use std::sync::OnceLock;

use roxmltree::{Document, Node};

use super::geometry::{LinkGeometry, of_links};
use super::inertial::Inertial;
use urdd_directory::position::LineIndex;
use urdd_document::robot::of_urdf;
use urdd_format::index::Count;
use urdd_format::report::{Fix, TextEdit};
use urdd_format::urdf::UrdfModule;
use urdd_generate::SourceMeshes;
use urdd_validate::code::Code;
use urdd_validate::finding::{Finding, Findings};
use urdd_validate::skip::SkipReason;
use urdd_xml::element::children;

/// A URDF, its XML, the robot that it describes and its mesh files.
pub struct Subject<'a> {
    /// The file's name in the report.
    pub file: &'a str,
    /// The folder that relative mesh names refer to.
    pub folder: &'a Path,
    /// The text: of the file, or what xacro made of it.
    pub text: &'a str,
    /// `<robot>`.
    pub root: Node<'a, 'a>,
    /// Each `<link>`, in order.
    pub links: Vec<Node<'a, 'a>>,
    /// Each `<joint>` of the robot, in order.
    pub joints: Vec<Node<'a, 'a>>,
    lines: LineIndex<'a>,
    source: Option<&'a SourceMeshes>,
    bodies: OnceLock<Vec<Body>>,
}

/// A link as a body.
pub struct Body {
    /// Its shapes.
    pub geometry: LinkGeometry,
    /// Its mass properties; `None` if it has none, or they cannot be those of a body (SRC002 to SRC004).
    pub inertial: Option<Inertial>,
}

impl<'a> Subject<'a> {
    /// A URDF. `source` is the same text as the reader of `generate` understands it; `None` if it refuses it.
    pub fn new(
        file: &'a str,
        folder: &'a Path,
        document: &'a Document<'a>,
        source: Option<&'a SourceMeshes>,
    ) -> Self {
        let root = document.root_element();
        let named = |wanted: &str| {
            let found = children(root).filter(|(name, _)| *name == wanted);
            found.map(|(_, node)| node).collect::<Vec<_>>()
        };
        let (links, joints) = (named("link"), named("joint"));
        // Elements are found by their indices in both.
        let alike = |source: &&SourceMeshes| {
            (source.robot.links.len(), source.robot.joints.len()) == (links.len(), joints.len())
        };
        Subject {
            file,
            folder,
            text: document.input_text(),
            root,
            lines: LineIndex::new(document.input_text()),
            source: source.filter(alike),
            links,
            joints,
            bodies: OnceLock::new(),
        }
    }

    /// The robot. Skips the rule if the URDF describes none (URD011 says why).
    pub fn robot(&self, findings: &mut Findings) -> Option<&'a UrdfModule> {
        Some(&self.source(findings)?.robot)
    }

    /// The robot with its mesh files. Skips the rule if the URDF describes none.
    pub fn source(&self, findings: &mut Findings) -> Option<&'a SourceMeshes> {
        findings.or_skip(self.source.ok_or(SkipReason::Failed(Code::URD011)))
    }

    /// Each link as a body, read on first use. Skips the rule if the URDF describes no robot.
    pub fn bodies(&self, findings: &mut Findings) -> Option<&[Body]> {
        let source = self.source(findings)?;
        let make = || {
            let robot = of_urdf(&source.robot);
            let links = robot.links.iter().zip(of_links(source, &robot));
            let body = |(link, geometry)| Body {
                geometry,
                inertial: Inertial::of(link),
            };
            links.map(body).collect()
        };
        Some(self.bodies.get_or_init(make))
    }

    /// A finding about an element.
    pub fn at(&self, node: Node<'a, 'a>, message: impl Into<String>) -> Finding {
        self.placed(node, node.range().start, message)
    }

    /// A finding about an attribute of an element, at its name; about the element if it has none of that name.
    pub fn at_attribute(
        &self,
        node: Node<'a, 'a>,
        attribute: &str,
        message: impl Into<String>,
    ) -> Finding {
        let range = node.attribute_node(attribute).map(|one| one.range());
        let start = range.map_or(node.range().start, |range| range.start);
        self.placed(node, start, message)
    }

    /// Findings at the same kind of element are one with a count.
    fn placed(&self, node: Node<'a, 'a>, offset: usize, message: impl Into<String>) -> Finding {
        let mut finding = Finding::at(self.file, pointer(node), message)
            .position(Some(self.lines.position(offset)));
        finding.place.subject = subject(node);
        finding
    }

    /// A fix that replaces a range of the text.
    pub fn fix(&self, message: impl Into<String>, range: Range<usize>, text: String) -> Fix {
        let (start, end) = (
            self.lines.position(range.start),
            self.lines.position(range.end),
        );
        Fix {
            message: message.into(),
            is_safe: true,
            edits: vec![TextEdit {
                file: self.file.to_owned(),
                line: Count(start.line),
                column: Count(start.column),
                end_line: Count(end.line),
                end_column: Count(end.column),
                text,
            }],
        }
    }

    /// The indices of the links by their names.
    pub fn link_indices(&self) -> HashMap<&'a str, usize> {
        indices(&self.links)
    }

    /// The indices of the joints by their names.
    pub fn joint_indices(&self) -> HashMap<&'a str, usize> {
        indices(&self.joints)
    }
}

fn indices<'a>(nodes: &[Node<'a, 'a>]) -> HashMap<&'a str, usize> {
    let named = nodes.iter().enumerate();
    named
        .filter_map(|(index, node)| Some((node.attribute("name")?, index)))
        .collect()
}

/// The path of an element, with its index among those of the same name.
fn pointer(node: Node) -> String {
    let mut parts = Vec::new();
    let inside = |node: &Node| node.parent_element().is_some();
    for one in node.ancestors().take_while(inside) {
        let name = one.tag_name().name();
        let before = one.prev_siblings().skip(1);
        let before = before.filter(|other| other.is_element() && other.tag_name().name() == name);
        parts.push(format!("/{name}/{}", before.count()));
    }
    parts.reverse();
    parts.concat()
}

/// The link or joint that an element belongs to.
fn subject(node: Node) -> Option<String> {
    let is_part = |one: &Node| matches!(one.tag_name().name(), "link" | "joint");
    let part = node.ancestors().find(is_part)?;
    let name = part.attribute("name")?;
    Some(format!("{} `{name}`", part.tag_name().name()))
}

//! A URDF as rules see it.

use std::collections::HashSet;
use std::ops::Range;
use std::path::Path;
use std::sync::OnceLock;

use nalgebra::Vector3;
use urdd_directory::position::{LineIndex, Position};
use urdd_document::robot::{Robot, of_urdf};
use urdd_findings::code::Code;
use urdd_findings::finding::{Finding, Findings};
use urdd_findings::part::Part;
use urdd_findings::part::SkipReason;
use urdd_format::index::Count;
use urdd_format::report::{Fix, TextEdit};
use urdd_format::short;
use urdd_format::urdf::JointType;
use urdd_source::{Files, SourceMesh, SourceMeshes};
use urdd_xml::element::name;
use urdd_xml::{Document, Node};

use crate::beside::{Closing, NamedFile, Srdf, SrdfFile};
use crate::geometry::{Bodies, NamedMesh, RobotGeometry};
use crate::settings::{LintSettings, WITHOUT_MESHES, refused};
use crate::vocabulary::{Names, Unknown, What, child, kind, named, numbers, unknown};

/// A URDF, its XML, the robot that it describes and its mesh files.
pub struct Subject<'a> {
    /// The file's name in the report.
    pub file: &'a str,
    /// The folder that relative mesh names refer to.
    pub folder: &'a Path,
    pub files: &'a Files,
    /// The text: of the file, or what xacro made of it.
    pub text: &'a str,
    pub root: Node<'a, 'a>,
    pub links: Vec<Node<'a, 'a>>,
    pub joints: Vec<Node<'a, 'a>>,
    /// The files that may be SRDFs of it, read on first use.
    pub srdf_files: &'a OnceLock<Vec<SrdfFile>>,
    /// Those that are, found on first use.
    pub srdfs: OnceLock<Vec<Srdf<'a>>>,
    pub settings: &'a LintSettings,
    pub closing: Closing<'a>,
    lines: LineIndex<'a>,
    source: Result<&'a SourceMeshes, SkipReason>,
    robot: OnceLock<(Robot, Option<Bodies>)>,
    geometry: OnceLock<RobotGeometry>,
    unknown: OnceLock<Vec<Unknown<'a>>>,
    elements: OnceLock<Vec<Node<'a, 'a>>>,
    shapes: OnceLock<Vec<[Vec<Node<'a, 'a>>; 2]>>,
    joint_names: OnceLock<Names<'a>>,
    /// What LNT060 and LNT061 find, once the other rules ran: the faults that only programs name.
    pub programs: OnceLock<Vec<(Code, Finding)>>,
}

impl<'a> Subject<'a> {
    /// A URDF. `source` is the same text as the reader of `generate` understands it, or why that reader refuses it; `srdf_files`
    /// is filled with the SRDFs around it where a rule asks for them.
    pub fn new(
        file: &'a str,
        folder: &'a Path,
        document: &'a Document<'a>,
        source: Result<&'a SourceMeshes, &SkipReason>,
        settings: &'a LintSettings,
        srdf_files: &'a OnceLock<Vec<SrdfFile>>,
    ) -> Self {
        let root = document.root_element();
        let [links, joints] = ["link", "joint"].map(|name| named(root, name).collect::<Vec<_>>());
        // Elements are found by their indices in both.
        let source = source.map_err(Clone::clone).and_then(|source| {
            let robot = &source.robot;
            let is_same = (robot.links.len(), robot.joints.len()) == (links.len(), joints.len());
            let why = || refused("its links and joints could not be told apart");
            is_same.then_some(source).ok_or_else(why)
        });
        let of_urdf = source.as_ref().ok().copied();
        let closing = Closing::new(of_urdf, folder.join(file), &settings.source);
        Subject {
            file,
            folder,
            files: &settings.source.files,
            text: document.input_text(),
            root,
            lines: LineIndex::new(document.input_text()),
            source,
            srdf_files,
            srdfs: OnceLock::new(),
            settings,
            closing,
            links,
            joints,
            robot: OnceLock::new(),
            geometry: OnceLock::new(),
            unknown: OnceLock::new(),
            elements: OnceLock::new(),
            shapes: OnceLock::new(),
            joint_names: OnceLock::new(),
            programs: OnceLock::new(),
        }
    }

    /// The robot with its mesh files. Skips the rule if the URDF describes none.
    pub fn source(&self, findings: &mut Findings) -> Option<&'a SourceMeshes> {
        findings.or_skip(self.source.clone())
    }

    /// The robot and its bodies. Skips the rule if the URDF describes no tree (URD004 to URD011 say why).
    pub fn bodies(&self, findings: &mut Findings) -> Option<(&Robot, &Bodies)> {
        let source = self.source(findings)?;
        // URDD readers take 0 for them; rules would tell of poses that are not there.
        if self.parts().any(is_unreadable) {
            findings.skip(SkipReason::Failed(Code::URD011))?;
        }
        let (robot, bodies) = self.robot.get_or_init(|| {
            let robot = of_urdf(&source.robot);
            let bodies = Bodies::new(&robot);
            (robot, bodies)
        });
        let bodies = findings.or_skip(bodies.as_ref().ok_or(SkipReason::Failed(Code::URD004)))?;
        Some((robot, bodies))
    }

    /// The shapes of links and bodies, read on first use. Skips the rule as [`Self::bodies`] does, and if no mesh file is read.
    /// Links with meshes that could not be read are not verified by it.
    pub fn geometry(&self, findings: &mut Findings) -> Option<&RobotGeometry> {
        if self.settings.without_meshes {
            findings.skip(WITHOUT_MESHES)?;
        }
        let source = self.source(findings)?;
        let (robot, bodies) = self.bodies(findings)?;
        let read = || RobotGeometry::read(source, robot, bodies);
        let geometry = self.geometry.get_or_init(read);
        for (link, why) in &geometry.not_verified {
            findings.not_verified(Part::Plain(*link), *why);
        }
        Some(geometry)
    }

    /// The meshes of links that the URDF names, each file's name once a link and kind, with their elements. Skips the rule if the
    /// URDF describes no robot.
    pub fn meshes(&self, findings: &mut Findings) -> Option<Vec<(Node<'a, 'a>, &'a SourceMesh)>> {
        let source = self.source(findings)?;
        let mut seen = HashSet::new();
        let meshes = source.meshes.iter().filter_map(|mesh| {
            let node = self.mesh_node(mesh)?;
            seen.insert((mesh.link, mesh.geometry, &mesh.filename)).then_some((node, mesh))
        });
        Some(meshes.collect())
    }

    /// The meshes whose files are there, as they were read, once a kind, file and scale; with their elements. Skips the rule as
    /// [`Self::bodies`] does.
    pub fn read_meshes(
        &self,
        findings: &mut Findings,
    ) -> Option<Vec<(Node<'a, 'a>, NamedMesh<'_>)>> {
        let geometry = self.geometry(findings)?;
        let mut seen = HashSet::new();
        let meshes = self.meshes(findings)?.into_iter();
        let meshes = meshes.filter_map(|(node, mesh)| {
            let file = mesh.file.as_ref().ok()?;
            let read = geometry.files.get(file)?;
            let scale: [f64; 3] = numbers(node, "scale").unwrap_or([1.0; 3]);
            if !seen.insert((mesh.geometry, file, scale.map(f64::to_bits))) {
                return None;
            }
            let named = NamedMesh {
                kind: mesh.geometry,
                scale,
                file,
                facts: read.as_ref().map_err(String::as_str),
            };
            Some((node, named))
        });
        Some(meshes.collect())
    }

    /// Whether a joint moves. Scenery is judged less strictly.
    pub fn moves(&self) -> bool {
        let fixed = |node: &Node| node.attribute("type") == Some("fixed");
        self.joints.iter().any(|node| !fixed(node))
    }

    /// The length, m, from which a part is not of this robot's size: 100 times the largest offset or range of a joint, or 5 cm.
    /// Large parts on small offsets have 10 times. Skips the rule as [`Self::bodies`] does.
    pub fn longest_part(&self, findings: &mut Findings) -> Option<f64> {
        const TIMES: f64 = 100.0;
        const OFFSET: f64 = 0.05;
        let (robot, _) = self.bodies(findings)?;
        let offsets = robot.joints.iter().map(|joint| {
            let range = joint.limit.filter(|_| joint.joint_type == JointType::Prismatic);
            let ends = range.into_iter().flat_map(|limit| [limit.lower, limit.upper]);
            let range = ends.flatten().map(f64::abs).fold(0.0, f64::max);
            Vector3::from(joint.origin.xyz).norm().max(range)
        });
        Some(TIMES * offsets.fold(OFFSET, f64::max))
    }

    /// An element of a link's `<inertial>`; the nearest above it that is there.
    pub fn inertial(&self, link: usize, wanted: &str) -> Node<'a, 'a> {
        let node = self.links[link];
        let inertial = child(node, "inertial").unwrap_or(node);
        child(inertial, wanted).unwrap_or(inertial)
    }

    pub fn mesh_node(&self, mesh: &SourceMesh) -> Option<Node<'a, 'a>> {
        let shapes = self.shapes.get_or_init(|| {
            let of = |link: &Node<'a, 'a>| {
                ["visual", "collision"].map(|kind| named(*link, kind).collect())
            };
            self.links.iter().map(of).collect()
        });
        let element = shapes.get(mesh.link)?[mesh.geometry as usize].get(mesh.element)?;
        element.descendants().find(|node| node.tag_name().name() == "mesh")
    }

    pub fn joints_of(&self, types: &[&str]) -> impl Iterator<Item = Node<'a, 'a>> {
        let is_one =
            |node: &&Node| node.attribute("type").is_some_and(|kind| types.contains(&kind));
        self.joints.iter().filter(is_one).copied()
    }

    /// The joints of these types that have a `<limit>`, with it.
    pub fn limits_of(&self, types: &[&str]) -> impl Iterator<Item = (Node<'a, 'a>, Node<'a, 'a>)> {
        self.joints_of(types).filter_map(|joint| Some((joint, child(joint, "limit")?)))
    }

    /// Every element in a link or joint.
    pub fn parts(&self) -> impl Iterator<Item = Node<'a, 'a>> {
        let all = self.links.iter().chain(&self.joints);
        all.flat_map(|node| node.descendants()).filter(Node::is_element)
    }

    pub fn names<'n>(
        &self,
        nodes: &'n [Node<'a, 'a>],
    ) -> impl Iterator<Item = &'a str> + use<'a, 'n> {
        nodes.iter().filter_map(|node| node.attribute("name"))
    }

    /// The files of meshes and textures in links and materials, each name once an element.
    pub fn named_files(&self) -> Vec<NamedFile<'a, 'a>> {
        let named = self.root.descendants().filter(|node| {
            let in_gazebo = || node.ancestors().any(|one| one.tag_name().name() == "gazebo");
            matches!(node.tag_name().name(), "mesh" | "texture") && !in_gazebo()
        });
        let mut seen = HashSet::new();
        let named = named.filter_map(|node| {
            let name = node.attribute("filename")?;
            let is_new = seen.insert((part(node).map(|part| part.id()), name));
            is_new.then_some(NamedFile { node, name })
        });
        named.collect()
    }

    pub fn unknown(&self) -> &[Unknown<'a>] {
        self.unknown.get_or_init(|| unknown(self.root))
    }

    /// The element whose start tag holds an offset, or is the last before it.
    pub fn element(&self, offset: usize) -> Option<Node<'a, 'a>> {
        let all = || self.root.document().descendants().filter(Node::is_element).collect();
        let elements: &Vec<Node> = self.elements.get_or_init(all);
        let after = elements.partition_point(|node| node.range().start <= offset);
        elements.get(after.checked_sub(1)?).copied()
    }

    /// Whether a file is there under a name, as meshes are found.
    pub fn has_file(&self, name: &str) -> bool {
        self.source.as_ref().is_ok_and(|source| source.find(name).is_ok())
    }

    pub fn position(&self, offset: usize) -> Position {
        self.lines.position(offset)
    }

    /// The first element that only xacro understands.
    pub fn macros(&self) -> Option<Node<'a, 'a>> {
        let is_macro = |node: &Node| {
            let mut attributes = node.attributes();
            name(*node).starts_with("xacro:")
                || attributes.any(|one| one.value().contains("${") || one.value().contains("$("))
        };
        self.root.descendants().find(|node| node.is_element() && is_macro(node))
    }

    /// Reports an element whose `name` is not that of a joint.
    pub fn names_a_joint(&self, node: Node<'a, 'a>, findings: &mut Findings) {
        // A robot without links is no robot: that is the fault.
        if self.links.is_empty() {
            return;
        }
        let known = self.joint_names.get_or_init(|| Names::new(self.names(&self.joints)));
        let Some(name) = node.attribute("name").filter(|name| !known.has(name)) else { return };
        let hint = known.hint(name);
        let message = format!("no joint is called `{name}`{hint}; write the name of a joint");
        self.at_attribute(node, "name", message).report(findings);
    }

    /// Where the value of an attribute stands in the text, without quotes.
    pub fn value(&self, node: Node<'a, 'a>, attribute: &str) -> Option<Range<usize>> {
        node.attribute_node(attribute).map(|one| one.range_value())
    }

    /// Where the name of an element is in the text: in its start tag, and in its end tag if it has one.
    pub fn tag_names(&self, node: Node<'a, 'a>) -> Vec<Range<usize>> {
        let (range, length) = (node.range(), name(node).len());
        let start = range.start + 1;
        let end = self.text[range.clone()].rfind("</").map(|end| range.start + end + 2);
        let end = end.filter(|_| !self.text[range].ends_with("/>"));
        let starts = std::iter::once(start).chain(end);
        starts.map(|start| start..start + length).collect()
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

    pub fn at_unknown(&self, one: &Unknown<'a>, message: impl Into<String>) -> Finding {
        match one.what {
            What::Element => self.at(one.node, message),
            What::Attribute(name) => self.at_attribute(one.node, name, message),
        }
    }

    pub fn at_offset(&self, offset: usize, message: impl Into<String>) -> Finding {
        match self.element(offset) {
            Some(node) => self.placed(node, offset, message),
            None => Finding::in_file(self.file, message).position(Some(self.position(offset))),
        }
    }

    /// Findings at the same kind of element are one with a count.
    fn placed(&self, node: Node<'a, 'a>, offset: usize, message: impl Into<String>) -> Finding {
        let mut finding =
            Finding::at(self.file, kind(node), message).position(Some(self.lines.position(offset)));
        finding.place.subject = part_of(node);
        finding
    }

    /// A fix that replaces a range of the text.
    pub fn fix(&self, message: impl Into<String>, range: Range<usize>, text: String) -> Fix {
        let (start, end) = (self.lines.position(range.start), self.lines.position(range.end));
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
}

/// The link or joint that an element belongs to. A long name is shortened: each place has it.
pub fn part_of(node: Node) -> Option<String> {
    let part = part(node)?;
    let name = part.attribute("name")?;
    Some(format!("{} `{}`", part.tag_name().name(), short::name(name)))
}

/// The link or joint of the robot that holds an element.
fn part<'a>(node: Node<'a, 'a>) -> Option<Node<'a, 'a>> {
    let is_part = |one: &Node| {
        let in_robot = one.parent_element().is_some_and(|above| above.parent_element().is_none());
        in_robot && matches!(one.tag_name().name(), "link" | "joint")
    };
    node.ancestors().find(is_part)
}

/// Whether an element has numbers that cannot be read.
fn is_unreadable(node: Node) -> bool {
    let is_bad =
        |attribute| node.has_attribute(attribute) && numbers::<3>(node, attribute).is_none();
    match name(node) {
        "origin" => is_bad("xyz") || is_bad("rpy"),
        "mesh" => is_bad("scale"),
        _ => false,
    }
}

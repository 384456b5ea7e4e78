//! How it reads joints, and the meshes that it shows. Of what repeats, the last counts.

use crate::mesh::formats::ColladaFacts;
use crate::prelude::*;
use crate::three::{Joint, ThreeReader, name_of, named};

impl<'t> ThreeReader<'_, 't> {
    pub fn joint(&mut self, node: Node<'t>, links: &HashMap<&str, Node<'t>>) -> Joint<'t> {
        let part = Part::of("joint", name_of(node));
        let mimic = named(node, "mimic").next();
        if let Some(mimic) = mimic {
            self.numbers(mimic, &["multiplier", "offset"], &part.inside("mimic"), "NaN");
        }
        self.pose(node, &part);
        let parent = self.last(node, "parent", &part);
        let parent = parent.map(|parent| (parent, parent.value("link").unwrap_or("null")));
        let is_known = parent.is_some_and(|(_, link)| links.contains_key(link));
        match parent.filter(|_| !is_known) {
            Some((end, link)) => self.effects.refuse_mendable(end, Fault::unknown("link", link)),
            None if is_known => {}
            None => self.effects.refuse_mendable(node, Fault::MissingElement("parent")),
        }
        let child = self.last(node, "child", &part);
        let link = child.map(|child| child.value("link").unwrap_or("null"));
        if is_known && link.is_none_or(|link| !links.contains_key(link)) {
            let fault = Fault::unknown("link", link.unwrap_or_default());
            self.effects.drop(child.unwrap_or(node), part.inside("child"), fault);
        }
        if let Some(axis) = named(node, "axis").next() {
            match axis.attribute("xyz") {
                Some(xyz) => self.axis(xyz, &part.inside("axis")),
                None => self.effects.refuse_mendable(axis, Fault::Missing("xyz")),
            }
        }
        self.limit(node, &part);
        for unread in ["dynamics", "calibration", "safety_controller"] {
            if let Some(found) = named(node, unread).next() {
                self.effects.unread(found, part.inside(unread), unread);
            }
        }
        Joint { node, child: link, mimic }
    }

    /// An axis is split at white space, which may be before the first number too.
    fn axis(&mut self, xyz: &Attribute<'_>, part: &Part) {
        let text = &*xyz.value;
        let is_padded = text.is_empty() || text.starts_with(char::is_whitespace);
        let before = is_padded.then_some("");
        self.vector(xyz, before.into_iter().chain(text.split_whitespace()), 3, part);
    }

    fn limit(&mut self, joint: Node<'t>, part: &Part) {
        let (kind, part) = (joint.attribute("type"), part.inside("limit"));
        let text = kind.map_or("", |kind| &*kind.value);
        if !JOINT_TYPES.contains(&text) {
            let at = kind.map_or(joint.start(), |kind| kind.range.start);
            let part = Part::of("joint", name_of(joint));
            self.effects.read_as(at, part, Fault::value("type", text), "fixed");
        }
        let is_limited = matches!(text, "revolute" | "prismatic");
        let mut limits = named(joint, "limit").peekable();
        if limits.peek().is_none() && is_limited {
            self.effects.read_as(joint, &part, Fault::MissingElement("limit"), "locked at 0");
        }
        for limit in limits {
            self.numbers(limit, &["lower", "upper", "effort", "velocity"], &part, "NaN");
            self.effects.unread_attributes(limit, FURTHER, &part);
        }
    }

    /// Of joints with one child the last has it.
    pub fn children(&mut self, joints: &[Joint<'t>]) {
        let mut last: HashMap<&str, Node<'t>> = HashMap::new();
        for joint in joints {
            let Some(child) = joint.child else { continue };
            if let Some(other) =
                last.insert(child, joint.node).filter(|one| !one.is_like(joint.node))
            {
                let part = Part::of("joint", name_of(other)).inside("child");
                self.effects.drop(joint.node, part, TWO_PARENTS);
            }
        }
    }

    pub fn mimics(&mut self, joints: &[Joint<'t>], by_name: &HashMap<&str, usize>) -> Reading<()> {
        /// How often a joint was met: never, on the way, or to its end.
        const NEW: usize = 0;
        const DONE: usize = usize::MAX;
        let mut driver = vec![None; joints.len()];
        for (index, joint) in joints.iter().enumerate() {
            let Some(mimic) =
                joint.mimic.filter(|_| by_name.get(name_of(joint.node)) == Some(&index))
            else {
                continue;
            };
            let name = mimic.value("joint").unwrap_or("null");
            driver[index] = by_name.get(name).copied();
            if driver[index].is_none() {
                self.effects.refuse_mendable(mimic, Fault::unknown("joint", name));
            }
        }
        let mut met = vec![NEW; joints.len()];
        for start in 0..joints.len() {
            let mut way = Vec::new();
            let mut at = Some(start);
            while let Some(joint) = at.filter(|&joint| met[joint] == NEW) {
                met[joint] = start + 1;
                way.push(joint);
                at = driver[joint];
            }
            if let Some(again) = at.filter(|&joint| met[joint] == start + 1) {
                let place = joints[again].mimic.unwrap_or(joints[again].node);
                let fault = Fault::Other("joints mimic each other in a loop");
                return self.effects.refuse(place, fault);
            }
            way.into_iter().for_each(|joint| met[joint] = DONE);
        }
        Ok(())
    }
}

impl<'t> ThreeReader<'_, 't> {
    pub fn mesh(&mut self, mesh: Node<'t>, part: &Part) {
        let Some(name) = mesh.attribute("filename") else {
            return self.effects.drop(mesh, part, Fault::Missing("filename"));
        };
        if let Some(scale) = mesh.attribute("scale").filter(|scale| !scale.value.is_empty()) {
            self.vector(scale, scale.value.split_whitespace(), 3, part);
        }
        let packaged = name.value.starts_with("package://");
        let ending = name.value.rsplit('.').next().unwrap_or_default();
        let ending = ending.to_ascii_lowercase();
        let fault = match self.file.mesh(&as_path(&name.value)) {
            _ if !matches!(&*ending, "stl" | "dae") => format_fault(&name.value),
            _ if !packaged && (name.value.contains("://") || name.value.starts_with('/')) => {
                Fault::ForOthers("only `package://` names a file that is not beside the URDF")
            }
            Mesh::Missing => Fault::NotFound("mesh"),
            Mesh::Found(facts) => match facts.leniency() {
                Some(fault) => fault,
                None if is_mesh(&facts, &ending) => return,
                None => Fault::Mesh("the program cannot read the mesh"),
            },
            _ => return,
        };
        self.effects.drop(name, part, fault);
    }

    /// A COLLADA mesh is not painted with the material of the visual.
    pub fn own_colours(&mut self, visual: Node<'t>, form: Node<'t>, part: &Part) {
        let name = form.value("filename").unwrap_or_default().to_ascii_lowercase();
        if form.name().eq_ignore_ascii_case("mesh") && name.ends_with(".dae") {
            let part = part.inside("material");
            let fault = Fault::Way("a COLLADA mesh keeps its own colours");
            match visual.child("material") {
                Some(material) => self.effects.drop(material, part, fault),
                // There is none to lose: other meshes would be white.
                None => self.effects.read_as(form, part, fault, "the colours of the mesh"),
            }
        }
    }
}

/// The file of a name that is taken for a part of a URL.
fn as_path(name: &str) -> String {
    let mut bytes = Vec::with_capacity(name.len());
    let mut rest = name.replace('\\', "/").replace(['\n', '\t', '\r'], "").into_bytes().into_iter();
    while let Some(byte) = rest.next() {
        let hex = |byte: &u8| char::from(*byte).to_digit(16);
        let pair = rest.as_slice().get(..2).map(|pair| (hex(&pair[0]), hex(&pair[1])));
        match pair {
            Some((Some(high), Some(low))) if byte == b'%' => {
                bytes.push(u8::try_from(16 * high + low).unwrap_or_default());
                rest.nth(1);
            }
            _ => bytes.push(byte),
        }
    }
    String::from_utf8_lossy(&bytes).into_owned()
}

/// Whether it reads a mesh.
fn is_mesh(facts: &MeshFacts, ending: &str) -> bool {
    if ending == "dae" {
        let shows = |collada: &ColladaFacts| collada.is_complete && collada.has_scene;
        return facts.collada.as_ref().is_some_and(shows);
    }
    let Some(count) = facts.stl.as_ref().and_then(|stl| stl.written) else { return false };
    let is_text = facts.head.starts_with(b"solid") && !facts.is_binary_stl();
    is_text || count.checked_mul(50).is_some_and(|size| size + 84 <= facts.size)
}

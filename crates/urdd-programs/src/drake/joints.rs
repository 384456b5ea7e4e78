//! How Drake reads joints, mimics and transmissions, and what it makes a tree of.

use super::{DrakeReader, Links, WORLD};
use crate::prelude::*;

struct Joint<'t> {
    node: Node<'t>,
    freedoms: usize,
    effort: f64,
    /// Whether a transmission moves it: its effort is lost if not.
    is_driven: bool,
}

struct Model<'l, 't> {
    links: &'l Links<'t>,
    joints: HashMap<&'t str, Joint<'t>>,
    /// Their names in the order of the file.
    names: Vec<&'t str>,
    /// Names of frames, which joints make by adding to their own.
    frames: HashSet<String>,
    /// Links that joints connect: each has another one, or itself, as that of its group.
    groups: HashMap<&'t str, &'t str>,
}

impl DrakeReader<'_> {
    pub fn joints<'t>(&mut self, robot: Node<'t>, links: &Links<'t>) -> Reading<()> {
        let mut model = Model {
            links,
            joints: HashMap::new(),
            names: Vec::new(),
            frames: links.keys().map(|name| (*name).to_owned()).collect(),
            groups: HashMap::new(),
        };
        let all = robot.children().filter(|node| matches!(node.name(), "joint" | "drake:joint"));
        let before = self.effects.unread_parts();
        for node in all.clone() {
            let _ = self.joint(node, &mut model);
        }
        // From here on, joints and frames have to be known.
        self.effects.are_read(before)?;
        for node in all {
            let _ = self.mimic(node, &model);
        }
        let mut actuators = HashSet::new();
        for node in robot.named("transmission") {
            let _ = self.transmission(node, &mut model, &mut actuators);
        }
        for closing in robot.named("loop_joint") {
            let fault = Fault::Way("`<loop_joint>` is not supported");
            self.effects.refuse_mendable(closing, fault);
        }
        for frame in robot.named("frame") {
            let _ = self.frame(frame, &mut model);
        }
        self.effects.are_read(before)?;
        let is_joint = |name: &str| model.joints.contains_key(name);
        self.forces(robot, links, &model.frames, &is_joint);
        for name in &model.names {
            let idle = model.joints.get(name).filter(|joint| !joint.is_driven);
            let limit = idle.and_then(|joint| joint.node.child("limit"));
            if let Some(effort) = limit.and_then(|limit| limit.attribute("effort")) {
                let part = Part::of("joint", name).inside("limit");
                let fault = Fault::Way("`effort` is read only for a joint with a transmission");
                self.effects.read_as(effort, part, fault, "no motor");
            }
        }
        Ok(())
    }

    fn joint<'t>(&mut self, node: Node<'t>, model: &mut Model<'_, 't>) -> Reading<()> {
        if self.is_ignored(node) {
            return Ok(());
        }
        let name = self.effects.needed(node, "name")?;
        let kind = self.effects.needed(node, "type")?;
        let (parent, child) = (self.end(node, "parent")?, self.end(node, "child")?);
        let part = Part::of("joint", &name.value);
        for (value, attribute) in
            [(name, "name"), (kind, "type"), (parent, "link"), (child, "link")]
        {
            if value.value.is_empty() {
                self.effects.drop(value, part, Fault::Empty(attribute));
                return Ok(());
            }
        }
        for end in [parent, child] {
            if end.value != WORLD && !model.links.contains_key(&*end.value) {
                return self.effects.refuse(end, Fault::unknown("link", &end.value));
            }
        }
        self.pose(node, &part.inside("origin"));
        if !matches!(&*kind.value, "fixed" | "floating" | "ball") {
            let _ = self.axis(node, &part.inside("axis"));
        }
        let Some(freedoms) = freedoms(&kind.value, node.name() == "drake:joint") else {
            return self.effects.refuse(kind, Fault::value("type", &kind.value));
        };
        if kind.value == "screw" {
            let _ = self.effects.needed_element(node, "drake:screw_thread_pitch");
        }
        if kind.value == "floating" {
            self.effects.drop(kind, part, Fault::value("type", "floating"));
            return Ok(());
        }
        if child.value == WORLD {
            let fault = match &*kind.value {
                "fixed" => Fault::Way("the link `world` is the world of the program"),
                _ => Fault::world(),
            };
            self.effects.read_as(child, &part, fault, "a joint of the world");
        }
        self.effects.unread_elements(node, "safety_controller calibration", &part);
        let effort = self.motion(node, &kind.value, &part)?;
        if parent.value == child.value {
            return self.effects.refuse(child, Fault::Tree("a joint has one link on both sides"));
        }
        let joint = Joint { node, freedoms, effort, is_driven: freedoms == 0 };
        self.add(joint, name, &kind.value, model);
        if !model.connect(&parent.value, &child.value) {
            self.effects.refuse_mendable(node, Fault::Tree("the joint closes a loop"));
        }
        Ok(())
    }

    /// Adds a joint and its frames, whose names must be new.
    fn add<'t>(
        &mut self,
        joint: Joint<'t>,
        name: &'t Attribute<'t>,
        kind: &str,
        model: &mut Model<'_, 't>,
    ) {
        if model.joints.insert(&name.value, joint).is_some() {
            return self.effects.refuse_mendable(name, Fault::not_unique("joint", &name.value));
        }
        model.names.push(&name.value);
        let ends: &[&str] = if kind == "planar" { &["parent", "child"] } else { &["parent"] };
        for end in ends {
            let frame = format!("{}_{end}", name.value);
            if !model.frames.insert(frame) {
                let rule = "a link or frame is called so with `_parent` or `_child` behind it";
                self.effects.refuse_mendable(name, Fault::name("joint", &name.value, rule));
            }
        }
    }

    fn end<'t>(&mut self, joint: Node<'t>, name: &'static str) -> Reading<&'t Attribute<'t>> {
        let end = self.effects.needed_element(joint, name)?;
        self.effects.needed(end, "link")
    }

    fn axis(&mut self, joint: Node<'_>, part: &Part) -> Reading<()> {
        let axis = self.first(joint, "axis", part);
        let Some(xyz) = axis.and_then(|axis| axis.attribute("xyz")) else {
            return Ok(());
        };
        let squares = self.numbers(xyz, 3, part)?.iter().map(|number| number * number).sum::<f64>();
        if squares.sqrt() < 1e-8 || squares.is_infinite() {
            self.effects.refuse_mendable(xyz, Fault::range(xyz, "an axis needs a length"));
        }
        Ok(())
    }

    /// Limits and dynamics. Gives the limit of effort.
    fn motion(&mut self, joint: Node<'_>, kind: &str, part: &Part) -> Reading<f64> {
        let (limit_part, dynamics_part) = (part.inside("limit"), part.inside("dynamics"));
        let limit = self.first(joint, "limit", &limit_part);
        let dynamics = self.first(joint, "dynamics", &dynamics_part);
        let mut effort = f64::INFINITY;
        match kind {
            "revolute" | "continuous" | "prismatic" => {
                if let Some(limit) = limit {
                    effort = self.limit(limit, kind, &limit_part)?.unwrap_or(effort);
                }
                if let Some(dynamics) = dynamics {
                    self.dynamics(dynamics, &dynamics_part)?;
                }
            }
            "planar" => {
                if let Some(damping) = dynamics.and_then(|node| node.attribute("damping"))
                    && self.numbers(damping, 3, &dynamics_part)?.iter().any(|number| *number < 0.0)
                {
                    self.negative(damping);
                }
                if let Some(limit) = limit {
                    let fault = Fault::Way("limits of planar joints are not read");
                    self.effects.drop(limit, limit_part, fault);
                }
            }
            "fixed" => {
                if let Some(dynamics) = dynamics {
                    let fault = Fault::Way("a fixed joint has no dynamics");
                    self.effects.drop(dynamics, dynamics_part, fault);
                }
            }
            _ => {}
        }
        Ok(effort)
    }

    fn limit(&mut self, limit: Node<'_>, kind: &str, part: &Part) -> Reading<Option<f64>> {
        let mut number = |name| self.number(limit, name, part);
        let (lower, upper, effort) = (number("lower")?, number("upper")?, number("effort")?);
        for name in ["velocity", "drake:acceleration"] {
            self.not_negative(limit, name, part)?;
        }
        if let (Some(lower), Some(upper)) = (lower, upper)
            && lower > upper
        {
            self.effects.refuse_mendable(limit, CROSSED);
        }
        for (name, value) in [("lower", lower), ("upper", upper)] {
            if value.is_none() && kind != "continuous" {
                self.effects.read_as(limit, part, Fault::Missing(name), "no limit");
            }
        }
        if kind == "continuous" && (lower.is_some() || upper.is_some()) {
            let fault = Fault::Limits("a continuous joint is limited by `lower` and `upper`");
            self.effects.read_as(limit, part, fault, "a limited joint");
        }
        Ok(effort)
    }

    fn dynamics(&mut self, dynamics: Node<'_>, part: &Part) -> Reading<()> {
        self.not_negative(dynamics, "damping", part)?;
        self.number(dynamics, "coulomb_window", part)?;
        let friction = self.number(dynamics, "friction", part)?;
        if let Some(value) = dynamics.attribute("friction")
            && friction.is_some_and(|friction| friction != 0.0)
        {
            self.effects.read_as(value, part, Fault::NeverRead("friction".into()), "no friction");
        }
        Ok(())
    }

    fn not_negative(&mut self, node: Node<'_>, name: &str, part: &Part) -> Reading<()> {
        let Some(value) = node.attribute(name) else { return Ok(()) };
        if self.numbers(value, 1, part)?.iter().any(|number| *number < 0.0) {
            self.negative(value);
        }
        Ok(())
    }

    pub fn negative(&mut self, value: &Attribute<'_>) {
        self.effects.refuse_mendable(value, Fault::range(value, "must not be negative"));
    }

    fn mimic<'t>(&mut self, node: Node<'t>, model: &Model<'_, 't>) -> Reading<()> {
        let Some(mimic) = node.child("mimic") else { return Ok(()) };
        let name = node.value("name").unwrap_or_default();
        let of = self.effects.needed(mimic, "joint")?;
        let Some(leader) = model.joints.get(&*of.value) else {
            return self.effects.refuse(of, Fault::unknown("joint", &of.value));
        };
        if of.value == name {
            return self.effects.refuse(of, MIMICS_ITSELF);
        }
        let part = Part::of("joint", name).inside("mimic");
        self.number(mimic, "multiplier", &part)?;
        self.number(mimic, "offset", &part)?;
        let Some(follower) = model.joints.get(name) else { return Ok(()) };
        if follower.freedoms != leader.freedoms {
            let fault = Fault::Other("a joint mimics one of another number of degrees of freedom");
            return self.effects.refuse(mimic, fault);
        }
        if follower.freedoms != 1 {
            let fault = Fault::Other("only joints with one degree of freedom can mimic");
            self.effects.drop(mimic, part, fault);
        }
        Ok(())
    }

    fn transmission<'t>(
        &mut self,
        node: Node<'t>,
        model: &mut Model<'_, 't>,
        actuators: &mut HashSet<&'t str>,
    ) -> Reading<()> {
        let part = Part::of("transmission", node.value("name").unwrap_or_default());
        let kind = match node.child("type") {
            Some(kind) => match kind.text() {
                Some(text) => text,
                None => return self.effects.crash(kind, Fault::Other("`<type>` has no text")),
            },
            None => &*self.effects.needed(node, "type")?.value,
        };
        if !kind.contains("SimpleTransmission") {
            self.effects.drop(node, part, Fault::Way("only a SimpleTransmission is read"));
            return Ok(());
        }
        let actuator = self.effects.needed_element(node, "actuator")?;
        let actuator_name = self.effects.needed(actuator, "name")?;
        let of = self.effects.needed_element(node, "joint")?;
        let of = self.effects.needed(of, "name")?;
        let Some(joint) = model.joints.get_mut(&*of.value) else {
            return self.effects.refuse(of, Fault::unknown("joint", &of.value));
        };
        if joint.freedoms == 0 {
            self.effects.drop(of, part, Fault::Way("a fixed joint has a transmission"));
            return Ok(());
        }
        if joint.effort < 0.0 {
            let place = joint.node.child("limit").unwrap_or(joint.node);
            let fault = Fault::Other("a joint with a transmission has a negative `effort`");
            return self.effects.refuse(place, fault);
        }
        if joint.effort == 0.0 {
            let fault = Fault::Way("a transmission of a joint with `effort` 0 is not read");
            self.effects.drop(of, Part::of("joint", &of.value).inside("limit"), fault);
            return Ok(());
        }
        if joint.freedoms > 1 {
            let fault = Fault::Way("a joint with several degrees of freedom has a transmission");
            return self.effects.refuse(of, fault);
        }
        if !actuators.insert(&actuator_name.value) {
            let name = actuator_name;
            return self.effects.refuse(name, Fault::not_unique("actuator", &name.value));
        }
        joint.is_driven = true;
        let extensions: [(&str, &[&'static str]); 3] = [
            ("drake:rotor_inertia", &["value"]),
            ("drake:gear_ratio", &["value"]),
            ("drake:controller_gains", &["p", "d"]),
        ];
        for (element, names) in extensions {
            let Some(found) = actuator.child(element) else { continue };
            for name in names {
                let value = self.effects.needed(found, name)?;
                let number = self.numbers(value, 1, &part)?;
                if names.len() == 2 && number.iter().any(|number| *number < 0.0) {
                    self.negative(value);
                }
            }
        }
        Ok(())
    }

    fn frame<'t>(&mut self, frame: Node<'t>, model: &mut Model<'_, 't>) -> Reading<()> {
        let (name, link) =
            (self.effects.needed(frame, "name")?, self.effects.needed(frame, "link")?);
        if link.value != WORLD && !model.links.contains_key(&*link.value) {
            return self.effects.refuse(link, Fault::unknown("link", &link.value));
        }
        for vector in ["xyz", "rpy"] {
            self.vector(frame, vector, 3, &"frame".into())?;
        }
        if name.value.is_empty() {
            return self.effects.refuse(name, Fault::Empty("name"));
        }
        match model.frames.insert(name.value.to_string()) {
            true => Ok(()),
            false => {
                let fault = Fault::not_unique("link or frame", &name.value);
                self.effects.refuse_mendable(name, fault);
                Ok(())
            }
        }
    }
}

impl<'t> Model<'_, 't> {
    /// Connects two links; false if they are connected already.
    fn connect(&mut self, parent: &'t str, child: &'t str) -> bool {
        let (parent, child) = (self.group(parent), self.group(child));
        self.groups.insert(parent, child);
        parent != child
    }

    /// The link that stands for all that are connected with one.
    fn group(&mut self, mut link: &'t str) -> &'t str {
        while let Some(&next) = self.groups.get(link).filter(|next| **next != link) {
            // Halves the way for the next time.
            let far = self.groups.get(next).copied().unwrap_or(next);
            self.groups.insert(link, far);
            link = far;
        }
        link
    }
}

/// How many degrees of freedom a joint has; none of a type that is not for its element.
fn freedoms(kind: &str, is_own: bool) -> Option<usize> {
    match kind {
        "planar" => Some(3),
        "fixed" | "floating" if !is_own => Some(0),
        "revolute" | "continuous" | "prismatic" if !is_own => Some(1),
        "ball" if is_own => Some(3),
        "universal" if is_own => Some(2),
        "screw" | "curvilinear" if is_own => Some(1),
        _ => None,
    }
}

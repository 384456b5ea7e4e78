//! How Drake reads visuals and collisions, and springs, bushings and constraints that are its own.

use std::sync::Arc;

use crate::drake::{DrakeReader, Links};
use crate::prelude::*;

/// The shapes in the order in which Drake looks for them, and their sizes.
const SHAPES: [(&str, &[&str]); 7] = [
    ("box", &["size"]),
    ("sphere", &["radius"]),
    ("cylinder", &["radius", "length"]),
    ("capsule", &["radius", "length"]),
    ("drake:capsule", &["radius", "length"]),
    ("mesh", &[]),
    ("drake:ellipsoid", &["a", "b", "c"]),
];

impl DrakeReader<'_> {
    pub fn shape(&mut self, shape: Node<'_>, part: &Part) -> Reading<()> {
        let geometry = self.effects.needed_element(shape, "geometry")?;
        self.pose(shape, part);
        // Its material may be that of others, whatever its shape is.
        let form = self.form(geometry, part);
        if shape.name() == "visual" {
            self.color(shape, &part.inside("material"));
        }
        if let Some(name) = shape.attribute("name")
            && name.value.trim_matches(is_space).is_empty()
        {
            self.effects.refuse_mendable(name, Fault::Empty("name"));
        }
        match form? {
            mesh if mesh.name() == "mesh" => self.mesh(mesh, part, shape.name() == "collision"),
            _ => Ok(()),
        }
    }

    /// The shape in a `<geometry>`.
    fn form<'t>(&mut self, geometry: Node<'t>, part: &Part) -> Reading<Node<'t>> {
        let known = SHAPES.iter().find_map(|(name, sizes)| Some((geometry.child(name)?, *sizes)));
        let Some((form, sizes)) = known else {
            return self.effects.shapeless(geometry);
        };
        for name in sizes {
            let value = self.effects.needed(form, name)?;
            let count = if *name == "size" { 3 } else { 1 };
            let numbers = self.numbers(value, count, part)?;
            let may_be_zero = form.name() == "sphere";
            if numbers.iter().any(|&size| size < 0.0 || (size == 0.0 && !may_be_zero)) {
                let fault = Fault::range(value, "a size must be above 0");
                self.effects.refuse_mendable(value, fault);
            }
        }
        Ok(form)
    }

    fn color(&mut self, visual: Node<'_>, part: &Part) {
        let Some(material) = self.first(visual, "material", part) else { return };
        let Some((at, rgba)) = self.material(material, false) else { return };
        if rgba.iter().all(|number| (0.0..=1.0).contains(number)) {
            return;
        }
        let text: Vec<String> = rgba.iter().map(f64::to_string).collect();
        let fault = Fault::range_of("rgba", &text.join(" "), COLOR_RULE);
        self.effects.refuse_mendable(at, fault);
    }

    fn mesh(&mut self, mesh: Node<'_>, part: &Part, is_collision: bool) -> Reading<()> {
        let filename = self.effects.needed(mesh, "filename")?;
        let facts = self.found(filename, "mesh");
        if let Some(scale) = mesh.attribute("scale") {
            // One number stands for all three.
            let count = if scale.value.contains(' ') { 3 } else { 1 };
            let numbers = self.numbers(scale, count, part)?;
            if numbers.iter().any(|number| number.abs() < 1e-8) {
                let fault = Fault::range(scale, "a scale must not be 0");
                self.effects.refuse_mendable(scale, fault);
            }
        }
        if is_collision {
            self.hull(filename, facts.as_deref());
        }
        Ok(())
    }

    /// The convex hull of a collision's mesh.
    fn hull(&mut self, filename: &Attribute<'_>, facts: Option<&MeshFacts>) {
        let name = filename.value.rsplit('/').next().unwrap_or_default();
        let end = name.rsplit_once('.').filter(|(stem, _)| !stem.is_empty());
        let end = end.map(|(_, end)| end.to_ascii_lowercase()).unwrap_or_default();
        let why = match &*end {
            "obj" => match facts.and_then(|facts| Some((facts.obj.as_ref()?, &facts.measures))) {
                Some((obj, _)) if obj.vertices < 3 => "the mesh has fewer than three vertices",
                Some((obj, _)) if obj.faces == 0 => "the mesh has no face",
                Some((_, measures)) if measures.spread[0] < 1e-12 => "the mesh is a point",
                Some((_, measures)) if measures.spread[1] < 1e-12 => "the mesh is a line",
                _ => return,
            },
            "vtk" | "gltf" => return,
            _ => {
                let why = "a collision can only have a mesh in OBJ, glTF (.gltf) or VTK";
                let fault = match format_fault(name) {
                    FORMAT => Fault::ForOthers(why),
                    rare => rare,
                };
                return self.effects.refuse_mendable(filename, fault);
            }
        };
        self.effects.refuse_mendable(filename, Fault::Mesh(why));
    }

    /// What is in a file that must be there; none if that is not known.
    pub fn found(
        &mut self,
        filename: &Attribute<'_>,
        kind: &'static str,
    ) -> Option<Arc<MeshFacts>> {
        let name = &*filename.value;
        let mesh = match uri(name) {
            Some(("file", _, path)) => self.file.mesh(&format!("file:///{path}")),
            Some(("package" | "model", package, _)) if !package.is_empty() => self.file.mesh(name),
            None if name.is_empty() => Mesh::Unknown,
            None if !name.contains("://") => self.file.mesh(name),
            _ => Mesh::Missing,
        };
        let fault = match mesh {
            Mesh::Unknown => return None,
            Mesh::Found(facts) => return Some(facts),
            Mesh::NoPackage => NO_PACKAGE,
            Mesh::Missing => Fault::NotFound(kind),
        };
        self.effects.refuse_mendable(filename, fault);
        None
    }
}

/// Scheme, authority and path of a URI. `file://part.stl` is none to Drake.
fn uri(name: &str) -> Option<(&str, &str, &str)> {
    let (scheme, rest) = name.split_once("://")?;
    let (authority, path) = rest.split_once('/')?;
    let is_scheme =
        |byte: u8| byte.is_ascii_lowercase() || byte.is_ascii_digit() || b"+.-".contains(&byte);
    let fits = !scheme.is_empty() && scheme.bytes().all(is_scheme);
    fits.then(|| (scheme, authority, path.trim_start_matches('/')))
}

/// What an element has to name.
#[derive(Clone, Copy)]
enum End {
    Body(&'static str),
    Frame(&'static str),
}

/// What a value must be.
#[derive(Clone, Copy)]
enum Value {
    Any,
    NotNegative,
    Positive,
}

use End::{Body, Frame};
use Value::{Any, NotNegative, Positive};

/// An element, the elements in it that name its ends, and those that have numbers, and how many.
struct Force {
    name: &'static str,
    ends: &'static [End],
    numbers: &'static [(&'static str, usize, Value)],
}

const TENDON: &str = "drake:tendon_constraint";
const BALL: &str = "drake:ball_constraint";

const FORCES: [Force; 4] = [
    Force {
        name: "drake:linear_bushing_rpy",
        ends: &[Frame("drake:bushing_frameA"), Frame("drake:bushing_frameC")],
        numbers: &[
            ("drake:bushing_torque_stiffness", 3, NotNegative),
            ("drake:bushing_torque_damping", 3, NotNegative),
            ("drake:bushing_force_stiffness", 3, NotNegative),
            ("drake:bushing_force_damping", 3, NotNegative),
        ],
    },
    Force {
        name: "drake:linear_spring_damper",
        ends: &[
            Body("drake:linear_spring_damper_body_A"),
            Body("drake:linear_spring_damper_body_B"),
        ],
        numbers: &[
            ("drake:linear_spring_damper_p_AP", 3, Any),
            ("drake:linear_spring_damper_p_BQ", 3, Any),
            ("drake:linear_spring_damper_free_length", 1, Positive),
            ("drake:linear_spring_damper_stiffness", 1, NotNegative),
            ("drake:linear_spring_damper_damping", 1, NotNegative),
        ],
    },
    Force {
        name: BALL,
        ends: &[Body("drake:ball_constraint_body_A"), Body("drake:ball_constraint_body_B")],
        numbers: &[("drake:ball_constraint_p_AP", 3, Any), ("drake:ball_constraint_p_BQ", 3, Any)],
    },
    Force {
        name: TENDON,
        ends: &[],
        numbers: &[
            ("drake:tendon_constraint_offset", 1, Any),
            ("drake:tendon_constraint_lower_limit", 1, Any),
            ("drake:tendon_constraint_upper_limit", 1, Any),
            ("drake:tendon_constraint_stiffness", 1, Any),
            ("drake:tendon_constraint_damping", 1, Any),
        ],
    },
];

impl DrakeReader<'_> {
    /// `frames` has the links, too.
    pub fn forces(
        &mut self,
        robot: Node<'_>,
        links: &Links<'_>,
        frames: &HashSet<String>,
        is_joint: &dyn Fn(&str) -> bool,
    ) {
        for force in FORCES {
            for node in robot.named(force.name) {
                let _ = self.force(node, &force, links, frames);
                if force.name == TENDON {
                    let _ = self.tendon(node, is_joint);
                }
            }
        }
    }

    fn force(
        &mut self,
        node: Node<'_>,
        force: &Force,
        links: &Links<'_>,
        frames: &HashSet<String>,
    ) -> Reading<()> {
        let mut before = None;
        for end in force.ends {
            let (Body(element) | Frame(element)) = *end;
            let of = self.effects.needed_element(node, element)?;
            let of = self.effects.needed(of, "name")?;
            let (kind, is_there) = match end {
                Body(_) => ("link", links.contains_key(&*of.value)),
                Frame(_) => ("link or frame", frames.contains(&*of.value)),
            };
            if !is_there {
                return self.effects.refuse(of, Fault::unknown(kind, &of.value));
            }
            if force.name == BALL && before == Some(&of.value) {
                return self.effects.refuse(of, Fault::Other("a ball has one link on both sides"));
            }
            before = Some(&of.value);
        }
        for &(element, count, value) in force.numbers {
            let of = self.effects.needed_element(node, element)?;
            let written = self.effects.needed(of, "value")?;
            let numbers = self.numbers(written, count, &force.name.into())?;
            match value {
                NotNegative if numbers.iter().any(|number| *number < 0.0) => {
                    self.negative(written);
                }
                Positive if numbers.iter().any(|number| *number <= 0.0) => {
                    let fault = Fault::range(written, "must be above 0");
                    self.effects.refuse_mendable(written, fault);
                }
                _ => {}
            }
        }
        Ok(())
    }

    /// The joints of a tendon, each with a factor.
    fn tendon(&mut self, node: Node<'_>, is_joint: &dyn Fn(&str) -> bool) -> Reading<()> {
        const JOINT: &str = "drake:tendon_constraint_joint";
        self.effects.needed_element(node, JOINT)?;
        for joint in node.named(JOINT) {
            let name = self.effects.needed(joint, "name")?;
            if !is_joint(&name.value) {
                return self.effects.refuse(name, Fault::unknown("joint", &name.value));
            }
            let factor = self.effects.needed(joint, "a")?;
            self.numbers(factor, 1, &TENDON.into())?;
        }
        Ok(())
    }
}

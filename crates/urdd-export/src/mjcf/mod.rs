//! MJCF: bodies, joints, the URDD's shapes as geoms, and pairs that need no collision check, per piece.
//!
//! A floating joint becomes three slide joints and a ball joint, regardless of its parent, so that its position is
//! relative to the joint's frame; a free joint's position would be in the world frame. The root link is fixed to the
//! world, unless [`floating_base`](crate::Choices::floating_base) asks for a free joint. Mimic joints become
//! equality constraints with chains resolved, which MuJoCo enforces only in simulation: a caller that sets positions must
//! set those of mimic joints too. MuJoCo's own parent-child filter is switched off, so that the pairs are those of the
//! URDD. MuJoCo never checks two rigidly connected bodies, those without a joint between them.
//!
//! Kinematic loops are equality constraints too: `connect` and `weld` between sites, and polynomials of joints. Sites say where
//! the ends are; a `connect` of two bodies takes the second end from the pose of the model, in which loops may be open.

pub(super) mod actuators;
mod body;
mod keyframes;

use nalgebra::Translation3;

use crate::joints::{
    Closing, LeftOut, OTHER_KIND, closings as loops_of, is_linear, joints_of_dofs, names,
};
use crate::output::fill;
use crate::{Export, ExportError, Files, Note, Stand, Subject, Taken};
use body::{Bodies, geom_name, placed, site_named};
use urdd_document::tree::RigidGroups;
use urdd_format::loops::{Coupling, LoopKind};
use urdd_xml::number::{number, numbers};
use urdd_xml::writer::{Element, escaped, head};

const SEVERAL: &str =
    "it mimics a joint of several DOFs, which MuJoCo cannot express; it moves freely";

const WORLD: &str = "the root link is called `world`, which is MuJoCo's own body and never moves; the base is not free";

pub(super) fn export(subject: &Subject) -> Result<Export, ExportError> {
    let options = &subject.options.chosen;
    let scene_of = subject.options.file.as_ref().filter(|_| options.scene);
    let stand = Stand::new(subject, scene_of.is_some())?;
    let mut bodies = Bodies::new(subject)?;
    let closings = closings(subject, &mut bodies.notes)?;
    bodies.sites = closings.sites;
    let world = bodies.world(stand.base_height)?;
    let mut notes = bodies.notes;
    if subject.is_floating && !subject.has_free_base() {
        notes.push(Note::Robot(WORLD));
    }
    let mut compiler = Element::new("compiler").with("angle", "radian").with("autolimits", "true");
    if bodies.balanced {
        compiler = compiler.with("balanceinertia", "true");
    }
    let mut root = Element::new("mujoco").with("model", subject.urdf.name.as_str());
    root.push(compiler);
    let flag = Element::new("flag").with("filterparent", "disable");
    let mut option = Element::new("option").holding(flag);
    if !closings.equalities.is_empty() {
        option = option.with("integrator", INTEGRATOR);
    } else if options.actuators.is_some() {
        // The damping of actuators is integrated implicitly: it is stable for light links too.
        option = option.with("integrator", "implicitfast");
    }
    root.push(option);
    root.push(classes(subject));
    root.push_filled(bodies.assets);
    root.push(world);
    let mut equality = equality(subject, &mut notes);
    equality.extend(closings.equalities);
    root.push_filled(equality);
    root.push_filled(contact(subject));
    let mut what = format!("Geoms for collision: {}.", subject.shapes);
    if let Some(kind) = options.actuators {
        let (actuators, said) = actuators::actuators(subject, kind, &mut notes)?;
        what += &said;
        root.push_filled(actuators);
    }
    if options.sensors {
        root.push_filled(body::sensors(subject));
    }
    root.push_filled(keyframes::keyframes(subject, options.actuators, &stand)?);
    let mut files = bodies.files.into_files();
    if let Some(file) = scene_of {
        files.extend(scene(subject, file, &stand)?);
    }
    let text = root.document(&subject.comments(what, &notes)?);
    Ok(Export::of(text, files, notes))
}

/// Masses come from the URDF, so geoms have no density.
fn classes(subject: &Subject) -> Element {
    let geom = |class: &'static str, geom: Element| {
        let geom = geom.with("density", "0");
        Element::new("default").with("class", class).holding(geom)
    };
    let friction = subject.friction().map(number);
    let collision = Element::new("geom").with("group", "3").with_some("friction", friction);
    let visual =
        Element::new("geom").with("group", "2").with("contype", "0").with("conaffinity", "0");
    Element::new("default").holding(geom("collision", collision)).holding(geom("visual", visual))
}

/// The pairs that MuJoCo does not check and, for mixed pairs, those that it does: an `<exclude>` applies to two bodies,
/// and a `<pair>` of two geoms is checked in spite of it. Bit masks (`contype`, `conaffinity`) are insufficient: they
/// have 32 bits, and a robot can have hundreds of distinct shapes.
fn contact(subject: &Subject) -> Element {
    let mut contact = Element::new("contact");
    let groups = RigidGroups::new(&subject.view, &subject.tree);
    let mut pairs = Vec::new();
    for pair in &subject.pairs {
        if !pair.disabled && pair.mixed.is_none() {
            continue;
        }
        let [a, b] = pair.names.each_ref().map(String::as_str);
        contact.push(Element::new("exclude").with("body1", a).with("body2", b));
        let [one, other] = pair.links.map(|link| groups.of_link[link]);
        // Links that are fixed to each other touch always or never: MuJoCo does not check them.
        if let Some(mixed) = &pair.mixed
            && one != other
        {
            let geoms = |pieces: &[usize; 2]| {
                let pair = Element::new("pair").with("geom1", geom_name(a, pieces[0]));
                pair.with("geom2", geom_name(b, pieces[1]))
            };
            pairs.extend(mixed.checked.iter().map(geoms));
        }
    }
    contact.extend(pairs);
    contact
}

/// Mimic joints: `position = offset + multiplier * position of the driver`; and locked joints.
fn equality(subject: &Subject, notes: &mut Vec<Note>) -> Element {
    let mut equality = Element::new("equality");
    for (index, joint) in subject.view.joints.iter().enumerate() {
        if let Some(position) = subject.locked_at(index) {
            let coefficients = numbers(&[position, 0.0, 0.0, 0.0, 0.0]);
            let held = Element::new("joint").with("joint1", joint.name.as_str());
            // Stiffer than a mimic: an arm sags by less than 1e-4 rad.
            equality.push(held.with("polycoef", coefficients).with("solimp", "0.999 0.999 0.001"));
        }
        let Some(mimic) = &subject.mimics.by_joint[index] else { continue };
        let driver = &subject.view.joints[mimic.driver];
        let mut element = Element::new("joint").with("joint1", joint.name.as_str());
        let factor = match driver.num_dofs() {
            1 => {
                element = element.with("joint2", driver.name.as_str());
                mimic.multiplier
            }
            // A fixed joint is at 0.
            0 => 0.0,
            _ => {
                notes.push(Note::joint(&joint.name, SEVERAL));
                continue;
            }
        };
        let coefficients = numbers(&[mimic.offset, factor, 0.0, 0.0, 0.0]);
        equality.push(element.with("polycoef", coefficients));
    }
    equality
}

/// Names of our geoms have a slash: none is called as the floor.
const SCENE: &str = include_str!("scene.xml.in");

fn scene(subject: &Subject, file: &str, stand: &Stand) -> Result<Files, ExportError> {
    let stem = file.strip_suffix(".xml").unwrap_or(file);
    let floor = number(stand.floor);
    let what = format!("The floor is at z = {floor} m.");
    let values =
        [("ROBOT", escaped(&subject.urdf.name)), ("FILE", escaped(file)), ("FLOOR", floor)];
    let text = head(&subject.comments(what, &[])?) + &fill(SCENE, &values);
    Ok(vec![(format!("{stem}_scene.xml"), text.into_bytes())])
}

/// Nearly as stiff as MuJoCo's time step of 2 ms lets it be, whatever the mass of a rod: three times that, critically damped.
const SOLREF: &str = "0.006 1";
/// The largest impedance that MuJoCo takes.
const SOLIMP: &str = "0.9999 0.9999 0.001";

/// Rods of some grams that swing fast are stable only with the derivatives of their Coriolis forces, which `implicitfast`
/// leaves out.
const INTEGRATOR: &str = "implicit";

const OTHER_SUM: &str =
    "equality constraints are of one joint, or of one as a polynomial of another";

#[derive(Default)]
struct Closings {
    /// For each link, its sites.
    sites: Vec<Vec<Element>>,
    equalities: Vec<Element>,
}

fn closings(subject: &Subject, notes: &mut Vec<Note>) -> Result<Closings, ExportError> {
    let mut made = Closings { sites: vec![Vec::new(); subject.links.len()], ..Closings::default() };
    let mut left_out = LeftOut::default();
    let Some(module) = subject.robot.loops()? else { return Ok(made) };
    let names = names(subject.format, module);
    let mut taken = Taken::new(names.iter());
    for closing in loops_of(subject, &mut left_out)? {
        if !made.hold(subject, &closing, &mut taken) {
            left_out.of_loop(&closing.of.name, OTHER_KIND);
        }
    }
    let dofs = joints_of_dofs(subject)?;
    for (coupling, name) in module.couplings.iter().zip(&names[module.loops.len()..]) {
        match equation(subject, &dofs, coupling, name) {
            Some(element) => made.equalities.push(element),
            None => left_out.coupling(&coupling.name, OTHER_SUM),
        }
    }
    notes.extend(left_out.notes());
    Ok(made)
}

impl Closings {
    /// Adds what holds a loop; false for a kind that nothing holds.
    fn hold(&mut self, subject: &Subject, closing: &Closing, taken: &mut Taken) -> bool {
        let Some(points) = closing.points() else { return false };
        let word = if closing.of.kind == LoopKind::Fixed { "weld" } else { "connect" };
        for (number, along) in points.iter().enumerate() {
            let own = match number {
                0 => closing.name.clone(),
                _ => taken.free(format!("{}/{number}", closing.name)),
            };
            let mut element = Element::new(word).with("name", own);
            for ((key, end), on) in [("site1", "a"), ("site2", "b")].into_iter().zip(closing.ends) {
                // Our names of sites have two slashes and the number of the loop.
                let name = format!("loop/{}/{end}{number}", closing.number);
                let name = subject.names.taken.untaken(name);
                let pose = on.pose * Translation3::new(0.0, 0.0, *along);
                self.sites[on.link].push(placed(site_named(&name), &pose));
                element = element.with(key, name);
            }
            self.equalities.push(stiff(element));
        }
        true
    }
}

/// A coupling as an equality of one joint, or of two. `None` if it is of more, or of no joint as a polynomial of the other.
fn equation(
    subject: &Subject,
    dofs: &[(Option<usize>, bool)],
    coupling: &Coupling,
    name: &str,
) -> Option<Element> {
    let joint = |dof: usize| Some(&subject.view.joints[dofs.get(dof)?.0?]);
    let (follower, leader) = match &coupling.terms[..] {
        [one] if is_linear(&one.coefficients) => (one, None),
        [one, other] if is_linear(&other.coefficients) => (other, Some(one)),
        [one, other] if is_linear(&one.coefficients) => (one, Some(other)),
        _ => return None,
    };
    let joint1 = joint(follower.dof_idx.get())?;
    let factor = -1.0 / follower.coefficients[0];
    let mut polynomial = [coupling.constant * factor, 0.0, 0.0, 0.0, 0.0];
    let mut element = Element::new("joint").with("name", name).with("joint1", joint1.name.as_str());
    if let Some(leader) = leader {
        let joint2 = joint(leader.dof_idx.get())?;
        element = element.with("joint2", joint2.name.as_str());
        for (to, coefficient) in polynomial[1..].iter_mut().zip(leader.coefficients) {
            *to = coefficient * factor;
        }
    }
    let is_finite = polynomial.iter().all(|number| number.is_finite());
    is_finite.then(|| stiff(element.with("polycoef", numbers(&polynomial))))
}

fn stiff(element: Element) -> Element {
    element.with("solref", SOLREF).with("solimp", SOLIMP)
}

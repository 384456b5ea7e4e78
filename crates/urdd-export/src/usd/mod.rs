//! USD, for Isaac, Newton and Omniverse: one asset, a robot as rigid bodies under one articulation.
//!
//! Links are prims side by side, where they are in the default configuration. Joints say where they are in their two links.
//! USD has binary32 for these, degrees for angles, and no names but those of `prim`. Newton's and PhysX' own
//! attributes say what UsdPhysics has no words for; other programs pass over them.

mod joints;
pub(super) mod prim;
mod shapes;

use nalgebra::{Isometry3, UnitQuaternion};

use crate::gains::gains;
use crate::inertia::{Odd, mass};
use crate::joints::{Followers, LeftOut, closings};
use crate::meshes::looks;
use crate::names::last;
use crate::{Export, ExportError, MeshFiles, Note, Stand, Subject};
use joints::Joints;
use prim::{Filters, Paths, Prim, float, floats, wxyz};
use shapes::Materials;

const WORLD: &str = "the root link is called `world`, which never moves; the base is not free";
const ELSEWHERE: &str = "Bodies are in the default configuration, in which joints are not at 0; `state` of a joint has its position";

const CLOSED: &str = "Bodies are in the reference configuration, in which loops are closed; `state` of a joint has its position";

pub(super) fn export(subject: &Subject) -> Result<Export, ExportError> {
    if let Some(file) = &subject.options.file
        && let Some(ending) = [".usdc", ".usdz"].into_iter().find(|of| file.ends_with(of))
    {
        return Err(ExportError::Binary { file: file.clone(), ending });
    }
    let mut notes = Vec::new();
    let paths = Paths::new(subject);
    let filters = Filters::new(subject, &paths);
    let mut left_out = LeftOut::default();
    let closings = closings(subject, &mut left_out)?;
    let followers = Followers::new(subject, &mut left_out)?;
    let module = subject.robot.loops()?;
    let default = || subject.robot.configurations().map(|of| of.zero());
    let zero = module.map_or_else(default, |module| Ok(module.reference_configuration.clone()))?;
    let stand = Stand::new(subject, false)?;
    let up = Isometry3::translation(0.0, 0.0, stand.base_height);
    let poses = subject.link_poses(&zero)?;
    let mut files = MeshFiles::new(subject);
    let mut materials = Materials::new(&format!("/{}", paths.root), &paths.scopes[1]);
    let mut links: Vec<Prim> = Vec::new();
    for (link, pose) in poses.iter().enumerate() {
        let mut prim = Prim::new("Xform", last(&paths.links[link]));
        prim.show(&subject.links[link]);
        prim::elements(&mut prim, &subject.urdf.links[link].unknown_elements);
        if subject.is_frame(link)
            && let Some(body) = subject.tree.parent_link[link]
        {
            shapes::place(&mut prim, &(poses[body].inverse() * pose), None);
            links.push(prim);
            continue;
        }
        prim.apply("PhysicsRigidBodyAPI");
        shapes::place(&mut prim, &(up * pose), None);
        filters.apply(&paths.links[link], &mut prim);
        links.push(prim);
    }
    add_masses(subject, &mut links, &mut notes);
    shapes::add_looks(&looks(subject, &mut notes)?, &mut links, &mut materials, &mut files);
    let contact = subject.friction().map(|friction| materials.contact(friction));
    let names = (&filters, &paths);
    shapes::add_shapes(subject, &mut links, contact.as_ref(), names, &mut files, &mut notes)?;

    let mut what = format!("Collision geometry: {}.", subject.shapes);
    let mut drives = None;
    if let Some(kind) = subject.options.chosen.actuators {
        let (gains, said) = gains(subject, kind, &mut notes)?;
        what += &said;
        drives = Some(gains);
    }
    let values = subject.values(&zero)?;
    if values.values().any(|value| *value != 0.0) {
        notes.push(Note::Robot(if module.is_some() { CLOSED } else { ELSEWHERE }));
    }
    let joints = Joints { subject, paths: &paths, filters: &filters, drives, followers, values };
    let mut scope = Prim::new("Scope", paths.scopes[0].as_str());
    if !subject.has_free_base() {
        scope.push(joints.to_world());
        if subject.is_floating {
            notes.push(Note::Robot(WORLD));
        }
    }
    for index in (0..subject.view.joints.len()).filter(|joint| !subject.is_of_frame(*joint)) {
        scope.push(joints.prim(index, &mut notes));
    }
    let mut taken = paths.taken_joints.clone();
    for closing in &closings {
        let name = taken.free(prim::mend(&closing.name));
        match joints::closing_prim(subject, &paths, name, closing) {
            Some(prim) => scope.push(prim),
            None => left_out.of_loop(&closing.of.name, joints::UNIVERSAL),
        }
    }
    notes.extend(left_out.notes());
    let is_whole = |note: &Note| matches!(note, Note::Mixed { disabled: true, .. });
    notes.extend(subject.notes().into_iter().filter(is_whole));
    if !paths.mended.is_empty() {
        notes.push(Note::Mended(paths.mended.clone()));
    }
    let mut root = Prim::new("Xform", paths.root.as_str());
    root.show(&subject.urdf.name);
    root.describe("kind", "\"component\"");
    prim::robot(subject, &mut root)?;
    root = root.applying(&["PhysicsArticulationRootAPI", "NewtonArticulationRootAPI"]);
    let mut links: Vec<Option<Prim>> = links.into_iter().map(Some).collect();
    for link in (0..links.len()).filter(|link| subject.is_frame(*link)) {
        let frame = links[link].take();
        let body = subject.tree.parent_link[link].and_then(|body| links[body].as_mut());
        frame.into_iter().zip(body).for_each(|(frame, body)| body.push(frame));
    }
    links.into_iter().flatten().for_each(|link| root.push(link));
    root.push_filled(scope);
    root.push_filled(materials.scope);
    let text = root.file(&subject.comments(what, &notes)?);
    Ok(Export::of(text, files.into_files(), notes))
}

/// What a link without mass has, kg and kg m²: a ball of 5 cm has these moments.
const LEAST_MASS: f64 = 1e-6;
const LEAST_MOMENT: f64 = 1e-9;

const MASSLESS: &str =
    "no mass: written with 1e-6 kg and 1e-9 kg m2, since USD computes a mass of 0 from the shapes";
const NO_INERTIA: &str =
    "a moment of inertia of 0, which USD takes for not given: written as 1e-9 kg m2";

fn words(odd: Odd) -> &'static str {
    match odd {
        Odd::Negative => "its mass is negative, and written as 1e-6 kg",
        Odd::Indefinite => {
            "its inertia has a negative principal moment; the mass stays, and the moments are 1e-9 kg m2"
        }
        Odd::Triangle => {
            "a principal moment of inertia is more than the other two together, which no body has; it is written as it is, and Newton corrects it"
        }
    }
}

/// Adds the masses to the links, in link order.
fn add_masses(subject: &Subject, links: &mut [Prim], notes: &mut Vec<Note>) {
    let [mut massless, mut flat] = [Vec::new(), Vec::new()];
    let bodies = links.iter_mut().zip(&subject.view.links).enumerate();
    for (_, (prim, view)) in bodies.filter(|(link, _)| !subject.is_frame(*link)) {
        let (found, odd) = view.inertial.as_ref().map_or((None, None), mass);
        let note = |odd| Note::Inertia { link: view.name.clone(), what: words(odd) };
        notes.extend(odd.map(note));
        let mut own = found.unwrap_or_default();
        if !own.is_enough() {
            if own.mass <= 0.0 {
                own.mass = LEAST_MASS;
                if odd != Some(Odd::Negative) {
                    massless.push(view.name.clone());
                }
            } else if odd != Some(Odd::Indefinite) {
                flat.push(view.name.clone());
            }
            own.moments.apply(|moment| *moment = moment.max(LEAST_MOMENT));
        }
        let axes = UnitQuaternion::from_rotation_matrix(&own.axes);
        prim.apply("PhysicsMassAPI");
        prim.set("float physics:mass", float(own.mass));
        prim.set("point3f physics:centerOfMass", floats(&own.centre));
        prim.set("float3 physics:diagonalInertia", floats(own.moments.as_slice()));
        prim.set("quatf physics:principalAxes", floats(&wxyz(&axes)));
    }
    notes.extend(Note::links(massless, MASSLESS));
    notes.extend(Note::links(flat, NO_INERTIA));
}

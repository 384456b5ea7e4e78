//! Masses and inertias of links. USD takes 0 for what is not said, and computes it from shapes: each link says its own.

use super::prim::{Prim, float, floats, wxyz};
use crate::inertia::Odd;
use crate::mjcf::inertia::{Mass, mass};
use crate::{Note, Subject};
use nalgebra::UnitQuaternion;

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
pub(super) fn add(subject: &Subject, links: &mut [Prim], notes: &mut Vec<Note>) {
    let [mut massless, mut flat] = [Vec::new(), Vec::new()];
    let bodies = links.iter_mut().zip(&subject.view.links).enumerate();
    for (_, (prim, view)) in bodies.filter(|(link, _)| !subject.is_frame(*link)) {
        let (found, odd) = view.inertial.as_ref().map_or((None, None), mass);
        let note = |odd| Note::Inertia { link: view.name.clone(), what: words(odd) };
        notes.extend(odd.map(note));
        let mut own = found.unwrap_or(Mass::NONE);
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

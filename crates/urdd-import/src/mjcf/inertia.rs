//! Masses: as a model says them, or from shapes, as MuJoCo's compiler does.

use nalgebra::Matrix3;

use super::super::mass::{moments, tensor, turned, volume};
use super::super::model::Inertial;
use super::super::place::Place;
use super::super::refusal::{Fallible, at};
use super::assets::Assets;
use super::body::RawBody;
use super::compiler::{Compiler, FromShapes};
use super::fault::MjcfFault;
use super::fit::Fitted;
use super::geom::Geom;
use super::mesh::Meshes;
use super::orientation::orientation;
use super::principal::principal;
use super::reading::{Attributes, View, missing};

/// Masses that are smaller are none.
const SMALL: f64 = 1e-14;
/// How far, as a part, moments may break A + B ≥ C where they were computed.
const ROUNDING: f64 = 1e-9;

/// The mass of a body, if it has one.
pub fn inertial(
    body: &RawBody<'_>,
    fitted: &[Fitted],
    compiler: &Compiler,
    meshes: &mut Meshes<'_>,
    assets: &Assets<'_>,
) -> Fallible<Option<Inertial>> {
    let mut part = body.inertial.map(|view| said(view, compiler)).transpose()?;
    let place = body.inertial.map_or(body.place, |view| view.element.place);
    let is_from_shapes = match compiler.from_shapes {
        FromShapes::Never => false,
        FromShapes::Always => true,
        FromShapes::Auto => part.is_none(),
    };
    if is_from_shapes {
        let mut parts = Vec::new();
        for (geom, fitted) in body.geoms.iter().zip(fitted) {
            if compiler.mass_groups.contains(&geom.group) {
                parts.extend(of_shape(geom, fitted, meshes, assets)?);
            }
        }
        part = Inertial::together(&parts).or(part);
    }
    // MuJoCo puts the least mass of a body that has none where the body is, but in the body's frame.
    let centre = body.written_position.into();
    let mut part = part.unwrap_or(Inertial { mass: 0.0, centre, inertia: Matrix3::zeros() });
    part.mass = part.mass.max(compiler.least_mass);
    part.inertia = bounded(part.inertia, compiler, place)?;
    let is_none = part.mass == 0.0 && part.inertia == Matrix3::zeros();
    part.inertia = (part.inertia + part.inertia.transpose()) / 2.0;
    Ok((!is_none).then_some(part))
}

/// `<inertial>`.
fn said(view: View<'_>, compiler: &Compiler) -> Fallible<Inertial> {
    let element = view.element;
    let missing = |attribute| missing(element, attribute);
    let centre = view.numbers::<3>("pos")?.ok_or_else(|| missing("pos"))?;
    let mass = view.number("mass")?.ok_or_else(|| missing("mass"))?;
    let turn = orientation(view, compiler)?;
    let diagonal = view.numbers::<3>("diaginertia")?;
    let full = view.numbers::<6>("fullinertia")?;
    if full.is_some() && (turn.is_some() || diagonal.is_some()) {
        return Err(at(element.place, MjcfFault::TwoInertias));
    }
    let inertia = match full {
        Some(full) => {
            let full = tensor(full);
            if principal(&full).0[2] < SMALL {
                return Err(at(element.place, MjcfFault::FullInertia));
            }
            full
        }
        None => {
            let moments = diagonal.unwrap_or_default().into();
            turned(&Matrix3::from_diagonal(&moments), &turn.unwrap_or_default())
        }
    };
    let is_negative = mass < 0.0 || diagonal.is_some_and(|of| of.iter().any(|of| *of < 0.0));
    if is_negative {
        return Err(at(element.place, MjcfFault::NegativeMass));
    }
    Ok(Inertial { mass, centre: centre.into(), inertia })
}

/// The mass of a shape, if it has one.
fn of_shape(
    geom: &Geom<'_>,
    fitted: &Fitted,
    meshes: &mut Meshes<'_>,
    assets: &Assets<'_>,
) -> Fallible<Option<Inertial>> {
    if geom.mass.unwrap_or(geom.density) == 0.0 {
        return Ok(None);
    }
    if geom.mass.is_some_and(|mass| mass < 0.0) || geom.density < 0.0 {
        return Err(at(geom.place, MjcfFault::NegativeMass));
    }
    let mesh = geom.mesh.filter(|_| geom.kind.is_mesh());
    let measures = mesh.map(|mesh| meshes.measures(mesh, geom.place, assets)).transpose()?;
    let solid = geom.kind.solid(fitted.size);
    let size = match (&measures, &solid) {
        (Some(measures), _) => measures.mass,
        (None, Some(solid)) => volume(solid, geom.is_shell),
        (None, None) => 0.0,
    };
    let mass = match geom.mass {
        Some(mass) if size > SMALL => mass,
        Some(_) => 0.0,
        None => geom.density * size,
    };
    if mass <= SMALL {
        return Ok(None);
    }
    let own = match (&measures, &solid) {
        (Some(measures), _) => measures.weighing(mass),
        (None, solid) => {
            let moments = solid.as_ref().map(|solid| moments(solid, geom.is_shell, mass));
            Inertial::along_axes(mass, moments.unwrap_or_default())
        }
    };
    Ok(Some(own.at(&fitted.pose)))
}

/// An inertia within what the compiler asks of the principal moments.
fn bounded(inertia: Matrix3<f64>, compiler: &Compiler, place: Place) -> Fallible<Matrix3<f64>> {
    let (found, axes) = principal(&inertia);
    let moments = found.map(|moment| moment.max(compiler.least_inertia));
    let [a, b, c] = moments;
    // The greatest is first.
    if b + c >= a * (1.0 - ROUNDING) {
        let raised = || turned(&Matrix3::from_diagonal(&moments.into()), &axes);
        return Ok(if moments == found { inertia } else { raised() });
    }
    if !compiler.balances {
        let moments = moments.map(|moment| format!("{moment:.3e}")).join(", ");
        return Err(at(place, MjcfFault::Unbalanced(moments)));
    }
    Ok(Matrix3::identity() * ((a + b + c) / 3.0))
}

//! Masses, as a model says them, or from shapes, as MuJoCo's compiler does; and the primitives that it fits to meshes.

use nalgebra::{Isometry3, Matrix3, Point3, Translation3, UnitQuaternion, Vector3};
use urdd_geometry::mesh::Bounds;

use super::assets::Assets;
use super::body::RawBody;
use super::compiler::{Compiler, orientation};
use super::geom::{Geom, GeomKind};
use super::mesh::Meshes;
use super::reading::{Attributes, View, missing};
use crate::fault::MjcfFault;
use crate::mass::{moments, tensor, turned, volume};
use crate::model::Inertial;
use crate::place::{Fallible, Place, at};

/// Masses that are smaller are none.
const SMALL: f64 = 1e-14;
/// How far, as a part, moments may break A + B ≥ C where they were computed.
const ROUNDING: f64 = 1e-9;

pub fn inertial(
    body: &RawBody<'_>,
    fitted: &[Fitted],
    compiler: &Compiler,
    meshes: &mut Meshes<'_>,
    assets: &Assets<'_>,
) -> Fallible<Option<Inertial>> {
    let mut part = body.inertial.map(|view| said(view, compiler)).transpose()?;
    let place = body.inertial.map_or(body.place, |view| view.element.place);
    if compiler.from_shapes.unwrap_or(part.is_none()) {
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

/// A shape with its size: its frame in its body's, radius and half lengths.
#[derive(Debug, Clone, Copy)]
pub struct Fitted {
    pub pose: Isometry3<f64>,
    pub size: [f64; 3],
}

pub fn fitted(
    geom: &Geom<'_>,
    compiler: &Compiler,
    meshes: &mut Meshes<'_>,
    assets: &Assets<'_>,
) -> Fallible<Fitted> {
    let mesh = match geom.mesh {
        Some(mesh) if geom.kind.sizes() > 0 => mesh,
        _ => return Ok(Fitted { pose: geom.pose, size: geom.size }),
    };
    let measures = meshes.measures(mesh, geom.place, assets)?;
    let (moments, axes) = principal(&measures.inertia);
    let mut frame = Isometry3::from_parts(measures.centre.coords.into(), axes);
    let [a, b, c] = match compiler.fits_boxes {
        false => {
            // The half lengths of the box that has these moments.
            let sum: f64 = moments.iter().sum();
            moments.map(|moment| (1.5 * (sum - 2.0 * moment).max(0.0) / measures.mass).sqrt())
        }
        true => {
            let placed = meshes.placed(mesh, geom.place, assets)?;
            let points = placed
                .vertices
                .iter()
                .map(|vertex| frame.inverse_transform_point(&Point3::from(*vertex)).coords.into());
            let bounds = Bounds::of(points);
            let centre = [0, 1, 2].map(|axis| (bounds.min[axis] + bounds.max[axis]) / 2.0);
            frame *= Translation3::from(centre);
            bounds.size().map(|length| length / 2.0)
        }
    };
    let size = match (geom.kind, compiler.fits_boxes) {
        (GeomKind::Sphere, false) => [(a + b + c) / 3.0, 0.0, 0.0],
        (GeomKind::Sphere, true) => [a.max(b).max(c), 0.0, 0.0],
        (GeomKind::Capsule, false) => [(a + b) / 2.0, (c - (a + b) / 4.0).max(0.0), 0.0],
        (GeomKind::Cylinder, false) => [(a + b) / 2.0, c, 0.0],
        (GeomKind::Capsule, true) => [a.max(b), c - a.max(b), 0.0],
        (GeomKind::Cylinder, true) => [a.max(b), c, 0.0],
        _ => [a, b, c],
    };
    let size = size.map(|size| size * geom.fit_scale);
    if let Some(wrong) = size[..geom.kind.sizes()].iter().position(|size| *size <= 0.0) {
        return Err(at(geom.place, MjcfFault::Size(wrong + 1)));
    }
    Ok(Fitted { pose: geom.pose * frame, size })
}

/// Elements beside the diagonal that are smaller, as a part of the greatest moment, are 0.
const BESIDE: f64 = 1e-16;
/// Moments that differ by less, as a part of the greatest, are equal.
const EQUAL: f64 = 1e-12;
/// Rounds of Jacobi's method. A handful is enough.
const MOST: usize = 100;

/// The moments, the greatest first, and the rotation to their axes. It matters which axes of equal moments are chosen
/// where a primitive is fitted to a mesh; so this is Jacobi's method, which turns away the greatest element first.
pub fn principal(inertia: &Matrix3<f64>) -> ([f64; 3], UnitQuaternion<f64>) {
    let mut axes = UnitQuaternion::identity();
    let mut values = [0.0; 3];
    let size = inertia.amax();
    for _ in 0..MOST {
        let basis = axes.to_rotation_matrix();
        let turned = basis.matrix().transpose() * inertia * basis.matrix();
        values = [0, 1, 2].map(|axis| turned[(axis, axis)]);
        let beside = |row, column| turned[(row, column)].abs();
        let (row, column, about) = if beside(0, 1) > beside(0, 2) && beside(0, 1) > beside(1, 2) {
            (0, 1, 2)
        } else if beside(0, 2) > beside(1, 2) {
            (0, 2, 1)
        } else {
            (1, 2, 0)
        };
        if beside(row, column) <= BESIDE * size {
            break;
        }
        let tau = (values[column] - values[row]) / (2.0 * turned[(row, column)]);
        let tangent = tau.signum() / (tau.abs() + (1.0 + tau * tau).sqrt());
        let angle = if about == 1 { tangent.atan() } else { -tangent.atan() };
        axes *= turn(about, angle);
    }
    for first in [0, 1, 0] {
        if values[first] + EQUAL * size < values[first + 1] {
            values.swap(first, first + 1);
            axes *= turn((first + 2) % 3, std::f64::consts::FRAC_PI_2);
        }
    }
    (values, axes)
}

fn turn(about: usize, angle: f64) -> UnitQuaternion<f64> {
    let axes = [Vector3::x_axis(), Vector3::y_axis(), Vector3::z_axis()];
    UnitQuaternion::from_axis_angle(&axes[about], angle)
}

//! Masses of bodies: what they say, and what follows from the shapes that collide.

use nalgebra::{Matrix3, Point3, UnitQuaternion};
use urdd_usd::{Authored, Prim};

use super::form::rubbed;
use super::frames::Made;
use super::gprim::{Shapes, Solid};
use super::scene::{Scene, number, triple, turn, word};
use crate::features::{self, Tally};
use crate::mass::{Mode, WATER, measure, moments, tensor, turned};
use crate::model::{Geometry, Inertial};
use crate::place::Fallible;

pub fn add(
    scene: &Scene<'_>,
    made: &mut Made,
    shapes: &Shapes<'_, '_>,
    tally: &mut Tally,
) -> Fallible<()> {
    let bodies: Vec<(usize, usize)> =
        made.index.iter().map(|(prim, body)| (*body, *prim)).collect();
    for (index, prim) in bodies {
        let (of, place) = (scene.prim(prim), scene.place(prim));
        let shift = made.shifts[index];
        let positive =
            |name: &str| number(of, name).filter(|value| *value > 0.0 && value.is_finite());
        let mass = positive("physics:mass").map(|mass| mass * scene.kilogram);
        let scale = scene.frame(prim)?.1;
        let centre = triple(of, "physics:centerOfMass")
            .filter(|centre| centre.iter().all(|part| part.is_finite()));
        let centre = centre.map(|centre| centre.component_mul(&scale) * scene.metre - shift);
        let centre = centre.map(Point3::from);
        let diagonal = triple(of, "physics:diagonalInertia")
            .filter(|moments| moments.iter().any(|moment| *moment != 0.0));
        let unit = scene.kilogram * scene.metre.powi(2);
        let full = of.value("newton:inertia").and_then(Authored::numbers).and_then(full);
        let along_axes = diagonal.map(|diagonal| {
            let axes = turn(of, "physics:principalAxes").unwrap_or_else(UnitQuaternion::identity);
            turned(&Matrix3::from_diagonal(&diagonal), &axes)
        });
        let inertia = full.or(along_axes).map(|inertia| inertia * unit);
        let whole = match (mass, centre, inertia) {
            (Some(mass), Some(centre), Some(inertia)) => Some(Inertial { mass, centre, inertia }),
            _ => {
                let solids = shapes.solids.get(&index).map_or(&[][..], Vec::as_slice);
                let computed = computed(scene, of, solids);
                let mut whole = computed.or_else(|| mass.map(small));
                if let Some(whole) = &mut whole {
                    *whole = mass.map_or(*whole, |mass| whole.weighing(mass));
                    whole.centre = centre.unwrap_or(whole.centre);
                    whole.inertia = inertia.unwrap_or(whole.inertia);
                    tally.count(features::AUTO_MASSES);
                }
                whole
            }
        };
        let Some(mut whole) = whole else {
            tally.remark(
                place,
                format!(
                    "body `{}` has no mass, and no shapes that collide: its link has none",
                    made.bodies[index].name
                ),
            );
            continue;
        };
        tally.count(features::MASSES);
        whole.inertia.apply(|value| *value = if value.abs() < 1e-18 { 0.0 } else { *value });
        made.bodies[index].inertial = Some(whole);
    }
    Ok(())
}

/// The inertia that Newton's schema says: xx, yy, zz, xy, xz, yz. None of an empty array, which says nothing.
fn full(numbers: [f64; 6]) -> Option<Matrix3<f64>> {
    let is_said = numbers[..3].iter().any(|moment| *moment > 0.0);
    (is_said && numbers.iter().all(|number| number.is_finite())).then(|| tensor(numbers))
}

/// A ball of the density of water: of a body that says its mass alone, and has no shapes.
fn small(mass: f64) -> Inertial {
    let radius = (mass / WATER * 3.0 / (4.0 * std::f64::consts::PI)).cbrt();
    Inertial::along_axes(mass, moments(&Geometry::Sphere(radius), false, mass))
}

/// The masses of the shapes that collide, together.
fn computed(scene: &Scene<'_>, body: &Prim, solids: &[Solid]) -> Option<Inertial> {
    let cube = scene.kilogram / scene.metre.powi(3);
    let density = |prim: &Prim, name: &str| {
        number(prim, name).filter(|value| *value > 0.0).map(|value| value * cube)
    };
    let mut parts = Vec::new();
    for solid in solids {
        let own = scene.prim(solid.prim);
        let mode = match (word(own, "newton:massModel"), word(own, "mjc:inertia")) {
            (Some("shell"), _) | (_, Some("shell")) => Mode::Shell,
            (_, Some("convex")) => Mode::Convex,
            (_, Some("legacy")) => Mode::Legacy,
            _ => Mode::Exact,
        };
        let unit = of_density_one(solid, mode)?;
        let material = || {
            let material = rubbed(scene, solid.prim);
            density(scene.prim(material?), "physics:density")
        };
        let is_body = std::ptr::eq(own, body);
        let mass = number(own, "physics:mass")
            .filter(|mass| *mass > 0.0 && !is_body)
            .map(|mass| mass * scene.kilogram);
        let mass = mass.unwrap_or_else(|| {
            let own = density(own, "physics:density").or_else(|| density(body, "physics:density"));
            unit.mass * own.or_else(material).unwrap_or(WATER)
        });
        parts.push(unit.weighing(mass));
    }
    Inertial::together(&parts).filter(|whole| whole.mass > 0.0)
}

/// The mass of a shape whose density is 1, in the frame of its link; of a shell, that of its surface.
fn of_density_one(solid: &Solid, mode: Mode) -> Option<Inertial> {
    let own = match &solid.mesh {
        Some(mesh) => measure(mesh, mode).or_else(|_| measure(mesh, Mode::Convex)).ok()?,
        None => Inertial::of_primitive(&solid.geometry, mode == Mode::Shell, 1.0),
    };
    (own.mass > 0.0).then(|| own.at(&solid.pose))
}

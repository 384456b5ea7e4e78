use crate::context::Context;
use crate::finding::{Finding, Findings};
use crate::rule::declare_rule;
use crate::tolerance::{HULL_IN_VOLUME, LEGACY_SPHERE_SHORTFALL, number_tolerance};
use urdd_document::shapes::{ShapeList, Volume, approximations, max_distances};
use urdd_format::registry::{ModuleDocument, ModuleKind};

declare_rule! {
    /// A shape's largest distance from its link's origin is not what its box or sphere gives.
    ///
    /// The value is exact for a box (its farthest corner) and for a sphere (distance of its centre, plus
    /// its radius), and a hull or convex piece cannot reach farther than the box and the sphere that
    /// hold it. Programs bound by it how far a link's points move when joints turn; where it is too
    /// small, they miss collisions.
    ///
    /// Write the value from the same boxes and spheres as `link_shapes_approximations_module`. (Legacy
    /// spheres were measured at the corners of a tessellated one: up to 0.5 % of the radius too little passes.)
    SHP004 "max-distance-wrong", Error, clause "8.3", since "0.1.0",
    phase References, needs [
        Module(Kind::LinkShapesApproximations),
        Module(Kind::LinkShapesMaxDistanceFromOrigin),
        NotFailed(MSH004),
        SHAPES_LISTED,
        NotFailed(SHP003),
        // Of a box that does not fit, the distance may be that of the right one.
        NotFailed(SHP017),
        NotFailed(SHP018),
    ],
    check check,
}

fn check(context: &Context, findings: &mut Findings) {
    let kind = ModuleKind::LinkShapesMaxDistanceFromOrigin;
    let (Some(document), Some(module)) = (context.document(kind), context.module(kind)) else {
        return;
    };
    let (Some(distances), Some(volumes)) = (
        max_distances(document),
        context
            .document(ModuleKind::LinkShapesApproximations)
            .and_then(approximations),
    ) else {
        return;
    };
    let legacy = matches!(
        document,
        ModuleDocument::LegacyLinkShapesMaxDistanceFromOrigin(_)
    );
    let ([full_hulls, full @ ..], [full_boxes, full_spheres, boxes, spheres]) =
        (&distances, volumes.as_slice())
    else {
        return;
    };
    let [
        full_box_values,
        full_sphere_values,
        pieces,
        box_values,
        sphere_values,
    ] = full;
    let mut checker = Checker {
        context,
        file: module.file("module.json"),
        legacy,
        findings,
    };
    checker.volumes(full_box_values, full_boxes);
    checker.volumes(full_sphere_values, full_spheres);
    checker.volumes(box_values, boxes);
    checker.volumes(sphere_values, spheres);
    checker.hulls(full_hulls, full_boxes, full_spheres);
    checker.hulls(pieces, boxes, spheres);
}

struct Checker<'a> {
    context: &'a Context,
    file: String,
    legacy: bool,
    findings: &'a mut Findings,
}

impl Checker<'_> {
    /// The values of boxes or spheres.
    fn volumes(&mut self, values: &ShapeList<f64>, volumes: &ShapeList<Volume>) {
        for (link, piece, value) in entries(values) {
            let Some(volume) = entry(volumes, link, piece) else {
                continue;
            };
            let expected = volume.reach();
            let tolerance = number_tolerance(expected, value);
            let shortfall = match volume {
                Volume::Sphere { radius, .. } if self.legacy => radius * LEGACY_SPHERE_SHORTFALL,
                _ => tolerance,
            };
            if value > expected + tolerance || value < expected - shortfall {
                let what = match volume {
                    Volume::Sphere { .. } => "distance of the sphere's centre plus its radius",
                    Volume::Box { .. } => "distance of the box's farthest corner",
                };
                self.findings.report(
                    Finding::at(
                        &self.file,
                        values.pointer(link, piece),
                        format!(
                            "this is not the {what} ({}) for {}",
                            volumes.pointer(link, piece),
                            self.context.link_label(link)
                        ),
                    )
                    .expected(expected)
                    .actual(value)
                    .tolerance(shortfall.max(tolerance)),
                );
            }
        }
    }

    /// The values of hulls or convex pieces, held to the boxes and spheres themselves.
    fn hulls(
        &mut self,
        values: &ShapeList<f64>,
        boxes: &ShapeList<Volume>,
        spheres: &ShapeList<Volume>,
    ) {
        for (link, piece, value) in entries(values) {
            let reaches = [boxes, spheres].map(|list| entry(list, link, piece));
            let most = reaches
                .iter()
                .flatten()
                .map(Volume::reach)
                .fold(f64::INFINITY, f64::min);
            let tolerance = most * HULL_IN_VOLUME;
            let label = self.context.link_label(link);
            let message = if value < 0.0 {
                format!("a distance cannot be negative ({label})")
            } else if value > most + tolerance {
                format!("{label} reaches farther here than the box and the sphere that hold it")
            } else {
                continue;
            };
            self.findings.report(
                Finding::at(&self.file, values.pointer(link, piece), message)
                    .expected(format!("from 0 to {most}"))
                    .actual(value)
                    .tolerance(tolerance),
            );
        }
    }
}

fn entries(list: &ShapeList<f64>) -> impl Iterator<Item = (usize, usize, f64)> {
    let links = list.links.iter().enumerate();
    links.flat_map(|(link, entry)| {
        let pieces = entry.iter().enumerate();
        pieces.map(move |(piece, value)| (link, piece, *value))
    })
}

fn entry(list: &ShapeList<Volume>, link: usize, piece: usize) -> Option<Volume> {
    list.links.get(link)?.get(piece).copied()
}

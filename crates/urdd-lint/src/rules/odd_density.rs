use crate::rule::declare_lint;
use crate::subject::Subject;
use urdd_format::readable::number;
use urdd_validate::finding::Findings;

declare_lint! {
    /// The mass of a link divided by the volume of its convex hull is no density of a thing that is built.
    ///
    /// Above 20,000 kg/m³ it is heavier than solid lead or tungsten carbide, although the hull is at least as large as the link.
    /// Below 1 kg/m³ it is lighter than air. The mass is in grams, or the shapes are in millimetres or inches, or the
    /// mass is a placeholder.
    ///
    /// Write the mass in kilograms, and scale meshes to metres (`scale="0.001 0.001 0.001"`).
    LNT003 "odd-density", Warning, WrongMotion, since "1.1.0"
}

/// Least and greatest density, kg/m³.
const LEAST: f64 = 1.0;
const GREATEST: f64 = 20_000.0;

fn check(urdf: &Subject, findings: &mut Findings) -> Option<()> {
    for (index, body) in urdf.bodies(findings)?.iter().enumerate() {
        let Some((inertial, hull)) = body.inertial.zip(body.geometry.hull()) else {
            continue;
        };
        let density = inertial.mass / hull.mesh().signed_volume();
        if !density.is_finite() || (LEAST..=GREATEST).contains(&density) {
            continue;
        }
        let message = format!(
            "{} kg in the convex hull of the link's shapes make {} kg/m³; check the unit of the mass and the scale of \
            the shapes",
            number(inertial.mass, 3),
            number(density, 3)
        );
        urdf.at(urdf.links[index], message)
            .expected(format!("{LEAST} to {GREATEST} kg/m³"))
            .actual(format!("{} kg/m³", number(density, 3)))
            .report(findings);
    }
    Some(())
}

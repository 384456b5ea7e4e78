use super::prelude::*;

declare_lint! {
    /// A collision shape has a size of 0 or less.
    ///
    /// MuJoCo refuses the robot: `size 1 must be positive in geom`. Others have a shape that nothing touches. A visual of
    /// size 0 draws nothing, and is no finding.
    ///
    /// Write the size in metres, or remove the collision.
    LNT033 "size-not-positive", Error, Collisions, since "1.1.0"
}

fn check(urdf: &Subject, findings: &mut Findings) -> Option<()> {
    for link in &urdf.links {
        for (_, collision) in children(*link).filter(|(name, _)| *name == "collision") {
            let Some(geometry) = child(collision, "geometry") else {
                continue;
            };
            for (name, shape) in children(geometry) {
                let length = |name| numbers::<1>(shape, name).map_or(f64::INFINITY, |[size]| size);
                let least = match name {
                    "box" => numbers::<3>(shape, "size")
                        .map_or(f64::INFINITY, |[x, y, z]| x.min(y).min(z)),
                    "sphere" => length("radius"),
                    "cylinder" | "capsule" => length("radius").min(length("length")),
                    _ => continue,
                };
                if least <= 0.0 {
                    let message = format!(
                        "the {name} has a size of {least}; write the size in metres, or remove the collision"
                    );
                    urdf.at(shape, message).report(findings);
                }
            }
        }
    }
    Some(())
}

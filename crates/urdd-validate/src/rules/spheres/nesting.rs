use crate::rules::prelude::*;
use urdd_format::link_shapes_spheres::LinkSphere;

declare_rule! {
    /// A sphere is not inside of the one that it names in an outer level, or names none that is there.
    ///
    /// A program asks the outer level first and leaves out what is inside of a sphere that touches nothing. It misses what
    /// sticks out of that sphere.
    ///
    /// The first level is in no other. Each other level names one before it, and each of its spheres a sphere of the same
    /// link there that holds it: the distance of the centres and the inner radius come to no more than the outer radius.
    SPH004 "sphere-not-in-outer", Error, clause "8.9.3", since "1.4.0",
    phase References, needs [ModuleV1(Kind::LinkShapesSpheres), Passed(SPH002), Passed(SPH003)], check not_in_outer,
}

fn not_in_outer(context: &Context, findings: &mut Findings) -> Option<()> {
    let module = document!(context, LinkShapesSpheres)?;
    for (place, level) in module.levels.iter().enumerate() {
        let outer = level.outer_level_idx.map(|idx| idx.get());
        let expected = match place {
            0 => "null, since this is the first level".to_owned(),
            _ => format!("a level before this one: an index below {place}"),
        };
        if outer.is_some() == (place == 0) || outer.is_some_and(|outer| outer >= place) {
            let pointer = format!("/levels/{place}/outer_level_idx");
            finding_in(Kind::LinkShapesSpheres, pointer, "this is no level before this one")
                .values(expected, or_null(outer))
                .report(findings);
            continue;
        }
        let outer = outer.and_then(|outer| module.levels.get(outer));
        let mut fold = Fold::new(findings);
        for (link, spheres) in level.spheres.iter().enumerate() {
            let around = outer.and_then(|level| level.spheres.get(link));
            for (at, sphere) in spheres.iter().enumerate() {
                if let Some(fault) = fault(sphere, around.map(Vec::as_slice)) {
                    fold.add(|| fault.finding(context, [place, link, at]));
                }
            }
        }
    }
    Some(())
}

/// What is wrong with the sphere that one names.
enum Fault {
    /// It names this one, which is not there; or should name none.
    Named { expected: String, actual: Option<usize> },
    /// It sticks out of the other by this distance, m, of which so much is allowed.
    SticksOut { by: f64, tolerance: f64 },
}

/// The fault of a sphere; `outer` are those of the link in the outer level, if there is one.
fn fault(sphere: &LinkSphere, outer: Option<&[LinkSphere]>) -> Option<Fault> {
    let named = sphere.outer_sphere_idx.map(|idx| idx.get());
    let Some(outer) = outer else {
        let expected = "null, since this is the first level".to_owned();
        return named.map(|_| Fault::Named { expected, actual: named });
    };
    let Some(around) = named.and_then(|named| outer.get(named)) else {
        let expected = format!("an index below {}", outer.len());
        return Some(Fault::Named { expected, actual: named });
    };
    let apart = Vector3::from(sphere.offset_xyz) - Vector3::from(around.offset_xyz);
    let by = apart.norm() + sphere.radius - around.radius;
    let tolerance = SPHERE_IN_SPHERE * around.radius;
    // NaN, of numbers beyond all sizes, is reported too.
    let holds = by <= tolerance;
    (!holds).then_some(Fault::SticksOut { by, tolerance })
}

impl Fault {
    fn finding(self, context: &Context, [level, link, at]: [usize; 3]) -> Finding {
        let pointer = format!("/levels/{level}/spheres/{link}/{at}/outer_sphere_idx");
        let of = context.link_label(link);
        let finding = |message| finding_in(Kind::LinkShapesSpheres, pointer, message);
        match self {
            Fault::Named { expected, actual } => {
                let message = format!("sphere {at} of {of} names no sphere of an outer level");
                finding(message).values(expected, or_null(actual))
            }
            Fault::SticksOut { by, tolerance } => {
                let out = metres(by);
                let message = format!("sphere {at} of {of} sticks out of its outer one by {out}");
                finding(message)
                    .values("a sphere that holds this one", format!("{out} outside"))
                    .tolerance(tolerance)
                    .off_by(by, "m")
            }
        }
    }
}

//! How far pieces reach out of the hulls of their links.

use nalgebra::Vector3;
use rayon::prelude::*;

use crate::context::Context;
use crate::finding::{Finding, Findings, point};
use crate::part::Part;
use crate::solids::derived::Derived;
use crate::solids::polytope::{Polytope, distinct, step};
use crate::tolerance::{PIECE_BARELY_OUT_OF_HULL, PIECE_OUT_OF_HULL};
use crate::views::judged::judged;
use urdd_format::readable::metres;
use urdd_format::registry::ModuleKind;

/// Which pieces to report.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum How {
    /// Those that reach out by more than they may.
    Far,
    /// Those that reach out, and may.
    Barely,
}

/// The vertex of a piece that is farthest outside of its link's hull.
struct Outside {
    place: [f64; 3],
    distance: f64,
    /// What is passed over, m.
    least: f64,
    /// What is far, m.
    most: f64,
    diagonal: f64,
}

/// Reports the pieces that reach out of the hulls of their links.
pub fn report(context: &Context, how: How, findings: &mut Findings) {
    let kind = ModuleKind::ConvexDecompositionMeshes;
    let Some(module) = context.module(kind) else {
        return;
    };
    let part = |piece: &Derived| Part::Piece {
        link: piece.link,
        piece: piece.piece,
    };
    let pieces: Vec<&Derived> = context
        .solids()
        .derived(kind)
        .iter()
        .filter(|piece| judged(context, findings, part(piece), &[Part::Hull(piece.link)]))
        .collect();
    let outside: Vec<_> = pieces
        .par_iter()
        .map(|piece| farthest_outside(context, piece))
        .collect();
    for (piece, outside) in pieces.iter().zip(outside) {
        let Some(out) = outside else {
            continue;
        };
        let tolerance = match how {
            How::Far if out.distance > out.most => out.most,
            How::Barely if out.distance > out.least && out.distance <= out.most => out.least,
            _ => continue,
        };
        let distance = format!(
            "{} outside, {:.2} % of the hull's diagonal",
            metres(out.distance),
            100.0 * out.distance / out.diagonal
        );
        findings.report(
            Finding::at(
                module.file("module.json"),
                piece.pointer(),
                format!(
                    "piece {} of {} reaches out of its hull: the vertex at {} is {distance}",
                    piece.piece,
                    context.link_label(piece.link),
                    point(out.place),
                ),
            )
            .expected("every vertex inside the hull")
            .actual(distance)
            .tolerance(tolerance)
            .off_by(out.distance, "m")
            .part(part(piece)),
        );
    }
}

fn farthest_outside(context: &Context, piece: &Derived) -> Option<Outside> {
    let hull = context
        .solids()
        .sound(ModuleKind::ConvexHullMeshes, piece.link, 0)?;
    let polytope = Polytope::new(hull)?;
    let bounds = hull.bounds()?;
    let diagonal = (Vector3::from(bounds.max) - Vector3::from(bounds.min)).norm();
    let vertices = distinct(piece.sound()?);
    let every = step(vertices.len(), polytope.num_faces());
    let (place, distance) = vertices
        .into_iter()
        .step_by(every)
        .map(|vertex| (vertex, polytope.outside(vertex)))
        .reduce(|a, b| if b.1 > a.1 { b } else { a })?;
    Some(Outside {
        place,
        distance,
        least: polytope.resolution.max(PIECE_BARELY_OUT_OF_HULL * diagonal),
        most: polytope.resolution.max(PIECE_OUT_OF_HULL * diagonal),
        diagonal,
    })
}

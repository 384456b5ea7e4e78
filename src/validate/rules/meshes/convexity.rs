//! Hulls and pieces that are no convex bodies.

use rayon::prelude::*;

use crate::format::registry::ModuleKind;
use crate::validate::context::Context;
use crate::validate::finding::{Finding, Findings, metres, point};
use crate::validate::part::{Part, Why};
use crate::validate::solids::derived::{Derived, noun};
use crate::validate::solids::polytope::{NotConvex, not_convex};
use crate::validate::solids::surface::extent;
use crate::validate::tolerance::mesh_resolution;

/// Reports every mesh of a module that is not the closed surface of a convex body.
pub fn report(context: &Context, kind: ModuleKind, findings: &mut Findings) {
    let Some(module) = context.module(kind) else {
        return;
    };
    let judge = |mesh: &'_ Derived| not_convex(mesh.sound()?);
    let meshes = context.solids().derived(kind);
    let faults: Vec<Option<NotConvex>> = meshes.par_iter().map(judge).collect();
    for (mesh, fault) in meshes.iter().zip(faults) {
        let part = Part::of(kind, mesh.link, mesh.piece);
        if let (None, Some(part)) = (mesh.sound(), part) {
            findings.not_verified(part, Why::Unreadable);
        }
        let Some(fault) = fault else {
            continue;
        };
        let what = match fault {
            NotConvex::Nothing => "it has no face with an area".to_owned(),
            NotConvex::Open(at) => format!(
                "the edge at {} is not shared by two faces that are wound alike",
                point(at)
            ),
            NotConvex::Inward => "its faces look inward".to_owned(),
            NotConvex::Vertex(at, distance) => {
                format!(
                    "the vertex at {} is {} outside of a face",
                    point(at),
                    metres(distance)
                )
            }
        };
        let label = context.link_label(mesh.link);
        let which = match kind {
            ModuleKind::ConvexDecompositionMeshes => format!("piece {} of {label}", mesh.piece),
            _ => format!("the {} of {label}", noun(kind)),
        };
        let resolution = mesh
            .mesh
            .as_ref()
            .map_or(0.0, |mesh| mesh_resolution(extent(mesh)));
        findings.report(
            Finding::at(
                module.file("module.json"),
                mesh.pointer(),
                format!("{which} is no convex body: {what}"),
            )
            .expected("a closed convex surface, faces counter-clockwise seen from outside")
            .actual(what)
            .tolerance(resolution)
            .part(part),
        );
    }
}

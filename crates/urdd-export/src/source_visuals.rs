//! The visual elements of the source, with its primitives as primitives.

use std::collections::BTreeMap;

use nalgebra::Isometry3;

use super::subject::Subject;
use urdd_format::colors::Colors;
use urdd_format::meshes::GeometryKind;
use urdd_geometry::primitives::Primitive;
use urdd_geometry::read::Part;
use urdd_robot::{LinkVisual, RobotError, SourceShape};

/// A primitive of visual geometry, in its link's frame.
pub(super) struct Painted {
    pub pose: Isometry3<f64>,
    pub primitive: Primitive,
    pub color: Option<[f64; 4]>,
    pub name: Option<String>,
}

/// The meshes of links, and their primitives in link order. A link without visual elements has its plain mesh.
pub(super) fn source_visuals(
    subject: &Subject,
) -> Result<(Vec<LinkVisual>, Vec<Vec<Painted>>), RobotError> {
    let found = subject.robot.source_elements(GeometryKind::Visual)?;
    let mut primitives: Vec<Vec<Painted>> = subject.links.iter().map(|_| Vec::new()).collect();
    let mut meshes: BTreeMap<usize, Vec<Part>> = BTreeMap::new();
    let colors = Colors::of(&subject.described);
    for of in found.usable {
        let link = subject.described.links.get(of.link);
        let Some(visual) = link.and_then(|link| link.visual.get(of.element)) else { continue };
        let color = colors.get(visual.material.as_ref());
        let color = color.map(|rgba| rgba.map(|part| part.clamp(0.0, 1.0)));
        match of.shape {
            SourceShape::Primitive(pose, primitive) => {
                let name = visual.name.clone();
                primitives[of.link].push(Painted { pose, primitive, color, name });
            }
            SourceShape::Mesh(parts) => {
                let parts =
                    parts.into_iter().map(|part| Part { color: part.color.or(color), ..part });
                meshes.entry(of.link).or_default().extend(parts);
            }
        }
    }
    let is_bare = |link: &usize| primitives[*link].is_empty() && !meshes.contains_key(link);
    let bare: Vec<usize> = (0..subject.links.len()).filter(is_bare).collect();
    if !bare.is_empty() {
        let plain = subject.robot.visuals()?.into_iter();
        let plain = plain.filter(|visual| bare.contains(&visual.link));
        meshes.extend(plain.map(|visual| (visual.link, visual.parts)));
    }
    let meshes = meshes.into_iter().map(|(link, parts)| LinkVisual { link, parts }).collect();
    Ok((meshes, primitives))
}

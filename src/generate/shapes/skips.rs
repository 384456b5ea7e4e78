//! `link_shapes_skips_module`, the simple skips and a person's edits: SPEC 8.7.

use crate::format::chain::ChainModule;
use crate::format::link_shapes_simple_skips::LinkShapesSimpleSkipsModule;
use crate::format::link_shapes_skips::{LinkShapesSkipsModule, SkipEdit};

/// Makes the module. Every edit names two links of the robot.
pub(crate) fn skips(
    simple: &LinkShapesSimpleSkipsModule,
    edits: Vec<SkipEdit>,
    chain: &ChainModule,
) -> LinkShapesSkipsModule {
    let name = |link: usize| chain.links_in_chain[link].name.as_str();
    let full = simple.full_shapes.iter();
    let full: Vec<&str> = full.map(|link| name(link.get())).collect();
    let pieces = simple.decomposition_shapes.iter();
    let pieces: Vec<&str> = pieces.map(|piece| name(piece.link_idx.get())).collect();
    let of_full = |skips: &Vec<Vec<bool>>| edited(skips, &full, &edits);
    let of_pieces = |skips: &Option<Vec<Vec<bool>>>| {
        let skips = skips.as_ref();
        skips.map(|skips| edited(skips, &pieces, &edits))
    };
    LinkShapesSkipsModule {
        full_shapes: simple.full_shapes.clone(),
        decomposition_shapes: simple.decomposition_shapes.clone(),
        full_convex_hulls_skips: of_full(&simple.full_convex_hulls_simple_skips),
        full_obbs_skips: of_full(&simple.full_obbs_simple_skips),
        full_bounding_spheres_skips: of_full(&simple.full_bounding_spheres_simple_skips),
        decomposition_convex_hulls_skips: of_pieces(
            &simple.decomposition_convex_hulls_simple_skips,
        ),
        decomposition_obbs_skips: of_pieces(&simple.decomposition_obbs_simple_skips),
        decomposition_bounding_spheres_skips: of_pieces(
            &simple.decomposition_bounding_spheres_simple_skips,
        ),
        edits: edits.clone(),
    }
}

/// The matrix with the edits applied in order; `links[i]` is the name of the link of shape i.
fn edited(skips: &[Vec<bool>], links: &[&str], edits: &[SkipEdit]) -> Vec<Vec<bool>> {
    let mut skips = skips.to_vec();
    for edit in edits {
        let of = |name: &str| -> Vec<usize> {
            let all = links.iter().enumerate().filter(|(_, link)| **link == name);
            all.map(|(i, _)| i).collect()
        };
        for &i in &of(&edit.link_a) {
            for &j in &of(&edit.link_b) {
                if i != j {
                    skips[i][j] = edit.skip;
                    skips[j][i] = edit.skip;
                }
            }
        }
    }
    skips
}

//! Pairs of links whose shapes are checked, with their exact shapes.

use nalgebra::Isometry3;

use urdd_geometry::Mesh;
use urdd_geometry::convex::{BodyPairs, ShapeError};

/// Pairs of links with shapes of which at least one pair of pieces is checked.
#[derive(Debug)]
pub struct Pairs {
    /// The links that have shapes, ascending. All other link numbers here are indices into this list.
    pub links: Vec<usize>,
    /// The pieces of each of these links.
    pub pieces: Vec<Vec<Mesh>>,
    /// The pairs of links that are checked, each ascending.
    pub checked: Vec<[usize; 2]>,
    exact: BodyPairs,
}

impl Pairs {
    /// Of convex pieces, each with its link. `is_checked` says of two pieces whether contacts of them count.
    ///
    /// # Errors
    /// The index of the first invalid piece, and the reason.
    pub fn new(
        meshes: Vec<(usize, Mesh)>,
        is_checked: impl Fn(usize, usize) -> bool,
    ) -> Result<Self, (usize, ShapeError)> {
        let each = meshes.iter().map(|(link, mesh)| (*link, mesh.vertices.as_slice()));
        let mut exact = BodyPairs::new(each)?;
        let mut links: Vec<usize> = meshes.iter().map(|(link, _)| *link).collect();
        links.sort_unstable();
        links.dedup();
        let mut checked = Vec::new();
        for a in 0..links.len() {
            for b in a + 1..links.len() {
                if exact.add([links[a], links[b]], &is_checked) {
                    checked.push([a, b]);
                }
            }
        }
        let pieces = |link: &usize| {
            let own = meshes.iter().filter(|(of, _)| of == link);
            own.map(|(_, mesh)| mesh.clone()).collect()
        };
        Ok(Pairs { pieces: links.iter().map(pieces).collect(), links, checked, exact })
    }

    /// The indices of the pairs in contact, ascending. `poses` are those of all links of the robot.
    pub fn touching(&self, poses: &[Isometry3<f64>]) -> Vec<u32> {
        self.exact.touching(poses).into_iter().filter_map(|pair| u32::try_from(pair).ok()).collect()
    }

    /// Whether any pair is in contact.
    pub fn any_touches(&self, poses: &[Isometry3<f64>]) -> bool {
        self.exact.any_touches(poses)
    }
}

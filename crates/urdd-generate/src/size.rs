//! Size limits of a robot.

use std::sync::atomic::{AtomicUsize, Ordering};

use nalgebra::Vector3;

use super::error::Result;
use urdd_geometry::read::Part;
use urdd_source::Source;
use urdd_source::fault::Fault;

/// Maximum number of links. The matrix of lowest common ancestors grows with its square.
pub const MOST_LINKS: usize = 2_000;

/// Maximum number of elements besides links and joints; 2,000 links have some 10,000.
pub const MOST_ELEMENTS: usize = 100_000;

/// Maximum number of triangles of a link: its .obj stays below the 512 MiB that URDD readers accept.
pub const MOST_LINK_TRIANGLES: usize = 3_000_000;

/// Maximum number of triangles of all links together.
pub const MOST_TRIANGLES: usize = 10_000_000;

/// Minimum ratio of a shape's width to its largest coordinate. Files store coordinates as binary32, and readers assume
/// an accuracy of eight steps of that, some 1e-6. A thinner shape has no width for them.
const LEAST_WIDTH: f64 = 4e-6;

/// Refuses a robot whose URDD would be too large for its readers.
pub(super) fn check(source: &Source) -> Result<()> {
    let robot = &source.reading.robot;
    let links = robot.links.len();
    let shapes = robot
        .links
        .iter()
        .map(|link| link.visual.len() + link.collision.len() + link.unknown_elements.len());
    let of_joints = robot.joints.iter().map(|joint| joint.unknown_elements.len());
    let elements = shapes.chain(of_joints).sum::<usize>()
        + robot.materials.len()
        + robot.unknown_elements.len();
    let fault = if links > MOST_LINKS {
        Fault::TooManyLinks { found: links, limit: MOST_LINKS }
    } else if elements > MOST_ELEMENTS {
        Fault::TooManyElements { found: elements, limit: MOST_ELEMENTS }
    } else {
        return Ok(());
    };
    Err(source.refused(fault).into())
}

/// Counts the triangles of links before they are built: even a tiny URDF can reference a mesh or a sphere many times.
#[derive(Debug, Default)]
pub(super) struct TriangleBudget(AtomicUsize);

impl TriangleBudget {
    /// Adds the triangles of a link. Returns whether all links so far are within the budget.
    pub fn take(&self, link: &str, triangles: usize) -> Result<bool, Fault> {
        if triangles > MOST_LINK_TRIANGLES {
            return Err(Fault::TooManyTriangles {
                link: link.into(),
                found: triangles,
                limit: MOST_LINK_TRIANGLES,
            });
        }
        let before = self.0.fetch_add(triangles, Ordering::Relaxed);
        Ok(before + triangles <= MOST_TRIANGLES)
    }

    /// # Errors
    /// If all links together have too many.
    pub fn check(&self) -> Result<(), Fault> {
        if self.0.load(Ordering::Relaxed) > MOST_TRIANGLES {
            return Err(Fault::TooManyTrianglesInAll { limit: MOST_TRIANGLES });
        }
        Ok(())
    }
}

/// Refuses a link whose shape would have no width in its mesh files.
pub(super) fn check_resolved(link: &str, parts: &[Part]) -> Result<(), Fault> {
    let vertices = || parts.iter().flat_map(|part| &part.mesh.vertices);
    let mut largest = 0.0_f64;
    for vertex in vertices() {
        largest = vertex.iter().fold(largest, |most, x| most.max(x.abs()));
    }
    let width = width(vertices().map(|vertex| Vector3::from(*vertex)));
    if width > LEAST_WIDTH * largest {
        return Ok(());
    }
    Err(Fault::Unresolved { link: link.into() })
}

/// The largest distance of a point from a line through two distant points; 0 without points.
fn width(points: impl Iterator<Item = Vector3<f64>> + Clone) -> f64 {
    let Some(first) = points.clone().next() else { return 0.0 };
    let farthest = |distance: &dyn Fn(&Vector3<f64>) -> f64| {
        points.clone().map(|point| distance(&point)).fold(0.0, f64::max)
    };
    let length = farthest(&|point| (point - first).norm());
    let Some(last) = points.clone().find(|point| (point - first).norm() >= length) else {
        return 0.0;
    };
    let along = (last - first) / length;
    farthest(&|point| (point - first).cross(&along).norm())
}

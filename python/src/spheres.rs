//! Spheres in the place of a robot's shapes.

use numpy::{PyArray1, PyArray2, PyReadonlyArray2, PyUntypedArrayMethods};
use pyo3::prelude::*;
use urdd_robot::spheres::{
    Approximating, Covering, LinkSpheres, Sphere, SphereChecker as Checker, SphereLevel,
};
use urdd_robot::{EdgeSettings, World};

use crate::arrays::{Batch, answers, copy};
use crate::errors::of_robot;
use crate::obstacle::{Obstacle, objects_of};
use crate::robot::Robot;

/// Levels from coarse to fine: for each link, its index and its spheres (n, 4).
type Levels<'py> = Vec<Vec<(usize, PyReadonlyArray2<'py, f64>)>>;

enum Either {
    Covering(Checker<Covering>),
    Approximating(Checker<Approximating>),
}

/// The spheres of a robot, and obstacles.
#[pyclass(frozen, module = "urdd._urdd")]
pub struct SphereChecker(Either);

/// The same for both kinds of checkers.
macro_rules! both {
    ($self:expr, $checker:ident => $ask:expr) => {
        match &$self.0 {
            Either::Covering($checker) => $ask,
            Either::Approximating($checker) => $ask,
        }
    };
}

#[pymethods]
impl SphereChecker {
    #[new]
    fn new(
        py: Python<'_>,
        robot: PyRef<'_, Robot>,
        levels: Levels<'_>,
        pairs: Vec<[usize; 2]>,
        covers: bool,
    ) -> PyResult<Self> {
        let mut made = Vec::new();
        for level in levels {
            let mut links = Vec::new();
            for (link_idx, spheres) in level {
                let values = copy(&spheres)?;
                let sphere =
                    |[x, y, z, radius]: &[f64; 4]| Sphere { centre: [*x, *y, *z], radius: *radius };
                let spheres = values.as_chunks().0.iter().map(sphere).collect();
                links.push(LinkSpheres { link_idx, spheres });
            }
            made.push(SphereLevel { links, covers });
        }
        let either = robot.ask(py, move |robot, _| match covers {
            true => Checker::covering(robot, &made, &pairs).map(Either::Covering),
            false => Checker::approximating(robot, &made, &pairs).map(Either::Approximating),
        })?;
        Ok(SphereChecker(either))
    }

    /// The same spheres, and obstacles, each with the names of the links that may touch it.
    fn around(
        &self,
        py: Python<'_>,
        obstacles: Vec<(Py<Obstacle>, Vec<String>)>,
    ) -> PyResult<Self> {
        let world = World::new(objects_of(&obstacles));
        let made = match &self.0 {
            Either::Covering(checker) => checker.around(&world).map(Either::Covering),
            Either::Approximating(checker) => checker.around(&world).map(Either::Approximating),
        };
        made.map(SphereChecker).map_err(|error| of_robot(py, &error))
    }

    /// (count,): whether spheres are at most `margin` apart.
    fn is_within<'py>(
        &self,
        py: Python<'py>,
        configurations: PyReadonlyArray2<'py, f64>,
        margin: f64,
    ) -> PyResult<Bound<'py, PyArray1<bool>>> {
        let batch = Batch::new(&configurations)?;
        answers(
            py,
            configurations.shape()[0],
            FEW,
            batch.is_one(),
            |on, out| both!(self, checker => checker.touches_batch_into(&batch.values, margin, on, out)),
        )
    }

    /// (count,): where each straight motion is blocked, from 0 to 1; NaN where it is free.
    fn blocked_edge<'py>(
        &self,
        py: Python<'py>,
        starts: PyReadonlyArray2<'py, f64>,
        ends: PyReadonlyArray2<'py, f64>,
        margin: f64,
        resolution: Option<f64>,
        open_loops: bool,
    ) -> PyResult<Bound<'py, PyArray1<f64>>> {
        let (from, to) = (Batch::new(&starts)?, Batch::new(&ends)?);
        let settings = EdgeSettings { margin, resolution, open_loops };
        answers(py, ends.shape()[0], FEW, to.is_one(), |on, out| {
            let edges = [&from.values[..], &to.values[..]];
            both!(self, checker => checker.blocked_edge_batch_into(edges, &settings, on, out))
        })
    }

    /// (count, 2): the last part of each straight motion that is free, and the first that is blocked; NaN where it is free.
    fn first_contact<'py>(
        &self,
        py: Python<'py>,
        starts: PyReadonlyArray2<'py, f64>,
        ends: PyReadonlyArray2<'py, f64>,
        margin: f64,
        resolution: Option<f64>,
        open_loops: bool,
    ) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let (from, to) = (Batch::new(&starts)?, Batch::new(&ends)?);
        let settings = EdgeSettings { margin, resolution, open_loops };
        answers(py, [ends.shape()[0], 2], FEW, to.is_one(), |on, out| {
            let edges = [&from.values[..], &to.values[..]];
            both!(self, checker => checker.first_contact_batch_into(edges, &settings, on, out))
        })
    }
}

/// Levels as [`Levels`], as lists; and pairs of links.
type Listed = (Vec<Vec<(usize, Vec<[f64; 4]>)>>, Vec<[usize; 2]>);

/// The levels of the spheres of a URDD that cover the links, or the last that does not with those around it; and the pairs
/// of links that are checked.
#[pyfunction]
pub fn sphere_levels(py: Python<'_>, robot: PyRef<'_, Robot>, covers: bool) -> PyResult<Listed> {
    let (levels, pairs) = robot.ask(py, |robot, _| robot.sphere_levels(covers))?;
    let row = |sphere: Sphere| {
        let [x, y, z] = sphere.centre;
        [x, y, z, sphere.radius]
    };
    let link = |own: LinkSpheres| (own.link_idx, own.spheres.into_iter().map(row).collect());
    let levels = levels.into_iter().map(|level| level.links.into_iter().map(link).collect());
    Ok((levels.collect(), pairs))
}

/// So few take no longer than starting threads.
const FEW: usize = 64;

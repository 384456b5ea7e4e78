//! Kinematic loops of a robot.

use numpy::{PyArray1, PyArray2, PyArray3, PyArrayMethods, PyReadonlyArray2};
use pyo3::prelude::*;
use urdd_robot::{CloseSettings, LoopErrors};

use crate::arrays::{Batch, answers, copy};
use crate::errors::of_robot;
use crate::robot::{FEW, Robot, each};

#[pymethods]
impl Robot {
    /// The names of the loops, and of the couplings.
    fn loop_names(&self, py: Python<'_>) -> PyResult<[Vec<String>; 2]> {
        self.ask(py, |robot, _| {
            let Some(module) = robot.loops()? else { return Ok([Vec::new(), Vec::new()]) };
            let loops = module.loops.iter().map(|one| one.name.clone());
            Ok([loops.collect(), module.couplings.iter().map(|one| one.name.clone()).collect()])
        })
    }

    fn reference_configuration<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray1<f64>>> {
        let reference = self.ask(py, |robot, _| robot.reference_configuration())?;
        Ok(PyArray1::from_vec(py, reference))
    }

    fn independent_dofs(&self, py: Python<'_>) -> PyResult<Vec<usize>> {
        self.ask(py, |robot, _| robot.independent_dofs())
    }

    fn num_loop_equations(&self, py: Python<'_>) -> PyResult<usize> {
        self.ask(py, |robot, _| robot.num_loop_equations())
    }

    /// The independent and the dependent DOFs in a configuration.
    fn free_dofs(
        &self,
        py: Python<'_>,
        configuration: PyReadonlyArray2<'_, f64>,
    ) -> PyResult<(Vec<usize>, Vec<usize>)> {
        let configuration = copy(&configuration)?;
        let found = self.ask(py, move |robot, _| robot.free_dofs(&configuration))?;
        Ok((found.independent, found.dependent))
    }

    /// (count, 2 loops + couplings + 1): the gaps' positions, their rotations, the sums, and 1 where all is closed.
    fn loop_errors<'py>(
        &self,
        py: Python<'py>,
        configurations: PyReadonlyArray2<'py, f64>,
    ) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let [loops, couplings] = self.loop_names(py)?.map(|names| names.len());
        let (batch, width) = (Batch::new(&configurations)?, 2 * loops + couplings + 1);
        answers(py, [batch.count, width], FEW, batch.is_one(), |on, out| {
            each(on, out, width, |errors: &mut LoopErrors, k, out| {
                self.robot.loop_errors_into(batch.row(k), errors)?;
                let positions = errors.gaps.iter().map(|gap| gap.position);
                let rotations = errors.gaps.iter().map(|gap| gap.rotation);
                let closed = f64::from(u8::from(errors.is_closed));
                let sums = errors.sums.iter().copied().chain([closed]);
                let all = positions.chain(rotations).chain(sums);
                out.iter_mut().zip(all).for_each(|(out, value)| *out = value);
                Ok(())
            })
        })
    }

    /// (count, dofs + 1): the configurations, and 1 for those that are closed.
    fn close<'py>(
        &self,
        py: Python<'py>,
        configurations: PyReadonlyArray2<'py, f64>,
        held: Vec<usize>,
        bounds: Option<PyReadonlyArray2<'py, f64>>,
    ) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let dofs = self.read(py)?.dof_names().map_err(|error| of_robot(py, &error))?.len();
        let batch = Batch::new(&configurations)?;
        let bounds = bounds.as_ref().map(copy).transpose()?;
        let bounds = bounds.as_ref().map(|bounds| bounds.as_chunks().0);
        let settings = CloseSettings { held: &held, bounds };
        answers(py, [batch.count, dofs + 1], 0, batch.is_one(), |on, out| {
            each(on, out, dofs + 1, |(): &mut (), k, out| {
                let (configuration, is_closed) = out.split_at_mut(dofs);
                configuration.copy_from_slice(batch.row(k));
                let closed = self.robot.close_into(configuration, &settings)?;
                is_closed[0] = f64::from(u8::from(closed));
                Ok(())
            })
        })
    }

    /// (count, equations).
    fn loop_residuals<'py>(
        &self,
        py: Python<'py>,
        configurations: PyReadonlyArray2<'py, f64>,
    ) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let width = self.num_loop_equations(py)?;
        let batch = Batch::new(&configurations)?;
        answers(py, [batch.count, width], FEW, batch.is_one(), |on, out| {
            each(on, out, width, |(): &mut (), k, out| {
                self.robot.loop_residuals_into(batch.row(k), out)
            })
        })
    }

    /// (count, equations, dofs). In memory the DOFs come before the rows.
    fn loop_jacobian<'py>(
        &self,
        py: Python<'py>,
        configurations: PyReadonlyArray2<'py, f64>,
    ) -> PyResult<Bound<'py, PyArray3<f64>>> {
        let dofs = self.read(py)?.dof_names().map_err(|error| of_robot(py, &error))?.len();
        let rows = self.num_loop_equations(py)?;
        let batch = Batch::new(&configurations)?;
        let columns = answers(py, [batch.count, dofs, rows], FEW, batch.is_one(), |on, out| {
            each(on, out, dofs * rows, |(): &mut (), k, out| {
                self.robot.loop_jacobian_into(batch.row(k), out)
            })
        })?;
        columns.permute(Some([0, 2, 1]))
    }

    /// (count, dofs): NaN where the others do not follow from the independent ones.
    fn loop_velocities<'py>(
        &self,
        py: Python<'py>,
        configurations: PyReadonlyArray2<'py, f64>,
        independent: PyReadonlyArray2<'py, f64>,
    ) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let dofs = self.read(py)?.dof_names().map_err(|error| of_robot(py, &error))?.len();
        let (batch, given) = (Batch::new(&configurations)?, Batch::new(&independent)?);
        answers(py, [batch.count, dofs], FEW, batch.is_one(), |on, out| {
            each(on, out, dofs, |(): &mut (), k, out| {
                if !self.robot.loop_velocities_into(batch.row(k), given.row(k), out)? {
                    out.fill(f64::NAN);
                }
                Ok(())
            })
        })
    }
}

//! The native part of the Python library. Users import `python/lib/urdd`, which has the documentation.
//!
//! Input arrays are contiguous and of binary64: `urdd._arrays` converts them. They are copied before the interpreter is
//! detached, so that no other thread changes them during the work.

mod advice;
mod arrays;
mod collision_model;
mod diff;
mod errors;
mod export;
mod generate;
mod lint;
mod loops;
mod obstacle;
mod outputs;
mod page;
mod parts;
mod proximity;
mod queries;
mod robot;
mod shapes;
mod source;
mod spheres;
mod threads;
mod validate;
mod work;
mod world;

use std::ffi::OsString;
use std::process::ExitCode;

use pyo3::prelude::*;
use urdd_directory::range::Range;

/// Runs the command line, and returns the exit status. The first word is the program's name.
#[pyfunction]
pub fn main(py: Python<'_>, words: Vec<OsString>, closed: bool) -> u8 {
    let status = py.detach(|| urdd::cli::run(words, closed));
    // The only way to get the number of an exit status.
    (0..=u8::MAX).find(|number| ExitCode::from(*number) == status).unwrap_or(101)
}

/// The ranges of whole numbers that Python checks together with their types, by the function and its argument.
fn ranges() -> Vec<(&'static str, (u64, u64))> {
    let ends = |range: Range| (range.least as u64, range.most as u64);
    vec![
        ("generate.pieces", ends(urdd_generate::PIECES)),
        ("generate.samples", ends(urdd_generate::SAMPLES)),
    ]
}

#[pymodule]
mod _urdd {
    #[pymodule_export]
    use crate::collision_model::CollisionModel;
    #[pymodule_export]
    use crate::diff::diff;
    #[pymodule_export]
    use crate::export::{base_pose, export, joint_groups};
    #[pymodule_export]
    use crate::generate::{combine, generate};
    #[pymodule_export]
    use crate::lint::lint;
    #[pymodule_export]
    use crate::main;
    #[pymodule_export]
    use crate::obstacle::Obstacle;
    #[pymodule_export]
    use crate::outputs::write_files;
    #[pymodule_export]
    use crate::page::{Page, page_html};
    #[pymodule_export]
    use crate::proximity::Proximity;
    #[pymodule_export]
    use crate::robot::Robot;
    #[pymodule_export]
    use crate::source::{find_urdfs, import_robot};
    #[pymodule_export]
    use crate::spheres::{SphereChecker, sphere_levels};
    #[pymodule_export]
    use crate::threads::{num_threads, set_num_threads};
    #[pymodule_export]
    use crate::validate::{explain, validate};
    #[pymodule_export]
    use crate::world::WorldProximity;

    use pyo3::prelude::*;
    use pyo3::types::PyDict;

    #[pymodule_init]
    fn init(module: &Bound<'_, PyModule>) -> PyResult<()> {
        let ranges = PyDict::new(module.py());
        for (option, ends) in crate::ranges() {
            ranges.set_item(option, ends)?;
        }
        module.add("RANGES", ranges)?;
        module.add("__version__", env!("CARGO_PKG_VERSION"))
    }
}

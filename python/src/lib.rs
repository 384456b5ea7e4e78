//! The native part of the Python library. Users import `python/lib/urdd`, which has the documentation.
//!
//! Input arrays are contiguous and of binary64: `urdd._arrays` converts them. They are copied before the interpreter is
//! detached, so that no other thread changes them during the work.

mod advice;
mod arrays;
mod collision_model;
mod combine;
mod command;
mod diff;
mod errors;
mod export;
mod generate;
mod import;
mod jobs;
mod lint;
mod obstacle;
mod outputs;
mod page;
mod parts;
mod proximity;
mod queries;
mod ranges;
mod robot;
mod shapes;
mod source;
mod threads;
mod validate;
mod work;
mod world;

use pyo3::prelude::*;

#[pymodule]
mod _urdd {
    #[pymodule_export]
    use crate::collision_model::CollisionModel;
    #[pymodule_export]
    use crate::combine::combine;
    #[pymodule_export]
    use crate::command::main;
    #[pymodule_export]
    use crate::diff::diff;
    #[pymodule_export]
    use crate::export::{base_pose, export, joint_groups};
    #[pymodule_export]
    use crate::generate::generate;
    #[pymodule_export]
    use crate::import::import_robot;
    #[pymodule_export]
    use crate::jobs::find_urdfs;
    #[pymodule_export]
    use crate::lint::lint;
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
        for (option, ends) in crate::ranges::all() {
            ranges.set_item(option, ends)?;
        }
        module.add("RANGES", ranges)?;
        module.add("__version__", env!("CARGO_PKG_VERSION"))
    }
}

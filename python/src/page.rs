//! The page of `urdd view`.

use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex};
use std::thread::JoinHandle;

use pyo3::exceptions::PyOSError;
use pyo3::prelude::*;
use urdd_directory::cancellation::Cancellation;
use urdd_view::{Collection, Server, Shown};

use crate::errors::raise;
use crate::robot::Robot;
use crate::work;

/// The page, served to this machine's browser until it is closed.
#[pyclass(frozen, module = "urdd._urdd")]
pub struct Page {
    address: String,
    robots: Vec<Arc<Shown>>,
    process: u32,
    cancellation: Cancellation,
    thread: Mutex<Option<JoinHandle<()>>>,
}

fn collection(py: Python<'_>, path: &Path) -> PyResult<Collection> {
    let robots = Collection::default();
    let added = robots.add(path);
    added.map_err(|error| raise(py, "OpenError", error, &[]))?;
    Ok(robots)
}

#[pymethods]
impl Page {
    #[new]
    #[pyo3(signature = (path, port=None))]
    fn new(py: Python<'_>, path: PathBuf, port: Option<u16>) -> PyResult<Self> {
        let collection = collection(py, &path)?;
        let robots = collection.robots();
        let server = Server::bind(collection, port);
        let server = server.map_err(|error| PyOSError::new_err(error.to_string()))?;
        let (address, cancellation) = (server.address(), Cancellation::default());
        let own = cancellation.clone();
        let thread = std::thread::Builder::new()
            .name("urdd-page".to_owned())
            .spawn(move || server.run(&own))?;
        Ok(Page {
            address,
            robots,
            process: std::process::id(),
            cancellation,
            thread: Mutex::new(Some(thread)),
        })
    }

    /// The address to open. It contains the token that every request needs.
    #[getter]
    fn address(&self) -> &str {
        &self.address
    }

    /// Shows a configuration, in every open page.
    fn set(&self, configuration: Vec<f64>) {
        for robot in &self.robots {
            robot.states.set(&configuration);
        }
    }

    /// Shows what is around the robot: JSON as [`urdd_view::States::show`] takes it.
    fn show(&self, around: &str) {
        for robot in &self.robots {
            robot.states.show(around);
        }
    }

    /// Stops serving.
    fn close(&self, py: Python<'_>) -> PyResult<()> {
        self.cancellation.cancel();
        let thread = work::lock(py, &self.thread)?.take();
        if let Some(thread) = thread
            && self.process == std::process::id()
        {
            let _ = py.detach(|| thread.join());
        }
        Ok(())
    }
}

impl Drop for Page {
    fn drop(&mut self) {
        self.cancellation.cancel();
    }
}

/// The page with one embedded robot, as HTML, and what it shows of it: JSON as [`urdd_view::page_with`] takes it.
#[pyfunction]
#[pyo3(signature = (robot, showing=None))]
pub fn page_html(py: Python<'_>, robot: &Robot, showing: Option<String>) -> PyResult<String> {
    let root = robot.robot.root();
    let made = work::run(py, move |_| {
        let shown = Collection::default().add_root(root).map_err(|error| error.to_string())?;
        urdd_view::page_with(&shown, showing.as_deref()).map_err(|error| error.to_string())
    })?;
    made.map_err(|error| raise(py, "OpenError", error, &[]))
}

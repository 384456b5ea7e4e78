//! Reads USD: the bodies and joints of UsdPhysics in a stage as a robot.

mod actuators;
mod assets;
mod door;
mod drive;
pub mod fault;
mod form;
mod frames;
mod gprim;
mod graph;
mod groups;
mod joint;
mod look;
mod made;
mod mass;
mod mesh;
mod missing;
mod pairs;
mod robot;
mod scene;
mod upright;

use std::collections::BTreeMap;

use urdd_source::ImportOptions;
use urdd_source::gate::Gate;
use urdd_usd::{Place as LayerPlace, UsdError};

use super::model::Model;
use super::place::TextFile;
use super::refusal::{Placed, placed};
use door::GateDoor;
use fault::UsdFault;
use robot::robot;
use scene::Scene;

/// Reads the robot of a description.
pub fn read(file: TextFile, gate: &Gate, options: &ImportOptions) -> Result<Model, Placed> {
    let name = file.path.file_name().unwrap_or_default().to_string_lossy().into_owned();
    let shown = file.shown.clone();
    let files = BTreeMap::from([(name.clone(), file)]);
    let mut door = GateDoor { gate, files };
    let opened = urdd_usd::open(&name, &mut door);
    let refused = |error: UsdError| {
        let own = door.file(&error.layer).map_or(&*shown, |file| &*file.shown);
        let (line, column) = match error.place {
            LayerPlace::Text(line, column) => (line, column),
            _ => (0, 0),
        };
        let place = match (&error.place, error.layer.ends_with(']')) {
            (LayerPlace::Text(..) | LayerPlace::Layer, false) => String::new(),
            (place, false) => format!("{place}: ").trim_start_matches(", ").to_owned(),
            (place, true) => format!("{}{place}: ", error.layer),
        };
        let fault = UsdFault::Layer(format!("{place}{}", error.fault)).into();
        Placed { file: own.to_owned(), line, column, fault }
    };
    let stage = opened.map_err(refused)?;
    if let Some(error) = missing::needed(&stage) {
        return Err(refused(error.clone()));
    }
    let files: Vec<TextFile> =
        stage.layers.iter().filter_map(|layer| door.file(layer).cloned()).collect();
    let made = (|| {
        let texts: Vec<&str> = files.iter().map(|file| &*file.text).collect();
        let scene = Scene::of(&stage, &texts, gate.account())?;
        robot(&scene, gate, options)
    })();
    match made {
        Ok(model) => Ok(Model { files, ..model }),
        Err(why) => Err(placed(&files, why)),
    }
}

//! Reads USD: the bodies and joints of UsdPhysics in a stage as a robot.

mod assets;
mod drive;
mod form;
mod frames;
mod gprim;
mod joint;
mod mass;
mod pairs;
mod robot;
mod scene;

use std::collections::BTreeMap;

use urdd_directory::account::{Account, AccountError};
use urdd_source::ImportOptions;
use urdd_source::gate::Gate;
use urdd_usd::{Fault as LayerFault, Place as LayerPlace, Stage, UsdError};

use crate::fault::UsdFault;
use crate::model::Model;
use crate::place::{Placed, Placing, TextFile, placed};
use assets::GateDoor;
use joint::is_joint;
use robot::robot;
use scene::Scene;

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
        let fault = match error.fault {
            LayerFault::TooMuch(why @ AccountError::Cancelled(_)) => why.into(),
            fault => UsdFault::Layer(format!("{place}{fault}")).into(),
        };
        Placed { file: own.to_owned(), line, column, fault }
    };
    let stage = opened.map_err(refused)?;
    let files: Vec<TextFile> =
        stage.layers.iter().filter_map(|layer| door.file(layer).cloned()).collect();
    let needed = needed(&stage, gate.account()).at(Default::default());
    if let Some(error) = needed.map_err(|why| placed(&files, why))? {
        return Err(refused(error.clone()));
    }
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

/// The first that may hold a part of a robot: where bodies or joints are in the prim that brings it in, or it is in a body,
/// or a joint leads into it, or there are no bodies.
fn needed<'s>(stage: &'s Stage, account: &Account) -> Result<Option<&'s UsdError>, AccountError> {
    // Of each prim: whether it is in a body, and whether a body or a joint is in it.
    let mut is_inside = vec![false; stage.prims.len()];
    let mut is_around = vec![false; stage.prims.len()];
    let mut has_bodies = false;
    let mut mark = |mut at: Option<usize>| {
        while let Some(prim) = at.filter(|prim| !std::mem::replace(&mut is_around[*prim], true)) {
            at = stage.prims[prim].parent;
        }
    };
    for (at, prim) in stage.prims.iter().enumerate() {
        let is_body = prim.has("PhysicsRigidBodyAPI");
        has_bodies |= is_body;
        is_inside[at] = is_body || prim.parent.is_some_and(|parent| is_inside[parent]);
        if is_body || is_joint(prim) {
            mark(Some(at));
        }
        for end in ["physics:body0", "physics:body1"] {
            for target in prim.targets(end).walk(account)? {
                // What is there of the path.
                if stage.find(target, account)?.is_none() {
                    mark(stage.nearest(target, account)?);
                }
            }
        }
    }
    let is_needed = |prim: Option<usize>| {
        prim.is_none_or(|prim| !has_bodies || is_inside[prim] || is_around[prim])
    };
    Ok(stage.missing.iter().find(|(prim, _)| is_needed(*prim)).map(|(_, error)| error))
}

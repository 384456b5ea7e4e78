//! Models read of SDF, against what libsdformat 12 resolves of the same files (`truth.jsonl`), and closed forms.
//!
//! `truth.jsonl` is written in `fixtures` by `ls *.sdf | sed "s|^|$PWD/|" | sdf_truth > ../truth.jsonl`, where `sdf_truth`
//! is `tests/figures/imports/sdf.cpp`.

mod closed_forms;
mod names;
mod refusals;
mod refused;
mod resolved;
mod said;
mod versions;
mod worlds;

use std::path::{Path, PathBuf};
use std::sync::Arc;

use nalgebra::Isometry3;
use urdd_source::gate::Gate;
use urdd_source::{Files, ImportOptions, Settings};

use crate::model::{Body, Joint, Model};
use crate::place::{Placed, TextFile};
use crate::sdf;
use crate::tests::Entries as _;

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("src/tests/sdf/fixtures")
}

fn read(text: &str, folder: &Path, settings: &Settings) -> Result<Model, Placed> {
    read_with(text, folder, settings, &ImportOptions::default())
}

fn read_with(
    text: &str,
    folder: &Path,
    settings: &Settings,
    options: &ImportOptions,
) -> Result<Model, Placed> {
    let gate = Gate::of_project(folder, settings);
    let path = folder.join("robot.sdf");
    let bytes = Arc::from(text.as_bytes());
    let file = TextFile { shown: "robot.sdf".to_owned(), path, text: text.to_owned(), bytes };
    sdf::read(file, &gate, options)
}

/// The model of a fixture.
fn fixture(name: &str) -> Model {
    let text = std::fs::read_to_string(folder().join(name)).expect("a fixture");
    read(&text, &folder(), &Settings::default()).expect("a model")
}

/// The model of a text, with files in memory around it.
fn given(text: &str, files: &[(&str, &str)]) -> Result<Model, Placed> {
    read(text, Path::new("/"), &memory(files))
}

fn memory(files: &[(&str, &str)]) -> Settings {
    let file = |(path, text): &(&str, &str)| ((*path).to_owned(), Arc::from(text.as_bytes()));
    let files = Files::in_memory(files.iter().map(file)).expect("files");
    Settings { files, ..Settings::default() }
}

/// The model of what is in `<model>`.
fn inside(version: &str, text: &str) -> Result<Model, Placed> {
    given(&format!("<sdf version=\"{version}\"><model name=\"m\">{text}</model></sdf>"), &[])
}

fn body<'m>(model: &'m Model, name: &str) -> &'m Body {
    let found = model.bodies.iter().find(|body| body.name == name);
    found.unwrap_or_else(|| panic!("no body {name}"))
}

/// A joint, with the body that it moves.
fn joint<'m>(model: &'m Model, name: &str) -> (&'m Body, &'m Joint) {
    let all =
        model.bodies.iter().flat_map(|body| body.joints.iter().map(move |joint| (body, joint)));
    let mut found = all.filter(|(_, joint)| joint.name == name);
    found.next().unwrap_or_else(|| panic!("no joint {name}"))
}

/// The pose of a body in the frame of the root, all joints at their references.
fn pose(model: &Model, name: &str) -> Isometry3<f64> {
    let mut at = body(model, name);
    let mut pose = Isometry3::identity();
    while let Some(parent) = at.parent {
        pose = at.pose * pose;
        at = &model.bodies[parent];
    }
    pose
}

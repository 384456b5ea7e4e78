//! What commands write among files of a person: all or nothing, never through a link or into a pipe, never over what was
//! there without `--force`, and nothing that a kill leaves for good.
#![cfg(unix)]

mod in_the_way;
mod killed;
mod names;

use std::fs;
use std::path::Path;

/// A robot of which an import writes all kinds of files: the URDF, a mesh, an SRDF, an `export.toml`. The number is in each,
/// but not in their names.
pub fn mjcf(number: u32) -> String {
    format!(
        "<mujoco model=\"r\"><compiler angle=\"radian\"/>\n\
         <asset><mesh name=\"m\" vertex=\"0 0 0 1 0 0 0 1 0 0 0 {number}\"/></asset>\n\
         <worldbody><body name=\"a\"><geom type=\"mesh\" mesh=\"m\" mass=\"1\"/>\n\
         <body name=\"x\"><joint name=\"j\" range=\"-1 1\"/><geom size=\".1\"/>\n\
         <body name=\"end\" pos=\"0 0 1\"><joint name=\"k\" range=\"-1 1\"/><geom size=\".1\"/></body></body></body></worldbody>\n\
         <actuator><position joint=\"j\" kp=\"{number}\" kv=\"1\"/></actuator>\n\
         <contact><exclude body1=\"a\" body2=\"end\"/></contact>\n\
         <keyframe><key name=\"home\" qpos=\"0.{number} 0\"/></keyframe></mujoco>\n"
    )
}

/// The files below a folder, hidden ones too, without what pipes and links lead to.
pub fn files(folder: &Path) -> Vec<(String, Vec<u8>)> {
    let mut found = Vec::new();
    let mut open = vec![folder.to_owned()];
    while let Some(here) = open.pop() {
        for entry in fs::read_dir(&here).unwrap() {
            let path = entry.unwrap().path();
            let kind = fs::symlink_metadata(&path).unwrap();
            let name = path.strip_prefix(folder).unwrap().to_str().unwrap().to_owned();
            match kind {
                kind if kind.is_dir() => open.push(path),
                kind if kind.is_file() => found.push((name, fs::read(path).unwrap())),
                kind => found.push((format!("{name} {:?}", kind.file_type()), Vec::new())),
            }
        }
    }
    found.sort();
    found
}

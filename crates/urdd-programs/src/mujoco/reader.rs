//! What the parts of the reader share.

use crate::prelude::*;

/// The least mass, and the least moment of inertia, of a link that moves.
pub const LEAST: f64 = 1e-15;

/// Which MuJoCo.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Release {
    /// 3.3.7.
    Three,
    /// 4.0.0.
    Four,
}

impl Release {
    /// What counts as nothing off the diagonal of a tensor.
    pub fn epsilon(self) -> f64 {
        match self {
            Release::Three => 1e-12,
            Release::Four => 0.0,
        }
    }
}

/// What all parts of the reader have.
pub struct Reader<'r> {
    pub release: Release,
    pub file: &'r File<'r>,
    pub effects: &'r mut Effects,
    pub settings: Settings,
    /// The names of collisions.
    pub geoms: HashSet<String>,
}

/// What `<compiler>` says.
pub struct Settings {
    /// Visuals are geoms too.
    pub has_visuals: bool,
    /// Only the last part of a mesh's file name counts; none if nothing is said.
    pub strips_paths: Option<bool>,
    /// The folder of meshes.
    pub mesh_folder: String,
    /// Tensors that no body can have are mended.
    pub balances: bool,
    /// Links that are fixed together are one.
    pub fuses: bool,
    /// Inertias come from collisions, whatever inertials say.
    pub ignores_inertials: bool,
    /// The least mass and the least moment.
    pub least: [f64; 2],
}

impl Default for Settings {
    fn default() -> Settings {
        Settings {
            has_visuals: false,
            strips_paths: None,
            mesh_folder: String::new(),
            balances: false,
            fuses: true,
            ignores_inertials: false,
            least: [0.0; 2],
        }
    }
}

//! Every rule, in files by subject: one rule, or several that are about the same or share their check.

pub mod bounds;
pub mod chain {
    //! CHN: `chain_module`.
    //!
    //! Every table is compared with the tree that follows from `urdf_module`, and none with another, so
    //! that one wrong value gives one finding.

    pub mod joints;
    pub mod links;
}
pub mod composition;
pub mod connections;
pub mod directory {
    //! DIR: files and folders, and the root metadata.

    pub mod files;
    pub mod listed;
    pub mod metadata;
    pub mod versions;
}
pub mod dof;
pub mod extensions;
pub mod kinematics {
    //! KIN: poses.

    pub mod poses;
    pub mod samples;
}
pub mod learned {
    //! LRN: the learned self-collision model.

    pub mod numbers;
    pub mod results;
}
pub mod legacy;
pub mod loops {
    //! LOP: `loops_module`.

    pub mod configurations;
    pub mod ties;
}
pub mod meshes {
    //! MSH: the mesh modules and the contents of their files.

    pub mod formats;
    pub mod geometry;
    pub mod lists;
    pub mod originals;
    pub mod pieces;
}
pub mod named_configurations;
mod prelude;
pub mod shapes {
    //! SHP: the link shape modules, on their own and compared with meshes and kinematics.

    pub mod fit;
    pub mod matrices;
    pub mod reasons;
    pub mod skips;
    pub mod statistics;
}
pub mod source {
    //! SRC: unusual robots, whose URDD may still be correct.

    pub mod inertia;
    pub mod limits;
}
pub mod spheres {
    //! SPH: `link_shapes_spheres_module`.

    pub mod fit;
    pub mod lists;
    pub mod pairs;
}
pub mod testing;
pub mod text;
pub mod urdf {
    //! URD: `urdf_module` against the carried URDF, and as a tree.

    pub mod compared;
    pub mod tree;
}

use super::rule::Rule;

macro_rules! rules_of {
    ($($($file:ident)::+),+ $(,)?) => {
        [$($($file)::+::RULES),+].concat()
    };
}

/// Every rule, in the order of their codes.
pub fn all() -> Vec<&'static Rule> {
    let mut rules = rules_of! {
        bounds, chain::joints, chain::links, composition, connections, directory::files, directory::listed,
        directory::metadata, directory::versions, dof, extensions, kinematics::poses, kinematics::samples,
        learned::numbers, learned::results, legacy, loops::configurations, loops::ties, meshes::formats,
        meshes::geometry, meshes::lists, meshes::originals, meshes::pieces, named_configurations, shapes::fit,
        shapes::matrices, shapes::reasons, shapes::skips, shapes::statistics, source::inertia, source::limits,
        spheres::fit, spheres::lists, spheres::pairs, text, urdf::compared, urdf::tree,
    };
    rules.sort_by_key(|rule| rule.code);
    rules
}

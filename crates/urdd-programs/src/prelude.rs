//! Names that readers use.

pub(crate) use std::collections::{HashMap, HashSet};

pub(crate) use crate::effect::{At, Effects, Reading};
pub(crate) use crate::fault::*;
pub(crate) use crate::file::{About, File};
pub(crate) use crate::look::Look;
pub(crate) use crate::mesh::{Mesh, MeshFacts};
pub(crate) use crate::number::{is_space, istream, pieces, strtod, whole};
pub(crate) use crate::part::Part;
pub(crate) use crate::tinyxml;
pub(crate) use crate::tree::{Attribute, Node};
pub(crate) use crate::unknown::Names;

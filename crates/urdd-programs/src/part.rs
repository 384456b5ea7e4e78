//! Parts of a robot.

use std::fmt::Display;
use std::ops::Deref;
use std::sync::Arc;

use urdd_format::short;

use crate::tree::Node;

/// A part of a robot, such as `joint/elbow/limit`; empty for the whole file. It is made of names, and a long name is
/// shortened where it enters: a part is short, however many effects have it.
#[derive(Debug, Clone, PartialEq, Eq, Hash, Default)]
pub struct Part(Arc<str>);

impl Part {
    /// The part of a kind and name.
    pub(crate) fn of(kind: &str, name: &str) -> Self {
        Part(format!("{kind}/{}", short::name(name)).into())
    }

    pub(crate) fn inside(&self, what: impl Display) -> Self {
        Part(format!("{}/{what}", self.0).into())
    }

    /// The visuals or collisions of a link whose part it is, and the part of each.
    pub(crate) fn shapes<'t>(
        &self,
        link: Node<'t>,
        kind: &'static str,
    ) -> impl Iterator<Item = (Node<'t>, Part)> {
        let part = move |(index, shape)| (shape, self.inside(format_args!("{kind}/{index}")));
        link.named(kind).enumerate().map(part)
    }
}

impl From<&'static str> for Part {
    fn from(part: &'static str) -> Self {
        Part(part.into())
    }
}

impl From<&Part> for Part {
    fn from(part: &Part) -> Self {
        part.clone()
    }
}

impl Deref for Part {
    type Target = str;
    fn deref(&self) -> &str {
        &self.0
    }
}

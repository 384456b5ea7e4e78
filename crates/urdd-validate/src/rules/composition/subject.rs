//! What the rules judge.

use crate::rules::prelude::*;
use urdd_document::robot::Robot;
use urdd_format::composition::CompositionModule;

/// The module, its document and the robot.
pub(super) fn subject(context: &Context) -> Option<(&Module, &CompositionModule, &Robot)> {
    let kind = ModuleKind::Composition;
    let composition = document!(context, Composition)?;
    Some((context.module(kind)?, composition, context.robot()?))
}

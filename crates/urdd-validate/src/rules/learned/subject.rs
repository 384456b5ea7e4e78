//! What the rules judge.

use crate::rules::prelude::*;
use urdd_format::self_collision_model::SelfCollisionModelModule;

/// The module and its document.
pub(super) fn subject(context: &Context) -> Option<(&Module, &SelfCollisionModelModule)> {
    let model = document!(context, SelfCollisionModel)?;
    Some((context.module(ModuleKind::SelfCollisionModel)?, model))
}

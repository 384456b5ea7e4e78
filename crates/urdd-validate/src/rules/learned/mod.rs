//! LRN: the learned self-collision model.

mod counts_differ;
mod counts_few;
mod counts_impossible;
mod index_out_of_range;
mod input_wrong;
mod other_geometry;
mod output_differs;
mod overflow;
mod pairs_differ;
mod rates_not_met;
mod too_large;
mod wrong_shape;

use crate::context::Context;
use crate::rule::Rule;
use urdd_document::module::Module;
use urdd_format::registry::{ModuleDocument, ModuleKind};
use urdd_format::self_collision_model::SelfCollisionModelModule;

/// The rules of this family.
pub const RULES: &[&Rule] = &[
    &index_out_of_range::RULE,
    &input_wrong::RULE,
    &wrong_shape::RULE,
    &overflow::RULE,
    &too_large::RULE,
    &other_geometry::RULE,
    &pairs_differ::RULE,
    &output_differs::RULE,
    &counts_impossible::RULE,
    &counts_differ::RULE,
    &rates_not_met::RULE,
    &counts_few::RULE,
];

/// What every rule of this family looks at: the module, and what it says.
fn subject(context: &Context) -> Option<(&Module, &SelfCollisionModelModule)> {
    let kind = ModuleKind::SelfCollisionModel;
    let Some(ModuleDocument::SelfCollisionModel(model)) = context.document(kind) else {
        return None;
    };
    Some((context.module(kind)?, model))
}

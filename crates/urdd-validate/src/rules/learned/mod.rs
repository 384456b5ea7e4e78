//! LRN: the learned self-collision model.

pub mod counts_differ;
pub mod counts_few;
pub mod counts_impossible;
pub mod index_out_of_range;
pub mod input_wrong;
pub mod other_geometry;
pub mod output_differs;
pub mod overflow;
pub mod pairs_differ;
pub mod rates_not_met;
pub mod too_large;
pub mod wrong_shape;

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

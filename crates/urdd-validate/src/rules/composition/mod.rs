//! CMP: how a robot was put together from others.

mod attachment_wrong;
mod frozen_joint_moves;
mod index_out_of_range;
mod not_one_to_one;
mod part_ids;
mod renamed_otherwise;

use crate::context::Context;
use crate::rule::Rule;
use urdd_document::module::Module;
use urdd_document::robot::Robot;
use urdd_format::composition::CompositionModule;
use urdd_format::registry::{ModuleDocument, ModuleKind};

/// The rules of this family.
pub const RULES: &[&Rule] = &[
    &index_out_of_range::RULE,
    &part_ids::RULE,
    &not_one_to_one::RULE,
    &renamed_otherwise::RULE,
    &attachment_wrong::RULE,
    &frozen_joint_moves::RULE,
];

/// What every rule of this family looks at: the module, what it says, and the robot.
fn subject(context: &Context) -> Option<(&Module, &CompositionModule, &Robot)> {
    let kind = ModuleKind::Composition;
    let Some(ModuleDocument::Composition(composition)) = context.document(kind) else {
        return None;
    };
    Some((context.module(kind)?, composition, context.robot()?))
}

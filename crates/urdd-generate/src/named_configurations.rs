//! `named_configurations_module` from the user's decisions, DOFs and bounds: SPEC 6.7.

use super::context::Context;
use super::error::GenerateError;
use super::made::{Made, made};
use urdd_format::named_configurations::NamedConfigurationsModule;
use urdd_source::note::NoteKind;

/// The module.
pub(super) fn named_configurations(context: &Context) -> Result<Made, GenerateError> {
    let mut made =
        made(&NamedConfigurationsModule { configurations: context.named.configurations.clone() })?;
    let assumed = "the position is left out; the DOF has its default value there";
    let lost = context.named.lost.iter();
    made.notes
        .extend(lost.map(|problem| context.note(NoteKind::LeftOut, problem.clone(), assumed)));
    Ok(made)
}

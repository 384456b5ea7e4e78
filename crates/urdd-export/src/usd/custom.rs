//! What USD has no place for, as custom data of a prim under `urdd`: named configurations, and elements of the source that
//! URDF does not define.

use super::prim::{Prim, array, string};
use crate::{ExportError, Subject};
use urdd_format::named_configurations::NamedConfiguration;
use urdd_xml::number::number;

/// Adds elements of the source, each as it is written there.
pub(super) fn elements(prim: &mut Prim, elements: &[String]) {
    data(prim, elements, String::new());
}

/// Adds elements and named configurations: for each, the value of each DOF, rad or m.
pub(super) fn robot(subject: &Subject, prim: &mut Prim) -> Result<(), ExportError> {
    let dofs = subject.robot.dof_names()?;
    let one = |named: &NamedConfiguration| {
        let each = dofs.iter().zip(&named.configuration);
        let values =
            each.map(|(dof, value)| format!("double {} = {}", string(dof), number(*value)));
        format!(
            "dictionary {} = {{ {} }}",
            string(named.name.as_str()),
            values.collect::<Vec<_>>().join("; ")
        )
    };
    let named: Vec<String> = subject.robot.named_configurations()?.iter().map(one).collect();
    let named = match named.is_empty() {
        true => String::new(),
        false => format!("dictionary configurations = {{ {} }}; ", named.join("; ")),
    };
    data(prim, &subject.urdf.unknown_elements, named);
    Ok(())
}

fn data(prim: &mut Prim, elements: &[String], mut all: String) {
    if !elements.is_empty() {
        let texts = array(elements.iter().map(|text| string(text)));
        all += &format!("string[] elements = {texts}");
    }
    if !all.is_empty() {
        prim.describe("customData", &format!("{{ dictionary urdd = {{ {all} }} }}"));
    }
}

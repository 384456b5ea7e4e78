//! Creates the files of a new rule of lint.

use std::path::Path;

use crate::new_rule::{
    CODES, add_change, add_code, check_name, check_new, next_version, register, severity,
};
use crate::source::Edits;

pub const RULES: &str = "crates/urdd-lint/src/rules";
pub const CASES: &str = "crates/urdd-lint/tests/cases";
/// It also has candidates that were given up, whose codes are not used.
const EVIDENCE: &str = "benches/evaluation/lint/evidence.md";

/// Creates a rule of the family LNT. Writes nothing unless all edits are possible.
///
/// # Errors
/// If the code or the name is invalid, or the source does not have the expected form.
pub fn make(root: &Path, code: &str, name: &str, severity_word: &str) -> Result<String, String> {
    check_name(name)?;
    let severity = severity(severity_word)?;
    let mut edits = Edits::new(root);
    let candidates = edits.read(EVIDENCE)?;
    let candidates =
        candidates.lines().filter_map(|line| line.strip_prefix("## LNT")?.get(..3)?.parse().ok());
    let least = candidates.max().unwrap_or(0) + 1;
    edits.set(CODES, add_code(&edits.read(CODES)?, code, least)?);
    add_change(&mut edits, &format!("what {code} finds"))?;
    check_new(root, RULES, name)?;
    let module = name.replace('-', "_");
    edits.create(
        &format!("{RULES}/{module}.rs"),
        rule(code, name, severity, &next_version(&edits)?),
    )?;
    let list = format!("{RULES}/mod.rs");
    edits.set(&list, register(&edits.read(&list)?, &module, &list)?);
    for case in ["invalid", "near_miss"] {
        edits.create(&format!("{CASES}/{code}/{case}.urdf"), CASE.to_owned())?;
    }
    edits.write()?;
    Ok(format!(
        "1. Write the rule: {RULES}/{module}.rs.\n\
         2. Write its two cases: {CASES}/{code}/invalid.urdf, in which only it finds something, and near_miss.urdf.\n\
         3. cargo test --workspace --test lint cases\n\
         4. cargo xtask update       (writes again what is generated)\n\
         5. cargo xtask check        (says what is left; before you send, .ci/quick runs it)\n"
    ))
}

fn rule(code: &str, name: &str, severity: &str, since: &str) -> String {
    format!(
        r#"use super::prelude::*;

declare_lint! {{
    /// TODO: what is wrong, in one sentence.
    ///
    /// TODO: what goes wrong in which program, and what to do.
    {code} "{name}", {severity}, WrongMotion, since "{since}", off by default
}}

fn check(urdf: &Subject, findings: &mut Findings) -> Option<()> {{
    // TODO: report each place. `subject.rs` shows what a rule can look at.
    for joint in urdf.joints_of(&["TODO"]) {{
        urdf.at(joint, "TODO: what is wrong here, and what to do").report(findings);
    }}
    Some(())
}}
"#
    )
}

/// A robot without a fault.
const CASE: &str = r#"<robot name="arm">
  <link name="base">
    <inertial>
      <mass value="5"/>
      <inertia ixx="0.03" ixy="0" ixz="0" iyy="0.03" iyz="0" izz="0.04"/>
    </inertial>
  </link>
  <joint name="turn" type="continuous">
    <parent link="base"/>
    <child link="upper"/>
    <axis xyz="0 0 1"/>
  </joint>
  <link name="upper">
    <inertial>
      <mass value="2"/>
      <inertia ixx="0.016" ixy="0" ixz="0" iyy="0.016" iyz="0" izz="0.002"/>
    </inertial>
  </link>
</robot>
"#;

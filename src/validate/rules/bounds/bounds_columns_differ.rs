use crate::format::registry::ModuleKind;
use crate::validate::context::Context;
use crate::validate::finding::{Finding, Findings};
use crate::validate::rule::declare_rule;
use crate::validate::tolerance::{number_tolerance, numbers_agree};

declare_rule! {
    /// `dof_lower_bounds` or `dof_upper_bounds` is not the column of `bounds`.
    ///
    /// The module says the same twice, for programs that want pairs and for programs that want two
    /// vectors. Where the two differ, programs disagree about the robot.
    ///
    /// Write all three lists from the limits of the joints, which decide which of the two is right.
    BND002 "bounds-columns-differ", Error, clause "6.5.1", since "0.1.0",
    phase References, needs [Module(Kind::Bounds), Passed(BND001)],
    check check,
}

fn check(context: &Context, findings: &mut Findings) {
    let (Some(bounds), Some(module)) = (context.bounds(), context.module(ModuleKind::Bounds))
    else {
        return;
    };
    for (column, (name, values)) in [
        ("dof_lower_bounds", bounds.lower),
        ("dof_upper_bounds", bounds.upper),
    ]
    .into_iter()
    .enumerate()
    {
        for (dof, (pair, value)) in bounds.bounds.iter().zip(values).enumerate() {
            let right = pair[column];
            if !numbers_agree(right, *value) {
                findings.report(
                    Finding::at(
                        module.file("module.json"),
                        format!("/{name}/{dof}"),
                        format!(
                            "this and `/bounds/{dof}/{column}` say different things of DOF {dof}; one of them is wrong"
                        ),
                    )
                    .expected(format!("{right:?}, as `/bounds/{dof}/{column}` has it"))
                    .actual(format!("{value:?}"))
                    .tolerance(number_tolerance(right, *value))
                    .off_by(right - value, ""),
                );
            }
        }
    }
}

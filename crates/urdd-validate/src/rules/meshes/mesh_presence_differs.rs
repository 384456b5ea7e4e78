use crate::rules::prelude::*;

declare_rule! {
    /// A link has a mesh in one mesh module and none in another.
    ///
    /// Hulls and convex pieces are made from the plain mesh: a link has all three or none. Where one is
    /// missing, a program that checks collisions passes over a link that another program sees.
    ///
    /// Write the mesh modules again, all from the same plain meshes.
    MSH007 "mesh-presence-differs", Error, clause "7.2", since "0.1.0",
    phase References, needs [DERIVED_MESHES, NotFailed(MSH001), NotFailed(MSH003)],
}

fn check(context: &Context, findings: &mut Findings) -> Option<()> {
    let modules: Vec<_> = context.mesh_modules(DERIVED).collect();
    let links = modules.iter().map(|(_, _, meshes)| meshes.num_links()).max();
    for link in 0..links.unwrap_or(0) {
        let (with, without): (Vec<_>, Vec<_>) =
            (modules.iter()).partition(|(_, _, meshes)| meshes.count(link) > 0);
        if with.is_empty() || without.is_empty() {
            continue;
        }
        // Reported at the module that differs from the others; of two, at the one without a mesh.
        let odd_has = with.len() < without.len();
        let (odd, others) = if odd_has { (with, without) } else { (without, with) };
        let (_, module, meshes) = odd.first()?;
        let others: Vec<&str> = others.iter().map(|(kind, ..)| kind.name()).collect();
        let (label, others) = (context.link_label(link), others.join(" and "));
        let (message, expected, actual) = match odd_has {
            true => {
                let message = format!("{label} has a mesh here, but none in {others}");
                (message, "no mesh", "a mesh")
            }
            false => {
                let message = format!("{label} has no mesh here, but one in {others}");
                (message, "a mesh", "none")
            }
        };
        let finding = finding_in(*module, meshes.pointer(link), message);
        findings.report(finding.values(expected, actual));
    }
    Some(())
}

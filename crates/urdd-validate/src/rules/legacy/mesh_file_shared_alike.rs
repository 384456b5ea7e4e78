use crate::rules::prelude::*;
use crate::views::shared_meshes;

declare_rule! {
    /// Links share one derived mesh file.
    ///
    /// The first producer named derived files after the mesh that they came from, so that links with
    /// one mesh name had one file, and the last of them overwrote it. Here these links place the mesh
    /// in the same way, and the file is right for all of them. Where they do not, MSH005 reports it.
    ///
    /// Nothing needs to be done now. When one of these links gets another visual origin or scale, the
    /// meshes of the others become wrong without notice. In version 1 each link has its own file.
    LEG007 "mesh-file-shared-alike", Info, clause "10.6", since "0.1.0",
    phase References, needs [Legacy, Module(Kind::Urdf), NotFailed(MSH001), NotFailed(MSH003)],
}

fn check(context: &Context, findings: &mut Findings) -> Option<()> {
    let mut shared = shared_meshes::all(context);
    shared.retain(|shared| shared.alike);
    let pairs = shared.iter().flat_map(|shared| [shared.first.0, shared.other.0]);
    let links: BTreeSet<usize> = pairs.collect();
    if let Some(first) = shared.first() {
        let message = format!(
            "{} links share derived mesh files with others that place the same mesh in the same way: correct as it is, but wrong once one of them is placed differently",
            links.len()
        );
        let (a, b) = (first.first.0, first.other.0);
        let (a, b) = (context.link_label(a), context.link_label(b));
        let file = format!("{}/module.json", first.kind.folder());
        let finding = Finding::at(file, &first.other.1, message);
        findings.report(finding.actual(format!("`{}`, of {a} and {b}", first.path)));
    }
    Some(())
}

use super::prelude::*;

declare_lint! {
    /// A visual names a material that is not defined.
    ///
    /// urdfdom 1.0 refuses the whole robot: `material 'X' undefined`. Others log an error, and draw the link in a default
    /// colour. urdfdom reads links in the order of the file, so a definition in a later link does not count.
    ///
    /// Define the material directly in `<robot>`, or write its colour here.
    LNT041 "material-not-defined", Warning, Appearance, since "1.1.0"
}

fn check(urdf: &Subject, findings: &mut Findings) -> Option<()> {
    let named = |node: Node<'_, '_>, wanted: &str| node.tag_name().name() == wanted;
    let global = children(urdf.root).filter(|(name, _)| *name == "material");
    let mut defined: BTreeSet<&str> =
        global.filter_map(|(_, node)| node.attribute("name")).collect();
    let mut told = BTreeSet::new();
    for link in &urdf.links {
        let visuals = link.children().filter(|node| named(*node, "visual"));
        for material in visuals.filter_map(|visual| child(visual, "material")) {
            let Some(name) = material.attribute("name").filter(|name| !name.is_empty()) else {
                continue;
            };
            if child(material, "color").is_some() || child(material, "texture").is_some() {
                defined.insert(name);
            } else if !defined.contains(name) && told.insert(name) {
                let message = format!(
                    "material `{}` is not defined in `<robot>`, nor in a link before this one; define it \
                     in `<robot>`",
                    urdd_format::escape::line(name)
                );
                urdf.at_attribute(material, "name", message).report(findings);
            }
        }
    }
    Some(())
}

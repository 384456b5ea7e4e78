//! `<mujoco>` in a URDF.

use super::reader::Reader;
use crate::prelude::*;

impl Reader<'_> {
    pub fn settings(&mut self, robot: Node<'_>) -> Reading<()> {
        let Some(mujoco) = self.only(robot, "mujoco")? else { return Ok(()) };
        if let Some(compiler) = self.only(mujoco, "compiler")? {
            self.compiler(compiler)?;
        }
        if let Some(option) = self.only(mujoco, "option")? {
            self.each_number(option, &["timestep", "impratio", "tolerance", "gravity", "wind"])?;
        }
        if let Some(size) = self.only(mujoco, "size")? {
            self.each_number(size, &["njmax", "nconmax", "nstack", "nuserdata", "nkey"])?;
        }
        Ok(())
    }

    fn compiler(&mut self, compiler: Node<'_>) -> Reading<()> {
        const FLAGS: [&str; 6] =
            ["autolimits", "usethread", "fitaabb", "alignfree", "saveinertial", "discardvisual"];
        for name in FLAGS {
            self.flag(compiler, name)?;
        }
        self.keyword(compiler, "angle", &["radian", "degree"])?;
        self.keyword(compiler, "coordinate", &["local", "global"])?;
        self.each_number(compiler, &["boundmass", "boundinertia", "settotalmass"])?;
        for (name, least) in [("boundmass", 0), ("boundinertia", 1)] {
            let value = compiler.value(name).and_then(|value| whole(strtod(value.trim())));
            self.settings.least[least] = value.unwrap_or(0.0);
        }
        self.settings.has_visuals = self.flag(compiler, "discardvisual")? == Some(false);
        self.settings.strips_paths = self.flag(compiler, "strippath")?;
        self.settings.balances = self.flag(compiler, "balanceinertia")?.unwrap_or(false);
        self.settings.fuses = self.flag(compiler, "fusestatic")?.unwrap_or(true);
        self.settings.mesh_folder = compiler.value("meshdir").unwrap_or_default().to_owned();
        let ignores = self.keyword(compiler, "inertiafromgeom", &["false", "true", "auto"])?;
        self.settings.ignores_inertials = ignores == Some("true");
        Ok(())
    }

    fn flag(&mut self, node: Node<'_>, name: &str) -> Reading<Option<bool>> {
        let known =
            if name == "autolimits" { &["false", "true", "auto"][..] } else { &["false", "true"] };
        Ok(self.keyword(node, name, known)?.map(|value| value == "true"))
    }

    fn keyword<'t>(
        &mut self,
        node: Node<'t>,
        name: &str,
        known: &[&str],
    ) -> Reading<Option<&'t str>> {
        match node.attribute(name) {
            Some(value) if !known.contains(&&*value.value) => {
                self.effects.refuse(value, Fault::value(name, &value.value))
            }
            value => Ok(value.map(|value| &*value.value)),
        }
    }

    /// Attributes that are numbers, whatever their count.
    fn each_number(&mut self, node: Node<'_>, names: &[&str]) -> Reading<()> {
        for value in names.iter().filter_map(|name| node.attribute(name)) {
            let mut words = value.value.split(is_space).filter(|word| !word.is_empty());
            if !words.all(|word| whole(strtod(word)).is_some()) {
                return self.effects.refuse(value, Fault::not_a_number(value));
            }
        }
        Ok(())
    }
}

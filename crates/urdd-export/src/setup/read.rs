//! Reads `NAME.export.toml`.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use toml::Spanned;

use super::{
    BANDWIDTH, Chosen, Curobo, EndEffector, Gains, Group, Guess, Members, Placed, Setup,
    SetupError, by_breadth, contains_itself, is_pattern, stands_for, within, wrong,
};
use crate::Structure;
use crate::error::unknown;
use urdd_directory::export_toml::{EndEffectorTable, File, GroupTable, JointGains, Name};
use urdd_directory::file_type::setup_beside;
use urdd_directory::limits::MAX_SETUP_BYTES;
use urdd_directory::position::LineIndex;
use urdd_directory::range::Range;
use urdd_directory::regular;
use urdd_robot::Robot;

impl Setup {
    /// The path of the file for a URDD: `NAME.export.toml` beside the folder `NAME` or the archive `NAME.zip`.
    #[must_use]
    pub fn path(urdd: &Path) -> PathBuf {
        setup_beside(urdd)
    }

    /// Reads a file, or without one that beside the URDD, if it is there.
    ///
    /// # Errors
    /// If there is one that cannot be read or is wrong: see [`Setup::from_toml`].
    pub fn find(
        file: Option<&Path>,
        urdd: &Path,
        robot: &Robot,
    ) -> Result<Option<Setup>, SetupError> {
        let beside = || Some(Setup::path(urdd)).filter(|file| file.symlink_metadata().is_ok());
        let file = file.map(Path::to_owned).or_else(beside);
        file.map(|file| Setup::read(&file, robot)).transpose()
    }

    /// Reads a file.
    ///
    /// # Errors
    /// If it cannot be read, is longer than 16 MiB, or is wrong: see [`Setup::from_toml`].
    pub fn read(file: &Path, robot: &Robot) -> Result<Setup, SetupError> {
        let shown = file.display().to_string();
        let unreadable = |reason: String| SetupError::Unreadable { file: shown.clone(), reason };
        let bytes =
            regular::read(file, MAX_SETUP_BYTES).map_err(|error| unreadable(error.to_string()))?;
        let text =
            String::from_utf8(bytes).map_err(|_| unreadable("it is not UTF-8".to_owned()))?;
        Setup::from_toml(&text, &shown, robot)
    }

    /// Reads the text of a file; `shown` is its name in messages.
    ///
    /// # Errors
    /// If it is not TOML, has an unknown key, is for another robot, or names something that there is not: what is
    /// wrong, where, and what to do.
    pub fn from_toml(text: &str, shown: &str, robot: &Robot) -> Result<Setup, SetupError> {
        let refused = |at: Option<usize>, reason: String| SetupError::Content {
            file: shown.to_owned(),
            at: at.map(|at| LineIndex::new(text).position(at)),
            reason,
        };
        let file: File = toml::from_str(text).map_err(|error| {
            let place = error.span().map(|span| span.start);
            refused(place, error.message().to_owned() + advice(error.message()))
        })?;
        let structure = Structure::new(robot)?;
        let configurations: Vec<String> = robot
            .named_configurations()?
            .iter()
            .map(|named| named.name.as_str().to_owned())
            .collect();
        let setup =
            SetupReader { structure: &structure, configurations: &configurations }.setup(file);
        setup.map_err(|(at, reason)| refused(Some(at), reason))
    }
}

struct SetupReader<'a> {
    structure: &'a Structure,
    configurations: &'a [String],
}

impl SetupReader<'_> {
    fn setup(&self, file: File) -> Placed<Setup> {
        let expected = &self.structure.view.name;
        if file.robot.get_ref() != expected {
            let [found, expected] =
                [file.robot.get_ref(), expected].map(|name| name.escape_debug());
            return wrong(
                &file.robot,
                format!(
                    "this file is for robot `{found}`, not for `{expected}`; `urdd export init` writes one"
                ),
            );
        }
        let groups = self.groups(&file.group)?;
        let names: Vec<&str> = groups.iter().map(|group| group.name.as_str()).collect();
        let mut ends = Vec::new();
        for end in &file.end_effector {
            ends.push(self.end_effector(end, &names, &ends)?);
        }
        let mut gains = Gains {
            bandwidth: ranged(BANDWIDTH, file.actuators.bandwidth.as_ref())?,
            joints: BTreeMap::new(),
        };
        let mut chosen = Chosen::default();
        for (name, of) in by_breadth(&file.actuators.joint) {
            let joints = self.matching(name)?;
            let own = joint_gains(of)?;
            for joint in joints {
                chosen.add(joint, name, own.clone())?;
            }
            if own.name.is_some_and(|name| chosen.is_given_twice(&name)) {
                return wrong(of, "another actuator has the same `name`: change one".to_owned());
            }
        }
        gains.joints = chosen.gains;
        let mut curobo = Curobo {
            ee_link: file.curobo.ee_link.as_ref().map(|link| self.link(link)).transpose()?,
            locked: BTreeMap::new(),
            retract: None,
        };
        for (name, position) in &file.curobo.locked {
            if !position.get_ref().is_finite() {
                return wrong(position, "`locked` is a position, rad or m".to_owned());
            }
            curobo.locked.insert(self.driven(name)?, *position.get_ref());
        }
        if let Some(name) = &file.curobo.retract {
            curobo.retract = Some(self.configuration(name)?);
        }
        let links = |names: &[Name]| -> Placed<Vec<usize>> {
            names.iter().map(|name| self.link(name)).collect()
        };
        // `urdd import` writes poses here, and the configurations into an SRDF, which not every URDD has taken in.
        let has_any = !self.configurations.is_empty();
        let known = |name: &Name| match has_any {
            true => self.configuration(name),
            false => Ok(name.get_ref().clone()),
        };
        let poses = file.base.poses.iter();
        let poses = poses.map(|(name, pose)| Ok((known(name)?, base_pose(pose)?)));
        Ok(Setup {
            of: self.structure.identity(),
            floating: Guess::read(file.base.floating),
            base_poses: poses.collect::<Placed<_>>()?,
            groups: groups.into_iter().map(Guess::read).collect(),
            end_effectors: ends.into_iter().map(Guess::read).collect(),
            tools: Guess::read(links(&file.frames.tools)?),
            imus: Guess::read(links(&file.frames.imus)?),
            gains,
            curobo,
            acceleration: number("acceleration", file.limits.acceleration.as_ref())?,
            jerk: number("jerk", file.limits.jerk.as_ref())?,
            friction: number("friction", file.contact.friction.as_ref())?,
        })
    }

    fn groups(&self, tables: &[Spanned<GroupTable>]) -> Placed<Vec<Group>> {
        let names: Vec<&str> =
            tables.iter().map(|table| table.get_ref().name.get_ref().as_str()).collect();
        let mut groups = Vec::new();
        for (place, table) in tables.iter().enumerate() {
            let name = &table.get_ref().name;
            if names[..place].contains(&name.get_ref().as_str()) {
                return twice("group", name);
            }
            groups.push(self.group(table, &names)?);
        }
        for (place, table) in tables.iter().enumerate() {
            let inner = |group: usize| match &groups[group].members {
                Members::Groups(others) => others.as_slice(),
                _ => &[],
            };
            if within(place, groups.len(), inner).is_none() {
                return wrong(table, contains_itself(names[place]));
            }
        }
        Ok(groups)
    }

    fn group(&self, table: &Spanned<GroupTable>, names: &[&str]) -> Placed<Group> {
        let (whole, table) = (table, table.get_ref());
        let members = match (&table.base, &table.tip, &table.joints, &table.groups) {
            (Some(base), Some(tip), None, None) => {
                let [from, to] = [self.link(base)?, self.link(tip)?];
                if !self.structure.is_chain(from, to) {
                    let [base, tip] = [base, tip].map(|name| name.get_ref().escape_debug());
                    return wrong(
                        whole,
                        format!(
                            "the link `{base}` is not an ancestor of `{tip}`, or no joint between them moves"
                        ),
                    );
                }
                Members::Chain { base: from, tip: to }
            }
            (None, None, Some(joints), None) if !joints.is_empty() => {
                let joints: Placed<Vec<usize>> =
                    joints.iter().map(|name| self.driven(name)).collect();
                Members::Joints(joints?)
            }
            (None, None, None, Some(groups)) if !groups.is_empty() => {
                let groups = groups.iter().map(|name| find(name, "group", names.iter().copied()));
                Members::Groups(groups.collect::<Placed<Vec<usize>>>()?)
            }
            _ => {
                let name = table.name.get_ref().escape_debug();
                return wrong(
                    whole,
                    format!(
                        "the group `{name}` needs `base` and `tip`, or `joints`, or `groups`, and only one of these"
                    ),
                );
            }
        };
        Ok(Group { name: table.name.get_ref().clone(), members, passive: table.passive })
    }

    fn end_effector(
        &self,
        table: &EndEffectorTable,
        groups: &[&str],
        before: &[EndEffector],
    ) -> Placed<EndEffector> {
        let name = table.name.get_ref();
        if before.iter().any(|other| other.name == *name) {
            return twice("end effector", &table.name);
        }
        let group = |name: &Name| find(name, "group", groups.iter().copied());
        Ok(EndEffector {
            name: name.clone(),
            group: group(&table.group)?,
            parent_group: table.parent_group.as_ref().map(group).transpose()?,
            parent_link: self.link(&table.parent_link)?,
        })
    }

    fn link(&self, name: &Name) -> Placed<usize> {
        let links = &self.structure.view.links;
        find(name, "link", links.iter().map(|link| link.name.as_str()))
    }

    fn configuration(&self, name: &Name) -> Placed<String> {
        let known = self.configurations.iter().map(String::as_str);
        find(name, "named configuration", known)?;
        Ok(name.get_ref().clone())
    }

    /// The joint of a name that something can drive, or all such joints that a pattern stands for.
    fn matching(&self, name: &Name) -> Placed<Vec<usize>> {
        let joints = &self.structure.view.joints;
        let is_name = joints.iter().any(|joint| joint.name == *name.get_ref());
        if is_name || !is_pattern(name.get_ref()) {
            return Ok(vec![self.driven(name)?]);
        }
        let fits = |at: &usize| stands_for(name.get_ref(), &joints[*at].name);
        let found: Vec<usize> =
            (0..joints.len()).filter(fits).filter(|at| self.structure.moves(*at)).collect();
        if found.is_empty() {
            let shown = name.get_ref().escape_debug();
            return wrong(name, format!("no joint that something drives is called as `{shown}`"));
        }
        Ok(found)
    }

    /// A joint that something can drive.
    fn driven(&self, name: &Name) -> Placed<usize> {
        let joints = &self.structure.view.joints;
        let joint = find(name, "joint", joints.iter().map(|joint| joint.name.as_str()))?;
        if !self.structure.moves(joint) {
            let name_shown = name.get_ref().escape_debug();
            return wrong(
                name,
                format!(
                    "the joint `{name_shown}` is fixed, or follows another joint: nothing drives it"
                ),
            );
        }
        Ok(joint)
    }
}

/// Where a free base is, with a quaternion of length 1.
fn base_pose(given: &Spanned<Vec<f64>>) -> Placed<[f64; 7]> {
    if let Ok([x, y, z, w, i, j, k]) = <[f64; 7]>::try_from(given.get_ref().as_slice()) {
        let length = w.hypot(i).hypot(j.hypot(k));
        let is_finite = [x, y, z, length].into_iter().all(f64::is_finite);
        if is_finite && length > 1e-6 {
            return Ok([x, y, z, w / length, i / length, j / length, k / length]);
        }
    }
    wrong(given, "a pose is 7 numbers: x, y, z in m, and a quaternion w, x, y, z".to_owned())
}

fn find<'n>(
    name: &Name,
    what: &'static str,
    known: impl Iterator<Item = &'n str> + Clone,
) -> Placed<usize> {
    let found = known.clone().position(|known| known == name.get_ref());
    found.map_or_else(|| wrong(name, unknown(what, name.get_ref(), known).to_string()), Ok)
}

fn twice<T>(what: &str, name: &Name) -> Placed<T> {
    let shown = name.get_ref().escape_debug();
    wrong(name, format!("another {what} is called `{shown}`: give it another name"))
}

/// What to write instead of gains in another place.
fn advice(message: &str) -> &'static str {
    let is_gain = |word: &&str| message.starts_with(&format!("unknown field `{word}`"));
    match ["kp", "kv", "armature"].iter().any(is_gain) {
        true => {
            "; gains are those of a joint: `[actuators.joint.NAME]`, or of all that a pattern stands for: `[actuators.joint.\"*_hip_*\"]`"
        }
        false => "",
    }
}

fn ranged(range: Range, value: Option<&Spanned<f64>>) -> Placed<Option<f64>> {
    let check = |value: &Spanned<f64>| {
        range.check(*value.get_ref()).or_else(|error| wrong(value, error.to_string()))
    };
    value.map(check).transpose()
}

/// A number above 0.
fn number(key: &str, value: Option<&Spanned<f64>>) -> Placed<Option<f64>> {
    match value {
        Some(value) if !(value.get_ref().is_finite() && *value.get_ref() > 0.0) => {
            wrong(value, format!("`{key}` is a number above 0"))
        }
        value => Ok(value.map(|value| *value.get_ref())),
    }
}

fn joint_gains(table: &Spanned<JointGains>) -> Placed<JointGains> {
    let gains = table.get_ref().clone();
    let each = [("kp", gains.kp), ("kv", gains.kv), ("armature", gains.armature)];
    let is_wrong =
        |value: Option<f64>| value.is_some_and(|value| !(value.is_finite() && value >= 0.0));
    if let Some((key, _)) = each.into_iter().find(|(_, value)| is_wrong(*value)) {
        return wrong(table, format!("`{key}` is a number that is not below 0"));
    }
    let rises = |ends: [f64; 2]| ends[0].is_finite() && ends[1].is_finite() && ends[0] < ends[1];
    let ranges = [("ctrlrange", gains.ctrlrange), ("forcerange", gains.forcerange)];
    if let Some((key, _)) = ranges.into_iter().find(|(_, of)| of.is_some_and(|of| !rises(of))) {
        return wrong(table, format!("`{key}` is two numbers, the first below the second"));
    }
    if gains.name.as_ref().is_some_and(String::is_empty) {
        return wrong(table, "`name` of an actuator must not be empty".to_owned());
    }
    Ok(gains)
}

//! What `urdd info` computes in sampled configurations: what holds the robot still, and which links touch unseen.

use std::fmt::{self, Write};
use std::path::Path;

use clap::Args;
use serde::Serialize;

use crate::cli::inputs;
use crate::cli::output::Failure;
use urdd_format::escape;
use urdd_format::readable::number;
use urdd_robot::{GravitySettings, Payload, Robot, RobotError, ShapeKind};

/// As the statistics of a URDD that `urdd generate` makes.
const SAMPLES: u32 = 1000;
/// A URDD may state any number.
const MAX_SAMPLES: u32 = 100_000;

/// What `urdd info --statics` is asked.
#[derive(Args)]
pub struct StaticsArguments {
    /// Also say what each joint must give to hold the robot still against gravity, and how much of its effort limit that is.
    #[arg(long)]
    statics: bool,

    /// A mass that the robot carries, kg.
    #[arg(long, value_name = "KG", requires_all = ["statics", "at"])]
    payload: Option<f64>,

    /// The link that carries the payload, at the origin of its frame.
    #[arg(long, value_name = "LINK", requires = "payload")]
    at: Option<String>,
}

#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Statics {
    /// m/s², in the root link's frame.
    pub gravity: [f64; 3],
    pub payload: Option<PayloadInfo>,
    /// The mass of all links, kg.
    pub mass: f64,
    /// The centre of mass of all links in the default configuration, m.
    pub centre_of_mass: Option<[f64; 3]>,
    pub num_samples: u32,
    pub dofs: Vec<DofStatics>,
}

#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct PayloadInfo {
    pub link: String,
    /// kg.
    pub mass: f64,
}

/// Torques in N m, forces in N: `unit`.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct DofStatics {
    pub name: String,
    pub unit: &'static str,
    /// In the default configuration.
    pub default: f64,
    /// The largest of the default and the sampled configurations.
    pub worst: f64,
    /// The effort limit; null if the source states none.
    pub limit: Option<f64>,
    /// The share of the limit that the default configuration needs; null without a limit above 0.
    pub default_share: Option<f64>,
    /// The share of the limit that the worst configuration needs.
    pub worst_share: Option<f64>,
}

impl Statics {
    /// That of the URDD at `path`; `None` if it was not asked for.
    ///
    /// # Errors
    /// If its masses or its kinematics cannot be read, or the payload cannot be carried.
    pub fn of(path: &Path, asked: &StaticsArguments) -> Result<Option<Statics>, Failure> {
        if !asked.statics {
            return Ok(None);
        }
        let robot = inputs::open(path)?;
        let payload = asked.at.clone().zip(asked.payload);
        let payload = payload.map(|(link, mass)| PayloadInfo { link, mass });
        let mut settings = GravitySettings::default();
        if let Some(PayloadInfo { link, mass }) = &payload {
            settings.payload =
                Some(Payload { link: robot.link(link)?, mass: *mass, point: [0.0; 3] });
        }
        let space = robot.configurations()?;
        let default = space.zero();
        let at_default = robot.gravity_torques(&default, &settings)?;
        let num_samples = robot.num_samples()?.unwrap_or(SAMPLES).min(MAX_SAMPLES);
        let mut worst = at_default.clone();
        for k in 0..num_samples {
            let found = robot.gravity_torques(&space.random(u64::from(k)), &settings)?;
            for (worst, found) in worst.iter_mut().zip(found) {
                if found.abs() > worst.abs() {
                    *worst = found;
                }
            }
        }
        // A legacy URDD has no limits.
        let limits = robot.effort_limits().unwrap_or_default();
        let (names, units) = (robot.dof_names()?.iter(), robot.dof_units()?);
        let dofs = names.enumerate().map(|(dof, name)| {
            let limit = limits.get(dof).copied().filter(|limit| limit.is_finite());
            let share = |torque: f64| Some(torque.abs() / limit.filter(|limit| *limit > 0.0)?);
            DofStatics {
                name: name.clone(),
                unit: if units.get(dof) == Some(&"m") { "N" } else { "N m" },
                default: at_default[dof],
                worst: worst[dof],
                limit,
                default_share: share(at_default[dof]),
                worst_share: share(worst[dof]),
            }
        });
        Ok(Some(Statics {
            gravity: settings.gravity,
            payload,
            mass: robot.link_masses()?.iter().map(|link| link.mass).sum(),
            centre_of_mass: robot.centre_of_mass(&default)?,
            num_samples,
            dofs: dofs.collect(),
        }))
    }

    pub fn write(&self, out: &mut impl Write) -> fmt::Result {
        const MARGIN: &str = "            ";
        let payload = self.payload.as_ref().map(|PayloadInfo { link, mass }| {
            format!(" and a payload of {} kg at {}", short(*mass), escape::line(link))
        });
        let (mass, payload) = (short(self.mass), payload.unwrap_or_default());
        writeln!(out, "  statics   what holds {mass} kg{payload} still")?;
        let [x, y, z] = self.gravity;
        writeln!(out, "{MARGIN}gravity: ({x}, {y}, {z}) m/s² in the root link's frame")?;
        if let Some([x, y, z]) = self.centre_of_mass.map(|centre| centre.map(short)) {
            writeln!(
                out,
                "{MARGIN}centre of mass: ({x}, {y}, {z}) m in the default configuration"
            )?;
        }
        let worst = format!("worst of {}", self.num_samples);
        let mut rows = vec![["DOF", "default", &worst, "limit", "used"].map(str::to_owned)];
        rows.extend(self.dofs.iter().map(|dof| {
            let torque = |value| format!("{} {}", short(value), dof.unit);
            let used = match dof.worst_share {
                Some(share) if share > 1.0 => format!("{}, too much", percent(share)),
                Some(share) => percent(share),
                None => String::new(),
            };
            let limit = dof.limit.map_or_else(|| "none".to_owned(), torque);
            let name = escape::line(&dof.name).into_owned();
            [name, torque(dof.default), torque(dof.worst), limit, used]
        }));
        let width = |column: usize| {
            let widths = rows.iter().map(|row| row[column].chars().count());
            widths.max().unwrap_or(0)
        };
        let [a, b, c, d] = [0, 1, 2, 3].map(width);
        for [name, default, worst, limit, used] in &rows {
            let line = format!("    {name:a$}  {default:>b$}  {worst:>c$}  {limit:>d$}  {used}");
            writeln!(out, "{}", line.trim_end())?;
        }
        Ok(())
    }
}

/// Three digits. What rounding leaves of 0 is 0.
fn short(value: f64) -> String {
    number(if value.abs() < 1e-9 { 0.0 } else { value }, 3)
}

fn percent(share: f64) -> String {
    format!("{:.0} %", 100.0 * share)
}

/// Maximum number of pairs in text for people.
const MOST_SHOWN: usize = 10;

/// Two links that are skipped because they touch in the default configuration, or in the reference configuration.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct SkippedContact {
    pub links: [String; 2],
    /// Number of the sampled configurations in which they touch.
    pub touching: usize,
    pub num_samples: u32,
}

impl SkippedContact {
    /// Those of the URDD at `path`, most contacts first. Null if the modules for it are missing or cannot be read.
    pub fn all(path: &Path) -> Option<Vec<SkippedContact>> {
        Self::of(&Robot::open(path).ok()?).ok()
    }

    fn of(robot: &Robot) -> Result<Vec<SkippedContact>, RobotError> {
        let Some(hidden) = robot.skipped_contacts(ShapeKind::Pieces)? else {
            return Ok(Vec::new());
        };
        let space = robot.configurations()?;
        let num_samples = robot.num_samples()?.unwrap_or(SAMPLES).min(SAMPLES);
        let values: Vec<f64> = (0..num_samples).flat_map(|k| space.random(u64::from(k))).collect();
        let name = |link: usize| hidden.body_name(link).unwrap_or_default().to_owned();
        let found = hidden.contacts_of_links(&values, |link| link)?.into_iter();
        // Links that touch in all samples are as those that always do.
        let found = found.filter(|(_, touching)| *touching < num_samples as usize);
        let mut found: Vec<SkippedContact> = found
            .map(|(links, touching)| SkippedContact {
                links: links.map(name),
                touching,
                num_samples,
            })
            .collect();
        found.sort_by_key(|one| std::cmp::Reverse(one.touching));
        Ok(found)
    }
}

pub fn write_skipped(found: &[SkippedContact], out: &mut impl Write) -> fmt::Result {
    let Some(SkippedContact { num_samples, .. }) = found.first() else {
        return Ok(());
    };
    let (pairs, touch) = if found.len() == 1 { ("pair", "touches") } else { ("pairs", "touch") };
    writeln!(
        out,
        "  skipped   {} {pairs} of links that {touch} at rest; other collisions count as free: of {num_samples} samples, in",
        found.len()
    )?;
    for SkippedContact { links: [a, b], touching, .. } in found.iter().take(MOST_SHOWN) {
        let share = 100.0 * *touching as f64 / f64::from(*num_samples);
        let [a, b] = [a, b].map(|name| escape::line(name));
        writeln!(out, "    {touching:>7} ({share:.1} %)  {a} - {b}")?;
    }
    match found.len().saturating_sub(MOST_SHOWN) {
        0 => Ok(()),
        more => writeln!(out, "            and {more} more"),
    }
}

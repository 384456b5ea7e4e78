//! Why rules are skipped, in words that several of them use.

use std::borrow::Cow;

use urdd_findings::part::SkipReason;
use urdd_format::registry::ModuleKind;

/// A reason whose words are known.
const fn left_out(why: &'static str) -> SkipReason {
    SkipReason::LeftOut(Cow::Borrowed(why))
}

/// The modules do not define the kinematics of every link.
pub const KINEMATICS_OPEN: SkipReason =
    SkipReason::Obstacle(Cow::Borrowed("the modules leave the kinematics open"));
/// It is about version 1, and this is a legacy URDD.
pub const NOT_VERSION_1: SkipReason = SkipReason::ForOthers(Cow::Borrowed("this is a legacy URDD"));
/// It is about legacy URDDs, and this is not one.
pub const NOT_LEGACY: SkipReason =
    SkipReason::ForOthers(Cow::Borrowed("this is not a legacy URDD"));
/// The root metadata is missing or unusable.
pub const NO_ROOT_METADATA: SkipReason = left_out("there is no usable urdd.json");
/// The edits of legacy skips are not recorded.
pub const EDITS_NOT_RECORDED: SkipReason = left_out("the edits of legacy skips are not recorded");
/// Planar and floating joints of legacy URDDs use other coordinates.
pub const LEGACY_COORDINATES: SkipReason =
    left_out("planar and floating joints of legacy URDDs have other coordinates (SPEC 5.11)");
/// There are no statistics to compare distances with.
pub const STATISTICS_UNUSABLE: SkipReason = left_out("there are no usable statistics");
/// The statistics do not state their number of samples.
pub const SAMPLES_UNKNOWN: SkipReason =
    left_out("the statistics do not say over how many samples they are");
/// The statistics state 0 samples.
pub const NO_SAMPLES: SkipReason = left_out("the statistics are over no samples");
/// There is no list of shapes.
pub const NO_SHAPES: SkipReason = left_out("there is no list of shapes");

/// The loops tie too many joints to each other at once.
pub const TOO_MANY_LOOPS: SkipReason =
    left_out("the loops depend on too many joints at once for this program to count what is free");

/// There are more closed samples than can be looked at.
pub const TOO_MANY_SAMPLES: SkipReason =
    left_out("there are more closed samples than this program looks at; the first were right");

/// None of the modules that a rule is about can be used.
pub fn none_usable(kinds: &[ModuleKind]) -> SkipReason {
    let names: Vec<&str> = kinds.iter().map(|kind| kind.name()).collect();
    SkipReason::Absent(format!("there is no usable {}", names.join(" or ")).into())
}

/// A module's version does not contain what the rule checks.
pub fn not_in_this_version(kind: ModuleKind) -> SkipReason {
    let why = format!("{} is of a version that does not say this", kind.name());
    SkipReason::LeftOut(why.into())
}

/// A complete check takes long and was not requested: these kinds of shapes were left out.
pub fn not_deep(kinds: &[&str]) -> SkipReason {
    let why = format!(
        "{} would take long to compute again; only the first configurations were checked. Use --deep to check all",
        kinds.join(", ")
    );
    SkipReason::LeftOut(why.into())
}

/// A computation takes more work than allowed; `--deep` allows more.
fn too_much_work(what: &str, deep: bool) -> SkipReason {
    let why = match deep {
        false => "a validation does; use --deep, which allows more",
        true => "even --deep allows",
    };
    SkipReason::LeftOut(format!("{what} takes more work than {why}").into())
}

/// Counting the configurations of SPEC 8.8 takes more work than allowed.
pub fn counting_takes_too_long(deep: bool) -> SkipReason {
    too_much_work("counting its collisions again", deep)
}

/// Judging spheres of links (SPEC 8.9) takes more work than allowed.
pub fn spheres_take_too_long(deep: bool) -> SkipReason {
    too_much_work("computing again what the spheres say", deep)
}

//! The ranges of options, for all languages.

use super::options::{Detail, MeshOptions, Options, SphereBudget, SphereOptions};
use urdd_directory::range::{OutOfRange, Range};

/// [`SphereBudget::PerLink`].
pub const SPHERES: Range = Range::whole("spheres", 1, 10_000);

/// [`SphereBudget::Total`].
pub const TOTAL_SPHERES: Range = Range::whole("total_spheres", 1, 65_535);

/// [`SphereOptions::samples`].
pub const SAMPLES: Range = Range::whole("samples", 100, 1_000_000);

/// [`MjcfOptions::bandwidth`](super::MjcfOptions::bandwidth), in an `export.toml` too.
pub const BANDWIDTH: Range = Range::real("bandwidth", 0.01, 1000.0, "Hz");

/// [`Detail`].
const VISUALS: Range =
    Range::above_zero("visuals", "(a part between 0 and 1, or a whole number of triangles)");

impl Detail {
    /// A part of all triangles, or a number of them.
    ///
    /// # Errors
    /// If it is neither.
    pub fn new(given: f64) -> Result<Detail, OutOfRange> {
        match VISUALS.check(given)? {
            ratio if ratio < 1.0 => Ok(Detail::Ratio(ratio)),
            count if count.fract() == 0.0 => Ok(Detail::Triangles(count as usize)),
            given => Err(OutOfRange { range: VISUALS, given }),
        }
    }

    fn check(self) -> Result<(), OutOfRange> {
        let (given, is_wrong) = match self {
            Detail::Full => return Ok(()),
            Detail::Ratio(ratio) => (ratio, !(ratio > 0.0 && ratio < 1.0)),
            Detail::Triangles(count) => (count as f64, count == 0),
        };
        if is_wrong { Err(OutOfRange { range: VISUALS, given }) } else { Ok(()) }
    }
}

impl MeshOptions {
    fn check(&self) -> Result<(), OutOfRange> {
        self.visuals.map_or(Ok(()), Detail::check)
    }
}

impl SphereOptions {
    fn check(&self) -> Result<(), OutOfRange> {
        match self.budget {
            SphereBudget::Auto => {}
            SphereBudget::PerLink(count) => _ = SPHERES.check(count as f64)?,
            SphereBudget::Total(count) => _ = TOTAL_SPHERES.check(count as f64)?,
        }
        SAMPLES.check(self.samples as f64).map(drop)
    }
}

impl Options {
    /// Checks that each option is in its range.
    pub(super) fn check(&self) -> Result<(), OutOfRange> {
        let bandwidth =
            |given: Option<f64>| given.map_or(Ok(()), |given| BANDWIDTH.check(given).map(drop));
        match self {
            Options::Srdf(_) => Ok(()),
            Options::Urdf(of) => of.meshes.check(),
            Options::Drake(of) => of.model.meshes.check(),
            Options::Mjcf(of) => bandwidth(of.bandwidth).and_then(|()| of.meshes.check()),
            Options::Curobo(of) => of.spheres.check(),
            Options::Foam(of) => of.check(),
            Options::Spherized(of) => of.spheres.check().and_then(|()| of.meshes.check()),
            Options::Moveit(of) => of.model.meshes.check(),
            Options::Sdf(of) => of.model.meshes.check(),
            Options::Usd(of) => bandwidth(of.bandwidth).and_then(|()| of.meshes.check()),
        }
    }
}

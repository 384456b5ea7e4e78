//! Terms of the format as command-line values.

use std::error::Error;
use std::str::FromStr;

use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
use urdd_export::Word;
use urdd_format::meshes::GeometryKind;
use urdd_format::report::Severity;
use urdd_format::root_metadata::ConformanceClass;

/// Declares values with the names of a type's, and what they say in `--help`.
macro_rules! words {
    ($($(#[$about:meta])* $word:ident for $term:ident { $($(#[$help:meta])* $variant:ident,)+ })+) => {$(
        $(#[$about])*
        #[derive(Debug, Clone, Copy, PartialEq, Eq, clap::ValueEnum)]
        pub enum $word {
            $($(#[$help])* $variant,)+
        }

        impl From<$word> for $term {
            fn from(word: $word) -> Self {
                match word {
                    $($word::$variant => $term::$variant,)+
                }
            }
        }
    )+};
}

words! {
    /// A conformance class.
    Class for ConformanceClass {
        /// The robot and its kinematics.
        Core,
        /// Core, and meshes.
        Geometry,
        /// Geometry, and boxes, spheres, distances and skips.
        Shapes,
    }

    /// A severity.
    Level for Severity {
        /// What programs refuse or get wrong, or what a URDD must not have.
        Error,
        /// What is wrong or risky for some programs, or what a URDD should not have.
        Warning,
        /// An outdated convention, or something worth knowing.
        Info,
    }

    /// The elements that geometry is taken from.
    Preferred for GeometryKind {
        /// The visual elements.
        Visual,
        /// The collision elements.
        Collision,
    }
}

/// Takes one of these words of the library, as what it stands for.
pub fn value_of<T>(words: &[Word]) -> impl TypedValueParser<Value = T>
where
    T: FromStr<Err: Error + Send + Sync> + Clone + Send + Sync + 'static,
{
    parser(words).try_map(|word| word.parse::<T>())
}

/// Takes one of these words of the library.
pub fn parser(words: &[Word]) -> PossibleValuesParser {
    let value = |(word, about): &Word| match about.trim().trim_end_matches('.') {
        "" => PossibleValue::new(*word),
        about => PossibleValue::new(*word).help(about),
    };
    words.iter().map(value).collect::<Vec<_>>().into()
}

//! Version-independent view of matrices over link shapes: distances, skips, reasons, error models.

use std::fmt::Debug;

use super::shapes::{KINDS, ShapeKind};
use urdd_format::index::LinkIdx;
use urdd_format::legacy::link_shapes_lie_alg_error_models::ErrorBounds;
use urdd_format::link_shapes_simple_skips::SkipReason;
use urdd_format::registry::{ModuleDocument, ModuleKind};
use urdd_format::shapes::PieceShape;

/// The modules with matrices over shapes.
pub const MATRIX_MODULES: &[ModuleKind] = &[
    ModuleKind::LinkShapesDistanceStatistics,
    ModuleKind::LinkShapesSimpleSkips,
    ModuleKind::LinkShapesSkips,
    ModuleKind::LinkShapesLieAlgErrorModels,
];

/// The modules of version 1 with matrices over shapes.
pub const V1_MATRIX_MODULES: &[ModuleKind] = &[
    ModuleKind::LinkShapesDistanceStatistics,
    ModuleKind::LinkShapesSimpleSkips,
    ModuleKind::LinkShapesSkips,
];

/// The rows of a matrix, or `None` for null.
pub type Rows<'a, T> = Option<&'a [Vec<T>]>;

/// An element of a matrix, if it exists.
pub fn at<T: Copy>(rows: &[Vec<T>], i: usize, j: usize) -> Option<T> {
    rows.get(i)?.get(j).copied()
}

/// Distance statistics of one kind of shape.
#[derive(Debug, Clone, Copy)]
pub struct Statistics<'a> {
    /// Keys of the mean, minimum and maximum distances.
    pub keys: [&'static str; 3],
    /// Mean distances.
    pub mean: &'a [Vec<f64>],
    /// Minimum distances.
    pub min: &'a [Vec<f64>],
    /// Maximum distances.
    pub max: &'a [Vec<f64>],
    /// Number of sampled configurations; `None` if not stated.
    pub num_samples: Option<u32>,
}

/// Keys of the mean, minimum and maximum distances in version 1.
const V1_KEYS: [&str; 3] = ["mean_distances", "min_distances", "max_distances"];
const LEGACY_KEYS: [&str; 3] = ["averages", "minimums", "maximums"];

/// The six statistics of `link_shapes_distance_statistics_module`, in the order of [`KINDS`].
pub fn statistics(document: &ModuleDocument) -> Option<[Option<Statistics<'_>>; 6]> {
    match document {
        ModuleDocument::LinkShapesDistanceStatistics(m) => {
            let six = [
                Some(&m.full_convex_hulls),
                Some(&m.full_obbs),
                Some(&m.full_bounding_spheres),
                m.decomposition_convex_hulls.as_ref(),
                m.decomposition_obbs.as_ref(),
                m.decomposition_bounding_spheres.as_ref(),
            ];
            Some(six.map(|one| {
                one.map(|one| Statistics {
                    keys: V1_KEYS,
                    mean: &one.mean_distances,
                    min: &one.min_distances,
                    max: &one.max_distances,
                    num_samples: Some(m.num_samples.0),
                })
            }))
        }
        ModuleDocument::LegacyLinkShapesDistanceStatistics(m) => {
            let six = [
                &m.full_convex_hulls,
                &m.full_obbs,
                &m.full_bounding_spheres,
                &m.decomposition_convex_hulls,
                &m.decomposition_obbs,
                &m.decomposition_bounding_spheres,
            ];
            Some(six.map(|one| {
                Some(Statistics {
                    keys: LEGACY_KEYS,
                    mean: &one.averages,
                    min: &one.minimums,
                    max: &one.maximums,
                    num_samples: None,
                })
            }))
        }
        _ => None,
    }
}

/// The six matrices of `link_shapes_simple_skips_module` or `link_shapes_skips_module`, in the order
/// of [`KINDS`].
pub fn skips(document: &ModuleDocument) -> Option<[Rows<'_, bool>; 6]> {
    match document {
        ModuleDocument::LinkShapesSimpleSkips(m) => Some([
            Some(&m.full_convex_hulls_simple_skips),
            Some(&m.full_obbs_simple_skips),
            Some(&m.full_bounding_spheres_simple_skips),
            m.decomposition_convex_hulls_simple_skips.as_deref(),
            m.decomposition_obbs_simple_skips.as_deref(),
            m.decomposition_bounding_spheres_simple_skips.as_deref(),
        ]),
        ModuleDocument::LegacyLinkShapesSimpleSkips(m) => Some([
            Some(&m.full_convex_hulls_simple_skips),
            Some(&m.full_obbs_simple_skips),
            Some(&m.full_bounding_spheres_simple_skips),
            Some(&m.decomposition_convex_hulls_simple_skips),
            Some(&m.decomposition_obbs_simple_skips),
            Some(&m.decomposition_bounding_spheres_simple_skips),
        ]),
        ModuleDocument::LinkShapesSkips(m) => Some([
            Some(&m.full_convex_hulls_skips),
            Some(&m.full_obbs_skips),
            Some(&m.full_bounding_spheres_skips),
            m.decomposition_convex_hulls_skips.as_deref(),
            m.decomposition_obbs_skips.as_deref(),
            m.decomposition_bounding_spheres_skips.as_deref(),
        ]),
        ModuleDocument::LegacyLinkShapesSkips(m) => Some([
            Some(&m.full_convex_hulls_skips),
            Some(&m.full_obbs_skips),
            Some(&m.full_bounding_spheres_skips),
            Some(&m.decomposition_convex_hulls_skips),
            Some(&m.decomposition_obbs_skips),
            Some(&m.decomposition_bounding_spheres_skips),
        ]),
        _ => None,
    }
}

/// Suffix after the name of a kind in the key of a skip matrix.
fn skips_suffix(document: &ModuleDocument) -> &'static str {
    match document {
        ModuleDocument::LinkShapesSkips(_) | ModuleDocument::LegacyLinkShapesSkips(_) => "_skips",
        _ => "_simple_skips",
    }
}

/// JSON Pointer to a skip matrix.
pub fn skips_pointer(document: &ModuleDocument, kind: ShapeKind) -> String {
    format!("/{}{}", kind.name, skips_suffix(document))
}

/// The six matrices of reasons of `link_shapes_simple_skips_module` of version 1.
pub fn reasons(document: &ModuleDocument) -> Option<[Rows<'_, SkipReason>; 6]> {
    match document {
        ModuleDocument::LinkShapesSimpleSkips(m) => Some([
            Some(&m.reasons.full_convex_hulls),
            Some(&m.reasons.full_obbs),
            Some(&m.reasons.full_bounding_spheres),
            m.reasons.decomposition_convex_hulls.as_deref(),
            m.reasons.decomposition_obbs.as_deref(),
            m.reasons.decomposition_bounding_spheres.as_deref(),
        ]),
        _ => None,
    }
}

/// Suffix after the name of a kind in the key of a model matrix, and the matrices of the six kinds.
type Models<'a> = (&'static str, [&'a [Vec<ErrorBounds>]; 6]);

/// The twelve matrices of `link_shapes_lie_alg_error_models_module`: the standard models, then the
/// pseudo models.
fn models(document: &ModuleDocument) -> Option<[Models<'_>; 2]> {
    let ModuleDocument::LegacyLinkShapesLieAlgErrorModels(m) = document else {
        return None;
    };
    Some([
        (
            "_standard_models",
            [
                &m.full_convex_hulls_standard_models,
                &m.full_obbs_standard_models,
                &m.full_bounding_spheres_standard_models,
                &m.decomposition_convex_hulls_standard_models,
                &m.decomposition_obbs_standard_models,
                &m.decomposition_bounding_spheres_standard_models,
            ],
        ),
        (
            "_pseudo_models",
            [
                &m.full_convex_hulls_pseudo_models,
                &m.full_obbs_pseudo_models,
                &m.full_bounding_spheres_pseudo_models,
                &m.decomposition_convex_hulls_pseudo_models,
                &m.decomposition_obbs_pseudo_models,
                &m.decomposition_bounding_spheres_pseudo_models,
            ],
        ),
    ])
}

/// `full_shapes` and `decomposition_shapes` of a module of version 1.
pub fn shape_lists(document: &ModuleDocument) -> Option<(&[LinkIdx], &[PieceShape])> {
    match document {
        ModuleDocument::LinkShapesDistanceStatistics(m) => {
            Some((&m.full_shapes, &m.decomposition_shapes))
        }
        ModuleDocument::LinkShapesSimpleSkips(m) => Some((&m.full_shapes, &m.decomposition_shapes)),
        ModuleDocument::LinkShapesSkips(m) => Some((&m.full_shapes, &m.decomposition_shapes)),
        _ => None,
    }
}

/// The elements of a matrix.
#[derive(Debug, Clone, Copy)]
pub enum Elements<'a> {
    /// Distances, m.
    Distances(&'a [Vec<f64>]),
    /// Skips.
    Skips(&'a [Vec<bool>]),
    /// Reasons of skips.
    Reasons(&'a [Vec<SkipReason>]),
    /// Error models.
    Models(&'a [Vec<ErrorBounds>]),
}

impl Elements<'_> {
    /// Number of rows.
    pub fn rows(&self) -> usize {
        match self {
            Elements::Distances(rows) => rows.len(),
            Elements::Skips(rows) => rows.len(),
            Elements::Reasons(rows) => rows.len(),
            Elements::Models(rows) => rows.len(),
        }
    }

    /// Number of elements of each row.
    pub fn row_lengths(&self) -> Vec<usize> {
        fn lengths<T>(rows: &[Vec<T>]) -> Vec<usize> {
            rows.iter().map(Vec::len).collect()
        }
        match self {
            Elements::Distances(rows) => lengths(rows),
            Elements::Skips(rows) => lengths(rows),
            Elements::Reasons(rows) => lengths(rows),
            Elements::Models(rows) => lengths(rows),
        }
    }

    /// An element as text.
    pub fn text(&self, i: usize, j: usize) -> String {
        fn shown<T: Copy + Debug>(rows: &[Vec<T>], i: usize, j: usize) -> String {
            at(rows, i, j).map_or_else(String::new, |element| format!("{element:?}"))
        }
        match self {
            Elements::Distances(rows) => shown(rows, i, j),
            Elements::Skips(rows) => shown(rows, i, j),
            Elements::Reasons(rows) => shown(rows, i, j),
            Elements::Models(rows) => shown(rows, i, j),
        }
    }
}

/// A matrix over shapes.
#[derive(Debug, Clone)]
pub struct Matrix<'a> {
    /// The kind of shape that its indices refer to.
    pub kind: ShapeKind,
    /// JSON Pointer in the document.
    pub pointer: String,
    /// Its elements; `None` if the document has null.
    pub elements: Option<Elements<'a>>,
}

/// Every matrix of a module, kind by kind.
pub fn matrices(document: &ModuleDocument) -> Vec<Matrix<'_>> {
    let mut matrices = Vec::new();
    let mut add = |kind: ShapeKind, pointer, elements| {
        matrices.push(Matrix {
            kind,
            pointer,
            elements,
        });
    };
    for (kind, one) in KINDS
        .into_iter()
        .zip(statistics(document).into_iter().flatten())
    {
        match one {
            None => add(kind, format!("/{}", kind.name), None),
            Some(one) => {
                for (key, rows) in one.keys.into_iter().zip([one.mean, one.min, one.max]) {
                    let pointer = format!("/{}/{key}", kind.name);
                    add(kind, pointer, Some(Elements::Distances(rows)));
                }
            }
        }
    }
    for (kind, rows) in KINDS.into_iter().zip(skips(document).into_iter().flatten()) {
        add(
            kind,
            skips_pointer(document, kind),
            rows.map(Elements::Skips),
        );
    }
    for (kind, rows) in KINDS
        .into_iter()
        .zip(reasons(document).into_iter().flatten())
    {
        let pointer = format!("/reasons/{}", kind.name);
        add(kind, pointer, rows.map(Elements::Reasons));
    }
    for (suffix, six) in models(document).into_iter().flatten() {
        for (kind, rows) in KINDS.into_iter().zip(six) {
            let pointer = format!("/{}{suffix}", kind.name);
            add(kind, pointer, Some(Elements::Models(rows)));
        }
    }
    matrices
}

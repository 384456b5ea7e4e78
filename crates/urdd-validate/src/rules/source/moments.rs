//! Principal moments of inertia.

use nalgebra::Matrix3;

use urdd_format::readable::number;

/// The principal moments of a tensor (xx, xy, xz, yy, yz, zz), ascending.
pub fn principal([xx, xy, xz, yy, yz, zz]: [f64; 6]) -> [f64; 3] {
    // Scaled to 1 first: squaring numbers near the ends of binary64 would overflow or underflow.
    let scale = [xx, xy, xz, yy, yz, zz]
        .into_iter()
        .fold(0.0, |largest: f64, element| largest.max(element.abs()));
    if scale == 0.0 || !scale.is_finite() {
        return [0.0; 3];
    }
    let tensor = Matrix3::new(xx, xy, xz, xy, yy, yz, xz, yz, zz).map(|element| element / scale);
    let mut moments: [f64; 3] = tensor.symmetric_eigenvalues().into();
    moments.sort_by(f64::total_cmp);
    moments.map(|moment| moment * scale)
}

/// Moments for messages; those within rounding of 0 are shown as 0.
pub(super) fn show(moments: [f64; 3]) -> String {
    let largest = moments.into_iter().fold(0.0, |a: f64, b| a.max(b.abs()));
    let shown = moments.map(|moment| match moment.abs() > 1e-14 * largest {
        true => number(moment, 5),
        false => "0".to_owned(),
    });
    format!("principal moments {} kg m²", shown.join(", "))
}

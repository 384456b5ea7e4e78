//! Principal moments of inertia.

use nalgebra::Matrix3;

use urdd_format::readable::number;

/// The principal moments of a tensor (xx, xy, xz, yy, yz, zz), ascending.
pub(super) fn principal([xx, xy, xz, yy, yz, zz]: [f64; 6]) -> [f64; 3] {
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn agrees_with_numpy() {
        // numpy.linalg.eigvalsh([[4, -.5, .3], [-.5, 5, .2], [.3, .2, 6]])
        let expected = [3.737_516_65, 5.201_588_51, 6.060_894_84];
        for (moment, expected) in principal([4.0, -0.5, 0.3, 5.0, 0.2, 6.0]).iter().zip(expected) {
            assert!((moment - expected).abs() < 1e-8, "{moment} {expected}");
        }
    }

    #[test]
    fn comes_to_an_end_whatever_the_size() {
        for size in [1e-310, 1e-200, 1e200, f64::MAX] {
            let moments = principal([size, size, -size, 0.0, size, -size]);
            assert!(moments[0] <= moments[1] && moments[1] <= moments[2]);
        }
        assert_eq!(principal([0.0; 6]), [0.0; 3]);
    }
}

//! Systems of equations with a symmetric, positive definite matrix.

/// Solves such a system in place: `right` becomes the solution, and the lower triangle of `matrix`, row by row, its factor.
/// `added` is added to the diagonal first. False where the matrix is not positive definite; both are then any.
pub(crate) fn solve(matrix: &mut [f64], added: f64, right: &mut [f64]) -> bool {
    let n = right.len();
    for i in 0..n {
        for j in 0..=i {
            let (head, row) = matrix.split_at(i * n);
            let of_j = if i == j { &row[..j] } else { &head[j * n..j * n + j] };
            let dot: f64 = row[..j].iter().zip(of_j).map(|(a, b)| a * b).sum();
            let value = row[j] - dot;
            if i == j {
                let value = value + added;
                if value.is_nan() || value <= 0.0 {
                    return false;
                }
                matrix[i * n + i] = value.sqrt();
            } else {
                matrix[i * n + j] = value / matrix[j * n + j];
            }
        }
    }
    for i in 0..n {
        let dot: f64 = (0..i).map(|j| matrix[i * n + j] * right[j]).sum();
        right[i] = (right[i] - dot) / matrix[i * n + i];
    }
    for i in (0..n).rev() {
        let dot: f64 = (i + 1..n).map(|j| matrix[j * n + i] * right[j]).sum();
        right[i] = (right[i] - dot) / matrix[i * n + i];
    }
    true
}

//! Small systems of linear equations.

/// Cholesky's method on the lower half. `None` if the matrix is not positive definite.
pub(crate) fn solve<const N: usize>(mut m: [[f64; N]; N], mut right: [f64; N]) -> Option<[f64; N]> {
    for i in 0..N {
        for j in 0..=i {
            let mut sum = m[i][j];
            for k in 0..j {
                sum -= m[i][k] * m[j][k];
            }
            if i == j {
                if sum <= 0.0 {
                    return None;
                }
                m[i][i] = sum.sqrt();
            } else {
                m[i][j] = sum / m[j][j];
            }
        }
    }
    for i in 0..N {
        for k in 0..i {
            right[i] -= m[i][k] * right[k];
        }
        right[i] /= m[i][i];
    }
    for i in (0..N).rev() {
        for k in i + 1..N {
            right[i] -= m[k][i] * right[k];
        }
        right[i] /= m[i][i];
    }
    Some(right)
}

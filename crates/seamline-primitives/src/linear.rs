//! Small systems of linear equations.

/// Cholesky's method on the lower half. `None` if the matrix is not positive definite.
pub(crate) fn solve<const N: usize>(mut m: [[f64; N]; N], mut right: [f64; N]) -> Option<[f64; N]> {
    // One over each number on the diagonal of the root.
    let mut over = [0.0; N];
    for i in 0..N {
        for j in 0..=i {
            let mut sum = m[i][j];
            for k in 0..j {
                sum -= m[i][k] * m[j][k];
            }
            if i > j {
                m[i][j] = sum * over[j];
            } else if sum > 0.0 {
                over[i] = 1.0 / sum.sqrt();
            } else {
                return None;
            }
        }
    }
    for i in 0..N {
        for k in 0..i {
            right[i] -= m[i][k] * right[k];
        }
        right[i] *= over[i];
    }
    for i in (0..N).rev() {
        for k in i + 1..N {
            right[i] -= m[k][i] * right[k];
        }
        right[i] *= over[i];
    }
    Some(right)
}

//! The operations inside `<transform>`.

use etendue_math::glam::{DMat4, DVec3};

use crate::geometry::{Transform, TransformError};

/// Rotation about an axis of any length, anticlockwise when seen against it.
///
/// # Errors
/// An axis without direction.
pub(crate) fn rotate(axis: DVec3, degrees: f64) -> Result<DMat4, TransformError> {
    Ok(DMat4::from(*Transform::rotate(axis, degrees)?.affine()))
}

/// The transform that takes the z axis to the line of sight and the y axis upwards; a zero `up`
/// means any.
///
/// # Errors
/// Target and origin that coincide, `up` along the line of sight.
pub(crate) fn look_at(origin: DVec3, target: DVec3, up: DVec3) -> Result<DMat4, TransformError> {
    let up = match (target - origin).try_normalize() {
        Some(direction) if up == DVec3::ZERO => direction.any_orthonormal_vector(),
        _ => up,
    };
    Ok(DMat4::from(*Transform::look_at(origin, target, up)?.affine()))
}

/// A matrix written row by row, of 9 or 16 numbers; `None` for any other count.
pub(crate) fn matrix(rows: &[f64]) -> Option<DMat4> {
    let size = match rows.len() {
        9 => 3,
        16 => 4,
        _ => return None,
    };
    let mut columns = DMat4::IDENTITY.to_cols_array_2d();
    for (i, &value) in rows.iter().enumerate() {
        columns[i % size][i / size] = value;
    }
    Some(DMat4::from_cols_array_2d(&columns))
}

#[cfg(test)]
mod tests {
    use super::*;
    use etendue_math::glam::DVec4;

    #[test]
    fn rotation_about_an_oblique_axis_agrees_with_mitsuba() {
        // mi.ScalarTransform4d().rotate([1, 2, 3] / sqrt(14), 40).matrix
        let expected = [
            [0.782755554325, -0.481954422141, 0.393717763319],
            [0.548798866964, 0.832888887942, -0.071525547616],
            [-0.293451096084, 0.272058882085, 0.916444443971],
        ];
        let rotation = rotate(DVec3::new(1.0, 2.0, 3.0), 40.0).unwrap();
        for (i, row) in expected.iter().enumerate() {
            for (j, value) in row.iter().enumerate() {
                // Mitsuba's axis and angle were single precision.
                assert!((rotation.col(j)[i] - value).abs() < 2e-7);
            }
        }
    }

    #[test]
    fn an_oblique_line_of_sight_agrees_with_mitsuba() {
        // mi.ScalarTransform4d().look_at([1, 2, 3], [-1, 0.5, 2], [0.1, 0.2, 1]).matrix
        let expected = [
            [0.561383572214, -0.364862093012, -0.742781352708, 1.0],
            [-0.820483682466, -0.128303153587, -0.557086014531, 2.0],
            [0.107958379272, 0.922178916405, -0.371390676354, 3.0],
        ];
        let [origin, target] = [DVec3::new(1.0, 2.0, 3.0), DVec3::new(-1.0, 0.5, 2.0)];
        let m = look_at(origin, target, DVec3::new(0.1, 0.2, 1.0)).unwrap();
        for (i, row) in expected.iter().enumerate() {
            for (j, value) in row.iter().enumerate() {
                // Mitsuba's vectors were single precision.
                assert!((m.col(j)[i] - value).abs() < 2e-7);
            }
        }
    }

    #[test]
    fn a_zero_up_vector_means_any() {
        let any = look_at(DVec3::ZERO, DVec3::Z, DVec3::ZERO).unwrap();
        // A rotation: unit determinant up to a few roundings.
        assert!((any.determinant() - 1.0).abs() < 1e-14);
        assert_eq!(look_at(DVec3::X, DVec3::X, DVec3::ZERO), Err(TransformError::TargetAtOrigin));
    }

    #[test]
    fn matrices_are_written_row_by_row() {
        let m = matrix(&[1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0]).unwrap();
        assert_eq!(m.row(0), DVec4::new(1.0, 2.0, 3.0, 0.0));
        assert_eq!(m.row(3), DVec4::W);
        assert_eq!(matrix(&[1.0; 12]), None);
    }
}

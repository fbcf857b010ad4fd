//! Random numbers: the order of rays must not be what the processor's caches like.

use etendue_math::glam::Vec3;

/// A linear congruential generator, of which the upper bits are used.
pub struct Random(pub u64);

impl Random {
    /// In [0, 1).
    pub fn uniform(&mut self) -> f32 {
        self.0 = self.0.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (self.0 >> 40) as f32 / 16777216.0
    }

    /// Below `n`.
    pub fn below(&mut self, n: usize) -> usize {
        ((f64::from(self.uniform()) * n as f64) as usize).min(n - 1)
    }

    /// A point in the unit ball.
    pub fn in_ball(&mut self) -> Vec3 {
        loop {
            let v = Vec3::from_array(std::array::from_fn(|_| 2.0 * self.uniform() - 1.0));
            if v.length_squared() < 1.0 {
                return v;
            }
        }
    }

    /// A direction.
    pub fn direction(&mut self) -> Vec3 {
        loop {
            let v = self.in_ball();
            if v.length_squared() > 1e-6 {
                return v.normalize();
            }
        }
    }

    /// A direction about a normal, by the cosine.
    pub fn about(&mut self, normal: Vec3) -> Vec3 {
        loop {
            let v = self.direction() + normal;
            if v.length_squared() > 1e-6 {
                return v.normalize();
            }
        }
    }
}

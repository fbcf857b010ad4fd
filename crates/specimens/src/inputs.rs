//! Inputs addressed by their index.

use etendue_math::{Real, Vec3, Vector3, mix_u64};

/// What a model or function is called with.
#[derive(Clone, Copy, Debug)]
pub struct Inputs<T: Real> {
    /// Which inputs these are.
    pub index: u64,
    /// Unit vector, above the surface seven times out of eight, scaled towards the horizon once.
    pub wo: Vec3<T>,
    /// Another one.
    pub wi: Vec3<T>,
    /// Uniforms in `[0, 1)`.
    pub u: [T; 3],
}

impl<T: Real> Inputs<T> {
    /// Inputs number `index`: made of integer operations, products, sums, quotients and square roots
    /// alone, hence of the same bits on every IEEE 754 target.
    pub fn new(index: u64) -> Self {
        let mut address = 0;
        let mut next = || {
            address += 1;
            mix_u64(index, address)
        };
        let (wo, wi) = (direction::<T>(&mut next), direction::<T>(&mut next));
        Self { index, wo, wi, u: [(); 3].map(|()| T::from_random_bits(next())) }
    }

    /// The same with both directions above the surface.
    pub fn above(index: u64) -> Self {
        let inputs = Self::new(index);
        let up = |w: Vec3<T>| Vec3::<T>::new(w.x(), w.y(), w.z().abs());
        Self { wo: up(inputs.wo), wi: up(inputs.wi), ..inputs }
    }
}

/// The direction of a random point of a cube, the upper half of it preferred.
fn direction<T: Real>(next: &mut impl FnMut() -> u64) -> Vec3<T> {
    let choice = next();
    let mut coordinate = || T::TWO * T::from_random_bits(next()) - T::ONE;
    let (x, y, z) = (coordinate(), coordinate(), coordinate());
    let z = match choice % 8 {
        0 => z * T::lit(1.0 / (1_u64 << (choice >> 59)) as f64),
        1 => z,
        _ => z.abs(),
    };
    let up = Vec3::<T>::new(T::ZERO, T::ZERO, T::ONE);
    Vec3::<T>::new(x, y, z).try_normalize().unwrap_or(up)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn directions_are_of_unit_length_and_of_every_kind() {
        let inputs = || (0..10_000).map(Inputs::<f64>::new);
        assert!(inputs().all(|i| (i.wo.length() - 1.0).abs() < 1e-15));
        // One in eight is scaled towards the horizon; one in eight and half of those lie below.
        let share = |test: fn(&Inputs<f64>) -> bool| inputs().filter(test).count() as f64 / 1e4;
        assert!((share(|i| i.wo.z < 0.0) - 0.125).abs() < 0.02);
        assert!((share(|i| i.wo.z.abs() < 1e-3) - 0.09).abs() < 0.03);
        assert!((share(|i| i.u[2] < 0.5) - 0.5).abs() < 0.02);
    }
}

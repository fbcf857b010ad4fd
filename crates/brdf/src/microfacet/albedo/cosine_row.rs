//! A function of the angle, tabulated.

use etendue_math::Real;

/// A function of `cos θ = μ` in `[0, 1]`, linear in √μ between nodes `μⱼ = (j/31)²`.
///
/// Albedos of interfaces and fuzz are steep at grazing angles: as functions of √μ they are not.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct CosineRow<T>(pub(crate) [T; NODES]);

/// Number of nodes.
const NODES: usize = 32;

/// Where a cosine lies among the nodes of every [`CosineRow`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Place<T> {
    node: usize,
    /// Share of the next node.
    rest: T,
}

impl<T: Real> Place<T> {
    /// The place of a cosine, which is limited to `[0, 1]`.
    #[inline(always)]
    pub(crate) fn of(mu: T) -> Self {
        let x = mu.clamp_to(T::ZERO, T::ONE).sqrt() * T::lit((NODES - 1) as f64);
        let node = (x.to_f64() as usize).min(NODES - 2);
        Self { node, rest: x - T::lit(node as f64) }
    }
}

impl<T: Real> CosineRow<T> {
    /// Number of nodes.
    pub(crate) const NODES: usize = NODES;

    /// The row of a function of μ.
    #[inline]
    pub(crate) fn of(f: impl Fn(T) -> T) -> Self {
        Self(core::array::from_fn(|j| f(Self::node(j))))
    }

    /// `μⱼ`
    #[inline]
    pub(crate) fn node(j: usize) -> T {
        T::lit(j as f64 / (NODES - 1) as f64).sqr()
    }

    /// The value at a place.
    #[inline(always)]
    pub(crate) fn at(&self, place: Place<T>) -> T {
        let [low, high] = [self.0[place.node], self.0[place.node + 1]];
        low * (T::ONE - place.rest) + high * place.rest
    }

    /// What passes where a layer that lets this through covers a share `weight` of the surface: `1 − w + w f`.
    #[inline]
    pub(crate) fn covering(&self, weight: T) -> Self {
        Self(self.0.map(|f| (T::ONE - weight) + weight * f))
    }

    /// The row of the product.
    #[inline]
    pub(crate) fn times(&self, other: &Self) -> Self {
        Self(core::array::from_fn(|j| self.0[j] * other.0[j]))
    }

    /// `2 ∫₀¹ f(μ) μ dμ` of the interpolated row: each node's hat function has its weight in closed form.
    pub(crate) fn average(&self) -> T {
        let last = (NODES - 1) as f64;
        let mut sum = T::ZERO;
        for (j, &value) in self.0.iter().enumerate() {
            // ∫ 4 x³ (1 − |31 x − j|) dx over the hat: (20 j³ + 10 j)/(5 · 31⁴), half a hat at the ends.
            let j = j as f64;
            let weight = if j == 0.0 {
                0.2
            } else if j == last {
                2.0 * j * j * j - 2.0 * j * j + j - 0.2
            } else {
                4.0 * j * j * j + 2.0 * j
            };
            sum += T::lit(weight / (last * last * last * last)) * value;
        }
        sum
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_average_of_a_constant_is_the_constant() {
        // 32 roundings of weights that sum to 1.
        assert!((CosineRow::of(|_| 1.0_f64).average() - 1.0).abs() < 1e-14);
    }

    #[test]
    fn a_function_linear_in_the_root_is_reproduced_with_its_average() {
        let row = CosineRow::of(|mu: f64| 0.3 + 0.5 * Real::sqrt(mu));
        for mu in [0.0, 1e-9, 0.01, 0.37, 0.999, 1.0] {
            // Two roundings of a place among 31.
            assert!((row.at(Place::of(mu)) - (0.3 + 0.5 * Real::sqrt(mu))).abs() < 1e-14, "{mu}");
        }
        // 2 ∫ √μ μ dμ = 4/5.
        assert!((row.average() - 0.7).abs() < 1e-14);
    }
}

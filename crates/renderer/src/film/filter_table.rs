//! One axis of a reconstruction filter, tabulated for sampling.

use etendue_scene::film::ReconstructionFilter;

/// Cells over the support of the filter. The filter is replaced by a staircase of this many steps
/// of its exact cell means, which moves no mass further than radius/128.
const CELLS: usize = 256;

/// The cumulated filter `∫|k|` and `∫k` along one axis, and where `∫|k|` reaches given shares.
///
/// Reconstruction filters are products `k(x) k(y)`, so one table serves both axes.
#[derive(Clone, Debug)]
pub(super) struct FilterTable {
    radius: f32,
    /// `∫_{−r}^{x} |k|` at the cell borders; the last entry is 1.
    absolute: Vec<f32>,
    /// `∫_{−r}^{x} k` at the cell borders, in the same unit.
    signed: Vec<f32>,
    /// For each of `CELLS` equal shares of [0, 1): the cell in which it begins.
    guide: Vec<u16>,
}

/// The part of the axis that one pixel may sample.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Span {
    /// Cumulated share at which the part begins.
    begin: f32,
    /// Share of the part.
    length: f32,
    /// `∫|k| / ∫k` over the part: the weight of a sample where k is positive.
    pub(super) normalisation: f32,
}

/// An offset from the pixel's centre and the sign of the filter there.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Offset {
    /// Distance from the pixel's centre, in pixels.
    pub(super) x: f32,
    /// 1 or −1.
    pub(super) sign: f32,
}

impl FilterTable {
    /// Tabulates `filter`; `None` where it has no positive integral and so cannot be normalised.
    pub(super) fn new(filter: &ReconstructionFilter) -> Option<Self> {
        let radius = filter.radius();
        let width = 2.0 * f64::from(radius) / CELLS as f64;
        let (mut absolute, mut signed) = (vec![0.0_f64], vec![0.0_f64]);
        let (mut sum, mut signed_sum) = (0.0, 0.0);
        for cell in 0..CELLS {
            // Four midpoints per cell: the filters are smooth but for a few corners.
            let mean = (0..4)
                .map(|i| {
                    let x = (cell as f64 + (f64::from(i) + 0.5) / 4.0) * width - f64::from(radius);
                    f64::from(filter.eval(x as f32)) / 4.0
                })
                .sum::<f64>();
            sum += mean.abs();
            signed_sum += mean;
            absolute.push(sum);
            signed.push(signed_sum);
        }
        if !(signed_sum > 0.0 && sum.is_finite() && radius > 0.0) {
            return None;
        }
        let scaled = |table: Vec<f64>| table.into_iter().map(|x| (x / sum) as f32).collect();
        let absolute: Vec<f32> = scaled(absolute);
        let guide = (0..CELLS)
            .map(|i| {
                let share = i as f32 / CELLS as f32;
                (absolute.partition_point(|&c| c <= share) - 1).min(CELLS - 1) as u16
            })
            .collect();
        Some(Self { radius, absolute, signed: scaled(signed), guide })
    }

    /// The filter's radius in pixels.
    pub(super) fn radius(&self) -> f32 {
        self.radius
    }

    /// The part of the filter between two offsets from its centre; the whole one where the filter
    /// integrates to nothing positive there.
    pub(super) fn span(&self, low: f32, high: f32) -> Span {
        let at = |table: &[f32], x: f32| {
            let position = ((x + self.radius) / (2.0 * self.radius)).clamp(0.0, 1.0) * CELLS as f32;
            let cell = (position as usize).min(CELLS - 1);
            table[cell] + (table[cell + 1] - table[cell]) * (position - cell as f32)
        };
        let begin = at(&self.absolute, low);
        let length = at(&self.absolute, high) - begin;
        let signed = at(&self.signed, high) - at(&self.signed, low);
        if signed > 0.0 {
            Span { begin, length, normalisation: length / signed }
        } else {
            let whole = self.signed[CELLS];
            Span { begin: 0.0, length: 1.0, normalisation: 1.0 / whole }
        }
    }

    /// Inverts the cumulated |k|, linear within a cell.
    #[inline]
    pub(super) fn sample(&self, span: Span, u: f32) -> Offset {
        let share = span.begin + u * span.length;
        let guided = ((share * CELLS as f32) as usize).min(CELLS - 1);
        let mut cell = self.guide[guided] as usize;
        while cell + 1 < CELLS && self.absolute[cell + 1] <= share {
            cell += 1;
        }
        let mass = self.absolute[cell + 1] - self.absolute[cell];
        let within = if mass > 0.0 { (share - self.absolute[cell]) / mass } else { 0.5 };
        let x = (cell as f32 + within.clamp(0.0, 1.0)) / CELLS as f32 * 2.0 - 1.0;
        let sign = if self.signed[cell + 1] < self.signed[cell] { -1.0 } else { 1.0 };
        Offset { x: x * self.radius, sign }
    }
}

//! One strategy on one model: what is run for its noise and for its time.

use core::hint::black_box;

use etendue_brdf::Bsdf;
use etendue_math::{Real, Vec3, Vector3};

use super::lighting::{Lighting, Lights};
use super::points::PointSet;
use super::strategy::{Draw, Strategy, Uniforms};
use super::variance::{Spread, Variance};

/// Cosines of the directions of view.
pub const VIEW_COSINES: [f64; 4] = [1.0, 0.7, 0.3, 0.05];
/// Azimuth of all of them in degrees: in no plane of symmetry of an anisotropic model.
pub const VIEW_AZIMUTH: f64 = 30.0;

/// The directions of view.
fn views() -> [Vec3<f32>; VIEW_COSINES.len()] {
    let azimuth = VIEW_AZIMUTH.to_radians();
    VIEW_COSINES.map(|cos| {
        let sin = ((1.0 - cos) * (1.0 + cos)).sqrt();
        let [x, y] = [Real::cos(azimuth), Real::sin(azimuth)].map(|a| (a * sin) as f32);
        Vec3::<f32>::new(x, y, cos as f32)
    })
}

/// Points of all replications, computed once.
#[derive(Clone, Debug)]
pub(super) struct Points {
    /// How many a replication has.
    per_replication: u32,
    /// How many replications.
    replications: u32,
    tables: [Vec<Uniforms>; 2],
}

impl Points {
    /// Those of a seed.
    pub(super) fn new(seed: u64, per_replication: u32, replications: u32) -> Self {
        let tables = PointSet::ALL.map(|set| {
            let indices = (0..replications).flat_map(|r| (0..per_replication).map(move |i| (r, i)));
            indices.map(|(r, i)| set.uniforms(seed, r, i)).collect()
        });
        Self { per_replication, replications, tables }
    }

    fn of(&self, set: PointSet) -> &[Uniforms] {
        &self.tables[set as usize]
    }
}

/// What a timed pass runs through: directions of view and points in turn.
#[derive(Clone, Debug)]
pub(super) struct Workload(Vec<(Vec3<f32>, Uniforms)>);

impl Workload {
    /// Some of the points, each with the next direction of view.
    pub(super) fn new(points: &Points) -> Self {
        let views = views().into_iter().cycle();
        Self(views.zip(points.of(PointSet::Independent).iter().copied()).take(256).collect())
    }

    /// Draws for all of it.
    pub(super) fn pass(&self, draw: DrawFunction<'_>) -> usize {
        let mut sum = 0.0;
        for &(wo, u) in &self.0 {
            sum += draw(wo, u).map_or(0.0, |d| d.weight + d.wi.x());
        }
        black_box(sum);
        self.0.len()
    }

    /// Reads all of it and calls a function that draws nothing.
    pub(super) fn idle(&self) -> usize {
        self.pass(black_box(&|wo, u| Some(Draw { wi: wo, weight: u.lobe + u.direction[0] })))
    }
}

/// What a strategy does on a model. A call, as in a renderer, where every hit has a model of its own.
pub(super) type DrawFunction<'a> = &'a dyn Fn(Vec3<f32>, Uniforms) -> Option<Draw>;

/// A strategy on a model.
pub(super) struct Contestant<'a> {
    /// Name of the strategy.
    pub(super) strategy: &'static str,
    draw: Box<dyn Fn(Vec3<f32>, Uniforms) -> Option<Draw> + 'a>,
}

impl<'a> Contestant<'a> {
    /// Pairs a strategy with a model.
    pub(super) fn new(
        name: &'static str,
        strategy: impl Strategy + 'a,
        model: &'a impl Bsdf<Color = f32>,
    ) -> Self {
        Self { strategy: name, draw: Box::new(move |wo, u| strategy.draw(model, wo, u)) }
    }

    /// Draws for all of a workload.
    pub(super) fn pass(&self, workload: &Workload) -> usize {
        workload.pass(&*self.draw)
    }

    /// Its variance under each of [`Lighting::ALL`].
    pub(super) fn noise(&self, points: &Points, set: PointSet) -> [Variance; Lighting::ALL.len()] {
        let new =
            || Spread::new(set, points.per_replication, points.replications, VIEW_COSINES.len());
        let mut spreads = Lighting::ALL.map(|_| new());
        for (direction, wo) in views().into_iter().enumerate() {
            let lights = Lights::seen_from(wo);
            let replications = points.of(set).chunks(points.per_replication as usize);
            for (replication, replication_points) in (0..).zip(replications) {
                let mut sums = [[0.0; 2]; Lighting::ALL.len()];
                for &u in replication_points {
                    let Some(draw) = (self.draw)(wo, u) else { continue };
                    for (sum, radiance) in sums.iter_mut().zip(lights.radiance(draw.wi)) {
                        let x = f64::from(draw.weight * radiance);
                        sum[0] += x;
                        sum[1] += x * x;
                    }
                }
                for (spread, sum) in spreads.iter_mut().zip(sums) {
                    spread.add(direction, replication, sum);
                }
            }
        }
        spreads.map(|spread| spread.variance())
    }
}

//! Ways of drawing directions from reflection models: noise, time, and what both come to.
//!
//! For every model of [`etendue_specimens`] with a continuous part, seen from [`VIEW_COSINES`], the estimator
//! `f L |cos θi| / pdf` under every [`Lighting`], by every [`strategy`] there is for it, with independent and with Sobol'
//! points. A delta lobe is left out: what the model's own sampler draws from it counts 0, as it would cost its turn.
//!
//! Everything is computed in `f32`, as in the renderer; sums are in `f64`.

mod contest;
mod contestant;
mod lighting;
mod points;
mod report;
pub mod strategy;
mod variance;

use core::hint::black_box;

use etendue_brdf::microfacet::{AllNormals, BoundedCaps, ProjectedDisk, VisibleNormals};
use etendue_brdf::{Bsdf, Microfacets};
use etendue_specimens::{Each, Specimen, Typical, Visitor, for_each};

use crate::timing::{self, Budget, Timing};
use contestant::{Contestant, Points, Workload};
use strategy::{Cosine, Normals, Own, Sides, Uniform};

pub use contestant::{VIEW_AZIMUTH, VIEW_COSINES};
pub use lighting::{LIGHT_DEGREES, Lighting};
pub use points::PointSet;
pub use report::report;
pub use variance::{GROUPS, Variance};

/// What is measured.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Settings {
    /// Names of models; all for none.
    pub models: Vec<String>,
    /// Chooses the points.
    pub seed: u64,
    /// Points of a replication, N.
    pub points: u32,
    /// Replications, at least two in each of [`GROUPS`].
    pub replications: u32,
    /// Time for the times.
    pub budget: Budget,
}

impl Settings {
    /// Minutes: variances to a few per cent where tails are short.
    pub fn usual() -> Self {
        Self { models: Vec::new(), seed: 1, points: 64, replications: 1024, budget: Budget::USUAL }
    }

    /// Seconds: variances to ten per cent or worse.
    pub fn quick() -> Self {
        Self { replications: 64, budget: Budget::QUICK, ..Self::usual() }
    }
}

/// What a strategy came to on a model.
#[derive(Clone, Debug, PartialEq)]
pub struct Outcome {
    /// The model.
    pub model: &'static str,
    /// The strategy.
    pub strategy: &'static str,
    /// Time to draw and weigh a direction, the point given.
    pub timing: Timing,
    /// By [`PointSet::ALL`], then by [`Lighting::ALL`].
    pub variances: [[Variance; Lighting::ALL.len()]; 2],
}

/// Everything that was measured.
#[derive(Clone, Debug, PartialEq)]
pub struct Measurement {
    /// Nanoseconds for a point: by [`PointSet::ALL`].
    pub point_nanoseconds: [f64; 2],
    /// Strategies in order, model by model.
    pub outcomes: Vec<Outcome>,
}

/// Names of the models that can be measured: those with a continuous part.
pub fn names() -> Vec<&'static str> {
    let mut names = Names(Vec::new());
    for_each(&mut names);
    names.0
}

/// Measures; `progress` hears of every model done how many of how many there are now.
pub fn measure(settings: &Settings, progress: &mut dyn FnMut(usize, usize)) -> Measurement {
    let wanted =
        |name: &str| settings.models.is_empty() || settings.models.iter().any(|m| m == name);
    let points = Points::new(settings.seed, settings.points, settings.replications);
    let workload = Workload::new(&points);
    let names: Vec<_> = names().into_iter().filter(|name| wanted(name)).collect();
    let mut models = Models {
        names,
        budget: settings.budget,
        points: &points,
        workload: &workload,
        outcomes: Vec::new(),
        done: 0,
        progress,
    };
    for_each(&mut models);
    Measurement {
        point_nanoseconds: point_times(settings.seed, settings.budget),
        outcomes: models.outcomes,
    }
}

/// Nanoseconds to compute a point.
fn point_times(seed: u64, budget: Budget) -> [f64; 2] {
    const COUNT: u32 = 256;
    let pass = |set: PointSet| {
        move || {
            let mut sum = 0.0;
            for i in 0..COUNT {
                let u = set.uniforms(black_box(seed), 0, black_box(i));
                sum += u.lobe + u.direction[0] + u.direction[1];
            }
            black_box(sum);
            COUNT as usize
        }
    };
    let idle = || {
        let mut sum = 0.0;
        for i in 0..COUNT {
            sum += black_box(i) as f32;
        }
        black_box(sum);
        COUNT as usize
    };
    let [independent, sobol] = PointSet::ALL.map(pass);
    let times = timing::race(&idle, &[&independent, &sobol], budget);
    [times[0].nanoseconds, times[1].nanoseconds]
}

struct Names(Vec<&'static str>);

impl Each for Names {
    fn each<S: Specimen>(&mut self) {
        let continuous = S::show::<f32, _>(&mut Typical, HasContinuum);
        if continuous.expect("typical parameters are valid") {
            self.0.push(S::NAME);
        }
    }
}

struct HasContinuum;

impl Visitor<f32> for HasContinuum {
    type Output = bool;

    fn visit(self, model: &impl Bsdf<Color = f32>) -> bool {
        model.lobes().continuous
    }
}

struct Models<'a> {
    names: Vec<&'static str>,
    budget: Budget,
    points: &'a Points,
    workload: &'a Workload,
    outcomes: Vec<Outcome>,
    done: usize,
    progress: &'a mut dyn FnMut(usize, usize),
}

impl Each for Models<'_> {
    fn each<S: Specimen>(&mut self) {
        if !self.names.contains(&S::NAME) {
            return;
        }
        let facets = S::facets::<f32>(&mut Typical).expect("typical widths are valid");
        let visitor = Model {
            name: S::NAME,
            facets,
            budget: self.budget,
            points: self.points,
            workload: self.workload,
        };
        let outcomes = S::show::<f32, _>(&mut Typical, visitor);
        self.outcomes.extend(outcomes.expect("typical parameters are valid"));
        self.done += 1;
        (self.progress)(self.done, self.names.len());
    }
}

struct Model<'a> {
    name: &'static str,
    facets: Option<Microfacets<f32>>,
    budget: Budget,
    points: &'a Points,
    workload: &'a Workload,
}

impl Visitor<f32> for Model<'_> {
    type Output = Vec<Outcome>;

    fn visit(self, model: &impl Bsdf<Color = f32>) -> Vec<Outcome> {
        let contestants = contestants(model, self.facets);
        let passes: Vec<_> = contestants.iter().map(|c| || c.pass(self.workload)).collect();
        let passes: Vec<timing::Pass<'_>> = passes.iter().map(|p| p as timing::Pass<'_>).collect();
        let timings = timing::race(&|| self.workload.idle(), &passes, self.budget);
        contestants
            .iter()
            .zip(timings)
            .map(|(contestant, timing)| Outcome {
                model: self.name,
                strategy: contestant.strategy,
                timing,
                variances: PointSet::ALL.map(|set| contestant.noise(self.points, set)),
            })
            .collect()
    }
}

/// Every strategy there is for a model: the model's own first. Facet normals only where light is reflected, since
/// mirroring about them finds no transmission.
fn contestants(
    model: &impl Bsdf<Color = f32>,
    facets: Option<Microfacets<f32>>,
) -> Vec<Contestant<'_>> {
    let sides = if model.lobes().transmission { Sides::Both } else { Sides::Upper };
    let mut contestants = vec![
        Contestant::new("own", Own, model),
        Contestant::new("uniform", Uniform(sides), model),
        Contestant::new("cosine", Cosine(sides), model),
    ];
    if let Some(facets) = facets.filter(|_| sides == Sides::Upper) {
        let all = Normals::<AllNormals>::new(facets);
        let caps = Normals::<VisibleNormals>::new(facets);
        let disk = Normals::<ProjectedDisk>::new(facets);
        let bounded = Normals::<BoundedCaps>::new(facets);
        contestants.extend(all.map(|s| Contestant::new("all normals", s, model)));
        contestants.extend(caps.map(|s| Contestant::new("visible normals", s, model)));
        contestants.extend(disk.map(|s| Contestant::new("visible normals, disk", s, model)));
        contestants.extend(bounded.map(|s| Contestant::new("bounded caps", s, model)));
    }
    contestants
}

#[cfg(test)]
mod tests;

//! Every check on every case, on all cores.

use core::time::Duration;

use etendue_brdf::registry::MODELS;
use rayon::prelude::*;

use crate::budget::Budget;
use crate::cases::{self, ModelCases, Surface};
use crate::checks::{self, Context};
use crate::closed_forms::CLOSED_FORMS;
use crate::filter::Filter;
use crate::furnace;
use crate::hard_cases::HARD_CASES;
use crate::measure::{Outcome, Worst};
use crate::progress::Progress;
use crate::scalar::Scalar;
use crate::statistics::sidak;
use crate::subject::{Case, Laws, Subject};
use crate::sweep::sweep;

/// Probability that a sound implementation fails any of the χ² tests of a run. Seeds are fixed:
/// this was decided once, when the seeds were chosen, and does not vary from run to run.
const OVERALL_SIGNIFICANCE: f64 = 0.01;

/// One line of the report: a check on a case in a precision.
#[derive(Clone, Debug, PartialEq)]
pub struct Record {
    /// Model, or the function of a closed form or hard case.
    pub model: &'static str,
    /// Its parameters; empty for a function.
    pub parameters: String,
    /// `"f32"`, `"f64"`, or `"both"` for a check that compares them.
    pub precision: &'static str,
    /// The check.
    pub check: &'static str,
    /// What came of it.
    pub outcome: Outcome,
    /// Of a hard case, the worst figure of the naive form over the same inputs.
    pub naive: Option<f64>,
}

/// A model with its cases in both precisions, built once per run.
struct Built {
    name: &'static str,
    laws: Laws,
    single: Vec<Case<f32>>,
    double: Vec<Case<f64>>,
}

type Task<'a> = Box<dyn Fn() -> Record + Send + Sync + 'a>;

/// Runs every check that the filter wants, hard cases included.
///
/// Records come in the order models, parameters, checks, whatever the number of threads.
pub fn run(budget: Budget, filter: &Filter, progress: &Progress) -> Vec<Record> {
    let models = cases::models();
    let built: Vec<Built> = models.iter().filter_map(Built::new).collect();
    // Counted over all models, so that a filtered run judges as the full run does.
    let tests: usize = built.iter().map(|b| 2 * b.single.len() * budget.viewers).sum();
    let context = Context { budget, significance: sidak(OVERALL_SIGNIFICANCE, tests) };
    let (single, double) = (cases::surfaces::<f32>(), cases::surfaces::<f64>());

    let mut tasks: Vec<Task> = Vec::new();
    for model in &built {
        model.add_checks(&mut tasks, &model.single, filter, context);
        model.add_checks(&mut tasks, &model.double, filter, context);
    }
    add_furnaces(&mut tasks, &single, filter, budget);
    add_furnaces(&mut tasks, &double, filter, budget);
    add_closed_forms(&mut tasks, filter, budget);
    add_hard_cases(&mut tasks, filter);

    let mut records: Vec<Record> =
        registration(&models).into_iter().filter(|r| filter.wants(r.model, r.check)).collect();
    // Parallel collection keeps the order of the tasks.
    records.par_extend(tasks.par_iter().map(|task| {
        let record = task();
        progress.check_done(tasks.len());
        record
    }));
    for model in &built {
        records.extend(model.sweep(filter, budget, progress));
    }
    // A stable sort: functions and microfacets, which are no models, stay behind.
    records.sort_by_key(|r| built.iter().position(|b| b.name == r.model).unwrap_or(built.len()));
    records
}

fn add_furnaces<'a, T: Scalar>(
    tasks: &mut Vec<Task<'a>>,
    surfaces: &'a [Surface<T>],
    filter: &Filter,
    budget: Budget,
) {
    if filter.wants(furnace::MODEL, furnace::CHECK) {
        tasks.extend(surfaces.iter().map(|surface| -> Task<'a> {
            Box::new(move || Record {
                model: furnace::MODEL,
                parameters: surface.name.to_owned(),
                precision: T::NAME,
                check: furnace::CHECK,
                outcome: furnace::weak_furnace(surface, budget),
                naive: None,
            })
        }));
    }
}

fn add_closed_forms(tasks: &mut Vec<Task>, filter: &Filter, budget: Budget) {
    for form in CLOSED_FORMS.iter().filter(|f| filter.wants(f.function, f.name)) {
        for (precision, check) in [("f32", form.single), ("f64", form.double)] {
            tasks.push(Box::new(move || Record {
                model: form.function,
                parameters: String::new(),
                precision,
                check: form.name,
                outcome: check(budget),
                naive: None,
            }));
        }
    }
}

fn add_hard_cases(tasks: &mut Vec<Task>, filter: &Filter) {
    for hard in HARD_CASES.iter().filter(|h| filter.wants(h.function, h.name)) {
        tasks.push(Box::new(|| {
            let verdict = hard.audit();
            Record {
                model: hard.function,
                parameters: String::new(),
                precision: "f32",
                check: hard.name,
                outcome: verdict.outcome,
                naive: verdict.naive,
            }
        }));
    }
}

/// Every model of the registry has cases, and every case is of a model of the registry.
pub fn registration(models: &[ModelCases]) -> Vec<Record> {
    let registered = MODELS.iter().map(|info| info.name);
    let strangers = models.iter().filter(|m| m.info().is_none()).map(|m| m.name);
    let record = |name| {
        let audited = models.iter().any(|m| m.name == name && m.info().is_some());
        let mut worst = Worst::default();
        worst.observe(f64::from(u8::from(!audited)), || {
            "the registry and the cases of the audit do not both have it".to_owned()
        });
        Record {
            model: name,
            parameters: String::new(),
            precision: "both",
            check: "registration",
            outcome: worst.within(0.0, "violations"),
            naive: None,
        }
    };
    registered.chain(strangers).map(record).collect()
}

impl Built {
    /// `None` for a model that is not in the registry, which [`registration`] reports.
    fn new(model: &ModelCases) -> Option<Self> {
        Some(Self {
            name: model.name,
            laws: Laws::from(model.info()?),
            single: (model.single)(),
            double: (model.double)(),
        })
    }

    fn add_checks<'a, T: Scalar>(
        &'a self,
        tasks: &mut Vec<Task<'a>>,
        cases: &'a [Case<T>],
        filter: &Filter,
        context: Context,
    ) {
        for case in cases {
            for check in checks::all::<T>() {
                if filter.wants(self.name, check.name) {
                    tasks.push(Box::new(move || Record {
                        model: self.name,
                        parameters: case.parameters.clone(),
                        precision: T::NAME,
                        check: check.name,
                        outcome: (check.run)(&Subject { laws: &self.laws, case }, &context),
                        naive: None,
                    }));
                }
            }
        }
    }

    /// The checks `precision` and `finite` of every case; the inputs are shared out evenly.
    fn sweep(&self, filter: &Filter, budget: Budget, progress: &Progress) -> Vec<Record> {
        let wanted = checks::SWEPT.map(|check| filter.wants(self.name, check));
        if !wanted.contains(&true) {
            return Vec::new();
        }
        let count = budget.swept.div_ceil(self.single.len() as u64);
        let (mut records, mut time) = (Vec::new(), Duration::ZERO);
        for (single, double) in self.single.iter().zip(&self.double) {
            let (swept, elapsed) = sweep(single, double, count);
            time += elapsed;
            for (check, outcome) in checks::SWEPT.into_iter().zip([swept.precision, swept.finite]) {
                records.push(Record {
                    model: self.name,
                    parameters: single.parameters.clone(),
                    precision: "both",
                    check,
                    outcome,
                    naive: None,
                });
            }
        }
        progress.swept(self.name, &records, time);
        records.into_iter().filter(|r| filter.wants(r.model, r.check)).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::Totals;

    #[test]
    fn a_model_without_cases_and_cases_without_a_model_fail() {
        let mut models = cases::models();
        assert!(Totals::of(&registration(&models)).all_passed());
        models[0].name = "stranger";
        assert_eq!(Totals::of(&registration(&models)).failed, 2);
    }

    #[test]
    fn records_do_not_depend_on_the_number_of_threads() {
        let run_on = |threads| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            pool.install(|| run(Budget::TEST, &Filter::new(["mask"]), &Progress::Silent))
        };
        let one = run_on(1);
        assert!(one.len() > 20 && one == run_on(3));
    }
}

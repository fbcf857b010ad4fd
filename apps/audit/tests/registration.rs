//! No model escapes the audit: what implements `Bsdf` is registered, and what is registered has cases.

use std::fs;
use std::path::{Path, PathBuf};

use etendue_audit::budget::Budget;
use etendue_audit::filter::Filter;
use etendue_audit::progress::Progress;
use etendue_audit::report::{self, Report, Totals};
use etendue_audit::run::{registration, run};
use etendue_audit::{cases, subject::Case};
use etendue_brdf::registry::MODELS;

fn sources(folder: &Path, found: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            // What is in there owns models and forwards to them.
            if !path.ends_with("named") {
                sources(&path, found);
            }
        } else if path.extension().is_some_and(|e| e == "rs") {
            found.push(path);
        }
    }
}

/// The types `X` of every `impl<…> Bsdf for X` in a source text, test modules left out.
fn implementors(text: &str) -> Vec<String> {
    // Test modules stand at the end of their file.
    let text = text.split("#[cfg(test)]\nmod tests").next().unwrap_or_default();
    text.lines()
        .map(str::trim_start)
        .filter(|line| line.starts_with("impl"))
        .filter_map(|line| line.split_once(" Bsdf for "))
        .map(|(_, name)| {
            let name = name.trim_start_matches('&');
            name.chars().take_while(|c| c.is_alphanumeric() || *c == '_').collect()
        })
        .collect()
}

#[test]
fn implementors_are_found_in_every_way_they_are_written() {
    let text = "impl Bsdf for A {\nimpl<C: Spectrum> Bsdf for B<C> {\n  impl<F: Bsdf> crate::Bsdf for C<F>\n\
                impl<C> Bsdf for D<'_, C>\n// impl Bsdf for E\n#[cfg(test)]\nmod tests {\nimpl Bsdf for F {";
    assert_eq!(implementors(&text.replace("crate::Bsdf", " Bsdf")), ["A", "B", "C", "D"]);
}

#[test]
fn every_type_that_implements_bsdf_is_registered() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../crates/brdf/src");
    let mut files = Vec::new();
    sources(&root, &mut files);
    let found: Vec<String> =
        files.iter().flat_map(|f| implementors(&fs::read_to_string(f).unwrap())).collect();
    assert!(found.len() >= 10, "the scan has lost its way: {found:?}");
    for name in found {
        assert!(
            MODELS.iter().any(|info| info.type_name == name),
            "{name} implements Bsdf but is not in etendue_brdf::registry::MODELS"
        );
    }
}

#[test]
fn every_registered_model_has_cases_in_both_precisions() {
    let models = cases::models();
    assert!(Totals::of(&registration(&models)).all_passed());
    for model in models {
        let (single, double) = ((model.single)(), (model.double)());
        let name = |i: usize| &double[i].parameters;
        assert!(!single.is_empty(), "{}", model.name);
        assert!(single.iter().enumerate().all(|(i, c)| &c.parameters == name(i)), "{}", model.name);
    }
}

#[test]
fn cases_have_no_lobe_that_the_registry_does_not_state() {
    for model in cases::models() {
        let stated = model.info().unwrap().lobes;
        for Case { bsdf, parameters, .. } in (model.double)() {
            let has = bsdf.lobes();
            assert!(
                has.continuous <= stated.continuous
                    && has.delta <= stated.delta
                    && has.transmission <= stated.transmission,
                "{} {parameters}: {has:?} beyond {stated:?}",
                model.name
            );
        }
    }
}

#[test]
fn the_whole_audit_passes_on_a_small_budget() {
    let records = run(Budget::TEST, &Filter::default(), &Progress::Silent);
    let report = Report { date: "2000-01-01".into(), budget: Budget::TEST, records };
    let mut text = Vec::new();
    report::table(&mut text, &report).unwrap();
    assert!(Totals::of(&report.records).all_passed(), "{}", String::from_utf8_lossy(&text));
}

//! Families of functions hold what they state.

#![allow(clippy::std_instead_of_alloc, reason = "for hosts with an operating system")]

use std::collections::HashSet;
use std::rc::Rc;

use etendue_accuracy::functions::{
    Domain, Effort, ErrorKind, Errors, FAMILIES, Reference, Variant, measure, section,
};
use etendue_accuracy::timing::Budget;
use etendue_brdf::fresnel::dielectric;
use etendue_report::Cell;

#[test]
fn names_are_distinct_and_fit_for_addresses() {
    let names: HashSet<_> = FAMILIES.iter().map(|family| family.name).collect();
    assert_eq!(names.len(), FAMILIES.len());
    for name in names {
        assert!(name.bytes().all(|b| b.is_ascii_lowercase() || b == b'-'), "{name}");
    }
}

#[test]
fn the_error_of_every_exact_variant_is_within_its_bound_and_no_variant_fails() {
    for info in FAMILIES {
        let family = info.family(Effort::Quick);
        let (kind, bound) = (family.setup.judged_by, family.setup.bound);
        let reference = (family.setup.compute)();
        assert_eq!(reference.values.len(), family.setup.ground.len(), "{}", info.name);
        let mut labels = HashSet::new();
        for (i, variant) in family.setup.variants.iter().enumerate() {
            let (values, energies) = (variant.values(), variant.energies());
            assert_eq!(energies.len(), reference.energies.len(), "{}", info.name);
            let errors = Errors::of(&values, &energies, &reference, kind);
            let judged = errors.judged(kind);
            assert!(judged.is_finite(), "{}: {}", info.name, variant.label());
            assert!(i > 0 || judged <= bound, "{}: {judged} exceeds {bound}", info.name);
            assert!(labels.insert(variant.label()), "{}: twice {}", info.name, variant.label());
            assert_eq!(variant.pass(), values.len(), "{}", info.name);
            assert_eq!(variant.idle(), values.len(), "{}", info.name);
        }
    }
}

#[test]
fn a_section_has_a_row_a_point_and_a_place_for_every_variant() {
    let info = FAMILIES.iter().find(|family| family.name == "burley").expect("a family");
    let family = info.family(Effort::Quick);
    let measured = measure(&family, Budget::QUICK, |variant| Some(10.0 + variant as f64));
    let section = section(&family, &measured);
    let count = family.setup.variants.len();
    assert_eq!(section.table.rows().len(), count);
    assert_eq!(section.charts.len(), 2);
    for chart in &section.charts {
        assert_eq!(chart.series.iter().map(|s| s.points.len()).sum::<usize>(), count);
    }
    let flags = |column: usize| {
        section.table.rows().iter().filter(|row| row[column] == Cell::Flag(true)).count()
    };
    let column = |name: &str| section.table.columns().iter().position(|c| c.name == name).unwrap();
    assert_eq!(flags(column("exact")), 1);
    // The first has the fewest instructions: nothing beats it in both.
    assert!(flags(column("front_instructions")) >= 1);
    assert!(section.advice.iter().any(|text| text.starts_with("On the front")));
}

#[test]
fn a_formula_that_is_changed_changes_its_error() {
    let domain = Rc::new(Domain {
        words: String::new(),
        points: (1..100).map(|i| f64::from(i) / 100.0).collect(),
        place: |cos: &f64| cos.to_string(),
        probes: Vec::new(),
    });
    let reference =
        Reference { values: domain.values(|&cos| dielectric(cos, 1.5)), ..Reference::default() };
    let wrong = |factor: f64| {
        let variant =
            Variant::new("", &domain, |&cos| cos, move |&cos: &f64| factor * dielectric(cos, 1.5));
        let errors = Errors::of(&variant.values(), &[], &reference, ErrorKind::RmsRelative);
        errors.rms_relative
    };
    assert_eq!(wrong(1.0), 0.0);
    // Two roundings of numbers near 1.
    assert!((wrong(1.001) - 1e-3).abs() < 1e-15, "{}", wrong(1.001));
}

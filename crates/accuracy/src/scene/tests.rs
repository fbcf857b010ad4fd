use super::*;
use core::sync::atomic::{AtomicUsize, Ordering};
use etendue_scene::{LoadOptions, load_scene};

/// A box open to the front with an area light: paths of any length, every light found either way.
const BOX: &str = r#"<scene version="3.0.0">
    <sensor type="perspective">
        <transform name="to_world"><lookat origin="0,0,3" target="0,0,0" up="0,1,0"/></transform>
        <film type="hdrfilm"><integer name="width" value="12"/><integer name="height" value="12"/></film>
    </sensor>
    <shape type="sphere"><float name="radius" value="4"/><boolean name="flip_normals" value="true"/>
        <bsdf type="twosided"><bsdf type="diffuse"><rgb name="reflectance" value="0.7"/></bsdf></bsdf></shape>
    <shape type="sphere"><float name="radius" value="0.7"/>
        <bsdf type="roughdiffuse"><float name="sigma" value="0.6"/><rgb name="reflectance" value="0.8"/></bsdf></shape>
    <shape type="sphere"><point name="center" x="2" y="2" z="2"/><float name="radius" value="0.8"/>
        <emitter type="area"><rgb name="radiance" value="5"/></emitter></shape>
</scene>"#;

fn subject() -> Subject {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("box.xml");
    std::fs::write(&path, BOX).expect("writable");
    Subject::new(|| load_scene(&path, &LoadOptions::default()).map(|loaded| loaded.scene))
        .expect("a scene")
}

fn settings() -> Settings {
    Settings { seed: 5, samples: vec![1, 4, 16], pairs: 4, reference_samples: 256, threads: 1 }
}

fn watched(
    subject: &Subject,
    settings: &Settings,
    checkpoint: Option<Checkpoint>,
) -> Option<Outcome> {
    let watch = Watch { progress: &|_| (), cancel: &AtomicBool::new(false) };
    run(subject, settings, None, checkpoint, &watch).expect("threads and folders")
}

fn estimate<'a>(outcome: &'a Outcome, name: &str) -> &'a Estimate {
    let found = outcome.estimates.iter().find(|(variant, _)| variant.name == name);
    &found.unwrap_or_else(|| panic!("no variant {name}")).1
}

#[test]
fn what_is_left_out_is_a_bias_and_ways_to_find_light_are_not() {
    let outcome = watched(&subject(), &settings(), None).expect("not cancelled");
    for (variant, estimate) in &outcome.estimates {
        let is_biased = estimate.floor() > 0.0;
        match variant.kind {
            Kind::Strategy => assert!(!is_biased, "{}: {estimate:?}", variant.name),
            // A closed room: what is cut off after a few edges is most of the light.
            Kind::Approximation if variant.max_depth.is_some_and(|depth| depth <= 5) => {
                assert!(is_biased, "{}: {estimate:?}", variant.name);
            }
            // Another form of the ball's material; Lambert's reflector is furthest off, by 0.012 ± 0.0005.
            Kind::Approximation if variant.form.is_some() => {
                assert!(is_biased && estimate.floor() < 0.015, "{}: {estimate:?}", variant.name);
            }
            Kind::Approximation => {}
        }
    }
    let floor = |depth: u32| estimate(&outcome, &format!("at most {depth} edges")).floor();
    assert!(floor(2) > floor(3) && floor(3) > floor(5));
    let base = estimate(&outcome, "MIS, independent");
    // Independent samples: noise falls as 1/n; estimates over 144 pixels and 4 pairs are good to some 20 %.
    let noise: Vec<f64> = base.levels.iter().map(|level| level.noise).collect();
    assert!((noise[0] / noise[2] / 16.0 - 1.0).abs() < 0.6, "{noise:?}");
    let flip: Vec<f64> = base.levels.iter().map(|level| level.flip).collect();
    assert!(flip[0] > flip[1] && flip[1] > flip[2] && flip[2] > 0.0 && flip[0] < 1.0, "{flip:?}");
    let own = outcome.reference_error.expect("rendered");
    assert!(own > 0.0 && own < noise[2], "{own}");
}

#[test]
fn the_variants_of_a_scene_are_those_that_differ_from_it() {
    let names: Vec<String> = subject().variants().iter().map(|v| v.name.clone()).collect();
    assert!(names.contains(&"Oren–Nayar, qualitative".to_owned()), "{names:?}");
    assert!(
        !names.iter().any(|name| name == "Oren–Nayar, full" || name.contains("plastic")),
        "{names:?}"
    );
    let mut distinct = names.clone();
    distinct.sort();
    distinct.dedup();
    assert_eq!(distinct.len(), names.len());
}

#[test]
fn an_experiment_that_was_cancelled_goes_on_where_it_was_with_the_same_errors() {
    let subject = subject();
    let settings = Settings { samples: vec![1, 2], pairs: 2, reference_samples: 8, ..settings() };
    let whole = watched(&subject, &settings, None).expect("not cancelled");

    let folder = tempfile::tempdir().expect("a folder");
    let open = || {
        let circumstances = settings.circumstances(&subject, 7, None);
        Checkpoint::open(folder.path(), circumstances).expect("a checkpoint")
    };
    let cancel = AtomicBool::new(false);
    // 16 samples of references, then some 10 pairs.
    let progress = |now: Progress| cancel.store(now.finished >= 16 + 25, Ordering::Relaxed);
    let watch = Watch { progress: &progress, cancel: &cancel };
    let cancelled =
        run(&subject, &settings, None, Some(open()), &watch).expect("threads and folders");
    assert_eq!(cancelled, None);
    let kept = open().records().len();
    let all = 2 * 2 * subject.variants().len();
    assert!(0 < kept && kept < all, "{kept}");

    let rendered = AtomicUsize::new(0);
    let progress = |now: Progress| rendered.store(now.total, Ordering::Relaxed);
    let watch = Watch { progress: &progress, cancel: &AtomicBool::new(false) };
    let resumed =
        run(&subject, &settings, None, Some(open()), &watch).expect("threads and folders");
    let resumed = resumed.expect("not cancelled");
    assert_eq!(open().records().len(), all);
    assert_eq!(resumed.reference_error, whole.reference_error);
    for ((_, a), (_, b)) in whole.estimates.iter().zip(&resumed.estimates) {
        // Times differ; everything else is the same bits.
        assert_eq!(a.bias, b.bias);
        assert!(a.levels.iter().zip(&b.levels).all(|(a, b)| a.noise == b.noise));
    }
    assert!(rendered.into_inner() < 16 + all * 3, "what was kept was rendered again");
}

#[test]
fn a_reference_of_another_size_is_refused() {
    let watch = Watch { progress: &|_| (), cancel: &AtomicBool::new(false) };
    let settings = Settings { samples: vec![1], pairs: 2, ..settings() };
    let given = Some(Image::black([3, 4]));
    let error = run(&subject(), &settings, given, None, &watch).expect_err("another size");
    assert!(error.to_string().contains("12×12") && error.to_string().contains("3×4"), "{error}");
}

#[test]
fn the_report_marks_floors_and_what_is_never_reached() {
    let settings = Settings { samples: vec![1, 8], ..settings() };
    let outcome = watched(&subject(), &settings, None).expect("not cancelled");
    let report = report(&outcome, &settings, Vec::new());
    let json = report.json();
    let row = |section: &str, variant: &str| {
        let rows = json["sections"][section]["rows"].as_array().expect("rows");
        rows.iter().find(|row| row["variant"] == variant).expect("a row").clone()
    };
    let direct = row("bias", "at most 2 edges");
    assert_eq!(direct["biased"], true);
    let floor = direct["floor"].as_f64().expect("a number");
    assert!(floor > 0.001, "{floor}");
    assert_eq!(row("times", "at most 2 edges")["how_1e-3"], "never");
    assert_eq!(
        json["sections"]["levels"]["rows"].as_array().expect("rows").len(),
        2 * outcome.estimates.len()
    );
    assert!(report.svg().contains("at most 2 edges") && report.svg().contains("1/time"));
}

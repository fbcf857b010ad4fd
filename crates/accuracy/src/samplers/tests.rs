use super::*;

/// Variances alone; times are quick and not looked at.
fn outcomes(models: &[&str]) -> Vec<Outcome> {
    let models = models.iter().map(|&m| m.to_owned()).collect();
    let budget = Budget { rounds: 1, round: core::time::Duration::from_nanos(1) };
    let settings = Settings { models, replications: 256, budget, ..Settings::usual() };
    measure(&settings, &mut |_, _| ()).outcomes
}

fn of<'a>(outcomes: &'a [Outcome], strategy: &str) -> &'a Outcome {
    outcomes.iter().find(|o| o.strategy == strategy).expect("measured")
}

#[test]
fn every_strategy_estimates_the_same_mean() {
    for model in outcomes(&[]).chunk_by(|a, b| a.model == b.model) {
        let own = &model[0];
        assert_eq!(own.strategy, "own");
        for other in &model[1..] {
            for lighting in 0..Lighting::ALL.len() {
                let [a, b] = [own, other].map(|o| &o.variances[0][lighting]);
                // Over all views: a light that a view sees next to nothing of is found by some strategies only.
                let [mean_a, mean_b] = [a, b].map(|v| v.means.iter().sum::<f64>());
                let squares = |v: &Variance| v.mean_errors.iter().map(|e| e * e).sum::<f64>();
                // 5 standard errors of a fixed seed, and the rounding of single precision.
                let allowed = 5.0 * (squares(a) + squares(b)).sqrt() + 1e-5 * mean_a;
                assert!(
                    (mean_a - mean_b).abs() <= allowed,
                    "{} by {} under {:?}: {a:?} {b:?}",
                    other.model,
                    other.strategy,
                    Lighting::ALL[lighting]
                );
            }
        }
    }
}

#[test]
fn a_matte_surface_has_the_variances_of_theory() {
    let outcomes = outcomes(&["lambert"]);
    let furnace = |strategy| of(&outcomes, strategy).variances[0][0].clone();
    // f cos / pdf is the reflectance itself.
    for strategy in ["own", "cosine"] {
        // The square of a few ulp of single precision.
        assert!(furnace(strategy).relative < 1e-12, "{strategy} {:?}", furnace(strategy));
    }
    // f cos / pdf = 2 ρ cos θ with cos θ uniform: ρ² (4/3 − 1), and ρ² divided out.
    let uniform = furnace("uniform");
    assert!((uniform.relative * 3.0 - 1.0).abs() < 4.0 * uniform.uncertainty, "{uniform:?}");
}

#[test]
fn a_small_light_on_a_matte_surface_has_the_variance_of_theory() {
    let outcomes = outcomes(&["lambert"]);
    let light = &of(&outcomes, "own").variances[0][2];
    // Cosine sampling: X = ρ L, E X = (ρ/π) ∫ L cos, E X² = (ρ²/π) ∫ L² cos. A lobe exp(κ (cos γ − 1)) integrates to 2π/κ, its
    // square to half of that, and cos is that of its axis, 1/√2, times the mean cosine 1 − 1/κ (1 − 1/2κ of the square).
    let kappa = 1.0 / (1.0 - etendue_math::Real::cos(LIGHT_DEGREES.to_radians()));
    let (mean, square) = (
        2.0 / kappa * core::f64::consts::FRAC_1_SQRT_2 * (1.0 - 1.0 / kappa),
        1.0 / kappa * core::f64::consts::FRAC_1_SQRT_2 * (1.0 - 0.5 / kappa),
    );
    let want = square / (mean * mean) - 1.0;
    assert!((light.relative / want - 1.0).abs() < 4.0 * light.uncertainty, "{light:?} {want}");
}

#[test]
fn visible_normals_are_no_noisier_than_all_of_them_and_those_of_the_model_are_its_own() {
    for model in [
        "rough-conductor",
        "rough-conductor/beckmann",
        "turquin-conductor",
        "conductor",
        "two-sided",
    ] {
        let outcomes = outcomes(&[model]);
        let at = |strategy| of(&outcomes, strategy).variances[0][0].clone();
        let [all, visible, own] = ["all normals", "visible normals", "own"].map(at);
        assert!(visible.relative < all.relative, "{model} {visible:?} {all:?}");
        // The same points, the same directions; weights differ by roundings, which divisions at grazing angles enlarge.
        assert!(
            (visible.relative / own.relative - 1.0).abs() < 1e-3,
            "{model} {visible:?} {own:?}"
        );
    }
}

#[test]
fn strata_help_smooth_integrands() {
    let outcomes = outcomes(&["lambert", "burley"]);
    for outcome in outcomes.iter().filter(|o| o.strategy == "uniform") {
        let [independent, sobol] = [0, 1].map(|set| outcome.variances[set][0].relative);
        assert!(sobol < 0.05 * independent, "{outcome:?}");
    }
}

#[test]
fn the_report_holds_every_outcome_under_every_light_and_says_what_is_exact() {
    let settings =
        Settings { models: vec!["lambert".to_owned(), "burley".to_owned()], ..Settings::quick() };
    let measurement = measure(&settings, &mut |_, _| ());
    let json = report(&measurement, &settings, Vec::new()).json();
    for lighting in Lighting::ALL {
        let rows = json["sections"][lighting.name()]["rows"].as_array().expect("rows");
        assert_eq!(rows.len(), measurement.outcomes.len());
        let best =
            |model: &str| rows.iter().filter(|r| r["model"] == model && r["best"] == true).count();
        assert!(best("burley") == 1 && best("lambert") >= 1);
    }
    let own = &json["sections"]["furnace"]["rows"][3];
    assert_eq!((&own["model"], &own["strategy"]), (&"lambert".into(), &"own".into()));
    assert_eq!(own["efficiency_independent"], "exact");
    let digest = json["sections"]["own"]["rows"].as_array().expect("rows");
    assert_eq!(digest.len(), 2);
    assert_eq!(
        (&digest[1]["furnace"], &digest[1]["furnace_best"]),
        (&"exact".into(), &"own = cosine".into())
    );
}

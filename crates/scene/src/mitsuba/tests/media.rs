//! Participating media.

use super::*;
use crate::color::Primaries;
use crate::medium::MediumCurves;

#[test]
fn media_have_mitsubas_defaults_and_are_translated_once() {
    let loaded = load(
        "<integrator type=\"volpath\"/><sensor type=\"perspective\"><ref id=\"fog\"/></sensor>
        <medium type=\"homogeneous\" id=\"fog\"/>
        <shape type=\"sphere\"><ref name=\"interior\" id=\"fog\"/>
            <medium type=\"heterogeneous\" name=\"exterior\">
                <phase type=\"hg\"/><rgb name=\"albedo\" value=\"0.5 1.5 0\"/>
                <rgb name=\"sigma_t\" value=\"1 2 3\"/><float name=\"scale\" value=\"2\"/>
                <boolean name=\"sample_emitters\" value=\"false\"/>
            </medium>
        </shape>
        <shape type=\"sphere\"/>",
    )
    .expect("media");
    let scene = &loaded.scene;
    // Of `volpath`, whose 5 is the last that ends none.
    assert!(scene.path.volumes && scene.path.roulette_depth == 6);
    let [fog, cloud] = [0, 1].map(|id| scene.media.get(MediumId(id)).expect("a medium"));
    assert!(scene.media.get(MediumId(2)).is_none());
    assert_eq!(scene.media.around_camera, Some(MediumId(0)));
    let sides = Boundary { interior: Some(MediumId(0)), exterior: Some(MediumId(1)) };
    assert_eq!(scene.surfaces[0].boundary, Some(sides));
    assert_eq!(scene.surfaces[1].boundary, None);
    assert!(
        matches!(fog.extinction, Extinction::Homogeneous(sigma) if sigma.to_array() == [1.0; 3])
    );
    assert_eq!(fog.albedo_at(Vec3::ZERO, Primaries).to_array(), [0.75; 3]);
    assert!(fog.phase.is_isotropic() && fog.samples_lights && !fog.is_coloured());
    let Extinction::Heterogeneous(density) = &cloud.extinction else { panic!("{cloud:?}") };
    assert_eq!(density.at(Vec3::splat(0.5)).to_array(), [2.0, 4.0, 6.0]);
    assert!(matches!(cloud.phase, Phase::HenyeyGreenstein(lobe) if lobe.mean_cosine() == 0.8));
    assert!(!cloud.samples_lights && cloud.is_coloured());
    // Albedos are reflectances: at most 1, with a warning.
    assert_eq!(cloud.albedo_at(Vec3::ZERO, Primaries).to_array(), [0.5, 1.0, 0.0]);
    assert!(loaded.warnings.iter().any(|w| w.to_string().contains("clamped to [0, 1]")));
}

#[test]
fn media_keep_the_curves_of_their_spectra() {
    let loaded = load(
        "<shape type=\"sphere\"><medium type=\"homogeneous\" name=\"interior\">
            <spectrum name=\"sigma_t\" value=\"400:4, 700:1\"/><float name=\"scale\" value=\"2\"/>
            <spectrum name=\"albedo\" value=\"400:0.5, 700:1\"/></medium></shape>",
    )
    .expect("a medium");
    let medium = loaded.scene.media.get(MediumId(0)).expect("a medium");
    let MediumCurves { extinction: Some(extinction), albedo: Some(albedo) } = &medium.curves else {
        panic!("{:?}", medium.curves)
    };
    assert_eq!((extinction.at(550.0), albedo.at(550.0)), (5.0, 0.75));
    assert!(medium.is_coloured());
}

#[test]
fn phase_functions_are_those_of_mitsuba() {
    let phase = |content: &str| {
        let medium = format!("<medium type=\"homogeneous\" name=\"interior\">{content}</medium>");
        let loaded = load(&format!("<shape type=\"sphere\">{medium}</shape>")).expect("a medium");
        loaded.scene.media.get(MediumId(0)).expect("a medium").phase.clone()
    };
    let straight_on = |phase: &Phase| phase.eval(Vec3::ZERO, Vec3::Z, Vec3::Z);
    assert!(matches!(phase("<phase type=\"rayleigh\"/>"), Phase::Rayleigh));
    let parts = "<phase type=\"tabphase\" name=\"b\"><string name=\"values\" value=\"0, 1\"/></phase>\
                 <phase type=\"isotropic\" name=\"a\"/>";
    // In the order of the file; a table that rises evenly is twice as high at its end as on average.
    for (weight, expected) in [("", 1.5), ("<float name=\"weight\" value=\"1\"/>", 1.0)] {
        let blend = phase(&format!("<phase type=\"blendphase\">{weight}{parts}</phase>"));
        let found = straight_on(&blend) * 4.0 * core::f32::consts::PI;
        // A few roundings.
        assert!((found - expected).abs() < 1e-6, "{weight}: {found}");
    }
}

#[test]
fn wrong_media_are_refused_where_they_stand() {
    let in_shape = |medium: &str| format!("<shape type=\"sphere\">\n{medium}</shape>");
    let inside = |content: &str| {
        in_shape(&format!("<medium type=\"homogeneous\" name=\"interior\">\n{content}</medium>"))
    };
    let nameless = in_shape("<medium type=\"homogeneous\"/>");
    refused(&nameless, 3, "does not say on which side the medium is; name it “interior” or");
    refused(
        &in_shape("<medium type=\"fog\" name=\"interior\"/>"),
        3,
        "supported are heterogeneous",
    );
    let hg = "<phase type=\"hg\"><float name=\"g\" value=\"1\"/></phase>";
    refused(&inside(hg), 4, "“g” must lie between -1 and 1, both excluded, but is 1");
    for (values, problem) in [
        ("1", "“values” must be at least two"),
        ("1, x", "“x” in “values” is no number"),
        ("1, -1", "“values”: weight 1 is negative"),
        ("0 0", "“values”: all weights are 0"),
    ] {
        let table = format!(
            "<phase type=\"tabphase\"><string name=\"values\" value=\"{values}\"/></phase>"
        );
        refused(&inside(&table), 4, problem);
    }
    refused(&inside("<phase type=\"tabphase\"/>"), 4, "the table has no “values”");
    let half = "<phase type=\"blendphase\"><phase type=\"rayleigh\"/></phase>";
    refused(&inside(half), 4, "a blend needs two phase functions inside");
    refused(&inside("<phase type=\"isotropic\"/><phase type=\"hg\"/>"), 4, "more than one phase");
    refused(&inside("<float name=\"scale\" value=\"-1\"/>"), 4, "“scale” must be not negative");
    refused(&inside("<float name=\"sigma_r\" value=\"1\"/>"), 4, "did you mean “sigma_t”?");
    let volume = "<volume type=\"constvolume\" name=\"sigma_t\"/>";
    refused(&inside(volume), 4, "of a homogeneous medium cannot be a volume");
    let dense = "<medium type=\"heterogeneous\" name=\"interior\">\n\
                 <float name=\"sigma_t\" value=\"1e9\"/></medium>";
    refused(&in_shape(dense), 4, "the medium is too dense: its optical thickness");
    let nameless = "<volume type=\"gridvolume\" name=\"albedo\"/>";
    refused(&inside(nameless), 4, "volume “gridvolume” has no “filename”");
    let missing = "<volume type=\"gridvolume\" name=\"albedo\">\
                   <string name=\"filename\" value=\"no.vol\"/></volume>";
    let error = load(&inside(missing)).expect_err("there is no such file").to_string();
    assert!(error.contains("no.vol") && error.contains("(named at scene.xml:4:"), "{error}");
}

#[test]
fn media_that_the_integrator_does_not_see_are_warned_of() {
    let warned = |integrator: &str| {
        let shape =
            "<shape type=\"sphere\"><medium type=\"homogeneous\" name=\"interior\"/></shape>";
        let loaded = load(&format!("<integrator type=\"{integrator}\"/>{shape}")).expect("a scene");
        loaded.warnings.iter().any(|w| w.to_string().contains("the integrator sees no media"))
    };
    assert!(warned("path") && !warned("volpath") && !warned("volpathmis"));
}

#[test]
fn scattering_and_absorption_are_extinction_and_albedo() {
    let medium = "<medium type=\"homogeneous\" name=\"interior\"><float name=\"scale\" value=\"2\"/>\
                  <rgb name=\"sigma_s\" value=\"1 2 0\"/><rgb name=\"sigma_a\" value=\"3 0 0\"/></medium>";
    let content = format!("<shape type=\"sphere\">{medium}</shape>");
    let loaded = load(&content).expect("a medium of version 0.6");
    let medium = &loaded.scene.media.list[0];
    let Extinction::Homogeneous(sigma_t) = medium.extinction else { panic!("{medium:?}") };
    assert_eq!(sigma_t.to_array(), [8.0, 4.0, 0.0]);
    assert_eq!(medium.albedo.at(Vec3::ZERO).to_array(), [0.25, 1.0, 0.0]);
    let both = content.replace("sigma_a", "sigma_t");
    refused(&both, 2, "give either “sigma_s” or “sigma_t”");
}

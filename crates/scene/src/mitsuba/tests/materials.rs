//! Materials and what they are made of.

use etendue_brdf::Bsdf;

use super::*;
use crate::color::Primaries;
use crate::material::Side;

#[test]
fn every_bsdf_is_translated() {
    let is = |bsdf: &str, expected: fn(&Material) -> bool| {
        let (material, _) = material(bsdf);
        assert!(expected(&material), "{bsdf}: {material:?}");
    };
    is("<bsdf type=\"diffuse\"/>", |m| matches!(m, Material::Diffuse { .. }));
    is("<bsdf type=\"roughdiffuse\"/>", |m| matches!(m, Material::RoughDiffuse { .. }));
    is("<bsdf type=\"dielectric\"/>", |m| {
        matches!(m, Material::Dielectric { eta, dispersion: None, roughness: None, .. }
            if (eta.value() - 1.5046 / 1.000277).abs() < 1e-6)
    });
    is("<bsdf type=\"thindielectric\"/>", |m| matches!(m, Material::ThinDielectric { .. }));
    is("<bsdf type=\"roughdielectric\"/>", |m| {
        matches!(m, Material::Dielectric { roughness: Some(_), .. })
    });
    is("<bsdf type=\"conductor\"/>", |m| {
        matches!(m, Material::Conductor { index: ConductorIndex::Mirror, roughness: None, .. })
    });
    is("<bsdf type=\"plastic\"/>", |m| matches!(m, Material::Plastic { .. }));
    is("<bsdf type=\"roughplastic\"/>", |m| matches!(m, Material::Plastic { .. }));
    is("<bsdf type=\"principledthin\"/>", |m| matches!(m, Material::PrincipledThin(_)));
    is("<bsdf type=\"mask\"><bsdf type=\"diffuse\"/></bsdf>", |m| {
        matches!(m, Material::Mask { .. })
    });
    is(
        "<bsdf type=\"twosided\"><bsdf type=\"diffuse\"/></bsdf>",
        |m| matches!(m, Material::TwoSided { front, back } if front == back),
    );
    is(
        "<bsdf type=\"blendbsdf\"><bsdf type=\"diffuse\"/><bsdf type=\"plastic\"/></bsdf>",
        |m| matches!(m, Material::Blend { parts: [a, b], .. } if a < b),
    );
    is(
        "<bsdf type=\"normalmap\"><rgb name=\"normalmap\" value=\"0.5 0.5 1\"/>\
         <boolean name=\"flip_invalid_normals\" value=\"false\"/><bsdf type=\"diffuse\"/></bsdf>",
        |m| {
            matches!(m, Material::NormalMap { options, .. }
                if !options.flip_invalid_normals && options.use_shadowing_function)
        },
    );
    is("<bsdf type=\"null\"/>", |m| matches!(m, Material::Null));
    is("<bsdf type=\"phong\"/>", |m| matches!(m, Material::Phong { .. }));
    is("<bsdf type=\"coating\"><bsdf type=\"diffuse\"/></bsdf>", |m| {
        matches!(m, Material::Coated { .. })
    });
    refused(
        "<bsdf type=\"coating\"><bsdf type=\"dielectric\"/></bsdf>",
        2,
        "only an opaque material, of one side, can have a coating",
    );
    is("<bsdf type=\"difftrans\"/>", |m| matches!(m, Material::DiffuseTransmitter { .. }));
}

#[test]
fn a_mixture_is_made_of_blends() {
    let part = |value: f64| {
        format!("<bsdf type=\"diffuse\"><float name=\"reflectance\" value=\"{value}\"/></bsdf>")
    };
    for (weights, expected) in [
        ("0.5, 0.25, 0.25", 0.5 * 0.2 + 0.25 * 0.4 + 0.25 * 0.8),
        // What is left is absorbed; what is too much is scaled.
        ("0.2 0.3 0.1", 0.2 * 0.2 + 0.3 * 0.4 + 0.1 * 0.8),
        ("2 1 1", 0.5 * 0.2 + 0.25 * 0.4 + 0.25 * 0.8),
        ("0 0 1", 0.8),
    ] {
        let bsdf = format!(
            "<bsdf type=\"mixturebsdf\"><string name=\"weights\" value=\"{weights}\"/>{}{}{}</bsdf>",
            part(0.2),
            part(0.4),
            part(0.8)
        );
        let (_, loaded) = material(&bsdf);
        let scene = &loaded.scene;
        let id = scene.surfaces[0].material;
        let model =
            scene.materials.prepare(id, &scene.textures, [0.0; 2].into(), Side::Front, Primaries);
        let albedo = model.albedo(Vec3::Z).expect("of diffuse parts").r;
        // Weights of single precision.
        assert!((f64::from(albedo) - expected).abs() < 1e-6, "{weights}: {albedo} {expected}");
    }
    refused(
        "<bsdf type=\"mixturebsdf\"><string name=\"weights\" value=\"1 2\"/><bsdf type=\"null\"/></bsdf>",
        2,
        "1 bsdfs have 2 weights",
    );
}

#[test]
fn spectra_may_be_plugins() {
    let mean = |spectrum: &str| {
        let (material, loaded) = material(&format!("<bsdf type=\"diffuse\">{spectrum}</bsdf>"));
        let Material::Diffuse { reflectance } = material else { panic!("{material:?}") };
        loaded.scene.textures.mean(reflectance)
    };
    let inline =
        mean("<spectrum name=\"reflectance\" value=\"400:0.1, 500:0.2, 600:0.5, 700:0.4\"/>");
    let irregular = "<spectrum type=\"irregular\" name=\"reflectance\">\
        <string name=\"wavelengths\" value=\"400, 500, 600, 700\"/>\
        <string name=\"values\" value=\"0.1, 0.2, 0.5, 0.4\"/></spectrum>";
    let regular = "<spectrum type=\"regular\" name=\"reflectance\">\
        <float name=\"wavelength_min\" value=\"400\"/><float name=\"wavelength_max\" value=\"700\"/>\
        <string name=\"values\" value=\"0.1, 0.2, 0.5, 0.4\"/></spectrum>";
    assert_eq!(mean(irregular), inline);
    assert_eq!(mean(regular), inline);
    let black_body = |temperature: f64| {
        mean(&format!(
            "<texture type=\"checkerboard\" name=\"reflectance\"><spectrum type=\"blackbody\" \
             name=\"color0\"><float name=\"temperature\" value=\"{temperature}\"/></spectrum></texture>"
        ))
    };
    let [warm, cold] = [1200.0, 12000.0].map(black_body);
    assert!(warm.r > warm.b && cold.b >= cold.r, "{warm:?} {cold:?}");
    refused(
        "<bsdf type=\"diffuse\"><spectrum type=\"irregular\" name=\"reflectance\">\
         <string name=\"wavelengths\" value=\"400 300\"/><string name=\"values\" value=\"1 1\"/></spectrum></bsdf>",
        2,
        "wavelength 300 does not lie above 400",
    );
}

#[test]
fn named_conductors_have_mitsubas_indices() {
    let bsdf = "<bsdf type=\"roughconductor\"><string name=\"material\" value=\"Au\"/>\
                <float name=\"alpha_u\" value=\"0.1\"/><float name=\"alpha_v\" value=\"0.3\"/></bsdf>";
    let (material, loaded) = material(bsdf);
    let Material::Conductor { index: ConductorIndex::Complex { eta, .. }, roughness, .. } =
        material
    else {
        panic!("{material:?}")
    };
    let textures = &loaded.scene.textures;
    // mi.traverse(mi.load_dict({'type': 'conductor', 'material': 'Au'})); our wavelengths are rounded to a hundredth of a
    // nanometre.
    for (ours, theirs) in
        textures.mean(eta).to_array().into_iter().zip([0.143036, 0.375307, 1.44205])
    {
        assert!((ours / theirs - 1.0).abs() < 3e-5, "{ours} {theirs}");
    }
    let curve = textures.curve(eta).expect("a curve");
    assert!(curve.at(450.0) > 1.3 && curve.at(650.0) < 0.2);
    let roughness = roughness.expect("a rough conductor");
    assert_eq!(textures.value(roughness.alpha_u, [0.0; 2]), 0.1);
    assert_eq!(textures.value(roughness.alpha_v, [0.0; 2]), 0.3);
}

/// The indices of an interface at 486 and 656 nm, relative to air, and that of its material.
fn indices(parameters: &str) -> [f32; 3] {
    let bsdf = format!("<bsdf type=\"dielectric\">{parameters}</bsdf>");
    match material(&bsdf).0 {
        Material::Dielectric { eta, dispersion: Some(dispersion), .. } => {
            [dispersion.index(486.1327), dispersion.index(656.2725), eta.value()]
        }
        other => panic!("{other:?}"),
    }
}

#[test]
fn dispersion_is_stated_in_four_ways() {
    const AIR: f32 = 1.000_277;
    let close = |found: [f32; 3], wanted: [f32; 3]| {
        for (found, wanted) in found.into_iter().zip(wanted) {
            // Six digits of data sheets.
            assert!((found * AIR - wanted).abs() < 2e-6, "{found} {wanted}");
        }
    };
    // The formula in double precision.
    let flint = [1.806_513, 1.775_955, 1.784_72];
    for glass in [
        "glass\" value=\"N-SF11\"",
        "sellmeier\" value=\"1.73759695, 0.013188707, 0.313747346, 0.0623068142, 1.89878101, 155.23629\"",
    ] {
        let found = indices(&format!("<string name=\"{glass}/>"));
        for (found, wanted) in found.into_iter().zip(flint) {
            // Six digits after the point, and a rounding.
            assert!((found * AIR - wanted).abs() < 2e-6, "{found} {wanted}");
        }
    }
    let cauchy = indices(
        "<string name=\"cauchy\" value=\"1.5 0.004\"/><float name=\"ext_ior\" value=\"1.000277\"/>",
    );
    close(cauchy, [1.516_926, 1.509_287, 1.511_587]);
    let abbe =
        indices("<float name=\"int_ior\" value=\"1.5\"/><float name=\"abbe\" value=\"50\"/>");
    assert!((abbe[2] * AIR - 1.5).abs() < 1e-6);
    assert!(((abbe[0] - abbe[1]) * AIR - 0.01).abs() < 1e-6);
}

#[test]
fn spectra_are_kept_beside_their_colours() {
    let (material, loaded) = material(
        "<bsdf type=\"conductor\"><spectrum name=\"eta\" value=\"400:1, 700:3\"/>\
         <float name=\"ext_eta\" value=\"2\"/></bsdf>",
    );
    let Material::Conductor { index: ConductorIndex::Complex { eta, k }, .. } = material else {
        panic!("{material:?}")
    };
    let textures = &loaded.scene.textures;
    assert_eq!(textures.curve(eta).map(|curve| curve.at(550.0)), Some(1.0));
    assert!(textures.curve(k).is_none());
}

#[test]
fn principled_materials_have_an_index_by_either_name_and_transmit_only_on_demand() {
    let principled = |parameters: &str| {
        let bsdf = format!("<bsdf type=\"principled\">{parameters}</bsdf>");
        match material(&bsdf).0 {
            Material::Principled(textures) => *textures,
            other => panic!("{other:?}"),
        }
    };
    let plain = principled("");
    // (1 + √0.04)/(1 − √0.04) = 1.5, to the rounding of f32.
    assert!((plain.eta.value() - 1.5).abs() < 1e-6 && plain.spec_trans.is_none());
    let glass = principled(
        "<float name=\"eta\" value=\"1.3\"/><float name=\"spec_trans\" value=\"0.5\"/>\
         <float name=\"clearcoat_sampling_rate\" value=\"0.25\"/>",
    );
    assert!(glass.eta.value() == 1.3 && glass.spec_trans.is_some());
    assert_eq!(glass.sampling_rates, [1.0, 1.0, 0.25]);
    let zero = "<float name=\"specular\" value=\"0\"/>";
    assert_eq!(principled(zero).eta.value(), 1.0);
    let through = principled(&format!("{zero}<float name=\"spec_trans\" value=\"1\"/>"));
    assert!(through.eta.value() > 1.018);
    let both = "<bsdf type=\"principled\"><float name=\"eta\" value=\"1.3\"/>\n\
                <float name=\"specular\" value=\"0.5\"/></bsdf>";
    refused(both, 3, "either “eta” or “specular”");
    let two_sided = "<bsdf type=\"twosided\"><bsdf type=\"principled\">\
                     <float name=\"spec_trans\" value=\"1\"/></bsdf></bsdf>";
    refused(two_sided, 2, "only an opaque material");
}

#[test]
fn materials_around_others_say_what_they_lack() {
    let bsdf = |plugin: &str, inner: &str| format!("<bsdf type=\"{plugin}\">\n{inner}</bsdf>");
    let diffuse = "<bsdf type=\"diffuse\"/>";
    refused(&bsdf("blendbsdf", diffuse), 2, "a blend needs two bsdfs");
    refused(&bsdf("normalmap", diffuse), 2, "no texture “normalmap”");
    refused(&bsdf("bumpmap", diffuse), 2, "the bump map has no texture inside");
    refused(&bsdf("mask", ""), 2, "bsdf “mask” has no bsdf inside");
    let board = "<texture type=\"checkerboard\" name=\"height\"/>";
    refused(&bsdf("bumpmap", &format!("{board}{diffuse}")), 3, "must be a bitmap");
    let glass = bsdf("blendbsdf", &format!("{diffuse}<bsdf type=\"dielectric\"/>"));
    refused(&bsdf("twosided", &glass), 2, "only an opaque material");
}

#[test]
fn attributes_are_looked_up_on_the_meshes_that_have_them() {
    let bsdf = "<bsdf type=\"diffuse\"><texture type=\"mesh_attribute\" name=\"reflectance\">\
                <string name=\"name\" value=\"vertex_color\"/></texture></bsdf>";
    refused(
        &format!("<bsdf type=\"null\"/>\n<shape type=\"sphere\">{bsdf}</shape>"),
        3,
        "shape “sphere” has no attribute “vertex_color”",
    );
    let lamp = |name| {
        format!(
            "<shape type=\"sphere\"><emitter type=\"area\">\n\
             <texture type=\"mesh_attribute\" name=\"radiance\">\
             <string name=\"name\" value=\"{name}\"/></texture></emitter></shape>"
        )
    };
    refused(&lamp("vertex_color"), 3, "“radiance” cannot be an attribute of a mesh");
    refused(&lamp("color"), 3, "begins with neither “vertex_” nor “face_”");
}

//! Pictures by wavelength against those of Mitsuba's spectral mode.

mod common;

use common::Folder;

/// A metal ball under an even sky, of which the only pixel sees the middle.
fn metal(name: &str) -> String {
    format!(
        "<scene version=\"3.0.0\"><integrator type=\"path\"><integer name=\"max_depth\" value=\"2\"/></integrator>
        <sensor type=\"perspective\"><float name=\"fov\" value=\"0.1\"/>
          <transform name=\"to_world\"><lookat origin=\"0, 0, 6\" target=\"0, 0, 0\" up=\"0, 1, 0\"/></transform>
          <film type=\"hdrfilm\"><integer name=\"width\" value=\"1\"/><integer name=\"height\" value=\"1\"/>
            <rfilter type=\"box\"/></film></sensor>
        <emitter type=\"constant\"><rgb name=\"radiance\" value=\"1\"/></emitter>
        <shape type=\"sphere\"><float name=\"radius\" value=\"0.7\"/>
          <bsdf type=\"conductor\"><string name=\"material\" value=\"{name}\"/></bsdf></shape></scene>"
    )
}

#[test]
fn metals_have_the_colours_of_their_spectra() {
    // Mitsuba 3.9.1, `scalar_spectral`, 786 432 samples: standard errors of 2e-4 in red, 1e-5 in green and 3e-4 in blue.
    for (name, expected) in
        [("Au", [1.021_64, 0.782_17, 0.343_37]), ("Cu", [0.954_84, 0.637_65, 0.537_86])]
    {
        let folder = Folder::new();
        folder.write("scene.xml", metal(name));
        let picture = folder.render(&folder.path("scene.xml"), &["--spectral", "--spp", "16384"]);
        for (ours, theirs) in picture.pixel(0, 0).into_iter().zip(expected) {
            // Three of their standard errors; ours are smaller, for a stratified wavelength is all that varies.
            assert!((ours - theirs).abs() < 1e-3, "{name}: {ours} {theirs}");
        }
    }
}

#[test]
fn wavelengths_are_carried_only_where_they_are_asked_for() {
    let folder = Folder::new();
    folder.write("scene.xml", metal("Au"));
    let configuration = |arguments: &[&str]| {
        let fixed = ["render", "scene.xml", "--spp", "1", "--json", "-q", "-o", "a.pfm"];
        folder.run(&[&fixed, arguments].concat()).json()["configuration"].clone()
    };
    assert_eq!(configuration(&[]), "surfaces");
    assert_eq!(configuration(&["--spectral"]), "spectral");
    assert_eq!(configuration(&["--spectral", "--without", "spectral-colours"]), "surfaces");
}

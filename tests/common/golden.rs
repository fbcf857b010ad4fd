//! Comparing a scene with its golden picture.

use super::{Folder, repository};

/// A scene with a picture in `tests/golden`, and how far from it a picture of 64 samples per pixel
/// may be.
pub(crate) struct Golden<'a> {
    /// Its file.
    pub(crate) scene: &'a str,
    /// Name of the picture, without its extension.
    pub(crate) name: &'a str,
    pub(crate) size: &'a str,
    /// Bound of the relMSE: twice the largest of eight seeds, which lie within a fifth of each
    /// other, so that another order of random numbers passes. Another slope of the rough sphere
    /// (0.3 rad) or glass of index 1.33 exceeds it.
    pub(crate) relative_mse: f64,
    /// Bound of the relative difference of the means: twice the largest of eight seeds. Paths cut
    /// off at four edges in the Cornell box (−3.8 %) exceed it.
    pub(crate) mean_difference: f64,
}

impl Golden<'_> {
    /// Renders the scene and compares.
    pub(crate) fn check(&self) {
        let Self { scene, name, size, relative_mse, mean_difference } = self;
        let folder = Folder::new();
        folder.render(&repository(scene), &["--size", size, "--spp", "64", "--strict"]);
        let golden = repository(&format!("tests/golden/{name}.exr"));
        let golden = golden.to_str().expect("UTF-8");
        let outcome = folder.run(&["compare", "out.pfm", golden, "--json"]);
        assert_eq!(outcome.exit, Some(0), "{scene}: {}", outcome.stderr);
        let json = outcome.json();
        let figure = |key: &str| json[key].as_f64().unwrap_or_else(|| panic!("{key} in {json}"));
        assert!(figure("rel_mse") <= *relative_mse, "{scene}: {json}");
        assert!(figure("mean_difference").abs() <= *mean_difference, "{scene}: {json}");
        assert_eq!(figure("non_finite_pixels"), 0.0, "{scene}");
    }
}

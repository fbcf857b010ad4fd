//! Named conductors.

mod spectra;

use alloc::vec::Vec;

use etendue_math::Rgb;

use crate::color::{Curve, SpectrumRole, spectrum_to_rgb};
use crate::texture::{TextureId, Textures};
use spectra::CONDUCTORS;

/// A conductor as it was measured.
pub(super) struct Conductor {
    names: &'static [&'static str],
    /// Wavelengths in nm, increasing; index of refraction η and extinction coefficient k.
    samples: &'static [(f64, f64, f64)],
}

impl Conductor {
    /// The one of a name. Letter case matters (`Cr` and `CR` would not be the same).
    pub(super) fn by_name(name: &str) -> Option<&'static Self> {
        CONDUCTORS.iter().find(|conductor| conductor.names.contains(&name))
    }

    /// η and k as textures: curves, and their colours in linear RGB, where components outside the gamut are 0.
    ///
    /// # Source
    /// Colours as of Mitsuba 3's `conductor` in its RGB mode, which are not those of curves under daylight that a scene states
    /// itself.
    pub(super) fn textures(&self, textures: &mut Textures) -> [TextureId; 2] {
        let of = |pick: fn(&(f64, f64, f64)) -> f64| -> Vec<(f64, f64)> {
            self.samples.iter().map(|sample| (sample.0, pick(sample))).collect()
        };
        [of(|sample| sample.1), of(|sample| sample.2)].map(|samples| {
            let rgb = spectrum_to_rgb(&samples, SpectrumRole::Emission);
            let color = Rgb::from(rgb.to_array().map(|c| c.max(0.0) as f32));
            textures.constant_curve(color, Curve::new(samples))
        })
    }
}

/// The names of all conductors.
pub(super) fn names() -> impl Iterator<Item = &'static str> {
    CONDUCTORS.iter().flat_map(|conductor| conductor.names).copied()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn colors(name: &str) -> [[f32; 3]; 2] {
        let mut textures = Textures::default();
        let conductor = Conductor::by_name(name).expect("a conductor");
        conductor.textures(&mut textures).map(|id| textures.color(id, [0.0; 2]).to_array())
    }

    #[test]
    fn colours_are_those_of_mitsuba() {
        // mi.load_dict({'type': 'conductor', 'material': …}), scalar_rgb, 3.9.1.
        for (name, eta, k) in [
            ("Au", [0.143036, 0.375307, 1.44205], [3.983, 2.38556, 1.60336]),
            ("Al", [1.6575, 0.880405, 0.521244], [9.22381, 6.2695, 4.837]),
            ("TiO2-e_palik", [3.10656, 2.51317, 2.58244], [2.97516e-05, 0.0, 0.000182698]),
            ("AlSb", [0.0, 4.13937, 4.66925], [0.0, 0.0940091, 1.30057]),
        ] {
            let found = colors(name);
            for (found, expected) in found.into_iter().zip([eta, k]) {
                for (ours, theirs) in found.into_iter().zip(expected) {
                    // Wavelengths are rounded to a hundredth of a nanometre.
                    assert!(
                        (ours - theirs).abs() <= 1e-4 * (theirs + 0.1),
                        "{name} {ours} {theirs}"
                    );
                }
            }
        }
    }

    #[test]
    fn names_are_unique_and_samples_in_order() {
        for name in names() {
            assert_eq!(names().filter(|&other| other == name).count(), 1, "{name}");
        }
        assert!(Conductor::by_name("au").is_none());
        for conductor in &CONDUCTORS {
            assert!(conductor.samples.is_sorted_by(|a, b| a.0 < b.0), "{:?}", conductor.names);
        }
    }
}

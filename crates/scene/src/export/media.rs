//! Participating media and phase functions.

use alloc::string::String;

use etendue_math::Spectrum as _;

use super::element::Element;
use super::exporter::Exporter;
use super::textures::Meaning;
use super::values::{boolean, float, list, string};
use super::volumes;
use crate::medium::{BlendPhase, Extinction, Medium, MediumId, Phase};

impl Exporter<'_> {
    /// A reference to a medium as the parameter `name`, described where that has not happened yet; nothing for one that does
    /// not exist.
    pub(super) fn medium(&mut self, name: &str, id: MediumId) -> Option<Element> {
        let medium = self.scene.media.get(id)?;
        let known = self.medium_ids.get(&id).cloned();
        let name_of = known.unwrap_or_else(|| self.add_medium(id, medium));
        Some(Element::reference(&name_of).named(name))
    }

    fn add_medium(&mut self, id: MediumId, medium: &Medium) -> String {
        let (plugin, sigma_t, scale) = match &medium.extinction {
            Extinction::Homogeneous(sigma) => {
                let curve = medium.curves.extinction.as_ref().filter(|_| self.spectral);
                let unit = curve.map_or_else(|| volumes::unit(*sigma), |_| 1.0);
                let sigma_t =
                    self.constant("sigma_t", *sigma * unit.recip(), curve, Meaning::Matter);
                ("homogeneous", sigma_t, unit)
            }
            Extinction::Heterogeneous(density) => {
                let volume = density.volume();
                let unit = match volume.placed_grid() {
                    Some(_) => 1.0,
                    None => volumes::unit(volume.mean()),
                };
                let sigma_t =
                    volumes::parameter(self, "sigma_t", volume, Meaning::Matter, None, unit);
                ("heterogeneous", sigma_t, density.scale() * unit)
            }
        };
        let albedo = volumes::parameter(
            self,
            "albedo",
            &medium.albedo,
            Meaning::Share,
            medium.curves.albedo.as_ref(),
            1.0,
        );
        let scale = (scale != 1.0).then(|| float("scale", scale));
        let phase = phase(self, &medium.phase);
        let element = Element::plugin("medium", plugin)
            .with(sigma_t)
            .with_all(scale)
            .with(albedo)
            .with_all((!medium.samples_lights).then(|| boolean("sample_emitters", false)))
            .with(phase);
        let name = self.name("medium");
        self.media.push(element.attribute("id", name.clone()));
        self.medium_ids.insert(id, name.clone());
        name
    }
}

fn phase(exporter: &mut Exporter<'_>, function: &Phase) -> Element {
    let plugin = |kind| Element::plugin("phase", kind);
    match function {
        Phase::Isotropic => plugin("isotropic"),
        Phase::HenyeyGreenstein(lobe) => plugin("hg").with(float("g", lobe.mean_cosine())),
        Phase::Rayleigh => plugin("rayleigh"),
        Phase::Tabulated(table) => {
            plugin("tabphase").with(string("values", &list(table.values()).replace(' ', ", ")))
        }
        Phase::Blend(blend) => {
            let BlendPhase { weight, parts } = &**blend;
            let weight = match weight.placed_grid() {
                Some(_) => volumes::plugin(exporter, weight, 1.0).named("weight"),
                // A number is the mean of a colour that is the same everywhere.
                None => float("weight", weight.mean().mean().min(1.0)),
            };
            plugin("blendphase")
                .with(weight)
                .with_all(parts.iter().map(|part| phase(exporter, part)))
        }
    }
}

//! Glass, metal and plastic.

use etendue_brdf::{
    Alpha, BeckmannLambda, Distribution, InternalReflectance, InternalScattering, Ior, Masking,
    PlasticInterface, TransmittanceTable,
};

use super::super::Loss;
use super::super::element::Element;
use super::super::exporter::Exporter;
use super::super::textures::Meaning::{Matter, Number, Share};
use super::super::values::{boolean, float, string};
use super::{Described, plugin};
use crate::material::{ConductorIndex, PlasticSurface, Roughness};
use crate::texture::TextureId;

impl Exporter<'_> {
    pub(super) fn dielectric(
        &mut self,
        eta: Ior<f32>,
        roughness: Option<&Roughness>,
        [reflected, transmitted]: [TextureId; 2],
    ) -> Described {
        // Facets between equal indices are not there, and refused by Mitsuba.
        let roughness = roughness.filter(|_| !eta.is_matched());
        let name = if roughness.is_some() { "roughdielectric" } else { "dielectric" };
        let facets = roughness.map(|roughness| self.facets(roughness));
        let interface = plugin(name).with_all(indices(eta)).with_all(facets.into_iter().flatten());
        (name, self.scaled(interface, reflected, Some(transmitted)))
    }

    pub(super) fn pane(
        &mut self,
        eta: Ior<f32>,
        [reflected, transmitted]: [TextureId; 2],
    ) -> Described {
        let name = "thindielectric";
        let pane = plugin(name).with_all(indices(eta));
        (name, self.scaled(pane, reflected, Some(transmitted)))
    }

    pub(super) fn conductor(
        &mut self,
        index: ConductorIndex,
        roughness: Option<&Roughness>,
        reflected: TextureId,
    ) -> Described {
        let name = if roughness.is_some() { "roughconductor" } else { "conductor" };
        let mut metal = plugin(name);
        match index {
            ConductorIndex::Mirror => metal = metal.with(string("material", "none")),
            ConductorIndex::Complex { eta, k } => {
                metal = metal.with(self.texture("eta", eta, Matter));
                metal = metal.with(self.texture("k", k, Matter));
            }
        }
        let facets = roughness.map(|roughness| self.facets(roughness));
        let metal = metal.with_all(facets.into_iter().flatten());
        (name, self.scaled(metal, reflected, None))
    }

    pub(super) fn plastic(
        &mut self,
        surface: &PlasticSurface,
        base: TextureId,
        scattering: InternalScattering,
        reflected: TextureId,
    ) -> Described {
        let (name, interface) = self.plastic_interface(surface);
        let nonlinear = scattering == InternalScattering::NonLinear;
        let base = self.texture("diffuse_reflectance", base, Share);
        let plastic = interface.with(base).with_all(nonlinear.then(|| boolean("nonlinear", true)));
        (name, self.scaled(plastic, reflected, None))
    }

    /// With the factors of reflected and transmitted light where they are not 1.
    fn scaled(
        &mut self,
        mut interface: Element,
        reflected: TextureId,
        transmitted: Option<TextureId>,
    ) -> Element {
        let reflected = ("specular_reflectance", Some(reflected));
        for (name, factor) in [reflected, ("specular_transmittance", transmitted)] {
            if let Some(factor) = factor.filter(|&id| !self.scene.textures.is_white(id)) {
                interface = interface.with(self.texture(name, factor, Share));
            }
        }
        interface
    }

    /// The distribution of facets and their widths.
    fn facets(&mut self, roughness: &Roughness) -> impl Iterator<Item = Element> + use<> {
        let &Roughness { distribution, masking, alpha_u, alpha_v } = roughness;
        let distribution = self.distribution(distribution, masking);
        let widths = if alpha_u == alpha_v {
            [Some(self.texture("alpha", alpha_u, Number)), None]
        } else {
            let widths = [("alpha_u", alpha_u), ("alpha_v", alpha_v)];
            widths.map(|(name, id)| Some(self.texture(name, id, Number)))
        };
        [distribution].into_iter().chain(widths.into_iter().flatten())
    }

    fn distribution(&mut self, distribution: Distribution, masking: Masking) -> Element {
        let (name, is_exact) = match distribution {
            Distribution::Ggx => ("ggx", false),
            Distribution::Beckmann { lambda } => ("beckmann", lambda == BeckmannLambda::Exact),
        };
        if is_exact || masking != Masking::Separable {
            self.losses.insert(Loss::ExactFacets);
        }
        string("distribution", name)
    }

    fn plastic_interface(&mut self, surface: &PlasticSurface) -> Described {
        let (name, eta, is_exact, facets) = match surface {
            PlasticSurface::Smooth(interface) => {
                let mitsubas = |eta| PlasticInterface::new(eta, InternalReflectance::Mitsuba);
                let eta = Ior::new(interface.eta()).ok();
                let is_exact = eta.is_some_and(|eta| mitsubas(eta) != *interface);
                ("plastic", eta, is_exact, None)
            }
            PlasticSurface::Rough(table) => {
                let facets = table.facets();
                let eta = Ior::new(table.eta()).ok();
                let (distribution, masking) = (facets.distribution(), facets.masking());
                let [alpha, _] = facets.widths();
                let mitsubas = |eta| {
                    let internal = InternalReflectance::Mitsuba;
                    let alpha = Alpha::clamped(alpha);
                    TransmittanceTable::new(eta, distribution, alpha, masking, internal)
                };
                let is_exact = eta.is_some_and(|eta| mitsubas(eta) != **table);
                let distribution = self.distribution(distribution, masking);
                ("roughplastic", eta, is_exact, Some([distribution, float("alpha", alpha)]))
            }
        };
        if is_exact {
            self.losses.insert(Loss::ExactInternalReflectance);
        }
        let interface = plugin(name).with_all(eta.into_iter().flat_map(indices));
        (name, interface.with_all(facets.into_iter().flatten()))
    }
}

/// A relative index: that of the inside in empty space.
pub(super) fn indices(eta: Ior<f32>) -> [Element; 2] {
    [float("int_ior", eta.value()), float("ext_ior", 1.0_f32)]
}

//! Materials.

use alloc::string::String;

use etendue_brdf::{
    Alpha, BeckmannLambda, Distribution, InternalReflectance, InternalScattering, Ior, Masking,
    PlasticInterface, TransmittanceTable,
};

use etendue_math::{Real, Spectrum};

use super::Loss;
use super::element::Element;
use super::exporter::Exporter;
use super::textures::Meaning::{Matter, Number, Share};
use super::values::{boolean, float, string};
use crate::material::{
    ConductorIndex, Material, MaterialId, Perturbation, PlasticSurface, PrincipledTextures,
    PrincipledThinTextures, Roughness,
};
use crate::texture::TextureId;

impl Exporter<'_> {
    /// A reference to a material, described where that has not happened yet.
    pub(super) fn material(&mut self, id: MaterialId) -> Element {
        if let Some(known) = self.material_ids.get(&id) {
            return Element::reference(known);
        }
        // What there is none of is not noticed.
        let (name, element) = match self.scene.materials.get(id) {
            Some(material) => self.described(material),
            None => ("null", plugin("null")),
        };
        let name: String = self.name(name);
        self.materials.push(element.attribute("id", name.clone()));
        self.material_ids.insert(id, name.clone());
        Element::reference(&name)
    }

    /// The plugin that a material is, and what it is called.
    fn described(&mut self, material: &Material) -> (&'static str, Element) {
        match material {
            Material::Diffuse { reflectance } => self.diffuse(*reflectance),
            Material::RoughDiffuse { reflectance, .. } => {
                self.losses.insert(Loss::RoughDiffuse);
                self.diffuse(*reflectance)
            }
            Material::DiffuseTransmitter { reflectance, transmittance } => {
                ("principledthin", self.transmitter(*reflectance, *transmittance))
            }
            Material::Phong { diffuse_reflectance, specular_reflectance, exponent } => {
                self.phong(*diffuse_reflectance, *specular_reflectance, *exponent)
            }
            Material::Dielectric {
                eta,
                // Left out before.
                dispersion: _,
                nesting: _,
                roughness,
                specular_reflectance,
                specular_transmittance,
            } => {
                // Facets between equal indices are not there, and refused by Mitsuba.
                let roughness = roughness.as_ref().filter(|_| !eta.is_matched());
                let name = if roughness.is_some() { "roughdielectric" } else { "dielectric" };
                let facets = roughness.map(|roughness| self.facets(roughness));
                let interface =
                    plugin(name).with_all(indices(*eta)).with_all(facets.into_iter().flatten());
                (name, self.scaled(interface, *specular_reflectance, Some(*specular_transmittance)))
            }
            Material::ThinDielectric { eta, specular_reflectance, specular_transmittance } => {
                let name = "thindielectric";
                let pane = plugin(name).with_all(indices(*eta));
                (name, self.scaled(pane, *specular_reflectance, Some(*specular_transmittance)))
            }
            Material::Conductor { index, roughness, specular_reflectance } => {
                let name = if roughness.is_some() { "roughconductor" } else { "conductor" };
                let mut metal = plugin(name);
                match *index {
                    ConductorIndex::Mirror => metal = metal.with(string("material", "none")),
                    ConductorIndex::Complex { eta, k } => {
                        metal = metal.with(self.texture("eta", eta, Matter));
                        metal = metal.with(self.texture("k", k, Matter));
                    }
                }
                let facets = roughness.as_ref().map(|roughness| self.facets(roughness));
                let metal = metal.with_all(facets.into_iter().flatten());
                (name, self.scaled(metal, *specular_reflectance, None))
            }
            Material::Plastic {
                surface,
                diffuse_reflectance,
                specular_reflectance,
                scattering,
            } => {
                let (name, interface) = self.plastic(surface);
                let nonlinear = *scattering == InternalScattering::NonLinear;
                let base = self.texture("diffuse_reflectance", *diffuse_reflectance, Share);
                let plastic =
                    interface.with(base).with_all(nonlinear.then(|| boolean("nonlinear", true)));
                (name, self.scaled(plastic, *specular_reflectance, None))
            }
            Material::Principled(textures) => ("principled", self.principled(textures)),
            Material::PrincipledThin(textures) => {
                ("principledthin", self.principled_thin(textures))
            }
            // Left out before.
            Material::Compensated { nested, .. } => match self.scene.materials.get(*nested) {
                Some(material) => self.described(material),
                None => ("null", plugin("null")),
            },
            Material::Mask { opacity, nested } => {
                let opacity = self.texture("opacity", *opacity, Number);
                ("mask", plugin("mask").with(opacity).with(self.material(*nested)))
            }
            Material::Blend { weight, parts } => {
                let weight = self.texture("weight", *weight, Number);
                let parts = parts.map(|part| self.material(part));
                ("blend", plugin("blendbsdf").with(weight).with_all(parts))
            }
            Material::NormalMap { normal, options, nested } => {
                let normal = self.texture("normalmap", *normal, Number);
                let map = plugin("normalmap").with(normal).with_all(perturbation(*options));
                ("normalmap", map.with(self.material(*nested)))
            }
            Material::BumpMap { height, scale, options, nested } => {
                let height = self.height(*height);
                let map = plugin("bumpmap")
                    .with(height)
                    .with_all((*scale != 1.0).then(|| float("scale", *scale)))
                    .with_all(perturbation(*options));
                ("bumpmap", map.with(self.material(*nested)))
            }
            Material::TwoSided { front, back } => {
                let front_side = self.material(*front);
                let back_side = (front != back).then(|| self.material(*back));
                ("twosided", plugin("twosided").with(front_side).with_all(back_side))
            }
            Material::Null => ("null", plugin("null")),
        }
    }

    fn diffuse(&mut self, reflectance: TextureId) -> (&'static str, Element) {
        ("diffuse", plugin("diffuse").with(self.texture("reflectance", reflectance, Share)))
    }

    /// A sheet that lets light through, as Disney's without its specular lobes.
    fn transmitter(&mut self, reflectance: TextureId, transmittance: TextureId) -> Element {
        self.losses.insert(Loss::DiffuseTransmitter);
        let textures = &self.scene.textures;
        let (color, through) = if textures.is_black(reflectance) {
            (self.texture("base_color", transmittance, Share), 2.0)
        } else {
            let [r, t] = [textures.mean(reflectance), textures.mean(transmittance)];
            let both = r + t;
            let share = t.luminance() / both.luminance();
            (self.constant("base_color", both, None, Share), 2.0 * share.clamp(0.0, 1.0))
        };
        plugin("principledthin")
            .with(color)
            .with(float("roughness", 0.0_f32))
            .with(float("diff_trans", through))
    }

    /// Phong's lobe as that of a metal whose facets have normals as far apart: α² = 2 / (n + 2).
    ///
    /// # Source
    /// B. Walter et al., "Microfacet Models for Refraction through Rough Surfaces", EGSR 2007, section 5.2.
    fn phong(
        &mut self,
        diffuse: TextureId,
        specular: TextureId,
        exponent: TextureId,
    ) -> (&'static str, Element) {
        self.losses.insert(Loss::Phong);
        let textures = &self.scene.textures;
        let is_even = [diffuse, specular, exponent].iter().all(|&id| textures.is_constant(id));
        let [kd, ks] = [textures.mean(diffuse), textures.mean(specular)];
        let [d, s] = [kd, ks].map(Spectrum::max_channel);
        if !is_even || s == 0.0 {
            return self.diffuse(diffuse);
        }
        let alpha = Real::sqrt(2.0 / (textures.mean(exponent).luminance() + 2.0));
        let weight = s / (d + s);
        let metal = plugin("roughconductor")
            .with(string("material", "none"))
            .with(float("alpha", alpha))
            .with(self.constant("specular_reflectance", ks * weight.recip(), None, Share));
        let base = match 1.0 - weight {
            rest if rest > 0.0 => kd * rest.recip(),
            _ => kd,
        };
        let base = plugin("diffuse").with(self.constant("reflectance", base, None, Share));
        let parts = [base, metal];
        ("blend", plugin("blendbsdf").with(float("weight", weight)).with_all(parts))
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

    fn plastic(&mut self, surface: &PlasticSurface) -> (&'static str, Element) {
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

    fn principled(&mut self, textures: &PrincipledTextures) -> Element {
        let PrincipledTextures {
            base_color,
            roughness,
            anisotropic,
            metallic,
            spec_trans,
            eta,
            spec_tint,
            sheen,
            sheen_tint,
            flatness,
            clearcoat,
            clearcoat_gloss,
            sampling_rates: [diffuse, specular, coat],
        } = *textures;
        let shares = [
            ("anisotropic", Some(anisotropic)),
            ("metallic", Some(metallic)),
            ("spec_trans", spec_trans),
            ("spec_tint", Some(spec_tint)),
            ("sheen", Some(sheen)),
            ("sheen_tint", Some(sheen_tint)),
            ("flatness", Some(flatness)),
            ("clearcoat", Some(clearcoat)),
            ("clearcoat_gloss", Some(clearcoat_gloss)),
        ];
        let rates = [
            ("diffuse_reflectance_sampling_rate", diffuse),
            ("main_specular_sampling_rate", specular),
            ("clearcoat_sampling_rate", coat),
        ];
        let material = self.lobes("principled", [base_color, roughness], shares);
        material.with(float("eta", eta.value())).with_all(sampling(rates))
    }

    fn principled_thin(&mut self, textures: &PrincipledThinTextures) -> Element {
        let PrincipledThinTextures {
            base_color,
            roughness,
            anisotropic,
            spec_trans,
            eta,
            spec_tint,
            sheen,
            sheen_tint,
            flatness,
            diff_trans,
            sampling_rates: [specular, specular_through, diffuse, diffuse_through],
        } = *textures;
        let shares = [
            ("anisotropic", Some(anisotropic)),
            ("spec_trans", spec_trans),
            ("eta", Some(eta)),
            ("spec_tint", Some(spec_tint)),
            ("sheen", Some(sheen)),
            ("sheen_tint", Some(sheen_tint)),
            ("flatness", Some(flatness)),
            ("diff_trans", Some(diff_trans)),
        ];
        let rates = [
            ("specular_reflectance_sampling_rate", specular),
            ("specular_transmittance_sampling_rate", specular_through),
            ("diffuse_reflectance_sampling_rate", diffuse),
            ("diffuse_transmittance_sampling_rate", diffuse_through),
        ];
        let material = self.lobes("principledthin", [base_color, roughness], shares);
        material.with_all(sampling(rates))
    }

    /// Colour and roughness, and those of the other parameters that are not 0, their default.
    fn lobes<const N: usize>(
        &mut self,
        name: &'static str,
        [base_color, roughness]: [TextureId; 2],
        shares: [(&'static str, Option<TextureId>); N],
    ) -> Element {
        let mut material = plugin(name)
            .with(self.texture("base_color", base_color, Share))
            .with(self.texture("roughness", roughness, Number));
        for (name, id) in shares {
            if let Some(id) = id.filter(|&id| !self.scene.textures.is_black(id)) {
                material = material.with(self.texture(name, id, Number));
            }
        }
        material
    }

    /// The height of bumps, which Mitsuba wants to be a texture of any name.
    fn height(&mut self, id: TextureId) -> Element {
        if self.scene.textures.is_constant(id) {
            let value = self.texture("value", id, Number);
            return Element::plugin("texture", "uniform").with(value).named("height");
        }
        self.texture("height", id, Number)
    }
}

fn plugin(name: &str) -> Element {
    Element::plugin("bsdf", name)
}

/// A relative index: that of the inside in empty space.
fn indices(eta: Ior<f32>) -> [Element; 2] {
    [float("int_ior", eta.value()), float("ext_ior", 1.0_f32)]
}

/// What is done where normals disagree, where it is not the default.
fn perturbation(options: Perturbation) -> impl Iterator<Item = Element> {
    let options = [
        ("flip_invalid_normals", options.flip_invalid_normals),
        ("use_shadowing_function", options.use_shadowing_function),
    ];
    options.into_iter().filter(|(_, is_on)| !is_on).map(|(name, _)| boolean(name, false))
}

/// How often lobes are sampled, where it is not as often as the others.
fn sampling<const N: usize>(rates: [(&'static str, f32); N]) -> impl Iterator<Item = Element> {
    rates.into_iter().filter(|(_, rate)| *rate != 1.0).map(|(name, rate)| float(name, rate))
}

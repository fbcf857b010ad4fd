//! What lets light through.

use alloc::boxed::Box;
use alloc::format;

use etendue_brdf::fresnel::Dispersion;
use etendue_brdf::{Distribution, Ior, Masking};
use etendue_math::{Real, Spectrum};

use super::json::Json;
use super::material::Reading;
use super::principled;
use super::texture::product;
use crate::effect::Element;
use crate::material::{Material, PrincipledThinTextures, RelativeDispersion, Roughness};
use crate::medium::{Boundary, Extinction, Medium, MediumCurves, MediumId, Phase, Volume};
use crate::texture::TextureId;
use crate::{Color, SceneError};

/// How a material transmits.
pub(super) struct Transmission<'a> {
    /// Its share; not black.
    share: TextureId,
    /// `KHR_materials_volume`, of a body; none of a sheet.
    volume: Option<Json<'a>>,
}

impl<'a> Transmission<'a> {
    /// The transmission of a material that has any.
    pub(super) fn of(reading: &mut Reading<'_, 'a>) -> Result<Option<Self>, SceneError> {
        let Some(extension) = reading.json.extension("KHR_materials_transmission")? else {
            return Ok(None);
        };
        let names = ["transmissionFactor", "transmissionTexture"];
        let share = reading.share(&extension, names, 0, 0.0)?;
        let object = reading.metallic_roughness()?;
        let metallic = principled::metallic(reading, &object)?;
        if reading.known(share) == Some(0.0) || reading.known(metallic) == Some(1.0) {
            return Ok(None);
        }
        let volume = match reading.json.extension("KHR_materials_volume")? {
            Some(volume) if volume.number_in("thicknessFactor", 0.0, 0.0..=f64::MAX)? > 0.0 => {
                Some(volume)
            }
            _ => None,
        };
        Ok(Some(Self { share, volume }))
    }
}

/// The material, and the medium that it encloses.
///
/// | | all of it transmits, no metal | else |
/// | --- | --- | --- |
/// | body | dielectric, its base colour a factor of what passes the surface | principled |
/// | sheet | thin dielectric where it is smooth | thin principled |
pub(super) fn of(
    reading: &mut Reading<'_, '_>,
    transmission: &Transmission<'_>,
) -> Result<(Material, Option<Boundary>), SceneError> {
    let object = reading.metallic_roughness()?;
    let metallic = principled::metallic(reading, &object)?;
    let roughness = principled::roughness(reading, &object)?;
    let is_pure =
        reading.known(transmission.share) == Some(1.0) && reading.known(metallic) == Some(0.0);
    let is_smooth = reading.known(roughness) == Some(0.0);
    let dispersion = reading.json.extension("KHR_materials_dispersion")?;
    if let Some(dispersion) = &dispersion
        && !(is_pure && transmission.volume.is_some())
    {
        let message = "only bodies that transmit all light, without metal, disperse it";
        reading.builder.warn(&dispersion.warning(message));
    }
    let Some(volume) = &transmission.volume else {
        return Ok((thin(reading, transmission, is_pure && is_smooth)?, None));
    };
    let material = if is_pure {
        let white = reading.builder.constant(1.0);
        let specular_transmittance = reading.base_color()?;
        let (eta, dispersion) = interface(reading, dispersion.as_ref())?;
        let roughness = (!is_smooth).then(|| {
            let alpha = product(&mut reading.builder.model.textures, roughness, roughness);
            Roughness {
                distribution: Distribution::Ggx,
                masking: Masking::Separable,
                alpha_u: alpha,
                alpha_v: alpha,
            }
        });
        Material::Dielectric {
            eta,
            dispersion,
            nesting: None,
            roughness,
            specular_reflectance: white,
            specular_transmittance,
        }
    } else {
        Material::Principled(principled::of(reading, Some(transmission.share))?.into())
    };
    let interior = inside(reading, volume)?;
    Ok((material, interior.map(|interior| Boundary { interior: Some(interior), exterior: None })))
}

/// A sheet.
fn thin(
    reading: &mut Reading<'_, '_>,
    transmission: &Transmission<'_>,
    is_pane: bool,
) -> Result<Material, SceneError> {
    let index = principled::index(&reading.json)?;
    let base_color = reading.base_color()?;
    if is_pane {
        let eta = Ior::new(index as f32).map_err(|error| reading.json.error(error))?;
        let specular_reflectance = reading.builder.constant(1.0);
        let specular_transmittance = base_color;
        return Ok(Material::ThinDielectric { eta, specular_reflectance, specular_transmittance });
    }
    if reading.json.extension("KHR_materials_clearcoat")?.is_some() {
        reading.warn("a sheet that transmits has no clear coat");
    }
    let object = reading.metallic_roughness()?;
    let metallic = principled::metallic(reading, &object)?;
    if reading.known(metallic) != Some(0.0) {
        reading.warn("a sheet that transmits has no metal");
    }
    let (roughness, anisotropic) = principled::facets(reading)?;
    let nothing = reading.builder.constant(0.0);
    Ok(Material::PrincipledThin(Box::new(PrincipledThinTextures {
        base_color,
        roughness,
        anisotropic,
        spec_trans: Some(transmission.share),
        eta: reading.builder.constant(index as f32),
        spec_tint: nothing,
        sheen: nothing,
        sheen_tint: nothing,
        flatness: nothing,
        diff_trans: nothing,
        sampling_rates: [1.0; 4],
    })))
}

/// The index of a body, by wavelength where it disperses light: `dispersion` is 20 over Abbe's number.
fn interface(
    reading: &Reading<'_, '_>,
    dispersion: Option<&Json<'_>>,
) -> Result<(Ior<f32>, Option<Box<RelativeDispersion>>), SceneError> {
    let index = principled::index(&reading.json)?;
    let plain = Ior::new(index as f32).map_err(|error| reading.json.error(error))?;
    let Some(json) = dispersion else { return Ok((plain, None)) };
    let strength = json.number_in("dispersion", 0.0, 0.0..=f64::MAX)?;
    if strength == 0.0 {
        return Ok((plain, None));
    }
    let interior = Dispersion::from_abbe_number(index, 20.0 / strength);
    let relative = RelativeDispersion { interior, exterior: 1.0 };
    let eta = relative.checked().map_err(|(nm, error)| {
        json.error(format!("the index at {nm} nm: {error}")).help("let it disperse less")
    })?;
    Ok((eta, Some(Box::new(relative))))
}

/// The darkest colour that is left of light after a distance: what is black would have no extinction to speak of.
const DARKEST: f32 = 1e-6;

/// What absorbs light inside a body, if anything does.
///
/// ```text
/// σt = −ln(attenuationColor) / attenuationDistance
/// ```
fn inside(
    reading: &mut Reading<'_, '_>,
    volume: &Json<'_>,
) -> Result<Option<MediumId>, SceneError> {
    let color = super::color(volume, "attenuationColor", [1.0; 3])?;
    let Some(distance) = volume.number("attenuationDistance")? else { return Ok(None) };
    if distance <= 0.0 {
        return Err(volume.error(format!("“attenuationDistance” must be positive, not {distance}")));
    }
    let sigma = color.map(|left| -Real::ln(left.clamp(DARKEST, 1.0)) / distance as f32);
    if sigma.is_black() {
        return Ok(None);
    }
    if !sigma.to_array().iter().all(|sigma| sigma.is_finite()) {
        return Err(volume.error("the medium is too dense for single precision"));
    }
    let media = &mut reading.builder.model.media.list;
    let id = MediumId(media.len() as u32);
    media.push(Medium {
        extinction: Extinction::Homogeneous(sigma),
        albedo: Volume::constant(Color::black()),
        curves: MediumCurves::default(),
        phase: Phase::Isotropic,
        samples_lights: false,
    });
    reading.builder.note(Element::Medium(id), volume)?;
    Ok(Some(id))
}

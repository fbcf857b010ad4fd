//! The families, one file each.

mod ashikhmin_shirley;
mod averages;
mod burley;
mod conductor_fresnel;
mod coupled;
mod dielectric_fresnel;
mod directions;
mod elementary;
mod energy_compensation;
mod layered;
mod metals;
mod monte_carlo;
mod rough_diffuse;
mod smith;

use super::family::FamilyInfo;

/// All families, in the order of reports.
pub const FAMILIES: &[FamilyInfo] = &[
    dielectric_fresnel::USUAL,
    dielectric_fresnel::MATCHED,
    conductor_fresnel::INFO,
    averages::OUTSIDE,
    averages::INSIDE,
    averages::CONDUCTOR,
    rough_diffuse::INFO,
    burley::INFO,
    smith::GGX,
    smith::BECKMANN,
    energy_compensation::INFO,
    ashikhmin_shirley::INFO,
    coupled::INFO,
    layered::INFO,
    elementary::SIN,
    elementary::EXP,
    elementary::LN,
    elementary::POWF,
];

//! The families, one file each.

mod dielectric_fresnel;
mod directions;
mod rough_diffuse;

use super::family::FamilyInfo;

/// All families, in the order of reports.
pub const FAMILIES: &[FamilyInfo] =
    &[dielectric_fresnel::USUAL, dielectric_fresnel::MATCHED, rough_diffuse::INFO];
